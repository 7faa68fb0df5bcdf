/// \file
/// Where voxels come from: a file, or a shape to digitise.
#pragma once

#include "libdsc/cli/run.h"
#include "libdsc/io/volume_source.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/binary_volume.h"
#include "libdsc/voxels/implicit_shape.h"
#include "libdsc/voxels/label_volume.h"
#include "libdsc/voxels/rigid_map.h"

#include <memory>
#include <string>
#include <variant>

namespace dsc::cli {

/// A voxel set or a label image, and the shape that it digitises where there is one.
///
/// A shape that its box cuts has a surface inside the box only, but its solid goes on beyond. Where
/// normals are estimated from balls of voxels, the volume has a margin of a ball's radius around
/// the box, so that no ball feels the cut; `part` keeps the surfels of the box.
struct Input {
  std::variant<BinaryVolume, LabelVolume> voxels;
  std::unique_ptr<ImplicitShape> shape;
  RigidMap world;  ///< from the positions that are computed with to those that people give and get
  std::string grid_name;  ///< of a .vdb file
  VolumeClass volume_class = VolumeClass::values;
  Border border = Border::closed;
  std::function<bool(const Surfel&)> part;  ///< empty: all surfels

  const Grid& grid() const {
    return std::visit([](const auto& volume) -> const Grid& { return volume.grid(); }, voxels);
  }
};

/// Reads the file or digitises the shape. \throws InputError where no voxel is inside.
Input read_input(Run& run);

/// The radius of the integral invariant's ball: the one asked for, else shape_radius() or
/// data_radius().
double ball_radius(const Options& options, bool is_shape, const Vec3& spacing);

/// The one asked for; else ii, but for label images and meshes, which it cannot serve.
CurvatureEstimator curvature_estimator(const Options& options);

}  // namespace dsc::cli
