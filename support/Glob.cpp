#include "support/Glob.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dotek {
namespace {

// Without empty parts and `.`, so that `./a//b/` is `a/b`.
std::vector<std::string_view> partsOf(std::string_view path) {
  std::vector<std::string_view> out;
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t end = std::min(path.find('/', at), path.size());
    const std::string_view part = path.substr(at, end - at);
    if (!part.empty() && part != ".") out.push_back(part);
    at = end + 1;
  }
  return out;
}

bool matchesPart(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0;
  std::size_t star = std::string_view::npos, taken = 0; // the last `*`, and the name after what it takes
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      taken = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++taken;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*')
    ++p;
  return p == pattern.size();
}

} // namespace

bool matchesGlob(std::string_view pattern, std::string_view path) {
  std::vector<std::string_view> wanted = partsOf(pattern);
  const std::vector<std::string_view> parts = partsOf(path);
  if (wanted.empty()) return false;
  if (pattern.find('/') == std::string_view::npos) wanted.insert(wanted.begin(), "**");
  // reached[i]: the pattern so far takes the first i parts.
  std::vector<bool> reached(parts.size() + 1, false);
  reached[0] = true;
  for (const std::string_view part : wanted) {
    std::vector<bool> next(parts.size() + 1, false);
    bool before = false;
    for (std::size_t i = 0; i <= parts.size(); ++i) {
      before = before || reached[i];
      if (part == "**")
        next[i] = before;
      else if (i > 0)
        next[i] = reached[i - 1] && matchesPart(part, parts[i - 1]);
    }
    reached = std::move(next);
  }
  for (const bool folder : reached)
    if (folder) return true;
  return false;
}

} // namespace dotek
