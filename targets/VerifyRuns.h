// Many cases of a `verify` on several threads.
#pragma once

#include "targets/VerifyReport.h"

#include <functional>
#include <memory>

namespace dotek::targets {

// All cases of a command go to whoever is free: `main`, and what `another` gives to a thread of its own
// (nullptr: none). The report does not depend on who ran which. Without values for a case nothing is reported
// to it, but to the session of `main`: false. The same where a case stops the verification; the first such
// case is reported.
bool runCases(const VerifyOptions& options, bool edges, CaseSubject& main,
              const std::function<std::unique_ptr<CaseSubject>()>& another, VerifyReport& report);

} // namespace dotek::targets
