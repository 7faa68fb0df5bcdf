#include "tests/benchmarks/report/tables.h"

#include <fmt/core.h>

#include <cmath>

namespace report {
namespace {

/// Three digits, without an exponent.
std::string digits(double value) {
  if (!(value > 0)) return "0";
  const int decimals = 2 - static_cast<int>(std::floor(std::log10(value)));
  return fmt::format("{:.{}f}", value, std::max(0, decimals));
}

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{} %", digits(100. * *share)) : "–";
}

std::string millions(double faces) {
  return faces < 1e6 ? fmt::format("{:.0f} k", 1e-3 * faces)
                     : fmt::format("{:.2f} M", 1e-6 * faces);
}

std::string errors(const Figure& figure) {
  const auto mean = figure.maybe("error_mean");
  const auto max = figure.maybe("error_max");
  return mean && max ? fmt::format("{:.2g} ({:.2g})", *mean, *max) : "–";
}

bool is_normals(const std::string& family) {
  return family.starts_with("sums") || family.starts_with("normals");
}

}  // namespace

std::string duration(double seconds) {
  if (seconds < 1e-3) return digits(1e6 * seconds) + " µs";
  if (seconds < 1) return digits(1e3 * seconds) + " ms";
  return digits(seconds) + " s";
}

std::string ceilings_table(const Figures& figures) {
  std::string text = "| ceiling | |\n| --- | ---: |\n";
  const auto row = [&](const char* name, const std::string& ceiling, double unit,
                       const char* unit_name) {
    const double rate = figures.rate(ceiling);
    text += rate > 0 ? fmt::format("| {} | {} {} |\n", name, digits(rate / unit), unit_name)
                     : fmt::format("| {} | – |\n", name);
  };
  row("triad, 1 thread", "triad/threads:1", 1e9, "GB/s");
  row("triad, 2 threads", "triad/threads:2", 1e9, "GB/s");
  row("first touch of memory, 1 thread", "first_touch/threads:1", 1e9, "GB/s");
  row("first touch of memory, 2 threads", "first_touch/threads:2", 1e9, "GB/s");
  row("words counted (popcount), 1 thread", "popcount", 1e9, "G/s");
  row("byte shuffles of 32 bytes, 1 thread", "shuffles", 1e9, "G/s");
  row("multiply-adds of doubles (AVX2), 1 thread", "fma", 1e9, "G/s");
  const double yardstick = figures.rate("yardstick");
  text += fmt::format("| yardstick (the peer's machine: 1.0 s) | {} |\n",
                      yardstick > 0 ? duration(1 / yardstick) : "–");
  return text;
}

std::string stages_table(const Figures& figures) {
  std::string text =
      "| stage | faces | time | a face | of its ceiling | cold | peak, bytes a face | error, mean "
      "(max) | "
      "growth |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const std::string& family : figures.families()) {
    if (is_normals(family)) continue;
    const auto exponent = figures.exponent(family);
    const auto members = figures.family(family);
    for (const Figure* f : members) {
      const bool spot = f->name.find("/n:0") != std::string::npos;
      text += fmt::format("| {}{} | {} | {} | {:.1f} ns | {} | {} | {:.0f} | {} | {} |\n", family,
                          spot ? ", spot" : "", millions(f->faces()), duration(f->seconds),
                          1e9 * f->seconds / f->faces(), percent(figures.share(*f)),
                          duration(f->counter("cold")), f->counter("peak") / f->faces(), errors(*f),
                          f == members.back() && exponent ? fmt::format("{:.2f}", *exponent) : "");
    }
  }
  return text;
}

std::string normals_table(const Figures& figures) {
  std::string text =
      "| | faces | time | ns a row and core | of its ceiling | peak, bytes a face | error in "
      "degrees, "
      "mean (max) | growth |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const std::string& family : figures.families()) {
    if (!is_normals(family)) continue;
    const auto exponent = figures.exponent(family);
    const auto members = figures.family(family);
    for (const Figure* f : members) {
      const auto wrong = f->maybe("wrong_balls");
      text += fmt::format(
          "| {} | {} | {} | {:.2f} | {} | {:.0f} | {} | {} |\n", family, millions(f->faces()),
          duration(f->seconds), f->counter("ns_per_row"), percent(figures.share(*f)),
          f->counter("peak") / f->faces(),
          wrong ? fmt::format("{:.0f} balls unlike the plain scan", *wrong) : errors(*f),
          f == members.back() && exponent ? fmt::format("{:.2f}", *exponent) : "");
    }
  }
  return text;
}

std::string jobs_table(const Jobs& jobs) {
  std::string text =
      "| `dsc geodesic` | faces | read, digitize | extract | normals | assemble | factorize | "
      "solve | "
      "write | all | peak memory | error, mean (max) |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const Job* job : jobs.all()) {
    text += fmt::format("| {} | {} |", job->name, millions(job->faces));
    for (const char* stage :
         {"read", "extract", "normals", "assemble", "factorize", "solve", "write"}) {
      text += fmt::format(" {:.2f} s |", job->stages.at(stage));
    }
    text += fmt::format(
        " {:.2f} s | {:.0f} MB | {} |\n", job->seconds, 1e-6 * job->peak_bytes,
        job->error_mean ? fmt::format("{:.4f} ({:.4f})", *job->error_mean, *job->error_max) : "–");
  }
  text += fmt::format("\n`dsc --help` takes {}, `dsc info` on a small file {} (medians of 20).\n",
                      duration(jobs.help_seconds), duration(jobs.info_seconds));
  return text;
}

std::string peer_table(const Figures& figures, const Jobs& jobs) {
  const double yardstick = figures.rate("yardstick");
  if (!jobs.spot || !(yardstick > 0)) return {};
  const auto& stages = jobs.spot->stages;
  std::string text =
      "| spot, 512³ voxels | DGtal, scaled | here | times faster |\n| --- | ---: | ---: | ---: |\n";
  const auto row = [&](const char* name, double peer, double here) {
    text += fmt::format("| {} | {:.1f} s | {} | {} |\n", name, peer / yardstick, duration(here),
                        digits(peer / yardstick / here));
  };
  // One thread of DGtal on a machine where the yardstick takes 1.0 s.
  row("read the .vol file", 6.9, stages.at("read"));
  row("find the surfels, build the mesh", 7.2 + 8.5, stages.at("extract"));
  row("integral invariant normals, R = 6", 12.6, stages.at("normals"));
  row("assemble, factorize, one distance field", 83.9 + 3.9,
      stages.at("assemble") + stages.at("factorize") + stages.at("solve"));
  row("all", 125., jobs.spot->seconds);
  return text;
}

}  // namespace report
