#include "libdsc/base/error.h"
#include "libdsc/voxels/shape_rows.h"
#include "libdsc/voxels/shapes.h"

namespace dsc {

// Rounded cube.

namespace {
double fourth(double t) { return (t * t) * (t * t); }
}  // namespace

RoundedCube::RoundedCube(double r) : r_(r) {
  if (!(r >= 1e-30 && r <= 1e30)) {
    throw UsageError("rounded-cube: r must be positive (1e-30 to 1e30), not " + text_of(r));
  }
}

double RoundedCube::value(const Vec3& p) const {
  return (fourth(p.x()) + (fourth(p.y()) + fourth(p.z()))) - fourth(r_);
}

Vec3 RoundedCube::gradient(const Vec3& p) const { return 4. * p.array().cube(); }

Mat3 RoundedCube::hessian(const Vec3& p) const {
  return Vec3(12. * p.array().square()).asDiagonal();
}

Eigen::AlignedBox3d RoundedCube::bounds() const {
  return {Vec3::Constant(-r_), Vec3::Constant(r_)};
}

std::string RoundedCube::name() const { return "rounded-cube,r=" + text_of(r_); }

void RoundedCube::values_along_x(double step, Index first, int count, double y, double z,
                                 double* out) const {
  const double yz = fourth(y) + fourth(z);
  const double rr = fourth(r_);
  detail::fill_row(step, first, count, out, [=](double x) { return (fourth(x) + yz) - rr; });
}

// Goursat's surface: a sum of g(t) = 0.03 t^4 - 2 t^2 over the axes, less 8. |x| reaches
// sqrt(280/3) = 9.66, where y^2 = z^2 = 100/3.

namespace {
double goursat_term(double t) {
  const double tt = t * t;
  return (0.03 * tt - 2.) * tt;
}
}  // namespace

double Goursat::value(const Vec3& p) const {
  return (goursat_term(p.x()) + (goursat_term(p.y()) + goursat_term(p.z()))) - 8.;
}

Vec3 Goursat::gradient(const Vec3& p) const { return 0.12 * p.array().cube() - 4. * p.array(); }

Mat3 Goursat::hessian(const Vec3& p) const {
  return Vec3(0.36 * p.array().square() - 4.).asDiagonal();
}

Eigen::AlignedBox3d Goursat::bounds() const { return {Vec3::Constant(-10.), Vec3::Constant(10.)}; }

void Goursat::values_along_x(double step, Index first, int count, double y, double z,
                             double* out) const {
  const double yz = goursat_term(y) + goursat_term(z);
  detail::fill_row(step, first, count, out, [=](double x) { return (goursat_term(x) + yz) - 8.; });
}

// Leopold. With w = y^2 z^2 + 4: f = w x^2 + 4 y^2 + 3 z^2 - 100.

double Leopold::value(const Vec3& p) const {
  const double yy = p.y() * p.y();
  const double zz = p.z() * p.z();
  return (yy * zz + 4.) * (p.x() * p.x()) + ((4. * yy + 3. * zz) - 100.);
}

Vec3 Leopold::gradient(const Vec3& p) const {
  const Vec3 s = p.array().square();
  return 2. * Vec3(p.x() * (s.y() * s.z() + 4.), p.y() * (s.x() * s.z() + 4.),
                   p.z() * (s.x() * s.y() + 3.));
}

Mat3 Leopold::hessian(const Vec3& p) const {
  const Vec3 s = p.array().square();
  Mat3 h;
  h.diagonal() = 2. * Vec3(s.y() * s.z() + 4., s.x() * s.z() + 4., s.x() * s.y() + 3.);
  h(0, 1) = h(1, 0) = 4. * p.x() * p.y() * s.z();
  h(0, 2) = h(2, 0) = 4. * p.x() * p.z() * s.y();
  h(1, 2) = h(2, 1) = 4. * p.y() * p.z() * s.x();
  return h;
}

Eigen::AlignedBox3d Leopold::bounds() const {
  const Vec3 half(5., 5., 5.78);  // z reaches sqrt(100/3) = 5.7735
  return {-half, half};
}

void Leopold::values_along_x(double step, Index first, int count, double y, double z,
                             double* out) const {
  const double yy = y * y;
  const double zz = z * z;
  const double w = yy * zz + 4.;
  const double c = (4. * yy + 3. * zz) - 100.;
  detail::fill_row(step, first, count, out, [=](double x) { return w * (x * x) + c; });
}

// Taubin's heart. With A = x^2 + 9/4 y^2 + z^2 - 1: f = A^3 - x^2 z^3 - 9/80 y^2 z^3.

double Heart::value(const Vec3& p) const {
  const double xx = p.x() * p.x();
  const double yy = p.y() * p.y();
  const double zz = p.z() * p.z();
  const double a = xx + ((2.25 * yy + zz) - 1.);
  return a * a * a - (xx + 0.1125 * yy) * (zz * p.z());
}

Vec3 Heart::gradient(const Vec3& p) const {
  const Vec3 s = p.array().square();
  const double zzz = s.z() * p.z();
  const double a = s.x() + ((2.25 * s.y() + s.z()) - 1.);
  const Vec3 da(2. * p.x(), 4.5 * p.y(), 2. * p.z());
  return 3. * a * a * da -
         Vec3(2. * p.x() * zzz, 0.225 * p.y() * zzz, 3. * (s.x() + 0.1125 * s.y()) * s.z());
}

Mat3 Heart::hessian(const Vec3& p) const {
  const Vec3 s = p.array().square();
  const double zzz = s.z() * p.z();
  const double a = s.x() + ((2.25 * s.y() + s.z()) - 1.);
  const Vec3 da(2. * p.x(), 4.5 * p.y(), 2. * p.z());
  Mat3 h = da * da.transpose();  // symmetric to the last bit, unlike (6 a da) da^T
  h *= 6. * a;
  h.diagonal() += 3. * a * a * Vec3(2., 4.5, 2.) -
                  Vec3(2. * zzz, 0.225 * zzz, 6. * (s.x() + 0.1125 * s.y()) * p.z());
  h(0, 2) -= 6. * p.x() * s.z();
  h(2, 0) -= 6. * p.x() * s.z();
  h(1, 2) -= 0.675 * p.y() * s.z();
  h(2, 1) -= 0.675 * p.y() * s.z();
  return h;
}

Eigen::AlignedBox3d Heart::bounds() const {
  const Vec3 half(1.2, 0.8, 1.3);
  return {-half, half};
}

void Heart::values_along_x(double step, Index first, int count, double y, double z,
                           double* out) const {
  const double yy = y * y;
  const double c = (2.25 * yy + z * z) - 1.;
  const double yyw = 0.1125 * yy;
  const double zzz = (z * z) * z;
  detail::fill_row(step, first, count, out, [=](double x) {
    const double xx = x * x;
    const double a = xx + c;
    return a * a * a - (xx + yyw) * zzz;
  });
}

}  // namespace dsc
