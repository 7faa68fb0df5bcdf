// An OpenMesh program that uses the installed headers and the installed library.
#include <libdsc/surface/surface_mesh.h>
#include <libdsc/voxels/binary_volume.h>

#include <iostream>

int main() {
  dsc::Grid grid;
  grid.size = {3, 3, 3};
  dsc::BinaryVolume volume(grid);
  volume.set(1, 1, 1);
  dsc::SurfaceMesh mesh;
  return volume.count() == 1 && mesh.n_faces() == 0 ? 0 : 1;
}
