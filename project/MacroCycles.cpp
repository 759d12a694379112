#include "project/MacroCycles.h"

#include "frontend/cycle/Check.h"
#include "frontend/cycle/Link.h"
#include "stdlib/MacroCycle.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace dotek::project {

namespace cycle = frontend::cycle;

namespace {

std::optional<cycle::MacroCycle> carriedOut(const cycle::File& file,
                                            const stdlib::MacroSignature& signature) {
  const stdlib::CycleFacts facts = stdlib::cycleFacts(signature);
  cycle::MacroCycle out;
  out.call.cycle = std::string(stdlib::intentName(signature.intent));
  out.call.axis = stdlib::axisOf(signature);
  out.call.moves = facts.moves;
  out.call.returns = facts.returns;
  std::size_t required = 0;
  for (const cycle::Statement* const one : cycle::declarations(file)) {
    if (const auto* parameter = std::get_if<cycle::Parameter>(&one->node))
      for (const cycle::Name& name : parameter->names) {
        const auto letter =
            std::find_if(signature.arguments.begin(), signature.arguments.end(), [&](const auto& argument) {
              return stdlib::languageName(roleName(argument.role)) == name.text;
            });
        // A place is a coordinate for the macro, and nothing of the kind for a cycle of the language.
        if (letter == signature.arguments.end() || !letter->unknown.empty() ||
            letter->role == stdlib::ArgumentRole::Target)
          return std::nullopt;
        required += letter->required ? 1 : 0;
        if (letter->role == stdlib::ArgumentRole::Depth) out.below = name.text;
        out.parameters[name.text] = {stdlib::parameterName(*letter), nullptr, std::nullopt, letter->kind,
                                     stdlib::movesProbe(letter->role)};
      }
    if (const auto* result = std::get_if<cycle::Result>(&one->node))
      for (const cycle::Name& name : result->names) {
        const auto left =
            std::find_if(signature.results.begin(), signature.results.end(), [&](const auto& candidate) {
              return candidate.documented && candidate.name &&
                     stdlib::languageName(outputName(candidate.output)) == name.text;
            });
        if (left == signature.results.end()) return std::nullopt;
        out.results[name.text] = *left->name;
        out.call.results.push_back(*left->name);
      }
  }
  const auto demanded = std::count_if(signature.arguments.begin(), signature.arguments.end(),
                                      [](const auto& argument) { return argument.required; });
  if (required != static_cast<std::size_t>(demanded) || !signature.unknown.empty()) return std::nullopt;
  return out;
}

} // namespace

std::map<const cycle::File*, cycle::MacroCycle> macroCycles(const stdlib::MacroSet& set, CycleFiles& files) {
  std::map<const cycle::File*, cycle::MacroCycle> out;
  for (const stdlib::MacroSignature& signature : set.signatures) {
    const cycle::File* const file = files.library(stdlib::libraryCycle(signature));
    if (file == nullptr || file->hasErrorNodes) continue;
    if (std::optional<cycle::MacroCycle> one = carriedOut(*file, signature))
      out.emplace(file, std::move(*one));
  }
  return out;
}

std::map<std::string, ir::Cycle, std::less<>>
measuringCycles(const std::vector<const stdlib::MacroSet*>& sets, Session& session) {
  std::map<std::string, ir::Cycle, std::less<>> out;
  CycleFiles files(session);
  const auto add = [&](const std::string& name) {
    if (out.contains(name)) return;
    const cycle::File* const file = files.library(name);
    if (file == nullptr || file->hasErrorNodes) return;
    Diagnostics found;
    cycle::check(*file, session.sources(), found);
    if (!found.hasErrors())
      if (auto lowered = cycle::lower(*file, session.sources(), found))
        out.emplace(name, std::move(lowered->cycle));
    for (Diagnostic& one : found.all())
      session.diagnostics().add(std::move(one));
  };
  for (const stdlib::MacroSet* const set : sets) {
    if (set == nullptr) continue;
    for (const stdlib::MacroSignature& signature : set->signatures) {
      add(stdlib::libraryCycle(signature));
      add(stdlib::islandCycle(signature));
    }
  }
  return out;
}

} // namespace dotek::project
