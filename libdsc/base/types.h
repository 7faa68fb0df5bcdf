/// \file
/// Scalar, index and vector types that every layer shares.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <cstdint>

/// All of libdsc. What is in a namespace `detail` is no part of what it promises.
namespace dsc {

/// Counts and positions in arrays; 64 bits, so that no voxel or corner count overflows.
using Index = std::int64_t;

/// A degree of freedom of a scalar function on a surface (see DigitalSurface). Never an OpenMesh
/// handle.
using VertexId = std::int32_t;

/// A point or a vector in space, a 3 x 3 matrix; doubles.
/// @{
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
/// @}

/// Column-major with 32-bit inner indices: the form that Eigen's and CHOLMOD's solvers take.
using SparseMatrix = Eigen::SparseMatrix<double>;

/// 3 x n doubles in memory that somebody else owns: column i is the i-th vector.
struct Vec3View {
  const double* data = nullptr;  ///< 3 size doubles
  Index size = 0;                ///< n

  /// Vector i, 0 <= i < size.
  Vec3 operator[](Index i) const { return Vec3(data[3 * i], data[3 * i + 1], data[3 * i + 2]); }
  /// Whether there is no vector.
  bool empty() const { return size == 0; }
  /// The same memory as a 3 x n matrix of Eigen.
  Eigen::Map<const Eigen::Matrix3Xd> matrix() const { return {data, 3, size}; }
};

/// A lattice point or a voxel (i, j, k).
using Index3 = std::array<Index, 3>;

}  // namespace dsc
