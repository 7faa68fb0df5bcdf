// Medical images through the program: computed in the frame of the volume, placed in the world.
#include "libdsc/io/volume_writer.h"
#include "libdsc/voxels/rigid_map.h"
#include "tests/cli/program.h"
#include "tests/io/image_bytes.h"
#include "tests/io/result_parsers.h"

#include <gtest/gtest.h>

namespace dsc::test {
namespace {

/// An ellipsoid on stretched voxels, as .npy with --gridstep, and as .mha in a turned frame.
class Placed : public ::testing::TestWithParam<double> {
 protected:
  void SetUp() override {
#ifndef DSC_IMAGE_READER
    GTEST_SKIP() << "built without DSC_WITH_ITK";
#endif
    image_ = {{23, 25, 15}, {1, 0.75, 1.5}, test_direction(GetParam()), {-20, 100, 7}, {}};
    for (Index z = 0; z < 15; ++z) {
      for (Index y = 0; y < 25; ++y) {
        for (Index x = 0; x < 23; ++x) {
          const Vec3 p = image_.spacing.cwiseProduct(Vec3(x, y, z)) - centre_;
          image_.values.push_back(p.cwiseQuotient(Vec3(9, 7, 8)).norm() < 1 ? 5 : 0);
        }
      }
    }
    world_ = {image_.direction, image_.origin};
    write_file(folder_ / "v.mha", mha_bytes(image_));
    write_volume(folder_ / "v.npy", Grid{image_.size, {1, 1, 1}, Vec3::Zero()},
                 std::span<const std::int16_t>(image_.values));
  }

  static std::string point(const Vec3& p) { return joined(p, ","); }

  /// Runs on one of the two, and returns what was written.
  PlyFile run(const std::string& input, Words arguments) {
    const std::string out = folder_ / "out.ply";
    arguments.insert(arguments.begin() + 1, folder_ / input);
    arguments.insert(arguments.end(), {"-o", out, "--report", folder_ / "report.json"});
    if (input == "v.npy") arguments.insert(arguments.end(), {"--gridstep", point(image_.spacing)});
    const Outcome outcome = run_dsc(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? read_ply(out) : PlyFile{};
  }
  nlohmann::json report() const { return read_json(folder_ / "report.json"); }

  static Vec3 vector(const std::vector<double>& values, std::size_t i) {
    return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  }

  Vec3 centre_{11, 9, 10.5};
  TestImage image_;
  RigidMap world_;
  Folder folder_;
};

TEST_P(Placed, DistancesAreTheSameAndPositionsInTheWorld) {
  const Vec3 source = centre_ + Vec3(9, 0.1, 0.2);
  const PlyFile here = run("v.npy", {"geodesic", "--source", point(source)});
  const double radius = report()["normals"]["radius"];
  const PlyFile there = run("v.mha", {"geodesic", "--source", point(world_(source))});
  EXPECT_EQ(report()["normals"]["radius"], radius);
  EXPECT_DOUBLE_EQ(radius, 6 * 1.5);  // voxels of the coarsest axis
  ASSERT_EQ(here.vertices.size(), there.vertices.size());
  for (std::size_t v = 0; v < here.vertices.size(); ++v) {
    const auto& p = here.vertices[v];
    const auto& q = there.vertices[v];
    EXPECT_EQ(p[3], q[3]) << "distance of vertex " << v;
    EXPECT_LT((world_(Vec3(p[0], p[1], p[2])) - Vec3(q[0], q[1], q[2])).norm(), 1e-11);
  }
  const auto input = report()["input"];
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(input["origin"][i], image_.origin[static_cast<int>(i)], 1e-12);
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(input["direction"][i][j],
                  image_.direction(static_cast<int>(i), static_cast<int>(j)), 1e-12);
    }
  }
}

TEST_P(Placed, NormalsAndFacesPointOutwards) {
  const auto here = run("v.npy", {"normals"}).face_columns({"nx", "ny", "nz"});
  const PlyFile there = run("v.mha", {"normals"});
  const auto normals = there.face_columns({"nx", "ny", "nz"});
  ASSERT_EQ(normals.size(), here.size());
  const Vec3 centre = world_(centre_);
  for (std::size_t f = 0; f < there.faces.size(); ++f) {
    const Vec3 n = vector(normals, f);
    EXPECT_LT((world_.turned(vector(here, f)) - n).norm(), 1e-12);
    Vec3 area = Vec3::Zero(), middle = Vec3::Zero();
    for (std::size_t c = 0; c < 4; ++c) {
      const auto& p = there.vertices[static_cast<std::size_t>(there.faces[f][c])];
      const auto& q = there.vertices[static_cast<std::size_t>(there.faces[f][(c + 1) % 4])];
      area += (Vec3(p[0], p[1], p[2]) - centre).cross(Vec3(q[0], q[1], q[2]) - centre);
      middle += Vec3(p[0], p[1], p[2]) / 4;
    }
    EXPECT_GT(n.dot(middle - centre), 0);
    EXPECT_GT(area.dot(middle - centre), 0) << "face " << f << " is inside out";
  }
}

TEST_P(Placed, FunctionsAreOfWorldCoordinatesAndGradientsOfTheWorld) {
  // x of the world, in coordinates of the volume.
  const Vec3 row = image_.direction.row(0);
  const std::string x = "(" + joined({row[0]}, "") + ")*x+(" + joined({row[1]}, "") + ")*y+(" +
                        joined({row[2]}, "") + ")*z+(" + joined({image_.origin[0]}, "") + ")";
  const auto here =
      run("v.npy", {"gradient", "--function", "(" + x + ")^2"}).face_columns({"gx", "gy", "gz"});
  const auto there =
      run("v.mha", {"gradient", "--function", "x^2"}).face_columns({"gx", "gy", "gz"});
  ASSERT_EQ(here.size(), there.size());
  double largest = 0;
  for (std::size_t f = 0; f < there.size() / 3; ++f) {
    EXPECT_LT((world_.turned(vector(here, f)) - vector(there, f)).norm(), 1e-9);
    largest = std::max(largest, vector(there, f).norm());
  }
  EXPECT_GT(largest, 10);
}

TEST_P(Placed, LabelsOfAnImageAreWritten) {
  const PlyFile file = run("v.mha", {"surface", "--labels", "all"});
  for (const double label : file.face_columns({"label_inner"})) EXPECT_EQ(label, 5);
}

INSTANTIATE_TEST_SUITE_P(TurnedAndMirrored, Placed, ::testing::Values(1., -1.));

TEST(Images, ATruncatedOneIsExitCodeThree) {
  const Folder folder;
  write_file(folder / "v.nii", "no image");
  const Outcome outcome = run_dsc({"info", folder / "v.nii"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("v.nii"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace dsc::test
