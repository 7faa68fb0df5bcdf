// Small meshes for the calculus' tests, built independently of the extraction.
#pragma once

#include "libdsc/surface/flat_mesh.h"

#include <Eigen/Geometry>

#include <array>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace dsc::testing {

/// A FlatMesh that owns its arrays.
struct OwnedMesh {
  std::vector<double> positions;
  std::vector<VertexId> corners;
  std::vector<Index> offsets;
  std::vector<double> normals;
  std::vector<Surfel> surfels;
  Vec3 spacing{1., 1., 1.};

  FlatMesh view() const {
    FlatMesh mesh;
    mesh.positions = {positions.data(), static_cast<Index>(positions.size()) / 3};
    mesh.corners = corners;
    mesh.offsets = offsets;
    mesh.normals = {normals.data(), static_cast<Index>(normals.size()) / 3};
    mesh.surfels = surfels;
    mesh.spacing = spacing;
    return mesh;
  }
  /// The same faces without the knowledge that they are surfels: takes the general path.
  OwnedMesh as_polygons() const {
    OwnedMesh mesh = *this;
    mesh.surfels.clear();
    return mesh;
  }
  VertexId add_vertex(const Vec3& p) {
    positions.insert(positions.end(), p.data(), p.data() + 3);
    return static_cast<VertexId>(positions.size() / 3) - 1;
  }
  void add_face(const std::vector<VertexId>& ids) {
    if (offsets.empty()) offsets.push_back(0);
    corners.insert(corners.end(), ids.begin(), ids.end());
    offsets.push_back(static_cast<Index>(corners.size()));
  }
};

inline Vec3 random_unit(std::mt19937& random) {
  std::normal_distribution<double> gauss;
  return Vec3(gauss(random), gauss(random), gauss(random)).normalized();
}

/// Unit normals within `spread` of the faces' own (1: any that is not too steep).
inline void add_normals(OwnedMesh& mesh, double spread, unsigned seed) {
  std::mt19937 random(seed);
  mesh.normals.clear();
  for (const Surfel& s : mesh.surfels) {
    const Vec3 u = (s.normal() + spread * random_unit(random)).normalized();
    mesh.normals.insert(mesh.normals.end(), u.data(), u.data() + 3);
  }
}

/// The surfels between the voxels of `object` and the others; `keep` of 100 of them.
inline OwnedMesh digital_mesh(const std::set<std::array<int, 3>>& object, const Vec3& spacing,
                              int keep = 100) {
  OwnedMesh mesh;
  mesh.spacing = spacing;
  std::map<std::array<int, 3>, VertexId> ids;
  int count = 0;
  for (const auto& voxel : object) {
    for (int d = 0; d < 6; ++d) {
      auto other = voxel;
      other[static_cast<std::size_t>(d / 2)] += d % 2 == 1 ? 1 : -1;
      if (object.contains(other) || (count++ * 37) % 100 >= keep) continue;
      mesh.surfels.push_back({voxel[0], voxel[1], voxel[2], d});
      const SurfelFrame frame = kSurfelFrames[d];
      for (const auto& [a, b] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
        std::array<int, 3> pointel = voxel;  // lattice coordinates plus one half
        pointel[static_cast<std::size_t>(d / 2)] += d % 2;
        pointel[static_cast<std::size_t>(frame.first)] += a;
        pointel[static_cast<std::size_t>(frame.second)] += b;
        const auto [it, fresh] = ids.try_emplace(pointel, -1);
        if (fresh) {
          it->second = mesh.add_vertex(
              spacing.cwiseProduct(Vec3(pointel[0] - 0.5, pointel[1] - 0.5, pointel[2] - 0.5)));
        }
        mesh.corners.push_back(it->second);
      }
    }
  }
  return mesh;
}

/// Closed, without pinches: the voxels of a ball.
inline std::set<std::array<int, 3>> ball(int radius) {
  std::set<std::array<int, 3>> object;
  for (int x = -radius; x <= radius; ++x)
    for (int y = -radius; y <= radius; ++y)
      for (int z = -radius; z <= radius; ++z)
        if (x * x + y * y + z * z < radius * radius) object.insert({x, y, z});
  return object;
}

/// Pinched at every other place: random voxels.
inline std::set<std::array<int, 3>> random_voxels(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::set<std::array<int, 3>> object;
  for (int x = 0; x < size; ++x)
    for (int y = 0; y < size; ++y)
      for (int z = 0; z < size; ++z)
        if (random() % 2 == 0) object.insert({x, y, z});
  return object;
}

/// The surfaces every law is checked on: closed, bounded, pinched, all with anisotropic spacing and
/// random normals.
inline std::vector<OwnedMesh> digital_family() {
  const Vec3 spacing(0.5, 1.25, 0.75);
  std::vector<OwnedMesh> family{digital_mesh(ball(4), spacing), digital_mesh(ball(4), spacing, 60),
                                digital_mesh(random_voxels(5, 7), spacing)};
  unsigned seed = 1;
  for (OwnedMesh& mesh : family) add_normals(mesh, 0.8, seed++);
  return family;
}

/// Triangles to octagons, non-planar, glued at random: vertices repeat even within a face.
inline OwnedMesh polygon_soup(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss;
  OwnedMesh mesh;
  for (int v = 0; v < 40; ++v) mesh.add_vertex(Vec3(gauss(random), gauss(random), gauss(random)));
  for (int f = 0; f < 60;) {
    std::vector<VertexId> ids(3 + random() % 6);
    for (VertexId& v : ids) v = static_cast<VertexId>(random() % 40);
    const auto at = [&](std::size_t i) { return mesh.view().positions[ids[i % ids.size()]]; };
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 0; i < ids.size(); ++i) area += 0.5 * at(i).cross(at(i + 1));
    if (area.norm() < 0.2) continue;  // there and back again, or nearly
    ++f;
    mesh.add_face(ids);
    const Vec3 u = random_unit(random);
    mesh.normals.insert(mesh.normals.end(), u.data(), u.data() + 3);
  }
  return mesh;
}

/// digital_family(), its pinched member as polygons too, and polygons that are not planar and meet
/// themselves.
inline std::vector<OwnedMesh> mixed_family() {
  std::vector<OwnedMesh> meshes = digital_family();
  meshes.push_back(meshes[2].as_polygons());
  meshes.push_back(polygon_soup(1));
  return meshes;
}

}  // namespace dsc::testing
