#include "frontend/gibbs/LowerFlatten.h"

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
    : Interpreter(context, purpose), cycle_(cycle), context_(context) {
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    const std::string key = foldCase(cycle.variables[id].name);
    if (cycle.variables[id].role == ir::Role::Parameter) {
      fields_.emplace(key, id);
    }
    names_.insert(key);
  }
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
    for (const auto& [name, value] : frame.locals)
      key += "," + name + (value ? "=" + canonical(*value) : "");
    for (const LoopRun& loop : frame.loops)
      key += fmt::format(" {}/{}", loop.index, loop.instance);
    if (frame.onError != nullptr) key += "!" + foldCase(frame.onError->text);
    key += ';';
  }
  for (const auto& [name, value] : state.globals)
    key += name + "=" + canonical(value) + ";";
  for (const auto& [host, value] : state.written)
    key += host + ",";
  key += ';';
  for (const auto& [name, value] : state.shadowed)
    key += name + (value ? "=" + canonical(*value) : "") + ",";
  key += ';';
  for (const auto* names : {&state.dialogs, &state.changed}) {
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
      for (const LoopRun& loop : frame.loops)
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
    switch (step(state, instruction)) {
    case Flow::Next: ++state.frames.back().at; break;
    case Flow::Jumped: break;
    case Flow::Failed: return emit(instruction.range, FlatRefuse{std::move(fault_->diagnostic)});
    case Flow::Ended:
    case Flow::Stopped:
    case Flow::DialogAgain:
    case Flow::NeedsUser: return;
    }
  }
}

void Flattener::leaveFrame(State& state) {
  state.frames.pop_back();
  ++state.frames.back().at;
}

// Fields that were assigned where no dialog overwrites them.
void Flattener::ended(State& state) {
  for (const auto& [field, known] : state.shadowed) {
    const ir::VariableId target = fields_.at(field);
    const Name name{{}, cycle_.variables[target].name};
    const auto value = known ? number(*known, {}).value_or(nullptr)
                             : ir::variable(variableOf({VariableKey::Kind::Shadow, field}, name));
    if (value) emit({}, FlatAssign{target, value});
  }
  emit({}, FlatReturn{});
}

// States become places.
void Flattener::resolve() {
  const auto code = variables_.find({VariableKey::Kind::Global, "CALLBACK_RETURNCODE"});
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
    assumes("for-end-at-entry", loop.endRange);
    flat_.steps.front() = {loop.endRange, FlatRefuse{std::move(fault_->diagnostic)}};
    return;
  }
}

// ---- instructions ---------------------------------------------------------------------------------------

void Flattener::refuse(SourceRange range, std::string_view why) {
  fault<diag::CannotTranslate>(range, false, why);
}

Interpreter::Flow Flattener::fork(State& state, const ir::ConditionPtr& condition, std::size_t otherwise,
                                  SourceRange range) {
  State other = state;
  other.frames.back().at = otherwise;
  emit(range, FlatBranch{ir::negate(condition), later(std::move(other))});
  return Flow::Next;
}

Interpreter::Flow Flattener::arrive(State& state, SourceRange range) {
  if (showsDialogAgain(state)) {
    emit(range, FlatEnd{true});
  } else {
    emit(range, FlatJump{later(state)});
  }
  return Flow::Ended;
}

// The next instruction shows a dialog that was shown before.
bool Flattener::showsDialogAgain(State& state) {
  const Frame& frame = state.frames.back();
  if (purpose_ != Purpose::Checks || frame.at >= frame.program->instructions.size()) return false;
  const Instruction& instruction = frame.program->instructions[frame.at];
  const auto* step = std::get_if<CommandStep>(&instruction.step);
  if (step == nullptr || foldCase(step->command->name.text) != "DIALOG") return false;
  const auto name = dialogName(state, *step->command, instruction.range, nullptr);
  fault_.reset();
  return name && state.dialogs.contains(*name);
}

// ---- loops ----------------------------------------------------------------------------------------------

bool Flattener::openLoop(State& state, std::size_t index, const Value& end, double step) {
  Frame& frame = state.frames.back();
  const For& loop = *frame.program->loops[index].statement;
  const auto bound = number(end, loop.to->range);
  if (!bound) return false;
  LoopInstance made;
  made.endRange = loop.to->range;
  made.step = step;
  std::optional<double> constant;
  if (const double* known = ir::constantValue(*bound)) {
    constant = *known;
    made.end = *bound;
  } else {
    const ir::VariableId variable =
        freshLocal({VariableKey::Kind::LoopEnd, "", frame.instance, index}, "end_of_" + loop.variable.text);
    made.end = ir::variable(variable);
    collectVariables(*bound, made.bounds);
    emit(loop.to->range, FlatAssign{variable, *bound});
  }
  const auto [found, isNew] = loopIds_.try_emplace({frame.instance, index, constant}, loops_.size());
  if (isNew) {
    loops_.push_back(std::move(made));
  } else {
    loops_[found->second].bounds.insert(made.bounds.begin(), made.bounds.end());
  }
  frame.loops.push_back({index, 0.0, step, found->second});
  runningLoops_.push_back(found->second);
  return true;
}

Interpreter::Flow Flattener::advance(State& state, const Loop& loop, const VariableRef& variable,
                                     const Value& before, SourceRange range) {
  const LoopInstance run = loops_[state.frames.back().loops.back().instance];
  const auto counter = number(before, range);
  if (!counter) return Flow::Failed;
  const ir::ExpressionPtr sum = ir::binary(ir::BinaryOp::Add, *counter, ir::constant(run.step, range), range);
  if (!write(state, variable, sum, range)) return Flow::Failed;
  const auto after = read(state, variable);
  const auto now = after ? number(*after, range) : std::nullopt;
  if (!now) return Flow::Failed;
  State body = state;
  body.frames.back().at = loop.body;
  const ir::Relation goesOn = run.step < 0 ? ir::Relation::GreaterEqual : ir::Relation::LessEqual;
  emit(range, FlatBranch{ir::compare(goesOn, *now, run.end, range), later(std::move(body))});
  state.frames.back().loops.pop_back();
  return Flow::Next;
}

// ---- calls and declarations -----------------------------------------------------------------------------

// The values go to the names of an ARGS that begins the macro.
Interpreter::Flow Flattener::enter(State& state, Frame frame, const CallMacro& call, const Macro& macro,
                                   std::vector<Value> arguments) {
  const Frame& from = state.frames.back();
  frame.instance =
      instances_.try_emplace({from.instance, from.at, macro.file}, instances_.size() + 1).first->second;
  const auto& code = frame.program->instructions;
  const ArgsStep* args = code.empty() ? nullptr : std::get_if<ArgsStep>(&code.front().step);
  const std::size_t taken = args != nullptr ? args->args->names.size() : 0;
  if (taken != arguments.size()) {
    fault<diag::ArgsMismatch>(frame.called, false, arguments.size(), taken);
    return Flow::Failed;
  }
  if (args != nullptr) {
    frame.at = 1;
    for (const VariableRef& ref : args->args->names)
      frame.locals.try_emplace(foldCase(ref.name.text));
  }
  state.frames.push_back(std::move(frame));
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (!write(state, {args->args->names[i].name, nullptr, 0}, std::move(arguments[i]),
               call.arguments[i]->range))
      return Flow::Failed;
  }
  return Flow::Jumped;
}

Interpreter::Flow Flattener::takeArguments(State&, const Args& args, SourceRange range) {
  fault<diag::ArgsMismatch>(range, false, 0, args.names.size());
  return Flow::Failed;
}

bool Flattener::declareArray(State&, const VariableRef& ref, Scope) {
  refuse(ref.name.range, "an array is declared");
  return false;
}

void Flattener::declared(State& state, const VariableRef& local) {
  if (local.name.isText()) return;
  const VariableKey key = keyFor(state, foldCase(local.name.text));
  emit(local.name.range, FlatUnset{variableOf(key, local.name)});
}

} // namespace dotek::frontend::gibbs
