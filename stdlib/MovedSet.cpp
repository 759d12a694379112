#include "stdlib/MovedSet.h"

#include "stdlib/DataFiles.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace dotek::stdlib {
namespace {

constexpr std::uint32_t kFirstKept = 500, kLast = 9999;

using Range = std::pair<std::uint32_t, std::uint32_t>;

// `#520` within `kept` becomes the variable as far after `first`.
std::string movedText(std::string_view text, const Range& kept, std::uint32_t first) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    out += text[at];
    if (text[at++] != '#') continue;
    std::size_t end = at;
    while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0)
      ++end;
    std::uint32_t number = 0;
    std::from_chars(text.data() + at, text.data() + end, number);
    const bool moves = number >= kept.first && number <= kept.second;
    out += moves ? std::to_string(number - kept.first + first) : std::string(text.substr(at, end - at));
    at = end;
  }
  return out;
}

} // namespace

std::optional<MovedName> movedName(std::string_view name) {
  const std::size_t at = name.find('@');
  if (at == std::string_view::npos) return MovedName{name, std::nullopt};
  const std::string_view digits = name.substr(at + 1);
  std::uint32_t first = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), first);
  if (error != std::errc() || end != digits.data() + digits.size() || first < kFirstKept || first > kLast)
    return std::nullopt;
  return MovedName{name.substr(0, at), first};
}

std::optional<Range> keptVariables(const MacroSet& set) {
  std::optional<Range> out;
  for (const auto& [first, last] : set.scratch) {
    if (first < kFirstKept) continue;
    if (!out) out = {first, last};
    out = {std::min(out->first, first), std::max(out->second, last)};
  }
  return out;
}

MacroSet movedTo(MacroSet set, std::uint32_t first) {
  const std::optional<Range> kept = keptVariables(set);
  if (!kept) return set;
  const auto move = [&](std::uint32_t& number) {
    if (number >= kept->first && number <= kept->second) number = number - kept->first + first;
  };
  const auto moveIfAny = [&](std::optional<std::uint32_t>& number) {
    if (number) move(*number);
  };
  for (auto* ranges : {&set.scratch, &set.overwritten})
    for (auto& [from, to] : *ranges) {
      move(from);
      move(to);
    }
  for (MacroSignature& signature : set.signatures)
    for (MacroResult& result : signature.results)
      move(result.variable);
  ProbingFacts& facts = set.probing;
  for (auto* number : {&facts.feedVariable, &facts.radiusX, &facts.radiusY, &facts.offsetX, &facts.offsetY,
                       &facts.vectorFirst, &facts.vectorLast})
    moveIfAny(*number);
  for (auto& [number, value] : set.callerValues)
    move(number);
  set.needs = movedText(set.needs, *kept, first);
  const std::string from = "new macros " + set.name, to = from + "@" + std::to_string(first);
  if (const std::size_t at = set.needs.find(from); at != std::string::npos)
    set.needs.replace(at, from.size(), to);
  set.name += "@" + std::to_string(first);
  return set;
}

std::optional<std::string> macroText(const DataFiles& files, std::string_view name) {
  const std::optional<MovedName> moved = movedName(name);
  const DataFile* const file = moved ? files.find("macrob", moved->set) : nullptr;
  if (file == nullptr) return std::nullopt;
  if (!moved->first) return std::string(file->text);
  const std::optional<MacroSet> set = MacroSet::load(files, moved->set);
  const auto kept = set ? keptVariables(*set) : std::nullopt;
  if (!kept) return std::nullopt;
  return movedText(file->text, *kept, *moved->first);
}

} // namespace dotek::stdlib
