#include "libdsc/normals/continued_ball.h"

#include "libdsc/normals/row_scan.h"

#include <algorithm>

namespace dsc {
namespace {

/// Doubled offsets from the centre, of one parity; empty where last < first.
struct Interval {
  Index first = 0, last = -1;

  bool contains(Index d) const { return first <= d && d <= last; }
  /// What the interval shares with its mirror image.
  Interval symmetric() const { return {std::max(first, -last), std::min(last, -first)}; }
  Interval within(Index extent) const { return {std::max(first, -extent), std::min(last, extent)}; }
};

/// The voxels of an interval of row (dy, dz) that are not in the set.
RowSums complement(const BinaryVolume& volume, const Interval& dx, Index y, Index z,
                   const Index3& centre) {
  RowSums sums;
  if (dx.first > dx.last) return sums;
  add_run(sums, dx.first, (dx.last - dx.first) / 2 + 1);
  const RowSums inside =
      scan_row(volume, (centre[0] + dx.first) / 2, (centre[0] + dx.last) / 2, y, z, centre[0]);
  return {sums.count - inside.count, sums.first - inside.first, sums.second - inside.second};
}

}  // namespace

bool reaches_beyond(const Grid& grid, const BallRows& rows, const Index3& centre) {
  for (std::size_t a = 0; a < 3; ++a) {
    const Index reach = rows.reach(static_cast<int>(a));
    if (reach >= 0 && (centre[a] - reach < 0 || centre[a] + reach > 2 * (grid.size[a] - 1))) {
      return true;
    }
  }
  return false;
}

BallMoments continued_moments(const BinaryVolume& volume, const BallRows& rows,
                              const Index3& centre) {
  std::array<Interval, 3> grid;  // the offsets that lie in it
  for (std::size_t a = 0; a < 3; ++a) {
    grid[a] = {-centre[a], 2 * (volume.grid().size[a] - 1) - centre[a]};
  }
  BallMoments m;
  const Interval all_dz = grid[2].within(rows.reach(2));
  const Interval all_dy = grid[1].within(rows.reach(1));
  for (Index dz = all_dz.first; dz <= all_dz.last; dz += 2) {
    for (Index dy = all_dy.first; dy <= all_dy.last; dy += 2) {
      const Index extent = rows.extent(dy, dz);
      const Interval dx = grid[0].within(extent);
      if (extent < 0 || dx.first > dx.last) continue;
      const Index y = (centre[1] + dy) / 2;
      const Index z = (centre[2] + dz) / 2;
      add_row(
          m,
          scan_row(volume, (centre[0] + dx.first) / 2, (centre[0] + dx.last) / 2, y, z, centre[0]),
          dy, dz);
      // The voxels of the row whose mirror images lie beyond.
      RowSums mirrored = complement(volume, dx, y, z, centre);
      if (grid[1].symmetric().contains(dy) && grid[2].symmetric().contains(dz)) {
        const RowSums seen = complement(volume, grid[0].symmetric().within(extent), y, z, centre);
        mirrored = {mirrored.count - seen.count, mirrored.first - seen.first,
                    mirrored.second - seen.second};
      }
      add_row(m, {mirrored.count, -mirrored.first, mirrored.second}, -dy, -dz);
    }
  }
  return m;
}

}  // namespace dsc
