/// \file
/// \internal
/// The inner loop of BallScanner on AVX2: four rows of a ball in one register.
///
/// A ball is cut into slices of constant z, a slice into strips of at most kStripGroups groups of
/// four rows. A row is a window of 64 bits along x from the ball's leftmost column; bit P of it is
/// x = first column + P. The kernel gives sums over the bits b of the ball, in P, in doubled dy,
/// and in k + 1 for the k-th slice; BallMasks turns them into moments.
///
/// How (after the counts by nibble tables of Mula, Kurz and Lemire, 2016): per byte, tables of 16
/// entries looked up by byte shuffles give c = sum b, t = sum j b, q = sum b (d^2 - 1)/8, where j
/// in 0..7 is the place in the byte and d = 2j - 7, so that sum j^2 b = 2q + 7t - 12c; byte B of a
/// row holds P = 8B + j. Weights along y and z cost no multiplications: rows and slices are visited
/// downwards, and a running sum of running sums weighs the k-th by k + 1. A strip is short enough
/// for c, t, q to be summed in bytes (8 * 28 <= 255) and the running sums of sum P b in 16 bits (36
/// * 888 <= 32767).
#pragma once

#include <cstdint>

namespace dsc::detail {

inline constexpr int kStripGroups = 8;

/// Rows y of one slice that share running sums; masks cut each row to the ball (0 beyond its end).
struct BallStrip {
  const std::uint64_t* masks;  ///< 4 * groups words
  std::int32_t first_row;      ///< counted from the ball's lowest row
  std::int32_t first_dy;       ///< doubled offset of the first row from the centre
  std::int32_t groups;
};

/// Rows of one slice: row r of the ball is at low[r] and, to its right, high[r].
struct BallWords {
  const std::uint64_t* low;
  const std::uint64_t* high;  ///< null where the window lies in one word
};

/// Sums over b; k counts the slices given, from 0.
struct KernelSums {
  std::int64_t n = 0, k1 = 0, k2 = 0;          // 1, (k + 1), (k + 1)(k + 2) / 2
  std::int64_t y = 0, yy = 0, yk = 0;          // dy, dy^2, dy (k + 1)
  std::int64_t p = 0, pp = 0, py = 0, pk = 0;  // P, P^2, P dy, P (k + 1)
};

/// Whether this machine runs the kernel.
bool has_ball_kernel();

/// One ball of `slices` slices: slice k has strips[k] … strips[k + 1] (pointers into one array) and
/// words[k]; every window starts at bit `shift` of its low word.
/// Precondition: has_ball_kernel(); at most 64 slices of at most 64 rows.
KernelSums ball_kernel(const BallStrip* const* strips, const BallWords* words, int slices,
                       int shift);

}  // namespace dsc::detail
