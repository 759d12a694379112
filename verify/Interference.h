// What the probe says against what is there: whether a program is caught by its own guards.
#pragma once

#include "verify/Record.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace dotek::verify {

// mm; what a control that counts in eight digits compares exactly.
inline constexpr double kStep = 0.001;

// Each by its number in the run, from 0. Searches are bare skip moves: those within a call are the macro's
// own.
struct Interference {
  std::optional<std::size_t> missing;    // this search finds nothing
  std::optional<std::size_t> missedCall; // no touch of this measuring call finds anything
  bool andLater = false;                 // neither does any search or call after that
  // This protected move, bare or of a macro whose probe is on, is stopped: `beforeEnd` mm from its end, or
  // half way where that is 0.
  std::optional<std::size_t> obstacle;
  double beforeEnd = 0;
  std::optional<std::size_t> touching; // this question finds contact
  // Every search ends on the control's step, and this one where it has gone so many mm. One that finds
  // nothing else goes to its end.
  struct Placed {
    std::size_t search = 0;
    double distance = 0;
  };
  std::optional<Placed> placed = {};
  // Two measurements of one surface that do not tell the same: from this search or call on each surface is
  // met that much earlier, or each time another one of three places; never before the ball has gone a little.
  struct Unlike {
    std::size_t from = 0;
    double by = 0;         // mm, above 0
    bool changing = false; // by 0, once and twice as much in turn
  };
  std::optional<Unlike> unlike = {};
};

// Pieces after the last stop, which the operator has read, that go straight up in feed. 0 where anything else
// comes after it.
std::size_t retractsAtEnd(const Record& record);

// Whether the run came to the interference and then ended with the alarm of this kind: nothing moved any
// more, but up after a stop, no datum was set, nothing recorded. "" or what it did instead; `at`: where.
std::string whyNotCaught(const Record& record, std::string_view alarmKind, SourceRange& at);

} // namespace dotek::verify
