#include "libdsc/base/error.h"
#include "libdsc/io/read_binary.h"
#include "libdsc/io/read_labels.h"
#include "tests/io/temporary_folder.h"
#include "tests/io/volume_bytes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace dsc {
namespace {

/// The bytes of a value, in memory's order or the other one.
template <class T>
std::string bytes_of(T value, bool swap) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (swap) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// 3 x 4 x 5 voxels, of value 2 x + y + 10 z - 20.
template <class T>
void expect_read(const std::string& type, bool is_signed) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.bin";
  for (const bool big : {false, true}) {
    for (const Index offset : {Index{0}, Index{13}}) {
      std::string bytes(static_cast<std::size_t>(offset), '\x55');
      const auto value = [&](Index x, Index y, Index z) {
        const Index v = 2 * x + y + 10 * z - 20;
        return is_signed ? v : std::max<Index>(0, v);
      };
      for (Index z = 0; z < 5; ++z) {
        for (Index y = 0; y < 4; ++y) {
          for (Index x = 0; x < 3; ++x) bytes += bytes_of(static_cast<T>(value(x, y, z)), big);
        }
      }
      write_all(path, bytes);
      const RawLayout layout{{3, 4, 5}, value_type(type), big, offset};
      const auto read = [&](const VoxelSelection& selection) {
        return read_binary(*open_raw_volume(path, layout), selection);
      };
      const BinaryVolume all = read({}), middle = read({{{-3., 7.5}}, {}}), two = read({{}, {2}});
      for (Index z = 0; z < 5; ++z) {
        for (Index y = 0; y < 4; ++y) {
          for (Index x = 0; x < 3; ++x) {
            const Index v = value(x, y, z);
            ASSERT_EQ(all(x, y, z), v != 0) << type;
            ASSERT_EQ(middle(x, y, z), v >= -3 && v <= 7) << type;
            ASSERT_EQ(two(x, y, z), v == 2) << type;
          }
        }
      }
    }
  }
}

TEST(RawReader, ReadsEveryTypeInEitherByteOrderBehindAnOffset) {
  expect_read<std::uint8_t>("u8", false);
  expect_read<std::int8_t>("i8", true);
  expect_read<std::uint16_t>("u16", false);
  expect_read<std::int16_t>("i16", true);
  expect_read<std::uint32_t>("u32", false);
  expect_read<std::int32_t>("i32", true);
  expect_read<std::uint64_t>("u64", false);
  expect_read<std::int64_t>("i64", true);
  expect_read<float>("f32", true);
  expect_read<double>("f64", true);
}

TEST(RawReader, AnotherLengthIsRefusedWithBothNumbers) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.raw";
  const RawLayout layout{{3, 4, 5}, value_type("u16"), false, 7};
  for (const int bytes : {0, 6, 126, 128}) {
    write_all(path, std::string(static_cast<std::size_t>(bytes), 'x'));
    expect_input_error([&] { (void)open_raw_volume(path, layout); },
                       {path, "120 bytes", std::to_string(std::max(0, bytes - 7)) + " after"});
  }
  write_all(path, std::string(127, 'x'));
  EXPECT_NO_THROW((void)open_raw_volume(path, layout));
}

TEST(RawReader, WhatIsNoLayoutIsRefused) {
  for (const char* name : {"", "u", "u7", "f8", "f16", "x8", "u08", "u128", "uint8"}) {
    EXPECT_THROW((void)value_type(name), UsageError) << name;
  }
  const TemporaryFolder folder;
  write_all(folder / "v.raw", "x");
  EXPECT_THROW((void)open_raw_volume(folder / "v.raw", RawLayout{{1, 0, 1}, {}, false, 0}),
               UsageError);
  const Index huge = Index{1} << 31;
  EXPECT_THROW((void)open_raw_volume(folder / "v.raw", RawLayout{{huge, huge, huge}, {}, false, 0}),
               LimitError);
  EXPECT_THROW((void)open_volume(folder / "v.raw"), UsageError);
}

TEST(FloatValues, SelectExactlyAndNaNIsNeverInside) {
  const TemporaryFolder folder;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<double> values = {0, -0., nan, 0.5, 1, 1.5, -2, kInfinity, 1e300, 0x1p53};
  std::string bytes;
  for (const double v : values) bytes += bytes_of(v, false);
  write_all(folder / "v.raw", bytes);
  const auto inside = [&](const VoxelSelection& selection) {
    const RawLayout layout{{static_cast<Index>(values.size()), 1, 1}, value_type("f64"), false, 0};
    const auto volume = read_binary(*open_raw_volume(folder / "v.raw", layout), selection);
    std::vector<int> found;
    for (Index x = 0; x < volume.grid().size[0]; ++x) {
      if (volume(x, 0, 0)) found.push_back(static_cast<int>(x));
    }
    return found;
  };
  using Indices = std::vector<int>;
  EXPECT_EQ(inside({}), (Indices{3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(inside({{{0.5, 1.}}, {}}), (Indices{3, 4}));
  EXPECT_EQ(inside({{{-kInfinity, kInfinity}}, {}}), (Indices{0, 1, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(inside({{}, {1}}), (Indices{4}));
  EXPECT_EQ(inside({{}, {0, -2}}), (Indices{0, 1, 6}));
  // 2^53 + 1 is no double.
  EXPECT_EQ(inside({{}, {(std::int64_t{1} << 53) + 1}}), Indices{});
  EXPECT_EQ(inside({{}, {std::int64_t{1} << 53}}), (Indices{9}));
}

TEST(FloatValues, AreLabelsWhereTheyAreWhole) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.raw";
  const RawLayout layout{{2, 2, 1}, value_type("f32"), false, 0};
  const auto write = [&](float last) {
    write_all(path, bytes_of(0.F, false) + bytes_of(7.F, false) + bytes_of(1.F, false) +
                        bytes_of(last, false));
  };
  write(16777216.F);
  const LabelVolume labels = read_labels(*open_raw_volume(path, layout));
  EXPECT_EQ(labels.labels(), (std::vector<Label>{1, 7, 16777216}));
  for (const float bad : {0.5F, -1.F, 4294967296.F, std::numeric_limits<float>::quiet_NaN()}) {
    write(bad);
    expect_input_error([&] { (void)read_labels(*open_raw_volume(path, layout)); }, {"(1, 1, 0)"});
  }
}

}  // namespace
}  // namespace dsc
