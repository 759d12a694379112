// Faults that a programmer or a translator plants in a program of Macro B, by operators over its text.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::tests {

// What the operators have to know of a program.
struct FaultWords {
  std::set<std::string> radius;              // variables that hold the radius of the ball: "#520"
  std::set<std::string> probeOn;             // statements that switch the probe on, without blanks: "M31"
  std::set<std::uint32_t> measures, travels; // programs that measure, and that move protected
};

struct Fault {
  std::string kind;     // the operator's name
  std::size_t line = 0; // from 0
  std::string before;   // the line
  std::string after;    // what is there instead; "": the line is dropped; may be two lines

  // "change a sign in line 12: `X#24` becomes `X-#24`"
  std::string text() const;
};

// The operators' names, in a fixed order.
const std::vector<std::string_view>& faultKinds();
// All places of `program` where the operator fits; comments and `%` are left alone.
std::vector<Fault> faultsOf(std::string_view kind, std::string_view program, const FaultWords& words);
std::string withFault(std::string_view program, const Fault& fault);

} // namespace dotek::tests
