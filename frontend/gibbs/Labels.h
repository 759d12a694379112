// What the user reads beside the inputs of a dialog.
#pragma once

#include "frontend/gibbs/Ast.h"

#include <string>
#include <vector>

namespace dotek::frontend::gibbs {

// An input is INPUT, CHECK, RADIO or DROPDOWN_NEW with a variable. Its name is the label that overlaps its
// rows, begins left of it and begins nearest to it; on a tie the greatest overlap of rows. Its meaning is
// the nearest label that begins at or right of its right edge, overlaps its rows (same tie rule) and is the
// name of no input. Rows are [top, top + height) of closedBox().
struct InputLabel {
  const Control* input = nullptr; // of the dialog; never null
  Name variable;
  std::string name;      // bytes, without blanks and unit: "K A [mm]" gives "KA"; "" where no label is found
  std::string unit;      // between square brackets at the end of the label: "mm"
  std::string meaning;   // bytes, without blanks at the ends
  SourceRange nameRange; // of the label's text; no place where there is none
  SourceRange meaningRange;
};

// The place of a control as the dialog opens. The height of a DROPDOWN_NEW is that of the opened list; closed
// it is as high as the lowest INPUT of the dialog.
Box closedBox(const Dialog& dialog, const Control& control);

// One entry for each input with a variable, in the order of the file. The dialog outlives the result.
std::vector<InputLabel> inputLabels(const Dialog& dialog);

} // namespace dotek::frontend::gibbs
