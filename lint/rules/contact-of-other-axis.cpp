#include "ir/Dataflow.h"
#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <algorithm>
#include <map>
#include <optional>

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

// How often a variable is read, and how often as the second length of ATAN alone: the way along the surface
// between two touches, for which any position serves.
struct Reads {
  std::map<std::uint32_t, std::size_t> all, alongAngle;

  explicit Reads(const std::vector<ir::ProgramStatement>& body) {
    const auto count = [](const ir::Expression& node, std::map<std::uint32_t, std::size_t>& into) {
      const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
      const double* number = variable == nullptr ? nullptr : ir::constantValue(variable->number);
      if (number != nullptr && *number >= 1 && *number < 1e6) ++into[static_cast<std::uint32_t>(*number)];
    };
    for (const ir::ProgramStatement& statement : body)
      ir::eachNode(statement, [&](const ir::Expression& node) {
        count(node, all);
        const auto* binary = std::get_if<ir::Binary>(&node.node);
        if (binary == nullptr || binary->op != ir::BinaryOp::Bearing) return;
        ir::eachNode(binary->left, [&](const ir::Expression& inner) { count(inner, alongAngle); });
      });
  }
  bool onlyAlongAngle(std::uint32_t variable) const {
    const auto found = alongAngle.find(variable);
    return found != alongAngle.end() && found->second == all.at(variable);
  }
};

// The axes of the G31s of a loop, and kAnyAxis where it calls a program.
AxisSet touchedIn(const std::vector<ir::ProgramStatement>& body, std::size_t loop, std::size_t end) {
  AxisSet out = 0;
  for (std::size_t i = loop; i < end; ++i) {
    if (const ir::NcBlock* skip = skipOf(body[i])) out = static_cast<AxisSet>(out | axesOf(*skip));
    if (callOf(body[i]) != nullptr) out = static_cast<AxisSet>(out | kAnyAxis);
  }
  return out;
}

// One of several stores in a row that keep the whole position, the axis that touched included: the other
// axes are where they stand.
bool keepsWholePosition(const NcProgram& nc, std::size_t at, std::uint32_t kept, std::uint32_t read,
                        AxisSet moved) {
  const auto& body = nc.program.body;
  for (std::size_t i = at > 2 ? at - 2 : 0; i < body.size() && i <= at + 2; ++i) {
    const auto* store = std::get_if<ir::Store>(&body[i].node);
    const auto other = store == nullptr ? std::nullopt : storedNumber(body[i]);
    const auto contact = store == nullptr ? std::nullopt : variableNumber(*store->value);
    const auto axis = contact ? contactAxis(*contact) : std::nullopt;
    if (axis && (*axis & moved) != 0 && other && *other - kept == *contact - read) return true;
  }
  return false;
}

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const auto& body = program.body;
  // A macro may evaluate what its caller measured.
  if (nc.skips().empty() && !endsProgram(program)) return;
  std::optional<Reads> reads;
  const auto moved = ir::factsBefore<AxisSet>(
      body, nc.flow(), kNone,
      [&](std::size_t at, std::size_t to, AxisSet axes) -> AxisSet {
        // A loop that touches is written to run.
        if (std::holds_alternative<ir::Loop>(body[at].node) && to > at + 1 && (axes & kNone) != 0)
          if (const AxisSet touched = touchedIn(body, at, to); touched != 0)
            return static_cast<AxisSet>((axes & ~kNone) | touched);
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
    for (const auto& [number, range] : nc.reads(i)) {
      const auto axis = contactAxis(number);
      const bool none = (*moved[i] & kNone) != 0;
      if (!axis || told || (!none && (*moved[i] & *axis) != 0)) continue;
      const auto* store = std::get_if<ir::Store>(&body[i].node);
      const auto kept = store == nullptr ? std::nullopt : storedNumber(body[i]);
      if (!none && kept) {
        if (!reads) reads.emplace(body);
        if (reads->onlyAlongAngle(*kept)) continue;
      }
      if (!none && kept && keepsWholePosition(nc, i, *kept, number, *moved[i])) continue;
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
    }
  }
}

} // namespace

DOTEK_LINT_RULE(contact_of_other_axis){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
