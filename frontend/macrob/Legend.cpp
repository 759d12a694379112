#include "frontend/macrob/Legend.h"

#include "frontend/macrob/Keywords.h"

#include <cctype>
#include <string>

namespace dotek::frontend::macrob {

namespace {

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
bool isDigit(char c) {
  return c >= '0' && c <= '9';
}
// Bytes above 127 are letters of texts.
bool isTextLetter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) > 127;
}

} // namespace

bool isPlainText(std::string_view text) {
  bool lower = false;
  for (const char c : text) {
    if (!isTextLetter(c) && !isBlank(c) && c != '.') return false;
    lower = lower || std::islower(static_cast<unsigned char>(c)) != 0;
  }
  return lower;
}

std::size_t findLegend(std::string_view line) {
  const auto skip = [&](std::size_t at) {
    while (at < line.size() && isBlank(line[at]))
      ++at;
    return at;
  };
  const std::size_t first = skip(0);
  for (std::size_t at = first; at < line.size(); ++at) {
    const std::uint32_t variable = argumentVariable(line[at]);
    if (variable == 0) continue;
    if (at != first && (at < 2 || !isBlank(line[at - 1]) || !isBlank(line[at - 2]))) continue;
    std::size_t next = skip(at + 1);
    if (next >= line.size() || line[next] != '#') continue;
    next = skip(next + 1);
    std::uint32_t number = 0;
    const std::size_t digits = next;
    while (next < line.size() && isDigit(line[next]) && next - digits < 4)
      number = number * 10 + static_cast<std::uint32_t>(line[next++] - '0');
    next = skip(next);
    if (number != variable || next >= line.size() || line[next] != '=') continue;
    // Words, not an expression.
    for (++next; next < line.size();) {
      std::string letters;
      while (next < line.size() && isTextLetter(line[next]))
        letters += line[next++];
      if (!letters.empty() && !isExpressionWord(letters)) return at;
      if (letters.empty()) ++next;
    }
  }
  return std::string_view::npos;
}

} // namespace dotek::frontend::macrob
