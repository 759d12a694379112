// Any bytes as the folder of a custom drill cycle with its post: the texts of macro, path, dialog, words and
// Prog, with lines of `----` between. It becomes a cycle of the language, a program, a page. The first byte
// chooses.
#include "driver/Driver.h"
#include "driver/Preview.h"

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

constexpr std::array<const char*, 5> kNames = {"cycle/CycleData.mac", "cycle/ToolPath.mac",
                                               "cycle/CycleData.dlg", "cycle/DefineData.txt", "prog.txt"};

fs::path makeFolder() {
  const fs::path shared = "/dev/shm";
  fs::path out = (fs::is_directory(shared) ? shared : fs::temp_directory_path()) /
                 ("dotek-fuzz-folder-" + std::to_string(::getpid()));
  fs::create_directories(out / "cycle");
  return out;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fs::path kFolder = makeFolder();
  if (size == 0) return 0;
  std::string rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  for (const char* name : kNames) {
    const std::size_t end = std::min(rest.find("----\n"), rest.size());
    std::ofstream(kFolder / name, std::ios::binary | std::ios::trunc) << rest.substr(0, end);
    rest.erase(0, end + 5);
  }
  driver::ConvertOptions options;
  options.inputs = {(kFolder / "cycle").string()};
  options.source.prog = (kFolder / "prog.txt").string();
  options.common.assume = {"probe-on"};
  options.common.limits.steps = 20000;
  options.common.limits.paths = 200;
  driver::Outcome outcome;
  const unsigned choice = data[0] % 4;
  if (choice == 3) {
    driver::PreviewOptions page;
    page.folders = options.inputs;
    page.common = options.common;
    outcome = driver::preview(page);
  } else {
    constexpr std::array<const char*, 3> kTargets = {"cycle", "fanuc", "fusion"};
    options.to = kTargets[choice];
    outcome = driver::convert(options);
    if (outcome.status == 0 && outcome.files.empty()) std::abort();
  }
  if (outcome.status != 0 && outcome.diagnostics.all().empty()) std::abort();
  renderText(outcome.diagnostics, outcome.sources, 0);
  if (choice != 0 || outcome.files.empty()) return 0;
  // What is given as a cycle of the language is one.
  std::ofstream(kFolder / "again.cycle", std::ios::binary | std::ios::trunc) << outcome.files[0].text;
  driver::CycleOptions check;
  check.inputs = {(kFolder / "again.cycle").string()};
  if (driver::check(check).diagnostics.hasErrors()) std::abort();
  return 0;
}
