// Private to Verify*.cpp: the cases of a `verify` and their report.
#pragma once

#include "driver/Command.h"
#include "targets/VerifyReport.h"

#include <functional>
#include <memory>

namespace dotek::driver {

// Runs all cases (targets::runCases) and gives what they come to: the summary, the findings, and the report
// as a file where the options name a format of one. `said` is reported beside them,
// unless a case stopped all.
Outcome outcomeOfCases(const VerifyOptions& options, bool edges, CaseSubject& main,
                       const std::function<std::unique_ptr<CaseSubject>()>& another, VerifyReport& report,
                       const Diagnostics& said = {});

} // namespace dotek::driver
