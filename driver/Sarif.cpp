#include "support/Sarif.h"

#include "driver/Driver.h"
#include "lint/Catalog.h"
#include "lint/Rule.h"

#include <set>

namespace dotek::driver {

std::string sarif(const Outcome& outcome) {
  std::set<std::string_view> told;
  for (const Diagnostic& d : outcome.diagnostics.all())
    told.insert(d.code);
  std::vector<SarifRule> rules;
  for (const lint::CodeInfo& info : lint::codeTable()) {
    if (told.contains(info.code))
      rules.push_back(
          {info.code, info.severity, lint::summaryOf(info), lint::helpOf(info), lint::helpMarkdownOf(info)});
  }
  return renderSarif(outcome.diagnostics, outcome.sources, rules);
}

} // namespace dotek::driver
