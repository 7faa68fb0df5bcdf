/// \file
/// What the tests of .vdb share. Private to tests/io/.
#pragma once

#include "tests/io/temporary_folder.h"
#include "tests/support/vdb_files.h"

#include <gtest/gtest.h>

namespace dsc {

using test::VdbClass;
using test::VdbForm;
using test::VdbGrid;
using test::VdbType;
using test::VdbVoxel;

class Vdb : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string path_ = folder_ / "v.vdb";
};

/// Voxels of an odd box with values from a rule.
template <class Value>
VdbGrid box_of(VdbType type, const Value& value) {
  VdbGrid grid{.type = type};
  for (int z = 0; z < 11; ++z) {
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 10; ++x)
        grid.voxels.push_back({{x - 5, y + 6, z - 9}, static_cast<double>(value(x, y, z))});
    }
  }
  return grid;
}

}  // namespace dsc
