#include "ir/Dataflow.h"
#include "lint/Skips.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

constexpr AxisSet kAnyAxis = 8; // a called program may have moved
constexpr AxisSet kNone = 16;   // on one path nothing has

std::string names(AxisSet axes) {
  std::string out;
  for (const auto& [bit, name] : {std::pair{1, 'X'}, {2, 'Y'}, {4, 'Z'}})
    if ((axes & bit) != 0) out += out.empty() ? std::string(1, name) : fmt::format(" and {}", name);
  return out;
}

void checkProgram(const ir::Program& program, Report& report) {
  const auto& body = program.body;
  const bool skips = std::any_of(body.begin(), body.end(),
                                 [](const ir::ProgramStatement& s) { return skipOf(s) != nullptr; });
  // A macro may evaluate what its caller measured.
  if (!skips && !endsProgram(program)) return;
  const auto moved = ir::factsBefore<AxisSet>(
      body, kNone,
      [&](std::size_t at, std::size_t, AxisSet axes) -> AxisSet {
        if (const ir::NcBlock* skip = skipOf(body[at])) return axesOf(*skip);
        return callOf(body[at]) != nullptr ? kAnyAxis : axes;
      },
      [](AxisSet& into, AxisSet other) {
        const AxisSet before = into;
        into = static_cast<AxisSet>(into | other);
        return into != before;
      });
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!moved[i] || (*moved[i] & kAnyAxis) != 0) continue;
    bool told = false;
    eachRead(body[i], [&](std::uint32_t number, SourceRange range) {
      const auto axis = contactAxis(number);
      const bool none = (*moved[i] & kNone) != 0;
      if (!axis || told || (!none && (*moved[i] & *axis) != 0)) return;
      told = true;
      const SourceRange place = range.hasPlace() ? range : body[i].origin.range();
      if (none)
        report.at(place,
                  "#{} is where the last G31 stopped, and no G31 is before this block; the value is left "
                  "from another measurement; read it after the G31",
                  number);
      else
        report.at(place,
                  "#{} is where the last G31 stopped along {}, and that G31 moves along {} alone; the value "
                  "says nothing about the surface; read the variable of the other axis, or move along {}",
                  number, names(*axis), names(*moved[i]), names(*axis));
    });
  }
}

void check(const Project& project, Report& report) {
  eachProgram(project,
              [&](const ir::Program& program, const macrob::File&) { checkProgram(program, report); });
}

} // namespace

DOTEK_LINT_RULE(contact_of_other_axis){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
