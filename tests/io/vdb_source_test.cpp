// OpenVDB's files through dsc-vdb-reader, against files that OpenVDB wrote of known voxels.
#include "libdsc/base/error.h"
#include "libdsc/io/read_binary.h"
#include "libdsc/io/read_labels.h"
#include "tests/io/vdb_fixture.h"
#include "tests/io/volume_bytes.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace dsc {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Eigen::Matrix4d matrix_of(const Mat3& axes, const Vec3& origin) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = axes;
  matrix.topRightCorner<3, 1>() = origin;
  return matrix;
}

/// The values in the order of the file's voxels, x fastest, as doubles.
VoxelSelection between(double low, double high) {
  VoxelSelection selection;
  selection.threshold = {low, high};
  return selection;
}

/// The place of the values' type in VoxelValues.
std::size_t type_of(VolumeSource& source) {
  std::size_t type = 99;
  source.read([&](const Slab& slab) { type = slab.values.index(); });
  return type;
}

/// A radius like this one, so that around a centre in 16ths of a voxel no voxel is on the sphere:
/// all squares of distances are 256ths.
double off_lattice(double radius) {
  return std::sqrt((std::round(radius * radius * 256) + 0.5) / 256);
}
const double kRadius = off_lattice(6.37);

/// Expects the voxels of a ball, each at its place in the world.
void expect_ball(const std::string& path, double radius, const Vec3& centre,
                 const Eigen::Matrix4d& matrix) {
  const auto source = open_volume(path);
  EXPECT_EQ(source->volume_class(), VolumeClass::level_set);
  const RigidMap world = source->world();
  const BinaryVolume volume = read_binary(*source);
  const Grid& grid = volume.grid();
  const Eigen::Matrix4d back = matrix.inverse();
  Index inside = 0;
  for (Index z = 0; z < grid.size[2]; ++z) {
    for (Index y = 0; y < grid.size[1]; ++y) {
      for (Index x = 0; x < grid.size[0]; ++x) {
        const Vec3 place = world(
            grid.position(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)));
        const Vec3 voxel = (back * place.homogeneous()).head<3>();  // the file's coordinates
        ASSERT_LT((voxel - voxel.array().round().matrix()).norm(), 1e-9);
        const double distance = (voxel - centre).norm() - radius;
        ASSERT_GT(std::abs(distance), 1e-5) << "the test's ball has a voxel on its surface";
        ASSERT_EQ(volume(x, y, z), distance < 0) << voxel.transpose();
        inside += distance < 0 ? 1 : 0;
      }
    }
  }
  // None was left out of the box.
  Index expected = 0;
  const auto r = static_cast<int>(radius) + 1;
  const Vec3 middle = centre.array().round();
  for (int k = -r; k <= r; ++k) {
    for (int j = -r; j <= r; ++j) {
      for (int i = -r; i <= r; ++i) {
        expected += (middle + Vec3(i, j, k) - centre).norm() < radius ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(inside, expected);
}

TEST_F(Vdb, ALevelSetsInteriorIsTheObject) {
  const Vec3 centre(0.3125, -7.25, 3.125);
  for (const double radius : {off_lattice(1.63), off_lattice(12.37), off_lattice(40.41)}) {
    const Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    test::write_vdb_ball(path_, "ball", radius, centre, matrix);
    expect_ball(path_, radius, centre, matrix);
  }
}

TEST_F(Vdb, TransformsAreSpacingAndPlaceInTheWorld) {
  const Vec3 centre(0.3125, -7.25, 3.125), origin(-20, 100, 7.5), spacing(0.1, 0.25, 0.7);
  const Mat3 turn = Eigen::AngleAxisd(0.5, Vec3(1, -2, 2).normalized()).toRotationMatrix();
  const Mat3 scale = spacing.asDiagonal();
  const Mat3 mirror = Vec3(1, -1, 1).asDiagonal();
  for (const Mat3& axes : {Mat3(0.1 * Mat3::Identity()), scale, Mat3(turn * scale),
                           Mat3(turn * mirror * scale), Mat3(mirror * scale)}) {
    SCOPED_TRACE(axes);
    const Eigen::Matrix4d matrix = matrix_of(axes, origin);
    test::write_vdb_ball(path_, "ball", kRadius, centre, matrix);
    expect_ball(path_, kRadius, centre, matrix);
    const auto source = open_volume(path_);
    EXPECT_EQ(source->world().mirrors(), axes.determinant() < 0);
    for (int a = 0; a < 3; ++a) {
      EXPECT_NEAR(source->grid().spacing[a], axes.col(a).norm(), 1e-13);
    }
  }
  // Spacing is exact where neither a rotation nor, in OpenVDB itself, a translation rounds it.
  test::write_vdb_ball(path_, "ball", kRadius, centre, matrix_of(scale, Vec3::Zero()));
  EXPECT_EQ(open_volume(path_)->grid().spacing, spacing);
  EXPECT_EQ(open_volume(path_)->world().rotation, Mat3(Mat3::Identity()));
}

TEST_F(Vdb, InactiveTilesOfALevelSetsInteriorAreInside) {
  // No voxel but one is stored; the tiles are of 128, 8 and 1 voxels.
  const VdbGrid grid{.grid_class = VdbClass::level_set,
                     .background = 3,
                     .fills = {{{-1, 0, 0}, {135, 128, 127}, -3, false}},
                     .voxels = {{{-20, 5, 5}, 1.5}}};
  test::write_vdb(path_, {grid});
  const auto source = open_volume(path_);
  EXPECT_EQ(source->grid().size, (Index3{156, 129, 128}));
  EXPECT_EQ(source->world().translation, Vec3(-20, 0, 0));
  const BinaryVolume volume = read_binary(*source);
  EXPECT_EQ(volume.count(), Index{137} * 129 * 128);
  EXPECT_FALSE(volume(18, 5, 5));
  EXPECT_TRUE(volume(19, 5, 5));
  // What a threshold chooses is a matter of values only.
  EXPECT_EQ(read_binary(path_, between(1, 2)).count(), 1);
}

TEST_F(Vdb, EveryTypeGivesItsValues) {
  const auto wide = [](int x, int y, int z) { return (x - 4) * 1e9 + y * 7. + z; };
  const auto real = [](int x, int y, int z) { return 1.25 * x - 0.0625 * y + 3 * z; };
  const auto small = [](int x, int y, int z) { return (x * y + z) % 50 - 20.; };
  const auto huge = [](int x, int y, int z) { return std::ldexp(x + y - z, 55) + 1024; };
  const auto bit = [](int x, int y, int z) { return (x + y * z) % 3 == 0 ? 1. : 0.; };
  const auto expect = [&](VdbType type, std::size_t index, const auto& value) {
    for (const VdbForm form : {VdbForm::plain, VdbForm::zip, VdbForm::blosc, VdbForm::stream}) {
      SCOPED_TRACE(static_cast<int>(type) * 10 + static_cast<int>(form));
      const VdbGrid grid = box_of(type, value);
      test::write_vdb(path_, {grid}, form);
      EXPECT_EQ(type_of(*open_volume(path_)), index);
      const auto source = open_volume(path_);
      ASSERT_EQ(source->grid().size, (Index3{10, 3, 11}));
      EXPECT_EQ(source->world().translation, Vec3(-5, 6, -9));
      EXPECT_EQ(source->volume_class(), VolumeClass::values);
      EXPECT_EQ(source->grid_name(), "grid");
      const std::vector<double> values = values_of(*source);
      ASSERT_EQ(values.size(), grid.voxels.size());
      for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], grid.voxels[i].value);
    }
  };
  expect(VdbType::float32, 8, real);
  expect(VdbType::float64, 9, real);
  expect(VdbType::half, 8, small);
  expect(VdbType::int32, 5, small);
  expect(VdbType::int64, 7, wide);
  expect(VdbType::int64, 7, huge);
  expect(VdbType::boolean, 0, bit);
}

TEST_F(Vdb, AMaskIsWhatIsActive) {
  test::write_vdb(path_,
                  {{.type = VdbType::mask,
                    .fills = {{{0, 0, 0}, {15, 15, 15}, 1}, {{8, 8, 8}, {15, 15, 15}, 0, false}},
                    .voxels = {{{20, 3, 3}, 1}}}});
  const auto source = open_volume(path_);
  EXPECT_EQ(source->grid().size, (Index3{21, 16, 16}));
  EXPECT_EQ(read_binary(*source).count(), 16 * 16 * 16 - 512 + 1);
}

TEST_F(Vdb, LabelsOfIntegersAreRead) {
  test::write_vdb(path_, {{.type = VdbType::int32,
                           .fills = {{{0, 0, 0}, {7, 7, 7}, 3}, {{8, 0, 0}, {15, 7, 7}, 70000}}}});
  const LabelVolume labels = read_labels(path_);
  EXPECT_EQ(labels.grid().size, (Index3{16, 8, 8}));
  EXPECT_EQ(labels(7, 1, 2), 3U);
  EXPECT_EQ(labels(8, 1, 2), 70000U);
}

TEST_F(Vdb, OfAFogVolumeWhatIsAboveZeroIsInsideAndNaNNever) {
  VdbGrid grid{.grid_class = VdbClass::fog_volume,
               .voxels = {{{0, 0, 0}, -1},
                          {{1, 0, 0}, 0},
                          {{2, 0, 0}, 1e-30},
                          {{3, 0, 0}, kNaN},
                          {{4, 0, 0}, 0.5},
                          {{6, 0, 0}, 2}}};
  test::write_vdb(path_, {grid});
  const auto count = [&](const VoxelSelection& selection) {
    return read_binary(path_, selection).count();
  };
  EXPECT_EQ(open_volume(path_)->volume_class(), VolumeClass::fog_volume);
  EXPECT_EQ(count({}), 3);
  EXPECT_EQ(count(between(0.25, 10)), 2);
  EXPECT_EQ(count(between(-5, 5)), 6);  // (5, 0, 0) is background; NaN is in no interval
  grid.grid_class = VdbClass::unknown;
  test::write_vdb(path_, {grid});
  EXPECT_EQ(count({}), 4) << "without a class, all but 0, as in other files";
  grid.grid_class = VdbClass::level_set;
  grid.background = 3;
  test::write_vdb(path_, {grid});
  EXPECT_EQ(count({}), 1);
}

TEST_F(Vdb, GridsAreChosenByName) {
  const auto grid = [](const std::string& name, double value, VdbType type = VdbType::float32) {
    return VdbGrid{.name = name, .type = type, .voxels = {{{0, 0, 0}, value}}};
  };
  const auto value = [&](const std::optional<std::string>& name) {
    return values_of(*open_volume(path_, {name})).at(0);
  };
  for (const VdbForm form : {VdbForm::blosc, VdbForm::stream}) {
    SCOPED_TRACE(static_cast<int>(form));
    test::write_vdb(path_, {grid("density", 2), grid("v", 1, VdbType::vector)}, form);
    EXPECT_EQ(value(std::nullopt), 2) << "one is of numbers";
    EXPECT_EQ(value("density"), 2);
    expect_input_error([&] { (void)value("v"); }, {path_, "'v' holds vectors (vec3s)"});
    expect_input_error([&] { (void)value("w"); },
                       {path_, "no grid 'w'", "'density' (float), 'v' (vec3s)"});
    test::write_vdb(path_, {grid("a", 1), grid("b", 2, VdbType::int32), grid("a", 3)}, form);
    expect_input_error([&] { (void)value(std::nullopt); },
                       {path_, "'a[0]' (float), 'b' (int32), 'a[1]' (float)", "--grid"});
    expect_input_error([&] { (void)value("a"); }, {path_, "'a[0]'", "'a[1]'"});
    EXPECT_EQ(value("b"), 2);
    EXPECT_EQ(value("a[1]"), 3);
    EXPECT_EQ(open_volume(path_, {"a[1]"})->grid_name(), "a[1]");
    test::write_vdb(path_, {grid("", 7), grid("", 8)}, form);
    EXPECT_EQ(value("[1]"), 8);
    test::write_vdb(path_, {grid("v", 1, VdbType::vector)}, form);
    expect_input_error([&] { (void)value(std::nullopt); }, {path_, "'v' holds vectors"});
    test::write_vdb(path_, {}, form);
    expect_input_error([&] { (void)value(std::nullopt); }, {path_, "no grid"});
  }
  write_all(folder_ / "v.vol", "");
  EXPECT_THROW((void)open_volume(folder_ / "v.vol", {"a"}), UsageError);
}

TEST_F(Vdb, GridsThatShareVoxelsAreBothRead) {
  test::write_vdb_instances(path_);
  for (const bool second : {false, true}) {
    const auto source = open_volume(path_, {second ? "two" : "one"});
    EXPECT_EQ(source->world().translation, Vec3(second ? 11 : 1, 2, 3));
    EXPECT_EQ(values_of(*source), (std::vector<double>{4, 5}));
  }
}

}  // namespace
}  // namespace dsc
