#include "support/messages/Lint.h"
#include "driver/ChangedFiles.h"
#include "driver/ChangedTogether.h"
#include "driver/Command.h"
#include "driver/Companions.h"
#include "driver/Driver.h"
#include "driver/LintBaseline.h"
#include "driver/LintFix.h"
#include "frontend/compost/Summary.h"
#include "frontend/fusion/Declared.h"
#include "frontend/fusion/Parse.h"
#include "frontend/gibbs/Check.h"
#include "frontend/macrob/Check.h"
#include "frontend/mikroprog/Parse.h"
#include "lint/Baseline.h"
#include "lint/Config.h"
#include "lint/PostEntries.h"
#include "lint/PostFile.h"
#include "lint/PostedBlocks.h"
#include "lint/Project.h"
#include "lint/Projects.h"
#include "lint/Run.h"
#include "lint/Shared.h"
#include "lint/Suppressions.h"
#include "project/Compilation.h"
#include "project/CycleFiles.h"
#include "project/CycleFolder.h"
#include "project/CycleLowering.h"
#include "project/InputWalk.h"
#include "project/Inputs.h"
#include "project/Job.h"
#include "project/PostShape.h"
#include "project/Programs.h"
#include "support/Files.h"
#include "support/WholeName.h"
#include "support/messages/ComPost.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"
#include "support/messages/Gibbs.h"
#include "support/messages/Posts.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <set>
#include <tuple>

namespace dotek::driver {

namespace fs = std::filesystem;
namespace gibbs = frontend::gibbs;
namespace compost = frontend::compost;
namespace macrob = frontend::macrob;

namespace {

// Bytes of a file of programs from which on the trees of all its plain moves are too many to keep.
constexpr std::size_t kSummaryFrom = 1U << 20U;

class LintCommand {
public:
  LintCommand(const LintOptions& options, Session& session)
      : options_(options), session_(session), configs_(session), compilation_(session), cycles_(session),
        projects_(options, configs_, compilation_),
        walk_(
            options.followLinks, session.limits().files,
            [this](const std::string& path, bool) { folder(path); },
            [this](const std::string& path, bool named) { file(path, named); }) {}

  Outcome run() {
    if (options_.paths.empty())
      session_.diagnostics().report<diag::MissingOption>({}, "lint", "PATH", "a file or a folder");
    for (const std::string& path : options_.paths)
      configs_.of(path);
    // A setting that is not understood would change what is reported: nothing is reported then.
    if (session_.diagnostics().hasErrors()) return failed();
    if (!options_.changedSince.empty()) {
      changed_ = changedFiles(options_.paths, options_.changedSince, session_.diagnostics());
      if (!changed_) return failed();
    }
    inputs_ = compilation_.load(options_.source, "");
    if (inputs_ == nullptr) return failed();
    for (const std::string& path : options_.paths)
      if (std::error_code error; fs::is_directory(path, error)) session_.addInputRoot(path);
    for (const std::string& path : options_.paths)
      walk_.visit(path, session_.diagnostics());
    companions_.walk(options_.programs, walk_, session_);
    if (walk_.ended()) {
      std::erase_if(session_.diagnostics().all(),
                    [](const Diagnostic& d) { return d.code != diag::TooManyFiles::code; });
      return failed();
    }
    if (checkedFiles_ == 0 && !session_.diagnostics().hasErrors() && !options_.paths.empty())
      session_.diagnostics().report<diag::NothingRead>(
          {}, fmt::format("`{}`", fmt::join(options_.paths, "`, `")) +
                  (excluded_ == 0 ? "" : fmt::format(" beside the {} that dotek.toml excludes", excluded_)));
    const std::deque<lint::Project>& projects = projects_.gather(*inputs_, sufReadings_, checked_, posts_);
    if (changed_) together_.emplace(projects, *changed_, [this](FileId file) { return isChanged(file); });
    // Shared rules all run, since one that nobody asked for may tell why another finding begins at its place.
    const auto wanted = [&](const lint::NamedRule& rule) {
      return rule.rule->shared || isWantedSomewhere(rule.id);
    };
    Diagnostics separate;
    std::size_t done = 0;
    for (const lint::Project& project : projects) {
      say("{} files read, rules on part {} of {}", checkedFiles_, ++done, projects.size());
      lint::runRules(project, session_.diagnostics(), separate, wanted);
    }
    acceptEntryPoints();
    keepStrongest(session_.diagnostics());
    dropReadsOfUndefined();
    lint::moveInto(session_.diagnostics(), separate);
    for (const lint::Project& project : projects)
      lint::lintPosted(project, session_.diagnostics(), wanted);
    reportUnknownSets();
    configs_.reportUnused(options_.paths);
    suppress(projects);
    lint::keepOneOfEach(session_.diagnostics());
    select();
    session_.diagnostics().sort();
    if (!passOverBaseline()) return failed();
    std::string baseline;
    if (options_.writeBaseline) {
      const std::optional<lint::Baseline> before =
          keptBaseline(*options_.writeBaseline, session_, passedOver_);
      if (!before) return failed();
      const lint::Baseline::Judged judged = judgedBy(lookedAt(), session_.sources());
      baseline = lint::Baseline::render(session_.diagnostics(), session_.sources(), *options_.writeBaseline,
                                        *before, judged);
      if (const std::size_t others = before->others(judged); others > 0)
        passedOver_ = fmt::format("{} of the baseline stay{}: this run did not look for {}", others,
                                  others == 1 ? "s" : "", others == 1 ? "it" : "them");
    }
    const bool fails = !options_.writeBaseline && failsNow();
    Outcome outcome = outcomeOf(session_, "", true);
    outcome.summary = summary();
    if (options_.writeBaseline) outcome.files.push_back({"baseline", baseline});
    // Findings are the result of lint, not its failure.
    if (outcome.status == 1) outcome.status = 0;
    if (outcome.status == 0 && fails) outcome.status = 1;
    return outcome;
  }

private:
  template <class... Values> void say(fmt::format_string<Values...> text, Values&&... values) const {
    if (options_.progress) options_.progress(fmt::format(text, std::forward<Values>(values)...));
  }

  // false: it cannot be read; reported.
  bool passOverBaseline() {
    if (!options_.baseline) return true;
    std::optional<lint::Baseline> baseline = readBaseline(*options_.baseline, session_);
    if (!baseline) return false;
    baseline->passOver(session_.diagnostics(), session_.sources());
    passedOver_ = fmt::format("{} of the baseline left out", baseline->passedOver());
    if (const std::size_t blind = baseline->passedBlindly(); blind > 0)
      passedOver_ +=
          fmt::format(", {} of them with further places, which the list of an older version does not "
                      "know: write it anew",
                      blind);
    if (const std::size_t gone = baseline->gone(judgedBy(lookedAt(), session_.sources())); gone > 0)
      passedOver_ += fmt::format(", {} of it no longer found: write it anew", gone);
    else if (baseline->isOfOthers(session_.sources()))
      passedOver_ += ", as it is of other files: it names them from its own folder";
    return true;
  }

  LookedAt lookedAt() {
    return {options_.paths, [this](FileId file) { return !changed_ || isChanged(file); },
            [this](const std::string& code) { return isWantedSomewhere(code); },
            [this](const std::string& code, FileId file) {
              if (code == diag::PathUnused::code && !configs_.knowsUnused(file)) return false;
              return lint::isWanted(code, options_, projects_.configOf(file));
            }};
  }

  Outcome failed() {
    Outcome outcome = outcomeOf(session_, "", true);
    outcome.status = 2;
    return outcome;
  }

  // "": only files were named, and each of them was read or is an error.
  std::string summary() const {
    std::error_code error;
    const bool folders = std::any_of(options_.paths.begin(), options_.paths.end(),
                                     [&](const std::string& path) { return fs::is_directory(path, error); });
    std::string out =
        folders ? walkSummary(checkedFiles_, excluded_, walk_.passedOver(),
                              options_.paths.size() == 1 ? options_.paths.front() : "", options_.listSkipped)
                : "";
    if (!passedOver_.empty()) out += (out.empty() ? "" : "\n") + passedOver_;
    return out;
  }

  bool isWantedSomewhere(std::string_view code) {
    for (const std::string& path : options_.paths)
      if (lint::isWanted(code, options_, *configs_.of(path))) return true;
    for (FileId file = 0; file < session_.sources().size(); ++file)
      if (lint::isWanted(code, options_, projects_.configOf(file))) return true;
    return false;
  }

  void reportUnknownSets() {
    if (inputs_->sets.empty()) return;
    std::string cycles;
    std::set<std::string> declared; // also by cycles without a Prog
    for (const CycleFolder& folder : compilation_.folders()) {
      if (!folder.cycle) continue;
      const gibbs::Cycle* const cycle = folder.cycle.get();
      cycles += (cycles.empty() ? "" : ", ") + cycle->name;
      for (const gibbs::Field& field : gibbs::declaredFields(*cycle))
        declared.insert(gibbs::foldCase(field.name.text));
    }
    for (const auto& [name, value] : inputs_->sets)
      if (!compilation_.usedSets().contains(name) && !declared.contains(gibbs::foldCase(name)))
        session_.diagnostics().report<diag::NoSuchField>({}, name, cycles, "");
  }

  void suppress(const std::deque<lint::Project>& projects) {
    std::vector<lint::Suppression> suppressions;
    std::set<std::tuple<FileId, std::uint32_t, std::uint32_t>> seen;
    std::set<FileId> joined;
    std::set<FileId> lowered;
    for (const lint::Project& project : projects) {
      // A file of several projects says it once.
      for (lint::Suppression& one : lint::suppressionsOf(project, session_.diagnostics()))
        if (seen.emplace(one.range.file, one.range.begin, one.range.end).second)
          suppressions.push_back(std::move(one));
      for (const lint::Joined& one : project.joined) {
        std::set<FileId> files{one.prog->file};
        if (one.cycle->defineData) files.insert(one.cycle->defineData->file);
        if (one.cycle->dialog) files.insert(one.cycle->dialog->file);
        if (one.cycle->cycleData) files.insert(one.cycle->cycleData->file);
        if (one.cycle->toolPath) files.insert(one.cycle->toolPath->file);
        joined.insert(files.begin(), files.end());
        if (one.lowered) lowered.insert(files.begin(), files.end());
      }
      for (const lint::NcFile& nc : project.programs)
        if (nc.lowered) lowered.insert(nc.file->file);
    }
    for (lint::Suppression& one :
         lint::suppressionsOf(cycleFiles_, session_.sources(), session_.diagnostics()))
      suppressions.push_back(std::move(one));
    if (suppressions.empty()) return;
    lint::applySuppressions(suppressions, session_.sources(), session_.diagnostics(),
                            [&](std::string_view code, FileId file) {
                              if (!lint::isWanted(code, options_, projects_.configOf(file))) return false;
                              const lint::NamedRule* named = lint::findRule(code);
                              if (named == nullptr || named->rule->shared) return true;
                              if (named->rule->tier == lint::Tier::Bundle) return joined.contains(file);
                              if (named->rule->tier == lint::Tier::Ir) return lowered.contains(file);
                              return true;
                            });
  }

  // A variable that nothing sets is one that is read before it is set.
  void dropReadsOfUndefined() {
    auto& all = session_.diagnostics().all();
    std::set<std::pair<FileId, std::uint32_t>> undefined;
    for (const Diagnostic& d : all)
      if (d.code == frontend::gibbs::undefinedVariableCheck.code)
        undefined.emplace(d.range.file, d.range.begin);
    std::erase_if(all, [&](const Diagnostic& d) {
      return d.code == diag::ReadBeforeSet::code && undefined.contains({d.range.file, d.range.begin});
    });
  }

  bool failsNow() {
    for (const Diagnostic& d : session_.diagnostics().all()) {
      const FailOn level = options_.failOn
                               ? *options_.failOn
                               : projects_.configOf(d.range.file).failOn.value_or(FailOn::Warning);
      if (level == FailOn::Never) continue;
      const Severity from = level == FailOn::Note    ? Severity::Note
                            : level == FailOn::Error ? Severity::Error
                                                     : Severity::Warning;
      if (d.severity >= from) return true;
    }
    return false;
  }

  void folder(const std::string& path) {
    if (configs_.of(path)->exclude) return;
    // The folder's loader owns the trees of sub-macros; they are linted as files of their own.
    if (isCycleFolder(path)) compilation_.addFolder(path, false);
  }

  // The loader of a cycle's folder has read it.
  static bool isPartOfCycle(const fs::path& path) {
    const std::string name = gibbs::foldCase(path.filename().string());
    return name == "DEFINEDATA.TXT" || name == "CYCLEDATA.DLG" || name == "CYCLEDATA.MAC" ||
           name == "TOOLPATH.MAC";
  }

  void file(const std::string& path, bool named) {
    if (companions_.walks)
      return companions_.take(path, session_, [this](const std::string& one) { read(one, InputKind::Nc); });
    companions_.note(path);
    say("{} files read", checkedFiles_);
    if (!named && configs_.of(path)->exclude) {
      ++excluded_;
      return;
    }
    if (!options_.common.from && path.ends_with(".toml") && job(path)) {
      ++checkedFiles_;
      return;
    }
    if (!named && isPartOfCycle(path)) {
      ++checkedFiles_;
      return;
    }
    const Recognition* const found = session_.kindOf(path, session_.diagnostics());
    if (found == nullptr) return;
    if (isPost(*found)) {
      ++checkedFiles_;
      if (const auto id = session_.read(path, Encoding::Cp1250)) post(*id);
      return;
    }
    if (!found->kind) {
      notRead(path, named, *found);
      return;
    }
    ++checkedFiles_;
    const bool program = found->kind == InputKind::Nc || found->kind == InputKind::Suf;
    if (program && found->reason == kEmptyInput) {
      // A transfer that broke off leaves such a file.
      if (const auto empty = session_.read(path, Encoding::Cp1250))
        session_.diagnostics().report<diag::EmptyFile>({*empty, 0, 0}, inputName(path));
      return;
    }
    read(path, *found->kind);
  }

  void notRead(const std::string& path, bool named, const Recognition& found) {
    if (!named) {
      // The settings were read.
      if (fs::path(path).filename() != "dotek.toml") walk_.passOver(path, found.reason);
      return;
    }
    const std::optional<FileId> empty =
        found.reason == kEmptyInput ? session_.read(path, Encoding::Cp1250) : std::nullopt;
    if (empty)
      session_.diagnostics().report<diag::EmptyFile>({*empty, 0, 0}, inputName(path));
    else
      reportNoInput(path, found, session_);
  }

  void read(const std::string& path, InputKind kind) {
    if (kind == InputKind::Prog) {
      const compost::Program* program = compilation_.addProg(path, false);
      if (program == nullptr) return;
      for (const auto* routine : compost::cycleRoutines(*program, session_.compostKeywords()))
        entryPoints_.insert(routine->name);
      return;
    }
    if (kind == InputKind::Cycle) {
      if (const auto file = checkCycleFile(path, cycles_, session_)) cycleFiles_.push_back(*file);
      return;
    }
    const std::optional<FileId> id =
        session_.read(path, kind == InputKind::Suf ? Encoding::Cp852 : Encoding::Cp1250);
    if (!id) return;
    if (kind == InputKind::Suf) return suf(*id);
    if (kind == InputKind::Nc) {
      const auto settings = projects_.settingsOf(*id);
      const stdlib::Control* const control =
          settings.control.empty() ? nullptr : session_.control(settings.control, settings.probe);
      const auto& programs = compilation_.addPrograms(
          *id, control == nullptr ? macrob::Forms{} : macrob::formsOf(*control),
          session_.sources().file(*id).bytes().size() < kSummaryFrom ? macrob::Keep::All
                                                                     : macrob::Keep::Summary);
      if (programs.programs.empty() && !programs.tooLarge)
        session_.diagnostics().report<diag::NoProgram>({*id, 0, 0}, inputName(path), "checked");
      return;
    }
    const gibbs::ParseContext context{session_.sources(), session_.gibbsKeywords(), session_.limits(),
                                      session_.diagnostics()};
    if (kind == InputKind::Macro) {
      const gibbs::Macro& macro = compilation_.addMacro(*id);
      checked_.emplace_back(macro, loaderOf(path, macro).included(macro), context);
    } else if (kind == InputKind::Dialog) {
      checked_.emplace_back(compilation_.addDialog(*id), context);
    } else {
      checked_.emplace_back(compilation_.addDefineData(*id), context);
    }
  }

  // What macros of one folder include is read once.
  MacroLoader& loaderOf(const std::string& path, const gibbs::Macro& macro) {
    const fs::path folder = fs::path(path).parent_path();
    auto& loader = loaders_[folder.generic_string()];
    if (!loader) loader = std::make_unique<MacroLoader>(session_, folder);
    loader->know(path, macro);
    return *loader;
  }

  void post(FileId id) {
    if (!fusionNames_) fusionNames_ = stdlib::FusionNames::load(session_.data());
    lint::PostFile& post = posts_.emplace_back();
    post.file = id;
    post.names = &*fusionNames_;
    post.tree = frontend::fusion::parse(id, session_.sources());
    for (const frontend::fusion::Unread& one : post.tree.unread)
      session_.diagnostics().report<diag::PostUnread>(one.range, one.message);
    post.scopes = frontend::fusion::resolve(post.tree);
    for (const frontend::fusion::Unread& one : frontend::fusion::declaredTwice(post.tree, post.scopes))
      session_.diagnostics().report<diag::PostUnread>(one.range, one.message);
    for (const lint::TopFunction& one : lint::topFunctions(post.tree))
      if (fusionNames_->entries.contains(one.name->text)) post.whole = true;
  }

  // Without --control a program with Y is taken for one of a mill, else for one of the lathe.
  void suf(FileId id) {
    using namespace frontend;
    const std::string named = projects_.settingsOf(id).control;
    const stdlib::MikroprogControl* control =
        session_.data().find("mikroprog", named) == nullptr ? nullptr : sufControl(named);
    const mikroprog::Program& program = sufPrograms_.emplace_back(mikroprog::parse(
        id, session_.sources(), session_.diagnostics(), session_.limits(), keepingOf(id, control)));
    if (control == nullptr)
      control = sufControl(std::string(mikroprog::profileOf(program).value_or(stdlib::kMikroprogLathe)));
    if (control != nullptr) sufReadings_.emplace_back(program, *control, session_.sources());
  }

  // `control`: named for the file. These rules look at each move.
  frontend::mikroprog::Keeping keepingOf(FileId id, const stdlib::MikroprogControl* control) {
    for (const std::string_view rule : {"suf-zeros", "suf-short-form", "suf-not-joined"})
      if (lint::isWanted(rule, options_, projects_.configOf(id))) return {};
    if (control == nullptr) {
      const auto* lathe = sufControl(stdlib::kMikroprogLathe);
      const auto* mill = sufControl(stdlib::kMikroprogMill);
      const bool plain = lathe != nullptr && mill != nullptr &&
                         frontend::mikroprog::takesPlainMoves(*lathe) &&
                         frontend::mikroprog::takesPlainMoves(*mill);
      return {plain ? "XYZ" : "", kSummaryFrom};
    }
    return {frontend::mikroprog::takesPlainMoves(*control) ? std::string_view(control->axes) : "",
            kSummaryFrom};
  }

  // nullptr: there is none, because --data took it away.
  const stdlib::MikroprogControl* sufControl(std::string_view name) {
    auto [at, isNew] = sufControls_.try_emplace(std::string(name));
    if (isNew) at->second = stdlib::MikroprogControl::load(session_.data(), name);
    return at->second ? &*at->second : nullptr;
  }

  // A routine that prints for a cycle is called for its operations; others are named by a job.
  void acceptEntryPoints() {
    std::erase_if(session_.diagnostics().all(), [&](const Diagnostic& d) {
      return d.code == compost::routineNeverCalledCheck.code &&
             entryPoints_.contains(std::string(session_.sources().text(d.range)));
    });
  }

  // A job in TOML: a file with operations.
  bool job(const std::string& path) {
    Diagnostics ignored;
    const std::optional<std::string> bytes = session_.bytes(path, ignored);
    const bool isJob = bytes && (bytes->starts_with("operation") || bytes->starts_with("[[operation]]") ||
                                 bytes->find("\noperation") != std::string::npos ||
                                 bytes->find("\n[[operation]]") != std::string::npos);
    if (!isJob) return false;
    const auto loaded = loadJob(path, session_);
    if (!loaded) return true;
    for (const auto& routine : {loaded->startRoutine, loaded->operationRoutine, loaded->endRoutine}) {
      if (routine) entryPoints_.insert(*routine);
    }
    return true;
  }

  void select() {
    auto& all = session_.diagnostics().all();
    repairListings(session_);
    std::erase_if(all, [&](const Diagnostic& d) {
      if (isUsageCode(d.code) || d.code == diag::TooManyFindings::code) return false;
      return projects_.isExcluded(d.range.file) ||
             !lint::isWanted(d.code, options_, projects_.configOf(d.range.file)) || isOfUnchanged(d) ||
             companions_.has(d);
    });
    for (Diagnostic& d : all) {
      const auto& severity = projects_.configOf(d.range.file).severity;
      if (const auto at = severity.find(d.code); at != severity.end() && at->second) d.severity = *at->second;
    }
  }

  // A finding whose other place is in a changed file is of that change, and so is one that may rest on it.
  bool isOfUnchanged(const Diagnostic& d) {
    if (!changed_ || !d.range.hasPlace() || together_->covers(d.code, d.range.file)) return false;
    return !isChanged(d.range.file) && std::none_of(d.notes.begin(), d.notes.end(), [&](const auto& note) {
      return note.range.hasPlace() && isChanged(note.range.file);
    });
  }
  bool isChanged(FileId file) {
    const auto [at, isNew] = isChanged_.try_emplace(file);
    if (isNew) at->second = changed_->contains(nameAmongChanged(session_.sources().file(file).name()));
    return at->second;
  }

  const LintOptions& options_;
  Session& session_;
  lint::Configs configs_;
  Compilation compilation_;
  CycleFiles cycles_;
  std::vector<FileId> cycleFiles_; // of the cycle language
  lint::Projects projects_;
  InputWalk walk_;
  std::size_t checkedFiles_ = 0, excluded_ = 0;
  Companions companions_;
  std::optional<std::set<std::string>> changed_; // names of --changed-since
  std::map<FileId, bool> isChanged_;
  std::optional<ChangedTogether> together_; // with those
  std::string passedOver_;                  // of the baseline, for the summary
  LoweringInputs* inputs_ = nullptr;
  std::map<std::string, std::unique_ptr<MacroLoader>> loaders_; // by folder
  std::set<std::string> entryPoints_;      // routines that run without a call in the Prog
  std::deque<gibbs::CheckedFile> checked_; // files that are no part of a cycle's folder
  std::deque<frontend::mikroprog::Program> sufPrograms_;
  std::deque<frontend::mikroprog::Reading> sufReadings_;
  std::optional<stdlib::FusionNames> fusionNames_;
  std::deque<lint::PostFile> posts_;
  std::map<std::string, std::optional<stdlib::MikroprogControl>> sufControls_; // loaded once, by name
};

Outcome lintOnce(const LintOptions& options) {
  return guarded(options.common, [&](Session& session) { return LintCommand(options, session).run(); });
}

// A repair may lay bare the next one; a few turns are enough for all that do not undo each other.
constexpr int kFixTurns = 8;

Outcome lintAndFix(const LintOptions& options) {
  Outcome outcome = lintOnce(options);
  if (!options.fix || outcome.status > 1) return outcome;
  std::vector<MadeFix> total;
  Diagnostics writing;
  for (int turn = 0; turn < kFixTurns; ++turn) {
    const auto made = applySafeFixes(outcome, options.common.limits, options.force, writing);
    if (made.empty()) break;
    total.insert(total.end(), made.begin(), made.end());
    outcome = lintOnce(options);
  }
  reportFixes(total, outcome);
  const std::string repairs =
      total.empty() ? "no repair to make: `dotek list rules` marks the rules that --fix repairs"
                    : fmt::format("{} repair{} made", total.size(), total.size() == 1 ? "" : "s");
  outcome.summary += (outcome.summary.empty() ? "" : "\n") + repairs;
  for (const Diagnostic& d : writing.all())
    outcome.diagnostics.add(d);
  if (writing.hasErrors()) outcome.status = 2;
  outcome.diagnostics.sort();
  return outcome;
}

// The turns of lintAndFix, on texts in memory.
Outcome proposed(LintOptions options) {
  options.fix = false;
  Outcome found = lintOnce(options);
  if (found.status > 1) return found;
  std::map<std::string, std::string> texts;
  std::size_t repairs = 0;
  std::vector<OutputFile> next;
  std::vector<MadeFix> made;
  next = safeFixes(found, made);
  for (int turn = 0; turn < kFixTurns && !next.empty(); ++turn) {
    repairs += made.size();
    auto buffers = std::make_shared<std::map<std::string, std::string>>();
    if (options.common.buffers) *buffers = *options.common.buffers;
    for (OutputFile& file : next)
      texts[file.name] = std::move(file.text);
    for (const auto& [name, text] : texts)
      (*buffers)[wholeName(name)] = text;
    options.common.buffers = buffers;
    made.clear();
    next = safeFixes(lintOnce(options), made);
  }
  for (auto& [name, text] : texts)
    found.files.push_back({name, std::move(text)});
  found.summary = repairs == 0 ? "no repair to make: `dotek list rules` marks the rules that --fix repairs"
                               : fmt::format("{} repair{} in {} file{} would be made; nothing is changed",
                                             repairs, repairs == 1 ? "" : "s", found.files.size(),
                                             found.files.size() == 1 ? "" : "s");
  found.status = repairs > 0 ? 1 : 0; // a gate for repairs that wait; findings are lint's
  return found;
}

} // namespace

Outcome proposeFixes(const LintOptions& options) {
  return caught([&] { return proposed(options); });
}

Outcome lint(const LintOptions& options) {
  return caught([&] { return lintAndFix(options); });
}

} // namespace dotek::driver
