// The corpus of the fuzzers, read as they do, by any compiler. The names tell what must come out:
// read-… is read whole, refuse-… is an error.
#include "tests/fuzz/fuzz.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace dsc::fuzz {
namespace {

using Target = void (*)(std::string_view);
const std::map<std::string, Target> kTargets{{"vol", fuzz_vol},
                                             {"longvol", fuzz_longvol},
                                             {"npy", fuzz_npy},
                                             {"raw", fuzz_raw},
                                             {"vox", fuzz_vox},
                                             {"vti", fuzz_vti},
                                             {"off", fuzz_off},
                                             {"obj", fuzz_obj},
                                             {"ply", fuzz_ply},
                                             {"stl", fuzz_stl},
                                             {"om", fuzz_om},
                                             {"shape", fuzz_shape},
                                             {"expression", fuzz_expression}};

std::string corpus(const std::string& name) { return DSC_FUZZ_CORPUS "/" + name; }

/// What came out of a file of the corpus, in the words of its name.
std::string result_of(const std::string& error) { return error.empty() ? "read" : "refuse"; }

TEST(FuzzCorpus, EveryFileIsReadOrRefusedAsItsNameSays) {
  for (const auto& [name, target] : kTargets) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(corpus(name))) {
      SCOPED_TRACE(entry.path().string());
      const std::string file = entry.path().filename().string();
      const std::string error = outcome(target, read_all(entry.path().string()));
      EXPECT_EQ(result_of(error), file.substr(0, file.find('-'))) << error;
      ++files;
    }
    EXPECT_GE(files, 4U) << name;
  }
}

/// What the fuzzers found, made small, and what has to come of it now.
struct Finding {
  const char* file;
  const char* part;  ///< of the message
};
class FuzzFinding : public testing::TestWithParam<Finding> {};

TEST_P(FuzzFinding, HasItsOutcome) {
  const std::string file = GetParam().file;
  const std::string error =
      outcome(kTargets.at(file.substr(0, file.find('/'))), read_all(corpus(file)));
  EXPECT_NE(error.find(GetParam().part), std::string::npos) << error;
  if (*GetParam().part == '\0') {
    EXPECT_EQ(error, "");
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, FuzzFinding,
    testing::Values(
        // Bytes of the file went to the terminal as they were.
        Finding{"vol/refuse-control-characters", "'?[2J?'"},
        Finding{"off/refuse-control-characters", "'?[2J' is not"},
        // A key of 800 characters came whole.
        Finding{"npy/refuse-long-key", " ... "},
        // No bound: memory for 2^31 - 1 vertices was asked for.
        Finding{"ply/refuse-vertices-of-nothing", "lack x, y or z"},
        // Pointers were moved away from null, numbers beyond integers made integers.
        Finding{"ply/read-no-vertex", ""}, Finding{"ply/refuse-corner-beyond-integers", "1e+300"},
        // 2^32 as a float is the largest label rounded up, and no label.
        Finding{"npy/read-label-beyond", ""},
        // OpenMesh wrote to vertices that were not there yet, and read properties into others of
        // the same name, its own among them.
        Finding{"om/read-vertices-last", ""}, Finding{"om/read-property-first", ""},
        Finding{"om/read-names-of-openmesh", ""},
        Finding{"om/refuse-property-twice", "'h' comes twice"},
        Finding{"om/refuse-positions-with-a-name", "has a name"},
        // Two fields of one name, which could not be written.
        Finding{"om/read-a-vector-called-as-a-scalar", ""},
        // The name of a plane made another plane.
        Finding{"shape/read-plane-of-5-0-4", ""}),
    [](const auto& finding) {
      std::string name = finding.param.file;
      std::replace_if(
          name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
      return name;
    });

TEST(FuzzCorpus, ABrokenPromiseIsSeen) {
  EXPECT_THROW((void)outcome([](std::string_view) { require(false, "nothing"); }, ""), Broken);
  EXPECT_THROW((void)outcome([](std::string_view) { throw std::bad_alloc(); }, ""), std::bad_alloc);
}

}  // namespace
}  // namespace dsc::fuzz
