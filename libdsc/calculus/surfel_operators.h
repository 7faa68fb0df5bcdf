/// \file
/// The calculus on a surfel in closed form: a handful of flops, no matrices.
///
/// In the frame of a rectangle hx × hy with outward normal z, corners in the order 00, 10, 11, 01
/// (kSurfelFrames) and estimated normal u, a function φ enters by its mean differences along x and
/// along y and by its twist,
///     p = ½ (−φ00 + φ10 + φ11 − φ01),  q = ½ (−φ00 − φ10 + φ11 + φ01),  g·φ = φ00 − φ10 + φ11 −
///     φ01.
/// With area a = hx hy u_z of the projected face:
///     G φ     = (p/hx, q/hy, −(u_x p/hx + u_y q/hy)/u_z)
///     φᵀLφ    = −(A p² + B q² + 2 C p q + λ_f (g·φ)²),
///               A = (hy/hx)(1 − u_y²)/u_z,  B = (hx/hy)(1 − u_x²)/u_z,  C = u_x u_y/u_z
///     Div V d = −a Gᵀ d
/// Equal to FaceOperators on the projected corners, whatever u is (DESIGN: 'One family').
#pragma once

#include "libdsc/calculus/embedding.h"
#include "libdsc/calculus/options.h"
#include "libdsc/surface/surfel.h"

#include <array>
#include <cmath>

namespace dsc {

/// The rectangle that all surfels of one direction share.
struct SurfelShape {
  /// World axes of the frame.
  /// @{
  int x = 0, y = 1, z = 2;
  /// @}

  double sign = 1.;  ///< the frame's z axis is sign × world axis z

  /// Edges along x and y, world units.
  /// @{
  double hx = 1., hy = 1.;
  /// @}

  /// hy/hx and hx/hy: divided once, not for each surfel.
  /// @{
  double yx = hy / hx, xy = hx / hy;
  /// @}

  /// Of the surfel itself, hx hy.
  double area() const { return hx * hy; }
};

/// The rectangles of the six directions for voxels of `spacing`.
inline std::array<SurfelShape, 6> surfel_shapes(const Vec3& spacing) {
  std::array<SurfelShape, 6> shapes;
  for (int d = 0; d < 6; ++d) {
    const SurfelFrame frame = kSurfelFrames[d];
    shapes[static_cast<std::size_t>(d)] = {
        frame.first,          frame.second,         d >> 1, (d & 1) != 0 ? 1. : -1.,
        spacing[frame.first], spacing[frame.second]};
  }
  return shapes;
}

/// The local Laplacian of a surfel: the entry between corners i and j depends on i xor j alone, but
/// for the sign of c, which is that of the diagonal through corner i.
struct SurfelLaplacian {
  double s = 0.;     ///< ¼ (A + B)
  double c = 0.;     ///< ½ C
  double d = 0.;     ///< ¼ (A − B)
  double area = 0.;  ///< a, of the projected face

  /// −L(i, i) without its part of λ_f.
  double diagonal(int i) const { return (i & 1) == 0 ? s + c : s - c; }
  /// L(i, j); every corner has its own diagonal, an x-edge (i xor 1), its opposite (i xor 2) and a
  /// y-edge (i xor 3).
  double entry(int i, int j, double lambda_f) const {
    switch (i ^ j) {
      case 0:
        return -diagonal(i) - lambda_f;
      case 1:
        return d + lambda_f;
      case 2:
        return diagonal(i) - lambda_f;
      default:
        return lambda_f - d;
    }
  }
};

/// λ_f as constant + slope · s, for SurfelLaplacian::s (which is a quarter of the s in options.h).
struct SurfelLambda {
  double constant = 0.;  ///< the part without s
  double slope = 0.;     ///< the factor of s
  /// Of the stabilization that the options name.
  explicit SurfelLambda(const CalculusOptions& options) {
    switch (options.stabilization) {
      case Stabilization::de_goes:
        constant = options.lambda;
        break;
      case Stabilization::mercat:
        break;
      case Stabilization::corrected_elements:
        slope = 4. / 12.;
        break;
      case Stabilization::virtual_refinement:
        slope = 4. / 8.;
        break;
    }
  }
  /// λ_f of a surfel.
  double operator()(double s) const { return constant + slope * s; }
};

/// The operators on one surfel; refers to the shape, which must outlive it.
class SurfelOperators {
 public:
  /// The naive embedding: u = e.
  explicit SurfelOperators(const SurfelShape& shape) : shape_(shape) {}
  /// `u` is a unit vector in world axes.
  SurfelOperators(const SurfelShape& shape, const Vec3& u, double min_cosine)
      : shape_(shape), ux_(u[shape.x]), uy_(u[shape.y]), uz_(shape.sign * u[shape.z]) {
    if (uz_ < min_cosine) clamp(min_cosine);
  }

  /// Whether u was tilted back (embedding.h).
  bool clamped() const { return clamped_; }
  /// Area of the projected face.
  double area() const { return shape_.area() * uz_; }
  /// The normal of the projected face, in world axes.
  Vec3 normal() const { return world(ux_, uy_, uz_); }

  /// L of the surfel, still without λ_f.
  SurfelLaplacian laplacian() const {
    const double quarter = 0.25 / uz_;
    const double a = shape_.yx * (1. - uy_ * uy_) * quarter;
    const double b = shape_.xy * (1. - ux_ * ux_) * quarter;
    return {a + b, 2. * ux_ * uy_ * quarter, a - b, area()};
  }
  /// G φ, the gradient of the corner values, in world axes.
  Vec3 gradient(double phi0, double phi1, double phi2, double phi3) const {
    const double x = 0.5 * ((phi2 - phi0) - (phi3 - phi1)) / shape_.hx;
    const double y = 0.5 * ((phi2 - phi0) + (phi3 - phi1)) / shape_.hy;
    return world(x, y, -(ux_ * x + uy_ * y) / uz_);
  }
  /// Div V d, the integrated divergence at the corners of the vector `d` in world axes.
  std::array<double, 4> divergence(const Vec3& d) const {
    const double dz = shape_.sign * d[shape_.z];
    const double m = 0.5 * shape_.hy * (uz_ * d[shape_.x] - ux_ * dz);
    const double n = 0.5 * shape_.hx * (uz_ * d[shape_.y] - uy_ * dz);
    return {m + n, n - m, -m - n, m - n};
  }

 private:
  /// The rule of embedding.h for e = z.
  void clamp(double min_cosine) {
    clamped_ = true;
    const double across = std::sqrt(ux_ * ux_ + uy_ * uy_);
    if (across < 1e-8) {
      ux_ = uy_ = 0.;
      uz_ = 1.;
      return;
    }
    const double scale = std::sqrt(1. - min_cosine * min_cosine) / across;
    ux_ *= scale;
    uy_ *= scale;
    uz_ = min_cosine;
  }
  Vec3 world(double x, double y, double z) const {
    Vec3 v;
    v[shape_.x] = x;
    v[shape_.y] = y;
    v[shape_.z] = shape_.sign * z;
    return v;
  }

  const SurfelShape& shape_;
  double ux_ = 0., uy_ = 0., uz_ = 1.;
  bool clamped_ = false;
};

}  // namespace dsc
