// Runs what emit() wrote, on a double of the post kernel, as a script in a process of its own.
#pragma once

#include "script/Script.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::backends::fusion {

// One operation. Lengths are mm.
struct RunInput {
  bool inch = false; // the document's unit
  std::map<std::string, double>
      properties; // by name, "surfaceX_G"; others keep the value of their definition
  std::vector<std::array<double, 3>> points = {{0, 0, 0}};
  double toolDiameter = 6;
  double toolNumber = 1;
  double toolLengthOffset = 1;
  std::map<std::string, double> cycle; // "clearance", "retract"
  bool chosen = true;                  // the operation names this cycle; else none
  bool probing = false;                // the operation's strategy is one of probing
  // What arrives as a text instead of a number: a property, a member of the cycle, "x", "y", "z" of the
  // points, "diameter", "number" or "lengthOffset" of the tool. "": nothing does.
  std::string noNumber = {};
  std::string entry = "dispatch"; // the function of a fragment that is called for each point
};

struct RunResult {
  std::string text;                  // NC, line ends LF
  std::vector<std::string> errors;   // of error(..), in order
  std::vector<std::string> warnings; // of warning(..)
  bool wroteAfterError = false;      // a defect: something was written after an error
  bool taken = false;                // of a fragment: its dispatch says that the operation is its own
  std::map<std::string, std::string> defined; // of a fragment: `value` of each property that has one
  std::map<std::string, std::string> scopes;  // of each of them, "operation"
  std::map<std::string, std::string> titles;  // of a fragment: `title` of each property, UTF-8
  // Of a fragment: `group` of each property that has none, but for the case of its letters.
  std::map<std::string, std::string> lostGroups;
  // Of a fragment: what the list of each such property offers, `id` and `title`.
  std::map<std::string, std::vector<std::pair<std::string, std::string>>> offered;
  std::vector<std::string> kept;      // of a fragment: outputs of the post that were not reset
  std::optional<script::Fault> fault; // an exception, a limit: nothing else is known then
  bool ok() const { return !fault && errors.empty(); }
};

// Lines of a fragment are named by this in the places of faults.
inline constexpr std::string_view kFragment = "fragment";

// A fragment within the post of postAround(), or a whole post, that runs many times: its text is read once,
// and each run finds it as it was then. For one thread.
class Fragment {
public:
  // `runner` outlives the fragment, and runs this one alone after load().
  explicit Fragment(script::Runner& runner) : runner_(runner) {}
  // The text, whose names begin with `prefix`. `numbered`: the post's writeBlock puts `N1 ` before each
  // block. A fault where it cannot be read.
  // `helpers`: of sharedHelpers(), read before it.
  std::optional<script::Fault> load(std::string_view fragment, std::string_view prefix, bool numbered = false,
                                    std::string_view helpers = "");
  std::optional<script::Fault> loadPost(std::string_view post, std::string_view prefix);
  // PREFIX_dispatch(x, y, z) for each point, of a post its entry functions in their order; the prefix chooses
  // the cycle.
  RunResult run(const RunInput& input) const;

private:
  script::Runner& runner_;
  std::string prefix_;
  bool whole_ = false;
};

// Everything of a run as one script for another engine: prints the NC text with console.log.
std::string scriptFor(std::string_view fragment, std::string_view prefix, const RunInput& input);
// Evaluates `code` after the kernel's double and gives its value as text; of one that throws "throws: ...".
// For tests of the double.
std::string evaluate(script::Runner& runner, std::string_view code);

} // namespace dotek::backends::fusion
