#include "libdsc/truth/exact_geodesic.h"
#include "libdsc/truth/smooth_mesh.h"

#include <algorithm>
#include <cmath>

namespace dsc::truth {

SurfaceDistances surface_distances(const ImplicitShape& shape, double edge_length,
                                   const Vec3& source, Vec3View queries, const Context& context) {
  // Refused before the work that a finer mesh would be.
  const SmoothMesh coarse = smooth_mesh(shape, {edge_length, kMaxGeodesicVertices}, context);
  const SmoothMesh fine = refine(shape, coarse, context);
  const ExactGeodesic on_fine(fine.mesh);
  SurfaceDistances result;
  result.fine_vertices = fine.counts.vertices;
  result.coarse = ExactGeodesic(coarse.mesh).distances(source, queries, context);
  result.fine = on_fine.distances(source, queries, context);
  result.distance.resize(queries.size);
  for (Index i = 0; i < queries.size; ++i) {
    if (std::isinf(result.fine[i])) {
      result.distance[i] = result.fine[i];
      continue;
    }
    result.distance[i] = (4. * result.fine[i] - result.coarse[i]) / 3.;
    result.correction = std::max(result.correction, std::abs(result.distance[i] - result.fine[i]));
  }
  return result;
}

}  // namespace dsc::truth
