// What one block says twice: functions that exclude each other, words of one address.
#include "frontend/mikroprog/Check.h"

#include <algorithm>
#include <optional>

namespace dotek::frontend::mikroprog {

namespace {

using stdlib::MikroprogFunction;

constexpr std::size_t kMostOfBlock = 8; // codes of a block that are compared

bool isOneOf(const MikroprogFunction& function, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), function.function) != names.end();
}

// Says where the program goes on.
bool leads(const MikroprogFunction& function) {
  return isOneOf(function, {"jump", "jump-if", "call", "return", "end", "leave", "stop", "stop-if",
                            "run-program", "run-macro"});
}

// G24 is a state under G90 and G91; only G90 ends it.
bool isSubState(const MikroprogFunction& one, const MikroprogFunction& other) {
  return isOneOf(one, {"radius"}) && isOneOf(other, {"incremental"});
}

// Why the two cannot be in one block; nothing: they can.
std::optional<std::string> whyNot(const Line& line, const MikroprogFunction& one,
                                  const MikroprogFunction& other) {
  const std::string pair = fmt::format("`{}` and `{}` are in one block", one.code(), other.code());
  if (one.code() == other.code()) return fmt::format("`{}` is in the block twice", one.code());
  if (!one.group.empty() && one.group == other.group) {
    if (isSubState(one, other) || isSubState(other, one)) return std::nullopt;
    return pair + ", and only one of them can be in force; leave out one";
  }
  for (const stdlib::MikroprogAddress& address : one.addresses)
    if (address.letter != ';' && other.find(address.letter) != nullptr &&
        line.find(address.letter) != nullptr)
      return fmt::format("{}, and both take {}; write two blocks", pair, address.letter);
  if (leads(one) && leads(other))
    return pair + ", and which of them comes first is not known; write two blocks";
  const bool reference = isOneOf(one, {"reference"}) || isOneOf(other, {"reference"});
  const MikroprogFunction& moves = isOneOf(one, {"reference"}) ? other : one;
  if (reference && (moves.find('X') != nullptr || moves.find('Z') != nullptr))
    return pair + ": G98 is the reference run here, which moves the machine; it is a block of its own";
  return std::nullopt;
}

} // namespace

Findings saidTwice(const Reading& reading) {
  Findings out;
  for (const Block& block : reading.blocks) {
    const Line& line = *block.line;
    if (line.unread) continue;
    for (std::size_t i = 1; i < std::min(block.codes.size(), kMostOfBlock); ++i) {
      const MikroprogFunction* function = block.codes[i].function;
      for (std::size_t j = 0; function != nullptr && j < i; ++j) {
        const auto why = block.codes[j].function == nullptr
                             ? std::nullopt
                             : whyNot(line, *block.codes[j].function, *function);
        if (!why) continue;
        out.push_back({block.codes[i].word->range, *why});
        break; // one finding a code
      }
    }
    if (line.firsts.size() == line.words.size()) continue;
    std::string seen;
    for (const Word& word : line.words) {
      const bool again = line.find(word.address) != &word;
      // Several outputs in one M20 are possible (Q15).
      if (!again || word.address == 'G' || word.address == 'M' || word.address == 'Q' ||
          seen.find(word.address) != std::string::npos)
        continue;
      seen += word.address;
      out.push_back({word.range, fmt::format("{} is in the block twice; which of the two counts is not known",
                                             word.address == '@' ? std::string("a file")
                                                                 : std::string(1, word.address))});
    }
  }
  return out;
}

} // namespace dotek::frontend::mikroprog
