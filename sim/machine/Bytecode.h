// Macro programs in the form in which they run: instructions over one array of cells (Cells.h). After the
// cells of the variables are those of intermediate values, then the constants.
#pragma once

#include "ir/Program.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace dotek::sim {

// Operands a and b are cells, c is the cell of the result or the place of a jump, where nothing else is said.
// Arithmetic and comparisons read null as 0, but for Copy and the words of blocks.
enum class Op : std::uint8_t {
  Copy,   // null stays null
  Number, // null becomes 0
  Add,
  Subtract,
  Multiply,
  Divide,
  Sine,
  Cosine,
  SquareRoot,
  Unary,       // detail: ir::UnaryOp
  Binary,      // detail: ir::BinaryOp
  NegateGiven, // of a word `X-#1`: null has no meaning there
  ToIncrement, // ROUND after an address; detail: the letter
  Read,        // a: number of a system variable; detail: kHazard
  ReadAt,      // a: cell of the number
  Write,       // a: number of a system variable; b
  WriteAt,     // a: cell of the number; b
  JumpLess,    // to c
  JumpGreater,
  JumpLessEqual,
  JumpGreaterEqual,
  JumpSame, // null is a value of its own
  JumpDifferent,
  JumpTrue,  // a is not 0
  JumpFalse, // a is 0
  Test,      // c becomes 1 or 0; detail: ir::Relation, or kIsNull
  And,
  Or,
  Not,
  Jump,       // to c
  JumpTo,     // a: cell of an N number
  SkipDelete, // to c where the switch `detail` of block delete is on
  Sequence,   // a: the N number
  Block,      // a: index in blocks
  Call,       // a: index in calls
  Exit,       // a: cell of the N number in the caller; kNoCell: none
  Raise,      // a: cell; b: index in texts
  Notice,     // b: index in texts
  OpenPort,   // detail: 1 POPEN, 0 PCLOS
  Print,      // a: index in prints
  Name,       // a: index in names
  Refuse,     // b: index in texts: why the run is inconclusive here
  End,        // of the program's text
  // What macro B does not have (RunDialect.cpp); b: index in texts, why the run ends.
  Given,      // a: cell; a value that nobody has set ends the run as inconclusive
  Absolute,   // incremental mode ends the run as inconclusive
  Place,      // c becomes the position along axis `detail`, of the active system
  JumpSignal, // to c where the probe's signal is there; no signal ends the run as inconclusive
  JumpMissed, // to c where the last skip move met nothing; one that began in contact ends the run, as above
  CallPlace,  // subprogram of the same text at c
  LeavePlace, // back to after its call; a fault of the control where there is none
  Pause,      // b: index in texts of what the operator reads
  Record,     // a: cell of the value, kNoCell: the position; b: index in texts of the file
  Fault,      // the control stops
  CountBlock, // a block of the text that has no words for the machine
  Act,        // a: index in actions
  Round,      // a jump back comes; with the machine as it was in an earlier round the run ends
};

inline constexpr std::uint8_t kHazard = 1;   // a position, or the window of the PMC
inline constexpr std::uint8_t kIsNull = 255; // of Test
inline constexpr std::uint32_t kNoCell = UINT32_MAX;
inline constexpr std::uint32_t kTemporaries = 256;

struct Instruction {
  Op op = Op::End;
  std::uint8_t detail = 0;
  std::uint32_t a = 0, b = 0, c = 0;
};

struct WordSlot {
  char letter = 0;
  bool computed = false; // counts as written with a point
  bool point = false;    // of one that is not: it has a point
  std::uint8_t places = 0;
  std::uint32_t cell = 0;
};
struct BlockSlots {
  std::uint32_t firstWord = 0, words = 0;
  std::uint64_t line = 0;
  bool mayCall = false;   // a code that calls a program, or a computed one
  bool mayStop = false;   // a code that ends reading ahead, or a computed one
  bool positions = false; // its skip move is meant to meet nothing
};
struct ArgumentSlot {
  std::uint32_t local = 0, cell = 0;
  bool bare = false; // counts least increments
};
struct CallSlots {
  ir::CallKind kind = ir::CallKind::Macro;
  std::uint32_t program = kNoCell, repeats = kNoCell;
  std::uint32_t firstArgument = 0, arguments = 0;
};

struct NumberedPlace {
  std::uint64_t number = 0;
  std::uint32_t place = 0; // of the instruction
  std::uint32_t loop = 0;
};
struct Routine {
  std::uint64_t number = 0;         // O; 0: a name, or none
  std::uint32_t begin = 0, end = 0; // places
  const ir::Program* program = nullptr;
  std::vector<NumberedPlace> labels; // by number, then by place
};

class Machine;
// What a dialect does by itself, with the cells. false: the run has ended.
using Action = std::function<bool(Machine& machine, double* cells)>;

struct Bytecode {
  std::vector<Instruction> instructions;
  // Of each instruction: its statement in the body, its line, and the innermost loop around it, 0 for none.
  std::vector<std::uint32_t> statements, lines, loops;
  std::vector<std::uint32_t> outerLoops; // by loop
  std::vector<double> constants;
  std::vector<BlockSlots> blocks;
  std::vector<WordSlot> words;
  std::vector<CallSlots> calls;
  std::vector<ArgumentSlot> arguments;
  std::vector<std::string> texts;
  std::vector<Action> actions;
  std::vector<const ir::Print*> prints;
  std::vector<const ir::NameVariables*> names;
  std::vector<Routine> routines; // in the order of the programs; the first is the main one
  std::vector<std::uint32_t>
      byNumber; // indexes of routines with a number, rising; of one number the first given

  const Routine* find(std::uint64_t number) const; // nullptr: there is none
  const Routine& routineOf(std::uint32_t place) const;
  const ir::ProgramStatement& statementOf(std::uint32_t place) const;
  // Where a search from `place` meets the block: forward, then from the first block. nullptr: there is none.
  const NumberedPlace* search(const Routine& routine, std::uint32_t place, std::uint64_t number) const;
  // A jump from a place within loop `from` to one within loop `to` stays within or leaves; it enters none.
  bool entersLoop(std::uint32_t from, std::uint32_t to) const;
};

} // namespace dotek::sim
