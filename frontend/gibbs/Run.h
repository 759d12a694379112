// Runs the macros of a custom drill cycle on values: the checks of CycleData.mac and the path of
// ToolPath.mac. What the reference grades U is refused unless an assumption names the reading.
#pragma once

#include "frontend/gibbs/Ast.h"
#include "frontend/gibbs/Program.h"
#include "stdlib/GibbsKeywords.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::frontend::gibbs {

struct RunContext {
  const SourceMap& sources;
  const stdlib::GibbsKeywords& keywords;
  const Limits& limits;
  Diagnostics& diagnostics;
  // Values of the cycle's fields, mm and degrees, by folded name (foldCase).
  std::map<std::string, double> fields;
  // Host inputs that are known: tool_radius, retract, start_x, ... (docs/cli.md).
  std::map<std::string, double> hosts;
  // Readings of unverified constructs that the user has named (`--assume`); docs/gibbs.md lists them.
  std::set<std::string> assumptions;
  // The parsed macro that CALL or #INCLUDE names, nullptr if there is none; diagnostics are the loader's.
  std::function<const Macro*(const std::string& name, SourceRange where)> load;
  // The parsed dialog that DIALOG names, nullptr if there is none.
  std::function<const Dialog*(const std::string& name, SourceRange where)> loadDialog;
  // Compiled macros that further runs with these limits use again; nullptr: none are kept.
  Programs* programs = nullptr;
};

// A MESSAGE or STOP that was shown, or a return code that was set, before the values were rejected.
struct Rejection {
  SourceRange range; // of the statement
  std::string text;  // of the message, UTF-8; "" where none was shown
};

struct ChecksResult {
  enum class Verdict : std::uint8_t {
    Passes,   // the dialog would be left with OK
    Rejected, // it is shown again, a STOP is met, or callback_returncode is not 0 at the end
    Depends,  // on host inputs that are not known
    NotRun,   // could not be run: reported
  };
  Verdict verdict = Verdict::Passes;
  std::vector<Rejection> rejections;    // of the paths that reject, in source order
  std::vector<std::string> neededHosts; // for Depends: what to give
  // Fields whose value the macro changes after the dialog, by folded name (only where all paths agree).
  std::map<std::string, double> changed;
  std::vector<SourceRange> changedAt;
  // Messages shown on a passing path: the user sees them, and goes on.
  std::vector<Rejection> shown;
};

// Runs CycleData.mac as if the user had typed the fields into its dialog and pressed OK. A condition that
// depends on an unknown host input is followed both paths (limits.paths).
ChecksResult runChecks(const Macro& cycleData, RunContext& context);

// One ADD_CUSTOM_DRILL_CYCLE_PATH: where the tool is after it. X and Y count from the point of the
// operation, Z from the retract plane (mm). The point is what the CAM draws: the ball's centre in X and Y,
// its lowest point in Z.
struct PathMove {
  enum class Kind : std::uint8_t { Feed, FeedX, FeedY, FeedZ };
  Kind kind = Kind::Feed;
  double x = 0, y = 0,
         z = 0; // written words: all three for Feed, one otherwise; the others are carried along
  SourceRange range;
};

// nullopt where the path could not be computed: reported (an unknown host input names its flag).
std::optional<std::vector<PathMove>> runToolPath(const Macro& toolPath, RunContext& context);

// `feed(0,0,45)`, `z -10`: one move a line, as `dump --stage path` prints it.
std::string pathText(const std::vector<PathMove>& path);

} // namespace dotek::frontend::gibbs
