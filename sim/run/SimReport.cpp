#include "sim/run/SimReport.h"

#include "frontend/macrob/Check.h"
#include "frontend/macrob/ReadAhead.h"
#include "sim/machine/EndText.h"
#include "sim/machine/Value.h"
#include "support/Decimal.h"
#include "support/Printable.h"
#include "support/messages/Common.h"
#include "support/messages/MacroB.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace dotek::sim {
namespace {

using frontend::nc::ScanFault;

constexpr std::string_view kHidden = "a macro statement or a call that the first reading did not show";

// The line as a file of its own, since the program itself is not kept.
FileId addLine(const std::string& path, std::string_view line, std::uint64_t number, Session& session) {
  const Encoding encoding = isUtf8(line) ? Encoding::Utf8 : Encoding::Cp1250;
  return session.sources().add(
      SourceFile(path, std::string(line), encoding, static_cast<std::uint32_t>(number == 0 ? 1 : number)));
}

// Of the block without blanks around it and without its end.
SourceRange wholeLine(FileId file, std::string_view line) {
  std::size_t begin = 0, end = line.size();
  while (begin < end && (line[begin] == ' ' || line[begin] == '\t'))
    ++begin;
  while (end > begin && (line[end - 1] == ' ' || line[end - 1] == '\t'))
    --end;
  return {file, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
}

std::string where(const RunEnd& end) {
  const std::string callers = callersText(end);
  return callers.empty() ? "" : " (" + callers + ")";
}

std::string alarmText(const RunEnd& end) {
  return end.text.empty() ? "the program gives it no text" : toUtf8Text(end.text);
}

std::string_view endingName(const Machine& machine, bool stoppedByText) {
  if (stoppedByText) return "not-read";
  switch (machine.end().ending) {
  case Ending::ProgramEnd: return "program-end";
  case Ending::Return: return "return";
  case Ending::Alarm: return "alarm";
  case Ending::Inconclusive: return "inconclusive";
  case Ending::Call: return "inconclusive";
  case Ending::Limit: return "limit";
  case Ending::Running:
  case Ending::TextEnd: break;
  }
  return "text-end";
}

} // namespace

std::string toUtf8Text(const std::string& bytes) {
  return toUtf8(bytes, isUtf8(bytes) ? Encoding::Utf8 : Encoding::Cp1250);
}

std::string positionText(const Position& position, std::uint32_t shown) {
  std::string out;
  for (std::size_t i = 0; i < kAxes; ++i) {
    if (i >= 3 && (shown >> i & 1) == 0) continue;
    out += fmt::format("{}\"{}\": {}", out.empty() ? "" : ", ", kAxisLetters[i], jsonNumber(position[i], 6));
  }
  return "{" + out + "}";
}

namespace {

// C or R follows the comma that ends at `at`.
bool isCornerWord(std::string_view line, std::size_t at) {
  at = line.find_first_not_of(" \t", at);
  return at != std::string_view::npos && std::string_view("CRcr").find(line[at]) != std::string_view::npos;
}

} // namespace

SourceRange placeOfLine(const std::string& path, const frontend::nc::Scanner& scanner, Session& session) {
  const std::string_view line = scanner.lineText();
  return wholeLine(addLine(path, line, scanner.line(), session), line);
}

void reportLeader(const std::string& path, const frontend::nc::Scanner& scanner, Session& session) {
  if (scanner.leader().empty()) return;
  const FileId file = addLine(path, scanner.leader(), scanner.leaderLine(), session);
  session.diagnostics().report<diag::TextBeforeStart>(wholeLine(file, scanner.leader()));
}

void reportScanError(const std::string& path, const frontend::nc::Scanner& scanner, const LineChunks& chunks,
                     Session& session) {
  const frontend::nc::ScanError& error = scanner.error();
  Diagnostics& diagnostics = session.diagnostics();
  if (error.fault == ScanFault::Reading) {
    diagnostics.report<diag::FileNotReadable>({}, path, chunks.error());
    return;
  }
  const FileId file = addLine(path, scanner.lineText(), error.line, session);
  const SourceRange range{file, error.begin, error.end};
  const std::string text = session.sources().textUtf8(range);
  switch (error.fault) {
  case ScanFault::BadCharacter:
    if (text == std::string(1, '\0'))
      diagnostics.report<diag::NulByte>(range);
    else if (text == "," && isCornerWord(scanner.lineText(), error.end))
      diagnostics.report<diag::RunInconclusive>(
          range, text,
          "`,C` is a chamfer and `,R` a rounding at the corner to the next block, where the control has "
          "them; "
          "Dotek does not follow them; write the points of the chamfer, or an arc, for a run here");
    else
      diagnostics.report<diag::BlockCharacter>(range, text);
    break;
  case ScanFault::NoNumber: diagnostics.report<diag::AddressWithoutNumber>(range, text); break;
  case ScanFault::BadNumber: diagnostics.report<diag::NumberNotRead>(range, text); break;
  case ScanFault::OpenComment: diagnostics.report<diag::CommentOpen>(range); break;
  case ScanFault::LateDelete: diagnostics.report<diag::LateBlockDelete>(range); break;
  case ScanFault::LateMark: diagnostics.report<diag::LateProgramMark>(range); break;
  case ScanFault::LineTooLong: diagnostics.report<diag::BlockTooLong>(range, LineChunks::kBuffer); break;
  case ScanFault::MacroText:
  case ScanFault::Reading:
  case ScanFault::None: diagnostics.report<diag::RunInconclusive>(range, text, kHidden); break;
  }
}

void reportEnd(const std::string& path, const frontend::nc::Scanner& scanner, const Machine& machine,
               bool told, Session& session) {
  const RunEnd& end = machine.end();
  if (told) return;
  if (end.ending != Ending::Alarm && end.ending != Ending::Inconclusive && end.ending != Ending::Call &&
      end.ending != Ending::Return)
    return;
  SourceRange range = placeOfLine(path, scanner, session);
  if (end.letter != 0) {
    if (const auto word = frontend::nc::findWord(scanner.lineText(), end.letter, end.which))
      range = {range.file, word->begin, word->end};
  }
  Diagnostics& diagnostics = session.diagnostics();
  if (end.ending == Ending::Alarm)
    diagnostics.report<diag::ControlAlarm>(range, alarmName(end), alarmText(end), where(end));
  else if (end.ending == Ending::Inconclusive)
    diagnostics.report<diag::RunInconclusive>(range, session.sources().textUtf8(range), end.text);
  else
    diagnostics.report<diag::RunInconclusive>(range, session.sources().textUtf8(range), kHidden);
}

void reportRun(const Run& run, const Machine& machine, const std::string& advice,
               const std::vector<std::string>& folders, bool told, Session& session) {
  Diagnostics& diagnostics = session.diagnostics();
  const stdlib::Control& control = machine.control();
  std::string stops;
  for (const auto& [letter, tenths] : control.readAheadStops)
    stops += fmt::format("{}{}{}{}", stops.empty() ? "" : ", ", letter, numberText(tenths / 10.0),
                         letter == 'G' && tenths == 1030 ? " P1" : "");
  using frontend::macrob::positionReadEarlyCheck;
  Report earlyReads(positionReadEarlyCheck.code, positionReadEarlyCheck.severity, diagnostics);
  // A macro reads its start axis by axis: one cause, one finding.
  Diagnostic* before = nullptr;
  SourceRange last;
  for (const EarlyRead& early : run.earlyReads()) {
    const bool next = before != nullptr && early.range.file == last.file &&
                      session.sources().line(early.range) == session.sources().line(last) + 1;
    last = early.range;
    if (next) {
      before->note(early.range, fmt::format("and #{}", early.number));
      continue;
    }
    before = &frontend::macrob::reportReadAhead(early.range, early.number, control, earlyReads);
    before->note({},
                 "the control waits at " + (stops.empty() ? std::string("codes that are not known") : stops));
  }
  if (told) return;
  const RunEnd& end = machine.end();
  const SourceRange range = run.place();
  Diagnostic* report = nullptr;
  switch (end.ending) {
  case Ending::Alarm: {
    if (!machine.dialect().numbersAlarms) {
      report = &diagnostics.report<diag::ControlFault>(range, end.text);
      break;
    }
    report = &diagnostics.report<diag::ControlAlarm>(range, alarmName(end), alarmText(end), where(end));
    const stdlib::AlarmInfo* missing = control.find(stdlib::Alarm::NoSuchProgram);
    std::string searched;
    for (const std::string& folder : folders)
      searched += fmt::format(" nor `{}`", folder);
    if (missing != nullptr && end.number == missing->number && end.text == missing->text)
      report->note({}, folders.empty() ? "programs of other files are found with `--programs DIR`"
                                       : fmt::format("neither this file{} (`--programs`) has a program of "
                                                     "this number; a file without one counts as `O1234` or "
                                                     "`O1234.nc` says",
                                                     searched));
    break;
  }
  case Ending::Limit:
    report = &diagnostics.report<diag::RunLimit>(range, end.text);
    if (const std::string loop = run.loopText(); !loop.empty()) report->note({}, loop);
    break;
  case Ending::Inconclusive:
  case Ending::Call:
  case Ending::Return:
    report = &diagnostics.report<diag::RunInconclusive>(range, session.sources().textUtf8(range), end.text);
    break;
  case Ending::Running:
  case Ending::ProgramEnd:
  case Ending::TextEnd: return;
  }
  if (!advice.empty()) report->note({}, advice);
  constexpr std::size_t kMostCalls = 8;
  const std::vector<SourceRange> calls = run.openCalls();
  for (std::size_t i = 0; i < calls.size() && i < kMostCalls; ++i)
    report->note(calls[calls.size() - 1 - i], "called here");
  if (calls.size() > kMostCalls)
    report->note({}, fmt::format("called by {} calls more", calls.size() - kMostCalls));
}

void reportShifts(const Machine& machine, SourceRange range, Session& session) {
  if (machine.end().ending != Ending::ProgramEnd && machine.end().ending != Ending::TextEnd) return;
  const auto report = [&](std::string_view code, const std::string& what, const std::string& cure) {
    session.diagnostics().report<diag::ShiftLeftOn>(range, code, what, cure);
  };
  const auto words = [](const Position& shift, bool zero) {
    std::string out;
    for (std::size_t i = 0; i < kAxes; ++i)
      if (shift[i] != 0) out += fmt::format(" {}{}", kAxisLetters[i], zero ? "0" : fixedText(shift[i], 3));
    return out;
  };
  constexpr std::string_view kLater = "whether M30 takes it away depends on a parameter of the machine, and "
                                      "a program that runs next may count from "
                                      "this zero";
  if (const std::string shift = words(machine.localShift(), false); !shift.empty())
    report("`G52" + shift + "`", std::string(kLater), "`G52" + words(machine.localShift(), true) + "`");
  if (const std::string shift = words(machine.positionShift(), false); !shift.empty())
    report("`G92`", fmt::format("all work systems lie off by{}, for the next program, too", shift),
           "a `G92` that moves them back");
  if (machine.rotation().on())
    report("`G68`",
           fmt::format("{} degrees; most controls end it at M30, some do not",
                       numberText(machine.rotation().degrees())),
           "`G69`");
}

void addLists(const Machine& machine, const Run* run, bool variables, SimWorld& world) {
  PictureList printed{"printed", "Printed by the program (DPRNT)", {}};
  if (run != nullptr) {
    std::string_view text = run->output();
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      printed.lines.push_back(toUtf8Text(std::string(text.substr(0, end))));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }
  world.addList(std::move(printed));
  PictureList left{"left", "Left by the program", {}};
  if (machine.rotation().on())
    left.lines.push_back(fmt::format("G68 R{} in force", numberText(machine.rotation().degrees())));
  if (variables && run != nullptr)
    for (const auto& [number, value] : machine.written())
      if (machine.control().isCommon(number) && std::isfinite(value))
        left.lines.push_back(fmt::format("#{} = {}", number, fixedText(value, machine.control().decimals)));
  world.addList(std::move(left));
}

void traceVariables(const Machine& machine, Trace& trace) {
  if (machine.dialect().firstParameter) return; // its records say them
  for (const auto& [number, value] : machine.written()) {
    trace.begin("variable").text(std::to_string(number));
    if (isNull(value))
      trace.text("null").end();
    else
      trace.word("", value).end();
  }
}

namespace {

// As the control shows it.
std::string shownText(Position position, const Machine& machine) {
  if (machine.showsDiameters()) position[0] *= 2;
  return positionText(position, machine.movedAxes());
}

} // namespace

std::string summary(Machine& machine, const Run* run, const SimWorld& world, Session& session) {
  const RunEnd& end = machine.end();
  const bool notRead = end.ending == Ending::Running && session.diagnostics().hasErrors();
  std::string out = "{\n";
  out += fmt::format("  \"ending\": \"{}\",\n", endingName(machine, notRead));
  out += fmt::format("  \"control\": {},\n", jsonString(machine.control().name));
  out += fmt::format("  \"blocks\": {},\n", machine.blocks());
  out += fmt::format("  \"position\": {},\n", shownText(machine.knownPosition(), machine));
  out += fmt::format("  \"machine\": {},\n", shownText(machine.knownMachinePosition(), machine));
  std::string unknown;
  for (std::size_t i = 0; i < kAxes; ++i)
    if ((machine.uncertain() >> i & 1) != 0)
      unknown += fmt::format("{}\"{}\"", unknown.empty() ? "" : ", ", kAxisLetters[i]);
  out += fmt::format("  \"unknownAxes\": [{}],\n", unknown);
  out += fmt::format("  \"feed\": {},\n", jsonNumber(machine.feed(), 6));
  out += fmt::format("  \"dwellSeconds\": {},\n", jsonNumber(machine.seconds(), 6));
  if (end.ending == Ending::Alarm) {
    std::string stack;
    for (const Frame& frame : end.stack)
      stack += fmt::format("{}{{\"program\": {}, \"sequence\": {}, \"line\": {}}}", stack.empty() ? "" : ", ",
                           frame.program, frame.sequence, frame.line);
    out += fmt::format("  \"alarm\": {{\"number\": {}, \"text\": {}, \"line\": {}, \"stack\": [{}]}},\n",
                       end.number == 0 ? "null" : std::to_string(end.number),
                       jsonString(toUtf8Text(end.text)), end.line, stack);
  } else {
    out += "  \"alarm\": null,\n";
  }
  if (run != nullptr) {
    const std::optional<std::uint32_t> first = machine.dialect().firstParameter;
    std::string variables;
    for (const auto& [number, value] : machine.written())
      if (!isUnknown(value) && (!first || number <= machine.dialect().lastParameter))
        // what a macro left there and no source tells is no value
        variables += fmt::format("{}\"{}\": {}", variables.empty() ? "" : ", ", number - first.value_or(0),
                                 std::isfinite(value) ? numberText(value) : "null");
    out += fmt::format("  \"{}\": {{{}}},\n", first ? "parameters" : "variables", variables);
    if (first)
      out += fmt::format("  \"zero\": {},\n{}", positionText(machine.activeZero(), machine.movedAxes()),
                         world.notes());
    else
      out += fmt::format("  \"output\": {},\n", jsonString(toUtf8Text(run->output())));
  }
  out += world.summary();
  return out + diagnosticsMember(session.diagnostics(), session.sources()) + "}\n";
}

std::string diagnosticsMember(const Diagnostics& diagnostics, const SourceMap& sources) {
  std::string text = renderJson(diagnostics, sources);
  while (text.ends_with('\n'))
    text.pop_back();
  return "  \"diagnostics\": " + text + "\n";
}

std::string notRunSummary(const Diagnostics& diagnostics, const SourceMap& sources) {
  return "{\n  \"ending\": \"not-run\",\n  \"control\": null,\n  \"blocks\": 0,\n  \"position\": null,\n"
         "  \"machine\": null,\n" +
         diagnosticsMember(diagnostics, sources) + "}\n";
}

} // namespace dotek::sim
