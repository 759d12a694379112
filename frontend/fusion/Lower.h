// A post as ES5, which is what the engine of `script` reads.
#pragma once

#include "frontend/fusion/Scopes.h"

#include <string>

namespace dotek::frontend::fusion {

struct Lowered {
  // In the encoding of the file; each statement on its line. A script that is ES5 is itself. The text calls
  // `dotekEs6` (stdlib/fusion/es6.js).
  std::string text;
  std::vector<Unread> refused; // constructs that cannot be said in ES5
};

// Of a tree without unread parts.
Lowered lower(const Tree& tree, const Scopes& scopes);

} // namespace dotek::frontend::fusion
