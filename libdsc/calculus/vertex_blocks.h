/// \file
/// \internal
/// Sums over the faces around each vertex, parallel and in one fixed order.
///
/// The vertices are cut into blocks, one task each; a task walks the faces in ascending order and
/// adds only to its own vertices. So each sum runs in ascending face order whatever the blocks are:
/// the same bits for any thread count, without atomics or a copy a thread. Ranges of faces that
/// touch no vertex of the block are skipped by their least and greatest vertex id, so where the
/// numbering follows the surface nearly every face is walked once.
#pragma once

#include "libdsc/base/parallel.h"
#include "libdsc/calculus/mesh_checks.h"

#include <vector>

namespace dsc {

class VertexBlocks {
 public:
  /// \throws InputError naming the face where a corner is not a vertex.
  VertexBlocks(const FlatMesh& mesh, const Context& context)
      : vertices_(mesh.vertices()), faces_(mesh.faces()) {
    ranges_.resize(static_cast<std::size_t>((faces_ + kGrain - 1) / kGrain));
    parallel_for(context, faces_, kGrain, [&](Index first, Index last) {
      const auto begin = static_cast<std::size_t>(mesh.first_corner(first));
      const auto end = static_cast<std::size_t>(mesh.first_corner(last));
      Range range{static_cast<VertexId>(vertices_), -1};
      for (const VertexId v : mesh.corners.subspan(begin, end - begin)) {
        range.least = std::min(range.least, v);
        range.greatest = std::max(range.greatest, v);
      }
      if (range.least < 0 || range.greatest >= vertices_) {
        for (Index f = first; f < last; ++f) {
          for (const VertexId v : mesh.face(f)) check_vertex(mesh, f, v);
        }
      }
      ranges_[static_cast<std::size_t>(first / kGrain)] = range;
    });
  }

  /// Calls body(v0, v1, f0, f1) so that every (vertex in [v0, v1), face in [f0, f1)) that are
  /// incident meet once; for one block of vertices the calls come in ascending face order, from one
  /// thread. The body must write to nothing but its own vertices.
  template <class Body>
  void run(const Context& context, Body&& body) const {
    const int threads = thread_count(context);
    const Index blocks =
        threads == 1 ? 1 : std::min<Index>(4 * threads, std::max<Index>(vertices_, 1));
    parallel_for(context, blocks, 1, [&](Index b, Index) {
      const auto v0 = static_cast<VertexId>(vertices_ * b / blocks);
      const auto v1 = static_cast<VertexId>(vertices_ * (b + 1) / blocks);
      for (std::size_t r = 0; r < ranges_.size(); ++r) {
        if (ranges_[r].greatest < v0 || ranges_[r].least >= v1) continue;
        context.check();
        const Index f0 = static_cast<Index>(r) * kGrain;
        body(v0, v1, f0, std::min(f0 + kGrain, faces_));
      }
    });
  }

 private:
  static constexpr Index kGrain = 4096;
  struct Range {
    VertexId least, greatest;
  };
  Index vertices_, faces_;
  std::vector<Range> ranges_;
};

}  // namespace dsc
