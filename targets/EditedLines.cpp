#include "targets/EditedLines.h"

#include "support/Ascii.h"
#include "support/LineEnds.h"
#include "support/LineMatch.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace dotek::targets {
namespace {

using View = std::string_view;

struct Line {
  std::uint32_t number = 0; // from 1
  std::string text;         // without blanks at the ends
  std::string key;          // without blanks outside of texts and comments, one for several inside
};

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

// What comments and texts are in, which the languages that convert writes differ in.
struct Style {
  bool program = false; // of a control: comments in round brackets
  bool script = false;  // a part of a post: no brackets are comments, quotes hold texts
};
Style styleOf(View text) {
  const bool program = !text.empty() && View("%O:(").find(text.front()) != View::npos;
  return {program, text.find("function ") != View::npos};
}

std::string keyOf(View line, const Style& style) {
  std::string out;
  char inside = 0; // what ends the text or the comment
  for (const char c : line) {
    if (isBlank(c)) {
      if (inside != 0 && out.back() != ' ') out += ' ';
      continue;
    }
    if (inside == 0 && style.program && c == '(')
      inside = ')';
    else if (inside == 0 && style.script && (c == '"' || c == '\''))
      inside = c;
    else if (c == inside)
      inside = 0;
    out += c;
  }
  return out;
}

// Without empty lines.
std::vector<Line> linesOf(View text, const Style& style) {
  std::vector<Line> out;
  std::uint32_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = endOfLine(text, at);
    View line = text.substr(at, end - at);
    at = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
    ++number;
    while (!line.empty() && isBlank(line.front()))
      line.remove_prefix(1);
    while (!line.empty() && isBlank(line.back()))
      line.remove_suffix(1);
    if (line.empty()) continue;
    Line& one = out.emplace_back();
    one.number = number;
    one.text = line;
    one.key = keyOf(line, style);
  }
  return out;
}

// Of all languages that convert writes.
bool isComment(const Line& line, const Style& style) {
  const View key = line.key;
  for (const View begin : {";", "//", "/*", "*", "!"})
    if (key.starts_with(begin)) return true;
  if (style.script) return false;
  const char open = style.program ? '(' : '{', close = style.program ? ')' : '}';
  return key.starts_with(open) && key.find(close) == key.size() - 1;
}

std::size_t digitsAt(View text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && isDigit(text[end]))
    ++end;
  return end - at;
}

// The digits of the first O number; "": there is none.
View programNumber(const std::vector<Line>& lines) {
  for (const Line& line : lines)
    if (const std::size_t digits = line.key.starts_with('O') ? digitsAt(line.key, 1) : 0; digits > 0)
      return View(line.key).substr(1, digits);
  return {};
}

// What is before a comment at the end of the line: `O8000` of `O8000(TITLE)`; "": it has none.
View beforeComment(const Line& line, const Style& style) {
  const View key = line.key;
  const std::size_t at =
      style.program ? std::min(key.find('('), key.find(';')) : key.find(style.script ? "//" : ";");
  if (at == View::npos || at == 0) return {};
  return key[at] == '(' && key.find(')') != key.size() - 1 ? View() : key.substr(0, at);
}

bool isTitle(View code) {
  return code.size() > 1 && code.front() == 'O' && digitsAt(code, 1) == code.size() - 1;
}

// The program has another number, and so it is called: `O8000` and `P8000`.
void renumber(std::vector<Line>& lines, const std::string& from, View to) {
  for (Line& line : lines)
    for (std::string* text : {&line.text, &line.key})
      for (std::size_t at = text->find(from); at != std::string::npos; at = text->find(from, at + 1)) {
        const bool named = at > 0 && ((*text)[at - 1] == 'O' || (*text)[at - 1] == 'P');
        if (named && digitsAt(*text, at) == from.size()) text->replace(at, from.size(), to);
      }
}

} // namespace

std::vector<EditedLine> editedLines(View converted, View edited) {
  const Style style = styleOf(converted);
  std::vector<Line> before = linesOf(converted, style);
  const std::vector<Line> now = linesOf(edited, style);
  const std::string number{programNumber(before)};
  if (const View other = programNumber(now); !number.empty() && !other.empty() && other != number)
    renumber(before, number, other);
  const auto pairs =
      matchLines(static_cast<std::uint32_t>(before.size()), static_cast<std::uint32_t>(now.size()),
                 [&](std::uint32_t i, std::uint32_t j) { return before[i].key == now[j].key; });
  const auto comment = [&](const Line* line) { return line == nullptr || isComment(*line, style); };
  const bool keepsComments =
      std::any_of(now.begin(), now.end(), [&](const Line& line) { return comment(&line); });
  // The one with a comment at its end that the other does not have: added, or taken out with all others.
  const auto sameCode = [&](const Line& was, const Line& is) {
    const View code = beforeComment(was, style);
    return beforeComment(is, style) == was.key || (!keepsComments && isTitle(code) && code == is.key);
  };

  std::vector<EditedLine> out;
  const std::uint32_t last = now.empty() ? 1 : now.back().number;
  std::size_t i = 0, j = 0;
  // What lies between two lines that both have, line by line. Comments that were added are passed over.
  const auto upTo = [&](std::size_t endI, std::size_t endJ) {
    std::vector<const Line*> was, is;
    for (; i < endI; ++i)
      if (keepsComments || !comment(&before[i])) was.push_back(&before[i]);
    for (; j < endJ; ++j)
      is.push_back(&now[j]);
    std::size_t added = is.size() - std::min(is.size(), was.size());
    std::erase_if(is, [&](const Line* line) { return added > 0 && comment(line) && added-- > 0; });
    for (std::size_t k = 0; k < std::max(was.size(), is.size()); ++k) {
      const Line* const old = k < was.size() ? was[k] : nullptr;
      const Line* const line = k < is.size() ? is[k] : nullptr;
      const View code = old != nullptr ? beforeComment(*old, style) : View();
      if (old != nullptr && line != nullptr && sameCode(*old, *line)) continue;
      EditedLine& one = out.emplace_back();
      one.line = line != nullptr ? line->number : endJ < now.size() ? now[endJ].number : last;
      if (line != nullptr) one.now = line->text;
      if (old != nullptr) one.converted = old->text;
      const bool title = line != nullptr && isTitle(code) && beforeComment(*line, style) == code;
      one.comment = title || (comment(old) && comment(line));
    }
  };
  if (pairs)
    for (const auto& [r, c] : *pairs) {
      upTo(r, c);
      ++i, ++j;
    }
  upTo(before.size(), now.size());
  return out;
}

} // namespace dotek::targets
