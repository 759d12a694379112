#include "backends/fanuc/TargetAlarms.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace dotek::targets {

namespace {

constexpr std::string_view kSystemAlarm = "WORK OFFSET NOT 54 TO 59";
constexpr std::string_view kExtendedAlarm = "NO SUCH WORK OFFSET";

// Numbers and texts after `before`, "#3000=103(ARGUMENT X MISSING)": the text to the next bracket or line.
std::vector<std::pair<std::uint32_t, std::string>> alarmsIn(std::string_view text, std::string_view before,
                                                            char open) {
  std::vector<std::pair<std::uint32_t, std::string>> out;
  for (std::size_t at = 0; (at = text.find(before, at)) != std::string_view::npos;) {
    at += before.size();
    std::uint32_t number = 0;
    const auto end = std::from_chars(text.data() + at, text.data() + text.size(), number);
    const auto begin = static_cast<std::size_t>(end.ptr - text.data());
    if (end.ec != std::errc() || begin >= text.size() || text[begin] != open) continue;
    out.emplace_back(number, text.substr(begin + 1, text.find_first_of(")\n", begin + 1) - begin - 1));
  }
  return out;
}

// Letters and digits, in upper case.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      out += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

// An alarm of the program, or one that its header lists, says what the message says.
bool hasAlarm(std::string_view program, const std::string& message) {
  for (const auto& list : {alarmsIn(program, "#3000=", '('), alarmsIn(program, "(ALARM ", ' ')})
    for (const auto& [number, text] : list)
      if (const std::string own = plain(text); !own.empty() && message.find(own) != std::string::npos)
        return true;
  return false;
}

} // namespace

std::string_view listedDefault(std::string_view program, char letter) {
  // As wide as the numbers of its locals: `(     NAME ` or `(      NAME `.
  std::size_t heading = program.find("   NAME ");
  while (heading != std::string_view::npos && heading > 0 && program[heading] == ' ')
    --heading;
  if (heading == std::string_view::npos || program[heading] != '(') return "";
  const std::size_t column = program.substr(heading).find(" DEFAULT ");
  for (std::size_t at = heading; (at = program.find('\n', at)) != std::string_view::npos;) {
    const std::size_t begin = ++at;
    const std::string_view line = program.substr(begin, program.find('\n', begin) - begin);
    if (!line.starts_with('(')) return "";
    if (line.size() <= column + 1 || line[1] != letter || !line.substr(2).starts_with(" #")) continue;
    const std::string_view rest = line.substr(column + 1);
    return rest.substr(0, rest.find_first_of(" )"));
  }
  return "";
}

bool saysSo(std::string_view program, std::string_view alarm, std::string_view message,
            std::size_t alarmLength) {
  const bool ascii = std::all_of(message.begin(), message.end(),
                                 [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  if (!ascii) return true;
  const std::string wanted = plain(message);
  // What a cycle finds at its table, a program asks before.
  const bool noTool = message.starts_with("there is no tool offset") && alarm.starts_with("TOOL OFFSET NOT");
  // What the dialog says is between the marks of the sentence.
  std::string_view said = message;
  if (const std::size_t end = message.rfind('`'); end != std::string_view::npos && end > 0)
    if (const std::size_t begin = message.rfind('`', end - 1); begin != std::string_view::npos)
      said = message.substr(begin + 1, end - begin - 1);
  const std::string shown = plain(alarm), whole = plain(said);
  const bool isWhole =
      whole == shown || (said.size() > alarmLength && whole.find(shown) != std::string::npos);
  return noTool || isWhole ||
         ((kSystemAlarm.starts_with(alarm) || kExtendedAlarm.starts_with(alarm)) &&
          !hasAlarm(program, wanted));
}

bool raises(std::string_view program, std::string_view alarm) {
  const auto own = alarmsIn(program, "#3000=", '(');
  return std::any_of(own.begin(), own.end(),
                     [&](const auto& one) { return plain(one.second) == plain(alarm); });
}

std::string whyListsOther(std::string_view program) {
  const auto listed = alarmsIn(program, "(ALARM ", ' ');
  if (listed.empty()) return "";
  for (const auto& raised : alarmsIn(program, "#3000=", '(')) {
    const bool there = std::any_of(listed.begin(), listed.end(), [&raised](const auto& one) {
      const std::string text = plain(one.second), own = plain(raised.second);
      return one.first == raised.first && (text.starts_with(own) || own.starts_with(text));
    });
    if (!there)
      return fmt::format("alarm {} `{}` is not in the list of the header", raised.first, raised.second);
  }
  return "";
}

} // namespace dotek::targets
