#include "libdsc/io/world_result.h"

#include "libdsc/base/parallel.h"

#include <algorithm>

namespace dsc {
namespace {

template <class Map>
Eigen::Matrix3Xd mapped(Vec3View from, const Map& map, const Context& context) {
  Eigen::Matrix3Xd to(3, from.size);
  parallel_for(context, from.size, 1 << 14, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) to.col(i) = map(from[i]);
  });
  return to;
}

}  // namespace

WorldResult::WorldResult(const Result& result, const RigidMap& map, const Context& context)
    : mapped_(result) {
  mapped_.mesh.surfels = {};  // no longer along the axes
  if (map.is_identity()) return;
  positions_ = mapped(result.mesh.positions, map, context);
  mapped_.mesh.positions = {positions_.data(), positions_.cols()};
  if (map.mirrors()) {
    corners_.assign(result.mesh.corners.begin(), result.mesh.corners.end());
    parallel_for(context, result.mesh.faces(), 1 << 14, [&](Index first, Index last) {
      for (Index f = first; f < last; ++f) {
        std::reverse(corners_.begin() + result.mesh.first_corner(f) + 1,
                     corners_.begin() + result.mesh.first_corner(f + 1));
      }
    });
    mapped_.mesh.corners = corners_;
  }
  vectors_.reserve(mapped_.fields.size() + 1);  // the fields look at its elements' memory
  const auto turned = [&](Vec3View vectors) -> Vec3View {
    vectors_.push_back(mapped(
        vectors, [&](const Vec3& v) { return map.turned(v); }, context));
    return {vectors_.back().data(), vectors_.back().cols()};
  };
  if (mapped_.mesh.has_normals()) mapped_.mesh.normals = turned(mapped_.mesh.normals);
  for (Field& field : mapped_.fields) {
    if (field.parts.size() != 3) continue;
    const Vec3View values{field.values.data(), static_cast<Index>(field.values.size() / 3)};
    field.values = {turned(values).data, field.values.size()};
  }
}

}  // namespace dsc
