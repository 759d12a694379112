#include "project/ProgramLibrary.h"

#include "project/Inputs.h"
#include "project/Programs.h"
#include "stdlib/CalledProgram.h"
#include "support/Files.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <system_error>
#include <utility>

namespace dotek::project {
namespace {

namespace fs = std::filesystem;

// A control keeps the number; the text of the file may lack it.
void nameByFile(ir::ProgramFile& file, const fs::path& path) {
  const std::uint64_t number = numberOfName(path.filename().string());
  if (number == 0 || file.programs.empty() || file.programs.front().nameKind != ir::Program::NameKind::None)
    return;
  file.programs.front().nameKind = ir::Program::NameKind::Number;
  file.programs.front().number = number;
}

} // namespace

std::optional<ProgramLibrary> ProgramLibrary::load(FileId main, const std::vector<std::string>& folders,
                                                   const stdlib::Control& control, Session& session) {
  ProgramLibrary out;
  out.main_ = session.sources().file(main).name();
  std::optional<ir::ProgramFile> file = out.loadMain(main, control, session);
  if (!file) return std::nullopt;
  out.add(std::move(*file), true, session);
  if (out.programs_.empty()) {
    session.diagnostics().report<diag::NoProgram>({main, 0, 0}, inputName(out.main_), "run");
    return std::nullopt;
  }
  if (!out.addFolders(folders, control, session)) return std::nullopt;
  out.addUncalled(main, control, session);
  return out;
}

std::optional<ProgramLibrary> ProgramLibrary::loadCalled(FileId main, const Caller& caller,
                                                         const std::vector<std::string>& folders,
                                                         const stdlib::Control& control, Session& session) {
  ProgramLibrary out;
  out.main_ = session.sources().file(main).name();
  std::optional<ir::ProgramFile> file = out.loadMain(main, control, session);
  if (!file) return std::nullopt;
  nameByFile(*file, fs::path(out.main_));
  using NameKind = ir::Program::NameKind;
  const NameKind kind = file->programs.empty() ? NameKind::None : file->programs.front().nameKind;
  const bool numbered = kind == NameKind::Number || kind == NameKind::Colon;
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
  if (!out.addFolders(folders, control, session)) return std::nullopt;
  out.addUncalled(main, control, session);
  return out;
}

// All programs of the file; where a later one has errors, the first one, and the others wait for a call.
std::optional<ir::ProgramFile> ProgramLibrary::loadMain(FileId main, const stdlib::Control& control,
                                                        Session& session) {
  Diagnostics before = std::exchange(session.diagnostics(), Diagnostics());
  std::optional<ir::ProgramFile> file = loadPrograms(main, control, session);
  if (!file) {
    Diagnostics ofAll = std::exchange(session.diagnostics(), Diagnostics());
    std::vector<LoneProgram> programs = lonePrograms(main, control, session);
    std::optional<ir::Program> first;
    if (programs.size() > 1) first = lowerAlone(programs.front(), control, session);
    if (first) {
      file.emplace().programs.push_back(std::move(*first));
      waiting_.insert(waiting_.end(), std::make_move_iterator(programs.begin() + 1),
                      std::make_move_iterator(programs.end()));
    } else
      session.diagnostics() = std::move(ofAll);
  }
  std::swap(before, session.diagnostics());
  for (Diagnostic& one : before.all())
    session.diagnostics().add(std::move(one));
  return file;
}

// What is left of the file that runs: an error in a program that nothing calls stops no run.
void ProgramLibrary::addUncalled(FileId main, const stdlib::Control& control, Session& session) {
  for (LoneProgram& one : waiting_) {
    if (one.file.file != main) continue;
    const auto& name = one.file.programs.front().name;
    const SourceRange place = name ? name->range : SourceRange{main, 0, 0};
    Diagnostics kept = std::exchange(session.diagnostics(), Diagnostics());
    std::optional<ir::Program> program = lowerAlone(one, control, session);
    std::swap(kept, session.diagnostics());
    if (program) {
      add(std::move(*program), false, session);
      continue;
    }
    Diagnostic& found = session.diagnostics().report<diag::ProgramUncalled>(place, inputName(main_));
    const auto error = std::find_if(kept.all().begin(), kept.all().end(),
                                    [](const Diagnostic& d) { return d.severity == Severity::Error; });
    if (error != kept.all().end()) found.note(error->range, error->message);
  }
  std::erase_if(waiting_, [&](const LoneProgram& one) { return one.file.file == main; });
}

bool ProgramLibrary::addFolders(const std::vector<std::string>& folders, const stdlib::Control& control,
                                Session& session) {
  for (const std::string& folder : folders)
    if (!find(folder, session)) return false;
  if (!addCalled(control, session)) return false;
  addPossible(control, session);
  return true;
}

bool ProgramLibrary::find(const std::string& folder, Session& session) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    const bool named = numberOfName(at->path().filename().string()) != 0;
    if (at->is_regular_file(ignored) || (named && !at->is_directory(ignored))) paths.push_back(at->path());
  }
  if (error) {
    session.diagnostics().report<diag::FileNotReadable>({}, folder, error.message());
    return false;
  }
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    std::error_code ignored;
    if (fs::equivalent(path, main_, ignored)) continue; // the program that runs
    const std::uint64_t named = numberOfName(path.filename().string());
    Diagnostics unread; // said once the file is called
    const bool stream = isStream(path.string());
    const Recognition* const kind = stream ? nullptr : session.kindOf(path.string(), unread);
    if (kind != nullptr && kind->kind != InputKind::Nc) continue;
    Unread& file = unread_.emplace_back();
    file.path = path.string();
    session.sources().add(SourceFile(file.path, "", Encoding::Utf8)); // no result is written over it
    if (named != 0) file.numbers.insert(named);
    const auto text = kind == nullptr ? std::nullopt : session.bytes(path.string(), unread);
    if (!text) continue;
    for (const std::uint64_t number : programNumbers(*text))
      file.numbers.insert(number);
  }
  return true;
}

bool ProgramLibrary::read(Unread& file, const stdlib::Control& control, Session& session) {
  if (refusesStream(file.path, {}, session)) return false;
  const std::optional<FileId> id = session.read(file.path, Encoding::Cp1250);
  if (!id) return false;
  for (LoneProgram& one : lonePrograms(*id, control, session))
    waiting_.push_back(std::move(one));
  return true;
}

ProgramLibrary::Calls ProgramLibrary::calls(const stdlib::Control& control) const {
  Calls out;
  for (const ir::Program& program : programs_) {
    for (const ir::ProgramStatement& statement : program.body) {
      const auto* call = std::get_if<ir::Call>(&statement.node);
      if (call == nullptr || call->program == nullptr) continue;
      const double* number = ir::constantValue(call->program);
      if (number == nullptr) {
        out.computed = true;
      } else if (*number >= 1 && *number < 1e8) {
        const auto written = static_cast<std::uint64_t>(std::llround(*number));
        const bool counts = call->kind == ir::CallKind::Subprogram && call->repeats == nullptr;
        out.numbers.insert(counts ? stdlib::subprogramCall(written, control).program : written);
      }
    }
  }
  return out;
}

// What is added may call more.
bool ProgramLibrary::addCalled(const stdlib::Control& control, Session& session) {
  bool good = true;
  for (bool found = true; found;) {
    found = false;
    const Calls called = calls(control);
    std::vector<Unread> files = std::exchange(unread_, {});
    for (Unread& file : files) {
      const bool wanted = std::any_of(file.numbers.begin(), file.numbers.end(),
                                      [&](std::uint64_t number) { return called.numbers.contains(number); });
      if (!wanted)
        unread_.push_back(std::move(file));
      else
        good = read(file, control, session) && good;
    }
    std::vector<LoneProgram> programs = std::exchange(waiting_, {});
    for (LoneProgram& one : programs) {
      if (!called.numbers.contains(one.number)) {
        waiting_.push_back(std::move(one));
        continue;
      }
      std::optional<ir::Program> program = lowerAlone(one, control, session);
      good = good && program.has_value();
      if (program) add(std::move(*program), false, session);
      found = true;
    }
  }
  return good;
}

// What a call that computes its number could mean, and the codes of the control that call programs.
void ProgramLibrary::addPossible(const stdlib::Control& control, Session& session) {
  std::set<std::string> leftOut;
  for (bool found = true; found;) {
    found = false;
    const Calls called = calls(control);
    const auto isPossible = [&](std::uint64_t number) {
      return called.computed || called.numbers.contains(number) ||
             std::any_of(control.callCodes.begin(), control.callCodes.end(),
                         [&](const stdlib::CallCode& code) {
                           return number >= code.program && number - code.program < code.count;
                         });
    };
    Diagnostics kept = std::exchange(session.diagnostics(), Diagnostics());
    std::vector<Unread> files = std::exchange(unread_, {});
    for (Unread& file : files) {
      if (std::none_of(file.numbers.begin(), file.numbers.end(), isPossible))
        unread_.push_back(std::move(file));
      else if (!read(file, control, session)) {
        leftOut.insert(file.path);
        for (const std::uint64_t number : file.numbers)
          unreadable_.emplace(number, file.path);
      }
    }
    std::vector<LoneProgram> programs = std::exchange(waiting_, {});
    for (LoneProgram& one : programs) {
      if (one.number == 0) continue;
      if (!isPossible(one.number)) {
        waiting_.push_back(std::move(one));
        continue;
      }
      const std::string& path = session.sources().file(one.file.file).name();
      std::optional<ir::Program> program = lowerAlone(one, control, session);
      if (!program) {
        leftOut.insert(fmt::format("O{:04} of {}", one.number, path));
        unreadable_.emplace(one.number, path);
      }
      if (program) add(std::move(*program), false, session);
      found = true;
    }
    std::swap(kept, session.diagnostics());
    for (Diagnostic& one : kept.all()) // of those that were read; errors belong to what is left out
      if (one.severity != Severity::Error) session.diagnostics().add(std::move(one));
  }
  if (leftOut.empty()) return;
  constexpr std::size_t kNames = 3;
  std::string names;
  std::size_t count = 0;
  for (const std::string& one : leftOut)
    if (count++ < kNames) names += (names.empty() ? "`" : ", `") + one + "`";
  if (count > kNames) names += fmt::format(" and {} more", count - kNames);
  session.diagnostics().report<diag::ProgramLeftOut>({}, names);
}

void ProgramLibrary::add(ir::ProgramFile file, bool main, Session& session) {
  for (ir::Program& program : file.programs)
    add(std::move(program), main, session);
}

void ProgramLibrary::add(ir::Program program, bool main, Session& session) {
  const bool named = program.nameKind != ir::Program::NameKind::None;
  // The main program may lack a header, and nothing but it.
  if (!named && (!main || !programs_.empty() || program.body.empty())) return;
  const bool twice = program.number != 0 && !numbers_.insert(program.number).second;
  if (!twice) {
    programs_.push_back(std::move(program));
    return;
  }
  Diagnostic& finding = session.diagnostics().report<diag::ProgramTwice>(program.range, program.number);
  const auto first = std::find_if(programs_.begin(), programs_.end(),
                                  [&](const ir::Program& one) { return one.number == program.number; });
  if (first != programs_.end()) finding.note(first->range, "the first one");
}

std::vector<const ir::Program*> ProgramLibrary::programs() const {
  std::vector<const ir::Program*> out;
  for (const ir::Program& program : programs_)
    out.push_back(&program);
  return out;
}

} // namespace dotek::project
