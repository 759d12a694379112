// What an engine refuses of a script that is read: names that are declared twice.
#pragma once

#include "frontend/fusion/Scopes.h"

namespace dotek::frontend::fusion {

std::vector<Unread> declaredTwice(const Tree& tree, const Scopes& scopes);

// Lines of a function that has no name of its own, and what it is given to: `const writeBlock = () => ..`.
struct GivenFunction {
  std::uint32_t begin = 0, end = 0;
  std::string name; // "": to nothing that has a name
};
std::vector<GivenFunction> givenFunctions(const Tree& tree);

} // namespace dotek::frontend::fusion
