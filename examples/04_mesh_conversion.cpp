// Mesh files: a surface of voxels to every form, from one form to another with its fields, and the
// calculus on what was read.
#include "libdsc/io/mesh_reader.h"
#include "libdsc/normals/radius.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"

#include <iostream>

int main() {
  const double h = 0.05;  // the edge of a voxel
  const dsc::BinaryVolume voxels = dsc::digitize(dsc::Sphere(1.), {h, h, h});
  dsc::DigitalSurface surface = dsc::extract_surface(voxels);
  dsc::integral_invariant_normals(surface, voxels, {.radius = dsc::shape_radius(h)});

  // The mesh with a field per face, its normals, and one per vertex.
  const Eigen::VectorXd height = surface.positions().matrix().row(2);
  const dsc::Result result{
      surface.flat(),
      {dsc::vector_field("normal", {"nx", "ny", "nz"}, dsc::FieldOn::face, surface.normals()),
       dsc::scalar_field("height", dsc::FieldOn::vertex, height)}};
  for (const char* path : {"sphere.off", "sphere.obj", "sphere.ply", "sphere.stl", "sphere.om"}) {
    const auto left_out = dsc::write_result(path, result);
    std::cout << path << ": " << left_out.size() << " fields left out\n";
  }

  // From form to form nothing is lost where the forms hold fields.
  dsc::write_result("again.om", dsc::read_mesh("sphere.ply").result());
  const dsc::PolygonMesh again = dsc::read_mesh("again.om");
  const bool whole = again.positions == surface.positions().matrix() &&
                     again.normals == surface.normals().matrix() && again.fields.size() == 1;
  std::cout << (whole ? "nothing" : "something") << " was lost on the way\n";

  // With normals the calculus is the projected one, whose area is that of the smooth sphere.
  const dsc::MeshCalculus calculus(again);
  std::cout << "area " << calculus.mass0().diagonal().sum() << ", of the sphere 12.5664\n";
}
