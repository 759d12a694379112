// What the variables of one program hold of the length of the tool before each of its statements, and what it
// passes to programs that it calls. ToolLength.h judges by it.
#pragma once

#include "lint/HeldLength.h"
#include "lint/LengthNumbers.h"
#include "lint/NcProgram.h"
#include "lint/OffsetStates.h"

#include <map>
#include <set>
#include <vector>

namespace dotek::lint {

// Variables with what they hold, by number.
using Values = std::vector<std::pair<std::uint32_t, Held>>;

// A call of a program of the files with a position that holds the length among what it gets.
struct Passing {
  std::uint32_t callee = 0;
  Offset offset = Offset::AsBefore;
  Values values;
};

// What programs of the files, each number once, leave in the variables that they set.
using LeftBehind = std::map<std::uint32_t, Values>;

class LengthFacts {
public:
  LengthFacts(const NcProgram& nc, const LengthNumbers& numbers, const std::set<std::uint32_t>& switching,
              std::optional<CalledUnder> called, const LeftBehind* left)
      : nc_(nc), program_(nc.program), project_(nc.project), numbers_(numbers), switching_(switching),
        called_(called), left_(left) {}

  // Calls of `own` programs that pass a position.
  std::vector<Passing> passings(const std::set<std::uint32_t>& own);
  // Variables below the system's that it may set.
  std::set<std::uint32_t> stored() const;
  // What the variables of `stored` hold where it returns, as far as that does not come from its caller.
  Values leftBehind(const std::set<std::uint32_t>& stored) const;
  // An entry of the table of tools gets a new value: the length of a tool that has none in force. What is
  // added to the old one corrects it, by a contact under an offset as any other.
  bool measuresTool() const;

protected:
  Fact entryFact() const;
  std::vector<std::optional<Fact>> factsFrom(const Fact& entry) const;
  // A macro gets its arguments and the common variables, a subprogram the locals as well.
  Values passedBy(const ir::Call& call, const Fact& fact) const;
  bool readsPosition() const;
  bool readsLength() const;
  // One that it calls leaves a position in a variable.
  bool getsPosition() const;
  bool reads(const std::set<std::uint32_t>& numbers) const;
  bool isToolOffset(const std::optional<std::uint32_t>& number, const ir::ExpressionPtr& computed) const;
  // It reads an entry of the table of tools, or a variable that one was kept in.
  bool readsToolOffset(const ir::ExpressionPtr& value, const std::set<std::uint32_t>& kept) const;
  Held variable(const ir::Expression& expression, const Fact& fact) const;
  // The first variable of a table of zero points: #[5203+..].
  bool zeroTable(std::uint32_t first) const;
  Held held(const ir::ExpressionPtr& value, const Fact& fact) const;
  void step(const ir::ProgramStatement& statement, Fact& fact) const;
  // `#[100+#9]=#[5060+#9]`: what those of the range get that hold a position then.
  Values copiedBeside(const ir::Store& store, const NumberRange& range, const Fact& fact) const;
  // What is written by a computed number may have set any variable of the range.
  static void lose(const std::optional<NumberRange>& range, Fact& fact);

  const NcProgram& nc_;
  const ir::Program& program_;
  const Project& project_;
  const LengthNumbers& numbers_;
  const std::set<std::uint32_t>& switching_;
  std::optional<CalledUnder> called_; // by programs of the files
  const LeftBehind* left_;            // by programs that it calls; nullptr: nothing is known
};

} // namespace dotek::lint
