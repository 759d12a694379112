#include "frontend/cycle/Checker.h"
#include "frontend/cycle/Link.h"
#include "frontend/cycle/Words.h"
#include "support/WriteInstead.h"
#include "support/messages/Cycle.h"

#include <algorithm>
#include <map>

namespace dotek::frontend::cycle {

namespace {

bool usesOptions(const File& file, const std::string& name) {
  return std::any_of(file.body.statements.begin(), file.body.statements.end(), [&](const Statement& one) {
    const auto* use = std::get_if<Use>(&one.node);
    return use != nullptr && use->name.text == name;
  });
}

bool needsProbe(const File& file) {
  return std::any_of(file.body.statements.begin(), file.body.statements.end(),
                     [](const Statement& one) { return std::holds_alternative<Needs>(one.node); });
}

} // namespace

// A cycle that comes back to this one.
bool Checker::callsItself(const File& file, std::set<const File*>& seen) const {
  for (const Call* call : callsOf(file.body)) {
    if (call->called == nullptr) continue;
    if (call->called == &file_) return true;
    if (seen.insert(call->called).second && callsItself(*call->called, seen)) return true;
  }
  return false;
}

void Checker::argument(const Argument& argument, const Parameter& parameter, const Known& known) {
  // What the caller may have left out may be left out of the call as well.
  Known handed = known;
  const auto* use = std::get_if<NameUse>(&argument.value->node);
  if (use != nullptr && parameter.optional) handed.given.insert(use->name);
  want(*argument.value, quantityOf(parameter.type), "`" + argument.name.text + "`", handed);
}

void Checker::call(const Call& call, Known& known) {
  const Header* own = file_.header();
  const bool self = own != nullptr && call.cycle.text == own->name.text;
  const File* called = self ? nullptr : call.called;
  const Header* header = called == nullptr ? nullptr : called->header();
  std::set<const File*> seen;
  if (self || (called != nullptr && callsItself(*called, seen)))
    diagnostics_.report<diag::CycleRecursion>(call.cycle.range, call.cycle.text);
  else if (called == nullptr)
    diagnostics_.report<diag::UnknownCycle>(call.cycle.range, call.cycle.text);
  else if (header != nullptr && header->options)
    diagnostics_.report<diag::CallOfOptions>(call.cycle.range, call.cycle.text);
  if (called != nullptr && needsProbe(*called) && known.probe != ProbeState::On && !known.ended)
    diagnostics_.report<diag::TouchWithProbeOff>(call.cycle.range, "calls a cycle that touches",
                                                 known.probe == ProbeState::Off ? "" : " on some paths");
  // What is broken may be the declaration that is missing.
  if (called != nullptr && called->hasErrorNodes) called = nullptr;
  std::map<std::string, const Parameter*> parameters;
  if (called != nullptr)
    for (const Statement* statement : declarations(*called))
      if (const auto* parameter = std::get_if<Parameter>(&statement->node))
        for (const Name& name : parameter->names)
          parameters.emplace(name.text, parameter);
  std::set<std::string> given;
  for (const Argument& one : call.arguments) {
    if (!given.insert(one.name.text).second)
      diagnostics_.report<diag::ArgumentTwice>(one.name.range, one.name.text);
    const auto at = parameters.find(one.name.text);
    if (at != parameters.end()) {
      argument(one, *at->second, known);
      continue;
    }
    if (called != nullptr) {
      const std::string near = nameLike(one.name.text, parameters);
      std::string names;
      for (const auto& taken : parameters)
        names += (names.empty() ? "; it has `" : ", `") + taken.first + "`";
      diagnostics_
          .report<diag::UnknownArgument>(one.name.range, call.cycle.text, one.name.text,
                                         near.empty() ? names : "; did you mean `" + near + "`?")
          .fix = writeInstead(one.name.range, near);
      given.insert(near); // what is meant by it is not missing
    }
    if (!self) quantity(*one.value, known);
  }
  for (const Name& options : call.uses)
    if (!usesOptions(file_, options.text) || (called != nullptr && !usesOptions(*called, options.text)))
      diagnostics_.report<diag::OptionsNotShared>(options.range, options.text, call.cycle.text);
  for (const Argument& one : call.handedOn) {
    given.insert(one.name.text);
    if (const auto at = symbols_.find(one.name.text); at != symbols_.end()) at->second.read = true;
  }
  std::string missing;
  for (const auto& [name, parameter] : parameters)
    if (!parameter->optional && parameter->value == nullptr && !given.contains(name))
      missing += (missing.empty() ? "`" : ", `") + name + "`";
  if (!missing.empty())
    diagnostics_.report<diag::ArgumentMissing>(call.cycle.range, call.cycle.text, missing);
  if (!call.result) return;
  Symbol symbol;
  symbol.role = Symbol::Role::Call;
  symbol.cycle = called;
  gives(*call.result, symbol, known);
}

} // namespace dotek::frontend::cycle
