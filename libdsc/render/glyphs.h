/// \file
/// \internal
/// Vectors as arrows, spread evenly over the picture.
#pragma once

#include "libdsc/io/results.h"
#include "libdsc/render/camera.h"
#include "libdsc/render/tracer.h"

#include <vector>

namespace dsc::render {

/// Triangles, in pixels.
struct ArrowMesh {
  std::vector<double> positions;  ///< x, y, z
  std::vector<VertexId> corners;
  std::vector<Index> offsets;

  FlatMesh view() const;
};

/// About `count` arrows: the vectors of the faces (or vertices) that are seen at the points of a
/// hexagonal grid of the picture. Those that one in twenty exceeds are one and a half grid steps
/// long, the others in proportion; they start a little above the surface.
ArrowMesh make_arrows(const FlatMesh& mesh, const Field& vectors, int count, const Tracer& surface,
                      const Camera& camera, const Rectangle& area, const Context& context);

}  // namespace dsc::render
