#include "libdsc/io/read_binary.h"
#include "libdsc/io/read_labels.h"
#include "tests/io/temporary_folder.h"
#include "tests/io/volume_bytes.h"

#include <gtest/gtest.h>

namespace dsc {
namespace {

std::string number(std::size_t value) { return little_endian(value, 4); }
std::string chunk(const std::string& name, const std::string& content,
                  const std::string& children = "") {
  return name + number(content.size()) + number(children.size()) + content + children;
}
std::string size_chunk(std::size_t x, std::size_t y, std::size_t z) {
  return chunk("SIZE", number(x) + number(y) + number(z));
}
std::string voxels_chunk(const std::vector<std::string>& voxels) {
  std::string list;
  for (const std::string& v : voxels) list += v;
  return chunk("XYZI", number(voxels.size()) + list);
}
std::string file(const std::string& chunks) {
  return "VOX " + number(150) + chunk("MAIN", "", chunks);
}

const std::vector<std::string> kVoxels = {{1, 2, 3, 9}, {0, 0, 0, 1}, {3, 4, 5, '\xff'}};

TEST(VoxReader, AModelKeepsItsColoursAsLabels) {
  const TemporaryFolder folder;
  const std::string path = folder / "m.vox";
  write_all(path, file(size_chunk(4, 5, 6) + voxels_chunk(kVoxels) +
                       chunk("RGBA", std::string(1024, 'c')) + chunk("nTRN", "xyz", "children")));
  const LabelVolume labels = read_labels(path);
  EXPECT_EQ(labels.grid().size, (Index3{4, 5, 6}));
  EXPECT_EQ(labels.count(), 3);
  EXPECT_EQ(labels(1, 2, 3), 9U);
  EXPECT_EQ(labels(0, 0, 0), 1U);
  EXPECT_EQ(labels(3, 4, 5), 255U);
  EXPECT_EQ(read_binary(path, {{}, {9}}).count(), 1);
}

TEST(VoxReader, DamagedFilesAreRefusedWithThePlace) {
  const TemporaryFolder folder;
  const std::string path = folder / "m.vox";
  const auto expect = [&](const std::string& content, const std::string& part) {
    SCOPED_TRACE(part);
    write_all(path, content);
    expect_input_error([&] { (void)read_labels(path); }, {path, "byte", part});
  };
  const std::string size = size_chunk(4, 5, 6), voxels = voxels_chunk(kVoxels);
  const std::string good = file(size + voxels);
  for (std::size_t n = 0; n < good.size(); ++n) {
    write_all(path, good.substr(0, n));
    EXPECT_THROW((void)read_labels(path), InputError) << n;
  }
  expect(good + "x", "too long");
  expect("VIX " + good.substr(4), "magic");
  expect(file(""), "0 models");
  expect(file(size), "XYZI is missing");
  expect(file(voxels), "before any SIZE");
  expect(file(size + voxels + size + voxels), "2 models");
  expect(file(size + voxels + voxels), "second");
  expect(file(size_chunk(4, 0, 6) + voxels), "from 1 to 256");
  expect(file(size_chunk(4, 5, 257) + voxels), "from 1 to 256");
  expect(file(chunk("SIZE", "12345678") + voxels), "12 bytes");
  expect(file(size_chunk(4, 5, 5) + voxels), "outside of SIZE");
  expect(file(size + voxels_chunk({{1, 2, 3, 0}})), "colour 0");
  expect(file(size + voxels_chunk({{1, 2, 3, 4}, {1, 2, 3, 5}})), "there before");
  expect(file(size + chunk("XYZI", number(2) + "abcd")), "promises 2");
}

}  // namespace
}  // namespace dsc
