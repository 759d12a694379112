// The scripts of stdlib/fusion as they were when the program was built.
#pragma once

#include <span>
#include <string_view>

namespace dotek::posts {

struct KernelFile {
  std::string_view name; // "30-text.js"
  std::string_view text;
};

// Sorted by name. Generated.
std::span<const KernelFile> kernelFiles();

} // namespace dotek::posts
