// Codes and ranges of codes as texts, and codes that a run may pass over.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

struct Control;

// Codes from `first` to `last`, code times ten: of "M41", "G54.1", "M100-M199", "M100-199". At most 1000.
struct CodeSpan {
  char letter = 0;
  std::uint32_t first = 0, last = 0;
};
std::optional<CodeSpan> codeSpan(std::string_view text);

// What `--auxiliary` leaves among the assumptions: M41 of `auxiliary=M41`.
std::vector<std::string> auxiliaryCodes(const std::set<std::string>& assumed);

// The first code of these that has a meaning on the control which nothing else may take: "M3 is spindle
// clockwise"; "": none.
std::string takenAuxiliary(const Control& control, const std::vector<std::string>& codes);

// These codes run on the control, change nothing and are printed; of a range those that nothing lists. Codes
// with another meaning keep it.
void addAuxiliary(Control& control, const std::vector<std::string>& codes);

} // namespace dotek::stdlib
