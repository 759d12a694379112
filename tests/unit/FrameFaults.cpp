#include "tests/unit/FrameFaults.h"

#include "tests/policy/Tree.h"

#include <array>
#include <functional>
#include <regex>
#include <string>
#include <utility>

namespace dotek::tests {

namespace {

using Lines = std::vector<std::string>;
// What one line becomes: each a fault; "": it is dropped.
using Operator = std::function<Lines(const std::string& line, const Lines& all)>;

bool matches(const std::string& line, const char* pattern) {
  return std::regex_search(line, std::regex(pattern));
}

Operator dropping(const char* pattern) {
  return [pattern](const std::string& line, const Lines&) {
    return matches(line, pattern) ? Lines{""} : Lines();
  };
}

// Each of the words once left out.
Lines wordsLeftOut(const std::string& line) {
  Lines out;
  const std::regex word("[A-Z][-#0-9.]+");
  for (auto at = std::sregex_iterator(line.begin(), line.end(), word); at != std::sregex_iterator(); ++at) {
    std::string rest =
        at->prefix().str() + line.substr(static_cast<std::size_t>(at->position() + at->length()));
    rest = std::regex_replace(rest, std::regex("^ +| +$|( ) +"), "$1");
    out.push_back(rest);
  }
  return out;
}

Lines otherGroups(const std::string& line, const Lines& all) {
  Lines out;
  std::smatch own, other;
  const std::regex kept("^#\\d+=(#4\\d\\d\\d)$");
  if (!std::regex_match(line, own, kept)) return out;
  for (const std::string& one : all)
    if (std::regex_match(one, other, kept) && other[1] != own[1])
      out.push_back(std::regex_replace(line, std::regex("=#4\\d\\d\\d"), "=" + other[1].str()));
  return out;
}

Lines otherBounds(const std::string& line, const Lines&) {
  Lines out;
  static const std::array<std::pair<const char*, const char*>, 4> kTurns = {
      {{" LE ", " LT "}, {" LT ", " LE "}, {" GE ", " GT "}, {" GT ", " GE "}}};
  // No part lies on the bound of a measured value to the last digit.
  if (!line.starts_with("IF[") || matches(line, "#4\\d\\d\\d|#50\\d\\d|#51\\d\\d|#1[34]\\d\\b")) return out;
  for (const auto& [from, to] : kTurns)
    for (std::size_t at = 0; (at = line.find(from, at)) != std::string::npos; ++at)
      out.push_back(std::string(line).replace(at, 4, to));
  return out;
}

const std::vector<std::pair<std::string_view, Operator>>& operators() {
  static const std::vector<std::pair<std::string_view, Operator>> kAll = {
      {"leave the spindle or the coolant on", dropping("^M0?[59]$")},
      {"end in place of returning",
       [](const std::string& line, const Lines&) { return line == "M99" ? Lines{"M30"} : Lines(); }},
      {"do not keep a mode", dropping("^#\\d+=#4\\d\\d\\d$")},
      {"keep the mode of another group", otherGroups},
      {"do not put a mode back",
       [](const std::string& line, const Lines&) {
         return matches(line, "^[GF]#\\d+( [GF]#\\d+)*$") ? wordsLeftOut(line) : Lines();
       }},
      {"do not set a mode",
       [](const std::string& line, const Lines&) {
         return matches(line, "^G90 G94 G17") ? wordsLeftOut(line) : Lines();
       }},
      {"do not ask for an argument", dropping("^IF\\[#\\d+ EQ #0\\]THEN #3000=")},
      {"take no default", dropping("^IF\\[#\\d+ EQ #0\\]THEN #\\d\\d?=")},
      {"take another default",
       [](const std::string& line, const Lines&) {
         std::smatch found;
         if (!std::regex_match(line, found, std::regex("(IF\\[#\\d+ EQ #0\\]THEN #\\d\\d?=-?)(\\d+)(\\..*)")))
           return Lines();
         return Lines{found[1].str() + std::to_string(std::stoi(found[2].str()) + 1) + found[3].str()};
       }},
      {"do not demand something of the caller",
       dropping("^IF\\[(#4\\d\\d\\d|ABS\\[#50\\d\\d|ABS\\[#51\\d\\d).*THEN #3000=")},
      {"do not wait for the axes", dropping("^G53$")},
      {"turn a bound", otherBounds},
      {"do not ask for a whole number", dropping("^IF\\[#\\d+ NE FIX")},
      {"raise the alarm of another number",
       [](const std::string& line, const Lines&) {
         const std::size_t at = line.find("#3000=");
         if (line.starts_with("(") || at == std::string::npos) return Lines();
         const int number = std::stoi(line.substr(at + 6));
         return Lines{line.substr(0, at + 6) + std::to_string(number + 1) +
                      line.substr(at + 6 + std::to_string(number).size())};
       }},
      {"do not check", dropping("^IF\\[.*\\]THEN #3000=1\\d\\d\\((?!ARGUMENT)")},
      {"search less far",
       [](const std::string& line, const Lines&) {
         const bool measures = matches(line, "^G65 P(9023|98(11|12|14|15|16|19|23)|88(11|12|14)) ");
         return measures && line.find(" Q") == std::string::npos ? Lines{line + " Q1."} : Lines();
       }},
  };
  return kAll;
}

} // namespace

const std::vector<std::string_view>& frameFaultKinds() {
  static const std::vector<std::string_view> kNames = [] {
    std::vector<std::string_view> out;
    for (const auto& [name, apply] : operators())
      out.push_back(name);
    return out;
  }();
  return kNames;
}

std::vector<Fault> frameFaultsOf(std::string_view kind, std::string_view program) {
  std::vector<Fault> out;
  const Lines lines = linesOf(std::string(program));
  for (const auto& [name, apply] : operators()) {
    if (name != kind) continue;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].starts_with("(") || lines[i] == "%") continue;
      for (std::string& after : apply(lines[i], lines))
        out.push_back({std::string(name), i, lines[i], std::move(after)});
    }
  }
  return out;
}

} // namespace dotek::tests
