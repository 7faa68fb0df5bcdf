// A label image: three labels meet along a line, and a distance runs across it.
#include "libdsc/algorithms/geodesic.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"

#include <cmath>
#include <iostream>

// Three sectors of 120 degrees around the z axis through the middle, turned a little.
dsc::LabelVolume sectors(dsc::Index n) {
  dsc::LabelVolume volume(dsc::Grid{{n, n, n}}, 1);
  const double middle = 0.5 * static_cast<double>(n - 1);
  for (dsc::Index z = 0; z < n; ++z) {
    for (dsc::Index y = 0; y < n; ++y) {
      for (dsc::Index x = 0; x < n; ++x) {
        const double angle = std::atan2(static_cast<double>(y) - middle + 0.1,
                                        static_cast<double>(x) - middle + 0.2);
        const double third = (angle - 0.2 + 2 * M_PI) / (2 * M_PI / 3);
        volume.set(x, y, z, static_cast<dsc::Label>(static_cast<int>(third) % 3 + 1));
      }
    }
  }
  return volume;
}

int main() {
  const dsc::Index n = 81;
  const dsc::LabelVolume volume = sectors(n);

  // Every interface between two labels once, from the smaller label to the larger; here without the
  // sides on the border of the volume.
  dsc::ExtractOptions options;
  options.border = dsc::Border::open;
  dsc::DigitalSurface surface = dsc::extract_surface(volume, options);
  std::cout << surface.counts().junction_edges << " edges where three labels meet, of " << n
            << " layers\n";

  // Each interface has normals from the voxels of its own two labels.
  const dsc::NormalReport normals = dsc::integral_invariant_normals(surface, volume, {.radius = 6});
  std::cout << normals.third_label_faces << " faces near the junction\n";

  // OpenMesh's halfedges hold no edge with three faces, so the mesh is split there. The vertex ids
  // of the side table are not: functions live on them and run on across the junction.
  std::cout << surface.mesh().n_vertices() << " mesh vertices for " << surface.vertex_count()
            << " vertex ids\n";

  // From a point of one sheet to one of the next: a straight line where both are laid flat.
  const double middle = 0.5 * static_cast<double>(n - 1);
  const auto nearest = [&](double angle, double radius, double z) {
    const dsc::Vec3 p(middle + radius * std::cos(angle), middle + radius * std::sin(angle), z);
    dsc::Index best = 0;
    (surface.positions().matrix().colwise() - p).colwise().squaredNorm().minCoeff(&best);
    return static_cast<dsc::VertexId>(best);
  };
  const dsc::VertexId from = nearest(0.2, 25, 25);
  const dsc::GeodesicResult result = dsc::geodesic_distance(surface.flat(), {&from, 1});
  for (int sheet = 1; sheet <= 2; ++sheet) {
    const dsc::VertexId to = nearest(0.2 + sheet * 2 * M_PI / 3, 20, 50);
    std::cout << "to sheet " << sheet << ": " << result.distance[to] << ", laid flat "
              << std::hypot(25 + 20, 50 - 25) << '\n';
  }
}
