#include "ir/Print.h"

#include "ir/Names.h"
#include "ir/PrintStatement.h"

#include <string_view>

namespace dotek::ir {
namespace {

class Printer {
public:
  Printer(const Cycle& cycle, const SourceMap* sources) : cycle_(cycle), names_(cycle), sources_(sources) {}

  std::string run() {
    line(0, "cycle " + nameText(cycle_.name) + (cycle_.title.empty() ? "" : " " + quoted(cycle_.title)),
         cycle_.range, "");
    if (!cycle_.measurementStated) line(2, "measurement not stated", {}, "");
    for (VariableId id = 0; id < cycle_.variables.size(); ++id)
      declare(id);
    declareLabels();
    list("checks", cycle_.checks);
    list("body", cycle_.body);
    return std::move(out_);
  }

private:
  void line(std::size_t indent, std::string text, SourceRange range, const std::string& reason) {
    text.insert(0, indent, ' ');
    out_ += withOrigin(std::move(text), range, reason, sources_) + "\n";
  }

  void declare(VariableId id) {
    static constexpr std::string_view kRoles[] = {"parameter", "host", "local"};
    const Variable& variable = cycle_.variables[id];
    const std::string name = nameText(variable.name);
    std::string text(kRoles[static_cast<std::size_t>(variable.role)]);
    text += " " + name;
    if (names_.variable(id) != name) text += " as " + names_.variable(id);
    text += " ";
    text += kindName(variable.kind);
    if (!variable.unit.empty()) text += " in " + nameText(variable.unit);
    if (variable.optional) text += " optional";
    if (variable.defaultValue)
      text += " = " + constantText(*variable.defaultValue, variable.defaultDigits);
    else if (!variable.defaultDigits.empty())
      text += " = written " + quoted(variable.defaultDigits);
    if (!variable.meaning.empty()) text += " " + quoted(variable.meaning);
    line(2, std::move(text), variable.range, "");
  }

  // Labels are numbered in the order in which they are placed; what differs is declared.
  void declareLabels() {
    LabelId next = 0;
    for (const auto* list : {&cycle_.checks, &cycle_.body})
      for (const CycleStatement& statement : *list)
        if (const auto* label = std::get_if<Label>(&statement.node))
          next = label->label == next ? next + 1 : static_cast<LabelId>(cycle_.labels.size() + 1);
    if (next == cycle_.labels.size()) return;
    std::string text = "labels";
    for (LabelId id = 0; id < cycle_.labels.size(); ++id)
      text += " " + names_.label(id);
    line(2, std::move(text), {}, "");
  }

  void list(const char* title, const std::vector<CycleStatement>& statements) {
    line(2, title, {}, "");
    for (const CycleStatement& statement : statements) {
      const bool label = std::holds_alternative<Label>(statement.node);
      line(label ? 2 : 4, statementText(statement, names_), statement.origin.range(),
           statement.origin.reason);
    }
  }

  const Cycle& cycle_;
  Names names_;
  const SourceMap* sources_;
  std::string out_;
};

} // namespace

std::string print(const Module& module, const SourceMap* sources) {
  std::string out = module.sourceUnit == LengthUnit::Inch ? "units inch\n" : "units mm\n";
  for (const Cycle& cycle : module.cycles)
    out += "\n" + Printer(cycle, sources).run();
  return out;
}

} // namespace dotek::ir
