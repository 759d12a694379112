#include "lint/MacroNames.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

bool isTyped(const gibbs::Control& control, const std::string& kind) {
  return control.box && (kind == "INPUT" || kind == "OK" || kind == "CANCEL" || kind == "CHECK");
}

struct Placed {
  const gibbs::Control* control = nullptr;
  std::string kind; // upper case
};

bool overlap(const gibbs::Box& a, const gibbs::Box& b) {
  return a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height &&
         b.top < a.top + a.height;
}

void check(const Project& project, Report& report) {
  for (const gibbs::Dialog* dialog : project.allDialogs()) {
    std::vector<Placed> placed;
    for (const gibbs::Control& control : dialog->controls) {
      const std::string kind = gibbs::foldCase(control.kind.text);
      if (!isTyped(control, kind)) continue;
      const auto other = std::find_if(placed.begin(), placed.end(), [&](const Placed& one) {
        // A second OK is reported as such.
        return (kind == "INPUT" || kind != one.kind) && overlap(*one.control->box, *control.box);
      });
      const gibbs::Control* before = other == placed.end() ? nullptr : other->control;
      placed.push_back({&control, kind});
      if (before == nullptr) continue;
      report
          .at(control.range,
              "this lies on the place of another control; one of the two cannot be used; move it")
          .note(before->range, "the other one");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(inputs_overlap){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
