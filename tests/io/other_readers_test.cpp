// Files opened by readers of others: Python's own parsers, and ITK for the voxels. (OpenMesh:
// mesh_reader_test.cpp; CGAL: ../cli/readback_test.cpp.)
#include "libdsc/io/read_labels.h"
#include "libdsc/io/results.h"
#include "libdsc/io/volume_writer.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace dsc {
namespace {

std::string hexadecimal(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}

template <class Values, class Text>
std::string json_list(const Values& values, const Text& text) {
  std::string list;
  for (const auto& value : values) list += (list.empty() ? "[" : ",") + text(value);
  return list + "]";
}
std::string json_list(const std::vector<double>& values) {
  return json_list(values, [](double v) { return '"' + hexadecimal(v) + '"'; });
}

constexpr Index3 kSize{5, 4, 3};

std::vector<std::uint8_t> random_voxels() {
  std::mt19937 random(8);
  std::vector<std::uint8_t> voxels(60);
  for (std::uint8_t& v : voxels) v = static_cast<std::uint8_t>(random());
  return voxels;
}

Grid grid_of(Index3 size) { return {size, {1, 1, 1}, Vec3::Zero()}; }

#ifdef DSC_PYTHON
int check_by_python(const std::string& folder, std::string* said = nullptr) {
  const std::string command =
      std::string(DSC_PYTHON " " DSC_READ_RESULTS " '") + folder + "' > '" + folder + "/said' 2>&1";
  const int status = std::system(command.c_str());
  if (said != nullptr) *said = read_all(folder + "/said");
  return WEXITSTATUS(status);
}

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
  std::string faces;
  for (Index f = 0; f < mesh.view().faces(); ++f) {
    faces += (f == 0 ? "" : ",") +
             json_list(mesh.view().face(f), [](VertexId v) { return std::to_string(v); });
  }
  const double* p = mesh.positions.data();
  write_all(folder / "truth.json",
            "{\"positions\":" + json_list(std::vector<double>(p, p + mesh.positions.size())) +
                ",\"faces\":[" + faces + "],\"scalar\":" + json_list(scalar) +
                ",\"vector\":" + json_list(vector) + ",\"size\":[5,4,3],\"voxels\":" +
                json_list(voxels, [](int v) { return std::to_string(v); }) + "}");
}

TEST(OtherReaders, PythonsOwnParsersFindEveryBit) {
  const TemporaryFolder folder;
  write_all_forms(folder);
  std::string said;
  EXPECT_EQ(check_by_python(folder.path(), &said), 0) << said;
}

/// A single bit changed in any of the files is seen, so the test above can fail.
TEST(OtherReaders, PythonSeesAChangedBit) {
  const TemporaryFolder folder;
  write_all_forms(folder);
  ASSERT_EQ(check_by_python(folder.path()), 0);
  for (const std::string name :
       {"s.ply", "s.vtp", "s.csv", "s.off", "s.obj", "s.stl", "v.vol", "v.longvol", "v.npy"}) {
    const std::string bytes = read_all(folder / name);
    std::string changed = bytes;
    if (name == "s.csv" || name == "s.off" || name == "s.obj") {  // a digit
      const std::size_t place = changed.find_first_of("123456789", changed.find('.', 40));
      changed[place] = changed[place] == '7' ? '8' : '7';
    } else if (name == "s.vtp") {  // a digit of base64
      const std::size_t place = changed.find('_', changed.find("<AppendedData")) + 30;
      changed[place] = changed[place] == 'B' ? 'C' : 'B';
    } else {
      const std::size_t from_the_end = name == "s.stl" ? 4 : 2;
      changed[changed.size() - from_the_end] =
          static_cast<char>(changed[changed.size() - from_the_end] ^ 1);
    }
    write_all(folder / name, changed);
    std::string said;
    EXPECT_EQ(check_by_python(folder.path(), &said), 1) << name;
    EXPECT_NE(said.find(name.substr(2)), std::string::npos) << name << ": " << said;
    write_all(folder / name, bytes);
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
