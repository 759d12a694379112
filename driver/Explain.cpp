#include "driver/Command.h"
#include "driver/Driver.h"
#include "lint/Catalog.h"
#include "lint/Rule.h"
#include "project/Assumptions.h"
#include "stdlib/Control.h"
#include "stdlib/HostInputs.h"
#include "stdlib/MacroSet.h"
#include "stdlib/MikroprogControl.h"
#include "support/NearestName.h"
#include "support/Printable.h"
#include "support/messages/Commands.h"
#include "targets/Target.h"

#include "support/Ascii.h"

#include <algorithm>

namespace dotek::driver {
namespace {

std::string table(const std::vector<std::pair<std::string, std::string>>& rows) {
  std::size_t width = 0;
  for (const auto& row : rows)
    width = std::max(width, row.first.size());
  std::string out;
  for (const auto& [name, text] : rows)
    out += fmt::format("{:<{}}  {}\n", printable(name), width, printable(text));
  return out;
}

// "title: calculator (assumed), IF THEN, skip at #5061, common #100-#199 #500-#999, 104 codes"
std::string facts(const stdlib::Control& control) {
  std::string common;
  for (const stdlib::VariableRange& range : control.common)
    common += fmt::format(" #{}-#{}", range.first, range.last);
  const std::string skip =
      control.variables.skip ? fmt::format("skip at #{}", *control.variables.skip) : "no skip position";
  return fmt::format("{}: {} ({}), {}, {}, common{}, {} codes", control.title,
                     control.decimal == stdlib::DecimalMode::Calculator ? "calculator" : "increment",
                     control.decimalGrade, control.ifThen ? "IF THEN" : "no IF THEN", skip, common,
                     control.codes.size());
}

// "title: axes XYZ, 47 G and 29 M functions, relies on Q12 Q20, Q7 open"
std::string facts(const stdlib::MikroprogControl& control) {
  std::size_t g = 0;
  for (const stdlib::MikroprogFunction& function : control.functions)
    g += function.letter == 'G' ? 1 : 0;
  std::string relied, open;
  for (const stdlib::MikroprogQuestion& question : control.questions)
    (question.assumed ? relied : open) += fmt::format(" Q{}", question.number);
  return fmt::format("{}: axes {}, {} G and {} M functions, taken as given:{}, open:{}", control.title,
                     control.axes, g, control.functions.size() - g, relied, open);
}

// "title: P9770 protected move; P9023 single surface along X, .."
std::string facts(const stdlib::MacroSet& set) {
  std::string out = set.title;
  std::uint32_t program = 0;
  for (const stdlib::MacroSignature& signature : set.signatures) {
    const bool same = signature.program == program;
    out += fmt::format("{}{}",
                       same           ? ", "
                       : program == 0 ? ": "
                                      : "; ",
                       same ? signature.title : fmt::format("P{} {}", signature.program, signature.title));
    program = signature.program;
  }
  return out;
}

// Name, origin and facts of each file of the folder; a file with a defect is reported, and the others stand.
template <class Thing>
std::vector<std::pair<std::string, std::string>> loaded(Session& session, const std::string& folder) {
  const std::vector<const stdlib::DataFile*> files = session.data().list(folder);
  std::size_t width = 0;
  for (const stdlib::DataFile* file : files)
    width = std::max(width, file->origin.size());
  std::vector<std::pair<std::string, std::string>> rows;
  for (const stdlib::DataFile* file : files) {
    try {
      const std::optional<Thing> thing = Thing::load(session.data(), file->name);
      rows.emplace_back(file->name, fmt::format("{:<{}}  {}", file->origin, width, facts(*thing)));
    } catch (const stdlib::DataError& error) {
      rows.emplace_back(file->name, fmt::format("{:<{}}  does not load", file->origin, width));
      session.diagnostics().report<diag::DataFileDefect>({}, error.what());
    }
  }
  return rows;
}

} // namespace

Outcome explain(const std::string& asked) {
  const std::string code = lowerCase(asked);
  Outcome outcome;
  std::vector<std::string> codes;
  for (const lint::CodeInfo& info : lint::codeTable()) {
    codes.emplace_back(info.code);
    if (info.code != code) continue;
    outcome.output = fmt::format("{}: {}{}\n\n{}", info.code, severityName(info.severity),
                                 info.byDefault ? "" : ", off unless it is selected", lint::helpOf(info));
    return outcome;
  }
  const std::string near = nearestName(code, codes);
  outcome.diagnostics.report<diag::UnknownCode>({}, code,
                                                near.empty() ? "" : "; did you mean `" + near + "`?");
  outcome.status = 2;
  return outcome;
}

Outcome list(const std::string& what, const CommonOptions& options) {
  return guarded(options, [&](Session& session) {
    // Its folders of data files; who mends a dotek.toml may look into the other tables.
    if (what == "forms" || what == "controls" || what == "macros" || what == "cycles")
      checkSettings({}, session);
    std::vector<std::pair<std::string, std::string>> rows;
    if (what == "limits") {
      for (const LimitInfo& limit : limitTable())
        rows.emplace_back(limit.name, fmt::format("{:>9}  {}", session.limits().*limit.member, limit.what));
    } else if (what == "hosts") {
      for (const stdlib::HostInput& host : stdlib::kHostInputs)
        rows.emplace_back(host.name, host.meaning);
    } else if (what == "assumptions") {
      rows = assumptionTable();
    } else if (what == "rules") {
      return outcomeOf(session, lint::ruleList(), true);
    } else if (what == "messages") {
      for (const lint::CodeInfo& info : lint::codeTable())
        if (info.rule == nullptr)
          rows.emplace_back(info.code,
                            fmt::format("{:<7}  {}", severityName(info.severity), lint::summaryOf(info)));
    } else if (what == "controls") {
      rows = loaded<stdlib::Control>(session, what);
      for (auto& row : loaded<stdlib::MikroprogControl>(session, "mikroprog"))
        rows.push_back(std::move(row));
    } else if (what == "macros") {
      rows = loaded<stdlib::MacroSet>(session, what);
    } else if (what == "forms" || what == "cycles") {
      for (const stdlib::DataFile* file : session.data().list(what))
        rows.emplace_back(file->name, file->origin);
      if (rows.empty())
        return outcomeOf(session, "none in this release; a folder given with --data can add some\n");
    } else if (what == "targets") {
      for (const NamedTarget& one : allTargets())
        rows.emplace_back(one.name, one.target->text);
    } else {
      session.diagnostics().report<diag::UnknownList>({}, what);
    }
    return outcomeOf(session, table(rows), true);
  });
}

} // namespace dotek::driver
