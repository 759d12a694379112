#include "project/InputKind.h"

#include "support/Ascii.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

namespace dotek::project {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

bool isNameCharacter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$';
}

std::string_view leadingName(std::string_view line) {
  std::size_t n = 0;
  while (n < line.size() && isNameCharacter(line[n]))
    ++n;
  return line.substr(0, n);
}

struct Marks {
  int prog = 0;
  int macro = 0;
  int dialog = 0;
  int nc = 0;
  int definition = 0;
  int lines = 0;
};

void markProg(std::string_view line, Marks& marks) {
  const std::string_view name = leadingName(line);
  if (name == "RETURN" || name == "EOL") marks.prog += 3;
  if (line.ends_with("EOL") || line.find("EOL ") != std::string_view::npos) marks.prog += 2;
  if (line.starts_with('{') || line.starts_with('\'') || line.starts_with("FORMAT(")) marks.prog += 2;
  if (line.starts_with("IF ") && line.find("?(") != std::string_view::npos) marks.prog += 3;
  if (line.find("#('") != std::string_view::npos || line.find("?('") != std::string_view::npos)
    marks.prog += 2;
  if (line.starts_with('#') && line.find("= '") != std::string_view::npos) marks.prog += 3;
}

void markDialog(std::string_view line, Marks& marks) {
  constexpr std::array<std::string_view, 8> kControls = {"LABEL", "INPUT",  "IMAGE", "FRAME",
                                                         "OK",    "CANCEL", "CHECK", "RADIO"};
  const std::string name = upperCase(leadingName(line));
  const std::string_view rest = trimmed(line.substr(name.size()));
  const auto commas = std::count(line.begin(), line.end(), ',');
  const bool boxed =
      !rest.empty() && std::isdigit(static_cast<unsigned char>(rest.front())) != 0 && commas >= 3;
  if (boxed && std::find(kControls.begin(), kControls.end(), name) != kControls.end()) marks.dialog += 3;
  if (name == "DIALOG" && commas >= 4) marks.dialog += 3;
}

void markMacro(std::string_view line, Marks& marks) {
  constexpr std::array<std::string_view, 14> kWords = {"IF",        "FOR",     "NEXT",  "GOTO",   "CALL",
                                                       "ARGS",      "MESSAGE", "LOCAL", "GLOBAL", "CONTINUE",
                                                       "PERMANENT", "DIALOG",  "STOP",  "DEBUG"};
  const std::string name = upperCase(leadingName(line));
  const std::string_view rest = trimmed(line.substr(name.size()));
  if (line.starts_with(':') || upperCase(line).starts_with("#INCLUDE")) marks.macro += 3;
  if (std::find(kWords.begin(), kWords.end(), name) != kWords.end()) marks.macro += 2;
  if (name.find('_') != std::string::npos && !rest.starts_with('=')) marks.macro += 2;
  if (!name.empty() && rest.starts_with('=')) {
    const std::string_view value = trimmed(rest.substr(
        1, rest.find('!') == std::string_view::npos ? std::string_view::npos : rest.find('!') - 1));
    const bool number = !value.empty() && std::all_of(value.begin(), value.end(), [](char c) {
      return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+';
    });
    if (number)
      ++marks.definition;
    else
      ++marks.macro;
  }
}

// `%`, program headers, macro statements, words of a letter and a number.
void markNc(std::string_view line, Marks& marks) {
  std::string text; // without blanks and comments
  bool comment = false;
  for (const char c : line) {
    comment = comment || c == '(';
    if (!comment && c != ' ' && c != '\t') text += c;
    if (c == ')') comment = false;
  }
  std::string_view rest = text;
  const auto at = [&](std::size_t i) { return i < rest.size() ? rest[i] : '\0'; };
  const auto digit = [&](std::size_t i) { return std::isdigit(static_cast<unsigned char>(at(i))) != 0; };
  const auto skipDigits = [&](std::size_t i) {
    while (digit(i))
      ++i;
    return i;
  };
  if (rest == "%" || (at(0) == '<' && at(rest.size() - 1) == '>')) marks.nc += 3;
  if ((at(0) == 'O' || at(0) == ':') && digit(1) && skipDigits(1) == rest.size()) marks.nc += 4;
  if (at(0) == '/') rest.remove_prefix(1);
  if (at(0) == 'N' && digit(1)) rest.remove_prefix(skipDigits(1));
  if (at(0) == '#' &&
      (at(1) == '[' || (digit(1) && at(skipDigits(1)) == '=' && at(skipDigits(1) + 1) != '\'')))
    marks.nc += 3;
  for (const std::string_view word : {"IF[", "WHILE[", "DPRNT[", "BPRNT[", "GOTO#", "GOTO["})
    if (rest.starts_with(word)) marks.nc += 3;
  for (const std::string_view word : {"GOTO", "END", "DO"})
    if (rest.starts_with(word) && digit(word.size())) marks.nc += 3;
  const bool value = digit(1) || at(1) == '#' || at(1) == '-' || at(1) == '.';
  if (std::string_view("GMXYZTSF").find(at(0)) != std::string_view::npos && !rest.empty() && value)
    marks.nc += 2;
}

std::optional<InputKind> byName(const std::string& name) {
  const auto ends = [&](std::string_view suffix) { return name.ends_with(suffix); };
  if (name == "DEFINEDATA.TXT") return InputKind::DefineData;
  if (ends(".MAC")) return InputKind::Macro;
  if (ends(".DLG")) return InputKind::Dialog;
  if (ends(".NC")) return InputKind::Nc;
  if (ends(".SUF")) return InputKind::Suf;
  return std::nullopt;
}

} // namespace

constexpr std::string_view kListing = "listing";

std::string_view kindName(InputKind kind) {
  switch (kind) {
  case InputKind::Prog: return "prog";
  case InputKind::Macro: return "mac";
  case InputKind::Dialog: return "dlg";
  case InputKind::DefineData: return "define";
  case InputKind::Nc: return "nc";
  case InputKind::Suf: return "suf";
  }
  return "";
}

bool isListing(const std::optional<std::string>& from) {
  return from == kListing;
}

std::optional<InputKind> kindByName(std::string_view name) {
  if (name == kListing) return InputKind::Nc;
  for (const InputKind kind : {InputKind::Prog, InputKind::Macro, InputKind::Dialog, InputKind::DefineData,
                               InputKind::Nc, InputKind::Suf}) {
    if (kindName(kind) == name) return kind;
  }
  return std::nullopt;
}

std::optional<InputKind> recognise(std::string_view fileName, std::string_view bytes) {
  Marks marks;
  std::size_t at = 0;
  while (at < bytes.size() && marks.lines < 500) {
    const std::size_t end = std::min(bytes.find_first_of("\r\n", at), bytes.size());
    const std::string_view line = trimmed(bytes.substr(at, std::min<std::size_t>(end - at, 400)));
    at = end + 1;
    if (line.empty() || line.starts_with('!')) continue;
    ++marks.lines;
    markProg(line, marks);
    markDialog(line, marks);
    markMacro(line, marks);
    markNc(line, marks);
  }
  const std::size_t slash = fileName.find_last_of("/\\");
  const std::string name = upperCase(slash == std::string_view::npos ? fileName : fileName.substr(slash + 1));
  const auto named = byName(name);
  // A name that is fixed in GibbsCAM says more than a damaged content.
  // Words of Mikroprog look like any NC.
  if (named == InputKind::DefineData || named == InputKind::Suf) return named;
  const int best = std::max({marks.prog, marks.macro, marks.dialog});
  if (marks.nc > best || (named == InputKind::Nc && best < 2)) return InputKind::Nc;
  if (best >= 2) {
    if (marks.prog == best && marks.prog > marks.macro) return InputKind::Prog;
    if (marks.dialog == best && marks.dialog > marks.macro) return InputKind::Dialog;
    if (marks.macro == best) return named == InputKind::Dialog ? named : InputKind::Macro;
  }
  if (named) return named;
  if (marks.definition > 0 && marks.definition == marks.lines) return InputKind::DefineData;
  return std::nullopt;
}

} // namespace dotek::project
