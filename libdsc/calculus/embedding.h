/// \file
/// The corrected embedding of a face: its corners projected along the estimated normal u.
///
/// The projected calculus replaces the corners X of a face by X (I − u uᵀ). The projected vector
/// area is a c u, with a the area of the face and c = u·e the cosine against its own normal e, so
/// every operator depends on u and c alone and grows like 1/c. Where c falls below `min_cosine`, u
/// is tilted back towards e in the plane of both,
///     u ← √(1 − c²) t̂ + c e,   c = min_cosine,   t̂ = the unit part of u across e,
/// which keeps u a unit vector. u points outwards, as e does, so a cosine of zero or below is an
/// estimate gone wrong; it is tilted by the same rule. Only u = −e has no t̂: there u ← e.
/// Every tilted face is reported as clamped.
#pragma once

#include "libdsc/base/types.h"

#include <cmath>

namespace dsc {

/// The normal that a face is projected along, and its cosine.
struct Embedding {
  Vec3 u;                ///< the unit normal that the face is projected along
  double cosine = 1.;    ///< u·e > 0, the factor on the area
  bool clamped = false;  ///< u is not what was given
};

/// The embedding for the estimated normal `u` on a face of own normal `e`, both unit vectors.
inline Embedding embed(const Vec3& u, const Vec3& e, double min_cosine) {
  const double cosine = u.dot(e);
  if (cosine >= min_cosine) return {u, cosine, false};
  const Vec3 across = u - cosine * e;
  const double length = across.norm();
  // Below this length the direction of `across` is the rounding of u.
  if (length < 1e-8) return {e, 1., true};
  const double sine = std::sqrt(1. - min_cosine * min_cosine);
  return {(sine / length) * across + min_cosine * e, min_cosine, true};
}

/// Whether `u` is a finite unit vector, to the precision of a normal that was stored in floats.
inline bool is_unit(const Vec3& u) { return std::abs(u.squaredNorm() - 1.) < 1e-5; }

}  // namespace dsc
