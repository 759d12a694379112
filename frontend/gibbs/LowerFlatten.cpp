#include "frontend/gibbs/LowerFlatten.h"

#include "frontend/gibbs/Assumptions.h"
#include "frontend/gibbs/LowerTerms.h"
#include "support/messages/Gibbs.h"

#include <algorithm>

namespace dotek::frontend::gibbs {
namespace {

// Bounds of the code that one macro may become.
constexpr std::size_t kMaxSteps = 20'000;
constexpr std::size_t kMaxKeyBytes = 32u << 20;

} // namespace

Flattener::Flattener(ir::Cycle& cycle, LowerContext& context, Purpose purpose)
    : cycle_(cycle), context_(context), purpose_(purpose),
      compiling_{context.sources, context.keywords,  context.limits, context.diagnostics, {}, {}, {},
                 context.load,    context.loadDialog} {
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    const std::string key = foldCase(cycle.variables[id].name);
    if (cycle.variables[id].role == ir::Role::Parameter) fields_.emplace(key, id);
    names_.insert(key);
  }
}

const Program& Flattener::programOf(const Macro& macro) {
  auto& program = programs_[&macro];
  if (!program) program = std::make_unique<const Program>(compileProgram(macro, compiling_));
  return *program;
}

Flat Flattener::flatten(const Macro& macro) {
  State state;
  Frame frame;
  frame.program = &programOf(macro);
  state.frames.push_back(std::move(frame));
  follow(std::move(state));
  while (!waiting_.empty()) {
    auto first = waiting_.extract(waiting_.begin());
    follow(std::move(first.mapped()));
  }
  resolve();
  checkLoopEnds();
  return std::move(flat_);
}

// Equal keys: what follows is the same.
std::string Flattener::keyOf(const State& state) const {
  std::string key;
  for (const Frame& frame : state.frames) {
    key += fmt::format("{}@{}", frame.instance, frame.at);
    for (const std::string& name : frame.locals)
      key += "," + name;
    for (const LoopAt& loop : frame.loops)
      key += fmt::format(" {}/{}", loop.index, loop.instance);
    if (frame.onError != nullptr) key += "!" + foldCase(frame.onError->text);
    key += ';';
  }
  for (const auto& [name, value] : state.fixed)
    key += name + "=" + canonical(value) + ";";
  for (const auto* names : {&state.written, &state.dialogs, &state.shadowed, &state.changed}) {
    for (const std::string& name : *names)
      key += name + ",";
    key += ';';
  }
  if (state.angles) key += *state.angles == ir::AngleUnit::Degrees ? 'd' : 'r';
  return key;
}

std::size_t Flattener::idOf(const State& state) {
  std::string key = keyOf(state);
  const std::size_t bytes = key.size();
  const auto [found, isNew] = states_.emplace(std::move(key), placeOf_.size());
  if (isNew) {
    placeOf_.push_back(kNowhere);
    keyBytes_ += bytes;
  }
  return found->second;
}

std::size_t Flattener::later(State state) {
  while (state.frames.size() > 1 &&
         state.frames.back().at >= state.frames.back().program->instructions.size()) {
    leaveFrame(state);
  }
  const std::size_t id = idOf(state);
  if (placeOf_[id] != kNowhere) return id;
  std::vector<std::size_t> order;
  for (const Frame& frame : state.frames)
    order.push_back(frame.at);
  waiting_.emplace(std::make_pair(std::move(order), id), std::move(state));
  return id;
}

bool Flattener::full() const {
  return flat_.steps.size() >= std::min<std::size_t>(kMaxSteps, context_.limits.steps) ||
         keyBytes_ > kMaxKeyBytes;
}

void Flattener::emit(SourceRange range, decltype(FlatStep::step) step) {
  if (const auto* assign = std::get_if<FlatAssign>(&step)) {
    for (const std::size_t loop : runningLoops_)
      loops_[loop].changed.insert(assign->variable);
  }
  flat_.steps.push_back({range, std::move(step)});
}

void Flattener::follow(State state) {
  for (;;) {
    while (state.frames.size() > 1 &&
           state.frames.back().at >= state.frames.back().program->instructions.size()) {
      leaveFrame(state);
    }
    const std::size_t id = idOf(state);
    if (placeOf_[id] != kNowhere) return emit({}, FlatJump{id});
    placeOf_[id] = flat_.steps.size();
    std::vector<std::size_t> order;
    runningLoops_.clear();
    for (const Frame& frame : state.frames) {
      order.push_back(frame.at);
      for (const LoopAt& loop : frame.loops)
        runningLoops_.push_back(loop.instance);
    }
    waiting_.erase({std::move(order), id});
    Frame& frame = state.frames.back();
    if (frame.at >= frame.program->instructions.size()) return ended(state);
    const Instruction& instruction = frame.program->instructions[frame.at];
    if (full()) {
      return emit(instruction.range,
                  FlatRefuse{makeDiagnostic<diag::CannotTranslate>(
                      instruction.range, "the macro and what it calls become too much code")});
    }
    failure_.reset();
    switch (step(state, instruction)) {
    case Flow::Next: ++state.frames.back().at; break;
    case Flow::Jumped: break;
    case Flow::Ended: return;
    case Flow::Failed: return emit(instruction.range, FlatRefuse{std::move(*failure_)});
    }
  }
}

void Flattener::leaveFrame(State& state) {
  const std::string prefix = fmt::format("#{}:", state.frames.back().instance);
  std::erase_if(state.fixed, [&](const auto& entry) { return entry.first.starts_with(prefix); });
  state.frames.pop_back();
  ++state.frames.back().at;
}

// Fields that were assigned where no dialog overwrites them.
void Flattener::ended(State& state) {
  for (const std::string& field : state.shadowed) {
    const auto fixed = state.fixed.find("~" + field);
    const ir::VariableId target = fields_.at(field);
    const Name name{{}, cycle_.variables[target].name};
    const auto value = fixed == state.fixed.end() ? ir::variable(variableOf("~" + field, name))
                                                  : number({nullptr, fixed->second}, {}).value_or(nullptr);
    if (value) emit({}, FlatAssign{target, value});
  }
  emit({}, FlatReturn{});
}

// States become places.
void Flattener::resolve() {
  const auto code = variables_.find("CALLBACK_RETURNCODE");
  if (code != variables_.end()) flat_.returnCode = code->second;
  for (FlatStep& each : flat_.steps) {
    if (auto* jump = std::get_if<FlatJump>(&each.step)) jump->target = placeOf_[jump->target];
    if (auto* branch = std::get_if<FlatBranch>(&each.step)) branch->target = placeOf_[branch->target];
    auto* end = std::get_if<FlatReturn>(&each.step);
    if (end != nullptr && flat_.returnCode != kNoVariable) end->code = flat_.returnCode;
    if (end != nullptr && flat_.returnCode == kNoVariable) each.step = FlatEnd{false};
  }
}

// Whether the end of a FOR is taken once or at each NEXT is not known: nothing may tell the two apart.
void Flattener::checkLoopEnds() {
  if (context_.assumptions.contains("for-end-at-entry")) return;
  for (const LoopInstance& loop : loops_) {
    const bool changes = std::any_of(loop.bounds.begin(), loop.bounds.end(),
                                     [&](ir::VariableId id) { return loop.changed.contains(id); });
    if (!changes) continue;
    failure_.reset();
    assumes("for-end-at-entry", loop.endRange);
    flat_.steps.front() = {loop.endRange, FlatRefuse{std::move(*failure_)}};
    return;
  }
}

// ---- instructions ---------------------------------------------------------------------------------------

Flattener::Flow Flattener::step(State& state, const Instruction& instruction) {
  const SourceRange range = instruction.range;
  if (const auto* s = std::get_if<AssignStep>(&instruction.step)) {
    const auto value = lower(state, *s->assignment->value);
    return value && write(state, s->assignment->target, *value, range) ? Flow::Next : Flow::Failed;
  }
  if (const auto* s = std::get_if<BranchStep>(&instruction.step)) return branch(state, *s, range);
  if (const auto* s = std::get_if<JumpStep>(&instruction.step)) return jump(state, s->target, range);
  if (const auto* s = std::get_if<ForStep>(&instruction.step)) return loop(state, *s, range);
  if (const auto* s = std::get_if<NextStep>(&instruction.step)) return next(state, *s, range);
  if (const auto* s = std::get_if<GotoStep>(&instruction.step)) return jumpTo(state, *s->label, range);
  if (const auto* s = std::get_if<CallStep>(&instruction.step)) return call(state, *s, range);
  if (const auto* s = std::get_if<DeclareStep>(&instruction.step)) return declare(state, *s->declaration);
  if (const auto* s = std::get_if<CommandStep>(&instruction.step)) return command(state, *s->command, range);
  if (const auto* s = std::get_if<OnErrorStep>(&instruction.step)) {
    state.frames.back().onError = s->label;
    return Flow::Next;
  }
  if (const auto* s = std::get_if<UnverifiedStep>(&instruction.step))
    return assumes(s->assumption, range) ? Flow::Next : Flow::Failed;
  if (const auto* s = std::get_if<ArgsStep>(&instruction.step)) {
    fail<diag::ArgsMismatch>(range, 0, s->args->names.size());
    return Flow::Failed;
  }
  if (const auto* s = std::get_if<RefuseStep>(&instruction.step)) fail<diag::CannotTranslate>(range, s->why);
  return Flow::Failed;
}

Flattener::Flow Flattener::branch(State& state, const BranchStep& s, SourceRange range) {
  const auto holds = condition(state, *s.condition);
  if (!holds) return Flow::Failed;
  State otherwise = state;
  otherwise.frames.back().at = s.otherwise;
  if (const auto* truth = std::get_if<ir::Truth>(&(*holds)->node)) {
    if (truth->value) return Flow::Next;
    state = std::move(otherwise);
    return Flow::Jumped;
  }
  emit(range, FlatBranch{ir::negate(*holds), later(std::move(otherwise))});
  return Flow::Next;
}

Flattener::Flow Flattener::jump(State& state, std::size_t target, SourceRange range) {
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
  std::size_t running = 0;
  while (running < std::min(around.size(), frame.loops.size()) &&
         frame.loops[running].index == around[running]) {
    ++running;
  }
  if (running < around.size() && !assumes("goto-into-for", range)) return Flow::Failed;
  frame.loops.resize(running);
  for (std::size_t i = running; i < around.size(); ++i) {
    if (!enterLoop(state, around[i])) return Flow::Failed;
  }
  state.frames.back().at = target;
  if (showsDialogAgain(state)) {
    emit(range, FlatEnd{true});
  } else {
    emit(range, FlatJump{later(state)});
  }
  return Flow::Ended;
}

Flattener::Flow Flattener::jumpTo(State& state, const Name& label, SourceRange range) {
  const auto& labels = state.frames.back().program->labels;
  const auto found = labels.find(foldCase(label.text));
  if (found == labels.end()) {
    fail<diag::CannotTranslate>(label.range, "no label of this name stands in the macro");
    return Flow::Failed;
  }
  if (found->second == kNowhere) {
    fail<diag::CannotTranslate>(label.range, "the label stands twice, and where the jump leads is not known");
    return Flow::Failed;
  }
  return jump(state, found->second, range);
}

// ---- loops ----------------------------------------------------------------------------------------------

Flattener::Flow Flattener::loop(State& state, const ForStep& s, SourceRange range) {
  const Loop& loop = state.frames.back().program->loops[s.index];
  if (loop.next == kNowhere) {
    fail<diag::CannotTranslate>(range, "the FOR has no NEXT");
    return Flow::Failed;
  }
  const auto from = lowerNumber(state, *s.loop->from);
  if (!from || !enterLoop(state, s.index)) return Flow::Failed;
  return write(state, {s.loop->variable, nullptr, 0}, {*from, 0.0}, range) ? Flow::Next : Flow::Failed;
}

bool Flattener::enterLoop(State& state, std::size_t index) {
  Frame& frame = state.frames.back();
  const For& loop = *frame.program->loops[index].statement;
  const auto end = lowerNumber(state, *loop.to);
  if (!end) return false;
  LoopInstance made;
  made.endRange = loop.to->range;
  if (loop.step) {
    const auto given = lowerNumber(state, *loop.step);
    if (!given) return false;
    const double* size = ir::constantValue(*given);
    if (size == nullptr) {
      fail<diag::CannotTranslate>(loop.step->range,
                                  "the STEP is no constant, so which way the loop counts is not known");
      return false;
    }
    made.step = *size;
    if (made.step < 0 && !assumes("negative-step", loop.step->range)) return false;
  }
  const double* constant = ir::constantValue(*end);
  std::string key = fmt::format("{}:{}", frame.instance, index);
  if (constant != nullptr) key += fmt::format("={}", *constant);
  made.end =
      constant != nullptr ? *end : ir::variable(freshLocal("end " + key, "end_of_" + loop.variable.text));
  if (constant == nullptr) {
    collectVariables(*end, made.bounds);
    const auto* use = std::get_if<ir::VariableUse>(&made.end->node);
    emit(loop.to->range, FlatAssign{use->variable, *end});
  }
  const auto [found, isNew] = loopIds_.emplace(std::move(key), loops_.size());
  if (isNew) {
    loops_.push_back(std::move(made));
  } else {
    loops_[found->second].bounds.insert(made.bounds.begin(), made.bounds.end());
  }
  state.frames.back().loops.push_back({index, found->second});
  runningLoops_.push_back(found->second);
  return true;
}

Flattener::Flow Flattener::next(State& state, const NextStep& s, SourceRange range) {
  Frame& frame = state.frames.back();
  const Loop& loop = frame.program->loops[s.index];
  if (frame.loops.empty() || frame.loops.back().index != s.index) {
    fail<diag::CannotTranslate>(range, "the NEXT is reached without its FOR");
    return Flow::Failed;
  }
  const LoopInstance run = loops_[frame.loops.back().instance];
  const VariableRef variable{loop.statement->variable, nullptr, 0};
  const auto before = read(state, variable);
  if (!before) return Flow::Failed;
  const auto counter = number(*before, range);
  if (!counter) return Flow::Failed;
  if (!write(state, variable,
             {ir::binary(ir::BinaryOp::Add, *counter, ir::constant(run.step, range), range), 0.0}, range))
    return Flow::Failed;
  const auto after = read(state, variable);
  if (!after || !after->number) return Flow::Failed;
  State body = state;
  body.frames.back().at = loop.body;
  const ir::Relation goesOn = run.step < 0 ? ir::Relation::GreaterEqual : ir::Relation::LessEqual;
  emit(range, FlatBranch{ir::compare(goesOn, after->number, run.end, range), later(std::move(body))});
  state.frames.back().loops.pop_back();
  return Flow::Next;
}

// ---- calls and declarations -----------------------------------------------------------------------------

Flattener::Flow Flattener::call(State& state, const CallStep& s, SourceRange range) {
  const CallMacro& call = *s.call;
  if (!call.macro && !assumes("bare-file", call.macroRange)) return Flow::Failed;
  std::string name = call.bareName;
  if (call.macro) {
    const auto text = lower(state, *call.macro);
    if (!text) return Flow::Failed;
    const std::string* known = text->number ? nullptr : std::get_if<std::string>(&text->fixed);
    if (known == nullptr) {
      fail<diag::CannotTranslate>(call.macroRange, "which macro CALL names is not known");
      return Flow::Failed;
    }
    name = *known;
  }
  std::vector<Lowered> arguments;
  for (const ExpressionPtr& argument : call.arguments) {
    auto value = lower(state, *argument);
    if (!value) return Flow::Failed;
    arguments.push_back(std::move(*value));
  }
  if (state.frames.size() > context_.limits.callDepth) {
    fail<diag::CallTooDeep>(range, context_.limits.callDepth);
    return Flow::Failed;
  }
  const Macro* macro = context_.load ? context_.load(name, call.macroRange) : nullptr;
  if (macro == nullptr) {
    fail<diag::CannotTranslate>(call.macroRange, "the macro that CALL names is not there");
    return Flow::Failed;
  }
  Frame frame;
  frame.called = range;
  frame.program = &programOf(*macro);
  const std::string place =
      fmt::format("{}:{}:{}", state.frames.back().instance, state.frames.back().at, macro->file);
  frame.instance = instances_.emplace(place, instances_.size() + 1).first->second;
  const auto& code = frame.program->instructions;
  const ArgsStep* args = code.empty() ? nullptr : std::get_if<ArgsStep>(&code.front().step);
  const std::size_t taken = args != nullptr ? args->args->names.size() : 0;
  if (taken != arguments.size()) {
    fail<diag::ArgsMismatch>(range, arguments.size(), taken);
    return Flow::Failed;
  }
  if (args != nullptr) {
    frame.at = 1;
    for (const VariableRef& ref : args->args->names)
      frame.locals.insert(foldCase(ref.name.text));
  }
  state.frames.push_back(std::move(frame));
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (!write(state, {args->args->names[i].name, nullptr, 0}, arguments[i], call.arguments[i]->range))
      return Flow::Failed;
  }
  return Flow::Jumped;
}

Flattener::Flow Flattener::declare(State& state, const Declaration& declaration) {
  for (const VariableRef& ref : declaration.names) {
    const std::string key = foldCase(ref.name.text);
    if (ref.index) {
      fail<diag::CannotTranslate>(ref.name.range, "an array is declared");
      return Flow::Failed;
    }
    Frame& frame = state.frames.back();
    if (declaration.scope != Scope::Local) {
      frame.locals.erase(key);
    } else if (frame.locals.insert(key).second) {
      const std::string own = fixedKey(state, key);
      state.fixed.erase(own);
      if (!ref.name.isText()) emit(ref.name.range, FlatUnset{variableOf(own, ref.name)});
    }
  }
  return Flow::Next;
}

} // namespace dotek::frontend::gibbs
