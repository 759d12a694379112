#include "driver/CycleFolder.h"
#include "driver/Driver.h"
#include "driver/InputKind.h"
#include "driver/Job.h"
#include "driver/Lowering.h"
#include "driver/PostProgram.h"
#include "driver/Session.h"
#include "frontend/compost/Summary.h"
#include "frontend/macrob/Check.h"
#include "frontend/macrob/Parse.h"
#include "frontend/mikroprog/Check.h"
#include "frontend/mikroprog/Parse.h"
#include "support/Files.h"
#include "support/messages/ComPost.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"
#include "support/messages/Gibbs.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace dotek::driver {

namespace fs = std::filesystem;
namespace gibbs = frontend::gibbs;

namespace {

class LintCommand {
public:
  LintCommand(const LintOptions& options, Session& session) : options_(options), session_(session) {}

  Outcome run() {
    if (options_.paths.empty())
      session_.diagnostics().report<diag::MissingOption>({}, "lint", "PATH", "a file or a folder");
    if (session_.data().find("mikroprog", options_.control) != nullptr)
      mikroprog_ = stdlib::MikroprogControl::load(session_.data(), options_.control);
    else if (!options_.control.empty())
      control_ = loadControl(options_.control, session_);
    for (const std::string& path : options_.paths)
      visit(path, true);
    acceptEntryPoints();
    select();
    keepStrongest(session_.diagnostics());
    Outcome outcome = session_.finish("", true);
    // Findings are the result of lint, not its failure.
    if (outcome.status == 1) outcome.status = 0;
    return outcome;
  }

private:
  void visit(const std::string& path, bool named) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      file(path, named);
      return;
    }
    const bool cycle = isCycleFolder(path);
    // The folder's loader owns the trees of sub-macros; they are linted below as files of their own.
    if (cycle) loadCycleFolder(path, session_);
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(path, error))
      entries.push_back(entry.path());
    if (error) session_.diagnostics().report<diag::FileNotReadable>({}, path, error.message());
    std::sort(entries.begin(), entries.end());
    for (const fs::path& entry : entries) {
      const std::string name = entry.filename().string();
      if (name.starts_with('.') || (cycle && isUnitFile(name))) continue;
      visit(entry.generic_string(), false);
    }
  }

  static bool isUnitFile(const std::string& name) {
    const std::string folded = gibbs::foldCase(name);
    return folded == "DEFINEDATA.TXT" || folded == "CYCLEDATA.DLG" || folded == "CYCLEDATA.MAC" ||
           folded == "TOOLPATH.MAC";
  }

  static bool mayBeSource(const fs::path& path) {
    const std::string suffix = gibbs::foldCase(path.extension().string());
    return suffix == ".TXT" || suffix == ".MAC" || suffix == ".DLG" || suffix == ".NC" || suffix == ".SUF";
  }

  void file(const std::string& path, bool named) {
    if (!options_.common.from && path.ends_with(".toml") && job(path)) return;
    if (!named && !mayBeSource(path)) return;
    std::optional<InputKind> kind;
    if (options_.common.from) {
      kind = kindByName(*options_.common.from);
    } else {
      Diagnostics ignored;
      const std::optional<std::string> bytes =
          readBytes(path, session_.limits(), named ? session_.diagnostics() : ignored);
      if (!bytes) return;
      kind = recognise(path, *bytes);
    }
    if (!kind) {
      // A text that cannot be read says why; another one is none of ours.
      const std::optional<FileId> id = session_.read(path, Encoding::Cp1250);
      if (!named || !id) return;
      if (session_.sources().file(*id).bytes().empty())
        session_.diagnostics().report<diag::EmptyFile>({*id, 0, 0}, path);
      else
        session_.diagnostics().report<diag::UnknownKind>({}, path);
      return;
    }
    if (*kind == InputKind::Prog) {
      const auto program = loadProg(path, session_);
      if (!program) return;
      for (const auto* routine : frontend::compost::cycleRoutines(*program, session_.compostKeywords()))
        entryPoints_.insert(routine->name);
      return;
    }
    const std::optional<FileId> id =
        session_.read(path, *kind == InputKind::Suf ? Encoding::Cp852 : Encoding::Cp1250);
    if (!id) return;
    if (*kind == InputKind::Suf) return suf(*id);
    if (*kind == InputKind::Nc) {
      using namespace frontend;
      const macrob::File program =
          macrob::parse(*id, session_.sources(), session_.limits(), session_.diagnostics());
      macrob::checkFile(program, control_ ? &*control_ : nullptr, session_.sources(), session_.diagnostics());
      return;
    }
    const gibbs::ParseContext context{session_.sources(), session_.gibbsKeywords(), session_.limits(),
                                      session_.diagnostics()};
    if (*kind == InputKind::Macro) {
      const gibbs::Macro macro = gibbs::parseMacro(*id, context);
      MacroLoader loader(session_, fs::path(path).parent_path());
      gibbs::checkMacro(macro, loader.included(macro), context);
    } else if (*kind == InputKind::Dialog) {
      gibbs::checkDialog(gibbs::parseDialog(*id, context), context);
    } else {
      gibbs::checkDefineData(gibbs::parseDefineData(*id, context), context);
    }
  }

  // Without --control a program with Y is taken for one of a mill, else for one of the lathe.
  void suf(FileId id) {
    using namespace frontend;
    const mikroprog::Program program = mikroprog::parse(id, session_.sources(), session_.diagnostics());
    const bool mill =
        std::any_of(program.lines.begin(), program.lines.end(), [](const mikroprog::Line& line) {
          return line.find('Y') != nullptr || line.find('J') != nullptr;
        });
    const auto control =
        mikroprog_
            ? mikroprog_
            : stdlib::MikroprogControl::load(session_.data(), mill ? "mikroprog-mill" : "mikroprog-s280");
    if (control) mikroprog::checkProgram(program, *control, session_.sources(), session_.diagnostics());
  }

  // A routine that prints for a cycle is called for its operations; others are named by a job.
  void acceptEntryPoints() {
    std::erase_if(session_.diagnostics().all(), [&](const Diagnostic& d) {
      return d.code == diag::RoutineNeverCalled::code &&
             entryPoints_.contains(std::string(session_.sources().text(d.range)));
    });
  }

  // A job in TOML: a file with operations.
  bool job(const std::string& path) {
    Diagnostics ignored;
    const std::optional<std::string> bytes = readBytes(path, session_.limits(), ignored);
    const bool isJob = bytes && (bytes->starts_with("operation") || bytes->starts_with("[[operation]]") ||
                                 bytes->find("\noperation") != std::string::npos ||
                                 bytes->find("\n[[operation]]") != std::string::npos);
    if (!isJob) return false;
    const auto loaded = loadJob(path, session_.limits(), session_.sources(), session_.diagnostics());
    if (!loaded) return true;
    for (const auto& routine : {loaded->startRoutine, loaded->operationRoutine, loaded->endRoutine}) {
      if (routine) entryPoints_.insert(*routine);
    }
    return true;
  }

  void select() {
    auto& all = session_.diagnostics().all();
    std::erase_if(all, [&](const Diagnostic& d) {
      if (isUsageCode(d.code) || d.code == diag::TooManyFindings::code) return false;
      const std::string code(d.code);
      return (options_.select && !options_.select->contains(code)) || options_.ignore.contains(code);
    });
  }

  const LintOptions& options_;
  Session& session_;
  std::optional<stdlib::Control> control_;            // --control
  std::optional<stdlib::MikroprogControl> mikroprog_; // the same, for .SUF
  std::set<std::string> entryPoints_;                 // routines that run without a call in the Prog
};

} // namespace

Outcome lint(const LintOptions& options) {
  return guarded(options.common, [&](Session& session) { return LintCommand(options, session).run(); });
}

} // namespace dotek::driver
