#include "libdsc/normals/curvature.h"

#include "libdsc/base/error.h"
#include "libdsc/normals/radius.h"
#include "libdsc/voxels/closest_point.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/implicit_curvature.h"
#include "libdsc/voxels/shapes.h"
#include "tests/normals/normals_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dsc {
namespace {

/// The slope of the line through (log x, log y).
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = std::log(x[i]), b = std::log(y[i]);
    n += 1, sx += a, sy += b, sxx += a * a, sxy += a * b;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

CurvatureField of_sphere(double h, double r, CurvatureForm form = CurvatureForm::centred) {
  const BinaryVolume volume = test::digital_sphere(1, h);
  return integral_invariant_curvatures(volume, test::all_surfels(volume), {r, form});
}

double mean_error(const Eigen::VectorXd& values, double truth) {
  return (values.array() - truth).abs().mean();
}

/// The centred form on the smooth unit sphere is 1 - r^2/4, from the exact volume and moments of
/// the lens; the lattice must add little to that.
TEST(Curvature, OfTheSphereHasTheErrorOfItsFormulaAlone) {
  std::vector<double> gridsteps, errors;
  for (const double h : {0.1, 0.07, 0.05, 0.035, 0.025, 0.0175}) {
    const double r = shape_radius(h);
    const CurvatureField field = of_sphere(h, r);
    EXPECT_EQ(field.fallbacks, 0);
    EXPECT_EQ(field.radius, r);
    EXPECT_NEAR(field.mean.mean(), 1 - 0.25 * r * r, 0.12 * 0.25 * r * r) << h;
    for (const Eigen::VectorXd* k : {&field.mean, &field.kappa_1, &field.kappa_2}) {
      EXPECT_LT(mean_error(*k, 1), 0.35 * r * r) << h;
    }
    EXPECT_LT(mean_error(field.gaussian, 1), 0.6 * r * r) << h;
    EXPECT_LT((field.mean.array() - 1).abs().maxCoeff(), 8. * h) << h;
    gridsteps.push_back(h);
    errors.push_back(mean_error(field.mean, 1));
  }
  EXPECT_GT(exponent(gridsteps, errors), 0.85);
}

/// At a given radius in voxels every ball is the same set of points, whose error would not average
/// out over the surface.
TEST(Curvature, HasNoBiasOfTheDigitalBall) {
  const double rho = 40.3;
  const BinaryVolume volume = test::digital_sphere(rho, 1);
  const std::vector<Surfel> surfels = test::all_surfels(volume);
  for (const double r : {5., 6., 7., 8., 8.3, 9., 10., 12.}) {
    const CurvatureField field = integral_invariant_curvatures(volume, surfels, {r});
    EXPECT_NEAR(rho * field.mean.mean(), 1 - 0.25 * r * r / (rho * rho), 0.03) << r;
    const CurvatureField plain =
        integral_invariant_curvatures(volume, surfels, {r, CurvatureForm::plain});
    EXPECT_NEAR(rho * plain.mean.mean(), 1, 0.03) << r;
  }
}

/// On the smooth sphere the plain H is 1 for every r; on the lattice a centre at distance d outside
/// adds 4 d / r^2, and d spreads over about +- h/2.
TEST(Curvature, OfTheSphereInThePlainFormIsUnbiasedAndScatters) {
  for (const double h : {0.1, 0.05, 0.025}) {
    const double r = shape_radius(h);
    const CurvatureField field = of_sphere(h, r, CurvatureForm::plain);
    EXPECT_NEAR(field.mean.mean(), 1, 0.02) << h;
    // The lens' moments give 1 - r^2/16 for the principal ones; their difference is that of the
    // centred form.
    EXPECT_NEAR(0.5 * (field.kappa_1 + field.kappa_2).mean(), 1 - r * r / 16, 0.02) << h;
    const CurvatureField centred = of_sphere(h, r);
    EXPECT_LT((field.kappa_2 - field.kappa_1 - centred.kappa_2 + centred.kappa_1).norm(), 1e-9);
    EXPECT_LT(mean_error(field.mean, 1), h / (r * r)) << h;
    EXPECT_GT(mean_error(field.mean, 1), 0.3 * h / (r * r)) << h;
  }
  // r ~ h^(1/3) makes it converge.
  const auto error = [](double h) {
    return mean_error(of_sphere(h, 2 * std::cbrt(h), CurvatureForm::plain).mean, 1);
  };
  EXPECT_LT(error(0.025), 0.75 * error(0.1));
}

/// Between a point of the lattice and the plane through the centre lie at most as many points as
/// the disc's border meets, so the error of a digital plane stays far below that of one layer of
/// voxels (an offset of d = 1: 4/R^2). The centred form cancels the offset itself.
TEST(Curvature, OfTiltedPlanesIsFarBelowThatOfOneLayerOfVoxels) {
  for (const Vec3& slope : {Vec3(1, 2, 3), Vec3(5, 1, 0.3), Vec3(1, 1, 1), Vec3(-3, 7, 2)}) {
    const double R = 10;
    const Plane plane(slope, 0.3, 60);
    const BinaryVolume volume = digitize(plane, Vec3(1, 1, 1));
    std::vector<Surfel> surfels;
    for (const Surfel& s : test::all_surfels(volume)) {
      if (s.centre(volume.grid()).cwiseAbs().maxCoeff() < 15) surfels.push_back(s);
    }
    ASSERT_GT(surfels.size(), 900u);
    const CurvatureField field = integral_invariant_curvatures(volume, surfels, {R});
    EXPECT_EQ(field.fallbacks, 0);
    EXPECT_LT(field.mean.cwiseAbs().maxCoeff(), 0.25 * 4 / (R * R));
    EXPECT_LT(field.kappa_1.cwiseAbs().maxCoeff(), 0.5 * 4 / (R * R));
    EXPECT_LT(field.kappa_2.cwiseAbs().maxCoeff(), 0.5 * 4 / (R * R));
    const CurvatureField plain =
        integral_invariant_curvatures(volume, surfels, {R, CurvatureForm::plain});
    EXPECT_LT(plain.mean.cwiseAbs().maxCoeff(), 0.6 * 4 / (R * R));
  }
}

TEST(Curvature, OfAxisAlignedPlanesIsExactlyZeroWhateverTheRadiusAndTheSpacing) {
  for (const Vec3& spacing : {Vec3(1, 1, 1), Vec3(1, 2, 0.7)}) {
    for (int axis = 0; axis < 3; ++axis) {
      Grid grid{{33, 34, 35}};
      grid.spacing = spacing;
      const BinaryVolume volume =
          test::fill(grid, [&](const Vec3& p) { return p[axis] / spacing[axis] < 16.5; });
      Surfel surfel{16, 16, 16, 2 * axis + 1};
      for (const double r : {4., 5.3, 7.}) {
        for (const CurvatureForm form : {CurvatureForm::centred, CurvatureForm::plain}) {
          const CurvatureField field =
              integral_invariant_curvatures(volume, {&surfel, 1}, {r, form});
          EXPECT_NEAR(field.mean[0], 0, 1e-13);
          EXPECT_NEAR(field.kappa_1[0], 0, 1e-13);
          EXPECT_NEAR(field.kappa_2[0], 0, 1e-13);
          EXPECT_EQ(field.normals.col(0), surfel.normal());
        }
      }
    }
  }
}

struct TorusErrors {
  double kappa_1 = 0, kappa_2 = 0, mean = 0, gaussian = 0;  ///< root mean squares
  double degrees = 0;                                       ///< mean angle of direction 2
};

TorusErrors torus_errors(double h, double r, const Vec3& stretch = Vec3::Ones()) {
  const Torus torus(1, 0.5);
  const BinaryVolume volume = digitize(torus, h * stretch);
  const std::vector<Surfel> surfels = test::all_surfels(volume);
  const CurvatureField field = integral_invariant_curvatures(volume, surfels, {r});
  EXPECT_EQ(field.fallbacks, 0);
  TorusErrors sum;
  const auto n = static_cast<double>(surfels.size());
  for (std::size_t s = 0; s < surfels.size(); ++s) {
    const auto i = static_cast<Index>(s);
    const ClosestPoint q = closest_point(torus, surfels[s].centre(volume.grid()));
    const ImplicitCurvature truth = implicit_curvature(torus, q.point).value();
    EXPECT_LE(field.kappa_1[i], field.kappa_2[i]);
    EXPECT_NEAR(field.mean[i], 0.5 * (field.kappa_1[i] + field.kappa_2[i]), 1e-9);
    EXPECT_NEAR(field.gaussian[i], field.kappa_1[i] * field.kappa_2[i], 1e-9);
    EXPECT_NEAR(field.direction_1.col(i).dot(field.direction_2.col(i)), 0, 1e-12);
    EXPECT_NEAR(field.direction_1.col(i).dot(field.normals.col(i)), 0, 1e-12);
    sum.kappa_1 += std::pow(field.kappa_1[i] - truth.kappa_1, 2) / n;
    sum.kappa_2 += std::pow(field.kappa_2[i] - truth.kappa_2, 2) / n;
    sum.mean += std::pow(field.mean[i] - truth.mean, 2) / n;
    sum.gaussian += std::pow(field.gaussian[i] - truth.gaussian, 2) / n;
    const double cosine = std::abs(field.direction_2.col(i).dot(truth.direction_2));
    sum.degrees += std::acos(std::min(1., cosine)) * 180 / std::numbers::pi / n;
  }
  for (double* square : {&sum.kappa_1, &sum.kappa_2, &sum.mean, &sum.gaussian}) {
    *square = std::sqrt(*square);
  }
  return sum;
}

/// The tube's curvature is 2: of a ball of radius r = 2 h^(1/2) the bias is about r^2 times the
/// curvature's cube over 4 per direction, the noise smaller.
TEST(Curvature, PrincipalOnesAndTheirDirectionsConvergeOnATorus) {
  std::vector<double> gridsteps, kappa_1, kappa_2, gaussian, degrees;
  for (const double h : {0.05, 0.035, 0.025, 0.0175}) {
    const TorusErrors e = torus_errors(h, 2 * std::sqrt(h));
    EXPECT_LT(e.kappa_2, 0.2 * 8 * 4 * h + 0.01) << h;
    EXPECT_LT(e.degrees, 60 * h) << h;
    gridsteps.push_back(h);
    kappa_1.push_back(e.kappa_1);
    kappa_2.push_back(e.kappa_2);
    gaussian.push_back(e.gaussian);
    degrees.push_back(e.degrees);
  }
  EXPECT_GT(exponent(gridsteps, kappa_1), 0.8);
  EXPECT_GT(exponent(gridsteps, kappa_2), 0.8);
  EXPECT_GT(exponent(gridsteps, gaussian), 0.8);
  EXPECT_GT(exponent(gridsteps, degrees), 0.7);
}

TEST(Curvature, FollowsTheWorldWhereSpacingDiffers) {
  const TorusErrors e = torus_errors(0.025, 2 * std::sqrt(0.025), Vec3(1, 0.5, 0.8));
  EXPECT_LT(e.kappa_1, 0.1);
  EXPECT_LT(e.kappa_2, 0.2);
  EXPECT_LT(e.degrees, 1.5);
}

/// The voxels of the ball that are not in the set: V - V_0 and Vol - Vol_0 change their signs, but
/// for the means that V is about.
TEST(Curvature, ChangesItsSignWhereInsideAndOutsideAreExchanged) {
  Grid grid{{61, 61, 61}};
  grid.origin = Vec3(-30, -30, -30);
  const auto inside = [](const Vec3& p) { return p.norm() < 20; };
  const BinaryVolume solid = test::fill(grid, inside);
  const BinaryVolume hollow = test::fill(grid, [&](const Vec3& p) { return !inside(p); });
  std::vector<Surfel> surfels, opposites;
  for (const Surfel& s : test::all_surfels(solid)) {
    surfels.push_back(s);
    Surfel o = s;
    o.direction ^= 1;
    (s.axis() == 0 ? o.x : s.axis() == 1 ? o.y : o.z) += s.sign();
    opposites.push_back(o);
  }
  const CurvatureField a = integral_invariant_curvatures(solid, surfels, {8.});
  const CurvatureField b = integral_invariant_curvatures(hollow, opposites, {8.});
  EXPECT_NEAR(a.mean.mean(), 1. / 20, 0.01);
  EXPECT_LT((a.mean + b.mean).cwiseAbs().maxCoeff(), 0.1 / 20);
  const CurvatureField c =
      integral_invariant_curvatures(solid, surfels, {8., CurvatureForm::plain});
  const CurvatureField d =
      integral_invariant_curvatures(hollow, opposites, {8., CurvatureForm::plain});
  EXPECT_LT((c.mean + d.mean).cwiseAbs().maxCoeff(), 1e-12);  // the volume alone: exactly
}

TEST(Curvature, IsFiniteAndCountedWhereTheBallDefinesNoNormal) {
  const BinaryVolume single =
      test::fill(Grid{{3, 3, 3}}, [](const Vec3& p) { return p == Vec3(1, 1, 1); });
  const std::vector<Surfel> surfels = test::all_surfels(single);
  const CurvatureField field = integral_invariant_curvatures(single, surfels, {4.});
  EXPECT_EQ(field.fallbacks, 6);
  for (Index i = 0; i < 6; ++i) {
    EXPECT_EQ(field.normals.col(i), surfels[static_cast<std::size_t>(i)].normal());
  }
  for (const double density : {0.1, 0.5, 0.9}) {
    const BinaryVolume noise = test::random_volume(Grid{{20, 15, 10}}, density, 3);
    for (const double radius : {0.5, 1., 2., 40.}) {
      for (const CurvatureForm form : {CurvatureForm::centred, CurvatureForm::plain}) {
        const CurvatureField any =
            integral_invariant_curvatures(noise, test::all_surfels(noise), {radius, form});
        EXPECT_TRUE(any.mean.allFinite() && any.gaussian.allFinite() && any.kappa_1.allFinite() &&
                    any.kappa_2.allFinite() && any.direction_1.allFinite());
      }
    }
  }
  EXPECT_THROW(integral_invariant_curvatures(single, surfels, {0.}), UsageError);
}

TEST(Curvature, HasTheNormalsOfTheNormalEstimator) {
  const BinaryVolume volume = test::digital_sphere(1, 0.1);
  const std::vector<Surfel> surfels = test::all_surfels(volume);
  EXPECT_EQ(integral_invariant_curvatures(volume, surfels, {0.7}).normals,
            integral_invariant_normals(volume, surfels, {0.7, BallCentre::surfel}).u);
}

TEST(Curvature, HasTheSameBitsForAnyThreadCount) {
  const BinaryVolume volume = test::digital_sphere(1, 0.08);
  const std::vector<Surfel> surfels = test::all_surfels(volume);
  Context context;
  context.threads = 1;
  const CurvatureField one = integral_invariant_curvatures(volume, surfels, {0.6}, context);
  for (const int threads : {2, 5}) {
    context.threads = threads;
    const CurvatureField many = integral_invariant_curvatures(volume, surfels, {0.6}, context);
    EXPECT_EQ(many.mean, one.mean);
    EXPECT_EQ(many.kappa_1, one.kappa_1);
    EXPECT_EQ(many.direction_1, one.direction_1);
  }
}

}  // namespace
}  // namespace dsc
