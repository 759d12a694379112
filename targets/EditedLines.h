// Where an edited translation is not the text that convert writes. What no case tells apart stays undecided:
// a comment is not run, and a limit may lie between two cases.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::targets {

struct EditedLine {
  std::uint32_t line = 0;     // from 1, of the edited text: the line, or that before which one is missing
  std::string now, converted; // without blanks at the ends; "": the text does not have it
  bool comment = false;       // neither side is more than a comment
};

// In the order of the text. Blanks outside of texts, another number of the program, comments that were added
// and, where none of them is left, comments that were taken out are no edits.
std::vector<EditedLine> editedLines(std::string_view converted, std::string_view edited);

} // namespace dotek::targets
