// Blocks that a control or a command refuses whatever values run through them.
#include "frontend/macrob/BlockWords.h"
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Check.h"
#include "frontend/macrob/Format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace dotek::frontend::macrob {
namespace {

bool isOneOf(double code, std::initializer_list<double> codes) {
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

// Codes that take none of the letters that a straight move does not take either.
constexpr std::array kPlain = {0.0,  1.0,  17.0, 18.0, 19.0, 20.0, 21.0, 40.0, 41.0, 42.0, 43.0, 44.0,
                               49.0, 53.0, 54.0, 55.0, 56.0, 57.0, 58.0, 59.0, 90.0, 91.0, 94.0};

bool isPlain(double code) {
  return std::find(kPlain.begin(), kPlain.end(), code) != kPlain.end();
}

// Codes that are in their block only and take its words: dwell, data, reference points, skip, shifts.
constexpr std::array kOneShot = {4.0, 10.0, 27.0, 28.0, 29.0, 30.0, 31.0, 52.0, 53.0, 92.0};

} // namespace

// ---- statements

namespace {

// A character of printed text that no control sends; 0: none. Capital letters, digits and `+ - / *` are
// documented; small letters, the point, the comma and the signs of a table are sent by some.
char unprintable(const Print& print) {
  for (const auto& piece : print.pieces)
    if (const auto* text = std::get_if<PrintedText>(&piece))
      for (const char c : text->text)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 &&
            std::string_view(" +-/*.,=:()").find(c) == std::string_view::npos)
          return c;
  return '\0';
}

} // namespace

void printedFormat(const CheckedProgram& input, Report& report) {
  for (const Block& block : input.program.blocks) {
    const auto* print = std::get_if<Print>(&block.body);
    if (print == nullptr)
      if (const auto* branch = std::get_if<If>(&block.body)) print = std::get_if<Print>(&branch->statement);
    if (print == nullptr) continue;
    if (const char sign = unprintable(*print); sign != '\0') {
      report.at(print->range,
                "{} is in what is printed, and {} prints capital letters, digits and `+ - / *`, with `*` as "
                "a blank; the control stops with an alarm; take it out",
                static_cast<unsigned char>(sign) < 0x80 ? fmt::format("`{}`", sign) : "a letter beyond ASCII",
                print->binary ? "BPRNT" : "DPRNT");
      continue;
    }
    for (const auto& piece : print->pieces) {
      const auto* variable = std::get_if<PrintedVariable>(&piece);
      if (variable == nullptr) continue;
      const std::string& format = variable->format;
      const bool digits =
          std::all_of(format.begin(), format.end(), [](char c) { return c >= '0' && c <= '9'; });
      if (digits && format.size() == (print->binary ? 1 : 2)) continue;
      report.at(print->range,
                "`#{0}` is printed with the format `[{1}]`; {2}; the control stops with an alarm; write "
                "`#{0}[{3}]`",
                variable->variable, format,
                print->binary ? "BPRNT takes one digit, the decimals"
                              : "DPRNT takes two digits, before and after the point",
                print->binary ? "3" : "53");
      break;
    }
  }
}

void blockDeleteOfLoop(const CheckedProgram& input, Report& report) {
  for (const Block& block : input.program.blocks)
    if (block.blockDelete &&
        (std::holds_alternative<Do>(block.body) || std::holds_alternative<End>(block.body)))
      report.at(
          block.blockDelete->range,
          "block delete before a loop's begin or end; where the loop is passed over the other half of it is "
          "left; write the `/` before the blocks inside");
}

void returnRepeated(const CheckedProgram& input, Report& report) {
  for (const Words* words : input.plain)
    if (const auto call = callOf(*words); call && call->kind == CallKind::Return && call->repeat != nullptr)
      report.at(call->repeat->range,
                "what `L` does after M99 is not known to Dotek; leave it out, or repeat the call");
}

void atanDivisor(const CheckedProgram& input, Report& report) {
  for (const CheckedProgram::Part& part : input.parts) {
    const auto* operation = std::get_if<nc::Operation>(&part.expression->node);
    if (operation == nullptr || operation->op != "/" || operation->left->brackets > 0 ||
        operation->right->brackets > 0)
      continue;
    const auto* call = std::get_if<nc::FunctionCall>(&operation->left->node);
    if (call == nullptr || call->name != "ATAN" || call->arguments.size() != 1 || call->bare) continue;
    const SourceRange right = operation->right->range;
    report
        .at({right.file, operation->left->range.begin, right.end},
            "`/` after ATAN[..] is without brackets; ATAN takes two values as `ATAN[y]/[x]`, so the control "
            "stops "
            "with an alarm or divides the angle; write `/[{0}]`, or `[ATAN[..]]/{0}` if the angle is to be "
            "divided",
            print(*operation->right))
        .fix =
        Fix{Fix::Applicability::Display,
            "write the brackets",
            {{{right.file, right.begin, right.begin}, "["}, {{right.file, right.end, right.end}, "]"}}};
  }
}

// ---- words

namespace {

class Ranges {
public:
  Ranges(const CheckedProgram& input, Report& report) : control_(input.control), report_(report) {}

  void plain(const Words& words) const {
    bool feeds = false, dwells = false, data = false, reference = false, extended = false, length = false;
    for (const nc::Word& word : words.words) {
      const auto code = word.address == 'G' ? literal(word) : std::nullopt;
      if (!code) continue;
      feeds = feeds || isOneOf(*code, {1, 2, 3, 31});
      dwells = dwells || *code == 4;
      data = data || *code == 10;
      reference = reference || *code == 30;
      extended = extended || *code == 54.1;
      length = length || isOneOf(*code, {43, 44});
    }
    for (const nc::Word& word : words.words) {
      const auto value = literal(word);
      if (!value) continue;
      switch (word.address) {
      case 'G':
      case 'M':
        if (*value < 0) tell(word, "a code is not below 0");
        break;
      case 'F':
        if (*value < 0) tell(word, "a feed is not below 0");
        if (*value == 0 && feeds) tell(word, "a feed move needs a feed above 0 (alarm 11)");
        break;
      case 'S':
        if (*value < 0) tell(word, "a speed is not below 0");
        break;
      case 'T':
        if (*value < 0) tell(word, "a tool number is not below 0");
        break;
      case 'H':
        if (length) offset(word, *value);
        break;
      case 'P':
        if (dwells && (*value < 0 || *value != std::floor(*value)))
          tell(word, "P of a dwell counts whole milliseconds; seconds are written with X");
        else if (reference && !isOneOf(*value, {2, 3, 4}))
          tell(word, "G30 goes to the second to fourth reference point, P2 to P4");
        else if (extended)
          system(word, *value);
        else if (data)
          dataNumber(words, word, *value);
        break;
      default: break;
      }
      if (control_ != nullptr && !data &&
          std::string_view("XYZUVWIJKR").find(word.address) != std::string_view::npos &&
          std::abs(*value) >= std::pow(10.0, control_->integerDigits) && hasPoint(word))
        tell(word,
             fmt::format("the control takes {} digits before the point (alarm 3)", control_->integerDigits));
    }
  }

  void call(const Call& call) const {
    const double last = control_ != nullptr ? control_->programLast : 99999999;
    const bool repeatsInside =
        call.kind == CallKind::Subprogram && (control_ == nullptr || control_->repeatInProgram);
    if (call.program != nullptr)
      if (const auto value = literal(*call.program);
          value && (*value < 1 || *value != std::floor(*value) || (*value > last && !repeatsInside)))
        tell(
            *call.program,
            fmt::format("programs have whole numbers from 1 to {}{}", last,
                        *value > last && *value <= 99999999 && *value == std::floor(*value)
                            ? "; where the machine is set for longer ones, `[programs] last = 99999999` in a "
                              "file that extends the control says so"
                            : ""));
    if (call.repeat != nullptr)
      if (const auto value = literal(*call.repeat);
          value && (*value < 1 || *value > 9999 || *value != std::floor(*value)))
        tell(*call.repeat, "a call repeats 1 to 9999 times");
  }

private:
  void tell(const nc::Word& word, std::string_view why) const {
    report_.at(word.range, "`{}`: {}; the control stops with an alarm; write a value that it takes",
               wordText(word), why);
  }
  static bool hasPoint(const nc::Word& word) {
    const Expression* value = word.value.get();
    if (const auto* negated = std::get_if<nc::Negated>(&value->node)) value = negated->operand.get();
    const auto* number = std::get_if<nc::Number>(&value->node);
    return number != nullptr && number->point;
  }
  void offset(const nc::Word& word, double value) const {
    const int last = control_ != nullptr ? control_->variables.toolCount : 0;
    if (value < 0 || value != std::floor(value))
      tell(word, "a tool offset has a whole number");
    else if (last > 0 && value > last)
      tell(word, fmt::format("tool offsets go to {} in the profile of this control", last));
  }
  void system(const nc::Word& word, double value) const {
    const int last = control_ != nullptr ? control_->variables.extendedCount : 0;
    if (value < 1 || value != std::floor(value) || (last > 0 && value > last))
      tell(word, last > 0 ? fmt::format("additional work systems are P1 to P{}", last)
                          : std::string("additional work systems begin at P1"));
  }
  // P of G10: work systems (L2, L20) and tool offsets (L10 to L13).
  void dataNumber(const Words& words, const nc::Word& word, double value) const {
    const nc::Word* kind = findWord(words, 'L');
    const auto l = kind == nullptr ? std::nullopt : literal(*kind);
    if (!l) return;
    if (*l == 20) system(word, value);
    if (*l >= 10 && *l <= 13 && value == 0)
      tell(word, "tool offsets begin at 1");
    else if (*l >= 10 && *l <= 13)
      offset(word, value);
  }

  const stdlib::Control* control_;
  Report& report_;
};

} // namespace

void wordOutOfRange(const CheckedProgram& input, Report& report) {
  const Ranges ranges(input, report);
  for (const Words* words : input.plain)
    ranges.plain(*words);
  for (const Call& call : input.calls)
    ranges.call(call);
  for (const Call& call : input.subprograms)
    ranges.call(call);
}

void wordRepeated(const CheckedProgram& input, Report& report) {
  for (const Words* words : input.plain) {
    // A code of the builder may call a macro, whose arguments I, J and K repeat.
    const bool calls = std::any_of(words->words.begin(), words->words.end(), [](const nc::Word& word) {
      return word.address == 'G' && literal(word).value_or(100) >= 100;
    });
    if (calls) continue;
    std::array<const nc::Word*, 128> first{};
    std::map<std::pair<char, double>, const nc::Word*> codes;
    for (const nc::Word& word : words->words) {
      if (word.value == nullptr) continue;
      if (word.address == 'G' || word.address == 'M') {
        const auto code = literal(word);
        if (!code) continue;
        const auto [before, added] = codes.try_emplace({word.address, *code}, &word);
        if (!added)
          report
              .at(word.range,
                  "`{}{}` is twice in the block; another code may be meant, or a block of its own; leave one "
                  "out",
                  word.address, *code)
              .note(before->second->range, "the first one");
        continue;
      }
      const nc::Word*& before = first[static_cast<unsigned char>(word.address) & 127U];
      if (before != nullptr)
        report
            .at(word.range,
                "the address `{}` is twice in the block; controls take the last one or stop with an alarm; "
                "leave "
                "one out",
                word.address)
            .note(before->range, "the first one");
      before = &word;
    }
  }
}

// Blocks that say their motion or choose a work offset, and nothing else that could take a word.
void wordNotTaken(const CheckedProgram& input, Report& report) {
  // Under cutter compensation, which a caller may have begun, I, J and K of a straight move state a
  // direction.
  const bool main = std::any_of(input.plain.begin(), input.plain.end(), [](const Words* words) {
    return findCode(*words, 'M', 30) != nullptr || findCode(*words, 'M', 2) != nullptr;
  });
  const bool compensates =
      !main || std::any_of(input.plain.begin(), input.plain.end(), [](const Words* words) {
        return findCode(*words, 'G', 41) != nullptr || findCode(*words, 'G', 42) != nullptr;
      });
  const std::string_view letters = compensates ? "ELPQR" : "EIJKLPQR";
  for (const Words* words : input.plain) {
    bool straight = false, skips = false, certain = true;
    const nc::Word* system = nullptr;
    for (const nc::Word& word : words->words) {
      if (word.address == 'M' || word.address == 'T') certain = false;
      if (word.address != 'G') continue;
      const auto code = literal(word);
      straight = straight || (code && (*code == 0 || *code == 1));
      skips = skips || (code && *code == 31);
      if (code && *code >= 54 && *code <= 59) system = &word;
      certain = certain && code && (isPlain(*code) || *code == 31);
    }
    if (!certain) continue;
    if (!straight && !skips) {
      // A canned cycle in force could take other letters, and P beside an axis.
      if (const nc::Word* number = findWord(*words, 'P');
          system != nullptr && number != nullptr && !hasAny(*words, "XYZIJKLQR"))
        report.at(number->range,
                  "`{1}` beside `{0}`: a control ignores it, stops with an alarm or takes the two for an "
                  "additional work offset; write `G54.1 {1}` if that is meant, or leave `{1}` out",
                  wordText(*system), wordText(*number));
      continue;
    }
    // P, Q and others choose the skip signal or the like on some controls.
    const std::string_view refused = skips ? "IJK" : letters;
    for (const nc::Word& word : words->words)
      if (word.value != nullptr && refused.find(word.address) != std::string_view::npos)
        report.at(
            word.range,
            "nothing in this block takes `{}`; the control ignores it or stops with an alarm, and the code "
            "that it was meant for does not run; write that code, or leave the word out",
            wordText(word));
  }
}

namespace {

// G0 to G3 in the block of a canned cycle.
void cycleBesideMotion(const Words& words, Report& report) {
  const nc::Word *motion = nullptr, *cycle = nullptr;
  for (const nc::Word& word : words.words) {
    const auto code = word.address == 'G' ? literal(word) : std::nullopt;
    if (!code || *code != std::floor(*code)) continue;
    if (*code >= 0 && *code <= 3) motion = &word;
    if (isOneOf(*code, {73, 74, 76}) || (*code >= 81 && *code <= 89)) cycle = &word;
  }
  if (motion == nullptr || cycle == nullptr) return;
  report
      .at(cycle->range,
          "`{}` and `{}` in one block; a motion ends a canned cycle, so the control moves and drills "
          "nothing, or "
          "stops with an alarm; give each a block of its own",
          wordText(*motion), wordText(*cycle))
      .note(motion->range, "the motion");
}

} // namespace

namespace {

// G2 or G3 beside a code that takes the end of the arc.
void arcBesideOneShot(const Words& words, Report& report) {
  const nc::Word *arc = nullptr, *other = nullptr;
  bool hasPlane = false;
  for (const nc::Word& word : words.words) {
    const auto code = word.address == 'G' ? literal(word) : std::nullopt;
    if (!code) continue;
    if (isOneOf(*code, {2, 3})) arc = &word;
    if (isOneOf(*code, {10, 27, 28, 29, 30, 31, 53, 92}) && other == nullptr) other = &word;
    hasPlane = hasPlane || isOneOf(*code, {17, 18, 19});
  }
  if (arc == nullptr || other == nullptr) return;
  const double code = *literal(*other);
  report
      .at(other->range,
          "`{}` and `{}` in one block: the second takes the axis words, so no arc is made, or the control "
          "stops with an alarm; {}give each a block of its own",
          wordText(*arc), wordText(*other),
          !hasPlane && isOneOf(code, {27, 28, 29})
              ? fmt::format("write `G{}` if the plane is meant, or ", static_cast<int>(code) - 10)
              : "")
      .note(arc->range, "the arc");
}

// Codes of which one at a time is in force. Those of canned cycles are looked at elsewhere.
struct Group {
  char letter;
  std::array<double, 8> codes;
  std::size_t count;
};
constexpr std::array kGroups = {
    Group{'G', {0, 1, 2, 3, 33}, 5},
    Group{'G', {17, 18, 19}, 3},
    Group{'G', {90, 91}, 2},
    Group{'G', {20, 21}, 2},
    Group{'G', {40, 41, 42}, 3},
    Group{'G', {43, 44, 49}, 3},
    Group{'G', {98, 99}, 2},
    Group{'G', {94, 95}, 2},
    Group{'G', {96, 97}, 2},
    Group{'G', {68, 69}, 2},
    Group{'G', {50, 51}, 2},
    Group{'G', {15, 16}, 2},
    Group{'G', {54, 55, 56, 57, 58, 59}, 6},
    Group{'M', {3, 4, 5}, 3},
    Group{'M', {7, 9}, 2},
    Group{'M', {8, 9}, 2},
    Group{'M', {0, 1, 2, 30, 98, 99}, 6},
};

void codesOfOneGroup(const Words& words, Report& report) {
  for (const Group& group : kGroups) {
    const nc::Word* first = nullptr;
    for (const nc::Word& word : words.words) {
      const auto code = word.address == group.letter ? literal(word) : std::nullopt;
      const auto end = group.codes.begin() + static_cast<std::ptrdiff_t>(group.count);
      if (!code || std::find(group.codes.begin(), end, *code) == end) continue;
      if (first != nullptr && literal(*first) != code) {
        report
            .at(word.range,
                "`{}` and `{}` are of one group, and one at a time is in force; the control takes the last "
                "one or stops "
                "with an alarm; leave out the one that is not meant, or give each a block of its own",
                wordText(*first), wordText(word))
            .note(first->range, "the first one");
        return;
      }
      if (first == nullptr) first = &word;
    }
  }
}

} // namespace

void codesExclude(const CheckedProgram& input, Report& report) {
  for (const Words* words : input.plain) {
    const nc::Word* first = nullptr;
    for (const nc::Word& word : words->words) {
      const auto code = word.address == 'G' ? literal(word) : std::nullopt;
      if (!code || std::find(kOneShot.begin(), kOneShot.end(), *code) == kOneShot.end()) continue;
      const auto is = [&](double one) { return code == one || literal(*first) == one; };
      // A skip move in machine coordinates is in programs that run.
      if (first != nullptr && literal(*first) != code && !(is(53) && is(31)))
        report
            .at(word.range,
                "`{}` and `{}` both want the words of this block; the control carries out one of them or "
                "stops with "
                "an alarm; give each a block of its own",
                wordText(*first), wordText(word))
            .note(first->range, "the first one");
      if (first == nullptr) first = &word;
    }
    cycleBesideMotion(*words, report);
    arcBesideOneShot(*words, report);
    codesOfOneGroup(*words, report);
  }
}

} // namespace dotek::frontend::macrob
