// Operators of macros, DefineData.txt and dialogs.
#include "tests/unit/Mutants.h"

#include <algorithm>
#include <set>

namespace dotek::tests {
namespace {

using Text = std::optional<std::string>;

std::regex folded(const std::string& pattern) {
  return std::regex(pattern, std::regex::ECMAScript | std::regex::icase);
}

std::string upper(std::string text) {
  for (char& c : text)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

// What the first group of the pattern is, line by line.
std::vector<std::string> firstGroups(const InputFile* file, const std::regex& pattern) {
  std::vector<std::string> out;
  if (file == nullptr) return out;
  for (const Line& line : linesOf(*file)) {
    std::smatch match;
    if (std::regex_search(line.code, match, pattern)) out.push_back(match.str(1));
  }
  return out;
}

std::vector<std::string> fieldsOf(const InputFile& file, const Bundle& bundle) {
  return firstGroups(bundle.find(file.folder() + "/DefineData.txt"), folded("^\\s*(\\w+)\\s*="));
}

// Fields, what is assigned, and what a command gets; as written, each once.
std::vector<std::string> variablesOf(const InputFile& file, const Bundle& bundle) {
  std::vector<std::string> out = fieldsOf(file, bundle);
  for (const std::string& name : firstGroups(&file, folded("(?:^|\\bthen)\\s*(\\w+)\\s*=")))
    out.push_back(name);
  for (const std::string& name : firstGroups(&file, folded("^\\s*get_\\w+.*?(\\w+)\\s*$")))
    out.push_back(name);
  std::vector<std::string> once;
  std::set<std::string> seen;
  for (const std::string& name : out)
    if (!upper(name).starts_with("CALLBACK_") && seen.insert(upper(name)).second) once.push_back(name);
  return once;
}

// The names of variables outside texts.
void eachVariable(const InputFile& file, const Bundle& bundle,
                  const std::function<Text(const std::vector<std::string>&, std::size_t)>& replace,
                  Sites& sites) {
  const std::vector<std::string> names = variablesOf(file, bundle);
  static const std::regex word("\"[^\"]*\"|[A-Za-z_]\\w*");
  eachMatch(
      file, word, 0,
      [&](const std::smatch& match) -> Text {
        for (std::size_t i = 0; i < names.size(); ++i)
          if (upper(names[i]) == upper(match.str())) return replace(names, i);
        return std::nullopt;
      },
      sites);
}

void labelLost(const InputFile& file, const Bundle&, Sites& sites) {
  static const std::regex label("^\\s*:(\\w+)");
  for (const Line& line : linesOf(file)) {
    std::smatch match;
    if (std::regex_search(line.code, match, label) &&
        std::regex_search(file.code, folded("goto\\s+" + match.str(1) + "\\b")))
      sites.push_back(dropLine(file, line));
  }
}

void checkLost(const InputFile& file, const Bundle& bundle, Sites& sites) {
  if (!file.name.ends_with("CycleData.mac")) return;
  for (const std::string& field : fieldsOf(file, bundle))
    dropLines(file, folded("^\\s*if\\b.*\\b" + field + "\\b.*\\bthen\\b"), sites);
}

void wayBackLost(const InputFile& file, const Bundle&, Sites& sites) {
  static const std::regex label("^\\s*:(\\w+)");
  const std::vector<Line> lines = linesOf(file);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::smatch match;
    if (!std::regex_search(lines[i].code, folded("^\\s*dialog\\b")) ||
        !std::regex_search(lines[i - 1].code, match, label))
      continue;
    dropLines(file, folded("goto\\s+" + match.str(1) + "\\b"), sites);
  }
}

void retractLost(const InputFile& file, const Bundle&, Sites& sites) {
  const std::vector<Line> lines = linesOf(file);
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    if (!std::regex_search(line->code, folded("^\\s*add_custom_drill_cycle_path\\s+feed_z"))) continue;
    sites.push_back(dropLine(file, *line));
    return;
  }
}

std::string numberText(double value) {
  std::string out = std::to_string(value);
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out;
}

// The bound of the first check of a field against a number, crossed by one.
void defaultOutside(const InputFile& file, const Bundle& bundle, Sites& sites) {
  const InputFile* checks = bundle.find(file.folder() + "/CycleData.mac");
  if (checks == nullptr) return;
  eachMatch(
      file, folded("^\\s*(\\w+)\\s*=\\s*(\\S+)"), 2,
      [&](const std::smatch& match) -> Text {
        const std::regex check =
            folded("if\\s+(?:abs\\()?" + match.str(1) + "\\)?\\s*(<=?|>=?)\\s*(-?[0-9.]+)\\s+then");
        std::smatch found;
        if (!std::regex_search(checks->code, found, check)) return std::nullopt;
        const std::string comparison = found.str(1);
        const double bound = std::stod(found.str(2));
        return numberText(comparison == "<" ? bound - 1 : comparison == ">" ? bound + 1 : bound);
      },
      sites);
}

const char* const kInput = "^\\s*input\\s+(\\d+\\s*,\\s*\\d+)\\s*,\\s*\\d+\\s*,\\s*\\d+\\s*,\\s*(\\w+)";

void inputOther(const InputFile& file, const Bundle&, Sites& sites) {
  std::vector<std::string> names;
  eachMatch(
      file, folded(kInput), 2,
      [&](const std::smatch& match) -> Text {
        names.push_back(match.str(2));
        return std::nullopt;
      },
      sites);
  std::size_t at = 0;
  eachMatch(
      file, folded(kInput), 2, [&](const std::smatch&) -> Text { return names[++at % names.size()]; }, sites);
}

void controlCovered(const InputFile& file, const Bundle&, Sites& sites) {
  std::string before;
  eachMatch(
      file, folded(kInput), 1,
      [&](const std::smatch& match) -> Text {
        const std::string there = before;
        before = match.str(1);
        return there.empty() ? std::nullopt : Text(there);
      },
      sites);
}

// Labels that begin with the name of a field.
void captionOther(const InputFile& file, const Bundle& bundle, Sites& sites) {
  const std::vector<std::string> fields = fieldsOf(file, bundle);
  const std::regex label = folded("^\\s*label\\b.*\"([^\"]*)\"");
  const auto isCaption = [&](const std::string& text) {
    return std::any_of(fields.begin(), fields.end(), [&](const std::string& field) {
      return std::regex_search(text, folded("^" + field + "\\b")) || text.starts_with(field);
    });
  };
  std::vector<std::string> captions;
  eachMatch(
      file, label, 1,
      [&](const std::smatch& match) -> Text {
        if (isCaption(match.str(1))) captions.push_back(match.str(1));
        return std::nullopt;
      },
      sites);
  std::size_t at = 0;
  eachMatch(
      file, label, 1,
      [&](const std::smatch& match) -> Text {
        if (!isCaption(match.str(1))) return std::nullopt;
        return captions[++at % captions.size()];
      },
      sites);
}

} // namespace

std::vector<Operator> macroOperators() {
  return {
      {"variable-misspelt", "m",
       [](const InputFile& file, const Bundle& bundle, Sites& sites) {
         eachVariable(
             file, bundle, [](const auto& names, std::size_t at) { return Text(misspelt(names[at])); },
             sites);
       }},
      {"variable-other", "m",
       [](const InputFile& file, const Bundle& bundle, Sites& sites) {
         eachVariable(
             file, bundle,
             [](const auto& names, std::size_t at) { return Text(names[(at + 1) % names.size()]); }, sites);
       }},
      replacing(
          "command-misspelt", "m",
          "(?:^|\\bthen)\\s*(get_\\w+|add_\\w+|dialog|message|goto|callback_\\w+)\\b", 1,
          [](const std::smatch& match) { return shortened(match.str(1)); }, true),
      {"label-lost", "m", labelLost},
      replacing(
          "goto-misspelt", "m", "\\bgoto\\s+(\\w+)", 1,
          [](const std::smatch& match) { return shortened(match.str(1)); }, true),
      {"check-lost", "m", checkLost},
      replacing(
          "error-number-other", "m", "\\bthen\\s+\\w+\\s*=\\s*(\\d+)", 1,
          [](const std::smatch& match) { return Text(std::to_string(std::stoi(match.str(1)) + 1)); }, true),
      taking("message-empty", "m", "\\bmessage\\s+\"([^\"]*)\"", 1, true),
      {"way-back-lost", "m", wayBackLost},
      taking("then-lost", "m", "( then)\\b", 1, true),
      droppingLines("get-lost", "m", "^\\s*get_", true),
      replacing(
          "path-axis-other", "m", "\\bfeed_([xyz])\\b", 1,
          [](const std::smatch& match) {
            const char axis = match.str(1)[0];
            return Text(std::string(1, axis == 'z' || axis == 'Z'   ? static_cast<char>(axis - 2)
                                       : axis == 'x' || axis == 'X' ? static_cast<char>(axis + 1)
                                                                    : static_cast<char>(axis - 1)));
          },
          true),
      {"retract-lost", "m", retractLost},
      taking("dialog-file-misspelt", "m", "\\bdialog\\s+\"..(.)[^\"]*\"", 1, true),
      {"default-outside", "d", defaultOutside},
      taking("default-sign-lost", "d", "=\\s*(-)\\d", 1),
      replacing("field-misspelt", "d", "^\\s*(\\w+)\\s*=", 1,
                [](const std::smatch& match) { return Text(misspelt(match.str(1))); }),
      droppingLines("field-lost", "d", "^\\s*\\w+\\s*="),
      replacing(
          "input-misspelt", "l", kInput, 2,
          [](const std::smatch& match) { return Text(misspelt(match.str(2))); }, true),
      {"input-other", "l", inputOther},
      {"caption-other", "l", captionOther},
      droppingLines("button-lost", "l", "^\\s*(ok|cancel)\\b", true),
      replacing(
          "control-shifted", "l", "^\\s*(?:label|input|ok|cancel|image)\\s+(\\d+)", 1,
          [](const std::smatch& match) { return Text(match.str(1) + "0"); }, true),
      {"control-covered", "l", controlCovered},
      taking("argument-lost", "l", "(,\\s*\\d+)", 1),
  };
}

} // namespace dotek::tests
