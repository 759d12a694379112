#include "ir/Interval.h"
#include "lint/MacroNames.h"

namespace dotek::lint::rule {
namespace {

ir::Interval intervalOf(const gibbs::Expression& expression) {
  if (const auto number = plainNumber(expression)) return {*number, *number};
  if (const auto* inner = std::get_if<gibbs::Bracketed>(&expression.node)) return intervalOf(*inner->inner);
  if (const auto* unary = std::get_if<gibbs::Unary>(&expression.node)) {
    const ir::Interval of = intervalOf(*unary->operand);
    return unary->op == gibbs::UnaryOperator::Minus ? ir::negated(of) : of;
  }
  if (const auto* call = std::get_if<gibbs::FunctionCall>(&expression.node)) {
    if (call->arguments.size() != 1) return {};
    const std::string name = gibbs::foldCase(call->name.text);
    if (name == "ABS") return ir::absolute(intervalOf(*call->arguments.front()));
    if (name == "SQRT" || name == "SQR") return {0, ir::Interval::kNone};
    if (name == "SIN" || name == "COS") return {-1, 1};
    return {};
  }
  const auto* binary = std::get_if<gibbs::Binary>(&expression.node);
  if (binary == nullptr) return {};
  const ir::Interval left = intervalOf(*binary->left), right = intervalOf(*binary->right);
  switch (binary->op) {
  case gibbs::BinaryOperator::Add: return ir::sum(left, right);
  case gibbs::BinaryOperator::Subtract: return ir::sum(left, ir::negated(right));
  case gibbs::BinaryOperator::Multiply: return ir::product(left, right);
  case gibbs::BinaryOperator::Divide:
    if (right.low != right.high || right.low == 0) return {};
    return ir::product(left, {1 / right.low, 1 / right.low});
  }
  return {};
}

// Whether it holds for all values; nothing: it depends on them.
std::optional<bool> decided(const gibbs::Comparison& comparison) {
  const ir::Interval left = intervalOf(*comparison.left), right = intervalOf(*comparison.right);
  // Two numbers are a switch that somebody put there.
  if (readsOf(*comparison.left).empty() && readsOf(*comparison.right).empty()) return std::nullopt;
  const auto turned = [](std::optional<bool> one) { return one ? std::optional(!*one) : one; };
  std::optional<bool> out;
  switch (comparison.relation) {
  case gibbs::Relation::Less: out = ir::alwaysLess(left, right); break;
  case gibbs::Relation::GreaterEqual: out = turned(ir::alwaysLess(left, right)); break;
  case gibbs::Relation::LessEqual: out = ir::alwaysAtMost(left, right); break;
  case gibbs::Relation::Greater: out = turned(ir::alwaysAtMost(left, right)); break;
  case gibbs::Relation::Equal: out = ir::alwaysEqual(left, right); break;
  case gibbs::Relation::NotEqual: out = turned(ir::alwaysEqual(left, right)); break;
  }
  return comparison.nots.size() % 2 == 0 ? out : turned(out);
}

// `code = 2` after the THEN; nullptr: something else.
const gibbs::Assignment* codeSet(const gibbs::Statement& statement) {
  const auto* branch = std::get_if<gibbs::If>(&statement.node);
  if (branch == nullptr || !branch->then) return nullptr;
  const auto* assign = std::get_if<gibbs::Assignment>(&branch->then->node);
  return assign != nullptr && assign->value && plainNumber(*assign->value) ? assign : nullptr;
}

// The MESSAGE that is shown for the code that this alone sets; nullptr: there is none, or it comes otherwise.
const gibbs::Statement* messageOf(const gibbs::Assignment& code, const gibbs::Macro& macro) {
  const std::string name = gibbs::foldCase(code.target.name.text);
  const double value = *plainNumber(*code.value);
  const gibbs::Statement* out = nullptr;
  bool elsewhere = false;
  eachStatement(macro, [&](const gibbs::Statement& statement) {
    const auto* assign = std::get_if<gibbs::Assignment>(&statement.node);
    if (assign != nullptr && assign != &code && gibbs::foldCase(assign->target.name.text) == name) {
      const auto other = assign->value ? plainNumber(*assign->value) : std::nullopt;
      elsewhere = elsewhere || !other || *other == value;
    }
    const gibbs::Comparison* comparison = onlyComparison(statement);
    if (comparison == nullptr || comparison->relation != gibbs::Relation::Equal ||
        commandName(statement) != "MESSAGE")
      return;
    const gibbs::Name* left = plainName(*comparison->left);
    const auto right = plainNumber(*comparison->right);
    if (left != nullptr && gibbs::foldCase(left->text) == name && right == value) out = &statement;
  });
  return elsewhere ? nullptr : out;
}

void checkMacro(const gibbs::Macro& macro, Report& report) {
  eachStatement(macro, [&](const gibbs::Statement& statement) {
    const gibbs::Comparison* comparison = onlyComparison(statement);
    const auto always = comparison == nullptr ? std::nullopt : decided(*comparison);
    if (!always) return;
    Diagnostic& found = report.at(
        comparison->range,
        "this condition {} holds, whatever the values are, so it checks nothing{}; compare with the bound "
        "that is meant",
        *always ? "always" : "never", *always ? "" : ": what it is to refuse goes to the machine");
    const gibbs::Assignment* code = *always ? nullptr : codeSet(statement);
    const gibbs::Statement* message = code == nullptr ? nullptr : messageOf(*code, macro);
    if (message != nullptr) found.note(message->range, "this message is never shown");
  });
}

void check(const Project& project, Report& report) {
  for (const gibbs::Macro* macro : project.allMacros())
    checkMacro(*macro, report);
}

} // namespace

DOTEK_LINT_RULE(check_never_fails){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
