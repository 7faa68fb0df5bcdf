#include "libdsc/base/parallel.h"
#include "libdsc/surface/surface_builder.h"

#include <atomic>

namespace dsc {
namespace {

using topology::Junction;
using topology::kNoSide;
using topology::SideCode;

}  // namespace

SurfaceBuilder SurfaceBuilder::part(const std::vector<std::uint8_t>& keep,
                                    const Context& context) && {
  const auto old_corners = corners();
  const auto old_surfels = surfels();
  const auto old_positions = positions();
  const auto faces = static_cast<Index>(keep.size());

  // New numbers, in the old order.
  std::vector<VertexId> face_number(keep.size(), -1), vertex_number(old_positions.size(), -1);
  VertexId kept_faces = 0, kept_vertices = 0;
  for (std::size_t f = 0; f < keep.size(); ++f) {
    if (keep[f] == 0) continue;
    face_number[f] = kept_faces++;
    for (const VertexId v : old_corners[f]) vertex_number[static_cast<std::size_t>(v)] = 0;
  }
  for (VertexId& number : vertex_number) {
    if (number == 0) number = kept_vertices++;
  }
  const auto renamed = [&](SideCode s) {
    if (s == kNoSide) return kNoSide;
    const VertexId f = face_number[static_cast<std::size_t>(topology::face_of(s))];
    return f < 0 ? kNoSide : topology::side_code(f, s & 3);
  };

  SurfaceBuilder result(surface_.grid(), kept_vertices, kept_faces, surface_.labels_.is_valid(),
                        false, context);
  const auto new_corners = result.corners();
  const auto new_surfels = result.surfels();
  const auto old_labels = labels(), new_labels = result.labels();
  const auto new_positions = result.positions();
  parallel_for(context, faces, 8192, [&](Index first, Index last) {
    for (auto f = static_cast<std::size_t>(first); f < static_cast<std::size_t>(last); ++f) {
      if (keep[f] == 0) continue;
      const auto g = static_cast<std::size_t>(face_number[f]);
      new_surfels[g] = old_surfels[f];
      if (!new_labels.empty()) new_labels[g] = old_labels[f];
      for (std::size_t i = 0; i < 4; ++i) {
        new_corners[g][i] = vertex_number[static_cast<std::size_t>(old_corners[f][i])];
        result.opposite_[4 * g + i] = renamed(opposite_[4 * f + i]);
      }
    }
  });
  for (std::size_t v = 0; v < old_positions.size(); ++v) {
    if (vertex_number[v] >= 0) {
      new_positions[static_cast<std::size_t>(vertex_number[v])] = old_positions[v];
    }
  }

  for (const Junction& old : junctions_) {
    Junction j{};
    std::vector<int> present;
    for (int k = 0; k < 4; ++k) {
      j.sides[static_cast<std::size_t>(k)] = renamed(old.sides[static_cast<std::size_t>(k)]);
      if (j.sides[static_cast<std::size_t>(k)] != kNoSide) present.push_back(k);
    }
    if (present.size() < 2) continue;
    const auto pair = [&](int k) {
      const SideCode s = j.sides[static_cast<std::size_t>(k)];
      return new_labels.empty() ? LabelPair{}
                                : new_labels[static_cast<std::size_t>(topology::face_of(s))];
    };
    if (present.size() == 2 && (present[0] + present[1]) % 2 == 1 &&
        pair(present[0]) == pair(present[1])) {
      // An ordinary edge of the part: the two run opposite ways along the linel.
      const SideCode a = j.sides[static_cast<std::size_t>(present[0])];
      const SideCode b = j.sides[static_cast<std::size_t>(present[1])];
      result.opposite_[static_cast<std::size_t>(a)] = b;
      result.opposite_[static_cast<std::size_t>(b)] = a;
      continue;
    }
    result.junctions_.push_back(j);
  }
  return result;
}

}  // namespace dsc
