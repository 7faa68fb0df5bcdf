#include "libdsc/io/read_binary.h"
#include "tests/io/temporary_folder.h"
#include "tests/io/volume_bytes.h"

#include <gtest/gtest.h>

namespace dsc {
namespace {

/// Bytes with no pattern that a wrong order of the axes would keep.
std::string some_bytes(Index count) {
  std::string bytes;
  std::uint32_t state = 12345;
  for (Index i = 0; i < count; ++i) {
    state = state * 1664525u + 1013904223u;
    bytes += static_cast<char>((state >> 24) % 3);
  }
  return bytes;
}

void expect_voxels(const BinaryVolume& volume, const std::string& bytes, Index X, Index Y,
                   Index Z) {
  ASSERT_EQ(volume.grid().size, (Index3{X, Y, Z}));
  std::size_t i = 0;
  for (Index z = 0; z < Z; ++z) {
    for (Index y = 0; y < Y; ++y) {
      for (Index x = 0; x < X; ++x) ASSERT_EQ(volume(x, y, z), bytes[i++] != 0) << x << y << z;
    }
  }
}

TEST(VolReader, RawAndCompressedVoxelsLieXFastest) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vol";
  for (const Index X : {1, 62, 63, 64, 65, 127, 200}) {
    const std::string bytes = some_bytes(X * 5 * 3);
    write_all(path, vol_text(X, 5, 3, 2) + bytes);
    expect_voxels(read_binary(path), bytes, X, 5, 3);
    write_all(path, vol_text(X, 5, 3, 3) + deflated(bytes));
    expect_voxels(read_binary(path), bytes, X, 5, 3);
  }
}

TEST(VolReader, SlabsOfSeveralMegabytesJoin) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vol";
  const std::string bytes = some_bytes(300 * 200 * 75);
  write_all(path, vol_text(300, 200, 75, 3) + deflated(bytes));
  expect_voxels(read_binary(path), bytes, 300, 200, 75);
}

TEST(VolReader, LongvolWordsHaveEightBytes) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.longvol";
  const std::uint64_t values[] = {0, 1, 1ull << 40, 1ull << 63, 0, 7};
  std::string bytes;
  for (const std::uint64_t v : values) bytes += little_endian(v, 8);
  const std::string header =
      "X: 3\nY: 2\nZ: 1\nLvoxel-Size: 4\nAlpha-Color: 0\nLvoxel-Endian: 0\nInt-Endian: 0123\n";
  for (const bool zlib : {false, true}) {
    write_all(path, header + "Version: " + (zlib ? "3" : "2") + "\n.\n" +
                        (zlib ? deflated(bytes) : bytes));
    EXPECT_EQ(read_binary(path).count(), 4);
    EXPECT_EQ(read_binary(path, {{}, {std::int64_t{1} << 40}}).count(), 1);
    EXPECT_EQ(read_binary(path, {{{9.2e18, 1e30}}, {}}).count(), 1);  // 2^63 alone
  }
}

TEST(VolReader, SpacingIsOneUnlessItsKeysSayOtherwise) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vol";
  write_all(path, vol_text("X: 1\nY: 1\nZ: 1\n", "2") + "\1");
  EXPECT_EQ(open_volume(path)->grid().spacing, Vec3(1, 1, 1));
  EXPECT_EQ(open_volume(path)->grid().origin, Vec3(0, 0, 0));
  write_all(path,
            vol_text("X: 1\nY: 1\nZ: 1\nSpacing-X: 0.5\nSpacing-Y: 1\nSpacing-Z: 5\n", "2") + "\1");
  EXPECT_EQ(open_volume(path)->grid().spacing, Vec3(0.5, 1, 5));
}

TEST(VolReader, DamagedHeadersAreRefusedWithThePlace) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vol";
  const auto expect = [&](const std::string& bytes, const std::vector<std::string>& parts) {
    SCOPED_TRACE(bytes.substr(0, 60));
    write_all(path, bytes);
    std::vector<std::string> all = parts;
    all.push_back(path);
    expect_input_error([&] { (void)open_volume(path); }, all);
  };
  expect("", {"byte 0"});
  expect("X: 1\nY: 1\n", {"byte 10", "dot"});
  expect(std::string(100000, 'a'), {"byte 0"});
  expect("\x93NUMPY garbage\n.\n", {"byte 0", "Key: value"});
  expect(vol_text("X: 1\nY: 1\n", "2") + "\1", {"lacks the key Z"});
  expect(vol_text("X: 1\nX: 1\nY: 1\nZ: 1\n", "2") + "\1", {"byte 5", "twice"});
  expect(vol_text("X: 1\nY: 0\nZ: 1\n", "2"), {"byte 5", "positive"});
  expect(vol_text("X: 1\nY: -3\nZ: 1\n", "2"), {"byte 5", "positive"});
  expect(vol_text("X: 1\nY: 2a\nZ: 1\n", "2"), {"byte 5", "'2a'"});
  expect(vol_text("X: 99999999999999999999\nY: 1\nZ: 1\n", "2"), {"byte 0", "64-bit"});
  expect(vol_text("X: 1\nY: 1\nZ: 1\n", "4") + "\1", {"Version 4", "2 (raw) and 3 (zlib)"});
  expect("X: 1\nY: 1\nZ: 1\n.\n\1", {"Version", "version 2 or 3"});
  expect("X: 1\nY: 1\nZ: 1\nVoxel-Size: 2\nVersion: 2\n.\n\1", {"Voxel-Size", "longvol"});
  expect(vol_text("X: 1\nY: 1\nZ: 1\nSpacing-X: nan\n", "2") + "\1", {"Spacing-X"});
  expect(vol_text("X: 1\nY: 1\nZ: 1\nSpacing-X: 0\n", "2") + "\1", {"Spacing-X"});
}

TEST(VolReader, SizesBeyondCountingOrMemoryAreOutOfLimits) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vol";
  const std::string uncountable = "X: 4000000000\nY: 4000000000\nZ: 4000000000\n";
  const std::string petabytes = "X: 1000000\nY: 1000000\nZ: 100000\n";
  for (const std::string version : {"2", "3"}) {
    for (const std::string& sizes : {uncountable, petabytes}) {
      write_all(path, vol_text(sizes, version) + "some data");
      expect_error<LimitError>([&] { (void)open_volume(path); }, {path, "byte 0", "too large"});
    }
  }
}

/// Behind the volume, megabytes of zeros and then damage, which nobody sees who stops in time.
TEST(VolReader, InflationStopsAtTheDeclaredSize) {
  const TemporaryFolder folder;
  for (const auto& [name, width] : {std::pair<const char*, Index>{"v.vol", 1}, {"v.longvol", 8}}) {
    std::string packed = deflated(some_bytes(10 * 20 * 30 * width) + std::string(64 << 20, '\0'));
    for (std::size_t i = packed.size() / 2; i < packed.size(); ++i) packed[i] = '\xff';
    write_all(folder / name, vol_text(10, 20, 30, 3) + packed);
    expect_input_error([&] { (void)read_binary(folder / name); },
                       {name, "goes on after the volume is full"});
  }
}

TEST(VolReader, DataOfAnotherLengthIsRefused) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vol";
  const std::string bytes = some_bytes(10 * 20 * 30);
  const std::string packed = deflated(bytes);
  const auto expect = [&](const std::string& content, const std::string& part) {
    SCOPED_TRACE(part);
    write_all(path, content);
    expect_input_error([&] { (void)read_binary(path); }, {path, "byte", part});
  };
  expect(vol_text(10, 20, 30, 2) + bytes.substr(1), "truncated");
  expect(vol_text(10, 20, 30, 2) + bytes + "x", "too long");
  expect(vol_text(10, 20, 30, 3) + packed.substr(0, packed.size() - 1), "truncated");
  expect(vol_text(10, 20, 30, 3) + packed.substr(0, packed.size() / 2), "truncated");
  expect(vol_text(10, 20, 30, 3) + packed + "x", "goes on after the end");
  expect(vol_text(10, 20, 31, 3) + packed, "200 bytes before the volume is full");
  expect(vol_text(10, 20, 29, 3) + packed, "goes on after the volume is full");
  // Gigabytes in a kilobyte: refused before anything is allocated.
  expect(vol_text(10000, 10000, 100, 3) + packed, "more than the file's");
  std::string damaged = packed;
  damaged[packed.size() - 2] = static_cast<char>(damaged[packed.size() - 2] ^ 1);  // the checksum
  expect(vol_text(10, 20, 30, 3) + damaged, "damaged");
  damaged = packed;
  damaged[0] = 'x';
  damaged[1] = 'y';
  expect(vol_text(10, 20, 30, 3) + damaged, "damaged");
}

TEST(VolReader, WhatIsNoFileIsRefused) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.vol");
  expect_input_error([&] { (void)open_volume(folder / "none.vol"); }, {"none.vol", "No such file"});
  expect_input_error([&] { (void)open_volume(folder / "folder.vol"); }, {"no regular file"});
  EXPECT_THROW((void)open_volume(folder / "picture.png"), UsageError);
}

}  // namespace
}  // namespace dsc
