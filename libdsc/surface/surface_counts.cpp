#include "libdsc/surface/surface_counts.h"

#include "libdsc/base/parallel.h"
#include "libdsc/base/union_find.h"

#include <algorithm>
#include <array>

namespace dsc::topology {
namespace {

struct Sides {
  Index edges = 0, unlinked = 0;

  /// Counts each edge once: by its later side, or by its only one.
  void add(SideCode side, std::span<const SideCode> opposite) {
    const SideCode across = opposite[static_cast<std::size_t>(side)];
    if (across == kNoSide) ++unlinked;
    if (across < side) ++edges;
  }
};

/// How many labels the surfels of a linel separate; 0 without labels.
Index meeting_labels(const Junction& j, std::span<const LabelPair> labels) {
  if (labels.empty()) return 0;
  std::array<Label, 8> found;
  auto end = found.begin();
  for (const SideCode s : j.sides) {
    if (s == kNoSide) continue;
    for (const Label label : labels[static_cast<std::size_t>(face_of(s))]) {
      if (std::find(found.begin(), end, label) == end) *end++ = label;
    }
  }
  return end - found.begin();
}

}  // namespace

SurfaceCounts count_glued(std::span<const QuadCorners> corners, Index vertices,
                          std::span<const SideCode> opposite, std::span<const Junction> junctions,
                          std::span<const LabelPair> labels, const Context& context) {
  UnionFind components(vertices);
  Sides sides = parallel_reduce(
      context, static_cast<Index>(corners.size()), 8192, Sides{},
      [&](Index first, Index last) {
        Sides partial;
        for (Index f = first; f < last; ++f) {
          const QuadCorners& c = corners[static_cast<std::size_t>(f)];
          for (int i = 0; i < 4; ++i) partial.add(side_code(f, i), opposite);
          for (std::size_t i = 1; i < 4; ++i) components.join(c[0], c[i]);
        }
        return partial;
      },
      [](const Sides& a, const Sides& b) {
        return Sides{a.edges + b.edges, a.unlinked + b.unlinked};
      });
  SurfaceCounts counts;
  for (const Junction& j : junctions) {
    Sides here;
    Index present = 0;
    for (const SideCode s : j.sides) {
      if (s == kNoSide) continue;
      ++present;
      here.add(s, opposite);
    }
    sides.edges -= here.edges - 1;  // one linel, however many edges of the mesh
    sides.unlinked -= here.unlinked;
    if (present > 2) ++counts.nonmanifold_edges;
    if (present > 2 && meeting_labels(j, labels) > 2) ++counts.junction_edges;
  }
  counts.vertices = vertices;
  counts.faces = static_cast<Index>(corners.size());
  counts.edges = sides.edges;
  counts.boundary_edges = sides.unlinked;
  counts.euler = counts.vertices - counts.edges + counts.faces;
  counts.components = parallel_reduce(
      context, vertices, 65536, Index{0},
      [&](Index first, Index last) {
        Index roots = 0;
        for (Index v = first; v < last; ++v) {
          const auto id = static_cast<VertexId>(v);
          if (components.find(id) == id) ++roots;
        }
        return roots;
      },
      [](Index a, Index b) { return a + b; });
  return counts;
}

}  // namespace dsc::topology
