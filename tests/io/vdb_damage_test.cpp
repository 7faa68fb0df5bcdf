// .vdb files that are too large, cut, damaged or no volume: an error of ours, in words.
#include "libdsc/base/error.h"
#include "libdsc/io/read_binary.h"
#include "tests/io/vdb_fixture.h"
#include "tests/io/volume_bytes.h"
#include "tests/support/long_tests.h"
#include "tests/support/memory_left.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <random>

namespace dsc {
namespace {

TEST_F(Vdb, WhatIsNoVolumeIsRefused) {
  const auto expect = [&](const VdbGrid& grid, const std::string& part) {
    SCOPED_TRACE(part);
    test::write_vdb(path_, {grid});
    expect_input_error([&] { (void)read_binary(path_); }, {path_, "'grid'", part});
  };
  const std::vector<VdbVoxel> one{{{0, 0, 0}, 1}};
  expect({}, "no active voxel");
  expect({.frustum = true}, "no active voxel");
  expect({.voxels = one, .frustum = true}, "frustum");
  Eigen::Matrix4d sheared = Eigen::Matrix4d::Identity();
  sheared(0, 1) = 0.1;
  expect({.voxels = one, .matrix = sheared}, "shears");
  expect({.grid_class = VdbClass::level_set, .background = -1, .voxels = one}, "no end");
  expect({.grid_class = VdbClass::level_set, .background = std::nan(""), .voxels = one}, "no end");
  expect({.type = VdbType::vector, .voxels = one}, "vectors");
  expect_input_error([&] { (void)open_volume(folder_ / "none.vdb"); }, {"does not exist"});
  std::filesystem::create_directory(folder_ / "folder.vdb");
  expect_input_error([&] { (void)open_volume(folder_ / "folder.vdb"); }, {"no regular file"});
  EXPECT_THROW((void)open_volume("vdb:-"), UsageError);
}

TEST_F(Vdb, BoxesBeyondMemoryAreRefusedAtOnce) {
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max() - 10;
  for (const std::int32_t far : {std::int32_t{1} << 30, kFar, std::int32_t{3000000}}) {
    SCOPED_TRACE(far);
    test::write_vdb(path_, {{.voxels = {{{-far, -far, -far}, 1}, {{far, far, far}, 1}}}});
    const auto start = std::chrono::steady_clock::now();
    expect_error<LimitError>([&] { (void)read_binary(path_); }, {path_, "'grid' spans"});
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
  }
  // A row that is not too long, at the end of what OpenVDB counts.
  test::write_vdb(path_, {{.voxels = {{{kFar, 0, 0}, 1}}}});
  expect_error<LimitError>([&] { (void)read_binary(path_); },
                           {path_, "'grid' spans", "beyond 2^30"});
  // All of the space is one tile of a root, but for its size.
  test::write_vdb(path_,
                  {{.type = VdbType::boolean, .fills = {{{0, 0, 0}, {65535, 65535, 65535}, 1}}}});
  expect_error<LimitError>([&] { (void)read_binary(path_); },
                           {path_, "from [0, 0, 0] to [65535, 65535, 65535]"});
}

TEST_F(Vdb, TheMemoryThatIsLeftBoundsTheReader) {
  const VdbGrid grid{.fills = {{{0, 0, 0}, {399, 319, 239}, 1}},
                     .dense = true};  // 123 MB of leaves
  test::write_vdb(path_, {grid});
  const auto count = [&](Index bytes) {
    const test::MemoryLeft limit(bytes);
    return read_binary(*open_volume(path_, {0, nullptr, &limit})).count();
  };
  EXPECT_EQ(count(Index{400} << 20), Index{400} * 320 * 240);
#ifndef __SANITIZE_ADDRESS__
  expect_error<LimitError>([&] { (void)count(Index{10} << 20); }, {path_, "memory"});
#endif
}

/// Two grids: a ball's level set, and numbers of many values.
std::string sample_bytes(const std::string& path, VdbForm form) {
  VdbGrid second =
      box_of(VdbType::float64, [](int x, int y, int z) { return x + 10 * y + 100 * z; });
  second.name = "second";
  VdbGrid first{.name = "first", .grid_class = VdbClass::level_set, .background = 3};
  for (int z = -6; z <= 6; ++z) {
    for (int y = -6; y <= 6; ++y) {
      for (int x = -6; x <= 6; ++x) {
        const double distance = Vec3(x, y, z).norm() - 4.3;
        if (std::abs(distance) < 2) first.voxels.push_back({{x, y, z}, distance});
      }
    }
  }
  first.fills = {{{-2, -2, -2}, {2, 2, 2}, -3, false}};
  test::write_vdb(path, {first, second}, form);
  return read_all(path);
}

TEST_F(Vdb, CutAnywhereItIsAnErrorOrWhole) {
  for (const VdbForm form : {VdbForm::plain, VdbForm::zip, VdbForm::blosc, VdbForm::stream}) {
    const std::string bytes = sample_bytes(path_, form);
    const std::vector<double> first = values_of(*open_volume(path_, {"first"}));
    const std::vector<double> second = values_of(*open_volume(path_, {"second"}));
    ASSERT_EQ(second.size(), 330U);
    const std::size_t step = testing::long_tests() ? 1 : bytes.size() / 50;
    std::size_t refused = 0, cuts = 0;
    for (std::size_t n = 0; n<bytes.size(); n += n + 40> bytes.size() ? 3 : step) {
      SCOPED_TRACE(std::to_string(static_cast<int>(form)) + ", byte " + std::to_string(n) + " of " +
                   std::to_string(bytes.size()));
      write_all(path_, bytes.substr(0, n));
      for (const bool last : {false, true}) {
        ++cuts;
        try {
          EXPECT_EQ(values_of(*open_volume(path_, {last ? "second" : "first"})),
                    last ? second : first);
        } catch (const InputError& error) {
          ++refused;
          const std::string what = error.what();
          EXPECT_NE(what.find(path_), std::string::npos) << what;
          for (const char* death : {"Aborted", "Segmentation", "exit code", "signal"}) {
            EXPECT_EQ(what.find(death), std::string::npos) << what;
          }
        }
      }
    }
    EXPECT_EQ(refused, cuts) << "nothing in the file is superfluous";
  }
}

TEST_F(Vdb, DamageIsAnErrorOrOtherValuesAndNothingElse) {
  const std::string bytes = sample_bytes(path_, VdbForm::blosc);
  std::mt19937 random(7);
  const int count = testing::usually_or_long(60, 3000);
  const test::MemoryLeft limit(Index{256} << 20);
  for (int i = 0; i < count; ++i) {
    std::string damaged = bytes;
    for (int k = 0; k < 1 + i % 4; ++k) {
      // The first part has the counts and places.
      const std::size_t range = i % 2 == 0 ? 1500 : bytes.size();
      damaged[random() % std::min(range, bytes.size())] = static_cast<char>(random() & 255);
    }
    write_all(path_, damaged);
    for (const char* name : {"first", "second"}) {
      try {
        (void)read_binary(*open_volume(path_, {name}, {0, nullptr, &limit}), {},
                          {0, nullptr, &limit});
      } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(path_), std::string::npos) << error.what();
      }
    }
  }
}

TEST_F(Vdb, GarbageIsRefused) {
  std::mt19937 random(3);
  for (const std::size_t size : {0U, 1U, 8U, 100U, 5000U}) {
    std::string bytes(size, '\0');
    for (char& c : bytes) c = static_cast<char>(random() & 255);
    write_all(path_, bytes);
    expect_input_error([&] { (void)open_volume(path_); }, {path_});
  }
  // A newer format than this OpenVDB knows.
  std::string newer = sample_bytes(path_, VdbForm::plain);
  newer[8] = static_cast<char>(250);
  write_all(path_, newer);
  expect_input_error([&] { (void)open_volume(path_); }, {path_, "version 250"});
}

TEST_F(Vdb, AReaderThatIsNotThereSaysSo) {
  write_all(path_, "");
  ::setenv("DSC_VDB_READER", (folder_ / "nowhere").c_str(), 1);
  expect_input_error([&] { (void)open_volume(path_); }, {"nowhere", "cannot start"});
  ::unsetenv("DSC_VDB_READER");
}

}  // namespace
}  // namespace dsc
