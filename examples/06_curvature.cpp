// The curvature of a scan: how its surface bends at every face, what that sums to, and a smooth
// mesh of it.
//
//     example_06_curvature [FILE.vol]      without a file, a torus is written
#include "libdsc/algorithms/regularise.h"
#include "libdsc/io/read_binary.h"
#include "libdsc/io/results.h"
#include "libdsc/io/volume_writer.h"
#include "libdsc/normals/curvature.h"
#include "libdsc/normals/radius.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"

#include <cmath>
#include <iostream>

int main(int argc, char** argv) {
  std::string path = "torus.vol";
  if (argc > 1) {
    path = argv[1];
  } else {
    dsc::write_volume(path, dsc::digitize(dsc::Torus(50., 20.), {1, 1, 1}));
  }
  const dsc::BinaryVolume voxels = dsc::read_binary(path);
  dsc::DigitalSurface surface = dsc::extract_surface(voxels);

  // In a ball around each face, the voxels inside tell the normal, how the surface bends and along
  // which directions. A larger ball sees less of the voxels and less of fine detail: here 8 of
  // them.
  dsc::CurvatureOptions options;
  options.radius = dsc::data_radius(voxels.grid().spacing, dsc::kCurvatureRadiusVoxels);
  const dsc::CurvatureField bend =
      dsc::integral_invariant_curvatures(voxels, surface.surfels(), options);
  std::cout << "the larger principal curvature is " << bend.kappa_2.mean()
            << " on average (of the tube of radius 20: 0.05)\n"
            << "the Gaussian curvature runs from " << bend.gaussian.minCoeff() << " to "
            << bend.gaussian.maxCoeff() << " (of the torus: from " << -1. / (20 * 30) << " to "
            << 1. / (20 * 70) << ")\n";

  // Its integral is 2 pi times the Euler number, whatever the shape (Gauss and Bonnet). The area of
  // a face is that of its square, seen along the normal.
  surface.set_normals(bend.normals);
  double total = 0, size = 0;
  for (dsc::Index f = 0; f < surface.face_count(); ++f) {
    const dsc::Vec3 own = surface.surfels()[static_cast<std::size_t>(f)].normal();
    const double area = std::abs(own.dot(surface.normals()[f]));
    total += bend.gaussian[f] * area;
    size += std::abs(bend.gaussian[f]) * area;
  }
  std::cout << "its integral is " << total / (2 * M_PI) << " times 2 pi, the Euler number "
            << surface.counts().euler << "; without signs " << size / (2 * M_PI) << '\n';

  dsc::write_result("curvature.vtp",
                    {surface.flat(),
                     {dsc::scalar_field("mean_curvature", dsc::FieldOn::face, bend.mean),
                      dsc::scalar_field("gaussian_curvature", dsc::FieldOn::face, bend.gaussian),
                      dsc::vector_field("direction_1", {"k1x", "k1y", "k1z"}, dsc::FieldOn::face,
                                        {bend.direction_1.data(), bend.direction_1.cols()})}});

  // The same faces on smooth positions, for programs that want a mesh without steps.
  const dsc::RegularisedPositions smooth = dsc::regularise_positions(surface.flat());
  dsc::FlatMesh mesh = surface.flat(false);
  mesh.positions = {smooth.positions.data(), smooth.positions.cols()};
  dsc::write_result("smooth.ply", {mesh, {}});
  std::cout << "the vertices moved by " << smooth.mean_displacement << " voxels on average\n";
}
