// The commands that a page shows, so that a test runs them as they are printed.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace dotek::tests {

// The commands of a page without `dotek`, each with its last heading.
inline std::vector<std::pair<std::string, std::string>> commandsOf(const std::string& page) {
  std::vector<std::pair<std::string, std::string>> out;
  std::string heading;
  bool open = false;
  for (std::size_t begin = 0; begin < page.size();) {
    const std::size_t end = std::min(page.find('\n', begin), page.size());
    std::string line = page.substr(begin, end - begin);
    begin = end + 1;
    if (line.starts_with("## ")) heading = line;
    const bool first = line.starts_with("    dotek ");
    if (!first && !open) continue;
    open = line.ends_with('\\');
    if (open) line.pop_back();
    if (first)
      out.emplace_back(heading, line.substr(10));
    else
      out.back().second += line;
  }
  return out;
}

} // namespace dotek::tests
