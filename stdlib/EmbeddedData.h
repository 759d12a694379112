// The data files as they were when the program was built.
#pragma once

#include <span>
#include <string_view>

namespace dotek::stdlib {

struct EmbeddedFile {
  std::string_view path; // "forms/NAME.toml"
  std::string_view text;
};

// Sorted by path.
std::span<const EmbeddedFile> embeddedFiles();

} // namespace dotek::stdlib
