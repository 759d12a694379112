#include "driver/VerifyCases.h"

#include "targets/VerifyRuns.h"

namespace dotek::driver {

Outcome outcomeOfCases(const VerifyOptions& options, bool edges, CaseSubject& main,
                       const std::function<std::unique_ptr<CaseSubject>()>& another, VerifyReport& report,
                       const Diagnostics& said) {
  Session& session = main.session();
  if (!runCases(options, edges, main, another, report)) return outcomeOf(session, "");
  session.diagnostics() = Diagnostics();
  Outcome outcome = outcomeOf(session, report.finish(), true);
  if (options.format != targets::ReportFormat::Text) outcome.files.push_back({"report", report.rendered()});
  for (const Diagnostic& one : said.all())
    outcome.diagnostics.add(one);
  outcome.diagnostics.sort();
  return outcome;
}

} // namespace dotek::driver
