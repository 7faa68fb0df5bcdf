#include "libdsc/io/read_binary.h"
#include "tests/io/temporary_folder.h"
#include "tests/io/volume_bytes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dsc {
namespace {

constexpr Index kX = 70, kY = 4, kZ = 3;

/// The value of voxel (x, y, z), in [-2, 2].
int value_at(Index x, Index y, Index z) {
  return static_cast<int>((x * x + 3 * y + 5 * z * x) % 5) - 2;
}

/// The values of all voxels in C or Fortran order of an array indexed [z][y][x].
std::string array_bytes(int bytes, bool big_endian, bool fortran) {
  std::string out;
  const auto add = [&](Index x, Index y, Index z) {
    std::string word =
        little_endian(static_cast<std::uint64_t>(std::int64_t{value_at(x, y, z)}), bytes);
    if (big_endian) std::reverse(word.begin(), word.end());
    out += word;
  };
  if (fortran) {
    for (Index x = 0; x < kX; ++x)
      for (Index y = 0; y < kY; ++y)
        for (Index z = 0; z < kZ; ++z) add(x, y, z);
  } else {
    for (Index z = 0; z < kZ; ++z)
      for (Index y = 0; y < kY; ++y)
        for (Index x = 0; x < kX; ++x) add(x, y, z);
  }
  return out;
}

TEST(NpyReader, EveryTypeOrderAndVersionGivesTheSameVoxels) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.npy";
  for (const int bytes : {1, 2, 4, 8}) {
    for (const bool is_signed : {true, false}) {
      for (const bool big_endian : {false, true}) {
        for (const bool fortran : {false, true}) {
          for (const int version : {1, 2, 3}) {
            const std::string descr = std::string(bytes == 1   ? "|"
                                                  : big_endian ? ">"
                                                               : "<") +
                                      (is_signed ? "i" : "u") + std::to_string(bytes);
            SCOPED_TRACE(descr + (fortran ? " Fortran" : " C"));
            write_all(path, npy_text(version, dictionary(descr, fortran, "(3, 4, 70)")) +
                                array_bytes(bytes, big_endian, fortran));
            const BinaryVolume all = read_binary(path);
            // Minus one is the largest value of an unsigned type.
            const BinaryVolume one = read_binary(path, {{}, {1}});
            const BinaryVolume low = read_binary(path, {{{-2., 1.}}, {}});
            ASSERT_EQ(all.grid().size, (Index3{kX, kY, kZ}));
            for (Index z = 0; z < kZ; ++z) {
              for (Index y = 0; y < kY; ++y) {
                for (Index x = 0; x < kX; ++x) {
                  const int v = value_at(x, y, z);
                  ASSERT_EQ(all(x, y, z), v != 0);
                  ASSERT_EQ(one(x, y, z), v == 1);
                  ASSERT_EQ(low(x, y, z), is_signed ? v <= 1 : v == 0 || v == 1);
                }
              }
            }
          }
        }
      }
    }
  }
}

TEST(NpyReader, BooleansAreRead) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.npy";
  const std::string bytes("\1\0\0\1\0\1", 6);
  write_all(path, npy_text(1, dictionary("|b1", false, "(1, 2, 3)")) + bytes);
  const BinaryVolume volume = read_binary(path);
  EXPECT_EQ(volume.count(), 3);
  EXPECT_TRUE(volume(0, 0, 0) && volume(0, 1, 0) && volume(2, 1, 0));
}

TEST(NpyReader, DamagedFilesAreRefusedWithThePlace) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.npy";
  const auto expect = [&](const std::string& content, const std::string& part) {
    SCOPED_TRACE(part);
    write_all(path, content);
    expect_input_error([&] { (void)read_binary(path); }, {path, "byte", part});
  };
  const std::string six = "123456";
  const std::string good = dictionary("|u1", false, "(1, 2, 3)");
  write_all(path, npy_text(1, good) + six);
  EXPECT_EQ(read_binary(path).count(), 6);
  expect("", "too short");
  expect("NUMPY not at all", "magic");
  expect(npy_text(4, good) + six, "version 4.0");
  expect(npy_text(1, good).substr(0, 40), "does not fit");
  expect(npy_text(2, good).substr(0, 10) + "\xff\xff" + good, "does not fit");
  expect(npy_text(1, good) + "12345", "truncated");
  expect(npy_text(1, good) + six + "7", "too long");
  expect(npy_text(1, dictionary("<f2", false, "(1, 2, 3)")) + six, "float32");
  expect(npy_text(1, dictionary("<f4", false, "(1, 2, 3)")) + six, "truncated");
  expect(npy_text(1, dictionary("<i3", false, "(1, 2, 3)")) + six, "not supported");
  expect(npy_text(1, dictionary("|i8", false, "(1, 2, 3)")) + six, "not supported");
  expect(npy_text(1, dictionary("|u1", false, "(2, 3)")) + six, "2 dimensions");
  expect(npy_text(1, dictionary("|u1", false, "(1, 0, 3)")), "empty");
  expect(npy_text(1, dictionary("|u1", false, "(1, -2, 3)")) + six, "64-bit integers");
  expect(npy_text(1, "{'descr': '|u1', 'shape': (1, 2, 3)}") + six, "fortran_order");
  expect(npy_text(1, "{'descr': [('a', '<i4')], 'fortran_order': False, 'shape': (1, 2, 3)}") + six,
         "records");
  expect(npy_text(1, "{'descr': '|u1', 'descr': '|u1'}") + six, "twice");
  expect(npy_text(1, "{'descr': '|u1") + six, "no end");
  expect(npy_text(1, "{'colour': 'red'}") + six, "unknown");
  expect(npy_text(1, good + "x") + six, "after the header");
}

TEST(NpyReader, ShapesBeyondCountingOrMemoryAreOutOfLimits) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.npy";
  for (const char* shape : {"(4000000000, 4000000000, 4000000000)", "(1000000, 1000000, 100000)"}) {
    write_all(path, npy_text(1, dictionary("<f8", false, shape)) + "some data");
    expect_error<LimitError>([&] { (void)open_volume(path); }, {path, "byte", "too large"});
  }
}

}  // namespace
}  // namespace dsc
