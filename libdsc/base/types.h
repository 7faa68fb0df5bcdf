/// \file
/// Scalar, index and vector types that every layer shares.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <cstdint>

namespace dsc {

/// Counts and positions in arrays; 64 bits, so that no voxel or corner count overflows.
using Index = std::int64_t;

/// A degree of freedom of a scalar function on a surface (see DigitalSurface). Never an OpenMesh
/// handle.
using VertexId = std::int32_t;

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Column-major with 32-bit inner indices: the form that Eigen's and CHOLMOD's solvers take.
using SparseMatrix = Eigen::SparseMatrix<double>;

/// 3 x n doubles in memory that somebody else owns: column i is the i-th vector.
struct Vec3View {
  const double* data = nullptr;
  Index size = 0;

  Vec3 operator[](Index i) const { return Vec3(data[3 * i], data[3 * i + 1], data[3 * i + 2]); }
  bool empty() const { return size == 0; }
  Eigen::Map<const Eigen::Matrix3Xd> matrix() const { return {data, 3, size}; }
};

/// A lattice point or a voxel (i, j, k).
using Index3 = std::array<Index, 3>;

}  // namespace dsc
