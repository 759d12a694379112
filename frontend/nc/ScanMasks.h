// Where the words of a line begin, from 64 bytes at once. Private to the scanner.
#pragma once

#include <bit>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace dotek::frontend::nc {

struct LineMasks {
  std::uint64_t letters = 0;  // bit i: byte i is a letter
  std::uint64_t lineEnds = 0; // bit i: byte i is a LF
};

#if defined(__SSE2__)
inline constexpr bool kHasLineMasks = std::endian::native == std::endian::little;

// 64 bytes can be read from `p`.
inline LineMasks lineMasks(const char* p) {
  LineMasks out;
  for (unsigned i = 0; i < 64; i += 16) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p + i));
    const __m128i fromA =
        _mm_sub_epi8(_mm_or_si128(bytes, _mm_set1_epi8(0x20)), _mm_set1_epi8('a')); // a to z: 0 to 25
    const __m128i letter = _mm_cmpeq_epi8(_mm_min_epu8(fromA, _mm_set1_epi8(25)), fromA);
    const __m128i end = _mm_cmpeq_epi8(bytes, _mm_set1_epi8('\n'));
    out.letters |= static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm_movemask_epi8(letter))) << i;
    out.lineEnds |= static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm_movemask_epi8(end))) << i;
  }
  return out;
}
#else
inline constexpr bool kHasLineMasks = false;
inline LineMasks lineMasks(const char*) {
  return {};
}
#endif

} // namespace dotek::frontend::nc
