#include "driver/Assume.h"

#include "frontend/gibbs/Assumptions.h"
#include "support/NearestName.h"

#include <algorithm>
#include <vector>

namespace dotek::driver {

void checkAssumptions(const std::set<std::string>& given, Diagnostics& diagnostics) {
  std::vector<std::string> known = {"missing-field-zero", "changed-field=macro", "changed-field=given",
                                    "and-before-or", "left-to-right"};
  for (const auto& each : frontend::gibbs::kAssumptions)
    known.emplace_back(each.id);
  for (const std::string& name : given) {
    // A condition of a Prog: `Word?=yes`, `Word?(name)=no`.
    const bool condition =
        name.find('?') != std::string::npos && (name.ends_with("=yes") || name.ends_with("=no"));
    if (condition || std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = nearestName(name, known);
    diagnostics.report<diag::UnknownName>({}, "--assume", name, "reading",
                                          near.empty() ? "" : "; did you mean `" + near + "`?");
  }
}

} // namespace dotek::driver
