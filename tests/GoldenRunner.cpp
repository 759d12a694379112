#include "tests/GoldenRunner.h"

#include "cli/Cli.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace dotek::tests {

namespace fs = std::filesystem;

Settings& settings() {
  static Settings instance;
  return instance;
}

CommandResult runDotek(const std::vector<std::string>& arguments, const fs::path& folder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  std::ostringstream out;
  std::ostringstream err;
  CommandResult result;
  result.status = cli::run(arguments, out, err);
  fs::current_path(before);
  result.out = out.str();
  result.err = err.str();
  return result;
}

fs::path root() {
  return DOTEK_ROOT;
}

std::optional<fs::path> corpus() {
  const char* named = std::getenv("DOTEK_CORPUS");
  const fs::path folder = named != nullptr ? fs::path(named) : root().parent_path() / "shared" / "corpus";
  if (!fs::is_directory(folder)) return std::nullopt;
  return fs::absolute(folder);
}

bool haveCorpus(fs::path& folder) {
  if (const auto found = corpus()) {
    folder = *found;
    ++settings().corpusRun;
    return true;
  }
  ++settings().corpusSkipped;
  return false;
}

std::string readAll(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> splitArguments(const std::string& line) {
  std::vector<std::string> out;
  std::string word;
  bool quoted = false;
  bool any = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
      any = true;
    } else if (c == ' ' && !quoted) {
      if (any || !word.empty()) out.push_back(word);
      word.clear();
      any = false;
    } else {
      word += c;
    }
  }
  if (any || !word.empty()) out.push_back(word);
  return out;
}

} // namespace dotek::tests
