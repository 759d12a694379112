#include "frontend/mikroprog/Check.h"

#include "frontend/mikroprog/CheckGeometry.h"
#include "support/Decimal.h"
#include "support/messages/Mikroprog.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace dotek::frontend::mikroprog {

namespace {

using stdlib::MikroprogFunction;

constexpr std::uint32_t kTouchProbe = 7;                           // condition O
constexpr std::uint32_t kFirstField = 20, kLastField = 23;         // conditions of the operator's fields
constexpr std::uint32_t kFieldLabel = 200;                         // M42 H220 sets up field 20
constexpr std::uint32_t kPowerSection = 8, kLastMachineOutput = 3; // Q

// What a code of another control is here; "" where nothing helps.
std::string_view remedy(char letter, std::uint32_t number) {
  struct Row {
    char letter;
    std::uint32_t number;
    std::string_view text;
  };
  static constexpr Row kRows[] = {
      {'G', 20, "; the control counts millimetres alone"},
      {'G', 21, "; the control counts millimetres alone"},
      {'G', 30, "; move with G0 to a safe point"},
      {'G', 32, "; G33 X Z K is a thread pass"},
      {'G', 43, "; M6 applies the correction table"},
      {'G', 49, "; M6 applies the correction table"},
      {'G', 56, "; the stored shifts are G52 to G55"},
      {'G', 57, "; the stored shifts are G52 to G55"},
      {'G', 58, "; the stored shifts are G52 to G55"},
      {'G', 59, "; the stored shifts are G52 to G55"},
      {'G', 65, "; parameters P and G26, G28 or M61 to M68 take its place"},
      {'G', 76, "; G78 is the thread cycle"},
      {'G', 80, "; cycles hold for their block alone"},
      {'G', 84, "; the machine cannot tap"},
      {'G', 97, "; a new S ends G96"},
      {'M', 98, "; G26 L calls a subprogram"},
  };
  for (const Row& row : kRows)
    if (row.letter == letter && row.number == number) return row.text;
  return "";
}

class Checker {
public:
  Checker(const Program& program, const stdlib::MikroprogControl& control, const SourceMap& sources,
          Diagnostics& diagnostics)
      : program_(program), control_(control), sources_(sources), diagnostics_(diagnostics) {}

  void run() {
    for (std::size_t i = 0; i < program_.lines.size(); ++i) {
      const Line& line = program_.lines[i];
      if (line.number) {
        if (!numbers_.emplace(*line.number, i).second)
          diagnostics_.report<diag::SufNumberOrder>(line.numberRange, *line.number, "stands twice");
        else if (*line.number < last_)
          diagnostics_.report<diag::SufNumberOrder>(line.numberRange, *line.number,
                                                    "is smaller than one before");
        last_ = *line.number;
      }
      if (end_ == kNone && holds(line, "end")) end_ = i;
    }
    for (std::size_t i = 0; i < program_.lines.size(); ++i) {
      at_ = i;
      line(program_.lines[i]);
    }
    layout();
  }

private:
  static constexpr std::size_t kNone = SIZE_MAX;

  const MikroprogFunction* functionOf(const Word& word) const {
    if ((word.address != 'G' && word.address != 'M') || !word.value.number) return nullptr;
    const double number = *word.value.number;
    if (number < 0 || number > 999 || number != std::floor(number)) return nullptr;
    return control_.find(word.address, static_cast<std::uint32_t>(number));
  }
  bool holds(const Line& line, std::string_view function) const {
    return std::any_of(line.words.begin(), line.words.end(), [&](const Word& word) {
      const MikroprogFunction* found = functionOf(word);
      return found != nullptr && found->function == function;
    });
  }
  static std::uint32_t whole(const Word* word) {
    return word != nullptr && word->value.number && *word->value.number >= 0 && *word->value.number < 1e9
               ? static_cast<std::uint32_t>(*word->value.number)
               : 0;
  }
  std::string text(SourceRange range) const { return sources_.textUtf8(range); }

  void line(const Line& line) {
    nonAscii(line);
    parameters(line);
    if (line.unread) return;
    std::vector<const MikroprogFunction*> functions;
    for (const Word& word : line.words) {
      if (word.address != 'G' && word.address != 'M') continue;
      const MikroprogFunction* function = functionOf(word);
      if (function == nullptr) {
        const std::uint32_t number = whole(&word);
        diagnostics_.report<diag::SufUnknownCode>(word.range, control_.title, text(word.range),
                                                  remedy(word.address, number));
        unknown_ = true;
        continue;
      }
      if (!function->usable)
        diagnostics_.report<diag::SufUnusableCode>(word.range, function->code(), function->title,
                                                   function->notes.empty() ? "" : function->notes.front());
      functions.push_back(function);
      addresses(line, word, *function);
    }
    if (!unknown_) taken(line, functions);
    unknown_ = false;
    for (const MikroprogFunction* function : functions)
      meaning(line, *function);
    state(line, functions);
  }

  void nonAscii(const Line& line) {
    const std::string_view bytes = sources_.text(line.range);
    const auto odd =
        std::find_if(bytes.begin(), bytes.end(), [](char c) { return static_cast<unsigned char>(c) > 126; });
    if (odd == bytes.end()) return;
    const auto from = line.range.begin + static_cast<std::uint32_t>(odd - bytes.begin());
    diagnostics_.report<diag::SufNonAscii>({line.range.file, from, from + 1});
  }

  // What one function wants of its block.
  void addresses(const Line& line, const Word& code, const MikroprogFunction& function) {
    const auto present = [&](char letter) {
      return letter == ';' ? line.comment.has_value() : line.find(letter) != nullptr;
    };
    for (const stdlib::MikroprogAddress& address : function.addresses) {
      if (address.letter == '@' && !present('@')) {
        diagnostics_.report<diag::SufFileMissing>(code.range, function.code(), control_.dataEnding);
        continue;
      }
      if (address.letter == ';' && address.use == stdlib::AddressUse::Needed &&
          (!line.comment || line.comment->empty())) {
        diagnostics_.report<diag::SufTextMissing>(code.range, function.code());
        continue;
      }
      const Word* word = line.find(address.letter);
      if (word == nullptr) {
        if (address.use != stdlib::AddressUse::Needed || address.letter == ';') continue;
        if (function.function == "stop-if" && conditionInComment(line)) continue;
        diagnostics_.report<diag::SufAddressMissing>(code.range, function.code(), function.title,
                                                     std::string(1, address.letter));
        continue;
      }
      if (!word->value.number) continue;
      const double value = *word->value.number;
      if ((address.least && value < *address.least) || (address.most && value > *address.most))
        diagnostics_.report<diag::SufRange>(
            word->range, text(word->range), std::string(1, address.letter), function.code(),
            address.most
                ? fmt::format("{} to {}", numberText(address.least.value_or(0)), numberText(*address.most))
                : fmt::format("{} or more", numberText(*address.least)));
    }
    const bool any =
        function.either.empty() ||
        std::any_of(function.either.begin(), function.either.end(), [&](const std::string& group) {
          return std::any_of(group.begin(), group.end(), present);
        });
    if (!any)
      diagnostics_.report<diag::SufAddressMissing>(code.range, function.code(), function.title,
                                                   fmt::format("any of {}", joined(function.either)));
    for (const std::string& group : function.notTogether) {
      if (!std::all_of(group.begin(), group.end(), present)) continue;
      diagnostics_.report<diag::SufNotTogether>(code.range, fmt::format("{} and {}", group[0], group[1]),
                                                function.code());
    }
  }

  static std::string joined(const std::vector<std::string>& groups) {
    std::string out;
    for (const std::string& group : groups)
      for (const char letter : group)
        out += (out.empty() ? "" : ", ") + std::string(1, letter);
    return out;
  }

  bool conditionInComment(const Line& line) {
    if (!line.comment || line.comment->size() < 2) return false;
    const char first = static_cast<char>(std::toupper(static_cast<unsigned char>((*line.comment)[0])));
    const std::string digits = line.comment->substr(1);
    if ((first != 'O' && first != '0') || digits.find_first_not_of("0123456789") != std::string::npos)
      return false;
    diagnostics_.report<diag::SufConditionInComment>(line.commentRange, digits);
    return true;
  }

  // Words that nothing takes; short form: axes, F and S may stand alone.
  void taken(const Line& line, const std::vector<const MikroprogFunction*>& functions) {
    const bool code = std::any_of(functions.begin(), functions.end(),
                                  [](const MikroprogFunction* one) { return !one->addresses.empty(); });
    for (const Word& word : line.words) {
      if (word.address == 'G' || word.address == 'M') continue;
      const auto refuses =
          std::find_if(functions.begin(), functions.end(), [&](const MikroprogFunction* one) {
            return one->forbids.find(word.address) != std::string::npos;
          });
      const bool takes = std::any_of(functions.begin(), functions.end(), [&](const MikroprogFunction* one) {
        return one->find(word.address) != nullptr;
      });
      const bool shortForm =
          !code && (control_.hasAxis(word.address) || word.address == 'F' || word.address == 'S' ||
                    word.address == 'R' || word.address == 'I' || word.address == 'J' || word.address == 'K');
      if (refuses != functions.end())
        diagnostics_.report<diag::SufAddressNotTaken>(
            word.range, text(word.range),
            fmt::format(": `{}` has none ({})", (*refuses)->code(),
                        (*refuses)->notes.empty() ? "" : (*refuses)->notes.front()));
      else if (!takes && !shortForm)
        diagnostics_.report<diag::SufAddressNotTaken>(
            word.range, text(word.range), word.address == 'O' ? "; a program has a name and no number" : "");
      if (std::string_view("XYZIJKR").find(word.address) == std::string_view::npos || !word.value.number)
        continue;
      if (Decimal::of(*word.value.number).fractionPart().size() > static_cast<std::size_t>(control_.decimals))
        diagnostics_.report<diag::SufDecimals>(word.range, text(word.range), control_.decimals);
    }
  }

  // What the value of a word means.
  void meaning(const Line& line, const MikroprogFunction& function) {
    if (const Word* target = line.find('L');
        target != nullptr && function.find('L') != nullptr && function.function != "run-program") {
      const auto found = numbers_.find(whole(target));
      if (found == numbers_.end())
        diagnostics_.report<diag::SufTargetMissing>(target->range, whole(target));
      else if (function.function == "call")
        calls_.emplace(found->second, target->range);
    }
    if (const Word* condition = line.find('O'); condition != nullptr && function.find('O') != nullptr) {
      const std::uint32_t number = whole(condition);
      if (control_.condition(number) == nullptr)
        diagnostics_.report<diag::SufCondition>(condition->range, number,
                                                number == 6   ? "it is reserved"
                                                : number == 9 ? "it is not used"
                                                              : "1 to 5, 7, 8, 10 to 18 and 20 to 23 are");
      else if (number >= kFirstField && number <= kLastField && !fields_.contains(number))
        diagnostics_.report<diag::SufFieldNotSet>(condition->range, number);
    }
    if (const Word* file = line.find('@');
        file != nullptr && function.function != "run-program" && function.find('@') != nullptr) {
      std::string name = file->file;
      std::transform(name.begin(), name.end(), name.begin(),
                     [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
      if (!name.ends_with("." + control_.dataEnding))
        diagnostics_.report<diag::SufFileEnding>(file->range, file->file, control_.dataEnding);
    }
    if (const Word* output = line.find('Q'); output != nullptr && function.find('Q') != nullptr) {
      const std::uint32_t number = whole(output);
      if (number == kPowerSection)
        diagnostics_.report<diag::SufPowerSection>(output->range);
      else if (number >= 1 && number <= kLastMachineOutput)
        diagnostics_.report<diag::SufOutput>(
            output->range, number, number == 3 ? "coolant is M8 and M9" : "the spindle is M3, M4 and M5");
    }
    if (function.function == "leave") diagnostics_.report<diag::SufLeavesMode>(line.range);
    if (function.function == "set-position") diagnostics_.report<diag::SufDatumLasts>(line.range);
    if (function.function == "set-condition") {
      const std::uint32_t field = whole(line.find('H'));
      fields_.insert(field > kFieldLabel ? field - kFieldLabel : field);
    }
  }

  // What is in force, in the order of the text.
  void state(const Line& line, const std::vector<const MikroprogFunction*>& functions) {
    const auto has = [&](std::string_view what) {
      return std::any_of(functions.begin(), functions.end(),
                         [&](const MikroprogFunction* one) { return one->function == what; });
    };
    if (line.find('F') != nullptr) feed_ = true;
    for (const char* motion : {"rapid", "feed", "arc-clockwise", "arc-counter-clockwise"})
      if (has(motion)) feeds_ = std::string_view(motion) != "rapid";
    const bool axes = std::any_of(line.words.begin(), line.words.end(),
                                  [&](const Word& word) { return control_.hasAxis(word.address); });
    const bool other = std::any_of(functions.begin(), functions.end(), [&](const MikroprogFunction* one) {
      return !one->addresses.empty() && one->group != "motion";
    });
    if (feeds_ && axes && !other && !feed_ && !feedTold_) {
      diagnostics_.report<diag::SufFeedMissing>(line.range);
      feedTold_ = true;
    }
    if (has("jump-if") && whole(line.find('O')) == kTouchProbe) guarded_ = true;
    if (has("spindle-right") || has("spindle-left")) spindle_ = true;
    if (has("spindle-off")) spindle_ = false;
    if (has("coolant-on")) coolant_ = true;
    if (has("coolant-off")) coolant_ = false;
    if (!has("probe-move")) return;
    if (line.find('L') == nullptr) diagnostics_.report<diag::SufProbeNoTarget>(line.range);
    if (!guarded_) diagnostics_.report<diag::SufProbeNoGuard>(line.range);
    guarded_ = true; // told once
    if (spindle_) diagnostics_.report<diag::SufProbeTurning>(line.range, "the spindle");
    if (coolant_) diagnostics_.report<diag::SufProbeTurning>(line.range, "the coolant");
  }

  void parameters(const Line& line) {
    const auto read = [&](const Value& value, SourceRange where) {
      if (value.parameter && !set_.contains(*value.parameter))
        diagnostics_.report<diag::SufParameterUnset>(where, *value.parameter);
    };
    for (const Word& word : line.words) {
      read(word.value, word.range);
      if (word.value.parameter && word.address != 'F')
        diagnostics_.report<diag::SufParameterUse>(word.range,
                                                   fmt::format("a parameter behind {}", word.address), "Q11");
    }
    if (holds(line, "read-value")) set_.insert(90);
    if (!line.assignment) return;
    for (const Term& term : line.assignment->terms)
      read(term.value, term.range);
    if (line.assignment->terms.size() > 1 || line.assignment->terms.front().value.parameter)
      diagnostics_.report<diag::SufParameterUse>(line.assignment->range,
                                                 "a parameter that is not set to a number", "Q10");
    set_.insert(line.assignment->parameter);
  }

  void layout() {
    if (end_ == kNone && !program_.lines.empty()) diagnostics_.report<diag::SufNoEnd>({program_.file, 0, 0});
    std::size_t lastReturn = kNone;
    for (std::size_t i = 0; i < program_.lines.size(); ++i)
      if (holds(program_.lines[i], "return")) lastReturn = i;
    for (const auto& [line, where] : calls_) {
      const std::uint64_t number = *program_.lines[line].number;
      if (end_ == kNone || line < end_) {
        diagnostics_.report<diag::SufCallLayout>(where, number);
        continue;
      }
      if (lastReturn == kNone || lastReturn < line)
        diagnostics_.report<diag::SufSubprogramEnd>(where, number);
    }
    for (std::size_t i = 0; i < program_.lines.size(); ++i) {
      if (!holds(program_.lines[i], "return")) continue;
      const bool called = !calls_.empty() && calls_.begin()->first <= i;
      if (!called) diagnostics_.report<diag::SufStrayReturn>(program_.lines[i].range);
    }
  }

  const Program& program_;
  const stdlib::MikroprogControl& control_;
  const SourceMap& sources_;
  Diagnostics& diagnostics_;
  std::map<std::uint64_t, std::size_t> numbers_; // N to its first line
  std::map<std::size_t, SourceRange> calls_;     // first line of a subprogram, and where it is called
  std::set<std::uint32_t> fields_, set_;         // fields of the operator; parameters with a value
  std::uint64_t last_ = 0;
  std::size_t end_ = kNone, at_ = 0;
  bool feed_ = false, feeds_ = false, feedTold_ = false, guarded_ = false, spindle_ = false, coolant_ = false;
  bool unknown_ = false; // this block holds a code that nobody knows
};

} // namespace

void checkProgram(const Program& program, const stdlib::MikroprogControl& control, const SourceMap& sources,
                  Diagnostics& diagnostics) {
  Checker(program, control, sources, diagnostics).run();
  checkGeometry(program, control, sources, diagnostics);
}

} // namespace dotek::frontend::mikroprog
