#include "lint/SufPrograms.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const mikroprog::Reading* reading : project.sufPrograms) {
    for (const mikroprog::Line& line : reading->program.lines) {
      const std::string_view bytes = reading->sources.text(line.range);
      const auto odd = std::find_if(bytes.begin(), bytes.end(),
                                    [](char c) { return static_cast<unsigned char>(c) > 126; });
      if (odd == bytes.end()) continue;
      const auto from = line.range.begin + static_cast<std::uint32_t>(odd - bytes.begin());
      report.at({line.range.file, from, from + 1},
                "a character outside ASCII; the control may show another one");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(suf_non_ascii){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
