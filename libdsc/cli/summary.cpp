// The text that a run prints: a column of names, a column of what they are.
#include "libdsc/cli/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dsc::cli {
namespace {

std::string line(std::string_view name, const std::string& text) {
  return fmt::format("{:<10} {}\n", name, text);
}

std::string counted(Index n, std::string_view singular, std::string_view plural) {
  return fmt::format("{} {}", n, n == 1 ? singular : plural);
}

std::string text_of(const SurfaceCounts& c) {
  std::string text = fmt::format("{}, {}, {}, Euler number {}", counted(c.faces, "face", "faces"),
                                 counted(c.vertices, "vertex", "vertices"),
                                 counted(c.components, "component", "components"), c.euler);
  if (c.boundary_edges > 0)
    text += ", " + counted(c.boundary_edges, "boundary edge", "boundary edges");
  if (c.nonmanifold_edges > 0) {
    text += ", " + counted(c.nonmanifold_edges, "non-manifold edge", "non-manifold edges");
  }
  if (c.junction_edges > 0) {
    text += ", " + counted(c.junction_edges, "junction edge", "junction edges");
  }
  if (c.pinched_vertices > 0) {
    text += ", " + counted(c.pinched_vertices, "pinched vertex", "pinched vertices");
  }
  return text;
}

std::string text_of(const InputReport& input) {
  const auto& [x, y, z] = input.size;
  const Vec3& h = input.spacing;
  const std::string spacing = h[0] == h[1] && h[1] == h[2]
                                  ? fmt::format("{:g}", h[0])
                                  : fmt::format("{:g} x {:g} x {:g}", h[0], h[1], h[2]);
  std::string text = fmt::format("{}: {} x {} x {} voxels of {}, {} inside", input.name, x, y, z,
                                 spacing, input.inside);
  if (!input.grid.empty()) {
    text += ", grid '" + input.grid + "'";
    if (input.volume_class != VolumeClass::values) {
      text += std::string(", a ") + name_of(input.volume_class);
      if (!input.chosen) text += std::string(" (") + inside_of(input.volume_class) + ")";
    }
  }
  if (input.labels) text += ", " + counted(*input.labels, "label", "labels");
  return text;
}

std::string text_of(const MeshInputReport& input) {
  std::string text = input.name + (input.normals ? ": a mesh with normals" : ": a mesh");
  for (const std::string& field : input.fields) text += ", " + field;
  if (input.isolated_vertices > 0) {
    text += "; " + counted(input.isolated_vertices, "vertex", "vertices") + " without faces";
  }
  return text;
}

std::string text_of(const NormalsReport& normals) {
  std::string text = normals.estimator == "ii" ? "integral invariant" : normals.estimator;
  if (normals.radius > 0) text += fmt::format(", radius {:.4g}", normals.radius);
  if (normals.fallbacks > 0) text += ", " + counted(normals.fallbacks, "fallback", "fallbacks");
  if (normals.cut_faces > 0) {
    text += ", continued beyond the border near " + counted(normals.cut_faces, "face", "faces");
  }
  if (normals.third_label_faces.value_or(0) > 0) {
    text += ", a third label near " + counted(*normals.third_label_faces, "face", "faces");
  }
  return text;
}

std::string text_of(const Timings& t) {
  std::string parts;
  const auto add = [&](const char* name, double seconds) {
    if (seconds >= 0.005)
      parts += fmt::format("{}{} {:.2f}", parts.empty() ? "" : ", ", name, seconds);
  };
  add("read", t.read);
  add("extract", t.extract);
  add("normals", t.normals);
  add("smooth", t.smooth);
  add("assemble", t.assemble);
  add("factorize", t.factorize);
  add("solve", t.solve);
  add("check", t.check);
  add("write", t.write);
  return fmt::format("{:.2f} s", t.total) + (parts.empty() ? "" : " (" + parts + ")");
}

}  // namespace

std::string summary(const Report& report) {
  std::string text;
  if (report.input) text += line("input", text_of(*report.input));
  if (report.mesh_input) text += line("input", text_of(*report.mesh_input));
  if (report.surface) text += line("surface", text_of(*report.surface));
  if (report.normals) text += line("normals", text_of(*report.normals));
  if (report.calculus) {
    const CalculusReport& c = *report.calculus;
    const std::string weight = c.lambda ? fmt::format("lambda {:g}", *c.lambda) : c.stabilisation;
    text +=
        line("calculus", fmt::format("{}, {}, {}", c.projected ? "projected" : "naive", weight,
                                     counted(c.clamped_faces, "clamped face", "clamped faces")));
  }
  if (report.spectrum) {
    constexpr std::size_t kShown = 16;
    const std::vector<double>& all = report.spectrum->eigenvalues;
    std::string values;
    for (std::size_t k = 0; k < std::min(kShown, all.size()); ++k) {
      // Zero up to rounding, in the size of its neighbours.
      const double value = std::abs(all[k]) < 1e-9 * std::abs(all.back()) ? 0. : all[k];
      values += fmt::format("{}{:.5g}", k == 0 ? "" : ", ", value);
    }
    if (all.size() > kShown) values += ", ...";
    if (report.spectrum->checkerboards) {
      values += fmt::format("; {} between them left out", counted(*report.spectrum->checkerboards,
                                                                  "checkerboard", "checkerboards"));
    }
    text += line("spectrum", values);
  }
  if (report.positions) {
    const PositionsReport& p = *report.positions;
    std::string moved = p.kind;
    if (p.mean_displacement) {
      moved += fmt::format(", moved by {:.4g} on average, {:.4g} at most", *p.mean_displacement,
                           *p.largest_displacement);
    }
    text += line("positions", moved);
  }
  if (report.heat) {
    const HeatReport& heat = *report.heat;
    std::string values = fmt::format("t = {:.4g}, {}", heat.time, heat.method);
    const auto add = [&](Index count, const char* one, const char* many) {
      if (count > 0) values += ", " + counted(count, one, many);
    };
    add(heat.negative_faces, "face with heat below zero", "faces with heat below zero");
    add(heat.flat_faces, "face without a direction", "faces without a direction");
    add(heat.raised_vertices, "vertex raised to 0", "vertices raised to 0");
    text += line("heat", values);
  }
  if (report.poisson) {
    const PoissonReport& p = *report.poisson;
    const bool mercat = report.calculus && report.calculus->stabilisation == "mercat";
    std::string values = counted(p.fixed_vertices, "fixed vertex", "fixed vertices");
    if (p.free_components > 0) {
      values += fmt::format(", {} without one, mean {:.4g} removed",
                            counted(p.free_components, mercat ? "parity" : "component",
                                    mercat ? "parities" : "components"),
                            p.removed_mean);
    }
    text += line("poisson", values);
  }
  if (report.result) {
    const Statistics& s = *report.result;
    std::string values = fmt::format("min {:.6g}, max {:.6g}, mean {:.6g}", s.min, s.max, s.mean);
    if (s.infinite > 0) values += fmt::format(", {} infinite", s.infinite);
    text += line(report.result_name, values);
  }
  if (report.error) {
    const ErrorNorms& e = *report.error;
    text += line("error", fmt::format("mean {:.4g}, max {:.4g}, l2 {:.4g} ({})", e.mean, e.max,
                                      e.l2, report.error_name));
  }
  for (const auto& [name, e] : report.further_errors) {
    text +=
        line("", fmt::format("mean {:.4g}, max {:.4g}, l2 {:.4g} ({})", e.mean, e.max, e.l2, name));
  }
  for (const std::string& path : report.outputs) text += line("written", path);
  text += line("time", fmt::format("{}; peak memory {:.0f} MB", text_of(report.timings),
                                   static_cast<double>(report.peak_memory_bytes) / 1e6));
  return text;
}

}  // namespace dsc::cli
