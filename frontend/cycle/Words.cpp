#include "frontend/cycle/Words.h"

#include "support/Ascii.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dotek::frontend::cycle {
namespace {

using View = std::string_view;

constexpr std::array<View, 11> kTypes = {"length", "angle", "feed",   "time",        "count",      "ratio",
                                         "flag",   "text",  "choice", "work_offset", "tool_offset"};
constexpr std::array<View, 7> kUnits = {"", "mm", "in", "deg", "mm/min", "in/min", "s"};
constexpr std::array<View, 4> kToolParts = {"length", "length_wear", "radius", "radius_wear"};
constexpr std::array<View, 12> kOperators = {
    " + ", " - ", " * ", " / ", " < ", " <= ", " > ", " >= ", " is ", " is not ", " and ", " or "};

constexpr std::array<View, 27> kStatements = {
    "cycle",   "options", "use",  "needs", "parameter", "result", "require", "probe", "spindle",
    "coolant", "dwell",   "stop", "alarm", "report",    "move",   "rapid",   "feed",  "protected",
    "touch",   "set",     "if",   "else",  "end",       "repeat", "for",     "while", "call"};
constexpr std::array<View, 16> kOthers = {"optional", "of",   "on",   "off",  "to",    "by", "start", "here",
                                          "machine",  "work", "tool", "then", "given", "is", "not",   "and"};

constexpr std::array<std::pair<View, View>, 27> kUsage = {{
    {"cycle", "`cycle bore \"Bore, four touches\"`"},
    {"options", "`options datum \"Work offset that the cycle sets\"`"},
    {"use", "`use datum`"},
    {"needs", "`needs probe`"},
    {"parameter", "`parameter depth : length = 5 mm \"Depth below the start\"`"},
    {"result", "`result size : length \"Measured diameter\"`"},
    {"require", "`require depth > 0 mm \"The depth is positive\"`"},
    {"probe", "`probe on` or `probe off`"},
    {"spindle", "`spindle off`"},
    {"coolant", "`coolant off`, `coolant flood` or `coolant mist`"},
    {"dwell", "`dwell 0.5 s`"},
    {"stop", "`stop \"Check the tool\"`"},
    {"alarm", "`alarm \"Diameter out of tolerance\"`"},
    {"report", "`report \"Diameter\" nominal diameter measured size tolerance 0.05 mm`"},
    {"move", "`move to x 10 mm, y 5 mm`, `move by z -5 mm` or `move to start`"},
    {"rapid", "`rapid move to x 10 mm, y 5 mm`"},
    {"feed", "`feed move to x 10 mm feed 500 mm/min`"},
    {"protected", "`protected move by z -5 mm`"},
    {"touch", "`touch x by 10 mm -> right` or `touch z to -5 mm -> top`"},
    {"set", "`set G54: right.at becomes x 0 mm`, `set tool 3 length 80 mm`, `set tool 3 radius_wear 0.02 mm` "
            "or `set stored NAME value`"},
    {"if", "`if size > 30 mm then`"},
    {"else", "`else` or `else if size > 30 mm then`"},
    {"end", "`end`"},
    {"repeat", "`repeat 3 times`"},
    {"for", "`for i = 1 to 4`"},
    {"while", "`while error > 0.01 mm at most 5 times`"},
    {"call", "`call bore diameter = 30 mm, depth = 8 mm -> hole`"},
}};

template <class Names> bool isIn(View word, const Names& names) {
  return std::find(names.begin(), names.end(), word) != names.end();
}

} // namespace

std::string_view toolPartText(ToolPart part) {
  return kToolParts[static_cast<std::size_t>(part)];
}
std::optional<ToolPart> toolPartOf(std::string_view text) {
  const auto at = std::find(kToolParts.begin(), kToolParts.end(), text);
  if (at == kToolParts.end()) return std::nullopt;
  return static_cast<ToolPart>(at - kToolParts.begin());
}
std::string_view unitText(Unit unit) {
  return kUnits[static_cast<std::size_t>(unit)];
}
char axisLetter(Axis axis) {
  return "xyzabc"[static_cast<std::size_t>(axis)];
}
std::string_view operatorText(BinaryOp op) {
  return kOperators[static_cast<std::size_t>(op)];
}
std::string_view typeText(TypeName type) {
  return kTypes[static_cast<std::size_t>(type)];
}

std::span<const std::string_view> typeWords() {
  return kTypes;
}

std::span<const std::string_view> statementWords() {
  return kStatements;
}

bool isReserved(View word) {
  const bool axis = word.size() == 1 && View("xyzabc").find(word) != View::npos;
  return axis || word == "or" || isIn(word, kStatements) || isIn(word, kOthers) || isIn(word, kTypes) ||
         (!word.empty() && isIn(word, kUnits));
}

bool isName(View word) {
  const auto small = [](char c) { return c >= 'a' && c <= 'z'; };
  return !word.empty() && small(word[0]) &&
         std::all_of(word.begin(), word.end(), [&](char c) { return small(c) || isDigit(c) || c == '_'; });
}

std::string proposeName(View word) {
  // German umlauts as they are written without them; other letters with accents lose these.
  constexpr std::array<std::pair<View, View>, 24> kLetters = {
      {{"\u00E4", "ae"}, {"\u00F6", "oe"}, {"\u00FC", "ue"}, {"\u00DF", "ss"}, {"\u00C4", "ae"},
       {"\u00D6", "oe"}, {"\u00DC", "ue"}, {"\u00E1", "a"},  {"\u010D", "c"},  {"\u010F", "d"},
       {"\u00E9", "e"},  {"\u011B", "e"},  {"\u00ED", "i"},  {"\u0148", "n"},  {"\u00F3", "o"},
       {"\u0159", "r"},  {"\u0161", "s"},  {"\u0165", "t"},  {"\u00FA", "u"},  {"\u016F", "u"},
       {"\u00FD", "y"},  {"\u017E", "z"},  {"\u00E8", "e"},  {"\u00F1", "n"}}};
  std::string out;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const auto letter = std::find_if(kLetters.begin(), kLetters.end(),
                                     [&](const auto& one) { return word.substr(i).starts_with(one.first); });
    if (letter != kLetters.end()) {
      out += letter->second;
      ++i;
      continue;
    }
    const char c = word[i];
    const bool capital = c >= 'A' && c <= 'Z';
    const bool afterSmall = i > 0 && word[i - 1] >= 'a' && word[i - 1] <= 'z';
    if (capital && afterSmall) out += '_';
    if (capital)
      out += static_cast<char>(c - 'A' + 'a');
    else if ((c >= 'a' && c <= 'z') || isDigit(c))
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_')
    out.pop_back();
  if (out.empty() || isDigit(out[0])) out = "value" + (out.empty() ? "" : "_" + out);
  return isReserved(out) ? out + "_value" : out;
}

bool sharesPart(View one, View other) {
  constexpr std::size_t kBeginning = 3, kPart = 4;
  const bool begins = one.size() >= kBeginning && other.size() >= kBeginning &&
                      (one.starts_with(other) || other.starts_with(one));
  const auto has = [&](View part) {
    for (View rest = other; !rest.empty();) {
      const std::size_t end = std::min(rest.find('_'), rest.size());
      if (rest.substr(0, end) == part) return true;
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
  };
  for (View rest = one; !rest.empty() && !begins;) {
    const std::size_t end = std::min(rest.find('_'), rest.size());
    if (end >= kPart && has(rest.substr(0, end))) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return begins;
}

std::optional<TypeName> typeOf(View word) {
  const auto at = std::find(kTypes.begin(), kTypes.end(), word);
  if (at == kTypes.end()) return std::nullopt;
  return static_cast<TypeName>(at - kTypes.begin());
}

std::optional<Unit> unitOf(View text) {
  const auto at = std::find(kUnits.begin(), kUnits.end(), text);
  if (at == kUnits.end()) return std::nullopt;
  return static_cast<Unit>(at - kUnits.begin());
}

std::string_view usageOf(View word) {
  const auto at =
      std::find_if(kUsage.begin(), kUsage.end(), [&](const auto& entry) { return entry.first == word; });
  return at == kUsage.end() ? View() : at->second;
}

} // namespace dotek::frontend::cycle
