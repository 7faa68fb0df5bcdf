#include "libdsc/cli/input.h"

#include "libdsc/base/error.h"
#include "libdsc/cli/mesh_input.h"
#include "libdsc/io/read_binary.h"
#include "libdsc/io/read_labels.h"
#include "libdsc/normals/radius.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shape_spec.h"

#include <cmath>

namespace dsc::cli {
namespace {

/// A file's voxels under another spacing than the file's own.
class RespacedSource final : public VolumeSource {
 public:
  RespacedSource(std::unique_ptr<VolumeSource> source, const Vec3& spacing)
      : source_(std::move(source)), grid_(source_->grid()) {
    grid_.spacing = spacing;
  }
  const std::string& path() const override { return source_->path(); }
  const Grid& grid() const override { return grid_; }
  RigidMap world() const override { return source_->world(); }
  VolumeClass volume_class() const override { return source_->volume_class(); }
  std::string grid_name() const override { return source_->grid_name(); }
  bool x_fastest() const override { return source_->x_fastest(); }
  void read(const std::function<void(const Slab&)>& take, const Context& context) override {
    source_->read(take, context);
  }

 private:
  std::unique_ptr<VolumeSource> source_;
  Grid grid_;
};

/// The same solid in a larger box.
class WidenedShape final : public ImplicitShape {
 public:
  WidenedShape(const ImplicitShape& shape, double margin) : shape_(shape), bounds_(shape.bounds()) {
    bounds_.min().array() -= margin;
    bounds_.max().array() += margin;
  }
  double value(const Vec3& p) const override { return shape_.value(p); }
  Vec3 gradient(const Vec3& p) const override { return shape_.gradient(p); }
  Mat3 hessian(const Vec3& p) const override { return shape_.hessian(p); }
  Eigen::AlignedBox3d bounds() const override { return bounds_; }
  bool closed() const override { return shape_.closed(); }
  std::string name() const override { return shape_.name(); }
  void values_along_x(double step, Index first, int count, double y, double z,
                      double* out) const override {
    shape_.values_along_x(step, first, count, y, z, out);
  }

 private:
  const ImplicitShape& shape_;
  Eigen::AlignedBox3d bounds_;
};

/// The surfels between two voxels of `box`, of those of a volume on `grid`, which share a lattice.
std::function<bool(const Surfel&)> part_within(const Grid& box, const Grid& grid) {
  Index3 shift;
  for (int axis = 0; axis < 3; ++axis) {
    shift[axis] = std::llround((box.origin[axis] - grid.origin[axis]) / grid.spacing[axis]);
  }
  return [box, shift](const Surfel& s) {
    Index3 voxel{s.x - shift[0], s.y - shift[1], s.z - shift[2]};
    const bool inner = box.contains(voxel[0], voxel[1], voxel[2]);
    voxel[static_cast<std::size_t>(s.axis())] += s.sign();
    return inner && box.contains(voxel[0], voxel[1], voxel[2]);
  };
}

bool uses_balls(const Options& options) {
  const bool wants_normals = options.command != Command::info &&
                             options.command != Command::voxels &&
                             (options.command != Command::surface || options.regularise);
  return wants_normals && options.projected && options.estimator == Estimator::integral_invariant;
}

Input digitized(Run& run) {
  const Options& options = run.options;
  const Vec3 spacing = *options.gridstep;
  Input input;
  input.shape = make_shape(options.input.substr(std::string("shape:").size()));
  const bool cut = !input.shape->closed();
  input.border = options.border.value_or(cut ? Border::open : Border::closed);
  try {
    if (cut && input.border == Border::open && uses_balls(options)) {
      const WidenedShape wide(*input.shape, ball_radius(options, true, spacing));
      input.voxels = digitize(wide, spacing, run.context);
      input.part = part_within(digitization_grid(*input.shape, spacing), input.grid());
    } else {
      input.voxels = digitize(*input.shape, spacing, run.context);
    }
  } catch (const LimitError& error) {
    throw LimitError("--gridstep: " + std::string(error.what()));
  }
  return input;
}

Input read_file(Run& run) {
  const Options& options = run.options;
  VoxelSelection selection;
  if (options.threshold) {
    selection.threshold = {(*options.threshold)[0], (*options.threshold)[1]};
  }
  selection.labels = options.labels;
  std::unique_ptr<VolumeSource> source =
      options.raw ? open_raw_volume(options.input, *options.raw, run.context)
                  : open_volume(options.input, {options.grid}, run.context);
  if (options.gridstep) {
    source = std::make_unique<RespacedSource>(std::move(source), *options.gridstep);
  }
  Input input;
  input.border = options.border.value_or(Border::closed);
  input.world = source->world();
  input.grid_name = source->grid_name();
  input.volume_class = source->volume_class();
  if (options.labelled()) {
    input.voxels = read_labels(*source, run.context);
  } else {
    input.voxels = read_binary(*source, selection, run.context);
  }
  return input;
}

}  // namespace

CurvatureEstimator curvature_estimator(const Options& options) {
  if (options.curvature) return *options.curvature;
  return options.labelled() || is_mesh_input(options) ? CurvatureEstimator::laplacian
                                                      : CurvatureEstimator::integral_invariant;
}

double ball_radius(const Options& options, bool is_shape, const Vec3& spacing) {
  if (options.radius) return *options.radius;
  if (is_shape) return shape_radius(spacing.maxCoeff());
  const bool curvature = options.command == Command::curvature &&
                         curvature_estimator(options) == CurvatureEstimator::integral_invariant;
  return data_radius(spacing, curvature ? kCurvatureRadiusVoxels : kDataRadiusVoxels);
}

Input read_input(Run& run) {
  const Stopwatch watch(run.report.timings.read);
  const bool is_shape = run.options.input.rfind("shape:", 0) == 0;
  Input input = is_shape ? digitized(run) : read_file(run);
  const auto* labels = std::get_if<LabelVolume>(&input.voxels);
  const Index inside =
      labels != nullptr ? labels->count(run.context) : std::get<BinaryVolume>(input.voxels).count();
  const Grid& grid = input.grid();
  InputReport report;
  report.name = is_shape ? "shape:" + input.shape->name() : run.options.input;
  report.size = grid.size;
  report.spacing = grid.spacing;
  report.origin = input.world(grid.origin);
  report.direction = input.world.rotation;
  report.inside = inside;
  report.grid = input.grid_name;
  report.volume_class = input.volume_class;
  report.chosen = run.options.threshold || !run.options.labels.empty() || labels != nullptr;
  if (labels != nullptr) {
    report.labels = static_cast<Index>(labels->labels(run.context).size());
  }
  run.report.input = std::move(report);
  if (inside == 0) {
    throw InputError(
        "'" + run.options.input + "': no voxel is inside; " +
        (is_shape ? "use a smaller --gridstep" : "choose others by --threshold or --label"));
  }
  return input;
}

}  // namespace dsc::cli
