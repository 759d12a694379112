#include "backends/fanuc/TargetHeader.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace dotek::targets {

namespace {

constexpr std::array<std::string_view, 4> kTitles = {" UNIT", " DEFAULT", " RANGE", " MEANING"};
constexpr std::array<std::string_view, 3> kSays = {"unit", "default", "range"};

struct Row {
  std::string key; // "X #24 XP"
  char letter = 0;
  std::array<std::string, 4> cells;
};

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(' ') + 1 - begin));
}

std::string oneSpace(std::string_view text) {
  std::string out;
  for (const char c : trimmed(text))
    if (c != ' ' || out.back() != ' ') out += c;
  return out;
}

std::vector<std::string_view> commentsOf(std::string_view program) {
  std::vector<std::string_view> out;
  for (std::size_t at = 0; at < program.size();) {
    const std::size_t end = std::min(program.find('\n', at), program.size());
    std::string_view line = program.substr(at, end - at);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.size() > 2 && line.front() == '(' && line.back() == ')')
      out.push_back(line.substr(1, line.size() - 2));
    at = end + 1;
  }
  return out;
}

// Cells begin where the titles of their columns do; lines that go on have only a meaning.
std::vector<Row> rowsOf(std::string_view program) {
  std::vector<Row> out;
  std::optional<std::array<std::size_t, 4>> columns;
  for (const std::string_view line : commentsOf(program)) {
    if (!columns) {
      std::array<std::size_t, 4> found{};
      for (std::size_t i = 0; i < kTitles.size(); ++i)
        found[i] = line.find(kTitles[i]);
      if (trimmed(line).starts_with("NAME ") && std::is_sorted(found.begin(), found.end()) &&
          found.back() != std::string_view::npos)
        columns = found;
      continue;
    }
    const auto cell = [&](std::size_t i) {
      const std::size_t begin = (*columns)[i] + 1;
      const std::size_t end = i + 1 < columns->size() ? (*columns)[i + 1] : line.size();
      return begin < line.size() ? trimmed(line.substr(begin, end - std::min(begin, end))) : std::string();
    };
    const std::string key = oneSpace(line.substr(0, (*columns)[0]));
    if (key.empty() && !out.empty()) {
      out.back().cells.back() += (out.back().cells.back().empty() ? "" : " ") + cell(3);
      continue;
    }
    if (key.size() < 4 || key[1] != ' ' || key[2] != '#') break;
    out.push_back({key, key.front(), {cell(0), cell(1), cell(2), cell(3)}});
  }
  return out;
}

// Of "CALL: G65 P8000 A0. B3.", without the values.
std::string lettersOfCall(std::string_view program) {
  constexpr std::string_view kCall = "CALL: ";
  std::string out;
  bool goesOn = false;
  for (const std::string_view line : commentsOf(program)) {
    if (!goesOn && !line.starts_with(kCall)) continue;
    std::string_view rest = goesOn ? line : line.substr(kCall.size());
    const std::string words = oneSpace(rest);
    // A call that needs two lines has only words on the second.
    const bool call = std::all_of(words.begin(), words.end(), [&](char c) {
      return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ' || c == '.' || c == '-';
    });
    if (goesOn && (!call || words.find_first_of("0123456789") == std::string::npos)) break;
    for (std::size_t i = 0; i < words.size(); ++i)
      if (words[i] >= 'A' && words[i] <= 'Z' && (i == 0 || words[i - 1] == ' ')) out += words[i];
    goesOn = true;
  }
  return out;
}

// The text with each number as `#`.
std::string withoutNumbers(std::string_view text) {
  std::string out;
  for (const char c : text)
    if ((c < '0' || c > '9') && c != '.')
      out += c;
    else if (out.empty() || out.back() != '#')
      out += '#';
  return out;
}

// Lists, alarms and demands name numbers, codes and variables: a line with the words of the converted program
// has its numbers, too. Values of the call are the editor's. "" or what is wrong.
std::string whyNumbersDiffer(std::string_view converted, std::string_view edited) {
  const std::vector<std::string_view> own = commentsOf(converted);
  for (const std::string_view line : commentsOf(edited)) {
    if (line.starts_with("CALL: ") || std::find(own.begin(), own.end(), line) != own.end()) continue;
    const auto same = std::find_if(own.begin(), own.end(), [&](std::string_view one) {
      return withoutNumbers(one) == withoutNumbers(line);
    });
    if (same != own.end() && !same->starts_with("CALL: "))
      return fmt::format("the header says `{}`, where it is `{}`", trimmed(line), trimmed(*same));
  }
  return "";
}

// Which arguments move the probe: the letters after these words.
std::string whyUsesDiffer(std::string_view converted, std::string_view edited) {
  const auto lettersAfter = [](std::string_view program, std::string_view words) {
    std::set<std::string> out;
    for (const std::string_view line : commentsOf(program)) {
      if (!line.starts_with(words)) continue;
      const std::string letters = oneSpace(line.substr(words.size()));
      for (std::size_t i = 0; i < letters.size(); i += 2)
        out.insert(letters.substr(i, 1));
    }
    return out;
  };
  for (const std::string_view words : {"MOVE THE PROBE:", "SET OR COMPARE, MOVE NOTHING:"}) {
    const std::set<std::string> meant = lettersAfter(converted, words), said = lettersAfter(edited, words);
    if (!meant.empty() && !said.empty() && meant != said)
      return fmt::format("the header says `{} {}`, where it is `{}`", words, fmt::join(said, " "),
                         fmt::join(meant, " "));
  }
  return "";
}

// What the header demands of the caller and says of the program, one by one: "TOOL LENGTH ACTIVE". A list
// that needs several lines goes on until one that begins something else.
std::vector<std::string> demandsIn(std::string_view program) {
  constexpr std::array<std::string_view, 4> kLists = {
      "THE CALLER PROVIDES, ELSE AN ALARM: ", "THE CALLER PROVIDES, NOT CHECKED: ",
      "CHANGES THAT ARE NOT PUT BACK: ", "COMPUTED, NO ARGUMENTS: "};
  std::vector<std::string> texts;
  bool goesOn = false;
  for (const std::string_view line : commentsOf(program)) {
    const auto list = std::find_if(kLists.begin(), kLists.end(),
                                   [&](std::string_view start) { return line.starts_with(start); });
    if (list != kLists.end())
      texts.push_back(oneSpace(line.substr(list->size())));
    else if (goesOn && line.find(':') == std::string_view::npos && !line.starts_with("ALARM ") &&
             !line.starts_with("RESULT ") && !line.starts_with("MEASURES FROM "))
      texts.back() += " " + oneSpace(line);
    else {
      goesOn = false;
      continue;
    }
    goesOn = true;
  }
  std::vector<std::string> out;
  for (std::string& text : texts) {
    for (std::size_t at = text.find(", "); at != std::string::npos; at = text.find(", ")) {
      out.push_back(text.substr(0, at));
      text.erase(0, at + 2);
    }
    out.push_back(std::move(text));
  }
  return out;
}

// Demands and formulas are all in the edited header, unless it has none of them. "" or what is wrong.
std::string whyDemandsDiffer(std::string_view converted, std::string_view edited) {
  std::string text;
  for (const std::string_view line : commentsOf(edited))
    text += oneSpace(line) + " ";
  if (text.find("THE CALLER PROVIDES") == std::string::npos) return "";
  for (const std::string& demand : demandsIn(converted))
    if (text.find(demand) == std::string::npos)
      return fmt::format("the header does not say `{}` any more", demand);
  return "";
}

// Digits after `before` where a text begins with it and they end at a blank, a bracket or its end.
std::string numberAfter(std::string_view text, std::string_view before) {
  if (!text.starts_with(before)) return "";
  const std::size_t begin = before.size();
  const std::size_t end = std::min(text.find_first_not_of("0123456789", begin), text.size());
  return end == begin || (end < text.size() && text[end] != ' ' && text[end] != '(')
             ? ""
             : std::string(text.substr(begin, end - begin));
}

// The number that the call in the header names, and that of the program, without zeros in front. "": none.
std::pair<std::string, std::string> numbersOf(std::string_view program) {
  std::pair<std::string, std::string> out;
  for (const std::string_view comment : commentsOf(program))
    if (out.first.empty()) out.first = numberAfter(comment, "CALL: G65 P");
  for (std::size_t at = 0; at < program.size() && out.second.empty();) {
    const std::size_t end = std::min(program.find('\n', at), program.size());
    std::string_view line = program.substr(at, end - at);
    if (line.ends_with('\r')) line.remove_suffix(1);
    out.second = numberAfter(line, "O");
    at = end + 1;
  }
  for (std::string* one : {&out.first, &out.second})
    one->erase(0, std::min(one->find_first_not_of('0'), one->size()));
  return out;
}

} // namespace

std::string whyHeaderDiffers(std::string_view converted, std::string_view edited) {
  const std::vector<Row> meant = rowsOf(converted);
  for (const Row& row : rowsOf(edited)) {
    const auto same =
        std::find_if(meant.begin(), meant.end(), [&](const Row& one) { return one.key == row.key; });
    if (same == meant.end()) {
      const auto other = std::find_if(meant.begin(), meant.end(), [&](const Row& one) {
        return one.letter == row.letter && withoutNumbers(one.key) == withoutNumbers(row.key);
      });
      if (other != meant.end())
        return fmt::format("the header says `{}`, where it is `{}`", row.key, other->key);
      continue;
    }
    for (std::size_t i = 0; i < kSays.size(); ++i)
      if (row.cells[i] != same->cells[i])
        return fmt::format("the header gives `{}` as the {} of {}, where it is `{}`", row.cells[i], kSays[i],
                           row.letter, same->cells[i]);
    const std::string& meaning = row.cells.back();
    if (meaning.empty() || meaning == same->cells.back()) continue;
    for (const Row& other : meant)
      if (other.key != row.key && other.cells.back() == meaning)
        return fmt::format("the header gives the meaning of {} to {}: `{}`", other.letter, row.letter,
                           meaning);
  }
  for (const auto why : {whyNumbersDiffer, whyUsesDiffer, whyDemandsDiffer})
    if (std::string out = why(converted, edited); !out.empty()) return out;
  if (const auto [called, program] = numbersOf(edited);
      !called.empty() && !program.empty() && called != program)
    return fmt::format("the call in the header names program {}, and the program is O{}", called, program);
  const std::string letters = lettersOfCall(edited), own = lettersOfCall(converted);
  if (!letters.empty() && !own.empty() &&
      std::set(letters.begin(), letters.end()) != std::set(own.begin(), own.end()))
    return fmt::format("the call in the header has the letters {} instead of {}", letters, own);
  return "";
}

} // namespace dotek::targets
