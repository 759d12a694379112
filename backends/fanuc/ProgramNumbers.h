// N numbers of the result: kept, renumbered, or new. Private to Program*.cpp.
#pragma once

#include "backends/fanuc/ProgramChecks.h"

#include <map>
#include <set>
#include <string>

namespace dotek::backends::fanuc {

// Where M99 P of the programs of a file leads, found once for all of them.
struct FileExits {
  explicit FileExits(const ir::ProgramFile& file);

  std::set<std::uint64_t> numbers;
  SourceRange computed; // of the first whose number is computed; no place: there is none
};

class ProgramNumbers {
public:
  // Reports what cannot be renumbered, and jumps whose number would lead elsewhere.
  // `exits` are those of the file. What is passed outlives this.
  ProgramNumbers(const ir::ProgramFile& file, const FileExits& exits, const ir::Program& program,
                 const ProgramContext& context);

  // Digits after the N of a block; "": the label has no number.
  std::string digits(ir::LabelId label) const;
  // After GOTO: the same without leading zeros.
  std::string target(ir::LabelId label) const;
  // Gives a number that nothing in the file names to a label that has none. `from`: what jumps there. Reports
  // where a computed number might meet it, or none is left.
  void add(ir::LabelId label, SourceRange from);
  // P of M99, renumbered with the block of the caller.
  ir::ExpressionPtr exitTo(const ir::Exit& exit, SourceRange range);

private:
  // Of programs in the file that call this one.
  struct Callers {
    std::vector<std::map<std::uint64_t, std::uint64_t>> numbers; // before and after, of each
    bool open;                                                   // a call whose program is computed
  };

  void renumber();
  void findCallers();
  void checkJumps();
  const ir::Program* onlyProgram(std::uint64_t number) const;

  const ir::ProgramFile& file_;
  const FileExits& exits_;
  const ir::Program& program_;
  const ProgramContext& context_;
  std::map<ir::LabelId, std::string> digits_;
  std::set<std::uint64_t> used_; // by the program itself
  std::optional<Callers> callers_;
  SourceRange computed_; // of a GOTO or M99 P whose number is computed
};

// The labels of `program` with their numbers as renumbered; those without stay out.
std::map<ir::LabelId, std::uint64_t> renumbered(const ir::Program& program, std::uint64_t start,
                                                std::uint64_t step);

} // namespace dotek::backends::fanuc
