/// \file
/// A result as it lies in the world, for files.
#pragma once

#include "libdsc/io/results.h"
#include "libdsc/voxels/rigid_map.h"

#include <vector>

namespace dsc {

/// Positions and vector fields (those of three parts) of a result, mapped. Where the map mirrors,
/// the corners of every face run the other way, from the same first one, so that they stay
/// counter-clockwise seen from outside; an outward normal stays outward as it is.
class WorldResult {
 public:
  /// What `result` looks at must outlive this.
  WorldResult(const Result& result, const RigidMap& map, const Context& context = {});
  WorldResult(const WorldResult&) = delete;
  WorldResult& operator=(const WorldResult&) = delete;

  /// A view of the mapped result; lives as long as this. Of its mesh, only what files hold is set.
  const Result& get() const { return mapped_; }

 private:
  Result mapped_;
  Eigen::Matrix3Xd positions_;
  std::vector<VertexId> corners_;
  std::vector<Eigen::Matrix3Xd> vectors_;
};

}  // namespace dsc
