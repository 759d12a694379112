#include "targets/Target.h"

#include "support/messages/CamFolder.h"
#include "support/messages/Commands.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Fusion.h"
#include "support/messages/Mikroprog.h"
#include "targets/Conversion.h"

#include <algorithm>
#include <filesystem>

namespace dotek::targets {

namespace {

struct Given {
  TargetFlag flag;
  bool given;
  std::string_view name;
};

void refuse(const Target& target, const std::string& to, std::span<const Given> flags,
            Diagnostics& diagnostics) {
  for (const Given& one : flags) {
    const bool taken = std::find(target.flags.begin(), target.flags.end(), one.flag) != target.flags.end();
    if (!one.given || taken) continue;
    if (one.flag == TargetFlag::WholePost)
      diagnostics.report<diag::WholePostOfControl>({});
    else if (target.refuseFlag != nullptr)
      target.refuseFlag(one.name, diagnostics);
    else
      diagnostics.report<diag::FlagOfOtherTarget>({}, one.name, to);
  }
}

void checkDatum(const Target& target, const std::string& to, const std::string& datum,
                Diagnostics& diagnostics) {
  if (datum.empty()) return;
  if (target.checkDatum != nullptr)
    target.checkDatum(datum, diagnostics);
  else
    diagnostics.report<diag::FlagOfOtherTarget>({}, "--datum", to);
}

} // namespace

const Target* findTarget(std::string_view name) {
  const std::span<const NamedTarget> all = allTargets();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const NamedTarget& one) { return one.name == name; });
  return found == all.end() ? nullptr : found->target;
}

std::string targetNames() {
  std::string out;
  const std::span<const NamedTarget> all = allTargets();
  for (std::size_t i = 0; i < all.size(); ++i)
    out.append(i == 0 ? "" : i + 1 == all.size() ? " or " : ", ").append(all[i].name);
  return out;
}

std::string_view callsText(Calls calls) {
  constexpr std::string_view kTexts[] = {"inline", "subprogram", "vendor"};
  return kTexts[static_cast<std::size_t>(calls)];
}

void checkTargetOptions(const Target& target, const ConvertOptions& options, Diagnostics& diagnostics) {
  const Given flags[] = {{TargetFlag::Arg, !options.letters.empty(), "--arg"},
                         {TargetFlag::ProgramNumber, options.programNumber.has_value(), "--program-number"},
                         {TargetFlag::ProbeMacros, options.probeMacros.has_value(), "--probe-macros"},
                         {TargetFlag::DefaultsUse, options.useDefaults, "--defaults use"},
                         {TargetFlag::ProbePower, options.switchProbe, "--probe-power macro"},
                         {TargetFlag::WholePost, options.wholePost, "--whole-post"},
                         {TargetFlag::Helpers, options.helpersApart, "--helpers"},
                         {TargetFlag::Variables, !options.variables.empty(), "--var"},
                         {TargetFlag::Result, !options.results.empty(), "--result"},
                         {TargetFlag::Calls, options.calls != Calls::Inline, "--calls"}};
  refuse(target, options.to, flags, diagnostics);
  checkDatum(target, options.to, options.datum, diagnostics);
  if (target.checkConvert != nullptr) target.checkConvert(options, diagnostics);
}

const Target* checkedTarget(const ConvertOptions& options, bool programs, bool cycles,
                            std::string_view command, std::string_view use, Diagnostics& diagnostics) {
  const Target* const target = findTarget(options.to);
  if (options.to.empty())
    diagnostics.report<diag::MissingOption>({}, command, "--to TARGET", use);
  else if (target == nullptr)
    diagnostics.report<diag::UnknownTarget>({}, options.to);
  else
    checkTargetOptions(*target, options, diagnostics);
  refuseOptions(options, programs, cycles, diagnostics);
  if (programs && target != nullptr && target->programs == nullptr && !target->writesPrograms)
    diagnostics.report<diag::ProgramTarget>({}, options.to);
  return target;
}

void checkTargetOptions(const Target& target, const VerifyOptions& options, Diagnostics& diagnostics) {
  if (!target.takesPathAlone && !options.source.prog)
    diagnostics.report<diag::MissingOption>(
        {}, "verify", "--prog PROG.txt", "a drawn path states no measurement that such a program could make");
  const Given flags[] = {{TargetFlag::Arg, !options.letters.empty(), "--arg"},
                         {TargetFlag::ProgramNumber, options.programNumber.has_value(), "--program-number"},
                         {TargetFlag::ProbeMacros, options.probeMacros.has_value(), "--probe-macros"},
                         {TargetFlag::DefaultsUse, options.useDefaults, "--defaults use"},
                         {TargetFlag::ProbePower, options.switchProbe, "--probe-power macro"},
                         {TargetFlag::Result, !options.results.empty(), "--result"},
                         {TargetFlag::Calls, options.calls != Calls::Inline, "--calls"}};
  refuse(target, options.to, flags, diagnostics);
  checkDatum(target, options.to, options.datum, diagnostics);
}

} // namespace dotek::targets
