#include "project/CycleChecks.h"

#include "frontend/gibbs/Blame.h"
#include "frontend/gibbs/Labels.h"
#include "frontend/gibbs/Run.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <set>
#include <utility>

namespace dotek::project {

namespace gibbs = frontend::gibbs;

namespace {

std::string flags(const std::vector<std::string>& hosts) {
  std::string out;
  for (const std::string& name : hosts)
    out += (out.empty() ? "`--host " : " and `--host ") + name + "=VALUE`";
  return out;
}

// Folded names of what the user types in the dialog.
std::set<std::string> typedInDialog(const CycleFolder& folder) {
  std::set<std::string> out;
  if (!folder.cycle->dialog) return out;
  for (const gibbs::Control& control : folder.cycle->dialog->controls)
    if (control.variable) out.insert(gibbs::foldCase(control.variable->text));
  return out;
}

bool isStored(const std::set<std::string>& typed, const Session& session, const std::string& name) {
  return !typed.contains(name) || session.options().assume.contains("changed-field=macro");
}

// The CAM stores a variable as the macro leaves it. That is certain enough where the user cannot type the
// value; where he can, which of the two is stored is not known.
void takeChanges(const gibbs::ChecksResult& result, const CycleFolder& folder, FieldTable& fields,
                 Session& session) {
  if (result.changed.empty()) return;
  const std::set<std::string> typed = typedInDialog(folder);
  const std::map<std::string, double> before = fields.macroValues();
  std::size_t at = 0;
  for (const auto& [name, value] : result.changed) {
    const SourceRange where =
        at < result.changedAt.size() ? result.changedAt[at] : SourceRange{folder.place, 0, 0};
    ++at;
    const auto given = before.find(name);
    const std::string was = given == before.end() ? "nothing" : numberText(given->second);
    if (isStored(typed, session, name)) {
      session.diagnostics().report<diag::FieldComputed>(where, name, numberText(value), was);
      fields.change(name, value);
    } else if (!session.options().assume.contains("changed-field=given")) {
      session.diagnostics().report<diag::FieldChangedByChecks>(where, name, was, numberText(value));
    }
  }
}

constexpr std::string_view kNoMessage = "no message"; // a message of that text has marks

// One finding, however many messages the macro shows.
void rejected(const gibbs::ChecksResult& result, const CycleFolder& folder, const gibbs::RunContext& context,
              Blame blame, Diagnostics& diagnostics) {
  // A value that the user types; what the macro computes from it follows.
  std::set<std::string> typed;
  if (blame == Blame::Fields)
    for (const std::string& name : typedInDialog(folder))
      if (context.fields.contains(name)) typed.insert(name);
  std::vector<std::pair<std::string, double>> blamed;
  std::vector<std::string> causes;
  if (blame == Blame::Fields)
    causes = gibbs::fieldsToBlame(*folder.cycle->cycleData, folder.cycle->others, context, typed);
  for (const std::string& folded : causes) {
    std::string written = folded;
    for (const gibbs::Field& field : gibbs::declaredFields(*folder.cycle))
      if (gibbs::foldCase(field.name.text) == folded) written = field.name.text;
    blamed.emplace_back(written, context.fields.at(folded));
  }
  const std::string values = rejectedValues(blamed);
  const auto shown = [](const std::string& text) {
    return text.empty() ? std::string(kNoMessage) : "`" + text + "`";
  };
  if (result.rejections.empty()) {
    diagnostics.report<diag::ValuesRejected>({folder.cycle->cycleData->file, 0, 0}, folder.name, values,
                                             shown(""));
    return;
  }
  const gibbs::Rejection& first = result.rejections.front();
  Diagnostic& finding =
      diagnostics.report<diag::ValuesRejected>(first.range, folder.name, values, shown(first.text));
  for (std::size_t i = 1; i < result.rejections.size(); ++i) {
    const gibbs::Rejection& further = result.rejections[i];
    finding.note(further.range, "it may show this, too: " + shown(further.text));
  }
}

} // namespace

std::string rejectedValues(const std::vector<std::pair<std::string, double>>& values) {
  if (values.empty()) return "these values";
  std::string out;
  for (std::size_t i = 0; i < values.size(); ++i)
    out += (i == 0                   ? "`"
            : i + 1 == values.size() ? " with `"
                                     : ", `") +
           values[i].first + "` = " + numberText(values[i].second);
  return out;
}

bool isWithoutMessage(std::string_view rejection) {
  return rejection.ends_with(kNoMessage);
}

void takeComputed(const gibbs::ChecksResult& result, const CycleFolder& folder, const Session& session,
                  std::map<std::string, double>& values) {
  using Verdict = gibbs::ChecksResult::Verdict;
  if (result.verdict != Verdict::Passes && result.verdict != Verdict::Depends) return;
  if (result.changed.empty()) return;
  const std::set<std::string> typed = typedInDialog(folder);
  for (const auto& [name, value] : result.changed)
    if (isStored(typed, session, name)) values[name] = value;
}

gibbs::RunContext runContext(const CycleFolder& folder, const FieldTable& fields,
                             std::map<std::string, double> hosts, Session& session) {
  MacroLoader* const loader = folder.loader.get();
  return {session.sources(),
          session.gibbsKeywords(),
          session.limits(),
          session.diagnostics(),
          fields.macroValues(),
          std::move(hosts),
          session.options().assume,
          [loader](const std::string& name, SourceRange where) { return loader->macro(name, where); },
          [loader](const std::string& name, SourceRange where) { return loader->dialog(name, where); },
          &loader->programs()};
}

void runCycleChecks(const CycleFolder& folder, FieldTable& fields, const std::map<std::string, double>& hosts,
                    Session& session, Blame blame) {
  if (!folder.cycle->cycleData) return;
  Diagnostics& diagnostics = session.diagnostics();
  gibbs::RunContext context = runContext(folder, fields, hosts, session);
  const gibbs::ChecksResult result = gibbs::runChecks(*folder.cycle->cycleData, context);
  switch (result.verdict) {
  case gibbs::ChecksResult::Verdict::Rejected: rejected(result, folder, context, blame, diagnostics); return;
  case gibbs::ChecksResult::Verdict::Depends: {
    if (result.neededHosts.empty()) break; // no flag helps; what is unknown has been reported
    const SourceRange where = result.rejections.empty() ? SourceRange{folder.cycle->cycleData->file, 0, 0}
                                                        : result.rejections.front().range;
    // Where no host input decides it, the conditions that stay open are named one by one.
    if (!result.neededHosts.empty())
      diagnostics.report<diag::ChecksDepend>(where, folder.name, flags(result.neededHosts));
    break;
  }
  case gibbs::ChecksResult::Verdict::NotRun:
    if (!diagnostics.hasErrors() && !session.options().assume.contains("unchecked"))
      diagnostics.report<diag::ChecksNotRun>({folder.cycle->cycleData->file, 0, 0}, folder.name);
    return;
  case gibbs::ChecksResult::Verdict::Passes: break;
  }
  for (const gibbs::Rejection& shown : result.shown)
    diagnostics.report<diag::MessageInChecks>(shown.range, folder.name, shown.text);
  takeChanges(result, folder, fields, session);
}

} // namespace dotek::project
