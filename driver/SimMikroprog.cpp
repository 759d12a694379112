#include "driver/SimMikroprog.h"

#include "frontend/mikroprog/Check.h"
#include "frontend/mikroprog/Lower.h"
#include "frontend/mikroprog/Parse.h"
#include "sim/machine/Mikroprog.h"
#include "sim/run/SimReport.h"
#include "sim/run/SimWorld.h"
#include "stdlib/MikroprogControl.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"
#include "support/messages/Mikroprog.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <nlohmann/json.hpp>

namespace dotek::driver {
namespace {

using sim::MikroprogEnding;
using sim::MikroprogEvent;
using sim::positionText;
using sim::RunPlace;
using sim::SimWorld;
using sim::toUtf8Text;

std::string_view endingName(MikroprogEnding ending) {
  switch (ending) {
  case MikroprogEnding::ProgramEnd: return "program-end";
  case MikroprogEnding::Fault: return "alarm";
  case MikroprogEnding::Crash: return "crash";
  case MikroprogEnding::Inconclusive: return "inconclusive";
  case MikroprogEnding::Endless: return "limit";
  case MikroprogEnding::Running: break;
  }
  return "not-read";
}

class SimMikroprog {
public:
  SimMikroprog(const SimOptions& options, Session& session) : options_(options), session_(session) {}

  Outcome run() {
    if (!refuseOptions()) return outcomeOf(session_, "");
    const std::optional<FileId> id = session_.read(options_.program, Encoding::Cp852);
    if (!id) return outcomeOf(session_, "");
    const auto program = frontend::mikroprog::parse(*id, session_.sources(), session_.diagnostics());
    if (diagnostics().hasErrors()) return outcomeOf(session_, "");
    control_ = loadControl(program);
    if (!control_ || !check(program)) return outcomeOf(session_, "");
    auto lowered = frontend::mikroprog::lower(program, session_.sources());
    const std::unique_ptr<SimWorld> world = SimWorld::load(options_, session_);
    if (!lowered || !world) return outcomeOf(session_, "");
    for (const frontend::mikroprog::Line& line : program.lines)
      lines_.emplace(session_.sources().line(line.range), line.range);

    const sim::BlockList blocks(std::move(lowered->programs.front()), session_.sources());
    sim::MikroprogMachine machine(*control_, blocks);
    world->setPlace([&] { return place(machine); });
    world->attach(machine);
    std::optional<sim::Trace> trace;
    if (options_.trace) machine.setTrace(&trace.emplace(options_.trace));
    constexpr std::uint64_t kStepsOfBlock = 10;
    machine.run(std::max<std::uint64_t>(1, session_.limits().simSteps / kStepsOfBlock));
    machine.setTrace(nullptr);
    trace.reset();
    report(machine);
    world->reportRest();
    Outcome out = outcomeOf(session_, options_.json ? summary(machine, *world) : "", true);
    out.files = world->pictures();
    return out;
  }

private:
  Diagnostics& diagnostics() { return session_.diagnostics(); }

  bool refuseOptions() {
    if (!options_.variables.empty()) diagnostics().report<diag::OptionOfMacroB>({}, "--var");
    if (!options_.programs.empty()) diagnostics().report<diag::OptionOfMacroB>({}, "--programs");
    if (options_.probeMacros) diagnostics().report<diag::OptionOfMacroB>({}, "--probe-macros");
    if (const std::string_view flag = options_.setup.firstFlag(); !flag.empty())
      diagnostics().report<diag::OptionOfMacroB>({}, flag);
    return !diagnostics().hasErrors();
  }

  // Without --control a program that moves Y is one of the mill; another may be of either.
  std::optional<stdlib::MikroprogControl> loadControl(const frontend::mikroprog::Program& program) {
    const bool mill = std::any_of(program.lines.begin(), program.lines.end(), [](const auto& line) {
      return line.find('Y') != nullptr || line.find('J') != nullptr;
    });
    if (options_.control.empty() && !mill) {
      diagnostics().report<diag::ControlNotChosen>({}, options_.program);
      return std::nullopt;
    }
    const std::string name = options_.control.empty() ? "mikroprog-mill" : options_.control;
    auto control = stdlib::MikroprogControl::load(session_.data(), name);
    if (!control) {
      std::vector<std::string> known;
      for (const stdlib::DataFile* file : session_.data().list("mikroprog"))
        known.push_back(file->name);
      diagnostics().report<diag::UnknownProfile>({}, name, fmt::format("{}", fmt::join(known, ", ")));
    }
    return control;
  }

  // What the control would not take is reported before anything runs; the rest is for lint.
  bool check(const frontend::mikroprog::Program& program) {
    frontend::mikroprog::refuse({program, *control_, session_.sources()}, diagnostics());
    return !diagnostics().hasErrors();
  }

  SourceRange rangeOf(std::uint32_t line) const {
    const auto found = lines_.find(line);
    return found == lines_.end() ? SourceRange() : found->second;
  }
  RunPlace place(const sim::MikroprogMachine& machine) const {
    RunPlace out{rangeOf(machine.line()), {}, 0};
    for (const std::uint32_t line : machine.openCalls())
      out.calls.push_back(rangeOf(line));
    return out;
  }

  void report(const sim::MikroprogMachine& machine) {
    const RunPlace at = place(machine);
    Diagnostic* said = nullptr;
    switch (machine.ending()) {
    case MikroprogEnding::Running:
    case MikroprogEnding::ProgramEnd: return;
    case MikroprogEnding::Fault:
    case MikroprogEnding::Crash:
      said = &diagnostics().report<diag::ControlFault>(at.range, toUtf8Text(machine.why()));
      break;
    case MikroprogEnding::Inconclusive:
      said = &diagnostics().report<diag::RunInconclusive>(at.range, session_.sources().textUtf8(at.range),
                                                          machine.why());
      break;
    case MikroprogEnding::Endless:
      said = &diagnostics().report<diag::RunLimit>(
          at.range, machine.why() + "; `--limit sim-steps=N` with ten steps a block allows more");
      break;
    }
    for (auto call = at.calls.rbegin(); call != at.calls.rend(); ++call)
      said->note(*call, "called here");
  }

  static std::string pointText(const std::array<double, 3>& point) {
    sim::Position wide{};
    std::copy(point.begin(), point.end(), wide.begin());
    return positionText(wide, 7);
  }

  std::string summary(const sim::MikroprogMachine& machine, const SimWorld& world) {
    std::string out = "{\n";
    out += fmt::format("  \"ending\": \"{}\",\n", endingName(machine.ending()));
    out += fmt::format("  \"control\": {},\n", nlohmann::json(control_->name).dump());
    out += fmt::format("  \"blocks\": {},\n", machine.blocks());
    out += fmt::format("  \"position\": {},\n", pointText(machine.position()));
    out += fmt::format("  \"machine\": {},\n", pointText(machine.machinePosition()));
    out += fmt::format("  \"zero\": {},\n", pointText(machine.offset()));
    std::string parameters, records, stops;
    for (const auto& [number, value] : machine.parameters())
      parameters += fmt::format("{}\"{}\": {}", parameters.empty() ? "" : ", ", number, numberText(value));
    const auto text = [](const std::string& bytes) { return nlohmann::json(toUtf8Text(bytes)).dump(); };
    for (const MikroprogEvent& event : machine.events()) {
      if (event.kind == MikroprogEvent::Kind::Record)
        records += fmt::format("{}{{\"file\": {}, \"position\": {}}}", records.empty() ? "" : ", ",
                               text(event.text), pointText(event.position));
      else if (event.kind == MikroprogEvent::Kind::Value)
        records += fmt::format("{}{{\"file\": {}, \"value\": {}}}", records.empty() ? "" : ", ",
                               text(event.text), numberText(event.value));
      else if (event.kind == MikroprogEvent::Kind::Stop)
        stops += (stops.empty() ? "" : ", ") + text(event.text);
    }
    out += fmt::format("  \"parameters\": {{{}}},\n  \"records\": [{}],\n  \"stops\": [{}],\n", parameters,
                       records, stops);
    out += world.summary();
    std::string diagnostics = renderJson(session_.diagnostics(), session_.sources());
    while (diagnostics.ends_with('\n'))
      diagnostics.pop_back();
    return out + "  \"diagnostics\": " + diagnostics + "\n}\n";
  }

  const SimOptions& options_;
  Session& session_;
  std::optional<stdlib::MikroprogControl> control_;
  std::map<std::uint32_t, SourceRange> lines_;
};

} // namespace

Outcome simMikroprog(const SimOptions& options, Session& session) {
  return SimMikroprog(options, session).run();
}

} // namespace dotek::driver
