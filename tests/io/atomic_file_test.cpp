#include "libdsc/io/atomic_file.h"

#include "libdsc/base/error.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>

namespace dsc {
namespace {

namespace fs = std::filesystem;

std::ptrdiff_t entries(const std::string& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(AtomicFile, TheTargetAppearsOnCommitAndWhole) {
  const TemporaryFolder folder;
  const std::string path = folder / "result.bin";
  const std::string big(3'000'000, 'x');
  {
    AtomicFile file(path);
    file.write("head\n");
    file.write(big);
    file.write("tail\n");
    EXPECT_FALSE(fs::exists(path));
    file.commit();
  }
  EXPECT_EQ(read_all(path), "head\n" + big + "tail\n");
  EXPECT_EQ(entries(folder.path()), 1);
}

TEST(AtomicFile, WithoutCommitTheOldFileStays) {
  const TemporaryFolder folder;
  const std::string path = folder / "result.bin";
  write_all(path, "old");
  {
    AtomicFile file(path);
    file.write("new");
  }
  EXPECT_EQ(read_all(path), "old");
  EXPECT_EQ(entries(folder.path()), 1);
}

TEST(AtomicFile, AFullDeviceIsAnErrorThatNamesFileAndReason) {
  const TemporaryFolder folder;
  const std::string link = folder / "full.ply";
  fs::create_symlink("/dev/full", link);
  AtomicFile file(link);
  file.write("something");
  try {
    file.commit();
    FAIL() << "nothing was thrown";
  } catch (const OutputError& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find("full.ply"), std::string::npos) << what;
    EXPECT_NE(what.find("No space left"), std::string::npos) << what;
  }
}

TEST(AtomicFile, LinksAreFollowedAndPermissionsKept) {
  const TemporaryFolder folder;
  const std::string target = folder / "target.txt";
  const std::string link = folder / "link.txt";
  write_all(target, "old");
  ASSERT_EQ(::chmod(target.c_str(), 0640), 0);
  fs::create_symlink("target.txt", link);
  AtomicFile file(link);
  file.write("new");
  file.commit();
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(read_all(target), "new");
  struct stat info {};
  ASSERT_EQ(::stat(target.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0640u);
}

TEST(AtomicFile, FoldersAndMissingFoldersAreRefusedAtOnce) {
  const TemporaryFolder folder;
  EXPECT_THROW(AtomicFile{folder.path()}, OutputError);
  EXPECT_THROW(AtomicFile{folder / "missing/result.ply"}, OutputError);
  EXPECT_THROW(AtomicFile{""}, OutputError);
}

TEST(AtomicFile, AnExitCanRemoveEveryTemporary) {
  const TemporaryFolder folder;
  AtomicFile a(folder / "a");
  AtomicFile b(folder / "b");
  a.write("a");
  EXPECT_EQ(entries(folder.path()), 2);
  AtomicFile::remove_all_temporaries();
  EXPECT_EQ(entries(folder.path()), 0);
  EXPECT_THROW(a.commit(), OutputError);
}

TEST(AtomicFile, ManyFilesMayFollowOneAnother) {
  const TemporaryFolder folder;
  for (int i = 0; i < 80; ++i) {
    AtomicFile file(folder / std::to_string(i));
    file.write("x");
    if (i % 2 == 0) file.commit();
  }
  EXPECT_EQ(entries(folder.path()), 40);
}

}  // namespace
}  // namespace dsc
