// Which letter of G65 hands over which parameter: docs/convert.md, "Letters".
#include "backends/fanuc/Emit.h"
#include "backends/fanuc/Uses.h"
#include "ir/Fold.h"
#include "ir/Positions.h"
#include "support/Ascii.h"
#include "support/NearestName.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <set>

namespace dotek::backends::fanuc {

namespace {

constexpr std::string_view kOrder = "ABCDEFHMQRSTUVWXYZIJK";

// Argument specification I.
std::uint32_t localOf(char letter) {
  constexpr std::string_view kLetters = "ABCIJKDEFHMQRSTUVWXYZ";
  constexpr std::uint32_t kLocals[] = {1,  2,  3,  4,  5,  6,  7,  8,  9,  11, 13,
                                       17, 18, 19, 20, 21, 22, 23, 24, 25, 26};
  return kLocals[kLetters.find(letter)];
}

struct Assignment {
  const ir::Cycle& cycle;
  std::vector<ir::VariableId> wanted; // parameters in the order of declaration, then hosts
  std::map<ir::VariableId, char> letters;
  std::set<char> taken;

  bool needs(ir::VariableId id) const {
    return std::find(wanted.begin(), wanted.end(), id) != wanted.end() && !letters.contains(id);
  }
  void give(ir::VariableId id, char letter) {
    letters[id] = letter;
    taken.insert(letter);
  }
};

std::vector<ir::VariableId> wantedNames(const ir::Cycle& cycle, const EmitOptions& options) {
  const std::set<ir::VariableId> used = usedVariables(cycle);
  std::vector<ir::VariableId> out;
  for (const ir::Role role : {ir::Role::Parameter, ir::Role::Host})
    for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
      const ir::Variable& variable = cycle.variable(id);
      if (variable.role != role) continue;
      const bool retract = role == ir::Role::Host && variable.name == "retract" &&
                           !options.fixed.contains("retract") && ir::countsFrom(cycle, ir::Frame::Retract);
      if (!used.contains(id) && !retract) continue;
      if (isStartHost(variable) && options.control.variables.blockEnd) continue;
      out.push_back(id);
    }
  return out;
}

std::string listed(const Assignment& assignment) {
  std::string out;
  for (const ir::VariableId id : assignment.wanted)
    out += (out.empty() ? "`" : ", `") + assignment.cycle.variable(id).name + "`";
  return out;
}

bool takeOverrides(Assignment& out, const EmitOptions& options, Diagnostics& diagnostics) {
  bool fine = true;
  for (const auto& [name, given] : options.letters) {
    const char letter = upperCase(given);
    std::optional<ir::VariableId> id;
    for (const ir::VariableId candidate : out.wanted)
      if (out.cycle.variable(candidate).name == name) id = candidate;
    if (!id) {
      std::vector<std::string> names;
      for (const ir::VariableId candidate : out.wanted)
        names.push_back(out.cycle.variable(candidate).name);
      const std::string near = nearestName(name, names);
      diagnostics.report<diag::ArgumentUnknown>({}, name, near.empty() ? "" : "; `" + near + "` is near");
      fine = false;
    } else if (kOrder.find(letter) == std::string_view::npos) {
      diagnostics.report<diag::LetterNotAllowed>({}, name, std::string(1, given));
      fine = false;
    } else if (out.taken.contains(letter)) {
      diagnostics.report<diag::LetterTwice>({}, std::string(1, letter), name);
      fine = false;
    } else {
      out.give(*id, letter);
    }
  }
  return fine;
}

void takeDirect(Assignment& out) {
  for (const auto* list : {&out.cycle.checks, &out.cycle.body})
    for (const ir::CycleStatement& statement : *list)
      for (const auto& [given, id] : statement.origin.arguments) {
        const char letter = upperCase(given);
        if (kOrder.find(letter) == std::string_view::npos || !out.needs(id) || out.taken.contains(letter) ||
            out.cycle.variable(id).role != ir::Role::Parameter)
          continue;
        out.give(id, letter);
      }
}

void takeOwnNames(Assignment& out) {
  for (const ir::VariableId id : out.wanted) {
    const std::string& name = out.cycle.variable(id).name;
    if (name.size() != 1 || !out.needs(id)) continue;
    const char letter = upperCase(name[0]);
    if (kOrder.find(letter) != std::string_view::npos && !out.taken.contains(letter)) out.give(id, letter);
  }
}

void warnOfOtherFields(const Assignment& assignment, Diagnostics& diagnostics) {
  for (const auto& [id, letter] : assignment.letters)
    for (ir::VariableId other = 0; other < assignment.cycle.variables.size(); ++other) {
      const ir::Variable& variable = assignment.cycle.variable(other);
      if (other == id || variable.role != ir::Role::Parameter || variable.name.size() != 1 ||
          upperCase(variable.name[0]) != letter)
        continue;
      const ir::Variable& own = assignment.cycle.variable(id);
      diagnostics.report<diag::LetterOfOtherField>(own.range, std::string(1, letter), own.name,
                                                   variable.name);
    }
}

} // namespace

std::optional<std::vector<Argument>> assignLetters(const ir::Cycle& cycle, const EmitOptions& options,
                                                   Diagnostics& diagnostics) {
  Assignment out{cycle, wantedNames(cycle, options), {}, {}};
  if (!takeOverrides(out, options, diagnostics)) return std::nullopt;
  if (out.wanted.size() > kOrder.size()) {
    diagnostics.report<diag::TooManyArguments>(cycle.range, out.wanted.size(), kOrder.size(), listed(out));
    return std::nullopt;
  }
  takeDirect(out);
  takeOwnNames(out);
  for (const ir::VariableId id : out.wanted) {
    if (!out.needs(id)) continue;
    const auto free =
        std::find_if(kOrder.begin(), kOrder.end(), [&](char letter) { return !out.taken.contains(letter); });
    out.give(id, *free);
  }
  warnOfOtherFields(out, diagnostics);
  std::vector<Argument> arguments;
  for (const ir::VariableId id : out.wanted)
    arguments.push_back({id, out.letters.at(id), localOf(out.letters.at(id))});
  return arguments;
}

} // namespace dotek::backends::fanuc
