// A language that Dotek writes: what it takes, how its programs are written, run and compared.
#pragma once

#include "support/Diagnostics.h"
#include "targets/Options.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace dotek::targets {

class Conversion;
class ProgramSubject;
class Verification;
struct ConversionContext;
struct VerificationSource;
struct VerifyPlan;

// Flags that some targets take and others do not.
enum class TargetFlag : std::uint8_t {
  Arg,
  ProgramNumber,
  ProbeMacros,
  DefaultsUse,
  ProbePower,
  WholePost,
  Helpers,
  Result,
  Calls,
  Variables
};

struct Target {
  std::string_view text; // what `list targets` says of it
  std::span<const TargetFlag> flags = {};
  // Reports a flag that it does not take; nullptr: FlagOfOtherTarget. WholePost and `--datum` have messages
  // of their own.
  void (*refuseFlag)(std::string_view flag, Diagnostics& diagnostics) = nullptr;
  // Reports an unknown value of `--datum`; nullptr: it takes none.
  void (*checkDatum)(const std::string& datum, Diagnostics& diagnostics) = nullptr;
  // Reports what else is missing on the command line of convert; nullptr: nothing is.
  void (*checkConvert)(const ConvertOptions& options, Diagnostics& diagnostics) = nullptr;

  bool ownControls = false;   // `--control` names none of controls/, which the source is read under
  bool controlOfForm = false; // `--control` may only repeat the control of the form
  // Its programs take no values when they run. Each is written with those that the command line, the job's
  // operation and the defaults give, and verify writes one for each case.
  bool fixesValues = false;
  bool takesPathAlone = false;  // verify takes a cycle without a Prog: its path alone
  bool takesCycleFiles = false; // convert takes files of the cycle language
  bool writesFolder = false;    // several files for each cycle; the last has the blocks
  bool writesPrograms = false;  // convert takes programs of macro B, although verify does not
  // Where it fixes values: host inputs that every program needs.
  std::span<const std::string_view> hosts = {};

  std::unique_ptr<Conversion> (*convert)(ConversionContext& context) = nullptr;
  std::unique_ptr<Verification> (*verify)(const VerificationSource& source) = nullptr;
  // Where inputs may be programs of macro B, too: one beside its translation. nullptr: it takes none.
  std::unique_ptr<ProgramSubject> (*programs)(const VerifyOptions& options, const VerifyPlan& plan) = nullptr;
};

struct NamedTarget {
  std::string_view name;
  const Target* target = nullptr;
};

std::string_view callsText(Calls calls); // as --calls names it
// All targets, sorted by name.
std::span<const NamedTarget> allTargets();
const Target* findTarget(std::string_view name); // nullptr: there is none
// "fanuc, fusion or mikroprog"
std::string targetNames();

// Report flags that `target`, which the options name, does not take, and values that it does not know.
void checkTargetOptions(const Target& target, const ConvertOptions& options, Diagnostics& diagnostics);
// The target of a conversion of cycles, of programs or of both; what it does not take, and what none of the
// inputs does, is reported. nullptr: there is none, reported. `use`: what --to is to `command`.
const Target* checkedTarget(const ConvertOptions& options, bool programs, bool cycles,
                            std::string_view command, std::string_view use, Diagnostics& diagnostics);
void checkTargetOptions(const Target& target, const VerifyOptions& options, Diagnostics& diagnostics);

} // namespace dotek::targets

// Defines the target of a folder.
#define DOTEK_TARGET(name)                                                                                   \
  extern const ::dotek::targets::Target name;                                                                \
  const ::dotek::targets::Target name
