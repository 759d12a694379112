// What is lost in typing and leaves a program that a control takes: a point, an ABS.
#include "frontend/macrob/Check.h"
#include "frontend/macrob/Format.h"
#include "frontend/macrob/Walk.h"

#include <map>

namespace dotek::frontend::macrob {
namespace {

void judgeNumber(const Expression& expression, Report& report) {
  const auto* number = std::get_if<nc::Number>(&expression.node);
  if (number == nullptr || number->point || number->value == 0 || !number->digits.starts_with('0')) return;
  const std::size_t first = number->digits.find_first_not_of('0');
  report.at(
      expression.range,
      "`{}` begins with a zero and has no point, so it is {}; write `0.{}` if the point is lost, and `{}` "
      "otherwise",
      number->digits, number->digits.substr(first), number->digits.substr(1), number->digits.substr(first));
}

bool isDifference(const Expression& expression) {
  const auto* operation = std::get_if<nc::Operation>(&expression.node);
  return operation != nullptr && operation->op == "-";
}

// `ABS[..]-#29`: a magnitude less its tolerance.
bool hasMagnitude(const Expression& difference) {
  const auto* operation = std::get_if<nc::Operation>(&difference.node);
  const auto* call = operation == nullptr ? nullptr : std::get_if<nc::FunctionCall>(&operation->left->node);
  return call != nullptr && call->name == "ABS";
}

bool isAbsoluteDifference(const Expression& expression) {
  const auto* call = std::get_if<nc::FunctionCall>(&expression.node);
  return call != nullptr && call->name == "ABS" && call->arguments.size() == 1 &&
         isDifference(*call->arguments.front());
}

} // namespace

void pointLost(const CheckedProgram& input, Report& report) {
  for (const Condition* condition : input.conditions)
    eachComparison(*condition, [&](const Comparison& comparison, SourceRange) {
      judgeNumber(*comparison.left, report);
      judgeNumber(*comparison.right, report);
    });
  for (const auto& part : input.parts)
    if (const auto* operation = std::get_if<nc::Operation>(&part.expression->node)) {
      judgeNumber(*operation->left, report);
      judgeNumber(*operation->right, report);
    }
}

void absMissing(const CheckedProgram& input, Report& report) {
  // By comparison and bound: where a difference is compared with ABS.
  std::map<std::string, const Comparison*> withAbs;
  const auto kindOf = [](const Comparison& comparison) { return comparison.op + print(*comparison.right); };
  for (const Condition* condition : input.conditions)
    eachComparison(*condition, [&](const Comparison& comparison, SourceRange) {
      if (isAbsoluteDifference(*comparison.left)) withAbs.emplace(kindOf(comparison), &comparison);
    });
  if (withAbs.empty()) return;
  for (const Condition* condition : input.conditions)
    eachComparison(*condition, [&](const Comparison& comparison, SourceRange) {
      if (!isDifference(*comparison.left) || hasMagnitude(*comparison.left)) return;
      const auto other = withAbs.find(kindOf(comparison));
      if (other == withAbs.end()) return;
      const SourceRange range = comparison.left->range;
      report
          .at(range, "this difference is compared without ABS, another one with the same bound has it; a "
                     "deviation to the other side passes; write `ABS[..]`")
          .notes.push_back({other->second->left->range, "the comparison with ABS"});
    });
}

} // namespace dotek::frontend::macrob
