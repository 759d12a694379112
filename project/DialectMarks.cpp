#include "project/DialectMarks.h"

#include "support/Ascii.h"

#include <algorithm>
#include <array>

namespace dotek::project {
namespace {

using View = std::string_view;
using enum Tongue;

constexpr std::array<TongueFacts, kTongues> kFacts = {{
    {Sinumerik, "Sinumerik (Siemens)", 3, true,
     "its R parameters are `#100..` of Macro B, GOTOF and GOTOB are GOTO, MEAS is G31"},
    {Heidenhain, "Heidenhain conversational", 3, true,
     "its Q parameters are `#100..` of Macro B, FN 9 to 12 are IF and GOTO, L is G1, CALL LBL is M98"},
    {HeidenhainIso, "Heidenhain DIN/ISO, with blocks that end with `*`", 4, true,
     "Macro B has its blocks without `*`, and cycles of its own"},
    {Okuma, "Okuma OSP", 3, true,
     "its VC variables are `#100..` of Macro B, `IF [..] NX` is IF and GOTO with a number, CALL is G65"},
    {LinuxCnc, "LinuxCNC or a control of its family", 3, true,
     "its o-words are IF, WHILE, GOTO and G65 of Macro B, named variables are `#100..`, G38.2 is G31"},
    {Grbl, "Grbl", 4, true, "its lines that begin with `$` are commands to the firmware; take them out"},
    {RepRap, "RepRapFirmware (Duet)", 3, true,
     "its `if`, `while` and `var` are IF, WHILE and `#..` of Macro B, G38.2 is G31"},
    {Printer, "a 3D printer (Marlin and the like)", 6, true, ""},
    {Klipper, "Klipper", 4, true, ""},
    {Fagor, "Fagor", 5, true, "its P parameters are `#..` of Macro B, `(IF .. GOTO N..)` is IF and GOTO"},
    {Fadal, "Fadal format 1", 6, true, "its R variables and `#` lines are `#..`, IF and GOTO of Macro B"},
    {Eding, "Eding CNC", 5, true,
     "its SUB and GOSUB are programs of their own and M98, IF with ELSE is IF and GOTO of Macro B"},
    {WireEdm, "a wire EDM (AccuteX and the like)", 5, true, "its E codes choose conditions of the generator"},
    {Parameters, "the parameter memory of a control, not for running", 8, true,
     "the control reads it in a screen of its own; leave it out of a folder of programs"},
    {Script, "source code of another language", 2, false, ""},
    {Markdown, "no language that Dotek reads", 2, false, ""},
}};

std::size_t digitsAt(View text, std::size_t at) {
  std::size_t n = at;
  while (n < text.size() && isDigit(text[n]))
    ++n;
  return n - at;
}
std::size_t lettersAt(View text, std::size_t at) {
  std::size_t n = at;
  while (n < text.size() && isLetter(text[n]))
    ++n;
  return n - at;
}

// The given letters, a number and `=`: `R1=`, `VC1=`.
bool assigns(View text, View letters) {
  for (std::size_t at = text.find(letters); at != View::npos; at = text.find(letters, at + 1)) {
    if (at > 0 && (isLetter(text[at - 1]) || text[at - 1] == '#')) continue;
    const std::size_t begin = at + letters.size();
    const std::size_t digits = digitsAt(text, begin);
    if (digits > 0 && trimmedText(text.substr(begin + digits)).starts_with('=')) return true;
  }
  return false;
}

// ---- shapes of a line without its number and its round brackets

bool givesRParameter(View body) {
  return body.find_first_of("[#") == View::npos && assigns(body, "R");
}
bool givesQParameter(View body) {
  return assigns(body, "Q") || assigns(body, "QL") || assigns(body, "QS");
}
bool givesVc(View body) {
  return assigns(body, "VC") || (body.starts_with("IF") && body.find("[VC") != View::npos);
}
// An axis or a feed that takes its value after `=`, `X=R1`.
bool givesByEquals(View body) {
  if (body.size() >= 80) return false;
  const std::size_t name =
      std::min(body.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789 "), body.size());
  const bool assignment = name > 0 && name < body.size() && body[name] == '=';
  if (assignment) return false;
  for (std::size_t i = 0; i + 1 < body.size(); ++i) {
    const bool alone = i == 0 || body[i - 1] == ' ' || isDigit(body[i - 1]);
    if (alone && View("XYZABCIJKFS").find(body[i]) != View::npos && body[i + 1] == '=') return true;
  }
  return false;
}
// `CYCLE81(..)`, `CYCLE800()`; not `CYCLE TIME`.
bool callsCycle(View body) {
  return body.starts_with("CYCLE") && digitsAt(body, 5) > 0;
}
bool callsPocket(View body) {
  return (body.starts_with("POCKET") && digitsAt(body, 6) > 0) || body.starts_with("HOLES1") ||
         body.starts_with("HOLES2");
}
// `LABEL:` alone on its line.
bool isLabel(View body) {
  const std::size_t colon = body.find(':');
  if (colon == View::npos || colon < 2 || colon + 1 != body.size()) return false;
  return body.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789") == colon && isLetter(body[0]);
}
// O100 IF, O9 SUB, O[#1] CALL.
bool isOWord(View body) {
  constexpr std::array<View, 17> kWords = {"ENDSUB", "SUB",   "ELSEIF",   "ELSE",      "ENDIF", "IF",
                                           "WHILE",  "DO",    "ENDWHILE", "ENDREPEAT", "CALL",  "CONTINUE",
                                           "RETURN", "BREAK", "REPEAT",   "ALARM",     "ERROR"};
  if (!body.starts_with('O') || body.size() < 4) return false;
  std::size_t at = 1 + digitsAt(body, 1);
  if (at == 1) {
    const char open = body[1];
    const std::size_t close = open == '[' ? body.find(']') : View::npos;
    if (close == View::npos) return false;
    at = close + 1;
  }
  const View rest = trimmedText(body.substr(at));
  return std::any_of(kWords.begin(), kWords.end(), [&](View one) {
    return rest == one || (rest.starts_with(one) && View(" [(<;#").find(rest[one.size()]) != View::npos);
  });
}
bool isRealTimeCommand(View body) {
  if (!body.starts_with('$')) return false;
  const View word = body.substr(1, body.find_first_of(" ;\t") - 1);
  constexpr std::array<View, 12> kWords = {"", "$", "H", "X", "I", "G", "C", "#", "N", "SLP", "HX", "HY"};
  if (word.empty() && trimmedText(body).size() > 1) return false; // `$ ls`, of a shell
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end() || word.starts_with("J=") ||
         word.starts_with("RST=") || word.starts_with("N0=") || word.starts_with("N1=") ||
         (digitsAt(word, 0) > 0 && word.size() > digitsAt(word, 0) && word[digitsAt(word, 0)] == '=');
}
bool isStatusQuery(View body) {
  return trimmedText(body.substr(0, body.find(';'))) == "?";
}
bool endsWithStar(View body) {
  return body.ends_with('*') && body.size() > 2 && isLetter(body[0]) &&
         (isDigit(body[1]) || body[1] == '+' || body[1] == '-');
}
bool beginsStarProgram(View body) {
  return body.starts_with('%') && body.ends_with('*') && body.size() > 4;
}
// `IF [..] NEND`, `IF [PX EQ EMPTY] N4`: a jump without GOTO.
bool jumpsByName(View body) {
  if (!body.starts_with("IF") || body.find('#') != View::npos) return false;
  const std::size_t close = body.rfind(']');
  if (close == View::npos || body.find('[') == View::npos) return false;
  const View target = trimmedText(body.substr(close + 1));
  return target.size() > 1 && target[0] == 'N' &&
         target.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789") == View::npos;
}
// `GOTO NEND`; `GOTO N10` is a slip of Macro B.
bool goesToName(View body) {
  const std::size_t at = body.find("GOTO N");
  return at != View::npos && lettersAt(body, at + 5) >= 2;
}
// `VZOFX[1]=`, `VTOFH[..`: system variables are V and four letters.
bool hasOspVariable(View body) {
  constexpr std::array<View, 14> kNames = {"VZOFX", "VZOFY", "VZOFZ", "VTOFH", "VTOFD", "VDOUT", "VUACM",
                                           "VTLCN", "VTLNN", "VAPAX", "VAPAY", "VAPAZ", "VATOL", "VWKCC"};
  return std::any_of(kNames.begin(), kNames.end(), [&](View one) {
    const std::size_t at = body.find(one);
    return at != View::npos && (at == 0 || !isLetter(body[at - 1]));
  });
}
bool callsOsp(View body) {
  const std::size_t at = body.find("CALL O");
  return at == 0 || (at != View::npos && body[at - 1] == ' ');
}
bool extrudes(View body) {
  if (!body.starts_with("G1 ") && !body.starts_with("G0 ")) return false;
  const std::size_t at = body.find(" E");
  return at != View::npos && digitsAt(body, at + 2 + (body.substr(at + 2).starts_with('-') ? 1 : 0)) > 0;
}
bool isMetaCommand(View body) {
  constexpr std::array<View, 10> kWords = {"IF ",     "ELIF ",   "WHILE ",   "VAR ",    "GLOBAL ",
                                           "SET VAR", "SET GLO", "ABORT \"", "ECHO \"", "ECHO {"};
  if (std::none_of(kWords.begin(), kWords.end(), [&](View one) { return body.starts_with(one); }))
    return false;
  if (body.starts_with("SET ") || body.starts_with("ABORT") || body.starts_with("ECHO")) return true;
  if (body.starts_with("VAR ") || body.starts_with("GLOBAL ")) {
    const std::size_t name = body.find(' ') + 1;
    const std::size_t end = body.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789", name);
    return end != View::npos && trimmedText(body.substr(end)).starts_with('=') && !body.ends_with(';');
  }
  return body.find("VAR.") != View::npos || body.find("GLOBAL.") != View::npos ||
         body.find("PARAM.") != View::npos || body.find("MOVE.") != View::npos ||
         body.find("STATE.") != View::npos || body.find("SENSORS.") != View::npos ||
         body.find("EXISTS(") != View::npos || body.find("ITERATIONS") != View::npos ||
         body.find("JOB.") != View::npos || body.find("RESULT ") != View::npos ||
         ((body.starts_with("IF {") || body.starts_with("WHILE {")) && body.ends_with('}'));
}
bool callsFile(View body) {
  return body.starts_with("M98 P\"") || body.starts_with("M98P\"");
}
bool isKlipperStatement(View body) {
  return body.starts_with("{%") || body.starts_with("[GCODE_MACRO") || body.starts_with("SET_GCODE_");
}
// Beside the brackets: `(P1=10)`, `(IF P1 EQ 0 GOTO N10)`.
bool isFagorStatement(View line) {
  if (line.starts_with("(P") && digitsAt(line, 2) > 0)
    return line.substr(2 + digitsAt(line, 2)).starts_with('=');
  return line.starts_with("(IF P") && digitsAt(line, 5) > 0 && line.find("GOTO N") != View::npos;
}
bool isFadalLine(View body) {
  if (!body.starts_with('#') || body.size() < 4) return false;
  constexpr std::array<View, 8> kWords = {"IF ", "GOTO ", "PRINT", "INPUT", "R", "V", "SETX", "CLEAR"};
  const View rest = trimmedText(body.substr(1));
  return std::any_of(kWords.begin(), kWords.end(), [&](View one) {
    if (one == "R" || one == "V")
      return rest.starts_with(one) && digitsAt(rest, 1) > 0 &&
             trimmedText(rest.substr(1 + digitsAt(rest, 1))).starts_with('=');
    return rest.starts_with(one);
  });
}
bool isEdingWord(View body) {
  constexpr std::array<View, 4> kAlone = {"ENDSUB", "ENDIF", "ENDWHILE", "ELSE"};
  const View word = trimmedText(body.substr(0, body.find(';')));
  if (std::find(kAlone.begin(), kAlone.end(), word) != kAlone.end()) return false; // slips of Macro B too
  return (body.starts_with("GOSUB ") && lettersAt(body, 6) > 1) ||
         (body.starts_with("SUB ") && lettersAt(body, 4) > 1 && body.find('(') == View::npos) ||
         body.starts_with("DLGMSG \"") || body.starts_with("WARNMSG \"") || body.starts_with("ERRMSG \"") ||
         body.starts_with("MSG \"");
}
// `%00227` alone, and `T1.1`: a tool with its offset after a point.
bool beginsFagorProgram(View body) {
  return body.starts_with('%') && digitsAt(body, 1) == 5 && body.size() == 6;
}
bool choosesByPoint(View body) {
  if (!body.starts_with('T')) return false;
  const std::size_t tool = digitsAt(body, 1);
  if (tool == 0 || body.size() < tool + 3 || body[1 + tool] != '.') return false;
  const std::size_t end = tool + 2 + digitsAt(body, tool + 2);
  return end > tool + 2 && (end == body.size() || body[end] == ' ');
}
// `_PROFILE(1,0,"",,)`
bool callsByName(View body) {
  const std::size_t open = body.find('(');
  if (open == View::npos || open < 4 || !body.ends_with(')')) return false;
  const View name = body.substr(0, open);
  return name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789") == View::npos && !isDigit(name[0]) &&
         name.find('_') != View::npos && body.find_first_of(",\"", open) != View::npos;
}
// `TEST=1`; `SPEED=#101` is none.
bool givesName(View body) {
  const std::size_t letters = lettersAt(body, 0);
  if (letters < 3 || body.find_first_of("#[") != View::npos) return false;
  return trimmedText(body.substr(letters)).starts_with('=');
}
bool isAlone(View body, View word) {
  return body == word || (body.starts_with(word) && body[word.size()] == ' ');
}
bool resetsOffset(View body) {
  return isAlone(body, "G500");
}
bool endsSubprogram(View body) {
  return body == "M17";
}
// `M4000 P11 S"Face"`
bool takesText(View body) {
  if (!body.starts_with('M') || digitsAt(body, 1) == 0) return false;
  const std::size_t quote = body.find('"');
  return quote != View::npos && quote > 2 && isLetter(body[quote - 1]) && body[quote - 2] == ' ';
}
// `E001=10 17 16`
bool givesCondition(View body) {
  return body.starts_with('E') && digitsAt(body, 1) == 3 && body.size() > 5 && body[4] == '=' &&
         isDigit(body[5]);
}
// `N1020A1P88A2P90`, `N0000P00000010`: without the number.
bool isParameter(View body) {
  std::size_t at = 0, values = 0;
  while (at < body.size()) {
    if (View("QALSTK").find(body[at]) != View::npos) {
      const std::size_t which = digitsAt(body, at + 1);
      if (which == 0) return false;
      at += 1 + which;
      continue;
    }
    if (body[at] != 'P') return false;
    std::size_t sign = at + 1 < body.size() && body[at + 1] == '-' ? 1 : 0;
    std::size_t end = at + 1 + sign + digitsAt(body, at + 1 + sign);
    if (end < body.size() && body[end] == '.') end += 1 + digitsAt(body, end + 1);
    if (end == at + 1 + sign) return false;
    ++values;
    at = end;
  }
  return values > 0;
}
bool isHeading(View line) {
  if (!line.starts_with('#')) return false;
  const View rest = line.substr(std::min(line.find_first_not_of('#'), line.size()));
  return rest.size() > 1 && rest[0] == ' ' && isLetter(rest[1]);
}
// `L X+10 R0 FMAX`, `L IX-5`: an address with a sign.
bool isKlartextLine(View body) {
  if (!body.starts_with("L ")) return false;
  const View rest = trimmedText(body.substr(2));
  const std::size_t axis = rest.starts_with('I') ? 1 : 0;
  return rest.size() > axis + 1 && View("XYZABCUVW").find(rest[axis]) != View::npos &&
         (rest[axis + 1] == '+' || rest[axis + 1] == '-' || rest[axis + 1] == 'Q');
}

constexpr std::array kMarks = {
    Mark{Sinumerik, Place::Begin, "%_N_", 5},
    Mark{Sinumerik, Place::Begin, ";$PATH", 5},
    Mark{Sinumerik, Place::Begin, "DEF REAL", 4},
    Mark{Sinumerik, Place::Begin, "DEF INT", 4},
    Mark{Sinumerik, Place::Begin, "DEF BOOL", 4},
    Mark{Sinumerik, Place::Begin, "DEF STRING", 4},
    Mark{Sinumerik, Place::Begin, "DEF AXIS", 4},
    Mark{Sinumerik, Place::Begin, "PROC ", 4},
    Mark{Sinumerik, Place::Begin, "EXTERN ", 4},
    Mark{Sinumerik, Place::Begin, "MCALL", 4},
    Mark{Sinumerik, Place::Begin, "MSG(", 4},
    Mark{Sinumerik, Place::Begin, "MSG (", 4},
    Mark{Sinumerik, Place::Begin, "STOPRE", 4},
    Mark{Sinumerik, Place::Begin, "TRAFOOF", 4},
    Mark{Sinumerik, Place::Begin, "TRANS ", 3},
    Mark{Sinumerik, Place::Begin, "ATRANS", 3},
    Mark{Sinumerik, Place::Begin, "AROT", 3},
    Mark{Sinumerik, Place::Begin, "ROT ", 3},
    Mark{Sinumerik, Place::Begin, "SETAL(", 4},
    Mark{Sinumerik, Place::Begin, "WORKPIECE(", 4},
    Mark{Sinumerik, Place::Shape, "CYCLE81", 4, callsCycle},
    Mark{Sinumerik, Place::Shape, "POCKET3", 2, callsPocket},
    Mark{Sinumerik, Place::Begin, "LIMS=", 3},
    Mark{Sinumerik, Place::Begin, "ENDPROC", 3},
    Mark{Sinumerik, Place::Begin, "SUPA", 3},
    Mark{Sinumerik, Place::Begin, "ENDFOR", 3},
    Mark{Sinumerik, Place::Begin, "ENDLOOP", 3},
    Mark{Sinumerik, Place::Word, "GOTOF", 4},
    Mark{Sinumerik, Place::Word, "GOTOB", 4},
    Mark{Sinumerik, Place::Word, "$P_", 4},
    Mark{Sinumerik, Place::Word, "$AA_", 4},
    Mark{Sinumerik, Place::Word, "$AC_", 4},
    Mark{Sinumerik, Place::Word, "$TC_", 4},
    Mark{Sinumerik, Place::Word, "$MN_", 4},
    Mark{Sinumerik, Place::Word, "$A_", 4},
    Mark{Sinumerik, Place::Word, "$MC_", 4},
    Mark{Sinumerik, Place::Word, " SUPA ", 3},
    Mark{Sinumerik, Place::Word, "MEAS=", 4},
    Mark{Sinumerik, Place::Word, "MEAW=", 4},
    Mark{Sinumerik, Place::Word, "T=\"", 4},
    Mark{Sinumerik, Place::Word, "CR=", 3},
    Mark{Sinumerik, Place::Word, "=IC(", 4},
    Mark{Sinumerik, Place::Word, "=AC(", 4},
    Mark{Sinumerik, Place::Word, "=DC(", 4},
    Mark{Sinumerik, Place::Shape, "R1=", 2, givesRParameter},
    Mark{Sinumerik, Place::Shape, "X=", 1, givesByEquals},
    Mark{Sinumerik, Place::Shape, "LABEL:", 2, isLabel},
    Mark{Sinumerik, Place::Shape, "_NAME(..)", 4, callsByName},
    Mark{Sinumerik, Place::Shape, "NAME=", 1, givesName},
    Mark{Sinumerik, Place::Shape, "G500", 2, resetsOffset},
    Mark{Sinumerik, Place::Shape, "M17", 1, endsSubprogram},
    Mark{Heidenhain, Place::Begin, "BEGIN PGM", 5},
    Mark{Heidenhain, Place::Begin, "END PGM", 5},
    Mark{Heidenhain, Place::Begin, "TOOL CALL", 4},
    Mark{Heidenhain, Place::Begin, "TOOL DEF", 4},
    Mark{Heidenhain, Place::Begin, "BLK FORM", 4},
    Mark{Heidenhain, Place::Begin, "CYCL DEF", 4},
    Mark{Heidenhain, Place::Begin, "CYCL CALL", 4},
    Mark{Heidenhain, Place::Begin, "CALL LBL", 4},
    Mark{Heidenhain, Place::Begin, "CALL PGM", 4},
    Mark{Heidenhain, Place::Begin, "TCH PROBE", 4},
    Mark{Heidenhain, Place::Begin, "LBL ", 3},
    Mark{Heidenhain, Place::Begin, "FN 0", 3},
    Mark{Heidenhain, Place::Begin, "FN 1", 3},
    Mark{Heidenhain, Place::Begin, "FN 9", 3},
    Mark{Heidenhain, Place::Word, " FMAX", 4},
    Mark{Heidenhain, Place::Shape, "L X+", 3, isKlartextLine},
    Mark{Heidenhain, Place::Shape, "Q1 =", 2, givesQParameter},
    Mark{HeidenhainIso, Place::Shape, "%.. *", 4, beginsStarProgram},
    Mark{HeidenhainIso, Place::Shape, "*", 1, endsWithStar},
    Mark{Okuma, Place::Begin, "MODIN", 3},
    Mark{Okuma, Place::Begin, "MODOUT", 3},
    Mark{Okuma, Place::Begin, "NLAP", 3},
    Mark{Okuma, Place::Begin, "NOEX ", 4},
    Mark{Okuma, Place::Begin, "LET ", 2},
    Mark{Okuma, Place::Begin, "RTS", 3},
    Mark{Okuma, Place::Word, ".MIN%", 5},
    Mark{Okuma, Place::Shape, "VC1", 4, givesVc},
    Mark{Okuma, Place::Shape, "IF [..] NX", 4, jumpsByName},
    Mark{Okuma, Place::Shape, "GOTO NX", 3, goesToName},
    Mark{Okuma, Place::Shape, "VZOFX", 4, hasOspVariable},
    Mark{Okuma, Place::Shape, "CALL O", 4, callsOsp},
    Mark{LinuxCnc, Place::Begin, "O<", 4},
    Mark{LinuxCnc, Place::Word, "#<", 4},
    Mark{LinuxCnc, Place::Shape, "O100 IF", 4, isOWord},
    Mark{LinuxCnc, Place::Word, "G38.2", 3},
    Mark{LinuxCnc, Place::Word, "G38.3", 3},
    Mark{LinuxCnc, Place::Word, "G38.4", 3},
    Mark{LinuxCnc, Place::Word, "G38.5", 3},
    Mark{LinuxCnc, Place::Word, "G38.6", 3},
    Mark{LinuxCnc, Place::Raw, "(PROBEOPEN", 3},
    Mark{LinuxCnc, Place::Raw, "(ABORT,", 2},
    Mark{LinuxCnc, Place::Raw, "(DEBUG,", 2},
    Mark{Grbl, Place::Shape, "$$", 4, isRealTimeCommand},
    Mark{Grbl, Place::Shape, "?", 2, isStatusQuery},
    Mark{RepRap, Place::Shape, "if {..}", 4, isMetaCommand},
    Mark{RepRap, Place::Shape, "M98 P\"", 4, callsFile},
    Mark{RepRap, Place::Word, "{VAR.", 4},
    Mark{RepRap, Place::Word, "{GLOBAL.", 4},
    Mark{RepRap, Place::Word, "{PARAM.", 4},
    Mark{RepRap, Place::Word, "{MOVE.", 4},
    Mark{RepRap, Place::Begin, "M291 P\"", 4},
    Mark{RepRap, Place::Begin, "M291 R\"", 4},
    Mark{RepRap, Place::Begin, "M291 P{", 4},
    Mark{RepRap, Place::Begin, "M118 P", 2},
    Mark{RepRap, Place::Begin, "M550 P\"", 4},
    Mark{RepRap, Place::Begin, "M584 X", 3},
    Mark{RepRap, Place::Begin, "M574 X", 3},
    Mark{RepRap, Place::Begin, "M906 X", 3},
    Mark{RepRap, Place::Begin, "M350 X", 2},
    Mark{RepRap, Place::Begin, "M569 P", 2},
    Mark{RepRap, Place::Begin, "M563 P", 2},
    Mark{RepRap, Place::Shape, "M4000 S\"", 4, takesText},
    Mark{Printer, Place::Begin, "M104 S", 3},
    Mark{Printer, Place::Begin, "M109 S", 3},
    Mark{Printer, Place::Begin, "M140 S", 3},
    Mark{Printer, Place::Begin, "M190 S", 3},
    Mark{Printer, Place::Begin, "M300 P", 3},
    Mark{Printer, Place::Begin, "M300 S", 3},
    Mark{Printer, Place::Begin, "M400", 1},
    Mark{Printer, Place::Begin, "G92 E", 4},
    Mark{Printer, Place::Begin, "M851 Z", 4},
    Mark{Printer, Place::Begin, "M92 X", 3},
    Mark{Printer, Place::Begin, "M205 X", 3},
    Mark{Printer, Place::Begin, "M201 X", 2},
    Mark{Printer, Place::Begin, "M203 X", 2},
    Mark{Printer, Place::Begin, "M206 X", 2},
    Mark{Printer, Place::Begin, "M221 S", 2},
    Mark{Printer, Place::Begin, "M420 S", 2},
    Mark{Printer, Place::Begin, "M117 ", 2},
    Mark{Printer, Place::Begin, ";LAYER", 4},
    Mark{Printer, Place::Begin, "; LAYER", 3},
    Mark{Printer, Place::Begin, ";TYPE:", 4},
    Mark{Printer, Place::Begin, ";FLAVOR:", 6},
    Mark{Printer, Place::Begin, "M862.", 4},
    Mark{Printer, Place::Shape, "E", 3, extrudes},
    Mark{Klipper, Place::Shape, "{%", 4, isKlipperStatement},
    Mark{Fagor, Place::Begin, "$IF", 4},
    Mark{Fagor, Place::Begin, "$FOR", 4},
    Mark{Fagor, Place::Begin, "$WHILE", 4},
    Mark{Fagor, Place::Begin, "$GOTO", 4},
    Mark{Fagor, Place::Begin, "#MSG[", 4},
    Mark{Fagor, Place::Begin, "#TOOL", 4},
    Mark{Fagor, Place::Raw, "(RPT N", 4},
    Mark{Fagor, Place::Raw, "(PCALL ", 4},
    Mark{Fagor, Place::Word, "V.P.", 4},
    Mark{Fagor, Place::Word, "V.S.", 4},
    Mark{Fagor, Place::Raw, "(P1=..)", 3, isFagorStatement},
    Mark{Fagor, Place::Shape, "%00227", 3, beginsFagorProgram},
    Mark{Fagor, Place::Shape, "T1.1", 2, choosesByPoint},
    Mark{WireEdm, Place::Shape, "E001=", 3, givesCondition},
    Mark{Parameters, Place::Shape, "P00000010", 2, isParameter},
    Mark{Fadal, Place::Shape, "# R1=", 3, isFadalLine},
    Mark{Eding, Place::Shape, "GOSUB", 4, isEdingWord},
    Mark{Script, Place::Begin, "FUNCTION ", 4},
    Mark{Script, Place::Begin, "VAR ", 3},
    Mark{Script, Place::Begin, "CONST ", 3},
    Mark{Script, Place::Begin, "LET ", 2},
    Mark{Script, Place::Begin, "/*", 2},
    Mark{Script, Place::Begin, "DEF ", 2},
    Mark{Script, Place::Begin, "IMPORT ", 3},
    Mark{Script, Place::Begin, "#!/", 5},
    Mark{Script, Place::Begin, "});", 2},
    Mark{Script, Place::Begin, "};", 2},
    Mark{Script, Place::Begin, "RETURN;", 2},
    Mark{Script, Place::Begin, "END IF", 4},
    Mark{Script, Place::Begin, "END SUB", 5},
    Mark{Script, Place::Begin, "END FUNCTION", 5},
    Mark{Script, Place::Begin, "DIM ", 3},
    Mark{Script, Place::Begin, "PRINT *", 5},
    Mark{Script, Place::Begin, "SUBROUTINE ", 4},
    Mark{Script, Place::Begin, "#INCLUDE <", 4},
    Mark{Script, Place::Begin, "#INCLUDE \"", 4},
    Mark{Script, Place::Begin, "#DEFINE ", 3},
    Mark{Script, Place::Begin, "PUBLIC ", 3},
    Mark{Script, Place::Begin, "CLASS ", 3},
    Mark{Script, Place::Begin, "@ECHO ", 4},
    Mark{Script, Place::Begin, "PRINTF(", 3},
    Mark{Script, Place::Raw, "=> {", 3},
    Mark{Script, Place::Raw, ") {", 2},
    Mark{Markdown, Place::Begin, "```", 5},
    Mark{Markdown, Place::Begin, "@@ -", 5}, // a patch
    Mark{Markdown, Place::Begin, "|--", 3},
    Mark{Markdown, Place::Begin, "- **", 3},
    Mark{Markdown, Place::Shape, "#", 2, isHeading},
};

} // namespace

const TongueFacts& factsOf(Tongue tongue) {
  return kFacts[static_cast<std::size_t>(tongue)];
}

std::span<const Mark> dialectMarks() {
  return kMarks;
}

View trimmedText(View text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
    text.remove_suffix(1);
  return text;
}

View withoutBlockNumber(View text) {
  const std::size_t letter = text.starts_with('N') ? 1 : 0;
  const std::size_t digits = digitsAt(text, letter);
  if (digits == 0) return text;
  const View rest = text.substr(letter + digits);
  return letter == 1 || rest.starts_with(' ') ? trimmedText(rest) : text;
}

} // namespace dotek::project
