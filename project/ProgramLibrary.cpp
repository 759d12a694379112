#include "project/ProgramLibrary.h"

#include "project/Programs.h"
#include "support/Files.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>
#include <utility>

namespace dotek::project {
namespace {

namespace fs = std::filesystem;

// Of a file O1234; 0: it has another name.
std::uint64_t numberOfName(const std::string& name) {
  std::uint64_t number = 0;
  if (name.size() < 2 || (name[0] != 'O' && name[0] != 'o')) return 0;
  const auto [end, error] = std::from_chars(name.data() + 1, name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() ? number : 0;
}

// A control keeps the number; the text of the file may lack it.
void nameByFile(ir::ProgramFile& file, const fs::path& path) {
  const std::uint64_t number = numberOfName(path.stem().string());
  if (number == 0 || file.programs.empty() || file.programs.front().nameKind != ir::Program::NameKind::None)
    return;
  file.programs.front().nameKind = ir::Program::NameKind::Number;
  file.programs.front().number = number;
}

bool holdsPrograms(const fs::path& path) {
  const std::string end = path.extension().string();
  return end == ".nc" || end == ".NC" || (end.empty() && numberOfName(path.filename().string()) != 0);
}

} // namespace

std::optional<ProgramLibrary> ProgramLibrary::load(FileId main, const std::vector<std::string>& folders,
                                                   const stdlib::Control& control, Session& session) {
  ProgramLibrary out;
  out.main_ = session.sources().file(main).name();
  std::optional<ir::ProgramFile> file = loadPrograms(main, control, session);
  if (!file) return std::nullopt;
  out.add(std::move(*file), true, session);
  for (const std::string& folder : folders)
    if (!out.addFolder(folder, control, session)) return std::nullopt;
  return out;
}

std::optional<ProgramLibrary> ProgramLibrary::loadCalled(FileId main, const Caller& caller,
                                                         const std::vector<std::string>& folders,
                                                         const stdlib::Control& control, Session& session) {
  ProgramLibrary out;
  out.main_ = session.sources().file(main).name();
  std::optional<ir::ProgramFile> file = loadPrograms(main, control, session);
  if (!file) return std::nullopt;
  nameByFile(*file, fs::path(out.main_));
  const bool numbered =
      !file->programs.empty() && file->programs.front().nameKind == ir::Program::NameKind::Number;
  if (!numbered) {
    session.diagnostics().report<diag::SetupFlag>(
        {}, "--call",
        "the program has no number that it could be called by; begin it with a line such as `O9100`");
    return std::nullopt;
  }
  const std::optional<FileId> call = addText("--call", caller(file->programs.front().number), Encoding::Utf8,
                                             std::nullopt, session.sources(), session.diagnostics());
  std::optional<ir::ProgramFile> calling;
  if (call) calling = loadPrograms(*call, control, session);
  if (!calling) return std::nullopt;
  out.add(std::move(*calling), true, session);
  out.add(std::move(*file), false, session);
  for (const std::string& folder : folders)
    if (!out.addFolder(folder, control, session)) return std::nullopt;
  return out;
}

bool ProgramLibrary::addFolder(const std::string& folder, const stdlib::Control& control, Session& session) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    if (at->is_regular_file(ignored) && holdsPrograms(at->path())) paths.push_back(at->path());
  }
  if (error) {
    session.diagnostics().report<diag::FileNotReadable>({}, folder, error.message());
    return false;
  }
  std::sort(paths.begin(), paths.end());
  bool good = true;
  for (const fs::path& path : paths) {
    std::error_code ignored;
    if (fs::equivalent(path, main_, ignored)) continue; // the program that runs
    const std::optional<FileId> id = session.read(path.string(), Encoding::Cp1250);
    std::optional<ir::ProgramFile> file;
    if (id) file = loadPrograms(*id, control, session);
    good = good && file.has_value();
    if (!file) continue;
    nameByFile(*file, path);
    add(std::move(*file), false, session);
  }
  return good;
}

void ProgramLibrary::add(ir::ProgramFile file, bool main, Session& session) {
  for (ir::Program& program : file.programs) {
    const bool named = program.nameKind != ir::Program::NameKind::None;
    // The main program may lack a header, and nothing but it.
    if (!named && (!main || !programs_.empty() || program.body.empty())) continue;
    const bool twice = program.number != 0 &&
                       std::any_of(programs_.begin(), programs_.end(),
                                   [&](const ir::Program& one) { return one.number == program.number; });
    if (twice) session.diagnostics().report<diag::ProgramTwice>(program.range, program.number);
    if (!twice) programs_.push_back(std::move(program));
  }
}

std::vector<const ir::Program*> ProgramLibrary::programs() const {
  std::vector<const ir::Program*> out;
  for (const ir::Program& program : programs_)
    out.push_back(&program);
  return out;
}

} // namespace dotek::project
