/// \file
/// The topology of a voxel set's boundary, found from the voxels alone in Khalimsky coordinates:
/// the oracle for extraction. Slow, and shares no code with it.
#pragma once

#include "libdsc/surface/digital_surface.h"
#include "libdsc/voxels/binary_volume.h"

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

namespace dsc::testing {

/// A cell of the grid: odd coordinates 2i+1 span voxel i, even ones 2i lie at its low side.
using Cell = std::array<int, 3>;

/// Surfels around a cell: at most 4 around a linel, 12 around a pointel.
class Around {
 public:
  void push_back(const Cell& c) { cells_[size_++] = c; }
  std::size_t size() const { return size_; }
  const Cell* begin() const { return cells_.data(); }
  const Cell* end() const { return cells_.data() + size_; }
  const Cell& operator[](std::size_t i) const { return cells_[i]; }
  bool has(const Cell& c) const { return std::find(begin(), end(), c) != end(); }

 private:
  std::size_t size_ = 0;
  std::array<Cell, 12> cells_{};
};

/// Surfels around every cell of a grid, as a dense table.
class CellTable {
 public:
  explicit CellTable(const Index3& n) : size_{2 * n[0] + 1, 2 * n[1] + 1, 2 * n[2] + 1} {
    table_.resize(static_cast<std::size_t>(size_[0] * size_[1] * size_[2]));
  }
  std::size_t index(const Cell& c) const {
    return static_cast<std::size_t>((c[2] * size_[1] + c[1]) * size_[0] + c[0]);
  }
  std::size_t size() const { return table_.size(); }
  Around& operator[](const Cell& c) { return table_[index(c)]; }
  /// Empty beyond the grid.
  const Around& at(const Cell& c) const {
    static const Around none{};
    for (std::size_t a = 0; a < 3; ++a) {
      if (c[a] < 0 || c[a] >= size_[a]) return none;
    }
    return table_[index(c)];
  }
  /// Calls visit(cell, around) where any surfel is around.
  template <class Visit>
  void for_each(const Visit& visit) const {
    Cell c;
    for (c[2] = 0; c[2] < size_[2]; ++c[2]) {
      for (c[1] = 0; c[1] < size_[1]; ++c[1]) {
        for (c[0] = 0; c[0] < size_[0]; ++c[0]) {
          if (at(c).size() > 0) visit(Cell(c), at(c));
        }
      }
    }
  }

 private:
  Index3 size_;
  std::vector<Around> table_;
};

struct VoxelTopology {
  explicit VoxelTopology(const Index3& n) : linels(n), pointels(n) {}
  std::vector<Cell> surfels;  ///< sorted
  CellTable linels;           ///< linel → its surfels
  CellTable pointels;         ///< pointel → its surfels
  SurfaceCounts counts;
};

inline Cell shifted(Cell c, int axis, int by) {
  c[static_cast<std::size_t>(axis)] += by;
  return c;
}
inline bool odd(const Cell& c, int axis) { return (c[static_cast<std::size_t>(axis)] & 1) != 0; }
inline int normal_axis(const Cell& surfel) { return !odd(surfel, 0) ? 0 : !odd(surfel, 1) ? 1 : 2; }

/// The label of the voxel at an odd cell; of a binary volume 1 or 0.
template <class Volume>
Label voxel_at(const Volume& volume, const Cell& c) {
  return volume((c[0] - 1) >> 1, (c[1] - 1) >> 1, (c[2] - 1) >> 1);
}

/// The voxel on the inside of a surfel, or on its outside: inside is the smaller label but 0.
template <class Volume>
Cell voxel_beside(const Volume& volume, const Cell& s, bool inner) {
  const int axis = normal_axis(s);
  const Cell up = shifted(s, axis, 1), down = shifted(s, axis, -1);
  const Label a = voxel_at(volume, up), b = voxel_at(volume, down);
  const bool up_inside = b == 0 || (a != 0 && a < b);
  return up_inside == inner ? up : down;
}
template <class Volume>
std::array<Label, 2> labels_of(const Volume& volume, const Cell& s) {
  return {voxel_at(volume, voxel_beside(volume, s, true)),
          voxel_at(volume, voxel_beside(volume, s, false))};
}

/// The number of classes of `items` under the symmetric relation `linked`, closed transitively.
template <class Linked>
Index class_count(const Around& items, const Linked& linked) {
  std::array<int, 12> mark{};
  Index classes = 0;
  for (std::size_t start = 0; start < items.size(); ++start) {
    if (mark[start] != 0) continue;
    ++classes;
    std::array<std::size_t, 12> open{start};
    std::size_t count = 1;
    mark[start] = 1;
    while (count > 0) {
      const std::size_t i = open[--count];
      for (std::size_t j = 0; j < items.size(); ++j) {
        if (mark[j] == 0 && linked(items[i], items[j])) {
          mark[j] = 1;
          open[count++] = j;
        }
      }
    }
  }
  return classes;
}

/// Whether two of a linel's surfels are linked: never where they separate different labels; where
/// they are the only two that separate theirs, unless they lie in one plane and face opposite ways;
/// where more do, if they share the voxel that the adjacency names.
template <class Volume>
bool linked_at(const Volume& volume, Adjacency adjacency, const Around& around, const Cell& s,
               const Cell& r) {
  const auto pair = labels_of(volume, s);
  if (pair != labels_of(volume, r)) return false;
  const auto alike = std::count_if(around.begin(), around.end(),
                                   [&](const Cell& c) { return labels_of(volume, c) == pair; });
  const int a = normal_axis(s), b = normal_axis(r);
  if (alike == 2) {
    return a != b || voxel_at(volume, shifted(s, a, 1)) == voxel_at(volume, shifted(r, b, 1));
  }
  const bool inner = adjacency == Adjacency::interior;
  return voxel_beside(volume, s, inner) == voxel_beside(volume, r, inner);
}

/// `kept`, where given, says which surfels (by their cell) belong to the part.
template <class Volume>
VoxelTopology voxel_topology(const Volume& volume, Adjacency adjacency,
                             const std::function<bool(const Cell&)>& kept = {}) {
  const Index3 n = volume.grid().size;
  VoxelTopology t(n);
  for (int axis = 0; axis < 3; ++axis) {
    Index3 last = n;
    ++last[static_cast<std::size_t>(axis)];
    for (int k = 0; k < last[2]; ++k) {
      for (int j = 0; j < last[1]; ++j) {
        for (int i = 0; i < last[0]; ++i) {
          const Cell s = shifted({2 * i + 1, 2 * j + 1, 2 * k + 1}, axis, -1);
          const Label above = voxel_at(volume, shifted(s, axis, 1));
          const Label below = voxel_at(volume, shifted(s, axis, -1));
          if (above != below && (!kept || kept(s))) t.surfels.push_back(s);
        }
      }
    }
  }
  std::sort(t.surfels.begin(), t.surfels.end());
  for (const Cell& s : t.surfels) {
    for (int a = 0; a < 3; ++a) {
      if (a == normal_axis(s)) continue;
      for (const int da : {-1, 1}) {
        t.linels[shifted(s, a, da)].push_back(s);
        for (int b = a + 1; b < 3; ++b) {
          if (b == normal_axis(s)) continue;
          for (const int db : {-1, 1}) t.pointels[shifted(shifted(s, a, da), b, db)].push_back(s);
        }
      }
    }
  }
  t.counts.faces = static_cast<Index>(t.surfels.size());
  t.linels.for_each([&](const Cell&, const Around& around) {
    ++t.counts.edges;
    if (around.size() == 1) ++t.counts.boundary_edges;
    if (around.size() > 2) ++t.counts.nonmanifold_edges;
  });
  // Components: pointels joined by the surfels.
  std::vector<std::size_t> parent(t.pointels.size());
  const auto root = [&](std::size_t c) {
    while (parent[c] != c) c = parent[c];
    return c;
  };
  t.pointels.for_each([&](const Cell& pointel, const Around& around) {
    ++t.counts.vertices;
    parent[t.pointels.index(pointel)] = t.pointels.index(pointel);
    const Index umbrellas = class_count(around, [&](const Cell& s, const Cell& r) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const int d : {-1, 1}) {
          const Around& l = t.linels.at(shifted(pointel, axis, d));
          if (l.has(s) && l.has(r) && linked_at(volume, adjacency, l, s, r)) return true;
        }
      }
      return false;
    });
    if (umbrellas > 1) ++t.counts.pinched_vertices;
  });
  t.counts.euler = t.counts.vertices - t.counts.edges + t.counts.faces;
  for (const Cell& s : t.surfels) {
    const int a = (normal_axis(s) + 1) % 3, b = (normal_axis(s) + 2) % 3;
    const std::size_t first = t.pointels.index(shifted(shifted(s, a, -1), b, -1));
    for (const int da : {-1, 1}) {
      for (const int db : {-1, 1}) {
        parent[root(t.pointels.index(shifted(shifted(s, a, da), b, db)))] = root(first);
      }
    }
  }
  t.pointels.for_each([&](const Cell& p, const Around&) {
    t.counts.components += parent[t.pointels.index(p)] == t.pointels.index(p) ? 1 : 0;
  });
  return t;
}

/// The Khalimsky cell of a surfel.
inline Cell cell_of(const Surfel& s) {
  return shifted({2 * s.x + 1, 2 * s.y + 1, 2 * s.z + 1}, s.axis(), s.sign());
}

}  // namespace dsc::testing
