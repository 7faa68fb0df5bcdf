#include "libdsc/normals/brick_ball.h"

#include <algorithm>

namespace dsc {
namespace {

constexpr Index kEdge = BrickVolume::kEdge;

/// The brick that voxel p lies in.
Index brick_of(Index p) { return p >> 3; }

/// The rows of a ball, by voxels counted from the lowest of the centre's brick.
class VoxelRows {
 public:
  VoxelRows(const BallRows& rows, const Index3& residue) : rows_(rows), residue_(residue) {}

  /// The bricks that the ball reaches along an axis; none where first > last.
  std::pair<Index, Index> bricks(std::size_t axis) const {
    const Index reach = rows_.reach(static_cast<int>(axis));
    if (reach < 0) return {0, -1};
    return {brick_of((residue_[axis] - reach) / 2), brick_of((residue_[axis] + reach) / 2)};
  }
  /// The voxels x of row (y, z) in the ball; none where first > last.
  std::pair<Index, Index> row(Index y, Index z) const {
    const Index dy = 2 * y - residue_[1];
    const Index dz = 2 * z - residue_[2];
    const auto within = [this](Index d, int axis) { return std::abs(d) <= rows_.reach(axis); };
    const Index extent = within(dy, 1) && within(dz, 2) ? rows_.extent(dy, dz) : -1;
    if (extent < 0) return {0, -1};
    // Floors, of even numbers.
    return {(residue_[0] - extent) >> 1, (residue_[0] + extent) >> 1};
  }

 private:
  const BallRows& rows_;
  Index3 residue_;
};

/// The bits of x in [first, last] among the eight of brick i.
std::uint64_t row_mask(Index first, Index last, Index i) {
  const Index from = std::max<Index>(first - kEdge * i, 0);
  const Index to = std::min<Index>(last - kEdge * i, kEdge - 1);
  return from <= to ? (0xffu << from) & (0xffu >> (kEdge - 1 - to)) : 0;
}

bool is_empty(const BrickBits& mask) {
  return std::all_of(mask.begin(), mask.end(), [](auto word) { return word == 0; });
}

bool is_full(const BrickBits& mask) {
  return std::all_of(mask.begin(), mask.end(), [](auto word) { return ~word == 0; });
}

detail::BrickOffset offset(const Index3& brick) {
  const auto voxels = [](Index bricks) { return static_cast<std::int32_t>(kEdge * bricks); };
  return {0, voxels(brick[0]), voxels(brick[1]), voxels(brick[2])};
}

}  // namespace

BrickBall::BrickBall(const BrickVolume& volume, const BallRows& rows, const Index3& residue)
    : residue_(residue) {
  const VoxelRows voxels(rows, residue);
  const auto [first_i, last_i] = voxels.bricks(0);
  const auto [first_j, last_j] = voxels.bricks(1);
  const auto [first_k, last_k] = voxels.bricks(2);
  std::vector<BrickBits> masks;  // of one row of bricks
  for (Index k = first_k; k <= last_k; ++k) {
    for (Index j = first_j; j <= last_j; ++j) {
      masks.assign(static_cast<std::size_t>(last_i - first_i + 1), BrickBits{});
      for (Index z = 0; z < kEdge; ++z) {
        for (Index y = 0; y < kEdge; ++y) {
          const auto [first, last] = voxels.row(kEdge * j + y, kEdge * k + z);
          if (first > last) continue;
          for (Index i = brick_of(first); i <= brick_of(last); ++i) {
            masks[static_cast<std::size_t>(i - first_i)][static_cast<std::size_t>(z)] |=
                row_mask(first, last, i) << (8 * y);
          }
        }
      }
      detail::BrickRow inner{0, 0, offset({0, j, k})};
      for (Index i = first_i; i <= last_i; ++i) {
        const BrickBits& mask = masks[static_cast<std::size_t>(i - first_i)];
        const auto place = static_cast<std::int32_t>(volume.place({i, j, k}));
        if (is_empty(mask)) continue;
        if (is_full(mask)) {
          if (inner.first == inner.last) inner.first = place;
          inner.last = place + 1;  // a ball is convex: they follow one another
        } else {
          places_.push_back(place);
          by_.push_back(offset({i, j, k}));
          masks_.push_back(mask);
          full_.push_back(
              moved(detail::masked_brick_sums(mask, mask), {kEdge * i, kEdge * j, kEdge * k}));
        }
      }
      if (inner.first != inner.last) rows_.push_back(inner);
    }
  }
  full_list_.resize(places_.size() + 1);
  mixed_list_.resize(places_.size() + 1);
}

BallMoments BrickBall::moments(const BrickVolume& volume, const Index3& centre) {
  const Index at = volume.place(centre);
  const detail::CutBricks cut{places_.size(), places_.data(),    by_.data(),        masks_.data(),
                              full_.data(),   full_list_.data(), mixed_list_.data()};
  const detail::BrickView view{volume.states() + at, volume.mixed(), volume.before() + at};
  const detail::BallSums sums = detail::brick_ball_sums(
      rows_.data(), rows_.size(), static_cast<std::int32_t>(-kEdge * centre[0]), cut, view);

  // From voxels counted from the centre's brick to d = 2 x - r.
  const auto& [n, x, y, z] = sums.first;
  const auto& [rx, ry, rz] = residue_;
  const auto second = [count = n](Index ab, Index a, Index b, Index ra, Index rb) {
    return 4 * ab - 2 * (ra * b + rb * a) + ra * rb * count;
  };
  BallMoments m;
  m.count = n;
  m.first = {2 * x - rx * n, 2 * y - ry * n, 2 * z - rz * n};
  m.second = {second(sums.square[1], x, x, rx, rx), second(sums.square[2], y, y, ry, ry),
              second(sums.square[3], z, z, rz, rz), second(sums.cross[1], x, y, rx, ry),
              second(sums.cross[3], x, z, rx, rz),  second(sums.cross[2], y, z, ry, rz)};
  return m;
}

}  // namespace dsc
