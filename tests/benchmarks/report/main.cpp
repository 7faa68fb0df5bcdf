// dsc_benchmark_report [--quick|--smoke] <benchmarks> <dsc> <folder>: runs the benchmarks and whole
// jobs, and rewrites <folder>/RESULTS.md; <folder>/notes.md is copied into it. --quick leaves out
// the large surfaces and prints what it finds instead; --smoke takes the smallest only.
#include "tests/benchmarks/report/process.h"
#include "tests/benchmarks/report/reach.h"
#include "tests/benchmarks/report/tables.h"

#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace report {
namespace {

std::string contents(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    if (line.starts_with("model name")) return line.substr(line.find(": ") + 2);
  }
  return "unknown processor";
}

std::string results(const std::string& benchmarks, const std::string& program,
                    const std::string& folder, Extent extent) {
  const std::string notes = contents(folder + "/notes.md");
  const auto begin = std::chrono::steady_clock::now();
  const Figures figures(benchmarks, extent);
  const Jobs jobs = run_jobs(program, extent);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;

  std::string text = fmt::format(
      "# Results\n\nWritten by `./cmake/bootstrap.sh benchmarks`, in {:.0f} s, on {} cores of an "
      "{}.\n"
      "Explanations are kept in `notes.md`.\n\n",
      took.count(), std::thread::hardware_concurrency(), processor());
  text += "## Reach\n\n" + reach_table(figures, jobs) + "\n" + notes + "\n";
  text += "## Ceilings\n\n" + ceilings_table(figures) + "\n";
  text +=
      "## Stages\n\nSurfaces are unit spheres, whose faces have the sphere's own normals, and "
      "spot-512. "
      "Times are of warm memory (the\nmedian of repeats) where a run takes less than 4 s; `cold` "
      "is the "
      "first run of a process. The peak is what the stage\ntakes beyond its input. The share of "
      "the "
      "ceiling is that of the floor, stated in the stage's source, in the time. Growth\nis the "
      "exponent "
      "from 0.1 million faces on. Errors are lengths on the unit sphere; of the spectrum, "
      "eigenvalues.\n\n" +
      stages_table(figures) + "\n";
  text +=
      "## Normals\n\n`sums` are the moments of the balls alone, on one thread, by bricks or by "
      "rows as the estimator chooses; "
      "`normals` is the whole "
      "estimator, on every core (threads:0) or one.\n\n" +
      normals_table(figures) + "\n";
  text += "## Whole jobs\n\n" + jobs_table(jobs);
  const std::string peer = peer_table(figures, jobs);
  if (!peer.empty()) text += "\n" + peer;
  return text;
}

int run_report(std::vector<std::string> arguments) {
  Extent extent = Extent::full;
  if (!arguments.empty() && arguments[0].starts_with("--")) {
    if (arguments[0] == "--quick") {
      extent = Extent::quick;
    } else if (arguments[0] == "--smoke") {
      extent = Extent::smoke;
    } else {
      throw std::runtime_error("unknown option " + arguments[0]);
    }
    arguments.erase(arguments.begin());
  }
  if (arguments.size() != 3) {
    throw std::runtime_error(
        "usage: dsc_benchmark_report [--quick|--smoke] <benchmarks> <dsc> <folder>");
  }
  const std::string& folder = arguments[2];
  const std::string text = results(arguments[0], arguments[1], folder, extent);
  if (extent != Extent::full) {
    fmt::print("\n{}", text);
    return 0;
  }
  const std::string target = folder + "/RESULTS.md";
  std::ofstream file(target + ".new");
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + target);
  std::filesystem::rename(target + ".new", target);
  fmt::print("\nWritten: {}\n", target);
  return 0;
}

}  // namespace
}  // namespace report

int main(int argc, char** argv) {
  try {
    return report::run_report({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "dsc_benchmark_report: {}\n", error.what());
    return 1;
  }
}
