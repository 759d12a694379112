#include "lint/AskedVariables.h"

#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/Probing.h"

namespace dotek::lint {

std::set<std::uint32_t> askedIn(const ir::Program& program) {
  std::set<std::uint32_t> out;
  const auto take = [&](const ir::Expression& node) {
    if (!std::holds_alternative<ir::MachineVariable>(node.node)) return;
    if (const auto number = variableNumber(node)) out.insert(*number);
  };
  for (const ir::ProgramStatement& statement : program.body) {
    if (const ir::ConditionPtr* condition = ir::conditionOf(statement); condition != nullptr && *condition)
      ir::eachNode(*condition, take);
    if (callOf(statement) != nullptr) ir::eachNode(statement, take);
  }
  return out;
}

Askers collectAskers(const Project& project) {
  Askers out;
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    for (const std::uint32_t number : askedIn(program))
      ++out[number];
  });
  return out;
}

} // namespace dotek::lint
