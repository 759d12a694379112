#include "frontend/cycle/Link.h"
#include "frontend/cycle/Walk.h"

#include <algorithm>

namespace dotek::frontend::cycle {
namespace {

template <class Blocks, class Visit> void eachCall(Blocks& block, const Visit& visit) {
  eachStatement(block, [&](auto& statement) {
    if (auto* call = std::get_if<Call>(&statement.node)) visit(*call);
  });
}

const File* optionsOf(const File& file, const std::string& name) {
  for (const Statement& statement : file.body.statements) {
    const auto* use = std::get_if<Use>(&statement.node);
    if (use != nullptr && use->name.text == name) return use->options;
  }
  return nullptr;
}

bool isWritten(const Call& call, const std::string& name) {
  return std::any_of(call.arguments.begin(), call.arguments.end(),
                     [&](const Argument& one) { return one.name.text == name; });
}

void handOn(Call& call, const Name& use, const File& options) {
  for (const Statement& statement : options.body.statements) {
    const auto* parameter = std::get_if<Parameter>(&statement.node);
    if (parameter == nullptr) continue;
    for (const Name& name : parameter->names) {
      if (isWritten(call, name.text)) continue;
      auto value = std::make_unique<Expression>();
      value->range = use.range;
      value->node = NameUse{name.text};
      call.handedOn.push_back({{use.range, name.text}, std::move(value)});
    }
  }
}

} // namespace

void link(File& file, const FindCycle& find) {
  for (Statement& statement : file.body.statements)
    if (auto* use = std::get_if<Use>(&statement.node)) use->options = find(use->name.text);
  eachCall(file.body, [&](Call& call) {
    call.called = find(call.cycle.text);
    call.handedOn.clear();
    for (const Name& name : call.uses)
      if (const File* options = optionsOf(file, name.text)) handOn(call, name, *options);
  });
}

std::vector<const Statement*> declarations(const File& file) {
  std::vector<const Statement*> out;
  const auto take = [&](const Statement& one) {
    const bool declares = std::holds_alternative<Parameter>(one.node) ||
                          std::holds_alternative<Result>(one.node) ||
                          std::holds_alternative<Require>(one.node);
    if (declares) out.push_back(&one);
  };
  for (const Statement& statement : file.body.statements) {
    take(statement);
    const auto* use = std::get_if<Use>(&statement.node);
    const Header* header = use == nullptr || use->options == nullptr ? nullptr : use->options->header();
    if (header != nullptr && header->options)
      for (const Statement& one : use->options->body.statements)
        take(one);
  }
  return out;
}

std::vector<const Call*> callsOf(const Block& block) {
  std::vector<const Call*> out;
  eachCall(block, [&](const Call& call) { out.push_back(&call); });
  return out;
}

} // namespace dotek::frontend::cycle
