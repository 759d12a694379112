#include "frontend/gibbs/Assumptions.h"
#include "driver/Session.h"
#include "support/NearestName.h"

#include <algorithm>
#include <array>

namespace dotek::driver {

namespace {

// Readings that are asked for outside the macro language. `NAME?=yes` and `NAME?=no` stand for any boolean.
constexpr std::array<std::string_view, 5> kOthers = {"missing-field-zero", "changed-field=macro",
                                                     "changed-field=given", "and-before-or", "left-to-right"};

} // namespace

void Session::checkAssumptions() {
  std::vector<std::string> known(kOthers.begin(), kOthers.end());
  for (const auto& each : frontend::gibbs::kAssumptions)
    known.emplace_back(each.id);
  for (const std::string& name : options_.assume) {
    const bool boolean = name.ends_with("?=yes") || name.ends_with("?=no");
    if (boolean || std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = nearestName(name, known);
    diagnostics_.report<diag::UnknownAssumption>({}, name,
                                                 near.empty() ? "" : "; did you mean `" + near + "`?");
  }
}

} // namespace dotek::driver
