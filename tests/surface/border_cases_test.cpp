// Volumes at the ends of what a volume can be, against the count from the voxels alone.
#include "libdsc/surface/extract.h"
#include "tests/support/random_volume.h"
#include "tests/support/surface_check.h"

#include <gtest/gtest.h>

#include <random>

namespace dsc {
namespace {

using testing::Cell;

LabelVolume label_volume(Index3 size) {
  return LabelVolume(Grid{size, {1, 1, 1}, Vec3::Zero()}, 1);
}
BinaryVolume binary_volume(Index3 size) {
  return BinaryVolume(Grid{size, {1, 1, 1}, Vec3::Zero()});
}

template <class Volume, class Value>
void fill(Volume& volume, const Value& value) {
  const Index3 n = volume.grid().size;
  for (Index z = 0; z < n[2]; ++z) {
    for (Index y = 0; y < n[1]; ++y) {
      for (Index x = 0; x < n[0]; ++x) volume.set(x, y, z, value(x, y, z));
    }
  }
}

/// Sound under both adjacencies, both ways to glue and both borders.
template <class Volume>
void check(const Volume& volume, const std::string& what) {
  const Index3 n = volume.grid().size;
  const auto within = [&](const Cell& c) {  // off the border of the volume
    const auto a = static_cast<std::size_t>(testing::normal_axis(c));
    return c[a] != 0 && c[a] != 2 * n[a];
  };
  for (const Adjacency adjacency : {Adjacency::interior, Adjacency::exterior}) {
    const auto closed = testing::voxel_topology(volume, adjacency);
    const auto open = testing::voxel_topology(volume, adjacency, within);
    for (const Glue glue : {Glue::pointel, Glue::umbrella}) {
      ExtractOptions options;
      options.adjacency = adjacency;
      options.glue = glue;
      testing::expect_sound(extract_surface(volume, options, Context{1}), closed, what);
      options.border = Border::open;
      testing::expect_sound(extract_surface(volume, options, Context{1}), open, what + ", open");
    }
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(BorderCases, OneVoxelAndFullAndEmptyVolumesOfEverySmallSize) {
  for (Index x = 1; x <= 3; ++x) {
    for (Index y = 1; y <= 3; ++y) {
      for (Index z = 1; z <= 3; ++z) {
        const std::string size = std::to_string(100 * x + 10 * y + z);
        auto volume = binary_volume({x, y, z});
        check(volume, "empty " + size);
        volume.set(x - 1, y - 1, z - 1, true);
        check(volume, "one voxel of " + size);
        fill(volume, [](Index, Index, Index) { return true; });
        check(volume, "full " + size);
        auto labels = label_volume({x, y, z});
        fill(labels,
             [&](Index i, Index j, Index k) { return static_cast<Label>(i + x * (j + y * k)); });
        check(labels, "all labels differ " + size);
        if (HasFailure()) return;
      }
    }
  }
}

TEST(BorderCases, RowsOfVoxelsAlongEachAxis) {
  for (const Index length : {1, 2, 63, 64, 65, 128, 200}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Index3 size{1, 1, 1};
      size[axis] = length;
      const std::string what = std::to_string(length) + " along " + std::to_string(axis);
      check(testing::random_volume(size, 0.5, static_cast<unsigned>(length)), what);
      auto labels = label_volume(size);
      std::mt19937 random(static_cast<unsigned>(length));
      fill(labels, [&](Index, Index, Index) { return static_cast<Label>(random() % 9); });
      check(labels, what + ", labels");
      if (HasFailure()) return;
    }
  }
}

/// Every linel between two diagonal voxels has four surfels: as pinched as a surface can be.
TEST(BorderCases, Checkerboards) {
  for (const Index odd : {0, 1}) {
    auto board = binary_volume({7, 6, 5});
    fill(board, [&](Index x, Index y, Index z) { return (x + y + z) % 2 == odd; });
    check(board, "checkerboard");
    auto labels = label_volume({7, 6, 5});
    fill(labels, [&](Index x, Index y, Index z) {
      return (x + y + z) % 2 == odd ? static_cast<Label>(1 + (x + 2 * y + 3 * z) % 8) : 0;
    });
    check(labels, "checkerboard of 8 labels");
    fill(labels,
         [](Index x, Index y, Index z) {  // no two neighbours alike, eight labels around a pointel
           return static_cast<Label>(1 + x % 2 + 2 * (y % 2) + 4 * (z % 2));
         });
    check(labels, "eight labels around every pointel");
  }
}

/// Boxes that touch any of the six sides of the volume, as a whole or in a corner.
TEST(BorderCases, ObjectsAtEveryBorder) {
  const Index3 size{5, 4, 3};
  for (int code = 0; code < 216; ++code) {
    Index3 lo{}, hi{};
    for (std::size_t a = 0, rest = static_cast<std::size_t>(code); a < 3; ++a, rest /= 6) {
      constexpr Index kLow[] = {0, 0, 0, 1, 1, 2};
      const Index last = size[a];
      const Index high[] = {1, last - 1, last, last - 1, last, last};
      lo[a] = kLow[rest % 6];
      hi[a] = high[rest % 6];
    }
    const auto box = testing::box_volume(size, lo, hi);
    check(box, "box " + std::to_string(code));
    auto labels = label_volume(size);
    fill(labels, [&](Index x, Index y, Index z) {
      return static_cast<Label>(box(x, y, z) ? 2 : (x + y) % 2 == 0 ? 0 : 1);
    });
    check(labels, "labels around box " + std::to_string(code));
    if (HasFailure()) return;
  }
}

TEST(BorderCases, TenThousandComponents) {
  auto apart = binary_volume({200, 200, 1});
  fill(apart, [](Index x, Index y, Index) { return x % 2 == 0 && y % 2 == 0; });
  const auto truth = testing::voxel_topology(apart, Adjacency::interior);
  ASSERT_EQ(truth.counts.components, 10000);
  const DigitalSurface surface = extract_surface(apart);
  testing::expect_sound(surface, truth, "apart");
  EXPECT_EQ(surface.counts().euler, 20000);  // each a sphere

  auto labels = label_volume({200, 200, 1});
  fill(labels, [](Index x, Index y, Index) {
    return x % 2 == 0 && y % 2 == 0 ? static_cast<Label>(1 + (x / 2 + y / 2) % 8) : 0;
  });
  testing::expect_sound(extract_surface(labels),
                        testing::voxel_topology(labels, Adjacency::exterior), "labels apart");
}

}  // namespace
}  // namespace dsc
