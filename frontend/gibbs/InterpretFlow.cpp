#include "frontend/gibbs/Interpreter.h"

#include "ir/Match.h"
#include "support/messages/Gibbs.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

const Program& Interpreter::programOf(const Macro& macro) {
  for (const Programs* known : {&programs_, around_.programs})
    if (known != nullptr)
      if (const auto found = known->find(&macro); found != known->end()) return *found->second;
  auto program = std::make_unique<const Program>(compileProgram(macro, around_.limits, around_.load));
  // A file that cannot be read is reported by each run.
  Programs& keeper = around_.programs == nullptr || program->includes ? programs_ : *around_.programs;
  return *keeper.emplace(&macro, std::move(program)).first->second;
}

void Interpreter::reportOnce(Diagnostic diagnostic) {
  const SourceRange range = diagnostic.range;
  for (const Diagnostic& other : around_.diagnostics.all()) {
    const bool overlaps =
        other.range.file == range.file && other.range.begin <= range.end && range.begin <= other.range.end;
    if (diagnostic.severity == Severity::Error && other.severity == Severity::Error && range.hasPlace() &&
        overlaps)
      return;
  }
  around_.diagnostics.add(std::move(diagnostic));
}

Interpreter::Flow Interpreter::step(State& state, const Instruction& instruction) {
  const SourceRange range = instruction.range;
  const auto flow = [](bool done) { return done ? Flow::Next : Flow::Failed; };
  fault_.reset();
  return std::visit(
      ir::Overloaded{[&](const AssignStep& s) {
                       auto value = evaluate(state, *s.assignment->value);
                       return flow(value && write(state, s.assignment->target, std::move(*value), range));
                     },
                     [&](const BranchStep& s) {
                       const auto truth = decide(state, *s.condition);
                       if (!truth) return Flow::Failed;
                       const bool* known = std::get_if<bool>(&*truth);
                       if (known == nullptr)
                         return fork(state, std::get<ir::ConditionPtr>(*truth), s.otherwise, range);
                       if (*known) return Flow::Next;
                       state.frames.back().at = s.otherwise;
                       return Flow::Jumped;
                     },
                     [&](const JumpStep& s) { return jump(state, s.target, range); },
                     [&](const ForStep& s) { return loop(state, s, range); },
                     [&](const NextStep& s) { return next(state, s, range); },
                     [&](const GotoStep& s) { return jumpToLabel(state, *s.label, range); },
                     [&](const CallStep& s) { return call(state, s, range); },
                     [&](const ArgsStep& s) { return takeArguments(state, *s.args, range); },
                     [&](const DeclareStep& s) { return declare(state, *s.declaration); },
                     [&](const OnErrorStep& s) {
                       state.frames.back().onError = s.label;
                       return Flow::Next;
                     },
                     [&](const CommandStep& s) { return command(state, *s.command, range); },
                     [&](const UnverifiedStep& s) { return flow(assumes(s.assumption, range)); },
                     [&](const RefuseStep& s) {
                       refuse(range, s.why);
                       return Flow::Failed;
                     }},
      instruction.step);
}

// ---- jumps ----------------------------------------------------------------------------------------------

Interpreter::Flow Interpreter::jump(State& state, std::size_t target, SourceRange range) {
  Frame& frame = state.frames.back();
  const Program& program = *frame.program;
  std::vector<std::size_t> around; // loops around the target
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
  return arrive(state, range);
}

Interpreter::Flow Interpreter::jumpToLabel(State& state, const Name& label, SourceRange range) {
  const auto& labels = state.frames.back().program->labels;
  const auto found = labels.find(foldCase(label.text));
  if (found == labels.end()) {
    refuse(label.range, "no label of this name is in the macro");
    return Flow::Failed;
  }
  if (found->second == kNowhere) {
    refuse(label.range, "the label appears twice, and where the jump leads is not known");
    return Flow::Failed;
  }
  state.jumped = range;
  return jump(state, found->second, range);
}

// ---- loops ----------------------------------------------------------------------------------------------

Interpreter::Flow Interpreter::loop(State& state, const ForStep& s, SourceRange range) {
  if (state.frames.back().program->loops[s.index].next == kNowhere) {
    refuse(range, "the FOR has no NEXT");
    return Flow::Failed;
  }
  auto from = evaluateNumber(state, *s.loop->from);
  if (!from || !enterLoop(state, s.index)) return Flow::Failed;
  return write(state, {s.loop->variable, nullptr, 0}, std::move(*from), range) ? Flow::Next : Flow::Failed;
}

bool Interpreter::enterLoop(State& state, std::size_t index) {
  const For& loop = *state.frames.back().program->loops[index].statement;
  const auto end = evaluateNumber(state, *loop.to);
  if (!end) return false;
  double size = 1;
  if (loop.step) {
    const auto given = evaluateNumber(state, *loop.step);
    if (!given) return false;
    const double* number = numberIn(*given);
    if (number == nullptr) {
      if (const Unknown* unknown = unknownIn(*given))
        fault<diag::UnknownValue>(loop.step->range, false, unknownText(*unknown));
      else
        refuse(loop.step->range, "the STEP is no constant, so which way the loop counts is not known");
      return false;
    }
    size = *number;
    if (size < 0 && !assumes("negative-step", loop.step->range)) return false;
  }
  return openLoop(state, index, *end, size);
}

Interpreter::Flow Interpreter::next(State& state, const NextStep& s, SourceRange range) {
  const Frame& frame = state.frames.back();
  if (frame.loops.empty() || frame.loops.back().index != s.index) {
    refuse(range, "the NEXT is reached without its FOR");
    return Flow::Failed;
  }
  const Loop& loop = frame.program->loops[s.index];
  const VariableRef variable{loop.statement->variable, nullptr, 0};
  const auto before = read(state, variable);
  return before ? advance(state, loop, variable, *before, range) : Flow::Failed;
}

// ---- calls and declarations -----------------------------------------------------------------------------

Interpreter::Flow Interpreter::call(State& state, const CallStep& s, SourceRange range) {
  const CallMacro& call = *s.call;
  if (!call.macro && !assumes("bare-file", call.macroRange)) return Flow::Failed;
  std::string name = call.bareName;
  if (call.macro) {
    const auto text = evaluateText(state, *call.macro);
    if (!text) return Flow::Failed;
    if (const Unknown* unknown = unknownIn(*text)) {
      fault<diag::UnknownValue>(call.macroRange, false, unknownText(*unknown));
      return Flow::Failed;
    }
    name = std::get<std::string>(*text);
  }
  std::vector<Value> arguments;
  for (const ExpressionPtr& argument : call.arguments) {
    auto value = evaluate(state, *argument);
    if (!value) return Flow::Failed;
    arguments.push_back(std::move(*value));
  }
  if (state.frames.size() > around_.limits.callDepth) {
    fault<diag::CallTooDeep>(range, false, around_.limits.callDepth);
    return Flow::Failed;
  }
  const Macro* macro = around_.load ? around_.load(name, call.macroRange) : nullptr;
  if (macro == nullptr) {
    refuse(call.macroRange, "the macro that CALL names is not there");
    return Flow::Failed;
  }
  Frame frame;
  frame.program = &programOf(*macro);
  frame.called = range;
  return enter(state, std::move(frame), call, *macro, std::move(arguments));
}

Interpreter::Flow Interpreter::declare(State& state, const Declaration& declaration) {
  for (const VariableRef& ref : declaration.names) {
    const std::string key = foldCase(ref.name.text);
    auto& locals = state.frames.back().locals;
    if (ref.index) {
      if (!assumes(ref.bracket == '[' ? "array-square" : "array-round", ref.name.range) ||
          !declareArray(state, ref, declaration.scope))
        return Flow::Failed;
    } else if (declaration.scope != Scope::Local) {
      locals.erase(key);
    } else if (locals.try_emplace(key).second) {
      declared(state, ref);
    }
  }
  return Flow::Next;
}

} // namespace dotek::frontend::gibbs
