/// \file
/// Meshes with known distances, as owners of the arrays that a FlatMesh views.
#pragma once

#include "libdsc/surface/flat_mesh.h"

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace dsc::testing {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Mesh {
  Eigen::Matrix3Xd positions;
  std::vector<VertexId> corners;
  std::vector<Index> offsets;

  FlatMesh flat() const {
    FlatMesh mesh;
    mesh.positions = {positions.data(), positions.cols()};
    mesh.corners = corners;
    mesh.offsets = offsets;
    return mesh;
  }
  VertexId nearest(const Vec3& p) const {
    Index best = 0;
    (positions.colwise() - p).colwise().squaredNorm().minCoeff(&best);
    return static_cast<VertexId>(best);
  }
};

/// n x m quads of side h in the plane z = 0; vertex (i, j) has id i * (m + 1) + j.
inline Mesh grid(Index n, Index m, double h = 1) {
  Mesh mesh;
  mesh.positions.resize(3, (n + 1) * (m + 1));
  for (Index i = 0; i <= n; ++i) {
    for (Index j = 0; j <= m; ++j) {
      mesh.positions.col(i * (m + 1) + j) << h * static_cast<double>(i), h * static_cast<double>(j),
          0;
    }
  }
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < m; ++j) {
      const auto v = static_cast<VertexId>(i * (m + 1) + j);
      const auto w = static_cast<VertexId>(v + m + 1);
      mesh.corners.insert(mesh.corners.end(), {v, w, w + 1, v + 1});
    }
  }
  return mesh;
}

/// The unit sphere as the six faces of a cube, n x n quads each, projected; closed, 6 n^2 + 2
/// vertices.
inline Mesh cube_sphere(Index n) {
  Mesh mesh;
  std::vector<VertexId> id(static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)), -1);
  std::vector<Vec3> points;
  const auto vertex = [&](Index x, Index y, Index z) {
    VertexId& v = id[static_cast<std::size_t>((x * (n + 1) + y) * (n + 1) + z)];
    if (v < 0) {
      v = static_cast<VertexId>(points.size());
      const Vec3 p =
          2. * Vec3(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)) /
              static_cast<double>(n) -
          Vec3::Ones();
      points.push_back((p * 0.25 * M_PI).array().tan().matrix().normalized());
    }
    return v;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const Index side : {Index{0}, n}) {
      for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j < n; ++j) {
          const auto corner = [&](Index a, Index b) {
            Index c[3];
            c[axis] = side;
            c[(axis + 1) % 3] = a;
            c[(axis + 2) % 3] = b;
            return vertex(c[0], c[1], c[2]);
          };
          const VertexId q[4] = {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1),
                                 corner(i, j + 1)};
          if (side == n) {
            mesh.corners.insert(mesh.corners.end(), {q[0], q[1], q[2], q[3]});
          } else {
            mesh.corners.insert(mesh.corners.end(), {q[0], q[3], q[2], q[1]});
          }
        }
      }
    }
  }
  mesh.positions.resize(3, static_cast<Index>(points.size()));
  for (std::size_t v = 0; v < points.size(); ++v)
    mesh.positions.col(static_cast<Index>(v)) = points[v];
  return mesh;
}

/// The disjoint union, b's vertices after a's; `glue` pairs (vertex of a, vertex of b) become one.
inline Mesh join(const Mesh& a, const Mesh& b, const Vec3& shift = Vec3::Zero()) {
  Mesh mesh = a;
  mesh.positions.conservativeResize(3, a.positions.cols() + b.positions.cols());
  mesh.positions.rightCols(b.positions.cols()) = b.positions.colwise() + shift;
  for (const VertexId v : b.corners) {
    mesh.corners.push_back(v + static_cast<VertexId>(a.positions.cols()));
  }
  return mesh;
}

}  // namespace dsc::testing
