// The text that a source prints for its blocks, beside the statements that it means: for targets that print
// it again, field by field. The back ends of controls do not need it.
#pragma once

#include "ir/Expression.h"
#include "support/Picture.h"

#include <optional>
#include <string>
#include <vector>

namespace dotek::ir {

// Text, or a variable with the picture that prints it.
struct PrintedPiece {
  std::string text;               // UTF-8; of a variable ""
  VariableId variable = 0;        // where `picture` is given
  std::optional<Picture> picture; // nothing: a text
  std::string name;               // of a variable, for messages: "the field `D`"
  SourceRange range;
};

// One block. Its statements are those whose Origin::block is its place in the list, counted from 1.
struct PrintedBlock {
  bool numbered = false; // an N number is before it; `pieces` hold it not
  std::vector<PrintedPiece> pieces;
  SourceRange range;
};

} // namespace dotek::ir
