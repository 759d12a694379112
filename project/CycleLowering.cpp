#include "project/CycleLowering.h"

#include "frontend/cycle/Check.h"
#include "frontend/cycle/Link.h"
#include "ir/Verify.h"
#include "project/CycleFiles.h"
#include "project/MacroCycles.h"
#include "support/messages/Commands.h"
#include "support/messages/Cycle.h"

#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

namespace dotek::project {

namespace fs = std::filesystem;
namespace cycle = frontend::cycle;

bool isCycleFile(const std::string& path, Session& session) {
  std::error_code error;
  if (!isStream(path) && !fs::is_regular_file(path, error)) return false;
  Diagnostics ignored; // who reads it reports
  // Asked first, it decides what a text of no certain kind is: a program, as wherever one is expected.
  const Recognition* const found = session.kindOf(path, ignored, InputKind::Nc);
  return found != nullptr && found->kind == InputKind::Cycle;
}

namespace {

// Of a cycle in which check() found no error. What it calls has to be sound as well; it is checked once.
std::optional<cycle::Lowered> lowered(const cycle::File& file, Session& session,
                                      const cycle::CallForms& forms = {}) {
  Diagnostics& diagnostics = session.diagnostics();
  std::set<const cycle::File*> seen = {&file};
  const auto checkCalled = [&](const auto& self, const cycle::File& one) -> void {
    for (const cycle::Call* const call : cycle::callsOf(one.body)) {
      if (call->called == nullptr || !seen.insert(call->called).second) continue;
      cycle::check(*call->called, session.sources(), diagnostics);
      self(self, *call->called);
    }
  };
  checkCalled(checkCalled, file);
  if (diagnostics.hasErrors()) return std::nullopt;
  std::optional<cycle::Lowered> out = cycle::lower(file, session.sources(), diagnostics, forms);
  if (!out || diagnostics.hasErrors()) return std::nullopt;
  const auto verify = [&](const ir::Cycle& one) {
    for (const ir::Violation& violation : ir::verify(one))
      if (!violation.mixedKinds) // the checks of the language know the kinds better
        diagnostics.report<diag::InternalDefect>(violation.range, violation.message);
  };
  verify(out->cycle);
  for (const cycle::CalledProgram& program : out->programs)
    if (!program.cycle.name.empty()) verify(program.cycle);
  if (diagnostics.hasErrors()) return std::nullopt;
  return out;
}

} // namespace

std::optional<cycle::Lowered> lowerCycleFile(const std::string& path, Session& session,
                                             const CallsAs& calls) {
  CycleFiles files(session);
  const cycle::File* file = files.check(path);
  if (file == nullptr || file->hasErrorNodes || session.diagnostics().hasErrors()) return std::nullopt;
  cycle::CallForms forms{calls.programLevels, {}};
  if (calls.macros != nullptr) forms.macros = macroCycles(*calls.macros, files);
  std::optional<cycle::Lowered> out = lowered(*file, session, forms);
  if (out && calls.macros != nullptr && out->macroCalls == 0)
    session.diagnostics().report<diag::CallsWithoutMacro>(out->cycle.range, out->cycle.name,
                                                          calls.macros->title);
  return out;
}

std::optional<FileId> checkCycleFile(const std::string& path, CycleFiles& files, Session& session) {
  Diagnostics before = std::exchange(session.diagnostics(), Diagnostics());
  const cycle::File* file = files.check(path);
  const bool sound = file != nullptr && !file->hasErrorNodes && !session.diagnostics().hasErrors();
  if (sound && file->header() != nullptr && !file->header()->options) lowered(*file, session);
  for (Diagnostic& one : session.diagnostics().all())
    before.add(std::move(one));
  session.diagnostics() = std::move(before);
  return file == nullptr ? std::nullopt : std::optional(file->file);
}

} // namespace dotek::project
