// Which work system a number names that a call is given, tried on the checks of a cycle.
#pragma once

#include "ir/Cycle.h"
#include "ir/Evaluate.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::backends {

// Numbers that name systems beyond the first six; first 0: none do.
struct ExtendedSystems {
  double first = 0, last = 0, step = 1;
};

// 54 to 59, or one of `extended`.
bool namesSystem(double number, const ExtendedSystems& extended);

// With what the checks assign once, by the values of the environment.
ir::Environment withLocals(const ir::Cycle& cycle, ir::Environment environment);

// Other values of the arguments: the defaults, and some that differ.
std::vector<ir::Environment> environmentsOf(const ir::Cycle& cycle);

// The variables that a caller gives, from which the checks compute `value`.
std::set<ir::VariableId> givenFor(const ir::Cycle& cycle, const ir::ExpressionPtr& value);

struct NoSystem {
  double given = 0; // the variable's value
  double number = 0;
};

// The first value of `id` that the checks let pass, where they let only such pass as `system` makes no work
// system of: then whoever calls the program gets an alarm. Values that end like the largest or the smallest
// are those that the checks of `id` reject, whatever the other arguments are.
std::optional<NoSystem> passesNoSystem(const ir::Cycle& cycle, ir::VariableId id,
                                       const ir::ExpressionPtr& system, const ExtendedSystems& extended);

// Whether the checks of the one argument that `value` counts from let some value pass and, of many that are
// tried, `beside` among them, only those with which `accepts` holds for `value`.
bool passOnly(const ir::Cycle& cycle, const ir::ExpressionPtr& value, const std::vector<double>& beside,
              const std::function<bool(double)>& accepts);

// Whether `system` names systems beyond the first six alone, by the checks.
bool isBeyond(const ir::Cycle& cycle, const ir::ExpressionPtr& system, const ExtendedSystems& extended);

// Which of the systems beyond the first six it is, from 0: `from` is its number less extended.first.
ir::ExpressionPtr beyondIndex(const ir::ExpressionPtr& from, const ExtendedSystems& extended);

// The numbers with which the calls of the source name systems beyond G59, counted as 54 is G54, as far as the
// control has variables for them and, where the macros of the target set them, those take such numbers, too.
// `target`: nullptr where the program writes the offset itself. first 0: none.
ExtendedSystems extendedNumbers(const stdlib::MacroArgument* source, const stdlib::MacroArgument* target,
                                const stdlib::Control& control);

// What a message says of a number that the target's macros do not take, and what to do about it: `otherwise`
// where it is none of those that the calls of the source name either.
struct SystemWords {
  std::string number, remedy;
};
SystemWords systemWords(double number, const stdlib::MacroSet* source, const stdlib::Control& control,
                        std::string otherwise);

// The letter of a call that takes such numbers; nullptr: none.
const stdlib::MacroArgument* extendedArgument(const stdlib::MacroSignature& signature);
const stdlib::MacroArgument* extendedArgument(const stdlib::MacroSet* set);

} // namespace dotek::backends
