/// \file
/// Where every face's contributions go in the Laplacian: the part of assembly that depends on the
/// corners alone, built once and filled as often as normals or λ change.
///
/// Column v holds, sorted, the vertices that share a face with v. The fill gathers: for every
/// vertex it walks the incident corners in ascending order and adds each face's row to the column
/// through precomputed slots. Nothing is searched, nothing is shared between threads, and every sum
/// has one order. A face that has a vertex twice, and vertices where the surface is pinched, need
/// no care.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/calculus/options.h"
#include "libdsc/surface/flat_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dsc {

class SmallRanks;
struct LaplaceSystem;

/// The sparsity of the Laplacian of one set of corners, and the way to fill it.
class LaplacianPattern {
 public:
  /// Reads the corners of `mesh`, which is not kept.
  /// \throws InputError where a corner is not a vertex, LimitError where corners or nonzeros pass
  /// 31 bits.
  explicit LaplacianPattern(const FlatMesh& mesh, const Context& context = {});

  /// V.
  Index vertices() const { return static_cast<Index>(outer_.size()) - 1; }
  /// F.
  Index faces() const { return faces_; }
  /// Entries stored, both triangles and the diagonal.
  Index nonzeros() const { return static_cast<Index>(inner_.size()); }

  /// The Laplacian and mass of `mesh`, whose corners must be those of the pattern (its sizes are
  /// checked); see assemble_laplacian().
  LaplaceSystem assemble(const FlatMesh& mesh, const CalculusOptions& options = {},
                         const Context& context = {}) const;
  /// The same into a system that assemble() has returned: new values, no allocation of its matrix.
  void refill(LaplaceSystem& system, const FlatMesh& mesh, const CalculusOptions& options = {},
              const Context& context = {}) const;

 private:
  void need_memory(const FlatMesh& mesh, const Context& context) const;
  void find_incident(const FlatMesh& mesh, const Context& context);
  void find_columns(const FlatMesh& mesh, const Context& context);
  void find_surfel_column(const FlatMesh& mesh, Index v, SmallRanks& ranks);
  Index fill_surfels(const FlatMesh& mesh, const CalculusOptions& options, double* values,
                     double* mass, const Context& context) const;
  Index fill_polygons(const FlatMesh& mesh, const CalculusOptions& options, double* values,
                      double* mass, const Context& context) const;

  /// Vertices that are filled together, and the faces around them.
  struct Block {
    Index first_vertex, last_vertex;
    Index first_face, last_face;
    Index own_face;  ///< faces from here on are in no earlier block
  };
  void find_blocks(const Context& context);

  /// The face of an incident corner and the corner's place in it.
  struct Place {
    Index face, corner;
  };
  Place place(const FlatMesh& mesh, std::int32_t entry) const {
    const auto at = static_cast<std::size_t>(entry);
    if (mesh.offsets.empty()) return {incident_[at] >> 2, incident_[at] & 3};
    const Index face = incident_face_[at];
    return {face, incident_[at] - mesh.first_corner(face)};
  }
  /// The number of (corner, corner) pairs in the faces before `face`: where its slots begin.
  Index pairs_before(Index face) const {
    return pairs_.empty() ? 16 * face : pairs_[static_cast<std::size_t>(face)];
  }

  Index faces_ = 0;
  Index corners_ = 0;
  bool digital_ = false;
  std::vector<std::int32_t> outer_, inner_;   ///< as in SparseMatrix
  std::vector<std::int32_t> incident_begin_;  ///< V + 1 positions in incident_
  std::vector<std::int32_t> incident_;        ///< C corners, by vertex, ascending
  std::vector<std::int32_t> incident_face_;   ///< their faces; empty where all are quads
  std::vector<Index> pairs_;                  ///< F + 1; empty where all are quads
  /// Of surfels, whose columns have at most 27 entries: for each incident corner i, in the order of
  /// incident_, the positions of the vertices of corners i, i xor 1, i xor 2 and i xor 3 in the
  /// column.
  std::vector<std::array<std::uint8_t, 4>> surfel_slots_;
  /// Of polygons: for corners i, j of a face, the position of j's vertex in the column of i's.
  std::vector<std::int32_t> polygon_slots_;
  /// Of surfels: all vertices, in ranges. Empty where the numbering of the faces does not follow
  /// that of the vertices, so that the faces around a range would be too many.
  std::vector<Block> blocks_;
};

}  // namespace dsc
