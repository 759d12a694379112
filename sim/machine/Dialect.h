// In what the machine that all controls share differs for the language of a control. The default is Macro B.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace dotek::sim {

struct Dialect {
  bool skipsAtOwnSpeed = false; // a skip move takes no feed, the control chooses its speed
  // false: faults of the control have texts alone, and what its profile does not list is not known to be one.
  bool numbersAlarms = true;
  char dwellLetter = 0;   // of the seconds of a dwell, beside P, X and U; 0: none
  bool holdsTool = false; // the length of the tool counts from its change on, without a code
  // The common variable of parameter 0, where programs call them parameters and write them to files.
  std::optional<std::uint32_t> firstParameter;
  std::uint32_t lastParameter = 0;       // the variables beyond it are what the control keeps for itself
  bool isLathe = false;                  // the trace has no Y that nothing moves
  bool showsDiameters = false;           // the control shows X twice as large as it is
  std::optional<int> wordDecimals;       // of its words, where the machine counts finer than those
  std::vector<std::uint32_t> startCodes; // G codes in force at the start, times ten, where not as usual
};

} // namespace dotek::sim
