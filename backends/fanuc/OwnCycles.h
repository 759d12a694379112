// Cycles by name that no macro carries out (ir/CycleNames.h).
#pragma once

#include "backends/common/ToolCorrection.h"
#include "backends/fanuc/State.h"
#include "ir/CycleNames.h"

namespace dotek::backends::fanuc {

// Writes such a cycle, or refuses it. false: it is the call of a macro.
bool writeOwnCycle(State& state, const ir::CallCycle& cycle, const ir::Origin& origin);
// Sets the offsets of a kSetOffset by the values that the program has computed.
void writeSetOffset(State& state, const ir::CallCycle& set, const ir::Origin& origin);

// ---- ToolWrite.cpp

// A part of a tool offset (kSetTool): a length or radius as a whole into its geometry, the wear becomes 0.
// Refused: a control whose profile says no such part, a move after a length.
// After the call: the tool length becomes shorter by a share of the error, in the register that the macro of
// the source corrects; an offset that the table has not is an alarm.
void writeToolCorrection(State& state, const ToolCorrection& correction, const ir::Origin& origin);
void writeSetTool(State& state, const ir::CallCycle& set, const ir::Origin& origin);
// `left` gets what the table has.
void writeReadTool(State& state, const std::string& left, ir::ToolPart part, const ir::ExpressionPtr& tool,
                   const ir::Origin& origin);
// An alarm where `tool` is no offset of the table.
void writeToolAlarm(State& state, const ir::ExpressionPtr& tool, const ir::Origin& origin);

// ---- OwnTouches.cpp

// The cycle with its touches along a direction in the plane XY as the call `angled-surface` that the set has,
// and those that may find nothing with the parameter `flag-only`. Statements keep their places. What the set
// has no call for stays as it is.
ir::Cycle withTouchCalls(const ir::Cycle& given, const stdlib::MacroSet& macros);
// It was made by withTouchCalls().
bool isOwnTouchAlong(const ir::CycleStatement& statement);
// An alarm where the surface of such a touch is not expected before the ball: once at entry, where it is
// known there.
void guardDistance(State& state, const ir::CallCycle& cycle, const ir::Origin& origin);
void writeDistanceAlarm(State& state, const ir::ExpressionPtr& distance, const ir::Origin& origin);
// Right after the call: what a set does not leave of such a touch, its error along the direction (Main) or
// the height at which it was (PositionZ), mm. nullptr: the control or the set does not say enough.
ir::ExpressionPtr resultAlong(State& state, const ir::CycleStatement& measured, ir::ResultName name);

} // namespace dotek::backends::fanuc
