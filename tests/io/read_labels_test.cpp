#include "libdsc/io/read_labels.h"

#include "libdsc/io/volume_writer.h"
#include "tests/io/temporary_folder.h"
#include "tests/io/volume_bytes.h"

#include <gtest/gtest.h>

#include <random>

namespace dsc {
namespace {

/// A .npy file of 3 x 4 x 5 (x, y, z) values that are distinct, and zeros.
template <class T>
void expect_labels_of_type(const std::string& descr, T largest) {
  const TemporaryFolder folder;
  for (const bool fortran : {false, true}) {
    std::vector<T> values(60);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<T>(i % 7 == 0 ? 0 : i);
    values[17] = largest;
    std::string bytes;
    for (const T v : values) bytes += little_endian(static_cast<std::uint64_t>(v), sizeof(T));
    const std::string path = folder / "labels.npy";
    write_all(path, npy_text(1, dictionary(descr, fortran, "(5, 4, 3)")) + bytes);
    const LabelVolume volume = read_labels(path);
    EXPECT_EQ(volume.grid().size, (Index3{3, 4, 5}));
    EXPECT_EQ(volume.memory_bytes(), 60 * std::min<std::size_t>(4, sizeof(T)));
    for (Index z = 0; z < 5; ++z) {
      for (Index y = 0; y < 4; ++y) {
        for (Index x = 0; x < 3; ++x) {
          const Index i = fortran ? z + 5 * (y + 4 * x) : x + 3 * (y + 4 * z);
          EXPECT_EQ(volume(x, y, z), values[static_cast<std::size_t>(i)]) << descr;
        }
      }
    }
  }
}

TEST(ReadLabels, KeepsEveryValueOfEveryWidth) {
  expect_labels_of_type<std::uint8_t>("|u1", 255);
  expect_labels_of_type<std::int8_t>("|i1", 127);
  expect_labels_of_type<std::uint16_t>("<u2", 65535);
  expect_labels_of_type<std::int16_t>("<i2", 32767);
  expect_labels_of_type<std::uint32_t>("<u4", 4294967295U);
  expect_labels_of_type<std::int32_t>("<i4", 2147483647);
  expect_labels_of_type<std::uint64_t>("<u8", 4294967295U);
  expect_labels_of_type<std::int64_t>("<i8", 4294967295);
}

TEST(ReadLabels, WhatIsNoLabelIsRefusedWithItsVoxel) {
  const TemporaryFolder folder;
  const std::string path = folder / "labels.npy";
  for (const bool fortran : {false, true}) {
    const std::string descr = dictionary("<i8", fortran, "(5, 4, 3)");
    for (const std::int64_t bad : {std::int64_t{-1}, std::int64_t{4294967296}}) {
      std::string bytes;
      for (int i = 0; i < 60; ++i) {
        // Two of them: (2, 1, 3) comes first in either order.
        const bool here = i == (fortran ? 3 + 5 * (1 + 4 * 2) : 2 + 3 * (1 + 4 * 3)) || i == 59;
        bytes += little_endian(static_cast<std::uint64_t>(here ? bad : i), 8);
      }
      write_all(path, npy_text(1, descr) + bytes);
      expect_input_error([&] { (void)read_labels(path); },
                         {"(2, 1, 3)", std::to_string(bad), "4294967295", path});
    }
  }
}

TEST(ReadLabels, ALargeVolumeOfManySlabsComesBack) {
  const TemporaryFolder folder;
  const Grid grid{{300, 200, 150}, {1, 1, 1}, Vec3::Zero()};
  std::vector<std::uint16_t> values(static_cast<std::size_t>(grid.voxels()));
  std::mt19937 random(7);
  for (auto& v : values) v = static_cast<std::uint16_t>(random());
  write_volume(folder / "v.npy", grid, std::span<const std::uint16_t>(values));
  const LabelVolume volume = read_labels(folder / "v.npy");
  Index different = 0;
  for (Index i = 0; i < grid.voxels(); ++i) {
    const Label here = volume(i % 300, i / 300 % 200, i / 60000);
    different += here != values[static_cast<std::size_t>(i)] ? 1 : 0;
  }
  EXPECT_EQ(different, 0);
}

}  // namespace
}  // namespace dsc
