// Private to the verification of programs: one case as its files share it.
#pragma once

#include "backends/fanuc/TargetVerifyPrograms.h"

#include <cstdint>
#include <optional>
#include <string>

namespace dotek::targets {

// What a case comes to on the source's side.
struct ProgramRunner::Played {
  verify::Case drawn;
  std::optional<sim::Part> part;
  verify::Record record;
  std::string why; // the case is undecided; "" where it may agree
  SourceRange whyAt;
  bool rehearsed = false;     // nothing is measured: a run without a part, which meets nothing
  std::uint32_t rejected = 0; // proposals that the check at `whyAt` rejected
  std::string remedy;         // flags that give what it reads
};

} // namespace dotek::targets
