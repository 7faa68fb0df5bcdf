/// \file
/// \internal
/// Sums over a row of a ball, and how they enter the ball's moments.
#pragma once

#include "libdsc/normals/ball_moments.h"

namespace dsc {

/// Count, sum dx and sum dx dx over voxels of one row.
struct RowSums {
  Index count = 0, first = 0, second = 0;
};

/// Adds the run of `n` voxels at dx = start, start + 2, ….
inline void add_run(RowSums& sums, Index start, Index n) {
  sums.count += n;
  sums.first += n * (start + n - 1);
  sums.second += n * start * start + 2 * start * n * (n - 1) + 2 * (n - 1) * n * (2 * n - 1) / 3;
}

/// Adds row (dy, dz) of the ball.
inline void add_row(BallMoments& m, const RowSums& row, Index dy, Index dz) {
  m.count += row.count;
  m.first[0] += row.first;
  m.first[1] += dy * row.count;
  m.first[2] += dz * row.count;
  m.second[0] += row.second;
  m.second[1] += dy * dy * row.count;
  m.second[2] += dz * dz * row.count;
  m.second[3] += dy * row.first;
  m.second[4] += dz * row.first;
  m.second[5] += dy * dz * row.count;
}

}  // namespace dsc
