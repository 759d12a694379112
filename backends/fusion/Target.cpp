// convert --to fusion.
#include "backends/common/ToolLength.h"
#include "backends/fusion/TargetVerify.h"

#include "backends/fusion/Emit.h"
#include "backends/fusion/TargetCycle.h"
#include "backends/fusion/TargetProgram.h"
#include "backends/fusion/TargetVerifyCycle.h"
#include "ir/Fold.h"
#include "project/Lowering.h"
#include "support/messages/Commands.h"
#include "support/messages/Fusion.h"
#include "support/messages/Nc.h"
#include "targets/Conversion.h"
#include "targets/DialogChoices.h"
#include "targets/Target.h"

#include <algorithm>
#include <filesystem>

namespace dotek::targets {

namespace fusion = backends::fusion;

namespace {

// Notes on what a program on a control changes; a post prints the Prog's text as it is.
void dropNotesOfPrograms(Diagnostics& diagnostics) {
  auto& all = diagnostics.all();
  std::erase_if(all, [](const Diagnostic& one) {
    return one.code == diag::PictureDecimals::code || one.code == diag::AlarmRenumbered::code ||
           one.code == diag::WordLeftOut::code;
  });
}

void checkFusionConvert(const ConvertOptions& options, Diagnostics& diagnostics) {
  std::error_code fault;
  const bool folders =
      std::all_of(options.inputs.begin(), options.inputs.end(),
                  [&](const std::string& path) { return std::filesystem::is_directory(path, fault); });
  if (!options.source.prog && folders) diagnostics.report<diag::FusionNeedsProg>({});
}

void refuseFlag(std::string_view flag, Diagnostics& diagnostics) {
  diagnostics.report<diag::FanucOption>({}, flag);
}

// Parts of a post, one for each cycle of the command; with --whole-post one file.
class FusionConversion final : public Conversion {
public:
  using Conversion::Conversion;

  bool cycle(const CycleFolder& folder, std::size_t index) override {
    if (const std::string* file = context_.compilation.fileOf(folder)) return cycleFile(folder, index, *file);
    if (!takesFlags()) return true;
    std::optional<LoweredSource> source = lowerSource(folder, context_);
    if (!source) return false;
    const stdlib::MacroSet* called = source->lowered.macros;
    context_.result.macros = options_.probeMacros ? *options_.probeMacros
                             : called != nullptr  ? called->name
                                                  : "";
    if (!session_.diagnostics().hasErrors()) add(folder, source->lowered, std::move(source->defaults));
    return true;
  }

  void program(const std::string& path) override {
    const auto control =
        loadControl(options_.control.empty() ? std::string(kDefaultControl) : options_.control, session_);
    std::optional<CalledCycle> called = control ? calledProgram(path, *control, context_) : std::nullopt;
    if (!called) return;
    stdlib::MacroSet none;
    none.title = "the program";
    fusion::EmitOptions emit{*control, none, false, {}, {}, {}, {}, {}, options_.helpersApart};
    programControl_ = *control;
    emit.call = std::move(called->call);
    const ir::Cycle& cycle = called->lowered.cycle;
    keep(cycle, fusion::emit(cycle, emit, session_.diagnostics()), true);
    context_.result.arguments.push_back(std::move(called->arguments));
  }

  void finish() override {
    if (!options_.probeMacros) dropNotesOfPrograms(session_.diagnostics());
    // An alarm is printed with its number, whatever the macros are.
    std::erase_if(session_.diagnostics().all(),
                  [](const Diagnostic& one) { return one.code == diag::AlarmRenumbered::code; });
    if (parts_.empty()) return;
    if (options_.helpersApart)
      context_.result.helpers =
          fusion::sharedHelpers(programControl_ ? *programControl_ : *context_.inputs->sourceControl);
    if (!options_.wholePost) {
      for (Part& part : parts_)
        write(part.prefix + ".js", std::move(part.lines));
      return;
    }
    std::vector<std::vector<backends::EmittedLine>> fragments;
    std::vector<std::string> prefixes, closing;
    for (const Part& part : parts_) {
      if (part.closes) closing.push_back(part.prefix);
      fragments.push_back(part.lines);
      prefixes.push_back(part.prefix);
    }
    write((parts_.size() == 1 ? parts_.front().prefix : std::string("cycles")) + ".cps",
          fusion::postAround(fragments, prefixes, closing));
  }

private:
  struct Part {
    std::string cycle, prefix;
    std::vector<backends::EmittedLine> lines;
    bool closes = false; // it carries a program
  };

  // Flags of programs on a control are for files of the cycle language.
  bool takesFlags() {
    Diagnostics& diagnostics = session_.diagnostics();
    if (!options_.source.prog) diagnostics.report<diag::FusionNeedsProg>({});
    if (!options_.letters.empty()) refuseFlag("--arg", diagnostics);
    if (options_.programNumber) refuseFlag("--program-number", diagnostics);
    if (!options_.results.empty()) refuseFlag("--result", diagnostics);
    return !diagnostics.hasErrors();
  }

  bool cycleFile(const CycleFolder& folder, std::size_t index, const std::string& file) {
    std::optional<CalledCycle> called = calledCycle(folder, index, file, context_);
    if (!called) return !session_.diagnostics().hasErrors();
    const LoweringInputs& inputs = *context_.inputs;
    const stdlib::MacroSet* const macros = session_.macroSet(called->macros, &*inputs.control);
    if (macros == nullptr) return true;
    const ir::Cycle& cycle = called->lowered.cycle;
    fusion::EmitOptions emit{*inputs.control,
                             *macros,
                             false,
                             {},
                             called->lowered.fixed,
                             called->lowered.fixedByName,
                             std::move(called->choices),
                             {},
                             options_.helpersApart};
    emit.fixedByName.insert(inputs.hosts.begin(), inputs.hosts.end());
    emit.call = std::move(called->call);
    emit.groups = std::move(called->groups);
    keep(cycle, fusion::emit(cycle, emit, session_.diagnostics()), true);
    ConversionResult& result = context_.result;
    result.macros = called->macros;
    result.arguments.push_back(std::move(called->arguments));
    if (!options_.wholePost) result.macrosByCycle.push_back(called->macros);
    return true;
  }

  void keep(const ir::Cycle& cycle, std::optional<std::vector<backends::EmittedLine>> lines, bool closes) {
    const std::string prefix = fusion::prefixOf(cycle.name);
    for (const Part& part : parts_)
      if (part.prefix == prefix)
        session_.diagnostics().report<diag::FragmentNameTwice>({}, part.cycle, cycle.name, prefix);
    if (lines) parts_.push_back({cycle.name, prefix, std::move(*lines), closes});
  }

  void write(const std::string& name, std::vector<backends::EmittedLine> lines) {
    for (backends::EmittedLine& line : lines)
      std::erase_if(line.ranges, [](const SourceRange& range) { return !range.hasPlace(); });
    context_.result.add(name, lines);
  }

  void add(const CycleFolder& folder, LoweredCycle& lowered, std::map<ir::VariableId, double> defaults) {
    const LoweringInputs& inputs = *context_.inputs;
    const std::string& control = inputs.sourceControl->name;
    if (!options_.control.empty() && options_.control != control)
      session_.diagnostics().report<diag::ControlOfForm>(lowered.cycle.range, control, options_.control);
    const stdlib::MacroSet none = [] {
      stdlib::MacroSet set;
      set.title = "no set";
      return set;
    }();
    const stdlib::MacroSet* macros = options_.probeMacros
                                         ? session_.macroSet(*options_.probeMacros, &*inputs.sourceControl)
                                         : lowered.macros;
    const bool foreign = macros != lowered.macros && lowered.macros != nullptr;
    if (macros == nullptr) macros = &none;
    const auto lists = dialogChoices(folder, lowered.cycle, session_.sources());
    confineToLists(lowered.cycle, lists, session_.diagnostics());
    backends::refuseNoLength(lowered.cycle, lowered.fixed, *inputs.sourceControl,
                             inputs.control ? *inputs.control : *inputs.sourceControl,
                             session_.diagnostics());
    ir::FoldOptions folding;
    for (const ir::PrintedBlock& block : lowered.printed)
      for (const ir::PrintedPiece& piece : block.pieces)
        if (piece.picture) folding.read.insert(piece.variable);
    ir::fold(lowered.cycle, lowered.fixed, folding);
    fusion::EmitOptions emit{*inputs.sourceControl,
                             *macros,
                             foreign,
                             std::move(lowered.printed),
                             lowered.fixed,
                             lowered.fixedByName,
                             {},
                             std::move(defaults),
                             options_.helpersApart};
    for (const auto& [id, choices] : lists)
      for (const DialogChoice& choice : choices)
        emit.choices[id].push_back({choice.value, choice.title});
    emit.fixedByName.insert(inputs.hosts.begin(), inputs.hosts.end());
    emit.source = lowered.macros;
    auto lines = fusion::emit(lowered.cycle, emit, session_.diagnostics());
    if (options_.probeMacros && !foreign) dropNotesOfPrograms(session_.diagnostics());
    keep(lowered.cycle, std::move(lines), false);
  }

  std::vector<Part> parts_;
  std::optional<stdlib::Control> programControl_; // of inputs that are programs
};

constexpr TargetFlag kFlags[] = {TargetFlag::ProbeMacros, TargetFlag::WholePost,     TargetFlag::Helpers,
                                 TargetFlag::Arg,         TargetFlag::ProgramNumber, TargetFlag::Result};

std::unique_ptr<Verification> verificationOf(const VerificationSource& source) {
  return source.plan.cycleFile ? fusionCycleVerification(source) : fusionVerification(source);
}

} // namespace

namespace target {

DOTEK_TARGET(fusion) = {
    .text = "part of a Fusion post",
    .flags = kFlags,
    .refuseFlag = refuseFlag,
    .checkConvert = checkFusionConvert,
    .controlOfForm = true,
    .takesCycleFiles = true,
    .writesPrograms = true,
    .convert = conversionBy<FusionConversion>,
    .verify = verificationOf,
};

} // namespace target

} // namespace dotek::targets
