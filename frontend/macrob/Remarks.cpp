#include "frontend/macrob/Remarks.h"

#include "frontend/macrob/Keywords.h"
#include "support/Ascii.h"

#include <string>

namespace dotek::frontend::macrob {
namespace {

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

// No block of a Fanuc begins or goes on so. `text` ends before the next `;` or the line's end.
bool isProseOfRemark(std::string_view text) {
  std::size_t at = 0;
  const auto skip = [&] {
    while (at < text.size() && (isBlank(text[at]) || static_cast<unsigned char>(text[at]) < 0x20))
      ++at;
  };
  skip();
  if (at == text.size()) return false;
  if (std::string_view("/#<%:[").find(text[at]) == std::string_view::npos && !isLetter(text[at]) &&
      text[at] != '(')
    return true;
  while (at < text.size()) {
    if (text[at] == '(') {
      const std::size_t close = text.find(')', at);
      if (close == std::string_view::npos) return false;
      at = close + 1;
      continue;
    }
    if (!isLetter(text[at])) {
      if (static_cast<unsigned char>(text[at]) > 127 || text[at] == '\'' || text[at] == '"' ||
          text[at] == '!')
        return true;
      ++at;
      continue;
    }
    std::string letters;
    while (at < text.size() && isLetter(text[at]))
      letters += upperCase(text[at++]);
    skip();
    const char next = at < text.size() ? text[at] : '\0';
    if (letters.size() == 1) {
      // An address without its value.
      if (next == '\0' || isLetter(next) || next == ',' || next == ';' || next == '=') return true;
      continue;
    }
    for (std::string_view rest = letters; !rest.empty();) {
      const WordMatch word = wordAt(rest);
      if (word.kind == WordKind::Address && (rest.size() > 1 || next == '\0' || next == ' ')) return true;
      if (word.kind == WordKind::Print) return false;
      rest.remove_prefix(word.length);
    }
  }
  return false;
}

} // namespace

std::size_t remarkAt(std::string_view line, std::size_t at) {
  if (line[at] == '/') return at + 1 < line.size() && line[at + 1] == '/' ? 2 : 0;
  if (line[at] != ';') return 0;
  const std::string_view rest = line.substr(at + 1);
  return isProseOfRemark(rest.substr(0, rest.find(';'))) ? 1 : 0;
}

} // namespace dotek::frontend::macrob
