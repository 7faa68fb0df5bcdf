#include "libdsc/cli/option_checks.h"

#include "libdsc/base/error.h"
#include "libdsc/calculus/options.h"
#include "libdsc/cli/file_checks.h"
#include "libdsc/cli/input.h"
#include "libdsc/cli/mesh_input.h"
#include "libdsc/cli/picture_options.h"
#include "libdsc/io/path_extension.h"
#include "libdsc/io/volume_writer.h"

#include <algorithm>
#include <filesystem>
#include <string>

namespace dsc::cli {
namespace {

/// An option that could change nothing was meant to: it is named with the one that makes it idle.
void check_have_effect(const Options& o) {
  if (o.given("--lambda") && o.stabilisation != Stabilization::de_goes &&
      o.command != Command::geodesic) {
    throw UsageError(std::string("--lambda is the weight of --stabilisation de-goes; ") +
                     name_of(o.stabilisation) + " has its own, leave one of them out");
  }
  if (o.command == Command::diffuse && o.stabilisation == Stabilization::mercat) {
    throw UsageError(
        "--stabilisation mercat leaves checkerboards as they are, and half of a point source is "
        "one; choose another to diffuse it");
  }
  if (o.compare_naive && !o.projected) {
    throw UsageError(
        "--compare naive has no effect with --calculus naive, which it would be compared with; "
        "leave one of them out");
  }
  if (o.command == Command::voxels && o.given("--gridstep") && o.input.rfind("shape:", 0) != 0 &&
      std::none_of(o.outputs.begin(), o.outputs.end(), keeps_spacing)) {
    throw UsageError(
        "--gridstep has no effect on a file's voxels in .npy, which has no room for a spacing: "
        "leave it out or write .vti");
  }
  const bool balls = o.estimator == Estimator::integral_invariant;
  for (const char* option : {"--estimator", "--radius", "--centre"}) {
    if (!o.given(option)) continue;
    if (o.command == Command::surface && !o.regularise) {
      throw UsageError(std::string(option) +
                       " has no effect without --regularise: give both or leave it out");
    }
    if (!o.projected) {
      throw UsageError(std::string(option) +
                       " has no effect with --calculus naive, which uses no estimated normals; "
                       "leave one of them out");
    }
    if (!balls && option != std::string("--estimator")) {
      throw UsageError(std::string(option) + " describes the ball of --estimator ii; --estimator " +
                       name_of(o.estimator) + " has none, leave one of them out");
    }
  }
}

}  // namespace

void check_options(const Options& o) {
  if (is_mesh_input(o)) check_mesh_options(o);
  const bool shape = o.input.rfind("shape:", 0) == 0;
  if (shape && !o.gridstep) {
    throw UsageError("'" + o.input + "' needs --gridstep H, the edge of a voxel");
  }
  if (shape && (o.threshold || !o.labels.empty() || o.labelled())) {
    throw UsageError(
        "--threshold, --label, --labels and --between choose voxels of a volume file; a shape has "
        "none");
  }
  if (o.labelled() && (o.threshold || !o.labels.empty())) {
    throw UsageError(
        "--threshold and --label make one object of the voxels, --labels and --between keep their "
        "labels apart; give one of them");
  }
  if (o.all_labels && !o.between.empty()) {
    throw UsageError("--labels all has every interface, --between one of them; give one of them");
  }
  if (o.labelled() && o.centre == BallCentre::voxel_pair) {
    throw UsageError("--centre pair is not there for labels: their ball is centred on the surfel");
  }
  if (shape && o.raw) throw UsageError("--size and --type describe a raw file, not a shape");
  if (o.grid && (shape || o.raw || extension_of(o.input) != ".vdb")) {
    throw UsageError("--grid names a grid of a .vdb file, and '" + o.input + "' is none");
  }
  if (o.raw && (o.raw->size[0] == 0 || !o.raw_type)) {
    throw UsageError("a raw file needs --size X,Y,Z and --type u8 or another");
  }
  if (!shape && !o.raw &&
      (std::filesystem::path(o.input).extension() == ".raw" || o.input == "raw:-")) {
    throw UsageError("'" + o.input + "': a raw file needs --size X,Y,Z and --type u8 or another");
  }
  if (!shape && o.estimator == Estimator::analytic) {
    throw UsageError("--estimator analytic needs a shape: voxels have no exact normals");
  }
  if (o.command == Command::curvature) {
    const bool balls = curvature_estimator(o) == CurvatureEstimator::integral_invariant;
    if (balls && is_mesh_input(o)) {
      throw UsageError("--estimator ii counts voxels, which a mesh does not have; use laplacian");
    }
    if (balls && o.labelled()) {
      throw UsageError(
          "--estimator ii has no curvature for the interfaces of labels: use laplacian, or "
          "--label to choose one object");
    }
    if (balls && (o.time || o.curvature_lambda > 0)) {
      throw UsageError("--diffuse and --lambda are for --estimator laplacian");
    }
    if (!balls && (o.on_vertices || o.form == CurvatureForm::plain)) {
      throw UsageError("--on and --form are for --estimator ii");
    }
  }
  const bool wants_sources = o.command == Command::diffuse || o.command == Command::geodesic;
  if (wants_sources && o.sources.empty() && o.source_vertices.empty()) {
    throw UsageError(std::string(name_of(o.command)) +
                     " needs a source: --source x,y,z or --source-vertex ID");
  }
  if (o.threshold && !o.labels.empty()) {
    throw UsageError("--threshold and --label both say which voxels are inside; give one of them");
  }
  CalculusOptions{o.lambda}.check();
  if (o.curvature_lambda > 0) CalculusOptions{o.curvature_lambda}.check();
  check_have_effect(o);
  check_picture_options(o);
  check_files(o);
}

}  // namespace dsc::cli
