#include "tests/Process.h"

#include "tests/GoldenRunner.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sys/wait.h>
#include <unistd.h>

namespace dotek::tests {

namespace fs = std::filesystem;

namespace {

fs::path newFolder() {
  std::string name = (fs::temp_directory_path() / "dotek-process-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) return {};
  return name;
}

// Whoever starts the tests may ignore signals (nohup, a job of a script); what is run here shall not.
class DefaultSignals {
public:
  DefaultSignals() {
    for (std::size_t i = 0; i < kSignals.size(); ++i)
      before_[i] = std::signal(kSignals[i], SIG_DFL);
  }
  ~DefaultSignals() {
    for (std::size_t i = 0; i < kSignals.size(); ++i)
      std::signal(kSignals[i], before_[i]);
  }
  DefaultSignals(const DefaultSignals&) = delete;
  DefaultSignals& operator=(const DefaultSignals&) = delete;

private:
  static constexpr std::array kSignals = {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE};
  std::array<void (*)(int), kSignals.size()> before_{};
};

} // namespace

ProcessFolder::ProcessFolder() : folder_(newFolder()), streams_(newFolder()) {}

ProcessFolder::~ProcessFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  fs::remove_all(streams_, ignored);
}

ShellResult ProcessFolder::run(const std::string& script) const {
  std::ofstream(streams_ / "script") << "dotek() { '" DOTEK_BUILD "/dotek' \"$@\"; }\nDOTEK='" DOTEK_BUILD
                                        "/dotek'\ncd '"
                                     << folder_.string() << "'\n"
                                     << script << "\n";
  const std::string out = (streams_ / "out").string(), err = (streams_ / "err").string();
  const DefaultSignals signals;
  const int status =
      std::system(("bash '" + (streams_ / "script").string() + "' >'" + out + "' 2>'" + err + "'").c_str());
  ShellResult result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = readAll(out);
  result.err = readAll(err);
  return result;
}

void ProcessFolder::write(const std::string& name, const std::string& bytes) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name, std::ios::binary) << bytes;
}

std::string ProcessFolder::read(const std::string& name) const {
  return readAll(folder_ / name);
}

std::string ProcessFolder::names() const {
  std::set<std::string> sorted;
  for (const auto& entry : fs::directory_iterator(folder_))
    sorted.insert(entry.path().filename().string());
  std::string out;
  for (const std::string& name : sorted)
    out += name + " ";
  return out;
}

bool isRoot() {
  return geteuid() == 0;
}

} // namespace dotek::tests
