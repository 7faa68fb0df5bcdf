/// \file
/// Implicit shapes: the solid {p in bounds() : f(p) < 0} of a function f with gradient and Hessian.
///
/// The gradient points outwards on the surface {f = 0}. Named shapes have exact derivatives; see
/// shapes.h for their formulas and shape_spec.h to make one from text. All members are const and
/// safe to call from several threads.
#pragma once

#include "libdsc/base/types.h"

#include <Eigen/Geometry>

#include <optional>
#include <string>

namespace dsc {

/// The function, its derivatives and the box; the base of the named shapes and of expressions.
class ImplicitShape {
 public:
  ImplicitShape() = default;
  ImplicitShape(const ImplicitShape&) = delete;
  ImplicitShape& operator=(const ImplicitShape&) = delete;
  virtual ~ImplicitShape() = default;

  /// f at p, in world units. \throws InputError where f is not finite (expressions only).
  virtual double value(const Vec3& p) const = 0;
  /// The gradient of f at p, along the world axes.
  virtual Vec3 gradient(const Vec3& p) const = 0;
  /// The Hessian of f at p, symmetric.
  virtual Mat3 hessian(const Vec3& p) const = 0;

  /// Finite. Contains {f <= 0} where closed(); otherwise the box that cuts it.
  virtual Eigen::AlignedBox3d bounds() const = 0;
  /// Whether the surface lies inside bounds(). If not, bounds() cuts it, and extraction with
  /// Border::open gives its part inside, with a boundary.
  virtual bool closed() const { return true; }
  /// The specification that makes this shape again, with every parameter.
  virtual std::string name() const = 0;

  /// out[k] = f(step (first + k), y, z) for k in [0, count), the same bits as value(). One virtual
  /// call for a word of voxels.
  virtual void values_along_x(double step, Index first, int count, double y, double z,
                              double* out) const;

  /// The closest point of the surface in closed form, for shapes that have one; nothing elsewhere.
  /// Where it is not unique (the centre of a sphere) one of them.
  virtual std::optional<Vec3> closest_point_in_closed_form(const Vec3& /*p*/) const {
    return std::nullopt;
  }
};

}  // namespace dsc
