#include "libdsc/cli/stages.h"

#include "libdsc/base/error.h"
#include "libdsc/calculus/embedding.h"
#include "libdsc/cli/picture_options.h"
#include "libdsc/cli/picture_output.h"
#include "libdsc/io/world_result.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/page/page.h"
#include "libdsc/render/glb_file.h"
#include "libdsc/solve/matrix_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace dsc::cli {

namespace {

/// The labels of the faces as fields.
class LabelColumns {
 public:
  explicit LabelColumns(std::span<const LabelPair> labels)
      : inner_(static_cast<Index>(labels.size())), outer_(inner_.size()) {
    for (std::size_t f = 0; f < labels.size(); ++f) {
      inner_[static_cast<Index>(f)] = labels[f][0];
      outer_[static_cast<Index>(f)] = labels[f][1];
    }
  }
  void append_to(std::vector<Field>& fields) const {
    if (inner_.size() == 0) return;
    fields.push_back(scalar_field("label_inner", FieldOn::face, inner_));
    fields.push_back(scalar_field("label_outer", FieldOn::face, outer_));
  }

 private:
  Eigen::VectorXd inner_, outer_;
};

/// \throws InputError where it has no face, though voxels are inside.
DigitalSurface extract(const Input& input, Run& run) {
  const Stopwatch watch(run.report.timings.extract);
  ExtractOptions options;
  options.adjacency = run.options.adjacency;
  options.border = input.border;
  options.part = input.part;
  options.between = run.options.between;
  DigitalSurface surface =
      std::visit([&](const auto& volume) { return extract_surface(volume, options, run.context); },
                 input.voxels);
  run.report.surface = surface.counts();
  if (surface.face_count() == 0) {
    if (!options.between.empty()) {
      throw InputError("'" + run.options.input + "': no face lies between the labels given");
    }
    throw InputError("'" + run.options.input +
                     "': the surface has no face; its sides on the border of the volume were left "
                     "open");
  }
  return surface;
}

}  // namespace

Scene open_scene(Run& run) {
  if (is_mesh_input(run.options)) return {Input{}, DigitalSurface(), read_mesh_input(run)};
  Input input = read_input(run);
  DigitalSurface surface = extract(input, run);
  return {std::move(input), std::move(surface), {}};
}

Beyond beyond_of(const Input& input) {
  // Shapes go on by themselves: their volume is wider than the surface.
  const bool cut = input.border == Border::open && !input.shape;
  return cut ? Beyond::continued : Beyond::empty;
}

void check_default_radius(const Input& input, double radius, Run& run) {
  if (run.options.radius || !input.shape) return;
  const double half = 0.5 * input.shape->bounds().sizes().minCoeff();
  const double voxel = input.grid().spacing.maxCoeff();
  if (radius <= half && radius >= 2. * voxel) return;
  std::ostringstream text;
  text << "the default radius, 3 h^(1/2) = " << radius
       << ", is for shapes of unit size; this one is " << 2. * half << " thick and its voxels "
       << voxel << ": choose another by --radius";
  run.warn(text.str());
}

void estimate_normals(Scene& scene, Run& run) {
  const Input& input = scene.input;
  DigitalSurface& surface = scene.surface;
  const Stopwatch watch(run.report.timings.normals);
  if (scene.polygons) {
    if (scene.polygons->normals.cols() > 0) {
      run.warn("the normals of '" + run.options.input + "' were replaced");
    }
    scene.polygons->normals = own_normals(scene.polygons->view(), run.context);
    run.report.normals = NormalsReport{name_of(Estimator::trivial), 0., 0, 0, {}};
    return;
  }
  NormalReport report;
  switch (run.options.estimator) {
    case Estimator::integral_invariant: {
      IntegralInvariantOptions options;
      options.radius = ball_radius(run.options, input.shape != nullptr, input.grid().spacing);
      options.centre = run.options.centre;
      options.beyond = beyond_of(input);
      check_default_radius(input, options.radius, run);
      report = std::visit(
          [&](const auto& volume) {
            return integral_invariant_normals(surface, volume, options, run.context);
          },
          input.voxels);
      break;
    }
    case Estimator::trivial:
      report = trivial_normals(surface, run.context);
      break;
    case Estimator::analytic:
      report = analytic_normals(surface, *input.shape, run.context);
      break;
  }
  run.report.normals = NormalsReport{
      name_of(run.options.estimator), report.radius, report.fallbacks, report.cut_faces, {}};
  const bool balls = run.options.estimator == Estimator::integral_invariant;
  if (balls && run.options.labelled()) {
    run.report.normals->third_label_faces = report.third_label_faces;
  }
  if (report.fallbacks > 0) {
    run.warn(std::to_string(report.fallbacks) + " of " + std::to_string(surface.face_count()) +
             " faces keep their own normal: the estimator had no answer there");
  }
}

Scene prepare_scene(Run& run) {
  Scene scene = open_scene(run);
  if (run.options.projected && !scene.polygons) estimate_normals(scene, run);
  return scene;
}

Eigen::VectorXd sample_at_vertices(const Expression& f, const Scene& scene, Run& run) {
  const Vec3View positions = scene.positions();
  const RigidMap& world = scene.input.world;
  if (world.is_identity()) return f(positions, run.context);
  Eigen::Matrix3Xd points(3, positions.size);
  for (Index v = 0; v < positions.size; ++v) points.col(v) = world(positions[v]);
  return f({points.data(), points.cols()}, run.context);
}

FlatMesh flat_mesh(const DigitalSurface& surface, const Run& run) {
  return surface.flat(run.options.projected);
}

FlatMesh flat_mesh(const Scene& scene, const Run& run) {
  if (!scene.polygons) return flat_mesh(scene.surface, run);
  FlatMesh mesh = scene.polygons->view();
  if (!run.projected()) mesh.normals = {};
  return mesh;
}

std::optional<FlatMesh> mesh_to_compare(FlatMesh mesh, const Run& run) {
  if (!run.options.compare_naive) return {};
  if (!mesh.has_normals()) {
    throw UsageError("--compare naive: '" + run.options.input +
                     "' has no normals, so that its calculus is the naive one; leave it out");
  }
  mesh.normals = {};
  return mesh;
}

CalculusOptions calculus_options(const Run& run) {
  CalculusOptions options;
  options.lambda = run.options.lambda;
  options.stabilization = run.options.stabilisation;
  return options;
}

SpdSolverFactory timed_solvers(Run& run) {
  return [&](SparseMatrix&& A, const SolverOptions& options, const Context& context) {
    const Stopwatch watch(run.report.timings.factorize);
    return make_spd_solver(take(A), options, context);
  };
}

Index count_clamped_faces(const FlatMesh& mesh, const CalculusOptions& options,
                          const Context& context) {
  Index count = 0;
  if (!mesh.has_normals()) return count;
  const Eigen::Matrix3Xd normals =
      mesh.is_digital() ? Eigen::Matrix3Xd() : own_normals(mesh, context);
  for (Index f = 0; f < mesh.faces(); ++f) {
    const Vec3 own = mesh.is_digital() ? mesh.surfels[static_cast<std::size_t>(f)].normal()
                                       : Vec3(normals.col(f));
    if (embed(mesh.normals[f], own, options.min_cosine).clamped) ++count;
  }
  return count;
}

void note_calculus(Index clamped_faces, Run& run) {
  note_calculus(run.projected(), calculus_options(run), clamped_faces, run);
}

void note_calculus(bool projected, const CalculusOptions& options, Index clamped_faces, Run& run) {
  run.report.calculus =
      CalculusReport{projected, name_of(options.stabilization), {}, clamped_faces};
  if (options.stabilization == Stabilization::de_goes) run.report.calculus->lambda = options.lambda;
  if (options.stabilization == Stabilization::mercat) run.report.calculus->lambda = 0;
}

std::vector<VertexId> find_sources(const Scene& scene, Run& run) {
  const Stopwatch watch(run.report.timings.assemble);
  const Vec3View positions = scene.positions();
  std::vector<VertexId> sources;
  for (const std::int64_t id : run.options.source_vertices) {
    if (id < 0 || id >= positions.size) {
      throw UsageError("--source-vertex " + std::to_string(id) +
                       ": the surface has the vertices 0 to " + std::to_string(positions.size - 1));
    }
    sources.push_back(static_cast<VertexId>(id));
  }
  for (const Vec3& place : run.options.sources) {
    const Vec3 point = scene.input.world.inverse(place);
    Index nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (Index v = 0; v < positions.size; ++v) {
      const double distance = (positions[v] - point).squaredNorm();
      if (distance < least) {
        least = distance;
        nearest = v;
      }
    }
    sources.push_back(static_cast<VertexId>(nearest));
  }
  std::sort(sources.begin(), sources.end());
  sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
  run.report.source_vertices.assign(sources.begin(), sources.end());
  return sources;
}

void write_outputs(const Scene& scene, const Result& result, Run& run) {
  if (run.options.outputs.empty()) return;
  const Stopwatch watch(run.report.timings.write);
  // The labels as fields; what is turned into the world of a medical image.
  const Index vectors = std::count_if(result.fields.begin(), result.fields.end(),
                                      [](const Field& field) { return field.parts.size() == 3; });
  const Index faces = result.mesh.faces(), vertices = result.mesh.vertices();
  run.context.need("write", (scene.surface.labels().empty() ? 0 : 16 * faces) +
                                (scene.input.world.is_identity()
                                     ? 0
                                     : 24 * vertices + 4 * result.mesh.corner_count() +
                                           24 * vectors * std::max(faces, vertices)));
  const LabelColumns labels(scene.surface.labels());
  Result labelled = result;
  labels.append_to(labelled.fields);
  if (scene.polygons) keep_fields(*scene.polygons, labelled, run);
  labelled.mesh.normals = scene.polygons ? scene.polygons->view().normals : scene.surface.normals();
  const WorldResult placed(labelled, scene.input.world, run.context);
  for (const std::string& path : run.options.outputs) {
    if (is_page_path(path)) {
      write_page(path, placed.get(), run.context);
      run.report.outputs.push_back(path);
      continue;
    }
    if (is_picture_path(path)) {
      write_picture(path, scene, result, placed.get(), run);
      run.report.outputs.push_back(path);
      continue;
    }
    const std::vector<std::string> left_out =
        render::is_glb_path(path) ? render::write_glb(path, placed.get(), run.context)
                                  : write_result(path, placed.get(), run.context);
    for (const std::string& field : left_out) {
      run.warn(fmt::format("'{}' has no room for {}; write .ply or .vtp as well", path, field));
    }
    run.report.outputs.push_back(path);
  }
}

}  // namespace dsc::cli
