// What the text of a translation says of its alarms and its arguments.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dotek::targets {

// What the list of arguments in the header gives as the default of a letter: a number, or GIVE. "": no such
// line.
std::string_view listedDefault(std::string_view program, char letter);

// The text of an alarm is that of a message, in upper case and cut, or the translation's own for a number
// that is no work offset, where no alarm of the program says what the message says. What a message has beside
// ASCII is written in several ways.
bool saysSo(std::string_view program, std::string_view alarm, std::string_view message,
            std::size_t alarmLength);

// The text is that of an alarm which the program raises itself.
bool raises(std::string_view program, std::string_view alarm);

// The list in the header says what each alarm is. "" or what is wrong.
std::string whyListsOther(std::string_view program);

} // namespace dotek::targets
