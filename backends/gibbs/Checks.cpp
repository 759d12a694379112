// CycleData.mac: shows the dialog, and again while a check refuses what the user typed.
#include "backends/gibbs/Macro.h"

#include "ir/Fold.h"
#include "support/messages/CamFolder.h"

#include <algorithm>

namespace dotek::backends::gibbs {

namespace {

bool setsReturnCode(const ir::Cycle& cycle, const ir::Assign& node) {
  const ir::Variable& variable = cycle.variable(node.variable);
  return variable.role == ir::Role::Local && variable.name == "callback_returncode";
}

void writeStatement(const ir::Cycle& cycle, const ir::CycleStatement& statement, const std::string& ask,
                    const std::string& pass, MacroText& text) {
  const ir::Origin& origin = statement.origin;
  ir::match(
      statement,
      [&](const ir::Assign& node) {
        if (!setsReturnCode(cycle, node)) text.assign(text.names().of(node.variable), node.value, origin);
      },
      [&](const ir::Label& node) { text.label(node.label, origin); },
      [&](const ir::Jump& node) { text.jump(node.target, origin); },
      [&](const ir::Branch& node) { text.jumpIf(node.condition, node.target, origin); },
      [&](const ir::Alarm& node) {
        const std::string shown = node.message.empty() ? "These values are refused" : node.message;
        text.add("message \"" + plain(shown, origin.range(), text.diagnostics()) + "\"", origin);
        text.add("goto " + ask, origin);
      },
      [&](const ir::Comment& node) {
        text.add("! " + plain(node.text, origin.range(), text.diagnostics()), origin);
      },
      [&](const ir::Return&) { text.add("goto " + pass, origin); },
      [&](const ir::OneOf<ir::Store, ir::Move, ir::Measure, ir::ProbePower, ir::Spindle, ir::Coolant,
                          ir::SetMode, ir::Dwell, ir::Stop, ir::CallCycle, ir::OpaqueBlock, ir::Port,
                          ir::Print> auto&) {
        text.fail();
        text.diagnostics().report<diag::CamExpression>(origin.range(), "what the machine does");
      });
}

} // namespace

std::vector<EmittedLine> checkLines(const ir::Cycle& cycle, const Folder& folder, MacroText& text) {
  const std::string ask = text.freshLabel("ask"), pass = text.freshLabel("pass");
  const bool returns =
      std::any_of(cycle.checks.begin(), cycle.checks.end(),
                  [](const ir::CycleStatement& one) { return std::holds_alternative<ir::Return>(one.node); });
  text.add("callback_returncode = 0 ! dotek: ignore return-code-constant -- the dialog comes again instead");
  if (const auto radius = findHost(cycle, "tool_radius"); radius && ir::uses(cycle, *radius)) {
    const std::string number = text.names().fresh("edited");
    text.add(number + " = callback_proc");
    readRadius(text, "proc", number, text.names().of(*radius));
  }
  text.add(":" + ask);
  text.add("dialog \"CycleData.dlg\"");
  for (const ir::CycleStatement& statement : cycle.checks)
    writeStatement(cycle, statement, ask, pass, text);
  if (returns) text.add(":" + pass);
  for (const Field& field : folder.fields) // the post prints it
    if (!field.asked && field.name != text.names().of(field.variable))
      text.add(field.name + " = " + text.names().of(field.variable));
  std::vector<EmittedLine> lines = text.take();
  if (text.turns()) lines.insert(lines.begin(), EmittedLine{"degrees", {}, "unit of the angles"});
  return lines;
}

} // namespace dotek::backends::gibbs
