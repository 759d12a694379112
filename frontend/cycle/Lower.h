// A cycle to the IR.
#pragma once

#include "frontend/cycle/Ast.h"
#include "frontend/cycle/Link.h"
#include "ir/Cycle.h"
#include "support/Diagnostics.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::frontend::cycle {

// A called cycle that is a program of its own. What its caller demands of the machine it does not ask for
// again, and it ends with the call ir::kResults.
struct CalledProgram {
  ir::Cycle cycle;
  std::map<ir::VariableId, char> letters;
  std::vector<std::string> results;  // all that it has, in the order of ir::handedBack()
  std::set<std::string> readResults; // those that some caller reads
};

// A call that was to be of a program and has its cycle in its place.
struct CallInPlace {
  SourceRange range;
  std::string cycle, why;
};

// A cycle of the library that a program of a macro set carries out.
struct MacroCycle {
  ir::CallCycle call;                                  // its arguments aside
  std::map<std::string, ir::CycleArgument> parameters; // by their names, their values aside: all that it has
  std::map<std::string, ir::ResultName> results;       // by their names: all that it has
  std::string below; // the parameter that counts down from where the probe is, of the macro a coordinate z
};

// What calls of cycles become that are not written in the place of their calls.
struct CallForms {
  // So deep calls of cycles that move the probe are calls of programs (ir::kProgram); what moves nothing is
  // in the place of its call whatever that is.
  std::uint32_t programLevels = 0;
  std::map<const File*, MacroCycle> macros; // cycles by name, which a back end writes as calls of its macros
};

struct Lowered {
  ir::Cycle cycle;
  std::map<ir::VariableId, char> letters; // that the source wishes for arguments
  std::vector<CalledProgram> programs;    // that ir::kProgram calls; one with an empty name is called by none
  std::vector<CallInPlace> inPlace;
  std::size_t macroCalls = 0; // calls of CallForms::macros, before any is dropped
};

// The cycle with the cycles that it calls written in the place of their calls. Only of a linked tree without
// error nodes in which check() found no error. Lengths are mm, angles degrees, feeds mm/min; a flag is 0 or
// 1, a choice the place of its name in the list, from 1. A parameter whose default is a constant has it as
// Variable::defaultValue; one whose default is computed is optional, and the checks compute it. What the
// language has beside moves and touches are cycles by the names of ir/CycleNames.h. What the IR has no form
// for is reported at its place; nullopt then.
std::optional<Lowered> lower(const File& file, const SourceMap& sources, Diagnostics& diagnostics,
                             const CallForms& forms = {});

} // namespace dotek::frontend::cycle
