#include "backends/fanuc/TargetProgramPlayed.h"
#include "project/MacroCycles.h"

#include "backends/fanuc/ProgramCalls.h"
#include "project/Hosts.h"
#include "project/Lowering.h"
#include "project/MillControl.h"
#include "project/Programs.h"
#include "project/VariableFlags.h"
#include "sim/machine/Compile.h"
#include "sim/machine/Value.h"
#include "sim/vendor/VendorMacros.h"
#include "stdlib/MovedSet.h"
#include "support/Files.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <cmath>

namespace dotek::targets {

namespace {

constexpr std::uint32_t kAttempts = 24;       // to find values with which the program comes to its end
constexpr std::uint32_t kChecked = 400;       // of them, that a check of the program rejects
constexpr std::uint32_t kEndless = 3;         // of them, that come to the limit of steps
constexpr std::uint32_t kMostSteps = 200'000; // of one run: --limit sim-steps may make it less
constexpr std::uint64_t kCallerCases = 8;   // in which the probe meets something else, and callers have modes
constexpr std::uint64_t kMostCalled = 9999; // by M98 on every control
constexpr double kEightDigits = 1e-6;       // what they leave of a value

double toStep(double value) {
  return std::round(value * 1000) / 1000;
}

} // namespace

ProgramRunner::ProgramRunner(const VerifyOptions& options, const VerifyPlan& plan)
    : options_(options), plan_(plan), session_(options.common), sourceLimits_(options.common.limits),
      targetLimits_(options.common.limits) {
  sourceLimits_.simSteps = std::min(sourceLimits_.simSteps, kMostSteps);
  targetLimits_.simSteps = 2 * sourceLimits_.simSteps; // a translation may jump more often
}

ProgramRunner::~ProgramRunner() = default;

bool ProgramRunner::load() {
  const std::string target = options_.control.empty() ? std::string(kDefaultControl) : options_.control;
  targetControl_ = loadControl(target, session_);
  sourceControl_ =
      options_.fromControl.empty() ? targetControl_ : loadControl(options_.fromControl, session_);
  hosts_ = parseHosts(options_.common.host, session_.diagnostics());
  if (!targetControl_ || !sourceControl_ || session_.diagnostics().hasErrors()) return false;
  if (project::refuseLathe(*targetControl_, session_) || project::refuseLathe(*sourceControl_, session_))
    return false;
  const std::optional<FileId> id = session_.read(options_.inputs.front(), Encoding::Cp1250);
  if (!id) return false;
  file_ = *id;
  programs_ = loadPrograms(*id, *sourceControl_, session_);
  if (!programs_ || programs_->programs.empty()) return false;
  sourceSet_ = backends::fanuc::calledSet(*programs_, session_.macroSets(&*sourceControl_));
  // A program of the file is before a macro of that number.
  if (sourceSet_ != nullptr &&
      std::any_of(programs_->programs.begin(), programs_->programs.end(), [&](const ir::Program& program) {
        return program.number != 0 && sourceSet_->calls(static_cast<std::uint32_t>(program.number));
      }))
    sourceSet_ = nullptr;
  if (sourceSet_ != nullptr) {
    sourceSet_ = session_.macroSet(sourceSet_->name, &*sourceControl_);
    targetSet_ = session_.macroSet(options_.probeMacros.value_or(sourceSet_->name), &*targetControl_);
    if (targetSet_ == nullptr) targetSet_ = sourceSet_;
  }
  measuring_ = project::measuringCycles({sourceSet_, targetSet_}, session_);
  std::vector<const stdlib::MacroSet*> used;
  if (sourceSet_ != nullptr) used.push_back(sourceSet_);
  if (targetSet_ != sourceSet_) used.push_back(targetSet_);
  variables_ = verify::variablesOf(*programs_, *sourceControl_, used);
  const auto has = [&](stdlib::Function function) {
    return std::any_of(programs_->programs.begin(), programs_->programs.end(),
                       [&](const ir::Program& program) {
                         return blockWith(program, *sourceControl_, function).has_value();
                       });
  };
  stopsSpindle_ = has(stdlib::Function::SpindleOff);
  stopsCoolant_ = has(stdlib::Function::CoolantOff);
  flow_ = std::make_unique<verify::VariableFlow>(*programs_, *sourceControl_);
  // Signals go by the same number on both.
  std::erase_if(variables_, [&](const verify::ProgramVariable& one) {
    return one.use == verify::VariableUse::Signal && !sim::Machine(*targetControl_).preset(one.number, 0);
  });
  for (const stdlib::VariableRange& range : sourceControl_->common)
    for (std::uint32_t number = range.first; number <= range.last; ++number)
      if (used.size() < 2 || std::none_of(used.begin(), used.end(), [&](const stdlib::MacroSet* set) {
            return verify::usesVariable(*set, number);
          }))
        stores_.insert(number);
  return true;
}

std::optional<std::vector<verify::DrawField>> ProgramRunner::fields() {
  for (const auto& [number, value] : variablesOf(options_.variables, session_.diagnostics()))
    fixed_[number] = value;
  if (session_.diagnostics().hasErrors()) return std::nullopt;
  std::vector<verify::DrawField> out;
  const auto add = [&](std::uint32_t number, std::optional<double> value) {
    verify::DrawField field;
    field.name = std::to_string(number);
    field.fixed = value;
    out.push_back(std::move(field));
  };
  for (const verify::ProgramVariable& variable : variables_)
    if (!fixed_.contains(variable.number)) add(variable.number, std::nullopt);
  for (const auto& [number, value] : fixed_)
    add(number, value);
  return out;
}

// A program that returns is called: M98 leaves it the locals that were set before.
bool ProgramRunner::addCaller() {
  const std::vector<ir::Program>& programs = programs_->programs;
  const auto& body = programs.front().body;
  const bool returns = std::any_of(body.begin(), body.end(), [](const ir::ProgramStatement& statement) {
    return std::holds_alternative<ir::Exit>(statement.node);
  });
  if (!returns) return true;
  std::set<std::uint64_t> taken;
  for (const ir::Program& program : programs) {
    taken.insert(program.number);
    for (const ir::ProgramStatement& statement : program.body) {
      const auto* call = std::get_if<ir::Call>(&statement.node);
      const double* number = call != nullptr && call->program ? ir::constantValue(call->program) : nullptr;
      if (number != nullptr && *number >= 1 && *number < 1e8)
        taken.insert(static_cast<std::uint64_t>(std::lround(*number)));
    }
  }
  const auto next = [&] {
    std::uint32_t number = 1;
    while (taken.contains(number))
      ++number;
    taken.insert(number);
    return number;
  };
  const std::uint64_t own = programs.front().number;
  caller_ = Caller();
  caller_->callee = own >= 1 && own <= kMostCalled ? static_cast<std::uint32_t>(own) : next();
  caller_->text = fmt::format("O{}\nM98P{}\nM30\n", next(), caller_->callee);
  programs_->programs.front().nameKind = ir::Program::NameKind::Number;
  programs_->programs.front().number = caller_->callee;
  const std::optional<FileId> id = addText("call", caller_->text, Encoding::Utf8, std::nullopt,
                                           session_.sources(), session_.diagnostics());
  if (id) caller_->source = loadPrograms(*id, *sourceControl_, session_);
  return caller_->source.has_value();
}

bool ProgramRunner::compileSource(const stdlib::Control& control, sim::Bytecode& out, verify::Stand& stand) {
  std::vector<const ir::Program*> programs;
  if (caller_) programs.push_back(&caller_->source->programs.front());
  for (const ir::Program& program : programs_->programs)
    programs.push_back(&program);
  if (sourceSet_ != nullptr && !macros_) {
    if (auto text = stdlib::macroText(session_.data(), sourceSet_->name)) {
      const std::optional<FileId> id =
          addText("macrob/" + sourceSet_->name + ".nc", std::move(*text), Encoding::Utf8, std::nullopt,
                  session_.sources(), session_.diagnostics());
      if (id) macros_ = loadPrograms(*id, control, session_);
      if (!macros_) return false;
    }
  }
  if (macros_)
    for (const ir::Program& program : macros_->programs)
      programs.push_back(&program);
  out = sim::compile(programs, control, session_.sources());
  stand.watchOnly(sim::safeMoves(programs, control));
  return true;
}

bool ProgramRunner::prepare() {
  const auto listOf = [](const stdlib::MacroSet* set) {
    return set == nullptr ? std::vector<const stdlib::MacroSet*>{}
                          : std::vector<const stdlib::MacroSet*>{set};
  };
  sourceStand_ = std::make_unique<verify::Stand>(*sourceControl_, listOf(sourceSet_), sourceLimits_);
  if (!addCaller() || !compileSource(*sourceControl_, sourceCode_, *sourceStand_)) return false;
  if (sourceControl_->arithmetic != targetControl_->arithmetic) {
    sourceAsTarget_ = sourceControl_;
    sourceAsTarget_->arithmetic = targetControl_->arithmetic;
    sourceAsTargetStand_ =
        std::make_unique<verify::Stand>(*sourceAsTarget_, listOf(sourceSet_), sourceLimits_);
    if (!compileSource(*sourceAsTarget_, sourceAsTargetCode_, *sourceAsTargetStand_)) return false;
  }
  targetStand_ = std::make_unique<verify::Stand>(*targetControl_, listOf(targetSet_), targetLimits_);
  if (caller_ && !translation_.read("call", caller_->text, *targetControl_, session_)) return false;
  if (!translation_.readTranslation(*plan_.translation, *targetControl_, session_)) return false;
  if (caller_) translation_.numberFirst(caller_->callee);
  if (targetSet_ != nullptr && !translation_.readMacros(*targetSet_, *targetControl_, session_)) return false;
  translation_.compile(*targetControl_);
  targetStand_->watchOnly(translation_.safeMoves());
  return true;
}

// Each name has numbers of its own, so that none depends on what is drawn beside it.
verify::Case ProgramRunner::propose(std::uint64_t index, const Tries& tries) const {
  const auto triesOf = [&](std::uint32_t number) {
    const auto at = tries.find(number);
    return at == tries.end() ? 0 : at->second;
  };
  const std::uint64_t first = verify::Random::sub(options_.seed, index);
  const std::uint64_t stream = verify::Random::sub(first, triesOf(0));
  const auto randomOf = [&](const std::string& name) {
    return verify::Random(verify::Random::sub(stream, verify::Random::hash(name)));
  };
  verify::Case out;
  out.stream = stream;
  for (const verify::ProgramVariable& variable : variables_) {
    const std::string name = std::to_string(variable.number);
    const std::uint32_t attempt = triesOf(0) + triesOf(variable.number);
    verify::Random random(
        verify::Random::sub(verify::Random::sub(first, attempt), verify::Random::hash(name)));
    const std::optional<double> value = verify::drawValue(variable, attempt, random);
    if (value && !options_.replay) out.values[name] = *value;
  }
  for (const auto& [number, value] : fixed_)
    out.values[std::to_string(number)] = value;
  const auto host = [&](const std::string& name, double least, double most) {
    verify::Random random = randomOf(name);
    out.hosts[name] = toStep(random.between(least, most));
  };
  host("tool_radius", 0.5, 3);
  host("start_x", -100, 100);
  host("start_y", -100, 100);
  host("start_z", 10, 100);
  for (const auto& [name, value] : hosts_)
    out.hosts[name] = value;
  // A check that compares two variables mostly wants them near each other, one with a place near the start.
  constexpr std::uint32_t kInVain = 4;
  for (const verify::ProgramVariable& variable : variables_) {
    const std::uint32_t attempt = triesOf(0) + triesOf(variable.number);
    if (attempt < kInVain || options_.replay || fixed_.contains(variable.number)) continue;
    verify::Random random(verify::Random::sub(verify::Random::sub(first, attempt), variable.number));
    for (const std::uint32_t other : variable.comparedTo) {
      const auto near = out.values.find(std::to_string(other));
      if (other == variable.number || near == out.values.end() || !random.chance(0.3)) continue;
      const bool whole = variable.use >= verify::VariableUse::Whole;
      const double beside = random.between(-10, 10);
      out.values[std::to_string(variable.number)] =
          whole ? std::round(near->second + beside) : toStep(near->second + beside);
    }
    if (variable.use != verify::VariableUse::Length || !variable.constants.empty() || !random.chance(0.3))
      continue;
    const char* const axis[] = {"start_x", "start_y", "start_z"};
    out.values[std::to_string(variable.number)] =
        toStep(out.hosts[axis[random.below(3)]] + random.between(-30, 30));
  }
  out.callers = index < kCallerCases || options_.replay;
  out.system = 54 + static_cast<std::uint32_t>(randomOf("system").below(6));
  if (options_.activeSystem) out.system = *options_.activeSystem;
  if (options_.partError) {
    const auto& [x, y, z, turn] = *options_.partError;
    out.error = {{x, y, z}, turn};
  }
  return out;
}

// Values that reject the program from what cannot be run here would hide it.
bool ProgramRunner::otherValuesMayDo(const verify::Record& record) const {
  return record.ending == verify::Ending::Inconclusive ? record.overLimit : !lacksProgram(record);
}

bool ProgramRunner::lacksProgram(const verify::Record& record) const {
  const stdlib::AlarmInfo* const missing = sourceControl_->find(stdlib::Alarm::NoSuchProgram);
  return record.ending == verify::Ending::Alarm && missing != nullptr && record.alarm == missing->number;
}

// Variables that are drawn and that the check reads which ended the run; empty: no check of the program did.
std::set<std::uint32_t> ProgramRunner::rejectedBy(const verify::Record& record) const {
  std::set<std::uint32_t> out;
  if (record.ending != verify::Ending::Alarm || !inSource(record.endedAt).hasPlace()) return out;
  const std::set<verify::VariableKey> read = flow_->readByCheck(record.endedAt);
  for (const verify::ProgramVariable& variable : variables_)
    if (!fixed_.contains(variable.number) && read.contains(flow_->key(0, variable.number)))
      out.insert(variable.number);
  return out;
}

// What a check rejects is drawn anew, and nothing else: so several checks are met one after the other.
std::optional<verify::Case> ProgramRunner::draw(std::uint64_t index) {
  std::uint32_t endless = 0;                         // they take long
  std::map<std::uint32_t, std::uint32_t> rejections; // by the place of the check
  Tries tries;
  for (std::uint32_t free = 0, checked = 0; free < kAttempts && checked < kChecked && endless < kEndless;) {
    drawn_ = play(propose(index, tries), !options_.partError);
    if (drawn_->record.overLimit) ++endless;
    if (drawn_->why.empty() || options_.replay || !otherValuesMayDo(drawn_->record)) break;
    // It decides nothing; a difference shows all the same.
    if (!drawn_->record.overLimit && !differences(*drawn_, runTarget(*drawn_)).empty()) break;
    const std::set<std::uint32_t> read = rejectedBy(drawn_->record);
    if (read.empty()) {
      ++free;
      ++tries[0];
      continue;
    }
    drawn_->rejected = ++rejections[drawn_->whyAt.begin];
    drawn_->remedy.clear();
    // One of them after the other, so that what another check has taken stays.
    ++tries[*std::next(read.begin(), static_cast<std::ptrdiff_t>(checked++ % read.size()))];
    for (const std::uint32_t number : read) {
      drawn_->remedy += fmt::format("{}`--var {}=VALUE`", drawn_->remedy.empty() ? "" : ", ", number);
    }
  }
  return drawn_->drawn; // the last one, whatever it comes to
}

verify::Case ProgramRunner::edge(std::uint64_t index) {
  verify::Case out = propose(~index, {});
  std::vector<const verify::ProgramVariable*> free;
  for (const verify::ProgramVariable& variable : variables_)
    if (!fixed_.contains(variable.number)) free.push_back(&variable);
  if (!free.empty()) {
    const verify::ProgramVariable& variable = *free[index % free.size()];
    const std::string name = std::to_string(variable.number);
    out.values.erase(name);
    if (const auto value = verify::edgeValue(variable, index / free.size())) out.values[name] = *value;
  }
  out.edge = true;
  drawn_ = play(std::move(out), true);
  return drawn_->drawn;
}

verify::Record ProgramRunner::runSide(const Side& side, const verify::Case& drawn, sim::World& world,
                                      verify::Stand::Way way, const Beside& beside) const {
  verify::Entry entry = entryFor(drawn, assumesProbe());
  if (beside.mode != nullptr) {
    const bool target = side.code == &translation_.code();
    const verify::ModeInForce::Side& mode = target ? beside.mode->target : beside.mode->source;
    entry.blocks = mode.blocks;
    entry.modal = mode.modal;
  }
  for (const auto& [name, value] : drawn.values)
    entry.variables.emplace_back(static_cast<std::uint32_t>(std::stoul(name)), value);
  // Most programs of one's own look for a surface beyond the place where it is expected.
  entry.contactShare =
      verify::Random(verify::Random::sub(drawn.stream, verify::Random::hash("contact"))).between(0.5, 0.95);
  std::optional<sim::VendorMacros> meaning;
  if (side.set != nullptr) {
    meaning.emplace(*side.set, *side.control, measuring_);
    meaning->setStylusRadius(drawn.hosts.at("tool_radius"));
    if (sameMacros(sourceSet_, targetSet_)) meaning->passUnstated();
  }
  // What the programs switch off is on before, on both sides.
  verify::Random random(callerStream(drawn));
  const bool left = random.chance(0.5), mist = random.chance(0.5);
  if (stopsSpindle_) entry.spindle = left ? 2 : 1;
  if (stopsCoolant_) entry.coolant = mist ? sim::Machine::Coolant::Mist : sim::Machine::Coolant::Flood;
  verify::Record record =
      side.stand->run(*side.code, world, entry, stores_, meaning ? &*meaning : nullptr, way, beside.by);
  // What macros do inside is their own business.
  std::erase_if(record.early, [&](const verify::EarlyUse& use) {
    return side.code == &translation_.code() ? translation_.line(use.range) == 0 : use.range.file != file_;
  });
  return record;
}

// The source's side: a rehearsal says what is measured, the part is made for that, then it runs.
std::unique_ptr<ProgramRunner::Played> ProgramRunner::play(verify::Case drawn, bool drawError) {
  auto out = std::make_unique<Played>();
  out->drawn = std::move(drawn);
  const sim::Probe probe = probeFor(plan_, out->drawn);
  const sim::Point3 zero = entryFor(out->drawn, false).zeros[out->drawn.system - 54];
  const Side source = sourceSide();
  if (plan_.part) {
    out->part = plan_.part;
  } else {
    sim::World nothing(emptyPart(zero), probe);
    verify::Record rehearsal = runSide(source, out->drawn, nothing, verify::Stand::Way::Rehearse);
    if (drawError) {
      verify::Random random(verify::Random::sub(out->drawn.stream, verify::Random::hash("part")));
      out->drawn.error = verify::drawError(rehearsal, probe.ballRadius(), random);
    }
    const std::vector<verify::Touch> touches = verify::touchesOf(rehearsal, probe.ballRadius());
    out->part =
        verify::partOf(touches, probe.ballRadius(), std::max(probe.ballRadius(), kReach), out->drawn.error);
    if (!out->part) out->part = emptyPart(zero);
    // Nothing to meet: the run would be the same.
    if ((rehearsal.measures.empty() && !plan_.machine) || rehearsal.overLimit) {
      out->record = std::move(rehearsal);
      out->rehearsed = true;
    }
  }
  if (!out->rehearsed) {
    sim::World world(*out->part, probe, limits());
    out->record = runSide(source, out->drawn, world, verify::Stand::Way::Run);
  }
  const verify::Record& record = out->record;
  const bool measures = !record.measures.empty();
  if (measures || record.ending != verify::Ending::Finished || !record.events.empty())
    out->why = verify::whyNoEvidence(record, out->whyAt);
  if (lacksProgram(record))
    out->why +=
        "; it calls a program that the file does not hold, and `verify` runs what one file holds: put a "
        "copy of that program at its end";
  out->whyAt = record.overLimit ? SourceRange{} : inSource(out->whyAt);
  return out;
}

verify::Record ProgramRunner::runTarget(const Played& played) const {
  sim::World world(*played.part, probeFor(plan_, played.drawn), limits());
  return runSide(targetSide(), played.drawn, world,
                 played.rehearsed ? verify::Stand::Way::Rehearse : verify::Stand::Way::Run);
}

verify::CompareRules ProgramRunner::rules() const {
  verify::CompareRules out;
  const bool otherArithmetic = sourceControl_->arithmetic != targetControl_->arithmetic;
  out.tolerance = std::max(options_.tolerance, otherArithmetic ? kOtherArithmetic : 0);
  out.results = std::max(out.tolerance,
                         sourceSet_ != targetSet_ ? resultTolerance(*sourceControl_, *targetControl_) : 0);
  out.relative = otherArithmetic ? kEightDigits : 0;
  out.sameProgram = true;
  out.sourceControl = &*sourceControl_;
  out.targetControl = &*targetControl_;
  if (sourceControl_->name == targetControl_->name) out.targetControl = out.sourceControl;
  const stdlib::CodeInfo* const wait = targetControl_->find(stdlib::Function::MachineCoordinates);
  out.waits = wait != nullptr && wait->grade != "assumed";
  out.sameAlarmNumbers = sameMacros(sourceSet_, targetSet_);
  out.toolParts = sourceSet_ == targetSet_ && sourceControl_->variables.toolGeometry.has_value() ==
                                                  targetControl_->variables.toolGeometry.has_value();
  out.samePlace = [this](SourceRange one, SourceRange other) {
    return plan_.translation->stemsFrom(inSource(one), translation_.line(other), session_.sources());
  };
  return out;
}

std::vector<verify::Difference> ProgramRunner::differences(const Played& played,
                                                           const verify::Record& target) {
  const verify::CompareRules loose = rules();
  std::vector<verify::Difference> out = verify::compare(played.record, target, loose);
  if (out.empty())
    if (std::optional<verify::Difference> one = compareReturn(played.record, target))
      return {std::move(*one)};
  if (out.empty() || !sourceAsTarget_) return out;
  // Whether the digits alone make the difference.
  sim::World world(*played.part, probeFor(plan_, played.drawn), limits());
  const verify::Record again =
      runSide(sourceAsTargetSide(), played.drawn, world,
              played.rehearsed ? verify::Stand::Way::Rehearse : verify::Stand::Way::Run);
  if (!verify::compare(again, target, loose).empty()) return out;
  for (verify::Difference& one : out)
    one.text += "; with the arithmetic of " + targetControl_->name + " the source does the same";
  return out;
}

CaseResult ProgramRunner::run(const verify::Case& drawn) {
  std::unique_ptr<Played> played = std::move(drawn_); // of draw()
  if (!played) played = play(drawn, false);
  CaseResult result;
  result.why = played->why;
  result.whyAt = played->whyAt;
  result.rejected = played->rejected;
  result.remedy = played->remedy;
  for (const verify::Measure& measure : played->record.measures)
    if (!measure.unstated.empty()) result.unstated.emplace_back(inSource(measure.range), measure.unstated);
  const verify::ProbeOff off = verify::probeOffIn(played->record);
  if (off.measuring) result.unarmed = inSource(*off.measuring);
  if (off.protectedMove) result.unprotected = inSource(*off.protectedMove);
  if (played->record.ending == verify::Ending::Inconclusive) {
    result.verdict = CaseVerdict::NoProgram;
    return result;
  }
  const verify::Record target = runTarget(*played);
  std::vector<verify::Difference> found = differences(*played, target);
  if (found.empty() && played->drawn.callers) found = compareBeside(*played, target);
  for (const verify::Difference& one : found) {
    CaseFinding finding;
    finding.aspect = one.aspect;
    finding.text = one.text;
    finding.subject = one.subject;
    finding.source = inSource(one.source);
    finding.targetLine = translation_.line(one.target);
    result.findings.push_back(std::move(finding));
  }
  result.verdict = !result.findings.empty() ? CaseVerdict::Differ
                   : result.why.empty()     ? CaseVerdict::Agrees
                                            : CaseVerdict::Undecided;
  return result;
}

VerifySides ProgramRunner::sides() const {
  return {controlText(*sourceControl_), controlText(*targetControl_), ""};
}

std::optional<CasePictures> ProgramRunner::pictures(const verify::Case& drawn) {
  const std::unique_ptr<Played> played = play(drawn, false);
  const sim::Probe probe = probeFor(plan_, drawn);
  sim::World world(*played->part, probe);
  const verify::Record record = runSide(sourceSide(), drawn, world, verify::Stand::Way::KeepMoves);
  ShownRun shown;
  shown.record = runSide(targetSide(), drawn, world, verify::Stand::Way::KeepMoves);
  return picturesOf(record, shown, *played->part, probe, !plan_.part && record.measures.empty());
}

} // namespace dotek::targets
