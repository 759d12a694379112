#include "lint/OwnCalls.h"

#include <cmath>

namespace dotek::lint {
namespace {

bool isEmpty(const ir::ExpressionPtr& expression) {
  return std::holds_alternative<ir::NullValue>(expression->node) || variableNumber(*expression) == 0U;
}

// What is at the label is an alarm.
bool raisesAt(const std::vector<ir::ProgramStatement>& body, ir::LabelId label) {
  for (std::size_t i = 0; i < body.size(); ++i) {
    const auto* target = std::get_if<ir::Label>(&body[i].node);
    if (target == nullptr || target->label != label) continue;
    while (i < body.size() && ir::isLayout(body[i]))
      ++i;
    return i < body.size() && std::holds_alternative<ir::Raise>(body[i].node);
  }
  return false;
}

} // namespace

std::map<std::uint32_t, std::vector<OwnCall>> callsByProgram(const Project& project) {
  std::map<std::uint32_t, std::vector<OwnCall>> out;
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    for (const ir::ProgramStatement& statement : program.body) {
      const ir::Call* call = callOf(statement);
      const double* number = call == nullptr || !call->program ? nullptr : ir::constantValue(call->program);
      if (number == nullptr || *number < 1 || *number > 1e8 || call->kind != ir::CallKind::Macro) continue;
      OwnCall one{&statement, {}};
      for (const ir::CallArgument& argument : call->arguments)
        one.given.insert(argument.local);
      out[static_cast<std::uint32_t>(std::lround(*number))].push_back(std::move(one));
    }
  });
  return out;
}

std::optional<std::uint32_t> nullCompared(const ir::ConditionPtr& condition) {
  if (const auto* inner = std::get_if<ir::Not>(&condition->node)) return nullCompared(inner->inner);
  if (const auto* test = std::get_if<ir::IsNull>(&condition->node)) return variableNumber(*test->value);
  const auto* same = std::get_if<ir::Comparison>(&condition->node);
  if (same == nullptr || (same->relation != ir::Relation::Same && same->relation != ir::Relation::Different))
    return std::nullopt;
  if (isEmpty(same->right)) return variableNumber(*same->left);
  return isEmpty(same->left) ? variableNumber(*same->right) : std::nullopt;
}

std::optional<std::uint32_t> nullTested(const ir::ConditionPtr& condition) {
  const auto* same = std::get_if<ir::Comparison>(&condition->node);
  const bool empty = std::holds_alternative<ir::IsNull>(condition->node) ||
                     (same != nullptr && same->relation == ir::Relation::Same);
  return empty ? nullCompared(condition) : std::nullopt;
}

namespace {

// IF [..] THEN #3000=..: the branch at `at` jumps over one alarm.
bool passesAlarm(const std::vector<ir::ProgramStatement>& body, std::size_t at) {
  const auto* branch = std::get_if<ir::Branch>(&body[at].node);
  if (branch == nullptr || at + 2 >= body.size() || !std::holds_alternative<ir::Raise>(body[at + 1].node))
    return false;
  const auto* label = std::get_if<ir::Label>(&body[at + 2].node);
  return label != nullptr && label->label == branch->target;
}

} // namespace

std::set<std::uint32_t> requiredLocals(const ir::Program& program) {
  std::set<std::uint32_t> out;
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    const ir::ProgramStatement& statement = program.body[i];
    const bool open = match(
        statement,
        [&](const ir::Branch& node) {
          if (passesAlarm(program.body, i)) {
            if (!nullTested(node.condition))
              if (const auto number = nullCompared(node.condition)) out.insert(*number);
            i += 2;
            return true;
          }
          if (!raisesAt(program.body, node.target)) return false;
          if (const auto number = nullTested(node.condition)) out.insert(*number);
          return true;
        },
        [](const ir::OneOf<ir::Comment, ir::Store, ir::NcBlock> auto&) { return true; },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::JumpTo, ir::Loop, ir::LoopEnd, ir::Call, ir::Exit,
                           ir::Raise, ir::Notice, ir::Port, ir::Print, ir::NameVariables> auto&) {
          return false;
        });
    if (!open) break;
  }
  return out;
}

} // namespace dotek::lint
