// One case: both sides run, and what they did is compared.
#include "driver/VerifyCaseParts.h"
#include "driver/VerifyTargets.h"
#include "frontend/gibbs/Ast.h"
#include "sim/machine/Value.h"
#include "sim/machine/VendorMacros.h"
#include "support/messages/Verify.h"

#include <algorithm>
#include <cmath>

namespace dotek::driver {

namespace compost = frontend::compost;
namespace gibbs = frontend::gibbs;

namespace {

// What the program leaves: zeros of the systems in coordinates of the machine, variables.
void traceResults(const verify::Record& record, sim::Trace& trace) {
  for (const auto& [key, value] : record.zeros) {
    trace.begin("zero").text(std::to_string(key.first));
    trace.word(std::string_view("XYZ").substr(key.second, 1), value).end();
  }
  for (const auto& [number, value] : record.stores) {
    trace.begin("variable").text(std::to_string(number));
    if (sim::isNull(value))
      trace.text("null").end();
    else
      trace.word("", value).end();
  }
}

} // namespace

verify::Record CaseRunner::runTranslation(const Values& values, sim::World& world, bool probeOn,
                                          std::string& trace) {
  verify::Entry entry = entryFor(plan_, values.drawn, probeOn);
  for (const OutputArgument& argument : plan_.translation->arguments) {
    const std::uint32_t local = stdlib::localOf(argument.letter);
    const std::string folded = gibbs::foldCase(argument.name);
    const auto field = std::find_if(values.drawn.values.begin(), values.drawn.values.end(),
                                    [&](const auto& one) { return gibbs::foldCase(one.first) == folded; });
    if (field != values.drawn.values.end())
      entry.variables.emplace_back(local, field->second);
    else if (const auto host = values.drawn.hosts.find(argument.name); host != values.drawn.hosts.end())
      entry.variables.emplace_back(local, host->second);
  }
  std::optional<sim::VendorMacros> meaning;
  if (targetSet_ != nullptr) {
    meaning.emplace(*targetSet_, *inputs_->control);
    meaning->setStylusRadius(values.drawn.hosts.at("tool_radius"));
  }
  std::optional<sim::Trace> writer;
  if (options_.traces) {
    writer.emplace([&](std::string_view lines) { trace += lines; });
    const sim::Point3& at = entry.start;
    writer->begin("start").word("X", at.x).word("Y", at.y).word("Z", at.z).end();
  }
  targetStand_->setTrace(writer ? &*writer : nullptr);
  verify::Record record = targetStand_->run(ready_->code(), world, entry,
                                            values.posted ? values.posted->stores : std::set<std::uint32_t>{},
                                            meaning ? &*meaning : nullptr);
  if (writer) traceResults(record, *writer);
  return record;
}

SourceRange CaseRunner::sourceOf(SourceRange posted, const Values& values) const {
  if (!posted.hasPlace() || values.lines.empty()) return {};
  // The text was "O1", then a posted line each.
  std::uint32_t at = 3;
  for (const compost::PostedLine& line : values.lines) {
    const std::uint32_t end = at + static_cast<std::uint32_t>(line.text.size()) + 1;
    if (posted.begin < end) return posted.begin < at ? SourceRange{} : line.range;
    at = end;
  }
  return {};
}

std::uint32_t CaseRunner::targetLine(SourceRange range) const {
  return ready_ ? ready_->line(range) : 0;
}

void CaseRunner::addFinding(CaseResult& result, const verify::Difference& difference,
                            const Values& values) const {
  CaseFinding finding;
  finding.aspect = difference.aspect;
  finding.text = difference.text;
  finding.source = plan_.translation ? sourceOf(difference.source, values) : difference.source;
  finding.targetLine = targetLine(difference.target);
  if (!plan_.translation) finding.posted = sourceOf(difference.target, values);
  result.findings.push_back(std::move(finding));
}

CaseResult CaseRunner::run(const verify::Case& drawn) {
  CaseResult result;
  const bool probeOn = options_.common.assume.contains("probe-on");
  std::unique_ptr<Values> values = std::move(drawn_); // of draw()
  if (!values) values = check(drawn, false);
  if (!values) {
    result.verdict = CaseVerdict::NoProgram;
    result.why = refusal_;
    return result;
  }
  if (!values->part && values->path && makePart(*values))
    misplace(*values);
  else if (!values->part)
    values->part = plan_.part;
  result.partMade = values->path && !values->path->touches.empty();
  if (!values->part) values->part = emptyPart(zeroOf(drawn));
  sim::World world(*values->part, probeFor(plan_, drawn),
                   plan_.machine ? plan_.machine->limits : sim::MachineLimits{});

  if (routine_ == nullptr) {
    compareGeometry(result, *values, runTranslation(*values, world, true, result.trace));
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
    source = runPosted(*values, world, probeOn, verify::Stand::Way::Run);
  }
  SourceRange at;
  result.why = verify::whyNothingProved(*source, at);
  result.whyAt = values->rejected ? values->rejectedAt : sourceOf(at, *values);
  noteProbe(result, *source, *values);
  if (source->ending == verify::Ending::Inconclusive) {
    result.verdict = CaseVerdict::NoProgram;
    return result;
  }
  if (target_ != nullptr) {
    const verify::Entry entry = entryFor(plan_, values->drawn, probeOn);
    const std::set<std::uint32_t> none;
    const TargetRun ran = target_->run({values->drawn, entry, values->posted ? values->posted->stores : none,
                                        world, values->rejected ? nullptr : &*source});
    if (ran.refused && !values->rejected) {
      result.verdict = CaseVerdict::Refused;
      result.why = "the translation refuses the values: " + ran.why;
      result.whyAt = {};
      return result;
    }
    if (ran.undecided) {
      result.verdict = CaseVerdict::NoProgram;
      result.why = ran.why;
      result.whyAt = {};
      return result;
    }
    takeRun(result, ran, *values);
  } else if (plan_.translation) {
    const verify::Record target = runTranslation(*values, world, probeOn, result.trace);
    verify::CompareRules rules;
    rules.results = std::max(options_.tolerance, resultTolerance(*inputs_->control, *inputs_->sourceControl));
    // Behind a write of the system that is active, what follows stands as exactly as the control computes.
    rules.tolerance = source && writesActive(*source, *values) ? rules.results : options_.tolerance;
    // Of eight digits the last one is a ten millionth at most; two of them.
    rules.relative = rules.results > options_.tolerance ? 2e-7 : 0;
    rules.mayRestoreModes = true;
    rules.sameAlarmNumbers = sourceSet_ == targetSet_ && !values->rejected;
    rules.samePlace = [&](SourceRange one, SourceRange other) {
      return plan_.translation->stemsFrom(values->rejected ? values->rejectedAt : sourceOf(one, *values),
                                          targetLine(other), session_.sources());
    };
    if (!values->rejected && target.ending == verify::Ending::Alarm && target.pieces.empty() &&
        plan_.translation->madeUp(targetLine(target.endedAt))) {
      result.verdict = CaseVerdict::Refused;
      result.why = "the translation refuses the values: " + target.text;
      result.whyAt = {};
      return result;
    }
    // How far another vendor's macro searches is its own business: it may find what the source's does not.
    const bool searches = source && source->ending == verify::Ending::Alarm &&
                          source->alarmKind == stdlib::macroAlarmName(stdlib::MacroAlarm::ProbeFail);
    if (!values->rejected && sourceSet_ != targetSet_ && searches &&
        !rules.samePlace(source->endedAt, target.endedAt)) {
      result.verdict = CaseVerdict::NoProgram;
      return result;
    }
    if (values->rejected) {
      compareRejection(result, *values, target);
    } else {
      for (const verify::Difference& difference : verify::compare(*source, target, rules))
        addFinding(result, difference, *values);
      comparePath(result, *values);
    }
  } else if (values->path && !values->rejected) {
    for (const verify::Difference& difference :
         verify::compare(*values->path, {}, *source, options_.tolerance))
      addFinding(result, difference, *values);
  }
  result.verdict = !result.findings.empty() ? CaseVerdict::Differ
                   : result.why.empty()     ? CaseVerdict::Proved
                                            : CaseVerdict::Idle;
  return result;
}

void CaseRunner::takeRun(CaseResult& result, const TargetRun& ran, const Values& values) const {
  if (values.rejected && !ran.refused && ran.differences.empty()) {
    CaseFinding finding;
    finding.aspect = verify::Aspect::Ending;
    finding.text = "the dialog turns the values away, and the translation takes them";
    finding.source = values.rejectedAt;
    result.findings.push_back(std::move(finding));
  }
  for (const TargetDifference& one : ran.differences) {
    CaseFinding finding;
    finding.aspect = one.difference.aspect;
    finding.text = one.difference.text + (one.line.empty() ? "" : ", in `" + one.line + "`");
    finding.source = values.rejected ? values.rejectedAt : sourceOf(one.difference.source, values);
    result.findings.push_back(std::move(finding));
  }
  if (!values.rejected) comparePath(result, values);
}

// The dialog has turned the values away: the translation raises an alarm that stems from there, and nothing
// has moved.
void CaseRunner::compareRejection(CaseResult& result, const Values& values,
                                  const verify::Record& target) const {
  CaseFinding finding;
  finding.aspect = verify::Aspect::Ending;
  finding.source = values.rejectedAt;
  finding.targetLine = targetLine(target.endedAt);
  if (target.ending != verify::Ending::Alarm)
    finding.text = "the dialog turns the values away, and the program runs";
  else if (!target.pieces.empty())
    finding.text = "the dialog turns the values away, and the program moves before its alarm";
  else
    return;
  result.findings.push_back(std::move(finding));
}

// What the path touches and what the source measures, whatever the translation is: nominal contacts alone.
void CaseRunner::comparePath(CaseResult& result, const Values& values) const {
  if (!values.path || !values.rehearsal) return;
  for (const verify::Difference& difference :
       verify::compare(*values.path, {}, *values.rehearsal, options_.tolerance)) {
    if (difference.aspect != verify::Aspect::Nominal) continue;
    CaseFinding finding{difference.aspect, "the drawn path and the post: " + difference.text,
                        difference.source, sourceOf(difference.target, values), 0};
    result.findings.push_back(std::move(finding));
  }
}

// Without a Prog: the way and the touches alone.
void CaseRunner::compareGeometry(CaseResult& result, const Values& values,
                                 const verify::Record& target) const {
  result.why = "measurement not stated by the source";
  if (values.rejected) {
    compareRejection(result, values, target);
  } else if (target.ending != verify::Ending::Finished) {
    result.findings.push_back({verify::Aspect::Ending,
                               "the path ends against an alarm: " + target.text,
                               {},
                               {},
                               targetLine(target.endedAt)});
  } else if (values.path) {
    for (const verify::Difference& difference :
         verify::compare(*values.path, {}, target, options_.tolerance)) {
      CaseFinding finding{
          difference.aspect, difference.text, difference.source, {}, targetLine(difference.target)};
      result.findings.push_back(std::move(finding));
    }
  }
  result.verdict = result.findings.empty() ? CaseVerdict::Idle : CaseVerdict::Differ;
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
    // Within the last place, towards the value's own side, so that no check turns it away.
    value->second += (value->second < 0 ? -0.4 : 0.4) * std::pow(10.0, -field.decimals);
    for (const SourceRange& place : lost(finer))
      if (std::find(always.begin(), always.end(), place) == always.end()) out.emplace_back(field.name, place);
  }
  return out;
}

// The zero of the system in which the case begins is another one at the end.
bool CaseRunner::writesActive(const verify::Record& record, const Values& values) const {
  const sim::Point3 zero = zeroOf(values.drawn);
  const double before[] = {zero.x, zero.y, zero.z};
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const auto after = record.zeros.find({values.drawn.system, axis});
    if (after != record.zeros.end() && after->second != before[axis]) return true;
  }
  return false;
}

} // namespace dotek::driver
