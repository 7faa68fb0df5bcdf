#include "libdsc/normals/ball_kernel.h"

#include "libdsc/normals/nibble_tables.h"

#if defined(__x86_64__) && defined(__GNUC__)

namespace dsc::detail {
namespace {

DSC_AVX2 inline std::int64_t sum64(__m256i v) {
  const __m128i halves = _mm_add_epi64(_mm256_castsi256_si128(v), _mm256_extracti128_si256(v, 1));
  return _mm_extract_epi64(halves, 0) + _mm_extract_epi64(halves, 1);
}

/// The sum of eight signed 32-bit lanes.
DSC_AVX2 inline std::int64_t sum32(__m256i v) {
  return sum64(_mm256_add_epi64(_mm256_cvtepi32_epi64(_mm256_castsi256_si128(v)),
                                _mm256_cvtepi32_epi64(_mm256_extracti128_si256(v, 1))));
}

template <bool kTwoWords>
DSC_AVX2 KernelSums run(const BallStrip* const* strips, const BallWords* words, int slices,
                        int shift) {
  const __m256i zero = _mm256_setzero_si256();
  const __m256i one8 = _mm256_set1_epi8(1);
  const __m256i one16 = _mm256_set1_epi16(1);
  const auto [count, place_low, place_high, byte1, byte2] = nibble_tables();
  const __m256i square_low = table(0, 6, 3, 9, 1, 7, 4, 10, 0, 6, 3, 9, 1, 7, 4, 10);
  const __m256i square_high = table(0, 0, 1, 1, 3, 3, 4, 4, 6, 6, 7, 7, 9, 9, 10, 10);
  const __m256i byte8 = _mm256_slli_epi16(byte1, 3);  // no carry between bytes: 8 * 7 < 256
  const __m256i lanes64 = _mm256_setr_epi64x(0, 2, 4, 6);
  const __m256i lanes32 = _mm256_setr_epi32(0, 0, 2, 2, 4, 4, 6, 6);
  const __m128i right = _mm_cvtsi32_si128(shift);
  const __m128i left = _mm_cvtsi32_si128(64 - shift);  // a shift by 64 gives 0

  // Lanes of 64 bits, one a row, but p, pk, py, pp: two of 32 bits a row.
  __m256i n = zero, nk1 = zero, nk2 = zero, y = zero, yk = zero, yy = zero;
  __m256i p = zero, pk = zero, py = zero, pp = zero, t_sum = zero, q_sum = zero;

  for (int slice = slices - 1; slice >= 0; --slice) {
    for (const BallStrip* strip = strips[slice]; strip != strips[slice + 1]; ++strip) {
      const std::uint64_t* low = words[slice].low + strip->first_row;
      const std::uint64_t* high = kTwoWords ? words[slice].high + strip->first_row : nullptr;
      __m256i c = zero, t = zero, q = zero;  // running sums, bytes
      __m256i c1 = zero, c2 = zero;          // running sums of c by row, and of those
      __m256i p1 = zero;                     // running sum of sum P b, 16 bits
      for (int g = 4 * (strip->groups - 1); g >= 0; g -= 4) {
        __m256i bits =
            _mm256_srl_epi64(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(low + g)), right);
        if constexpr (kTwoWords) {
          bits = _mm256_or_si256(
              bits, _mm256_sll_epi64(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(high + g)),
                                     left));
        }
        bits = _mm256_and_si256(
            bits, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(strip->masks + g)));
        const Nibbles nibbles = nibbles_of(bits);
        c = _mm256_add_epi8(c, looked_up(count, count, nibbles));
        t = _mm256_add_epi8(t, looked_up(place_low, place_high, nibbles));
        q = _mm256_add_epi8(q, looked_up(square_low, square_high, nibbles));
        c1 = _mm256_add_epi64(c1, _mm256_sad_epu8(c, zero));
        c2 = _mm256_add_epi64(c2, c1);
        p1 = _mm256_add_epi16(
            p1, _mm256_add_epi16(_mm256_maddubs_epi16(c, byte8), _mm256_maddubs_epi16(t, one8)));
      }
      // Row 4g + lane of the strip has dy = offset + 8 (g + 1), offset = first_dy - 8 + 2 lane.
      const __m256i offset = _mm256_add_epi64(_mm256_set1_epi64x(strip->first_dy - 8), lanes64);
      const __m256i rows = _mm256_sad_epu8(c, zero);
      const __m256i moved = _mm256_mul_epi32(offset, rows);
      n = _mm256_add_epi64(n, rows);
      y = _mm256_add_epi64(y, _mm256_add_epi64(moved, _mm256_slli_epi64(c1, 3)));
      const __m256i cross = _mm256_add_epi64(moved, _mm256_slli_epi64(c1, 4));
      yy = _mm256_add_epi64(yy, _mm256_mul_epi32(offset, cross));
      yy = _mm256_add_epi64(yy,
                            _mm256_slli_epi64(_mm256_sub_epi64(_mm256_slli_epi64(c2, 1), c1), 6));

      const __m256i offset32 = _mm256_add_epi32(_mm256_set1_epi32(strip->first_dy - 8), lanes32);
      const __m256i places = _mm256_madd_epi16(
          _mm256_add_epi16(_mm256_maddubs_epi16(c, byte8), _mm256_maddubs_epi16(t, one8)), one16);
      p = _mm256_add_epi32(p, places);
      py = _mm256_add_epi32(py,
                            _mm256_add_epi32(_mm256_mullo_epi32(offset32, places),
                                             _mm256_slli_epi32(_mm256_madd_epi16(p1, one16), 3)));
      // 64 B^2 c + 16 B t, without the factor 16
      pp = _mm256_add_epi32(
          pp, _mm256_madd_epi16(_mm256_maddubs_epi16(c, byte2), _mm256_set1_epi16(4)));
      pp = _mm256_add_epi32(pp, _mm256_madd_epi16(_mm256_maddubs_epi16(t, byte1), one16));
      t_sum = _mm256_add_epi64(t_sum, _mm256_sad_epu8(t, zero));
      q_sum = _mm256_add_epi64(q_sum, _mm256_sad_epu8(q, zero));
    }
    nk1 = _mm256_add_epi64(nk1, n);
    nk2 = _mm256_add_epi64(nk2, nk1);
    yk = _mm256_add_epi64(yk, y);
    pk = _mm256_add_epi32(pk, p);
  }

  KernelSums sums;
  sums.n = sum64(n);
  sums.k1 = sum64(nk1);
  sums.k2 = sum64(nk2);
  sums.y = sum64(y);
  sums.yy = sum64(yy);
  sums.yk = sum64(yk);
  sums.p = sum32(p);
  sums.pk = sum32(pk);
  sums.py = sum32(py);
  sums.pp = 16 * sum32(pp) + 7 * sum64(t_sum) + 2 * sum64(q_sum) - 12 * sums.n;
  return sums;
}

}  // namespace

bool has_ball_kernel() { return __builtin_cpu_supports("avx2") != 0; }

KernelSums ball_kernel(const BallStrip* const* strips, const BallWords* words, int slices,
                       int shift) {
  if (slices == 0) return {};
  return words[0].high != nullptr ? run<true>(strips, words, slices, shift)
                                  : run<false>(strips, words, slices, shift);
}

}  // namespace dsc::detail

#else  // another machine or compiler: the plain scan

namespace dsc::detail {

bool has_ball_kernel() { return false; }

KernelSums ball_kernel(const BallStrip* const*, const BallWords*, int, int) { return {}; }

}  // namespace dsc::detail

#endif
