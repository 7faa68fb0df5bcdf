// An OpenMesh program that uses the installed headers and the installed library: the surface of one
// voxel, seen as a mesh.
#ifdef WITH_CHOLMOD
#include <libdsc/solve/cholmod_solver.h>
#endif
#ifdef WITH_PICTURES
#include <libdsc/render/picture.h>
#endif
#include <libdsc/surface/digital_surface.h>
#include <libdsc/surface/extract.h>
#ifdef WITH_TRUTH
#include <libdsc/truth/smooth_mesh.h>
#include <libdsc/voxels/shapes.h>
#endif

#include <iostream>

int main() {
  dsc::Grid grid;
  grid.size = {3, 3, 3};
  grid.spacing = {1., 2., 3.};
  dsc::BinaryVolume volume(grid);
  volume.set(1, 1, 1);
  const dsc::DigitalSurface surface = dsc::extract_surface(volume);
  const dsc::SurfaceMesh& mesh = surface.mesh();

  double area = 0;
  for (const auto face : mesh.faces()) {
    for (const auto halfedge : face.halfedges()) {
      // The corners of a rectangle span four times its area together.
      area +=
          0.25 * (mesh.calc_edge_vector(halfedge) % mesh.calc_edge_vector(halfedge.next())).norm();
    }
  }
  std::cout << mesh.n_vertices() << " vertices, " << mesh.n_edges() << " edges, " << mesh.n_faces()
            << " faces, area " << area << '\n';
  const bool right = mesh.n_vertices() == 8 && mesh.n_edges() == 12 && mesh.n_faces() == 6 &&
                     area == 2 * (1 * 2 + 2 * 3 + 3 * 1);
#ifdef WITH_CHOLMOD
  dsc::SparseMatrix A(2, 2);
  A.insert(0, 0) = A.insert(1, 1) = 4.;
  const Eigen::VectorXd x = dsc::make_cholmod_solver(A)->solve(Eigen::Vector2d(4., 8.)).x;
  if (x != Eigen::Vector2d(1., 2.)) return 1;
#endif
#ifdef WITH_TRUTH
  if (dsc::truth::smooth_mesh(dsc::Torus(), {0.2}).counts.euler != 0) return 1;
#endif
#ifdef WITH_PICTURES
  dsc::render::PictureOptions options;
  options.width = options.height = 64;
  const dsc::render::Image image = dsc::render::draw(surface.flat(), options).image;
  if (image.at(32, 32) == image.at(0, 0)) return 1;
#endif
  return right ? 0 : 1;
}
