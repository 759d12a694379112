#include "targets/CycleFileCasesParts.h"

#include "frontend/cycle/Link.h"
#include "ir/CycleNames.h"
#include "ir/Rewrite.h"
#include "project/CycleFiles.h"
#include "stdlib/HostInputs.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"
#include "support/messages/Verify.h"
#include "targets/KeptResults.h"
#include "targets/Stage.h"
#include "targets/Target.h"
#include "targets/ToolEntry.h"
#include "verify/Random.h"
#include "verify/Rehearsal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::targets {

namespace cycle = frontend::cycle;

namespace {

constexpr std::uint32_t kAttempts = 2000; // to find values that the cycle takes
// Of values with which the cycle ends in an alarm of its own: so many of a case are run on both sides.
constexpr std::uint32_t kMostAlarms = 2;
// Of values that the cycle takes and for which no program is written: others are not looked for any more.
constexpr std::uint32_t kMostRefused = 300;
constexpr std::uint64_t kCallerCases = 8; // whose callers break what the translation demands
constexpr double kOvertravel = 10;        // of a search where nothing states it: that of vendors' macros, mm
constexpr double kLeastWay = 0.01;        // mm to a touch; macros take less for a stylus that is deflected
constexpr double kMissing = 0.3;          // share of the surfaces that may be missing and are
constexpr double kLeftOut = 0.35;         // share of the cases in which a caller leaves an argument out

// Names of the choice, as many as the type has; of a flag both states.
std::vector<double> choicesOf(const cycle::Type& type) {
  std::vector<double> out;
  if (type.name == cycle::TypeName::Flag) return {0, 1};
  for (std::size_t i = 0; i < type.choices.size(); ++i)
    out.push_back(static_cast<double>(i + 1));
  return out;
}

// Without some of those after which the cycle goes on where nothing is found; which, the values decide, so
// that a replay has the same part.
std::vector<verify::Touch> foundOf(const verify::CycleStand::Rehearsal& rehearsal,
                                   const verify::Case& drawn) {
  std::uint64_t seed = 0;
  for (const auto& [name, value] : drawn.values)
    seed = verify::Random::sub(seed, verify::Random::hash(name + numberText(value)));
  std::vector<verify::Touch> out;
  for (std::size_t i = 0; i < rehearsal.surfaces.size(); ++i) {
    verify::Random random(verify::Random::sub(seed, i));
    if (!rehearsal.mayMiss[i] || !random.chance(kMissing)) out.push_back(rehearsal.surfaces[i]);
  }
  return out;
}

} // namespace

bool touchesAtOnce(const verify::Record& record, double ballRadius, SourceRange& at) {
  for (const verify::Measure& measure : record.measures) {
    if (measure.contacts.empty()) continue;
    const sim::Point3 centre = measure.start + sim::Point3{0, 0, ballRadius};
    if ((measure.contacts.front().centre - centre).length() >= kLeastWay) continue;
    at = measure.range;
    return true;
  }
  return false;
}

CycleFileRunner::CycleFileRunner(const VerifyOptions& options, const VerifyPlan& plan)
    : options_(options), plan_(plan), session_(options.common), compilation_(session_),
      limitsOfCycle_(limitsOfRun(session_.limits())) {}

CycleFileRunner::~CycleFileRunner() = default;

bool CycleFileRunner::load() {
  const Target* const target = findTarget(options_.to);
  const bool first = options_.control.empty() || (target != nullptr && target->ownControls);
  compilation_.takeLiterals();
  inputs_ = compilation_.load(options_.source, first ? std::string(kDefaultControl) : options_.control);
  if (inputs_ == nullptr) return false;
  const std::string& path = options_.inputs.front();
  folder_ = &compilation_.addFile(path);
  lowered_ = compilation_.lower(*folder_);
  if (!lowered_ || session_.diagnostics().hasErrors()) return false;
  stores_ = keepResults(lowered_->cycle, options_.results, session_.diagnostics()).numbers;
  Diagnostics said = std::exchange(session_.diagnostics(), Diagnostics());
  project::CycleFiles files(session_);
  const cycle::File& file = *files.linked(path); // it has been lowered
  session_.diagnostics() = std::move(said);
  needsProbe_ =
      std::any_of(file.body.statements.begin(), file.body.statements.end(),
                  [](const cycle::Statement& one) { return std::holds_alternative<cycle::Needs>(one.node); });
  for (const ir::CycleStatement& statement : cycle().body) {
    const auto* spindle = std::get_if<ir::Spindle>(&statement.node);
    const auto* coolant = std::get_if<ir::Coolant>(&statement.node);
    stopsSpindle_ |= spindle != nullptr && spindle->state == ir::Spindle::State::Off;
    stopsCoolant_ |= coolant != nullptr && coolant->state == ir::Coolant::State::Off;
  }
  std::map<std::string, std::vector<double>> choices;
  for (const cycle::Statement* const declared : cycle::declarations(file))
    if (const auto* parameter = std::get_if<cycle::Parameter>(&declared->node))
      for (const cycle::Name& name : parameter->names)
        choices[name.text] = choicesOf(parameter->type);
  const std::set<double> compared = ir::constantsOf(cycle().checks);
  int decimals = 3;
  if (inputs_->control) decimals = std::min(decimals, static_cast<int>(inputs_->control->decimals));
  for (ir::VariableId id = 0; id < cycle().variables.size(); ++id) {
    const ir::Variable& variable = cycle().variable(id);
    if (variable.role != ir::Role::Parameter) continue;
    verify::DrawField& field = fields_.emplace_back();
    field.name = variable.name;
    field.kind = variable.kind;
    field.initial = variable.defaultValue;
    field.decimals = variable.kind == ir::Kind::Count ? 0 : decimals;
    field.thresholds.assign(compared.begin(), compared.end());
    field.choices = choices[variable.name];
    if (const auto fixed = lowered_->fixed.find(id); fixed != lowered_->fixed.end())
      field.fixed = fixed->second;
  }
  return !session_.diagnostics().hasErrors();
}

std::vector<verify::DrawField> CycleFileRunner::fields() const {
  return fields_;
}

bool CycleFileRunner::isField(const std::string& name) const {
  return std::any_of(plan_.fields.begin(), plan_.fields.end(),
                     [&](const verify::DrawField& one) { return one.name == name; });
}

bool CycleFileRunner::knowsValues() {
  for (const auto& [name, text] : options_.values) {
    const bool field = isField(name);
    if (!parseNumber(text))
      session_.diagnostics().report<diag::NotANumber>({}, "--value", name, text);
    else if (!field && !stdlib::isHostInput(name))
      session_.diagnostics().report<diag::NoSuchField>(SourceRange{}, name, folder_->name, "");
  }
  return !session_.diagnostics().hasErrors();
}

bool CycleFileRunner::prepare() {
  if (!knowsValues()) return false;
  std::vector<std::string> hosts = {"tool_radius", "start_x", "start_y", "start_z"};
  for (const ir::Variable& variable : cycle().variables)
    if (variable.role == ir::Role::Host) hosts.push_back(variable.name);
  for (const std::string_view host : findTarget(options_.to)->hosts)
    if (std::find(hosts.begin(), hosts.end(), host) == hosts.end()) hosts.emplace_back(host);
  draws_.emplace(plan_.fields, std::move(hosts), plan_.fixedHosts, options_.seed, plan_.bounds,
                 options_.cases);
  stand_.emplace(limitsOfCycle_);
  target_ = findTarget(options_.to)->verify({options_, plan_, session_, *inputs_, *folder_, compilation_});
  return target_->prepare();
}

// What the caller may leave out he leaves out now and then.
void CycleFileRunner::leaveOut(verify::Case& drawn) const {
  for (const ir::Variable& variable : cycle().variables) {
    if (variable.role != ir::Role::Parameter || (!variable.optional && !variable.defaultValue)) continue;
    const auto field = std::find_if(plan_.fields.begin(), plan_.fields.end(),
                                    [&](const auto& one) { return one.name == variable.name; });
    if (field == plan_.fields.end() || field->fixed) continue;
    const Verification::Given given =
        target_ == nullptr ? Verification::Given::AsDrawn : target_->given(variable.name);
    if (given == Verification::Given::Never) drawn.values.erase(variable.name);
    if (given != Verification::Given::AsDrawn) continue;
    verify::Random random(verify::Random::sub(drawn.stream, verify::Random::hash(variable.name)));
    if (random.chance(kLeftOut)) drawn.values.erase(variable.name);
  }
}

// The retract plane lies above the start.
void CycleFileRunner::settle(verify::Case& drawn) const {
  const auto retract = drawn.hosts.find("retract");
  if (retract != drawn.hosts.end() && !plan_.fixedHosts.contains("retract"))
    retract->second = std::round((drawn.hosts.at("start_z") + retract->second) * 1000) / 1000;
}

sim::CycleInputs CycleFileRunner::inputsOf(const verify::Case& drawn) const {
  sim::CycleInputs out;
  const auto host = [&](const char* name) {
    const auto found = drawn.hosts.find(name);
    return found == drawn.hosts.end() ? std::nullopt : std::optional(found->second);
  };
  out.overtravel = host("overtravel").value_or(kOvertravel);
  out.approachFeed = host("approach_feed").value_or(out.approachFeed);
  out.measuringFeed = host("measuring_feed").value_or(out.measuringFeed);
  out.retract = host("retract");
  out.values.resize(cycle().variables.size());
  for (ir::VariableId id = 0; id < cycle().variables.size(); ++id) {
    const ir::Variable& variable = cycle().variable(id);
    if (variable.role == ir::Role::Local) continue;
    const auto& given = variable.role == ir::Role::Host ? drawn.hosts : drawn.values;
    if (const auto found = given.find(variable.name); found != given.end())
      out.values[id] = ir::Scalar::of(found->second);
    else if (variable.role == ir::Role::Parameter)
      out.values[id] = variable.defaultValue ? ir::Scalar::of(*variable.defaultValue) : ir::Scalar::null();
  }
  return out;
}

// What the cycle switches off is on before.
verify::Entry CycleFileRunner::entryOf(const verify::Case& drawn) const {
  verify::Entry entry = entryFor(drawn, needsProbe_ || options_.common.assume.contains("probe-on"));
  verify::Random random(callerStream(drawn));
  const bool left = random.chance(0.5), mist = random.chance(0.5);
  if (stopsSpindle_) entry.spindle = left ? 2 : 1;
  if (stopsCoolant_) entry.coolant = mist ? sim::Machine::Coolant::Mist : sim::Machine::Coolant::Flood;
  return entry;
}

sim::MachineLimits CycleFileRunner::limits() const {
  return {}; // zeros are drawn: no travel holds for them
}

namespace {

// The tool table of the machine that the cycle runs on. `wears`: that of the target keeps a wear of the
// length apart.
void putTools(const std::vector<ToolEntry>& tools, bool wears, verify::Entry& entry) {
  for (const ToolEntry& tool : tools) {
    const auto put = [&](ir::ToolPart part, double value) {
      const double base = ir::kToolTable + ir::kToolPartStep * static_cast<double>(part);
      entry.variables.emplace_back(static_cast<std::uint32_t>(base) + tool.number, value);
    };
    if (wears) put(ir::ToolPart::LengthWear, tool.lengthWear);
    put(ir::ToolPart::Radius, tool.radius);
    put(ir::ToolPart::RadiusWear, tool.radiusWear);
  }
}

bool keepsWear(const std::optional<stdlib::Control>& control) {
  return !control || (control->variables.toolGeometry && control->variables.toolWear);
}

} // namespace

verify::Record CycleFileRunner::runCycle(const verify::Case& drawn, sim::World& world, bool keepMoves,
                                         const verify::Interference& interference, sim::CycleWay* way) const {
  verify::Entry entry = entryOf(drawn);
  putTools(toolEntries(plan_, drawn), keepsWear(inputs_->control), entry);
  return stand_->run(cycle(), inputsOf(drawn), world, entry, stores_, keepMoves, false, interference, way);
}

// A rehearsal says which surfaces it expects, the part is made of them, then it runs.
std::unique_ptr<CycleFileRunner::Played> CycleFileRunner::play(verify::Case drawn, bool drawError) {
  auto out = std::make_unique<Played>();
  out->drawn = std::move(drawn);
  const sim::Probe probe = probeFor(plan_, out->drawn);
  verify::Entry entry = entryOf(out->drawn);
  putTools(toolEntries(plan_, out->drawn), keepsWear(inputs_->control), entry);
  const sim::Point3 zero = entry.zeros[out->drawn.system - 54];
  verify::CycleStand::Rehearsal rehearsal = stand_->rehearse(cycle(), inputsOf(out->drawn), probe, entry);
  if (plan_.part) {
    out->part = plan_.part;
  } else if (out->surfaces = foundOf(rehearsal, out->drawn); !out->surfaces.empty()) {
    if (drawError) {
      verify::Random random(verify::Random::sub(out->drawn.stream, verify::Random::hash("part")));
      verify::Record expected;
      expected.measures.emplace_back().nominal = out->surfaces;
      out->drawn.error = verify::drawError(expected, probe.ballRadius(), random);
    }
    out->part = verify::partOf(out->surfaces, probe.ballRadius(), std::max(probe.ballRadius(), kReach),
                               out->drawn.error);
    out->partMade = out->part.has_value();
  }
  const bool tooMany = !out->part && !out->surfaces.empty();
  if (!out->part) out->part = emptyPart(zero);
  sim::World world(*out->part, probe, limits());
  out->record = runCycle(out->drawn, world, false, {}, &out->way);
  out->rejected = isRejection(out->record);
  out->why = verify::whyNoEvidence(out->record, out->whyAt);
  // A cycle that touches nothing computes, and sets what it computes.
  if (out->record.ending == verify::Ending::Finished && rehearsal.surfaces.empty()) out->why.clear();
  out->atOnce = touchesAtOnce(out->record, probe.ballRadius(), out->whyAt);
  if (out->atOnce) out->why = "the ball touches where a touch begins";
  if (tooMany && !out->why.empty()) {
    out->why =
        fmt::format("no part can be made of the {} surfaces that it touches: a part has at most {} shapes; "
                    "`--part FILE` gives one",
                    out->surfaces.size(), sim::PartBuilder::kMostShapes);
    out->whyAt = {};
  }
  return out;
}

verify::Case CycleFileRunner::replayed(verify::Case drawn) const {
  drawn.values.clear(); // what is not given is left out
  for (const verify::DrawField& field : plan_.fields)
    if (field.fixed) drawn.values[field.name] = *field.fixed;
  for (const auto& [name, text] : options_.values) {
    const bool field = isField(name);
    (field ? drawn.values : drawn.hosts)[name] = parseNumber(text).value_or(0);
  }
  return drawn;
}

std::optional<verify::Case> CycleFileRunner::draw(std::uint64_t index) {
  rejected_.clear();
  std::uint32_t alarms = 0, checks = 0, refused = 0;
  for (std::uint32_t tries = 0; tries < kAttempts; ++tries) {
    verify::Case proposal = draws_->propose(index, tries);
    proposal.callers = plan_.translation && (index < kCallerCases || options_.replay);
    if (options_.activeSystem) proposal.system = *options_.activeSystem;
    if (options_.partError) {
      const auto& [x, y, z, turn] = *options_.partError;
      proposal.error = {{x, y, z}, turn};
    }
    if (options_.replay) return replayed(std::move(proposal));
    leaveOut(proposal);
    settle(proposal);
    std::unique_ptr<Played> played = play(std::move(proposal), !options_.partError);
    bool taken = played->why.empty(), unwritten = false;
    // Written for each case: values for which there is no program tell nothing.
    if (taken && findTarget(options_.to)->fixesValues) {
      const TargetRun ran = runTarget(*played);
      taken = !ran.refused;
      if (ran.refused) {
        unwritten = true;
        played->why = ran.why;
        for (const Diagnostic& one : session_.diagnostics().all())
          if (one.severity == Severity::Error) {
            played->whyAt = one.range;
            break;
          }
      }
    }
    // An alarm of the cycle is an alarm of the program, too: a difference is not drawn away. Where a move
    // that is to meet nothing grazes the part, or a touch has no way, the last digit decides.
    if (!taken && played->record.ending == verify::Ending::Alarm && played->record.events.empty() &&
        played->record.alarmKind.empty() && !played->atOnce) {
      std::uint32_t& count = played->rejected ? checks : alarms;
      if (count < kMostAlarms) {
        ++count;
        noteCompared(played->record, played->way);
        const TargetRun ran = runTarget(*played);
        if (!ran.stopped.empty())
          stopped_ = {makeDiagnostic<diag::TranslationStopped>({}, plan_.translation->name, ran.stopped),
                      played->drawn};
        taken = !ran.differences.empty() || stopped_.has_value();
      }
    }
    if (taken) {
      verify::Case drawn = played->drawn;
      drawn_ = std::move(played);
      return drawn;
    }
    Rejection& rejection = rejected_[{played->why, played->whyAt.begin}];
    rejection = {rejection.count + 1, played->why, played->whyAt, unwritten};
    refused += unwritten ? 1 : 0;
    if (refused >= kMostRefused) break;
  }
  return std::nullopt;
}

verify::Case CycleFileRunner::edge(std::uint64_t index) {
  verify::Case out = draws_->edge(index);
  leaveOut(out);
  settle(out);
  drawn_ = play(std::move(out), true);
  return drawn_->drawn;
}

TargetRun CycleFileRunner::runTarget(const Played& played, ShownRun* shown) {
  Questions questions(*this, played);
  return runTarget(played, played.drawn.callers && !played.rejected ? &questions : nullptr, shown);
}

TargetRun CycleFileRunner::runTarget(const Played& played, SourceQuestions* questions, ShownRun* shown) {
  sim::World world(*played.part, probeFor(plan_, played.drawn), limits());
  const verify::Entry entry = entryOf(played.drawn);
  TargetCase now{.drawn = played.drawn,
                 .entry = entry,
                 .stores = stores_,
                 .world = world,
                 .source = played.rejected ? nullptr : &played.record,
                 .stream = callerStream(played.drawn)};
  now.shown = shown;
  now.questions = questions;
  now.rejected = played.rejected;
  now.rejection = played.record.text;
  now.sourceOf = [](SourceRange place) { return place; };
  return target_->run(now);
}

void CycleFileRunner::takeDifferences(CaseResult& result, const TargetRun& ran) const {
  for (const TargetDifference& one : ran.differences) {
    CaseFinding& finding = result.findings.emplace_back();
    finding.aspect = one.difference.aspect;
    finding.text = one.difference.text + (one.text.empty() ? "" : ", in `" + one.text + "`");
    finding.source = one.difference.source;
    finding.targetLine = one.line;
  }
}

CaseResult CycleFileRunner::run(const verify::Case& drawn) {
  CaseResult result = runBoth(drawn);
  result.alarms = std::exchange(met_, {});
  result.reached = std::exchange(newly_, {});
  return result;
}

CaseResult CycleFileRunner::runBoth(const verify::Case& drawn) {
  std::unique_ptr<Played> played = std::move(drawn_); // of draw()
  if (!played) played = play(drawn, false);
  CaseResult result;
  result.why = played->why;
  result.whyAt = played->whyAt;
  result.partMade = played->partMade;
  const verify::ProbeOff off = verify::probeOffIn(played->record);
  if (!played->rejected) result.unarmed = off.measuring, result.unprotected = off.protectedMove;
  if (played->record.ending == verify::Ending::Inconclusive) {
    result.verdict = CaseVerdict::NoProgram;
    return result;
  }
  TargetRun ran = runTarget(*played);
  result.trace = std::move(ran.trace);
  if (!ran.stopped.empty()) {
    stopped_ = {makeDiagnostic<diag::TranslationStopped>({}, plan_.translation->name, ran.stopped), drawn};
    return result;
  }
  if (ran.refused && !played->rejected) {
    result.verdict = CaseVerdict::Refused;
    result.why = "the translation refuses the values: " + ran.why;
    result.whyAt = {};
    return result;
  }
  if (ran.undecided) {
    result.verdict = CaseVerdict::NoProgram;
    if (!ran.why.empty()) result.why = std::move(ran.why), result.whyAt = {};
    return result;
  }
  takeDifferences(result, ran);
  noteCompared(played->record, played->way);
  if (drawn.callers && result.findings.empty() && result.why.empty()) {
    runAtBounds(drawn, result);
    if (result.findings.empty()) runOnOtherParts(*played, result);
  }
  result.verdict = !result.findings.empty() ? CaseVerdict::Differ
                   : result.why.empty()     ? CaseVerdict::Agrees
                                            : CaseVerdict::Undecided;
  return result;
}

std::vector<Rejection> CycleFileRunner::rejections() const {
  return commonestFirst(rejected_);
}

VerifySides CycleFileRunner::sides() const {
  VerifySides out;
  const Target* const target = findTarget(options_.to);
  if (target != nullptr && target->ownControls)
    out.targetControl = options_.control;
  else if (inputs_->control)
    out.targetControl = controlText(*inputs_->control);
  return out;
}

std::optional<CasePictures> CycleFileRunner::pictures(const verify::Case& drawn) {
  const std::unique_ptr<Played> played = play(drawn, false);
  const sim::Probe probe = probeFor(plan_, drawn);
  sim::World world(*played->part, probe);
  const bool empty = !played->partMade && !plan_.part;
  const verify::Record source = runCycle(drawn, world, true);
  ShownRun shown;
  runTarget(*played, &shown);
  return picturesOf(source, shown, *played->part, probe, empty);
}

} // namespace dotek::targets
