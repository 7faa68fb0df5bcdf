// Real voxel objects, from the folder that the variable DSC_TEST_DATA names. The expected counts of
// faces come with the data.
#include "libdsc/io/read_binary.h"
#include "libdsc/io/volume_writer.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace dsc {
namespace {

/// Faces of the surface: pairs of neighbours with different values, the outside being empty.
Index count_faces(const BinaryVolume& volume) {
  const Index3 n = volume.grid().size;
  Index faces = 0;
  for (Index z = 0; z <= n[2]; ++z) {
    for (Index y = 0; y <= n[1]; ++y) {
      for (Index x = 0; x <= n[0]; ++x) {
        const bool here = volume(x, y, z);
        faces += (here != volume(x - 1, y, z)) + (here != volume(x, y - 1, z)) +
                 (here != volume(x, y, z - 1));
      }
    }
  }
  return faces;
}

void expect_faces(const std::string& name, Index size, Index faces) {
  const char* folder = std::getenv("DSC_TEST_DATA");
  if (folder == nullptr) GTEST_SKIP() << "DSC_TEST_DATA does not name the folder of " << name;
  const BinaryVolume volume = read_binary(std::string(folder) + "/" + name);
  EXPECT_EQ(volume.grid().size, (Index3{size, size, size}));
  EXPECT_EQ(count_faces(volume), faces);
}

TEST(RealVolumes, Spot256HasItsFaces) { expect_faces("spot-256.vol", 257, 180958); }
TEST(RealVolumes, Spot512HasItsFaces) { expect_faces("spot-512.vol", 513, 723098); }

TEST(RealVolumes, SpotSurvivesEveryFormat) {
  const char* folder = std::getenv("DSC_TEST_DATA");
  if (folder == nullptr) GTEST_SKIP() << "DSC_TEST_DATA does not name the folder of spot-64.vol";
  const TemporaryFolder out;
  const BinaryVolume volume = read_binary(std::string(folder) + "/spot-64.vol");
  const Index faces = count_faces(volume);
  EXPECT_GT(faces, 1000);
  for (const char* name : {"v.vol", "v.longvol", "v.npy"}) {
    write_volume(out / name, volume);
    const BinaryVolume back = read_binary(out / name);
    EXPECT_EQ(back.count(), volume.count());
    EXPECT_EQ(count_faces(back), faces);
  }
}

}  // namespace
}  // namespace dsc
