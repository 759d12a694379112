// What the branches of a Prog do for one cycle: which routine posts it, which fields it prints.
#pragma once

#include "frontend/compost/Ast.h"
#include "stdlib/ComPostKeywords.h"

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::frontend::compost {

// A branch that runs for one cycle. With `IF NOT CycleType?('x')` that is the ELSE part.
struct BranchRef {
  const If* branch = nullptr;
  const Routine* routine = nullptr;
  bool elsePart = false;

  const std::vector<Statement>& body() const { return elsePart ? branch->elseBody : branch->thenBody; }
};

// The argument of an `OpFieldData#`; `range` is the text with its apostrophes.
struct FieldRef {
  std::string name;
  SourceRange range;
};

// The routine of that name, exactly as spelt; the first of several; nullptr for none.
const Routine* findRoutine(const Program& program, std::string_view name);

// The cycle that the operand tests, NOTs before it aside; nullptr for another operand.
const std::string* cycleTested(const ConditionTerm& term);

// The cycles for which the condition can hold; nothing where it does not depend on the cycle alone that way.
std::optional<std::set<std::string>> cyclesOf(const Condition& condition);

// All arguments of `CycleType?`, in the order in which they first occur.
std::vector<std::string> cycleIds(const Program& program);

// Every IF whose condition tests CycleType?('<cycleId>'), in source order.
std::vector<BranchRef> branchesOf(const Program& program, std::string_view cycleId);

// Whether the statements, or a routine that they call, print something: a text, a number, EOL, or a command
// that is not known to be silent. Setting flags prints nothing.
bool prints(const std::vector<Statement>& statements, const Program& program,
            const stdlib::ComPostKeywords& keywords);

// The routines with a branch for the cycle that prints, in source order; where none prints, those that test
// the cycle and print elsewhere.
std::vector<const Routine*> printingRoutines(const Program& program, const stdlib::ComPostKeywords& keywords,
                                             std::string_view cycleId);

// The routines with a branch for some cycle that prints or calls something, in one pass over the Prog: the
// post engine runs them for an operation, so that nothing in the Prog need call them.
std::vector<const Routine*> cycleRoutines(const Program& program, const stdlib::ComPostKeywords& keywords);

// The fields that the branch prints for the cycle, those of called routines included, in the order of
// reaching them; inner branches on other cycles are left out. A field occurs as often as it is printed.
std::vector<FieldRef> fieldsPrinted(const Program& program, const BranchRef& branch,
                                    std::string_view cycleId);

// The same for all that a routine prints while the cycle is posted.
std::vector<FieldRef> fieldsPrinted(const Program& program, const Routine& routine, std::string_view cycleId);

} // namespace dotek::frontend::compost
