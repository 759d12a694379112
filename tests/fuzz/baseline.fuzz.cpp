// Any bytes as a list of findings that are passed over: read, or refused with a reason.
#include "lint/Baseline.h"

#include <cstdint>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dotek;
  std::string reason;
  auto baseline = lint::Baseline::read(std::string_view(reinterpret_cast<const char*>(data), size), reason);
  if (!baseline) {
    if (reason.empty()) std::abort();
    return 0;
  }
  SourceMap sources;
  Diagnostics findings;
  const auto all = [](const std::string&, const std::string&) { return true; };
  const std::size_t gone = baseline->gone(all);
  baseline->passOver(findings, sources);
  if (baseline->passedOver() != 0 || baseline->gone(all) != gone) std::abort();
  return 0;
}
