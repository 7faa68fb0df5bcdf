// λ_f = 0: what the kernel is, and that solvers and spectra leave it out.
#include "libdsc/solve/checkerboard.h"

#include "libdsc/algorithms/geodesic.h"
#include "libdsc/algorithms/poisson.h"
#include "libdsc/base/error.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/solve/spectrum.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "tests/algorithms/meshes.h"
#include "tests/solve/grid_systems.h"
#include "tests/support/random_volume.h"
#include "tests/support/spheres.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace dsc {
namespace {

using testing::box_volume;
using testing::Mesh;
using testing::random_volume;
using testing::scrambled;

CalculusOptions mercat() {
  CalculusOptions options;
  options.stabilization = Stabilization::mercat;
  return options;
}

template <class Options>
Options with_mercat() {
  Options options;
  options.calculus = mercat();
  return options;
}

/// Each face's own normal, tilted at random by up to about 40 degrees.
void tilt_normals(DigitalSurface& surface) {
  const Eigen::VectorXd noise = scrambled(3 * surface.face_count(), 11);
  Eigen::Matrix3Xd u(3, surface.face_count());
  for (Index f = 0; f < u.cols(); ++f) {
    u.col(f) =
        surface.surfels()[static_cast<std::size_t>(f)].normal() + 0.4 * noise.segment(3 * f, 3);
  }
  u.colwise().normalize();
  surface.set_normals(u);
}

/// Pinched at pointels and at linels, in several components, on stretched voxels.
DigitalSurface pinched_surface(unsigned seed) {
  DigitalSurface surface = extract_surface(random_volume({5, 5, 5}, 0.25, seed, {1, 0.8, 1.3}));
  tilt_normals(surface);
  return surface;
}

/// Two cubes of 2 x 2 x 2 voxels that share one pointel.
DigitalSurface two_cubes() {
  BinaryVolume volume = box_volume({6, 6, 6}, {1, 1, 1}, {3, 3, 3});
  for (Index z = 3; z < 5; ++z) {
    for (Index y = 3; y < 5; ++y) {
      for (Index x = 3; x < 5; ++x) volume.set(x, y, z);
    }
  }
  DigitalSurface surface = extract_surface(volume);
  tilt_normals(surface);
  return surface;
}

/// (-1)^(i+j+k) of the pointels.
Eigen::VectorXd checkerboard(const DigitalSurface& surface) {
  const Grid& grid = surface.grid();
  Eigen::VectorXd result(surface.vertex_count());
  for (VertexId v = 0; v < result.size(); ++v) {
    const Vec3 cell = (surface.position(v) - grid.origin).cwiseQuotient(grid.spacing);
    result[v] = std::lround(cell.sum() + 1.5) % 2 == 0 ? 1 : -1;
  }
  return result;
}

Index kernel_dimension(const SparseMatrix& L) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> dense{Eigen::MatrixXd(-L)};
  return (dense.eigenvalues().array() < 1e-10 * dense.eigenvalues().maxCoeff()).count();
}

Index kernel_dimension(const FlatMesh& mesh) {
  return kernel_dimension(assemble_laplacian(mesh, mercat()).L);
}

TEST(Checkerboard, IsInTheKernelOnPinchedSurfaces) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const DigitalSurface surface = pinched_surface(seed);
    const SparseMatrix L = assemble_laplacian(surface.flat(), mercat()).L;
    EXPECT_LT((L * checkerboard(surface)).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_GT((assemble_laplacian(surface.flat()).L * checkerboard(surface)).norm(), 1);
  }
}

TEST(Checkerboard, ClassesCountTheKernelOfTheLaplacian) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    const DigitalSurface surface = pinched_surface(seed);
    ASSERT_GT(surface.counts().pinched_vertices, 0);
    for (const bool projected : {true, false}) {
      const FlatMesh mesh = surface.flat(projected);
      EXPECT_EQ(kernel_classes(mesh, Stabilization::mercat).count(), kernel_dimension(mesh));
      EXPECT_EQ(kernel_classes(mesh, Stabilization::de_goes).count(),
                kernel_dimension(assemble_laplacian(mesh).L));
    }
  }
  const DigitalSurface cubes = two_cubes();  // they share one parity only
  EXPECT_EQ(connected_components(cubes.flat()).count(), 1);
  EXPECT_EQ(kernel_classes(cubes.flat(), Stabilization::mercat).count(), 3);
}

TEST(Checkerboard, ThereIsNoneWithoutTwoColours) {
  Mesh ring;  // three quads around a triangle
  ring.positions.resize(3, 6);
  ring.positions << 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 1, 1;
  ring.corners = {0, 1, 4, 3, 1, 2, 5, 4, 2, 0, 3, 5};
  EXPECT_EQ(kernel_classes(ring.flat(), Stabilization::mercat).count(), 1);
  EXPECT_EQ(kernel_dimension(ring.flat()), 1);
  Mesh triangles = ring;
  triangles.corners = {0, 1, 4, 0, 4, 3, 2, 5, 4};
  triangles.offsets = {0, 3, 6, 9};
  EXPECT_EQ(kernel_classes(triangles.flat(), Stabilization::mercat).count(), 1);
  EXPECT_EQ(kernel_dimension(triangles.flat()), 1);
  triangles.corners = {0, 1, 2, 4, 3};
  triangles.offsets = {0, 5};
  EXPECT_THROW(kernel_classes(triangles.flat(), Stabilization::mercat), UsageError);
}

TEST(Checkerboard, FormIsBetweenNothingAndTheMass) {
  const DigitalSurface surface = pinched_surface(5);
  const SparseMatrix S = checkerboard_form(surface.flat());
  const Eigen::VectorXd mass = assemble_laplacian(surface.flat()).mass;
  const Eigen::VectorXd chi = checkerboard(surface);
  EXPECT_NEAR(chi.dot(S * chi), mass.sum(), 1e-12 * mass.sum());
  const Eigen::VectorXd x = surface.positions().matrix().row(0).transpose();
  EXPECT_LT((S * x).norm(), 1e-13);  // linear functions have none
  const Eigen::VectorXd any = scrambled(chi.size(), 2);
  EXPECT_GT(any.dot(S * any), 0);
  EXPECT_LT(any.dot(S * any), any.dot(mass.cwiseProduct(any)));
}

TEST(Checkerboard, PoissonRecoversLinearFunctionsOnPinchedSurfaces) {
  for (DigitalSurface surface : {pinched_surface(6), pinched_surface(7), two_cubes()}) {
    const FlatMesh mesh = surface.flat();
    const PoissonProblem problem(mesh, {}, with_mercat<PoissonOptions>());
    const Eigen::VectorXd truth =
        (mesh.positions.matrix().row(0) - 2 * mesh.positions.matrix().row(2)).transpose();
    const Eigen::VectorXd found = problem.solve(assemble_laplacian(mesh, mercat()).L * truth).x;
    const Components components = connected_components(mesh);
    const Eigen::VectorXd mean = component_means(components, problem.mass(), truth);
    for (Index v = 0; v < truth.size(); ++v) {
      const VertexId c = components.of_vertex[static_cast<std::size_t>(v)];
      EXPECT_NEAR(found[v], truth[v] - mean[c], 1e-9) << v;
    }
  }
}

TEST(Checkerboard, PoissonRecoversWhatIsOrthogonalToTheKernel) {
  const DigitalSurface surface = testing::sphere(0.2);
  const PoissonProblem problem(surface.flat(), {}, with_mercat<PoissonOptions>());
  Eigen::VectorXd truth = scrambled(surface.vertex_count(), 3);
  const Eigen::VectorXd& mass = problem.mass();
  // Constants and the checkerboard are not orthogonal to each other: the two parities are.
  const Components parities = kernel_classes(surface.flat(), Stabilization::mercat);
  ASSERT_EQ(parities.count(), 2);
  const Eigen::VectorXd mean = component_means(parities, mass, truth);
  for (Index v = 0; v < truth.size(); ++v) {
    truth[v] -= mean[parities.of_vertex[static_cast<std::size_t>(v)]];
  }
  EXPECT_NEAR(mass.dot(truth), 0, 1e-10);
  EXPECT_NEAR(mass.cwiseProduct(checkerboard(surface)).dot(truth), 0, 1e-10);
  const Eigen::VectorXd b = assemble_laplacian(surface.flat(), mercat()).L * truth;
  EXPECT_LT((problem.solve(b).x - truth).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Checkerboard, IsSolvedForDirectlyWhateverTheMethod) {
  // Multigrid's coarse functions do not span the kernel.
  const DigitalSurface surface = testing::sphere(0.1);
  auto options = with_mercat<PoissonOptions>();
  options.solver.method = SolverMethod::multigrid;
  const Eigen::VectorXd x = surface.positions().matrix().row(0).transpose();
  const Eigen::VectorXd b = assemble_laplacian(surface.flat(), mercat()).L * x;
  EXPECT_LE(solve_poisson(surface.flat(), b, {}, {}, options).iterations, 1);
}

TEST(Checkerboard, ARightHandSideWithOneIsRefused) {
  const DigitalSurface surface = testing::sphere(0.2);
  Eigen::VectorXd b = checkerboard(surface);
  b.array() -= b.mean();
  solve_poisson(surface.flat(), b);  // sums to zero: fine with a stabilisation
  try {
    solve_poisson(surface.flat(), b, {}, {}, with_mercat<PoissonOptions>());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("parity"), std::string::npos) << error.what();
  }
}

TEST(Checkerboard, EachParityNeedsAFixedVertex) {
  const Mesh mesh = testing::grid(6, 5);
  const Eigen::VectorXd linear = (mesh.positions.row(0) - 3 * mesh.positions.row(1)).transpose();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(linear.size());
  const auto options = with_mercat<PoissonOptions>();
  const std::vector<VertexId> one{0, 2, 14};  // of one parity: rows have six vertices
  try {
    PoissonProblem(mesh.flat(), one, options);
    FAIL();
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("parity"), std::string::npos) << error.what();
  }
  std::vector<VertexId> rim;
  for (VertexId v = 0; v < linear.size(); ++v) {
    if (v / 6 == 0 || v / 6 == 6 || v % 6 == 0 || v % 6 == 5) rim.push_back(v);
  }
  const Solution s = solve_poisson(mesh.flat(), zero, rim, linear, options);
  EXPECT_LT((s.x - linear).cwiseAbs().maxCoeff(), 1e-12);
}

/// Mean error against the great circles.
double distance_error(const DigitalSurface& surface, const GeodesicOptions& options) {
  const VertexId source = 17;
  const Vec3 p = surface.position(source);
  const Eigen::VectorXd d = geodesic_distance(surface.flat(), {&source, 1}, options).distance;
  double sum = 0;
  for (VertexId v = 0; v < d.size(); ++v) {
    const Vec3 q = surface.position(v);
    sum += std::abs(d[v] - std::atan2(p.cross(q).norm(), p.dot(q)));
  }
  return sum / static_cast<double>(d.size());
}

TEST(Checkerboard, DistancesConvergeWithoutIt) {
  double last = 1;
  for (const double h : {0.2, 0.1, 0.05}) {
    const DigitalSurface surface = testing::sphere(h);
    auto options = with_mercat<GeodesicOptions>();
    const double error = distance_error(surface, options);
    EXPECT_LT(error, 0.8 * last) << h;
    last = error;
    for (const HeatMethod method : {HeatMethod::direct, HeatMethod::bands}) {
      options.method = method;
      EXPECT_NEAR(distance_error(surface, options), error, 0.01 * h);
    }
  }
  EXPECT_LT(last, distance_error(testing::sphere(0.05), {}));
}

TEST(Checkerboard, DistancesCrossASharedPointel) {
  const DigitalSurface surface = two_cubes();
  const VertexId source = 0;
  const auto distance = [&](const GeodesicOptions& options) {
    return geodesic_distance(surface.flat(false), {&source, 1}, options).distance;
  };
  const Eigen::VectorXd with = distance({}), without = distance(with_mercat<GeodesicOptions>());
  EXPECT_GT(with.maxCoeff(), 6);                         // the far corner of the second cube
  EXPECT_LT((with - without).cwiseAbs().maxCoeff(), 1);  // a voxel
}

TEST(Checkerboard, TheSpectrumOfTheSphereIsThatOfTheHarmonics) {
  const DigitalSurface surface = testing::sphere(0.05);
  const LaplaceSystem system = assemble_laplacian(surface.flat(), mercat());
  const Spectrum s = lowest_smooth_spectrum(-system.L, system.mass,
                                            checkerboard_form(surface.flat()), {.count = 9});
  EXPECT_GT(s.checkerboards, 0);
  const double exact[] = {0, 2, 2, 2, 6, 6, 6, 6, 6};
  for (Index k = 0; k < 9; ++k) EXPECT_NEAR(s.values[k], exact[k], 0.01) << k;
  const Eigen::MatrixXd gram = s.vectors.transpose() * system.mass.asDiagonal() * s.vectors;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(9, 9)).norm(), 1e-9);
  const Eigen::MatrixXd rest =
      system.L * s.vectors + system.mass.asDiagonal() * s.vectors * s.values.asDiagonal();
  EXPECT_LT(rest.norm(), 1e-6);
  // What was left out are eigenvalues too: with them the same number of values ends sooner.
  EXPECT_LT(lowest_spectrum(-system.L, system.mass, {.count = 9}).values[8], s.values[8] - 1);
}

TEST(Checkerboard, ParitiesWithSpectraOfTheirOwnAreRefused) {
  // On flat faces across the axes nothing couples them, and a side of 8 has no symmetry that swaps
  // them.
  const DigitalSurface surface = extract_surface(box_volume({10, 10, 10}, {1, 1, 1}, {9, 9, 9}));
  const LaplaceSystem system = assemble_laplacian(surface.flat(), mercat());
  EXPECT_THROW(lowest_smooth_spectrum(-system.L, system.mass, checkerboard_form(surface.flat()),
                                      {.count = 6}),
               SolverError);
}

}  // namespace
}  // namespace dsc
