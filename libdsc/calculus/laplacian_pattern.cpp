#include "libdsc/calculus/laplacian_pattern.h"

#include "libdsc/base/checked.h"
#include "libdsc/base/parallel.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/calculus/mesh_checks.h"
#include "libdsc/calculus/small_ranks.h"
#include "libdsc/calculus/vertex_blocks.h"

#include <algorithm>
#include <limits>

namespace dsc {
namespace {

constexpr Index kPatternGrain = 4096;
/// What a slot of a byte can hold.
constexpr std::size_t kMostSurfelEntries = 255;

/// The entries of a column: the vertices around one, ascending.
class Column {
 public:
  void clear() { ids_.clear(); }
  void append(std::span<const VertexId> ids) { ids_.insert(ids_.end(), ids.begin(), ids.end()); }
  void sort() {
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  }
  Index position(VertexId v) const {
    return std::lower_bound(ids_.begin(), ids_.end(), v) - ids_.begin();
  }
  const std::vector<VertexId>& ids() const { return ids_; }

 private:
  std::vector<VertexId> ids_;
};

}  // namespace

LaplacianPattern::LaplacianPattern(const FlatMesh& mesh, const Context& context)
    : faces_(mesh.faces()), corners_(mesh.corner_count()), digital_(mesh.is_digital()) {
  check_mesh(mesh, CalculusOptions());
  context.begin("laplacian pattern", mesh.vertices());
  if (!mesh.offsets.empty()) {
    pairs_.resize(static_cast<std::size_t>(faces_) + 1);
    for (Index f = 0; f < faces_; ++f) {
      const Index n = mesh.first_corner(f + 1) - mesh.first_corner(f);
      pairs_[static_cast<std::size_t>(f) + 1] =
          pairs_[static_cast<std::size_t>(f)] + checked_product(n, n, "pairs of corners of a face");
    }
  }
  need_memory(mesh, context);
  find_incident(mesh, context);
  find_columns(mesh, context);
  if (digital_) find_blocks(context);
}

void LaplacianPattern::need_memory(const FlatMesh& mesh, const Context& context) const {
  // At most all corners of all faces around a vertex, and itself, are in its column; the columns
  // are collected, with room for 10 entries each, and joined.
  const Index pairs = pairs_before(faces_);
  const Index most = mesh.vertices() + pairs - corners_;
  const Index slots = checked_product(pairs, digital_ ? 1 : 4, "bytes of pairs of corners");
  const Index incident = (mesh.offsets.empty() ? 4 : 8) * corners_;
  context.need("laplacian pattern", slots + incident + 8 * mesh.vertices() + 4 * most +
                                        4 * std::max(most, 10 * mesh.vertices()));
}

/// A counting sort of the corners by vertex.
void LaplacianPattern::find_incident(const FlatMesh& mesh, const Context& context) {
  const VertexBlocks blocks(mesh, context);
  const auto V = static_cast<std::size_t>(mesh.vertices());
  incident_begin_.assign(V + 1, 0);
  blocks.run(context, [&](VertexId v0, VertexId v1, Index f0, Index f1) {
    for (Index c = mesh.first_corner(f0); c < mesh.first_corner(f1); ++c) {
      const VertexId v = mesh.corners[static_cast<std::size_t>(c)];
      if (v >= v0 && v < v1) ++incident_begin_[static_cast<std::size_t>(v)];
    }
  });
  // Begins, that the placing below moves to the ends, which are the next vertex's begins.
  std::int32_t sum = 0;
  for (std::size_t v = 0; v <= V; ++v) {
    const std::int32_t count = incident_begin_[v];
    incident_begin_[v] = sum;
    sum += count;
  }
  // The first touch of memory is slow, so that each array gets a thread.
  parallel_for(context, 2, 1, [&](Index array, Index) {
    if (array == 0) incident_.resize(mesh.corners.size());
    if (array == 1 && digital_) surfel_slots_.resize(mesh.corners.size());
  });
  if (!mesh.offsets.empty()) incident_face_.resize(mesh.corners.size());
  blocks.run(context, [&](VertexId v0, VertexId v1, Index f0, Index f1) {
    for (Index f = f0; f < f1; ++f) {
      const Index last = mesh.first_corner(f + 1);
      for (Index c = mesh.first_corner(f); c < last; ++c) {
        const VertexId v = mesh.corners[static_cast<std::size_t>(c)];
        if (v < v0 || v >= v1) continue;
        const auto at = static_cast<std::size_t>(incident_begin_[static_cast<std::size_t>(v)]++);
        incident_[at] = static_cast<std::int32_t>(c);
        if (!incident_face_.empty()) incident_face_[at] = static_cast<std::int32_t>(f);
      }
    }
  });
  for (std::size_t v = V; v > 0; --v) incident_begin_[v] = incident_begin_[v - 1];
  incident_begin_[0] = 0;
}

/// The column of a vertex with few faces, and their slots.
void LaplacianPattern::find_surfel_column(const FlatMesh& mesh, Index v, SmallRanks& ranks) {
  const auto begin = static_cast<std::size_t>(incident_begin_[static_cast<std::size_t>(v)]);
  const auto end = static_cast<std::size_t>(incident_begin_[static_cast<std::size_t>(v) + 1]);
  ranks.clear();
  if (begin == end) return ranks.sort();
  ranks.push(static_cast<VertexId>(v));  // in every face
  for (std::size_t k = begin; k < end; ++k) {
    const auto corner = static_cast<std::size_t>(incident_[k]);
    for (std::size_t j = 1; j < 4; ++j) ranks.push(mesh.corners[corner ^ j]);
  }
  ranks.sort();
  std::size_t pushed = 1;
  for (std::size_t k = begin; k < end; ++k, pushed += 3) {
    surfel_slots_[k] = {ranks.rank(0), ranks.rank(pushed), ranks.rank(pushed + 1),
                        ranks.rank(pushed + 2)};
  }
}

void LaplacianPattern::find_columns(const FlatMesh& mesh, const Context& context) {
  const Index V = mesh.vertices();
  if (!digital_) {
    polygon_slots_.resize(static_cast<std::size_t>(pairs_before(faces_)));
  }
  std::vector<std::vector<VertexId>> parts(
      static_cast<std::size_t>((V + kPatternGrain - 1) / kPatternGrain));
  outer_.assign(static_cast<std::size_t>(V) + 1, 0);

  parallel_for(context, V, kPatternGrain, [&](Index first, Index last) {
    std::vector<VertexId>& part = parts[static_cast<std::size_t>(first / kPatternGrain)];
    part.reserve(static_cast<std::size_t>(10 * (last - first)));
    Column column;
    SmallRanks ranks;
    for (Index v = first; v < last; ++v) {
      const std::int32_t begin = incident_begin_[static_cast<std::size_t>(v)];
      const std::int32_t end = incident_begin_[static_cast<std::size_t>(v) + 1];
      if (digital_ && 1 + 3 * static_cast<std::size_t>(end - begin) <= SmallRanks::kMost) {
        find_surfel_column(mesh, v, ranks);
        part.insert(part.end(), ranks.sorted().begin(), ranks.sorted().end());
        outer_[static_cast<std::size_t>(v) + 1] = static_cast<std::int32_t>(ranks.sorted().size());
        continue;
      }
      column.clear();
      for (std::int32_t k = begin; k < end; ++k) column.append(mesh.face(place(mesh, k).face));
      column.sort();
      if (digital_ && column.ids().size() > kMostSurfelEntries) {
        throw InputError("vertex " + std::to_string(v) + " has " +
                         std::to_string(column.ids().size()) +
                         " neighbours, more than a digital surface can have at a pointel");
      }
      for (std::int32_t k = begin; k < end; ++k) {
        const Place at = place(mesh, k);
        const auto ids = mesh.face(at.face);
        if (digital_) {
          for (std::size_t j = 0; j < 4; ++j) {
            surfel_slots_[static_cast<std::size_t>(k)][j] = static_cast<std::uint8_t>(
                column.position(ids[static_cast<std::size_t>(at.corner) ^ j]));
          }
          continue;
        }
        std::int32_t* row = polygon_slots_.data() + pairs_before(at.face) +
                            at.corner * static_cast<Index>(ids.size());
        for (const VertexId id : ids) *row++ = static_cast<std::int32_t>(column.position(id));
      }
      part.insert(part.end(), column.ids().begin(), column.ids().end());
      outer_[static_cast<std::size_t>(v) + 1] = static_cast<std::int32_t>(column.ids().size());
    }
    context.advance(last - first);
  });

  Index nonzeros = 0;
  for (const auto& part : parts) nonzeros += static_cast<Index>(part.size());
  checked_id(nonzeros, "nonzeros of the Laplacian");
  for (Index v = 0; v < V; ++v) {
    outer_[static_cast<std::size_t>(v) + 1] += outer_[static_cast<std::size_t>(v)];
  }
  inner_.resize(static_cast<std::size_t>(nonzeros));
  parallel_for(context, V, kPatternGrain, [&](Index first, Index) {
    std::vector<VertexId>& part = parts[static_cast<std::size_t>(first / kPatternGrain)];
    std::copy(part.begin(), part.end(), inner_.begin() + outer_[static_cast<std::size_t>(first)]);
    std::vector<VertexId>().swap(part);
  });
}

void LaplacianPattern::find_blocks(const Context& context) {
  // The faces of a block, 32 bytes each, should stay in the cache of a core; but those between two
  // blocks, about one slice of the volume, are computed for both.
  constexpr Index kBlock = 32768;
  blocks_.resize(static_cast<std::size_t>((vertices() + kBlock - 1) / kBlock));
  parallel_for(context, vertices(), kBlock, [&](Index v, Index last_vertex) {
    const auto begin = static_cast<std::size_t>(incident_begin_[static_cast<std::size_t>(v)]);
    const auto end =
        static_cast<std::size_t>(incident_begin_[static_cast<std::size_t>(last_vertex)]);
    std::int32_t least = static_cast<std::int32_t>(corners_), greatest = -1;
    for (std::size_t k = begin; k < end; ++k) {
      least = std::min(least, incident_[k]);
      greatest = std::max(greatest, incident_[k]);
    }
    // Where no face is: the end and the begin.
    blocks_[static_cast<std::size_t>(v / kBlock)] = {v, last_vertex, least >> 2,
                                                     (greatest >> 2) + 1, 0};
  });
  Index done = 0, total = 0;
  for (Block& block : blocks_) {
    block.first_face = std::min(block.first_face, done);
    block.last_face = std::max(block.last_face, done);
    block.own_face = done;
    done = block.last_face;
    total += block.last_face - block.first_face;
  }
  if (total > 2 * faces_ + kBlock) blocks_.clear();
}

LaplaceSystem LaplacianPattern::assemble(const FlatMesh& mesh, const CalculusOptions& options,
                                         const Context& context) const {
  // The matrix and the mass; what faces contribute is kept by polygons, by surfels for a block
  // only.
  context.need("laplacian", 12 * nonzeros() + 12 * vertices() +
                                (digital_ ? 0 : 8 * (pairs_before(faces_) + faces_)));
  LaplaceSystem system;
  system.L.resize(vertices(), vertices());
  system.L.resizeNonZeros(nonzeros());
  std::copy(outer_.begin(), outer_.end(), system.L.outerIndexPtr());
  std::int32_t* inner = system.L.innerIndexPtr();
  parallel_for(context, nonzeros(), 16 * kPatternGrain, [&](Index first, Index last) {
    std::copy(inner_.begin() + first, inner_.begin() + last, inner + first);
  });
  system.mass.resize(vertices());
  refill(system, mesh, options, context);
  return system;
}

void LaplacianPattern::refill(LaplaceSystem& system, const FlatMesh& mesh,
                              const CalculusOptions& options, const Context& context) const {
  options.check();
  check_mesh(mesh, options);
  if (mesh.vertices() != vertices() || mesh.faces() != faces_ || mesh.corner_count() != corners_ ||
      mesh.is_digital() != digital_) {
    throw UsageError("the Laplacian's pattern was built for another mesh; build it for this one");
  }
  if (system.L.rows() != vertices() || system.L.nonZeros() != nonzeros() ||
      system.mass.size() != vertices()) {
    throw UsageError("the system to refill is not one of this pattern; take it from assemble()");
  }
  context.begin("laplacian", vertices());
  double* values = system.L.valuePtr();
  double* mass = system.mass.data();
  system.clamped_faces = digital_ ? fill_surfels(mesh, options, values, mass, context)
                                  : fill_polygons(mesh, options, values, mass, context);
}

LaplaceSystem assemble_laplacian(const FlatMesh& mesh, const CalculusOptions& options,
                                 const Context& context) {
  options.check();
  check_mesh(mesh, options);
  return LaplacianPattern(mesh, context).assemble(mesh, options, context);
}

}  // namespace dsc
