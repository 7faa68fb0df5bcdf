// Files cut at every byte: an error or the whole result, never a part of it. mesh_reader_test.cpp
// has the meshes that libdsc writes; here are volumes, large files, and the two forms of which a
// part can be a whole file.
#include "libdsc/io/mesh_formats.h"
#include "libdsc/io/read_labels.h"
#include "libdsc/io/volume_formats.h"
#include "libdsc/io/volume_writer.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/temporary_folder.h"
#include "tests/io/volume_bytes.h"
#include "tests/support/long_tests.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

namespace dsc {
namespace {

/// Lengths shorter than `size`: all of a small file; else those that end in the first 500 bytes,
/// the last 64, around blocks of 256 KB, and some at random.
std::set<std::size_t> cuts(std::size_t size) {
  std::set<std::size_t> all;
  const std::size_t start = size <= 6000 ? size : 500;
  for (std::size_t n = 0; n < start; ++n) all.insert(n);
  for (std::size_t n = size - std::min<std::size_t>(size, 64); n < size; ++n) all.insert(n);
  for (std::size_t block = 1 << 18; block < size; block += 1 << 18) {
    for (std::size_t n = block - 1; n <= block + 1 && n < size; ++n) all.insert(n);
  }
  std::mt19937 random(7);
  for (int i = 0; size > 0 && i < testing::usually_or_long(60, 3000); ++i)
    all.insert(random() % size);
  return all;
}

using OpenBytes = std::function<std::unique_ptr<VolumeSource>(std::string_view)>;

std::vector<Label> all_labels(VolumeSource& source) {
  const LabelVolume volume = read_labels(source);
  const Index3& size = volume.grid().size;
  std::vector<Label> labels(static_cast<std::size_t>(volume.grid().voxels()));
  for (Index row = 0; row < size[1] * size[2]; ++row) {
    volume.row(row % size[1], row / size[1], labels.data() + row * size[0]);
  }
  return labels;
}

/// Of the last `unused` bytes a file may lack some: it is then read whole.
void expect_all_or_nothing(const std::string& bytes, const OpenBytes& open,
                           std::size_t unused = 0) {
  const std::vector<Label> whole = all_labels(*open(bytes));
  for (const std::size_t n : cuts(bytes.size())) {
    try {
      const std::vector<Label> read = all_labels(*open(std::string_view(bytes).substr(0, n)));
      ASSERT_GE(n + unused, bytes.size()) << "cut at byte " << n << " it is read";
      ASSERT_EQ(read, whole) << n;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("'cut."), std::string::npos) << error.what();
    }
  }
}

/// Values that do not compress well.
std::vector<std::uint8_t> noise(std::size_t count) {
  std::mt19937 random(5);
  std::vector<std::uint8_t> values(count);
  for (std::uint8_t& v : values) v = static_cast<std::uint8_t>(random() % 5 * 50);
  return values;
}

TEST(Truncated, VolumesAreErrors) {
  const auto open_vol = [](std::string_view bytes) {
    return detail::open_vol(InputFile("cut.vol", bytes), false);
  };
  const auto open_longvol = [](std::string_view bytes) {
    return detail::open_vol(InputFile("cut.longvol", bytes), true);
  };
  const auto open_npy = [](std::string_view bytes) {
    return detail::open_npy(InputFile("cut.npy", bytes));
  };
  const auto open_vti = [](std::string_view bytes) {
    return detail::open_vti(InputFile("cut.vti", bytes));
  };
  const TemporaryFolder folder;
  for (const Index3 size : {Index3{3, 4, 5}, Index3{120, 110, 100}}) {
    SCOPED_TRACE(size[0]);
    const Grid grid{size, {0.5, 1, 2}, {0, 0, 0}};
    const std::vector<std::uint8_t> values = noise(static_cast<std::size_t>(grid.voxels()));
    for (const bool compress : {false, true}) {
      for (const std::string name : {"a.vol", "a.longvol", "a.npy", "a.vti"}) {
        SCOPED_TRACE(name + (compress ? " compressed" : ""));
        write_volume(folder / name, grid, std::span(values), {.compress = compress});
        const OpenBytes open = name == "a.vol"   ? OpenBytes(open_vol)
                               : name == "a.npy" ? OpenBytes(open_npy)
                               : name == "a.vti" ? OpenBytes(open_vti)
                                                 : OpenBytes(open_longvol);
        const std::string bytes = read_all(folder / name);
        // After the values of .vti only the ends of its elements come.
        const std::size_t end = name == "a.vti" ? bytes.rfind("\n</AppendedData>") : bytes.size();
        expect_all_or_nothing(bytes, open, bytes.size() - end);
      }
    }
  }
  const std::string eight = "12345678";
  expect_all_or_nothing(npy_text(1, dictionary("<i2", true, "(1, 2, 2)")) + eight, open_npy);
  expect_all_or_nothing(npy_text(2, dictionary(">u4", false, "(2, 1, 1)")) + eight, open_npy);
  expect_all_or_nothing(eight, [](std::string_view bytes) {
    RawLayout layout;
    layout.size = {2, 2, 2};
    return detail::open_raw(InputFile("cut.raw", bytes), layout);
  });
  // vox_reader_test.cpp cuts .vox.
}

TEST(Truncated, RealVolumesAreErrors) {
  const char* data = std::getenv("DSC_TEST_DATA");
  if (data == nullptr) GTEST_SKIP() << "DSC_TEST_DATA is not set";
  for (const std::string name : {"/spot-64.vol", "/spot-128.vol"}) {
    SCOPED_TRACE(name);
    expect_all_or_nothing(read_all(data + name), [](std::string_view bytes) {
      return detail::open_vol(InputFile("cut.vol", bytes), false);
    });
  }
}

PolygonMesh read_bytes(const std::string& name, std::string_view bytes) {
  InputFile file(name, bytes);
  return detail::read_mesh(file, {});
}

/// The number of whole lines' vertices and faces of an .obj text.
std::pair<Index, Index> statements(std::string_view text) {
  std::pair<Index, Index> found{0, 0};
  for (std::size_t at = 0, end = 0; (end = text.find('\n', at)) != std::string_view::npos;) {
    found.first += text[at] == 'v' ? 1 : 0;
    found.second += text[at] == 'f' ? 1 : 0;
    at = end + 1;
  }
  return found;
}

bool says_it_ends_early(const PolygonMesh& mesh) {
  return std::any_of(mesh.remarks.begin(), mesh.remarks.end(), [](const std::string& remark) {
    return remark.find("without a newline") != std::string::npos;
  });
}

/// An .obj file says nowhere how much it holds: cut after a line it is the file of those lines. Cut
/// inside a line it is an error, or ends on a number, which a remark tells.
TEST(Truncated, ObjOfOthersHoldsItsWholeLinesAndTellsOfANumberAtItsEnd) {
  const std::string text = "v 0 0 0\nv 10 0 0\nv 11 12 0\nv 0 1 1.5e1\nf 1 2 3\nf 1 3 4\n";
  std::size_t refused = 0, told = 0, whole_lines = 0;
  for (std::size_t n = 0; n <= text.size(); ++n) {
    SCOPED_TRACE(n);
    const std::string_view part = std::string_view(text).substr(0, n);
    try {
      const PolygonMesh mesh = read_bytes("cut.obj", part);
      const auto [vertices, faces] = statements(part);
      const bool begun = !part.ends_with('\n');
      const Index all = mesh.positions.cols() + std::ssize(mesh.offsets) - 1;
      if (says_it_ends_early(mesh)) {
        ++told;
        EXPECT_TRUE(begun);
        EXPECT_EQ(all, vertices + faces + 1);
      } else {
        ++whole_lines;
        EXPECT_EQ(all, vertices + faces) << "a line was lost or made up";
      }
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GE(whole_lines, 6U);
  EXPECT_GE(told, 6U);
  EXPECT_GE(refused, 20U);
}

/// A text .stl file may hold several solids: cut between two it is the file of the first. Anywhere
/// else it is an error.
TEST(Truncated, TextStlIsWholeAfterAnEndsolidOnly) {
  std::string text;
  std::set<std::size_t> ends;
  for (const std::string z : {"0", "1"}) {
    text += "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 " + z + "\nvertex 1 0 " + z +
            "\nvertex 0 1 " + z + "\nendloop\nendfacet\nendsolid";
    ends.insert(text.size());
    text += "\n";
    ends.insert(text.size());
  }
  for (std::size_t n = 0; n <= text.size(); ++n) {
    const auto read = [&] { return read_bytes("cut.stl", std::string_view(text).substr(0, n)); };
    if (ends.contains(n)) {
      EXPECT_EQ(std::ssize(read().offsets) - 1, n < text.size() - 1 ? 1 : 2);
    } else {
      EXPECT_THROW((void)read(), InputError) << n;
    }
  }
}

TEST(Truncated, LargeMeshesAreErrors) {
  const TemporaryFolder folder;
  const PolygonMesh mesh = test::float_triangles(100);
  for (const std::string ending : {".off", ".obj", ".ply", ".stl", ".om"}) {
    SCOPED_TRACE(ending);
    write_result(folder / ("a" + ending), mesh.result());
    const std::string bytes = read_all(folder / ("a" + ending));
    ASSERT_GT(bytes.size(), std::size_t{1} << 18) << "several blocks";
    for (const std::size_t n : cuts(bytes.size())) {
      try {
        const PolygonMesh part = read_bytes("cut" + ending, std::string_view(bytes).substr(0, n));
        EXPECT_EQ(part.positions, mesh.positions) << n;
        // The last number of .off lost digits, or all of it was there.
        EXPECT_TRUE(ending == ".off" && says_it_ends_early(part) && n + 6 >= bytes.size()) << n;
      } catch (const InputError&) {
      }
    }
  }
}

}  // namespace
}  // namespace dsc
