// What the control refuses to take, or stops at. Each function is the check of one rule of lint, which has
// its page in docs/rules; commands that run a program ask refuse() first.
#pragma once

#include "frontend/mikroprog/Reading.h"
#include "support/Diagnostics.h"

#include <string>
#include <vector>

namespace dotek::frontend::mikroprog {

struct Finding {
  SourceRange range;
  std::string text;
};
using Findings = std::vector<Finding>;

// Codes.
Findings unknownCodes(const Reading& reading);
Findings unusableCodes(const Reading& reading);

// Addresses of a function, and their values.
Findings missingAddresses(const Reading& reading);
Findings addressesNotTaken(const Reading& reading);
Findings addressesNotTogether(const Reading& reading);
Findings saidTwice(const Reading& reading);
Findings valuesOutOfRange(const Reading& reading);
Findings tooManyDecimals(const Reading& reading);
Findings missingFiles(const Reading& reading);
Findings missingTexts(const Reading& reading);
Findings conditionsInComments(const Reading& reading);
Findings unknownConditions(const Reading& reading);
Findings powerSection(const Reading& reading);

// Jumps and subprograms.
Findings missingTargets(const Reading& reading);
Findings subprogramsBeforeEnd(const Reading& reading);
Findings subprogramsWithoutReturn(const Reading& reading);
Findings strayReturns(const Reading& reading);

// Loops and calls of which no path leads to an end, each once. The control takes them, so refuse() leaves
// them out.
Findings endlessLoops(const Reading& reading);

// What follows from where the tool is.
Findings impossibleArcs(const Reading& reading);
Findings unequalQuarters(const Reading& reading);
Findings threadsWithoutFeed(const Reading& reading);
Findings feedUnits(const Reading& reading);

// The others of the above as errors, each with the code of its rule.
void refuse(const Reading& reading, Diagnostics& diagnostics);

} // namespace dotek::frontend::mikroprog
