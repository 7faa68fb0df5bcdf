#include "libdsc/normals/ball_masks.h"

#include <algorithm>

namespace dsc {
namespace {

using Word = BinaryVolume::Word;
constexpr Index kWidest = 64;        // voxels of a block along an axis
constexpr double kMostBytes = 64e6;  // of masks: balls beyond radius 400 or so are scanned plainly

/// The rows of one slice of a ball that leaves the grid, copied: 0 outside.
class ClippedSlice {
 public:
  detail::BallWords copy(const BinaryVolume& volume, Index w, Index y_first, Index rows, Index z,
                         bool two_words) {
    copy_column(volume, w, y_first, rows, z, low_);
    if (two_words) copy_column(volume, w + 1, y_first, rows, z, high_);
    return {low_, two_words ? high_ : nullptr};
  }

 private:
  static void copy_column(const BinaryVolume& volume, Index w, Index y_first, Index rows, Index z,
                          Word* out) {
    std::fill_n(out, kWidest + 4, Word{0});
    if (w < 0 || w >= volume.words_per_row()) return;
    const Index begin = std::max<Index>(0, -y_first);
    const Index end = std::min(rows, volume.grid().size[1] - y_first);
    for (Index r = begin; r < end; ++r) out[r] = volume.word(w, y_first + r, z);
  }

  // The kernel reads whole groups of four rows.
  Word low_[kWidest + 4];
  Word high_[kWidest + 4];
};

}  // namespace

BallBlock::BallBlock(const BallRows& rows, const Index3& low, const Index3& size)
    : low_(low), size_(size) {
  std::vector<std::size_t> mask_at;  // pointers once masks_ no longer moves
  std::vector<std::size_t> strip_at;
  for (Index k = 0; k < size_[2]; ++k) {
    strip_at.push_back(strips_.size());
    const Index dz = low_[2] + 2 * k;
    // Mirror images share their masks.
    const Index twin = (-dz - low_[2]) / 2;
    if (twin >= 0 && twin < k) {
      const auto t = static_cast<std::size_t>(twin);
      for (std::size_t s = strip_at[t]; s < strip_at[t + 1]; ++s) {
        mask_at.push_back(mask_at[s]);
        strips_.push_back(strips_[s]);
      }
    } else {
      add_slice(rows, dz, mask_at);
    }
  }
  strip_at.push_back(strips_.size());
  for (std::size_t s = 0; s < strips_.size(); ++s) strips_[s].masks = masks_.data() + mask_at[s];
  for (const std::size_t s : strip_at) first_strip_.push_back(strips_.data() + s);
}

void BallBlock::add_slice(const BallRows& rows, Index dz, std::vector<std::size_t>& mask_at) {
  const Index last_dx = low_[0] + 2 * (size_[0] - 1);
  const auto mask = [&](Index row) {
    const Index extent = rows.extent(low_[1] + 2 * row, dz);
    const Index from = std::max(-extent, low_[0]);
    const Index to = std::min(extent, last_dx);
    if (extent < 0 || from > to) return Word{0};
    return (~Word{0} >> (63 - (to - from) / 2)) << ((from - low_[0]) / 2);
  };
  Index first = 0;
  Index last = size_[1] - 1;
  while (first <= last && mask(first) == 0) ++first;
  while (first <= last && mask(last) == 0) --last;
  const Index groups = (last - first + 1 + 3) / 4;
  const Index parts = (groups + detail::kStripGroups - 1) / detail::kStripGroups;
  for (Index part = 0; part < parts; ++part) {
    const Index begin = groups * part / parts;
    const Index end = groups * (part + 1) / parts;
    const Index first_row = first + 4 * begin;
    mask_at.push_back(masks_.size());
    strips_.push_back({nullptr, static_cast<std::int32_t>(first_row),
                       static_cast<std::int32_t>(low_[1] + 2 * first_row),
                       static_cast<std::int32_t>(end - begin)});
    for (Index r = 0; r < 4 * (end - begin); ++r) {
      masks_.push_back(first_row + r <= last ? mask(first_row + r) : 0);
    }
  }
}

BallMoments BallBlock::moments(const BinaryVolume& volume, const Index3& centre) const {
  const Index3& size = volume.grid().size;
  const Index bit = ((centre[0] + low_[0]) >> 1) + 1;
  const Index w = bit >> 6;
  const int shift = static_cast<int>(bit & 63);
  const bool two_words = shift + size_[0] > 64;
  const Index y_first = (centre[1] + low_[1]) >> 1;
  const Index rows = size_[1];
  const Index z_first = (centre[2] + low_[2]) >> 1;
  const Index begin = std::max<Index>(0, -z_first);
  const Index end = std::min(size_[2], size[2] - z_first);
  if (begin >= end) return {};

  const bool inside = w >= 0 && w + (two_words ? 1 : 0) < volume.words_per_row() && y_first >= -1 &&
                      y_first + rows <= size[1] + 1;
  detail::KernelSums s;
  const auto slices = static_cast<int>(end - begin);
  if (inside) {
    detail::BallWords words[kWidest];
    const Word* low = volume.word_address(w, y_first, z_first + begin);
    for (int k = 0; k < slices; ++k, low += volume.slice_stride()) {
      words[k] = {low, two_words ? low + volume.word_stride() : nullptr};
    }
    s = detail::ball_kernel(first_strip_.data() + begin, words, slices, shift);
  } else {
    const auto copies =
        std::make_unique_for_overwrite<ClippedSlice[]>(static_cast<std::size_t>(slices));
    detail::BallWords words[kWidest];
    for (int k = 0; k < slices; ++k) {
      words[k] = copies[static_cast<std::size_t>(k)].copy(volume, w, y_first, rows,
                                                          z_first + begin + k, two_words);
    }
    s = detail::ball_kernel(first_strip_.data() + begin, words, slices, shift);
  }

  // dx = 2P - rx; dz = o + 2 (k + 1).
  const Index rx = -low_[0];
  const Index o = low_[2] + 2 * begin - 2;
  BallMoments m;
  m.count = s.n;
  m.first = {2 * s.p - rx * s.n, s.y, o * s.n + 2 * s.k1};
  m.second[0] = 4 * s.pp - 4 * rx * s.p + rx * rx * s.n;
  m.second[1] = s.yy;
  m.second[2] = o * o * s.n + 4 * o * s.k1 + 4 * (2 * s.k2 - s.k1);
  m.second[3] = 2 * s.py - rx * s.y;
  m.second[5] = o * s.y + 2 * s.yk;
  m.second[4] = 2 * (o * s.p + 2 * s.pk) - rx * m.first[2];
  return m;
}

std::unique_ptr<BallMasks> BallMasks::make(const BallRows& rows) {
  if (!detail::has_ball_kernel()) return nullptr;
  double bytes = sizeof(Word);
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<double>(rows.reach(axis) + 1);
    bytes *= axis == 0 ? n / kWidest + 1 : n;
  }
  if (bytes > kMostBytes) return nullptr;
  return std::unique_ptr<BallMasks>(new BallMasks(rows));
}

BallMasks::BallMasks(const BallRows& rows) {
  const Index3 last{rows.reach(0), rows.reach(1), rows.reach(2)};
  if (last[0] < 0) return;
  Index3 parts{};
  for (std::size_t a = 0; a < 3; ++a) parts[a] = last[a] / kWidest + 1;
  blocks_.reserve(static_cast<std::size_t>(parts[0] * parts[1] * parts[2]));
  for (Index z = 0; z < parts[2]; ++z) {
    for (Index y = 0; y < parts[1]; ++y) {
      for (Index x = 0; x < parts[0]; ++x) {
        const Index3 part{x, y, z};
        Index3 low{};
        Index3 size{};
        for (std::size_t a = 0; a < 3; ++a) {
          const Index begin = (last[a] + 1) * part[a] / parts[a];
          low[a] = -last[a] + 2 * begin;
          size[a] = (last[a] + 1) * (part[a] + 1) / parts[a] - begin;
        }
        BallBlock block(rows, low, size);
        if (!block.empty()) blocks_.push_back(std::move(block));
      }
    }
  }
}

BallMoments BallMasks::moments(const BinaryVolume& volume, const Index3& centre) const {
  BallMoments total;
  for (const BallBlock& block : blocks_) {
    const BallMoments m = block.moments(volume, centre);
    total.count += m.count;
    for (std::size_t i = 0; i < m.first.size(); ++i) total.first[i] += m.first[i];
    for (std::size_t i = 0; i < m.second.size(); ++i) total.second[i] += m.second[i];
  }
  return total;
}

}  // namespace dsc
