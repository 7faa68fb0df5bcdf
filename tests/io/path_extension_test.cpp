#include "libdsc/io/path_extension.h"

#include <gtest/gtest.h>

namespace dsc {
namespace {

TEST(PathExtension, IsWhatFollowsTheLastDotOfTheFilesName) {
  EXPECT_EQ(extension_of("scan.vol"), ".vol");
  EXPECT_EQ(extension_of("a.b/scan.VTI"), ".vti");
  EXPECT_EQ(extension_of("scan.nii.gz"), ".gz");
  for (const char* none : {"", "scan", "a.b/scan", ".vol", "a/.vol", "a.b/", "."}) {
    EXPECT_EQ(extension_of(none), "") << none;
  }
}

TEST(PathExtension, OfAStandardStreamIsItsForm) {
  EXPECT_EQ(extension_of("ply:-"), ".ply");
  EXPECT_EQ(extension_of("LONGVOL:-"), ".longvol");
  EXPECT_EQ(extension_of("./ply:-"), "");  // a file of that name
  EXPECT_EQ(extension_of(":-"), "");
}

}  // namespace
}  // namespace dsc
