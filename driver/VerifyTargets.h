// Private to Verify*.cpp: translations that are no program of a control with arguments: how one case of them
// is run and compared with the posted program.
#pragma once

#include "driver/CycleFolder.h"
#include "driver/Lowering.h"
#include "driver/Session.h"
#include "driver/VerifyCase.h"
#include "sim/World.h"
#include "verify/Compare.h"
#include "verify/Stand.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::driver {

// One case as a translation sees it.
struct TargetCase {
  const verify::Case& drawn;
  const verify::Entry& entry;
  const std::set<std::uint32_t>& stores; // common variables that the source writes
  sim::World& world;
  const verify::Record* source; // nullptr: the dialog turns the values away
};

// A difference and the line of the translation that shows it; the text is that of this case.
struct TargetDifference {
  verify::Difference difference;
  std::string line; // "" where there is none
};

struct TargetRun {
  // Nothing is written for these values, or the translation stops with an error before anything moves.
  bool refused = false;
  bool undecided = false; // the two cannot be compared
  std::string why;        // it is refused or undecided
  std::vector<TargetDifference> differences;

  void differs(verify::Aspect aspect, std::string text, std::string line = "");
};

class VerifyTarget {
public:
  VerifyTarget() = default;
  virtual ~VerifyTarget() = default;
  VerifyTarget(const VerifyTarget&) = delete;
  VerifyTarget& operator=(const VerifyTarget&) = delete;
  // Before the first case. false: reported to the session.
  virtual bool prepare() = 0;
  // The session's diagnostics are this run's own.
  virtual TargetRun run(const TargetCase& now) = 0;
};

// What both share; all outlive the target.
struct TargetSource {
  const VerifyOptions& options;
  const VerifyPlan& plan;
  Session& session;
  LoweringInputs& inputs;
  const CycleFolder& folder;
};

// A fragment for Fusion, run on the kernel's double; its text runs like the posted one.
std::unique_ptr<VerifyTarget> fusionTarget(const TargetSource& source);
// A program of Mikroprog, written anew for each case.
std::unique_ptr<VerifyTarget> mikroprogTarget(const TargetSource& source);
// nullptr: the translation is a program with arguments, which CaseRunner runs itself.
std::unique_ptr<VerifyTarget> verifyTarget(const TargetSource& source);

// Whether the options fit the target; what does not is reported.
bool checkTargetOptions(const VerifyOptions& options, Diagnostics& diagnostics);

} // namespace dotek::driver
