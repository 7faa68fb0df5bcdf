#include "libdsc/surface/polygon_topology.h"

#include "libdsc/base/checked.h"
#include "libdsc/base/parallel.h"
#include "libdsc/base/union_find.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace dsc {
namespace {

/// A side by its edge: the vertices a < b that it joins.
struct Side {
  VertexId a, b;
  VertexId corner;  ///< where it begins
  bool forward;     ///< from a to b
};

/// Calls use(corner, next corner) for every side.
template <class Use>
void for_each_side(const FlatMesh& mesh, Use&& use) {
  for (Index f = 0; f < mesh.faces(); ++f) {
    const Index first = mesh.first_corner(f), last = mesh.first_corner(f + 1);
    for (Index c = first; c < last; ++c) use(c, c + 1 == last ? first : c + 1);
  }
}

/// The sides of edges, edge after edge: cast to their lower vertex, then sorted, the few of each.
std::vector<Side> sorted_sides(const FlatMesh& mesh, const Context& context) {
  checked_id(mesh.corner_count(), "face corners");
  for (Index c = 0; c < mesh.corner_count(); ++c) {
    const VertexId v = mesh.corners[static_cast<std::size_t>(c)];
    if (v < 0 || v >= mesh.vertices()) {
      throw InputError("corner " + std::to_string(v) + " is not one of the " +
                       std::to_string(mesh.vertices()) + " vertices");
    }
  }
  const auto for_each_edge_side = [&](auto&& use) {
    for_each_side(mesh, [&](Index c, Index next) {
      const VertexId from = mesh.corners[static_cast<std::size_t>(c)];
      const VertexId to = mesh.corners[static_cast<std::size_t>(next)];
      if (from != to) {
        use(Side{std::min(from, to), std::max(from, to), static_cast<VertexId>(c), from < to});
      }
    });
  };
  std::vector<std::ptrdiff_t> place(static_cast<std::size_t>(mesh.vertices()) + 1, 0);
  for_each_edge_side([&](const Side& side) { ++place[static_cast<std::size_t>(side.a) + 1]; });
  std::partial_sum(place.begin(), place.end(), place.begin());
  context.check();
  std::vector<Side> sides(static_cast<std::size_t>(place.back()));
  for_each_edge_side([&](const Side& side) {
    sides[static_cast<std::size_t>(place[static_cast<std::size_t>(side.a)]++)] = side;
  });
  // Each place is now where the next vertex begins.
  parallel_for(context, mesh.vertices(), 1 << 14, [&](Index first, Index last) {
    for (Index v = first; v < last; ++v) {
      const auto begin = v == 0 ? 0 : place[static_cast<std::size_t>(v) - 1];
      std::sort(sides.begin() + begin, sides.begin() + place[static_cast<std::size_t>(v)],
                [](const Side& s, const Side& t) {
                  return std::tie(s.b, s.corner) < std::tie(t.b, t.corner);
                });
    }
  });
  return sides;
}

/// Calls use(first, last) for the sides of each edge.
template <class Use>
void for_each_edge(const std::vector<Side>& sides, Use&& use) {
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].a == sides[first].a &&
           sides[last].b == sides[first].b) {
      ++last;
    }
    use(first, last);
  }
}

Index count_components(const FlatMesh& mesh) {
  UnionFind components(mesh.vertices());
  for (Index f = 0; f < mesh.faces(); ++f) {
    const auto corners = mesh.face(f);
    for (const VertexId v : corners) components.join(corners[0], v);
  }
  Index count = 0;
  for (Index v = 0; v < mesh.vertices(); ++v) {
    if (components.find(static_cast<VertexId>(v)) == v) ++count;
  }
  return count;
}

std::vector<VertexId> link(const FlatMesh& mesh, const std::vector<Side>& sides, SideLinks which) {
  std::vector<VertexId> links(mesh.corners.size(), -1);
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    const Side& s = sides[first];
    const Side& t = sides[last - 1];
    if (last - first != 2 || (which == SideLinks::opposed && s.forward == t.forward)) return;
    links[static_cast<std::size_t>(s.corner)] = t.corner;
    links[static_cast<std::size_t>(t.corner)] = s.corner;
  });
  return links;
}

}  // namespace

std::vector<VertexId> linked_sides(const FlatMesh& mesh, SideLinks which, const Context& context) {
  return link(mesh, sorted_sides(mesh, context), which);
}

std::vector<VertexId> corner_umbrellas(const FlatMesh& mesh, const std::vector<VertexId>& links) {
  std::vector<VertexId> next(mesh.corners.size());
  for_each_side(mesh, [&](Index c, Index after) {
    next[static_cast<std::size_t>(c)] = static_cast<VertexId>(after);
  });
  const auto vertex = [&](VertexId c) { return mesh.corners[static_cast<std::size_t>(c)]; };
  UnionFind sets(mesh.corner_count());
  for (Index c = 0; c < mesh.corner_count(); ++c) {
    const VertexId other = links[static_cast<std::size_t>(c)];
    if (other < c) continue;  // none, or seen from there
    const auto mine = static_cast<VertexId>(c);
    const VertexId mine_end = next[static_cast<std::size_t>(c)];
    const VertexId other_end = next[static_cast<std::size_t>(other)];
    const bool alike = vertex(other) == vertex(mine);
    sets.join(mine, alike ? other : other_end);
    sets.join(mine_end, alike ? other_end : other);
  }
  std::vector<VertexId> umbrellas(mesh.corners.size());
  for (Index c = 0; c < mesh.corner_count(); ++c) {
    umbrellas[static_cast<std::size_t>(c)] = sets.find(static_cast<VertexId>(c));
  }
  return umbrellas;
}

SurfaceCounts count_polygons(const FlatMesh& mesh, const Context& context) {
  context.begin("count");
  // Sides and their links; then links and umbrellas, which may not all fit where the sides were.
  constexpr Index kSide = sizeof(Side) + 2 * sizeof(VertexId), kPlace = sizeof(std::ptrdiff_t);
  context.need("count", kSide * mesh.corner_count() + kPlace * mesh.vertices());
  std::vector<Side> sides = sorted_sides(mesh, context);
  SurfaceCounts counts;
  counts.vertices = mesh.vertices();
  counts.faces = mesh.faces();
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    ++counts.edges;
    if (last - first == 1) ++counts.boundary_edges;
    if (last - first > 2) ++counts.nonmanifold_edges;
  });
  counts.euler = counts.vertices - counts.edges + counts.faces;

  const std::vector<VertexId> links = link(mesh, sides, SideLinks::any);
  std::vector<Side>().swap(sides);
  context.check();
  counts.components = count_components(mesh);
  context.check();

  const std::vector<VertexId> umbrellas = corner_umbrellas(mesh, links);
  std::vector<VertexId> first(static_cast<std::size_t>(mesh.vertices()), -1);
  std::vector<bool> pinched(first.size(), false);
  for (std::size_t c = 0; c < umbrellas.size(); ++c) {
    const auto v = static_cast<std::size_t>(mesh.corners[c]);
    if (first[v] < 0) first[v] = umbrellas[c];
    if (first[v] != umbrellas[c]) pinched[v] = true;
  }
  counts.pinched_vertices = std::count(pinched.begin(), pinched.end(), true);
  return counts;
}

Index count_isolated_vertices(const FlatMesh& mesh) {
  std::vector<bool> used(static_cast<std::size_t>(mesh.vertices()), false);
  for (const VertexId v : mesh.corners) used[static_cast<std::size_t>(v)] = true;
  return std::count(used.begin(), used.end(), false);
}

}  // namespace dsc
