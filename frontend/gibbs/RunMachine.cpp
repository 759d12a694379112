#include "frontend/gibbs/RunMachine.h"
#include "support/messages/Gibbs.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

State Machine::start(const Macro& macro) {
  State state;
  for (const auto& [name, value] : context_.fields)
    state.globals[name] = value;
  Frame frame;
  frame.program = &programOf(macro);
  state.frames.push_back(std::move(frame));
  return state;
}

const Program& Machine::programOf(const Macro& macro) {
  auto& program = programs_[&macro];
  if (!program) program = std::make_unique<const Program>(compileProgram(macro, context_));
  return *program;
}

void Machine::reportOnce(Diagnostic diagnostic) {
  const SourceRange range = diagnostic.range;
  for (const Diagnostic& other : context_.diagnostics.all()) {
    const bool overlaps =
        other.range.file == range.file && other.range.begin <= range.end && range.begin <= other.range.end;
    if (diagnostic.severity == Severity::Error && other.severity == Severity::Error && range.hasPlace() &&
        overlaps)
      return;
  }
  context_.diagnostics.add(std::move(diagnostic));
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
    Flow flow = execute(state, instruction);
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
    case Flow::Stopped: return PathEnd::Stopped;
    case Flow::DialogAgain: return PathEnd::DialogAgain;
    case Flow::NeedsUser: return PathEnd::NeedsUser;
    case Flow::Failed: return PathEnd::Failed;
    }
  }
}

Machine::Flow Machine::execute(State& state, const Instruction& instruction) {
  fault_.reset();
  question_.reset();
  return std::visit([&](const auto& s) { return step(state, s, instruction.range); }, instruction.step);
}

Machine::Flow Machine::handleFault(State& state) {
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

// ---- jumps ----------------------------------------------------------------------------------------------

Machine::Flow Machine::jump(State& state, std::size_t target, SourceRange range) {
  Frame& frame = state.frames.back();
  const Program& program = *frame.program;
  std::vector<std::size_t> around; // loops around the target, innermost first
  if (target < program.instructions.size()) {
    for (std::size_t loop = program.instructions[target].loop; loop != kNowhere;
         loop = program.loops[loop].parent) {
      around.push_back(loop);
    }
  }
  std::reverse(around.begin(), around.end());
  std::size_t running = 0; // loops around the target that run
  while (running < std::min(around.size(), frame.loops.size()) &&
         frame.loops[running].index == around[running]) {
    ++running;
  }
  if (running < around.size() && !assumes("goto-into-for", range)) return Flow::Failed;
  frame.loops.resize(running);
  for (std::size_t i = running; i < around.size(); ++i) {
    if (!enterLoop(state, around[i])) return Flow::Failed;
  }
  frame.at = target;
  return Flow::Jumped;
}

Machine::Flow Machine::jumpToLabel(State& state, const Name& label, SourceRange range) {
  const auto& labels = state.frames.back().program->labels;
  const auto found = labels.find(foldCase(label.text));
  if (found == labels.end()) {
    fault<diag::CannotRun>(label.range, false, "no label of this name stands in the macro");
    return Flow::Failed;
  }
  if (found->second == kNowhere) {
    fault<diag::CannotRun>(label.range, false,
                           "the label stands twice, and where the jump leads is not known");
    return Flow::Failed;
  }
  state.jumped = range;
  return jump(state, found->second, range);
}

Machine::Flow Machine::step(State& state, const JumpStep& s, SourceRange range) {
  return jump(state, s.target, range);
}

Machine::Flow Machine::step(State& state, const GotoStep& s, SourceRange range) {
  return jumpToLabel(state, *s.label, range);
}

Machine::Flow Machine::step(State& state, const BranchStep& s, SourceRange) {
  const auto truth = decide(state, *s.condition);
  if (!truth) return Flow::Failed;
  if (*truth) return Flow::Next;
  state.frames.back().at = s.otherwise;
  return Flow::Jumped;
}

// ---- loops ----------------------------------------------------------------------------------------------

Machine::Flow Machine::step(State& state, const ForStep& s, SourceRange range) {
  const Loop& loop = state.frames.back().program->loops[s.index];
  if (loop.next == kNowhere) {
    fault<diag::CannotRun>(range, false, "the FOR has no NEXT");
    return Flow::Failed;
  }
  const auto from = evaluateNumber(state, *s.loop->from);
  if (!from || !enterLoop(state, s.index)) return Flow::Failed;
  return write(state, {s.loop->variable, nullptr, 0}, *from) ? Flow::Next : Flow::Failed;
}

bool Machine::enterLoop(State& state, std::size_t index) {
  Frame& frame = state.frames.back();
  const For& loop = *frame.program->loops[index].statement;
  const auto end = evaluateNumber(state, *loop.to);
  if (!end) return false;
  double size = 1;
  if (loop.step) {
    const auto given = evaluateNumber(state, *loop.step);
    if (!given) return false;
    const double* number = std::get_if<double>(&*given);
    if (number == nullptr) {
      fault<diag::UnknownValue>(loop.step->range, false, unknownText(*unknownIn(*given)));
      return false;
    }
    size = *number;
    if (size < 0 && !assumes("negative-step", loop.step->range)) return false;
  }
  frame.loops.push_back({index, *end, size});
  return true;
}

std::optional<bool> Machine::loopGoesOn(State& state, const Value& value, const Value& end, double step,
                                        SourceRange range) {
  return compare(state, value, step < 0 ? Relation::GreaterEqual : Relation::LessEqual, end, range);
}

Machine::Flow Machine::step(State& state, const NextStep& s, SourceRange range) {
  Frame& frame = state.frames.back();
  const Loop& loop = frame.program->loops[s.index];
  if (frame.loops.empty() || frame.loops.back().index != s.index) {
    fault<diag::CannotRun>(range, false, "the NEXT is reached without its FOR");
    return Flow::Failed;
  }
  const LoopRun run = frame.loops.back();
  const VariableRef variable{loop.statement->variable, nullptr, 0};
  const auto before = read(state, variable);
  if (!before) return Flow::Failed;
  const auto stepped = [&](double size) -> std::optional<Value> {
    if (const double* number = std::get_if<double>(&*before)) return computed(ir::add(*number, size), range);
    return linear(*before, 1, size, 1);
  };
  const auto after = stepped(run.step);
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
    const double* number = std::get_if<double>(&*size);
    if (*goesOnNow != *goesOn || number == nullptr || *number != run.step) {
      assumes("for-end-at-entry", number == nullptr || *number != run.step ? loop.statement->step->range
                                                                           : loop.statement->to->range);
      return Flow::Failed;
    }
  }
  if (!write(state, variable, *after)) return Flow::Failed;
  if (*goesOn) {
    frame.at = loop.body;
    return Flow::Jumped;
  }
  frame.loops.pop_back();
  return Flow::Next;
}

// ---- calls and declarations -----------------------------------------------------------------------------

Machine::Flow Machine::step(State& state, const CallStep& s, SourceRange range) {
  if (!s.call->macro && !assumes("bare-file", s.call->macroRange)) return Flow::Failed;
  std::string name = s.call->bareName;
  if (s.call->macro) {
    const auto text = evaluateText(state, *s.call->macro);
    if (!text) return Flow::Failed;
    if (const Unknown* unknown = unknownIn(*text)) {
      fault<diag::UnknownValue>(s.call->macroRange, false, unknownText(*unknown));
      return Flow::Failed;
    }
    name = std::get<std::string>(*text);
  }
  std::vector<Value> arguments;
  for (const ExpressionPtr& argument : s.call->arguments) {
    const auto value = evaluate(state, *argument);
    if (!value) return Flow::Failed;
    arguments.push_back(*value);
  }
  if (state.frames.size() > context_.limits.callDepth) {
    fault<diag::CallTooDeep>(range, false, context_.limits.callDepth);
    return Flow::Failed;
  }
  const Macro* macro = context_.load ? context_.load(name, s.call->macroRange) : nullptr;
  if (macro == nullptr) {
    fault<diag::CannotRun>(s.call->macroRange, false, "the macro that CALL names is not there");
    return Flow::Failed;
  }
  Frame frame;
  frame.program = &programOf(*macro);
  frame.arguments = std::move(arguments);
  frame.called = range;
  state.frames.push_back(std::move(frame));
  return Flow::Jumped;
}

Machine::Flow Machine::step(State& state, const ArgsStep& s, SourceRange range) {
  Frame& frame = state.frames.back();
  const std::size_t given = frame.arguments ? frame.arguments->size() : 0;
  if (!frame.arguments || given != s.args->names.size()) {
    fault<diag::ArgsMismatch>(frame.called.hasPlace() ? frame.called : range, false, given,
                              s.args->names.size());
    return Flow::Failed;
  }
  const std::vector<Value> values = std::move(*frame.arguments);
  frame.arguments.reset();
  for (std::size_t i = 0; i < values.size(); ++i) {
    frame.locals[foldCase(s.args->names[i].name.text)].reset();
    if (!write(state, {s.args->names[i].name, nullptr, 0}, values[i])) return Flow::Failed;
  }
  return Flow::Next;
}

Machine::Flow Machine::step(State& state, const DeclareStep& s, SourceRange) {
  Frame& frame = state.frames.back();
  for (const VariableRef& ref : s.declaration->names) {
    const std::string key = foldCase(ref.name.text);
    if (ref.index) {
      if (!assumes(ref.bracket == '[' ? "array-square" : "array-round", ref.name.range)) return Flow::Failed;
      const auto size = evaluateNumber(state, *ref.index);
      if (!size) return Flow::Failed;
      const double* number = std::get_if<double>(&*size);
      if (number == nullptr || *number < 1 || *number > context_.limits.steps) {
        fault<diag::CannotRun>(ref.index->range, false, "the array has no such number of elements");
        return Flow::Failed;
      }
      // Elements are shared with called macros, whatever the declaration says.
      if (s.declaration->scope == Scope::Local && state.frames.size() > 1 && state.arrays.contains(key)) {
        fault<diag::CannotRun>(ref.name.range, false,
                               "the array of this name is declared in the calling macro as well");
        return Flow::Failed;
      }
      state.arrays[key] = static_cast<std::size_t>(*number);
    } else if (s.declaration->scope == Scope::Local) {
      frame.locals.try_emplace(key);
    } else {
      frame.locals.erase(key);
    }
  }
  return Flow::Next;
}

Machine::Flow Machine::step(State& state, const OnErrorStep& s, SourceRange) {
  state.frames.back().onError = s.label;
  return Flow::Next;
}

Machine::Flow Machine::step(State& state, const CommandStep& s, SourceRange range) {
  return command(state, *s.command, range);
}

Machine::Flow Machine::step(State&, const UnverifiedStep& s, SourceRange range) {
  return assumes(s.assumption, range) ? Flow::Next : Flow::Failed;
}

Machine::Flow Machine::step(State&, const RefuseStep& s, SourceRange range) {
  fault<diag::CannotRun>(range, false, s.why);
  return Flow::Failed;
}

Machine::Flow Machine::step(State& state, const AssignStep& s, SourceRange) {
  const auto value = evaluate(state, *s.assignment->value);
  if (!value) return Flow::Failed;
  return write(state, s.assignment->target, *value) ? Flow::Next : Flow::Failed;
}

} // namespace dotek::frontend::gibbs
