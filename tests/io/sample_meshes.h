/// \file
/// Meshes for the tests of mesh files: none of them easy.
#pragma once

#include "libdsc/io/polygon_mesh.h"

#include <cmath>
#include <random>

namespace dsc::test {

/// Random finite doubles of very different sizes, and -0.
inline double odd_double(std::mt19937_64& random) {
  const double mantissa = std::uniform_real_distribution<double>(-1, 1)(random);
  const int exponent = std::uniform_int_distribution<int>(-60, 30)(random);
  return random() % 17 == 0 ? -0. : std::ldexp(mantissa, exponent);
}

/// Adds a face.
inline void add_face(PolygonMesh& mesh, std::initializer_list<VertexId> corners) {
  if (mesh.offsets.empty()) mesh.offsets.push_back(0);
  mesh.corners.insert(mesh.corners.end(), corners);
  mesh.offsets.push_back(std::ssize(mesh.corners));
}

inline void set_random_positions(PolygonMesh& mesh, Index vertices, unsigned seed) {
  std::mt19937_64 random(seed);
  mesh.positions.resize(3, vertices);
  for (double& x : mesh.positions.reshaped()) x = odd_double(random);
}

/// Unit normals that are no face's own, and fields of every kind.
inline void add_random_fields(PolygonMesh& mesh, unsigned seed) {
  std::mt19937_64 random(seed);
  const Index V = mesh.positions.cols(), F = std::ssize(mesh.offsets) - 1;
  mesh.normals.resize(3, F);
  for (Index f = 0; f < F; ++f) {
    mesh.normals.col(f) = Vec3::Random().normalized();
  }
  const auto add = [&](const char* name, std::vector<std::string> parts, FieldOn on) {
    MeshField field{name, std::move(parts), on, {}};
    const Index n = (on == FieldOn::vertex ? V : F) * std::ssize(field.parts);
    for (Index i = 0; i < n; ++i) field.values.push_back(odd_double(random));
    mesh.fields.push_back(std::move(field));
  };
  add("distance", {"distance"}, FieldOn::vertex);
  add("direction", {"direction_x", "direction_y", "direction_z"}, FieldOn::vertex);
  add("gradient", {"gx", "gy", "gz"}, FieldOn::face);
  add("heat", {"heat"}, FieldOn::face);
  if (V > 0) mesh.fields[0].values[0] = std::numeric_limits<double>::infinity();
}

/// A triangle, a quad and a hexagon about one vertex, and a vertex that no face has.
inline PolygonMesh mixed_mesh() {
  PolygonMesh mesh;
  set_random_positions(mesh, 11, 1);
  add_face(mesh, {0, 1, 2});
  add_face(mesh, {0, 2, 3, 4});
  add_face(mesh, {0, 4, 5, 6, 7, 8});
  add_face(mesh, {3, 2, 9});
  return mesh;
}

/// Three quads at one edge, two of them with the same direction along it; a face given twice; two
/// fans that touch at a vertex only.
inline PolygonMesh junction_mesh() {
  PolygonMesh mesh;
  set_random_positions(mesh, 14, 2);
  add_face(mesh, {0, 1, 2, 3});
  add_face(mesh, {1, 0, 4, 5});
  add_face(mesh, {0, 1, 6, 7});
  add_face(mesh, {0, 1, 6, 7});
  add_face(mesh, {8, 9, 10});
  add_face(mesh, {8, 11, 12});
  add_face(mesh, {8, 12, 13});
  return mesh;
}

/// Triangles whose coordinates are floats, each vertex in some triangle, in the order of their
/// appearance: what an .stl file can hold.
inline PolygonMesh float_triangles(Index rows) {
  PolygonMesh mesh;
  mesh.offsets.push_back(0);
  std::vector<Vec3> points;
  std::vector<VertexId> id(static_cast<std::size_t>((rows + 1) * (rows + 1)), -1);
  std::mt19937_64 random(3);
  const auto vertex = [&](Index i, Index j) {
    VertexId& v = id[static_cast<std::size_t>(i * (rows + 1) + j)];
    if (v < 0) {
      v = static_cast<VertexId>(points.size());
      const auto x = static_cast<float>(odd_double(random)) + 0.F;
      points.emplace_back(x, i, j);
    }
    return v;
  };
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < rows; ++j) {
      const VertexId a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1);
      add_face(mesh, {a, b, c});
      const VertexId d = vertex(i, j + 1);
      add_face(mesh, {a, c, d});
    }
  }
  mesh.positions.resize(3, std::ssize(points));
  for (Index v = 0; v < mesh.positions.cols(); ++v) {
    mesh.positions.col(v) = points[static_cast<std::size_t>(v)];
  }
  return mesh;
}

}  // namespace dsc::test
