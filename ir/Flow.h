// Control flow of a statement list.
#pragma once

#include "ir/Cycle.h"
#include "ir/Program.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <vector>

namespace dotek::ir {

// The one or two places that a statement leads to.
class Next {
public:
  Next() = default;
  Next(std::initializer_list<std::size_t> places) {
    for (const std::size_t place : places)
      add(place);
  }
  // A place that is there already stays the only one.
  void add(std::size_t place) {
    if (std::find(begin(), end(), place) == end()) places_[size_++] = place;
  }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const std::size_t* begin() const { return places_.data(); }
  const std::size_t* end() const { return places_.data() + size_; }
  std::size_t operator[](std::size_t at) const { return places_[at]; }
  bool operator==(const Next&) const = default;

private:
  std::array<std::size_t, 2> places_{};
  std::size_t size_ = 0;
};

// Where the statements of a program lead. What a computed jump may lead to is kept once for all of them: a
// program of nothing else would have as many places as the square of its length.
struct ProgramFlow {
  std::vector<Next> next;          // as successors() says; of a computed jump without its labels
  std::vector<std::size_t> labels; // where each computed jump leads, ascending; empty: there is none
};

// Indices of the statements that may follow each statement of a cycle; `list.size()` is the end. Return, Exit
// and a block that ends the program go to the end, Alarm and Raise to none.
std::vector<std::vector<std::size_t>> successors(const std::vector<CycleStatement>& list);
// The same with less memory, of a program with its computed jumps.
ProgramFlow flowOf(const std::vector<CycleStatement>& list);
ProgramFlow flowOf(const std::vector<ProgramStatement>& list);
// A jump to whatever label has the number that is computed as the program runs.
bool isComputedJump(const CycleStatement& statement);
bool isComputedJump(const ProgramStatement& statement);
// M30 or M2 that is written out, the same on every control; no cycle has them.
bool endsProgram(const CycleStatement& statement);
bool endsProgram(const ProgramStatement& statement);
// The label that a Jump or a Branch goes to; nothing: another statement, or a computed jump.
std::optional<LabelId> targetOf(const CycleStatement& statement);
std::optional<LabelId> targetOf(const ProgramStatement& statement);
// A Label or a Comment: nothing is carried out there.
bool isLayout(const CycleStatement& statement);
bool isLayout(const ProgramStatement& statement);
std::vector<bool> reachable(const std::vector<CycleStatement>& list);
std::vector<bool> reachable(const std::vector<ProgramStatement>& list);
// `flow` is that of the list.
std::vector<bool> reachable(const std::vector<ProgramStatement>& list, const ProgramFlow& flow);
// From which places a run may come to one of `goals`, these included; both have the end as their last place.
// Computed jumps are taken to lead nowhere.
std::vector<bool> leadingTo(std::vector<bool> goals, const ProgramFlow& flow);

} // namespace dotek::ir
