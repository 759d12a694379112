// Codes of the machine's builder that switch the probe, given by the user for a control whose profile does
// not know them.
#pragma once

#include "stdlib/Control.h"

#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace dotek::stdlib {

// Texts as `--probe-on` takes them: "M31"; "": not given.
struct ProbeCodes {
  std::string on, off;

  auto operator<=>(const ProbeCodes&) const = default;
  bool any() const { return !on.empty() || !off.empty(); }
};

// What of `first` is not given, of `second`.
ProbeCodes merged(const ProbeCodes& first, const ProbeCodes& second);

// Letter and code times ten of "M31", "m31" or "G105"; nullopt: neither an M nor a G code.
std::optional<std::pair<char, std::uint32_t>> codeOf(std::string_view text);

// What the code already means on the control, as its table says it: "spindle orientation"; "": nothing, or
// that it switches the probe so.
std::string otherMeaning(const Control& control, std::string_view code, bool on);

// Adds the codes before those of the table, so that they are the ones that are written. One that has another
// meaning, or is no code, is left out.
void addProbeCodes(Control& control, const ProbeCodes& codes);

} // namespace dotek::stdlib
