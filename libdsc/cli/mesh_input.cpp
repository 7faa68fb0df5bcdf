#include "libdsc/cli/mesh_input.h"

#include "libdsc/base/error.h"
#include "libdsc/calculus/mesh_checks.h"
#include "libdsc/io/mesh_reader.h"
#include "libdsc/surface/polygon_topology.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace dsc::cli {
namespace {

bool takes_meshes(Command command) {
  switch (command) {
    case Command::info:
    case Command::surface:
    case Command::normals:
    case Command::gradient:
    case Command::diffuse:
    case Command::geodesic:
    case Command::spectrum:
    case Command::curvature:
    case Command::laplacian:
    case Command::poisson:
      return true;
    default:
      return false;
  }
}

/// Whether the command's result is one of a differential operator.
bool computes(Command command) {
  return command != Command::info && command != Command::surface && command != Command::normals;
}

void decide_calculus(const PolygonMesh& mesh, Run& run) {
  const bool has_normals = mesh.normals.cols() > 0;
  const bool projected = run.options.calculus_given ? run.options.projected : has_normals;
  if (projected && !has_normals) {
    throw InputError("'" + run.options.input +
                     "' has no normals for the projected calculus: give unit face normals nx, ny, "
                     "nz in .ply (dsc:normal in .om), or --calculus naive");
  }
  run.mesh_projected = projected;
}

/// No operator is defined at a vertex without faces.
void drop_isolated_vertices(PolygonMesh& mesh, Index count, Run& run) {
  const std::string what = "'" + run.options.input + "': " + std::to_string(count) +
                           " of its vertices belong to no face";
  if (!run.options.source_vertices.empty()) {
    throw InputError(what + ", so that the ids of the others are not certain; give --source x,y,z");
  }
  run.warn(what + " and were left out; the others are numbered anew");
  std::vector<VertexId> kept(static_cast<std::size_t>(mesh.positions.cols()), -1);
  for (const VertexId v : mesh.corners) kept[static_cast<std::size_t>(v)] = 0;
  VertexId next = 0;
  for (std::size_t v = 0; v < kept.size(); ++v) {
    if (kept[v] < 0) continue;
    kept[v] = next++;
    mesh.positions.col(kept[v]) = mesh.positions.col(static_cast<Index>(v)).eval();
  }
  mesh.positions.conservativeResize(3, next);
  for (VertexId& v : mesh.corners) v = kept[static_cast<std::size_t>(v)];
  for (MeshField& field : mesh.fields) {
    if (field.on != FieldOn::vertex) continue;
    const std::size_t parts = field.parts.size();
    std::vector<double> values;
    for (std::size_t v = 0; v < kept.size(); ++v) {
      for (std::size_t k = 0; kept[v] >= 0 && k < parts; ++k) {
        values.push_back(field.values[v * parts + k]);
      }
    }
    field.values = std::move(values);
  }
}

}  // namespace

bool is_mesh_input(const Options& options) {
  return !options.raw && options.input.rfind("shape:", 0) != 0 && is_mesh_path(options.input);
}

void check_mesh_options(const Options& o) {
  const std::string name = "'" + o.input + "' is a mesh: ";
  if (!takes_meshes(o.command)) {
    throw UsageError(name + "dsc " + name_of(o.command) +
                     " works on voxels, which it does not have");
  }
  if (o.gridstep || o.grid || o.threshold || !o.labels.empty() || o.labelled() || o.border ||
      o.adjacency != Adjacency::interior) {
    throw UsageError(
        name +
        "--gridstep, --grid, --threshold, --label, --labels, --between, --adjacency and "
        "--border are about voxels");
  }
  if (o.radius || o.centre != BallCentre::surfel ||
      (o.estimator_given && o.estimator == Estimator::integral_invariant)) {
    throw UsageError(name +
                     "integral invariants are estimated from voxels, which it does not have");
  }
  if (o.estimator_given && o.command != Command::normals) {
    throw UsageError(name +
                     "it brings its normals; with the faces' own ones the calculus is --calculus "
                     "naive");
  }
}

PolygonMesh read_mesh_input(Run& run) {
  PolygonMesh mesh;
  {
    const Stopwatch watch(run.report.timings.read);
    mesh = read_mesh(run.options.input, run.context);
  }
  for (const std::string& remark : mesh.remarks) run.warn("'" + run.options.input + "': " + remark);
  const FlatMesh view = mesh.view();
  {
    const Stopwatch watch(run.report.timings.extract);
    run.report.surface = count_polygons(view, run.context);
  }
  MeshInputReport report;
  report.name = run.options.input;
  report.normals = mesh.normals.cols() > 0;
  report.isolated_vertices = count_isolated_vertices(view);
  for (const MeshField& field : mesh.fields) report.fields.push_back(field.name);
  run.report.mesh_input = report;
  if (view.faces() == 0) throw InputError("'" + run.options.input + "': the mesh has no face");
  if (computes(run.options.command)) {
    decide_calculus(mesh, run);
    if (report.isolated_vertices > 0) drop_isolated_vertices(mesh, report.isolated_vertices, run);
  }
  return mesh;
}

Eigen::Matrix3Xd own_normals(const FlatMesh& mesh, const Context& context) {
  context.need("normals", 24 * mesh.faces());
  Eigen::Matrix3Xd normals(3, mesh.faces());
  for (Index f = 0; f < mesh.faces(); ++f) {
    const auto corners = mesh.face(f);
    const Vec3 origin = mesh.positions[corners[0]];
    Vec3 area = Vec3::Zero();
    double scale = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3 p = mesh.positions[corners[i]] - origin;
      const Vec3 q = mesh.positions[corners[(i + 1) % corners.size()]] - origin;
      area += 0.5 * p.cross(q);
      scale += (q - p).squaredNorm();
    }
    const double length = area.norm();
    if (!is_area(length, scale)) refuse_area(mesh, f);
    normals.col(f) = area / length;
  }
  return normals;
}

void keep_fields(const PolygonMesh& mesh, Result& result, Run& run) {
  const std::size_t own = result.fields.size();
  Result file = mesh.result();
  for (Field& field : file.fields) {
    bool taken = false, itself = false;
    for (std::size_t i = 0; i < own; ++i) {
      const Field& other = result.fields[i];
      itself = itself || other.values.data() == field.values.data();
      taken = taken || (other.on == field.on &&
                        std::any_of(field.parts.begin(), field.parts.end(), [&](const auto& part) {
                          return std::count(other.parts.begin(), other.parts.end(), part) > 0;
                        }));
    }
    if (!taken) {
      result.fields.push_back(std::move(field));
    } else if (!itself) {
      run.warn("the field " + field.name + " of '" + run.options.input + "' was replaced");
    }
  }
}

}  // namespace dsc::cli
