// Alarms and messages of programs: #3000 and #3006.
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Check.h"
#include "frontend/macrob/Walk.h"

namespace dotek::frontend::macrob {
namespace {

// On every control that has macro B.
constexpr int kAlarm = 3000;
constexpr int kStop = 3006;

// An assignment that shows something to the operator.
struct Shown {
  const nc::Assignment& assignment;
  bool alarm = false; // else a stop with a message
  const Comment* text = nullptr;
};

template <class Visit> void eachShown(const CheckedProgram& input, const Visit& visit) {
  const auto numberOf = [&](std::optional<int> stdlib::SystemVariables::*variable, int usual) {
    return input.control != nullptr ? input.control->variables.*variable : std::optional(usual);
  };
  const std::optional<int> alarm = numberOf(&stdlib::SystemVariables::alarm, kAlarm);
  const std::optional<int> stop = numberOf(&stdlib::SystemVariables::message, kStop);
  for (const Block& block : input.program.blocks) {
    const nc::Assignment* assignment = assignmentOf(block);
    if (assignment == nullptr) continue;
    const auto variable = literal(*assignment->variable);
    const bool isAlarm = alarm && variable == *alarm;
    if (!isAlarm && !(stop && variable == *stop)) continue;
    Shown shown{*assignment, isAlarm, nullptr};
    for (const Comment& comment : block.comments)
      if (comment.place > 0 && shown.text == nullptr) shown.text = &comment;
    visit(shown);
  }
}

} // namespace

void alarmNumberRange(const CheckedProgram& input, Report& report) {
  if (input.control == nullptr) return;
  const stdlib::Control& control = *input.control;
  eachShown(input, [&](const Shown& shown) {
    const auto number = literal(*shown.assignment.value);
    if (shown.alarm && number && !(*number >= control.alarmFirst && *number <= control.alarmLast))
      report.at(shown.assignment.value->range,
                "the alarm {} is outside the range of {}, {} to {}; what the control shows is not known; "
                "take a number "
                "of the range",
                *number, control.title, control.alarmFirst, control.alarmLast);
  });
}

void alarmWithoutText(const CheckedProgram& input, Report& report) {
  eachShown(input, [&](const Shown& shown) {
    if (shown.text == nullptr)
      report.at(shown.assignment.range,
                "the {} has no text; the operator sees a number alone; write `(WHY)` after it",
                shown.alarm ? "alarm" : "stop");
  });
}

void messageTooLong(const CheckedProgram& input, Report& report) {
  if (input.control == nullptr) return;
  eachShown(input, [&](const Shown& shown) {
    if (shown.text != nullptr && shown.text->text.size() > input.control->alarmLength)
      report.at(shown.text->range, "the message has {} characters; {} shows {}; shorten it",
                shown.text->text.size(), input.control->title, input.control->alarmLength);
  });
}

} // namespace dotek::frontend::macrob
