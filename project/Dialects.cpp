#include "project/Dialects.h"

#include "support/Ascii.h"

#include <algorithm>
#include <span>

namespace dotek::project {
namespace {

using View = std::string_view;

enum Dialect : std::size_t {
  Sinumerik,
  Heidenhain,
  HeidenhainIso,
  Okuma,
  LinuxCnc,
  Fagor,
  Printer,
  Script,
  Markdown,
  Semicolons
};

constexpr std::array<View, 10> kNames = {
    "Sinumerik",
    "Heidenhain conversational",
    "ISO blocks that end with `*`, as Heidenhain or a plotter reads them",
    "Okuma OSP",
    "LinuxCNC",
    "Fagor",
    "a 3D printer",
    "source code of another language",
    "no language that Dotek reads",
    "G code with comments after `;`"};

struct Sign {
  Dialect dialect;
  View text;
  int weight; // kCertain: no input of Dotek has it
};

constexpr int kCertain = 5;

// At the beginning of a line, after its block number.
constexpr std::array kBegins = {
    Sign{Sinumerik, "%_N_", 5},
    Sign{Sinumerik, ";$PATH", 5},
    Sign{Sinumerik, "DEF REAL", 4},
    Sign{Sinumerik, "DEF INT", 4},
    Sign{Sinumerik, "DEF BOOL", 4},
    Sign{Sinumerik, "DEF STRING", 4},
    Sign{Sinumerik, "DEF AXIS", 4},
    Sign{Sinumerik, "PROC ", 4},
    Sign{Sinumerik, "EXTERN ", 4},
    Sign{Sinumerik, "MCALL", 3},
    Sign{Sinumerik, "MSG(", 3},
    Sign{Sinumerik, "STOPRE", 3},
    Sign{Sinumerik, "TRAFOOF", 3},
    Sign{Sinumerik, "TRANS", 3},
    Sign{Sinumerik, "ATRANS", 3},
    Sign{Sinumerik, "AROT", 3},
    Sign{Sinumerik, "ROT ", 3},
    Sign{Sinumerik, "SETAL(", 4},
    Sign{Sinumerik, "WORKPIECE(", 4},
    Sign{Sinumerik, "CYCLE", 3},
    Sign{Sinumerik, "POCKET", 2},
    Sign{Sinumerik, "HOLES", 2},
    Sign{Sinumerik, "LIMS=", 3},
    Sign{Sinumerik, "ENDPROC", 3},
    Sign{Sinumerik, "SUPA", 3},
    Sign{Heidenhain, "BEGIN PGM", 5},
    Sign{Heidenhain, "END PGM", 5},
    Sign{Heidenhain, "TOOL CALL", 4},
    Sign{Heidenhain, "TOOL DEF", 4},
    Sign{Heidenhain, "BLK FORM", 4},
    Sign{Heidenhain, "CYCL DEF", 4},
    Sign{Heidenhain, "CYCL CALL", 4},
    Sign{Heidenhain, "CALL LBL", 4},
    Sign{Heidenhain, "CALL PGM", 4},
    Sign{Heidenhain, "TCH PROBE", 4},
    Sign{Heidenhain, "LBL ", 3},
    Sign{Heidenhain, "FN 0", 2},
    Sign{Heidenhain, "FN 9", 2},
    Sign{Heidenhain, "L X", 2},
    Sign{Heidenhain, "L Y", 2},
    Sign{Heidenhain, "L Z", 2},
    Sign{Okuma, "MODIN", 3},
    Sign{Okuma, "MODOUT", 3},
    Sign{Okuma, "NLAP", 3},
    Sign{Okuma, "LET ", 2},
    Sign{Okuma, "CALL O", 3},
    Sign{Okuma, "RTS", 2},
    Sign{LinuxCnc, "O<", 4},
    Sign{LinuxCnc, "#<", 3},
    Sign{Fagor, "$IF", 3},
    Sign{Fagor, "$FOR", 3},
    Sign{Fagor, "$WHILE", 3},
    Sign{Fagor, "$GOTO", 3},
    Sign{Fagor, "#MSG[", 3},
    Sign{Fagor, "#TOOL", 3},
    Sign{Fagor, "(RPT N", 3},
    Sign{Fagor, "(PCALL", 3},
    Sign{Fagor, "(CALL ", 2},
    Sign{Printer, "M104 S", 3},
    Sign{Printer, "M109 S", 3},
    Sign{Printer, "M140 S", 3},
    Sign{Printer, "M190 S", 3},
    Sign{Printer, ";LAYER", 3},
    Sign{Printer, "IF {", 3},
    Sign{Printer, "WHILE {", 3},
    Sign{Printer, "ECHO ", 2},
    Sign{Script, "FUNCTION ", 4},
    Sign{Script, "VAR ", 3},
    Sign{Script, "CONST ", 3},
    Sign{Script, "LET ", 2},
    Sign{Script, "//", 2},
    Sign{Script, "/*", 2},
    Sign{Script, "DEF ", 2},
    Sign{Script, "IMPORT ", 3},
    Sign{Script, "#!/", 5},
    Sign{Script, "});", 2},
    Sign{Script, "};", 2},
    Sign{Script, "RETURN;", 2},
    Sign{Markdown, "```", 5},
    Sign{Markdown, "|--", 3},
    Sign{Markdown, "- **", 3},
    Sign{Script, "END IF", 4},
    Sign{Script, "END SUB", 5},
    Sign{Script, "END FUNCTION", 5},
    Sign{Script, "DIM ", 3},
    Sign{Script, "PRINT *", 5},
    Sign{Script, "SUBROUTINE ", 4},
    Sign{Script, "#INCLUDE <", 4},
    Sign{Script, "#DEFINE ", 3},
    Sign{Script, "PUBLIC ", 3},
    Sign{Script, "CLASS ", 3},
    Sign{Script, "@ECHO ", 4},
    Sign{Script, "PRINTF(", 3},
};

// Anywhere in a line.
constexpr std::array kHolds = {
    Sign{Sinumerik, "GOTOF ", 4}, Sign{Sinumerik, "GOTOB ", 4}, Sign{Sinumerik, "$P_", 4},
    Sign{Sinumerik, "$AA_", 4},   Sign{Sinumerik, "$AC_", 4},   Sign{Sinumerik, "$TC_", 4},
    Sign{Sinumerik, "$MN_", 4},   Sign{Sinumerik, "$A_", 4},    Sign{Sinumerik, " SUPA ", 3},
    Sign{Sinumerik, "MEAS=", 3},  Sign{Sinumerik, "T=\"", 4},   Sign{Heidenhain, " FMAX", 3},
    Sign{Okuma, "VTOFH[", 4},     Sign{Okuma, "VZOFX[", 4},     Sign{Okuma, "VZOFZ[", 4},
    Sign{Okuma, "VAPA", 3},       Sign{Okuma, "VATOL", 3},      Sign{Okuma, ".MIN%", 5},
    Sign{Fagor, "V.P.", 4},       Sign{Fagor, "V.S.", 4},       Sign{Script, "=> {", 3},
    Sign{Script, ") {", 2},
};

View trimmed(View text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
    text.remove_suffix(1);
  return text;
}

std::size_t digitsAt(View text, std::size_t at) {
  std::size_t n = at;
  while (n < text.size() && isDigit(text[n]))
    ++n;
  return n - at;
}

// After `N10`, or the bare number of a Heidenhain block.
View withoutNumber(View text) {
  const std::size_t letter = text.starts_with('N') ? 1 : 0;
  const std::size_t digits = digitsAt(text, letter);
  if (digits == 0) return text;
  const View rest = text.substr(letter + digits);
  return letter == 1 || rest.starts_with(' ') ? trimmed(rest) : text;
}

// `R1=`, `VC1=`: a word of the given letters and a number that a value is given to.
bool assigns(View text, View letters) {
  for (std::size_t at = text.find(letters); at != View::npos; at = text.find(letters, at + 1)) {
    if (at > 0 && isLetter(text[at - 1])) continue;
    const std::size_t begin = at + letters.size();
    const std::size_t digits = digitsAt(text, begin);
    if (digits > 0 && trimmed(text.substr(begin + digits)).starts_with('=')) return true;
  }
  return false;
}

// An axis or a feed that takes its value after `=`, `X=R1`.
bool givesByEquals(View text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const bool alone = i == 0 || text[i - 1] == ' ' || isDigit(text[i - 1]);
    if (alone && View("XYZABCIJKFS").find(text[i]) != View::npos && text[i + 1] == '=') return true;
  }
  return false;
}

// LinuxCNC: O100 IF, O9 SUB.
bool isOWord(View text) {
  constexpr std::array<View, 15> kWords = {"SUB",   "ENDSUB",   "IF",     "ELSEIF",    "ELSE",
                                           "ENDIF", "WHILE",    "DO",     "ENDWHILE",  "REPEAT",
                                           "CALL",  "CONTINUE", "RETURN", "ENDREPEAT", "BREAK"};
  if (!text.starts_with('O')) return false;
  const View word = trimmed(text.substr(1 + digitsAt(text, 1)));
  return word.size() + 1 < text.size() && std::any_of(kWords.begin(), kWords.end(), [&](View one) {
           return word == one || (word.starts_with(one) && word.size() > one.size() &&
                                  View(" [(<").find(word[one.size()]) != View::npos);
         });
}

} // namespace

void Dialects::see(std::size_t dialect, int weight, View sign) {
  Seen& seen = seen_[dialect];
  if (seen.weight == 0) seen.sign = sign;
  seen.weight += weight;
  certain_ = certain_ || weight == kCertain;
}

void Dialects::look(View line) {
  const std::string folded = upperCase(trimmed(line));
  if (folded.empty()) return;
  const View text = folded;
  const View body = withoutNumber(text);
  // `trans = 3` gives a variable a value.
  const std::size_t name =
      std::min(text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789 "), text.size());
  const bool assignment = name > 0 && name < text.size() && text[name] == '=';
  for (const Sign& sign : kBegins) {
    if (assignment && sign.text.find('=') == View::npos) continue;
    if (text.starts_with(sign.text) || body.starts_with(sign.text))
      see(sign.dialect, sign.weight, trimmed(sign.text));
  }
  for (const Sign& sign : kHolds)
    if (text.find(sign.text) != View::npos) see(sign.dialect, sign.weight, trimmed(sign.text));
  const View code = trimmed(text.substr(0, text.find(';')));
  if (assigns(code, "R") && code.find('[') == View::npos) see(Sinumerik, 2, "R1=");
  if (!assignment && givesByEquals(code) && code.find('(') == View::npos && code.size() < 80)
    see(Sinumerik, 1, "X=");
  if (assigns(code, "Q")) see(Heidenhain, 1, "Q1 =");
  if (assigns(code, "VC")) see(Okuma, 4, "VC1=");
  if (body.starts_with("IF") && body.find("[VC") != View::npos) see(Okuma, 4, "VC1");
  if (isOWord(body)) see(LinuxCnc, 4, "O100 IF");
  if (body.starts_with("(IF ") && body.find("GOTO N") != View::npos) see(Fagor, 4, "(IF .. GOTO N..)");
  if (body.starts_with("(P") && digitsAt(body, 2) > 0 && body.find('=') != View::npos)
    see(Fagor, 3, "(P1=..)");
  if (body.starts_with('%') && body.ends_with('*') && body.size() > 4) see(HeidenhainIso, 4, "%.. *");
  if (body.ends_with('*') && body.size() > 2 && isDigit(body[1])) see(HeidenhainIso, 1, "*");
  if ((body.starts_with("G1 ") || body.starts_with("G0 ")) && body.find(" E") != View::npos &&
      digitsAt(body, body.find(" E") + 2) > 0)
    see(Printer, 2, "E");
  const std::size_t heading = text.find_first_not_of('#');
  if (text.starts_with('#') && heading + 1 < text.size() && text[heading] == ' ' &&
      isLetter(text[heading + 1]))
    see(Markdown, 2, "#");
  const std::size_t semicolon = text.find(';');
  const View remark = semicolon == View::npos ? View() : trimmed(text.substr(semicolon + 1));
  if (remark.size() > 1 && std::count_if(remark.begin(), remark.end(), isLetter) > 1 &&
      !remark.starts_with('('))
    see(Semicolons, 1, ";");
}

std::size_t Dialects::best(int lines) const {
  std::size_t out = 0;
  for (std::size_t i = 1; i < Semicolons; ++i)
    if (seen_[i].weight > seen_[out].weight) out = i;
  const int remarks = seen_[Semicolons].weight;
  const bool language = remarks >= 3 && remarks * 3 > lines;
  return language && seen_[out].weight < 3 ? Semicolons : out;
}

int Dialects::weight(int lines) const {
  return seen_[best(lines)].weight;
}

std::string Dialects::name(int lines) const {
  const std::size_t at = best(lines);
  const std::string name(kNames[at]);
  return at == HeidenhainIso || at >= Script ? name : name + " (`" + seen_[at].sign + "`)";
}

std::optional<std::string> otherFormat(View bytes) {
  struct Magic {
    View begin;
    View name;
  };
  constexpr std::array kMagic = {
      Magic{"\x89PNG", "an image"},
      Magic{"GIF8", "an image"},
      Magic{"\xFF\xD8\xFF", "an image"},
      Magic{"II*\0", "an image"},
      Magic{"PK\x03\x04", "an archive"},
      Magic{"\x1F\x8B", "an archive"},
      Magic{"%PDF-", "a PDF"},
      Magic{"\x7F"
            "ELF",
            "a program"},
      Magic{"{\\rtf", "RTF text"},
  };
  for (const Magic& magic : kMagic)
    if (bytes.starts_with(magic.begin)) return std::string(magic.name);
  if (bytes.starts_with("BM") && bytes.size() > 10 && bytes.substr(6, 4).find('\0') != View::npos)
    return "an image";
  View text = bytes;
  while (!text.empty() &&
         (trimmed(text).size() < text.size() || View("\r\n").find(text.front()) != View::npos)) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == 0 || begin == View::npos) break;
    text.remove_prefix(begin);
  }
  const std::string head = lowerCase(text.substr(0, 40));
  if (head.starts_with("<svg")) return "an SVG picture";
  for (const View tag : {"<?xml", "<!doctype", "<html", "<!--"})
    if (head.starts_with(tag))
      return text.substr(0, 2000).find("<svg") != View::npos ? "an SVG picture" : "HTML or XML";
  if (text.starts_with('{') || text.starts_with('[')) {
    const std::size_t inside = text.find_first_not_of(" \t\r\n", 1);
    const char next = inside == View::npos ? '\0' : text[inside];
    const bool json = next == '"' || (text.starts_with('[') && (next == '{' || next == '[' || next == ']')) ||
                      (text.starts_with('{') && next == '}' && text.size() < 5);
    const std::size_t close = next == '"' ? text.find('"', inside + 1) : View::npos;
    const std::size_t colon = close == View::npos ? close : text.find_first_not_of(" \t\r\n", close + 1);
    const bool named = colon != View::npos && (text[colon] == ':' || text.starts_with('['));
    if (json && (next != '"' || named)) return "JSON";
  }
  return std::nullopt;
}

} // namespace dotek::project
