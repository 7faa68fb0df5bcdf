/// \file
/// \internal
/// Counts of a surface glued by pointel, from its links.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/topology.h"

#include <span>

namespace dsc::topology {

/// All counts but pinched_vertices. `corners` holds pointels in [0, vertices); `junctions` lists
/// every linel with more than two surfels, or with two that are not linked; `labels` are those of
/// the faces, empty without.
SurfaceCounts count_glued(std::span<const QuadCorners> corners, Index vertices,
                          std::span<const SideCode> opposite, std::span<const Junction> junctions,
                          std::span<const LabelPair> labels, const Context& context);

}  // namespace dsc::topology
