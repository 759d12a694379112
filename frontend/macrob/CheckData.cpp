// Blocks that set something: data input (G10), dwells, signals; and calculations that stop in every run.
#include "frontend/macrob/BlockWords.h"
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Check.h"
#include "frontend/macrob/Constant.h"
#include "frontend/macrob/Format.h"
#include "frontend/macrob/Walk.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::frontend::macrob {
namespace {

bool isOneOf(double value, std::initializer_list<double> list) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

} // namespace

void dataInputWords(const CheckedProgram& input, Report& report) {
  for (const Words* words : input.plain) {
    const nc::Word* code = findCode(*words, 'G', 10);
    if (code == nullptr) continue;
    const nc::Word* kind = findWord(*words, 'L');
    const nc::Word* number = findWord(*words, 'P');
    const nc::Word* axis = findAnyOf(*words, "XYZABCUVW");
    const nc::Word* value = findWord(*words, 'R');
    if (kind == nullptr) {
      // Controls with one memory for lengths set a tool offset by G10 P R.
      const bool oneMemory = input.control != nullptr && !input.control->variables.toolGeometry;
      if (axis != nullptr || !oneMemory)
        report.at(code->range,
                  "G10 has no L, which says what is set; the control stops with an alarm, or writes "
                  "another table; write L2 for a work offset, L10 or L11 for a tool offset");
      continue;
    }
    const auto l = literal(*kind);
    if (!l) continue;
    if (!isOneOf(*l, {1, 2, 3, 10, 11, 12, 13, 14, 20, 50, 51, 52, 70})) {
      report.at(kind->range,
                "`{}` of G10 sets nothing that Dotek knows of; the control stops with an alarm, or writes "
                "another table; write L2 or L20 for work offsets, L10 to L13 for tool offsets",
                wordText(*kind));
      continue;
    }
    if (!isOneOf(*l, {2, 10, 11, 12, 13, 20})) continue;
    if (number == nullptr)
      report.at(code->range,
                "G10 {} has no P, which says which offset is set; the control stops with an alarm, or sets "
                "another one; write P",
                wordText(*kind));
    if (isOneOf(*l, {2, 20}) && value != nullptr)
      report.at(value->range,
                "`{}`: a work offset is set with the letters of its axes; the control ignores the word or "
                "stops with an alarm; write the axis",
                wordText(*value));
    if (*l >= 10 && *l <= 13 && (value == nullptr || axis != nullptr))
      report.at(
          value == nullptr ? code->range : axis->range,
          "G10 {} sets a tool offset to the value of R{}; the control stops with an alarm; write R alone",
          wordText(*kind), value == nullptr ? ", which is missing" : ", and an axis is beside it");
  }
}

void dwellWords(const CheckedProgram& input, Report& report) {
  for (const Words* words : input.plain) {
    const nc::Word* code = findCode(*words, 'G', 4);
    if (code == nullptr) continue;
    const bool alone = std::none_of(words->words.begin(), words->words.end(), [](const nc::Word& word) {
      return word.address == 'G' && literal(word) && isOneOf(*literal(word), {28, 29, 30, 31, 53});
    });
    if (!alone) continue; // codes-exclude speaks of these
    const nc::Word* first = nullptr;
    for (const nc::Word& word : words->words) {
      if (word.value == nullptr) continue;
      if (std::string_view("YZABCVW").find(word.address) != std::string_view::npos)
        report.at(word.range,
                  "`{}` in the block of a dwell, whose time is P, X or U; the control moves nothing, and "
                  "stops with an alarm or does not wait; write the move in a block of its own",
                  wordText(word));
      if (std::string_view("PXU").find(word.address) == std::string_view::npos) continue;
      if (first != nullptr)
        report.at(word.range,
                  "`{}` and `{}` both say how long to wait; the control takes one of them or stops with an "
                  "alarm; leave one out",
                  wordText(*first), wordText(word));
      first = &word;
      if (const auto value = literal(word); value && *value < 0 && word.address != 'P')
        report.at(word.range, "`{}`: a dwell is not below 0; the control stops with an alarm; correct it",
                  wordText(word));
    }
  }
}

// Inputs and outputs of the machine's PMC, each a variable of one bit, and the word that holds all of them.
void signalValue(const CheckedProgram& input, Report& report) {
  if (input.control == nullptr) return;
  for (const Block& block : input.program.blocks) {
    const nc::Assignment* assignment = assignmentOf(block);
    if (assignment == nullptr) continue;
    const auto number = literal(*assignment->variable);
    const auto value = constantOf(*assignment->value);
    if (!number || !value) continue;
    for (const stdlib::StateRange& range : input.control->state) {
      if (!range.word || range.access == stdlib::StateRange::Access::ReadOnly) continue;
      const bool bit = *number >= range.first && *number <= range.last;
      if (bit ? isOneOf(*value, {0, 1}) : *number != *range.word || *value == std::floor(*value)) continue;
      report.at(assignment->range,
                "#{} {}, and {} is none; the control stops with an alarm, or sets the signal by what is "
                "left of the value; correct it",
                *number, bit ? "is one signal, 0 or 1" : "holds signals as the bits of a whole number",
                *value);
    }
  }
}

void calculationStops(const CheckedProgram& input, Report& report) {
  const auto tell = [&](const Expression& at, std::string_view what, int alarm, std::string_view text) {
    report.at(at.range, "`{}`: {}; the control stops with alarm {} ({}) whenever it comes here; correct it",
              print(at), what, alarm, text);
  };
  constexpr std::string_view kRange = "argument value out of range";
  for (const CheckedProgram::Part& part : input.parts) {
    if (const auto* call = std::get_if<nc::FunctionCall>(&part.expression->node)) {
      if (call->arguments.size() != 1) continue;
      const auto value = constantOf(*call->arguments.front());
      if (!value) continue;
      if (call->name == "SQRT" && *value < 0)
        tell(*part.expression, "a negative number has no root", 119, kRange);
      if ((call->name == "ASIN" || call->name == "ACOS") && std::abs(*value) > 1)
        tell(*part.expression, "a sine or cosine is from -1 to 1", 119, kRange);
      if (call->name == "LN" && *value <= 0)
        tell(*part.expression, "only numbers above 0 have a logarithm", 119, kRange);
      if (call->name == "TAN" && std::fmod(std::abs(*value), 180) == 90)
        tell(*part.expression, "there is no tangent of 90 degrees", 112, "zero divide");
    }
    const auto* operation = std::get_if<nc::Operation>(&part.expression->node);
    if (operation == nullptr || (operation->op != "/" && operation->op != "MOD")) continue;
    if (constantOf(*operation->right) == 0.0 || variableNumber(*operation->right) == 0U)
      tell(*part.expression, "a division by 0", 112, "zero divide");
  }
}

} // namespace dotek::frontend::macrob
