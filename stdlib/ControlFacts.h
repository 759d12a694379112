// What a control's files say, fact by fact: for lists.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

class DataFiles;

struct ControlFact {
  std::string section; // "words", "codes"
  std::string key;     // "decimals", "G90", "#100-#199"
  std::string text;    // the value, or the title of a code
  std::string grade, source;
  std::string file;                  // "built in: fanuc-31i-b", or the path
  std::uint32_t first = 0, last = 0; // of ranges of variables
};

// The facts of the control of this name, section by section in the order of the files, each as the nearest
// file has it. Empty: there is no such control. Throws DataError where a file has a defect.
std::vector<ControlFact> controlFacts(const DataFiles& files, std::string_view name);

} // namespace dotek::stdlib
