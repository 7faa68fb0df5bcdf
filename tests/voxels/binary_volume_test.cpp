#include "libdsc/voxels/binary_volume.h"

#include "libdsc/base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace dsc {
namespace {

Grid grid_of(Index x, Index y, Index z) {
  Grid grid;
  grid.size = {x, y, z};
  return grid;
}

TEST(BinaryVolume, HoldsExactlyTheVoxelsThatWereSet) {
  std::mt19937 random(3);
  for (const Index X : {1, 61, 62, 63, 64, 126, 127, 130}) {
    BinaryVolume volume(grid_of(X, 5, 4));
    std::set<Index3> expected;
    for (int i = 0; i < 300; ++i) {
      const Index3 p{Index(random() % X), Index(random() % 5), Index(random() % 4)};
      const bool inside = random() % 3 != 0;
      volume.set(p[0], p[1], p[2], inside);
      if (inside) {
        expected.insert(p);
      } else {
        expected.erase(p);
      }
    }
    EXPECT_EQ(volume.count(), static_cast<Index>(expected.size()));
    for (Index z = -2; z < 6; ++z) {
      for (Index y = -2; y < 7; ++y) {
        for (Index x = -2; x < X + 2; ++x) {
          ASSERT_EQ(volume(x, y, z), expected.count({x, y, z}) > 0);
          // The words hold the same, margin included.
          if (x >= -1 && x <= X && y >= -1 && y <= 5 && z >= -1 && z <= 4) {
            const Index bit = x + 1;
            ASSERT_EQ((volume.word(bit / 64, y, z) >> (bit % 64) & 1) != 0, volume(x, y, z));
          }
        }
      }
    }
  }
}

TEST(BinaryVolume, SizesThatOverflowOrPassTheMemoryAreRefused) {
  EXPECT_THROW(BinaryVolume(grid_of(Index{1} << 40, Index{1} << 40, 1)), LimitError);
  EXPECT_THROW(BinaryVolume(grid_of(Index{1} << 21, Index{1} << 21, Index{1} << 20)), LimitError);
  EXPECT_THROW(BinaryVolume(grid_of(INT64_MAX, 1, 1)), LimitError);
  EXPECT_THROW(BinaryVolume(grid_of(-1, 1, 1)), InputError);
  Grid grid = grid_of(1, 1, 1);
  grid.spacing[1] = 0.;
  EXPECT_THROW(BinaryVolume{grid}, InputError);
  grid.spacing[1] = std::nan("");
  EXPECT_THROW(BinaryVolume{grid}, InputError);
}

TEST(BinaryVolume, AnEmptyGridIsAVolume) {
  const BinaryVolume volume(grid_of(0, 0, 0));
  EXPECT_EQ(volume.count(), 0);
  EXPECT_FALSE(volume(0, 0, 0));
}

}  // namespace
}  // namespace dsc
