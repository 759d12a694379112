#include "stdlib/AlarmMeaning.h"

namespace dotek::stdlib {

std::string_view alarmMeaning(Alarm alarm) {
  switch (alarm) {
  case Alarm::TooManyDigits: return "a number has too many digits";
  case Alarm::NoFeed: return "no feed is in force";
  case Alarm::ArcRadius: return "the end point does not lie on the arc";
  case Alarm::NoProgramNumber: return "no program number is given";
  case Alarm::SubprogramDepth: return "too many subprograms call one another";
  case Alarm::NoSuchProgram: return "the program that is called is not there";
  case Alarm::IntegerOverflow: return "a whole number is too large";
  case Alarm::Overflow: return "a value is too large";
  case Alarm::DivideByZero: return "a division by zero";
  case Alarm::ImproperCommand: return "the block is no command that the control takes";
  case Alarm::ExpressionFormat: return "the expression has no form that the control takes";
  case Alarm::NoSuchVariable: return "there is no such variable";
  case Alarm::WriteProtected: return "the variable can be read only";
  case Alarm::BracketDepth: return "too many brackets are one in another";
  case Alarm::ArgumentRange: return "the argument of a function is out of its range";
  case Alarm::MacroDepth: return "too many macros call one another";
  case Alarm::MissingEnd: return "a WHILE has no END";
  case Alarm::StatementFormat: return "the statement has no form that the control takes";
  case Alarm::LoopNumber: return "the number of a DO is none that the control takes";
  case Alarm::MixedBlock: return "a block holds NC words and a macro statement";
  case Alarm::NoSuchSequence: return "the block of a GOTO is not there";
  case Alarm::GArgument: return "a G code cannot be an argument of the call";
  }
  return "";
}

std::string_view macroAlarmText(stdlib::MacroAlarm alarm) {
  switch (alarm) {
  case MacroAlarm::PathObstructed:
    return "the probe touched something on its path where nothing was expected";
  case MacroAlarm::NoFeed: return "no feed is given for the protected move";
  case MacroAlarm::ProbeOpen: return "the probe is deflected before it moves";
  case MacroAlarm::ProbeFail: return "the probe met nothing on its path to the surface";
  case MacroAlarm::OutOfTolerance: return "the size is out of its tolerance";
  case MacroAlarm::OutOfPosition: return "the feature is out of its position tolerance";
  case MacroAlarm::OutOfAngle: return "the angle is out of its tolerance";
  case MacroAlarm::UpperLimit: return "the error is larger than the call allows";
  }
  return "";
}

} // namespace dotek::stdlib
