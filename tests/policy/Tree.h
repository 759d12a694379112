// The files of the repository, as the policy tests read them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dotek::tests {

struct TreeFile {
  std::string path; // from the root, with slashes
  std::string text;

  std::string folder() const; // "" at the root
  bool isHeader() const;
  bool isSource() const; // C++: header or not
  bool below(std::string_view folder) const;
};

// Every text file but those of builds and of version control, sorted by path.
const std::vector<TreeFile>& tree();

std::vector<std::string> linesOf(std::string_view text);
std::string lowerCase(std::string_view text);
// Where `word` is between characters that are neither letter, digit nor underscore; npos: nowhere.
std::size_t findWord(std::string_view text, std::string_view word);

} // namespace dotek::tests
