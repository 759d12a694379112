// Private to Verify*.cpp: translations that are no program of a control with arguments: how one case of them
// is run and compared with the posted program.
#pragma once

#include "driver/Command.h"
#include "driver/VerifyCase.h"
#include "project/CycleFolder.h"
#include "project/Lowering.h"
#include "sim/machine/World.h"
#include "verify/Compare.h"
#include "verify/Stand.h"

#include <functional>
#include <map>
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
  // Whether it takes only values with which start and travel lead to the coordinate that a surface gets.
  virtual bool needsNominal() const { return false; }
  // Before the first case. false: reported to the session.
  virtual bool prepare() = 0;
  // The session's diagnostics are this run's own.
  virtual TargetRun run(const TargetCase& now) = 0;
};

// Looks for the fields that say which coordinate a surface gets, by trying: a change of one moves one zero
// and no other.
class NominalFields {
public:
  explicit NominalFields(const std::vector<verify::DrawField>& fields) : fields_(fields) {}

  // Start points with no more places than the fields have.
  void roundStart(verify::Case& drawn) const;
  // The case with these fields changed so that no zero is missed. `misses`: by how much each is, in the order
  // of the program; nothing: the values are none. nullopt: no fields do that.
  std::optional<verify::Case>
  settle(verify::Case drawn,
         const std::function<std::optional<std::vector<double>>(const verify::Case&)>& misses);

private:
  const std::vector<verify::DrawField>& fields_;
  std::map<std::size_t, std::string> known_; // field by number of the zero
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
