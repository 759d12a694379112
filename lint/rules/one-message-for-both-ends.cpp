#include "lint/MacroNames.h"
#include "support/Decimal.h"

#include <map>
#include <tuple>

namespace dotek::lint::rule {
namespace {

struct End {
  const gibbs::Comparison* comparison = nullptr;
  bool upper = false;
};

// Variable and value of `code = 2`.
struct Code {
  std::string name;
  double value = 0;
  bool operator<(const Code& other) const {
    return std::tie(name, value) < std::tie(other.name, other.value);
  }
};

bool isUpper(gibbs::Relation relation) {
  return relation == gibbs::Relation::Greater || relation == gibbs::Relation::GreaterEqual;
}
bool isLower(gibbs::Relation relation) {
  return relation == gibbs::Relation::Less || relation == gibbs::Relation::LessEqual;
}

void checkMacro(const gibbs::Macro& macro, const Project& project, Report& report) {
  std::map<std::pair<Code, std::string>, std::vector<End>> ends; // by code and compared value
  std::map<Code, std::string> texts;
  eachStatement(macro, [&](const gibbs::Statement& statement) {
    const gibbs::Comparison* comparison = onlyComparison(statement);
    if (comparison == nullptr) return;
    const auto* branch = std::get_if<gibbs::If>(&statement.node);
    if (!branch->then) return;
    if (const auto* assign = std::get_if<gibbs::Assignment>(&branch->then->node)) {
      const auto value = assign->value ? plainNumber(*assign->value) : std::nullopt;
      const bool upper = isUpper(comparison->relation);
      if (value && (upper || isLower(comparison->relation)))
        ends[{{gibbs::foldCase(assign->target.name.text), *value}, squeezed(*comparison->left, project)}]
            .push_back({comparison, upper});
    }
    const auto* command = std::get_if<gibbs::Command>(&branch->then->node);
    if (command == nullptr || gibbs::foldCase(command->name.text) != "MESSAGE" || command->arguments.empty())
      return;
    const auto* text = std::get_if<gibbs::TextLiteral>(&command->arguments.front()->node);
    const gibbs::Name* name = plainName(*comparison->left);
    const auto value = plainNumber(*comparison->right);
    if (text != nullptr && name != nullptr && value && comparison->relation == gibbs::Relation::Equal)
      texts.emplace(Code{gibbs::foldCase(name->text), *value}, text->text);
  });
  for (const auto& [key, found] : ends) {
    const End* lower = nullptr;
    const End* upper = nullptr;
    for (const End& end : found)
      (end.upper ? upper : lower) = &end;
    const auto text = texts.find(key.first);
    if (lower == nullptr || upper == nullptr || text == texts.end()) continue;
    bool named = false; // a text that gives a bound serves both
    for (const End* end : {lower, upper})
      if (const auto bound = plainNumber(*end->comparison->right))
        named = named || text->second.find(numberText(*bound)) != std::string::npos;
    if (named) continue;
    report
        .at(upper->comparison->range,
            "a value that is too large gets the same message as one that is too small, and "
            "the text names no bound; the user looks for the wrong mistake; give each a "
            "message of its own")
        .note(lower->comparison->range, "the other bound");
  }
}

void check(const Project& project, Report& report) {
  for (const gibbs::Macro* macro : project.allMacros())
    checkMacro(*macro, project, report);
}

} // namespace

DOTEK_LINT_RULE(one_message_for_both_ends){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
