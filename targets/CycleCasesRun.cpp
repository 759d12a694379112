// One case: both sides run, and what they did is compared.
#include "support/Decimal.h"
#include "support/messages/Verify.h"
#include "targets/BesideBounds.h"
#include "targets/CycleCasesParts.h"
#include "targets/Stage.h"
#include "targets/Target.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::targets {

namespace compost = frontend::compost;

namespace {

constexpr double kNear = 0.01; // beside what a corrected path measures, mm

} // namespace

TargetRun CaseRunner::runTarget(const Values& values, sim::World& world, bool probeOn,
                                const verify::Record* source, ShownRun* shown, bool asks) {
  const verify::Entry entry = entryOf(values, probeOn);
  const std::set<std::uint32_t> none;
  TargetCase now{.drawn = values.drawn,
                 .entry = entry,
                 .stores = values.posted ? values.posted->stores : none,
                 .world = world,
                 .source = source,
                 .stream = callerStream(values.drawn)};
  if (routine_ == nullptr && values.path) now.path = &*values.path;
  now.shown = shown;
  now.rejected = values.rejected;
  now.rejection = values.rejection;
  now.losesDigits = values.losesDigits || values.rests;
  now.rounding = values.rounding;
  now.inItsDatums = [&] { return runPosted(values, world, probeOn, verify::Stand::Way::MovePath); };
  now.sourceOf = [&](SourceRange posted) { return sourceOf(posted, values); };
  now.lines = values.lines;
  if (values.posted) now.posted = &values.posted->file.programs.front();
  Questions questions(*this, values, world, probeOn);
  // A replay shows the difference that it was written for: where the path and the post differ already, what
  // other callers get is none of it.
  CaseResult known;
  if (options_.replay) comparePath(known, values, source);
  if (asks && values.drawn.callers && known.findings.empty()) now.questions = &questions;
  return target_->run(now);
}

void CaseRunner::askConversion(std::uint64_t index) {
  constexpr std::uint32_t kAsked = 200, kEnough = 3;
  if (target_ == nullptr || !findTarget(options_.to)->fixesValues || options_.translation) return;
  std::uint32_t refused = 0;
  std::string why;
  for (std::uint32_t tries = 0; tries < kAsked && refused < kEnough; ++tries) {
    const std::unique_ptr<Values> values = check(draws_->propose(index, tries), false);
    if (!values || values->rejected) continue;
    const sim::Part empty = emptyPart(zeroOf(values->drawn));
    sim::World nothing(empty, probeFor(plan_, values->drawn));
    const TargetRun run = runTarget(*values, nothing, false, nullptr, nullptr);
    // Not of these values alone: for others it is the same.
    if (!run.refused || (refused > 0 && run.why != why)) return;
    ++refused;
    why = run.why;
  }
  if (refused == kEnough) rejected_[{why, 0}] = {refused, why, {}, true};
}

SourceRange CaseRunner::progPlace(SourceRange posted, const std::vector<compost::PostedLine>& lines) {
  if (!posted.hasPlace() || lines.empty()) return {};
  // The text was "O1", then a posted line each.
  std::uint32_t at = 3;
  for (const compost::PostedLine& line : lines) {
    const std::uint32_t end = at + static_cast<std::uint32_t>(line.text.size()) + 1;
    if (posted.begin < end) return posted.begin < at ? SourceRange{} : line.range;
    at = end;
  }
  return {};
}

// Where each datum moves the path that follows: the path also fits the part with some axes at their place.
std::string CaseRunner::whyNotCorrected(const Values& values, const sim::Part& nominal, double off) const {
  const std::vector<verify::Touch> touches = values.path->nominal();
  for (unsigned axes = 0; axes < 7; ++axes) {
    verify::PartError error = values.drawn.error;
    error.shift.x *= axes & 1;
    error.shift.y *= axes >> 1 & 1;
    error.shift.z *= axes >> 2 & 1;
    const sim::Part part = verify::withError(nominal, touches, error);
    std::string why =
        verify::whyNotReached(*values.path, part, probeFor(plan_, values.drawn), off, off + kNear);
    if (!why.empty()) return why;
  }
  return "";
}

SourceRange CaseRunner::sourceOf(SourceRange posted, const Values& values) const {
  return progPlace(posted, values.lines);
}

CaseRunner::Performed CaseRunner::perform(const verify::Case& values, sim::World& world,
                                          const verify::Entry& entry, const std::set<std::uint32_t>& stores,
                                          verify::Stand::Way way) {
  Performed out;
  const std::unique_ptr<Values> now = check(values, false);
  if (!now) {
    out.text = stopped_ ? stopped_->why.message : refusal_;
    return out;
  }
  if (now->rejected) {
    out.rejected = true;
    out.text = now->rejection;
    return out;
  }
  if (!readPosted(*now)) {
    out.text = refusal_;
    return out;
  }
  now->posted->stores.insert(stores.begin(), stores.end());
  out.record = runPosted(*now, world, entry, way);
  std::erase_if(out.record->stores, [&](const auto& one) { return !stores.contains(one.first); });
  out.lines = now->lines;
  return out;
}

std::vector<verify::Difference> CaseRunner::drawnBeside(const verify::Case& values,
                                                        const verify::Entry& entry, double tolerance) {
  const std::unique_ptr<Values> now = check(values, false);
  if (!now || now->rejected || !now->path || !readPosted(*now)) return {};
  const bool touches = makePart(*now);
  if (!touches) now->part = emptyPart(zeroOf(values));
  sim::World world(*now->part, probeFor(plan_, values));
  const auto beside = [&](verify::Stand::Way way) {
    return verify::compare(*now->path, {}, runPosted(*now, world, entry, way), tolerance);
  };
  // Where other surfaces are measured than it draws the program would not find them.
  std::vector<verify::Difference> out = beside(verify::Stand::Way::Rehearse);
  std::erase_if(out, [](const verify::Difference& one) { return one.aspect != verify::Aspect::Nominal; });
  if (!out.empty() || !touches) return out;
  return runPosted(*now, world, entry, verify::Stand::Way::Run).ending == verify::Ending::Finished
             ? beside(verify::Stand::Way::Run)
             : out;
}

void CaseRunner::addFinding(CaseResult& result, const verify::Difference& difference,
                            const Values& values) const {
  CaseFinding finding;
  finding.pair = CaseFinding::Pair::PathAndPost;
  finding.aspect = difference.aspect;
  finding.text = difference.text;
  finding.subject = difference.subject;
  finding.source = difference.source;
  finding.posted = sourceOf(difference.target, values);
  result.findings.push_back(std::move(finding));
}

CaseResult CaseRunner::run(const verify::Case& drawn) {
  CaseResult result = runOne(drawn);
  result.alarms = met_;
  if (target_ != nullptr) // a path raises none
    for (const auto& [place, alarm] : std::exchange(branchAlarms_, {}))
      result.printed.push_back(alarm);
  if (!result.ofValues) met_.clear(); // else another one is drawn in its place, which takes them over
  return result;
}

void CaseRunner::noteAlarm(const verify::Record& source, const Values& values) {
  if (source.ending == verify::Ending::Alarm && source.alarmKind.empty())
    met_.push_back(sourceOf(source.endedAt, values));
}

CaseResult CaseRunner::runOne(const verify::Case& drawn) {
  CaseResult result;
  const bool probeOn = options_.common.assume.contains("probe-on");
  std::unique_ptr<Values> values = std::move(drawn_); // of draw()
  if (!values) values = check(drawn, false);
  if (!values) {
    result.verdict = CaseVerdict::NoProgram;
    result.why = refusal_;
    return result;
  }
  const bool stated =
      !values->part && values->path && routine_ != nullptr && !values->rejected && takeStatedPart(*values);
  if (!stated && !values->part && values->path && makePart(*values))
    misplace(*values);
  else if (!values->part)
    values->part = plan_.part;
  result.partMade = values->path && !values->path->touches.empty();
  if (!values->part) values->part = emptyPart(zeroOf(drawn));
  sim::World world(*values->part, probeFor(plan_, drawn)); // its zeros are drawn: no travel holds for them

  if (routine_ == nullptr) {
    result.why = "measurement not stated by the source";
    TargetRun ran = runTarget(*values, world, true, nullptr);
    noteStopped(ran, drawn);
    takeRun(result, std::move(ran), *values, nullptr);
    result.verdict = result.findings.empty() ? CaseVerdict::Undecided : CaseVerdict::Differ;
    return result;
  }
  std::optional<verify::Record> source;
  if (values->rejected) {
    source.emplace();
    source->ending = verify::Ending::Alarm;
    source->text = values->rejection;
  } else {
    if (!values->posted && !readPosted(*values)) {
      result.verdict = CaseVerdict::NoProgram;
      result.why = refusal_;
      return result;
    }
    if (drawn.edge && values->losesDigits) {
      result.verdict = CaseVerdict::NoProgram;
      result.why = "the post prints fewer digits than these values have";
      return result;
    }
    source = runPosted(*values, world, probeOn, verify::Stand::Way::Run);
    noteAlarm(*source, *values);
    // Of a case that was drawn before: what it measures is compared with the path again.
    if (!drawn.edge && values->path && !values->rehearsal && !whyNotMeasured(*values).empty())
      values->rehearsal.reset();
  }
  SourceRange at;
  result.why = verify::whyNoEvidence(*source, at);
  result.whyAt = values->rejected ? values->rejectedAt : sourceOf(at, *values);
  noteProbe(result, *source, *values);
  for (const verify::Measure& measure : source->measures)
    if (!measure.unstated.empty())
      result.unstated.emplace_back(sourceOf(measure.range, *values), measure.unstated);
  for (const verify::Deed& deed : source->deeds)
    if (deed.kind == verify::Deed::Kind::Subprogram)
      result.absent.emplace_back(sourceOf(deed.range, *values), static_cast<std::uint32_t>(deed.value));
  const bool ofValues = !drawn.edge && !values->rejected && !result.why.empty() && !result.unarmed &&
                        (source->ending == verify::Ending::Alarm || !source->measures.empty());
  if (source->ending == verify::Ending::Inconclusive) {
    result.verdict = CaseVerdict::NoProgram;
    result.ofValues = source->ofValue && !drawn.edge;
    return result;
  }
  if (target_ != nullptr) {
    // Where another case will be drawn in its place, the first one asks for all of them.
    const bool asks = !ofValues || others_ == 0;
    TargetRun ran = runTarget(*values, world, probeOn, values->rejected ? nullptr : &*source, nullptr, asks);
    noteStopped(ran, drawn);
    if (stopped_) return result;
    if (ran.refused && !values->rejected) {
      result.verdict = CaseVerdict::Refused;
      result.why = "the translation refuses the values: " + ran.why;
      result.whyAt = {};
      result.trace = std::move(ran.trace);
      return result;
    }
    if (ran.undecided) {
      result.verdict = CaseVerdict::NoProgram;
      result.ofValues = ofValues || (ran.ofValues && !drawn.edge);
      result.trace = std::move(ran.trace);
      if (ran.why.empty()) return result;
      result.why = std::move(ran.why);
      result.whyAt = {};
      return result;
    }
    if (!ran.differences.empty() && !values->rejected && meetsLimit(*values, probeOn)) {
      result.verdict = CaseVerdict::NoProgram;
      result.ofValues = !drawn.edge;
      result.trace = std::move(ran.trace);
      result.why = "the source compares what it measures with a limit that is met to the last digit";
      result.whyAt = {};
      return result;
    }
    takeRun(result, std::move(ran), *values, &*source);
    if (drawn.callers && !values->rejected && result.findings.empty() && result.why.empty()) {
      runAtBounds(drawn, result);
      if (result.findings.empty() && target_->takesTies()) runAtLimits(*values, probeOn, result);
    }
  } else if (values->path && !values->rejected) {
    for (const verify::Difference& difference :
         verify::compare(*values->path, {}, *source, pathTolerance(*values)))
      addFinding(result, difference, *values);
  }
  result.verdict = !result.findings.empty() ? CaseVerdict::Differ
                   : result.why.empty()     ? CaseVerdict::Agrees
                                            : CaseVerdict::Undecided;
  result.ofValues = ofValues && result.verdict == CaseVerdict::Undecided;
  return result;
}

// What the dialog rejects where one of its checks turns, the translation has to reject.
void CaseRunner::runAtBounds(const verify::Case& drawn, CaseResult& result) {
  runBesideBounds(
      plan_, drawn, result,
      [&](const verify::Case& beside) {
        const std::unique_ptr<Values> values = check(beside, false);
        if (stopped_) return false;
        if (!values || !values->rejected) return true;
        values->part = emptyPart(zeroOf(beside));
        sim::World world(*values->part, probeFor(plan_, beside));
        TargetRun ran = runTarget(*values, world, false, nullptr);
        if (!ran.refused && !ran.undecided && ran.stopped.empty())
          takeRun(result, std::move(ran), *values, nullptr);
        return true;
      },
      [&](verify::Case beside, const verify::Bound& bound) {
        if (!atBounds_.emplace(bound.comparison, bound.field).second) return true; // in another case
        beside.edge = true;
        CaseResult other = runOne(beside);
        if (other.verdict == CaseVerdict::Differ) result.findings = std::move(other.findings);
        return !stopped_;
      });
}

void CaseRunner::noteStopped(const TargetRun& ran, const verify::Case& drawn) {
  if (!ran.stopped.empty())
    stopped_ = {makeDiagnostic<diag::TranslationStopped>({}, plan_.translation->name, ran.stopped), drawn};
}

void CaseRunner::takeRun(CaseResult& result, TargetRun ran, const Values& values,
                         const verify::Record* source) const {
  result.trace = std::move(ran.trace);
  if (values.rejected && !ran.refused && ran.differences.empty()) {
    CaseFinding finding;
    finding.aspect = verify::Aspect::Ending;
    finding.text = "the dialog rejects the values, and the translation takes them";
    finding.source = values.rejectedAt;
    result.findings.push_back(std::move(finding));
  }
  for (TargetDifference& one : ran.differences) {
    CaseFinding finding;
    if (routine_ == nullptr) finding.pair = CaseFinding::Pair::PathAndTranslation;
    finding.aspect = one.difference.aspect;
    finding.subject = one.difference.subject;
    finding.text = one.difference.text + (one.text.empty() ? "" : ", in `" + one.text + "`");
    // Without a Prog it is the place in the macro.
    finding.source = values.rejected       ? values.rejectedAt
                     : routine_ == nullptr ? one.difference.source
                                           : sourceOf(one.difference.source, values);
    finding.targetLine = one.line;
    result.findings.push_back(std::move(finding));
  }
  if (!values.rejected) comparePath(result, values, source);
}

double CaseRunner::pathTolerance(const Values& values) const {
  return std::max(options_.tolerance, values.rounding);
}

// The source sets the very system in which it goes on, which the case has put in force: its path moves by
// what it has found, and a rehearsal finds each surface at the end of its travel.
bool CaseRunner::movesItself(const Values& values) const {
  const std::string system = fmt::format("G{} ", values.drawn.system);
  const auto& writes = values.rehearsal->offsetWrites;
  const auto first = writes.lower_bound(system);
  return selects_ != true && first != writes.end() && first->first.starts_with(system);
}

namespace {

// A loop by WHILE, or by a jump back.
bool loops(const ir::Program& program) {
  std::set<ir::LabelId> passed;
  for (const ir::ProgramStatement& statement : program.body) {
    if (const auto* label = std::get_if<ir::Label>(&statement.node)) passed.insert(label->label);
    if (std::holds_alternative<ir::Loop>(statement.node)) return true;
    if (const auto* jump = std::get_if<ir::Jump>(&statement.node); jump && passed.contains(jump->target))
      return true;
    if (const auto* branch = std::get_if<ir::Branch>(&statement.node);
        branch && passed.contains(branch->target))
      return true;
  }
  return false;
}

// A place that it goes to is computed on the control: of what it has measured, perhaps.
bool computesPlaces(const ir::Program& program) {
  return std::any_of(program.body.begin(), program.body.end(), [](const ir::ProgramStatement& statement) {
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    return block != nullptr &&
           std::any_of(block->words.begin(), block->words.end(), [](const ir::Word& word) {
             return word.address >= 'X' && word.address <= 'Z' && ir::constantValue(word.value) == nullptr;
           });
  });
}

} // namespace

// What the path touches and what the source measures, whatever the translation is: nominal contacts alone. A
// rehearsal finds each surface at the end of its travel; a branch that measures until it has found one, or
// goes where it has found some, agrees with its path in the run on the part. `source`: that run; nullptr:
// there is none.
void CaseRunner::comparePath(CaseResult& result, const Values& values, const verify::Record* source) const {
  if (!values.path || !values.rehearsal || movesItself(values)) return;
  constexpr double kComputed = 0.002; // mm, of the mean of two places that were read
  const ir::Program* const posted = values.posted ? &values.posted->file.programs.front() : nullptr;
  const double tolerance =
      std::max(pathTolerance(values), posted != nullptr && computesPlaces(*posted) ? kComputed : 0);
  const bool rounds = posted != nullptr && loops(*posted);
  const auto contacts = [&](const verify::Record& program) {
    std::vector<verify::Difference> out = verify::compare(*values.path, {}, program, tolerance, rounds);
    std::erase_if(out, [](const verify::Difference& one) { return one.aspect != verify::Aspect::Nominal; });
    return out;
  };
  const std::vector<verify::Difference> found = contacts(*values.rehearsal);
  // An alarm after all that the path touches has been measured says nothing of the path.
  if (!found.empty() && source != nullptr &&
      (source->ending == verify::Ending::Finished ||
       source->measures.size() >= values.path->touches.size()) &&
      contacts(*source).empty())
    return;
  for (const verify::Difference& difference : found)
    addFinding(result, difference, values);
}

void CaseRunner::noteProbe(CaseResult& result, const verify::Record& record, const Values& values) const {
  const verify::ProbeOff off = verify::probeOffIn(record);
  if (off.measuring) result.unarmed = sourceOf(*off.measuring, values);
  if (!off.protectedMove) return;
  result.unprotected = sourceOf(*off.protectedMove, values);
  result.spindleLater = values.spindleOff && off.protectedMove->begin < values.spindleOff->begin;
}

std::vector<std::pair<std::string, SourceRange>> CaseRunner::droppedDigits(const verify::Case& drawn) {
  std::vector<std::pair<std::string, SourceRange>> out;
  const auto lost = [&](const verify::Case& one) {
    std::vector<SourceRange> places;
    const std::unique_ptr<Values> values = check(one, false);
    if (!values || values->rejected) return places;
    post(*values);
    for (const Diagnostic& told : session_.diagnostics().all())
      if (told.code == "lost-decimals") places.push_back(told.range);
    return places;
  };
  const std::vector<SourceRange> always = lost(drawn);
  for (const verify::DrawField& field : plan_.fields) {
    if (field.fixed || field.kind == ir::Kind::WorkOffset) continue;
    verify::Case finer = drawn;
    const auto value = finer.values.find(field.name);
    if (value == finer.values.end()) continue;
    // Within the last place, towards the value's own side, so that no check rejects it.
    value->second += (value->second < 0 ? -0.4 : 0.4) * std::pow(10.0, -field.decimals);
    for (const SourceRange& place : lost(finer))
      if (std::find(always.begin(), always.end(), place) == always.end()) out.emplace_back(field.name, place);
  }
  return out;
}

VerifySides CaseRunner::sides() const {
  VerifySides out;
  if (inputs_->sourceControl) out.sourceControl = controlText(*inputs_->sourceControl);
  if (inputs_->program && inputs_->form) out.form = inputs_->form->name;
  const Target* const target = findTarget(options_.to);
  if (target == nullptr) return out;
  if (target->ownControls)
    out.targetControl = options_.control;
  else if (inputs_->control)
    out.targetControl = controlText(*inputs_->control);
  return out;
}

std::optional<CasePictures> CaseRunner::pictures(const verify::Case& drawn) {
  if (routine_ == nullptr) return std::nullopt;
  const std::unique_ptr<Values> values = check(drawn, false);
  if (!values || values->rejected) return std::nullopt;
  if (values->path && makePart(*values))
    misplace(*values);
  else
    values->part = plan_.part;
  const bool empty = !values->part;
  if (empty) values->part = emptyPart(zeroOf(drawn));
  if (!readPosted(*values)) return std::nullopt;
  const sim::Probe probe = probeFor(plan_, drawn);
  sim::World world(*values->part, probe);
  const bool probeOn = options_.common.assume.contains("probe-on");
  const verify::Record source = runPosted(*values, world, probeOn, verify::Stand::Way::KeepMoves);
  ShownRun shown;
  if (target_ != nullptr) runTarget(*values, world, probeOn, &source, &shown);
  return picturesOf(source, shown, *values->part, probe, empty);
}

} // namespace dotek::targets
