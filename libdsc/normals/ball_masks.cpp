#include "libdsc/normals/ball_masks.h"

#include <algorithm>

namespace dsc {
namespace {

using Word = BinaryVolume::Word;
constexpr Index kWidest = 64;  // voxels of a ball along an axis

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

std::unique_ptr<BallMasks> BallMasks::make(const BallRows& rows) {
  if (!detail::has_ball_kernel()) return nullptr;
  for (int axis = 0; axis < 3; ++axis) {
    if (rows.reach(axis) < 0 || rows.reach(axis) + 1 > kWidest) return nullptr;
  }
  return std::unique_ptr<BallMasks>(new BallMasks(rows));
}

BallMasks::BallMasks(const BallRows& rows) : reach_{rows.reach(0), rows.reach(1), rows.reach(2)} {
  std::vector<std::size_t> mask_at;  // pointers once masks_ no longer moves
  std::vector<std::size_t> strip_at;
  const Index slices = reach_[2] + 1;
  const Index lower_half = (slices + 1) / 2;
  for (Index k = 0; k < slices; ++k) {
    strip_at.push_back(strips_.size());
    const Index dz = -reach_[2] + 2 * k;
    if (k >= lower_half) {  // the mirror image shares its masks
      const std::size_t twin = static_cast<std::size_t>(slices - 1 - k);
      for (std::size_t s = strip_at[twin]; s < strip_at[twin + 1]; ++s) {
        mask_at.push_back(mask_at[s]);
        strips_.push_back(strips_[s]);
      }
      continue;
    }
    Index last = reach_[1];
    while (last >= 0 && rows.extent(last, dz) < 0) last -= 2;
    if (last < 0) continue;
    const Index groups = (last + 1 + 3) / 4;
    const Index parts = (groups + detail::kStripGroups - 1) / detail::kStripGroups;
    for (Index part = 0; part < parts; ++part) {
      const Index begin = groups * part / parts;
      const Index end = groups * (part + 1) / parts;
      const Index first_dy = -last + 8 * begin;
      mask_at.push_back(masks_.size());
      strips_.push_back({nullptr, static_cast<std::int32_t>((first_dy + reach_[1]) / 2),
                         static_cast<std::int32_t>(first_dy),
                         static_cast<std::int32_t>(end - begin)});
      for (Index r = 0; r < 4 * (end - begin); ++r) {
        const Index dy = first_dy + 2 * r;
        const Index extent = dy <= last ? rows.extent(dy, dz) : -1;
        const Index skip = (reach_[0] - extent) / 2;
        masks_.push_back(extent < 0 ? 0 : (~Word{0} >> (63 - extent)) << skip);
      }
    }
  }
  strip_at.push_back(strips_.size());
  for (std::size_t s = 0; s < strips_.size(); ++s) strips_[s].masks = masks_.data() + mask_at[s];
  for (const std::size_t s : strip_at) first_strip_.push_back(strips_.data() + s);
}

BallMoments BallMasks::moments(const BinaryVolume& volume, const Index3& centre) const {
  const Index3& size = volume.grid().size;
  const Index bit = ((centre[0] - reach_[0]) >> 1) + 1;
  const Index w = bit >> 6;
  const int shift = static_cast<int>(bit & 63);
  const bool two_words = shift + reach_[0] + 1 > 64;
  const Index y_first = (centre[1] - reach_[1]) >> 1;
  const Index rows = reach_[1] + 1;
  const Index z_first = (centre[2] - reach_[2]) >> 1;
  const Index begin = std::max<Index>(0, -z_first);
  const Index end = std::min(reach_[2] + 1, size[2] - z_first);
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

  // dx = 2P - reach; dz = o + 2 (k + 1).
  const Index rx = reach_[0];
  const Index o = -reach_[2] + 2 * begin - 2;
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

}  // namespace dsc
