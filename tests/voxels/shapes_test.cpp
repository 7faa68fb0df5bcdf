#include "libdsc/voxels/shapes.h"

#include "libdsc/base/error.h"
#include "libdsc/voxels/expression_shape.h"
#include "libdsc/voxels/shape_spec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dsc {
namespace {

const char* const kSpecs[] = {"sphere,r=1.3,cx=0.1,cy=0.2,cz=-0.3",
                              "ellipsoid,a=1.2,b=0.7,c=0.9",
                              "torus,R=1.1,r=0.3",
                              "rounded-cube,r=1.2",
                              "goursat",
                              "leopold",
                              "heart",
                              "plane,nx=1,ny=-2,nz=3,d=0.4,size=3",
                              "expr:x^2+0.5*y^2*z+sin(z)-1;box=-2,2"};

/// Random points of the bounds.
std::vector<Vec3> random_points(const ImplicitShape& shape, int n) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0., 1.);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const Vec3 t(uniform(random), uniform(random), uniform(random));
    points.push_back(shape.bounds().min() + t.cwiseProduct(shape.bounds().sizes()));
  }
  return points;
}

TEST(Shapes, TheGradientIsTheLimitOfDifferences) {
  for (const char* spec : kSpecs) {
    SCOPED_TRACE(spec);
    const auto shape = make_shape(spec);
    const double h = 1e-5 * shape->bounds().sizes().maxCoeff();
    for (const Vec3& p : random_points(*shape, 200)) {
      const Vec3 g = shape->gradient(p);
      for (int i = 0; i < 3; ++i) {
        const Vec3 e = h * Vec3::Unit(i);
        const double difference = (shape->value(p + e) - shape->value(p - e)) / (2. * h);
        ASSERT_NEAR(g[i], difference, 1e-6 * (1. + g.norm())) << p.transpose();
      }
    }
  }
}

TEST(Shapes, TheHessianIsTheDerivativeOfTheGradientAndSymmetric) {
  for (const char* spec : kSpecs) {
    SCOPED_TRACE(spec);
    const auto shape = make_shape(spec);
    const double h = 1e-5 * shape->bounds().sizes().maxCoeff();
    for (const Vec3& p : random_points(*shape, 200)) {
      const Mat3 hessian = shape->hessian(p);
      ASSERT_EQ(hessian, hessian.transpose());
      for (int i = 0; i < 3; ++i) {
        const Vec3 e = h * Vec3::Unit(i);
        const Vec3 difference = (shape->gradient(p + e) - shape->gradient(p - e)) / (2. * h);
        ASSERT_NEAR((hessian.col(i) - difference).norm(), 0, 1e-5 * (1. + hessian.norm()))
            << p.transpose();
      }
    }
  }
}

TEST(Shapes, ValuesAlongARowAreTheValuesOfItsPoints) {
  for (const char* spec : kSpecs) {
    SCOPED_TRACE(spec);
    const auto shape = make_shape(spec);
    const double h = shape->bounds().sizes()[0] / 99.;
    for (const Vec3& p : random_points(*shape, 20)) {
      for (const int count : {1, 17, 64}) {
        double row[64];
        shape->values_along_x(h, -30, count, p.y(), p.z(), row);
        for (int k = 0; k < count; ++k) {
          ASSERT_EQ(row[k], shape->value(Vec3(h * double(k - 30), p.y(), p.z())));
        }
      }
    }
  }
}

TEST(Shapes, ValuesAreNegativeInsideAndGrowOutwards) {
  EXPECT_LT(Sphere(2.).value(Vec3(1.99, 0, 0)), 0);
  EXPECT_GT(Sphere(2.).value(Vec3(0, 2.01, 0)), 0);
  EXPECT_LT(Torus(1., 0.4).value(Vec3(1.39, 0, 0)), 0);
  EXPECT_GT(Torus(1., 0.4).value(Vec3(0.59, 0, 0)), 0);
  EXPECT_NEAR(Torus(1., 0.4).value(Vec3(0, 1., 0.4)), 0, 1e-15);
  EXPECT_NEAR(Ellipsoid(Vec3(3, 2, 1)).value(Vec3(0, -2, 0)), 0, 1e-15);
  EXPECT_NEAR(RoundedCube(2.).value(Vec3(0, 0, -2)), 0, 1e-15);
  EXPECT_NEAR(
      Goursat().value(Vec3(std::sqrt(280. / 3.), std::sqrt(100. / 3.), std::sqrt(100. / 3.))), 0,
      1e-12);
  EXPECT_NEAR(Leopold().value(Vec3(0, 5, 0)), 0, 1e-12);
  EXPECT_NEAR(Heart().value(Vec3(0, 0, 1)), 0, 1e-15);
  EXPECT_LT(Heart().value(Vec3(0.6, 0, 0.9)), 0);  // a lobe
  EXPECT_GT(Heart().value(Vec3(0, 0, 1.1)), 0);    // the notch between the lobes
  EXPECT_DOUBLE_EQ(Plane(Vec3(0, 0, 2), 1.).value(Vec3(5, 5, 3)), 2.);  // a signed distance
}

TEST(ShapeSpec, NamesMakeTheShapeAgain) {
  for (const char* spec : kSpecs) {
    const auto shape = make_shape(spec);
    const auto again = make_shape(shape->name());
    EXPECT_EQ(again->name(), shape->name());
    for (const Vec3& p : random_points(*shape, 20)) EXPECT_EQ(again->value(p), shape->value(p));
  }
  for (const std::string& line : known_shapes()) {
    if (line.rfind("expr:", 0) == 0) continue;
    EXPECT_NO_THROW((void)make_shape(line)) << line;
  }
}

TEST(ShapeSpec, FaultsAreNamedWithTheRemedy) {
  const auto expect = [](const std::string& spec, const std::vector<std::string>& parts) {
    try {
      (void)make_shape(spec);
      ADD_FAILURE() << spec << ": nothing was thrown";
    } catch (const UsageError& e) {
      for (const std::string& part : parts) {
        EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << part << ": " << e.what();
      }
    }
  };
  expect("spher", {"'spher' is unknown", "sphere,r=1", "goursat", "expr:"});
  expect("", {"unknown", "sphere"});
  expect("sphere,R=1", {"'R=1'", "sphere,r=1,cx=0"});
  expect("sphere,r", {"'r'"});
  expect("goursat,r=1", {"'r=1'"});
  expect("sphere,r=1,r=2", {"r is given twice"});
  for (const char* value : {"", "abc", "1x", "nan", "inf", "-inf", "1e999", " 1"}) {
    expect(std::string("sphere,r=") + value, {"is not a finite number"});
  }
  expect("sphere,r=0", {"positive"});
  expect("sphere,r=-1", {"positive"});
  expect("torus,R=1,r=1", {"smaller than R"});
  expect("plane,nx=0,ny=0,nz=0", {"must not be zero"});
  expect("expr:x^2-1", {"needs a box"});
  expect("expr:x^2-1;box=1", {"needs a box"});
  expect("expr:x^2-1;box=1,-1", {"lower corner"});
  expect("expr:x^2-1;box=-1,1;size=3", {"'size=3'", "box=LO,HI"});
  expect("expr:x^2-;box=-1,1", {"character"});
}

TEST(ShapeSpec, ExpressionsMayBeOpenAndHaveCommas) {
  EXPECT_TRUE(make_shape("expr:max(x,y)-0.5;box=-1,1")->closed());
  const auto open = make_shape("expr:max(x,y)-0.5;box=-1,-2,-3,1,2,3;open");
  EXPECT_FALSE(open->closed());
  EXPECT_EQ(open->bounds().max(), Vec3(1, 2, 3));
  EXPECT_DOUBLE_EQ(open->value(Vec3(0.25, 0.75, 0)), 0.25);
}

TEST(ExpressionShape, DerivativesHaveTheStatedAccuracy) {
  const ExpressionShape text("0.03*(x^4+y^4+z^4)-2*(x^2+y^2+z^2)-8",
                             {Vec3::Constant(-10.), Vec3::Constant(10.)});
  const Goursat exact;
  for (const Vec3& p : random_points(exact, 200)) {
    const Vec3 g = exact.gradient(p);
    ASSERT_NEAR((text.gradient(p) - g).norm(), 0, 1e-10 * (1. + g.norm()));
    ASSERT_NEAR((text.hessian(p) - exact.hessian(p)).norm(), 0, 1e-8 * (1. + g.norm()));
  }
}

}  // namespace
}  // namespace dsc
