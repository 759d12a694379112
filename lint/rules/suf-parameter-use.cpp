#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kLastParameter = 99; // those of listings are P1 to P90

void check(const Project& project, Report& report) {
  for (const mikroprog::Reading* reading : project.sufPrograms) {
    for (const mikroprog::Line& line : reading->program.lines) {
      for (const mikroprog::Word& word : line.words)
        if (word.value.parameter && word.address != 'F')
          report.at(word.range, "a parameter after {} is not known to be legal (Q11)", word.address);
      const auto& set = line.assignment;
      if (set && set->parameter > kLastParameter)
        report.at(set->range, "no source shows a parameter above P{}: P{} may be refused (Q16)",
                  kLastParameter, set->parameter);
      if (set && (set->terms.size() > 1 || set->terms.front().value.parameter))
        report.at(set->range, "a parameter that is not set to a number is not known to be legal (Q10)");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(suf_parameter_use){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
