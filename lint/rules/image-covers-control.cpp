#include "lint/MacroNames.h"

namespace dotek::lint::rule {
namespace {

constexpr std::size_t kShown = 3; // notes

bool meet(const gibbs::Box& a, const gibbs::Box& b) {
  return a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height &&
         b.top < a.top + a.height;
}

void check(const Project& project, Report& report) {
  for (const gibbs::Dialog* dialog : project.allDialogs()) {
    for (const gibbs::Control& image : dialog->controls) {
      if (gibbs::foldCase(image.kind.text) != "IMAGE" || !image.box) continue;
      std::vector<const gibbs::Control*> covered;
      for (const gibbs::Control& control : dialog->controls) {
        const std::string kind = gibbs::foldCase(control.kind.text);
        if (!control.box || kind == "DIALOG" || kind == "FRAME" || kind == "IMAGE") continue;
        if (meet(*image.box, *control.box)) covered.push_back(&control);
      }
      if (covered.empty()) continue;
      Diagnostic& finding = report.at(
          image.range,
          "the image reaches down to {} and covers {} {}; which of them GibbsCAM draws on top is not "
          "known; move one of them",
          image.box->top + image.box->height, covered.size(), covered.size() == 1 ? "control" : "controls");
      for (std::size_t i = 0; i < covered.size() && i < kShown; ++i)
        finding.note(covered[i]->range, "covered");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(image_covers_control){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
