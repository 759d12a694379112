// Any bytes as a cycle of the language that becomes a translation. The first byte chooses the target. What is
// given has a text, what is not has a reason.
#include "driver/Driver.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>

using namespace dotek;
namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 4> kTargets = {"fanuc", "mikroprog", "gibbs", "fusion"};

std::string makeFile() {
  const fs::path shared = "/dev/shm";
  const fs::path folder = (fs::is_directory(shared) ? shared : fs::temp_directory_path()) /
                          ("dotek-fuzz-cycle-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "a.cycle").put('\n');
  return (folder / "a.cycle").string();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string kPath = makeFile();
  if (size == 0) return 0;
  std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (!isUtf8(text)) return 0; // buffers are UTF-8
  driver::ConvertOptions options;
  options.inputs = {kPath};
  options.to = kTargets[data[0] % kTargets.size()];
  if ((data[0] & 4) != 0) options.probeMacros = "dotek";
  options.useDefaults = (data[0] & 8) != 0;
  // What a dialog has to know: a first value for each parameter, and what the CAM gives.
  if ((data[0] & 16) != 0) {
    constexpr std::string_view kWord = "parameter ";
    for (std::size_t at = text.find(kWord); at != std::string::npos; at = text.find(kWord, at + 1)) {
      const std::size_t begin = at + kWord.size();
      options.defaults.emplace_back(
          text.substr(begin, text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789", begin) - begin),
          "55");
    }
    options.common.host.emplace_back("approach_feed", "1000");
  }
  options.common.limits.steps = 20000;
  options.common.limits.paths = 200;
  options.common.buffers = std::make_shared<const std::map<std::string, std::string>>(
      std::map<std::string, std::string>{{kPath, text}});
  const driver::Outcome outcome = driver::convert(options);
  if (outcome.status == 0 && outcome.files.empty()) std::abort();
  if (outcome.status != 0 && outcome.diagnostics.all().empty()) std::abort();
  renderText(outcome.diagnostics, outcome.sources, 0);
  driver::CycleOptions page;
  page.inputs = options.inputs;
  page.common = options.common;
  driver::catalogue(page);
  return 0;
}
