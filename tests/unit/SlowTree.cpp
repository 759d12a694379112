#include "tests/unit/SlowTree.h"

#include <algorithm>

namespace dotek::tests {

namespace macrob = frontend::macrob;
namespace nc = frontend::nc;
using macrob::Condition;
using macrob::Expression;

std::uint32_t loopNumber(const std::optional<macrob::LoopNumber>& loop) {
  return loop ? loop->value : 0;
}

Routine routineOf(const macrob::Program& program) {
  Routine out;
  out.program = &program;
  out.partner.assign(program.blocks.size(), Routine::kNone);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < program.blocks.size(); ++i) {
    out.loops.push_back(open);
    const macrob::Body& body = program.blocks[i].body;
    if (std::holds_alternative<macrob::Do>(body)) {
      open.push_back(i);
    } else if (const auto* end = std::get_if<macrob::End>(&body)) {
      if (open.empty()) continue;
      const auto& loop = std::get<macrob::Do>(program.blocks[open.back()].body);
      if (loopNumber(loop.loop) != loopNumber(end->loop)) continue;
      out.partner[i] = open.back();
      out.partner[open.back()] = i;
      open.pop_back();
    }
  }
  return out;
}

std::uint32_t depth(const Expression& expression) {
  std::uint32_t inner = 0;
  if (const auto* variable = std::get_if<nc::VariableRef>(&expression.node)) inner = depth(*variable->number);
  if (const auto* negated = std::get_if<nc::Negated>(&expression.node)) inner = depth(*negated->operand);
  if (const auto* operation = std::get_if<nc::Operation>(&expression.node))
    inner = std::max(depth(*operation->left), depth(*operation->right));
  if (const auto* call = std::get_if<nc::FunctionCall>(&expression.node)) {
    for (const auto& argument : call->arguments)
      inner = std::max(inner, depth(*argument));
    if (!call->bare) ++inner;
  }
  return inner + expression.brackets;
}
std::uint32_t depth(const Condition& condition) {
  if (const auto* comparison = std::get_if<macrob::Comparison>(&condition.node))
    return condition.brackets + std::max(depth(*comparison->left), depth(*comparison->right));
  const auto& joined = std::get<macrob::JoinedConditions>(condition.node);
  return condition.brackets + std::max(depth(*joined.left), depth(*joined.right));
}

} // namespace dotek::tests
