/// \file
/// Small meshes whose pictures are known.
#pragma once

#include "libdsc/surface/flat_mesh.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace dsc::test {

struct OwnMesh {
  Eigen::Matrix3Xd positions;
  std::vector<VertexId> corners;
  std::vector<Index> offsets;  ///< empty: quads

  FlatMesh view() const {
    FlatMesh mesh;
    mesh.positions = {positions.data(), positions.cols()};
    mesh.corners = corners;
    mesh.offsets = offsets;
    return mesh;
  }
};

/// An axis-aligned box; its faces: -x, +x, -y, +y, -z, +z.
inline OwnMesh box(const Vec3& low, const Vec3& high) {
  OwnMesh mesh;
  mesh.positions.resize(3, 8);
  for (int i = 0; i < 8; ++i) {
    for (int a = 0; a < 3; ++a) mesh.positions(a, i) = ((i >> a) & 1) != 0 ? high[a] : low[a];
  }
  mesh.corners = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  return mesh;
}

/// The rectangle [0, a] × [0, b] of the plane y = 0, seen from the front with x to the right and z
/// up, as n × n quads.
inline OwnMesh front_plane(double a, double b, int n) {
  OwnMesh mesh;
  mesh.positions.resize(3, (n + 1) * (n + 1));
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) mesh.positions.col(j * (n + 1) + i) << a * i / n, 0., b * j / n;
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int v = j * (n + 1) + i;
      mesh.corners.insert(mesh.corners.end(), {v, v + 1, v + n + 2, v + n + 1});
    }
  }
  return mesh;
}

/// The unit sphere: two fans of triangles at the poles, quads between.
inline OwnMesh sphere(int n) {
  OwnMesh mesh;
  const int around = 2 * n;
  mesh.positions.resize(3, (n - 1) * around + 2);
  for (int j = 1; j < n; ++j) {
    for (int i = 0; i < around; ++i) {
      const double theta = std::numbers::pi * j / n, phi = std::numbers::pi * i / n;
      mesh.positions.col((j - 1) * around + i) << std::sin(theta) * std::cos(phi),
          std::sin(theta) * std::sin(phi), std::cos(theta);
    }
  }
  const int north = (n - 1) * around, south = north + 1;
  mesh.positions.col(north) << 0, 0, 1;
  mesh.positions.col(south) << 0, 0, -1;
  mesh.offsets.push_back(0);
  const auto add = [&](std::initializer_list<VertexId> face) {
    mesh.corners.insert(mesh.corners.end(), face);
    mesh.offsets.push_back(static_cast<Index>(mesh.corners.size()));
  };
  for (int i = 0; i < around; ++i) {
    const int next = (i + 1) % around, last = (n - 2) * around;
    add({north, i, next});
    for (int j = 0; j + 2 < n; ++j) {
      add({j * around + i, (j + 1) * around + i, (j + 1) * around + next, j * around + next});
    }
    add({last + i, south, last + next});
  }
  return mesh;
}

}  // namespace dsc::test
