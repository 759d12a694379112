#include "lint/MacroNames.h"

#include <algorithm>
#include <array>

namespace dotek::lint::rule {
namespace {

constexpr std::array<std::string_view, 5> kKinds = {"LABEL", "INPUT", "OK", "CANCEL", "CHECK"};

void check(const Project& project, Report& report) {
  for (const gibbs::Dialog* dialog : project.allDialogs()) {
    for (const gibbs::Control& control : dialog->controls) {
      const std::string kind = gibbs::foldCase(control.kind.text);
      const bool placed = std::find(kKinds.begin(), kKinds.end(), kind) != kKinds.end();
      // Too few arguments are reported as such.
      if (!placed || control.box || control.arguments.size() < 4) continue;
      report.at(control.range,
                "left, top, width and height of this {} are not four numbers; one was lost, and the words "
                "after it "
                "are taken for it; write all four",
                kind);
    }
  }
}

} // namespace

DOTEK_LINT_RULE(control_without_place){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
