// What is wrong where a control or a macro raises an alarm whose number and text no source says.
#pragma once

#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"

#include <string_view>

namespace dotek::stdlib {

std::string_view alarmMeaning(Alarm alarm);        // "a division by zero"
std::string_view macroAlarmText(MacroAlarm alarm); // "no feed is given for the protected move"

} // namespace dotek::stdlib
