// A macro as a flat list of instructions: blocks, loops and included lines are resolved to places, so that
// a run is a place and its variables, and can be copied.
#pragma once

#include "frontend/gibbs/Ast.h"
#include "support/Limits.h"

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dotek::frontend::gibbs {

inline constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();

struct AssignStep {
  const Assignment* assignment;
};
// Goes on after itself where the condition holds, else at `otherwise`.
struct BranchStep {
  const Condition* condition;
  std::size_t otherwise = kNowhere;
};
struct JumpStep {
  std::size_t target = kNowhere;
};
struct ForStep {
  const For* loop;
  std::size_t index = kNowhere; // in Program::loops
};
struct NextStep {
  std::size_t index = kNowhere;
};
struct GotoStep {
  const Name* label;
};
struct CallStep {
  const CallMacro* call;
};
struct ArgsStep {
  const Args* args;
};
struct DeclareStep {
  const Declaration* declaration;
};
struct OnErrorStep {
  const Name* label;
};
struct CommandStep {
  const Command* command;
};
// Reached only: needs the assumption of this name.
struct UnverifiedStep {
  std::string_view assumption;
};
// What cannot be run, with the reason as a message gives it.
struct RefuseStep {
  std::string why;
};

struct Instruction {
  SourceRange range;
  std::size_t loop = kNowhere; // innermost FOR around it
  std::variant<AssignStep, BranchStep, JumpStep, ForStep, NextStep, GotoStep, CallStep, ArgsStep, DeclareStep,
               OnErrorStep, CommandStep, UnverifiedStep, RefuseStep>
      step;
};

struct Loop {
  const For* statement;
  std::size_t parent = kNowhere;
  std::size_t body = kNowhere; // after the FOR
  std::size_t next = kNowhere; // its NEXT; nowhere: never closed
};

struct Program {
  std::vector<Instruction> instructions;
  std::vector<Loop> loops;
  // Folded name to place; nowhere: the label appears twice.
  std::map<std::string, std::size_t> labels;
  bool includes = false; // lines of other files
};

// Never fails: what cannot be run becomes an instruction that says so when it is reached.
using MacroLoader = std::function<const Macro*(const std::string& name, SourceRange where)>;
// By their macros, which outlive them.
using Programs = std::map<const Macro*, std::unique_ptr<const Program>>;
Program compileProgram(const Macro& macro, const Limits& limits, const MacroLoader& load);

} // namespace dotek::frontend::gibbs
