#include "frontend/nc/ScanWide.h"

#include "frontend/nc/ScanCodes.h"
#include "frontend/nc/ScanNumber.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define DOTEK_WIDE __attribute__((target("avx2,bmi,popcnt")))
#endif

namespace dotek::frontend::nc {

using ir::NcWords;

#if defined(DOTEK_WIDE)

bool canReadWide() {
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("bmi") != 0 &&
         __builtin_cpu_supports("popcnt") != 0;
}

namespace {

// Numbers of a line: lane i of a step stands for word i. The arrays have room for a last step that is not
// full.
struct Lanes {
  static constexpr std::size_t kMost = 32;
  alignas(32) std::array<std::uint64_t, kMost + 4> start, digits, places, points;
  alignas(32) std::array<double, kMost + 4> value;

  // No initialisation: a line writes what it reads.
  Lanes() {}
};

DOTEK_WIDE inline void store(std::uint64_t* p, __m256i v) {
  _mm256_store_si256(reinterpret_cast<__m256i*>(p), v);
}

// Eight bytes after the address at `p`.
inline long long word(const char* p) {
  long long out = 0;
  std::memcpy(&out, p + 1, 8);
  return out;
}

// Four numbers from word `i` on; not 0 in the result: one of them is none that fits eight bytes. `most`
// is how many places each has. The steps are those of readShortNumber.
DOTEK_WIDE inline __m256i readNumbers(__m256i bytes, __m256i length, Lanes& lanes, std::size_t i,
                                      __m256i& most) {
  const __m256i one = _mm256_set1_epi64x(1), ones = _mm256_set1_epi8(1);
  const __m256i sign =
      _mm256_cmpeq_epi64(_mm256_and_si256(bytes, _mm256_set1_epi64x(0xFF)), _mm256_set1_epi64x('-'));
  const __m256i minus = _mm256_and_si256(sign, one);
  bytes = _mm256_srlv_epi64(bytes, _mm256_slli_epi64(minus, 3));
  const __m256i count = _mm256_sub_epi64(length, minus);
  const __m256i d = _mm256_sllv_epi64(_mm256_xor_si256(bytes, _mm256_set1_epi8('0')),
                                      _mm256_sub_epi64(_mm256_set1_epi64x(64), _mm256_slli_epi64(count, 3)));
  const __m256i isDigit = _mm256_cmpeq_epi8(_mm256_min_epu8(d, _mm256_set1_epi8(9)), d);
  const __m256i isPoint = _mm256_cmpeq_epi8(d, _mm256_set1_epi8('.' ^ '0'));
  const __m256i points = _mm256_sad_epu8(_mm256_and_si256(isPoint, ones), _mm256_setzero_si256());
  // Every byte is a digit or a point; one point at most; one to eight bytes, one digit at least.
  __m256i odd = _mm256_xor_si256(_mm256_xor_si256(isDigit, isPoint), _mm256_set1_epi8(-1));
  odd = _mm256_or_si256(odd, _mm256_srli_epi64(points, 1));
  const __m256i less = _mm256_sub_epi64(count, one);
  odd = _mm256_or_si256(
      odd, _mm256_andnot_si256(_mm256_set1_epi64x(7), _mm256_or_si256(less, _mm256_sub_epi64(less, points))));
  // The bits below the point (without one all), and those above it (without one none).
  const __m256i at = _mm256_and_si256(isPoint, _mm256_sub_epi64(_mm256_setzero_si256(), isPoint));
  const __m256i front = _mm256_sub_epi64(at, one);
  const __m256i back = _mm256_sub_epi64(_mm256_setzero_si256(), _mm256_slli_epi64(at, 8));
  const __m256i places = _mm256_sad_epu8(_mm256_and_si256(back, ones), _mm256_setzero_si256());
  __m256i digits = _mm256_or_si256(
      _mm256_sllv_epi64(_mm256_and_si256(d, front), _mm256_slli_epi64(points, 3)), _mm256_and_si256(d, back));
  digits = _mm256_maddubs_epi16(digits, _mm256_set1_epi16(0x010A));   // pairs: 10 a + b
  digits = _mm256_madd_epi16(digits, _mm256_set1_epi32(0x0001'0064)); // fours: 100 a + b
  digits =
      _mm256_add_epi64(_mm256_mul_epu32(digits, _mm256_set1_epi64x(10000)), _mm256_srli_epi64(digits, 32));
  // As a double: the digits fill the low bits of 2^52.
  const __m256d whole =
      _mm256_sub_pd(_mm256_castsi256_pd(_mm256_or_si256(digits, _mm256_set1_epi64x(0x4330'0000'0000'0000))),
                    _mm256_set1_pd(0x1p52));
  // Powers of ten up to 10^7, which a float holds exactly, picked within a register: a gather costs more.
  const __m256 powers = _mm256_setr_ps(1e0F, 1e1F, 1e2F, 1e3F, 1e4F, 1e5F, 1e6F, 1e7F);
  const __m256i packed = _mm256_permutevar8x32_epi32(places, _mm256_setr_epi32(0, 2, 4, 6, 0, 2, 4, 6));
  const __m256d power = _mm256_cvtps_pd(_mm256_castps256_ps128(_mm256_permutevar8x32_ps(powers, packed)));
  const __m256d value =
      _mm256_or_pd(_mm256_div_pd(whole, power), _mm256_castsi256_pd(_mm256_slli_epi64(minus, 63)));
  _mm256_store_pd(&lanes.value[i], value);
  store(&lanes.digits[i], digits);
  store(&lanes.places[i], places);
  store(&lanes.points[i], points);
  most = places;
  return odd;
}

} // namespace

DOTEK_WIDE unsigned readLineWide(const char* p, NcWords& words) {
  std::uint64_t letters = 0, blanks = 0, ends = 0;
  for (unsigned i = 0; i < 64; i += 32) {
    const __m256i bytes = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p + i));
    const __m256i fromA =
        _mm256_sub_epi8(_mm256_or_si256(bytes, _mm256_set1_epi8(0x20)), _mm256_set1_epi8('a'));
    const __m256i letter = _mm256_cmpeq_epi8(_mm256_min_epu8(fromA, _mm256_set1_epi8(25)), fromA);
    const __m256i blank = _mm256_cmpeq_epi8(bytes, _mm256_set1_epi8(' '));
    const __m256i end = _mm256_cmpeq_epi8(bytes, _mm256_set1_epi8('\n'));
    letters |= static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm256_movemask_epi8(letter))) << i;
    blanks |= static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm256_movemask_epi8(blank))) << i;
    ends |= static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm256_movemask_epi8(end))) << i;
  }
  const unsigned behind = static_cast<unsigned>(std::countr_zero(ends));
  if (ends == 0 || behind == 0 || (letters & 1) == 0) return 0;
  const unsigned stop = behind - (p[behind - 1] == '\r' ? 1 : 0);
  const std::uint64_t stopBit = std::uint64_t{1} << stop;
  letters &= stopBit - 1;
  // A number ends before a blank, a letter, or the line's end. What does not pair with an address makes a
  // number odd.
  const std::uint64_t breaks = letters | (blanks & (stopBit - 1)) | stopBit;
  std::uint64_t lasts = ~breaks & (breaks >> 1) & (stopBit - 1);
  const auto count = static_cast<std::size_t>(std::popcount(letters));
  if (count > Lanes::kMost || std::popcount(lasts) != static_cast<int>(count)) return 0;
  Lanes lanes;
  __m256i odd = _mm256_setzero_si256(), most = _mm256_setzero_si256();
  std::uint64_t rest = letters;
  for (std::size_t i = 0; i < count; i += 4) {
    // Built in registers: four small stores and one wide load would wait for each other. Lanes without a word
    // read after the line and do not count.
    std::uint64_t start[4], length[4];
    for (unsigned k = 0; k < 4; ++k) {
      start[k] = static_cast<std::uint64_t>(std::countr_zero(rest));
      length[k] = static_cast<std::uint64_t>(std::countr_zero(lasts)) - start[k];
      lanes.start[i + k] = start[k];
      rest &= rest - 1;
      lasts &= lasts - 1;
    }
    const __m256i bytes =
        _mm256_set_epi64x(word(p + start[3]), word(p + start[2]), word(p + start[1]), word(p + start[0]));
    const __m256i lengths =
        _mm256_set_epi64x(static_cast<long long>(length[3]), static_cast<long long>(length[2]),
                          static_cast<long long>(length[1]), static_cast<long long>(length[0]));
    const __m256i used = _mm256_cmpgt_epi64(_mm256_set1_epi64x(static_cast<long long>(count - i)),
                                            _mm256_setr_epi64x(0, 1, 2, 3));
    __m256i places = _mm256_setzero_si256();
    odd = _mm256_or_si256(odd, _mm256_and_si256(used, readNumbers(bytes, lengths, lanes, i, places)));
    most = _mm256_max_epi32(most, _mm256_and_si256(used, places));
  }
  if (_mm256_testz_si256(odd, odd) == 0) return 0;

  std::uint32_t present = 0, pointed = 0, repeated = 0, gCount = 0, mCount = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned kind = (static_cast<unsigned char>(p[lanes.start[i]]) & 0x1Fu) - 1;
    const std::uint32_t bit = std::uint32_t{1} << kind;
    repeated |= present & bit;
    present |= bit;
    pointed |= static_cast<std::uint32_t>(lanes.points[i]) << kind;
    words.value[kind] = lanes.value[i];
    if ((kCodeBits & bit) == 0) continue;
    const bool minus = std::signbit(lanes.value[i]);
    if (kind == kG)
      words.g[gCount++ % NcWords::kMostCodes] = gCode(lanes.digits[i], lanes.places[i], minus);
    else
      words.m[mCount++ % NcWords::kMostCodes] = mCode(lanes.digits[i], lanes.points[i] != 0, minus);
  }
  if ((present & ir::addressBit('O')) != 0 || std::max(gCount, mCount) > NcWords::kMostCodes) [[unlikely]]
    return 0;
  alignas(32) std::array<std::uint64_t, 4> places;
  store(places.data(), most);
  words.present = present;
  words.pointed = pointed;
  words.repeated = repeated & ~kCodeBits;
  words.mostPlaces =
      static_cast<std::uint32_t>(std::max(std::max(places[0], places[1]), std::max(places[2], places[3])));
  words.gCount = gCount;
  words.mCount = mCount;
  words.marks = NcWords::None;
  return behind + 1;
}

#else

bool canReadWide() {
  return false;
}
unsigned readLineWide(const char*, NcWords&) {
  return 0;
}

#endif

} // namespace dotek::frontend::nc
