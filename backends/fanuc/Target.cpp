// convert --to fanuc.
#include "targets/Target.h"
#include "backends/common/ToolLength.h"
#include "backends/fanuc/Emit.h"
#include "backends/fanuc/TargetCalls.h"
#include "backends/fanuc/TargetEarly.h"
#include "backends/fanuc/TargetPrograms.h"
#include "backends/fanuc/TargetVerify.h"
#include "backends/fanuc/TargetVerifyPrograms.h"
#include "frontend/gibbs/Ast.h"
#include "ir/CycleNames.h"
#include "ir/Fold.h"
#include "ir/Positions.h"
#include "ir/Walk.h"
#include "project/MillControl.h"
#include "stdlib/SearchTravel.h"
#include "support/NearestName.h"
#include "support/messages/Commands.h"
#include "support/messages/Cycle.h"
#include "support/messages/Fanuc.h"
#include "targets/Conversion.h"
#include "targets/DialogChoices.h"
#include "targets/KeptResults.h"
#include "targets/Reports.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace dotek::targets {

namespace fanuc = backends::fanuc;

namespace {

constexpr std::uint32_t kFirstProgram = 8000;

// A program that is called with G65 for each cycle; files of programs for another control.
class FanucConversion final : public Conversion {
public:
  explicit FanucConversion(ConversionContext& context)
      : Conversion(context), programs_(context.options, context.session) {}

  bool beginPrograms() override { return programs_.load(); }

  bool cycle(const CycleFolder& folder, std::size_t index) override {
    project::CallsAs calls;
    if (options_.calls == Calls::Subprogram && context_.inputs->control)
      calls.programLevels = programLevels(*context_.inputs->control);
    if (options_.calls == Calls::Vendor && context_.compilation.fileOf(folder) != nullptr) {
      calls.macros = options_.probeMacros
                         ? session_.macroSet(*options_.probeMacros, &*context_.inputs->control)
                         : firstThatTouches();
      if (options_.probeMacros && calls.macros == nullptr) return true; // reported
    }
    context_.compilation.callAs(calls);
    std::optional<LoweredSource> source = lowerSource(folder, context_);
    context_.compilation.callAs({});
    if (!source) return false;
    LoweredCycle& lowered = source->lowered;
    const LoweringInputs& inputs = *context_.inputs;
    if (project::refuseLathe(*inputs.control, session_)) return true;
    const stdlib::MacroSet* macros = macrosOf(lowered);
    if (macros == nullptr || session_.diagnostics().hasErrors()) return true;
    for (const auto& [id, value] : lowered.fixed) {
      const ir::Variable& variable = lowered.cycle.variable(id);
      const bool plane = variable.name == "retract" && ir::countsFrom(lowered.cycle, ir::Frame::Retract);
      if (!ir::uses(lowered.cycle, id) && !plane && variable.role == ir::Role::Host)
        lowered.fixedByName.erase(variable.name);
    }
    const bool ofLanguage = context_.compilation.fileOf(folder) != nullptr;
    if (!ofLanguage && options_.calls != Calls::Inline)
      session_.diagnostics().report<diag::CallsOfLanguage>({}, callsText(options_.calls), folder.name);
    if (!lowered.programs.empty()) ir::fold(lowered.cycle, lowered.fixed); // drops calls that are never made
    const std::optional<SourceRange> report = targets::dropReports(lowered.cycle);
    if (report) session_.diagnostics().report<diag::ReportLeftOut>(*report, inputs.control->title);
    CalledPrograms called(lowered, context_, *macros);
    KeptResults results;
    if (ofLanguage)
      results = leaveResults(lowered.cycle, *macros, called);
    else
      for (const auto& [name, number] : options_.results)
        session_.diagnostics().report<diag::CycleResultUnknown>({}, name, folder.name, "");
    const auto lists = dialogChoices(folder, lowered.cycle, session_.sources());
    confineToLists(lowered.cycle, lists, session_.diagnostics());
    backends::refuseNoLength(lowered.cycle, lowered.fixed, *inputs.sourceControl, *inputs.control,
                             session_.diagnostics());
    ir::fold(lowered.cycle, lowered.fixed);
    fanuc::EmitOptions emit{*inputs.control, *macros, *inputs.sourceControl, 0, {}, {}, {}, {}};
    emit.plainMessages = options_.common.assume.contains("plain-messages");
    emit.sameAxes = options_.common.assume.contains("same-axes");
    emit.foreignMacros = lowered.macros == nullptr || macros->name != lowered.macros->name;
    emit.source =
        lowered.macros == nullptr ? nullptr : session_.macroSet(lowered.macros->name, &*inputs.sourceControl);
    emit.computed = lowered.computed;
    emit.remarks = std::move(results.headings);
    if (report) emit.remarks.push_back("REPORTS OF THE SOURCE ARE NOT PRINTED");
    for (const auto& [id, choices] : lists)
      for (const DialogChoice& choice : choices)
        emit.choices[id].push_back({choice.value, choice.title});
    emit.programNumber = numberOf(index);
    emit.defaults = options_.useDefaults ? fanuc::Defaults::Use : fanuc::Defaults::Alarm;
    emit.probePower = options_.switchProbe ? fanuc::ProbePowerMode::Macro : fanuc::ProbePowerMode::Source;
    if (ofLanguage)
      emit.defaults = fanuc::Defaults::Use; // a default of the language is a value, not a proposal
    emit.letters = lettersOf(lowered);
    emit.fixed = lowered.fixedByName;
    for (const char* place : {"start_x", "start_y", "start_z"}) {
      if (const auto given = inputs.hosts.find(place); given != inputs.hosts.end()) emit.fixed.insert(*given);
    }
    const bool travels =
        std::any_of(macros->signatures.begin(), macros->signatures.end(), [](const auto& one) {
          return std::any_of(one.arguments.begin(), one.arguments.end(),
                             [&](const auto& argument) { return stdlib::travelIsSearch(one, argument); });
        });
    if (const auto given = inputs.hosts.find("overtravel");
        ofLanguage && travels && given != inputs.hosts.end())
      emit.fixed.insert(*given);
    if (!called.addTo(emit)) return true;
    std::vector<fanuc::Argument> letters;
    std::uint32_t alarms = 0;
    auto lines = emitSharing(lowered.cycle, emit, ofLanguage, session_.sources(), session_.diagnostics(),
                             letters, &alarms);
    if (!lines || !called.append(emit, alarms, *lines)) return true;
    warnOfEarlyReads(*lines, *inputs.control, session_);
    std::vector<OutputArgument> arguments;
    for (const fanuc::Argument& one : letters)
      arguments.push_back({lowered.cycle.variable(one.variable).name, one.letter});
    ConversionResult& result = context_.result;
    result.arguments.push_back(std::move(arguments));
    result.macros = macros->name;
    result.macrosByCycle.push_back(macros->name);
    result.handedBack.push_back(called.handedBack());
    result.numbers.emplace_back(emit.programNumber, folder.name);
    for (std::uint32_t i = 0; i < called.count(); ++i)
      result.numbers.emplace_back(nextCalled_ + i, folder.name);
    nextCalled_ += called.count();
    result.add(fmt::format("O{:04}.nc", emit.programNumber), *lines);
    result.files.back().mark = markOf(*lines);
    return true;
  }

  void finish() override {
    if (context_.inputs == nullptr || !context_.inputs->oneOfSeveral || session_.diagnostics().hasErrors())
      return;
    for (const auto& [name, number] : options_.results)
      if (!takenResults_.contains(name)) {
        const std::string near = nearestName(name, takenResults_);
        session_.diagnostics().report<diag::CycleResultUnknown>(
            {}, name, "any of the inputs", near.empty() ? "" : "; did you mean `" + near + "`?");
      }
  }

  void program(const std::string& path) override { programs_.convert(path, context_.result); }

private:
  // The lines of the header that name the cycle: those between the program's number and the control, else
  // the number, which has its name as a comment.
  static std::string markOf(const std::vector<backends::EmittedLine>& lines) {
    std::string out;
    for (std::size_t i = 2; i < lines.size() && !lines[i].text.starts_with("(FOR "); ++i)
      out += (out.empty() ? "" : "\n") + lines[i].text;
    return out.empty() ? lines.at(1).text : out;
  }

  // A program hands nothing back but what --result names.
  KeptResults leaveResults(ir::Cycle& cycle, const stdlib::MacroSet& macros, CalledPrograms& called) {
    NamedTexts wanted = options_.results;
    const std::set<std::string> stored = called.stored();
    std::erase_if(wanted, [&](const auto& one) { return stored.contains(one.first); });
    takenResults_.insert(stored.begin(), stored.end());
    if (context_.inputs->oneOfSeveral) { // each takes those that it has
      std::set<std::string> own;
      for (const ir::CycleStatement& statement : cycle.body)
        if (const auto* call = std::get_if<ir::CallCycle>(&statement.node);
            call != nullptr && (call->cycle == ir::kResults || call->cycle == ir::kKeep))
          for (const ir::CycleArgument& one : call->arguments)
            own.insert(one.parameter);
      std::erase_if(wanted, [&](const auto& one) { return !own.contains(one.first); });
      takenResults_.merge(own);
    }
    KeptResults out = keepResults(cycle, wanted, session_.diagnostics());
    if (nextCalled_ == 0) // after those of all inputs
      nextCalled_ = numberOf(std::max<std::size_t>(context_.folders.size(), 1));
    called.prepare(nextCalled_, out);
    const auto keeps = [&](std::uint32_t number) {
      const auto& common = context_.inputs->control->common;
      return std::any_of(common.begin(), common.end(), [&](const stdlib::VariableRange& range) {
        return range.kept && number >= range.first && number <= range.last;
      });
    };
    for (const std::uint32_t number : out.stored)
      if (!keeps(number))
        session_.diagnostics().report<diag::CycleStatementCannot>(
            cycle.range,
            fmt::format("a value for a later run in #{}, which is empty after power on,", number),
            context_.inputs->control->title, macros.title, "name a variable that keeps its value");
    for (const std::string& name : out.lost)
      session_.diagnostics().report<diag::ResultNotLeft>(cycle.range, name);
    return out;
  }

  std::uint32_t numberOf(std::size_t index) const {
    std::uint32_t first = kFirstProgram;
    if (options_.programNumber)
      first = *options_.programNumber;
    else if (context_.inputs->job && context_.inputs->job->number)
      first = static_cast<std::uint32_t>(*context_.inputs->job->number);
    return first + static_cast<std::uint32_t>(index);
  }

  // Blocks of the source say all, and the control has the codes of the probe's switch: G31 in them measures.
  bool needsNone(const ir::Cycle& cycle) const {
    const stdlib::Control& control = *context_.inputs->control;
    return std::all_of(cycle.body.begin(), cycle.body.end(),
                       [&](const ir::CycleStatement& statement) {
                         if (const auto* power = std::get_if<ir::ProbePower>(&statement.node))
                           return control.find(power->on ? stdlib::Function::ProbeOn
                                                         : stdlib::Function::ProbeOff) != nullptr;
                         return !ir::probes(statement) &&
                                !std::holds_alternative<ir::CallCycle>(statement.node);
                       }) &&
           std::any_of(cycle.body.begin(), cycle.body.end(), [](const ir::CycleStatement& statement) {
             return std::holds_alternative<ir::OpaqueBlock>(statement.node);
           });
  }

  // The set that the program calls: given, else the source's, none where nothing calls one; a path alone
  // takes the first that touches without setting an offset.
  const stdlib::MacroSet* macrosOf(const LoweredCycle& lowered) {
    const stdlib::Control* const control = &*context_.inputs->control;
    if (options_.probeMacros && lowered.macros == nullptr && needsNone(lowered.cycle)) return &none_;
    if (options_.probeMacros) return session_.macroSet(*options_.probeMacros, control);
    if (lowered.macros != nullptr) return session_.macroSet(lowered.macros->name, control);
    if (needsNone(lowered.cycle)) return &none_;
    if (const stdlib::MacroSet* const set = firstThatTouches()) {
      session_.diagnostics().report<diag::MacroSetChosen>({}, lowered.cycle.name, set->name);
      return set;
    }
    session_.diagnostics().report<diag::MissingOption>({}, "convert", "--probe-macros SET",
                                                       "the macros that the program calls");
    return nullptr;
  }

  // nullptr: none does without setting an offset.
  const stdlib::MacroSet* firstThatTouches() {
    for (const stdlib::MacroSet& set : session_.macroSets(&*context_.inputs->control)) {
      const stdlib::MacroSignature* surface = set.find(stdlib::Intent::Surface);
      const stdlib::MacroArgument* system =
          surface == nullptr ? nullptr : surface->find(stdlib::ArgumentRole::System, ir::Axis::X);
      if (surface == nullptr || (system != nullptr && system->required)) continue;
      // A vendor's set before one whose text has to be brought along.
      if (session_.data().find("macrob", set.name) != nullptr) continue;
      return &set;
    }
    return nullptr;
  }

  // --arg names are those of this cycle, as it spells them.
  std::map<std::string, char> lettersOf(const LoweredCycle& lowered) {
    std::map<std::string, char> out;
    std::set<char> taken;
    for (const auto& [name, letter] : context_.letters)
      taken.insert(letter);
    for (const auto& [id, letter] : lowered.letters) // wishes, as far as they can be granted
      if (ir::uses(lowered.cycle, id) && std::string_view("GLNOP").find(letter) == std::string_view::npos &&
          taken.insert(letter).second)
        out.emplace(lowered.cycle.variable(id).name, letter);
    for (const auto& [name, letter] : context_.letters) {
      const std::string folded = frontend::gibbs::foldCase(name);
      for (const ir::Variable& variable : lowered.cycle.variables) {
        if (variable.role == ir::Role::Local || frontend::gibbs::foldCase(variable.name) != folded) continue;
        context_.usedLetters.insert(name);
        out[variable.name] = letter;
      }
    }
    return out;
  }

  ProgramConversion programs_;
  std::uint32_t nextCalled_ = 0;       // number of the next program of a called cycle; 0: none is given yet
  std::set<std::string> takenResults_; // of several inputs: that one of them has
  const stdlib::MacroSet none_ = [] {
    stdlib::MacroSet set;
    set.title = "no set";
    return set;
  }();
};

constexpr TargetFlag kFlags[] = {TargetFlag::Arg,         TargetFlag::ProgramNumber, TargetFlag::ProbeMacros,
                                 TargetFlag::DefaultsUse, TargetFlag::ProbePower,    TargetFlag::Result,
                                 TargetFlag::Calls};

} // namespace

namespace target {

DOTEK_TARGET(fanuc) = {
    .text = "program that is called with G65",
    .flags = kFlags,
    .takesPathAlone = true,
    .takesCycleFiles = true,
    .convert = conversionBy<FanucConversion>,
    .verify = fanucVerification,
    .programs = programsBy<ProgramRunner>,
};

} // namespace target

} // namespace dotek::targets
