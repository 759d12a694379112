#include "driver/ConvertMikroprog.h"

#include "backends/mikroprog/Emit.h"
#include "frontend/gibbs/Ast.h"
#include "ir/Fold.h"
#include "ir/Walk.h"
#include "stdlib/HostInputs.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"
#include "support/messages/Mikroprog.h"
#include "support/messages/Nc.h"

#include <algorithm>
#include <charconv>

namespace dotek::driver {

namespace mikroprog = backends::mikroprog;

namespace {

constexpr std::string_view kTarget = "mikroprog";
constexpr std::string_view kMill = "mikroprog-mill"; // of cycles that move Y

std::optional<stdlib::MikroprogControl> loadProfile(const std::string& name, Session& session) {
  auto control = stdlib::MikroprogControl::load(session.data(), name);
  if (!control) {
    std::string known;
    for (const stdlib::DataFile* file : session.data().list("mikroprog"))
      known += (known.empty() ? "" : ", ") + file->name;
    session.diagnostics().report<diag::UnknownProfile>({}, name, known);
  }
  return control;
}

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

bool MikroprogConversion::checkFlags() {
  const auto none = [&](bool given, std::string_view flag) {
    if (given) session_.diagnostics().report<diag::FlagOfOtherTarget>({}, flag, kTarget);
  };
  none(!options_.letters.empty(), "--arg");
  none(options_.programNumber.has_value(), "--program-number");
  none(options_.probeMacros.has_value(), "--probe-macros");
  none(options_.useDefaults, "--defaults use");
  none(options_.switchProbe, "--probe-power macro");
  if (!options_.datum.empty() && options_.datum != "g92" && options_.datum != "operator")
    session_.diagnostics().report<diag::UnknownDatum>({}, options_.datum);
  if (!options_.control.empty()) loadProfile(options_.control, session_);
  return !session_.diagnostics().hasErrors();
}

// The operation of the job for this folder; nullptr: none, or several, which is reported.
const JobOperation* MikroprogConversion::operationOf(const CycleFolder& folder) {
  if (!inputs_.job) return nullptr;
  const JobOperation* found = nullptr;
  std::size_t points = 0;
  for (const JobOperation& operation : inputs_.job->operations) {
    if (operation.cycle != folder.name) continue;
    found = found == nullptr ? &operation : found;
    points += std::max<std::size_t>(operation.at.size(), 1);
  }
  if (points <= 1) return found;
  session_.diagnostics().report<diag::PointsOfOperation>(found->cycleRange, folder.name, points);
  return nullptr;
}

std::optional<std::string> MikroprogConversion::controlFor(const CycleFolder& folder,
                                                           const LoweredCycle& lowered) {
  if (!options_.control.empty()) return options_.control;
  if (mikroprog::movesY(lowered.cycle)) return std::string(kMill);
  session_.diagnostics().report<diag::ControlNotChosen>(lowered.cycle.range, folder.name);
  return std::nullopt;
}

// Where the value of a parameter comes from, for the header.
std::string MikroprogConversion::fromWhere(const std::string& name) const {
  const auto names = [&](const auto& list) {
    return std::any_of(list.begin(), list.end(), [&](const auto& one) { return sameName(one.first, name); });
  };
  if (names(options_.common.set)) return "--set";
  if (names(inputs_.sets)) return "job";
  if (names(options_.defaults)) return "--default";
  return "default";
}

// A value for each parameter: given, or its default.
bool MikroprogConversion::fixParameters(LoweredCycle& lowered) {
  bool good = true;
  for (ir::VariableId id = 0; id < lowered.cycle.variables.size(); ++id) {
    const ir::Variable& variable = lowered.cycle.variable(id);
    if (variable.role != ir::Role::Parameter || lowered.fixed.contains(id)) continue;
    if (variable.defaultValue) {
      lowered.fixed.emplace(id, *variable.defaultValue);
    } else if (ir::uses(lowered.cycle, id)) {
      session_.diagnostics().report<diag::FieldNeeded>(variable.range, variable.name, variable.name);
      good = false;
    }
  }
  return good;
}

std::optional<MikroprogProgram> MikroprogConversion::run(const CycleFolder& folder,
                                                         std::set<std::string>& usedSets,
                                                         std::set<std::string>& usedDefaults) {
  Diagnostics& diagnostics = session_.diagnostics();
  const Restore restore(inputs_);
  const JobOperation* operation = operationOf(folder);
  if (diagnostics.hasErrors()) return std::nullopt;
  if (operation != nullptr) {
    std::map<std::string, double> own = operation->hosts;
    if (!operation->at.empty()) {
      own.emplace("start_x", operation->at.front().first);
      own.emplace("start_y", operation->at.front().second);
    }
    for (const auto& [name, value] : own) {
      const bool flag = std::any_of(options_.common.host.begin(), options_.common.host.end(),
                                    [&, &key = name](const auto& given) { return given.first == key; });
      if (!flag) inputs_.hosts[name] = value;
    }
    for (const JobValue& value : operation->set) {
      const bool flag = std::any_of(inputs_.sets.begin(), inputs_.sets.end(),
                                    [&](const auto& set) { return sameName(set.first, value.name); });
      if (!flag) inputs_.sets.emplace_back(value.name, value.value);
    }
  }

  std::optional<LoweredCycle> lowered = lowerCycle(folder, inputs_, usedSets, session_);
  if (!lowered) return std::nullopt;
  if (operation != nullptr) {
    for (const JobValue& value : operation->set)
      if (!usedSets.contains(value.name))
        diagnostics.report<diag::NoSuchField>(value.range, value.name, folder.name, "");
  }
  ir::Cycle& cycle = lowered->cycle;
  cycle.name = folder.name;
  applyDefaults(options_.defaults, *lowered, usedDefaults, session_);
  settleValues(folder, *lowered, session_);
  const std::optional<std::string> name = controlFor(folder, *lowered);
  if (!name || diagnostics.hasErrors()) return std::nullopt;
  const auto control = loadProfile(*name, session_);
  if (!control) return std::nullopt;
  const bool fixed = fixParameters(*lowered);
  for (const std::string& host : mikroprog::missingHosts(cycle, *control, inputs_.hosts)) {
    const auto info = std::find_if(std::begin(stdlib::kHostInputs), std::end(stdlib::kHostInputs),
                                   [&](const stdlib::HostInput& one) { return one.name == host; });
    diagnostics.report<diag::HostNeeded>(cycle.range, folder.name, host, info->meaning, host);
  }
  if (!fixed || diagnostics.hasErrors()) return std::nullopt;
  if (const std::optional<ir::Statement> alarm = certainAlarm(*lowered)) {
    reportRejected(folder, *alarm, session_);
    return std::nullopt;
  }

  mikroprog::EmitOptions emit{*control, mikroprog::shortFileName(folder.name), {}, {}, {}, false, {}};
  emit.datum = options_.datum == "operator" ? mikroprog::Datum::Operator : mikroprog::Datum::SetPosition;
  emit.assumed = questionsOf(options_.common.assume);
  emit.hosts = inputs_.hosts;
  emit.lengthToCentre = inputs_.job && inputs_.job->lengthToCentre;
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    const ir::Variable& variable = cycle.variable(id);
    if (variable.role != ir::Role::Parameter || !lowered->fixed.contains(id)) continue;
    emit.values.push_back({variable.name, lowered->fixed.at(id), fromWhere(variable.name)});
  }
  ir::fold(cycle, lowered->fixed, {true, session_.limits().steps});
  if (!cycle.checks.empty()) {
    diagnostics.report<diag::ChecksUndecided>(cycle.checks.front().origin.range(), folder.name);
    return std::nullopt;
  }
  const auto [other, added] = written_.emplace(emit.fileName, folder.name);
  if (!added) {
    diagnostics.report<diag::FileNameTwice>({}, emit.fileName, other->second, folder.name);
    return std::nullopt;
  }
  // The back end says what becomes of an alarm.
  std::erase_if(diagnostics.all(),
                [](const Diagnostic& one) { return one.code == diag::AlarmRenumbered::code; });
  const auto lines = mikroprog::emit(cycle, emit, diagnostics);
  if (!lines) return std::nullopt;
  MikroprogProgram out;
  out.file.name = emit.fileName + "." + control->programEnding;
  out.map.name = out.file.name;
  for (const mikroprog::EmittedLine& line : *lines) {
    out.file.text += line.text + "\r\n";
    out.map.lines.push_back({static_cast<std::uint32_t>(out.map.lines.size() + 1), line.ranges, line.reason});
  }
  return out;
}

} // namespace dotek::driver
