#include "ir/Dataflow.h"
#include "lint/Skips.h"

#include <set>

namespace dotek::lint::rule {
namespace {

enum class PortState : std::uint8_t { Closed, Open, Unknown };

std::set<std::uint32_t> called(const Project& project) {
  std::set<std::uint32_t> out;
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    for (const ir::ProgramStatement& statement : program.body) {
      const ir::Call* call = callOf(statement);
      const double* number = call != nullptr && call->program ? ir::constantValue(call->program) : nullptr;
      if (number != nullptr && *number > 0) out.insert(static_cast<std::uint32_t>(*number));
    }
  });
  return out;
}

// `main`: nobody opens the port before the program.
void checkProgram(const ir::Program& program, bool main, Report& report) {
  const auto& body = program.body;
  const auto before = ir::factsBefore<PortState>(
      body, main ? PortState::Closed : PortState::Unknown,
      [&](std::size_t at, std::size_t, PortState state) {
        if (const auto* port = std::get_if<ir::Port>(&body[at].node))
          return port->open ? PortState::Open : PortState::Closed;
        return callOf(body[at]) != nullptr ? PortState::Unknown : state; // a macro may open it
      },
      [](PortState& into, PortState other) {
        if (into == other || into == PortState::Unknown) return false;
        into = PortState::Unknown;
        return true;
      });
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!before[i] || *before[i] == PortState::Unknown) continue;
    const bool open = *before[i] == PortState::Open;
    const auto* port = std::get_if<ir::Port>(&body[i].node);
    const SourceRange range = body[i].origin.range();
    if (std::holds_alternative<ir::Print>(body[i].node) && !open) {
      report.at(range,
                "nothing has opened the port before this block prints; the control prints nothing or stops "
                "with an alarm; write POPEN before, and PCLOS after the last one");
      return;
    }
    if (port != nullptr && port->open == open)
      report.at(
          range, "{}",
          open
              ? "POPEN while the port is open already; the control may stop with an alarm; take it out, or "
                "write PCLOS before"
              : "PCLOS while the port is not open; the control may stop with an alarm; take it out, or write "
                "the POPEN that is missing");
  }
}

void check(const Project& project, Report& report) {
  const std::set<std::uint32_t> others = called(project);
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    const bool main = endsProgram(program) && !others.contains(static_cast<std::uint32_t>(program.number));
    checkProgram(program, main, report);
  });
}

} // namespace

DOTEK_LINT_RULE(print_without_port){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
