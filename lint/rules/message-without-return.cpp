#include "frontend/gibbs/Lower.h"
#include "lint/CalledFiles.h"
#include "lint/MacroNames.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

// Messages that something decides on: after THEN, at a label, or after a jump over them. Others tell the user
// something in any case.
void collectMessages(const gibbs::Macro& macro, bool asked, std::vector<const gibbs::Statement*>& out) {
  bool decided = false; // what comes next runs under a condition
  for (const gibbs::Line& line : macro.lines) {
    if (line.label) decided = true;
    if (!line.statement) continue;
    const gibbs::Statement& statement = *line.statement;
    asked = asked || commandName(statement) == "DIALOG";
    const auto* branch = std::get_if<gibbs::If>(&statement.node);
    const bool jumps =
        branch != nullptr && branch->then && std::holds_alternative<gibbs::Goto>(branch->then->node);
    if (asked && branch != nullptr && branch->then && commandName(*branch->then) == "MESSAGE")
      out.push_back(branch->then.get());
    if (asked && decided && branch == nullptr && commandName(statement) == "MESSAGE")
      out.push_back(&statement);
    decided = jumps;
  }
}

// What the messages of the checks become: alarms, or comments that all values get past. One that no value
// comes to is neither.
struct Messages {
  std::vector<SourceRange> alarms, passed;
};

// nullopt: they cannot be followed.
std::optional<Messages> messagesOf(const gibbs::Cycle& cycle, const Project& project) {
  ir::Cycle lowered = gibbs::declareCycle(cycle, project.sources);
  Diagnostics ignored;
  gibbs::LowerContext context{
      project.sources,
      project.gibbsKeywords,
      project.limits,
      ignored,
      {},
      {},
      [&](const std::string& name, SourceRange) { return calledMacro(cycle, name, project); },
      [&](const std::string&, SourceRange) { return cycle.dialog ? &*cycle.dialog : nullptr; },
      [&](const std::string& name) {
        for (ir::VariableId id = 0; id < lowered.variables.size(); ++id)
          if (lowered.variables[id].role == ir::Role::Host && lowered.variables[id].name == name) return id;
        ir::Variable variable;
        variable.name = name;
        variable.role = ir::Role::Host;
        variable.kind = ir::Kind::Length;
        return lowered.add(std::move(variable));
      }};
  if (!gibbs::lowerChecks(*cycle.cycleData, lowered, context)) return std::nullopt;
  Messages out;
  for (const ir::CycleStatement& statement : lowered.checks) {
    if (std::holds_alternative<ir::Alarm>(statement.node)) out.alarms.push_back(statement.origin.range());
    if (std::holds_alternative<ir::Comment>(statement.node)) out.passed.push_back(statement.origin.range());
  }
  return out;
}

void check(const Project& project, Report& report) {
  for (const gibbs::Cycle* cycle : project.cycles) {
    if (!cycle->cycleData || cycle->cycleData->hasErrorNodes) continue;
    std::vector<const gibbs::Statement*> messages;
    collectMessages(*cycle->cycleData, false, messages);
    for (const gibbs::Macro* other : cycle->others)
      if (!other->hasErrorNodes) collectMessages(*other, true, messages);
    if (messages.size() < 2) continue;
    const auto become = messagesOf(*cycle, project);
    if (!become) continue;
    const auto isOf = [](const std::vector<SourceRange>& ranges, const gibbs::Statement* message) {
      return std::any_of(ranges.begin(), ranges.end(), [&](const SourceRange& range) {
        return range.file == message->range.file && range.begin <= message->range.begin &&
               message->range.end <= range.end;
      });
    };
    const auto isAlarm = [&](const gibbs::Statement* message) { return isOf(become->alarms, message); };
    const auto other = std::find_if(messages.begin(), messages.end(), isAlarm);
    if (other == messages.end()) continue;
    for (const gibbs::Statement* message : messages)
      if (!isAlarm(message) && isOf(become->passed, message))
        report
            .at(message->range,
                "after this message the macro goes on with the values that it complains of, and the post "
                "prints them; write the GOTO to the dialog, as after the others")
            .note((*other)->range, "after this one the dialog comes again");
  }
}

} // namespace

DOTEK_LINT_RULE(message_without_return){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
