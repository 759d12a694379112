#include "project/Programs.h"

#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"
#include "project/Inputs.h"
#include "support/Files.h"

#include <filesystem>
#include <utility>

namespace dotek::project {

frontend::macrob::Text textOf(FileId file, Session& session) {
  using frontend::macrob::Text;
  const std::optional<std::string>& from = session.options().from;
  if (from) return isListing(from) ? Text::Listing : Text::Program;
  // The text of a set of macros, or of a pipe, is in no folder.
  const std::string path = session.sources().file(file).name();
  std::error_code error;
  const bool listing = std::filesystem::is_regular_file(path, error) && settingsOf(path, session).listing;
  return listing ? Text::Listing : Text::Program;
}

void repairListings(Session& session) {
  for (Diagnostic& one : session.diagnostics().all())
    if (one.fix && one.code == "table-base-read" && one.range.hasPlace() &&
        textOf(one.range.file, session) == frontend::macrob::Text::Listing)
      one.fix->applicability = Fix::Applicability::Safe;
}

frontend::macrob::Forms formsOf(FileId file, Session& session) {
  const std::string path = session.sources().file(file).name();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  const std::string name = settingsOf(path, session).control;
  const stdlib::Control* const control = name.empty() ? nullptr : session.control(name);
  return control == nullptr ? frontend::macrob::Forms{} : frontend::macrob::formsOf(*control);
}

bool isProgramFile(const std::string& path, Session& session) {
  std::error_code error;
  const bool file =
      isStream(path) || (std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error));
  if (file) kindAmong(path, {InputKind::Nc}, "an NC program or the folder of a cycle", session);
  return file;
}

namespace {

struct Loaded {
  std::optional<ir::ProgramFile> programs;
  SourceRange leader; // the text before the first `%`
};

Loaded load(FileId file, const stdlib::Control& control, Session& session, frontend::macrob::LowerFor use) {
  Diagnostics found;
  const frontend::macrob::Text text = textOf(file, session);
  const frontend::macrob::File tree =
      frontend::macrob::parse(file, session.sources(), session.limits(), found, text,
                              frontend::macrob::Reader::Fast, frontend::macrob::formsOf(control));
  for (Diagnostic& one : found.all())
    if (one.severity == Severity::Error) session.diagnostics().add(std::move(one));
  return {frontend::macrob::lower(tree, control, session.sources(), session.diagnostics(), use), tree.leader};
}

} // namespace

std::optional<ir::ProgramFile> loadPrograms(FileId file, const stdlib::Control& control, Session& session) {
  return load(file, control, session, frontend::macrob::LowerFor::Run).programs;
}

std::optional<ir::ProgramFile> loadForTranslation(FileId file, const stdlib::Control& control,
                                                  Session& session, SourceRange& leader) {
  Loaded loaded = load(file, control, session, frontend::macrob::LowerFor::Translation);
  leader = loaded.leader;
  return std::move(loaded.programs);
}

} // namespace dotek::project
