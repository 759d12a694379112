// Writes a cycle as a Fanuc macro program that is called with G65.
#pragma once

#include "backends/common/EmittedLine.h"
#include "ir/Cycle.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"
#include "support/Diagnostics.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dotek::backends::fanuc {

enum class Defaults : std::uint8_t { Alarm, Use };
enum class ProbePowerMode : std::uint8_t { Source, Macro };

// A value that a field may have, and what the dialog says of it (UTF-8).
struct Choice {
  double value = 0;
  std::string title;
};

// Blocks that a post prints for one operation, instead of a program.
struct BranchOptions {
  // What stands for each parameter and host input that the cycle uses: the post puts a number there.
  std::map<ir::VariableId, std::string> holes;
  std::vector<std::uint32_t>
      variables;                 // common variables for own values, in the order in which they are taken
  std::uint32_t firstNumber = 1; // N number of the first target of a jump, and step to the next
  bool modes = true;             // the blocks begin with the modes that they count on
};

// The argument of a parameter or host input in a call of the program.
struct Argument {
  ir::VariableId variable = 0;
  char letter = 0;
  std::uint32_t local = 0; // #n
};

// A program of the same file that ir::kProgram calls.
struct CalledProgram {
  std::uint32_t number = 0;
  const ir::Cycle* cycle = nullptr;
  std::vector<Argument> arguments;
  bool switchesOn = false, switchesOff = false; // the probe, by itself or by those that it calls
};

struct EmitOptions {
  const stdlib::Control& control;
  const stdlib::MacroSet& macros;
  const stdlib::Control& sourceControl; // opaque blocks are copied to the same control only
  std::uint32_t programNumber = 0;
  Defaults defaults = Defaults::Alarm;
  ProbePowerMode probePower = ProbePowerMode::Source;
  std::map<std::string, char> letters; // --arg, by name of the parameter or host input
  std::map<std::string, double> fixed; // what --set, --host or the job fixed: named in the header
  // Accents of messages are dropped (--assume plain-messages); else they are refused.
  bool plainMessages = false;
  // Axes beside X, Y and Z are copied to another control (--assume same-axes); else they are refused.
  bool sameAxes = false;
  // The source calls another set: calls are written in the order of the signature, not of the source's block.
  bool foreignMacros = false;
  const stdlib::MacroSet* source = nullptr;            // that the source calls; nullptr: none is known
  std::map<ir::VariableId, std::string> computed = {}; // fields that are no arguments, with their formulas
  std::map<ir::VariableId, std::vector<Choice>> choices = {}; // of a field that the dialog offers as a list
  const ir::Cycle* unshared = nullptr; // the cycle before its locals took over arguments: says what those do
  std::vector<std::string> remarks = {};              // further lines of the header, capitals and digits
  std::optional<BranchOptions> branch = std::nullopt; // of emitBranch() alone
  std::vector<CalledProgram> programs = {};           // by the number that ir::kProgram names
  // It is one of them: the program of this number has asked for what its caller has to provide.
  std::optional<std::uint32_t> calledFrom = std::nullopt;
  std::uint32_t alarmsBefore = 0; // of the programs before it in the file
  bool ends = true;               // the file ends with it
};

// Letters for the parameters and host inputs that `cycle` still uses (docs/convert.md, "Letters"), parameters
// in the order of declaration, then hosts. The start point is no argument where the control says it. Reports
// letters that are not allowed or given twice, and more names than letters (with the list); nullopt then.
std::optional<std::vector<Argument>> assignLetters(const ir::Cycle& cycle, const EmitOptions& options,
                                                   Diagnostics& diagnostics);

// The program, `%` lines included. nullopt where the control or the macro set cannot say something: reported.
// `assigned`, unless it is nullptr, gets the letters of the program; `alarms` how many it has.
std::optional<std::vector<EmittedLine>> emit(const ir::Cycle& cycle, const EmitOptions& options,
                                             const SourceMap& sources, Diagnostics& diagnostics,
                                             std::vector<Argument>* assigned = nullptr,
                                             std::uint32_t* alarms = nullptr);

// The blocks of `options.branch`. The checks of the cycle are the dialog's business, and the body may rely on
// them. nullopt where the control or the macro set cannot say something, or where a jump would lead back: a
// program holds the blocks once for each point, and the control would take the numbers of a later one.
// Reported.
struct BranchBlocks {
  struct Line {
    EmittedLine out;
    bool numbered = false; // it has an N number of its own
    bool comment = false;
  };
  std::vector<Line> lines;
  std::vector<std::uint32_t> variables; // of `branch.variables` that hold something
};
std::optional<BranchBlocks> emitBranch(const ir::Cycle& cycle, const EmitOptions& options,
                                       const SourceMap& sources, Diagnostics& diagnostics);

} // namespace dotek::backends::fanuc
