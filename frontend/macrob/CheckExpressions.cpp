// What the control can calculate and compare.
#include "frontend/macrob/Check.h"
#include "frontend/macrob/Constant.h"
#include "frontend/macrob/Format.h"
#include "frontend/macrob/Walk.h"
#include "ir/Interval.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace dotek::frontend::macrob {
namespace {

bool isWhole(double value) {
  return value == std::floor(value);
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
  if (operation->op == "/") {
    // Halves, quarters and eighths of an exact value are exact.
    const auto divisor = constantOf(*operation->right);
    if (divisor && (*divisor == 2 || *divisor == 4 || *divisor == 8))
      return isApproximate(*operation->left, literals);
    return true;
  }
  if (operation->op.size() > 1) return false; // AND, OR, XOR, MOD take whole numbers
  const auto fraction = [](const Expression& side) {
    const auto* number = std::get_if<nc::Number>(&side.node);
    return number != nullptr && !isWhole(number->value);
  };
  if (literals && (fraction(*operation->left) || fraction(*operation->right))) return true;
  return isApproximate(*operation->left, literals) || isApproximate(*operation->right, literals);
}

// FIX[#1/2] tells even from odd: halves are exact.
// Clocks and other states of the control are whole numbers, whose whole quotients come out so.
bool isHalved(const Expression& expression) {
  const auto* operation = std::get_if<nc::Operation>(&expression.node);
  if (operation == nullptr || operation->op != "/") return false;
  const auto divisor = constantOf(*operation->right);
  if (!divisor || isApproximate(*operation->left, true)) return false;
  constexpr std::uint32_t kFirstState = 1000;
  const bool state = variableNumber(*operation->left).value_or(0) >= kFirstState;
  return *divisor == 2 || *divisor == 4 || *divisor == 8 || (state && isWhole(*divisor));
}

// Whether a value is whole wherever it comes from: clocks, what is cut or rounded, sums and products of
// these.
class Wholes {
public:
  explicit Wholes(const Program& program) {
    for (const Block& block : program.blocks) {
      const nc::Assignment* assignment = assignmentOf(block);
      const auto* target =
          assignment == nullptr ? nullptr : std::get_if<nc::Number>(&assignment->variable->node);
      if (target != nullptr)
        set_[static_cast<std::uint32_t>(target->value)].push_back(assignment->value.get());
    }
  }

  bool holds(const Expression& value, int depth = 0) const {
    if (depth > 8) return false;
    if (const auto constant = constantOf(value)) return isWhole(*constant);
    if (const auto number = variableNumber(value)) {
      constexpr std::uint32_t kDate = 3011, kTime = 3012;
      if (*number == kDate || *number == kTime) return true;
      const auto found = set_.find(*number);
      return found != set_.end() &&
             std::all_of(found->second.begin(), found->second.end(),
                         [&](const Expression* one) { return holds(*one, depth + 1); });
    }
    if (const auto* call = std::get_if<nc::FunctionCall>(&value.node)) return isRounding(call->name);
    if (const auto* negated = std::get_if<nc::Negated>(&value.node))
      return holds(*negated->operand, depth + 1);
    const auto* operation = std::get_if<nc::Operation>(&value.node);
    return operation != nullptr && operation->op != "/" && holds(*operation->left, depth + 1) &&
           holds(*operation->right, depth + 1);
  }
  // A whole value by a whole number: where it comes out whole it does so exactly.
  bool divides(const Expression& value) const {
    const auto* operation = std::get_if<nc::Operation>(&value.node);
    return operation != nullptr && operation->op == "/" && holds(*operation->left) &&
           holds(*operation->right);
  }

private:
  std::map<std::uint32_t, std::vector<const Expression*>> set_;
};

bool isInexact(const Expression& side) {
  return !constantOf(side) && isApproximate(side, true);
}

// Variables that grow in steps such as 0.1. Eighths and the like are exact.
std::set<std::uint32_t> countersOf(const Program& program) {
  std::set<std::uint32_t> out;
  for (const Block& block : program.blocks) {
    const nc::Assignment* assignment = assignmentOf(block);
    if (assignment == nullptr) continue;
    const auto* target = std::get_if<nc::Number>(&assignment->variable->node);
    const auto* sum = std::get_if<nc::Operation>(&assignment->value->node);
    if (target == nullptr || sum == nullptr || (sum->op != "+" && sum->op != "-")) continue;
    const auto from = variableNumber(*sum->left);
    const auto step = constantOf(*sum->right);
    if (from && *from == target->value && step && !isWhole(*step * 8)) out.insert(*from);
  }
  return out;
}

// Between what the value lies. Of #0 the functions here make 0, which is within.
ir::Interval intervalOf(const Expression& expression) {
  if (const auto value = constantOf(expression)) return {*value, *value};
  if (const auto* negated = std::get_if<nc::Negated>(&expression.node))
    return ir::negated(intervalOf(*negated->operand));
  if (const auto* call = std::get_if<nc::FunctionCall>(&expression.node)) {
    if (call->arguments.empty()) return {};
    const ir::Interval inner = intervalOf(*call->arguments.front());
    if (call->name == "ABS") return ir::absolute(inner);
    if (call->name == "SQRT") return {0, ir::Interval::kNone};
    if (call->name == "SIN" || call->name == "COS") return {-1, 1};
    if (call->name == "FIX" && inner.low >= 0) return {0, inner.high};
    if (call->name == "FUP" && inner.low >= 0) return {inner.low, ir::Interval::kNone};
    return {};
  }
  const auto* operation = std::get_if<nc::Operation>(&expression.node);
  if (operation == nullptr) return {};
  const ir::Interval left = intervalOf(*operation->left), right = intervalOf(*operation->right);
  if (operation->op == "+") return ir::sum(left, right);
  if (operation->op == "-") return ir::sum(left, ir::negated(right));
  if (operation->op == "*") return ir::product(left, right);
  if (operation->op == "/" && right.low == right.high && right.low != 0)
    return ir::product(left, {1 / right.low, 1 / right.low});
  return {};
}

std::optional<bool> decided(const std::string& op, ir::Interval left, ir::Interval right) {
  if (left.any() && right.any()) return std::nullopt;
  const auto turned = [](std::optional<bool> one) { return one ? std::optional(!*one) : one; };
  if (op == "LT") return ir::alwaysLess(left, right);
  if (op == "GE") return turned(ir::alwaysLess(left, right));
  if (op == "LE") return ir::alwaysAtMost(left, right);
  if (op == "GT") return turned(ir::alwaysAtMost(left, right));
  if (op == "EQ") return ir::alwaysEqual(left, right);
  return turned(ir::alwaysEqual(left, right));
}

// Whether the comparison holds, where that is the same whatever the variables in it are. `WHILE[1EQ1]` is
// meant so.
std::optional<bool> alwaysSame(const Comparison& comparison) {
  if (!hasVariable(*comparison.left) && !hasVariable(*comparison.right)) return std::nullopt;
  const auto left = constantOf(*comparison.left);
  const auto right = constantOf(*comparison.right);
  if (left && right) return holds(comparison.op, *left, *right);
  if (print(*comparison.left) == print(*comparison.right)) return holds(comparison.op, 0, 0);
  return decided(comparison.op, intervalOf(*comparison.left), intervalOf(*comparison.right));
}

template <class Kind, class Visit> void eachPart(const CheckedProgram& input, const Visit& visit) {
  for (const CheckedProgram::Part& part : input.parts)
    if (const auto* node = std::get_if<Kind>(&part.expression->node)) visit(*node, part.expression->range);
}

template <class Visit> void eachIf(const CheckedProgram& input, const Visit& visit) {
  for (const Block& block : input.program.blocks)
    if (const auto* branch = std::get_if<If>(&block.body); branch != nullptr && branch->then) visit(*branch);
}

} // namespace

// ---- numbers and brackets

// Counted in the text: the tree does not know which pairs belong to functions.
void bracketsTooDeep(const CheckedProgram& input, Report& report) {
  const std::uint32_t most = input.control != nullptr ? input.control->bracketDepth : 5;
  for (const Block& block : input.program.blocks) {
    if (std::holds_alternative<Unread>(block.body) || std::holds_alternative<Print>(block.body) ||
        std::holds_alternative<SetNames>(block.body))
      continue;
    // The pair of the condition itself is not counted: no source says that it is.
    const std::uint32_t first = most + (conditionOf(block) != nullptr ? 2 : 1);
    const std::string_view text = input.sources.text(block.range);
    if (std::count(text.begin(), text.end(), '[') < first) continue; // nearly all
    std::uint32_t open = 0;
    bool inComment = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      inComment = inComment || c == '(';
      if (c == ')') inComment = false;
      if (inComment) continue;
      if (c == ']' && open > 0) --open;
      if (c != '[' || ++open != first) continue;
      const auto place = static_cast<std::uint32_t>(block.range.begin + i);
      report.at({block.range.file, place, place + 1},
                "brackets are nested deeper than {}; the control stops with alarm 118; calculate a part in a "
                "block of "
                "its own",
                most);
      break;
    }
  }
}

// Zeros before the first digit count as well, `.5` has one digit.
void numberDigits(const CheckedProgram& input, Report& report) {
  if (input.control == nullptr) return;
  eachPart<nc::Number>(input, [&](const nc::Number& number, SourceRange range) {
    const auto count = std::count_if(number.digits.begin(), number.digits.end(),
                                     [](char c) { return c >= '0' && c <= '9'; });
    if (count > static_cast<std::ptrdiff_t>(input.control->digits))
      report.at(range,
                "the number has {} digits; {} takes {} by most accounts and stops with an alarm, or drops "
                "the rest; "
                "write fewer",
                count, input.control->title, input.control->digits);
  });
}

// ---- functions

void functionUnknownHere(const CheckedProgram& input, Report& report) {
  std::set<std::string> told;
  const auto known = [&](const std::string& form, SourceRange range) {
    if (!input.onEach([&](const stdlib::Control& control) { return !control.functions.contains(form); }))
      return true;
    if (told.insert(form).second)
      report.at(
          range,
          "{} is not known to {}; the control stops with an alarm; use another form, or another control",
          form, input.machineText());
    return false;
  };
  for (const CheckedProgram::Part& part : input.parts) {
    const Expression& expression = *part.expression;
    if (const auto* operation = std::get_if<nc::Operation>(&expression.node)) {
      if (operation->op.size() > 1) known(operation->op, expression.range);
    } else if (const auto* call = std::get_if<nc::FunctionCall>(&expression.node)) {
      if (!known(call->name, expression.range) || call->name != "ATAN") continue;
      known(call->arguments.size() == 1 ? "ATAN[y]"
            : call->comma               ? "ATAN[y,x]"
                                        : "ATAN[y]/[x]",
            expression.range);
    }
  }
}

void functionWithoutBrackets(const CheckedProgram& input, Report& report) {
  if (input.control != nullptr && input.control->bareFunctions) return;
  eachPart<nc::FunctionCall>(input, [&](const nc::FunctionCall& call, SourceRange range) {
    if (!call.bare) return;
    const SourceRange argument = call.arguments.front()->range;
    report
        .at(range,
            "the argument of {} has no brackets; some controls take that, others stop with an alarm; write "
            "them",
            call.name)
        .fix = Fix{Fix::Applicability::Display,
                   "write the brackets",
                   {{{argument.file, argument.begin, argument.begin}, "["},
                    {{argument.file, argument.end, argument.end}, "]"}}};
  });
}

void fixOfComputed(const CheckedProgram& input, Report& report) {
  Diagnostic* first = nullptr; // one a program: whoever knows it of one FIX knows it of all
  const Wholes wholes(input.program);
  eachPart<nc::FunctionCall>(input, [&](const nc::FunctionCall& call, SourceRange range) {
    if (call.name != "FIX") return;
    const Expression& argument = *call.arguments.front();
    if (!isApproximate(argument, true) || isHalved(argument) || wholes.divides(argument)) return;
    if (first != nullptr)
      first->note(range, "and here");
    else
      first = &report.at(
          range,
          "FIX cuts a computed value; it may lie just below the whole number that is meant, and one less "
          "comes out; add a little, `FIX[..+0.0001]`, or use ROUND");
  });
}

// ---- conditions

void joinedUnknownHere(const CheckedProgram& input, Report& report) {
  if (input.control == nullptr || input.control->joinedConditions) return;
  for (const Condition* condition : input.conditions)
    if (const auto* both = std::get_if<JoinedConditions>(&condition->node))
      report.at(condition->range,
                "conditions joined by {} are not known to {}; it stops with an alarm; write one IF after "
                "the other",
                both->op, input.control->title);
}

void constantCondition(const CheckedProgram& input, Report& report) {
  for (const Condition* condition : input.conditions)
    eachComparison(*condition, [&](const Comparison& comparison, SourceRange range) {
      if (const auto result = alwaysSame(comparison))
        report.at(range,
                  "the condition {} holds, whatever the variables are; the branch is no test{}; one of the "
                  "numbers is "
                  "wrong",
                  *result ? "always" : "never",
                  *result ? "" : ", and what it leads to, an alarm for instance, never comes of it");
    });
}

void equalityOfComputed(const CheckedProgram& input, Report& report) {
  if (input.conditions.empty()) return;
  const std::set<std::uint32_t> counters = countersOf(input.program);
  // A variable that grows in steps, compared with a number.
  const auto counts = [&](const Expression& side, const Expression& other) {
    const auto number = variableNumber(side);
    return number && counters.contains(*number) && constantOf(other);
  };
  for (const Condition* condition : input.conditions)
    eachComparison(*condition, [&](const Comparison& comparison, SourceRange range) {
      if ((comparison.op != "EQ" && comparison.op != "NE") || alwaysSame(comparison)) return;
      const Expression& left = *comparison.left;
      const Expression& right = *comparison.right;
      if (isInexact(left) || isInexact(right) || counts(left, right) || counts(right, left))
        report.at(range,
                  "{} compares a computed value exactly; a last digit decides, and the program may miss it; "
                  "compare "
                  "the difference, `ABS[..]LT 0.0001`",
                  comparison.op);
    });
}

void thenUnknownHere(const CheckedProgram& input, Report& report) {
  if (input.control == nullptr || input.control->ifThen) return;
  eachIf(input, [&](const If& branch) {
    report.at(branch.range,
              "IF with THEN is not known to {}; it stops with an alarm; jump over the block with GOTO",
              input.control->title);
  });
}

void thenGoto(const CheckedProgram& input, Report& report) {
  if (input.control == nullptr || !input.control->ifThen || input.control->thenGoto) return;
  eachIf(input, [&](const If& branch) {
    if (std::holds_alternative<Goto>(branch.statement))
      report.at({branch.range.file, branch.condition->range.end, branch.range.end},
                "GOTO follows THEN; a 31i-B takes it, of this control it is not known; write `IF[..]GOTO`");
  });
}

} // namespace dotek::frontend::macrob
