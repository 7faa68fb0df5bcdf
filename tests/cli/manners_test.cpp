// What shells, readers of manuals and users of DGtal expect of a program.
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

namespace dsc::test {
namespace {

/// What a shell command prints; nothing where it fails.
std::string printed(const std::string& command) {
  std::FILE* pipe = ::popen(("( " + command + " ) 2>&1").c_str(), "r");
  std::string text;
  char buffer[4096];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
    text.append(buffer, n);
  const int status = ::pclose(pipe);
  return status == 0 ? text : "FAILED: " + text;
}

/// What bash offers for the last word of a command line.
std::string offered(const std::string& script, const std::string& line) {
  std::istringstream stream(line);
  std::string words;
  int count = -1;
  for (std::string word; stream >> word; ++count) words += " '" + word + "'";
  if (line.back() == ' ') {
    words += " ''";
    ++count;
  }
  return printed("bash -c 'source " + script + "; COMP_LINE=\"" + line +
                 "\"; COMP_POINT=${#COMP_LINE}; COMP_WORDS=(" +
                 [&] {
                   std::string quoted;
                   for (const char c : words) quoted += c == '\'' ? "\"" : std::string(1, c);
                   return quoted;
                 }() +
                 "); COMP_CWORD=" + std::to_string(count) + "; _dsc; echo \"${COMPREPLY[*]}\"'");
}

TEST(Completion, BashOffersCommandsOptionsAndTheirWords) {
  const Folder folder;
  const std::string script = folder / "dsc";
  write_file(script, run_dsc({"--completion", "bash"}).out);
  EXPECT_EQ(offered(script, "dsc geo"), "geodesic\n");
  EXPECT_EQ(offered(script, "dsc geodesic --bou"), "--boundary\n");
  EXPECT_EQ(offered(script, "dsc geodesic --boundary "), "mixed neumann\n");
  EXPECT_EQ(offered(script, "dsc normals --estimator tr"), "trivial\n");
  EXPECT_EQ(offered(script, "dsc info --source-ver"), "\n");  // not an option of this command
  EXPECT_EQ(offered(script, "dsc info shape:to"), "torus\n");
  write_file(folder / "object.vol", "");
  EXPECT_EQ(offered(script, "dsc info " + (folder / "obj")), folder / "object.vol\n");
  EXPECT_EQ(offered(script, "dsc info -i " + (folder / "obj")), folder / "object.vol\n");
}

TEST(Completion, ZshHasEveryOption) {
  const std::string script = run_dsc({"--completion", "zsh"}).out;
  EXPECT_EQ(script.rfind("#compdef dsc\n", 0), 0U);
  for (const std::string option : {"--boundary", "--gridstep", "--fix", "-k", "--regularise"}) {
    EXPECT_NE(script.find("'*" + option + "["), std::string::npos) << option;
  }
  if (printed("command -v zsh").rfind("FAILED", 0) == 0)
    GTEST_SKIP() << "there is no zsh to read it";
  const Folder folder;
  write_file(folder / "_dsc", script);
  EXPECT_EQ(printed("zsh -n " + (folder / "_dsc")), "");
}

TEST(Completion, AnotherShellIsRefused) {
  const Outcome outcome = run_dsc({"--completion", "tcsh"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("bash|zsh"), std::string::npos);
}

TEST(Manual, HasEveryCommandAndReadsWithoutAWarning) {
  const std::string page = run_dsc({"--manual"}).out;
  for (const std::string word :
       {"dsc geodesic", "\\-\\-gridstep", ".SH NOTES", "130 interrupted"}) {
    EXPECT_NE(page.find(word), std::string::npos) << word;
  }
  if (printed("command -v groff").rfind("FAILED", 0) == 0)
    GTEST_SKIP() << "there is no groff to read it";
  const Folder folder;
  write_file(folder / "dsc.1", page);
  EXPECT_EQ(printed("groff -man -ww -Tutf8 -z " + (folder / "dsc.1")), "");
}

TEST(Manners, DgtalsNamesOfOptionsAreKnown) {
  const Folder folder;
  // 3 voxels of values 1, 2, 3: LO is outside and HI inside, as there.
  write_file(folder / "v.raw", std::string("\1\2\3", 3));
  const std::vector<std::string> raw = {"--size", "3,1,1",    "--type",
                                        "u8",     "--report", folder / "r.json"};
  const auto inside = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "info");
    words.insert(words.end(), raw.begin(), raw.end());
    const Outcome outcome = run_dsc(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return read_json(folder / "r.json")["input"]["voxels_inside"].get<int>();
  };
  EXPECT_EQ(inside({"-i", folder / "v.raw"}), 3);
  EXPECT_EQ(inside({"-i", folder / "v.raw", "-m", "1"}), 2);
  EXPECT_EQ(inside({folder / "v.raw", "-m", "1", "-M", "2"}), 1);
  EXPECT_EQ(inside({"--input", folder / "v.raw", "-M", "2", "-g", "0.5"}), 2);
  EXPECT_EQ(read_json(folder / "r.json")["input"]["spacing"][0], 0.5);

  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"info"},
        {"info", "a.vol", "-i", "b.vol"},
        {"info", "a.vol", "-m", "2", "-M", "1"},
        {"info", "a.vol", "-m", "2", "--threshold", "1,2"}}) {
    EXPECT_EQ(run_dsc(words).exit_code, 2);
  }
}

TEST(Manners, StandardInputAndOutputHaveAFormat) {
  const Folder folder;
  const std::string program = DSC_PROGRAM;
  // .npy in, .ply out, the same bytes as through files.
  const std::string npy =
      std::string("\x93NUMPY\1\0\x46\0", 10) +
      "{'descr': '|u1', 'fortran_order': False, 'shape': (1, 1, 2), }       \n" + "\1\2";
  write_file(folder / "v.npy", npy);
  EXPECT_EQ(run_dsc({"surface", folder / "v.npy", "-o", folder / "v.ply", "--quiet"}).exit_code, 0);
  EXPECT_EQ(printed(program + " surface npy:- -o ply:- --report " + (folder / "r.json") + " 2>" +
                    (folder / "err") + " <" + (folder / "v.npy") + " >" + (folder / "w.ply")),
            "");
  EXPECT_EQ(read_file(folder / "w.ply"), read_file(folder / "v.ply"));
  EXPECT_NE(read_file(folder / "err").find("faces"), std::string::npos);  // the summary
  EXPECT_EQ(read_json(folder / "r.json")["surface"]["faces"], 10);
  // A mesh and raw voxels, through a pipe.
  EXPECT_NE(printed("cat " + (folder / "v.ply") + " | " + program + " info ply:-").find("10 faces"),
            std::string::npos);
  EXPECT_NE(
      printed("printf abc | " + program + " info raw:- --size 3,1,1 --type u8").find("14 faces"),
      std::string::npos);
  // What is cut short is refused, as it is in a file.
  EXPECT_NE(
      printed("head -c 80 " + (folder / "v.npy") + " | " + program + " info npy:-").find("npy:-"),
      std::string::npos);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"info", "-"},
        {"surface", "v.npy", "-o", "-"},
        {"surface", folder / "v.npy", "-o", "ply:-", "-o", "csv:-"}}) {
    const Outcome outcome = run_dsc(words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("standard"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace dsc::test
