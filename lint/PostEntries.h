// The functions of a post's top level, however they are written.
#pragma once

#include "lint/Posts.h"

namespace dotek::lint {

struct TopFunction {
  const fusion::Node* name = nullptr;     // a Name
  const fusion::Node* function = nullptr; // a Function or an Arrow
  const fusion::Node* body() const { return function->kids.back(); }
};

// `function onOpen() {}`, `const onOpen = () => {}` and `onOpen = function () {}`.
std::vector<TopFunction> topFunctions(const fusion::Tree& tree);

} // namespace dotek::lint
