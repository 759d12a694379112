#include "lint/OwnCalls.h"
#include "stdlib/MacroSet.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  const auto calls = callsByProgram(project);
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    const auto at = calls.find(static_cast<std::uint32_t>(program.number));
    if (program.number == 0 || at == calls.end()) return;
    for (const std::uint32_t local : requiredLocals(program)) {
      const char letter = stdlib::letterOfLocal(local);
      for (const OwnCall& call : at->second)
        if (letter != 0 && !call.given.contains(local))
          report
              .at(call.statement->origin.range(),
                  "O{} ends in an alarm where {} is not given, and this call does not give it; write it",
                  program.number, letter)
              .note(program.range, "the program");
    }
  });
}

} // namespace

DOTEK_LINT_RULE(required_argument_missing){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
