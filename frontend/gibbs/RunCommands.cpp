#include "frontend/gibbs/CommandShape.h"
#include "frontend/gibbs/RunMachine.h"

#include "support/Decimal.h"
#include "support/messages/Gibbs.h"

#include <algorithm>
#include <array>

namespace dotek::frontend::gibbs {
using stdlib::ArgumentSpec;
using stdlib::CommandSignature;

Machine::Flow Machine::command(State& state, const Command& c, SourceRange range) {
  std::string name = foldCase(c.name.text);
  if (const auto renamed = context_.keywords.renamedTo(name)) name = foldCase(std::string(*renamed));
  if (name == "MESSAGE" || name == "STOP") {
    const Flow flow = showMessage(state, c, range);
    return flow == Flow::Next && name == "STOP" ? Flow::Stopped : flow;
  }
  if (name == "DIALOG") return showDialog(state, c, range);
  if (name == "DEGREES" || name == "RADIANS") {
    state.angles = name == "DEGREES" ? ir::AngleUnit::Degrees : ir::AngleUnit::Radians;
    return Flow::Next;
  }
  if (name == "SWAP_VALUES") return swapValues(state, c, range);
  if (name == "ADD_CUSTOM_DRILL_CYCLE_PATH" && purpose_ == Purpose::ToolPath) return addMove(state, c, range);
  if (asksUser(name)) return needsUser(c, name);
  if (!context_.keywords.isCommand(name)) return unknownCommand(state, c, name);
  return tableCommand(state, c, name);
}

Machine::Flow Machine::needsUser(const Command& c, const std::string& name) {
  Diagnostic found = makeDiagnostic<diag::NeedsUser>(c.name.range, name);
  if (purpose_ == Purpose::ToolPath) found.severity = Severity::Error;
  reportOnce(std::move(found));
  return Flow::NeedsUser;
}

Machine::Flow Machine::showMessage(State& state, const Command& c, SourceRange range) {
  std::string text;
  for (const ExpressionPtr& argument : c.arguments) {
    const auto value = evaluate(state, *argument);
    if (!value) return Flow::Failed;
    if (!text.empty()) text += ' ';
    if (const std::string* known = std::get_if<std::string>(&*value)) {
      text +=
          toUtf8(*known, range.hasPlace() ? context_.sources.file(range.file).encoding() : Encoding::Utf8);
    } else if (const double* number = std::get_if<double>(&*value)) {
      text += numberText(*number);
    } else {
      text += fmt::format("<{}>", context_.sources.textUtf8(argument->range));
    }
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

Machine::Flow Machine::showDialog(State& state, const Command& c, SourceRange range) {
  if (purpose_ == Purpose::ToolPath) return needsUser(c, "DIALOG");
  std::string name = std::to_string(range.file) + ":" + std::to_string(range.begin);
  const Dialog* dialog = nullptr;
  if (!c.arguments.empty()) {
    const auto value = evaluateText(state, *c.arguments[0]);
    if (!value) return Flow::Failed;
    if (const std::string* text = std::get_if<std::string>(&*value)) {
      name = foldCase(*text);
      if (context_.loadDialog) dialog = context_.loadDialog(*text, c.arguments[0]->range);
    }
  }
  if (state.dialogs.contains(name)) return Flow::DialogAgain;
  if (state.dialogs.empty()) state.messageBefore = state.message;
  state.dialogs.insert(name);
  state.globals["BUTTON"] = 0.0; // OK
  const auto store = [&](const std::string& field, double value) {
    auto& locals = state.frames.back().locals;
    const auto local = locals.find(field);
    if (local != locals.end()) {
      local->second = value;
    } else {
      state.globals[field] = value;
    }
  };
  if (dialog == nullptr) {
    for (const auto& [field, value] : context_.fields)
      store(field, value);
    return Flow::Next;
  }
  for (const Control& control : dialog->controls) {
    if (!control.variable) continue;
    const std::string key = foldCase(control.variable->text);
    if (const auto field = context_.fields.find(key); field != context_.fields.end()) {
      store(key, field->second);
      continue;
    }
    // No field of the cycle: the user's entry is the default, or not known.
    std::optional<Value> value;
    if (control.initial != nullptr) {
      value = evaluate(state, *control.initial);
      if (!value) return Flow::Failed;
    } else if (state.globals.contains(key) || state.frames.back().locals.contains(key)) {
      continue;
    } else {
      value = opaque(state, "dialog " + key, {}, "the dialog's input " + control.variable->text,
                     control.variable->isText());
    }
    if (!write(state, {*control.variable, nullptr, 0}, *value)) return Flow::Failed;
  }
  return Flow::Next;
}

Machine::Flow Machine::swapValues(State& state, const Command& c, SourceRange range) {
  const auto* a = c.arguments.size() == 2 ? std::get_if<VariableRef>(&c.arguments[0]->node) : nullptr;
  const auto* b = c.arguments.size() == 2 ? std::get_if<VariableRef>(&c.arguments[1]->node) : nullptr;
  if (a == nullptr || b == nullptr) {
    fault<diag::CannotRun>(range, false, "SWAP_VALUES takes two variables");
    return Flow::Failed;
  }
  const auto first = read(state, *a);
  const auto second = first ? read(state, *b) : std::nullopt;
  if (!second || !write(state, *a, *second) || !write(state, *b, *first)) return Flow::Failed;
  return Flow::Next;
}

// ---- moves ----------------------------------------------------------------------------------------------

std::optional<double> Machine::coordinate(State& state, const Expression& e) {
  const auto value = evaluateNumber(state, e);
  if (!value) return std::nullopt;
  if (const double* number = std::get_if<double>(&*value)) return *number;
  const Unknown& unknown = *unknownIn(*value);
  if (unknown.sources.empty()) {
    fault<diag::UnknownValue>(e.range, false, unknownText(unknown));
  } else {
    fault<diag::HostInputUnknown>(e.range, false, unknownText(unknown));
  }
  return std::nullopt;
}

Machine::Flow Machine::addMove(State& state, const Command& c, SourceRange range) {
  const std::string kind = c.arguments.empty() ? "" : bareWord(*c.arguments[0]);
  constexpr std::array kKinds = {"FEED", "FEED_X", "FEED_Y", "FEED_Z"};
  const auto found = std::find(kKinds.begin(), kKinds.end(), kind);
  if (found == kKinds.end()) {
    const SourceRange where = c.arguments.empty() ? range : c.arguments[0]->range;
    fault<diag::PathKindUnknown>(where, false, c.arguments.empty() ? "" : context_.sources.textUtf8(where));
    return Flow::Failed;
  }
  PathMove move;
  if (!moves_.empty()) move = moves_.back();
  move.kind = static_cast<PathMove::Kind>(found - kKinds.begin());
  move.range = range;
  if (c.arguments.size() != (move.kind == PathMove::Kind::Feed ? 4u : 2u)) {
    fault<diag::CannotRun>(range, false, "a move of this kind takes another number of coordinates");
    return Flow::Failed;
  }
  std::array<double*, 3> words = {&move.x, &move.y, &move.z};
  for (std::size_t i = 1; i < c.arguments.size(); ++i) {
    const auto value = coordinate(state, *c.arguments[i]);
    if (!value) return Flow::Failed;
    const std::size_t axis =
        move.kind == PathMove::Kind::Feed ? i - 1 : static_cast<std::size_t>(move.kind) - 1;
    *words[axis] = *value;
  }
  if ((moves_.size() + 1) * sizeof(PathMove) > context_.limits.outputBytes) {
    fault<diag::RunTooLarge>(range, false, context_.limits.outputBytes);
    return Flow::Failed;
  }
  moves_.push_back(move);
  return Flow::Next;
}

// ---- commands of the table ------------------------------------------------------------------------------

Machine::Flow Machine::unknownCommand(State& state, const Command& c, const std::string& name) {
  bool writes = false;
  for (const ExpressionPtr& argument : c.arguments) {
    const auto* ref = std::get_if<VariableRef>(&argument->node);
    if (ref == nullptr || ref->index) continue;
    const std::string key = foldCase(ref->name.text);
    auto& locals = state.frames.back().locals;
    if (!locals.contains(key) &&
        (context_.keywords.isConstant(key) || context_.keywords.isSystemVariable(key)))
      continue;
    writes = true;
    if (!write(state, *ref, opaque(state, "", {}, name, ref->name.isText()))) return Flow::Failed;
  }
  if (writes) reportOnce(makeDiagnostic<diag::UnknownCommandRun>(c.name.range, name));
  return Flow::Next;
}

Machine::Flow Machine::tableCommand(State& state, const Command& c, const std::string& name) {
  const auto signatures = context_.keywords.commands(name);
  const auto fitting = std::find_if(signatures.begin(), signatures.end(),
                                    [&](const CommandSignature* s) { return fits(*s, c); });
  if (fitting == signatures.end()) return signatures.empty() ? Flow::Next : unknownCommand(state, c, name);
  const CommandSignature& signature = **fitting;
  for (std::size_t i = 0; i < c.arguments.size(); ++i) {
    const ArgumentSpec& spec = *specAt(signature, i);
    if (spec.kind != ArgumentSpec::Kind::Value || spec.array) continue;
    lenient_ = true;
    const auto value = evaluate(state, *c.arguments[i]);
    lenient_ = false;
    if (!value && fault_ && !fault_->catchable) fault_.reset(); // no effect on what follows
    if (!value && (fault_ || question_)) return Flow::Failed;
    // A host input that the macro changes is no longer the one that was given.
    const ArgumentSpec* parameter = i > 0 ? specAt(signature, i - 1) : nullptr;
    if (parameter == nullptr || parameter->kind != ArgumentSpec::Kind::Parameter) continue;
    const auto host = context_.keywords.hostInput(parameter->family, bareWord(*c.arguments[i - 1]));
    if (host)
      state.written.insert_or_assign(std::string(*host), value ? *value : opaque(state, "", {}, name, false));
  }
  for (std::size_t i = 0; i < c.arguments.size(); ++i) {
    const ArgumentSpec& spec = *specAt(signature, i);
    if (!isWritten(spec)) continue;
    const auto* ref = std::get_if<VariableRef>(&c.arguments[i]->node);
    if (ref == nullptr) {
      fault<diag::CannotRun>(c.arguments[i]->range, false, "the command writes its result to a variable");
      return Flow::Failed;
    }
    if (spec.array && !ref->index) {
      // Elements of a list that the command fills.
      const std::string key = foldCase(ref->name.text) + "(";
      for (auto at = state.globals.lower_bound(key); at != state.globals.end() && at->first.starts_with(key);
           ++at) {
        at->second = opaque(state, "", {}, name, ref->name.isText());
      }
      continue;
    }
    if (!write(state, *ref, dataValue(state, c, signature, name, ref->name.isText()))) return Flow::Failed;
  }
  return Flow::Next;
}

// What a command gives: a host input where its parameter names one of the cycle's own operation or tool.
Value Machine::dataValue(State& state, const Command& c, const CommandSignature& signature,
                         const std::string& name, bool text) {
  std::string reason = name;
  std::optional<std::string> host;
  std::string family;
  for (std::size_t i = 0; i < c.arguments.size(); ++i) {
    const ArgumentSpec& spec = *specAt(signature, i);
    if (spec.kind != ArgumentSpec::Kind::Parameter && spec.kind != ArgumentSpec::Kind::Choice) continue;
    const std::string word = bareWord(*c.arguments[i]);
    reason += " " + word;
    if (spec.kind != ArgumentSpec::Kind::Parameter) continue;
    family = spec.family;
    if (const auto mapped = context_.keywords.hostInput(family, word)) host = std::string(*mapped);
  }
  if (!host || text) return opaque(state, "", {}, reason, text);
  // The number before the parameter says of which tool or operation: only the cycle's own is the host's.
  if (specAt(signature, 0)->kind == ArgumentSpec::Kind::Value) {
    lenient_ = true;
    const auto number = evaluate(state, *c.arguments[0]);
    lenient_ = false;
    fault_.reset();
    const Symbol* symbol = number ? symbolIn(*number) : nullptr;
    const auto toolNumber = context_.hosts.find("tool_number");
    const bool known = toolNumber != context_.hosts.end() && !state.written.contains("tool_number") &&
                       number && *number == Value(toolNumber->second);
    const bool own = isOwn(family, symbol) || (family.starts_with("tool") && known);
    if (!own)
      return opaque(state, "", {}, reason + " of number " + (number ? canonical(*number) : "?"), false);
  }
  if (const auto written = state.written.find(*host); written != state.written.end()) return written->second;
  if (const auto known = context_.hosts.find(*host); known != context_.hosts.end()) return known->second;
  return sourceValue(Symbol::host(*host));
}

} // namespace dotek::frontend::gibbs
