// Whether a text holds macro statements or calls: one pass at the speed of memory.
#include "frontend/nc/Scan.h"
#include "frontend/nc/ScanNumber.h"
#include "support/Ascii.h"

#include <bit>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace dotek::frontend::nc {
namespace {

#if defined(__SSE2__)
constexpr std::size_t kStep = 16;

// Bytes of a step that may begin something: a bit each. One byte after the step is read.
unsigned candidates(const char* p) {
  const auto load = [](const char* at) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(at)); };
  const auto is = [](__m128i v, char c) { return _mm_cmpeq_epi8(v, _mm_set1_epi8(c)); };
  const auto upTo = [](__m128i v, char c) { return _mm_cmpeq_epi8(_mm_min_epu8(v, _mm_set1_epi8(c)), v); };
  const auto either = [](__m128i a, __m128i b) { return _mm_or_si128(a, b); };
  const __m128i here = load(p), next = load(p + 1);
  const __m128i low = either(here, _mm_set1_epi8(0x20));
  const __m128i letter = upTo(_mm_sub_epi8(low, _mm_set1_epi8('a')), 25);
  const __m128i number = upTo(_mm_sub_epi8(next, _mm_set1_epi8('+')), '9' - '+'); // signs, point, digits
  const __m128i marks = either(either(is(here, '#'), is(here, '[')), either(is(here, '('), is(here, '<')));
  const __m128i words = _mm_andnot_si128(number, letter);
  const __m128i calls = _mm_and_si128(either(is(low, 'g'), is(low, 'm')),
                                      either(is(next, '0'), either(is(next, '6'), is(next, '9'))));
  return static_cast<unsigned>(_mm_movemask_epi8(either(marks, either(words, calls))));
}
#else
constexpr std::size_t kStep = 8;

unsigned candidates(const char*) {
  return (1u << kStep) - 1;
}
#endif

enum class Finding : std::uint8_t { Nothing, Macro, Comment, Name };

Finding look(const char* p) {
  if (*p == '#' || *p == '[') return Finding::Macro;
  if (*p == '(') return Finding::Comment;
  if (*p == '<') return Finding::Name;
  if (!isLetter(*p)) return Finding::Nothing;
  const char letter = static_cast<char>(*p & 0x5F);
  ++p;
  while (*p == ' ' || *p == '\t')
    ++p;
  if (isLetter(*p)) return beginsMacroWord(letter, *p) ? Finding::Macro : Finding::Nothing;
  if (letter != 'G' && letter != 'M') return Finding::Nothing;
  while (*p == '0' || *p == '+')
    ++p;
  unsigned code = 0;
  for (int i = 0; i < 3 && *p >= '0' && *p <= '9'; ++i)
    code = code * 10 + static_cast<unsigned>(*p++ - '0');
  const bool call = letter == 'G' ? code == 65 || code == 66 : code == 98 || code == 99;
  return call ? Finding::Macro : Finding::Nothing;
}

} // namespace

bool mayHoldMacros(LineChunks& chunks) {
  for (;;) {
    const LineChunks::State state = chunks.next();
    if (state != LineChunks::State::Chunk) return false;
    const char* p = chunks.begin();
    const char* const end = chunks.end();
    while (p < end) {
      unsigned mask = candidates(p);
      const char* next = p + kStep;
      while (mask != 0) {
        const char* const at = p + std::countr_zero(mask);
        mask &= mask - 1;
        if (at >= end) break;
        const Finding finding = look(at);
        if (finding == Finding::Nothing) continue;
        if (finding == Finding::Macro) return true;
        // A comment or a name ends on its line, or it is a defect that the reader reports.
        const char close = finding == Finding::Comment ? ')' : '>';
        const char* stop = at;
        while (stop < end && *stop != close && *stop != '\n' && *stop != '\r')
          ++stop;
        next = stop < end ? stop + 1 : end;
        break;
      }
      p = next;
    }
  }
}

} // namespace dotek::frontend::nc
