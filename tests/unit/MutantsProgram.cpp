// Operators of NC programs with Macro B and of programs for Mikroprog.
#include "tests/unit/Mutants.h"

#include <algorithm>
#include <set>

namespace dotek::tests {
namespace {

using Text = std::optional<std::string>;

std::string next(const std::string& digits) {
  return std::to_string(std::stoul(digits) + 1);
}

std::set<std::string> groups(const InputFile& file, const std::regex& pattern) {
  std::set<std::string> out;
  for (std::sregex_iterator match(file.code.begin(), file.code.end(), pattern), none; match != none; ++match)
    out.insert(match->str(1));
  return out;
}

// The numbers that something of the file jumps to.
std::set<std::string> targetsOf(const InputFile& file) {
  return groups(file, std::regex(file.is("s") ? " L(\\d+)" : "GOTO ?(\\d+)"));
}

const std::regex& blockNumber() {
  static const std::regex pattern("^N(\\d+) ?");
  return pattern;
}

void targetLost(const InputFile& file, const Bundle&, Sites& sites) {
  const std::set<std::string> targets = targetsOf(file);
  eachMatch(
      file, blockNumber(), 0,
      [&](const std::smatch& match) { return targets.contains(match.str(1)) ? Text("") : std::nullopt; },
      sites);
}

void targetMissing(const InputFile& file, const Bundle&, Sites& sites) {
  const std::set<std::string> numbers = groups(file, std::regex("N(\\d+)"));
  eachMatch(
      file, std::regex(file.is("s") ? " L(\\d+)" : "GOTO ?(\\d+)"), 1,
      [&](const std::smatch& match) {
        std::string other = next(match.str(1));
        while (numbers.contains(other))
          other = next(other);
        return Text(other);
      },
      sites);
}

void numberDoubled(const InputFile& file, const Bundle&, Sites& sites) {
  const std::set<std::string> targets = targetsOf(file);
  eachMatch(
      file, blockNumber(), 1,
      [&](const std::smatch& match) -> Text {
        const auto other = targets.upper_bound(match.str(1));
        if (other != targets.end()) return *other;
        return targets.empty() || *targets.begin() == match.str(1) ? std::nullopt : Text(*targets.begin());
      },
      sites);
}

void stepLost(const InputFile& file, const Bundle&, Sites& sites) {
  dropLines(file, std::regex("^(#\\d+)=\\1[-+]\\d"), sites);
}

// Letters of the arguments of calls, with their values.
const char* const kArgument = " ?([A-FH-KM-Z])(#?\\[[^\\]]*\\]|#?-?[0-9.]+)";

void eachArgument(const InputFile& file,
                  const std::function<void(const Line&, const std::smatch&, std::size_t)>& visit) {
  static const std::regex call("G65 ?P\\d+");
  static const std::regex argument(kArgument);
  for (const Line& line : linesOf(file)) {
    std::smatch found;
    if (!std::regex_search(line.code, found, call)) continue;
    const std::size_t from = static_cast<std::size_t>(found.position() + found.length());
    const std::string rest = line.code.substr(from);
    for (std::sregex_iterator match(rest.begin(), rest.end(), argument), none; match != none; ++match)
      visit(line, *match, from);
  }
}

void callLetterOther(const InputFile& file, const Bundle&, Sites& sites) {
  eachArgument(file, [&](const Line& line, const std::smatch& match, std::size_t from) {
    char letter = match.str(1)[0];
    do
      letter = letter == 'Z' ? 'A' : static_cast<char>(letter + 1);
    while (std::string_view("GLNOP").find(letter) != std::string_view::npos ||
           line.code.find(letter) != std::string::npos);
    sites.push_back(
        {line.offset + from + static_cast<std::size_t>(match.position(1)), 1, std::string(1, letter)});
  });
}

void callLetterLost(const InputFile& file, const Bundle&, Sites& sites) {
  eachArgument(file, [&](const Line& line, const std::smatch& match, std::size_t from) {
    sites.push_back({line.offset + from + static_cast<std::size_t>(match.position()),
                     static_cast<std::size_t>(match.length()), ""});
  });
}

// A block that reads a result, within three blocks after what measures, moves before it.
void readBeforeCall(const InputFile& file, const Bundle&, Sites& sites) {
  static const std::regex measures("G31|G65 ?P(98(0[0-9]|1[1-9])|9023|8\\d\\d\\d|7\\d\\d)");
  static const std::regex reads("^#[^=]*=.*#(1[23]\\d|506\\d|520)|^IF\\[.*#506\\d");
  const std::vector<Line> lines = linesOf(file);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!std::regex_search(lines[i].code, measures)) continue;
    for (std::size_t k = i + 1; k < std::min(i + 4, lines.size()); ++k) {
      if (!std::regex_search(lines[k].code, reads)) continue;
      sites.push_back({lines[i].offset, lines[k].offset + lines[k].length - lines[i].offset,
                       file.text.substr(lines[k].offset, lines[k].length) + "\n" +
                           file.text.substr(lines[i].offset, lines[k].offset - lines[i].offset - 1)});
    }
  }
}

void waitLost(const InputFile& file, const Bundle&, Sites& sites) {
  static const std::regex wait("^(N\\d+ ?)?(G53|G4 ?P\\d+)$");
  const std::vector<Line> lines = linesOf(file);
  for (std::size_t i = 1; i + 1 < lines.size(); ++i)
    if (std::regex_search(lines[i].code, wait) && lines[i - 1].code.find("G31") == std::string::npos)
      sites.push_back(dropLine(file, lines[i]));
}

// A move along Z alone to a place that is higher than the one before.
void retractLost(const InputFile& file, const Bundle&, Sites& sites) {
  static const std::regex move("Z(#?-?[0-9.]+)");
  static const std::regex others("[XYDSR][-#0-9\\[]");
  std::optional<double> before;
  for (const Line& line : linesOf(file)) {
    std::smatch match;
    if (!std::regex_search(line.code, match, move) || match.str(1)[0] == '#') continue;
    const double z = std::stod(match.str(1));
    if (before && z > *before && !std::regex_search(line.code, others)) sites.push_back(dropLine(file, line));
    before = z;
  }
}

void incrementalLeft(const InputFile& file, const Bundle&, Sites& sites) {
  bool incremental = false;
  for (const Line& line : linesOf(file)) {
    if (incremental && line.code == "G90") sites.push_back(dropLine(file, line));
    if (line.code.find("G91") != std::string::npos) incremental = true;
    if (line.code.find("G90") != std::string::npos) incremental = false;
  }
}

void alarmTextLost(const InputFile& file, const Bundle&, Sites& sites) {
  static const std::regex alarm("#3000=\\d+(\\([^)]*\\))");
  for (std::sregex_iterator match(file.text.begin(), file.text.end(), alarm), none; match != none; ++match)
    sites.push_back(
        {static_cast<std::size_t>(match->position(1)), static_cast<std::size_t>(match->length(1)), ""});
}

Text turnedCoordinate(const std::smatch& match) {
  if (match.str(2).find_first_not_of("0.") == std::string::npos) return std::nullopt;
  return match.str(1).empty() ? "-" + match.str(2) : match.str(2);
}

Text swappedFunction(const std::smatch& match) {
  if (match.str(1) == "31") return "1";
  if (match.str(1) == "1") return "31";
  return swapped(match.str(1));
}

Text otherAxis(const std::smatch& match) {
  return match.str(1) == "3" ? "1" : next(match.str(1));
}

Text to(const char* text) {
  return Text(text);
}

Operator becoming(std::string_view id, std::string_view kinds, const char* pattern, const char* text) {
  return replacing(id, kinds, pattern, 1, [text](const std::smatch&) { return to(text); });
}

} // namespace

std::vector<Operator> programOperators() {
  const auto swap = [](const std::smatch& match) { return swapped(match.str(1)); };
  return {
      droppingLines("probe-on-lost", "n", "^(N\\d+ ?)?(M31|G65 ?P9832)$"),
      droppingLines("probe-off-lost", "n", "^(N\\d+ ?)?(M32|G65 ?P9833)$"),
      {"retract-of-post-lost", "n", retractLost},
      taking("feed-lost", "n", "(?:G31|G1[^0-9]|P9\\d10|P9770).*?( ?F(#\\d+|\\[[^\\]]*\\]|[0-9.]+))", 1),
      replacing("program-number-swapped", "n", "G65 ?P(\\d+)", 1, swap),
      replacing("m-code-swapped", "ns", "M(\\d\\d)(?!\\d)", 1, swap),
      taking("hash-lost", "n", "(#)[0-9\\[]", 1),
      replacing("local-other", "n", "#([1-9]|[12][0-9]|3[0-2])(?![0-9])", 1,
                [](const std::smatch& match) { return Text(next(match.str(1))); }),
      replacing("variable-swapped", "n", "#(\\d{3,})", 1, swap),
      {"goto-missing", "n", targetMissing},
      {"target-lost", "n", targetLost},
      {"number-doubled", "n", numberDoubled},
      replacing(
          "do-end-other", "n", "(?:DO|END)([123])", 1,
          [](const std::smatch& match) { return match.str(1) == "3" ? to("1") : Text(next(match.str(1))); }),
      taking("equals-lost", "n", "^(?:N\\d+ ?)?#[0-9#\\[\\]+]+(=)", 1),
      becoming("zero-in-goto", "n", "(GOTO)", "G0TO"),
      droppingLines("null-test-lost", "n", "(EQ|NE)#0(?![0-9])"),
      {"step-lost", "n", stepLost},
      {"call-letter-other", "n", callLetterOther},
      {"call-letter-lost", "n", callLetterLost},
      {"read-before-call", "n", readBeforeCall},
      {"wait-lost", "n", waitLost},
      becoming("rapid-for-protected", "n", "(G65 ?P9(?:810|770))", "G0"),
      becoming("g91-for-g90", "n", "(G90)", "G91"),
      {"g91-left", "n", incrementalLeft},
      taking("g90-lost", "n", "(G90 ?)G31", 1),
      droppingLines("g90-lost", "n", "^G90$"),
      becoming("skip-lost", "n", "(G31)", "G1"),
      becoming("skip-added", "n", "(G1)(?![0-9])", "G31"),
      becoming("offset-number-outside", "n", "G(5)[4-9](?![0-9])", "6"),
      becoming("offset-number-outside", "n", "S(5)[4-9]\\.", "6"),
      becoming("offset-number-outside", "n", "P98\\d\\d.* S([1-6])\\.", "7"),
      becoming("offset-number-outside", "n", "L2 ?P([1-6])", "7"),
      replacing("coordinate-turned", "ns", "[XYZ](-?)([0-9.]+)", 0,
                [](const std::smatch& match) -> Text {
                  const Text turned = turnedCoordinate(match);
                  return turned ? Text(match.str()[0] + *turned) : std::nullopt;
                }),
      droppingLines("end-of-program-lost", "ns", "\\b(M30|M99)\\b"),
      droppingLines("length-offset-lost", "n", "G43"),
      becoming("position-other", "n", "#50(6)\\d", "4"),
      replacing("position-other", "n", "#506([123])", 1, otherAxis),
      {"alarm-text-lost", "n", alarmTextLost},
      {"jump-target-missing", "s", targetMissing},
      {"number-lost", "s", targetLost},
      droppingLines("guard-lost", "s", "G23 L\\d+ O7"),
      taking("g31-target-lost", "s", "G31.*( L\\d+)", 1),
      replacing("g31-for-g1", "s", "G(\\d+)", 1, swappedFunction),
      taking("feed-of-mikroprog-lost", "s", "( F\\d+)", 1),
  };
}

} // namespace dotek::tests
