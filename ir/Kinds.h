// Kinds of expressions: what operators demand and give, what statements require.
#pragma once

#include "ir/Cycle.h"

#include <functional>

namespace dotek::ir {

// The result is of the operand's kind: absolute value, rounding.
bool keepsKind(UnaryOp op);
// Of operators that do not: Angle for sine, cosine and tangent; Number: any.
Kind operandKind(UnaryOp op);
// Angle for the arc functions; Number for the rest.
Kind resultKind(UnaryOp op);
// Of what a measurement leaves; Number: none, or that of what was measured (Main).
Kind resultKind(ResultName name);
// Both sides and the result are of one kind.
bool addsKinds(BinaryOp op);
// A sum with a number that makes none of G54 to G59 of the rest, as 100 + pallet in a set where 101 is G54.1
// P1: what is added to it counts.
bool isShiftedCount(const Binary& sum);

// The expressions of the statement that have to be of a kind.
void eachRequirement(const CycleStatement& statement,
                     const std::function<void(const ExpressionPtr&, Kind)>& visit);

// Number where no kind is known; of a mixture the first. `mixed` is called with each expression that is added
// to, or compared with, one of another kind.
using Mixed = std::function<void(const Expression& whole, Kind left, Kind right)>;
Kind kindOf(const ExpressionPtr& expression, const Cycle& cycle, const Mixed& mixed);

} // namespace dotek::ir
