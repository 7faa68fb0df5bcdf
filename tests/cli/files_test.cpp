// The files of a command line: the input survives, nothing is written twice, what cannot be
// written is refused at once.
#include "libdsc/page/page.h"
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

namespace dsc::test {
namespace {

/// A volume of 2 x 2 x 2 voxels, one inside.
std::string small_volume() {
  return "X: 2\nY: 2\nZ: 2\nVersion: 2\n.\n" + std::string("\1\0\0\0\0\0\0\0", 8);
}

TEST(Files, TheInputIsNeverOverwritten) {
  const Folder folder;
  const std::string input = folder / "h.vol";
  write_file(input, small_volume());
  ASSERT_EQ(::symlink(input.c_str(), (folder / "link.ply").c_str()), 0);
  ASSERT_EQ(::symlink("h.vol", (folder / "link.json").c_str()), 0);
  ASSERT_EQ(::mkdir((folder / "sub").c_str(), 0777), 0);
  expect_refused(run_dsc({"info", input, "--report", input}), 2, {"h.vol", "input"});
  expect_refused(run_dsc({"info", input, "--report", folder / "sub/../h.vol"}), 2, {"input"});
  expect_refused(run_dsc({"info", input, "--report", folder / "link.json"}), 2, {"link.json"});
  expect_refused(run_dsc({"surface", input, "-o", folder / "link.ply"}), 2, {"link.ply", "h.vol"});
  EXPECT_EQ(read_file(input), small_volume());
  // The other way round: the input is reached through a link.
  expect_refused(run_dsc({"info", folder / "link.json", "--report", input}), 2, {"input"});
  EXPECT_EQ(read_file(input), small_volume());
  EXPECT_EQ(run_dsc({"surface", input, "-o", folder / "s.ply"}).exit_code, 0);
}

TEST(Files, AFolderAsInputKeepsItsFiles) {
  const Folder folder;
  write_file(folder / "slice.ply", "slice");
  const std::string input = folder / ".";
  expect_refused(run_dsc({"info", input, "--report", folder / "slice.ply"}), 2, {"slice.ply"});
  // A new name in it is no reason to refuse; what the folder holds is.
  expect_refused(run_dsc({"info", input, "--report", input}), 3, {"folder"});
  EXPECT_NE(run_dsc({"info", input, "--report", folder / "new.json"}).exit_code, 0);
  EXPECT_EQ(run_dsc({"info", input, "--report", folder / "new.json"}).err.find("overwritten"),
            std::string::npos);
  EXPECT_EQ(read_file(folder / "slice.ply"), "slice");
}

TEST(Files, NoFileIsWrittenTwice) {
  const Folder folder;
  const Words sphere = {"surface", "shape:sphere", "--gridstep", "0.2", "-o", folder / "x.ply"};
  const auto with = [&](const Words& more) {
    Words all = sphere;
    all.insert(all.end(), more.begin(), more.end());
    return run_dsc(all);
  };
  expect_refused(with({"-o", folder / "x.ply"}), 2, {"x.ply", "twice"});
  expect_refused(with({"-o", folder / "./x.ply"}), 2, {"./x.ply", "twice"});
  expect_refused(with({"--report", folder / "./x.ply"}), 2, {"twice"});
  EXPECT_EQ(folder.names(), Words{});
  write_file(folder / "x.ply", "old");
  ASSERT_EQ(::symlink("x.ply", (folder / "y.ply").c_str()), 0);
  expect_refused(with({"-o", folder / "y.ply"}), 2, {"y.ply", "twice"});
  EXPECT_EQ(read_file(folder / "x.ply"), "old");
  EXPECT_EQ(with({"-o", folder / "z.ply", "--report", "/dev/null"}).exit_code, 0);
}

TEST(Files, WhatCannotBeWrittenIsFoundBeforeTheInputIsRead) {
  const Folder folder;
  for (const std::string option : {"--output", "--report"}) {
    ASSERT_TRUE(option == "--report" || ::mkdir((folder / "is.ply").c_str(), 0777) == 0);
    const Outcome outcome = run_dsc(
        {"surface", folder / "missing.vol", "-o", folder / "a.ply", option, folder / "is.ply"});
    expect_refused(outcome, 3, {"is.ply", "folder"});
  }
  // As a user who may not write there.
  ASSERT_EQ(::mkdir((folder / "shut").c_str(), 0555), 0);
  ASSERT_EQ(::chmod((folder / ".").c_str(), 0755), 0);
  constexpr uid_t kNobody = 65534;
  const bool root = ::geteuid() == 0;
  for (const std::string option : {"--output", "--report"}) {
    Words words = {"surface", folder / "missing.vol", option, folder / "shut/b.ply"};
    if (option == "--report") words[0] = "info";
    const Outcome outcome = run_dsc(words, [root] {
      if (root && ::setuid(kNobody) != 0) ::_exit(126);
    });
    if (outcome.exit_code == 126 || outcome.exit_code == 127) {
      GTEST_SKIP() << "another user cannot run the program here";
    }
    expect_refused(outcome, 3, {"shut/b.ply", "no file can be created"});
  }
}

TEST(Files, APageIsAResultWhereTheBuildHasPages) {
  const Folder folder;
  const Outcome run = run_dsc({"geodesic", "shape:sphere", "--gridstep", "0.2", "--source", "0,0,1",
                               "-o", folder / "d.html", "-o", folder / "d.ply"});
  if (has_pages()) {
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(read_file(folder / "d.html").find("<!doctype html>"), 0U);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"d.html", "d.ply"}));
  } else {
    expect_refused(run, 2, {"d.html", "DSC_WITH_PAGE", "libjs-three"});
    EXPECT_TRUE(folder.names().empty());
  }
}

}  // namespace
}  // namespace dsc::test
