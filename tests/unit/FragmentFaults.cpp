#include "tests/unit/FragmentFaults.h"

#include "tests/policy/Tree.h"

#include <functional>
#include <regex>
#include <string>
#include <utility>

namespace dotek::tests {

namespace {

using Lines = std::vector<std::string>;
using Operator = std::function<Lines(const std::string& line, const std::string& next)>;

bool matches(const std::string& line, const char* pattern) {
  return std::regex_search(line, std::regex(pattern));
}

// Each place where `from` stands, once with `to`.
Lines each(const std::string& line, std::string_view from, std::string_view to) {
  Lines out;
  for (std::size_t at = 0; (at = line.find(from, at)) != std::string::npos; at += from.size())
    out.push_back(std::string(line).replace(at, from.size(), to));
  return out;
}

bool prints(const std::string& line) {
  return matches(line, "^ *(writeBlock|writeln)\\(");
}

// Numbers of the text that is printed, each greater by one; those of variables and programs as well.
Lines numbers(const std::string& line) {
  Lines out;
  static const std::regex number("[A-Z#\\[]-?(\\d+)");
  for (auto at = std::sregex_iterator(line.begin(), line.end(), number); at != std::sregex_iterator(); ++at) {
    const auto begin = static_cast<std::size_t>(at->position(1));
    const std::string digits = (*at)[1].str();
    out.push_back(std::string(line).replace(begin, digits.size(), std::to_string(std::stoi(digits) + 1)));
  }
  return out;
}

const std::vector<std::pair<std::string_view, Operator>>& operators() {
  static const std::vector<std::pair<std::string_view, Operator>> kAll = {
      {"do not reset an output",
       [](const std::string& line, const std::string&) {
         return matches(line, "^ *\\w+\\.reset\\(\\);$") ? Lines{""} : Lines();
       }},
      {"write a block without its number",
       [](const std::string& line, const std::string&) { return each(line, "writeBlock(", "writeln("); }},
      {"say that the operation is another's",
       [](const std::string& line, const std::string&) {
         return each(line, "return true;", "return false;");
       }},
      {"be asked for by another name",
       [](const std::string& line, const std::string&) {
         return matches(line, "^ *case \"\\w+\":$") ? each(line, "\":", "x\":") : Lines();
       }},
      {"do not look at the unit",
       [](const std::string& line, const std::string&) { return each(line, "unit !== MM", "false"); }},
      {"define another default",
       [](const std::string& line, const std::string&) {
         std::smatch found;
         if (!std::regex_match(line, found, std::regex("( *value: \"?-?)(\\d+)(.*)"))) return Lines();
         return Lines{found[1].str() + std::to_string(std::stoi(found[2].str()) + 1) + found[3].str()};
       }},
      {"do not print a line",
       [](const std::string& line, const std::string&) { return prints(line) ? Lines{""} : Lines(); }},
      {"print another number",
       [](const std::string& line, const std::string&) { return prints(line) ? numbers(line) : Lines(); }},
      {"print another axis",
       [](const std::string& line, const std::string&) {
         Lines out;
         if (!prints(line)) return out;
         for (const auto& [from, to] : {std::pair(" X", " Y"), std::pair(" Y", " X"), std::pair(" Z", " X")})
           for (std::string& one : each(line, from, to))
             out.push_back(std::move(one));
         return out;
       }},
      {"do not check",
       [](const std::string& line, const std::string& next) {
         if (!matches(line, "^ *if \\(.*\\) \\{$") || !matches(next, "^ *error\\(")) return Lines();
         return Lines{line.substr(0, line.find('(') + 1) + "false) {"};
       }},
      {"turn a bound",
       [](const std::string& line, const std::string&) {
         Lines out;
         if (!matches(line, "^ *(\\} else )?if \\(")) return out;
         for (const auto& [from, to] : {std::pair(" < ", " <= "), std::pair(" <= ", " < "),
                                        std::pair(" > ", " >= "), std::pair(" >= ", " > ")})
           for (std::string& one : each(line, from, to))
             out.push_back(std::move(one));
         return out;
       }},
      {"compute with another sign",
       [](const std::string& line, const std::string&) {
         Lines out;
         if (!matches(line, "^ *(var )?\\w+ = ")) return out;
         for (const auto& [from, to] : {std::pair(" + ", " - "), std::pair(" - ", " + ")})
           for (std::string& one : each(line, from, to))
             out.push_back(std::move(one));
         return out;
       }},
  };
  return kAll;
}

} // namespace

const std::vector<std::string_view>& fragmentFaultKinds() {
  static const std::vector<std::string_view> kNames = [] {
    std::vector<std::string_view> out;
    for (const auto& [name, apply] : operators())
      out.push_back(name);
    return out;
  }();
  return kNames;
}

std::vector<Fault> fragmentFaultsOf(std::string_view kind, std::string_view fragment) {
  std::vector<Fault> out;
  const Lines lines = linesOf(std::string(fragment));
  for (const auto& [name, apply] : operators()) {
    if (name != kind) continue;
    bool own = true; // no private function
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
      if (lines[i].starts_with("function "))
        own = matches(lines[i], "^function \\w+_(write|dispatch)\\(");
      else if (lines[i].starts_with("properties") || lines[i].starts_with("if ("))
        own = true;
      if (!own || matches(lines[i], "^ *//")) continue;
      for (std::string& after : apply(lines[i], lines[i + 1]))
        out.push_back({std::string(name), i, lines[i], std::move(after)});
    }
  }
  return out;
}

} // namespace dotek::tests
