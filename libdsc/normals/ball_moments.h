/// \file
/// Exact moments of the voxels in balls: the sums behind integral invariant normals and curvature.
///
/// For a ball centred at C (doubled lattice coordinates) and the voxels p of the set within it,
/// with d = 2p - C: the count, sum d and sum d d^T, as 64-bit integers. They are exact, so they do
/// not depend on the order of summation, the number of threads or the instructions used.
#pragma once

#include "libdsc/normals/ball.h"
#include "libdsc/voxels/binary_volume.h"

#include <memory>

namespace dsc {

/// The sums over the voxels in one ball; all 0 where it has none.
struct BallMoments {
  Index count = 0;        ///< voxels
  Index3 first{0, 0, 0};  ///< sum dx, dy, dz
  std::array<Index, 6> second{0, 0, 0,
                              0, 0, 0};  ///< sum of dx dx, dy dy, dz dz, dx dy, dx dz, dy dz

  friend bool operator==(const BallMoments&, const BallMoments&) = default;
};

/// The covariance of DESIGN: V = hx hy hz sum (p - mean)(p - mean)^T, world units; zero for no
/// voxel. The integers are combined exactly, so each entry is within a few roundings of the truth.
Mat3 covariance(const BallMoments& moments, const Vec3& spacing);

class BallMasks;

/// Scans balls of one radius in one volume. Built once, then read by any number of threads.
class BallScanner {
 public:
  /// Which centres will be asked for; the tables of the others are not built.
  enum class Centres {
    voxels,   ///< all doubled coordinates even
    surfels,  ///< one of them odd
  };

  /// Keeps a reference to the volume. \throws as Ball does.
  BallScanner(const BinaryVolume& volume, double radius, Centres centres);
  ~BallScanner();
  BallScanner(const BallScanner&) = delete;
  BallScanner& operator=(const BallScanner&) = delete;

  /// The ball that is scanned.
  const Ball& ball() const { return ball_; }

  /// Moments of the ball at `centre`, doubled: (2x, 2y, 2z) for a voxel's, 2x +- 1 along one axis
  /// for a surfel's. It may lie anywhere, also outside the grid, where nothing is set. \throws
  /// UsageError on a centre of a kind that was not announced.
  BallMoments operator()(const Index3& centre) const;

  /// The same by scanning each row's runs: the oracle of the vector path, and the path for machines
  /// without it and for balls too large for it.
  BallMoments plain(const Index3& centre) const;

  /// The same for a volume whose object goes on beyond it (continued_ball.h). `cut` tells whether
  /// the ball reaches there.
  BallMoments continued(const Index3& centre, bool& cut) const;

  /// Whether operator() goes through the vector path for every kind of centre.
  bool vectorised() const;

 private:
  std::size_t kind(const Index3& centre) const;

  const BinaryVolume& volume_;
  Ball ball_;
  std::vector<BallRows> rows_;  ///< by kind(): one for voxels, one an axis for surfels
  std::vector<std::unique_ptr<BallMasks>> masks_;  ///< by kind(); null: plain
};

}  // namespace dsc
