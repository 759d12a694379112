#include "stdlib/GibbsKeywords.h"

#include "stdlib/GibbsTables.h"
#include "support/NearestName.h"

#include <algorithm>

namespace dotek::stdlib {
namespace {

template <class T> const T* lookUp(const NameMap<T>& map, std::string_view name) {
  const bool folded = std::none_of(name.begin(), name.end(), [](char c) { return upperCase(c) != c; });
  const auto at = folded ? map.find(name) : map.find(upperCase(name));
  return at == map.end() ? nullptr : &at->second;
}

const ParameterKind* lookUpParameter(const NameMap<ParameterFamily>& families, std::string_view family,
                                     std::string_view parameter) {
  const ParameterFamily* found = lookUp(families, family);
  return found == nullptr ? nullptr : lookUp(found->parameters, parameter);
}

std::vector<const CommandSignature*> pointers(const std::vector<CommandSignature>& signatures) {
  std::vector<const CommandSignature*> out;
  out.reserve(signatures.size());
  for (const CommandSignature& signature : signatures)
    out.push_back(&signature);
  return out;
}

bool hasPrefix(const std::vector<std::string>& prefixes, std::string_view name) {
  const std::string upper = upperCase(name);
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const std::string& prefix) { return upper.starts_with(prefix); });
}

std::optional<std::string_view> viewOf(const std::string* text) {
  return text == nullptr ? std::nullopt : std::optional<std::string_view>(*text);
}

} // namespace

GibbsKeywords::GibbsKeywords() = default;
GibbsKeywords::GibbsKeywords(GibbsKeywords&&) noexcept = default;
GibbsKeywords& GibbsKeywords::operator=(GibbsKeywords&&) noexcept = default;
GibbsKeywords::~GibbsKeywords() = default;

std::vector<const CommandSignature*> GibbsKeywords::commands(std::string_view name) const {
  const Tables::Command* command = lookUp(tables_->commands, name);
  return command == nullptr ? std::vector<const CommandSignature*>() : pointers(command->signatures);
}

bool GibbsKeywords::isCommand(std::string_view name) const {
  return lookUp(tables_->commands, name) != nullptr;
}

bool GibbsKeywords::isCore(std::string_view name) const {
  const Tables::Command* command = lookUp(tables_->commands, name);
  if (command != nullptr) return command->core;
  return std::find(tables_->coreWords.begin(), tables_->coreWords.end(), upperCase(name)) !=
         tables_->coreWords.end();
}

std::optional<std::string_view> GibbsKeywords::renamedTo(std::string_view name) const {
  return viewOf(lookUp(tables_->renamed, name));
}

std::vector<const CommandSignature*> GibbsKeywords::dialogControls(std::string_view name) const {
  const Tables::Control* control = lookUp(tables_->controls, name);
  return control == nullptr ? std::vector<const CommandSignature*>() : pointers(control->signatures);
}

const FunctionSpec* GibbsKeywords::function(std::string_view name) const {
  return lookUp(tables_->functions, name);
}

bool GibbsKeywords::isParameter(std::string_view family, std::string_view parameter) const {
  return lookUpParameter(tables_->families, family, parameter) != nullptr;
}

bool GibbsKeywords::isTextParameter(std::string_view family, std::string_view parameter) const {
  return parameterKind(family, parameter) == ParameterKind::Text;
}

std::optional<ParameterKind> GibbsKeywords::parameterKind(std::string_view family,
                                                          std::string_view parameter) const {
  const ParameterKind* kind = lookUpParameter(tables_->families, family, parameter);
  return kind == nullptr ? std::nullopt : std::optional(*kind);
}

bool GibbsKeywords::hasFamily(std::string_view family) const {
  return lookUp(tables_->families, family) != nullptr;
}

bool GibbsKeywords::isOpenFamily(std::string_view family) const {
  const ParameterFamily* found = lookUp(tables_->families, family);
  return found != nullptr && found->open;
}

std::optional<std::string_view> GibbsKeywords::hostInput(std::string_view family,
                                                         std::string_view parameter) const {
  return viewOf(lookUp(tables_->hosts, std::string(family) + "." + std::string(parameter)));
}

bool GibbsKeywords::isSystemVariable(std::string_view name) const {
  return lookUp(tables_->variables, name) != nullptr;
}
bool GibbsKeywords::isConstant(std::string_view name) const {
  return lookUp(tables_->constants, name) != nullptr;
}
bool GibbsKeywords::hasCommandPrefix(std::string_view name) const {
  return hasPrefix(tables_->commandPrefixes, name);
}
bool GibbsKeywords::hasVariablePrefix(std::string_view name) const {
  return hasPrefix(tables_->variablePrefixes, name);
}

std::vector<std::string_view> GibbsKeywords::commandNotes(std::string_view name) const {
  const Tables::Command* command = lookUp(tables_->commands, name);
  if (command == nullptr) return {};
  return {command->notes.begin(), command->notes.end()};
}

std::vector<std::string_view> GibbsKeywords::controlNotes(std::string_view name) const {
  const Tables::Control* control = lookUp(tables_->controls, name);
  if (control == nullptr) return {};
  return {control->notes.begin(), control->notes.end()};
}

bool GibbsKeywords::isUnprovedControl(std::string_view name) const {
  const Tables::Control* control = lookUp(tables_->controls, name);
  return control != nullptr && control->unproved;
}

std::span<const std::string> GibbsKeywords::requiredControls() const {
  return tables_->requiredControls;
}
std::string_view GibbsKeywords::firstControl() const {
  return tables_->firstControl;
}
std::string_view GibbsKeywords::imageSuffix() const {
  return tables_->imageSuffix;
}
const CallbackVariable* GibbsKeywords::callback(std::string_view name) const {
  return lookUp(tables_->callbacks, name);
}

const CursorNames* GibbsKeywords::cursor(std::string_view name) const {
  const std::size_t* index = lookUp(tables_->cursorOf, name);
  return index == nullptr ? nullptr : &tables_->cursors[*index];
}

bool GibbsKeywords::readAdvances(std::string_view name) const {
  return lookUp(tables_->advances, name) != nullptr;
}
std::optional<std::string_view> GibbsKeywords::removedSince(std::string_view name) const {
  return viewOf(lookUp(tables_->removed, name));
}
bool GibbsKeywords::isReservedField(std::string_view name) const {
  return lookUp(tables_->reserved, name) != nullptr;
}
std::span<const SystemMacro> GibbsKeywords::systemMacros() const {
  return tables_->systemMacros;
}

std::string GibbsKeywords::nearestCommand(std::string_view name) const {
  NearestName nearest(name);
  for (const auto& [candidate, unused] : tables_->commands)
    nearest.offer(candidate);
  for (const std::string& word : tables_->coreWords)
    nearest.offer(word);
  return nearest.result();
}

std::string GibbsKeywords::nearestControl(std::string_view name) const {
  return nearestName(name, tables_->controls);
}
std::string GibbsKeywords::nearestFunction(std::string_view name) const {
  return nearestName(name, tables_->functions);
}

std::string GibbsKeywords::nearestVariable(std::string_view name) const {
  NearestName nearest(name);
  for (const auto* map : {&tables_->variables, &tables_->constants}) {
    for (const auto& [key, spelling] : *map)
      nearest.offer(spelling);
  }
  return nearest.result();
}

std::string GibbsKeywords::nearestParameter(std::string_view family, std::string_view parameter) const {
  const ParameterFamily* found = lookUp(tables_->families, family);
  return found == nullptr ? "" : nearestName(parameter, found->parameters);
}

} // namespace dotek::stdlib
