#include "frontend/gibbs/Labels.h"
#include "lint/MacroNames.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const gibbs::Dialog* dialog : project.allDialogs()) {
    const gibbs::Control* window = nullptr;
    for (const gibbs::Control& control : dialog->controls)
      if (gibbs::foldCase(control.kind.text) == "DIALOG" && control.box && window == nullptr)
        window = &control;
    if (window == nullptr) continue;
    for (const gibbs::Control& control : dialog->controls) {
      const std::string kind = gibbs::foldCase(control.kind.text);
      if (!control.box || &control == window || kind == "DIALOG") continue;
      const gibbs::Box box = gibbs::closedBox(*dialog, control);
      // The box of a label is larger than its text more often than not; where it begins, the text begins.
      if (kind == "LABEL" && box.left < window->box->width && box.top < window->box->height) continue;
      const long right = long{box.left} + box.width;
      const long bottom = long{box.top} + box.height;
      if (box.left >= 0 && box.top >= 0 && right <= window->box->width && bottom <= window->box->height)
        continue;
      report
          .at(control.range,
              "{} reaches from {},{} to {},{}, the window is {} wide and {} high; what lies outside is "
              "not shown; move it, or make the window larger",
              kind, box.left, box.top, right, bottom, window->box->width, window->box->height)
          .note(window->range, "the window");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(control_outside_window){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
