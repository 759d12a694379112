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
    for (const gibbs::InputLabel& label : gibbs::inputLabels(*dialog)) {
      if (!isShortName(label.name) || !isShortName(label.variable.text) || !label.nameRange.hasPlace())
        continue;
      const std::string shown = gibbs::foldCase(label.name);
      const std::string bound = gibbs::foldCase(label.variable.text);
      // `X` beside `X1`, or `a` beside `Ka`, is one name with a mark.
      if (shown.find(bound) != std::string::npos || bound.find(shown) != std::string::npos) continue;
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
    .explanation =
        "A dialog shows the name of a field in front of its input. Where it shows another one, the post is "
        "easily written with the name that is shown.",
    .check = check,
};

} // namespace dotek::lint::rule
