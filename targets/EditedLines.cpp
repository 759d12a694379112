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
  std::string key;          // without any blank
};

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

// Without empty lines.
std::vector<Line> linesOf(View text) {
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
    std::copy_if(line.begin(), line.end(), std::back_inserter(one.key), [](char c) { return !isBlank(c); });
  }
  return out;
}

// Of all languages that convert writes.
bool isComment(const Line& line) {
  const View key = line.key;
  for (const View begin : {";", "//", "/*", "*", "!"})
    if (key.starts_with(begin)) return true;
  return (key.starts_with('(') && key.find(')') == key.size() - 1) ||
         (key.starts_with('{') && key.find('}') == key.size() - 1);
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

// `O8000` of `O8000(TITLE)`, whose title does not run; "": another line.
View title(const Line& line) {
  const std::size_t digits = line.key.starts_with('O') ? digitsAt(line.key, 1) : 0;
  const bool named = digits > 0 && View(line.key).substr(digits + 1).starts_with('(');
  return named ? View(line.key).substr(0, digits + 1) : View();
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
  std::vector<Line> before = linesOf(converted);
  const std::vector<Line> now = linesOf(edited);
  const std::string number{programNumber(before)};
  if (const View other = programNumber(now); !number.empty() && !other.empty() && other != number)
    renumber(before, number, other);
  const auto pairs =
      matchLines(static_cast<std::uint32_t>(before.size()), static_cast<std::uint32_t>(now.size()),
                 [&](std::uint32_t i, std::uint32_t j) { return before[i].key == now[j].key; });
  if (!pairs || pairs->size() * 2 < before.size()) return {};
  const bool keepsComments = std::any_of(pairs->begin(), pairs->end(),
                                         [&](const auto& pair) { return isComment(now[pair.second]); });

  std::vector<EditedLine> out;
  const std::uint32_t last = now.empty() ? 1 : now.back().number;
  std::size_t i = 0, j = 0;
  // What lies between two lines that both have, line by line. Comments that were added are passed over.
  const auto upTo = [&](std::size_t endI, std::size_t endJ) {
    std::vector<const Line*> was, is;
    for (; i < endI; ++i)
      if (keepsComments || !isComment(before[i])) was.push_back(&before[i]);
    for (; j < endJ; ++j)
      is.push_back(&now[j]);
    for (auto at = is.begin(); at != is.end() && is.size() > was.size();)
      at = isComment(**at) ? is.erase(at) : at + 1;
    for (std::size_t k = 0; k < std::max(was.size(), is.size()); ++k) {
      EditedLine& one = out.emplace_back();
      one.line = k < is.size() ? is[k]->number : endJ < now.size() ? now[endJ].number : last;
      if (k < is.size()) one.now = is[k]->text;
      if (k < was.size()) one.converted = was[k]->text;
      one.comment = (k >= was.size() || isComment(*was[k])) && (k >= is.size() || isComment(*is[k]));
      if (k < was.size() && k < is.size())
        one.comment = one.comment || (!title(*was[k]).empty() && title(*was[k]) == title(*is[k]));
    }
  };
  for (const auto& [r, c] : *pairs) {
    upTo(r, c);
    ++i, ++j;
  }
  upTo(before.size(), now.size());
  return out;
}

} // namespace dotek::targets
