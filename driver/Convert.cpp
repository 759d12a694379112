#include "driver/ConvertFusion.h"
#include "driver/ConvertMikroprog.h"
#include "driver/ConvertPrograms.h"
#include "driver/ConvertVerify.h"
#include "driver/Driver.h"
#include "driver/Targets.h"
#include "project/Lowering.h"
#include "project/Prog.h"
#include "project/Programs.h"
#include "project/Values.h"

#include "backends/fanuc/Emit.h"
#include "frontend/gibbs/Ast.h"
#include "ir/Fold.h"
#include "ir/Positions.h"
#include "support/Decimal.h"
#include "support/LineMap.h"
#include "support/NearestName.h"
#include "support/messages/Commands.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Fusion.h"
#include "support/messages/Mikroprog.h"

#include <algorithm>
#include <set>

namespace dotek::driver {

namespace fanuc = backends::fanuc;

namespace {

constexpr std::uint32_t kFirstProgram = 8000;

class ConvertCommand {
public:
  ConvertCommand(const ConvertOptions& options, Session& session)
      : options_(options), session_(session), programs_(options, session) {}

  Outcome run() {
    if (!load()) return refuse();
    if (mikroprog()) {
      toMikroprog();
      return finish();
    }
    if (options_.to == "fusion" && inputs_) fusion_.emplace(options_, *inputs_, session_);
    for (const Input& input : order_) {
      if (input.isProgram)
        program(options_.inputs[input.index]);
      else
        one(folders_[input.index], input.index);
    }
    if (fusion_) fusion_->finish(files_, maps_);
    return finish();
  }

private:
  bool mikroprog() const { return options_.to == "mikroprog"; }

  Outcome finish() {
    if (inputs_) reportUnknownNames();
    if (!session_.diagnostics().hasErrors()) filesDiffer();
    if (session_.diagnostics().hasErrors()) return refuse();
    keepStrongest(session_.diagnostics());
    std::string text;
    for (const OutputFile& file : files_)
      text += file.text;
    std::string map = renderLineMap(maps_, session_.sources());
    std::vector<MappedResult> maps = maps_;
    Outcome outcome = outcomeOf(session_, std::move(text));
    if (outcome.status != 0) return outcome;
    outcome.files = std::move(files_);
    outcome.map = std::move(map);
    outcome.maps = std::move(maps);
    outcome.arguments = std::move(arguments_);
    outcome.macros = std::move(called_);
    outcome.macrosByCycle = std::move(macrosByCycle_);
    return outcome;
  }

  Outcome refuse() {
    keepStrongest(session_.diagnostics());
    return outcomeOf(session_, "");
  }

  bool load() {
    Diagnostics& diagnostics = session_.diagnostics();
    if (options_.inputs.empty())
      diagnostics.report<diag::MissingOption>({}, "convert", "INPUT",
                                              "the folder of a cycle or a file of programs");
    if (options_.to.empty())
      diagnostics.report<diag::MissingOption>({}, "convert", "--to TARGET",
                                              "the language to write: fanuc, mikroprog or fusion");
    else if (std::find(kTargets.begin(), kTargets.end(), options_.to) == kTargets.end())
      diagnostics.report<diag::UnknownTarget>({}, options_.to);
    if (options_.source.cycle && options_.inputs.size() > 1) diagnostics.report<diag::CycleWithSeveral>({});
    if (options_.to == "fusion") FusionParts::checkOptions(options_, diagnostics);
    if (options_.wholePost && options_.to == "fanuc") diagnostics.report<diag::WholePostOfControl>({});
    if (options_.oneFile && options_.inputs.size() > 1 && !options_.wholePost)
      diagnostics.report<diag::OutputForOne>({}, options_.inputs.size());
    readLetters();
    const bool programs = classify();
    const bool cycles = !folderPaths_.empty();
    refuseOptions(options_, programs, cycles, session_);
    if (programs && options_.to != "fanuc") diagnostics.report<diag::ProgramTarget>({}, options_.to);
    if (diagnostics.hasErrors() || (programs && !programs_.load())) return false;
    if (!cycles) return true;
    // For Mikroprog the control is chosen by the cycle; the profile that is loaded here tells of the source.
    const bool own = options_.control.empty() || mikroprog();
    inputs_ =
        loadLoweringInputs(options_.source, own ? std::string(kDefaultControl) : options_.control, session_);
    if (!inputs_) return false;
    if (!mikroprog() && !options_.datum.empty())
      diagnostics.report<diag::FlagOfOtherTarget>({}, "--datum", options_.to);
    if (mikroprog() && !MikroprogConversion(options_, *inputs_, session_).checkFlags()) return false;
    if (options_.probeMacros && inputs_->macroSet(*options_.probeMacros) == nullptr) {
      std::vector<std::string> known;
      for (const stdlib::MacroSet& set : inputs_->macroSets)
        known.push_back(set.name);
      leaveFindingsToLint(session_);
      diagnostics.report<diag::UnknownMacroSet>({}, *options_.probeMacros,
                                                fmt::format("{}", fmt::join(known, ", ")));
      return false;
    }
    for (const std::string& path : folderPaths_)
      folders_.push_back(loadCycleFolder(path, session_));
    if (options_.source.cycle) folders_.front().name = *options_.source.cycle;
    leaveFindingsToLint(session_);
    if (!mikroprog() && inputs_->job && !inputs_->job->operations.empty())
      diagnostics.report<diag::JobOperationsUnused>(inputs_->job->operations.front().range);
    return !diagnostics.hasErrors() && (options_.to != "fanuc" || numbersDiffer());
  }

  // Whether there are programs among the inputs.
  bool classify() {
    bool programs = false;
    for (std::size_t i = 0; i < options_.inputs.size(); ++i) {
      if (isProgramFile(options_.inputs[i], session_)) {
        order_.push_back({true, i});
        programs = true;
        continue;
      }
      order_.push_back({false, folderPaths_.size()});
      folderPaths_.push_back(options_.inputs[i]);
    }
    return programs;
  }

  void readLetters() {
    for (const auto& [name, text] : options_.letters) {
      if (text.size() != 1)
        session_.diagnostics().report<diag::LetterNotAllowed>({}, name, text);
      else if (!letters_.emplace(name, text[0]).second)
        session_.diagnostics().report<diag::GivenTwice>({}, "--arg", name);
    }
  }

  std::uint32_t numberOf(std::size_t index) const {
    if (options_.programNumber) return *options_.programNumber;
    if (inputs_->job && inputs_->job->number) return static_cast<std::uint32_t>(*inputs_->job->number);
    return kFirstProgram + static_cast<std::uint32_t>(index);
  }

  bool numbersDiffer() {
    if (folders_.size() < 2 || numberOf(0) != numberOf(1)) return true;
    session_.diagnostics().report<diag::ProgramNumberTwice>({}, numberOf(0), folders_[0].name,
                                                            folders_[1].name);
    return false;
  }

  // The set that the program calls: given, else the source's; a path alone takes the first that touches
  // without setting an offset.
  const stdlib::MacroSet* macrosOf(const LoweredCycle& lowered) {
    if (options_.probeMacros) return inputs_->macroSet(*options_.probeMacros);
    if (lowered.macros != nullptr) return lowered.macros;
    for (const stdlib::MacroSet& set : inputs_->macroSets) {
      const stdlib::MacroSignature* surface = set.find(stdlib::Intent::Surface);
      const stdlib::MacroArgument* system =
          surface == nullptr ? nullptr : surface->find(stdlib::ArgumentRole::System, ir::Axis::X);
      if (surface == nullptr || (system != nullptr && system->required)) continue;
      // A vendor's set before one whose text has to be brought along.
      if (session_.data().find("macrob", set.name) != nullptr) continue;
      session_.diagnostics().report<diag::MacroSetChosen>({}, lowered.cycle.name, set.name);
      return &set;
    }
    session_.diagnostics().report<diag::MissingOption>({}, "convert", "--probe-macros SET",
                                                       "the macros that the program calls");
    return nullptr;
  }

  void one(const CycleFolder& folder, std::size_t index) {
    std::optional<LoweredCycle> lowered = lowerCycle(folder, *inputs_, usedSets_, session_);
    if (!lowered) {
      failed_ = true;
      return;
    }
    lowered->cycle.name = folder.name;
    applyDefaults(options_.defaults, *lowered, usedDefaults_, session_);
    std::map<ir::VariableId, double> defaults;
    for (ir::VariableId id = 0; id < lowered->cycle.variables.size(); ++id)
      if (const auto value = lowered->cycle.variable(id).defaultValue) defaults.emplace(id, *value);
    settleValues(folder, *lowered, session_);
    if (fusion_) {
      called_ = options_.probeMacros         ? *options_.probeMacros
                : lowered->macros != nullptr ? lowered->macros->name
                                             : "";
      if (!session_.diagnostics().hasErrors()) fusion_->add(folder, *lowered, std::move(defaults));
      return;
    }
    const stdlib::MacroSet* macros = macrosOf(*lowered);
    if (macros == nullptr || session_.diagnostics().hasErrors()) return;
    for (const auto& [id, value] : lowered->fixed) {
      const ir::Variable& variable = lowered->cycle.variable(id);
      const bool plane = variable.name == "retract" && ir::countsFrom(lowered->cycle, ir::Frame::Retract);
      if (!ir::uses(lowered->cycle, id) && !plane && variable.role == ir::Role::Host)
        lowered->fixedByName.erase(variable.name);
    }
    ir::fold(lowered->cycle, lowered->fixed);
    fanuc::EmitOptions emit{*inputs_->control, *macros, *inputs_->sourceControl, 0, {}, {}, {}, {}};
    emit.plainMessages = options_.common.assume.contains("plain-messages");
    emit.foreignMacros = macros != lowered->macros;
    emit.programNumber = numberOf(index);
    emit.defaults = options_.useDefaults ? fanuc::Defaults::Use : fanuc::Defaults::Alarm;
    emit.probePower = options_.switchProbe ? fanuc::ProbePowerMode::Macro : fanuc::ProbePowerMode::Source;
    emit.letters = lettersOf(*lowered);
    emit.fixed = lowered->fixedByName;
    for (const char* place : {"start_x", "start_y", "start_z"}) {
      if (const auto given = inputs_->hosts.find(place); given != inputs_->hosts.end())
        emit.fixed.insert(*given);
    }
    const auto lines = fanuc::emit(lowered->cycle, emit, session_.sources(), session_.diagnostics());
    if (!lines) return;
    Diagnostics told; // by emit() already
    std::vector<OutputArgument> arguments;
    if (const auto letters = fanuc::assignLetters(lowered->cycle, emit, told))
      for (const fanuc::Argument& one : *letters)
        arguments.push_back({lowered->cycle.variable(one.variable).name, one.letter});
    arguments_.push_back(std::move(arguments));
    called_ = macros->name;
    macrosByCycle_.push_back(macros->name);
    numbers_.emplace_back(emit.programNumber, folder.name);
    add(*lines, emit.programNumber);
  }

  void toMikroprog() {
    MikroprogConversion conversion(options_, *inputs_, session_);
    for (const CycleFolder& folder : folders_) {
      std::optional<MikroprogProgram> program = conversion.run(folder, usedSets_, usedDefaults_);
      if (!program) {
        failed_ = true;
        continue;
      }
      files_.push_back(std::move(program->file));
      maps_.push_back(std::move(program->map));
    }
  }

  // --arg names are those of this cycle, as it spells them.
  std::map<std::string, char> lettersOf(const LoweredCycle& lowered) {
    std::map<std::string, char> out;
    for (const auto& [name, letter] : letters_) {
      const std::string folded = frontend::gibbs::foldCase(name);
      for (const ir::Variable& variable : lowered.cycle.variables) {
        if (variable.role == ir::Role::Local || frontend::gibbs::foldCase(variable.name) != folded) continue;
        usedLetters_.insert(name);
        out.emplace(variable.name, letter);
      }
    }
    return out;
  }

  void program(const std::string& path) {
    std::optional<ConvertedFile> converted = programs_.convert(path);
    if (!converted) return;
    for (const std::uint64_t number : converted->numbers)
      numbers_.emplace_back(number, path);
    files_.push_back(std::move(converted->file));
    maps_.push_back(std::move(converted->map));
  }

  // Neither two files of one name nor two programs of one number. Two of one file were compared before.
  void filesDiffer() {
    std::map<std::uint64_t, std::string> byNumber;
    for (const auto& [number, path] : numbers_) {
      const auto [first, added] = byNumber.emplace(number, path);
      if (!added && first->second != path)
        session_.diagnostics().report<diag::ProgramNumberTwice>({}, number, first->second, path);
    }
    std::set<std::string> names;
    for (const OutputFile& file : files_)
      if (!names.insert(file.name).second)
        session_.diagnostics().report<diag::OutputNameTwice>({}, file.name);
  }

  void add(const std::vector<fanuc::EmittedLine>& lines, std::uint32_t number) {
    OutputFile file{fmt::format("O{:04}.nc", number), ""};
    MappedResult map{file.name, {}};
    for (const fanuc::EmittedLine& line : lines) {
      file.text += line.text + "\n";
      map.lines.push_back({static_cast<std::uint32_t>(map.lines.size() + 1), line.ranges, line.reason});
    }
    files_.push_back(std::move(file));
    maps_.push_back(std::move(map));
  }

  void reportUnknownNames() {
    if (failed_) return;
    std::string cycles;
    std::vector<std::string> names;
    for (const CycleFolder& folder : folders_) {
      cycles += (cycles.empty() ? "" : ", ") + folder.name;
      for (const auto& field : frontend::gibbs::declaredFields(*folder.cycle))
        names.push_back(field.name.text);
    }
    const auto unknown = [&](const std::string& name) {
      const std::string near = nearestName(name, names);
      session_.diagnostics().report<diag::NoSuchField>({}, name, cycles,
                                                       near.empty() ? "" : "; did you mean `" + near + "`?");
    };
    for (const auto& [name, value] : inputs_->sets)
      if (!usedSets_.contains(name)) unknown(name);
    for (const auto& [name, text] : options_.defaults)
      if (!usedDefaults_.contains(name)) unknown(name);
    for (const auto& [name, letter] : letters_) {
      if (usedLetters_.contains(name) || session_.diagnostics().hasErrors()) continue;
      const std::string near = nearestName(name, names);
      session_.diagnostics().report<diag::ArgumentUnknown>(
          {}, name, near.empty() ? "" : "; did you mean `" + near + "`?");
    }
  }

  struct Input {
    bool isProgram = false;
    std::size_t index = 0; // in the inputs of a program, in folders_ of a cycle
  };

  const ConvertOptions& options_;
  Session& session_;
  ProgramConversion programs_;
  std::vector<Input> order_;
  std::vector<std::string> folderPaths_;
  std::vector<std::pair<std::uint64_t, std::string>> numbers_; // of the results, with their inputs
  std::optional<LoweringInputs> inputs_;                       // nothing: no cycle
  std::vector<CycleFolder> folders_;
  std::map<std::string, char> letters_;
  std::set<std::string> usedSets_, usedDefaults_, usedLetters_;
  std::vector<OutputFile> files_;
  std::vector<MappedResult> maps_;
  std::vector<std::vector<OutputArgument>> arguments_;
  std::vector<std::string> macrosByCycle_;
  std::string called_;                // set of macros
  std::optional<FusionParts> fusion_; // with --to fusion
  bool failed_ = false;
};

} // namespace

Outcome convert(const ConvertOptions& options) {
  Outcome outcome =
      guarded(options.common, [&](Session& session) { return ConvertCommand(options, session).run(); });
  return options.verify && outcome.status == 0 ? verified(options, std::move(outcome)) : outcome;
}

} // namespace dotek::driver
