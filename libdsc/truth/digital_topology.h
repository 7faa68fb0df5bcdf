/// \file
/// Components and Euler number of an implicit surface, as its digitization has them, and points on
/// every component to start a mesher from.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/voxels/binary_volume.h"
#include "libdsc/voxels/implicit_shape.h"

namespace dsc::truth {

/// What two digitizations agree on, and the finer surface.
struct DigitalTopology {
  Index components = 0;    ///< of the surface
  Index euler = 0;         ///< of the surface, V - E + F
  double gridstep = 0;     ///< the coarser of the two that agree
  DigitalSurface surface;  ///< at half of it
};

/// Twice V - E + F - C of the 6-connected voxels: the Euler number of the surface that separates
/// them from the 26-connected rest, pinched or not.
Index surface_euler_number(const BinaryVolume& volume, const Context& context = {});

/// Digitizes at 1/48 of the longest side of bounds(), then at half of that and so on, until two
/// gridsteps in a row agree on both numbers. What is smaller than the gridstep goes unseen.
/// \throws UsageError where the shape is not closed, InputError where no lattice point is inside or
/// {f < 0} reaches the sides of bounds(), SolverError where no two gridsteps down to 1/384 agree.
DigitalTopology digital_topology(const ImplicitShape& shape, const Context& context = {});

/// Vertices of each component, moved onto the smooth surface: `spacing` apart, or closer on
/// components smaller than that.
Eigen::Matrix3Xd surface_seeds(const ImplicitShape& shape, const DigitalTopology& digital,
                               double spacing);

}  // namespace dsc::truth
