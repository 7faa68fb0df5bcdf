/// \file
/// The implicit shape of an expression, cut by a box.
///
/// Derivatives are differences of fourth order with steps s = e^(1/5) L for the gradient and
/// e^(1/6) L for the Hessian, e = 2.2e-16 and L = 1/16 of the box's diagonal: for a function that
/// varies on the scale L the relative errors are about 1e-12 and 1e-10. Polynomials up to degree 4
/// are exact up to rounding. The expression is therefore evaluated up to 2 s outside the box too.
#pragma once

#include "libdsc/voxels/expression.h"
#include "libdsc/voxels/implicit_shape.h"

#include <string>

namespace dsc {

/// {p in box : f(p) < 0} for the f of an expression.
class ExpressionShape final : public ImplicitShape {
 public:
  /// \throws UsageError where the text is no expression, or the box is empty or not finite.
  ExpressionShape(const std::string& text, const Eigen::AlignedBox3d& box, bool open = false);

  double value(const Vec3& p) const override;
  Vec3 gradient(const Vec3& p) const override;
  Mat3 hessian(const Vec3& p) const override;
  Eigen::AlignedBox3d bounds() const override { return box_; }
  bool closed() const override { return !open_; }
  std::string name() const override;
  void values_along_x(double step, Index first, int count, double y, double z,
                      double* out) const override;

 private:
  Expression f_;
  Eigen::AlignedBox3d box_;
  bool open_;
  double length_;
};

}  // namespace dsc
