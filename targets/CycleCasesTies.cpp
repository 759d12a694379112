// Arguments that a cycle compares with what it has measured: each also has the value at which the source goes
// another way, and there the measured value counts as equal to it.
#include "ir/Program.h"
#include "support/Decimal.h"
#include "targets/CycleCasesParts.h"
#include "targets/Stage.h"
#include "verify/SameWay.h"

#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace dotek::targets {

namespace {

// Values of one field, in steps of its last place.
class Limit {
public:
  Limit(SourceQuestions& questions, const verify::DrawField& field)
      : questions_(questions), name_(field.name), perUnit_(std::pow(10.0, field.decimals)) {}

  double value(long steps) const { return static_cast<double>(steps) / perUnit_ + 0.0; }
  double step() const { return 1 / perUnit_; }

  // The last step of each way of the source, as far as they show beside `now` and the sizes of limits that
  // people give.
  std::set<long> turns(double now) {
    constexpr double kSizes[] = {0, 0.02, 0.3, 4, 1000}; // mm, degrees
    std::set<long> places{std::lround(now * perUnit_)};
    for (const double size : kSizes)
      for (const double place : {size, -size})
        places.insert(std::lround(place * perUnit_));
    std::set<long> out;
    std::optional<long> last;
    for (const long place : places) {
      if (!at(place)) continue;
      if (last)
        verify::findTurns(
            *last, place, false, [&](long steps) -> const auto& { return at(steps); }, out);
      last = place;
    }
    return out;
  }

  bool meetsEach(long steps) { return at(steps) && verify::meetsEach(*at(steps)); }

private:
  const std::optional<verify::Record>& at(long steps) {
    constexpr std::size_t kMostRuns = 120;
    const auto known = runs_.find(steps);
    if (known != runs_.end()) return known->second;
    std::optional<verify::Record>& out = runs_[steps];
    if (runs_.size() > kMostRuns) return out;
    SourceQuestions::Ran ran = questions_.with(name_, value(steps));
    if (ran.answer == SourceQuestions::Answer::Runs && !ran.losesDigits) out = std::move(ran.record);
    return out;
  }

  SourceQuestions& questions_;
  const std::string name_;
  const double perUnit_; // steps of 1 mm, or degree
  std::map<long, std::optional<verify::Record>> runs_;
};

} // namespace

void CaseRunner::runAtLimits(const Values& drawn, bool probeOn, CaseResult& result) {
  constexpr double kTie = 0.003; // mm beside a step of the field: what other arithmetic or macros leave
  constexpr std::size_t kMostTurns = 6;
  if (!drawn.posted || !drawn.part) return;
  for (const verify::DrawField& field : plan_.fields) {
    if (!field.decides || field.fixed || !field.choices.empty()) continue;
    sim::World world(*drawn.part, probeFor(plan_, drawn.drawn));
    Questions questions(*this, drawn, world, probeOn);
    Limit limit(questions, field);
    const std::set<long> turns = limit.turns(drawn.drawn.values.at(field.name));
    if (turns.size() > kMostTurns) continue; // it goes another way with each value
    for (const long turn : turns) {
      // Where a search ends two macros do not share the last digit.
      if (!limit.meetsEach(turn) || !limit.meetsEach(turn + 1)) continue;
      verify::Case met = drawn.drawn;
      met.callers = false;
      met.values[field.name] = limit.value(turn);
      rests_ = drawn.rests;
      const std::unique_ptr<Values> values = check(met, false);
      rests_ = false;
      if (stopped_) return;
      if (!values || values->rejected || !readPosted(*values) || values->losesDigits) continue;
      values->part = drawn.part;
      sim::World tied(*values->part, probeFor(plan_, met));
      if (!target_->meetsLimitsAlike()) { // what differs there by itself is a matter of the last digits
        const verify::Record plain = runPosted(*values, tied, probeOn, verify::Stand::Way::Run);
        const TargetRun there = runTarget(*values, tied, probeOn, &plain, nullptr, false);
        if (there.refused || there.undecided || !there.differences.empty()) continue;
      }
      tied.setTie(limit.step() + kTie);
      const verify::Record source = runPosted(*values, tied, probeOn, verify::Stand::Way::Run);
      noteAlarm(source, *values);
      if (source.ending == verify::Ending::Inconclusive) continue;
      TargetRun ran = runTarget(*values, tied, probeOn, &source, nullptr, false);
      if (ran.refused || ran.undecided || !ran.stopped.empty()) continue;
      takeRun(result, std::move(ran), *values, &source);
      for (CaseFinding& finding : result.findings)
        finding.text = fmt::format("with {} {}, so that a measured value is exactly a limit: {}", field.name,
                                   fixedText(limit.value(turn), field.decimals), finding.text);
      if (!result.findings.empty()) return;
    }
  }
}

} // namespace dotek::targets
