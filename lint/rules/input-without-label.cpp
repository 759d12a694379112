#include "frontend/gibbs/Labels.h"
#include "lint/MacroNames.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const gibbs::Dialog* dialog : project.allDialogs()) {
    if (dialog->hasErrorNodes) continue;
    const std::vector<gibbs::InputLabel> labels = gibbs::inputLabels(*dialog);
    const gibbs::InputLabel* named = nullptr;
    for (const gibbs::InputLabel& label : labels)
      if (!label.name.empty()) named = &label;
    if (named == nullptr) continue;
    // Text after the inputs: of all but one.
    const gibbs::InputLabel* bare = nullptr;
    std::size_t without = 0;
    for (const gibbs::InputLabel& label : labels) {
      without += label.meaning.empty() ? 1 : 0;
      if (label.meaning.empty()) bare = &label;
    }
    if (without == 1 && labels.size() > 2 && !bare->name.empty())
      report.at(bare->input->range,
                "after each other input of the dialog is what it means, and after that of `{}` "
                "nothing; write "
                "it",
                bare->variable.text);
    for (const gibbs::InputLabel& label : labels)
      if (label.name.empty() && label.meaning.empty() && gibbs::foldCase(label.input->kind.text) == "INPUT")
        report
            .at(label.input->range,
                "no label is before the input of `{}`; the user does not see what belongs into it; write "
                "one",
                label.variable.text)
            .note(named->input->range, "another input has one");
  }
}

} // namespace

DOTEK_LINT_RULE(input_without_label){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
