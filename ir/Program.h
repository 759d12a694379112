// A program of a control at the altitude of NC blocks: the flat statement list that Macro B lowers to. Order,
// N numbers and comments of the text are kept; structure is an analysis beside the jumps (Structure.h).
#pragma once

#include "ir/Statement.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dotek::ir {

// A place that something jumps to, or a block that has an N number. LabelId is the index.
struct ProgramLabel {
  std::uint64_t number = 0; // N; 0: made up, no GOTO of the text names it
  std::string digits;       // as written: "0100"
  SourceRange range;
};

// All variables are MachineVariables, locals too; any of them may be null. Arithmetic reads null as 0 through
// NullAsZero, conditions compare it by Same and Different. Nothing raises a call to a Measure, a Move or a
// ProbePower yet, and what reads programs refuses these three.
//
// Each block of the text becomes one run of statements with the same Origin::block, from 1 and rising; a
// block without statements (a number alone) is its Label. IF [c] THEN s is a Branch by the opposite of c to a
// label without number right after s, all in one block.
struct Program {
  enum class NameKind : std::uint8_t { None, Number, Colon, Name }; // blocks before any header, O12, :12, <N>
  NameKind nameKind = NameKind::None;
  std::uint64_t number = 0;               // 0 of a name
  std::string name;                       // digits as written, or the name
  std::vector<std::string> titleComments; // on the line of the header; bytes of the source
  std::vector<ProgramLabel> labels;
  std::vector<ProgramStatement> body;
  SourceRange range; // of the header, or of the first block

  LabelId addLabel(ProgramLabel label);
};

// The file of the programs: what is around them.
struct ProgramFile {
  bool markFirst = false; // `%`
  bool markLast = false;
  std::vector<Program> programs;
};

} // namespace dotek::ir
