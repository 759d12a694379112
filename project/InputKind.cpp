#include "project/InputKind.h"

#include "project/Dialects.h"
#include "project/LineShapes.h"
#include "project/PostShape.h"
#include "support/Ascii.h"
#include "support/LineEnds.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace dotek::project {
namespace {

using View = std::string_view;

constexpr View kUnknown = "no language that Dotek reads";
constexpr View kListing = "listing";
constexpr View kToml = "settings in TOML";
constexpr int kMostLines = 2000;
constexpr int kLinesBetween = 250; // after so many it is asked whether more are needed
constexpr std::size_t kMostOfLine = 4096;
constexpr int kLongestLeader = 12; // lines before the first `%`, or after the last

constexpr std::array kKinds = {InputKind::Prog, InputKind::Macro, InputKind::Dialog, InputKind::DefineData,
                               InputKind::Nc,   InputKind::Suf,   InputKind::Cycle};

// What the lines of a text say for one language.
struct Tally {
  int lines = 0; // that are not blank to it
  int fits = 0;
  int begins = 0; // that only begin like it
  int weight = 0;

  void add(const Shape& shape) {
    if (shape.blank) return;
    ++lines;
    fits += shape.fits ? 1 : 0;
    weight += shape.weight;
  }
  double share() const { return lines == 0 ? 0 : static_cast<double>(fits) / lines; }
  double score() const { return weight * share() * share(); }
};

// Of NC nothing counts outside of `%`, as nothing of it reaches the control.
class NcTally {
public:
  void add(const BlockShape& shape) {
    if (shape.percent) {
      if (!inside_ && tally.lines <= kLongestLeader) tally = Tally{0, 0, 0, tally.weight};
      if (inside_) outside_ = 0;
      inside_ = !inside_;
    } else if (closed() && outside_ < kLongestLeader && !shape.blank) {
      ++outside_;
      return;
    }
    tally.add(shape);
    tally.begins += shape.begins ? 1 : 0;
    macroB += shape.macroB;
    code = code || shape.code || shape.macroB > (shape.percent ? 1 : 0);
    framed = framed || shape.percent || shape.header;
    seen_ = seen_ || shape.percent;
  }

  Tally tally;
  int macroB = 0;
  bool code = false;
  bool framed = false; // it has a `%` or the number of a program

private:
  bool closed() const { return seen_ && !inside_; }
  bool seen_ = false, inside_ = false;
  int outside_ = 0;
};

struct Evidence {
  Tally prog, macro, dialog, suf, cycle;
  NcTally nc;
  Dialects dialects;
  int definitions = 0, prose = 0;
  int stray = 0;       // blocks of NC that have a word which is none of it
  bool schema = false; // a TOML file of Dotek begins with `schema = 1`

  // Macro statements within `%` or after the number of a program, blocks throughout, and nothing that speaks
  // for another language: more lines of a file that is named so would not change what it is.
  bool plainlyNc() const {
    constexpr double kNearlyAll = 0.95;
    return nc.framed && nc.macroB >= kLinesBetween / 10 && nc.tally.share() >= kNearlyAll && stray == 0 &&
           dialects.weight() == 0 && !dialects.certain() && suf.share() < kNearlyAll / 2;
  }

  const Tally& of(InputKind kind) const {
    switch (kind) {
    case InputKind::Prog: return prog;
    case InputKind::Macro:
    case InputKind::DefineData: return macro;
    case InputKind::Dialog: return dialog;
    case InputKind::Nc: return nc.tally;
    case InputKind::Cycle: return cycle;
    case InputKind::Suf: break;
    }
    return suf;
  }
};

// Calls `visit` with each of the first lines as long as it wants more; CR LF is one end.
template <class Visit> void eachLine(View text, Visit&& visit) {
  int lines = 0;
  for (std::size_t at = 0; at < text.size() && lines < kMostLines; ++lines) {
    const std::size_t end = endOfLine(text, at);
    if (!visit(text.substr(at, std::min(end - at, kMostOfLine)))) return;
    at = end + (end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n' ? 2 : 1);
  }
}

View trimmed(View line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin == View::npos) return {};
  return line.substr(begin, line.find_last_not_of(" \t") + 1 - begin);
}

// name, or "name.with.dots"; quotes are not looked into.
bool isTomlName(View text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return isDigit(c) || isLetter(c) || View("_-.\"'* ").find(c) != View::npos;
  });
}

// [table], [[table]], whose name has a small letter, which no part of a program in brackets has.
bool isTomlTable(View line) {
  line = trimmed(line.substr(0, line.find('#')));
  const std::size_t depth = line.starts_with("[[") ? 2 : 1;
  if (!line.starts_with('[') || line.size() <= 2 * depth || !line.ends_with(depth == 2 ? "]]" : "]"))
    return false;
  const View name = line.substr(depth, line.size() - 2 * depth);
  return isTomlName(name) &&
         std::any_of(name.begin(), name.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

// Tables of settings, or Dotek's mark, and nothing but them, settings and remarks: what a text is that holds
// no program. "": something else.
View settingsOf(View text) {
  bool mark = false, table = false, other = false;
  int settings = 0, open = 0; // brackets of a list that goes on
  eachLine(text, [&](View raw) {
    const View line = trimmed(raw);
    if (line.empty() || line.starts_with('#')) return true;
    View value = line;
    if (open == 0) {
      if (isTomlTable(line)) {
        table = true;
        return true;
      }
      const std::size_t equals = line.find('=');
      value = equals == View::npos ? View() : trimmed(line.substr(equals + 1));
      if (value.empty() || !isTomlName(trimmed(line.substr(0, equals)))) {
        other = true;
        return false;
      }
      mark = mark || line.starts_with("schema =");
      ++settings;
      if (!value.starts_with('[') && !value.starts_with('{')) return true;
    }
    open += static_cast<int>(
        std::count_if(value.begin(), value.end(), [](char c) { return c == '[' || c == '{'; }));
    open -= static_cast<int>(
        std::count_if(value.begin(), value.end(), [](char c) { return c == ']' || c == '}'; }));
    return true;
  });
  return other || settings == 0 ? View() : mark ? kToml : table ? kUnknown : View();
}

// `named`: what it is by its name, if that says so.
Evidence look(View text, std::optional<InputKind> named) {
  Evidence out;
  int seen = 0;
  bool inComment = false;
  Tally closed; // of the Prog, as if each comment ended on its line
  eachLine(text, [&](View line) {
    out.dialects.look(line);
    ++seen;
    if (line.find_first_not_of(" \t\v\f") == View::npos) return true;
    out.prog.add(progShape(line, inComment));
    bool here = false;
    closed.add(progShape(line, here));
    out.macro.add(macroShape(line));
    out.dialog.add(dialogShape(line));
    const BlockShape block = blockShape(line);
    out.nc.add(block);
    out.prose += !block.fits && !block.blank && isProse(line) ? 1 : 0;
    out.stray += block.fits && block.macroB > 0 && hasStrayWord(line) ? 1 : 0;
    out.suf.add(sufShape(line));
    out.cycle.add(cycleShape(line));
    out.schema = out.schema || line.starts_with("schema =");
    out.definitions += isDefinition(line) ? 1 : 0;
    return seen % kLinesBetween != 0 || named != InputKind::Nc || !out.plainlyNc();
  });
  if (inComment && out.prog.lines == 0) out.prog = closed;
  return out;
}

std::optional<InputKind> kindOfName(const std::string& name) {
  if (name == "DEFINEDATA.TXT") return InputKind::DefineData;
  const std::size_t dot = name.rfind('.');
  const View end = dot == std::string::npos ? View() : View(name).substr(dot);
  if (end == ".MAC") return InputKind::Macro;
  if (end == ".DLG") return InputKind::Dialog;
  if (end == ".SUF" || end == ".FCB") return InputKind::Suf;
  if (end == ".CYCLE") return InputKind::Cycle;
  constexpr std::array<View, 12> kNc = {".NC",  ".CNC", ".TAP", ".EIA", ".PRG", ".NCC",
                                        ".NCF", ".ISO", ".DNC", ".FAN", ".PIM", ".MIN"};
  const bool number = name.size() > 1 && name[0] == 'O' &&
                      std::all_of(name.begin() + 1, name.end(), [](char c) { return isDigit(c); });
  if (number || std::find(kNc.begin(), kNc.end(), end) != kNc.end()) return InputKind::Nc;
  return std::nullopt;
}

// How much has to speak for a kind; less where the name does too.
bool suffices(InputKind kind, const Tally& tally, bool named) {
  const int least = named ? 1 : kind == InputKind::Nc || kind == InputKind::Macro ? 2 : 3;
  return tally.weight >= least && tally.share() >= (named ? 0.25 : 0.5);
}

std::string share(const Tally& tally, View of) {
  return fmt::format("{} of {} lines are {}", tally.fits, tally.lines, of);
}

View linesOf(InputKind kind) {
  switch (kind) {
  case InputKind::Prog: return "of a Prog";
  case InputKind::Macro: return "statements of a GibbsCAM macro";
  case InputKind::Dialog: return "controls of a dialog";
  case InputKind::DefineData: return "definitions";
  case InputKind::Nc: return "blocks of NC";
  case InputKind::Cycle: return "statements of a cycle";
  case InputKind::Suf: break;
  }
  return "blocks of Mikroprog";
}

// `named`: its name says so, or, where not `byName`, the command takes that.
Recognition recogniseText(View text, std::optional<InputKind> named, bool byName) {
  if (text.find_first_not_of(" \t\r\n\v\f\x1A") == View::npos) return {named, std::string(kEmptyInput)};
  if (named == InputKind::DefineData) return {named, "its name is fixed in GibbsCAM"};
  if (auto other = otherFormat(text)) return {std::nullopt, std::move(*other)};
  if (byName && named == InputKind::Cycle) return {named, "its name"};
  if (const View settings = byName ? View() : settingsOf(text); !settings.empty())
    return {std::nullopt, std::string(settings)};
  const Evidence seen = look(text, named);
  const Tally& nc = seen.nc.tally;
  // Words of Mikroprog look like any NC, and its comments like those of other controls.
  const bool suf = named == InputKind::Suf
                       ? seen.suf.share() >= 0.3 || (nc.fits + nc.begins) * 3 >= nc.lines
                       : seen.suf.share() >= 0.6 && seen.suf.weight >= 4 && seen.nc.macroB < 3;
  const int foreign = seen.dialects.weight();
  const int own = seen.nc.macroB + std::max({seen.macro.share() > 0.5 ? seen.macro.weight : 0,
                                             seen.dialog.share() > 0.5 ? seen.dialog.weight : 0,
                                             seen.prog.share() > 0.5 ? seen.prog.weight : 0});
  const bool ours = (named == InputKind::Macro || named == InputKind::Dialog) && seen.macro.share() >= 0.5;
  // An axis as the name of a field looks like a word of Sinumerik; `R1=` on each line weighs more.
  const int lines = seen.macro.lines;
  if (lines > 0 && seen.definitions == lines && !seen.schema && foreign <= lines)
    return {named == InputKind::Macro ? InputKind::Macro : InputKind::DefineData,
            fmt::format("each of {} lines gives a name a number", lines)};
  if (seen.dialects.certain() || (!suf && !ours && foreign > 0 && (foreign > own || seen.dialects.marked())))
    return {std::nullopt, seen.dialects.name()};
  if (suf) return {InputKind::Suf, share(seen.suf, linesOf(InputKind::Suf))};
  if (seen.cycle.weight >= 4 && seen.cycle.share() >= 0.5)
    return {InputKind::Cycle, share(seen.cycle, linesOf(InputKind::Cycle))};
  // A text about programs quotes some, and its sentences may begin with a variable.
  const bool sentences = !seen.nc.framed && seen.stray > 0 && seen.stray + seen.prose > nc.fits - seen.stray;
  const bool quotes = seen.prose * 4 > nc.lines || sentences;
  std::optional<InputKind> best;
  double score = 0;
  for (const InputKind kind : {InputKind::Nc, InputKind::Macro, InputKind::Dialog, InputKind::Prog}) {
    const Tally& tally = seen.of(kind);
    if (!suffices(kind, tally, named == kind)) continue;
    if (kind == InputKind::Nc && (named != kind ? quotes || !seen.nc.code : quotes && !byName)) continue;
    const double one = tally.score() * (named == kind ? 1.5 : 1);
    if (one > score) best = kind;
    score = std::max(score, one);
  }
  if (best) return {best, share(seen.of(*best), linesOf(*best))};
  if (seen.schema) return {std::nullopt, std::string(kToml)};
  if (named && *named != InputKind::Suf && seen.of(*named).lines == 0) return {named, "nothing but comments"};
  if (!byName && named == InputKind::Nc && quotes) return {std::nullopt, std::string(kUnknown)};
  if (named && seen.of(*named).share() >= 0.5) return {named, share(seen.of(*named), linesOf(*named))};
  if (named == InputKind::Nc && (nc.fits + nc.begins) * 4 >= nc.lines)
    return {named, "its name, and blocks with defects"};
  return {std::nullopt, std::string(kUnknown)};
}

// UTF-16 as its low bytes: enough to see what the text would be.
std::string narrowed(View bytes) {
  std::string out;
  std::copy_if(bytes.begin(), bytes.end(), std::back_inserter(out),
               [](char c) { return c != '\0' && c != '\xFF' && c != '\xFE'; });
  return out;
}

} // namespace

std::string_view kindName(InputKind kind) {
  switch (kind) {
  case InputKind::Prog: return "prog";
  case InputKind::Macro: return "mac";
  case InputKind::Dialog: return "dlg";
  case InputKind::DefineData: return "define";
  case InputKind::Nc: return "nc";
  case InputKind::Suf: return "suf";
  case InputKind::Cycle: return "cycle";
  }
  return "";
}

std::string_view kindText(InputKind kind) {
  switch (kind) {
  case InputKind::Prog: return "a Prog of ComPost";
  case InputKind::Macro: return "a GibbsCAM macro";
  case InputKind::Dialog: return "a GibbsCAM dialog";
  case InputKind::DefineData: return "a DefineData.txt";
  case InputKind::Nc: return "an NC program";
  case InputKind::Suf: return "a program of Mikroprog";
  case InputKind::Cycle: return "a cycle";
  }
  return "";
}

bool isListing(const std::optional<std::string>& from) {
  return from == kListing;
}

std::optional<InputKind> kindByName(View name) {
  if (name == kListing) return InputKind::Nc;
  const auto at =
      std::find_if(kKinds.begin(), kKinds.end(), [&](InputKind kind) { return kindName(kind) == name; });
  return at == kKinds.end() ? std::nullopt : std::optional(*at);
}

std::optional<InputKind> kindByFileName(View name) {
  const std::size_t slash = name.find_last_of("/\\");
  return kindOfName(upperCase(slash == View::npos ? name : name.substr(slash + 1)));
}

bool showsNothing(const Recognition& recognition) {
  return !recognition.kind && (recognition.reason.empty() || recognition.reason == kUnknown);
}

std::string otherwise(const Recognition& recognition) {
  return recognition.reason.empty() || recognition.reason == kUnknown ? "" : " (" + recognition.reason + ")";
}

std::optional<Foreign> foreignLanguage(View bytes) {
  View text = bytes.substr(0, kRecognisedBytes);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.find('\0') != View::npos || otherFormat(text)) return std::nullopt;
  Dialects dialects;
  eachLine(text, [&](View line) {
    dialects.look(line);
    return true;
  });
  return dialects.weight() > 0 || dialects.certain() ? dialects.foreign() : std::nullopt;
}

Recognition recognise(View fileName, View bytes, std::optional<InputKind> expected) {
  const std::size_t slash = fileName.find_last_of("/\\");
  auto named = kindOfName(upperCase(slash == View::npos ? fileName : fileName.substr(slash + 1)));
  const bool byName = named.has_value();
  if (lowerCase(slash == View::npos ? fileName : fileName.substr(slash + 1)) == "dotek.toml")
    return {std::nullopt, std::string(kToml)};
  if (!named) named = expected;
  View text = bytes.substr(0, kRecognisedBytes);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const auto nuls = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\0'));
  const bool wide = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") ||
                    (nuls > 0 && nuls * 2 + 2 >= text.size() && nuls * 2 <= text.size() + 2);
  if (auto other = otherFormat(text)) return {std::nullopt, std::move(*other)};
  const std::string upper =
      upperCase(fileName.substr(fileName.size() - std::min<std::size_t>(4, fileName.size())));
  if (!wide && isPostText(text, upper == ".CPS" || upper == ".CPI"))
    return {std::nullopt, std::string(kPostInput)};
  if (wide) {
    Recognition out = recogniseText(narrowed(text), named, byName);
    out.reason = out.kind ? "UTF-16, and " + out.reason : "UTF-16 text; save it as ANSI or UTF-8";
    return out;
  }
  // Feed holes of a tape before and after the text, or a damaged copy of one.
  const auto controls = std::count_if(text.begin(), text.end(), [](char c) {
    return c != '\0' && static_cast<unsigned char>(c) < 0x20 &&
           View("\t\r\n\v\f\x11\x12\x13\x14\x1A").find(c) == View::npos;
  });
  const std::size_t first = text.find_first_not_of('\0');
  const std::size_t last = text.find_last_not_of('\0');
  if (first == View::npos)
    return {named, std::string(text.empty() ? kEmptyInput : View("nothing but bytes 0"))};
  const View middle = text.substr(first, last + 1 - first);
  const auto inner = static_cast<std::size_t>(std::count(middle.begin(), middle.end(), '\0'));
  const std::size_t most = std::max<std::size_t>(8, middle.size() / 20); // a copy may be damaged
  if (inner > most || static_cast<std::size_t>(controls) > most) return {std::nullopt, "binary data"};
  return nuls == 0 ? recogniseText(text, named, byName) : recogniseText(narrowed(middle), named, byName);
}

} // namespace dotek::project
