// Callers of a cycle that no case draws: other values than those of the case, and values that its checks
// refuse.
#include "targets/BesideBounds.h"
#include "targets/CycleFileCasesParts.h"
#include "targets/Stage.h"

#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::targets {

SourceQuestions::Ran CycleFileRunner::Questions::with(const std::string& name, double value) {
  Ran out;
  verify::Case other = played_.drawn;
  (other.hosts.contains(name) ? other.hosts : other.values)[name] = value;
  sim::World world(*played_.part, probeFor(runner_.plan_, other), runner_.limits());
  out.record = runner_.runCycle(other, world, false);
  if (out.record.ending == verify::Ending::Inconclusive) return out;
  out.answer = isRejection(out.record) ? Answer::Rejected : Answer::Runs;
  return out;
}

// A cycle selects no work system and no tool length of its own.
SourceQuestions::Ran CycleFileRunner::Questions::from(const verify::Entry&) {
  return {};
}

SourceQuestions::Ran CycleFileRunner::Questions::disturbed(const verify::Interference& interference) {
  Ran out;
  sim::World world(*played_.part, probeFor(runner_.plan_, played_.drawn), runner_.limits());
  sim::CycleWay way;
  out.record = runner_.runCycle(played_.drawn, world, false, interference, &way);
  if (out.record.ending == verify::Ending::Inconclusive) return out;
  out.answer = Answer::Runs;
  runner_.noteCompared(out.record, way);
  return out;
}

bool CycleFileRunner::Questions::moves(const std::string&) {
  return true;
}

bool CycleFileRunner::Questions::rejectsSome(const std::string& name) {
  if (runner_.isField(name)) return true;
  constexpr double kFar = 1e5;
  const auto rejected = [&](double value) { return with(name, value).answer == Answer::Rejected; };
  return rejected(0) || rejected(kFar) || rejected(-kFar);
}

bool CycleFileRunner::Questions::maySkip(const std::string& name) {
  const auto& variables = runner_.cycle().variables;
  return std::any_of(variables.begin(), variables.end(), [&](const ir::Variable& one) {
    return one.name == name && (one.optional || one.defaultValue);
  });
}

// What the cycle refuses where one of its checks turns, the program has to refuse, with the same text.
void CycleFileRunner::runAtBounds(const verify::Case& drawn, CaseResult& result) {
  runBesideBounds(
      plan_, drawn, result,
      [&](const verify::Case& beside) {
        const std::unique_ptr<Played> played = play(beside, false);
        if (!played->rejected) return true;
        const TargetRun ran = runTarget(*played, nullptr, nullptr);
        if (!ran.refused && !ran.undecided && ran.stopped.empty()) takeDifferences(result, ran);
        return true;
      },
      [](const verify::Case&, const verify::Bound&) { return true; });
}

} // namespace dotek::targets
