#include "driver/VerifyTargets.h"

#include "support/messages/Mikroprog.h"

namespace dotek::driver {

void TargetRun::differs(verify::Aspect aspect, std::string text, std::string line) {
  TargetDifference& one = differences.emplace_back();
  one.difference.aspect = aspect;
  one.difference.text = std::move(text);
  one.line = std::move(line);
}

std::unique_ptr<VerifyTarget> verifyTarget(const TargetSource& source) {
  if (source.options.to == "fusion") return fusionTarget(source);
  if (source.options.to == "mikroprog") return mikroprogTarget(source);
  return nullptr;
}

bool checkTargetOptions(const VerifyOptions& options, Diagnostics& diagnostics) {
  const auto none = [&](bool given, std::string_view flag) {
    if (given) diagnostics.report<diag::FlagOfOtherTarget>({}, flag, options.to);
  };
  if (options.to == "mikroprog") {
    none(options.probeMacros.has_value(), "--probe-macros");
    if (!options.datum.empty() && options.datum != "g92" && options.datum != "operator")
      diagnostics.report<diag::UnknownDatum>({}, options.datum);
  } else if (!options.to.empty()) {
    none(!options.datum.empty(), "--datum");
  }
  return !diagnostics.hasErrors();
}

} // namespace dotek::driver
