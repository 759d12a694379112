#include "driver/Companions.h"

#include "project/InputKind.h"
#include "support/messages/Common.h"

#include <filesystem>
#include <utility>

namespace dotek::driver {

namespace fs = std::filesystem;
using project::InputKind;

namespace {

std::string canonical(const std::string& path) {
  std::error_code error;
  return fs::weakly_canonical(path, error).generic_string();
}

} // namespace

void Companions::walk(const std::vector<std::string>& folders, project::InputWalk& walk,
                      project::Session& session) {
  walks = true;
  for (const std::string& path : folders) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      session.diagnostics().report<diag::FileNotReadable>({}, path, "it is no folder");
      continue;
    }
    session.addInputRoot(path);
    walk.visit(path, session.diagnostics());
  }
  walks = false;
}

void Companions::note(const std::string& path) {
  seen_.insert(canonical(path));
}

void Companions::take(const std::string& path, project::Session& session,
                      const std::function<void(const std::string&)>& read) {
  if (!seen_.insert(canonical(path)).second) return;
  const std::size_t before = session.sources().size();
  Diagnostics kept = std::exchange(session.diagnostics(), Diagnostics());
  const project::Recognition* const found = session.kindOf(path, session.diagnostics());
  if (found != nullptr && found->kind == InputKind::Nc && found->reason != project::kEmptyInput) read(path);
  session.diagnostics() = std::move(kept);
  for (std::size_t i = before; i < session.sources().size(); ++i)
    files_.insert(static_cast<FileId>(i));
}

bool Companions::has(const Diagnostic& finding) const {
  return finding.range.hasPlace() && files_.contains(finding.range.file);
}

} // namespace dotek::driver
