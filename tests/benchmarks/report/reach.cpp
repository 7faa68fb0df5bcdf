#include "tests/benchmarks/report/reach.h"

#include "tests/benchmarks/report/tables.h"

#include <fmt/core.h>

namespace report {
namespace {

constexpr double kPeerSpot = 125.;  // seconds of DGtal where the yardstick takes 1.0 s
constexpr double kTimesFaster = 20.;

class Rows {
 public:
  void add(const std::string& target, const std::string& now, bool reached) {
    text_ += fmt::format("| {} | {} | {} |\n", target, now, reached ? "yes" : "**no**");
  }
  std::string text() const { return "| target | now | reached |\n| --- | --- | --- |\n" + text_; }

 private:
  std::string text_;
};

void surface(const Figures& figures, Rows& rows) {
  const double touch = figures.rate("first_touch/threads:2");
  if (const Figure* f = figures.find("extract/n:515"); f != nullptr && touch > 0) {
    const double times = f->counter("cold") / (f->counter("kept") / touch);
    rows.add("extraction of 5 million faces, cold: ≤ 2 × the first touch of the same bytes",
             fmt::format("{:.2f} × ({:.0f} bytes a face)", times, f->counter("kept") / f->faces()),
             times <= 2);
    const double rate = f->faces() / f->seconds;
    rows.add("extraction, warm: ≥ 5 million faces a second",
             fmt::format("{:.2f} million", 1e-6 * rate), rate >= 5e6);
    const double bytes = f->counter("peak") / f->faces();
    rows.add("extraction: ≤ 250 bytes a face at the peak", fmt::format("{:.0f}", bytes),
             bytes <= 250);
  }
  if (const Figure* f = figures.find("scan")) {
    const double share = figures.share(*f).value_or(0);
    rows.add(
        "scan of a 1024³ volume at memory speed (≥ 80 % of the triad)",
        fmt::format("{:.1f} GB/s, {:.0f} %", 1e-9 * f->counter("bytes_per_second"), 100 * share),
        share >= 0.8);
  }
}

void normals(const Figures& figures, Rows& rows) {
  for (const int radius : {6, 12, 24}) {
    const double target = radius >= 12 ? 1.5 : 2.5;
    for (const auto& [what, name] :
         {std::pair{"the sums", fmt::format("sums/R:{}", radius)},
          std::pair{"the whole estimator, two threads",
                    fmt::format("normals/R:{}/n:193/threads:0", radius)}}) {
      const Figure* f = figures.find(name);
      if (f == nullptr) continue;
      const double now = f->counter("ns_per_row");
      rows.add(
          fmt::format("normals, R = {}, {}: ≤ {} ns a ball row and core", radius, what, target),
          fmt::format("{:.2f} ns", now), now <= target);
    }
  }
}

void geodesic(const Figures& figures, Rows& rows) {
  if (const Figure* f = figures.find("fill/n:515")) {
    const double times = 1 / figures.share(*f).value_or(1e-9);
    rows.add("numeric fill of L and M0, warm: ≤ 2 × streaming its inputs and outputs",
             fmt::format("{:.2f} ×", times), times <= 2);
  }
  const auto seconds = [&](const char* target, const char* name, double most) {
    const Figure* f = figures.find(name);
    if (f != nullptr) rows.add(target, duration(f->seconds), f->seconds <= most);
  };
  seconds("geodesic distance, spot 512³, after normals, first source: ≤ 3.5 s",
          "geodesic_first/n:0", 3.5);
  seconds("the same, a further source: ≤ 2 s, or what the next row has", "geodesic_further/n:0",
          2.);
  const Figure* prepare = figures.find("geodesic_prepare/n:0");
  const Figure* prepared = figures.find("geodesic_prepared/n:0");
  if (prepare != nullptr && prepared != nullptr) {
    rows.add("a source after a preparation: ≤ 0.5 s",
             fmt::format("{} (preparation {}, {:.0f} MB)", duration(prepared->seconds),
                         duration(prepare->seconds), 1e-6 * prepare->counter("peak")),
             prepared->seconds <= 0.5);
  }
  if (const auto exponent = figures.exponent("geodesic_first");
      exponent && figures.find("geodesic_first/n:515") != nullptr) {
    rows.add("growth of the geodesic distance, 0.1 to 5 million faces: exponent ≤ 1.15",
             fmt::format("{:.2f}", *exponent), *exponent <= 1.15);
  }
  if (const Figure* f = figures.find("geodesic_first/n:515")) {
    const double bytes = f->counter("resident");
    rows.add("geodesic distance, 5 million faces: ≤ 60 s and 8 GB",
             fmt::format("{}, {:.1f} GB", duration(f->seconds), 1e-9 * bytes),
             f->seconds <= 60 && bytes <= 8e9);
  }
}

void whole(const Figures& figures, const Jobs& jobs, Rows& rows) {
  const double yardstick = figures.rate("yardstick");
  if (jobs.spot && yardstick > 0) {
    const double most = kPeerSpot / yardstick / kTimesFaster;
    rows.add(
        fmt::format("spot 512³, the whole job: {:.0f} times faster than DGtal, ≤ {:.2f} s here",
                    kTimesFaster, most),
        duration(jobs.spot->seconds), jobs.spot->seconds <= most);
    rows.add("the same in ≤ 1 020 MB", fmt::format("{:.0f} MB", 1e-6 * jobs.spot->peak_bytes),
             jobs.spot->peak_bytes <= 1.02e9);
  }
  if (jobs.sphere && jobs.sphere->faces > 4.9e6) {
    rows.add("5 million faces with everything (R = 68): ≤ 2 minutes",
             duration(jobs.sphere->seconds), jobs.sphere->seconds <= 120);
  }
  if (jobs.large) {
    rows.add(
        "10 million faces on 24 GB",
        fmt::format("{:.1f} GB, {}", 1e-9 * jobs.large->peak_bytes, duration(jobs.large->seconds)),
        jobs.large->peak_bytes <= 24e9);
  }
  rows.add("start-up of dsc --help: ≤ 50 ms", duration(jobs.help_seconds),
           jobs.help_seconds <= 0.05);
  rows.add("start-up of dsc info: ≤ 50 ms", duration(jobs.info_seconds), jobs.info_seconds <= 0.05);
}

}  // namespace

std::string reach_table(const Figures& figures, const Jobs& jobs) {
  Rows rows;
  surface(figures, rows);
  normals(figures, rows);
  geodesic(figures, rows);
  whole(figures, jobs, rows);
  return rows.text();
}

}  // namespace report
