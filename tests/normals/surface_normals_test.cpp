#include "libdsc/normals/surface_normals.h"

#include "libdsc/base/error.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"

#include <gtest/gtest.h>

namespace dsc {
namespace {

TEST(SurfaceNormals, EveryEstimatorWritesTheFaceProperty) {
  const Torus torus;
  const BinaryVolume volume = digitize(torus, Vec3::Constant(0.1));
  DigitalSurface surface = extract_surface(volume);
  ASSERT_TRUE(surface.normals().empty());

  const NormalReport ii = integral_invariant_normals(surface, volume, {0.35});
  EXPECT_EQ(ii.fallbacks, 0);
  EXPECT_EQ(ii.radius, 0.35);
  EXPECT_EQ(surface.normals().matrix(),
            integral_invariant_normals(volume, surface.surfels(), {0.35}).u);
  const Eigen::Matrix3Xd estimated = surface.normals().matrix();

  EXPECT_EQ(trivial_normals(surface).fallbacks, 0);
  EXPECT_EQ(surface.normals().matrix(), trivial_normals(surface.flat(false)).u);
  const Eigen::Matrix3Xd averaged = surface.normals().matrix();

  EXPECT_EQ(analytic_normals(surface, torus).fallbacks, 0);
  const auto exact = surface.normals().matrix();
  EXPECT_LT((estimated - exact).norm(), 0.7 * (averaged - exact).norm());
}

TEST(SurfaceNormals, RefuseAVolumeThatIsNotTheSurfaces) {
  const BinaryVolume volume = digitize(Sphere(), Vec3::Constant(0.2));
  DigitalSurface surface = extract_surface(volume);
  const BinaryVolume other = digitize(Sphere(), Vec3::Constant(0.1));
  EXPECT_THROW(integral_invariant_normals(surface, other, {0.5}), UsageError);
  EXPECT_TRUE(surface.normals().empty());
}

}  // namespace
}  // namespace dsc
