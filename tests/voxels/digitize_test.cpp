#include "libdsc/voxels/digitize.h"

#include "libdsc/base/error.h"
#include "libdsc/voxels/shape_spec.h"
#include "libdsc/voxels/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace dsc {
namespace {

const char* const kShapes[] = {"sphere,r=1.03,cx=0.2,cy=-0.1,cz=0.05",
                               "ellipsoid",
                               "torus",
                               "rounded-cube,r=0.9",
                               "goursat",
                               "leopold",
                               "heart",
                               "plane,nx=1,ny=2,nz=3,d=0.1,size=2",
                               "expr:x^2+2*y^2+z^4-1;box=-1.3,1.3"};

/// About 50 voxels across.
Vec3 spacing_for(const ImplicitShape& shape) {
  const double h = shape.bounds().sizes().maxCoeff() / 50.;
  return {h, 1.1 * h, 0.9 * h};
}

Index lattice_index(double position, double h) { return std::llround(position / h); }

TEST(Digitize, VoxelsAreTheLatticePointsWithNegativeValue) {
  for (const char* spec : kShapes) {
    SCOPED_TRACE(spec);
    const auto shape = make_shape(spec);
    const Vec3 h = spacing_for(*shape);
    const BinaryVolume volume = digitize(*shape, h);
    const Grid& grid = volume.grid();
    Index count = 0;
    for (Index z = 0; z < grid.size[2]; ++z) {
      for (Index y = 0; y < grid.size[1]; ++y) {
        for (Index x = 0; x < grid.size[0]; ++x) {
          const Vec3 about = grid.position(double(x), double(y), double(z));
          const Vec3 p(h[0] * double(lattice_index(about[0], h[0])),
                       h[1] * double(lattice_index(about[1], h[1])),
                       h[2] * double(lattice_index(about[2], h[2])));
          ASSERT_NEAR((about - p).norm(), 0, 1e-12);  // the origin is a lattice point
          const bool in_box = shape->bounds().contains(p);
          const bool inside = in_box && shape->value(p) < 0;
          ASSERT_EQ(volume(x, y, z), inside) << p.transpose();
          count += inside ? 1 : 0;
        }
      }
    }
    EXPECT_GT(count, 1000);
    EXPECT_EQ(volume.count(), count);
  }
}

TEST(Digitize, TheBoundsOfClosedShapesHoldAllOfThem) {
  for (const char* spec : kShapes) {
    SCOPED_TRACE(spec);
    const auto shape = make_shape(spec);
    if (!shape->closed()) continue;
    const Eigen::AlignedBox3d box = shape->bounds();
    for (int i = -40; i <= 40; ++i) {
      for (int j = -40; j <= 40; ++j) {
        for (int k = -40; k <= 40; ++k) {
          const Vec3 p = box.center() + (Vec3(i, j, k) / 20.).cwiseProduct(0.5 * box.sizes());
          if (!box.contains(p)) {
            ASSERT_GT(shape->value(p), 0) << p.transpose();
          }
        }
      }
    }
  }
}

TEST(Digitize, VolumeOfTheBallConverges) {
  const double exact = 4. / 3. * M_PI;
  for (const double h : {0.1, 0.05, 0.025}) {
    const double measured = double(digitize(Sphere(), {h, h, h}).count()) * h * h * h;
    EXPECT_NEAR(measured, exact, 0.25 * exact * h);  // |error| <= area * h / 2 would be 1.5 h
  }
}

TEST(Digitize, PointsOnTheSurfaceAreOutside) {
  // Powers of two are exact: (±1, 0, 0) lie on the unit sphere.
  const BinaryVolume volume = digitize(Sphere(), {0.25, 0.25, 0.25});
  const Grid& grid = volume.grid();
  const auto at = [&](double x, double y, double z) {
    return volume(std::llround((x - grid.origin[0]) / 0.25),
                  std::llround((y - grid.origin[1]) / 0.25),
                  std::llround((z - grid.origin[2]) / 0.25));
  };
  EXPECT_FALSE(at(1, 0, 0));
  EXPECT_FALSE(at(0, -1, 0));
  EXPECT_FALSE(at(0, 0, 1));
  EXPECT_TRUE(at(0.75, 0, 0));
}

TEST(Digitize, ClosedShapesLeaveAMarginAndOpenOnesReachTheBorder) {
  const BinaryVolume ball = digitize(Sphere(), {0.1, 0.1, 0.1});
  const Index n = ball.grid().size[0];
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      EXPECT_FALSE(ball(0, i, j) || ball(n - 1, i, j) || ball(i, 0, j) || ball(i, n - 1, j) ||
                   ball(i, j, 0) || ball(i, j, n - 1));
    }
  }
  const BinaryVolume plane = digitize(Plane(Vec3(0, 0, 1), 0.05, 2.), {0.1, 0.1, 0.1});
  EXPECT_EQ(plane.grid().size, (Index3{21, 21, 21}));
  EXPECT_EQ(plane.count(), 21 * 21 * 11);
}

TEST(Digitize, ThreadsDoNotChangeTheVoxels) {
  const Vec3 h(0.07, 0.07, 0.07);
  const BinaryVolume one = digitize(Torus(), h, Context{1});
  for (const int threads : {2, 4, 8}) {
    const BinaryVolume many = digitize(Torus(), h, Context{threads});
    for (Index z = 0; z < one.grid().size[2]; ++z) {
      for (Index y = 0; y < one.grid().size[1]; ++y) {
        for (Index w = 0; w < one.words_per_row(); ++w)
          ASSERT_EQ(one.word(w, y, z), many.word(w, y, z));
      }
    }
  }
}

TEST(Digitize, UnusableGridstepsAreRefused) {
  EXPECT_THROW(digitize(Sphere(), {0., 0.1, 0.1}), UsageError);
  EXPECT_THROW(digitize(Sphere(), {0.1, -0.1, 0.1}), UsageError);
  EXPECT_THROW(digitize(Sphere(), {0.1, 0.1, std::nan("")}), UsageError);
  EXPECT_THROW(digitize(Sphere(), {1e-12, 1e-12, 1e-12}), LimitError);
  EXPECT_THROW(digitize(Sphere(), {1e-6, 1e-6, 1e-6}), LimitError);  // 8e18 voxels
}

TEST(Digitize, ValuesThatAreNotNumbersNameTheirPoint) {
  const auto shape = make_shape("expr:sqrt(x)-1;box=-1,1");
  try {
    (void)digitize(*shape, {0.5, 0.5, 0.5});
    FAIL() << "nothing was thrown";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("(-1, -1, -1)"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace dsc
