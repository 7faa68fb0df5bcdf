// Distances along the surface of a voxel file: from one point, from several, and how they are
// written for ParaView.
//
//     example_02_distances [FILE.vol]      without a file, a ball of radius 20 voxels is written
#include "libdsc/algorithms/geodesic.h"
#include "libdsc/io/read_binary.h"
#include "libdsc/io/results.h"
#include "libdsc/io/volume_writer.h"
#include "libdsc/normals/radius.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"

#include <iostream>

int main(int argc, char** argv) {
  std::string path = "ball.vol";
  if (argc > 1) {
    path = argv[1];
  } else {
    dsc::write_volume(path, dsc::digitize(dsc::Sphere(20.), {1, 1, 1}));
  }

  // Every voxel that is not 0 is inside. A world unit is the edge of a voxel, unless the file says
  // otherwise.
  const dsc::BinaryVolume voxels = dsc::read_binary(path);
  dsc::DigitalSurface surface = dsc::extract_surface(voxels);

  // The squares of the surface are bent towards the normals of the object before anything is
  // measured on them; otherwise distances stay a quarter too long, however fine the voxels.
  const double radius = dsc::data_radius(voxels.grid().spacing);
  dsc::integral_invariant_normals(surface, voxels, {.radius = radius});

  // The solver is built once for a surface. Its factorization serves any number of sources.
  const dsc::GeodesicSolver solver(surface.flat());
  const dsc::VertexId one = 0;
  const dsc::GeodesicResult from_one = solver.distance({&one, 1});
  dsc::Index farthest = 0;
  const double largest = from_one.distance.maxCoeff(&farthest);
  std::cout << "the farthest vertex is at " << largest
            << " voxels (half a great circle of the ball: " << 20 * M_PI << ")\n";

  // From several sources: the distance to the nearest of them.
  const dsc::VertexId both[] = {one, static_cast<dsc::VertexId>(farthest)};
  const dsc::GeodesicResult from_both = solver.distance(both);
  std::cout << "with a second source there, every vertex is within "
            << from_both.distance.maxCoeff() << '\n';

  dsc::write_result(
      "distances.vtp",
      {surface.flat(),
       {dsc::scalar_field("distance", dsc::FieldOn::vertex, from_one.distance),
        dsc::scalar_field("to_the_nearest", dsc::FieldOn::vertex, from_both.distance)}});
}
