#include "targets/MissedTouches.h"

#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>

namespace dotek::targets {

namespace {

constexpr std::size_t kMost = 12; // touches; of a loop, the first

// The same blocks, as far as they show; not where they lead to.
bool sameWay(const verify::Record& a, const verify::Record& b) {
  const auto sameDeed = [](const verify::Deed& one, const verify::Deed& other) {
    return one.kind == other.kind && one.text == other.text && one.range.begin == other.range.begin;
  };
  const auto sameNumber = [](const auto& one, const auto& other) { return one.first == other.first; };
  return a.ending == b.ending && a.alarm == b.alarm && a.text == b.text &&
         a.endedAt.begin == b.endedAt.begin && a.lastBlock.begin == b.lastBlock.begin &&
         a.pieces.size() == b.pieces.size() && a.measures.size() == b.measures.size() &&
         std::equal(a.deeds.begin(), a.deeds.end(), b.deeds.begin(), b.deeds.end(), sameDeed) &&
         std::equal(a.stores.begin(), a.stores.end(), b.stores.begin(), b.stores.end(), sameNumber);
}

// Where one touch has to find its surface for the source to go another way than a step before.
class Turns {
public:
  Turns(SourceQuestions& questions, std::size_t search) : questions_(questions), search_(search) {}

  // In steps from where the touch begins: the last one of each way and the first one of the next, between
  // these.
  void find(long from, long to) {
    const std::optional<verify::Record>&one = at(from), &other = at(to);
    if (!one || !other || sameWay(*one, *other)) return;
    if (to - from <= 1) {
      found_.insert(from);
      found_.insert(to);
      return;
    }
    const long middle = from + (to - from) / 2;
    find(from, middle);
    find(middle, to);
  }
  const std::set<long>& found() const { return found_; }

  // nullopt: what the source does is not known, or it has been asked often enough.
  const std::optional<verify::Record>& at(long steps) {
    constexpr std::size_t kMostRuns = 160;
    const auto known = runs_.find(steps);
    if (known != runs_.end()) return known->second;
    std::optional<verify::Record>& out = runs_[steps];
    if (runs_.size() > kMostRuns) return out;
    SourceQuestions::Ran ran = questions_.disturbed(placed(steps));
    if (ran.answer == SourceQuestions::Answer::Runs) out = std::move(ran.record);
    return out;
  }
  verify::Interference placed(long steps) const {
    verify::Interference out;
    out.placed = {search_, static_cast<double>(steps) * verify::kStep};
    return out;
  }

private:
  SourceQuestions& questions_;
  const std::size_t search_;
  std::map<long, std::optional<verify::Record>> runs_;
  std::set<long> found_;
};

} // namespace

std::vector<verify::Difference>
compareMissed(const TargetCase& now, const verify::Record& ran,
              const std::function<verify::Record(const verify::Interference&)>& run,
              const std::function<verify::CompareRules(const verify::Record&)>& rules, bool exact) {
  if (now.source == nullptr || now.questions == nullptr || now.source->searches != ran.searches) return {};
  const auto compared = [&](const verify::Record& meant, const verify::Interference& by, std::string where) {
    std::vector<verify::Difference> found = verify::compare(meant, run(by), rules(meant));
    for (verify::Difference& one : found)
      one.text = where + ": " + one.text;
    return found;
  };
  for (std::size_t search = 0; search < std::min(ran.searches, kMost); ++search) {
    verify::Interference none;
    none.missing = search;
    const SourceQuestions::Ran meant = now.questions->disturbed(none);
    if (meant.answer != SourceQuestions::Answer::Runs) continue;
    std::vector<verify::Difference> found =
        compared(meant.record, none, fmt::format("where touch {} finds nothing", search + 1));
    if (!found.empty()) return found;
  }
  if (!exact) return {};
  std::size_t search = 0;
  for (const verify::Measure& measure : now.source->measures) {
    if (!measure.aim || search >= kMost) continue;
    Turns turns(*now.questions, search++);
    const auto steps = [&](const sim::Point3& to) {
      return std::lround((to - measure.start).length() / verify::kStep);
    };
    const long here = std::max(1L, steps(measure.end)), last = steps(*measure.aim);
    turns.find(1, here);
    turns.find(here, last);
    for (const long at : turns.found()) {
      const std::optional<verify::Record>& meant = turns.at(at);
      if (!meant) continue;
      std::vector<verify::Difference> found =
          compared(*meant, turns.placed(at),
                   fmt::format("where touch {} finds its surface {} mm from its start", search,
                               fixedText(static_cast<double>(at) * verify::kStep, 3)));
      if (!found.empty()) return found;
    }
  }
  return {};
}

} // namespace dotek::targets
