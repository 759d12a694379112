// The words of the cycle language and what they are.
#pragma once

#include "frontend/cycle/Ast.h"
#include "support/NearestName.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dotek::frontend::cycle {

// Words that begin a statement, in the order of docs/cycles.md.
std::span<const std::string_view> statementWords();
// length, angle, ...
std::span<const std::string_view> typeWords();
// A word that no parameter, result or variable may be called: of the language, a type, a unit or an axis.
bool isReserved(std::string_view word);
// lower_snake: a letter, then letters, digits and `_`.
bool isName(std::string_view word);
// A name for one that is reserved or no name: `Bore-Dia` gives `bore_dia`, `x` gives `x_value`.
std::string proposeName(std::string_view word);

// The one of two names is how the other begins, or they have a part in common: `dia` and `diameter`,
// `probe_radius` and `ball_radius`.
bool sharesPart(std::string_view one, std::string_view other);
// The nearest of pairs whose first is the name; else the only one that shares a part. "": none.
template <class Names> std::string nameLike(std::string_view name, const Names& names) {
  std::string out = nearestName(name, names);
  if (!out.empty()) return out;
  std::size_t left = NearestName::kMostOffers;
  for (const auto& known : names) {
    if (left-- == 0) return "";
    if (!sharesPart(name, known.first)) continue;
    if (!out.empty()) return "";
    out = known.first;
  }
  return out;
}

std::optional<TypeName> typeOf(std::string_view word);
std::optional<Unit> unitOf(std::string_view text);
// How a statement that begins with `word` is written: "`touch x by 10 mm -> right`"; "" where none does.
std::string_view usageOf(std::string_view word);

} // namespace dotek::frontend::cycle
