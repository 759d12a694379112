// Private to Verify*.cpp: many cases on several threads.
#pragma once

#include "driver/VerifyReport.h"

#include <functional>
#include <memory>

namespace dotek::driver {

// All cases of a command go to whoever is free: `main`, and what `another` gives to a thread of its own
// (nullptr: none). The report does not depend on who ran which. Without values for a case nothing is reported
// to it, but to the session of `main`: false.
bool runCases(const VerifyOptions& options, bool edges, CaseSubject& main,
              const std::function<std::unique_ptr<CaseSubject>()>& another, VerifyReport& report);

} // namespace dotek::driver
