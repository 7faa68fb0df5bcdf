#include "tests/benchmarks/report/jobs.h"

#include "tests/benchmarks/report/process.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace report {
namespace {

using Json = nlohmann::json;

Job geodesic(const std::string& program, const std::string& name,
             const std::vector<std::string>& arguments) {
  const WorkFolder folder;
  std::vector<std::string> command{program, "geodesic"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  for (const std::string& word : {std::string("--quiet"), std::string("-o"), folder.file("out.vtp"),
                                  std::string("--report"), folder.file("report.json")}) {
    command.push_back(word);
  }
  fmt::print("{:<40}", name);
  std::fflush(stdout);
  const Finished finished = run(command);
  fmt::print(" {:.4g} s, {:.0f} MB\n", finished.seconds, 1e-6 * finished.peak_bytes);

  Json report;
  std::ifstream(folder.file("report.json")) >> report;
  Job job;
  job.name = name;
  job.faces = report.at("surface").at("faces").get<double>();
  job.seconds = finished.seconds;
  job.peak_bytes = finished.peak_bytes;
  for (const auto& [stage, seconds] : report.at("timings_s").items()) {
    job.stages[stage] = seconds.get<double>();
  }
  if (report.contains("error") && report["error"].is_object()) {
    job.error_mean = report["error"].at("mean").get<double>();
    job.error_max = report["error"].at("max").get<double>();
  }
  return job;
}

Job sphere_job(const std::string& program, int n, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"shape:sphere", "--gridstep", fmt::format("{:.17g}", 1. / n),
                                     "--source", "0.3,0.5,0.81"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return geodesic(program, fmt::format("unit sphere, h = 1/{}", n), arguments);
}

double start_up(const std::vector<std::string>& command) {
  std::vector<double> times;
  for (int i = 0; i < 20; ++i) times.push_back(run(command).seconds);
  std::sort(times.begin(), times.end());
  return 0.5 * (times[9] + times[10]);
}

/// Two voxels in a file of a few bytes.
void write_small_volume(const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file << "X: 4\nY: 4\nZ: 4\nVoxel-Size: 1\nInt-Endian: 0123\nVoxel-Endian: 0\nAlpha-Color: 0\n"
          "Version: 2\n.\n";
  for (int i = 0; i < 64; ++i) file.put(i == 21 || i == 22 ? '\1' : '\0');
}

}  // namespace

std::vector<const Job*> Jobs::all() const {
  std::vector<const Job*> jobs;
  for (const auto* job : {&spot, &sphere, &large}) {
    if (*job) jobs.push_back(&**job);
  }
  return jobs;
}

Jobs run_jobs(const std::string& program, Extent extent) {
  Jobs jobs;
  {
    const WorkFolder folder;
    const std::string small = folder.file("small.vol");
    write_small_volume(small);
    jobs.help_seconds = start_up({program, "--help"});
    jobs.info_seconds = start_up({program, "info", small});
  }
  const char* data = std::getenv("DSC_TEST_DATA");
  const std::string spot = std::string(data != nullptr ? data : ".") + "/spot-512.vol";
  if (extent != Extent::smoke && std::filesystem::exists(spot)) {
    jobs.spot = geodesic(program, "spot, 512³ voxels, R = 6",
                         {spot, "--radius", "6", "--source-vertex", "0"});
  }
  switch (extent) {
    case Extent::full:
      jobs.sphere = sphere_job(program, 515, {});
      // Balls of R = 6: with the default radius the normals alone take longer than all else.
      jobs.large = sphere_job(program, 729, {"--radius", fmt::format("{:.17g}", 6. / 729)});
      jobs.large->name += ", R = 6";
      break;
    case Extent::quick:
      jobs.sphere = sphere_job(program, 73, {});
      break;
    case Extent::smoke:
      jobs.sphere = sphere_job(program, 10, {});
      break;
  }
  return jobs;
}

}  // namespace report
