// What a fragment owes the post and its operations, beside the blocks that it prints (docs/fusion.md,
// docs/verify.md).
#pragma once

#include "backends/fusion/Run.h"
#include "targets/Verification.h"

#include <map>
#include <string>
#include <string_view>

namespace dotek::targets {

// As a job file keeps numbers: in 32 bits.
inline double inJob(double value) {
  return static_cast<float>(value);
}

// The operation that gives the values of a case. `prefix`: of the fragment's names.
backends::fusion::RunInput operationOf(const verify::Case& drawn, const std::string& prefix);

// Operations that the fragment has to refuse or to leave alone. For one thread.
class OperationDemands {
public:
  // Both outlive it. `sameSet`: the source calls the same macros.
  OperationDemands(const VerificationSource& source, const backends::fusion::Fragment& fragment, bool sameSet)
      : from_(source), fragment_(fragment), sameSet_(sameSet) {}
  // The fragment has been loaded.
  void setPrefix(std::string prefix) { prefix_ = std::move(prefix); }

  // `result`: of the case itself, which asks questions.
  void check(const TargetCase& now, const backends::fusion::RunResult& result, TargetRun& out);
  // Not a check of the source: what the fragment looks at besides begins with the name of the cycle.
  bool isOfFragment(const std::string& error) const { return error.starts_with(from_.folder.name + ": "); }

private:
  void runElsewhere(const TargetCase& now, TargetRun& out);
  void compareChoice(const backends::fusion::RunResult& result, TargetRun& out) const;
  void compareDefinition(const verify::DrawField& field, const backends::fusion::RunResult& result,
                         TargetRun& out);
  void demandError(const TargetCase& now, const std::string& name, const backends::fusion::RunInput& input,
                   const std::string& why, TargetRun& out, std::string_view says = "");
  bool demandText(const backends::fusion::RunInput& input, double value, const std::string& what,
                  TargetRun& out);
  void demandTexts(backends::fusion::RunInput input, const std::string& property, double value,
                   const std::string& what, TargetRun& out);
  void runRejected(const TargetCase& now, TargetRun& out);
  void runWithoutSense(const TargetCase& now, TargetRun& out);
  void runBeside(const TargetCase& now, TargetRun& out);
  void runTooLarge(const TargetCase& now, TargetRun& out);
  void runWithoutBall(const TargetCase& now, TargetRun& out);
  void runWithout(const verify::DrawField& field, const TargetCase& now,
                  const backends::fusion::RunResult& result, TargetRun& out);
  bool uses(const TargetCase& now, const std::string& name);

  const VerificationSource& from_;
  const backends::fusion::Fragment& fragment_;
  const bool sameSet_;
  std::string prefix_;
  std::string right_;                // what it writes for the case at hand
  std::map<std::string, bool> uses_; // whether fields and host inputs are used; false may become true
};

} // namespace dotek::targets
