#include "ir/Extremes.h"
#include "ir/Walk.h"
#include "lint/AfterSkip.h"
#include "lint/AskedVariables.h"
#include "lint/ContactUse.h"

#include <algorithm>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::size_t kMostSteps = 200'000; // of all the walks of a program
constexpr std::uint32_t kFirstCommon = 100;
constexpr std::uint32_t kFirstSystem = 1000;

template <class Tree> void collectNumbers(const Tree& tree, std::set<std::uint32_t>& out) {
  ir::eachNode(tree, [&](const ir::Expression& node) {
    if (!std::holds_alternative<ir::MachineVariable>(node.node)) return;
    if (const auto number = variableNumber(node)) out.insert(*number);
  });
}

// Where the contact of this G31 is taken: kept in a variable or an offset, or printed into a block that
// offsets by it.
struct Taken {
  std::size_t at = 0;
  SourceRange range;
  std::uint32_t number = 0;
};

std::optional<Taken> takenAt(const ir::ProgramStatement& statement, std::size_t at, AxisSet axes) {
  const auto* store = std::get_if<ir::Store>(&statement.node);
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  if (store == nullptr && (block == nullptr || !hasCode(*block, 'G', 10))) return std::nullopt;
  std::optional<Taken> out;
  ir::eachNode(statement, [&](const ir::Expression& node) {
    const auto number = variableNumber(node);
    const auto axis = number ? contactAxis(*number) : std::nullopt;
    if (axis && (*axis & axes) != 0 && !out)
      out = Taken{at, node.range.hasPlace() ? node.range : statement.origin.range(), *number};
  });
  return out;
}

// G92 where the machine is still at the end of the G31: the place gets coordinates of the surface.
std::optional<Taken> zeroSetThere(const NcProgram& nc, const std::vector<std::size_t>& after,
                                  std::size_t skip, AxisSet axes) {
  const auto& body = nc.program.body;
  std::set<std::size_t> seen;
  std::vector<std::size_t> open{skip};
  while (!open.empty()) {
    const std::size_t from = open.back();
    open.pop_back();
    for (const std::size_t at : nc.flow().next[from]) {
      if (!std::binary_search(after.begin(), after.end(), at) || !seen.insert(at).second) continue;
      const auto* block = std::get_if<ir::NcBlock>(&body[at].node);
      const AxisSet named = block == nullptr || hasCode(*block, 'G', 10) ? AxisSet{0} : axesOf(*block);
      if (named == 0) {
        open.push_back(at);
        continue;
      }
      if (!hasCode(*block, 'G', 92) || (named & axes) == 0) continue; // it moves on
      std::uint32_t number = 5061;
      while ((named & axes & 1U << (number - 5061)) == 0)
        ++number;
      return Taken{at, body[at].origin.range(), number};
    }
  }
  return std::nullopt;
}

// Variables that hold the contact, from where it is taken and from copies of those.
std::set<std::uint32_t> heldIn(const ir::Program& program, std::set<std::uint32_t> held) {
  for (bool grows = !held.empty(); grows;) {
    grows = false;
    for (const ir::ProgramStatement& statement : program.body) {
      const auto* store = std::get_if<ir::Store>(&statement.node);
      const auto number = storedNumber(statement);
      if (store == nullptr || !number || *number >= kFirstSystem || held.contains(*number)) continue;
      std::set<std::uint32_t> read;
      collectNumbers(store->value, read);
      if (std::none_of(read.begin(), read.end(), [&](std::uint32_t one) { return held.contains(one); }))
        continue;
      held.insert(*number);
      grows = true;
    }
  }
  return held;
}

// The condition before `skip` that looks at the variable, with the value of another G31.
std::optional<SourceRange> lastAskBefore(const NcProgram& nc, std::size_t skip, std::uint32_t number) {
  for (std::size_t at = skip; at-- > 0;) {
    const ir::ConditionPtr* condition = ir::conditionOf(nc.program.body[at]);
    if (condition == nullptr || !*condition) continue;
    for (const VariableRead& read : nc.reads(at))
      if (read.number == number) return nc.program.body[at].origin.range();
  }
  return std::nullopt;
}

void check(const NcProgram& nc, Report& report) {
  const auto& body = nc.program.body;
  std::optional<std::set<std::uint32_t>> asked;
  std::size_t steps = kMostSteps;
  for (const std::size_t i : nc.skips()) {
    const ir::NcBlock* skip = skipOf(body[i]);
    if (mayAskControl(body[i]) || report.full(body[i].origin.range().file)) continue;
    const auto after = afterSkip(nc, i);
    if (!after || std::any_of(after->begin(), after->end(), [&](std::size_t at) {
          return mayAskControl(body[at]) && !ir::keepsExtreme(body, at);
        }))
      continue;
    std::optional<Taken> taken;
    std::set<std::uint32_t> held;
    for (const std::size_t at : *after) {
      const auto read = nc.reads(at);
      if (std::none_of(read.begin(), read.end(),
                       [](const VariableRead& one) { return contactAxis(one.number).has_value(); }))
        continue;
      const auto here = takenAt(body[at], at, axesOf(*skip));
      if (!here) continue;
      if (!taken) taken = here;
      if (const auto number = storedNumber(body[at]); number && *number < kFirstSystem) held.insert(*number);
    }
    if (const auto zero = zeroSetThere(nc, *after, i, axesOf(*skip)); zero && !taken) taken = zero;
    if (!taken) continue;
    const auto use = contactUse(nc, i, steps);
    if (use && use->asked) continue;
    if (!asked) asked = askedIn(nc.program);
    const std::set<std::uint32_t> all = use ? use->held : heldIn(nc.program, std::move(held));
    const auto askedOf =
        std::find_if(all.begin(), all.end(), [&](std::uint32_t number) { return asked->contains(number); });
    if (askedOf != all.end() && (!use || use->leadsOn)) continue;
    // A result that a caller looks at is asked for there.
    if (std::any_of(all.begin(), all.end(), [&](std::uint32_t number) {
          return number >= kFirstCommon && askersOf(nc.project).othersAsk(nc.program, number);
        }))
      continue;
    Diagnostic& finding = report.at(
        body[i].origin.range(),
        "nothing asks whether this G31 touched; where it meets nothing, #{0} is the end of the move, and "
        "the control goes on without an alarm with a result that is wrong; compare #{0} with the target "
        "after it, and end in an alarm where they are equal",
        taken->number);
    finding.note(taken->range, "it is taken for the contact here");
    if (askedOf == all.end()) continue;
    if (const auto where = lastAskBefore(nc, i, *askedOf))
      finding.note(*where, fmt::format("#{} is asked about here, before this G31 moves", *askedOf));
  }
}

} // namespace

DOTEK_LINT_RULE(skip_never_tested){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
