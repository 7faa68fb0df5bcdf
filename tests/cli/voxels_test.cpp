// dsc voxels: what is written reads back as the voxels, or labels, that went in; what a form has no
// room for is said.
#include "libdsc/io/read_labels.h"
#include "libdsc/io/volume_writer.h"
#include "tests/cli/program.h"
#include "tests/io/result_parsers.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include <malloc.h>

namespace dsc::test {
namespace {

const Words kTorus = {"shape:torus,R=1,r=0.4", "--gridstep", "0.1,0.08,0.12"};

nlohmann::json report_of(Words words, const Folder& folder) {
  words.insert(words.end(), {"--report", folder / "report.json"});
  const Outcome outcome = run_dsc(words);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return read_json(folder / "report.json");
}

std::string text_of(const nlohmann::json& warnings) { return warnings.dump(); }

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::vector<Label> labels_of(const std::string& path) {
  const LabelVolume volume = read_labels(path);
  const Index3& size = volume.grid().size;
  std::vector<Label> labels(static_cast<std::size_t>(volume.grid().voxels()));
  for (Index z = 0; z < size[2]; ++z) {
    for (Index y = 0; y < size[1]; ++y) {
      volume.row(y, z, labels.data() + (z * size[1] + y) * size[0]);
    }
  }
  return labels;
}

/// What a shell command prints; nothing on standard error.
std::string printed(const std::string& command) {
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string text;
  char buffer[4096];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
    text.append(buffer, n);
  EXPECT_EQ(::pclose(pipe), 0) << command;
  return text;
}

/// The same surface, from the shape and from each file, up to what the form does not keep.
TEST(Voxels, OfAShapeHaveItsSurface) {
  const Folder folder;
  Words words = Words{"voxels"} + kTorus;
  for (const char* name : {"v.vol", "v.longvol", "v.npy", "v.vti"}) {
    words.insert(words.end(), {"-o", folder / name});
  }
  const auto report = report_of(words, folder);
  const auto input = report["input"];
  const auto shape = report_of(Words{"surface", "-o", folder / "shape.ply"} + kTorus, folder);
  EXPECT_EQ(input, shape["input"]);
  EXPECT_FALSE(report.contains("surface"));
  EXPECT_EQ(report["outputs"].size(), 4U);
  const PlyFile expected = read_ply(folder / "shape.ply");
  for (const std::string name : {"v.vol", "v.longvol", "v.npy", "v.vti"}) {
    SCOPED_TRACE(name);
    const bool spacing = name != "v.npy", place = name == "v.vti";
    EXPECT_EQ(has(text_of(report["warnings"]), name + "' has no room for the spacing"), !spacing);
    EXPECT_EQ(has(text_of(report["warnings"]), name + "' has no room for the place in the world"),
              !place);
    Words again = {"surface", folder / name, "-o", folder / "file.ply"};
    if (!spacing) again = again + Words{"--gridstep", kTorus[2]};
    const auto file = report_of(again, folder);
    EXPECT_EQ(file["surface"], shape["surface"]);
    for (const char* key : {"size", "spacing", "voxels_inside"}) {
      EXPECT_EQ(file["input"][key], input[key]) << key;
    }
    if (place) {
      EXPECT_EQ(file["input"]["origin"], input["origin"]);
    }
    const PlyFile found = read_ply(folder / "file.ply");
    EXPECT_EQ(found.faces, expected.faces);
    ASSERT_EQ(found.vertices.size(), expected.vertices.size());
    for (std::size_t v = 0; v < found.vertices.size(); ++v) {
      for (std::size_t a = 0; a < 3; ++a) {
        const double origin = place ? 0. : input["origin"][a].get<double>();
        // One rounding each in the two sums, of positions up to 1.5.
        ASSERT_NEAR(found.vertices[v][a] + origin, expected.vertices[v][a], 1e-15) << v;
      }
    }
  }
}

TEST(Voxels, AreOneInsideAndZeroOutside) {
  const Folder folder;
  write_file(folder / "v.raw", std::string("\0\1\2\3\4\5\6\7", 8));
  const Words raw = {"voxels", folder / "v.raw", "--size", "2,2,2", "--type", "u8"};
  const auto written = [&](const Words& choice) {
    report_of(raw + choice + Words{"-o", folder / "w.vol"}, folder);
    return labels_of(folder / "w.vol");
  };
  EXPECT_EQ(written({}), (std::vector<Label>{0, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(written({"--threshold", "2,4"}), (std::vector<Label>{0, 0, 1, 1, 1, 0, 0, 0}));
  EXPECT_EQ(written({"-m", "2", "-M", "4"}), (std::vector<Label>{0, 0, 0, 1, 1, 0, 0, 0}));
  EXPECT_EQ(written({"--label", "7", "--label", "1"}),
            (std::vector<Label>{0, 1, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(written({"--labels", "all"}), (std::vector<Label>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(Voxels, LabelsAreKeptByTheFormsThatHaveRoom) {
  const Folder folder;
  std::mt19937 random(4);
  const Grid grid{{7, 6, 5}, {0.5, 1, 2}, Vec3::Zero()};
  for (const Label largest : {Label{255}, Label{65535}, Label{4294967295}}) {
    SCOPED_TRACE(largest);
    std::vector<std::uint32_t> values(static_cast<std::size_t>(grid.voxels()));
    for (std::uint32_t& value : values) value = static_cast<std::uint32_t>(random()) & largest;
    values[0] = 0;
    values[17] = largest;
    write_volume(folder / "in.vti", grid, std::span<const std::uint32_t>(values));
    const Words words = {"voxels", folder / "in.vti", "--labels", "all"};
    for (const char* name : {"v.longvol", "v.npy", "v.vti"}) {
      report_of(words + Words{"-o", folder / name}, folder);
      EXPECT_EQ(labels_of(folder / name), values) << name;
    }
    const Outcome vol = run_dsc(words + Words{"-o", folder / "v.vol"});
    if (largest == 255) {
      EXPECT_EQ(vol.exit_code, 0) << vol.err;
      EXPECT_EQ(labels_of(folder / "v.vol"), values);
      EXPECT_EQ(std::remove((folder / "v.vol").c_str()), 0);
    } else {
      EXPECT_EQ(vol.exit_code, 3);
      for (const char* part : {"v.vol", "voxel (", ".npy"})
        EXPECT_TRUE(has(vol.err, part)) << vol.err;
      for (const std::string& name : folder.names()) EXPECT_FALSE(has(name, "v.vol")) << name;
    }
  }
}

/// Turned, with a spacing of its own: .vti says all of it again.
TEST(Voxels, OfATurnedImageStayInTheirPlaceInVti) {
  const Folder folder;
  const Grid grid{{4, 3, 2}, {0.5, 1. / 3, 2}, Vec3::Zero()};
  const std::vector<std::uint8_t> values(24, 1);
  VolumeWriteOptions options;
  options.world.rotation << 0, -1, 0, 1, 0, 0, 0, 0, -1;
  options.world.translation = Vec3(7, 0.1, -9);
  write_volume(folder / "in.vti", grid, std::span<const std::uint8_t>(values), options);
  const auto report = report_of({"voxels", folder / "in.vti", "-o", folder / "v.vti", "-o",
                                 folder / "v.vol", "-o", folder / "v.npy"},
                                folder);
  EXPECT_EQ(report["warnings"].size(), 3U) << text_of(report["warnings"]);
  EXPECT_FALSE(has(text_of(report["warnings"]), "v.vti' has"));
  EXPECT_EQ(report_of({"info", folder / "v.vti"}, folder)["input"]["direction"],
            report["input"]["direction"]);
  for (const char* name : {"in", "v"}) {
    report_of({"surface", folder / (name + std::string(".vti")), "-o",
               folder / (name + std::string(".ply"))},
              folder);
  }
  EXPECT_EQ(read_file(folder / "v.ply"), read_file(folder / "in.ply"));
  // Another spacing than the file's.
  report_of({"voxels", folder / "in.vti", "--gridstep", "3", "-o", folder / "w.vti"}, folder);
  EXPECT_EQ(report_of({"info", folder / "w.vti"}, folder)["input"]["spacing"],
            nlohmann::json({3., 3., 3.}));
}

TEST(Voxels, PassThroughStandardStreams) {
  const Folder folder;
  const std::string program = DSC_PROGRAM;
  report_of(Words{"voxels", "-o", folder / "v.vol", "-o", folder / "v.vti"} + kTorus, folder);
  const std::string shape = program + " voxels " + kTorus[0] + " --gridstep " + kTorus[2];
  const std::string silent = " 2>" + (folder / "err");
  for (const std::string form : {"vol", "vti"}) {
    EXPECT_TRUE(printed(shape + " -o " + form + ":-" + silent) == read_file(folder / "v." + form));
    EXPECT_TRUE(has(read_file(folder / "err"), "inside")) << "the summary";
    EXPECT_TRUE(printed(program + " voxels " + form + ":- -o " + form + ":- <" +
                        (folder / ("v." + form)) + silent) == read_file(folder / ("v." + form)));
  }
  for (const char* form : {"npy", "longvol"}) {
    EXPECT_TRUE(has(printed(shape + " --quiet -o " + form + ":-" + silent + " | " + program +
                            " info " + form + ":-"),
                    "Euler number 0"));
  }
}

TEST(Voxels, WhatCannotBeDoneIsRefused) {
  const Folder folder;
  write_file(folder / "v.vol", "X: 2\nY: 1\nZ: 1\nVersion: 2\n.\n" + std::string("\1\0", 2));
  write_file(folder / "m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const Words before = folder.names();
  const auto refused = [&](int exit_code, const Words& words, const Words& parts) {
    expect_refused(run_dsc(Words{"voxels"} + words), exit_code, parts);
    EXPECT_EQ(folder.names(), before);
  };
  const std::string vol = folder / "v.vol", out = folder / "w.vol";
  refused(2, {vol}, {"--output"});
  refused(2, {vol, "-o", vol}, {"v.vol", "overwritten"});
  refused(2, {vol, "-o", out, "-o", out}, {"twice"});
  refused(2, {vol, "-o", "vol:-", "-o", "npy:-"}, {"standard output"});
  for (const std::string ending : {".ply", ".png", ".html", ".glb", ".vox", ""}) {
    refused(2, {vol, "-o", folder / ("w" + ending)}, {"w" + ending, ".longvol", ".vti"});
  }
  refused(3, {vol, "-o", folder / "none/w.vol"}, {"none", "does not exist"});
  refused(3, {folder / "missing.vol", "-o", out}, {"missing.vol"});
  refused(3, {vol, "--label", "7", "-o", out}, {"no voxel is inside"});
  refused(2, {folder / "m.off", "-o", out}, {"m.off", "is a mesh", "dsc voxels works on voxels"});
  refused(2, {"ply:-", "-o", out}, {"is a mesh"});
  // Options of the surface, which is not made.
  for (const Words& option :
       {Words{"--border", "open"}, Words{"--adjacency", "exterior"}, Words{"--between", "1,0"},
        Words{"--estimator", "trivial"}, Words{"--view", "top"}}) {
    refused(2, Words{vol, "-o", out} + option, {option[0]});
  }
  refused(2, {vol, "--gridstep", "2", "-o", folder / "w.npy"}, {"--gridstep", ".npy", ".vti"});
  refused(2, {"shape:sphere", "--gridstep", "0.5", "--labels", "all", "-o", out}, {"--labels"});
  // The other way round, the way is shown.
  const Outcome surface = run_dsc({"surface", vol, "-o", folder / "w.npy"});
  EXPECT_EQ(surface.exit_code, 2);
  EXPECT_TRUE(has(surface.err, "dsc voxels")) << surface.err;
  EXPECT_EQ(folder.names(), before);
}

/// Slices of noise, which do not get smaller, wait in memory until the last of a .vti file is made.
TEST(Voxels, StayWithinTheMemoryAllowed) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  const Folder folder;
  constexpr std::int64_t kMebi = 1 << 20;
  std::mt19937 random(5);
  {
    std::vector<std::uint32_t> noise(std::size_t{4} * kMebi);
    for (std::uint32_t& word : noise) word = static_cast<std::uint32_t>(random());
    write_file(folder / "v.raw", {reinterpret_cast<const char*>(noise.data()), 4 * noise.size()});
  }
  (void)::malloc_trim(0);  // what this process holds counts as the child's
  int done = 0, refused = 0;
  for (const int mebi : {38, 80}) {
    const Folder results;
    const Outcome outcome = run_dsc({"voxels", folder / "v.raw", "--size", "1024,1024,16", "--type",
                                     "u8", "--labels", "all", "--threads", "2", "--max-memory",
                                     std::to_string(mebi) + "M", "-o", results / "w.vti"});
    ASSERT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 4) << outcome.err;
    ++(outcome.exit_code == 0 ? done : refused);
    if (outcome.exit_code == 4) {
      EXPECT_TRUE(has(outcome.err, "'write'")) << outcome.err;
      EXPECT_EQ(results.names(), Words{});
    }
    EXPECT_LE(outcome.peak_bytes, (mebi + 10) * kMebi) << outcome.err;
  }
  EXPECT_GE(done, 1);
  EXPECT_GE(refused, 1);
}

}  // namespace
}  // namespace dsc::test
