/// \file
/// From voxels to the digital surface.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/surface/adjacency.h"
#include "libdsc/surface/surfel.h"
#include "libdsc/voxels/binary_volume.h"
#include "libdsc/voxels/label_volume.h"

#include <functional>
#include <vector>

namespace dsc {

class DigitalSurface;

/// What happens where the object touches the border of the volume.
enum class Border {
  closed,  ///< surfels there too: the world outside is empty
  open,    ///< none: the surface has a boundary there
};

/// Which surfels are taken, and how they are linked and glued.
struct ExtractOptions {
  Adjacency adjacency = Adjacency::interior;  ///< at linels with four surfels
  Glue glue = Glue::pointel;                  ///< what vertex ids stand for
  Border border = Border::closed;             ///< at the border of the volume
  /// Keeps only the surfels for which it is true; all where it is empty. Called from many threads.
  std::function<bool(const Surfel&)> part;
  /// For label volumes: only the interfaces between these pairs of labels, in either order; all
  /// where it is empty.
  std::vector<LabelPair> between;
};

/// The boundary of the voxel set, or the part of it that `options` keeps.
///
/// Every surfel appears exactly once. An empty set gives an empty surface.
/// \throws LimitError where faces or vertices pass 32-bit ids.
DigitalSurface extract_surface(const BinaryVolume& volume, const ExtractOptions& options = {},
                               const Context& context = {});

/// All interfaces of a label image, each surfel once, from the smaller label to the larger; 0 is
/// always outside. The two labels are the face property `dsc:labels`.
///
/// Surfels are linked at a linel only where they separate the same two labels, and where all four
/// at a linel do, by the adjacency (the smaller label is inside). Elsewhere the mesh ends, and the
/// side table glues: a function runs on across a junction of three labels. \throws as above.
DigitalSurface extract_surface(const LabelVolume& volume, const ExtractOptions& options = {},
                               const Context& context = {});

}  // namespace dsc
