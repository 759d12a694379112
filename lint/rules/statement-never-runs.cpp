#include "lint/MacroNames.h"

namespace dotek::lint::rule {
namespace {

// Folded labels of the file.
std::set<std::string> labelsOf(const gibbs::Macro& macro) {
  std::set<std::string> out;
  for (const gibbs::Line& line : macro.lines)
    if (line.label) out.insert(gibbs::foldCase(line.label->name.text));
  return out;
}

void checkLines(const std::vector<gibbs::Line>& lines, const std::set<std::string>& labels, Report& report) {
  const gibbs::Statement* jump = nullptr;
  bool told = false;
  for (const gibbs::Line& line : lines) {
    if (line.label) jump = nullptr;
    if (!line.statement) continue;
    const auto& node = line.statement->node;
    const bool closes = std::holds_alternative<gibbs::Next>(node);
    if (jump != nullptr && !closes && !told) {
      report
          .at(line.statement->range,
              "no path leads to this line: the jump before it is always taken, and no label is "
              "between; take the jump out, or the line")
          .note(jump->range, "the jump");
      told = true;
    }
    const auto* go = std::get_if<gibbs::Goto>(&node);
    // A GOTO to nowhere is reported already.
    if (go != nullptr && labels.contains(gibbs::foldCase(go->label.text))) {
      if (jump == nullptr) told = false;
      jump = line.statement.get();
    } else if (closes) {
      jump = nullptr;
    }
    if (const auto* branch = std::get_if<gibbs::If>(&node)) {
      checkLines(branch->thenBlock, labels, report);
      checkLines(branch->elseBlock, labels, report);
    }
  }
}

void check(const Project& project, Report& report) {
  for (const gibbs::Macro* macro : project.allMacros())
    checkLines(macro->lines, labelsOf(*macro), report);
}

} // namespace

DOTEK_LINT_RULE(statement_never_runs){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
