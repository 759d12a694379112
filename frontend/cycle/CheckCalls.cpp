#include "frontend/cycle/Checker.h"
#include "support/NearestName.h"
#include "support/messages/Cycle.h"

#include <map>

namespace dotek::frontend::cycle {
namespace {

// Calls of a block and the blocks within it.
template <class Visit> void eachCall(const Block& block, const Visit& visit) {
  for (const Statement& statement : block.statements) {
    if (const auto* call = std::get_if<Call>(&statement.node)) visit(*call);
    if (const auto* choice = std::get_if<If>(&statement.node)) {
      for (const If::Part& part : choice->parts)
        eachCall(part.body, visit);
      if (choice->otherwise != nullptr) eachCall(*choice->otherwise, visit);
    }
    if (const auto* touch = std::get_if<Touch>(&statement.node);
        touch != nullptr && touch->otherwise != nullptr)
      eachCall(*touch->otherwise, visit);
    if (const auto* repeat = std::get_if<Repeat>(&statement.node)) eachCall(repeat->body, visit);
    if (const auto* loop = std::get_if<For>(&statement.node)) eachCall(loop->body, visit);
    if (const auto* loop = std::get_if<While>(&statement.node)) eachCall(loop->body, visit);
  }
}

} // namespace

// A cycle that comes back to this one.
bool Checker::callsItself(const File& file, std::set<std::string>& seen) const {
  const Header* own = file_.header();
  bool found = false;
  eachCall(file.body, [&](const Call& call) {
    if (own != nullptr && call.cycle.text == own->name.text) found = true;
    if (found || !seen.insert(call.cycle.text).second) return;
    const File* called = find_(call.cycle.text);
    if (called != nullptr && callsItself(*called, seen)) found = true;
  });
  return found;
}

void Checker::call(const Call& call, Known& known) {
  const Header* own = file_.header();
  const bool self = own != nullptr && call.cycle.text == own->name.text;
  const File* called = self ? nullptr : find_(call.cycle.text);
  std::set<std::string> seen;
  if (self || (called != nullptr && callsItself(*called, seen)))
    diagnostics_.report<diag::CycleRecursion>(call.cycle.range, call.cycle.text);
  else if (called == nullptr)
    diagnostics_.report<diag::UnknownCycle>(call.cycle.range, call.cycle.text);
  std::map<std::string, const Parameter*> parameters;
  if (called != nullptr)
    for (const Statement& statement : called->body.statements)
      if (const auto* parameter = std::get_if<Parameter>(&statement.node))
        for (const Name& name : parameter->names)
          parameters.emplace(name.text, parameter);
  std::set<std::string> given;
  for (const Argument& argument : call.arguments) {
    if (!given.insert(argument.name.text).second)
      diagnostics_.report<diag::ArgumentTwice>(argument.name.range, argument.name.text);
    const auto at = parameters.find(argument.name.text);
    if (at != parameters.end()) {
      want(*argument.value, quantityOf(at->second->type), "`" + argument.name.text + "`", known);
      continue;
    }
    if (called != nullptr) {
      const std::string near = nearestName(argument.name.text, parameters);
      diagnostics_.report<diag::UnknownArgument>(argument.name.range, call.cycle.text, argument.name.text,
                                                 near.empty() ? "" : "; did you mean `" + near + "`?");
    }
    if (called != nullptr || !self) quantity(*argument.value, known);
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
