// The calculus in a program that has a mesh of its own, with traits of its own: nothing has to be
// converted, and results go where the program keeps them.
#include "libdsc/calculus/on_mesh.h"
#include "libdsc/solve/spd_solver.h"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <cmath>
#include <iostream>

// Any traits will do: here doubles, and a temperature at every vertex.
struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexTraits {
   public:
    double temperature = 0;
  };
};
using Mesh = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

// A torus of quads, which are not planar: the calculus takes polygons of any number of corners,
// planar or not.
Mesh torus(double R, double r, int n, int m) {
  Mesh mesh;
  std::vector<Mesh::VertexHandle> v;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const double a = 2 * M_PI * i / n, b = 2 * M_PI * (j + 0.3 * i) / m;  // a little sheared
      const double d = R + r * std::cos(b);
      v.push_back(mesh.add_vertex({d * std::cos(a), d * std::sin(a), r * std::sin(b)}));
    }
  }
  const auto at = [&](int i, int j) {
    // One turn around shears by 0.3 n corners, a whole number.
    const int k = i == n ? j + 3 * n / 10 : j;
    return v[static_cast<std::size_t>((i % n) * m + k % m)];
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      mesh.add_face({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

int main() {
  Mesh mesh = torus(1., 0.4, 100, 40);

  // Positions and corners are gathered once; every operator is a sparse matrix.
  const dsc::MeshCalculus calculus = dsc::calculus_on_mesh(mesh);
  const dsc::LaplaceSystem system = calculus.laplace_system();
  std::cout << "area " << system.mass.sum() << ", of the torus " << 4 * M_PI * M_PI * 0.4 << '\n';

  // Heat: one implicit step from a hot vertex, (M0 - t L) u = M0 u0. Its sum is kept.
  const double t = 0.05;
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(system.mass.size());
  heat[0] = 1.;
  const dsc::SparseMatrix A = calculus.mass0() - t * system.L;
  const dsc::Solution spread = dsc::make_spd_solver(A)->solve(heat);
  for (const auto v : mesh.vertices()) mesh.data(v).temperature = spread.x[v.idx()];
  double kept = 0;
  for (const auto v : mesh.vertices()) kept += mesh.data(v).temperature * system.mass[v.idx()];
  std::cout << "heat kept " << kept << '\n';

  // The gradient of a function, a vector a face: of the height, at most 1.
  Eigen::VectorXd height(system.mass.size());
  for (const auto v : mesh.vertices()) height[v.idx()] = mesh.point(v)[2];
  std::cout << "steepest slope " << calculus.gradients(height).colwise().norm().maxCoeff() << '\n';
}
