#include "lint/MacroNames.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

bool isTyped(const gibbs::Control& control) {
  const std::string kind = gibbs::foldCase(control.kind.text);
  return control.box && (kind == "INPUT" || kind == "OK" || kind == "CANCEL" || kind == "CHECK");
}

bool overlap(const gibbs::Box& a, const gibbs::Box& b) {
  return a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height &&
         b.top < a.top + a.height;
}

void check(const Project& project, Report& report) {
  for (const gibbs::Dialog* dialog : project.allDialogs()) {
    for (std::size_t i = 0; i < dialog->controls.size(); ++i) {
      const gibbs::Control& control = dialog->controls[i];
      if (!isTyped(control)) continue;
      const auto before =
          std::find_if(dialog->controls.begin(), dialog->controls.begin() + static_cast<std::ptrdiff_t>(i),
                       [&](const gibbs::Control& other) {
                         // A second OK is reported as such.
                         const std::string kind = gibbs::foldCase(control.kind.text);
                         const bool twice = kind != "INPUT" && kind == gibbs::foldCase(other.kind.text);
                         return isTyped(other) && !twice && overlap(*other.box, *control.box);
                       });
      if (before == dialog->controls.begin() + static_cast<std::ptrdiff_t>(i)) continue;
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
