// Shapes, points and digitizations that the tests of truth/ share.
#pragma once

#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/truth/triangle_mesh.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/implicit_shape.h"

#include <numbers>
#include <random>

namespace dsc::truth::test {

inline constexpr double kPi = std::numbers::pi;

inline Vec3View view(const Eigen::Matrix3Xd& points) { return {points.data(), points.cols()}; }

inline DigitalSurface digital_surface(const ImplicitShape& shape, double h) {
  return extract_surface(digitize(shape, Vec3::Constant(h)));
}

/// n points in the shape's box, scaled by `scale` about its centre.
inline Eigen::Matrix3Xd random_points(const ImplicitShape& shape, Index n, double scale = 1.) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  Eigen::Matrix3Xd points(3, n);
  for (Index i = 0; i < n; ++i) {
    const Vec3 t(uniform(random), uniform(random), uniform(random));
    points.col(i) = shape.bounds().center() + scale * t.cwiseProduct(shape.bounds().sizes());
  }
  return points;
}

inline double area_of(const TriangleMesh& mesh) {
  double sum = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) sum += mesh.area_vector(f).norm();
  return sum;
}

/// By the divergence theorem; positive where triangles face outwards.
inline double volume_of(const TriangleMesh& mesh) {
  double sum = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    sum += mesh.area_vector(f).dot(mesh.corner(f, 0)) / 3.;
  }
  return sum;
}

inline TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 4);
  mesh.vertices << 0, 1, 0, 0,  //
      0, 0, 1, 0,               //
      0, 0, 0, 1;
  mesh.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

}  // namespace dsc::truth::test
