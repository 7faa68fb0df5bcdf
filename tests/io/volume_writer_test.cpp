#include "libdsc/io/volume_writer.h"

#include "libdsc/base/error.h"
#include "libdsc/io/read_binary.h"
#include "libdsc/io/read_labels.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"
#include "tests/io/temporary_folder.h"
#include "tests/io/volume_bytes.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <bit>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace dsc {
namespace {

TEST(VolumeWriter, EveryFormatReadsBackAsTheSameVoxels) {
  const TemporaryFolder folder;
  const BinaryVolume volume = digitize(Torus(), {0.05, 0.04, 0.06});
  for (const char* name : {"v.vol", "v.longvol", "v.npy"}) {
    for (const bool compress : {true, false}) {
      SCOPED_TRACE(name);
      const std::string path = folder / name;
      write_volume(path, volume, {compress});
      const BinaryVolume back = read_binary(path);
      ASSERT_EQ(back.grid().size, volume.grid().size);
      if (std::string(name) != "v.npy") {
        EXPECT_EQ(back.grid().spacing, volume.grid().spacing);
      }
      EXPECT_EQ(back.count(), volume.count());
      for (Index z = 0; z < volume.grid().size[2]; ++z) {
        for (Index y = 0; y < volume.grid().size[1]; ++y) {
          for (Index w = 0; w < volume.words_per_row(); ++w) {
            ASSERT_EQ(back.word(w, y, z), volume.word(w, y, z));
          }
        }
      }
    }
  }
}

TEST(VolumeWriter, RawFilesHaveTheBytesOfTheFormat) {
  const TemporaryFolder folder;
  Grid grid;
  grid.size = {3, 1, 2};
  const std::vector<std::uint8_t> values = {0, 1, 2, 253, 254, 255};
  write_volume(folder / "v.vol", grid, std::span(values), {false});
  const std::string vol = read_all(folder / "v.vol");
  EXPECT_EQ(vol.substr(vol.find("\n.\n") + 3), std::string("\0\1\2\xfd\xfe\xff", 6));
  for (const char* line : {"X: 3\n", "Y: 1\n", "Z: 2\n", "Version: 2\n", "Voxel-Size: 1\n"}) {
    EXPECT_NE(vol.find(line), std::string::npos) << line;
  }
  write_volume(folder / "v.longvol", grid, std::span(values), {false});
  const std::string longvol = read_all(folder / "v.longvol");
  EXPECT_EQ(longvol.substr(longvol.find("\n.\n") + 3 + 24),
            little_endian(253, 8) + little_endian(254, 8) + little_endian(255, 8));
  write_volume(folder / "v.npy", grid, std::span(values), {false});
  const std::string npy = read_all(folder / "v.npy");
  EXPECT_EQ(npy.substr(0, 8), std::string("\x93NUMPY\1\0", 8));
  EXPECT_NE(npy.find("'shape': (2, 1, 3)"), std::string::npos);
  EXPECT_EQ((npy.size() - 6) % 64, 0u);
  EXPECT_EQ(npy[npy.size() - 7], '\n');
}

template <class T>
void expect_typed_roundtrip(const std::string& path, const std::vector<T>& values) {
  Grid grid;
  grid.size = {2, 2, 1};
  write_volume(path, grid, std::span(values));
  const auto source = open_volume(path);
  bool seen = false;
  source->read([&](const Slab& slab) {
    const auto* back = std::get_if<std::span<const T>>(&slab.values);
    ASSERT_NE(back, nullptr);
    EXPECT_EQ(std::vector<T>(back->begin(), back->end()), values);
    seen = true;
  });
  EXPECT_TRUE(seen);
}

TEST(VolumeWriter, NpyKeepsTheTypeOfTheValues) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.npy";
  expect_typed_roundtrip<std::uint8_t>(path, {0, 1, 2, 255});
  expect_typed_roundtrip<std::int8_t>(path, {0, 1, -128, 127});
  expect_typed_roundtrip<std::uint16_t>(path, {0, 1, 2, 65535});
  expect_typed_roundtrip<std::int16_t>(path, {0, 1, -32768, 32767});
  expect_typed_roundtrip<std::uint32_t>(path, {0, 1, 2, 4294967295u});
  expect_typed_roundtrip<std::int32_t>(path, {0, 1, -5, 2000000000});
  expect_typed_roundtrip<std::uint64_t>(path, {0, 1, 2, ~0ull});
  expect_typed_roundtrip<std::int64_t>(path, {0, 1, -2, INT64_MIN});
}

/// The bytes of all values of a volume that are of type T.
template <class T>
std::vector<T> typed_values(VolumeSource& source) {
  std::vector<T> all;
  source.read([&](const Slab& slab) {
    const auto values = std::get<std::span<const T>>(slab.values);
    all.insert(all.end(), values.begin(), values.end());
  });
  return all;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// Written, read and written again: the same values, to the last bit, and the same file.
template <class T>
void expect_vti_keeps(const TemporaryFolder& folder, const std::vector<T>& values,
                      const VolumeWriteOptions& options = {}, const Vec3& spacing = Vec3::Ones()) {
  const Grid grid{{std::ssize(values) / 2, 1, 2}, spacing, Vec3::Zero()};
  write_volume(folder / "a.vti", grid, std::span(values), options);
  const auto source = open_volume(folder / "a.vti");
  VolumeWriteOptions again = options;
  again.world = source->world();
  const std::vector<T> back = typed_values<T>(*source);
  EXPECT_TRUE(same_bits(back, values));
  write_volume(folder / "b.vti", source->grid(), std::span(back), again);
  EXPECT_EQ(read_all(folder / "a.vti"), read_all(folder / "b.vti"));
}

/// The ends of the type and what is at 0; of floats also what is no number, with any bits.
template <class T>
std::vector<T> ends_of() {
  using Limits = std::numeric_limits<T>;
  std::vector<T> ends = {0, 1, Limits::min(), Limits::lowest(), Limits::max(), Limits::max() / 3};
  if constexpr (Limits::is_iec559) {
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    const auto quiet = std::bit_cast<Bits>(Limits::quiet_NaN());
    ends.insert(ends.end(), {-T{0}, Limits::infinity(), -Limits::infinity(), Limits::denorm_min(),
                             Limits::quiet_NaN(), -Limits::quiet_NaN(),
                             std::bit_cast<T>(quiet | Bits{12345}), T{1} / 3});
  }
  return ends;
}

template <class... Types>
void expect_vti_keeps_all(const TemporaryFolder& folder) {
  for (const bool compress : {false, true}) {
    (expect_vti_keeps(folder, ends_of<Types>(), {.compress = compress}), ...);
  }
}

TEST(VolumeWriter, VtiKeepsEveryBitOfEveryType) {
  expect_vti_keeps_all<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                       std::int32_t, std::uint64_t, std::int64_t, float, double>(TemporaryFolder());
}

TEST(VolumeWriter, VtiKeepsEveryBitOfItsPlace) {
  const TemporaryFolder folder;
  for (int i = 0; i < 100; ++i) {
    VolumeWriteOptions options;
    RigidMap& world = options.world;
    world.rotation = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    if (i % 3 == 1) world.rotation.col(i % 2) *= -1.;  // mirrors
    if (i % 3 == 2) world.rotation *= Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    world.translation = Vec3::Random() * std::pow(10., i % 20 - 10);
    const Vec3 spacing = Vec3::Random().cwiseAbs() + Vec3::Constant(1e-9);
    expect_vti_keeps<std::uint8_t>(folder, {1, 2}, options, spacing);
    const auto source = open_volume(folder / "b.vti");
    EXPECT_EQ(source->world().rotation, world.rotation);
    EXPECT_EQ(source->world().translation, world.translation);
    EXPECT_EQ(source->grid().spacing, spacing);
  }
}

TEST(VolumeWriter, LabelsKeepTheirWidthWhereTheFormHasTypes) {
  const TemporaryFolder folder;
  const Grid grid{{3, 2, 2}, {1, 1, 1}, Vec3::Zero()};
  for (const int width : {1, 2, 4}) {
    LabelVolume labels(grid, width);
    for (Index z = 0; z < 2; ++z) {
      for (Index y = 0; y < 2; ++y) {
        for (Index x = 0; x < 3; ++x) {
          labels.set(x, y, z, labels.largest() - static_cast<Label>(x + 3 * (y + 2 * z)));
        }
      }
    }
    for (const char* name : {"v.longvol", "v.npy", "v.vti"}) {
      SCOPED_TRACE(name);
      EXPECT_EQ(write_volume(folder / name, labels), std::vector<std::string>{});
      const LabelVolume back = read_labels(folder / name);
      if (name != std::string("v.longvol")) {
        EXPECT_EQ(back.largest(), labels.largest());
      }
      for (Index z = 0; z < 2; ++z) {
        for (Index y = 0; y < 2; ++y) {
          for (Index x = 0; x < 3; ++x) EXPECT_EQ(back(x, y, z), labels(x, y, z));
        }
      }
    }
    if (width == 1) {
      write_volume(folder / "v.vol", labels);
      EXPECT_EQ(read_labels(folder / "v.vol")(2, 1, 1), 244U);
    } else {
      expect_input_error([&] { write_volume(folder / "w.vol", labels); },
                         {"w.vol", std::to_string(labels.largest()), "(0, 0, 0)"});
    }
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "w.vol"));
}

TEST(VolumeWriter, WhatAFormHasNoRoomForIsReturned) {
  const TemporaryFolder folder;
  const std::string spacing = "the spacing", place = "the place in the world";
  using Names = std::vector<std::string>;
  const auto left_out = [&](const char* name, const Grid& grid, const RigidMap& world) {
    VolumeWriteOptions options;
    options.world = world;
    const std::vector<float> values(static_cast<std::size_t>(grid.voxels()), 1.F);
    const Names of_values = write_volume(folder / name, grid, std::span(values), options);
    EXPECT_EQ(write_volume(folder / name, BinaryVolume(grid), options), of_values);
    EXPECT_EQ(write_volume(folder / name, LabelVolume(grid, 2), options), of_values);
    return of_values;
  };
  const Grid plain{{2, 2, 2}, {1, 1, 1}, Vec3::Zero()};
  Grid spaced = plain, moved = plain;
  spaced.spacing[2] = 2;
  moved.origin[1] = -1;
  RigidMap shifted, turned;
  shifted.translation[0] = 1e-300;
  turned.rotation << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  for (const char* name : {"v.vol", "v.longvol", "v.npy"}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(left_out(name, plain, {}), Names{});
    EXPECT_EQ(left_out(name, spaced, {}), name == std::string("v.npy") ? Names{spacing} : Names{});
    for (const auto& [grid, world] :
         {std::pair{moved, RigidMap{}}, {plain, shifted}, {plain, turned}}) {
      EXPECT_EQ(left_out(name, grid, world), Names{place});
    }
  }
  EXPECT_EQ(left_out("v.vti", spaced, turned), Names{});
}

TEST(VolumeWriter, ValuesThatDoNotFitAreRefusedAndNothingIsWritten) {
  const TemporaryFolder folder;
  Grid grid;
  grid.size = {2, 2, 1};
  const std::vector<std::int32_t> values = {0, 1, 2, 256};
  expect_input_error([&] { write_volume(folder / "v.vol", grid, std::span(values)); },
                     {"v.vol", "256", "(1, 1, 0)", ".npy"});
  const std::vector<std::int64_t> negative = {0, -1, 2, 3};
  expect_input_error([&] { write_volume(folder / "v.longvol", grid, std::span(negative)); },
                     {"-1", "(1, 0, 0)"});
  grid.size = {2, 2, 2};
  EXPECT_THROW(write_volume(folder / "v.npy", grid, std::span(values)), InputError);
  EXPECT_THROW(write_volume(folder / "v.tif", grid, std::span(values)), UsageError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace dsc
