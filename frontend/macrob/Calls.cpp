#include "frontend/macrob/Calls.h"

#include "frontend/macrob/Keywords.h"

#include <algorithm>

namespace dotek::frontend::macrob {
namespace {

struct CodeKind {
  char letter;
  double code;
  CallKind kind;
};
constexpr CodeKind kCodes[] = {
    {'G', 65, CallKind::Simple}, {'G', 66, CallKind::AfterMoves}, {'G', 66.1, CallKind::EachBlock},
    {'G', 67, CallKind::Off},    {'M', 98, CallKind::Subprogram}, {'M', 99, CallKind::Return},
};

// Counts the sets of I J K (argument specification II): a letter that does not come later in the alphabet
// than the one before it begins the next set.
class Sets {
public:
  CallArgument take(const nc::Word& word) {
    const auto index = static_cast<std::uint32_t>(word.address - 'I');
    CallArgument out{&word, 0, false};
    if (last_ && index <= *last_) {
      out.outOfOrder = !seen_[index];
      ++set_;
      seen_[0] = seen_[1] = seen_[2] = false;
    }
    last_ = index;
    seen_[index] = true;
    if (set_ < 10) out.variable = 4 + 3 * set_ + index;
    return out;
  }

private:
  std::uint32_t set_ = 0;
  std::optional<std::uint32_t> last_;
  bool seen_[3] = {};
};

} // namespace

std::optional<std::uint32_t> calledProgram(const Call& call) {
  constexpr double kLast = 99999999;
  const auto number = call.program == nullptr ? std::nullopt : literal(*call.program);
  if (!number || !(*number >= 1 && *number <= kLast)) return std::nullopt;
  return static_cast<std::uint32_t>(*number);
}

std::optional<double> literal(const Expression& expression) {
  if (expression.brackets > 0) return std::nullopt;
  if (const auto* number = std::get_if<nc::Number>(&expression.node)) return number->value;
  const auto* negated = std::get_if<nc::Negated>(&expression.node);
  if (negated == nullptr) return std::nullopt;
  const std::optional<double> value = literal(*negated->operand);
  return value ? std::optional(-*value) : std::nullopt;
}

std::optional<double> literal(const nc::Word& word) {
  return word.value == nullptr ? std::nullopt : literal(*word.value);
}

const nc::Word* findCode(const Words& words, char letter, double code) {
  for (const nc::Word& word : words.words)
    if (word.address == letter && literal(word) == code) return &word;
  return nullptr;
}

namespace {

// The code of a call that the word is; nullptr: another word.
const CodeKind* callCode(const nc::Word& word) {
  if (word.address != 'G' && word.address != 'M') return nullptr;
  const std::optional<double> value = literal(word);
  if (!value || *value < 65) return nullptr;
  const auto found = std::find_if(std::begin(kCodes), std::end(kCodes), [&](const CodeKind& code) {
    return code.letter == word.address && *value == code.code;
  });
  return found == std::end(kCodes) ? nullptr : &*found;
}

} // namespace

std::optional<Call> callOf(const Words& words) {
  // Most blocks have none: nothing is made for them.
  const CodeKind* kind = nullptr;
  std::size_t at = 0;
  for (; at < words.words.size() && kind == nullptr; ++at)
    kind = callCode(words.words[at]);
  if (kind == nullptr) return std::nullopt;
  Call call;
  call.kind = kind->kind;
  call.code = &words.words[at - 1];
  for (std::size_t i = 0; i + 1 < at; ++i)
    call.before.push_back(&words.words[i]);
  const bool macro =
      call.kind == CallKind::Simple || call.kind == CallKind::AfterMoves || call.kind == CallKind::EachBlock;
  if (macro) call.arguments.reserve(words.words.size() - at);
  Sets sets;
  for (; at < words.words.size(); ++at) {
    const nc::Word& word = words.words[at];
    if (word.address == 'P' && call.program == nullptr)
      call.program = &word;
    else if (word.address == 'L' && call.repeat == nullptr)
      call.repeat = &word;
    else if (word.address == 'Q' && call.kind == CallKind::Subprogram && call.block == nullptr)
      call.block = &word;
    else if (!macro)
      continue;
    else if (word.address >= 'I' && word.address <= 'K')
      call.arguments.push_back(sets.take(word));
    else if (const std::uint32_t variable = argumentVariable(word.address); variable != 0)
      call.arguments.push_back({&word, variable, false});
    else
      call.refused.push_back(&word);
  }
  return call;
}

} // namespace dotek::frontend::macrob
