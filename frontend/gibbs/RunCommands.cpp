#include "frontend/gibbs/RunMachine.h"
#include "support/messages/Gibbs.h"

namespace dotek::frontend::gibbs {

Interpreter::Flow Machine::needsUser(const Command& c, const std::string& name) {
  Diagnostic found = makeDiagnostic<diag::NeedsUser>(c.name.range, name);
  if (purpose_ == Purpose::ToolPath) found.severity = Severity::Error;
  reportOnce(std::move(found));
  return Flow::NeedsUser;
}

Interpreter::Flow Machine::show(State& state, const Command& c,
                                const std::vector<std::optional<std::string>>& parts, SourceRange range) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!text.empty()) text += ' ';
    text += parts[i] ? *parts[i] : fmt::format("<{}>", context_.sources.textUtf8(c.arguments[i]->range));
  }
  messageBytes_ += text.size() + sizeof(ShownMessage);
  if (messageBytes_ > context_.limits.outputBytes) {
    fault<diag::RunTooLarge>(range, false, context_.limits.outputBytes);
    return Flow::Failed;
  }
  messages_.push_back({{range, std::move(text)}, state.message});
  state.message = messages_.size() - 1;
  return Flow::Next;
}

void Machine::dialogOpens(State& state, SourceRange) {
  if (state.dialogs.empty()) state.messageBefore = state.message;
}

bool Machine::storeField(State& state, const std::string& field, SourceRange) {
  auto& locals = state.frames.back().locals;
  if (const auto local = locals.find(field); local != locals.end())
    local->second = context_.fields.at(field);
  else
    state.globals.erase(field);
  return true;
}

bool Machine::storeFields(State& state, SourceRange range) {
  for (const auto& [field, value] : context_.fields)
    storeField(state, field, range);
  return true;
}

std::optional<Value> Machine::coordinate(const Value& value, SourceRange range) {
  const Unknown* unknown = unknownIn(value);
  if (unknown == nullptr) return value;
  if (unknown->sources.empty()) {
    fault<diag::UnknownValue>(range, false, unknownText(*unknown));
  } else {
    fault<diag::HostInputUnknown>(range, false, unknownText(*unknown));
  }
  return std::nullopt;
}

bool Machine::addMove(PathMove::Kind kind, const std::array<std::optional<Value>, 3>& axes,
                      SourceRange range) {
  PathMove move;
  if (!moves_.empty()) move = moves_.back();
  move.kind = kind;
  move.range = range;
  const std::array<double*, 3> words = {&move.x, &move.y, &move.z};
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    if (axes[axis]) *words[axis] = *numberIn(*axes[axis]);
  if ((moves_.size() + 1) * sizeof(PathMove) > context_.limits.outputBytes) {
    fault<diag::RunTooLarge>(range, false, context_.limits.outputBytes);
    return false;
  }
  moves_.push_back(move);
  return true;
}

void Machine::fillArray(State& state, const VariableRef& ref, const std::string& reason) {
  const std::string key = foldCase(ref.name.text) + "(";
  for (auto at = state.globals.lower_bound(key); at != state.globals.end() && at->first.starts_with(key);
       ++at) {
    at->second = opaque(state, "", {}, reason, ref.name.isText(), ref.name.range);
  }
}

} // namespace dotek::frontend::gibbs
