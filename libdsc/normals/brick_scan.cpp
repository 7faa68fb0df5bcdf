#include "libdsc/normals/brick_scan.h"

#include "libdsc/base/parallel.h"
#include "libdsc/normals/brick_ball.h"

#include <algorithm>
#include <numbers>

namespace dsc {
namespace {

constexpr double kLeastRows = 200;    // of a ball: below, its rows are few enough
constexpr Index kLeastSurfels = 64;   // a residue: below, its table costs more than it saves
constexpr Index kResidues = 3 * 512;  // of surfels
constexpr Index kMostBricks = 2;      // a surfel: beyond, the volume is too sparse for them

Index3 doubled_centre(const Surfel& s) {
  Index3 c{2 * Index{s.x}, 2 * Index{s.y}, 2 * Index{s.z}};
  c[static_cast<std::size_t>(s.axis())] += s.sign();
  return c;
}

/// The bricks that balls at all these surfels reach.
struct Box {
  Index3 low, size;
};

Box box_of(std::span<const Surfel> surfels, const Ball& ball) {
  Index3 low = doubled_centre(surfels[0]);
  Index3 high = low;
  for (const Surfel& s : surfels) {
    const Index3 c = doubled_centre(s);
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], c[a]);
      high[a] = std::max(high[a], c[a]);
    }
  }
  Box box{};
  for (std::size_t a = 0; a < 3; ++a) {
    const Index reach = ball.reach(static_cast<int>(a));
    // Bytes of the volume's words begin at x = -1.
    box.low[a] = ((low[a] - reach) >> 4) * BrickVolume::kEdge - 1;
    // One more: a row's prefix is also read after its last brick.
    box.size[a] = (((high[a] + reach) >> 1) - box.low[a]) / BrickVolume::kEdge + 2;
  }
  return box;
}

/// A centre, doubled, as the brick that it lies in and its place in that.
struct Place {
  Index3 brick, residue;
};

Place place_of(const Surfel& s, const Index3& low) {
  const Index3 c = doubled_centre(s);
  Place place{};
  for (std::size_t a = 0; a < 3; ++a) {
    const Index from = c[a] - 2 * low[a];
    place.brick[a] = from >> 4;
    place.residue[a] = from & 15;
  }
  return place;
}

std::size_t key_of(const Index3& residue) {
  return static_cast<std::size_t>(residue[0] + 16 * residue[1] + 256 * residue[2]);
}

constexpr std::size_t kKeys = 4096;

}  // namespace

bool bricks_serve(const Ball& ball) {
  return detail::has_brick_kernel() &&
         ball.radius() / ball.spacing().minCoeff() <= BrickBall::kLargest;
}

bool bricks_pay(const Ball& ball, std::span<const Surfel> surfels) {
  const auto n = static_cast<Index>(surfels.size());
  const double square = static_cast<double>(ball.reach(1)) * static_cast<double>(ball.reach(2));
  if (!bricks_serve(ball) || std::numbers::pi / 4 * square < kLeastRows ||
      n < kLeastSurfels * kResidues) {
    return false;
  }
  const Index3 size = box_of(surfels, ball).size;
  return static_cast<double>(size[0]) * static_cast<double>(size[1]) *
             static_cast<double>(size[2]) <=
         static_cast<double>(kMostBricks * n);
}

void brick_scan(const BinaryVolume& volume, const Ball& ball, std::span<const Surfel> surfels,
                const std::function<void(Index, const BallMoments&)>& visit,
                const Context& context) {
  if (surfels.empty()) return;
  const Box box = box_of(surfels, ball);
  // The bricks; those with some voxels inside, collected and joined; the surfels in order. A brick
  // that no surfel touches is uniform, and a mixed one has at least six in or on it.
  const auto count = static_cast<Index>(surfels.size());
  const Index all =
      checked_product(checked_product(box.size[0], box.size[1], "bricks"), box.size[2], "bricks");
  context.need("normals", all * static_cast<Index>(sizeof(BrickSums) + sizeof(std::int32_t)) +
                              4 * std::min(all, count / 6) * static_cast<Index>(sizeof(BrickBits)) +
                              static_cast<Index>(sizeof(std::int32_t)) * count);
  const BrickVolume bricks(volume, box.low, box.size, context);
  const BallRows rows[3] = {BallRows(ball, {1, 0, 0}), BallRows(ball, {0, 1, 0}),
                            BallRows(ball, {0, 0, 1})};

  // Surfels by residue, each in the order given.
  std::vector<Index> begin(kKeys + 1, 0);
  for (const Surfel& s : surfels) ++begin[key_of(place_of(s, box.low).residue) + 1];
  for (std::size_t k = 0; k < kKeys; ++k) begin[k + 1] += begin[k];
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  std::vector<std::int32_t> order(surfels.size());
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    order[static_cast<std::size_t>(next[key_of(place_of(surfels[i], box.low).residue)]++)] =
        static_cast<std::int32_t>(i);
  }

  parallel_for(context, static_cast<Index>(kKeys), 1, [&](Index first, Index last) {
    for (Index key = first; key < last; ++key) {
      const Index from = begin[static_cast<std::size_t>(key)];
      const Index to = begin[static_cast<std::size_t>(key) + 1];
      if (from == to) continue;
      const Index3 residue{key & 15, key >> 4 & 15, key >> 8};
      const std::size_t axis = (residue[0] & 1) != 0 ? 0 : (residue[1] & 1) != 0 ? 1 : 2;
      BrickBall table(bricks, rows[axis], residue);
      for (Index i = from; i < to; ++i) {
        const std::int32_t at = order[static_cast<std::size_t>(i)];
        const Surfel& s = surfels[static_cast<std::size_t>(at)];
        visit(at, table.moments(bricks, place_of(s, box.low).brick));
      }
      context.advance(to - from);
    }
  });
}

}  // namespace dsc
