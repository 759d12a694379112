#include "frontend/nc/Scan.h"

#include "frontend/nc/ScanCodes.h"
#include "frontend/nc/ScanMasks.h"
#include "frontend/nc/ScanNumber.h"
#include "frontend/nc/ScanWide.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace dotek::frontend::nc {
namespace {

using ir::NcWords;

// What a byte begins: 0 to 25 is the address of a word.
enum : std::uint8_t { kLineEnd = 26, kBlank, kOpen, kMark, kSlash, kColon, kName, kBlockEnd, kMacro, kBad };

constexpr std::array<std::uint8_t, 256> makeClasses() {
  std::array<std::uint8_t, 256> out{};
  out.fill(kBad);
  for (unsigned i = 0; i < 26; ++i)
    out['A' + i] = out['a' + i] = static_cast<std::uint8_t>(i);
  out['\n'] = out['\r'] = kLineEnd;
  out[' '] = out['\t'] = kBlank;
  out['('] = kOpen;
  out['%'] = kMark;
  out['/'] = kSlash;
  out[':'] = kColon;
  out['<'] = kName;
  out[';'] = kBlockEnd;
  for (const char c : {'#', '[', ']', '=', '*'})
    out[static_cast<unsigned char>(c)] = kMacro;
  return out;
}
constexpr std::array<std::uint8_t, 256> kClass = makeClasses();

std::uint8_t classOf(char c) {
  return kClass[static_cast<unsigned char>(c)];
}
const char* skipBlanks(const char* p) {
  while (classOf(*p) == kBlank)
    ++p;
  return p;
}
// After the character, of which UTF-8 may need several bytes.
const char* behindCharacter(const char* p) {
  const bool leads = (*p & 0xC0) == 0xC0;
  for (++p; leads && (*p & 0xC0) == 0x80;)
    ++p;
  return p;
}
bool isLineEnd(char c) {
  return c == '\n' || c == '\r';
}

} // namespace

Scanner::Scanner(LineChunks& chunks, Way way)
    : chunks_(chunks), wide_(way == Way::Fastest && canReadWide()), quick_(way != Way::Careful) {}

bool Scanner::refill() {
  if (stopped_) return false;
  const bool first = at_ == nullptr;
  const LineChunks::State state = chunks_.next();
  at_ = lineStart_ = chunks_.begin();
  end_ = chunks_.end();
  if (state == LineChunks::State::Chunk) {
    if (first && end_ - at_ >= 3 && std::memcmp(at_, "\xEF\xBB\xBF", 3) == 0) at_ += 3;
    if (first && skipsLeader_) skipLeader();
    return true;
  }
  stopped_ = true;
  if (state == LineChunks::State::TooLong) {
    ++line_;
    fail(ScanFault::LineTooLong, at_, at_ + 1);
  } else if (state == LineChunks::State::Failed) {
    fail(ScanFault::Reading, at_, at_);
  }
  end_ = at_;
  return false;
}

// Text before the first `%` belongs to the tape's leader where no program begins in it and the mark does not
// end the text.
void Scanner::skipLeader() {
  std::uint64_t lines = 0, named = 0;
  std::string_view name;
  const char* p = at_;
  for (; p < end_; ++p) {
    const char* const begin = skipBlanks(p);
    const std::uint8_t kind = classOf(*begin);
    if (kind == kMark) break;
    if (kind == kO || kind == kColon || kind == kName) return;
    p = begin;
    while (!isLineEnd(*p))
      ++p;
    ++lines;
    if (named == 0 && p != begin) {
      named = lines;
      name = {begin, static_cast<std::size_t>(p - begin)};
    }
    if (*p == '\r' && p[1] == '\n') ++p;
  }
  if (named == 0 || p >= end_) return;
  const char* rest = skipBlanks(p) + 1;
  while (rest < end_ && (classOf(*rest) == kBlank || isLineEnd(*rest)))
    ++rest;
  if (rest >= end_) return;
  constexpr std::size_t kMost = 200;
  leader_ = name.substr(0, kMost);
  leaderLine_ = named;
  line_ = lines;
  at_ = p;
}

Scanner::Result Scanner::fail(ScanFault fault, const char* begin, const char* end) {
  error_ = {fault, line_, static_cast<std::uint32_t>(begin - lineStart_),
            static_cast<std::uint32_t>(end - lineStart_)};
  while (begin < end_ && !isLineEnd(*begin))
    ++begin;
  at_ = begin + 1;
  if (begin < end_ && *begin == '\r' && *at_ == '\n') ++at_;
  return Result::Error;
}

// Any line, byte by byte. Result::Block for an empty one too.
Scanner::Result Scanner::careful(NcWords& words) {
  const char* p = at_;
  lineStart_ = p;
  ++line_;
  std::uint32_t present = 0, pointed = 0, repeated = 0, mostPlaces = 0, gCount = 0, mCount = 0;
  std::uint32_t marks = NcWords::None;
  for (;;) {
    unsigned kind = classOf(*p);
    if (kind == kBlank) kind = classOf(*++p);
    if (kind >= 26) [[unlikely]] {
      if (kind == kLineEnd) break;
      switch (kind) {
      case kBlank: p = skipBlanks(p); continue;
      case kOpen: {
        const char* close = p;
        while (*close != ')' && !isLineEnd(*close))
          ++close;
        if (*close != ')' || close >= end_) return fail(ScanFault::OpenComment, p, close);
        p = close + 1;
        continue;
      }
      case kMark:
        if ((present | marks) != 0) return fail(ScanFault::LateMark, p, p + 1);
        marks = NcWords::ProgramMark;
        p = skipBlanks(p + 1);
        kind = classOf(*p);
        if (kind != kO && kind != kColon && kind != kName) continue;
        // `%O100`: the rest of the line is a block of its own.
        at_ = p;
        words.present = words.pointed = words.repeated = words.mostPlaces = words.gCount = words.mCount = 0;
        words.marks = NcWords::ProgramMark;
        words.line = line_--;
        return Result::Block;
      case kSlash: {
        const char* const slash = p;
        if ((present & ~ir::addressBit('N')) != 0 || marks != 0)
          return fail(ScanFault::LateDelete, slash, slash + 1);
        marks = NcWords::BlockDelete;
        ++p;
        words.deleteLevel = 1;
        if (*p >= '1' && *p <= '9') words.deleteLevel = static_cast<std::uint8_t>(*p++ - '0');
        continue;
      }
      case kName: {
        const char* close = p;
        while (*close != '>' && !isLineEnd(*close))
          ++close;
        if (*close != '>' || present != 0 || marks != 0) return fail(ScanFault::BadCharacter, p, p + 1);
        marks = NcWords::ProgramName;
        p = close + 1;
        continue;
      }
      case kBlockEnd: {
        const char* const rest = skipBlanks(p + 1);
        if (!isLineEnd(*rest)) return fail(ScanFault::BadCharacter, p, p + 1);
        p = rest;
        continue;
      }
      case kColon: kind = kO; break;
      case kMacro: return fail(ScanFault::MacroText, p, p + 1);
      default: return fail(ScanFault::BadCharacter, p, behindCharacter(p));
      }
    }
    const char* const address = p++;
    const ScannedNumber number = scanLongNumber(p);
    p = number.behind;
    if (p == nullptr) [[unlikely]] {
      const char* rest = skipBlanks(address + 1);
      if (number.fault == NumberFault::TooLong) {
        while (*rest == '-' || *rest == '+' || *rest == '.' || (*rest >= '0' && *rest <= '9'))
          ++rest;
        return fail(ScanFault::BadNumber, address, rest);
      }
      if (classOf(*rest) == kMacro ||
          (classOf(*rest) < 26 && beginsMacroWord(*address, *rest))) { // GOTO, X#1
        const char* stop = rest;
        while (classOf(*stop) < 26)
          ++stop;
        return fail(ScanFault::MacroText, address, std::max(stop, rest + 1));
      }
      return fail(ScanFault::NoNumber, address, address + 1);
    }
    if (marks == NcWords::ProgramMark) [[unlikely]]
      return fail(ScanFault::LateMark, address, p);
    const std::uint32_t bit = std::uint32_t{1} << kind;
    repeated |= present & bit;
    present |= bit;
    pointed |= number.point ? bit : 0;
    mostPlaces = std::max(mostPlaces, number.places);
    words.value[kind] = number.value;
    if ((kCodeBits & bit) == 0) continue;
    if (kind == kG)
      words.g[gCount++ % NcWords::kMostCodes] = gCode(number.digits, number.places, number.minus);
    else
      words.m[mCount++ % NcWords::kMostCodes] = mCode(number.digits, number.point, number.minus);
  }
  if (*p == '\r' && p[1] == '\n') ++p;
  at_ = p + 1;
  if (std::max(gCount, mCount) > NcWords::kMostCodes) [[unlikely]] {
    marks |= NcWords::TooManyCodes;
    gCount = std::min<std::uint32_t>(gCount, NcWords::kMostCodes);
    mCount = std::min<std::uint32_t>(mCount, NcWords::kMostCodes);
  }
  if ((present & ir::addressBit('O')) != 0) [[unlikely]]
    marks |= NcWords::ProgramName;
  words.present = present;
  words.pointed = pointed;
  words.repeated = repeated & ~kCodeBits;
  words.mostPlaces = mostPlaces;
  words.gCount = gCount;
  words.mCount = mCount;
  words.marks = static_cast<std::uint8_t>(marks);
  words.line = line_;
  return Result::Block;
}

// A line of words without comments, at most one blank between them: nearly all of what a CAM writes. The
// words are found first, so that their numbers do not wait for one another. false: the line is for `careful`,
// nothing is read.
bool Scanner::quick(NcWords& words) {
  const char* const p = at_;
  const LineMasks masks = lineMasks(p);
  if (masks.lineEnds == 0) return false;
  const unsigned behind = static_cast<unsigned>(std::countr_zero(masks.lineEnds));
  if (behind == 0 || (masks.letters & 1) == 0) return false;
  const unsigned stop = behind - (p[behind - 1] == '\r' ? 1 : 0);
  const std::uint64_t stopBit = std::uint64_t{1} << stop;
  std::uint64_t starts = (masks.letters & (stopBit - 1) & ~std::uint64_t{1}) | stopBit;
  std::uint64_t odd = 0, mostPlaces = 0;
  std::uint32_t present = 0, pointed = 0, repeated = 0, gCount = 0, mCount = 0;
  for (unsigned start = 0; start != stop;) {
    const unsigned next = static_cast<unsigned>(std::countr_zero(starts));
    starts &= starts - 1;
    const unsigned kind = (static_cast<unsigned char>(p[start]) & 0x1Fu) - 1;
    const unsigned blank = p[next - 1] == ' ' ? 1 : 0;
    const ShortNumber number = readShortNumber(p + start + 1, next - start - 1 - blank);
    start = next;
    odd |= number.odd;
    const std::uint32_t bit = std::uint32_t{1} << kind;
    repeated |= present & bit;
    present |= bit;
    pointed |= static_cast<std::uint32_t>(number.point) << kind;
    mostPlaces = std::max(mostPlaces, number.places);
    words.value[kind] = number.value;
    if ((kCodeBits & bit) == 0) continue;
    if (kind == kG)
      words.g[gCount++ % NcWords::kMostCodes] = gCode(number.digits, number.places, number.minus != 0);
    else
      words.m[mCount++ % NcWords::kMostCodes] = mCode(number.digits, number.point != 0, number.minus != 0);
  }
  if ((odd | (present & ir::addressBit('O'))) != 0 || gCount > NcWords::kMostCodes ||
      mCount > NcWords::kMostCodes) [[unlikely]]
    return false;
  at_ = p + behind + 1;
  lineStart_ = p;
  ++line_;
  words.present = present;
  words.pointed = pointed;
  words.repeated = repeated & ~kCodeBits;
  words.mostPlaces = static_cast<std::uint32_t>(mostPlaces);
  words.gCount = gCount;
  words.mCount = mCount;
  words.marks = NcWords::None;
  words.line = line_;
  return true;
}

Scanner::Result Scanner::next(NcWords& words) {
  for (;;) {
    if (at_ >= end_) {
      error_.fault = ScanFault::None;
      if (!refill()) return error_.fault == ScanFault::None ? Result::End : Result::Error;
      continue;
    }
    if (wide_) {
      if (const unsigned bytes = readLineWide(at_, words); bytes != 0) [[likely]] {
        lineStart_ = at_;
        at_ += bytes;
        words.line = ++line_;
        return Result::Block;
      }
    }
    if constexpr (kHasLineMasks) {
      if (quick_ && quick(words)) return Result::Block;
    }
    const Result result = careful(words);
    if (result == Result::Error || words.present != 0 || words.marks != 0) return result;
  }
}

std::string_view Scanner::lineText() const {
  const char* stop = lineStart_;
  while (stop < end_ && !isLineEnd(*stop))
    ++stop;
  // Of a line that is too long the beginning.
  if (lineStart_ == end_ && chunks_.end() > chunks_.begin() && error_.fault == ScanFault::LineTooLong)
    stop = std::min(chunks_.end(), lineStart_ + 80);
  return {lineStart_, static_cast<std::size_t>(stop - lineStart_)};
}

std::optional<WordPlace> findWord(std::string_view text, char letter, std::uint32_t which) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '(') {
      at = text.find(')', at);
      if (at == std::string_view::npos) break;
      continue;
    }
    const std::uint8_t kind = classOf(text[at]);
    const bool colon = text[at] == ':' && letter == 'O';
    if (kind >= 26 && !colon) continue;
    std::size_t end = at + 1;
    while (end < text.size() &&
           std::string_view("+-.0123456789 \t").find(text[end]) != std::string_view::npos)
      ++end;
    const std::size_t next = end;
    while (text[end - 1] == ' ' || text[end - 1] == '\t')
      --end;
    if ((colon || kind == letter - 'A') && which-- == 0)
      return WordPlace{static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(end)};
    at = next - 1;
  }
  return std::nullopt;
}

} // namespace dotek::frontend::nc
