// Values of one case: proposals until the cycle takes one, and what to say where it takes none.
#include "targets/CycleCasesParts.h"
#include "targets/NominalFields.h"
#include "verify/Bounds.h"
#include "verify/Random.h"

#include <algorithm>
#include <cmath>

namespace dotek::targets {

namespace {

constexpr std::uint32_t kAttempts = 2000;    // to find values that the cycle takes
constexpr std::uint32_t kMoreAttempts = 200; // for others in the place of those
constexpr std::uint32_t kNearest = 4;        // times that their part's error is halved at most
// What the checks of the translation reject is not asked of the source, which takes a thousand times as long.
// It is asked in one case of so many, for checks that were translated wrong, and where many attempts were in
// vain.
constexpr std::uint64_t kAsked = 4;
constexpr std::uint32_t kForeseen = 1500;
// Each so many-th case that is drawn in another's place.
constexpr std::uint32_t kSetsActive = 4, kFirstValues = 3;
constexpr std::uint64_t kCallerCases = 8; // in which callers break what the translation demands

} // namespace

std::optional<verify::Case> CaseRunner::draw(std::uint64_t index) {
  rejected_.clear();
  others_ = 0;
  std::optional<verify::Case> out = drawFrom(index, 0, kAttempts, false);
  if (!out) askConversion(index);
  return out;
}

std::optional<verify::Case> CaseRunner::another(std::uint64_t index) {
  if (options_.replay) return std::nullopt;
  ++others_;
  const std::uint32_t end = std::min(kAttempts, tries_ + kMoreAttempts);
  std::optional<verify::Case> out = drawFrom(index, tries_, end, true);
  // Where the limits are far beyond what is measured few values may pass the checks.
  return out || stopped_ ? out : drawFrom(index, tries_, end, false);
}

// What the system that the cycle sets has been is near what it becomes: it is the one in which the part lies.
// A cycle that compares the two stops in all other cases.
void CaseRunner::setsActive(verify::Case& proposal) const {
  for (const verify::DrawField& field : plan_.fields) {
    const auto value = proposal.values.find(field.name);
    if (field.kind != ir::Kind::WorkOffset || value == proposal.values.end()) continue;
    if (const std::uint32_t system = field.systemOf(value->second); system != 0) proposal.system = system;
    return;
  }
}

// With its first values a cycle comes to its end; the more cases were in vain, the more of them are taken.
void CaseRunner::takeFirstValues(verify::Case& proposal, verify::Random random) const {
  const double share = std::min(0.9, 0.2 * (others_ - 1));
  for (const verify::DrawField& field : plan_.fields) {
    const auto value = proposal.values.find(field.name);
    if (value == proposal.values.end() || !field.initial || field.fixed || field.kind == ir::Kind::WorkOffset)
      continue;
    if (random.chance(share)) value->second = *field.initial;
  }
}

// Proposals from `tries` on, up to `end`.
std::optional<verify::Case> CaseRunner::drawFrom(std::uint64_t index, std::uint32_t tries, std::uint32_t end,
                                                 bool wide) {
  const auto isForeseen = [&](const verify::Case& proposal) {
    if (plan_.bounds == nullptr || plan_.findsMacros) return false;
    if (plan_.hostDecimals.empty()) return plan_.bounds->rejects(proposal);
    verify::Case rounded = proposal;
    roundHosts(rounded);
    return plan_.bounds->rejects(rounded);
  };
  std::unique_ptr<Values> values;
  const auto proposed = [&](std::uint32_t which) {
    verify::Case proposal = (wide ? wide_ : draws_)->propose(index, which);
    if (options_.activeSystem) proposal.system = *options_.activeSystem;
    proposal.callers = plan_.translation && (index < kCallerCases || options_.replay);
    if (options_.partError) {
      const auto& [x, y, z, turn] = *options_.partError;
      proposal.error = {{x, y, z}, turn};
    } else if (others_ > 1) {
      // A place that is out of its tolerance ends the source: nearer to the nominal one each time.
      const double share = std::pow(0.5, std::min(others_ - 1, kNearest));
      for (double* const part :
           {&proposal.error.shift.x, &proposal.error.shift.y, &proposal.error.shift.z, &proposal.error.turn})
        *part = std::round(*part * share * 1000) / 1000;
      if (!options_.activeSystem && others_ % kSetsActive == 0) setsActive(proposal);
      if (others_ % kFirstValues == 2)
        if (others_ % kFirstValues == 2)
          takeFirstValues(proposal,
                          verify::Random(verify::Random::sub(options_.seed, index * kAttempts + which)));
    }
    return proposal;
  };
  const auto isTaken = [&](const verify::Case& proposal) {
    values = attempt(proposal);
    if (values) return true;
    Rejection& rejection = rejected_[{refusal_, refusedAt_.begin}];
    rejection = {rejection.count + 1, refusal_, refusedAt_};
    return false;
  };
  const auto take = [&](std::uint32_t which) {
    verify::Case drawn = values->drawn;
    drawn_ = std::move(values);
    tries_ = which + 1;
    return drawn;
  };
  const bool all = tries == 0;
  std::vector<std::uint32_t> passedOver; // for what the translated checks say
  for (; tries < end; ++tries) {
    verify::Case proposal = proposed(tries);
    if (options_.replay) {
      takeValues(proposal);
      takeSelected(proposal, false);
      return proposal; // drawn_ is of no other case
    }
    if (nominal_ != nullptr) nominal_->roundStart(proposal);
    if (tries < kForeseen && index % kAsked != 0 && isForeseen(proposal)) {
      passedOver.push_back(tries);
      continue;
    }
    if (isTaken(proposal)) return take(tries);
    if (unreadable_) return std::nullopt;
  }
  // What is reported adds up to the tries.
  for (const std::uint32_t which : all ? passedOver : std::vector<std::uint32_t>()) {
    verify::Case proposal = proposed(which);
    if (nominal_ != nullptr) nominal_->roundStart(proposal);
    if (isTaken(proposal)) return take(which);
    if (unreadable_ || stopped_) return std::nullopt;
  }
  return std::nullopt;
}

std::vector<Rejection> CaseRunner::rejections() const {
  return commonestFirst(rejected_);
}

} // namespace dotek::targets
