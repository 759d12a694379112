#include "frontend/gibbs/CommandShape.h"
#include "frontend/gibbs/LowerFlatten.h"

#include "support/Decimal.h"
#include "support/messages/Gibbs.h"

#include <algorithm>
#include <array>

namespace dotek::frontend::gibbs {

using stdlib::ArgumentSpec;
using stdlib::CommandSignature;

Flattener::Flow Flattener::command(State& state, const Command& c, SourceRange range) {
  std::string name = foldCase(c.name.text);
  if (const auto renamed = context_.keywords.renamedTo(name)) name = foldCase(std::string(*renamed));
  if (name == "MESSAGE" || name == "STOP") {
    const Flow flow = showMessage(state, c, range);
    if (flow != Flow::Next || name != "STOP") return flow;
    emit(range, FlatEnd{true});
    return Flow::Ended;
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

Flattener::Flow Flattener::needsUser(const Command& c, const std::string& name) {
  Diagnostic found = makeDiagnostic<diag::NeedsUser>(c.name.range, name);
  if (purpose_ == Purpose::Checks && context_.assumptions.contains("unchecked")) {
    context_.diagnostics.add(std::move(found));
    emit(c.name.range, FlatEnd{false});
    return Flow::Ended;
  }
  found.severity = Severity::Error;
  if (purpose_ == Purpose::Checks) found.note({}, "`--assume unchecked` leaves out what follows it");
  failure_ = std::move(found);
  return Flow::Failed;
}

Flattener::Flow Flattener::showMessage(State& state, const Command& c, SourceRange range) {
  FlatMessage message;
  for (const ExpressionPtr& argument : c.arguments) {
    const auto value = lower(state, *argument);
    if (!value) return Flow::Failed;
    const double* constant =
        value->number ? ir::constantValue(value->number) : std::get_if<double>(&value->fixed);
    const std::string* text = value->number ? nullptr : std::get_if<std::string>(&value->fixed);
    if (constant == nullptr && text == nullptr) {
      message.computed = true;
      continue;
    }
    if (!message.text.empty()) message.text += ' ';
    const Encoding encoding =
        range.hasPlace() ? context_.sources.file(range.file).encoding() : Encoding::Utf8;
    message.text += text != nullptr ? toUtf8(*text, encoding) : numberText(*constant);
  }
  emit(range, std::move(message));
  return Flow::Next;
}

// ---- the dialog -----------------------------------------------------------------------------------------

std::optional<std::string> Flattener::dialogName(State& state, const Command& c, SourceRange range,
                                                 const Dialog** dialog) {
  std::string name = std::to_string(range.file) + ":" + std::to_string(range.begin);
  if (c.arguments.empty()) return name;
  const auto value = lower(state, *c.arguments[0]);
  if (!value) return std::nullopt;
  if (value->number || !isTextValue(value->fixed)) {
    fail<diag::KindMismatchRun>(c.arguments[0]->range, "a number", "a text");
    return std::nullopt;
  }
  const std::string* text = std::get_if<std::string>(&value->fixed);
  if (text == nullptr) return name;
  if (dialog != nullptr && context_.loadDialog) *dialog = context_.loadDialog(*text, c.arguments[0]->range);
  return foldCase(*text);
}

// The next instruction shows a dialog that was shown before.
bool Flattener::showsDialogAgain(State& state) {
  const Frame& frame = state.frames.back();
  if (purpose_ != Purpose::Checks || frame.at >= frame.program->instructions.size()) return false;
  const Instruction& instruction = frame.program->instructions[frame.at];
  const auto* step = std::get_if<CommandStep>(&instruction.step);
  if (step == nullptr || foldCase(step->command->name.text) != "DIALOG") return false;
  const auto name = dialogName(state, *step->command, instruction.range, nullptr);
  failure_.reset();
  return name && state.dialogs.contains(*name);
}

Flattener::Flow Flattener::showDialog(State& state, const Command& c, SourceRange range) {
  if (purpose_ == Purpose::ToolPath) return needsUser(c, "DIALOG");
  const Dialog* dialog = nullptr;
  const auto name = dialogName(state, c, range, &dialog);
  if (!name) return Flow::Failed;
  if (state.dialogs.contains(*name)) {
    const auto& frames = state.frames;
    const bool again = std::any_of(frames.begin(), frames.end() - 1, [&](const Frame& frame) {
      return frame.program == frames.back().program;
    });
    emit(again ? frames.back().called : range, FlatEnd{true, again});
    return Flow::Ended;
  }
  emit(range, FlatDialog{});
  state.dialogs.insert(*name);
  state.fixed["BUTTON"] = 0.0; // OK
  return takeInputs(state, dialog, range) ? Flow::Next : Flow::Failed;
}

// The inputs get their values: those of fields the arguments, others their default.
bool Flattener::takeInputs(State& state, const Dialog* dialog, SourceRange range) {
  if (dialog == nullptr) {
    return std::all_of(fields_.begin(), fields_.end(),
                       [&](const auto& field) { return storeField(state, field.first, range); });
  }
  for (const Control& control : dialog->controls) {
    if (!control.variable) continue;
    const std::string key = foldCase(control.variable->text);
    if (fields_.contains(key)) {
      if (!storeField(state, key, range)) return false;
      continue;
    }
    std::optional<Lowered> value;
    if (control.initial != nullptr) {
      value = lower(state, *control.initial);
      if (!value) return false;
    } else {
      value = Lowered{nullptr, opaqueValue(Symbol::named("dialog " + key), {},
                                           "the dialog's input " + control.variable->text,
                                           control.variable->isText())};
    }
    if (!write(state, {*control.variable, nullptr, 0}, *value, range)) return false;
  }
  // What no input overwrites stays as the macro has set it.
  for (const std::string& field : std::set<std::string>(state.shadowed)) {
    const Name name{range, cycle_.variables[fields_.at(field)].name};
    const auto fixed = state.fixed.find("~" + field);
    const Lowered value = fixed == state.fixed.end()
                              ? Lowered{ir::variable(variableOf("~" + field, name), range)}
                              : Lowered{nullptr, fixed->second};
    state.fixed.erase("~" + field);
    state.shadowed.erase(field);
    const auto given = number(value, range);
    if (!given) return false;
    emit(range, FlatAssign{fields_.at(field), *given});
    state.changed.insert(field);
  }
  return true;
}

bool Flattener::storeField(State& state, const std::string& field, SourceRange range) {
  const ir::VariableId id = fields_.at(field);
  if (state.changed.contains(field)) {
    fail<diag::CannotTranslate>(range,
                                fmt::format("a second dialog sets `{}`, which was assigned since the first",
                                            cycle_.variables[id].name));
    return false;
  }
  if (state.frames.back().locals.contains(field)) {
    const std::string key = fixedKey(state, field);
    state.fixed.erase(key);
    emit(range, FlatAssign{variableOf(key, {range, cycle_.variables[id].name}), ir::variable(id, range)});
    return true;
  }
  state.fixed.erase("~" + field);
  state.shadowed.erase(field);
  return true;
}

Flattener::Flow Flattener::swapValues(State& state, const Command& c, SourceRange range) {
  const auto* a = c.arguments.size() == 2 ? std::get_if<VariableRef>(&c.arguments[0]->node) : nullptr;
  const auto* b = c.arguments.size() == 2 ? std::get_if<VariableRef>(&c.arguments[1]->node) : nullptr;
  if (a == nullptr || b == nullptr) {
    fail<diag::CannotTranslate>(range, "SWAP_VALUES takes two variables");
    return Flow::Failed;
  }
  auto first = read(state, *a);
  const auto second = first ? read(state, *b) : std::nullopt;
  if (!second) return Flow::Failed;
  if (first->number) {
    const ir::VariableId kept = freshLocal("swap", "swapped");
    emit(range, FlatAssign{kept, first->number});
    first->number = ir::variable(kept, range);
  }
  return write(state, *a, *second, range) && write(state, *b, *first, range) ? Flow::Next : Flow::Failed;
}

// ---- moves ----------------------------------------------------------------------------------------------

Flattener::Flow Flattener::addMove(State& state, const Command& c, SourceRange range) {
  const std::string kind = c.arguments.empty() ? "" : bareWord(*c.arguments[0]);
  constexpr std::array kKinds = {"FEED", "FEED_X", "FEED_Y", "FEED_Z"};
  const auto found = std::find(kKinds.begin(), kKinds.end(), kind);
  if (found == kKinds.end()) {
    const SourceRange where = c.arguments.empty() ? range : c.arguments[0]->range;
    fail<diag::PathKindUnknown>(where, c.arguments.empty() ? "" : context_.sources.textUtf8(where));
    return Flow::Failed;
  }
  FlatMove move;
  move.kind = static_cast<PathMove::Kind>(found - kKinds.begin());
  const bool all = move.kind == PathMove::Kind::Feed;
  if (c.arguments.size() != (all ? 4u : 2u)) {
    fail<diag::CannotTranslate>(range, "a move of this kind takes another number of coordinates");
    return Flow::Failed;
  }
  for (std::size_t i = 1; i < c.arguments.size(); ++i) {
    auto value = lowerNumber(state, *c.arguments[i]);
    if (!value) return Flow::Failed;
    move.axes[all ? i - 1 : static_cast<std::size_t>(move.kind) - 1] = std::move(*value);
  }
  emit(range, std::move(move));
  return Flow::Next;
}

// ---- commands of the table ------------------------------------------------------------------------------

Flattener::Flow Flattener::unknownCommand(State& state, const Command& c, const std::string& name) {
  bool writes = false;
  for (const ExpressionPtr& argument : c.arguments) {
    const auto* ref = std::get_if<VariableRef>(&argument->node);
    if (ref == nullptr || ref->index) continue;
    const std::string key = foldCase(ref->name.text);
    if (!state.frames.back().locals.contains(key) &&
        (context_.keywords.isConstant(key) || context_.keywords.isSystemVariable(key)))
      continue;
    writes = true;
    const Value unknown = opaqueValue(Symbol::place(argument->range), {}, name, ref->name.isText());
    if (!write(state, *ref, {nullptr, unknown}, argument->range)) return Flow::Failed;
  }
  if (writes) context_.diagnostics.report<diag::UnknownCommandRun>(c.name.range, name);
  return Flow::Next;
}

Flattener::Flow Flattener::tableCommand(State& state, const Command& c, const std::string& name) {
  const auto signatures = context_.keywords.commands(name);
  const auto fitting = std::find_if(signatures.begin(), signatures.end(),
                                    [&](const CommandSignature* s) { return fits(*s, c); });
  if (fitting == signatures.end()) return signatures.empty() ? Flow::Next : unknownCommand(state, c, name);
  const CommandSignature& signature = **fitting;
  for (std::size_t i = 1; i < c.arguments.size(); ++i) {
    const ArgumentSpec* parameter = specAt(signature, i - 1);
    if (specAt(signature, i)->kind != ArgumentSpec::Kind::Value ||
        parameter->kind != ArgumentSpec::Kind::Parameter)
      continue;
    // A host input that the macro changes is no longer the one that is given.
    const auto host = context_.keywords.hostInput(parameter->family, bareWord(*c.arguments[i - 1]));
    if (host) state.written.insert(std::string(*host));
  }
  for (std::size_t i = 0; i < c.arguments.size(); ++i) {
    const ArgumentSpec& spec = *specAt(signature, i);
    if (!isWritten(spec)) continue;
    const auto* ref = std::get_if<VariableRef>(&c.arguments[i]->node);
    if (ref == nullptr) {
      fail<diag::CannotTranslate>(c.arguments[i]->range,
                                  "the command writes its result to what is no variable");
      return Flow::Failed;
    }
    if (spec.array && !ref->index) continue; // elements are refused where they are read
    const Value value = dataValue(state, c, signature, name, ref->name.isText());
    if (!write(state, *ref, {nullptr, value}, c.arguments[i]->range)) return Flow::Failed;
  }
  return Flow::Next;
}

// What a command gives: a host input where its parameter names one of the cycle's own operation or tool.
Value Flattener::dataValue(State& state, const Command& c, const CommandSignature& signature,
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
    if (const auto mapped = context_.keywords.hostInput(family, word)) host = std::string(*mapped);
  }
  const auto unknown = [&](const std::string& why) {
    return opaqueValue(Symbol::place(c.name.range), {}, why, text);
  };
  if (!host || text) return unknown(reason);
  // The number before the parameter says of which tool or operation: only the cycle's own is the host's.
  if (specAt(signature, 0)->kind == ArgumentSpec::Kind::Value) {
    lenient_ = true;
    const auto number = lower(state, *c.arguments[0]);
    lenient_ = false;
    failure_.reset();
    if (!isOwn(family, number && !number->number ? symbolIn(number->fixed) : nullptr)) {
      const std::string which = context_.sources.textUtf8(c.arguments[0]->range);
      return unknown(reason + " of number `" + which + "`");
    }
  }
  return state.written.contains(*host) ? unknown(reason + " behind its change")
                                       : sourceValue(Symbol::host(*host));
}

} // namespace dotek::frontend::gibbs
