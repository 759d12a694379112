// convert --to mikroprog.
#include "backends/mikroprog/TargetProgram.h"

#include "backends/mikroprog/Emit.h"
#include "backends/mikroprog/Programs.h"
#include "backends/mikroprog/TargetCycle.h"
#include "frontend/gibbs/Ast.h"
#include "ir/Fold.h"
#include "ir/Walk.h"
#include "project/Lowering.h"
#include "project/Programs.h"
#include "project/Settings.h"
#include "stdlib/HostInputs.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"
#include "support/messages/Mikroprog.h"
#include "support/messages/Nc.h"
#include "targets/Conversion.h"
#include "targets/DialogChoices.h"
#include "targets/Target.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace dotek::targets {

namespace mikroprog = backends::mikroprog;

namespace {

std::set<std::uint32_t> questionsOf(const std::set<std::string>& assume) {
  std::set<std::uint32_t> out;
  for (const std::string& name : assume) {
    std::uint32_t number = 0;
    const char* end = name.data() + name.size();
    if (name.size() > 1 && name[0] == 'Q' && std::from_chars(name.data() + 1, end, number).ptr == end)
      out.insert(number);
  }
  return out;
}

// Values for the time of one folder.
class Restore {
public:
  explicit Restore(LoweringInputs& inputs) : inputs_(inputs), hosts_(inputs.hosts), sets_(inputs.sets) {}
  ~Restore() {
    inputs_.hosts = std::move(hosts_);
    inputs_.sets = std::move(sets_);
  }
  Restore(const Restore&) = delete;
  Restore& operator=(const Restore&) = delete;

private:
  LoweringInputs& inputs_;
  std::map<std::string, double> hosts_;
  std::vector<std::pair<std::string, double>> sets_;
};

bool sameName(const std::string& a, const std::string& b) {
  return frontend::gibbs::foldCase(a) == frontend::gibbs::foldCase(b);
}

} // namespace

std::optional<std::string> mikroprogControlFor(const std::string& given, const CycleFolder& folder,
                                               const LoweredCycle& lowered, Session& session) {
  if (!given.empty()) return given;
  if (mikroprog::movesY(lowered.cycle)) return std::string(stdlib::kMikroprogMill);
  session.diagnostics().report<diag::ControlNotChosen>(lowered.cycle.range, folder.name);
  return std::nullopt;
}

std::optional<MikroprogProgram> writeMikroprog(const CycleFolder& folder, LoweredCycle lowered,
                                               const MikroprogWriting& writing, Session& session) {
  Diagnostics& diagnostics = session.diagnostics();
  ir::Cycle& cycle = lowered.cycle;
  if (writing.cycleFile) prepareCycle(lowered, diagnostics);
  confineToLists(cycle, dialogChoices(folder, cycle, session.sources()), session.diagnostics());
  for (const std::string& host : mikroprog::missingHosts(cycle, writing.control, writing.hosts)) {
    const auto info = std::find_if(std::begin(stdlib::kHostInputs), std::end(stdlib::kHostInputs),
                                   [&](const stdlib::HostInput& one) { return one.name == host; });
    diagnostics.report<diag::HostNeeded>(cycle.range, folder.name, host, info->meaning, host);
  }
  if (diagnostics.hasErrors()) {
    // What it says besides is said at once.
    ir::Cycle rest = cycle;
    ir::fold(rest, lowered.fixed, {true, session.limits().steps});
    if (writing.cycleFile) joinSettings(rest, diagnostics);
    return std::nullopt;
  }
  if (const std::optional<ir::CycleStatement> alarm = certainAlarm(lowered)) {
    reportRejected(folder, lowered, *alarm, session);
    return std::nullopt;
  }

  mikroprog::EmitOptions emit{
      writing.control, mikroprog::shortFileName(folder.name), {}, {}, {}, false, {}, {}};
  emit.datum = writing.datum == "operator" ? mikroprog::Datum::Operator : mikroprog::Datum::SetPosition;
  emit.assumed = questionsOf(writing.assume);
  emit.hosts = writing.hosts;
  emit.cycleFile = writing.cycleFile;
  emit.lengthToCentre = writing.lengthToCentre;
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    const ir::Variable& variable = cycle.variable(id);
    if (variable.role != ir::Role::Parameter || !lowered.fixed.contains(id)) continue;
    emit.values.push_back({variable.name, lowered.fixed.at(id), writing.fromWhere(variable.name)});
  }
  std::vector<std::pair<std::string, double>> values;
  for (const auto& [id, value] : lowered.fixed)
    values.emplace_back(cycle.variable(id).name, value);
  emit.drawnSurfaces = [&] { return drawnSurfaces(folder, values, writing.hosts, session); };
  ir::fold(cycle, lowered.fixed, {true, session.limits().steps});
  if (!cycle.checks.empty()) {
    diagnostics.report<diag::ChecksUndecided>(cycle.checks.front().origin.range(), folder.name);
    return std::nullopt;
  }
  if (writing.cycleFile) joinSettings(cycle, diagnostics);
  if (diagnostics.hasErrors()) return std::nullopt;
  if (writing.folded != nullptr) *writing.folded = cycle;
  // The back end says what becomes of an alarm.
  std::erase_if(diagnostics.all(),
                [](const Diagnostic& one) { return one.code == diag::AlarmRenumbered::code; });
  auto lines = mikroprog::emit(cycle, emit, diagnostics);
  if (!lines) return std::nullopt;
  return MikroprogProgram{emit.fileName + "." + writing.control.programEnding, std::move(*lines)};
}

namespace {

// Programs without arguments, one for each cycle.
class MikroprogConversion final : public Conversion {
public:
  using Conversion::Conversion;

  bool beginCycles() override {
    return options_.control.empty() || loadMikroprogControl(options_.control, session_);
  }

  bool beginPrograms() override {
    Diagnostics& diagnostics = session_.diagnostics();
    if (options_.control.empty())
      diagnostics.report<diag::MissingOption>(
          {}, "convert", "--control NAME",
          "the control to write programs for: mikroprog-s280 or mikroprog-mill");
    if (options_.verify)
      diagnostics.report<diag::MikroprogCannot>(
          {},
          "a program for Mikroprog has one run, whose values are fixed, so there is nothing to vary and "
          "compare",
          "run source and result by `dotek sim --trace FILE` and compare the traces (docs/mikroprog.md)");
    if (diagnostics.hasErrors()) return false;
    programControl_ = loadMikroprogControl(options_.control, session_);
    return programControl_.has_value();
  }

  void program(const std::string& path) override {
    const std::string from =
        options_.fromControl.empty() ? settingsOf(path, session_).control : options_.fromControl;
    if (from.empty()) {
      session_.diagnostics().report<diag::MissingOption>({}, "convert", "--from-control NAME",
                                                         "the control that the program is written for");
      return;
    }
    const auto source = loadControl(from, session_);
    const auto id = source ? session_.read(path, Encoding::Cp1250) : std::nullopt;
    if (!id) return;
    SourceRange leader;
    const auto programs = loadForTranslation(*id, *source, session_, leader);
    if (!programs) return;
    if (programs->programs.empty()) {
      session_.diagnostics().report<diag::NoProgram>({*id, 0, 0}, path, "written");
      return;
    }
    if (leader.begin < leader.end) session_.diagnostics().report<diag::LeaderLeftOut>(leader);
    const std::string stem = std::filesystem::path(path).stem().generic_string();
    const auto lines =
        mikroprog::emitProgram(*programs, {*programControl_, *source, stem}, session_.diagnostics());
    if (lines)
      context_.result.add(mikroprog::shortFileName(stem) + "." + programControl_->programEnding, *lines,
                          "\r\n");
  }

  bool cycle(const CycleFolder& folder, std::size_t /*index*/) override {
    std::optional<MikroprogProgram> program = write(folder);
    if (!program) return false;
    context_.result.add(program->name, program->lines, "\r\n");
    const auto named = std::find_if(program->lines.begin(), program->lines.end(), [](const auto& line) {
      return line.text.find("CYCLE ") != std::string::npos;
    });
    if (named != program->lines.end()) context_.result.files.back().mark = named->text;
    return true;
  }

private:
  // Where the value of a parameter comes from, for the header.
  std::string fromWhere(const std::string& name) const {
    const auto names = [&](const auto& list) {
      return std::any_of(list.begin(), list.end(),
                         [&](const auto& one) { return sameName(one.first, name); });
    };
    if (names(options_.common.set)) return "--set";
    if (names(context_.inputs->sets)) return "job";
    if (names(options_.defaults)) return "--default";
    return "default";
  }

  // A value for each parameter: given, or its default.
  bool fixParameters(LoweredCycle& lowered, bool cycleFile) {
    bool good = true;
    for (ir::VariableId id = 0; id < lowered.cycle.variables.size(); ++id) {
      const ir::Variable& variable = lowered.cycle.variable(id);
      if (variable.role != ir::Role::Parameter || lowered.fixed.contains(id)) continue;
      if (cycleFile && variable.optional && !variable.defaultValue) continue; // left out
      if (variable.defaultValue) {
        lowered.fixed.emplace(id, *variable.defaultValue);
      } else if (ir::uses(lowered.cycle, id)) {
        session_.diagnostics().report<diag::FieldNeeded>(variable.range, variable.name, variable.name);
        good = false;
      }
    }
    return good;
  }

  std::optional<MikroprogProgram> write(const CycleFolder& folder) {
    Diagnostics& diagnostics = session_.diagnostics();
    LoweringInputs& inputs = *context_.inputs;
    const Restore restore(inputs);
    const JobOperation* operation = operationOf(folder, inputs, session_);
    if (diagnostics.hasErrors()) return std::nullopt;
    if (operation != nullptr) takeOperation(*operation, options_.common, inputs);

    std::optional<LoweredSource> source = lowerSource(folder, context_);
    if (!source) return std::nullopt;
    LoweredCycle& lowered = source->lowered;
    if (operation != nullptr) {
      for (const JobValue& value : operation->set)
        if (!context_.usedSets.contains(value.name))
          diagnostics.report<diag::NoSuchField>(value.range, value.name, folder.name, "");
    }
    const std::optional<std::string> name = mikroprogControlFor(options_.control, folder, lowered, session_);
    if (!name || diagnostics.hasErrors()) return std::nullopt;
    const auto control = loadMikroprogControl(*name, session_);
    if (!control) return std::nullopt;
    const bool fixed = fixParameters(lowered, context_.compilation.fileOf(folder) != nullptr);
    const MikroprogWriting writing{*control,
                                   options_.datum,
                                   options_.common.assume,
                                   inputs.job && inputs.job->lengthToCentre,
                                   inputs.hosts,
                                   [&](const std::string& parameter) { return fromWhere(parameter); },
                                   context_.compilation.fileOf(folder) != nullptr,
                                   nullptr};
    std::optional<MikroprogProgram> out = writeMikroprog(folder, std::move(lowered), writing, session_);
    if (!fixed || !out) return std::nullopt;
    const auto [other, added] = written_.emplace(out->name, folder.name);
    if (!added) {
      diagnostics.report<diag::FileNameTwice>({}, mikroprog::shortFileName(folder.name), other->second,
                                              folder.name);
      return std::nullopt;
    }
    return out;
  }

  std::map<std::string, std::string> written_; // names of files, by folder
  std::optional<stdlib::MikroprogControl> programControl_;
};

void checkDatum(const std::string& datum, Diagnostics& diagnostics) {
  if (datum != "g92" && datum != "operator") diagnostics.report<diag::UnknownDatum>({}, datum);
}

// What its programs need beside the values of fields.
constexpr std::string_view kHosts[] = {"clearance",   "start_x",    "start_y",
                                       "tool_radius", "overtravel", "return_feed"};

constexpr TargetFlag kFlags[] = {TargetFlag::Variables};

} // namespace

namespace target {

DOTEK_TARGET(mikroprog) = {
    .text = "program without arguments, for Mikroprog",
    .flags = kFlags,
    .checkDatum = checkDatum,
    .ownControls = true,
    .fixesValues = true,
    .takesCycleFiles = true,
    .writesPrograms = true,
    .hosts = kHosts,
    .convert = conversionBy<MikroprogConversion>,
    .verify = mikroprogVerification,
};

} // namespace target

} // namespace dotek::targets
