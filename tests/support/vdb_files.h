/// \file
/// OpenVDB files written by OpenVDB itself.
#pragma once

#include "libdsc/base/types.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace dsc::test {

enum class VdbType { float32, float64, half, int32, int64, boolean, mask, vector };
enum class VdbClass { unknown, level_set, fog_volume };

struct VdbVoxel {
  std::array<std::int32_t, 3> at;
  double value;
};

/// All voxels of a box, as tiles where it has room for some.
struct VdbFill {
  std::array<std::int32_t, 3> first, last;
  double value;
  bool active = true;
};

struct VdbGrid {
  std::string name = "grid";
  VdbType type = VdbType::float32;
  VdbClass grid_class = VdbClass::unknown;
  double background = 0;
  std::vector<VdbFill> fills{};
  std::vector<VdbVoxel> voxels{};  ///< active ones
  bool dense = false;              ///< no active tiles
  /// World position of the voxel (i, j, k): the product with (i, j, k, 1).
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  bool frustum = false;  ///< in place of the matrix
};

enum class VdbForm { plain, zip, blosc, stream };

/// `stream` has no table of where the grids lie.
void write_vdb(const std::string& path, const std::vector<VdbGrid>& grids,
               VdbForm form = VdbForm::blosc);

/// The signed distances of a ball, in voxels, by OpenVDB's tools: a narrow band of 3 voxels,
/// inactive tiles of background values inside and outside.
void write_vdb_ball(const std::string& path, const std::string& name, double radius,
                    const Vec3& centre, const Eigen::Matrix4d& matrix);

/// Grids "one" and "two" with the same voxels in memory and file, `two` moved by (10, 0, 0).
void write_vdb_instances(const std::string& path);

}  // namespace dsc::test
