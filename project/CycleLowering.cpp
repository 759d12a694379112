#include "project/CycleLowering.h"

#include "ir/Verify.h"
#include "project/CycleFiles.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>

namespace dotek::project {

namespace fs = std::filesystem;
namespace cycle = frontend::cycle;

bool isCycleFile(const std::string& path, Session& session) {
  std::error_code error;
  if (!isStream(path) && !fs::is_regular_file(path, error)) return false;
  Diagnostics ignored; // who reads it reports
  const Recognition* const found = session.kindOf(path, ignored, InputKind::Cycle);
  return found != nullptr && found->kind == InputKind::Cycle;
}

std::optional<cycle::Lowered> lowerCycleFile(const std::string& path, Session& session) {
  Diagnostics& diagnostics = session.diagnostics();
  CycleFiles files(session);
  const cycle::File* file = files.check(path);
  if (file == nullptr || file->hasErrorNodes || diagnostics.hasErrors()) return std::nullopt;
  const fs::path folder = isStream(path) ? fs::path(".") : fs::path(path).parent_path();
  // What is called has to be sound as well; it is checked once.
  std::map<std::string, const cycle::File*> called;
  const cycle::FindCycle find = [&](const std::string& name) {
    const auto [at, isNew] = called.try_emplace(name, nullptr);
    if (!isNew) return at->second;
    std::string stem = name;
    std::replace(stem.begin(), stem.end(), '_', '-');
    const std::string beside = (folder / (stem + ".cycle")).generic_string();
    std::error_code error;
    if (fs::is_regular_file(beside, error)) at->second = files.check(beside);
    return at->second;
  };
  std::optional<cycle::Lowered> out = cycle::lower(*file, session.sources(), find, diagnostics);
  if (!out || diagnostics.hasErrors()) return std::nullopt;
  for (const ir::Violation& violation : ir::verify(out->cycle))
    if (!violation.mixedKinds) // the checks of the language know the kinds better
      diagnostics.report<diag::InternalDefect>(violation.range, violation.message);
  if (diagnostics.hasErrors()) return std::nullopt;
  return out;
}

} // namespace dotek::project
