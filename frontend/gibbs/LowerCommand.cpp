#include "frontend/gibbs/LowerFlatten.h"
#include "support/messages/Gibbs.h"

#include <algorithm>
#include <utility>

namespace dotek::frontend::gibbs {

Interpreter::Flow Flattener::needsUser(const Command& c, const std::string& name) {
  Diagnostic found = makeDiagnostic<diag::NeedsUser>(c.name.range, name);
  if (purpose_ == Purpose::Checks && context_.assumptions.contains("unchecked")) {
    context_.diagnostics.add(std::move(found));
    emit(c.name.range, FlatEnd{false});
    return Flow::Ended;
  }
  found.severity = Severity::Error;
  if (purpose_ == Purpose::Checks) found.note({}, "`--assume unchecked` leaves out what follows it");
  fault_ = Fault{std::move(found)};
  return Flow::Failed;
}

Interpreter::Flow Flattener::show(State&, const Command&,
                                  const std::vector<std::optional<std::string>>& parts, SourceRange range) {
  FlatMessage message;
  for (const auto& part : parts) {
    if (!part) {
      message.computed = true;
      continue;
    }
    if (!message.text.empty()) message.text += ' ';
    message.text += *part;
  }
  emit(range, std::move(message));
  return Flow::Next;
}

Interpreter::Flow Flattener::stop(SourceRange range) {
  emit(range, FlatEnd{true});
  return Flow::Ended;
}

// ---- the dialog -----------------------------------------------------------------------------------------

void Flattener::dialogOpens(State&, SourceRange range) {
  emit(range, FlatDialog{});
}

Interpreter::Flow Flattener::dialogAgain(State& state, SourceRange range) {
  const auto& frames = state.frames;
  const bool again = std::any_of(frames.begin(), frames.end() - 1,
                                 [&](const Frame& frame) { return frame.program == frames.back().program; });
  emit(again ? frames.back().called : range, FlatEnd{true, again});
  return Flow::Ended;
}

// What no input overwrites stays as the macro has set it.
bool Flattener::dialogCloses(State& state, SourceRange range) {
  for (const auto& [field, known] : std::exchange(state.shadowed, {})) {
    const Name name{range, cycle_.variables[fields_.at(field)].name};
    const Value value =
        known ? *known : Value(ir::variable(variableOf({VariableKey::Kind::Shadow, field}, name), range));
    const auto given = number(value, range);
    if (!given) return false;
    emit(range, FlatAssign{fields_.at(field), *given});
    state.changed.insert(field);
  }
  return true;
}

bool Flattener::storeFields(State& state, SourceRange range) {
  return std::all_of(fields_.begin(), fields_.end(),
                     [&](const auto& field) { return storeField(state, field.first, range); });
}

bool Flattener::storeField(State& state, const std::string& field, SourceRange range) {
  const ir::VariableId id = fields_.at(field);
  if (state.changed.contains(field)) {
    refuse(range, fmt::format("a second dialog sets `{}`, which was assigned since the first",
                              cycle_.variables[id].name));
    return false;
  }
  if (state.frames.back().locals.contains(field)) {
    setFixed(state, field, std::nullopt);
    const Name name{range, cycle_.variables[id].name};
    emit(range, FlatAssign{variableOf(keyFor(state, field), name), ir::variable(id, range)});
    return true;
  }
  state.shadowed.erase(field);
  return true;
}

// ---- values and moves -----------------------------------------------------------------------------------

Value Flattener::kept(const Value& value, SourceRange range) {
  const auto* expression = std::get_if<ir::ExpressionPtr>(&value);
  if (expression == nullptr) return value;
  const ir::VariableId copy = freshLocal({VariableKey::Kind::Swap, ""}, "swapped");
  emit(range, FlatAssign{copy, *expression});
  return ir::variable(copy, range);
}

std::optional<Value> Flattener::coordinate(const Value& value, SourceRange range) {
  const auto given = number(value, range);
  return given ? std::optional<Value>(*given) : std::nullopt;
}

bool Flattener::addMove(PathMove::Kind kind, const std::array<std::optional<Value>, 3>& axes,
                        SourceRange range) {
  FlatMove move;
  move.kind = kind;
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    if (axes[axis]) move.axes[axis] = std::get<ir::ExpressionPtr>(*axes[axis]);
  emit(range, std::move(move));
  return true;
}

Value Flattener::writtenHost(State& state, const std::string&, const std::string& reason, SourceRange range) {
  return opaque(state, "", {}, reason + " after its change", false, range);
}

} // namespace dotek::frontend::gibbs
