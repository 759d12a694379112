// What of a program another control understands otherwise, and its translation where the profiles are
// certain. Private to Program*.cpp.
#pragma once

#include "backends/fanuc/Program.h"
#include "backends/fanuc/SavedModes.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>

namespace dotek::backends::fanuc {

// What the steps share.
struct ProgramContext {
  const ProgramOptions& options;
  const SourceMap& sources;
  Diagnostics& diagnostics;

  const stdlib::Control& to() const { return options.control; }
  const stdlib::Control& from() const { return options.source; }
  // The same machine: nothing is read otherwise.
  bool same() const { return to().name == from().name && to().origin == from().origin; }
};

// Whether a variable of any number means the same on both controls. Kept, as each answer compares two
// profiles.
class AnyVariable {
public:
  explicit AnyVariable(const ProgramContext& context) : context_(context) {}
  bool same();  // sameVariables
  bool holds(); // holdsVariablesOf the source

private:
  const ProgramContext& context_;
  std::optional<bool> same_, holds_;
};

// Numbers of variables become those of the target. Reports what it has not.
void translateVariables(ir::Program& program, AnyVariable& any, const ProgramContext& context);

// Modes of a file under which the numbers or addresses of a block mean something else: one program may run
// under those of another.
struct FileModes {
  FileModes(const ir::ProgramFile& file, const stdlib::Control& from);

  ModeVariables variables;
  bool inch = false, eachBlock = false, computed = false, perRevolution = false, canned = false;
};

// G and M codes, and numbers without a point where both controls count them differently. `modes`: of the file
// as it was read.
void translateWords(ir::Program& program, const FileModes& modes, const ProgramContext& context);

// How deep calls within a file go.
class CallLevels {
public:
  explicit CallLevels(const ir::ProgramFile& file);
  // Levels of G65 and G66 that calls from here come to, the program counted as called by none.
  std::uint32_t from(const ir::Program& program);

private:
  std::map<std::uint64_t, const ir::Program*> byNumber_;
  std::set<const ir::Program*> open_;
  std::map<const ir::Program*, std::uint32_t> depth_;
};

// Functions, digits of numbers, numbers of alarms, nesting of calls: what the target's profile bounds.
void checkProgram(const ir::Program& program, CallLevels& levels, const ProgramContext& context);

} // namespace dotek::backends::fanuc
