// Operators of Progs.
#include "tests/unit/Mutants.h"

#include <algorithm>

namespace dotek::tests {
namespace {

using Text = std::optional<std::string>;

const char* const kField = "OpFieldData#\\('([^']+)'\\)";
const char* const kCycle = "CycleType\\?\\('([^']+)'\\)";

// Each match becomes the next other text that the pattern finds in the file.
Operator nextOne(std::string_view id, const char* pattern) {
  return {id, "p", [re = std::regex(pattern)](const InputFile& file, const Bundle&, Sites& sites) {
            std::vector<std::string> all;
            eachMatch(
                file, re, 1,
                [&](const std::smatch& match) -> Text {
                  all.push_back(match.str(1));
                  return std::nullopt;
                },
                sites);
            std::size_t at = 0;
            eachMatch(
                file, re, 1,
                [&](const std::smatch& match) -> Text {
                  for (std::size_t i = ++at; i < at + all.size(); ++i)
                    if (all[i % all.size()] != match.str(1)) return all[i % all.size()];
                  return std::nullopt;
                },
                sites);
          }};
}

// The address of the next field in the same block, else the next letter.
void addressOther(const InputFile& file, const Bundle&, Sites& sites) {
  static const std::regex address("([A-Z])'OpFieldData#");
  for (const Line& line : linesOf(file)) {
    std::vector<std::pair<std::size_t, char>> found;
    for (std::sregex_iterator match(line.code.begin(), line.code.end(), address), none; match != none;
         ++match)
      found.emplace_back(match->position(1), match->str(1)[0]);
    for (std::size_t i = 0; i < found.size(); ++i) {
      char other = found[(i + 1) % found.size()].second;
      if (other == found[i].second) other = other == 'Z' ? 'Y' : static_cast<char>(other + 1);
      sites.push_back({line.offset + found[i].first, 1, std::string(1, other)});
    }
  }
}

// The height that the last path command of a cycle takes the probe up to, printed as a move.
void retractLost(const InputFile& file, const Bundle& bundle, Sites& sites) {
  static const std::regex path("feed_z\\s*,\\s*(\\w+)", std::regex::ECMAScript | std::regex::icase);
  std::vector<std::string> fields;
  for (const InputFile& macro : bundle.files) {
    if (!macro.name.ends_with("ToolPath.mac")) continue;
    std::string last;
    for (const Line& line : linesOf(macro)) {
      std::smatch match;
      if (std::regex_search(line.code, match, path)) last = match.str(1);
    }
    if (!last.empty() && std::find(fields.begin(), fields.end(), last) == fields.end())
      fields.push_back(last);
  }
  for (const std::string& field : fields)
    dropLines(file, std::regex("' G65 P9\\d+ Z'OpFieldData#\\('" + field + "'\\)' F\\d+'"), sites);
}

void routineMisspelt(const InputFile& file, const Bundle&, Sites& sites) {
  static const std::regex call("^\\s*(\\w+)\\s*$");
  eachMatch(
      file, call, 1,
      [&](const std::smatch& match) -> Text {
        if (file.code.find("\n" + match.str(1) + ":") == std::string::npos) return std::nullopt;
        return misspelt(match.str(1));
      },
      sites);
}

} // namespace

std::vector<Operator> postOperators() {
  return {
      droppingLines("end-lost", "p", "^\\s*END\\b"),
      droppingLines("return-lost", "p", "^\\s*RETURN\\b"),
      taking("eol-lost", "p", "( EOL)\\b", 1),
      replacing("eol-doubled", "p", "\\b(EOL)\\b", 1, [](const std::smatch&) { return Text("EOL EOL"); }),
      replacing("field-of-post-misspelt", "p", kField, 1,
                [](const std::smatch& match) { return Text(misspelt(match.str(1))); }),
      nextOne("field-of-post-other", kField),
      replacing(
          "keyword-misspelt", "p",
          "\\b(SpinOff|CoolOff|SeqC|ZCP1|OpFieldData|FORMAT|CycleType|SetFlagF?|Flag|EOL|RETURN|END)\\b", 1,
          [](const std::smatch& match) { return shortened(match.str(1)); }),
      taking("hash-of-keyword-lost", "p", "OpFieldData(#)", 1),
      replacing("cycle-misspelt", "p", kCycle, 1,
                [](const std::smatch& match) { return Text(misspelt(match.str(1))); }),
      nextOne("cycle-other", kCycle),
      {"routine-misspelt", "p", routineMisspelt},
      taking("picture-decimals", "p", "^\\s*#\\d+ = '#*\\.(#)", 1),
      taking("picture-zero-lost", "p", "^\\s*#\\d+ = '[^';]*(;[^']*)'", 1),
      replacing("format-other", "p", "FORMAT\\([^,]*,(\\d+)\\)", 1,
                [](const std::smatch& match) { return Text(std::to_string(std::stoi(match.str(1)) + 1)); }),
      {"address-other", "p", addressOther},
      taking("address-lost", "p", "([A-Z])'OpFieldData#", 1),
      taking("argument-of-post-lost", "p", "(' [A-Z]'OpFieldData#\\('[^']+'\\))", 1),
      replacing("sign-of-post", "p", "([A-Z])'OpFieldData#", 1,
                [](const std::smatch& match) { return Text(match.str(1) + "-"); }),
      droppingLines("probe-on-lost", "p", "' (M31|G65 P9832)'"),
      droppingLines("probe-off-lost", "p", "' (M32|G65 P9833)'"),
      {"retract-of-post-lost", "p", retractLost},
      taking("feed-lost", "p", "( F\\d+)'", 1),
      replacing("program-number-swapped", "p", "G65 P(\\d+)", 1,
                [](const std::smatch& match) { return swapped(match.str(1)); }),
      replacing("m-code-swapped", "p", "' M(\\d\\d)\\b", 1,
                [](const std::smatch& match) { return swapped(match.str(1)); }),
      replacing("offset-number-outside", "p", "' G(5)[4-9]\\b", 1,
                [](const std::smatch&) { return Text("6"); }),
  };
}

} // namespace dotek::tests
