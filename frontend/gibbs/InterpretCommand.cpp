#include "frontend/gibbs/CommandShape.h"
#include "frontend/gibbs/Interpreter.h"

#include "support/Decimal.h"
#include "support/messages/Gibbs.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

using stdlib::ArgumentSpec;
using stdlib::CommandSignature;

Interpreter::Flow Interpreter::command(State& state, const Command& c, SourceRange range) {
  std::string name = foldCase(c.name.text);
  if (const auto renamed = around_.keywords.renamedTo(name)) name = foldCase(std::string(*renamed));
  if (name == "MESSAGE") return showMessage(state, c, range);
  if (name == "STOP") {
    const Flow flow = showMessage(state, c, range);
    return flow == Flow::Next ? stop(range) : flow;
  }
  if (name == "DIALOG") return showDialog(state, c, range);
  if (name == "DEGREES" || name == "RADIANS") {
    state.angles = name == "DEGREES" ? ir::AngleUnit::Degrees : ir::AngleUnit::Radians;
    return Flow::Next;
  }
  if (name == "SWAP_VALUES") return swapValues(state, c, range);
  if (name == "ADD_CUSTOM_DRILL_CYCLE_PATH" && purpose_ == Purpose::ToolPath) return addMove(state, c, range);
  if (asksUser(name)) return needsUser(c, name);
  if (!around_.keywords.isCommand(name)) return unknownCommand(state, c, name);
  return tableCommand(state, c, name);
}

Interpreter::Flow Interpreter::showMessage(State& state, const Command& c, SourceRange range) {
  std::vector<std::optional<std::string>> parts;
  for (const ExpressionPtr& argument : c.arguments) {
    const auto value = evaluate(state, *argument);
    if (!value) return Flow::Failed;
    const Encoding encoding = range.hasPlace() ? around_.sources.file(range.file).encoding() : Encoding::Utf8;
    if (const auto* text = std::get_if<std::string>(&*value))
      parts.emplace_back(toUtf8(*text, encoding));
    else if (const double* number = numberIn(*value))
      parts.emplace_back(numberText(*number));
    else
      parts.emplace_back();
  }
  return show(state, c, parts, range);
}

Interpreter::Flow Interpreter::swapValues(State& state, const Command& c, SourceRange range) {
  const auto* a = c.arguments.size() == 2 ? std::get_if<VariableRef>(&c.arguments[0]->node) : nullptr;
  const auto* b = c.arguments.size() == 2 ? std::get_if<VariableRef>(&c.arguments[1]->node) : nullptr;
  if (a == nullptr || b == nullptr) {
    refuse(range, "SWAP_VALUES takes two variables");
    return Flow::Failed;
  }
  const auto first = read(state, *a);
  const auto second = first ? read(state, *b) : std::nullopt;
  if (!second) return Flow::Failed;
  const Value safe = kept(*first, range);
  return write(state, *a, *second, range) && write(state, *b, safe, range) ? Flow::Next : Flow::Failed;
}

// ---- the dialog -----------------------------------------------------------------------------------------

std::optional<std::string> Interpreter::dialogName(State& state, const Command& c, SourceRange range,
                                                   const Dialog** dialog) {
  std::string name = std::to_string(range.file) + ":" + std::to_string(range.begin);
  if (c.arguments.empty()) return name;
  const auto value = evaluateText(state, *c.arguments[0]);
  if (!value) return std::nullopt;
  const std::string* text = std::get_if<std::string>(&*value);
  if (text == nullptr) return name;
  if (dialog != nullptr && around_.loadDialog) *dialog = around_.loadDialog(*text, c.arguments[0]->range);
  return foldCase(*text);
}

Interpreter::Flow Interpreter::showDialog(State& state, const Command& c, SourceRange range) {
  if (purpose_ == Purpose::ToolPath) return needsUser(c, "DIALOG");
  const Dialog* dialog = nullptr;
  const auto name = dialogName(state, c, range, &dialog);
  if (!name) return Flow::Failed;
  if (state.dialogs.contains(*name)) return dialogAgain(state, range);
  dialogOpens(state, range);
  state.dialogs.insert(*name);
  state.globals["BUTTON"] = 0.0; // OK
  return takeInputs(state, dialog, range) ? Flow::Next : Flow::Failed;
}

// The inputs get their values: those of fields what was typed in, others their default.
bool Interpreter::takeInputs(State& state, const Dialog* dialog, SourceRange range) {
  if (dialog == nullptr) return storeFields(state, range);
  for (const Control& control : dialog->controls) {
    if (!control.variable) continue;
    const std::string key = foldCase(control.variable->text);
    if (isField(key)) {
      if (!storeField(state, key, range)) return false;
      continue;
    }
    // No field of the cycle: the user's entry is the default, or not known.
    std::optional<Value> value;
    if (control.initial != nullptr) {
      value = evaluate(state, *control.initial);
      if (!value) return false;
    } else {
      value = opaque(state, "dialog " + key, {}, "the dialog's input " + control.variable->text,
                     control.variable->isText(), range);
    }
    if (!write(state, {*control.variable, nullptr, 0}, std::move(*value), range)) return false;
  }
  return dialogCloses(state, range);
}

// ---- moves ----------------------------------------------------------------------------------------------

Interpreter::Flow Interpreter::addMove(State& state, const Command& c, SourceRange range) {
  const std::string word = c.arguments.empty() ? "" : bareWord(*c.arguments[0]);
  constexpr std::array kKinds = {"FEED", "FEED_X", "FEED_Y", "FEED_Z"};
  const auto found = std::find(kKinds.begin(), kKinds.end(), word);
  if (found == kKinds.end()) {
    const SourceRange where = c.arguments.empty() ? range : c.arguments[0]->range;
    fault<diag::PathKindUnknown>(where, false, c.arguments.empty() ? "" : around_.sources.textUtf8(where));
    return Flow::Failed;
  }
  const auto kind = static_cast<PathMove::Kind>(found - kKinds.begin());
  const bool all = kind == PathMove::Kind::Feed;
  if (c.arguments.size() != (all ? 4u : 2u)) {
    refuse(range, "a move of this kind takes another number of coordinates");
    return Flow::Failed;
  }
  std::array<std::optional<Value>, 3> axes;
  for (std::size_t i = 1; i < c.arguments.size(); ++i) {
    const auto value = evaluateNumber(state, *c.arguments[i]);
    if (!value) return Flow::Failed;
    auto& axis = axes[all ? i - 1 : static_cast<std::size_t>(kind) - 1];
    axis = coordinate(*value, c.arguments[i]->range);
    if (!axis) return Flow::Failed;
  }
  return addMove(kind, axes, range) ? Flow::Next : Flow::Failed;
}

// ---- commands of the table ------------------------------------------------------------------------------

Interpreter::Flow Interpreter::unknownCommand(State& state, const Command& c, const std::string& name) {
  for (const ExpressionPtr& argument : c.arguments) {
    const auto* ref = std::get_if<VariableRef>(&argument->node);
    if (ref == nullptr || ref->index) continue;
    const std::string key = foldCase(ref->name.text);
    if (!state.frames.back().locals.contains(key) &&
        (around_.keywords.isConstant(key) || around_.keywords.isSystemVariable(key)))
      continue;
    const Value unknown = opaque(state, "", {}, name, ref->name.isText(), argument->range);
    if (!write(state, *ref, unknown, argument->range)) return Flow::Failed;
  }
  reportOnce(makeDiagnostic<diag::UnknownCommandRun>(c.name.range, name));
  return Flow::Next;
}

// Nothing without a fault: the value has no effect, so that what it lacks is none of ours.
std::optional<Value> Interpreter::evaluateLeniently(State& state, const Expression& e) {
  lenient_ = true;
  auto value = evaluate(state, e);
  lenient_ = false;
  if (!value && fault_ && !fault_->catchable) fault_.reset();
  return value;
}

Interpreter::Flow Interpreter::tableCommand(State& state, const Command& c, const std::string& name) {
  const auto signatures = around_.keywords.commands(name);
  const auto fitting = std::find_if(signatures.begin(), signatures.end(),
                                    [&](const CommandSignature* s) { return fits(*s, c); });
  if (fitting == signatures.end()) return signatures.empty() ? Flow::Next : unknownCommand(state, c, name);
  const CommandSignature& signature = **fitting;
  for (std::size_t i = 0; i < c.arguments.size(); ++i) {
    const ArgumentSpec& spec = *specAt(signature, i);
    if (spec.kind != ArgumentSpec::Kind::Value || spec.array) continue;
    const Expression& argument = *c.arguments[i];
    const auto value = evaluateLeniently(state, argument);
    if (fault_) return Flow::Failed;
    // A host input that the macro changes is no longer the one that is given.
    const ArgumentSpec* parameter = i > 0 ? specAt(signature, i - 1) : nullptr;
    if (parameter == nullptr || parameter->kind != ArgumentSpec::Kind::Parameter) continue;
    const auto host = around_.keywords.hostInput(parameter->family, bareWord(*c.arguments[i - 1]));
    if (!host) continue;
    state.written.insert_or_assign(std::string(*host),
                                   value ? *value : opaque(state, "", {}, name, false, argument.range));
  }
  for (std::size_t i = 0; i < c.arguments.size(); ++i) {
    const ArgumentSpec& spec = *specAt(signature, i);
    if (!isWritten(spec)) continue;
    const SourceRange range = c.arguments[i]->range;
    const auto* ref = std::get_if<VariableRef>(&c.arguments[i]->node);
    if (ref == nullptr) {
      refuse(range, "the command writes its result to what is no variable");
      return Flow::Failed;
    }
    if (spec.array && !ref->index) {
      fillArray(state, *ref, name);
      continue;
    }
    if (!write(state, *ref, dataValue(state, c, signature, name, ref->name.isText()), range))
      return Flow::Failed;
  }
  return Flow::Next;
}

// What a command gives: a host input where its parameter names one of the cycle's own operation or tool.
Value Interpreter::dataValue(State& state, const Command& c, const CommandSignature& signature,
                             const std::string& name, bool text) {
  std::string reason = name;
  std::string family;
  std::optional<std::string> host;
  for (std::size_t i = 0; i < c.arguments.size(); ++i) {
    const ArgumentSpec& spec = *specAt(signature, i);
    if (spec.kind != ArgumentSpec::Kind::Parameter && spec.kind != ArgumentSpec::Kind::Choice) continue;
    const std::string word = bareWord(*c.arguments[i]);
    reason += " " + word;
    if (spec.kind != ArgumentSpec::Kind::Parameter) continue;
    family = spec.family;
    if (const auto mapped = around_.keywords.hostInput(family, word)) host = std::string(*mapped);
  }
  const SourceRange range = c.name.range;
  if (!host || text) return opaque(state, "", {}, reason, text, range);
  // The number before the parameter says of which tool or operation: only the cycle's own is the host's.
  if (specAt(signature, 0)->kind == ArgumentSpec::Kind::Value) {
    const auto number = evaluateLeniently(state, *c.arguments[0]);
    fault_.reset();
    const double* tool = knownHost("tool_number");
    const bool given =
        tool != nullptr && !state.written.contains("tool_number") && number && *number == Value(*tool);
    if (!isOwn(family, number ? symbolIn(*number) : nullptr) && !(family.starts_with("tool") && given)) {
      const std::string which = around_.sources.textUtf8(c.arguments[0]->range);
      return opaque(state, "", {}, reason + " of number `" + which + "`", false, range);
    }
  }
  if (state.written.contains(*host)) return writtenHost(state, *host, reason, range);
  const double* known = knownHost(*host);
  return known != nullptr ? Value(*known) : sourceValue(Symbol::host(*host));
}

const double* Interpreter::knownHost(const std::string& name) const {
  if (around_.hosts == nullptr) return nullptr;
  const auto found = around_.hosts->find(name);
  return found == around_.hosts->end() ? nullptr : &found->second;
}

Value Interpreter::writtenHost(State& state, const std::string& host, const std::string&, SourceRange) {
  return state.written.at(host);
}

} // namespace dotek::frontend::gibbs
