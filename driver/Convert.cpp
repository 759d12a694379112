#include "driver/Command.h"
#include "driver/Controls.h"
#include "driver/ConvertFlat.h"
#include "driver/ConvertVerify.h"
#include "frontend/gibbs/Ast.h"
#include "project/Compilation.h"
#include "project/CycleLowering.h"
#include "project/Inputs.h"
#include "project/Prog.h"
#include "project/Programs.h"
#include "support/NearestName.h"
#include "support/Printable.h"
#include "support/messages/Commands.h"
#include "support/messages/Cycle.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Mikroprog.h"
#include "targets/Conversion.h"
#include "targets/Target.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace dotek::driver {

namespace {

class ConvertCommand {
public:
  ConvertCommand(const ConvertOptions& options, Session& session)
      : options_(options), session_(session),
        compilation_(session), context_{options, compilation_, session, compilation_.folders(),
                                        compilation_.usedSets()} {}

  Outcome run() {
    if (!load()) return refusal();
    for (Input& input : order_)
      byItself(input, [&] {
        if (input.isProgram)
          conversion_->program(options_.inputs[input.index]);
        else if (!conversion_->cycle(context_.folders[input.index], input.index))
          failed_ = true;
      });
    conversion_->finish();
    return finish();
  }

private:
  struct Input {
    bool isProgram = false;
    bool isCycleFile = false; // of the cycle language; else, and if it is no program, the folder of a cycle
    bool refused = false;     // with --keep-going
    std::size_t place = 0;    // among the inputs
    std::size_t index = 0;    // in the inputs of a program, in the folders of a cycle
    std::vector<Diagnostic> found;
  };

  // With --keep-going an error of this input refuses it alone, and what it has added is taken away.
  template <class Step> void byItself(Input& input, const Step& step) {
    if (input.refused) return;
    if (!options_.keepGoing) return together(input, step);
    ConversionResult& result = context_.result;
    const std::array sizes = {result.files.size(),         result.maps.size(),    result.arguments.size(),
                              result.macrosByCycle.size(), result.numbers.size(), result.handedBack.size()};
    Diagnostics others = std::exchange(session_.diagnostics(), Diagnostics());
    step();
    input.refused = session_.diagnostics().hasErrors();
    std::swap(others, session_.diagnostics());
    for (Diagnostic& one : others.all()) {
      input.found.push_back(one);
      said_.push_back(std::move(one));
    }
    if (!input.refused) return;
    result.files.resize(sizes[0]);
    result.maps.resize(sizes[1]);
    result.arguments.resize(sizes[2]);
    result.macrosByCycle.resize(sizes[3]);
    result.numbers.resize(sizes[4]);
    result.handedBack.resize(sizes[5]);
  }

  // An error of one input refuses all; what follows it is not told apart any more.
  template <class Step> void together(Input& input, const Step& step) {
    if (session_.diagnostics().hasErrors()) return step();
    Diagnostics others = std::exchange(session_.diagnostics(), Diagnostics());
    step();
    std::swap(others, session_.diagnostics());
    for (Diagnostic& one : others.all()) {
      input.found.push_back(one);
      session_.diagnostics().add(std::move(one));
    }
  }

  // What was found in inputs by themselves.
  void sayAll() {
    for (Diagnostic& one : said_)
      session_.diagnostics().add(std::move(one));
    said_.clear();
  }

  Outcome refusal() {
    sayAll();
    return refusalOf(session_);
  }

  Outcome finish() {
    if (context_.inputs != nullptr) reportUnknownNames();
    if (!session_.diagnostics().hasErrors()) filesDiffer();
    const bool refused = session_.diagnostics().hasErrors();
    if (refused) return refusal();
    sayAll();
    keepStrongest(session_.diagnostics());
    ConversionResult& result = context_.result;
    std::string text;
    for (const OutputFile& file : result.files)
      text += file.text;
    Outcome outcome = outcomeOf(session_, std::move(text));
    if (outcome.status != 0 && !options_.keepGoing) return outcome;
    if (outcome.status == 2) outcome.status = 1; // some inputs are refused, and the others are written
    for (Input& input : order_) {
      if (input.refused) continue;
      outcome.inputs.push_back(options_.inputs[input.place]);
      outcome.foundIn.push_back(std::move(input.found));
    }
    for (Input& input : order_)
      if (input.refused) outcome.foundIn.push_back(std::move(input.found));
    outcome.files = std::move(result.files);
    outcome.helpers = std::move(result.helpers);
    outcome.maps = std::move(result.maps);
    outcome.arguments = std::move(result.arguments);
    outcome.handedBack = std::move(result.handedBack);
    outcome.macros = std::move(result.macros);
    outcome.macrosByCycle = std::move(result.macrosByCycle);
    return outcome;
  }

  bool load() {
    Diagnostics& diagnostics = session_.diagnostics();
    if (options_.inputs.empty())
      diagnostics.report<diag::MissingOption>({}, "convert", "INPUT",
                                              "the folder of a cycle or a file of programs");
    if (options_.source.cycle && options_.inputs.size() > 1) diagnostics.report<diag::CycleWithSeveral>({});
    if (options_.oneFile && options_.inputs.size() > 1 && !options_.wholePost)
      diagnostics.report<diag::OutputForOne>({}, options_.inputs.size());
    readLetters(context_);
    const bool programs = classify();
    if (foldersOfPrograms_) return false; // flags of programs would be called wrong
    const bool cycles = !folderPaths_.empty();
    if (!takesCycleFiles()) return false;
    const Target* const target = checkedTarget(options_, programs, cycles, "convert",
                                               "the language to write: " + targetNames(), diagnostics);
    if (diagnostics.hasErrors() || target == nullptr) return false;
    conversion_ = target->convert(context_);
    if (programs && !conversion_->beginPrograms()) return false;
    return !cycles || (loadCycles(*target) && conversion_->beginCycles());
  }

  bool loadCycles(const Target& target) {
    Diagnostics& diagnostics = session_.diagnostics();
    const bool first = options_.control.empty() || target.ownControls;
    if (std::any_of(order_.begin(), order_.end(), [](const Input& one) { return one.isCycleFile; }))
      compilation_.takeLiterals();
    context_.inputs =
        compilation_.load(options_.source, first ? std::string(kDefaultControl) : options_.control);
    if (context_.inputs == nullptr) return false;
    context_.inputs->oneOfSeveral = folderPaths_.size() > 1;
    const LoweringInputs& inputs = *context_.inputs;
    if (options_.probeMacros && session_.macroSet(*options_.probeMacros) == nullptr) {
      leaveFindingsToLint(session_);
      reportUnknownMacroSet(*options_.probeMacros, session_);
      return false;
    }
    for (Input& input : order_) {
      if (input.isCycleFile)
        compilation_.addFile(folderPaths_[input.index]);
      else if (!input.isProgram)
        byItself(input, [&] {
          compilation_.addFolder(folderPaths_[input.index]);
          if (options_.keepGoing) leaveFindingsToLint(session_);
        });
    }
    if (options_.source.cycle) context_.folders.front().name = *options_.source.cycle;
    leaveFindingsToLint(session_);
    if (!target.fixesValues && inputs.job && !inputs.job->operations.empty())
      diagnostics.report<diag::JobOperationsUnused>(inputs.job->operations.front().range);
    return !diagnostics.hasErrors();
  }

  // Whether there are programs among the inputs.
  bool classify() {
    bool programs = false;
    for (std::size_t i = 0; i < options_.inputs.size(); ++i) {
      Input& input = order_.emplace_back();
      input.place = i;
      byItself(input, [&] {
        input.isCycleFile = isCycleFile(options_.inputs[i], session_);
        input.isProgram = !input.isCycleFile && isProgramFile(options_.inputs[i], session_);
        if (!input.isCycleFile && !input.isProgram && isFolderOfPrograms(options_.inputs[i], session_))
          foldersOfPrograms_ = !options_.keepGoing;
      });
      input.index = input.isProgram ? i : folderPaths_.size();
      programs = programs || input.isProgram;
      if (!input.isProgram) folderPaths_.push_back(options_.inputs[i]);
    }
    return programs;
  }

  // false: refused, and reported.
  bool takesCycleFiles() {
    const Target* const target = findTarget(options_.to);
    if (target == nullptr || target->takesCycleFiles) return true;
    for (Input& input : order_)
      if (input.isCycleFile)
        byItself(input, [&] {
          session_.diagnostics().report<diag::CycleTarget>({}, inputName(options_.inputs[input.place]));
        });
    return !session_.diagnostics().hasErrors();
  }

  // Neither two files of one name nor two programs of one number. Two of one file were compared before.
  void filesDiffer() {
    std::map<std::uint64_t, std::string> byNumber;
    for (const auto& [number, path] : context_.result.numbers) {
      const auto [first, added] = byNumber.emplace(number, path);
      if (!added && first->second != path)
        session_.diagnostics().report<diag::ProgramNumberTwice>({}, number, first->second, path);
    }
    std::set<std::string> names;
    for (const OutputFile& file : context_.result.files)
      if (!names.insert(file.name).second)
        session_.diagnostics().report<diag::OutputNameTwice>({}, file.name);
  }

  void reportUnknownNames() {
    if (failed_ && !options_.keepGoing) return;
    std::string cycles;
    std::vector<std::string> names;
    for (const CycleFolder& folder : context_.folders) {
      cycles += (cycles.empty() ? "" : ", ") + folder.name;
      if (!folder.cycle) continue;
      for (const auto& field : frontend::gibbs::declaredFields(*folder.cycle))
        names.push_back(field.name.text);
    }
    const auto unknown = [&](const std::string& name) {
      // A cycle that is refused may have it.
      if (failed_ && std::any_of(names.begin(), names.end(), [&](const std::string& one) {
            return frontend::gibbs::foldCase(one) == frontend::gibbs::foldCase(name);
          }))
        return;
      const std::string near = nearestName(name, names);
      session_.diagnostics().report<diag::NoSuchField>({}, name, cycles,
                                                       near.empty() ? "" : "; did you mean `" + near + "`?");
    };
    for (const auto& [name, value] : context_.inputs->sets)
      if (!context_.usedSets.contains(name)) unknown(name);
    if (context_.inputs->oneOfSeveral && !failed_) // a cycle that is refused may know them
      reportUnknownPairs(options_.common, context_.usedSets, cycles, session_.diagnostics());
    for (const auto& [name, text] : options_.defaults)
      if (!context_.usedDefaults.contains(name)) unknown(name);
    for (const auto& [name, letter] : context_.letters) {
      if (failed_ || context_.usedLetters.contains(name) || session_.diagnostics().hasErrors()) continue;
      const std::string near = nearestName(name, names);
      session_.diagnostics().report<diag::ArgumentUnknown>(
          {}, name, near.empty() ? "" : "; did you mean `" + near + "`?");
    }
  }

  const ConvertOptions& options_;
  Session& session_;
  Compilation compilation_;
  ConversionContext context_;
  std::unique_ptr<Conversion> conversion_;
  std::vector<Input> order_;
  std::vector<std::string> folderPaths_;
  std::vector<Diagnostic> said_; // of inputs by themselves
  bool failed_ = false;
  bool foldersOfPrograms_ = false;
};

// "2 of 4 inputs are converted; refused: `a.nc`, `web`"; "" where none is.
std::string refusedOf(const ConvertOptions& options, const Outcome& outcome) {
  std::string names;
  for (const std::string& input : options.inputs)
    if (std::find(outcome.inputs.begin(), outcome.inputs.end(), input) == outcome.inputs.end())
      names += (names.empty() ? "`" : ", `") + printable(input) + "`";
  return names.empty() ? ""
                       : fmt::format("{} of {} inputs converted; refused: {}", outcome.inputs.size(),
                                     options.inputs.size(), names);
}

bool takesVariables(const targets::Target& target) {
  return std::find(target.flags.begin(), target.flags.end(), targets::TargetFlag::Variables) !=
         target.flags.end();
}

} // namespace

Outcome convert(const ConvertOptions& given) {
  ConvertOptions options = given;
  FoundInRuns found;
  const targets::Target* const target = targets::findTarget(options.to);
  if (!options.variables.empty() && target != nullptr && takesVariables(*target))
    if (std::optional<Outcome> failed = takeFlat(options, found)) return std::move(*failed);
  Outcome outcome = guarded(options.common, options.inputs, [&](Session& session) {
    takeControls(options, session);
    takeProbeCodes(options, session);
    for (const auto& [place, one] : found)
      session.diagnostics().report<diag::FoundInRun>({}, place, one.message);
    if (session.diagnostics().hasErrors()) return outcomeOf(session, "");
    return ConvertCommand(options, session).run();
  });
  if (options.verify && !outcome.files.empty())
    outcome = caught([&] { return verified(options, std::move(outcome)); });
  if (options.keepGoing && !outcome.inputs.empty()) outcome.summary = refusedOf(options, outcome);
  return outcome;
}

} // namespace dotek::driver
