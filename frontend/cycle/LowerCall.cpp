#include "frontend/cycle/Lowering.h"
#include "frontend/cycle/Walk.h"
#include "ir/Kinds.h"
#include "ir/Match.h"
#include "support/messages/Cycle.h"

namespace dotek::frontend::cycle {
namespace {

bool switchesProbe(const Block& block) {
  bool out = false;
  eachStatement(block,
                [&](const Statement& one) { out = out || std::holds_alternative<ProbeSwitch>(one.node); });
  return out;
}

} // namespace

bool Lowering::callMacro(const Call& call, SourceRange range) {
  if (macros_ == nullptr) return false;
  const auto found = macros_->find(call.called);
  if (found == macros_->end()) return false;
  const MacroCycle& macro = found->second;
  // A parameter that is left out, or handed on and perhaps absent, would be what the macro takes for it.
  if (!call.handedOn.empty() || call.arguments.size() != macro.parameters.size()) return false;
  ir::CallCycle out = macro.call;
  Scope inner;
  inner.prefix = scope_.prefix + call.cycle.text + "_";
  inner.inlined = true;
  for (const Argument& argument : call.arguments) {
    ir::CycleArgument given = macro.parameters.at(argument.name.text);
    given.value = value(*argument.value);
    Meaning& meaning = inner.names[argument.name.text];
    meaning.value = given.value;
    meaning.kind = kindOf(*argument.value);
    meaning.given = true;
    if (argument.name.text == macro.below)
      given.value = ir::binary(ir::BinaryOp::Subtract, here(ir::Axis::Z, range), given.value, range);
    out.arguments.push_back(std::move(given));
  }
  // What the cycle demands the macro does not ask for.
  std::swap(scope_, inner);
  for (const Statement* const one : cycle::declarations(*call.called)) {
    if (const auto* parameter = std::get_if<Parameter>(&one->node)) clauses(*parameter);
    if (const auto* require = std::get_if<Require>(&one->node))
      demand(*require->condition, require->message ? require->message->text : "require not met", one->range);
  }
  std::swap(scope_, inner);
  // The call is all that these do.
  std::vector<SourceRange>& ranges = emit(std::move(out), range).origin.ranges;
  eachStatement(call.called->body, [&](const Statement& one) {
    if (std::holds_alternative<Touch>(one.node) || std::holds_alternative<Move>(one.node))
      ranges.push_back(one.range);
  });
  ++macroCalls_;
  if (!call.result) return true;
  Meaning& meaning = scope_.names[call.result->text];
  for (const auto& [name, result] : macro.results) {
    Meaning& one = meaning.members[name];
    if (!one.variable) { // else it is another call of this name
      one.kind = ir::resultKind(result);
      one.variable = local(call.result->text + "_" + name, one.kind, call.result->range);
      one.value = ir::variable(*one.variable, call.result->range);
      touched_.insert(*one.variable);
    }
    emit(ir::Assign{*one.variable, ir::result(result, range)}, range);
  }
  return true;
}

void Lowering::call(const Call& call, SourceRange range) {
  const File* called = call.called;
  if (called == nullptr || called->hasErrorNodes) {
    refuse<diag::UnknownCycle>(call.cycle.range, call.cycle.text);
    return;
  }
  if (depth_ >= kMostCalls) {
    if (!failed_) refuse<diag::CycleTooLong>(range, kMostStatements);
    return;
  }
  if (switchesProbe(called->body) && probe_ == Probe::Either)
    refuse<diag::ProbeUncertain>(call.cycle.range, call.cycle.text);
  if (callMacro(call, range)) return;

  Scope inner;
  inner.prefix = scope_.prefix + (call.result ? call.result->text : call.cycle.text) + "_";
  inner.inlined = true;
  inner.keepsProbe = probe_ == Probe::On;
  inner.begin = out_->size();
  if (call.result) // of a call before, whose results have their variables
    if (const auto before = scope_.names.find(call.result->text); before != scope_.names.end())
      inner.names = before->second.members;

  const std::vector<const Statement*> declared = cycle::declarations(*called);
  std::map<std::string, ir::ExpressionPtr, std::less<>> values;
  std::map<std::string, std::optional<bool>, std::less<>> handed; // whether the caller has it himself
  const auto eachName = [&](const auto& visit) {
    for (const Statement* const one : declared)
      if (const auto* parameter = std::get_if<Parameter>(&one->node))
        for (const Name& name : parameter->names)
          visit(*parameter, name);
  };
  const auto choicesOfType = [](const Type& type) {
    return type.name == TypeName::Choice ? &type.choices : nullptr;
  };
  // The arguments, as the caller reads them, in the order in which he writes them.
  const auto take = [&](const Argument& argument) {
    eachName([&](const Parameter& parameter, const Name& name) {
      if (name.text != argument.name.text) return;
      const Meaning* const own = meaningOf(*argument.value);
      handed[name.text] = own != nullptr && parameter.optional ? own->given : std::optional(true);
      const ir::ExpressionPtr read = value(*argument.value, choicesOfType(parameter.type));
      const auto* use = std::get_if<ir::VariableUse>(&read->node);
      // A parameter is never assigned, so it needs no copy.
      const bool lasts = use != nullptr && cycle_.variable(use->variable).role != ir::Role::Local;
      values[name.text] = lasts ? read
                                : kept(read, inner.prefix.substr(scope_.prefix.size()) + name.text,
                                       kindOf(*argument.value), argument.name.range);
    });
  };
  for (const Argument& argument : call.arguments)
    take(argument);
  for (const Argument& argument : call.handedOn)
    take(argument);

  const bool apart = isProgram(call);
  Outline outline;
  if (apart) {
    outline.called = called;
    outline.probeOn = probe_ == Probe::On;
    outline.range = range;
    eachName([&](const Parameter&, const Name& name) {
      const auto argument = values.find(name.text);
      if (argument != values.end() && handed[name.text] != false)
        outline.arguments.emplace_back(name.text, argument->second);
    });
    leaveResults(known_, range); // an alarm of the called cycle leaves them, too
    outline.begin = label("call", range);
    outline.end = label("called", range);
    place(outline.begin, range);
  }
  inner.begin = out_->size();
  Scope outer = std::move(scope_);
  scope_ = std::move(inner);
  if (depth_++ == 0) {
    sites_.push_back({range, call.cycle.text});
    site_ = static_cast<std::uint32_t>(sites_.size());
  }
  for (const Statement* const statement : declared) {
    const Statement& one = *statement;
    if (const auto* parameter = std::get_if<Parameter>(&one.node)) {
      for (const Name& name : parameter->names) {
        Meaning meaning;
        meaning.choices = choicesOfType(parameter->type);
        meaning.kind = kindOfType(parameter->type.name);
        const auto argument = values.find(name.text);
        meaning.given = argument != values.end() ? handed[name.text] : parameter->value != nullptr;
        if (argument != values.end())
          meaning.value = argument->second;
        else if (parameter->value != nullptr)
          meaning.value =
              kept(value(*parameter->value, meaning.choices), name.text, meaning.kind, name.range);
        else
          meaning.value = ir::constant(0, name.range); // nothing reads it
        if (const auto* use = std::get_if<ir::VariableUse>(&meaning.value->node);
            use != nullptr && cycle_.variable(use->variable).kind == ir::Kind::Number)
          cycle_.variables[use->variable].kind = meaning.kind;
        scope_.names[name.text] = meaning;
      }
      clauses(*parameter);
    }
    if (const auto* result = std::get_if<Result>(&one.node)) this->result(*result);
    if (const auto* require = std::get_if<Require>(&one.node))
      demand(*require->condition, require->message ? require->message->text : "require not met", one.range);
  }
  declareTouches(called->body);
  block(called->body);
  if (--depth_ == 0) site_ = 0;
  if (apart) {
    place(outline.end, range);
    for (const Statement* const one : declared)
      if (const auto* result = std::get_if<Result>(&one->node))
        for (const Name& name : result->names)
          outline.results.emplace_back(name.text, *scope_.names.at(name.text).variable);
    outlines_.push_back(std::move(outline));
  }
  inner = std::move(scope_);
  scope_ = std::move(outer);
  for (std::size_t i = 0; i < 3; ++i)
    scope_.shifted[i] = scope_.shifted[i] || inner.shifted[i];
  if (!call.result) return;
  Meaning& out = scope_.names[call.result->text];
  for (const Statement* const one : declared)
    if (const auto* result = std::get_if<Result>(&one->node))
      for (const Name& name : result->names)
        out.members[name.text] = inner.names.at(name.text);
}

} // namespace dotek::frontend::cycle
