// Lowers the blocks that a Prog prints for one cycle to IR. Unlike Post.h it runs nothing: fields stay
// variables.
#pragma once

#include "frontend/compost/Ast.h"
#include "ir/Cycle.h"
#include "ir/PrintedText.h"
#include "stdlib/Control.h"
#include "stdlib/Form.h"
#include "stdlib/MacroSet.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::frontend::compost {

struct LowerSettings {
  const SourceMap& sources;
  const stdlib::Form& form;
  const Limits& limits;
  const stdlib::Control& control;              // of the source's machine
  std::vector<const stdlib::MacroSet*> macros; // all sets; the one that the blocks call is chosen
  std::set<std::string> assumptions;
  // The IR variable of a field, or of a host input, of the cycle; nullopt: reported by the callee.
  std::function<std::optional<ir::VariableId>(const std::string& field, SourceRange where)> field;
  std::function<std::optional<ir::VariableId>(const std::string& host, SourceRange where)> host;
  // Value of a variable that the command line fixes, for the checks of pictures; nullopt: it varies.
  std::function<std::optional<double>(ir::VariableId)> fixed;
};

struct Lowered {
  std::vector<ir::CycleStatement> body;
  const stdlib::MacroSet* macros = nullptr; // the set that the blocks call; nullptr: none
  std::vector<ir::PrintedBlock> printed;    // the text of the blocks
};

// What the routine prints for the cycle `cycleId`. nullopt where something has no single
// meaning: reported. A condition that is not known is refused; where its two sides leave different modal G
// codes in force the message says so.
std::optional<Lowered> lowerRoutine(const Program& program, const Routine& routine,
                                    const std::string& cycleId, ir::Cycle& cycle,
                                    const LowerSettings& settings, Diagnostics& diagnostics);

} // namespace dotek::frontend::compost
