// Files opened by readers of others: Python's own parsers, and ITK for the voxels. (OpenMesh:
// mesh_reader_test.cpp; CGAL: ../cli/readback_test.cpp.)
#include "libdsc/io/read_labels.h"
#include "libdsc/io/results.h"
#include "libdsc/io/volume_writer.h"
#include "tests/io/python_check.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace dsc {
namespace {

constexpr Index3 kSize{5, 4, 3};

std::vector<std::uint8_t> random_voxels() {
  std::mt19937 random(8);
  std::vector<std::uint8_t> voxels(60);
  for (std::uint8_t& v : voxels) v = static_cast<std::uint8_t>(random());
  return voxels;
}

Grid grid_of(Index3 size) { return {size, {1, 1, 1}, Vec3::Zero()}; }

#ifdef DSC_PYTHON
const char* const kForms = "ply vtp csv off obj stl volumes vti";

/// Every form of a surface and of voxels, and what they hold.
void write_all_forms(const TemporaryFolder& folder) {
  PolygonMesh mesh = test::mixed_mesh();
  std::mt19937_64 random(5);
  std::vector<double> scalar, vector;
  for (Index v = 0; v < mesh.positions.cols(); ++v) scalar.push_back(test::odd_double(random));
  for (std::size_t i = 0; i < 3 * (mesh.offsets.size() - 1); ++i)
    vector.push_back(test::odd_double(random));
  Result result;
  result.mesh = mesh.view();
  result.fields.push_back(scalar_field("heat", FieldOn::vertex, scalar));
  result.fields.push_back({"gradient", {"gx", "gy", "gz"}, FieldOn::face, vector});
  for (const char* ending : {"ply", "vtp", "csv", "off", "obj", "stl"}) {
    (void)write_result(folder / (std::string("s.") + ending), result);
  }
  const std::vector<std::uint8_t> voxels = random_voxels();
  for (const char* name : {"v.vol", "v.longvol", "v.npy"}) {
    write_volume(folder / name, grid_of(kSize), std::span(voxels));
  }
  // As blocks and not, of bytes and of doubles, in a place of its own.
  Grid grid = grid_of(kSize);
  grid.spacing = Vec3(0.1, 0.25, 1. / 3);
  VolumeWriteOptions options;
  options.world.rotation = Eigen::Quaterniond(0.1, -0.7, 0.5, 0.3).normalized().toRotationMatrix();
  options.world.translation = Vec3(1e-3, -1. / 7, 1e5);
  std::vector<double> doubles;
  for (std::size_t i = 0; i < voxels.size(); ++i) doubles.push_back(test::odd_double(random));
  write_volume(folder / "v.vti", grid, std::span(voxels), options);
  options.compress = false;
  write_volume(folder / "w.vti", grid, std::span(doubles), options);
  const auto listed = [](const auto& m) {
    return test::json_list(std::vector<double>(m.data(), m.data() + m.size()));
  };
  const Mat3 rows = options.world.rotation.transpose();  // Eigen counts down the columns
  write_all(
      folder / "truth.json",
      "{\"positions\":" + listed(mesh.positions) + ",\"faces\":" + test::json_faces(mesh.view()) +
          ",\"scalar\":" + test::json_list(scalar) + ",\"vector\":" + test::json_list(vector) +
          ",\"size\":[5,4,3],\"voxels\":" + test::json_integers(voxels) +
          ",\"doubles\":" + test::json_list(doubles) + ",\"spacing\":" + listed(grid.spacing) +
          ",\"origin\":" + listed(options.world.translation) + ",\"direction\":" + listed(rows) +
          "}");
}

TEST(OtherReaders, PythonsOwnParsersFindEveryBit) {
  const TemporaryFolder folder;
  write_all_forms(folder);
  std::string said;
  EXPECT_EQ(test::check_by_python(folder.path(), kForms, &said), 0) << said;
}

/// A single bit changed in any of the files is seen, so the test above can fail.
TEST(OtherReaders, PythonSeesAChangedBit) {
  const TemporaryFolder folder;
  write_all_forms(folder);
  ASSERT_EQ(test::check_by_python(folder.path(), kForms), 0);
  for (const std::string name : {"s.ply", "s.vtp", "s.csv", "s.off", "s.obj", "s.stl", "v.vol",
                                 "v.longvol", "v.npy", "v.vti", "w.vti"}) {
    const std::string bytes = read_all(folder / name);
    std::string changed = bytes;
    if (name == "s.csv" || name == "s.off" || name == "s.obj") {  // a digit
      const std::size_t place = changed.find_first_of("123456789", changed.find('.', 40));
      changed[place] = changed[place] == '7' ? '8' : '7';
    } else if (name == "s.vtp") {  // a digit of base64
      const std::size_t place = changed.find('_', changed.find("<AppendedData")) + 30;
      changed[place] = changed[place] == 'B' ? 'C' : 'B';
    } else if (name.ends_with(".vti")) {
      const std::size_t end = changed.find("\n</AppendedData>");
      changed[end - 2] = static_cast<char>(changed[end - 2] ^ 1);
    } else {
      const std::size_t from_the_end = name == "s.stl" ? 4 : 2;
      changed[changed.size() - from_the_end] =
          static_cast<char>(changed[changed.size() - from_the_end] ^ 1);
    }
    write_all(folder / name, changed);
    std::string said;
    EXPECT_EQ(test::check_by_python(folder.path(), kForms, &said), 1) << name;
    EXPECT_NE(said.find(name.substr(2)), std::string::npos) << name << ": " << said;
    write_all(folder / name, bytes);
  }
  // What .vti says of its place: the last digit of each number.
  const std::string bytes = read_all(folder / "v.vti");
  for (const std::string key : {"Extent", "Origin", "Spacing", "Direction"}) {
    std::string changed = bytes;
    char& digit = changed[changed.find('"', changed.find(" " + key + "=\"") + key.size() + 3) - 1];
    digit = digit == '7' ? '8' : '7';
    write_all(folder / "v.vti", changed);
    EXPECT_EQ(test::check_by_python(folder.path(), kForms), 1) << key;
  }
}
#else
TEST(OtherReaders, PythonsOwnParsersFindEveryBit) { GTEST_SKIP() << "there is no Python here"; }
#endif

/// ITK reads the values of our raw files through a header of its own that says where they begin.
TEST(OtherReaders, ItkFindsEveryVoxel) {
#ifndef DSC_IMAGE_READER
  GTEST_SKIP() << "built without DSC_WITH_ITK";
#else
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> voxels = random_voxels();
  ::setenv("DSC_IMAGE_READER", DSC_IMAGE_READER, 1);
  for (const std::string name : {"v.vol", "v.npy"}) {
    write_volume(folder / name, grid_of(kSize), std::span(voxels), {.compress = false});
    const std::string bytes = read_all(folder / name);
    const std::size_t header = bytes.size() - voxels.size();
    write_all(folder / "v.mhd",
              "ObjectType = Image\nNDims = 3\nDimSize = 5 4 3\nElementType = MET_UCHAR\n"
              "HeaderSize = " +
                  std::to_string(header) + "\nElementDataFile = " + name + "\n");
    const LabelVolume labels = read_labels(folder / "v.mhd");
    ASSERT_EQ(labels.grid().size, kSize) << name;
    std::size_t i = 0;
    for (Index z = 0; z < kSize[2]; ++z) {
      for (Index y = 0; y < kSize[1]; ++y) {
        for (Index x = 0; x < kSize[0]; ++x) ASSERT_EQ(labels(x, y, z), voxels[i++]) << name;
      }
    }
  }
#endif
}

}  // namespace
}  // namespace dsc
