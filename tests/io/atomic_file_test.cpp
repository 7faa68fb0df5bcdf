#include "libdsc/io/atomic_file.h"

#include "libdsc/base/error.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <thread>

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

TEST(AtomicFile, AGroupAppearsTogetherOrNotAtAll) {
  const TemporaryFolder folder;
  write_all(folder / "a", "old");
  const auto commit = [&](const std::string& name) {
    AtomicFile file(folder / name);
    file.write("new");
    file.commit();
  };
  {
    const FileGroup group;
    commit("a");
    commit("b");
    std::thread([&] { commit("of another thread"); }).join();
    EXPECT_EQ(read_all(folder / "a"), "old");
    EXPECT_FALSE(fs::exists(folder / "b"));
    EXPECT_EQ(read_all(folder / "of another thread"), "new");
  }
  EXPECT_EQ(read_all(folder / "a"), "old");
  EXPECT_EQ(entries(folder.path()), 2);

  FileGroup group;
  commit("a");
  commit("b");
  group.publish();
  EXPECT_EQ(read_all(folder / "a") + read_all(folder / "b"), "newnew");
  EXPECT_EQ(entries(folder.path()), 3);
}

TEST(AtomicFile, AGroupPublishesTheOthersWhereOneCannotBe) {
  const TemporaryFolder folder;
  FileGroup group;
  for (const std::string name : {"a", "b", "c"}) {
    AtomicFile file(folder / name);
    file.write("new");
    file.commit();
  }
  fs::create_directory(folder / "b");
  try {
    group.publish();
    FAIL() << "a file took the place of a folder";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find(folder / "b"), std::string::npos) << error.what();
  }
  EXPECT_EQ(read_all(folder / "a") + read_all(folder / "c"), "newnew");
  EXPECT_EQ(entries(folder.path()), 3);
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

/// In a process of its own, since none can be opened afterwards.
template <class Body>
int exit_code_of(const Body& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      body();
    } catch (...) {
      ::_exit(2);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

template <class Body>
bool refuses(const Body& body) {
  try {
    body();
    return false;
  } catch (const OutputError&) {
    return true;
  }
}

TEST(AtomicFile, AnExitCanRemoveEveryTemporary) {
  const TemporaryFolder folder;
  const int code = exit_code_of([&] {
    AtomicFile a(folder / "a");
    AtomicFile b(folder / "b");
    a.write("a");
    if (entries(folder.path()) != 2) ::_exit(3);
    AtomicFile::remove_all_temporaries();
    if (entries(folder.path()) != 0) ::_exit(4);
    if (!refuses([&] { a.commit(); })) ::_exit(5);
    if (!refuses([&] { AtomicFile late(folder / "late"); })) ::_exit(6);
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(entries(folder.path()), 0);
}

TEST(AtomicFile, NoTemporaryComesWhileTheyAreRemoved) {
  const TemporaryFolder folder;
  for (int round = 0; round < 50; ++round) {
    const int code = exit_code_of([&] {
      std::vector<std::thread> writers;
      for (int t = 0; t < 3; ++t) {
        writers.emplace_back([&, t] {
          for (int i = 0;; ++i) {
            (void)refuses([&] { AtomicFile file(folder / std::to_string(100 * t + i % 100)); });
          }
        });
      }
      std::this_thread::sleep_for(std::chrono::microseconds(300 + 70 * round));
      AtomicFile::remove_all_temporaries();
      ::_exit(0);
    });
    ASSERT_EQ(code, 0);
    ASSERT_EQ(entries(folder.path()), 0) << "round " << round;
  }
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
