// What is wrong where a control raises an alarm whose number and text no source says.
#pragma once

#include "stdlib/Control.h"

#include <string_view>

namespace dotek::stdlib {

std::string_view alarmMeaning(Alarm alarm); // "a division by zero"

} // namespace dotek::stdlib
