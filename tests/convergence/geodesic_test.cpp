// Distances on the digital unit sphere against great circles: normals by integral invariants with
// r = 3 h^(1/2), lambda = 1/4, t = h^2.

#include "libdsc/algorithms/geodesic.h"

#include "libdsc/normals/radius.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstdlib>

namespace dsc {
namespace {

struct Errors {
  double mean = 0;
  double max = 0;
};

VertexId nearest_vertex(Vec3View positions, const Vec3& point) {
  Index nearest = 0;
  for (Index v = 1; v < positions.size; ++v) {
    if ((positions[v] - point).squaredNorm() < (positions[nearest] - point).squaredNorm()) {
      nearest = v;
    }
  }
  return static_cast<VertexId>(nearest);
}

Errors distance_errors(const FlatMesh& mesh, double h) {
  const VertexId source = nearest_vertex(mesh.positions, {0.3, 0.5, 0.81});
  GeodesicOptions options;
  options.calculus.lambda = 0.25;
  options.time = h * h;
  const GeodesicResult result = geodesic_distance(mesh, std::span(&source, 1), options);
  EXPECT_FALSE(result.report.time_raised);
  const Vec3 s = mesh.positions[source];
  Errors errors;
  for (Index v = 0; v < mesh.vertices(); ++v) {
    const Vec3 p = mesh.positions[v];
    const double error = std::abs(result.distance[v] - std::atan2(p.cross(s).norm(), p.dot(s)));
    errors.mean += error / static_cast<double>(mesh.vertices());
    errors.max = error <= errors.max ? errors.max : error;  // NaN stays
  }
  return errors;
}

struct SphereErrors {
  Errors projected, naive;
};

SphereErrors sphere_errors(double h, bool with_naive = true) {
  const BinaryVolume volume = digitize(Sphere(), Vec3::Constant(h));
  DigitalSurface surface = extract_surface(volume);
  IntegralInvariantOptions normals;
  normals.radius = shape_radius(h);
  EXPECT_NEAR(normals.radius, 3 * std::sqrt(h), 1e-12);
  EXPECT_EQ(integral_invariant_normals(surface, volume, normals).fallbacks, 0);
  SphereErrors errors;
  errors.projected = distance_errors(surface.flat(), h);
  if (with_naive) errors.naive = distance_errors(surface.flat(false), h);
  return errors;
}

/// The bounds are those that another implementation reached.
TEST(GeodesicConvergence, DistancesOnTheSphereAreExactToTheBoundsOfThePrototype) {
  struct Case {
    double h, mean, max;
  };
  double previous = 1;
  for (const Case& c : {Case{0.1, 0.018, 0.038}, {0.025, 0.0065, 0.016}, {0.01, 0.0042, 0.0135}}) {
    SCOPED_TRACE("h = " + std::to_string(c.h));
    const SphereErrors errors = sphere_errors(c.h);
    EXPECT_LE(errors.projected.mean, c.mean);
    EXPECT_LE(errors.projected.max, c.max);
    EXPECT_LT(errors.projected.mean, previous);
    previous = errors.projected.mean;
    // The naive calculus does not converge.
    EXPECT_GT(errors.naive.mean, 0.2);
    EXPECT_LT(errors.naive.mean, 0.35);
  }
}

TEST(GeodesicConvergence, MillionsOfVerticesAreNoWorse) {
  if (std::getenv("DSC_LONG_TESTS") == nullptr) {
    GTEST_SKIP() << "set DSC_LONG_TESTS=1 to run it: a minute and some gigabytes";
  }
  const Errors coarse = sphere_errors(0.01, false).projected;
  const Errors fine = sphere_errors(0.0033, false).projected;
  EXPECT_LE(fine.mean, coarse.mean);
  EXPECT_LE(fine.max, coarse.max);
}

}  // namespace
}  // namespace dsc
