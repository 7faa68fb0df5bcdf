/// \file
/// \internal
/// Sums over the bits b_j of each byte, by tables of 16 entries for its lower and its higher nibble
/// that byte shuffles look up (after the counts of Mula, Kurz and Lemire, 2016): count = sum b_j,
/// place = sum j b_j. Called by functions with DSC_AVX2 alone, which run where the machine has it.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#define DSC_AVX2 __attribute__((target("avx2")))
#define DSC_AVX2_INLINE __attribute__((target("avx2"), always_inline)) inline

namespace dsc::detail {

/// The same 16 bytes in both halves: a byte shuffle looks up within each half.
DSC_AVX2_INLINE __m256i table(char a, char b, char c, char d, char e, char f, char g, char h,
                              char i, char j, char k, char l, char m, char n, char o, char p) {
  return _mm256_broadcastsi128_si256(_mm_setr_epi8(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p));
}

/// The tables that both kernels use, and the weights j and j^2 of the bytes of a lane of 64 bits.
struct NibbleTables {
  __m256i count, place_low, place_high, byte1, byte2;
};

DSC_AVX2_INLINE NibbleTables nibble_tables() {
  return {table(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4),
          table(0, 0, 1, 1, 2, 2, 3, 3, 3, 3, 4, 4, 5, 5, 6, 6),
          table(0, 4, 5, 9, 6, 10, 11, 15, 7, 11, 12, 16, 13, 17, 18, 22),
          table(0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7),
          table(0, 1, 4, 9, 16, 25, 36, 49, 0, 1, 4, 9, 16, 25, 36, 49)};
}

/// The nibbles of each byte.
struct Nibbles {
  __m256i low, high;
};

DSC_AVX2_INLINE Nibbles nibbles_of(__m256i bits) {
  const __m256i nibble = _mm256_set1_epi8(0x0f);
  return {_mm256_and_si256(bits, nibble), _mm256_and_si256(_mm256_srli_epi16(bits, 4), nibble)};
}

/// What the tables have for both nibbles of each byte, summed.
DSC_AVX2_INLINE __m256i looked_up(__m256i low, __m256i high, const Nibbles& nibbles) {
  return _mm256_add_epi8(_mm256_shuffle_epi8(low, nibbles.low),
                         _mm256_shuffle_epi8(high, nibbles.high));
}

}  // namespace dsc::detail

#endif
