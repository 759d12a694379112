// Whether a text is a post of Fusion, or a fragment of one. No command but `lint`, `dump` and `run-post`
// takes one, so it is no InputKind.
#pragma once

#include "project/InputKind.h"

#include <string_view>

namespace dotek::project {

inline constexpr std::string_view kPostInput = "a post of Fusion";

// recognise() says so.
inline bool isPost(const Recognition& recognition) {
  return !recognition.kind && recognition.reason == kPostInput;
}

// `named`: its name ends in .cps.
bool isPostText(std::string_view text, bool named);

} // namespace dotek::project
