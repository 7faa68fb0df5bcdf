/// \file
/// \internal
/// Umbrellas: the orbits of face corners around a pointel under the links between sides.
///
/// A corner is named like the side that starts there. Crossing side i of a face leads to the next
/// corner of the umbrella. An orbit is closed, or it is a chain that starts at the corner whose
/// incoming side is unlinked. Its leader is the smallest corner where closed, the start otherwise.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/surface/surface_mesh.h"
#include "libdsc/surface/topology.h"

#include <span>
#include <vector>

namespace dsc::topology {

using Opposite = std::span<const SideCode>;

/// The next corner around the same vertex, or kNoSide at a chain's end.
inline SideCode next_around(SideCode corner, Opposite opposite) {
  const SideCode across = opposite[static_cast<std::size_t>(corner)];
  return across == kNoSide ? kNoSide : next_side(across);
}
/// The corner before it, or kNoSide at a chain's start.
inline SideCode previous_around(SideCode corner, Opposite opposite) {
  return opposite[static_cast<std::size_t>(previous_side(corner))];
}

/// The leader of the corner's umbrella.
SideCode leader_of(SideCode corner, Opposite opposite);

/// Calls visit(corner) for every corner of the umbrella with this leader.
template <class Visit>
void for_each_around(SideCode leader, Opposite opposite, Visit&& visit) {
  SideCode corner = leader;
  do {
    visit(corner);
    corner = next_around(corner, opposite);
  } while (corner != kNoSide && corner != leader);
}

struct Umbrellas {
  std::vector<SideCode> first;    ///< per pointel, the umbrella with the smallest leader
  std::vector<SideCode> further;  ///< leaders of all the others, by (pointel, leader)
};

Umbrellas find_umbrellas(std::span<const QuadCorners> corners, Opposite opposite, Index vertices,
                         const Context& context);

}  // namespace dsc::topology
