#include "frontend/gibbs/Labels.h"
#include "lint/MacroNames.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace dotek::lint::rule {
namespace {

constexpr std::size_t kLongest = 3;

bool isShortName(const std::string& text) {
  return !text.empty() && text.size() <= kLongest &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

// The label is the name of another input than the one beside it.
bool isOther(const gibbs::InputLabel& label, const std::vector<gibbs::InputLabel>& labels) {
  const std::string shown = gibbs::foldCase(label.name);
  return shown != gibbs::foldCase(label.variable.text) &&
         std::any_of(labels.begin(), labels.end(),
                     [&](const auto& one) { return gibbs::foldCase(one.variable.text) == shown; });
}

// Two labels of one text beside two inputs. Short ones, as of the axes of several points, may repeat.
void checkRepeated(const std::vector<gibbs::InputLabel>& labels, Report& report) {
  std::map<std::string, const gibbs::InputLabel*> seen;
  for (const gibbs::InputLabel& label : labels) {
    if (label.name.size() <= kLongest || !label.nameRange.hasPlace()) continue;
    const auto [first, fresh] = seen.try_emplace(label.name, &label);
    const gibbs::InputLabel& other = *first->second;
    if (fresh || other.nameRange == label.nameRange || isOther(label, labels) ||
        gibbs::foldCase(other.variable.text) == gibbs::foldCase(label.variable.text))
      continue;
    report
        .at(label.variable.range,
            "the label beside this input says the same as the one beside `{}`; nobody can tell which of the "
            "two "
            "is meant; say what each is",
            other.variable.text)
        .note(label.nameRange, "the label")
        .note(other.nameRange, "the other one");
  }
}

void check(const Project& project, Report& report) {
  for (const gibbs::Dialog* dialog : project.allDialogs()) {
    const std::vector<gibbs::InputLabel> labels = gibbs::inputLabels(*dialog);
    checkRepeated(labels, report);
    for (const gibbs::InputLabel& label : labels) {
      if (label.name.empty() || !label.nameRange.hasPlace()) continue;
      const std::string shown = gibbs::foldCase(label.name);
      const std::string bound = gibbs::foldCase(label.variable.text);
      // A longer label is a text, unless it is the name of another input.
      const bool other = isOther(label, labels);
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
