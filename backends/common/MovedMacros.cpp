#include "backends/common/MovedMacros.h"

#include "ir/Walk.h"
#include "stdlib/MovedSet.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <array>

namespace dotek::backends {
namespace {

bool isKept(const stdlib::Control& control, std::uint32_t first, std::uint32_t last) {
  return std::any_of(control.common.begin(), control.common.end(), [&](const stdlib::VariableRange& range) {
    return range.kept && range.first <= first && last <= range.last;
  });
}

// A computed number counts from its constant by an index or two.
constexpr std::uint32_t kReach = 30;

template <class Statement> void addNumbers(const std::vector<Statement>& list, std::set<std::uint32_t>& out) {
  const auto add = [&](const ir::ExpressionPtr& number) {
    if (const double* known = ir::constantValue(number)) {
      if (*known > 0 && *known < 1e5) out.insert(static_cast<std::uint32_t>(*known));
    } else if (const auto first = ir::firstNumber(number)) {
      for (std::uint32_t one = *first; one <= *first + kReach; ++one)
        out.insert(one);
    }
  };
  for (const Statement& statement : list) {
    if (const auto* store = std::get_if<ir::Store>(&statement.node)) add(store->number);
    ir::eachNode(statement, [&](const ir::Expression& node) {
      if (const auto* variable = std::get_if<ir::MachineVariable>(&node.node)) add(variable->number);
    });
  }
}

} // namespace

std::set<std::uint32_t> numbersOf(const ir::Cycle& cycle) {
  std::set<std::uint32_t> out;
  addNumbers(cycle.checks, out);
  addNumbers(cycle.body, out);
  return out;
}

std::set<std::uint32_t> numbersOf(const ir::ProgramFile& file) {
  std::set<std::uint32_t> out;
  for (const ir::Program& program : file.programs)
    addNumbers(program.body, out);
  return out;
}

std::string storeRemedy(const stdlib::MacroSet& macros, const stdlib::Control& control,
                        const std::set<std::uint32_t>& used) {
  const std::string elsewhere = "store the value elsewhere";
  const auto name = stdlib::movedName(macros.name);
  const auto kept = stdlib::keptVariables(macros);
  // Those of a vendor's macros are where they are.
  if (!name || !kept || macros.needs.find("new macros " + macros.name) == std::string::npos) return elsewhere;
  const std::uint32_t count = kept->second - kept->first;
  const auto& package = control.package;
  for (const std::uint32_t first : std::array{900U, 800U, 700U, 600U, 950U, 850U, 650U, 540U}) {
    const std::uint32_t last = first + count;
    const auto at = used.lower_bound(first);
    const bool isFree = at == used.end() || *at > last;
    const bool isMaker = package && first <= package->calibrationLast && last >= package->calibrationFirst;
    if (isFree && !isMaker && isKept(control, first, last))
      return elsewhere + ", or move those of the macros: `--probe-macros " + std::string(name->set) + "@" +
             std::to_string(first) + "`";
  }
  return elsewhere;
}

bool holdsKept(const stdlib::MacroSet& macros, const stdlib::Control& control, Diagnostics& diagnostics) {
  const auto name = stdlib::movedName(macros.name);
  const auto kept = stdlib::keptVariables(macros);
  if (!name || !name->first || !kept || isKept(control, kept->first, kept->second)) return true;
  if (macros.needsSkipPosition && !control.variables.skip) // no other variables help
    diagnostics.report<diag::NoSkipPosition>({}, "macros of " + macros.title, control.title);
  else
    diagnostics.report<diag::MacroVariablesLost>({}, kept->first, kept->second, control.title, name->set);
  return false;
}

} // namespace dotek::backends
