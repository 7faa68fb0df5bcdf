#include "libdsc/base/checked.h"

#include <gtest/gtest.h>

namespace dsc {
namespace {

constexpr Index kMax = std::numeric_limits<Index>::max();

TEST(CheckedProduct, IsExactUpToTheLastCountThatFits) {
  EXPECT_EQ(checked_product(0, kMax, "voxels"), 0);
  EXPECT_EQ(checked_product(1, kMax, "voxels"), kMax);
  // 2^63 - 1 = 7^2 * 73 * 127 * 337 * 92737 * 649657.
  EXPECT_EQ(checked_product(kMax / 649657, 649657, "voxels"), kMax);
  EXPECT_EQ(checked_product(Index{1} << 31, Index{1} << 31, "voxels"), Index{1} << 62);
}

TEST(CheckedProduct, OverflowAndNegativeSizesThrow) {
  EXPECT_THROW(checked_product(Index{1} << 32, Index{1} << 31, "voxels"), LimitError);
  EXPECT_THROW(checked_product(kMax, 2, "voxels"), LimitError);
  // Wraps around to a small positive number without the check: 2^64 = 0.
  EXPECT_THROW(checked_product(Index{1} << 32, Index{1} << 32, "voxels"), LimitError);
  EXPECT_THROW(checked_product(-1, 4, "voxels"), LimitError);
  EXPECT_THROW(checked_product(-1, -1, "voxels"), LimitError);
}

TEST(CheckedProduct, TheMessageNamesWhatAndHowMany) {
  try {
    checked_product(kMax, 3, "voxels");
    FAIL() << "nothing was thrown";
  } catch (const LimitError& e) {
    EXPECT_NE(std::string(e.what()).find("voxels: 9223372036854775807 x 3"), std::string::npos);
  }
}

TEST(CheckedId, EndsAt31Bits) {
  EXPECT_EQ(checked_id(2147483647, "vertices"), 2147483647);
  EXPECT_THROW(checked_id(Index{1} << 31, "vertices"), LimitError);
  EXPECT_THROW(checked_id(-1, "vertices"), LimitError);
}

}  // namespace
}  // namespace dsc
