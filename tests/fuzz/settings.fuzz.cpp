// Files in TOML that steer the program: those of `--data` folders, jobs of cycles and of posts, dotek.toml.
// Each is read or refused with its place; one that is read has its values.
#include "project/Settings.h"
#include "lint/Config.h"
#include "posts/PostJob.h"
#include "project/Job.h"
#include "project/Session.h"
#include "stdlib/Control.h"
#include "stdlib/Form.h"
#include "stdlib/MacroSet.h"
#include "stdlib/MikroprogControl.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <unistd.h>

using namespace dotek;
namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 4> kDataFolders = {"controls", "forms", "macros", "mikroprog"};

// A folder of this process, in memory where the system has such a one.
fs::path makeFolder() {
  const fs::path shared = "/dev/shm";
  const fs::path base = fs::is_directory(shared) ? shared : fs::temp_directory_path();
  fs::path out = base / ("dotek-fuzz-" + std::to_string(::getpid()));
  for (const char* folder : kDataFolders)
    fs::create_directories(out / "data" / folder);
  fs::create_directories(out / "project");
  return out;
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

// false: the file has a defect and its message says where.
bool loads(std::size_t kind, const stdlib::DataFiles& files) {
  try {
    switch (kind) {
    case 0: return stdlib::Control::load(files, "mine").has_value();
    case 1: return stdlib::Form::load(files, "mine").has_value();
    case 2: return stdlib::MacroSet::load(files, "mine").has_value();
    default: return stdlib::MikroprogControl::load(files, "mine").has_value();
    }
  } catch (const stdlib::DataError& error) {
    if (std::string_view(error.what()).find("mine") == std::string_view::npos) std::abort();
    return false;
  }
}

} // namespace

// The first byte chooses what the rest is.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fs::path kFolder = makeFolder();
  static const project::CommonOptions kOptions;
  if (size == 0) return 0;
  // toml++ runs into undefined behaviour of its own at some letters that are no ASCII.
  if (std::any_of(data, data + size, [](std::uint8_t byte) { return byte >= 0x80; })) return 0;
  const std::size_t kind = static_cast<std::size_t>(data[0] - '0') % (kDataFolders.size() + 3);
  const std::string text(data + 1, data + size);
  if (kind < kDataFolders.size()) {
    const fs::path folder = kFolder / "data" / kDataFolders[kind];
    write(folder / "mine.toml", text);
    Diagnostics diagnostics;
    stdlib::DataFiles files;
    const Limits limits;
    files.addFolder((kFolder / "data").string(), limits, diagnostics);
    loads(kind, files);
    fs::remove(folder / "mine.toml");
    return 0;
  }
  project::Session session(kOptions);
  if (kind == kDataFolders.size()) {
    const std::string job = (kFolder / "job.toml").string();
    write(job, text);
    const bool read = project::loadJob(job, session).has_value();
    if (read == session.diagnostics().hasErrors()) std::abort();
  } else if (kind == kDataFolders.size() + 2) {
    const std::string job = (kFolder / "post-job.toml").string();
    write(job, text);
    const auto read = posts::readPostJob(job, posts::JobOptions(), session);
    if (read.has_value() == session.diagnostics().hasErrors()) std::abort();
    if (read && !nlohmann::json::accept(read->json)) std::abort();
  } else {
    write(kFolder / "project" / "dotek.toml", text);
    lint::Configs configs(session);
    configs.of((kFolder / "project" / "a.nc").string());
    project::settingsOf((kFolder / "project" / "a.nc").string(), session);
  }
  renderText(session.diagnostics(), session.sources(), 0);
  return 0;
}
