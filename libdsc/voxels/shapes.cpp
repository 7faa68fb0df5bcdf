#include "libdsc/voxels/shapes.h"

#include "libdsc/base/error.h"
#include "libdsc/voxels/shape_rows.h"

#include <cmath>

namespace dsc {
namespace {

/// Squares and fourth powers of sizes stay far from overflow and underflow in this range.
void check_size(const char* shape, const char* key, double size) {
  if (!(size >= 1e-30 && size <= 1e30)) {
    throw UsageError(std::string(shape) + ": " + key + " must be positive (1e-30 to 1e30), not " +
                     text_of(size));
  }
}

void check_coordinate(const char* shape, const char* key, double value) {
  if (!(std::abs(value) <= 1e30)) {
    throw UsageError(std::string(shape) + ": " + key + " must be finite (at most 1e30), not " +
                     text_of(value));
  }
}

}  // namespace

// Sphere. y^2 + z^2 is summed first, so that points with two non-zero coordinates give the same
// bits under every permutation of the axes.

Sphere::Sphere(double r, const Vec3& center) : r_(r), center_(center) {
  check_size("sphere", "r", r);
  check_coordinate("sphere", "cx", center.x());
  check_coordinate("sphere", "cy", center.y());
  check_coordinate("sphere", "cz", center.z());
}

double Sphere::value(const Vec3& p) const {
  const Vec3 q = p - center_;
  return (q.x() * q.x() + (q.y() * q.y() + q.z() * q.z())) - r_ * r_;
}

Vec3 Sphere::gradient(const Vec3& p) const { return 2. * (p - center_); }

Mat3 Sphere::hessian(const Vec3& /*p*/) const { return 2. * Mat3::Identity(); }

Eigen::AlignedBox3d Sphere::bounds() const {
  return {center_ - Vec3::Constant(r_), center_ + Vec3::Constant(r_)};
}

std::string Sphere::name() const {
  return "sphere,r=" + text_of(r_) + ",cx=" + text_of(center_.x()) + ",cy=" + text_of(center_.y()) +
         ",cz=" + text_of(center_.z());
}

void Sphere::values_along_x(double step, Index first, int count, double y, double z,
                            double* out) const {
  const double qy = y - center_.y();
  const double qz = z - center_.z();
  const double yz = qy * qy + qz * qz;
  const double cx = center_.x();
  const double rr = r_ * r_;
  detail::fill_row(step, first, count, out, [=](double x) {
    const double qx = x - cx;
    return (qx * qx + yz) - rr;
  });
}

std::optional<Vec3> Sphere::closest_point_in_closed_form(const Vec3& p) const {
  const Vec3 q = p - center_;
  const double length = q.stableNorm();
  if (!(length > 0)) return center_ + Vec3(r_, 0., 0.);
  return center_ + q * (r_ / length);
}

// Plane.

Plane::Plane(const Vec3& normal, double d, double size)
    : given_(normal), n_(normal), d_(d), size_(size) {
  check_coordinate("plane", "nx", normal.x());
  check_coordinate("plane", "ny", normal.y());
  check_coordinate("plane", "nz", normal.z());
  check_coordinate("plane", "d", d);
  check_size("plane", "size", size);
  const double length = normal.stableNorm();
  if (!(length > 0)) throw UsageError("plane: the normal nx, ny, nz must not be zero");
  n_ /= length;
}

double Plane::value(const Vec3& p) const {
  return (n_.x() * p.x() + (n_.y() * p.y() + n_.z() * p.z())) - d_;
}

Vec3 Plane::gradient(const Vec3& /*p*/) const { return n_; }

Mat3 Plane::hessian(const Vec3& /*p*/) const { return Mat3::Zero(); }

Eigen::AlignedBox3d Plane::bounds() const {
  return {Vec3::Constant(-0.5 * size_), Vec3::Constant(0.5 * size_)};
}

std::string Plane::name() const {
  return "plane,nx=" + text_of(given_.x()) + ",ny=" + text_of(given_.y()) +
         ",nz=" + text_of(given_.z()) + ",d=" + text_of(d_) + ",size=" + text_of(size_);
}

void Plane::values_along_x(double step, Index first, int count, double y, double z,
                           double* out) const {
  const double yz = n_.y() * y + n_.z() * z;
  const double nx = n_.x();
  const double d = d_;
  detail::fill_row(step, first, count, out, [=](double x) { return (nx * x + yz) - d; });
}

std::optional<Vec3> Plane::closest_point_in_closed_form(const Vec3& p) const {
  return p - value(p) * n_;
}

// Ellipsoid.

Ellipsoid::Ellipsoid(const Vec3& semi_axes) : axes_(semi_axes) {
  check_size("ellipsoid", "a", semi_axes.x());
  check_size("ellipsoid", "b", semi_axes.y());
  check_size("ellipsoid", "c", semi_axes.z());
  inverse_squares_ = axes_.cwiseAbs2().cwiseInverse();
}

double Ellipsoid::value(const Vec3& p) const {
  const Vec3& w = inverse_squares_;
  return (w.x() * (p.x() * p.x()) + (w.y() * (p.y() * p.y()) + w.z() * (p.z() * p.z()))) - 1.;
}

Vec3 Ellipsoid::gradient(const Vec3& p) const { return 2. * inverse_squares_.cwiseProduct(p); }

Mat3 Ellipsoid::hessian(const Vec3& /*p*/) const { return (2. * inverse_squares_).asDiagonal(); }

Eigen::AlignedBox3d Ellipsoid::bounds() const { return {-axes_, axes_}; }

std::string Ellipsoid::name() const {
  return "ellipsoid,a=" + text_of(axes_.x()) + ",b=" + text_of(axes_.y()) +
         ",c=" + text_of(axes_.z());
}

void Ellipsoid::values_along_x(double step, Index first, int count, double y, double z,
                               double* out) const {
  const double yz = inverse_squares_.y() * (y * y) + inverse_squares_.z() * (z * z);
  const double wx = inverse_squares_.x();
  detail::fill_row(step, first, count, out, [=](double x) { return (wx * (x * x) + yz) - 1.; });
}

// Torus. With s = |p|^2 + R^2 - r^2: f = s^2 - 4 R^2 (x^2 + y^2).

Torus::Torus(double R, double r) : R_(R), r_(r) {
  check_size("torus", "R", R);
  check_size("torus", "r", r);
  if (!(r < R)) {
    throw UsageError("torus: r must be smaller than R, or it meets itself; r = " + text_of(r) +
                     ", R = " + text_of(R));
  }
}

double Torus::value(const Vec3& p) const {
  const double xx = p.x() * p.x();
  const double yy = p.y() * p.y();
  const double s = (xx + yy) + (p.z() * p.z() + (R_ * R_ - r_ * r_));
  return s * s - 4. * (R_ * R_) * (xx + yy);
}

Vec3 Torus::gradient(const Vec3& p) const {
  const double s = p.squaredNorm() + R_ * R_ - r_ * r_;
  return 4. * s * p - 8. * R_ * R_ * Vec3(p.x(), p.y(), 0.);
}

Mat3 Torus::hessian(const Vec3& p) const {
  const double s = p.squaredNorm() + R_ * R_ - r_ * r_;
  Mat3 h = 8. * p * p.transpose();
  h.diagonal() += Vec3::Constant(4. * s) - 8. * R_ * R_ * Vec3(1., 1., 0.);
  return h;
}

Eigen::AlignedBox3d Torus::bounds() const {
  const Vec3 half(R_ + r_, R_ + r_, r_);
  return {-half, half};
}

std::string Torus::name() const { return "torus,R=" + text_of(R_) + ",r=" + text_of(r_); }

void Torus::values_along_x(double step, Index first, int count, double y, double z,
                           double* out) const {
  const double yy = y * y;
  const double c = z * z + (R_ * R_ - r_ * r_);
  const double rr4 = 4. * (R_ * R_);
  detail::fill_row(step, first, count, out, [=](double x) {
    const double xxyy = x * x + yy;
    const double s = xxyy + c;
    return s * s - rr4 * xxyy;
  });
}

std::optional<Vec3> Torus::closest_point_in_closed_form(const Vec3& p) const {
  const double rho = std::hypot(p.x(), p.y());
  const Vec3 radial = rho > 0 ? Vec3(p.x() / rho, p.y() / rho, 0.) : Vec3(1., 0., 0.);
  const Vec3 core = R_ * radial;  // the closest point of the core circle
  const Vec3 q = p - core;
  const double length = q.stableNorm();
  return core + (length > 0 ? Vec3(q * (r_ / length)) : Vec3(r_ * radial));
}

}  // namespace dsc
