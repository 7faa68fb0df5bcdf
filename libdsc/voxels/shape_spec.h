/// \file
/// Implicit shapes from text.
///
///     NAME[,key=value…]              sphere,r=2,cz=0.5     torus,R=1,r=0.4
///     expr:EXPR;box=LO,HI            expr:x^2+y^2+z^4-1;box=-1.1,1.1
///     expr:EXPR;box=X0,Y0,Z0,X1,Y1,Z1[;open]
///
/// | name         | keys (defaults)                           |
/// | ------------ | ----------------------------------------- |
/// | sphere       | r (1), cx, cy, cz (0)                     |
/// | ellipsoid    | a (1), b (0.8), c (0.6)                   |
/// | torus        | R (1), r (0.4)                            |
/// | rounded-cube | r (1)                                     |
/// | goursat, leopold, heart | none                           |
/// | plane        | nx, ny, nz (1), d (0), size (10)          |
///
/// An expression is cut by its box: where {f < 0} reaches it the surface is closed by the box's
/// sides, or left open there with `;open`. Its derivatives are finite differences (expression.h).
#pragma once

#include "libdsc/voxels/implicit_shape.h"

#include <memory>
#include <string>
#include <vector>

namespace dsc {

/// \throws UsageError with the known names or keys for an unknown one, and for a value that is not
/// a finite number or out of its range.
std::unique_ptr<ImplicitShape> make_shape(const std::string& spec);

/// One line a shape, name and keys with their defaults, for help texts.
std::vector<std::string> known_shapes();

}  // namespace dsc
