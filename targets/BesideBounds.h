// Cases where a check of the source turns, which are not drawn: a translation has to reject what the source
// rejects.
#pragma once

#include "support/Decimal.h"
#include "targets/Subject.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace dotek::targets {

// `run` gets each such case that the checks reject, at the bound, a step to either side and as far as
// Bounds::beside() says; `accepted` one at the bound itself that they take, with the number of the bound.
// Both add what they find to `result` and say whether to go on. The first that finds something is named and
// is the last.
template <class Plan, class Run, class Accepted>
void runBesideBounds(const Plan& plan, const verify::Case& drawn, CaseResult& result, const Run& run,
                     const Accepted& accepted) {
  if (plan.bounds == nullptr) return;
  for (const verify::Bound& bound : plan.bounds->find(plan.fields, {drawn}, true, UINT64_MAX)) {
    const std::optional<verify::Case> met = plan.bounds->meet(bound, plan.fields, drawn, true);
    if (!met) continue;
    const verify::DrawField& field = plan.fields[bound.field];
    const double turn = met->values.at(field.name), step = std::pow(10.0, -field.decimals);
    std::vector<double> values = {turn - step, turn, turn + step};
    if (std::abs(turn) > step) // a check may compare ABS[..]
      values.insert(values.end(), {-turn - step, -turn + step});
    for (const double far : plan.bounds->beside(*met, field))
      if (std::abs(far - turn) > 1.5 * step) values.push_back(far);
    for (const double value : values) {
      // What a list does not offer is rejected as such, and with which words is another question.
      if (!field.choices.empty() &&
          std::find(field.choices.begin(), field.choices.end(), value) == field.choices.end())
        continue;
      verify::Case beside = *met;
      beside.callers = false;
      beside.values[field.name] = value;
      const bool rejected = plan.bounds->rejects(beside);
      if (!rejected && value != turn) continue; // others are drawn
      const bool goOn = rejected ? run(beside) : accepted(beside, bound);
      for (CaseFinding& finding : result.findings)
        finding.text = fmt::format("called with {} {}: {}", field.name, numberText(value), finding.text);
      if (!goOn || !result.findings.empty()) return;
    }
  }
}

} // namespace dotek::targets
