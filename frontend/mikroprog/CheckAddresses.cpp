// What a function takes from the words of its block.
#include "frontend/mikroprog/Check.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>

namespace dotek::frontend::mikroprog {

namespace {

using stdlib::AddressUse;
using stdlib::MikroprogAddress;
using stdlib::MikroprogFunction;

constexpr std::uint32_t kPowerSection = 8; // Q

bool isPresent(const Line& line, char letter) {
  return letter == ';' ? line.comment.has_value() : line.find(letter) != nullptr;
}

// Each code with its function, of the blocks that could be read.
template <class Visit> void eachFunction(const Reading& reading, const Visit& visit) {
  for (const Block& block : reading.blocks) {
    if (block.line->unread) continue;
    for (const Code& code : block.codes)
      if (code.function != nullptr) visit(*block.line, code, *code.function);
  }
}

std::string joined(const std::vector<std::string>& groups) {
  std::string out;
  for (const std::string& group : groups)
    for (const char letter : group)
      out += (out.empty() ? "" : ", ") + std::string(1, letter);
  return out;
}

// `M1 ;o20`: the digits, "" for another comment.
std::string conditionIn(const Line& line) {
  if (!line.comment || line.comment->size() < 2) return "";
  const char first = static_cast<char>(std::toupper(static_cast<unsigned char>((*line.comment)[0])));
  std::string digits = line.comment->substr(1);
  if ((first != 'O' && first != '0') || digits.find_first_not_of("0123456789") != std::string::npos)
    return "";
  return digits;
}

bool hasConditionInComment(const Line& line, const MikroprogFunction& function) {
  return function.function == "stop-if" && line.find('O') == nullptr && !conditionIn(line).empty();
}

} // namespace

Findings missingAddresses(const Reading& reading) {
  Findings out;
  eachFunction(reading, [&](const Line& line, const Code& code, const MikroprogFunction& function) {
    for (const MikroprogAddress& address : function.addresses) {
      // Files and texts have rules of their own.
      if (address.letter == '@' || address.letter == ';' || address.use != AddressUse::Needed ||
          isPresent(line, address.letter) || hasConditionInComment(line, function))
        continue;
      out.push_back({code.word->range,
                     fmt::format("`{}` ({}) lacks {}", function.code(), function.title, address.letter)});
    }
    const bool any =
        std::any_of(function.either.begin(), function.either.end(), [&](const std::string& group) {
          return std::any_of(group.begin(), group.end(),
                             [&](char letter) { return isPresent(line, letter); });
        });
    if (!any && !function.either.empty())
      out.push_back({code.word->range, fmt::format("`{}` ({}) lacks any of {}", function.code(),
                                                   function.title, joined(function.either))});
  });
  return out;
}

Findings addressesNotTogether(const Reading& reading) {
  Findings out;
  eachFunction(reading, [&](const Line& line, const Code& code, const MikroprogFunction& function) {
    for (const std::string& group : function.notTogether)
      if (std::all_of(group.begin(), group.end(), [&](char letter) { return isPresent(line, letter); }))
        out.push_back({code.word->range, fmt::format("{} and {} are in one block with `{}`, which takes one "
                                                     "of them",
                                                     group[0], group[1], function.code())});
  });
  return out;
}

Findings valuesOutOfRange(const Reading& reading) {
  Findings out;
  eachFunction(reading, [&](const Line& line, const Code&, const MikroprogFunction& function) {
    for (const MikroprogAddress& address : function.addresses) {
      const Word* word = line.find(address.letter);
      if (word == nullptr || !word->value.number) continue;
      const double value = *word->value.number;
      if ((!address.least || value >= *address.least) && (!address.most || value <= *address.most)) continue;
      out.push_back({word->range,
                     fmt::format("`{}` is out of range: {} of `{}` is {}", reading.text(word->range),
                                 address.letter, function.code(),
                                 address.most ? fmt::format("{} to {}", numberText(address.least.value_or(0)),
                                                            numberText(*address.most))
                                              : fmt::format("{} or more", numberText(*address.least)))});
    }
  });
  return out;
}

Findings missingFiles(const Reading& reading) {
  Findings out;
  eachFunction(reading, [&](const Line& line, const Code& code, const MikroprogFunction& function) {
    if (function.find('@') == nullptr || isPresent(line, '@')) return;
    out.push_back({code.word->range,
                   function.function == "run-program"
                       ? fmt::format("`{}` runs another program here and names no file; write `@NAME.{}`; a "
                                     "way home is a G0 to a safe point, the reference run G98",
                                     function.code(), reading.control.programEnding)
                       : fmt::format("`{}` names no file; write `@NAME.{}`", function.code(),
                                     reading.control.dataEnding)});
  });
  return out;
}

Findings missingTexts(const Reading& reading) {
  Findings out;
  eachFunction(reading, [&](const Line& line, const Code& code, const MikroprogFunction& function) {
    const MikroprogAddress* text = function.find(';');
    if (text != nullptr && text->use == AddressUse::Needed && line.comment.value_or("").empty())
      out.push_back({code.word->range,
                     fmt::format("`{}` has no text after `;`; nothing would be written", function.code())});
  });
  return out;
}

Findings conditionsInComments(const Reading& reading) {
  Findings out;
  eachFunction(reading, [&](const Line& line, const Code&, const MikroprogFunction& function) {
    if (hasConditionInComment(line, function))
      out.push_back({line.commentRange, fmt::format("the condition of `M1` is in the comment, which the "
                                                    "control does not read; write `M1 O{}`",
                                                    conditionIn(line))});
  });
  return out;
}

namespace {

// What the functions of a block do with words of an address.
struct Taken {
  const MikroprogFunction* refuses = nullptr; // the first that must not appear with it
  bool takes = false;
};
Taken takenBy(const Block& block, char address) {
  Taken out;
  for (const Code& one : block.codes) {
    if (out.refuses == nullptr && one.function->forbids.find(address) != std::string::npos)
      out.refuses = one.function;
    out.takes = out.takes || one.function->find(address) != nullptr;
  }
  return out;
}

// What a word beside a change of the system would have to be.
std::string notOfShift(const std::string& word, char address, const MikroprogFunction& function) {
  std::string_view instead = "a move is a block of its own";
  if (function.function == "system-stored")
    instead = "the values are entered by hand, and a move is a block of its own";
  if (address == 'S') instead = "the greatest speed is the A of G96, the speed the S of M3 or M4";
  return fmt::format("nothing in this block takes `{}`: `{}` is {} here; {}", word, function.code(),
                     function.function == "system-stored" ? function.title : "the end of a shift", instead);
}

} // namespace

// Words that no function takes. Short form: axes, F and S may be alone.
Findings addressesNotTaken(const Reading& reading) {
  Findings out;
  for (const Block& block : reading.blocks) {
    if (block.line->unread || block.hasUnknownCode()) continue;
    const bool code = std::any_of(block.codes.begin(), block.codes.end(),
                                  [](const Code& one) { return !one.function->addresses.empty(); });
    // A shift is no move, so what would be short form beside another code is a leftover here.
    const auto shift = std::find_if(block.codes.begin(), block.codes.end(), [](const Code& one) {
      return one.function->group == "system" && one.function->addresses.empty();
    });
    std::map<char, Taken> taken; // by address: the same for all words of one
    for (const First& first : block.line->firsts)
      taken.emplace(first.address, takenBy(block, first.address));
    for (const Word& word : block.line->words) {
      if (word.address == 'G' || word.address == 'M') continue;
      const auto& [refuses, takes] = taken.at(word.address);
      const bool shortForm = !code && shift == block.codes.end() &&
                             (reading.control.hasAxis(word.address) ||
                              std::string_view("FSRIJK").find(word.address) != std::string::npos);
      if (refuses != nullptr) {
        const MikroprogFunction& function = *refuses;
        out.push_back({word.range, fmt::format("nothing in this block takes `{}`: `{}` has none ({})",
                                               reading.text(word.range), function.code(),
                                               function.notes.empty() ? "" : function.notes.front())});
      } else if (!takes && !code && shift != block.codes.end()) {
        out.push_back({word.range, notOfShift(reading.text(word.range), word.address, *shift->function)});
      } else if (!takes && !shortForm) {
        out.push_back(
            {word.range, fmt::format("nothing in this block takes `{}`{}", reading.text(word.range),
                                     word.address == 'O' ? "; a program has a name and no number" : "")});
      }
    }
  }
  return out;
}

Findings tooManyDecimals(const Reading& reading) {
  Findings out;
  for (const Block& block : reading.blocks) {
    if (block.line->unread || block.hasUnknownCode()) continue;
    for (const Word& word : block.line->words) {
      if (std::string_view("XYZIJKR").find(word.address) == std::string_view::npos || !word.value.number)
        continue;
      const std::size_t decimals = Decimal::of(*word.value.number).fractionPart().size();
      if (decimals > static_cast<std::size_t>(reading.control.decimals))
        out.push_back({word.range, fmt::format("`{}` has more than {} decimals", reading.text(word.range),
                                               reading.control.decimals)});
    }
  }
  return out;
}

Findings unknownConditions(const Reading& reading) {
  Findings out;
  eachFunction(reading, [&](const Line& line, const Code&, const MikroprogFunction& function) {
    const Word* condition = line.find('O');
    if (condition == nullptr || !condition->value.number || function.find('O') == nullptr) return;
    const auto number = wholeOf(condition);
    if (number && reading.control.condition(*number) != nullptr) return;
    out.push_back({condition->range, fmt::format("`{}` is no condition; {}", reading.text(condition->range),
                                                 number == 6   ? "it is reserved"
                                                 : number == 9 ? "it is not used"
                                                               : "1 to 5, 7, 8, 10 to 18 and 20 to 23 are")});
  });
  return out;
}

Findings powerSection(const Reading& reading) {
  Findings out;
  eachFunction(reading, [&](const Line& line, const Code&, const MikroprogFunction& function) {
    const Word* output = line.find('Q');
    if (function.find('Q') != nullptr && wholeOf(output) == kPowerSection)
      out.push_back({output->range,
                     "output Q8 switches the power section of the machine off; the drives lose their hold"});
  });
  return out;
}

} // namespace dotek::frontend::mikroprog
