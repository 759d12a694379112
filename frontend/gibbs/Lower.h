// Lowers the macros of a custom drill cycle to IR: the checks of CycleData.mac as code, the path of
// ToolPath.mac as moves and the touches that its code shows.
#pragma once

#include "frontend/gibbs/Cycle.h"
#include "ir/Cycle.h"
#include "stdlib/GibbsKeywords.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace dotek::frontend::gibbs {

struct LowerContext {
  const SourceMap& sources;
  const stdlib::GibbsKeywords& keywords;
  const Limits& limits;
  Diagnostics& diagnostics;
  std::set<std::string> assumptions; // `--assume`: readings; `unchecked`
  std::vector<SourceRange> touches;  // lines of ToolPath.mac that `--assume touch=FILE:LINE` names
  std::function<const Macro*(const std::string& name, SourceRange where)> load;
  std::function<const Dialog*(const std::string& name, SourceRange where)> loadDialog;
  // The IR variable of a host input (stdlib/HostInputs.h), made when first asked for.
  std::function<ir::VariableId(const std::string& host)> host;
};

// A cycle with a parameter for each declared field: name, default, unit and meaning from the dialog, title.
// Nothing else; kinds are Number until inferKinds. The order is that of declaredFields().
ir::Cycle declareCycle(const Cycle& source, const SourceMap& sources);

// cycle.checks = the code of CycleData.mac after its first DIALOG, with what the code before it computes.
// MESSAGE (or STOP) after which every path shows the dialog again or ends with a return code other than 0 is
// an alarm; such an end without a message is an alarm without text. Reports and returns false at a shape that
// cannot be translated: a message after which some paths go on and some do not, texts that are computed,
// arrays, commands that ask the user or read what only the CAM knows.
bool lowerChecks(const Macro& cycleData, ir::Cycle& cycle, LowerContext& context);

// cycle.body = the path of ToolPath.mac as protected moves (frames Start and Retract), and a Measure without
// a setting where the code shows a touch: a feed move along one axis to E minus the tool radius where the
// path has established E > 0, or E plus the tool radius where E < 0, followed by the return to where it
// began. E >= 0 will do where a move of its own serves E < 0, and the reverse; at 0 nothing moves. The
// contact point is E. A move that could be a touch and does not show it is reported at its line, unless
// `touches` names it. Reports a note with the fields that no move uses.
bool lowerToolPath(const Macro& toolPath, ir::Cycle& cycle, LowerContext& context);

} // namespace dotek::frontend::gibbs
