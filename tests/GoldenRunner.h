// Golden cases: tests/golden/<area>/<case>/cmd holds the arguments of dotek, one command a line; beside it
// are the inputs and the expected `stdout`, `stderr` (empty where absent) and `status` (0 where absent).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dotek::tests {

struct Settings {
  bool update = false;
  int run = 0;
  int rewritten = 0;
  int corpusRun = 0;
  int corpusSkipped = 0;
  int toolSkipped = 0; // test cases whose tool is not on this machine
};
Settings& settings();

struct CommandResult {
  int status = 0;
  std::string out;
  std::string err;
};

// Runs dotek in this process, in `folder`.
CommandResult runDotek(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

std::filesystem::path root();                  // of the repository
std::optional<std::filesystem::path> corpus(); // nothing: not on this machine
// true: the corpus is there, `folder` is set. false: counted as skipped.
bool haveCorpus(std::filesystem::path& folder);
std::string readAll(const std::filesystem::path& path);
std::vector<std::string> splitArguments(const std::string& line);

} // namespace dotek::tests
