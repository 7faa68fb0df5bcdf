#include "libdsc/cli/report.h"

#include "libdsc/io/atomic_file.h"

#include <nlohmann/json.hpp>

#include <cmath>

#include <sys/resource.h>

namespace dsc::cli {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json numbers(const Vec3& v) { return Json::array({number(v[0]), number(v[1]), number(v[2])}); }

Json json_of(const InputReport& input) {
  const Mat3& d = input.direction;
  Json json = {{"name", input.name},
               {"size", input.size},
               {"spacing", numbers(input.spacing)},
               {"origin", numbers(input.origin)},
               {"direction", {numbers(d.row(0)), numbers(d.row(1)), numbers(d.row(2))}},
               {"voxels_inside", input.inside}};
  if (!input.grid.empty()) {
    json["grid"] = input.grid;
    if (input.volume_class != VolumeClass::values) json["class"] = name_of(input.volume_class);
    if (!input.chosen) json["inside_where"] = inside_of(input.volume_class);
  }
  if (input.labels) json["labels"] = *input.labels;
  return json;
}

Json json_of(const MeshInputReport& input) {
  return {{"name", input.name},
          {"kind", "mesh"},
          {"normals", input.normals},
          {"isolated_vertices", input.isolated_vertices},
          {"fields", input.fields}};
}

Json json_of(const SurfaceCounts& counts, Adjacency adjacency) {
  return {{"vertices", counts.vertices},
          {"edges", counts.edges},
          {"faces", counts.faces},
          {"components", counts.components},
          {"boundary_edges", counts.boundary_edges},
          {"nonmanifold_edges", counts.nonmanifold_edges},
          {"junction_edges", counts.junction_edges},
          {"pinched_vertices", counts.pinched_vertices},
          {"euler", counts.euler},
          {"adjacency", adjacency == Adjacency::interior ? "interior" : "exterior"}};
}

Json json_of(const NormalsReport& normals) {
  Json json = {{"estimator", normals.estimator},
               {"radius", number(normals.radius)},
               {"fallbacks", normals.fallbacks},
               {"cut_faces", normals.cut_faces}};
  if (normals.third_label_faces) json["third_label_faces"] = *normals.third_label_faces;
  return json;
}

Json json_of(const CalculusReport& calculus) {
  Json json = {{"kind", calculus.projected ? "projected" : "naive"},
               {"stabilisation", calculus.stabilisation}};
  if (calculus.lambda) json["lambda"] = number(*calculus.lambda);
  json["clamped_faces"] = calculus.clamped_faces;
  return json;
}

Json json_of(const SpectrumReport& spectrum) {
  Json json = {{"eigenvalues", spectrum.eigenvalues},
               {"residual", number(spectrum.residual)},
               {"rounds", spectrum.rounds}};
  if (spectrum.checkerboards) json["checkerboards_left_out"] = *spectrum.checkerboards;
  return json;
}

Json json_of(const PositionsReport& positions) {
  Json json = {{"kind", positions.kind}};
  if (positions.mean_displacement) json["mean_displacement"] = number(*positions.mean_displacement);
  if (positions.largest_displacement) {
    json["largest_displacement"] = number(*positions.largest_displacement);
  }
  if (positions.iterations) json["iterations"] = *positions.iterations;
  return json;
}

Json json_of(const PoissonReport& poisson) {
  return {{"fixed_vertices", poisson.fixed_vertices},
          {"free_components", poisson.free_components},
          {"removed_mean", number(poisson.removed_mean)},
          {"relative_residual", number(poisson.relative_residual)}};
}

Json json_of(const HeatReport& heat) {
  return {{"time", number(heat.time)},
          {"time_raised", heat.time_raised},
          {"method", heat.method},
          {"components_without_source", heat.components_without_source},
          {"flat_faces", heat.flat_faces},
          {"negative_faces", heat.negative_faces},
          {"raised_vertices", heat.raised_vertices},
          {"lowest_value", number(heat.lowest_value)},
          {"heat_residual", number(heat.heat_residual)},
          {"poisson_residual", number(heat.poisson_residual)},
          {"poisson_iterations", heat.poisson_iterations}};
}

Json json_of(const PictureReport& picture) {
  Json json = {{"file", picture.path}};
  if (!picture.field.empty()) json["field"] = picture.field;
  if (picture.colormap.empty()) return json;
  json["colormap"] = picture.colormap;
  json["range"] = {number(picture.low), number(picture.high)};
  json["isoline_step"] = number(picture.isoline_step);
  json["infinite"] = picture.infinite;
  return json;
}

Json json_of(const Timings& t) {
  return {{"read", number(t.read)},         {"extract", number(t.extract)},
          {"normals", number(t.normals)},   {"smooth", number(t.smooth)},
          {"assemble", number(t.assemble)}, {"factorize", number(t.factorize)},
          {"solve", number(t.solve)},       {"check", number(t.check)},
          {"write", number(t.write)},       {"total", number(t.total)}};
}

Json json_of(const std::string& name, const Statistics& s) {
  return {{"quantity", name},       {"min", number(s.min)}, {"max", number(s.max)},
          {"mean", number(s.mean)}, {"finite", s.finite},   {"infinite", s.infinite}};
}

Json json_of(const std::string& name, const ErrorNorms& e) {
  return {{"quantity", name},
          {"mean", number(e.mean)},
          {"max", number(e.max)},
          {"l2", number(e.l2)},
          {"left_out", e.left_out}};
}

}  // namespace

const char* name_of(VolumeClass volume_class) {
  switch (volume_class) {
    case VolumeClass::level_set:
      return "level set";
    case VolumeClass::fog_volume:
      return "fog volume";
    case VolumeClass::values:
      break;
  }
  return "";
}

const char* inside_of(VolumeClass volume_class) {
  switch (volume_class) {
    case VolumeClass::level_set:
      return "value < 0";
    case VolumeClass::fog_volume:
      return "value > 0";
    case VolumeClass::values:
      break;
  }
  return "value != 0";
}

Index peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return Index{usage.ru_maxrss} * 1024;
}

void write_report(const std::string& path, const Options& options, const Report& report) {
  Json json;
  json["program"] = std::string("dsc ") + DSC_VERSION;
  json["command"] = name_of(options.command);
  if (report.input) json["input"] = json_of(*report.input);
  if (report.mesh_input) json["input"] = json_of(*report.mesh_input);
  if (report.surface) json["surface"] = json_of(*report.surface, options.adjacency);
  if (report.mesh_input) json["surface"].erase("adjacency");  // a choice about voxels
  if (report.normals) json["normals"] = json_of(*report.normals);
  if (report.calculus) json["calculus"] = json_of(*report.calculus);
  if (report.spectrum) json["spectrum"] = json_of(*report.spectrum);
  if (report.positions) json["positions"] = json_of(*report.positions);
  if (report.poisson) json["poisson"] = json_of(*report.poisson);
  if (report.heat) json["heat"] = json_of(*report.heat);
  if (!report.source_vertices.empty()) json["source_vertices"] = report.source_vertices;
  if (report.result) json["result"] = json_of(report.result_name, *report.result);
  if (report.error) json["error"] = json_of(report.error_name, *report.error);
  for (const auto& [name, error] : report.further_errors) {
    json["further_errors"].push_back(json_of(name, error));
  }
  json["outputs"] = report.outputs;
  for (const PictureReport& picture : report.pictures) {
    json["pictures"].push_back(json_of(picture));
  }
  json["warnings"] = report.warnings;
  json["timings_s"] = json_of(report.timings);
  json["peak_memory_bytes"] = report.peak_memory_bytes;

  // A file name need not be UTF-8, as JSON must be.
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  AtomicFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace dsc::cli
