#include "cli/Documents.h"

#include "cli/FindingsPage.h"
#include "driver/ProgramTools.h"
#include "sim/run/SimReport.h"
#include "support/CodeHosts.h"
#include "support/RenderText.h"

namespace dotek::cli {

std::string findingsDocument(std::string_view format, const driver::Outcome& outcome) {
  return format == "json"     ? renderJson(outcome.diagnostics, outcome.sources)
         : format == "sarif"  ? driver::sarif(outcome)
         : format == "github" ? renderGithub(outcome.diagnostics, outcome.sources)
         : format == "gitlab" ? renderGitlab(outcome.diagnostics, outcome.sources)
         : format == "html"   ? findingsPage(outcome.diagnostics, outcome.sources, outcome.summary)
                              : std::string();
}

std::string notRunDocument(std::string_view command, bool json, std::string_view format,
                           const driver::Outcome& outcome) {
  if (command == "sim" && json) return sim::notRunSummary(outcome.diagnostics, outcome.sources);
  if (command == "outline" && json) return std::string(driver::kEmptyOutline);
  return command == "lint" || command == "check" ? findingsDocument(format, outcome) : "";
}

} // namespace dotek::cli
