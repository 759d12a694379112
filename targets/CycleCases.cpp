#include "project/MacroCycles.h"
#include "targets/CycleCasesParts.h"

#include "frontend/compost/Summary.h"
#include "frontend/gibbs/Run.h"
#include "ir/Program.h"
#include "ir/Walk.h"
#include "project/CycleChecks.h"
#include "project/Prog.h"
#include "project/Programs.h"
#include "project/Values.h"
#include "project/VariableFlags.h"
#include "sim/machine/Compile.h"
#include "sim/machine/Value.h"
#include "sim/vendor/VendorMacros.h"
#include "stdlib/HostInputs.h"
#include "support/messages/ComPost.h"
#include "support/messages/Commands.h"
#include "support/messages/Gibbs.h"
#include "support/messages/Verify.h"
#include "targets/CycleFields.h"
#include "targets/DialogChoices.h"
#include "targets/NominalFields.h"
#include "targets/ReadBack.h"
#include "targets/SelectedSystems.h"
#include "targets/Stage.h"
#include "targets/Target.h"
#include "targets/Verification.h"
#include "verify/Bounds.h"
#include "verify/PathPieces.h"
#include "verify/Rehearsal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::targets {

namespace compost = frontend::compost;
namespace gibbs = frontend::gibbs;

namespace {

bool movesAxes(const ir::ProgramStatement& statement) {
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  return block != nullptr && std::any_of(block->words.begin(), block->words.end(), [](const ir::Word& word) {
           return word.address >= 'X' && word.address <= 'Z';
         });
}

// Variables of the control that the program writes by number; of a number that is computed from a constant
// those near it, which none of the sets works in.
std::set<std::uint32_t> storesOf(const std::vector<ir::Program>& programs,
                                 const std::vector<const stdlib::MacroSet*>& sets) {
  constexpr std::uint32_t kFirst = 100, kEnd = 1000, kBelow = 10, kAbove = 40;
  std::set<std::uint32_t> out;
  const auto near = [&](std::uint32_t base) {
    for (std::uint32_t number = std::max(kFirst, base - kBelow); number < std::min(kEnd, base + kAbove);
         ++number)
      if (std::none_of(sets.begin(), sets.end(), [&](const stdlib::MacroSet* set) {
            return set != nullptr && verify::usesVariable(*set, number);
          }))
        out.insert(number);
  };
  for (const ir::Program& program : programs) {
    for (const ir::ProgramStatement& statement : program.body) {
      const auto* store = std::get_if<ir::Store>(&statement.node);
      const double* number = store != nullptr && store->number ? ir::constantValue(store->number) : nullptr;
      if (number != nullptr && *number >= kFirst && *number < kEnd)
        out.insert(static_cast<std::uint32_t>(*number));
      else if (const auto base = store != nullptr && store->number && number == nullptr
                                     ? ir::firstNumber(store->number)
                                     : std::nullopt;
               base && *base >= kFirst && *base < kEnd)
        near(*base);
    }
  }
  return out;
}

} // namespace

CaseRunner::CaseRunner(const VerifyOptions& options, const VerifyPlan& plan)
    : options_(options), plan_(plan), session_(options.common), compilation_(session_) {}

CaseRunner::~CaseRunner() = default;

bool CaseRunner::load() {
  const Target* target = findTarget(options_.to);
  const bool first = options_.control.empty() || (target != nullptr && target->ownControls);
  inputs_ = compilation_.load(options_.source, first ? std::string(kDefaultControl) : options_.control);
  if (inputs_ != nullptr) inputs_->oneOfSeveral = options_.oneOfSeveral; // of `convert`, which reports them
  if (inputs_ == nullptr) return false;
  folder_ = &compilation_.addFolder(options_.inputs.front());
  if (options_.source.cycle) folder_->name = *options_.source.cycle;
  if (target != nullptr && target->fixesValues && !session_.diagnostics().hasErrors())
    if (const JobOperation* operation = operationOf(*folder_, *inputs_, session_))
      takeOperation(*operation, options_.common, *inputs_);
  return !session_.diagnostics().hasErrors();
}

bool CaseRunner::prepare() {
  std::vector<std::string> printed;
  if (inputs_->program) {
    routine_ =
        chooseRoutine(*inputs_->program, inputs_->routine, inputs_->routineAt, folder_->name, session_);
    if (routine_ == nullptr) return false;
    for (const compost::FieldRef& field : compost::fieldsPrinted(*inputs_->program, *routine_, folder_->name))
      printed.push_back(field.name);
  }
  if (!knowsValues()) return false;
  fields_.emplace(*folder_, std::move(printed), session_);
  for (const auto& [name, value] : inputs_->sets)
    if (!fields_->set(name, value, {}))
      session_.diagnostics().report<diag::NoSuchField>(SourceRange{}, name, folder_->name,
                                                       fields_->hint(name));
  if (session_.diagnostics().hasErrors()) return false;
  std::set<std::string> used;
  if (!fields_->mapGiven(inputs_->oneOfSeveral, used)) return false;
  std::vector<std::string> hosts;
  for (const stdlib::HostInput& host : stdlib::kHostInputs)
    if (!host.ofCyclesAlone) hosts.emplace_back(host.name);
  std::vector<verify::DrawField> near = plan_.fields, wide = plan_.fields;
  for (std::size_t i = 0; i < near.size(); ++i)
    if (std::erase(near[i].thresholds, kBeyondMeasured) > 0) {
      wide[i].thresholds = {kBeyondMeasured};
      wide[i].initial.reset(); // it led to nothing
    }
  wide_.emplace(std::move(wide), hosts, plan_.fixedHosts, options_.seed, plan_.bounds, options_.cases);
  draws_.emplace(std::move(near), std::move(hosts), plan_.fixedHosts, options_.seed, plan_.bounds,
                 options_.cases);
  sourceSet_ = session_.macroSet(plan_.sourceMacros, &*inputs_->sourceControl);
  measuring_ = project::measuringCycles({sourceSet_}, session_);
  if (sourceSet_ != nullptr)
    for (const auto intent : {stdlib::Intent::ProbeOn, stdlib::Intent::ProbeOff})
      if (const auto* signature = sourceSet_->find(intent)) switches_.insert(signature->program);
  variables_ = variablesOf(options_.variables, session_.diagnostics());
  if (session_.diagnostics().hasErrors()) return false;
  std::vector<const stdlib::MacroSet*> sets;
  if (sourceSet_ != nullptr) sets.push_back(sourceSet_);
  sourceStand_.emplace(*inputs_->sourceControl, sets, session_.limits());
  sourceStand_->passOverAbsent();
  if (!plan_.translation) return true;
  target_ = findTarget(options_.to)->verify({options_, plan_, session_, *inputs_, *folder_, compilation_});
  if (target_->needsNominal()) nominal_ = std::make_unique<NominalFields>(plan_.fields);
  return target_->prepare();
}

// To the last place that the post prints of them.
void CaseRunner::roundHosts(verify::Case& drawn) const {
  const auto round = [&](const std::string& name, int places) {
    const auto host = drawn.hosts.find(name);
    const double unit = std::pow(10.0, places);
    if (host != drawn.hosts.end() && !plan_.fixedHosts.contains(name))
      host->second = std::round(host->second * unit) / unit;
  };
  for (const auto& [name, places] : plan_.hostDecimals) {
    round(name, places);
    // One plane with the clearance, where the path goes there (clearOnRetract).
    if (target_ == nullptr && name == "clearance") round("retract", places);
  }
}

// Checks and path of a case. nullptr: the source cannot be run; refusal_ says why.
std::unique_ptr<CaseRunner::Values> CaseRunner::check(verify::Case drawn, bool settle) {
  if (stopped_) return nullptr;
  session_.diagnostics() = Diagnostics();
  auto out = std::unique_ptr<Values>(
      new Values{std::move(drawn), *fields_, {}, {}, false, "", {}, {}, {}, false, rests_, 0, nullptr, {}});
  for (const auto& [name, value] : out->drawn.values)
    out->fields.set(name, value, {});
  if (settle) roundHosts(out->drawn);
  startOnRetract(out->drawn);
  runCycleChecks(*folder_, out->fields, out->drawn.hosts, session_, project::Blame::Nothing);
  noteEndless(out->drawn);
  if (stopped_) return nullptr;
  for (const Diagnostic& one : session_.diagnostics().all()) {
    if (one.severity != Severity::Error) continue;
    out->rejected = true;
    out->rejection = one.message;
    for (const DiagnosticNote& note : one.notes) // a hint may come before what rejects them
      out->rejection += "; " + note.message;
    out->rejectedAt = one.range;
    return out;
  }
  if (out->rejection = whyNotOffered(plan_.fields, out->drawn); !out->rejection.empty()) {
    out->rejected = true;
    return out;
  }
  if (folder_->cycle->toolPath) {
    gibbs::RunContext context = project::runContext(*folder_, out->fields, out->drawn.hosts, session_);
    const auto path = gibbs::runToolPath(*folder_->cycle->toolPath, context);
    if (!path) {
      noteEndless(out->drawn);
      for (const Diagnostic& one : session_.diagnostics().all()) {
        if (one.code != diag::ReturnCodeSet::code && one.code != diag::ToolPathStopped::code) continue;
        out->rejected = true; // the macro draws no path for these values, as a dialog takes them not
        out->rejection = one.message;
        out->rejectedAt = one.range;
        return out;
      }
      refusal_ = session_.diagnostics().all().empty() ? "the path cannot be run"
                                                      : session_.diagnostics().all().front().message;
      return nullptr;
    }
    const auto drawPath = [&](const sim::Point3& zero) {
      const std::map<std::string, double>& hosts = out->drawn.hosts;
      const sim::Point3 start{hosts.at("start_x"), hosts.at("start_y"), hosts.at("start_z")};
      return verify::drawnPath(*path, start + zero, hosts.at("retract") + zero.z, hosts.at("tool_radius"));
    };
    if (settle) {
      const verify::DrawnPath settling = drawPath({});
      draws_->settleHosts(out->drawn, settling);
      roundHosts(out->drawn);
      startOnRetract(out->drawn);
      if (target_ == nullptr) clearOnRetract(out->drawn, settling);
    }
    out->path = drawPath(zeroOf(out->drawn));
  }
  return out;
}

// What the CAM would hang at is found once: each further case might take as long.
void CaseRunner::noteEndless(const verify::Case& drawn) {
  for (const Diagnostic& one : session_.diagnostics().all())
    if (one.code == diag::RunsForever::code || one.code == diag::PostRunsForever::code)
      stopped_ = {one, drawn};
}

// Those of --value; prepare() has seen that all are known.
void CaseRunner::takeValues(verify::Case& drawn) const {
  for (const auto& [name, text] : options_.values) {
    const std::string folded = gibbs::foldCase(name);
    const auto field =
        std::find_if(plan_.fields.begin(), plan_.fields.end(),
                     [&](const verify::DrawField& one) { return gibbs::foldCase(one.name) == folded; });
    const double value = parseNumber(text).value_or(0);
    if (field != plan_.fields.end())
      drawn.values[field->name] = value;
    else
      drawn.hosts[name] = value;
  }
}

bool CaseRunner::knowsValues() {
  for (const auto& [name, text] : options_.values) {
    const std::string folded = gibbs::foldCase(name);
    const bool field =
        std::any_of(plan_.fields.begin(), plan_.fields.end(),
                    [&](const verify::DrawField& one) { return gibbs::foldCase(one.name) == folded; });
    if (!parseNumber(text))
      session_.diagnostics().report<diag::NotANumber>({}, "--value", name, text);
    else if (!field && !stdlib::isHostInput(name))
      session_.diagnostics().report<diag::NoSuchField>(SourceRange{}, name, folder_->name, "");
  }
  return !session_.diagnostics().hasErrors();
}

// The work system and the tool offset that the posted program selects hold from its beginning: what is drawn
// is meant in them. Fields that set a work offset get another one than that (`others`), as far as the checks
// take one.
void CaseRunner::takeSelected(verify::Case& drawn, bool others) {
  if (routine_ == nullptr || selects_ == false) return;
  const auto selected = [&](const verify::Case& one) -> std::optional<Selected> {
    const std::unique_ptr<Values> values = check(one, false);
    if (!values || values->rejected || !readPosted(*values)) return std::nullopt;
    return selectedIn(values->posted->file.programs.front(), *inputs_->sourceControl, switches_);
  };
  const std::optional<Selected> found = selected(drawn);
  if (!found) return;
  selects_ = selects_.value_or(false) || found->system || found->toolOffset;
  if (found->toolOffset) drawn.toolOffset = *found->toolOffset;
  if (!found->system) return;
  drawn.system = *found->system;
  constexpr std::uint32_t kFirst = 54, kSystems = 6;
  for (const verify::DrawField& field : plan_.fields) {
    if (!others || field.kind != ir::Kind::WorkOffset || field.fixed) continue;
    if (field.systemOf(drawn.values.at(field.name)) != drawn.system) continue;
    for (std::uint32_t i = 0; i + 1 < kSystems; ++i) {
      verify::Case other = drawn;
      const auto beside = static_cast<std::uint32_t>(1 + (drawn.stream + i) % (kSystems - 1));
      other.values[field.name] = field.firstSystem + (drawn.system - kFirst + beside) % kSystems;
      const std::optional<Selected> again = selected(other);
      if (!again || again->system != drawn.system) continue;
      drawn = std::move(other);
      break;
    }
  }
}

// nullptr: the values are rejected; refusal_ says why.
std::unique_ptr<CaseRunner::Values> CaseRunner::attemptAsIs(const verify::Case& proposal) {
  refusal_.clear();
  refusedAt_ = {};
  verify::Case taken = proposal;
  takeSelected(taken, true);
  std::unique_ptr<Values> values = check(std::move(taken), true);
  if (!values) {
    unreadable_ = true;
    return nullptr;
  }
  if (values->rejected) {
    refusal_ = values->rejection;
    refusedAt_ = values->rejectedAt;
    return nullptr;
  }
  bool stated = false; // the part is that of what the calls state
  if (values->path) {
    refusal_ = verify::whyNoWay(*values->path);
    if (refusal_.empty()) refusal_ = whyNotClear(*values);
    if (!refusal_.empty()) return nullptr;
    stated = takeStatedPart(*values);
    if (stated) {
      // It is not walked: what the path shows is not known to be touched.
    } else if (makePart(*values)) {
      const sim::Part nominal = *values->part;
      misplace(*values);
      const double off =
          plan_.translation ? verify::mostOff(values->path->nominal(), values->drawn.error) : 0;
      refusal_ = verify::whyNotReached(*values->path, *values->part, probeFor(plan_, values->drawn), off);
      if (refusal_.empty() && target_ != nullptr && target_->datumsMovePath())
        refusal_ = whyNotCorrected(*values, nominal, off);
    } else if (plan_.part) {
      values->part = plan_.part;
    } else {
      refusal_ = "the path touches nothing";
    }
    if (!refusal_.empty()) return nullptr;
  }
  if (nominal_ != nullptr && !leadToNominal(values)) return nullptr;
  if (routine_ == nullptr) return values;
  if (!values->posted && !readPosted(*values)) return nullptr;
  if (target_ == nullptr && values->path) {
    refusal_ = whyAboveHome(*values);
    if (!refusal_.empty()) return nullptr;
  }
  drawVariables(*values);
  if (selects_ == false) {
    // Only some values make the post select something.
    const Selected found =
        selectedIn(values->posted->file.programs.front(), *inputs_->sourceControl, switches_);
    if (found.system || found.toolOffset) {
      selects_ = true;
      return attemptAsIs(proposal);
    }
  }
  if (values->path && !stated) refusal_ = whyNotMeasured(*values);
  return refusal_.empty() ? std::move(values) : nullptr;
}

namespace {

bool samePath(const verify::DrawnPath& a, const verify::DrawnPath& b) {
  return std::equal(
      a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
      [](const sim::Point3& one, const sim::Point3& other) { return verify::near(one, other, 1e-9); });
}

} // namespace

// Where start and travel have to lead to the nominal: changes what is nominal. Where the path moves with it,
// so does the part.
bool CaseRunner::leadToNominal(std::unique_ptr<Values>& values) {
  const auto misses = [&](const verify::Case& drawn) { return nominalMisses(drawn); };
  std::vector<const char*> starts;
  for (const char* start : {"start_x", "start_y"})
    if (!isGiven(start)) starts.push_back(start);
  const std::optional<verify::Case> settled = nominal_->settle(values->drawn, starts, misses);
  if (!settled) {
    refusal_ = "no field makes the start and the travel lead to the nominal";
    return false;
  }
  const std::unique_ptr<Values> before = std::move(values);
  values = check(*settled, false);
  if (!values) return false;
  refusal_ = values->rejection;
  if (values->rejected) return false;
  if (!values->path || !before->path || samePath(*values->path, *before->path)) {
    values->part = before->part;
    return true;
  }
  refusal_ = whyNotClear(*values);
  if (refusal_.empty() && makePart(*values)) {
    misplace(*values);
    const double off = plan_.translation ? verify::mostOff(values->path->nominal(), values->drawn.error) : 0;
    refusal_ = verify::whyNotReached(*values->path, *values->part, probeFor(plan_, values->drawn), off);
  } else {
    values->part = plan_.part;
  }
  return refusal_.empty();
}

// By how much each datum moves the zero away from that of the active system, where the part is in its place.
std::optional<std::vector<double>> CaseRunner::nominalMisses(const verify::Case& drawn) {
  const std::unique_ptr<Values> values = check(drawn, false);
  if (!values || values->rejected || !values->path || !makePart(*values) || !readPosted(*values))
    return std::nullopt;
  sim::World world(*values->part, probeFor(plan_, drawn));
  const verify::Record record = runPosted(*values, world, true, verify::Stand::Way::Run);
  std::vector<double> out;
  const sim::Point3 zero = zeroOf(drawn);
  const double active[] = {zero.x, zero.y, zero.z};
  for (const verify::Measure& measure : record.measures)
    for (const auto& [key, moved] : measure.datums)
      out.push_back(moved - active[key.second]);
  return out;
}

// A clearance that is given, or that the post prints with fewer digits, has to lie between the two highest
// levels of the path, as a drawn one does.
std::string CaseRunner::whyNotClear(const Values& values) const {
  const auto given = values.drawn.hosts.find("clearance");
  if (given == values.drawn.hosts.end() ||
      !(plan_.fixedHosts.contains("clearance") || plan_.hostDecimals.contains("clearance")))
    return "";
  constexpr double kSame = 1e-6;
  const std::vector<sim::Point3>& points = values.path->points;
  double highest = points[1].z;
  for (std::size_t i = 2; i < points.size(); ++i)
    highest = std::max(highest, points[i].z);
  const double clearance = given->second + zeroOf(values.drawn).z;
  if (clearance > highest + kSame) return "the clearance that is given lies above the path";
  bool below = false; // a level lies there
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].z >= highest - kSame) continue;
    below = true;
    if (points[i].z > clearance + kSame) return "the path goes on above the clearance that is given";
  }
  if (!below && clearance < highest - kSame) return "the whole path lies above the clearance that is given";
  return "";
}

// Of the touches that the path shows, at their nominal place.
bool CaseRunner::makePart(Values& values) const {
  const double radius = values.drawn.hosts.at("tool_radius");
  values.part = verify::partOf(values.path->nominal(), radius, std::max(radius, kReach), {});
  return values.part.has_value();
}

// The part of what the calls state, where the path shows more than that and a call is not stated. false: it
// is none of these.
bool CaseRunner::takeStatedPart(Values& values) {
  if (!passesUnstated() || !sourceSet_->hasUnstated() || (!values.posted && !readPosted(values)))
    return false;
  const sim::Part empty = emptyPart(zeroOf(values.drawn));
  sim::World nothing(empty, probeFor(plan_, values.drawn));
  verify::Record rehearsal = runPosted(values, nothing, true, verify::Stand::Way::Rehearse);
  bool unstated = false;
  std::size_t surfaces = 0;
  for (const verify::Measure& measure : rehearsal.measures) {
    unstated = unstated || (!measure.unstated.empty() && measure.nominal.empty());
    surfaces += measure.nominal.size();
  }
  if (!unstated || values.path->touches.size() <= surfaces) return false;
  const double radius = values.drawn.hosts.at("tool_radius");
  values.part = verify::partOf(verify::touchesOf(rehearsal, radius), radius, std::max(radius, kReach),
                               values.drawn.error);
  if (!values.part) values.part = empty;
  values.rehearsal = std::move(rehearsal);
  return true;
}

// Where a translation is looked at, the part is off its place.
void CaseRunner::misplace(Values& values) const {
  if (plan_.translation)
    values.part = verify::withError(*values.part, values.path->nominal(), values.drawn.error);
}

sim::Point3 CaseRunner::zeroOf(const verify::Case& drawn) const {
  return entryFor(drawn, false).zeros[drawn.system - 54];
}

// Host inputs as the path and the post's pictures have them.
verify::Case CaseRunner::settled(verify::Case drawn) {
  takeSelected(drawn, false);
  const std::unique_ptr<Values> values = check(drawn, true);
  return values ? values->drawn : drawn;
}

bool CaseRunner::post(Values& values) {
  compost::PostSettings settings{session_.sources(), *inputs_->form, session_.limits(),
                                 options_.common.assume};
  settings.printsRests = values.rests;
  compost::PostRun run(*inputs_->program, settings, session_.diagnostics());
  compost::Operation now;
  now.cycle = folder_->name;
  now.hosts = values.drawn.hosts;
  now.field = [&](const std::string& name, SourceRange where) { return values.fields.value(name, where); };
  run.run(*routine_, now);
  values.lines = run.finish();
  return !session_.diagnostics().hasErrors();
}

// Posts the case and reads what was posted. false: there is no such program; refusal_ says why.
bool CaseRunner::readPosted(Values& values) {
  if (!post(values)) {
    noteEndless(values.drawn);
    for (const Diagnostic& one : session_.diagnostics().all())
      if (one.severity == Severity::Error) refusal_ = one.message;
    return false;
  }
  std::string text = "O1\n";
  for (const compost::PostedLine& line : values.lines)
    text += line.text + "\n";
  text += "M30\n";
  values.losesDigits =
      std::any_of(session_.diagnostics().all().begin(), session_.diagnostics().all().end(),
                  [](const Diagnostic& one) { return one.code == diag::LostDecimals::code; });
  // No other values are drawn for these.
  if (values.losesDigits && !values.rests && (options_.replay || values.drawn.edge)) {
    values.rests = true;
    session_.diagnostics() = Diagnostics();
    return readPosted(values);
  }
  auto posted = std::make_unique<Posted>();
  Diagnostics found;
  auto file =
      readBack("posted", std::move(text), *inputs_->sourceControl, session_.limits(), posted->sources, found);
  if (!file) {
    refusal_ = firstError(found);
    return false;
  }
  posted->file = std::move(*file);
  const ir::Program& program = posted->file.programs.front();
  values.spindleOff = blockWith(program, *inputs_->sourceControl, stdlib::Function::SpindleOff);
  posted->stopsSpindle = values.spindleOff.has_value();
  posted->stopsCoolant =
      blockWith(program, *inputs_->sourceControl, stdlib::Function::CoolantOff).has_value();
  posted->stores = storesOf(
      posted->file.programs,
      {sourceSet_, session_.macroSet(plan_.targetMacros, inputs_->control ? &*inputs_->control : nullptr)});
  if (sourceSet_ == nullptr && plan_.findsMacros) findMacros(program);
  const bool others = plan_.sourceMacros != plan_.targetMacros;
  if (sourceSet_ != nullptr && others && halvesBetweenSteps(program)) values.losesDigits = true;
  values.rounding = roundingOf(program, others || target_ == nullptr);
  // What it asks of its caller before anything moves is no business of the cases.
  bool moves = false;
  for (const ir::ProgramStatement& statement : program.body) {
    moves = moves || std::holds_alternative<ir::Call>(statement.node) || movesAxes(statement);
    if (moves && std::holds_alternative<ir::Raise>(statement.node)) {
      const SourceRange at = sourceOf(statement.origin.range(), values);
      if (at.hasPlace()) branchAlarms_.try_emplace(at.begin, at);
    }
  }
  posted->code = sim::compile({&program}, *inputs_->sourceControl, posted->sources);
  posted->watching = sim::safeMoves({&program}, *inputs_->sourceControl);
  values.posted = std::move(posted);
  findReads(values);
  findLeftOver(values);
  return true;
}

// What both sides call alike need not be known.
bool CaseRunner::passesUnstated() const {
  return target_ != nullptr && !plan_.sourceMacros.empty() && plan_.sourceMacros == plan_.targetMacros;
}

verify::Record CaseRunner::runPosted(const Values& values, sim::World& world, bool probeOn,
                                     verify::Stand::Way way) const {
  return runPosted(values, world, entryOf(values, probeOn), way);
}

verify::Record CaseRunner::runPosted(const Values& values, sim::World& world, const verify::Entry& entry,
                                     verify::Stand::Way way, const verify::Interference& interference) const {
  std::optional<sim::VendorMacros> meaning;
  if (sourceSet_ != nullptr) {
    meaning.emplace(*sourceSet_, *inputs_->sourceControl, measuring_);
    meaning->setStylusRadius(values.drawn.hosts.at("tool_radius"));
    if (passesUnstated()) meaning->passUnstated();
    if (way == verify::Stand::Way::MovePath) meaning->touchApart();
  }
  sourceStand_->watchOnly(values.posted->watching);
  return sourceStand_->run(values.posted->code, world, entry, values.posted->stores,
                           meaning ? &*meaning : nullptr, way, interference);
}

// What the source measures, whatever the part: surfaces that the probe cannot get at by its own axes are out
// of reach. "" or why.
std::string CaseRunner::whyNotMeasured(Values& values) {
  sim::World nothing(*values.part, probeFor(plan_, values.drawn));
  values.rehearsal = runPosted(values, nothing, true, verify::Stand::Way::Rehearse);
  for (const verify::Measure& measure : values.rehearsal->measures) {
    if (measure.nominal.empty() && !measure.aim && measure.unstated.empty())
      return "a measure has no path to its surface";
    for (const verify::Touch& touch : measure.nominal)
      if (touch.direction.z > 0) return "a measure leads upward, where the stylus touches nothing";
  }
  return "";
}

} // namespace dotek::targets
