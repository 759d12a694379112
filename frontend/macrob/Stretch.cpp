#include "frontend/macrob/Stretch.h"

#include "support/Ascii.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace dotek::frontend::macrob {
namespace {

constexpr std::string_view kLetters = "XYZABCFG"; // bits of Move::letters
constexpr std::uint32_t kF = 1U << 6, kG = 1U << 7;
constexpr std::size_t kAxes = 3; // X, Y, Z
constexpr std::size_t kZ = 2;
constexpr std::uint32_t kPlane = 3; // X, Y

bool isBlank(char c) {
  return c == ' ' || c == '\t';
}

// A line of nothing but a move.
struct Move {
  std::uint32_t letters = 0;
  int code = -1;                               // of G
  std::array<std::int64_t, kAxes> values = {}; // of X, Y, Z, in ten thousandths
  std::size_t words = 0, end = 0;              // where those after N begin, and end
  std::size_t next = 0;                        // after the end of the line

  bool has(std::size_t axis) const { return (letters >> axis & 1U) != 0; }
};

class Reader {
public:
  Reader(std::string_view text, std::size_t at) : text_(text), at_(at) {}

  // nothing: the line is no such move.
  std::optional<Move> move(bool numbers) {
    Move out;
    blanks();
    if (here() == 'N') {
      ++at_;
      std::int64_t ignored = 0;
      constexpr std::size_t kLongest = 9;
      if (!numbers || digits(kLongest, ignored) == 0) return std::nullopt;
      blanks();
    }
    out.words = out.end = at_;
    while (!atEnd()) {
      if (!word(out)) return std::nullopt;
      out.end = at_;
      blanks();
    }
    if (out.letters == 0 || (out.code == 0 && (out.letters & kF) != 0)) return std::nullopt;
    out.next = afterEnd();
    return out;
  }

  // After a line of blanks; where it began, if there is none.
  std::size_t afterBlankLine() {
    const std::size_t begin = at_;
    blanks();
    return at_ < text_.size() && atEnd() ? afterEnd() : begin;
  }

private:
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void blanks() {
    while (isBlank(here()))
      ++at_;
  }
  bool atEnd() const {
    return at_ >= text_.size() || text_[at_] == '\n' ||
           (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n');
  }
  std::size_t afterEnd() const {
    if (at_ >= text_.size()) return at_;
    return at_ + (text_[at_] == '\r' ? 2 : 1);
  }
  // How many there are; 0 where they are more than `most`.
  std::size_t digits(std::size_t most, std::int64_t& value) {
    const std::size_t begin = at_;
    for (; isDigit(here()); ++at_)
      value = value * 10 + (text_[at_] - '0');
    return at_ - begin <= most ? at_ - begin : 0;
  }

  bool word(Move& out) {
    const std::size_t letter = kLetters.find(here());
    if (letter == std::string_view::npos || (out.letters >> letter & 1U) != 0) return false;
    out.letters |= 1U << letter;
    ++at_;
    const std::uint32_t bit = 1U << letter;
    if (bit == kG) {
      std::int64_t code = 0;
      if (digits(2, code) == 0 || code > 1 || here() == '.') return false;
      out.code = static_cast<int>(code);
      return true;
    }
    const bool minus = here() == '-';
    if (minus) ++at_;
    return bit == kF ? !minus && feed() : coordinate(out, letter, minus);
  }
  bool feed() {
    constexpr std::size_t kMost = 5, kMostDecimals = 3;
    std::int64_t value = 0;
    if (digits(kMost, value) == 0) return false;
    if (here() == '.') {
      ++at_;
      if (isDigit(here()) && digits(kMostDecimals, value) == 0) return false;
    }
    return value > 0;
  }
  // With a point, and so short that no control objects to it.
  bool coordinate(Move& out, std::size_t letter, bool minus) {
    constexpr std::size_t kMost = 4;
    std::int64_t value = 0;
    const std::size_t before = isDigit(here()) ? digits(kMost, value) : 0;
    if (here() != '.') return false;
    ++at_;
    const std::size_t after = isDigit(here()) ? digits(kMost, value) : 0;
    if (before + after == 0 || isDigit(here())) return false;
    for (std::size_t i = after; i < kMost; ++i)
      value *= 10;
    if (letter < kAxes) out.values.at(letter) = minus ? -value : value;
    return true;
  }

  std::string_view text_;
  std::size_t at_;
};

// Which lines of a stretch are kept, told one after another.
class Choice {
public:
  explicit Choice(std::string_view text) : text_(text) {}

  void add(TextLine line, const Move& move) {
    const std::size_t index = count_++;
    lengths_ += static_cast<std::uint64_t>(lengthsOf(move));
    if (index < Stretch::kEdge) keep(line);
    last_.at(index % Stretch::kEdge) = line;
    // Up to here the moves may have been rapid ones.
    if (move.code >= 0 && motion_ < 0)
      fell_ = belowZero_ = atZero_ = negative_ = cutsLowered_ = cutsAfterZ_ = false;
    if (move.code >= 0) {
      motion_ = move.code;
      context_[kCode] = line;
    }
    const std::size_t kind = move.letters | (static_cast<std::uint32_t>(motion_ + 1) << kLetters.size());
    if (!seen_.at(kind)) {
      seen_.at(kind) = true;
      keep(line);
    }
    for (std::size_t i = 0; i < kLetters.size(); ++i)
      if ((move.letters >> i & 1U) != 0) lastWith_.at(i) = line;
    for (std::size_t axis = 0; axis < kAxes; ++axis)
      if (move.has(axis)) extremes(axis, move.values.at(axis), line);
    if (move.has(kZ)) {
      down(move.values[kZ], line);
    } else if (motion_ != 0 && (move.letters & kPlane) != 0) {
      if (lowered_ && !std::exchange(cutsLowered_, true)) keep(line);
      // The first Z may be below the one that the stretch begins at.
      if (z_ && !std::exchange(cutsAfterZ_, true)) keep(line);
    }
    // What is written twice is so in what is kept.
    const std::string_view words = text_.substr(move.words, move.end - move.words);
    if (index > 0 && words == words_) {
      keep(before_);
      keep(line);
    }
    words_ = words;
    before_ = line;
  }

  std::size_t count() const { return count_; }
  std::uint64_t lengths() const { return lengths_; }

  std::vector<TextLine> finish() {
    for (const std::optional<TextLine>& one : last_)
      keep(one);
    for (const std::optional<TextLine>& one : lastWith_)
      keep(one);
    for (const auto& list : {least_, most_})
      for (const Extreme& one : list) {
        keepAll(one.context);
        keep(one.line);
      }
    for (const std::optional<TextLine>& one : {rapid_, high_, low_})
      keep(one);
    const auto before = [](const TextLine& a, const TextLine& b) { return a.begin < b.begin; };
    std::sort(kept_.begin(), kept_.end(), before);
    const auto same = [](const TextLine& a, const TextLine& b) { return a.begin == b.begin; };
    kept_.erase(std::unique(kept_.begin(), kept_.end(), same), kept_.end());
    return apart();
  }

  static std::ptrdiff_t lengthsOf(const Move& move) {
    std::ptrdiff_t out = 0;
    for (std::size_t axis = 0; axis < kAxes; ++axis)
      out += move.has(axis) && move.values.at(axis) != 0 ? 1 : 0;
    return out;
  }

private:
  // What decides how a line that is kept is read: the code of motion before it, the Z, and the feed down that
  // follows the last rapid move along Z.
  enum : std::size_t { kCode, kZLine, kRapidZ, kFallsFrom, kFallsTo, kContext };
  using Context = std::array<std::optional<TextLine>, kContext>;
  struct Extreme {
    std::int64_t value = 0;
    std::optional<TextLine> line;
    Context context;
  };

  void keep(const std::optional<TextLine>& line) {
    if (line) kept_.push_back(*line);
  }
  void keepAll(const Context& context) {
    for (const std::optional<TextLine>& one : context)
      keep(one);
  }
  void keep(TextLine line) {
    keepAll(context_);
    kept_.push_back(line);
  }

  void extremes(std::size_t axis, std::int64_t value, TextLine line) {
    if (!least_.at(axis).line || value < least_.at(axis).value) least_.at(axis) = {value, line, context_};
    if (!most_.at(axis).line || value > most_.at(axis).value) most_.at(axis) = {value, line, context_};
  }

  // A rapid move along Z takes the tool up for whoever looks whether it is down.
  void down(std::int64_t z, TextLine line) {
    const bool feeds = motion_ != 0;
    const bool falls = feeds && z_ && z < *z_;
    if (falls && !std::exchange(fell_, true)) {
      keep(line);
      cutsLowered_ = false; // what fell before may have been a rapid move
    }
    if (falls && !lowered_) {
      context_[kFallsFrom] = context_[kZLine];
      context_[kFallsTo] = line;
    }
    lowered_ = lowered_ || falls;
    if (falls && z < 0 && !std::exchange(belowZero_, true)) keep(line);
    if (feeds && z <= 0 && !std::exchange(atZero_, true)) keep(line);
    if (feeds && z < 0 && !std::exchange(negative_, true)) keep(line);
    if (!feeds) {
      lowered_ = false;
      context_[kFallsFrom].reset();
      context_[kFallsTo].reset();
      context_[kRapidZ] = line;
      rapid_ = line;
      high_.reset();
      low_.reset();
    } else if (falls && !low_) {
      high_ = context_[kZLine];
      low_ = line;
    }
    z_ = z;
    context_[kZLine] = line;
  }

  // Its words, without a number.
  std::string_view wordsOf(const TextLine& line) const {
    const auto move = Reader(text_.substr(0, line.end), line.begin).move(true);
    return move ? text_.substr(move->words, move->end - move->words) : std::string_view();
  }
  // The one before that is not blank; there is one.
  TextLine lineBefore(const TextLine& line) const {
    TextLine out{line.begin, line.begin};
    do {
      out = {out.begin - 1, out.begin};
      while (out.begin > 0 && text_[out.begin - 1] != '\n')
        --out.begin;
    } while (out.begin > 0 && wordsOf(out).empty());
    return out;
  }

  // Two that are kept and do not follow one another must not look as if one was written twice.
  std::vector<TextLine> apart() const {
    std::vector<TextLine> out;
    for (std::size_t i = kept_.size(); i-- > 0;) {
      out.push_back(kept_[i]);
      while (i > 0 && wordsOf(out.back()) == wordsOf(kept_[i - 1])) {
        const TextLine before = lineBefore(out.back());
        if (before.begin <= kept_[i - 1].begin) break;
        out.push_back(before);
      }
    }
    std::reverse(out.begin(), out.end());
    return out;
  }

  std::string_view text_;
  std::size_t count_ = 0;
  std::uint64_t lengths_ = 0;
  int motion_ = -1;                                     // -1: that of before
  std::array<bool, (3U << kLetters.size())> seen_ = {}; // by letters and motion
  std::vector<TextLine> kept_;
  std::array<std::optional<TextLine>, Stretch::kEdge> last_;
  std::array<std::optional<TextLine>, kLetters.size()> lastWith_;
  std::array<Extreme, kAxes> least_, most_;
  std::optional<std::int64_t> z_;
  Context context_;
  std::optional<TextLine> rapid_, high_, low_;
  // Happened at feed: Z fell, fell below 0, is 0 or less, less than 0, a move in the plane after it fell.
  bool fell_ = false, belowZero_ = false, atZero_ = false, negative_ = false, cutsLowered_ = false,
       cutsAfterZ_ = false;
  bool lowered_ = false;   // a feed may have taken the tool down
  std::string_view words_; // of the line before
  TextLine before_;
};

} // namespace

Stretch::Stretch(std::string_view text, std::size_t at, bool numbers) : end_(at), looked_(at) {
  Choice choice(text);
  while (looked_ < text.size()) {
    if (const std::size_t next = Reader(text, looked_).afterBlankLine(); next > looked_) {
      looked_ = next;
      continue;
    }
    const std::optional<Move> move = Reader(text, looked_).move(numbers);
    if (!move) break;
    choice.add({looked_, move->next}, *move);
    looked_ = move->next;
  }
  if (choice.count() < kLeast) return;
  end_ = looked_;
  kept_ = choice.finish();
  leftOut_.blocks = choice.count() - kept_.size();
  leftOut_.lengths = choice.lengths();
  for (const TextLine& line : kept_)
    if (const auto move = Reader(text.substr(0, line.end), line.begin).move(true))
      leftOut_.lengths -= static_cast<std::uint64_t>(Choice::lengthsOf(*move));
}

namespace {

// The rest of a line, read sign by sign without its blanks.
class Rest {
public:
  Rest(std::string_view text, std::size_t at) : text_(text), at_(at) {}
  char next() {
    while (at_ < text_.size() && isBlank(text_[at_]))
      ++at_;
    return at_ < text_.size() ? upperCase(text_[at_++]) : '\0';
  }
  // Of a code.
  unsigned number() {
    constexpr unsigned kMost = 1000;
    unsigned out = 0;
    while (at_ < text_.size() && isBlank(text_[at_]))
      ++at_;
    for (; at_ < text_.size() && isDigit(text_[at_]) && out < kMost; ++at_)
      out = out * 10 + static_cast<unsigned>(text_[at_] - '0');
    return out;
  }
  // Either letter, small or not, anywhere on the line.
  bool has(char letter) const {
    std::size_t begin = std::min(at_, text_.size());
    while (begin > 0 && text_[begin - 1] != '\n')
      --begin;
    const std::string_view line = text_.substr(begin, text_.find('\n', begin) - begin);
    return std::any_of(line.begin(), line.end(), [&](char c) { return upperCase(c) == letter; });
  }

private:
  std::string_view text_;
  std::size_t at_;
};

bool jumpsAt(std::string_view text, std::size_t at) {
  Rest rest(text, at + 1);
  if (upperCase(text[at]) == 'M') {
    const unsigned code = rest.number();
    return code == 97 || (code == 98 && rest.has('Q')) || (code == 99 && rest.has('P'));
  }
  Rest word = rest;
  if (word.next() == 'O') return word.next() == 'T' && word.next() == 'O';
  const unsigned code = rest.number();
  return code >= 70 && code <= 73 && rest.has('P') && rest.has('Q');
}

} // namespace

bool mayJump(std::string_view text) {
  for (const char letter : {'G', 'g', 'M', 'm'})
    for (std::size_t at = text.find(letter); at != std::string_view::npos; at = text.find(letter, at + 1))
      if (jumpsAt(text, at)) return true;
  return false;
}

void TextModes::pass(std::string_view line, bool header) {
  if (header) absolute_ = macroAfterMoves_ = false;
  const std::size_t first = line.find_first_not_of(" \t");
  const bool mayBeSkipped = first != std::string_view::npos && line[first] == '/';
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (line[at] == '(') {
      at = std::min(line.find(')', at), line.size());
      continue;
    }
    if (line[at] == '#' || line[at] == '[') absolute_ = false;
    if (!isLetter(line[at])) continue;
    const char letter = upperCase(line[at]);
    Rest rest(line, at + 1);
    // A keyword, what nobody can read, or a block that is gone to.
    if (isLetter(Rest(rest).next()) || (letter == 'N' && jumps_)) absolute_ = false;
    if (letter != 'G' && letter != 'M') continue;
    const unsigned code = rest.number();
    if (letter == 'M') {
      if (code >= 97 && code <= 99) absolute_ = false;
      continue;
    }
    if (code == 90 && !mayBeSkipped) absolute_ = true;
    if (code == 91 || code == 65) absolute_ = false;
    if (code == 66 || code == 67) macroAfterMoves_ = code == 66;
  }
}

} // namespace dotek::frontend::macrob
