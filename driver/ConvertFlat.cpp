#include "driver/ConvertFlat.h"

#include "driver/ProgramTools.h"
#include "project/CycleLowering.h"
#include "project/Session.h"
#include "support/WholeName.h"

#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <system_error>

namespace dotek::driver {

std::optional<Outcome> takeFlat(ConvertOptions& options, FoundInRuns& found) {
  auto buffers = std::make_shared<std::map<std::string, std::string>>();
  if (options.common.buffers != nullptr) *buffers = *options.common.buffers;
  std::error_code error;
  for (const std::string& input : options.inputs) {
    project::Session session(options.common);
    if (std::filesystem::is_directory(input, error) || project::isCycleFile(input, session)) continue;
    SimOptions run;
    run.program = input;
    run.common = options.common;
    run.control = options.fromControl;
    run.variables = options.variables;
    Outcome outcome = flatten(run);
    if (outcome.status != 0) return outcome;
    for (const Diagnostic& one : outcome.diagnostics.all())
      if (one.severity == Severity::Warning)
        found.emplace_back(
            one.range.hasPlace() ? fmt::format("line {}: ", outcome.sources.line(one.range)) : "", one);
    (*buffers)[wholeName(input)] = std::move(outcome.output);
  }
  options.common.buffers = std::move(buffers);
  return std::nullopt;
}

} // namespace dotek::driver
