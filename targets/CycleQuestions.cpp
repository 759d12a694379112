// What the source does with other values than those of a case, and what its caller has in force.
#include "targets/CycleCasesParts.h"
#include "targets/SelectedSystems.h"
#include "targets/Stage.h"
#include "verify/Callers.h"
#include "verify/PathPieces.h"
#include "verify/Random.h"

#include <algorithm>
#include <cmath>

namespace dotek::targets {

namespace {

constexpr double kSame = 1e-9;
constexpr double kContactShare =
    0.75; // of a bare skip move that is rehearsed: at its end it would have missed

bool sameMotion(const verify::Record& a, const verify::Record& b) {
  const auto samePiece = [](const verify::Piece& one, const verify::Piece& other) {
    return one.kind == other.kind && one.feed == other.feed && one.with == other.with &&
           verify::near(one.from, other.from, kSame) && verify::near(one.to, other.to, kSame);
  };
  const auto sameTouch = [](const verify::Touch& one, const verify::Touch& other) {
    return verify::near(one.point, other.point, kSame) && verify::near(one.direction, other.direction, kSame);
  };
  // Where the surface of a bare skip move is expected moves nothing: its path ends at its aim.
  const auto sameMeasure = [&](const verify::Measure& one, const verify::Measure& other) {
    if (one.aim || other.aim) return one.aim && other.aim && verify::near(*one.aim, *other.aim, kSame);
    return std::equal(one.nominal.begin(), one.nominal.end(), other.nominal.begin(), other.nominal.end(),
                      sameTouch);
  };
  // What leads away from the last measure goes with the offsets that were set there.
  const bool sets = a.zeros != b.zeros;
  const auto end = [&](const verify::Record& record) {
    const auto last =
        std::find_if(record.pieces.rbegin(), record.pieces.rend(),
                     [](const verify::Piece& one) { return one.kind == sim::PathKind::Measuring; });
    return sets ? last.base() : record.pieces.end();
  };
  return std::equal(a.pieces.begin(), end(a), b.pieces.begin(), end(b), samePiece) &&
         std::equal(a.measures.begin(), a.measures.end(), b.measures.begin(), b.measures.end(), sameMeasure);
}

} // namespace

SourceQuestions::Ran CaseRunner::Questions::play(const std::string& field, double value,
                                                 verify::Stand::Way way) {
  Ran out;
  verify::Case other = values_.drawn;
  (other.hosts.contains(field) ? other.hosts : other.values)[field] = value;
  runner_.rests_ = values_.rests;
  const std::unique_ptr<Values> now = runner_.check(other, false);
  runner_.rests_ = false;
  if (!now) return out;
  if (now->rejected) {
    out.answer = Answer::Rejected;
    return out;
  }
  if (!runner_.readPosted(*now)) return out;
  out.losesDigits = now->losesDigits;
  now->part = values_.part;
  now->caller = callerStream(values_.drawn);
  verify::Entry entry = runner_.entryOf(*now, probeOn_);
  entry.contactShare = kContactShare;
  out.record = runner_.runPosted(*now, world_, entry, way);
  if (out.record.ending != verify::Ending::Inconclusive) out.answer = Answer::Runs;
  return out;
}

SourceQuestions::Ran CaseRunner::Questions::with(const std::string& field, double value) {
  return values_.posted ? play(field, value, verify::Stand::Way::Run) : Ran{};
}

bool CaseRunner::Questions::prints(const std::string& field, const std::vector<double>& values) {
  const auto same = [](const frontend::compost::PostedLine& one, const frontend::compost::PostedLine& other) {
    return one.text == other.text;
  };
  return values_.posted && std::any_of(values.begin(), values.end(), [&](double value) {
           verify::Case other = values_.drawn;
           other.values[field] = value;
           const std::unique_ptr<Values> now = runner_.check(other, false);
           return now && !now->rejected && runner_.post(*now) &&
                  !std::equal(now->lines.begin(), now->lines.end(), values_.lines.begin(),
                              values_.lines.end(), same);
         });
}

bool CaseRunner::Questions::takesNoOffset(const std::string& name, double value) {
  if (!values_.posted) return false;
  verify::Case other = values_.drawn;
  (other.hosts.contains(name) ? other.hosts : other.values)[name] = value;
  const std::unique_ptr<Values> now = runner_.check(other, false);
  if (!now || now->rejected || !runner_.readPosted(*now)) return false;
  return verify::takesNoOffset(now->posted->file.programs.front(), *runner_.inputs_->sourceControl) &&
         !verify::takesNoOffset(values_.posted->file.programs.front(), *runner_.inputs_->sourceControl);
}

bool CaseRunner::Questions::rejectsSome(const std::string& name) {
  constexpr double kFar = 1e5;
  for (const double value : {0.0, kFar, -kFar}) {
    verify::Case other = values_.drawn;
    (other.hosts.contains(name) ? other.hosts : other.values)[name] = value;
    const std::unique_ptr<Values> now = runner_.check(other, false);
    if (now && now->rejected) return true;
  }
  return false;
}

bool CaseRunner::Questions::maySkip(const std::string&) {
  return false; // a folder knows no arguments
}

SourceQuestions::Ran CaseRunner::Questions::from(const verify::Entry& entry) {
  Ran out;
  if (!values_.posted) return out;
  out.record = runner_.runPosted(values_, world_, entry, verify::Stand::Way::Run);
  if (out.record.ending != verify::Ending::Inconclusive) out.answer = Answer::Runs;
  return out;
}

SourceQuestions::Ran CaseRunner::Questions::disturbed(const verify::Interference& interference) {
  Ran out;
  if (!values_.posted) return out;
  out.record = runner_.runPosted(values_, world_, runner_.entryOf(values_, probeOn_), verify::Stand::Way::Run,
                                 interference);
  runner_.noteAlarm(out.record, values_);
  if (out.record.ending != verify::Ending::Inconclusive) out.answer = Answer::Runs;
  return out;
}

void CaseRunner::Questions::elsewhere(const verify::PartError& more, const Growth& grown,
                                      const std::function<void(const verify::Record&, sim::World&)>& look) {
  if (!values_.posted) return;
  const std::optional<sim::Part> part = runner_.partBeside(values_, more, grown);
  if (!part) return;
  sim::World world(*part, probeFor(runner_.plan_, values_.drawn));
  world.setTie(grown.tie);
  const verify::Record record = runner_.runPosted(values_, world, probeOn_, verify::Stand::Way::Run);
  runner_.noteAlarm(record, values_);
  if (record.ending != verify::Ending::Inconclusive) look(record, world);
}

bool CaseRunner::Questions::setsActive(const std::string& field, double value) const {
  const auto& fields = runner_.plan_.fields;
  return std::any_of(fields.begin(), fields.end(), [&](const verify::DrawField& one) {
    return one.name == field && one.kind == ir::Kind::WorkOffset &&
           one.systemOf(value) == values_.drawn.system;
  });
}

bool CaseRunner::Questions::moves(const std::string& field) {
  const auto known = runner_.moving_.find(field);
  if (known != runner_.moving_.end() && known->second) return true;
  bool& moving = runner_.moving_[field];
  const auto now = values_.drawn.values.find(field);
  if (!values_.posted || now == values_.drawn.values.end()) return moving;
  // Where the active system is set, the path that follows is another one; and a tolerance that stops the run
  // moves nothing.
  const auto finished = [&](double value) -> std::optional<verify::Record> {
    if (setsActive(field, value)) return std::nullopt;
    Ran ran = play(field, value, verify::Stand::Way::Rehearse);
    if (ran.answer != Answer::Runs || ran.record.ending != verify::Ending::Finished) return std::nullopt;
    return std::move(ran.record);
  };
  std::optional<verify::Record> first = finished(now->second);
  constexpr std::uint32_t kOthers = 6; // values that are tried
  for (std::uint32_t n = 0; n < kOthers && !moving; ++n) {
    const verify::Case other = runner_.draws_->propose(values_.drawn.stream + n, 0);
    const auto value = other.values.find(field);
    if (value == other.values.end() || value->second == now->second) continue;
    std::optional<verify::Record> record = finished(value->second);
    if (first && record) moving = !sameMotion(*first, *record);
    if (!first) first = std::move(record);
  }
  return moving;
}

verify::Entry CaseRunner::entryOf(const Values& values, bool probeOn) const {
  verify::Entry out = entryFor(values.drawn, probeOn);
  // Both sides run under it; a source that puts its own length in force says by itself what holds.
  out.keepsLength =
      values.posted != nullptr && !verify::hasCode(values.posted->file.programs.front(),
                                                   *inputs_->sourceControl, stdlib::Function::ToolLengthPlus);
  if (values.posted)
    selectExtended(values.posted->file.programs.front(), *inputs_->sourceControl, switches_,
                   target_ == nullptr || !(target_->datumsMovePath() || target_->needsNominal()), out);
  if (values.path && target_ != nullptr && target_->datumsMovePath()) out.drawn = values.path->nominal();
  for (const auto& [number, value] : variables_)
    out.variables.emplace_back(number, value);
  for (const auto* given : {&values.presets, &values.drawn.variables})
    for (const auto& [number, value] : *given)
      out.variables.emplace_back(number, value);
  if (!plan_.translation) return out;
  verify::Random random(values.caller.value_or(callerStream(values.drawn)));
  out.feed = 50.5 + static_cast<double>(random.below(4000));
  const bool left = random.chance(0.5), mist = random.chance(0.5);
  if (!values.posted) return out;
  if (values.posted->stopsSpindle) out.spindle = left ? 2 : 1;
  if (values.posted->stopsCoolant)
    out.coolant = mist ? sim::Machine::Coolant::Mist : sim::Machine::Coolant::Flood;
  for (const std::uint32_t number : values.posted->leftOver)
    if (random.chance(0.5)) out.variables.emplace_back(number, static_cast<double>(random.below(8)) + 0.5);
  return out;
}

} // namespace dotek::targets
