/// \file
/// The named shapes, each with exact gradient and Hessian. Inside is f < 0.
///
/// | class       | f(x, y, z), p = (x, y, z) relative to the centre | bounds          |
/// | ----------- | ------------------------------------------------ | --------------- |
/// | Sphere      | x^2 + y^2 + z^2 - r^2                            | r               |
/// | Ellipsoid   | (x/a)^2 + (y/b)^2 + (z/c)^2 - 1                  | a, b, c         |
/// | Torus       | (x^2+y^2+z^2+R^2-r^2)^2 - 4 R^2 (x^2+y^2)        | R + r, R + r, r |
/// | RoundedCube | x^4 + y^4 + z^4 - r^4                            | r               |
/// | Goursat     | 0.03 (x^4+y^4+z^4) - 2 (x^2+y^2+z^2) - 8         | 10              |
/// | Leopold     | x^2 y^2 z^2 + 4 x^2 + 4 y^2 + 3 z^2 - 100        | 5, 5, 5.78      |
/// | Heart       | (x^2+9/4 y^2+z^2-1)^3 - x^2 z^3 - 9/80 y^2 z^3   | 1.2, 0.8, 1.3   |
/// | Plane       | n.p - d, n a unit vector                         | size / 2        |
///
/// The axis of Torus is z; bounds() of Plane cuts it (not closed).
/// Degenerate: the gradient of Heart vanishes where its surface meets the plane z = 0 (the equation
/// has a cusp direction there), so closest points near that curve may fail to converge.
#pragma once

#include "libdsc/voxels/implicit_shape.h"

namespace dsc {

/// A ball. Here and below radii must be positive and every parameter finite; the constructors throw
/// UsageError otherwise.
class Sphere final : public ImplicitShape {
 public:
  /// Radius and centre, world units.
  explicit Sphere(double r = 1., const Vec3& center = Vec3::Zero());
  /// As given.
  /// @{
  double radius() const { return r_; }
  const Vec3& center() const { return center_; }
  /// @}

  double value(const Vec3& p) const override;
  Vec3 gradient(const Vec3& p) const override;
  Mat3 hessian(const Vec3& p) const override;
  Eigen::AlignedBox3d bounds() const override;
  std::string name() const override;
  void values_along_x(double step, Index first, int count, double y, double z,
                      double* out) const override;
  std::optional<Vec3> closest_point_in_closed_form(const Vec3& p) const override;

 private:
  double r_;
  Vec3 center_;
};

/// The half space n.p < d, cut by the cube of edge length `size` around the origin.
class Plane final : public ImplicitShape {
 public:
  /// `normal` is made a unit vector; `d` is the distance of the plane from the origin along it.
  explicit Plane(const Vec3& normal = Vec3::Ones(), double d = 0., double size = 10.);
  const Vec3& normal() const { return n_; }  ///< unit, outward
  double offset() const { return d_; }       ///< d

  double value(const Vec3& p) const override;
  Vec3 gradient(const Vec3& p) const override;
  Mat3 hessian(const Vec3& p) const override;
  Eigen::AlignedBox3d bounds() const override;
  bool closed() const override { return false; }
  std::string name() const override;
  void values_along_x(double step, Index first, int count, double y, double z,
                      double* out) const override;
  std::optional<Vec3> closest_point_in_closed_form(const Vec3& p) const override;

 private:
  Vec3 given_;  ///< the normal as it was given: a unit vector divided by its length may change bits
  Vec3 n_;
  double d_;
  double size_;
};

/// Semi-axes a, b, c.
class Ellipsoid final : public ImplicitShape {
 public:
  /// a, b, c, world units.
  explicit Ellipsoid(const Vec3& semi_axes = Vec3(1., 0.8, 0.6));
  /// As given.
  const Vec3& semi_axes() const { return axes_; }

  double value(const Vec3& p) const override;
  Vec3 gradient(const Vec3& p) const override;
  Mat3 hessian(const Vec3& p) const override;
  Eigen::AlignedBox3d bounds() const override;
  std::string name() const override;
  void values_along_x(double step, Index first, int count, double y, double z,
                      double* out) const override;

 private:
  Vec3 axes_;
  Vec3 inverse_squares_;
};

/// A circle of radius R around the z axis, thickened by r; 0 < r < R.
class Torus final : public ImplicitShape {
 public:
  /// World units. \throws UsageError unless 0 < r < R.
  explicit Torus(double R = 1., double r = 0.4);
  /// As given.
  /// @{
  double major_radius() const { return R_; }
  double minor_radius() const { return r_; }
  /// @}

  double value(const Vec3& p) const override;
  Vec3 gradient(const Vec3& p) const override;
  Mat3 hessian(const Vec3& p) const override;
  Eigen::AlignedBox3d bounds() const override;
  std::string name() const override;
  void values_along_x(double step, Index first, int count, double y, double z,
                      double* out) const override;
  std::optional<Vec3> closest_point_in_closed_form(const Vec3& p) const override;

 private:
  double R_;
  double r_;
};

/// A cube with edges and corners rounded off, of half width r.
class RoundedCube final : public ImplicitShape {
 public:
  /// World units.
  explicit RoundedCube(double r = 1.);

  double value(const Vec3& p) const override;
  Vec3 gradient(const Vec3& p) const override;
  Mat3 hessian(const Vec3& p) const override;
  Eigen::AlignedBox3d bounds() const override;
  std::string name() const override;
  void values_along_x(double step, Index first, int count, double y, double z,
                      double* out) const override;

 private:
  double r_;
};

/// Goursat's quartic with the coefficients of the table; no parameters.
class Goursat final : public ImplicitShape {
 public:
  double value(const Vec3& p) const override;
  Vec3 gradient(const Vec3& p) const override;
  Mat3 hessian(const Vec3& p) const override;
  Eigen::AlignedBox3d bounds() const override;
  std::string name() const override { return "goursat"; }
  void values_along_x(double step, Index first, int count, double y, double z,
                      double* out) const override;
};

/// The sextic of the table; no parameters.
class Leopold final : public ImplicitShape {
 public:
  double value(const Vec3& p) const override;
  Vec3 gradient(const Vec3& p) const override;
  Mat3 hessian(const Vec3& p) const override;
  Eigen::AlignedBox3d bounds() const override;
  std::string name() const override { return "leopold"; }
  void values_along_x(double step, Index first, int count, double y, double z,
                      double* out) const override;
};

/// The heart of the table; its gradient vanishes in the plane z = 0, see above.
class Heart final : public ImplicitShape {
 public:
  double value(const Vec3& p) const override;
  Vec3 gradient(const Vec3& p) const override;
  Mat3 hessian(const Vec3& p) const override;
  Eigen::AlignedBox3d bounds() const override;
  std::string name() const override { return "heart"; }
  void values_along_x(double step, Index first, int count, double y, double z,
                      double* out) const override;
};

}  // namespace dsc
