#include "libdsc/solve/boundary.h"

#include "libdsc/base/error.h"

#include <algorithm>
#include <span>
#include <string>

namespace dsc {

std::vector<char> boundary_vertices(const FlatMesh& mesh) {
  const auto n = static_cast<std::size_t>(mesh.vertices());
  const auto for_each_edge = [&](auto&& visit) {
    for (Index f = 0; f < mesh.faces(); ++f) {
      const auto face = mesh.face(f);
      for (std::size_t i = 0; i < face.size(); ++i) {
        const VertexId a = face[i];
        const VertexId b = face[(i + 1) % face.size()];
        visit(static_cast<std::size_t>(std::min(a, b)), std::max(a, b));
      }
    }
  };
  for (const VertexId v : mesh.corners) {
    if (v < 0 || static_cast<std::size_t>(v) >= n) {
      throw InputError("boundary: a face has the corner " + std::to_string(v) + ", but there are " +
                       std::to_string(n) + " vertices");
    }
  }
  // The edges of each vertex to higher ones, once a face.
  std::vector<Index> start(n + 1, 0);
  for_each_edge([&](std::size_t low, VertexId) { ++start[low + 1]; });
  for (std::size_t v = 0; v < n; ++v) start[v + 1] += start[v];
  std::vector<VertexId> high(static_cast<std::size_t>(start[n]));
  std::vector<Index> next(start.begin(), start.end() - 1);
  for_each_edge([&](std::size_t low, VertexId other) {
    high[static_cast<std::size_t>(next[low]++)] = other;
  });
  std::vector<char> boundary(n, 0);
  for (std::size_t v = 0; v < n; ++v) {
    const auto edges = std::span(high).subspan(static_cast<std::size_t>(start[v]),
                                               static_cast<std::size_t>(start[v + 1] - start[v]));
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size();) {
      std::size_t j = i;
      while (j < edges.size() && edges[j] == edges[i]) ++j;
      if (j == i + 1) boundary[v] = boundary[static_cast<std::size_t>(edges[i])] = 1;
      i = j;
    }
  }
  return boundary;
}

}  // namespace dsc
