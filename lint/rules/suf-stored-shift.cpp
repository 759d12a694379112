#include "lint/SufPrograms.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

bool isStored(const mikroprog::Code& code, std::uint32_t first, std::uint32_t last) {
  return code.function != nullptr && code.function->function == "system-stored" &&
         code.function->number >= first && code.function->number <= last;
}

bool hasAxis(const mikroprog::Reading& reading, const mikroprog::Line& line) {
  return std::any_of(reading.control.axes.begin(), reading.control.axes.end(),
                     [&](char axis) { return line.find(axis) != nullptr; });
}

// G54 and G55 of a program that has no G52 and no G53, each once; a move beside G53.
void checkProgram(const mikroprog::Reading& reading, Report& report) {
  std::vector<const mikroprog::Code*> later; // G54 and G55, the first of each
  bool earlier = false;                      // G52 or G53
  for (const mikroprog::Block& block : reading.blocks) {
    if (block.line->unread) continue;
    for (const mikroprog::Code& code : block.codes) {
      earlier = earlier || isStored(code, 52, 53);
      if (isStored(code, 54, 55) && std::none_of(later.begin(), later.end(), [&](const auto* one) {
            return one->function == code.function;
          }))
        later.push_back(&code);
      // Beside G0 or G1 the words are those of a move; alone they are none that the block takes.
      if (isStored(code, 53, 53) && block.codes.size() > 1 && hasAxis(reading, *block.line))
        report.at(
            code.word->range,
            "`G53` is stored shift 2 here and stays in force; a move in machine coordinates, as on other "
            "controls, does not exist: write the move alone");
    }
  }
  if (earlier) return;
  for (const mikroprog::Code* code : later)
    report.at(
        code->word->range,
        "`{}` is {} here, and the program uses no G52 and no G53; work offset {} of other controls would "
        "be `G{}`",
        code->function->code(), code->function->title, code->function->number - 53,
        code->function->number - 2);
}

} // namespace

DOTEK_LINT_RULE(suf_stored_shift){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
