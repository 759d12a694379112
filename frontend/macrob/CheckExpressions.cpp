// What the control can calculate and compare.
#include "frontend/macrob/CheckParts.h"
#include "frontend/macrob/Format.h"
#include "frontend/macrob/Walk.h"
#include "support/messages/MacroB.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace dotek::frontend::macrob {
namespace {

bool isWhole(double value) {
  return value == std::floor(value);
}

// The value where it is the same in every run; nullopt: it depends on variables.
std::optional<double> constant(const Expression& expression) {
  if (const auto* number = std::get_if<nc::Number>(&expression.node)) return number->value;
  if (const auto* negated = std::get_if<nc::Negated>(&expression.node)) {
    const auto value = constant(*negated->operand);
    return value ? std::optional(-*value) : std::nullopt;
  }
  const auto* operation = std::get_if<nc::Operation>(&expression.node);
  if (operation == nullptr) return std::nullopt;
  const auto left = constant(*operation->left);
  const auto right = constant(*operation->right);
  // Nothing is left of a byte behind AND 0.
  if ((operation->op == "AND" || operation->op == "*") && (left == 0 || right == 0)) return 0;
  if (!left || !right) return std::nullopt;
  if (operation->op == "+") return *left + *right;
  if (operation->op == "-") return *left - *right;
  if (operation->op == "*") return *left * *right;
  return std::nullopt;
}

bool hasVariable(const Expression& expression) {
  bool found = false;
  walk(expression, [&](const Expression& part, bool) {
    found = found || std::holds_alternative<nc::VariableRef>(part.node);
  });
  return found;
}

bool holds(const std::string& op, double left, double right) {
  if (op == "EQ") return left == right;
  if (op == "NE") return left != right;
  if (op == "GT") return left > right;
  if (op == "GE") return left >= right;
  if (op == "LT") return left < right;
  return left <= right;
}

bool isRounding(const std::string& name) {
  return name == "ROUND" || name == "FIX" || name == "FUP" || name == "BIN" || name == "BCD";
}

// The value is a binary approximation: a quotient, a function of angles, a root. `literals`: a product or sum
// with decimals counts as well.
bool isApproximate(const Expression& expression, bool literals) {
  if (const auto* call = std::get_if<nc::FunctionCall>(&expression.node)) {
    if (isRounding(call->name)) return false;
    if (call->name == "ABS") return isApproximate(*call->arguments.front(), literals);
    return call->name != "ADP";
  }
  if (const auto* negated = std::get_if<nc::Negated>(&expression.node))
    return isApproximate(*negated->operand, literals);
  const auto* operation = std::get_if<nc::Operation>(&expression.node);
  if (operation == nullptr) return false;
  if (operation->op == "/") return true;
  if (operation->op.size() > 1) return false; // AND, OR, XOR, MOD take whole numbers
  const auto fraction = [](const Expression& side) {
    const auto* number = std::get_if<nc::Number>(&side.node);
    return number != nullptr && !isWhole(number->value);
  };
  if (literals && (fraction(*operation->left) || fraction(*operation->right))) return true;
  return isApproximate(*operation->left, literals) || isApproximate(*operation->right, literals);
}

class ExpressionCheck {
public:
  ExpressionCheck(const Program& program, const CheckContext& context)
      : program_(program), context_(context) {}

  void run() {
    for (const Block& block : program_.blocks)
      if (const nc::Assignment* assignment = assignmentOf(block)) counters(*assignment);
    for (const Block& block : program_.blocks) {
      if (!std::holds_alternative<Unread>(block.body)) depth(block);
      walk(block, [&](const Expression& expression, bool) {
        function(expression);
        digits(expression);
      });
      if (const Condition* condition = conditionOf(block)) {
        joined(*condition, true);
        compare(*condition);
      }
      if (const auto* branch = std::get_if<If>(&block.body)) then(*branch);
    }
  }

private:
  const stdlib::Control* control() const { return context_.control; }

  // ---- brackets

  // Counted in the text: the tree does not know which pairs belong to functions.
  void depth(const Block& block) {
    const std::uint32_t most = control() != nullptr ? control()->bracketDepth : 5;
    const std::string_view text = context_.sources.text(block.range);
    // The pair of the condition itself is not counted: no source says that it is.
    std::uint32_t open = 0;
    const bool condition = conditionOf(block) != nullptr;
    if (std::holds_alternative<Print>(block.body) || std::holds_alternative<SetNames>(block.body)) return;
    bool inComment = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      inComment = inComment || c == '(';
      if (c == ')') inComment = false;
      if (inComment) continue;
      if (c == ']' && open > 0) --open;
      if (c != '[' || ++open != most + (condition ? 2 : 1)) continue;
      const auto place = static_cast<std::uint32_t>(block.range.begin + i);
      context_.report<diag::BracketsTooDeep>({block.range.file, place, place + 1}, most);
      return;
    }
  }

  // Zeros before the first digit count as well, `.5` has one digit.
  void digits(const Expression& expression) {
    const auto* number = std::get_if<nc::Number>(&expression.node);
    if (number == nullptr || control() == nullptr) return;
    const auto count = std::count_if(number->digits.begin(), number->digits.end(),
                                     [](char c) { return c >= '0' && c <= '9'; });
    if (count > static_cast<std::ptrdiff_t>(control()->digits))
      context_.report<diag::NumberDigits>(expression.range, count, control()->title, control()->digits);
  }

  // ---- functions

  void function(const Expression& expression) {
    if (const auto* operation = std::get_if<nc::Operation>(&expression.node)) {
      if (operation->op.size() > 1) known(operation->op, operation->op, expression.range);
      return;
    }
    const auto* call = std::get_if<nc::FunctionCall>(&expression.node);
    if (call == nullptr) return;
    if (known(call->name, call->name, expression.range) && call->name == "ATAN") {
      const char* form = call->arguments.size() == 1 ? "ATAN[y]" : call->comma ? "ATAN[y,x]" : "ATAN[y]/[x]";
      known(form, form, expression.range);
    }
    if (call->bare && (control() == nullptr || !control()->bareFunctions)) {
      const SourceRange argument = call->arguments.front()->range;
      context_.report<diag::FunctionWithoutBrackets>(expression.range, call->name).fix =
          Fix{Fix::Applicability::Display,
              "write the brackets",
              {{{argument.file, argument.begin, argument.begin}, "["},
               {{argument.file, argument.end, argument.end}, "]"}}};
    }
    if (call->name == "FIX" && isApproximate(*call->arguments.front(), true) &&
        !halved(*call->arguments.front()))
      context_.report<diag::FixOfComputed>(expression.range);
  }

  bool known(const std::string& key, const std::string& shown, SourceRange range) {
    if (control() == nullptr || control()->functions.contains(key)) return true;
    if (told_.insert(key).second) context_.report<diag::FunctionUnknownHere>(range, shown, control()->title);
    return false;
  }

  // FIX[#1/2] tells even from odd: halves are exact.
  static bool halved(const Expression& expression) {
    const auto* operation = std::get_if<nc::Operation>(&expression.node);
    if (operation == nullptr || operation->op != "/") return false;
    const auto divisor = constant(*operation->right);
    return divisor && (*divisor == 2 || *divisor == 4 || *divisor == 8) && variableNumber(*operation->left);
  }

  // ---- conditions

  void joined(const Condition& condition, bool outer) {
    const auto* both = std::get_if<JoinedConditions>(&condition.node);
    if (both == nullptr) return;
    if (outer && control() != nullptr && !control()->joinedConditions)
      context_.report<diag::JoinedUnknownHere>(condition.range, both->op, control()->title);
    joined(*both->left, false);
    joined(*both->right, false);
  }

  void compare(const Condition& condition) {
    if (const auto* both = std::get_if<JoinedConditions>(&condition.node)) {
      compare(*both->left);
      compare(*both->right);
      return;
    }
    const auto& comparison = std::get<Comparison>(condition.node);
    const auto left = constant(*comparison.left);
    const auto right = constant(*comparison.right);
    const bool variables = hasVariable(*comparison.left) || hasVariable(*comparison.right);
    // `WHILE[1EQ1]` is meant so.
    if (variables && left && right) {
      const bool always = holds(comparison.op, *left, *right);
      context_.report<diag::ConstantCondition>(condition.range, always ? "always" : "never");
    } else if (variables && print(*comparison.left) == print(*comparison.right)) {
      context_.report<diag::ConstantCondition>(condition.range,
                                               holds(comparison.op, 0, 0) ? "always" : "never");
    } else if (comparison.op == "EQ" || comparison.op == "NE") {
      if (inexact(*comparison.left) || inexact(*comparison.right) ||
          counts(*comparison.left, *comparison.right) || counts(*comparison.right, *comparison.left))
        context_.report<diag::EqualityOfComputed>(condition.range, comparison.op);
    }
  }

  bool inexact(const Expression& side) const { return !constant(side) && isApproximate(side, true); }

  // A variable that grows in steps such as 0.1, compared with a number.
  bool counts(const Expression& side, const Expression& other) const {
    const auto number = variableNumber(side);
    return number && counters_.contains(*number) && constant(other);
  }

  void counters(const nc::Assignment& assignment) {
    const auto* target = std::get_if<nc::Number>(&assignment.variable->node);
    const auto* sum = std::get_if<nc::Operation>(&assignment.value->node);
    if (target == nullptr || sum == nullptr || (sum->op != "+" && sum->op != "-")) return;
    const auto from = variableNumber(*sum->left);
    const auto step = constant(*sum->right);
    if (!from || *from != target->value || !step) return;
    // Eighths and the like are exact.
    if (!isWhole(*step * 8)) counters_.insert(*from);
  }

  void then(const If& branch) {
    if (!branch.then || control() == nullptr) return;
    if (!control()->ifThen) {
      context_.report<diag::ThenUnknownHere>(branch.range, control()->title);
      return;
    }
    if (std::holds_alternative<Goto>(branch.statement) && !control()->thenGoto) {
      const SourceRange range{branch.range.file, branch.condition->range.end, branch.range.end};
      context_.report<diag::ThenGoto>(range);
    }
  }

  const Program& program_;
  const CheckContext& context_;
  std::set<std::string> told_;
  std::set<std::uint32_t> counters_;
};

} // namespace

void checkExpressions(const Program& program, const CheckContext& context) {
  ExpressionCheck(program, context).run();
}

} // namespace dotek::frontend::macrob
