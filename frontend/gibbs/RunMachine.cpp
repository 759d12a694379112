#include "frontend/gibbs/RunMachine.h"
#include "support/messages/Gibbs.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

State Machine::start(const Macro& macro) {
  State state;
  Frame frame;
  frame.program = &programOf(macro);
  state.frames.push_back(std::move(frame));
  return state;
}

std::vector<Rejection> Machine::messagesSince(const State& state, std::size_t until) const {
  std::vector<Rejection> found;
  for (std::size_t at = state.message; at != kNoMessage && at != until; at = messages_[at].earlier) {
    found.push_back(messages_[at].shown);
  }
  std::reverse(found.begin(), found.end());
  return found;
}

PathEnd Machine::run(State& state) {
  for (;;) {
    while (state.frames.back().at >= state.frames.back().program->instructions.size()) {
      if (state.frames.size() == 1) return PathEnd::Ended;
      if (!leaveFrame(state)) return PathEnd::Failed;
    }
    const Frame& frame = state.frames.back();
    const Instruction& instruction = frame.program->instructions[frame.at];
    place_ = instruction.range;
    if (++steps_ > context_.limits.steps) {
      reportOnce(makeDiagnostic<diag::RunsForever>(instruction.range, context_.limits.steps));
      return PathEnd::Failed;
    }
    const std::size_t fresh = state.fresh;
    question_.reset();
    Flow flow = step(state, instruction);
    if (flow == Flow::Failed) {
      // A question is asked again after the answer, with the same names for what is unknown.
      if (question_ && !fault_) {
        state.fresh = fresh;
        return PathEnd::Asks;
      }
      flow = handleFault(state);
    }
    switch (flow) {
    case Flow::Next: ++state.frames.back().at; break;
    case Flow::Jumped: break;
    case Flow::Ended: return PathEnd::Ended;
    case Flow::Stopped: return PathEnd::Stopped;
    case Flow::DialogAgain: return PathEnd::DialogAgain;
    case Flow::NeedsUser: return PathEnd::NeedsUser;
    case Flow::Failed: return PathEnd::Failed;
    }
  }
}

Interpreter::Flow Machine::handleFault(State& state) {
  const Fault fault = std::move(*fault_);
  fault_.reset();
  if (fault.catchable && state.frames.back().onError != nullptr) {
    const Flow flow = jumpToLabel(state, *state.frames.back().onError, state.frames.back().onError->range);
    if (flow != Flow::Failed) return flow;
    reportOnce(fault_->diagnostic);
    return Flow::Failed;
  }
  reportOnce(fault.diagnostic);
  return Flow::Failed;
}

bool Machine::leaveFrame(State& state) {
  const Frame& frame = state.frames.back();
  if (frame.arguments && !frame.arguments->empty()) {
    reportOnce(makeDiagnostic<diag::ArgsMismatch>(frame.called, frame.arguments->size(), 0));
    return false;
  }
  state.frames.pop_back();
  ++state.frames.back().at;
  return true;
}

void Machine::refuse(SourceRange range, std::string_view why) {
  fault<diag::CannotRun>(range, false, why);
}

// ---- jumps and loops ------------------------------------------------------------------------------------

// Conditions of a run are decided.
Interpreter::Flow Machine::fork(State&, const ir::ConditionPtr&, std::size_t, SourceRange range) {
  refuse(range, "the condition is broken");
  return Flow::Failed;
}

bool Machine::openLoop(State& state, std::size_t index, const Value& end, double step) {
  state.frames.back().loops.push_back({index, end, step});
  return true;
}

std::optional<bool> Machine::loopGoesOn(State& state, const Value& value, const Value& end, double step,
                                        SourceRange range) {
  return compare(state, value, step < 0 ? Relation::GreaterEqual : Relation::LessEqual, end, range);
}

Interpreter::Flow Machine::advance(State& state, const Loop& loop, const VariableRef& variable,
                                   const Value& before, SourceRange range) {
  Frame& frame = state.frames.back();
  const LoopRun run = frame.loops.back();
  const Combined sum = gibbs::combine(ir::BinaryOp::Add, before, run.step);
  std::optional<Value> after = sum.value;
  if (!after && sum.error == ir::ArithmeticError::None)
    after = opaque(state, "", {before}, loop.statement->variable.text, false, range);
  if (!after) after = computed({0, sum.error}, range);
  if (!after) return Flow::Failed;
  const auto goesOn = loopGoesOn(state, *after, run.end, run.step, range);
  if (!goesOn) return Flow::Failed;
  // Whether end and step are taken at FOR or at each NEXT is not known: both readings have to agree.
  if (!context_.assumptions.contains("for-end-at-entry")) {
    const auto end = evaluateNumber(state, *loop.statement->to);
    if (!end) return Flow::Failed;
    const auto size = loop.statement->step ? evaluateNumber(state, *loop.statement->step) : Value(1.0);
    if (!size) return Flow::Failed;
    const auto goesOnNow = loopGoesOn(state, *after, *end, run.step, range);
    if (!goesOnNow) return Flow::Failed;
    const double* number = numberIn(*size);
    const bool stepMoves = number == nullptr || *number != run.step;
    if (*goesOnNow != *goesOn || stepMoves) {
      assumes("for-end-at-entry", stepMoves ? loop.statement->step->range : loop.statement->to->range);
      return Flow::Failed;
    }
  }
  if (!write(state, variable, *after, range)) return Flow::Failed;
  if (*goesOn) {
    frame.at = loop.body;
    return Flow::Jumped;
  }
  frame.loops.pop_back();
  return Flow::Next;
}

// ---- calls and declarations -----------------------------------------------------------------------------

Interpreter::Flow Machine::enter(State& state, Frame frame, const CallMacro&, const Macro&,
                                 std::vector<Value> arguments) {
  frame.arguments = std::move(arguments);
  state.frames.push_back(std::move(frame));
  return Flow::Jumped;
}

Interpreter::Flow Machine::takeArguments(State& state, const Args& args, SourceRange range) {
  Frame& frame = state.frames.back();
  const std::size_t given = frame.arguments ? frame.arguments->size() : 0;
  if (!frame.arguments || given != args.names.size()) {
    fault<diag::ArgsMismatch>(frame.called.hasPlace() ? frame.called : range, false, given,
                              args.names.size());
    return Flow::Failed;
  }
  const std::vector<Value> values = std::move(*frame.arguments);
  frame.arguments.reset();
  for (std::size_t i = 0; i < values.size(); ++i) {
    frame.locals[foldCase(args.names[i].name.text)].reset();
    if (!write(state, {args.names[i].name, nullptr, 0}, values[i], range)) return Flow::Failed;
  }
  return Flow::Next;
}

bool Machine::declareArray(State& state, const VariableRef& ref, Scope scope) {
  const auto size = evaluateNumber(state, *ref.index);
  if (!size) return false;
  const double* number = numberIn(*size);
  if (number == nullptr || *number < 1 || *number > context_.limits.steps) {
    refuse(ref.index->range, "the array has no such number of elements");
    return false;
  }
  // Elements are shared with called macros, whatever the declaration says.
  const std::string key = foldCase(ref.name.text);
  if (scope == Scope::Local && state.frames.size() > 1 && state.arrays.contains(key)) {
    refuse(ref.name.range, "the array of this name is declared in the calling macro as well");
    return false;
  }
  state.arrays[key] = static_cast<std::size_t>(*number);
  return true;
}

} // namespace dotek::frontend::gibbs
