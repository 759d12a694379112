#include "lint/PathCommands.h"

#include "frontend/gibbs/Walk.h"

namespace dotek::lint {
namespace {

void take(const gibbs::Statement& statement, const gibbs::If* condition, std::vector<PathCommand>& out) {
  const auto* command = std::get_if<gibbs::Command>(&statement.node);
  if (command == nullptr || gibbs::foldCase(command->name.text) != "ADD_CUSTOM_DRILL_CYCLE_PATH") return;
  if (command->arguments.empty()) return;
  const gibbs::Name* kind = plainName(*command->arguments.front());
  const std::string word = kind == nullptr ? "" : gibbs::foldCase(kind->text);
  PathCommand path{&statement, condition, {}};
  if (word == "FEED" && command->arguments.size() == 4) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      path.axes[axis] = command->arguments[axis + 1].get();
  } else if (command->arguments.size() == 2 && word.size() == 6 && word.starts_with("FEED_") &&
             word[5] >= 'X' && word[5] <= 'Z') {
    path.axes[static_cast<std::size_t>(word[5] - 'X')] = command->arguments[1].get();
  }
  out.push_back(path);
}

void addTerms(const gibbs::Expression& expression, bool negative, std::vector<Term>& out) {
  if (const auto* bracketed = std::get_if<gibbs::Bracketed>(&expression.node))
    return addTerms(*bracketed->inner, negative, out);
  if (const auto* unary = std::get_if<gibbs::Unary>(&expression.node))
    return addTerms(*unary->operand, negative != (unary->op == gibbs::UnaryOperator::Minus), out);
  const auto* binary = std::get_if<gibbs::Binary>(&expression.node);
  if (binary != nullptr &&
      (binary->op == gibbs::BinaryOperator::Add || binary->op == gibbs::BinaryOperator::Subtract)) {
    addTerms(*binary->left, negative, out);
    return addTerms(*binary->right, negative != (binary->op == gibbs::BinaryOperator::Subtract), out);
  }
  const gibbs::Name* name = plainName(expression);
  out.push_back({name == nullptr ? "" : gibbs::foldCase(name->text), negative});
}

} // namespace

std::vector<PathCommand> pathCommands(const gibbs::Macro& toolPath) {
  std::vector<PathCommand> out;
  std::set<const gibbs::Statement*> below; // of an IF of one line
  eachStatement(toolPath, [&](const gibbs::Statement& statement) {
    const auto* branch = std::get_if<gibbs::If>(&statement.node);
    if (branch != nullptr && branch->then) {
      below.insert(branch->then.get());
      take(*branch->then, branch, out);
    } else if (!below.contains(&statement)) {
      take(statement, nullptr, out);
    }
  });
  return out;
}

std::vector<Term> termsOf(const gibbs::Expression& expression) {
  std::vector<Term> out;
  addTerms(expression, false, out);
  return out;
}

int signOf(const gibbs::Expression& expression, const std::string& name) {
  for (const Term& term : termsOf(expression))
    if (term.name == name) return term.negative ? -1 : 1;
  return 0;
}

std::set<std::string> drillData(const gibbs::Macro& macro, const std::string& parameter) {
  std::set<std::string> out;
  eachStatement(macro, [&](const gibbs::Statement& statement) {
    const auto* command = std::get_if<gibbs::Command>(&statement.node);
    if (command == nullptr || gibbs::foldCase(command->name.text) != "GET_CUSTOM_DRILL_CYCLE_DATA") return;
    if (command->arguments.size() != 2) return;
    const gibbs::Name* what = plainName(*command->arguments[0]);
    const gibbs::Name* into = plainName(*command->arguments[1]);
    if (what != nullptr && into != nullptr && gibbs::foldCase(what->text) == parameter)
      out.insert(gibbs::foldCase(into->text));
  });
  return out;
}

} // namespace dotek::lint
