// Any bytes as an input of lint, with every rule. The first byte chooses the kind. What is found has its
// place in the text, and a list of what is found takes all of it away.
#include "driver/Driver.h"
#include "lint/Baseline.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

using namespace dotek;
namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 6> kNames = {"a.nc", "a.suf", "a.cycle", "a.cps", "a.mac", "prog.txt"};

// In memory where the system has such a place; each file is there, and its text comes from a buffer.
fs::path makeFolder() {
  const fs::path shared = "/dev/shm";
  fs::path out = (fs::is_directory(shared) ? shared : fs::temp_directory_path()) /
                 ("dotek-fuzz-lint-" + std::to_string(::getpid()));
  fs::create_directories(out);
  for (const char* name : kNames)
    std::ofstream(out / name).put('\n');
  return out;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fs::path kFolder = makeFolder();
  if (size == 0) return 0;
  const std::string path = (kFolder / kNames[data[0] % kNames.size()]).string();
  std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (!isUtf8(text)) return 0; // buffers are UTF-8
  lint::LintOptions options;
  options.paths = {path};
  options.select = std::set<std::string>{"all"};
  options.control = (data[0] & 64) != 0 ? "haas-ngc" : "fanuc-31i-b";
  options.common.limits.steps = 20000;
  options.common.limits.paths = 200;
  options.common.buffers = std::make_shared<const std::map<std::string, std::string>>(
      std::map<std::string, std::string>{{path, text}});
  driver::Outcome outcome = driver::lint(options);
  if (outcome.status < 0 || outcome.status > 2) std::abort();
  for (const Diagnostic& one : outcome.diagnostics.all()) {
    if (one.message.empty() || one.code.empty()) std::abort();
    if (one.range.hasPlace() && one.range.end > outcome.sources.file(one.range.file).bytes().size())
      std::abort();
  }
  renderText(outcome.diagnostics, outcome.sources, 0);
  driver::sarif(outcome);
  std::string reason;
  const auto none = [](const std::string&, const std::string&) { return false; };
  auto baseline = lint::Baseline::read(
      lint::Baseline::render(outcome.diagnostics, outcome.sources, "", {}, none), reason);
  if (!baseline) std::abort();
  return 0;
}
