#include "backends/fanuc/ProgramCalls.h"

#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dotek::backends::fanuc {

namespace {

// P of a macro call with a literal number that some set knows.
std::optional<std::uint32_t> knownCall(const ir::Statement& statement,
                                       const std::vector<stdlib::MacroSet>& sets) {
  const auto* call = std::get_if<ir::Call>(&statement.node);
  if (call == nullptr || !call->program) return std::nullopt;
  const double* value = ir::constantValue(call->program);
  if (value == nullptr || *value < 1 || *value > 99999999) return std::nullopt;
  const auto number = static_cast<std::uint32_t>(std::lround(*value));
  const bool known =
      std::any_of(sets.begin(), sets.end(), [&](const stdlib::MacroSet& set) { return set.calls(number); });
  return known ? std::optional(number) : std::nullopt;
}

// `fits`: sets that know all calls so far.
struct Found {
  std::vector<const stdlib::MacroSet*> fits;
  const ir::Statement* first = nullptr;
  const ir::Statement* mixed = nullptr;
};

void look(const ir::Program& program, const std::vector<stdlib::MacroSet>& sets, Found& found) {
  for (const ir::Statement& statement : program.body) {
    const auto number = knownCall(statement, sets);
    if (!number || found.mixed != nullptr) continue;
    if (found.first == nullptr) {
      found.first = &statement;
      for (const stdlib::MacroSet& set : sets)
        found.fits.push_back(&set);
    }
    std::erase_if(found.fits, [&](const stdlib::MacroSet* set) { return !set->calls(*number); });
    if (found.fits.empty()) found.mixed = &statement;
  }
}

} // namespace

const stdlib::MacroSet* calledSet(const ir::ProgramFile& file, const std::vector<stdlib::MacroSet>& sets,
                                  const ir::Statement** mixed) {
  Found found;
  for (const ir::Program& program : file.programs)
    look(program, sets, found);
  if (mixed != nullptr) *mixed = found.mixed;
  return found.first == nullptr || found.fits.empty() ? nullptr : found.fits.front();
}

bool translateCalls(ir::Program& program, const stdlib::MacroSet& wanted,
                    const std::vector<stdlib::MacroSet>& sets, Diagnostics& diagnostics) {
  Found found;
  look(program, sets, found);
  if (found.first == nullptr) return true;
  if (found.mixed != nullptr) {
    diagnostics.report<diag::CallsOfSeveralSets>(found.mixed->origin.range(), wanted.name,
                                                 *knownCall(*found.mixed, sets));
    return false;
  }
  const bool same = std::any_of(found.fits.begin(), found.fits.end(),
                                [&](const stdlib::MacroSet* set) { return set->name == wanted.name; });
  if (same) return true;
  diagnostics.report<diag::CallsOfOtherSet>(found.first->origin.range(), wanted.name,
                                            found.fits.front()->title);
  return false;
}

} // namespace dotek::backends::fanuc
