#include "frontend/gibbs/Labels.h"
#include "lint/MacroNames.h"

#include <algorithm>
#include <cctype>

namespace dotek::lint::rule {
namespace {

constexpr std::size_t kLongest = 3;

bool isShortName(const std::string& text) {
  return !text.empty() && text.size() <= kLongest &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

void check(const Project& project, Report& report) {
  for (const gibbs::Dialog* dialog : project.allDialogs()) {
    const std::vector<gibbs::InputLabel> labels = gibbs::inputLabels(*dialog);
    for (const gibbs::InputLabel& label : labels) {
      if (label.name.empty() || !label.nameRange.hasPlace()) continue;
      const std::string shown = gibbs::foldCase(label.name);
      const std::string bound = gibbs::foldCase(label.variable.text);
      // A longer label is a text, unless it is the name of another input.
      const bool other = shown != bound && std::any_of(labels.begin(), labels.end(), [&](const auto& one) {
                           return gibbs::foldCase(one.variable.text) == shown;
                         });
      if (!other && (!isShortName(label.name) || !isShortName(label.variable.text))) continue;
      // `X` beside `X1`, or `a` beside `Ka`, is one name with a mark.
      if (!other && (shown.find(bound) != std::string::npos || bound.find(shown) != std::string::npos))
        continue;
      report
          .at(label.variable.range,
              "the label beside this input says `{}`, the input writes `{}`; who reads the dialog looks for "
              "`{}` in "
              "the macro and in the post; name them alike",
              label.name, label.variable.text, label.name)
          .note(label.nameRange, "the label");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(label_names_other){
    .severity = Severity::Note,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
