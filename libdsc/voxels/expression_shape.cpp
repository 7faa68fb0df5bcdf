#include "libdsc/voxels/expression_shape.h"

#include "libdsc/base/error.h"
#include "libdsc/voxels/shape_rows.h"

#include <cmath>
#include <limits>

namespace dsc {

ExpressionShape::ExpressionShape(const std::string& text, const Eigen::AlignedBox3d& box, bool open)
    : f_(text), box_(box), open_(open), length_(box.diagonal().norm() / 16.) {
  if (!box.min().allFinite() || !box.max().allFinite() ||
      !(box.max().array() > box.min().array()).all()) {
    throw UsageError("expr: the box must be finite, its lower corner below its upper one");
  }
}

double ExpressionShape::value(const Vec3& p) const { return f_(p); }

Vec3 ExpressionShape::gradient(const Vec3& p) const {
  Expression::Evaluator f(f_);
  const double s = std::pow(std::numeric_limits<double>::epsilon(), 1. / 5.) * length_;
  Vec3 g;
  for (int i = 0; i < 3; ++i) {
    const Vec3 e = s * Vec3::Unit(i);
    g[i] = (8. * (f(p + e) - f(p - e)) - (f(p + 2. * e) - f(p - 2. * e))) / (12. * s);
  }
  return g;
}

Mat3 ExpressionShape::hessian(const Vec3& p) const {
  Expression::Evaluator f(f_);
  const double s = std::pow(std::numeric_limits<double>::epsilon(), 1. / 6.) * length_;
  const double f0 = f(p);
  Mat3 h;
  for (int i = 0; i < 3; ++i) {
    const Vec3 e = s * Vec3::Unit(i);
    h(i, i) =
        (16. * (f(p + e) + f(p - e)) - (f(p + 2. * e) + f(p - 2. * e)) - 30. * f0) / (12. * s * s);
    for (int j = 0; j < i; ++j) {
      // d2f/didj = (4 M(s) - M(2s)) / 3 with M the four-point difference: Richardson.
      const auto mixed = [&](double t) {
        const Vec3 a = t * Vec3::Unit(i);
        const Vec3 b = t * Vec3::Unit(j);
        return (f(p + a + b) - f(p + a - b) - f(p - a + b) + f(p - a - b)) / (4. * t * t);
      };
      h(i, j) = h(j, i) = (4. * mixed(s) - mixed(2. * s)) / 3.;
    }
  }
  return h;
}

std::string ExpressionShape::name() const {
  std::string text = "expr:" + f_.text() + ";box=";
  for (int k = 0; k < 6; ++k) {
    text += (k > 0 ? "," : "") + text_of(k < 3 ? box_.min()[k] : box_.max()[k - 3]);
  }
  return open_ ? text + ";open" : text;
}

void ExpressionShape::values_along_x(double step, Index first, int count, double y, double z,
                                     double* out) const {
  Expression::Evaluator f(f_);
  for (int k = 0; k < count; ++k) {
    out[k] = f(Vec3(step * static_cast<double>(first + k), y, z));
  }
}

}  // namespace dsc
