// Choices by the kind of a node that name every kind: a kind that is added breaks the build of each of them.
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>
#include <variant>

namespace dotek::ir {

template <class... Cases> struct Overloaded : Cases... { using Cases::operator()...; };
template <class... Cases> Overloaded(Cases...) -> Overloaded<Cases...>; // clang 14 asks for it

// Kinds that one case serves: [](const OneOf<Label, Comment> auto&) { return false; }
template <class Type, class... Kinds>
concept OneOf = (std::same_as<std::remove_cv_t<Type>, Kinds> || ...);

// Calls the case for the kind of `owner.node`: a statement, an expression, a condition. Each kind needs a
// case, and a case that takes anything does not compile. A single case may be an object with an operator()
// for each kind.
template <class Owner, class... Cases> decltype(auto) match(Owner& owner, Cases&&... cases) {
  struct NoKind {};
  static_assert((!std::invocable<Cases&, NoKind&> && ...),
                "name the kinds: a case for all hides those to come");
  if constexpr (sizeof...(Cases) == 1)
    return std::visit(std::forward<Cases>(cases)..., owner.node);
  else
    return std::visit(Overloaded<std::remove_cvref_t<Cases>...>{std::forward<Cases>(cases)...}, owner.node);
}

} // namespace dotek::ir
