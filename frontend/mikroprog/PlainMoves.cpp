#include "frontend/mikroprog/PlainMoves.h"

#include "support/Decimal.h"

#include <algorithm>
#include <unordered_set>

namespace dotek::frontend::mikroprog {

namespace {

constexpr std::size_t kMostDigits = 5, kMostDecimals = 3;
constexpr double kLeastFeed = 1, kMostPerRevolution = 5; // that are right under G94, under G95
constexpr std::uint8_t kRapid = 1, kFeed = 2, kNumber = 4, kPlain = 8, kF = 16, kFirstAxis = 32;

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

class Reader {
public:
  explicit Reader(std::string_view text) : text_(text) {}

  // 0: nothing is wrong with it, and it is no plain move.
  std::uint8_t form(std::string_view axes, bool perRevolution) {
    std::uint8_t out = kPlain;
    blanks();
    if (take('N')) {
      const std::size_t from = at_;
      for (; at_ < text_.size() && isDigit(text_[at_]); ++at_)
        number_ = number_ * 10 + static_cast<std::uint64_t>(text_[at_] - '0');
      if (at_ == from || at_ - from > 9) return broken();
      hasNumber_ = true;
      out |= kNumber;
    }
    for (blanks(); at_ < text_.size(); blanks()) {
      const std::uint8_t bit = take('G') ? motion() : take('F') ? feed(perRevolution) : axis(axes);
      if (bit == 0 || (out & bit) != 0 || (bit < kNumber && (out & (kRapid | kFeed)) != 0)) return 0;
      out |= bit;
    }
    return out < kFirstAxis || (out & (kRapid | kF)) == (kRapid | kF) ? 0 : out;
  }
  // P1=500: moves nothing, and changes nothing that a plain move depends on.
  bool isAssignment() {
    if (!sequence() || !take('P') || digits() == 0) return false;
    blanks();
    if (!take('=')) return false;
    blanks();
    take('-');
    if (digits() == 0 || (take('.') && digits() == 0)) return false;
    blanks();
    return at_ == text_.size();
  }
  // G1, G2 or G3 with axes, a radius or centre and a feed, FP1 too: only a move.
  bool isCut(std::string_view axes) {
    if (!sequence() || !take('G') || !(take('1') || take('2') || take('3')) || !ends()) return false;
    for (blanks(); at_ < text_.size(); blanks()) {
      const char letter = text_[at_++];
      if (axes.find(letter) == std::string_view::npos &&
          std::string_view("RIJKF").find(letter) == std::string_view::npos)
        return false;
      if (letter == 'F' && take('P')) {
        if (digits() == 0 || !ends()) return false;
        continue;
      }
      take('-');
      if (digits() == 0 || (take('.') && digits() == 0) || !ends()) return false;
    }
    return true;
  }
  bool hasNumber() const { return hasNumber_; }
  std::uint64_t number() const { return number_; }

private:
  std::uint8_t broken() {
    hasNumber_ = false;
    return 0;
  }
  // Past an N, which is none of its own.
  bool sequence() {
    at_ = 0;
    blanks();
    if (take('N') && digits() == 0) return false;
    blanks();
    return true;
  }
  void blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t'))
      ++at_;
  }
  bool take(char c) {
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool ends() const { return at_ == text_.size() || text_[at_] == ' '; }

  std::uint8_t motion() {
    const std::uint8_t bit = take('0') ? kRapid : take('1') ? kFeed : 0;
    return ends() ? bit : 0;
  }
  std::uint8_t feed(bool perRevolution) {
    const std::size_t from = at_;
    digits();
    if (take('.')) digits();
    const auto value =
        ends() && at_ - from <= kMostDigits ? parseNumber(text_.substr(from, at_ - from)) : std::nullopt;
    return value && *value >= kLeastFeed && (!perRevolution || *value <= kMostPerRevolution) ? kF : 0;
  }
  std::uint8_t axis(std::string_view axes) {
    const std::size_t which = axes.find(text_[at_++]);
    if (which == std::string_view::npos) return 0;
    take('-');
    const std::size_t whole = digits();
    const std::size_t decimals = take('.') ? digits() : 1;
    if (whole == 0 || whole > kMostDigits || decimals == 0 || decimals > kMostDecimals || !ends()) return 0;
    return static_cast<std::uint8_t>(kFirstAxis << which);
  }
  std::size_t digits() {
    const std::size_t from = at_;
    while (at_ < text_.size() && isDigit(text_[at_]))
      ++at_;
    return at_ - from;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::uint64_t number_ = 0;
  bool hasNumber_ = false;
};

// Digits after an L, wherever it is.
void addTargets(std::string_view line, std::unordered_set<std::uint64_t>& out) {
  for (std::size_t at = line.find('L'); at != std::string_view::npos; at = line.find('L', at + 1)) {
    std::uint64_t number = 0;
    for (std::size_t i = at + 1; i < line.size() && (isDigit(line[i]) || line[i] == ' '); ++i)
      if (isDigit(line[i])) number = number * 10 + static_cast<std::uint64_t>(line[i] - '0');
    out.insert(number);
  }
}

} // namespace

std::vector<bool> leftOut(const std::vector<std::string_view>& lines, std::string_view axes) {
  std::vector<std::uint8_t> forms(lines.size());
  std::vector<bool> cuts(lines.size());
  std::vector<std::size_t> moves; // lines that are no assignments
  moves.reserve(lines.size());
  std::unordered_set<std::uint64_t> targets;
  std::vector<std::uint32_t> numbers(lines.size()); // of plain moves; 0: none
  std::uint64_t last = 0;
  bool perRevolution = false; // may be in force
  for (std::size_t i = 0; i < lines.size(); ++i) {
    Reader reader(lines[i]);
    forms[i] = reader.form(axes, perRevolution);
    const bool assigns = forms[i] == 0 && reader.isAssignment();
    if (!assigns) moves.push_back(i);
    if (forms[i] == 0 && !assigns) {
      cuts[i] = reader.isCut(axes);
      addTargets(lines[i], targets);
      perRevolution = perRevolution || lines[i].find("95") != std::string_view::npos; // G95, G095
    }
    if (!reader.hasNumber()) continue;
    if (i != 0 && reader.number() <= last) return {};
    last = reader.number();
    if (last == 0) forms[i] = 0;
    numbers[i] = static_cast<std::uint32_t>(last);
  }
  std::vector<bool> out(lines.size());
  for (std::size_t at = 1; at + 1 < moves.size(); ++at) {
    const std::size_t i = moves[at], before = moves[at - 1], after = moves[at + 1];
    const auto isLike = [&](std::size_t other) { return (forms[other] | kF) == (forms[i] | kF); };
    if (forms[i] == 0 || !isLike(after)) continue;
    // After an arc or a feed by a parameter the next line says all that the first one says.
    if (!isLike(before) && !(cuts[before] && (forms[i] & kFeed) != 0)) continue;
    // An F counts for the lines after it.
    if ((forms[i] & kF) != 0 && (forms[before] & forms[after] & kF) == 0) continue;
    // Before a G31 the last move counts, and so does where it begins.
    const std::size_t second = at + 2 < moves.size() ? moves[at + 2] : lines.size();
    const bool probed =
        second < lines.size() && forms[second] == 0 && lines[second].find("31") != std::string_view::npos;
    out[i] = !probed && (numbers[i] == 0 || !targets.contains(numbers[i]));
  }
  return out;
}

bool takesPlainMoves(const stdlib::MikroprogControl& control) {
  if (control.decimals < static_cast<int>(kMostDecimals)) return false;
  for (const std::uint32_t number : {0u, 1u}) {
    const stdlib::MikroprogFunction* const move = control.find('G', number);
    if (move == nullptr || !move->usable || move->function != (number == 0 ? "rapid" : "feed")) return false;
    for (const char axis : control.axes) {
      const stdlib::MikroprogAddress* const taken = move->find(axis);
      if (taken == nullptr || taken->least || taken->most) return false;
    }
  }
  return true;
}

} // namespace dotek::frontend::mikroprog
