#include "ir/Walk.h"
#include "lint/Probing.h"

#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kFirstSystem = 1000; // the control changes these itself

void checkProgram(const ir::Program& program, Report& report) {
  const auto& body = program.body;
  for (std::size_t at = 0; at < body.size(); ++at) {
    const auto* loop = std::get_if<ir::Loop>(&body[at].node);
    if (loop == nullptr || !loop->condition) continue;
    std::set<std::uint32_t> read;
    bool known = true;
    ir::eachNode(loop->condition, [&](const ir::Expression& node) {
      if (!std::holds_alternative<ir::MachineVariable>(node.node)) return;
      const auto number = variableNumber(node);
      if (number && *number < kFirstSystem)
        read.insert(*number);
      else
        known = false;
    });
    if (!known || read.empty()) continue;
    bool may = false; // something may change the condition, or lead out
    for (std::size_t i = at + 1; i < body.size() && !may; ++i) {
      const auto& node = body[i].node;
      const auto* end = std::get_if<ir::LoopEnd>(&node);
      if (end != nullptr && end->number == loop->number) break;
      const auto number = storedNumber(body[i]);
      may = std::holds_alternative<ir::Call>(node) || std::holds_alternative<ir::Exit>(node) ||
            std::holds_alternative<ir::Raise>(node) || std::holds_alternative<ir::JumpTo>(node) ||
            std::holds_alternative<ir::Jump>(node) || endsProgram(body[i]) ||
            (std::holds_alternative<ir::Store>(node) && (!number || read.contains(*number)));
      if (const auto* branch = std::get_if<ir::Branch>(&node)) {
        // A label with a number is one that a GOTO of the text names.
        may = may || program.labels[branch->target].number != 0;
      }
      // A code of the builder may call a macro.
      if (const auto* block = std::get_if<ir::NcBlock>(&node)) may = may || hasWord(*block, 'M');
    }
    if (may) continue;
    report.at(body[at].origin.range(),
              "nothing in this loop changes what its condition looks at, #{}; once in it the "
              "control does not come out; count it in the loop",
              *read.begin());
  }
}

void check(const Project& project, Report& report) {
  eachProgram(project,
              [&](const ir::Program& program, const macrob::File&) { checkProgram(program, report); });
}

} // namespace

DOTEK_LINT_RULE(loop_never_ends){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .explanation =
        "The variables of a WHILE are set nowhere in its loop, and no jump, call or alarm leads out of it. "
        "Mostly the line that counts is missing, or counts another variable.",
    .check = check,
};

} // namespace dotek::lint::rule
