#include "frontend/macrob/Calls.h"
#include "lint/NcProgram.h"
#include "lint/Turning.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

using stdlib::Function;

void check(const NcProgram& nc, Report& report) {
  if (!isForLathe(nc.project)) return;
  const auto count = [&](double number) {
    return std::count_if(nc.program.labels.begin(), nc.program.labels.end(), [&](const auto& label) {
      return number > 0 && static_cast<double>(label.number) == number;
    });
  };
  for (const ir::ProgramStatement& statement : nc.program.body) {
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    const ir::Word* cycle = nullptr;
    for (const Function one : {Function::ContourFinish, Function::ContourRough})
      if (const ir::Word* word = wordOf(*block, *nc.project.control, one)) cycle = word;
    if (cycle == nullptr) continue;
    for (const char letter : {'P', 'Q'}) {
      const ir::Word* word = firstWord(*block, std::string_view(&letter, 1));
      const double* number = word == nullptr ? nullptr : ir::constantValue(word->value);
      if (number == nullptr) continue;
      const auto found = count(*number);
      if (found == 0)
        report.at(
            word->range,
            "the program has no block N{}, at which the contour of this cycle {}; the control stops with an "
            "alarm; number the block, or correct {}",
            numberText(*number), letter == 'P' ? "begins" : "ends", letter);
      else if (found > 1)
        report.at(word->range,
                  "several blocks of the program are N{}, at one of which the contour of this cycle {}; "
                  "number them "
                  "differently",
                  numberText(*number), letter == 'P' ? "begins" : "ends");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(contour_block_missing){
    .severity = Severity::Error,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
