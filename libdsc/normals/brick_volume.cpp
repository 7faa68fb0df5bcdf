#include "libdsc/normals/brick_volume.h"

#include "libdsc/base/parallel.h"
#include "libdsc/normals/brick_kernel.h"

#include <algorithm>
#include <bit>

namespace dsc {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

/// Bits x … x + 7 of a row, x counted from the grid's first voxel; 0 outside the grid.
std::uint64_t eight(const BinaryVolume& volume, Index x, Index y, Index z) {
  const Index bit = x + 1;
  const Index w = bit >> 6;
  const Index shift = bit & 63;
  const auto word = [&](Index at) {
    return at >= 0 && at < volume.words_per_row() ? volume.word(at, y, z) : 0;
  };
  std::uint64_t bits = word(w) >> shift;
  if (shift > 56) bits |= word(w + 1) << (64 - shift);
  return bits & 0xff;
}

BrickBits read_brick(const BinaryVolume& volume, const Index3& low) {
  const Index3& size = volume.grid().size;
  BrickBits bits{};
  for (Index z = std::max<Index>(0, -low[2]); z < std::min<Index>(8, size[2] - low[2]); ++z) {
    for (Index y = std::max<Index>(0, -low[1]); y < std::min<Index>(8, size[1] - low[1]); ++y) {
      bits[static_cast<std::size_t>(z)] |= eight(volume, low[0], low[1] + y, low[2] + z) << (8 * y);
    }
  }
  return bits;
}

}  // namespace

BrickSums& BrickSums::operator+=(const BrickSums& other) {
  for (std::size_t i = 0; i < 4; ++i) {
    first[i] += other.first[i];
    square[i] += other.square[i];
    cross[i] += other.cross[i];
  }
  return *this;
}

BrickSums moved(const BrickSums& sums, const Index3& by) {
  BrickSums result = sums;
  const auto& f = sums.first;
  auto& g = result.first;
  const auto b = [&by](std::size_t axis) { return static_cast<std::uint32_t>(by[axis - 1]); };
  for (std::size_t a = 1; a <= 3; ++a) {
    g[a] += b(a) * f[0];
    result.square[a] += b(a) * (f[a] + g[a]);
  }
  for (std::size_t a = 1; a <= 3; ++a) {
    const std::size_t next = a % 3 + 1;
    result.cross[a] += b(a) * f[next] + b(next) * g[a];
  }
  return result;
}

BrickSums brick_sums(const BrickBits& bits) {
  BrickSums sums;
  for (std::uint32_t z = 0; z < 8; ++z) {
    for (std::uint64_t left = bits[z]; left != 0; left &= left - 1) {
      const auto at = static_cast<std::uint32_t>(std::countr_zero(left));
      const std::uint32_t x = at & 7, y = at >> 3;
      sums += {{1, x, y, z}, {0, x * x, y * y, z * z}, {0, x * y, y * z, z * x}};
    }
  }
  return sums;
}

BrickVolume::BrickVolume(const BinaryVolume& volume, const Index3& low, const Index3& size,
                         const Context& context)
    : strides_{1, size[0], size[0] * size[1]} {
  const Index n = strides_[2] * size[2];
  if (!(static_cast<double>(strides_[2]) * static_cast<double>(size[2]) < 0x1p31)) {
    throw LimitError("bricks: more than 2^31 of them");
  }
  states_.resize(static_cast<std::size_t>(n));
  before_.resize(static_cast<std::size_t>(n));

  const BrickSums full_sums = brick_sums({kAll, kAll, kAll, kAll, kAll, kAll, kAll, kAll});
  // Each slice collects its mixed bricks; then they are joined, and numbered on.
  std::vector<std::vector<BrickBits>> found(static_cast<std::size_t>(size[2]));
  parallel_for(context, size[2], 1, [&](Index first, Index last) {
    for (Index k = first; k < last; ++k) {
      std::vector<BrickBits>& mixed = found[static_cast<std::size_t>(k)];
      auto at = static_cast<std::size_t>(k * strides_[2]);
      for (Index j = 0; j < size[1]; ++j) {
        BrickSums sum;
        for (Index i = 0; i < size[0]; ++i, ++at) {
          before_[at] = sum;
          const BrickBits bits =
              read_brick(volume, {low[0] + kEdge * i, low[1] + kEdge * j, low[2] + kEdge * k});
          std::uint64_t any = 0, all = kAll;
          for (const std::uint64_t word : bits) {
            any |= word;
            all &= word;
          }
          if (any == 0) continue;
          const bool full = all == kAll;
          states_[at] = full ? kFull : kFirstMixed + static_cast<std::int32_t>(mixed.size());
          sum += moved(full ? full_sums : detail::masked_brick_sums(bits, bits), {kEdge * i, 0, 0});
          if (!full) mixed.push_back(bits);
        }
      }
    }
  });
  for (Index k = 0; k < size[2]; ++k) {
    std::vector<BrickBits>& mixed = found[static_cast<std::size_t>(k)];
    const auto begin = static_cast<std::int32_t>(mixed_.size());
    for (Index at = k * strides_[2]; at < (k + 1) * strides_[2]; ++at) {
      std::int32_t& state = states_[static_cast<std::size_t>(at)];
      if (state >= kFirstMixed) state += begin;
    }
    mixed_.insert(mixed_.end(), mixed.begin(), mixed.end());
    std::vector<BrickBits>().swap(mixed);
  }
}

}  // namespace dsc
