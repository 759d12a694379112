#include "frontend/gibbs/Labels.h"
#include "lint/MacroNames.h"

#include <map>

namespace dotek::lint::rule {
namespace {

constexpr std::size_t kLeast = 3; // inputs of a column

void check(const Project& project, Report& report) {
  for (const gibbs::Dialog* dialog : project.allDialogs()) {
    // Labels of the inputs of one column, by where they begin.
    std::map<int, std::map<int, std::vector<const gibbs::Control*>>> columns;
    for (const gibbs::InputLabel& label : gibbs::inputLabels(*dialog)) {
      if (!label.nameRange.hasPlace() || !label.input->box) continue;
      for (const gibbs::Control& control : dialog->controls)
        if (control.box && control.range.begin <= label.nameRange.begin &&
            label.nameRange.end <= control.range.end)
          columns[label.input->box->left][control.box->left].push_back(&control);
    }
    for (const auto& [input, lefts] : columns) {
      if (lefts.size() != 2) continue;
      const auto& first = lefts.begin()->second;
      const auto& last = lefts.rbegin()->second;
      const auto& few = first.size() < last.size() ? first : last;
      const auto& many = first.size() < last.size() ? last : first;
      if (few.size() != 1 || many.size() + 1 < kLeast) continue;
      report
          .at(few.front()->range,
              "this label begins elsewhere than the others of its column, and may lie on its "
              "input; a digit of its place is easily doubled")
          .note(many.front()->range, "as this one");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(label_out_of_column){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
