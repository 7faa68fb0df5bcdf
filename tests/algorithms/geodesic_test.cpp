#include "libdsc/algorithms/geodesic.h"

#include "libdsc/base/error.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"
#include "tests/algorithms/meshes.h"
#include "tests/support/memory_left.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <vector>

namespace dsc {
namespace {

using testing::cube_sphere;
using testing::grid;
using testing::join;
using testing::kInfinity;
using testing::Mesh;

struct Errors {
  double mean = 0;
  double max = 0;
};

/// Against the least of `exact(vertex, source)` over the sources. NaN counts as infinite.
template <class Exact>
Errors errors(const GeodesicResult& result, const std::vector<VertexId>& sources, Exact&& exact) {
  Errors e;
  for (Index v = 0; v < result.distance.size(); ++v) {
    double truth = kInfinity;
    for (const VertexId s : sources) truth = std::min(truth, exact(v, s));
    const double error = std::abs(result.distance[v] - truth);
    e.max = error <= e.max ? e.max : error;
    e.mean += error / static_cast<double>(result.distance.size());
  }
  return e;
}

auto straight(const Mesh& mesh) {
  return
      [&mesh](Index v, Index s) { return (mesh.positions.col(v) - mesh.positions.col(s)).norm(); };
}
auto great_circle(const Mesh& mesh) {
  return [&mesh](Index v, Index s) {
    const Vec3 p = mesh.positions.col(v), q = mesh.positions.col(s);
    return std::atan2(p.cross(q).norm(), p.dot(q));
  };
}

GeodesicOptions with(HeatMethod method, HeatBoundary boundary = HeatBoundary::neumann) {
  GeodesicOptions options;
  options.method = method;
  options.boundary = boundary;
  return options;
}

constexpr HeatMethod kMethods[] = {HeatMethod::direct, HeatMethod::bands};

TEST(Geodesic, ConvergesToTheStraightLineOnAFlatGrid) {
  for (const HeatMethod method : kMethods) {
    double previous = 1;
    for (const Index n : {16, 32, 64}) {
      const Mesh mesh = grid(n, n, 2. / static_cast<double>(n));
      const std::vector<VertexId> centre{mesh.nearest({1, 1, 0})};
      const auto e =
          errors(geodesic_distance(mesh.flat(), centre, with(method, HeatBoundary::mixed)), centre,
                 straight(mesh));
      EXPECT_LT(e.mean, 0.8 * previous);
      previous = e.mean;
    }
    EXPECT_LT(previous, 0.02);
  }
}

TEST(Geodesic, ConvergesToGreatCirclesOnTheSphere) {
  double previous = 1;
  for (const Index n : {10, 20, 40}) {
    const Mesh mesh = cube_sphere(n);
    const std::vector<VertexId> source{mesh.nearest({0.3, 0.5, 0.81})};
    const auto e = errors(geodesic_distance(mesh.flat(), source), source, great_circle(mesh));
    EXPECT_LT(e.mean, 0.7 * previous);
    previous = e.mean;
  }
  EXPECT_LT(previous, 0.01);
}

TEST(Geodesic, BandsEqualTheFullSolve) {
  const Mesh sphere = cube_sphere(40);
  const Mesh plane = grid(70, 50);
  for (const Mesh* mesh : {&sphere, &plane}) {
    for (const HeatBoundary boundary : {HeatBoundary::neumann, HeatBoundary::mixed}) {
      for (const std::vector<VertexId>& sources : {std::vector<VertexId>{901}, {17, 901}}) {
        const GeodesicResult direct =
            geodesic_distance(mesh->flat(), sources, with(HeatMethod::direct, boundary));
        const GeodesicResult bands =
            geodesic_distance(mesh->flat(), sources, with(HeatMethod::bands, boundary));
        EXPECT_EQ(direct.report.method, HeatMethod::direct);
        EXPECT_EQ(bands.report.method, HeatMethod::bands);
        EXPECT_LT((direct.distance - bands.distance).cwiseAbs().maxCoeff(),
                  1e-4 * direct.distance.maxCoeff());
      }
    }
  }
}

TEST(Geodesic, IsRightAtAnyDistance) {
  // A strip 3 quads wide: heat falls to e^-2900 on it, where doubles end at e^-745.
  const Mesh strip = grid(3000, 3);
  const std::vector<VertexId> source{1};
  for (const HeatMethod method : kMethods) {
    const GeodesicResult result = geodesic_distance(strip.flat(), source, with(method));
    const auto e = errors(result, source, straight(strip));
    EXPECT_LT(e.max, 2);
    for (Index i = 0; i < 3000; ++i) {
      const double step = result.distance[4 * (i + 1) + 1] - result.distance[4 * i + 1];
      EXPECT_GT(step, 0.3) << i;
      EXPECT_LT(step, 1.7) << i;
    }
    EXPECT_FALSE(result.report.time_raised && method == HeatMethod::bands);
  }
}

TEST(Geodesic, SourcesAreExactlyZeroAndNothingIsNegative) {
  const Mesh mesh = cube_sphere(30);
  std::vector<VertexId> sources;
  for (VertexId s = 3; s < mesh.positions.cols(); s += 709) sources.push_back(s);
  for (const HeatMethod method : kMethods) {
    const GeodesicResult result = geodesic_distance(mesh.flat(), sources, with(method));
    for (const VertexId s : sources) EXPECT_EQ(result.distance[s], 0);
    EXPECT_GE(result.distance.minCoeff(), 0);
    const auto e = errors(result, sources, great_circle(mesh));
    EXPECT_LT(e.mean, 0.02);
    EXPECT_LT(e.max, 0.06);
  }
}

TEST(Geodesic, DuplicatesAndOrderOfSourcesDoNotMatter) {
  const Mesh mesh = cube_sphere(12);
  const std::vector<VertexId> once{5, 200, 77}, twice{77, 5, 200, 5, 77};
  EXPECT_EQ(geodesic_distance(mesh.flat(), once).distance,
            geodesic_distance(mesh.flat(), twice).distance);
}

TEST(Geodesic, EveryVertexASourceGivesZero) {
  const Mesh mesh = cube_sphere(5);
  std::vector<VertexId> all;
  for (VertexId v = 0; v < mesh.positions.cols(); ++v) all.push_back(v);
  for (const HeatMethod method : kMethods) {
    EXPECT_EQ(geodesic_distance(mesh.flat(), all, with(method)).distance.maxCoeff(), 0);
  }
}

TEST(Geodesic, ComponentsWithoutASourceAreInfinitelyFar) {
  const Mesh mesh = join(grid(8, 8), join(grid(5, 6), grid(4, 4)), Vec3(20, 0, 0));
  for (const HeatMethod method : kMethods) {
    const GeodesicResult result =
        geodesic_distance(mesh.flat(), std::vector<VertexId>{3, 90}, with(method));
    EXPECT_EQ(result.report.components, 3);
    EXPECT_EQ(result.report.components_without_source, 1);
    EXPECT_TRUE(result.distance.head(81 + 42).allFinite());
    EXPECT_EQ(result.distance.tail(25).minCoeff(), kInfinity);
    // Each component is as if it were alone.
    const GeodesicResult alone =
        geodesic_distance(grid(8, 8).flat(), std::vector<VertexId>{3}, with(method));
    EXPECT_LT((result.distance.head(81) - alone.distance).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Geodesic, ASourceMayLieOnTheBoundary) {
  const Mesh mesh = grid(40, 40);
  for (const HeatMethod method : kMethods) {
    for (const HeatBoundary boundary : {HeatBoundary::neumann, HeatBoundary::mixed}) {
      for (const VertexId s : {0, 20}) {
        const std::vector<VertexId> source{s};
        const auto e = errors(geodesic_distance(mesh.flat(), source, with(method, boundary)),
                              source, straight(mesh));
        EXPECT_LT(e.mean, 1);
        EXPECT_LT(e.max, 2.5);
      }
    }
  }
}

TEST(Geodesic, MixedBoundaryIsNearerTheTruthThanReflection) {
  const Mesh mesh = grid(40, 40);
  const std::vector<VertexId> source{mesh.nearest({11, 27, 0})};
  for (const HeatMethod method : kMethods) {
    const auto reflected =
        errors(geodesic_distance(mesh.flat(), source, with(method)), source, straight(mesh));
    const auto mixed =
        errors(geodesic_distance(mesh.flat(), source, with(method, HeatBoundary::mixed)), source,
               straight(mesh));
    EXPECT_LT(mixed.mean, reflected.mean);
  }
}

TEST(Geodesic, DistancePassesThroughAPinchedVertex) {
  // Two square sheets that share one vertex only: the far sheet is reached through it, as a source
  // there would reach it.
  const Index n = 20;
  Mesh mesh = join(grid(n, n), grid(n, n), Vec3(n, n, 0));
  const auto first_of_b = static_cast<VertexId>((n + 1) * (n + 1));
  const auto pinch = static_cast<VertexId>(first_of_b - 1);
  for (VertexId& v : mesh.corners) {
    if (v == first_of_b) v = pinch;
  }
  for (const HeatMethod method : kMethods) {
    const std::vector<VertexId> source{static_cast<VertexId>(5 * (n + 1) + 7)}, middle{pinch};
    const GeodesicResult result = geodesic_distance(mesh.flat(), source, with(method));
    const GeodesicResult from_pinch = geodesic_distance(mesh.flat(), middle, with(method));
    for (Index v = first_of_b + 1; v < mesh.positions.cols(); ++v) {
      EXPECT_NEAR(result.distance[v], result.distance[pinch] + from_pinch.distance[v], 1.);
    }
    EXPECT_EQ(result.distance[first_of_b], kInfinity);  // the vertex that no face uses any more
    EXPECT_EQ(from_pinch.distance[pinch], 0);
    // By symmetry both sheets are the same seen from the pinch.
    EXPECT_NEAR(from_pinch.distance[0], from_pinch.distance[mesh.positions.cols() - 1], 1e-6);
  }
}

TEST(Geodesic, OneSolverServesManySourcesAsNewOnesWould) {
  const Mesh mesh = cube_sphere(15);
  for (const HeatMethod method : kMethods) {
    const GeodesicSolver solver(mesh.flat(), with(method));
    for (const VertexId s : {0, 44, 1000}) {
      const std::vector<VertexId> source{s};
      EXPECT_EQ(solver.distance(source).distance,
                geodesic_distance(mesh.flat(), source, with(method)).distance);
    }
  }
}

TEST(Geodesic, TheSameBitsForAnyThreadCount) {
  const Mesh mesh = cube_sphere(60);
  const std::vector<VertexId> sources{4, 9000};
  for (const HeatMethod method : kMethods) {
    const auto one = geodesic_distance(mesh.flat(), sources, with(method), Context{1});
    for (const int threads : {2, 4, 8}) {
      EXPECT_EQ(one.distance,
                geodesic_distance(mesh.flat(), sources, with(method), Context{threads}).distance);
    }
  }
}

TEST(Geodesic, ScalesWithTheUnitOfLength) {
  Mesh mesh = cube_sphere(12);
  const std::vector<VertexId> source{100};
  const Eigen::VectorXd unit = geodesic_distance(mesh.flat(), source).distance;
  mesh.positions *= 0x1p-40;
  const Eigen::VectorXd tiny = geodesic_distance(mesh.flat(), source).distance;
  EXPECT_LT((tiny * 0x1p40 - unit).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Geodesic, BadSourcesAndOptionsAreRefused) {
  const Mesh mesh = grid(3, 3);
  const auto from = [&](std::vector<VertexId> s) { return geodesic_distance(mesh.flat(), s); };
  EXPECT_THROW(from({}), UsageError);
  EXPECT_THROW(from({16}), UsageError);
  EXPECT_THROW(from({2, -1}), UsageError);
  GeodesicOptions options;
  options.time = -1;
  EXPECT_THROW(GeodesicSolver(mesh.flat(), options), UsageError);
  options.time = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(GeodesicSolver(mesh.flat(), options), UsageError);
  EXPECT_THROW(GeodesicSolver(FlatMesh{}), InputError);
}

TEST(Geodesic, TheMethodFollowsTheMemoryThatIsLeft) {
  const BinaryVolume voxels = digitize(Sphere(1.), {0.1, 0.1, 0.1});
  const DigitalSurface surface = extract_surface(voxels);
  const VertexId source = 0;
  Eigen::VectorXd distances[2];
  for (const bool ample : {false, true}) {
    const test::MemoryLeft room(ample ? Index{1} << 40 : Index{1} << 20);
    const GeodesicSolver solver(surface.flat(), {}, {1, nullptr, &room});
    const GeodesicResult result = solver.distance({&source, 1});
    EXPECT_EQ(result.report.method, ample ? HeatMethod::direct : HeatMethod::bands);
    distances[ample ? 1 : 0] = result.distance;
  }
  EXPECT_LE((distances[0] - distances[1]).cwiseAbs().maxCoeff(), 1e-3);
}

}  // namespace
}  // namespace dsc
