// Ctrl-C in every stage of a run, which the progress bar on a terminal names: the program ends
// within a second and leaves what was there.
#include "tests/cli/program.h"
#include "tests/io/image_bytes.h"
#include "tests/support/long_tests.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

namespace dsc::test {
namespace {

using Clock = std::chrono::steady_clock;

/// Fits a stage's name as the bar shows it, and a temporary file.
constexpr const char* kWriting = "a temporary file";
/// Of a job that draws no bar then: OpenMesh's reader does not tell how far it is.
constexpr const char* kUnseen = "read unseen";

class Terminal {
 public:
  Terminal() : ours_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    if (ours_ < 0 || ::grantpt(ours_) != 0 || ::unlockpt(ours_) != 0)
      throw std::runtime_error("pty");
    theirs_ = ::open(::ptsname(ours_), O_RDWR | O_NOCTTY);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() {
    ::close(ours_);
    ::close(theirs_);
  }
  int theirs() const { return theirs_; }
  /// What was drawn since the last call.
  std::string drawn(int wait_ms) const {
    pollfd file{ours_, POLLIN, 0};
    if (::poll(&file, 1, wait_ms) <= 0) return "";
    char buffer[4096];
    const ssize_t n = ::read(ours_, buffer, sizeof buffer);
    return {buffer, n > 0 ? static_cast<std::size_t>(n) : 0};
  }

 private:
  int ours_, theirs_ = -1;
};

struct Interrupted {
  bool seen = false;  ///< the stage, before the program ended
  Clock::duration took{};
  Outcome outcome;
};

/// Runs, and interrupts `after` the stage has begun.
Interrupted interrupt_in(const std::string& stage, const Words& words, const Folder& folder,
                         std::chrono::milliseconds after) {
  const Terminal terminal;
  Interrupted result;
  Clock::time_point sent;
  std::atomic<bool> done{false};
  std::thread reader;  // the bar goes on, and a full terminal would block it
  result.outcome = run_dsc(
      words, [&] { ::dup2(terminal.theirs(), STDERR_FILENO); },
      [&](int child) {
        std::string text;
        while (!has_ended(child) && !result.seen) {
          text += terminal.drawn(5);
          if (stage == kUnseen) {
            result.seen = true;
          } else if (stage == kWriting) {
            for (const std::string& name : folder.names()) {
              result.seen = result.seen || name.find(".tmp-") != std::string::npos;
            }
          } else {
            result.seen = text.find("\033[K" + stage + "  ") != std::string::npos;
          }
        }
        std::this_thread::sleep_for(after);
        sent = Clock::now();
        ::kill(child, SIGINT);
        reader = std::thread([&] {
          while (!done) (void)terminal.drawn(5);
        });
      });
  result.took = Clock::now() - sent;
  done = true;
  reader.join();
  return result;
}

struct Stage {
  const char* name;
  Words job;      ///< spends some time in that stage
  int later = 0;  ///< milliseconds from its begin to the work that the bar has no name for
  std::string ending = "ply";  ///< of the second file; the first is r.csv, or r.vol of voxels
};

/// A compressed volume of n^3 voxels; `value` of each.
template <class Value>
void write_vol(const std::string& path, int n, const Value& value) {
  const std::string side = std::to_string(n);
  const std::string header = "X: " + side + "\nY: " + side + "\nZ: " + side +
                             "\nVoxel-Size: 1\nAlpha-Color: 0\nVoxel-Endian: 0\nInt-Endian: 0123\n"
                             "Version: 3\n.\n";
  std::string slice(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), '\0');
  z_stream stream{};
  deflateInit(&stream, 1);
  std::string packed, buffer(1 << 20, '\0');
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        slice[static_cast<std::size_t>(y * n + x)] = static_cast<char>(value(x, y, z));
      }
    }
    stream.next_in = reinterpret_cast<Bytef*>(slice.data());
    stream.avail_in = static_cast<uInt>(slice.size());
    do {
      stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
      stream.avail_out = static_cast<uInt>(buffer.size());
      deflate(&stream, z + 1 == n ? Z_FINISH : Z_NO_FLUSH);
      packed.append(buffer, 0, buffer.size() - stream.avail_out);
    } while (stream.avail_out == 0);
  }
  deflateEnd(&stream);
  write_file(path, header + packed);
}

const Words kFine = {"shape:sphere", "--gridstep", "0.006", "--estimator", "trivial"};
const Words kFinest = {"shape:sphere", "--gridstep", "0.004"};
const Words kMiddle = {"shape:sphere", "--gridstep", "0.01"};
constexpr const char* kBig = "big.vol";      ///< 600^3 voxels, one of them inside
constexpr const char* kRough = "rough.vol";  ///< random labels: every other face is a surfel
constexpr const char* kImage = "image.mha";  ///< 300^3 voxels

std::vector<Stage> all_stages() {
  const Words source = {"--source-vertex", "0"};
  const Words diffuse = Words{"diffuse", kRough, "--time", "1", "--calculus", "naive"} + source;
  std::vector<Stage> all = {
      {"read", {"surface", kBig, "--labels", "all"}},
      {"read", {"surface", "mesh.off"}},
      {"read", {"surface", "mesh.ply"}},
      {"read", {"surface", "mesh.obj"}},
      {"read", {"surface", "mesh.stl"}},
      {kUnseen, {"surface", "mesh.om"}, 400},
      {"read", {"surface", "ball.npy", "--labels", "all"}},
      {"read", {"surface", "ball.vti", "--labels", "all"}},
      {"digitize",
       {"surface", "shape:expr:sin(3*x)*cos(2*y)+z^2+x^2+y^2-1;box=-2,2", "--gridstep", "0.008"}},
      {"scan", {"surface", kBig}},
      {"extract", {"surface", kRough}},
      {"link", {"surface", kRough}},
      {"compare labels", {"surface", kBig, "--labels", "all"}},
      {"normals", Words{"normals", "--radius", "0.9"} + kMiddle},
      {"normals", {"normals", "--estimator", "trivial", kRough}},
      {"normals", {"normals", "--estimator", "analytic", "shape:goursat", "--gridstep", "0.02"}},
      {"curvature", Words{"curvature", "--radius", "0.9"} + kMiddle},
      {"averages", Words{"curvature", "--on", "vertex", "--radius", "0.012"} + kFinest},
      {"project",
       {"gradient", "--function", "x", "shape:goursat", "--gridstep", "0.03", "--estimator",
        "trivial"}},
      {"evaluate",
       {"gradient", kRough, "--calculus", "naive", "--function",
        "sin(x)*cos(y)*sin(z)*exp(sin(cos(x)))"}},
      {"gradient", {"gradient", kRough, "--calculus", "naive", "--function", "x"}},
      {"laplacian pattern", diffuse},
      {"laplacian", diffuse},
      {"spectrum", Words{"spectrum", "-k", "60", "--estimator", "trivial"} + kMiddle},
      {"regularise", Words{"surface", "--regularise"} + Words(kFine.begin(), kFine.begin() + 3)},
      {"assemble", Words{"geodesic"} + source + kFine},
      {"factorize", Words{"geodesic"} + source + kFine},
      {"heat", Words{"geodesic"} + source + kFine},
      {"distance", Words{"geodesic"} + source + kFine},
      {"distance", Words{"geodesic"} + source + kFine, 300},
      {"divergence", Words{"geodesic"} + source + kFine},
      {"checkerboards", Words{"poisson", "--rhs", "x*y", "--stabilisation", "mercat"} + kFine},
      {"set up multigrid", Words{"poisson", "--rhs", "x*y"} + kFine},
      {"set up multigrid", Words{"poisson", "--rhs", "x*y"} + kFine, 600},
      {"solve", Words{"poisson", "--rhs", "x*y"} + kFine},
      {kWriting, Words{"surface"} + Words(kFine.begin(), kFine.begin() + 3)},
      {kWriting, Words{"normals"} + kFine, 60},
      {"write", {"voxels", kBig}, 0, "vti"},
      {"write", {"voxels", kBig, "--labels", "all"}, 300, "vti"},
      {"write", Words{"normals"} + kFine, 0, "glb"},
  };
#ifdef DSC_IMAGE_READER
  all.push_back({"read", {"surface", kImage, "--labels", "all"}});
#endif
  for (const std::string& ending : seen_endings()) {
    const bool picture = ending == "png";
    const Words size = picture ? Words{"--picture-size", "4000,3000"} : Words{};
    for (const int later : {0, 300}) {
      all.push_back({picture ? "draw" : "page", Words{"normals"} + kFine + size, later, ending});
    }
  }
  return all;
}

const std::vector<Stage>& stages() {
  static const std::vector<Stage> all = all_stages();
  return all;
}

/// Makes the input that `word` names, in `inputs`, and returns its path.
std::string made_input(const std::string& word, const Folder& inputs) {
  const std::string path = inputs / word;
  std::mt19937 random(3);
  if (word == kBig) {
    write_vol(path, 600, [](int x, int y, int z) { return x == 5 && y == 5 && z == 5 ? 2 : 0; });
  } else if (word == kRough) {
    write_vol(path, 110, [&](int, int, int) { return random() % 3; });
  } else if (word == kImage) {
    TestImage image;
    image.size = {300, 300, 300};
    write_file(path, mha_bytes(image) + std::string(54000000, '\1'));
  } else if (word.starts_with("mesh.")) {
    EXPECT_EQ(run_dsc(Words{"surface", "-o", path} + kFinest).exit_code, 0);
  } else if (word.starts_with("ball.")) {  // 600^3 voxels
    EXPECT_EQ(run_dsc({"voxels", "shape:sphere", "--gridstep", "0.0034", "-o", path}).exit_code, 0);
  } else {
    return word;
  }
  return path;
}

/// One test a stage, which CTest can run side by side.
class InterruptStage : public ::testing::TestWithParam<std::size_t> {};

TEST_P(InterruptStage, EndsWithinASecondAndLeavesWhatWasThere) {
  const Stage& stage = stages()[GetParam()];
  const Folder inputs;
  Words job;
  for (const std::string& word : stage.job) job.push_back(made_input(word, inputs));
  const std::string old = job[0] == "voxels" ? "r.vol" : "r.csv", other = "r." + stage.ending;
  for (const int after :
       testing::usually_or_long(std::vector<int>{10}, std::vector<int>{0, 20, 70, 150})) {
    // A stage shorter than it takes to see its name may be over: then once more.
    Interrupted run;
    for (int attempt = 0; attempt < 8 && !run.seen; ++attempt) {
      const Folder folder;
      write_file(folder / old, "old");
      Words words = job;
      words = words + Words{"-o", folder / old, "-o", folder / other};
      words = words + Words{"--report", folder / "r.json"};
      run = interrupt_in(stage.name, words, folder, std::chrono::milliseconds(after + stage.later));
      if (run.outcome.exit_code == 0) {
        EXPECT_LT(run.took, interrupt_limit());
        run.seen = false;
      }
      if (!run.seen) continue;
      EXPECT_EQ(run.outcome.exit_code, 130);
      EXPECT_EQ(folder.names(), Words{old});
      EXPECT_TRUE(read_file(folder / old) == "old");
      EXPECT_LT(run.took, interrupt_limit());
    }
    EXPECT_TRUE(run.seen || after > 10) << "the stage was not met";  // a late signal may miss it
    std::printf(
        "%-18s %-10s %4d ms: ended after %4ld ms\n", stage.name, stage.job[0].c_str(),
        after + stage.later,
        static_cast<long>(std::chrono::duration_cast<std::chrono::milliseconds>(run.took).count()));
  }
}

INSTANTIATE_TEST_SUITE_P(All, InterruptStage, ::testing::Range<std::size_t>(0, stages().size()),
                         [](const auto& place) {
                           std::string name = stages()[place.param].name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name + "_" + std::to_string(place.param);
                         });

}  // namespace
}  // namespace dsc::test
