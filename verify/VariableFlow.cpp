#include "verify/VariableFlow.h"

#include "ir/Flow.h"
#include "ir/Match.h"
#include "ir/Walk.h"
#include "stdlib/MacroSet.h"

#include <cmath>
#include <optional>
#include <vector>

namespace dotek::verify {

namespace {

// The number of a variable that the text names; nothing: it is computed.
std::optional<std::uint32_t> numberOf(const ir::ExpressionPtr& number) {
  const double* value = number ? ir::constantValue(number) : nullptr;
  if (value == nullptr || !(*value >= 0) || *value > 99999999) return std::nullopt;
  return static_cast<std::uint32_t>(std::lround(*value));
}

template <class Tree> Operands operandsIn(const Tree& tree) {
  Operands out;
  std::set<const ir::Expression*> numbers;
  ir::eachNode(tree, [&](const ir::Expression& node) {
    if (const auto* use = std::get_if<ir::MachineVariable>(&node.node)) {
      if (use->number) numbers.insert(use->number.get());
      if (const auto number = numberOf(use->number)) out.variables.insert(*number);
    } else if (const auto* constant = std::get_if<ir::Constant>(&node.node);
               constant && !numbers.contains(&node)) {
      out.constants.insert(constant->value);
    }
  });
  return out;
}

// The variable whose value this is, as it is or rounded.
std::optional<std::uint32_t> copiedFrom(const ir::ExpressionPtr& value) {
  if (!value) return std::nullopt;
  if (const auto* use = std::get_if<ir::MachineVariable>(&value->node)) return numberOf(use->number);
  const auto* unary = std::get_if<ir::Unary>(&value->node);
  if (unary == nullptr) return std::nullopt;
  using Op = ir::UnaryOp;
  const bool rounds = unary->op == Op::Truncate || unary->op == Op::RoundUp || unary->op == Op::Round ||
                      unary->op == Op::NullAsZero || unary->op == Op::AddPoint || unary->op == Op::Absolute;
  return rounds ? copiedFrom(unary->operand) : std::nullopt;
}

} // namespace

Operands operandsOf(const ir::ExpressionPtr& expression) {
  return expression ? operandsIn(expression) : Operands{};
}

Operands operandsOf(const ir::ConditionPtr& condition) {
  return condition ? operandsIn(condition) : Operands{};
}

VariableFlow::VariableFlow(const ir::ProgramFile& file, const stdlib::Control& control)
    : file_(file), control_(control) {
  for (std::size_t i = 0; i < file.programs.size(); ++i)
    for (const ir::ProgramStatement& statement : file.programs[i].body)
      take(i, statement);
}

VariableKey VariableFlow::key(std::size_t program, std::uint32_t number) const {
  const bool local = number >= 1 && number <= control_.locals;
  return {local ? program : VariableKey::kNoProgram, number};
}

void VariableFlow::take(std::size_t program, const ir::ProgramStatement& statement) {
  if (const auto* call = std::get_if<ir::Call>(&statement.node)) return takeCall(program, *call);
  const auto* store = std::get_if<ir::Store>(&statement.node);
  const auto number = store == nullptr ? std::nullopt : numberOf(store->number);
  if (!number) return;
  const VariableKey to = key(program, *number);
  const Operands operands = operandsOf(store->value);
  for (const std::uint32_t one : operands.variables)
    from_[to].insert(key(program, one));
  constants_[to].insert(operands.constants.begin(), operands.constants.end());
  if (const auto original = copiedFrom(store->value)) copies_.emplace(to, key(program, *original));
}

void VariableFlow::takeCall(std::size_t program, const ir::Call& call) {
  const auto number = numberOf(call.program);
  for (std::size_t callee = 0; number && callee < file_.programs.size(); ++callee) {
    if (file_.programs[callee].number != *number) continue;
    if (call.kind == ir::CallKind::Subprogram) { // the same locals
      for (std::uint32_t local = 1; local <= control_.locals; ++local) {
        from_[key(callee, local)].insert(key(program, local));
        copies_.emplace(key(callee, local), key(program, local));
      }
      continue;
    }
    for (const ir::CallArgument& argument : call.arguments) {
      const std::uint32_t local = stdlib::localOf(argument.letter);
      if (local == 0) continue;
      for (const std::uint32_t one : operandsOf(argument.value).variables)
        from_[key(callee, local)].insert(key(program, one));
      if (const auto original = copiedFrom(argument.value))
        copies_.emplace(key(callee, local), key(program, *original));
    }
  }
}

std::set<VariableKey> VariableFlow::sourcesOf(const VariableKey& start) const {
  std::set<VariableKey> out{start};
  std::vector<VariableKey> open{start};
  while (!open.empty()) {
    const auto at = from_.find(open.back());
    open.pop_back();
    if (at == from_.end()) continue;
    for (const VariableKey& one : at->second)
      if (out.insert(one).second) open.push_back(one);
  }
  return out;
}

Operands VariableFlow::expanded(std::size_t program, const ir::ExpressionPtr& expression) const {
  Operands out = operandsOf(expression);
  const std::set<std::uint32_t> named = out.variables;
  for (const std::uint32_t number : named) {
    if (key(program, number).program == VariableKey::kNoProgram) continue;
    for (const VariableKey& one : sourcesOf(key(program, number))) {
      if (one.program != program) continue;
      out.variables.insert(one.number);
      if (const auto at = constants_.find(one); at != constants_.end())
        out.constants.insert(at->second.begin(), at->second.end());
    }
  }
  return out;
}

std::set<VariableKey> VariableFlow::readByCheck(SourceRange raise) const {
  std::set<VariableKey> out;
  for (std::size_t p = 0; p < file_.programs.size(); ++p) {
    const std::vector<ir::ProgramStatement>& body = file_.programs[p].body;
    std::size_t at = 0;
    while (at < body.size() &&
           !(std::holds_alternative<ir::Raise>(body[at].node) && body[at].origin.range() == raise))
      ++at;
    if (at == body.size()) continue;
    std::vector<std::vector<std::size_t>> before(body.size());
    const ir::ProgramFlow flow = ir::flowOf(body);
    for (std::size_t i = 0; i < body.size(); ++i)
      for (const std::size_t to : flow.next[i])
        if (to < body.size()) before[to].push_back(i);
    // What leads to one of the labels of computed jumps leads to all of them.
    std::vector<std::size_t> computed;
    for (std::size_t i = 0; i < body.size() && !flow.labels.empty(); ++i)
      if (isComputedJump(body[i])) computed.push_back(i);
    std::set<std::size_t> seen{at};
    std::vector<std::size_t> open{at};
    while (!open.empty()) {
      const std::size_t now = open.back();
      open.pop_back();
      std::vector<std::size_t>& sources = before[now];
      if (!computed.empty() && std::binary_search(flow.labels.begin(), flow.labels.end(), now)) {
        sources.insert(sources.end(), computed.begin(), computed.end());
        computed.clear();
      }
      for (const std::size_t one : sources) {
        if (!seen.insert(one).second) continue;
        const ir::ConditionPtr* condition = ir::conditionOf(body[one]);
        if (condition == nullptr || !*condition) {
          open.push_back(one);
          continue;
        }
        for (const std::uint32_t number : operandsOf(*condition).variables) {
          const std::set<VariableKey> from = sourcesOf(key(p, number));
          out.insert(from.begin(), from.end());
        }
      }
    }
  }
  return out;
}

} // namespace dotek::verify
