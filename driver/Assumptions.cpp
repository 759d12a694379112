#include "driver/Assumptions.h"

#include "frontend/gibbs/Assumptions.h"
#include "support/NearestName.h"

#include <algorithm>

namespace dotek::driver {
namespace {

// Word?=yes, Word?(name)=no
bool answersCondition(const std::string& name) {
  const std::size_t mark = name.find('?');
  return mark != std::string::npos && mark > 0 && (name.ends_with("=yes") || name.ends_with("=no"));
}

} // namespace

std::vector<std::pair<std::string, std::string>> assumptionTable() {
  std::vector<std::pair<std::string, std::string>> out{
      {"missing-field-zero", "a field that the post prints and nobody declares: it is 0"},
      {"changed-field=macro",
       "a field that the macro changes behind its dialog: the macro's value is stored"},
      {"changed-field=given", "a field that the macro changes behind its dialog: the given value is stored"},
      {"unchecked", "checks of CycleData.mac that cannot be made: the values pass"},
      {"and-before-or", "AND beside OR in a Prog: AND binds tighter"},
      {"left-to-right", "AND beside OR in a Prog: read from left to right"},
      {"Word?=yes", "a condition of a Prog that only the CAM can answer: it holds"},
      {"Word?=no", "a condition of a Prog that only the CAM can answer: it does not hold"},
  };
  for (const frontend::gibbs::Assumption& one : frontend::gibbs::kAssumptions)
    out.emplace_back(one.id, std::string(one.construct) + ": " + std::string(one.reading));
  std::sort(out.begin(), out.end());
  return out;
}

void checkAssumptions(const std::set<std::string>& given, Diagnostics& diagnostics) {
  const auto table = assumptionTable();
  for (const std::string& name : given) {
    const bool known =
        std::any_of(table.begin(), table.end(), [&](const auto& row) { return row.first == name; });
    if (known || answersCondition(name)) continue;
    const std::string near = nearestName(name, table);
    diagnostics.report<diag::UnknownAssumption>({}, name,
                                                near.empty() ? "" : "; did you mean `" + near + "`?");
  }
}

} // namespace dotek::driver
