#include "libdsc/normals/brick_kernel.h"

#include "libdsc/normals/nibble_tables.h"

#if defined(__x86_64__) && defined(__GNUC__)

namespace dsc::detail {
namespace {

/// The sums of eight 32-bit lanes of each of four registers.
DSC_AVX2_INLINE __m128i sums_of(__m256i a, __m256i b, __m256i c, __m256i d) {
  const __m256i quarters = _mm256_hadd_epi32(_mm256_hadd_epi32(a, b), _mm256_hadd_epi32(c, d));
  return _mm_add_epi32(_mm256_castsi256_si128(quarters), _mm256_extracti128_si256(quarters, 1));
}

/// Lanes 1, 2, 3 become 2, 3, 1: y, z, x.
DSC_AVX2_INLINE __m128i turned(__m128i v) { return _mm_shuffle_epi32(v, _MM_SHUFFLE(1, 3, 2, 0)); }

/// Three lanes of four, as in BrickSums, by 32 bits and by 64.
struct Sums {
  __m128i first, square, cross;
};
struct WideSums {
  __m256i first, square, cross;
};

DSC_AVX2_INLINE void add(WideSums& total, const Sums& s) {
  total.first = _mm256_add_epi64(total.first, _mm256_cvtepi32_epi64(s.first));
  total.square = _mm256_add_epi64(total.square, _mm256_cvtepi32_epi64(s.square));
  total.cross = _mm256_add_epi64(total.cross, _mm256_cvtepi32_epi64(s.cross));
}

/// moved() of brick_volume.h.
DSC_AVX2_INLINE Sums moved(const Sums& s, __m128i by) {
  const __m128i n = _mm_shuffle_epi32(s.first, 0);
  const __m128i first = _mm_add_epi32(s.first, _mm_mullo_epi32(by, n));
  return {first, _mm_add_epi32(s.square, _mm_mullo_epi32(by, _mm_add_epi32(s.first, first))),
          _mm_add_epi32(s.cross, _mm_add_epi32(_mm_mullo_epi32(by, turned(s.first)),
                                               _mm_mullo_epi32(turned(by), first)))};
}

DSC_AVX2_INLINE __m128i load(const void* from) {
  return _mm_loadu_si128(static_cast<const __m128i*>(from));
}

DSC_AVX2_INLINE Sums load(const BrickSums& s) {
  return {load(s.first.data()), load(s.square.data()), load(s.cross.data())};
}

/// Counts bricks. A register holds four slices z, one a lane of 64 bits, byte y of a lane the row
/// y. Nibble tables give per byte c = sum b, t = sum x b, q = sum x^2 b (Mula, Kurz and Lemire,
/// 2016, for the count; ball_kernel.cpp has the larger form).
class Counter {
 public:
  DSC_AVX2_INLINE Counter()
      : xx_(_mm256_setzero_si256()), yy_(xx_), zz_(xx_), xy_(xx_), yz_(xx_), zx_(xx_) {}

  /// 1, x, y, z over bits & mask; second moments stay inside.
  DSC_AVX2_INLINE __m128i add(const BrickBits& bits, const BrickBits& mask) {
    const __m256i zero = _mm256_setzero_si256();
    const __m256i one16 = _mm256_set1_epi16(1);
    const auto [count, place_low, place_high, byte1, byte2] = nibble_tables();
    const __m256i square_low = table(0, 0, 1, 1, 4, 4, 5, 5, 9, 9, 10, 10, 13, 13, 14, 14);
    const __m256i square_high =
        table(0, 16, 25, 41, 36, 52, 61, 77, 49, 65, 74, 90, 85, 101, 110, 126);
    const __m256i lane = _mm256_setr_epi32(0, 0, 1, 1, 2, 2, 3, 3);

    const auto* from = reinterpret_cast<const __m256i*>(bits.data());
    const auto* by = reinterpret_cast<const __m256i*>(mask.data());
    __m256i c[2], t[2], q[2];
#pragma GCC unroll 2
    for (int half = 0; half < 2; ++half) {
      const __m256i v =
          _mm256_and_si256(_mm256_loadu_si256(from + half), _mm256_loadu_si256(by + half));
      const Nibbles nibbles = nibbles_of(v);
      c[half] = looked_up(count, count, nibbles);
      t[half] = looked_up(place_low, place_high, nibbles);
      // At most 14 + 126: unsigned.
      q[half] = _mm256_sad_epu8(looked_up(square_low, square_high, nibbles), zero);
    }
    const __m256i c_both = _mm256_add_epi8(c[0], c[1]);
    const __m256i t_both = _mm256_add_epi8(t[0], t[1]);
    // Slices are at z = lane + 4 half, so that sum z v = lane (v0 + v1) + 4 v1, by lanes of 32
    // bits.
    const __m256i n1 = _mm256_sad_epu8(c[1], zero);
    const __m256i n = _mm256_sad_epu8(c_both, zero);
    const __m256i x1 = _mm256_sad_epu8(t[1], zero);
    const __m256i x = _mm256_sad_epu8(t_both, zero);
    const __m256i y1 = _mm256_madd_epi16(_mm256_maddubs_epi16(c[1], byte1), one16);
    const __m256i y = _mm256_madd_epi16(_mm256_maddubs_epi16(c_both, byte1), one16);
    // The factors are small: 16 bits of each lane suffice.
    const __m256i z1 = _mm256_add_epi32(_mm256_madd_epi16(n1, lane), _mm256_slli_epi32(n1, 2));
    const __m256i z = _mm256_add_epi32(_mm256_madd_epi16(n, lane), _mm256_slli_epi32(n1, 2));
    xx_ = _mm256_add_epi32(xx_, _mm256_add_epi32(q[0], q[1]));
    yy_ = _mm256_add_epi32(yy_, _mm256_madd_epi16(_mm256_maddubs_epi16(c_both, byte2), one16));
    zz_ = _mm256_add_epi32(zz_,
                           _mm256_add_epi32(_mm256_madd_epi16(z, lane), _mm256_slli_epi32(z1, 2)));
    xy_ = _mm256_add_epi32(xy_, _mm256_madd_epi16(_mm256_maddubs_epi16(t_both, byte1), one16));
    yz_ = _mm256_add_epi32(yz_,
                           _mm256_add_epi32(_mm256_madd_epi16(y, lane), _mm256_slli_epi32(y1, 2)));
    zx_ = _mm256_add_epi32(zx_,
                           _mm256_add_epi32(_mm256_madd_epi16(x, lane), _mm256_slli_epi32(x1, 2)));
    return sums_of(n, x, y, z);
  }

  /// Second moments of the bricks so far, each from its own lowest voxel.
  DSC_AVX2_INLINE __m128i square() const { return sums_of(_mm256_setzero_si256(), xx_, yy_, zz_); }
  DSC_AVX2_INLINE __m128i cross() const { return sums_of(_mm256_setzero_si256(), xy_, yz_, zx_); }

 private:
  // 32-bit lanes: at most 6 272 a lane and brick.
  __m256i xx_, yy_, zz_, xy_, yz_, zx_;
};

}  // namespace

bool has_brick_kernel() { return __builtin_cpu_supports("avx2") != 0; }

DSC_AVX2 BrickSums masked_brick_sums(const BrickBits& bits, const BrickBits& mask) {
  Counter counter;
  BrickSums sums;
  _mm_store_si128(reinterpret_cast<__m128i*>(sums.first.data()), counter.add(bits, mask));
  _mm_store_si128(reinterpret_cast<__m128i*>(sums.square.data()), counter.square());
  _mm_store_si128(reinterpret_cast<__m128i*>(sums.cross.data()), counter.cross());
  return sums;
}

DSC_AVX2 BallSums brick_ball_sums(const BrickRow* rows, std::size_t row_count, std::int32_t x,
                                  const CutBricks& cut, const BrickView& view) {
  const __m256i zero = _mm256_setzero_si256();
  WideSums total{zero, zero, zero};

  const __m128i across = _mm_setr_epi32(0, x, 0, 0);
  for (std::size_t r = 0; r < row_count; ++r) {
    const Sums begin = load(view.before[rows[r].first]);
    const Sums end = load(view.before[rows[r].last]);
    add(total,
        moved({_mm_sub_epi32(end.first, begin.first), _mm_sub_epi32(end.square, begin.square),
               _mm_sub_epi32(end.cross, begin.cross)},
              _mm_or_si128(load(rows[r].by.data()), across)));
  }

  // Lists without branches: which bricks are full and which mixed cannot be foretold.
  std::size_t full = 0, mixed = 0;
  for (std::size_t b = 0; b < cut.count; ++b) {
    const std::int32_t state = view.states[cut.places[b]];
    cut.full_list[full] = static_cast<std::int32_t>(b);
    cut.mixed_list[mixed] = static_cast<std::int32_t>(b);
    full += state == BrickVolume::kFull ? 1 : 0;
    mixed += state >= BrickVolume::kFirstMixed ? 1 : 0;
  }
  for (std::size_t i = 0; i < full; ++i) add(total, load(cut.full[cut.full_list[i]]));

  Counter counter;
  const __m128i none = _mm_setzero_si128();
  for (std::size_t i = 0; i < mixed; ++i) {
    const std::int32_t b = cut.mixed_list[i];
    const BrickBits& bits = view.mixed[view.states[cut.places[b]] - BrickVolume::kFirstMixed];
    const __m128i first = counter.add(bits, cut.masks[b]);
    add(total, moved({first, none, none}, load(cut.by[b].data())));
  }
  add(total, {none, counter.square(), counter.cross()});

  BallSums sums;
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(sums.first.data()), total.first);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(sums.square.data()), total.square);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(sums.cross.data()), total.cross);
  return sums;
}

}  // namespace dsc::detail

#else  // another machine or compiler: bricks are not used

namespace dsc::detail {

bool has_brick_kernel() { return false; }

BrickSums masked_brick_sums(const BrickBits&, const BrickBits&) { return {}; }

BallSums brick_ball_sums(const BrickRow*, std::size_t, std::int32_t, const CutBricks&,
                         const BrickView&) {
  return {};
}

}  // namespace dsc::detail

#endif
