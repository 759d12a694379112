// Alarms and messages of programs: #3000 and #3006.
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/CheckParts.h"
#include "frontend/macrob/Walk.h"
#include "support/messages/MacroB.h"

#include <cmath>

namespace dotek::frontend::macrob {
namespace {

// On every control that has macro B.
constexpr double kAlarm = 3000;
constexpr double kStop = 3006;

const Comment* textOf(const Block& block) {
  for (const Comment& comment : block.comments)
    if (comment.place > 0) return &comment;
  return nullptr;
}

void checkBlock(const Block& block, const nc::Assignment& assignment, const CheckContext& context) {
  const stdlib::Control& control = *context.control;
  const auto variable = literal(*assignment.variable);
  const bool alarm = control.variables.alarm && variable == *control.variables.alarm;
  if (!alarm && !(control.variables.message && variable == *control.variables.message)) return;
  if (const auto number = literal(*assignment.value);
      alarm && number && !(*number >= control.alarmFirst && *number <= control.alarmLast))
    context.report<diag::AlarmNumberRange>(assignment.value->range, *number, control.title,
                                           control.alarmFirst, control.alarmLast);
  const Comment* text = textOf(block);
  if (text == nullptr) {
    context.report<diag::AlarmWithoutText>(assignment.range, alarm ? "alarm" : "stop");
  } else if (text->text.size() > control.alarmLength) {
    context.report<diag::MessageTooLong>(text->range, text->text.size(), control.title, control.alarmLength);
  }
}

} // namespace

void checkMessages(const Program& program, const CheckContext& context) {
  for (const Block& block : program.blocks) {
    const nc::Assignment* assignment = assignmentOf(block);
    if (assignment == nullptr) continue;
    if (context.control != nullptr)
      checkBlock(block, *assignment, context);
    else if (const auto variable = literal(*assignment->variable);
             (variable == kAlarm || variable == kStop) && textOf(block) == nullptr)
      context.report<diag::AlarmWithoutText>(assignment->range, variable == kAlarm ? "alarm" : "stop");
  }
}

} // namespace dotek::frontend::macrob
