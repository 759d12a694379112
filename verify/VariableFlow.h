// Which variables of programs of macro B get their values from which others, by copies, sums, and arguments
// of calls within the file.
#pragma once

#include "ir/Program.h"
#include "stdlib/Control.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

namespace dotek::verify {

// A local of one program of the file, or a common variable (program kNoProgram).
struct VariableKey {
  static constexpr std::size_t kNoProgram = SIZE_MAX;
  std::size_t program = kNoProgram; // index in the file
  std::uint32_t number = 0;
  auto operator<=>(const VariableKey&) const = default;
};

// What an expression is made of: variables that it names and its constants, which numbers of variables are
// not.
struct Operands {
  std::set<std::uint32_t> variables;
  std::set<double> constants;
};
Operands operandsOf(const ir::ExpressionPtr& expression);
Operands operandsOf(const ir::ConditionPtr& condition);

class VariableFlow {
public:
  // Both outlive it.
  VariableFlow(const ir::ProgramFile& file, const stdlib::Control& control);

  VariableKey key(std::size_t program, std::uint32_t number) const;
  // What a variable may be computed from, itself included, whatever runs first.
  std::set<VariableKey> sourcesOf(const VariableKey& key) const;
  // Variables whose value it is, unchanged or rounded: (copy, original).
  const std::set<std::pair<VariableKey, VariableKey>>& copies() const { return copies_; }
  // The expression with the constants and variables that its locals are computed from.
  Operands expanded(std::size_t program, const ir::ExpressionPtr& expression) const;
  // What the check reads that ends at the #3000 of this place: the conditions of the branches that lead
  // there. Empty: no #3000 of the file, or nothing leads there but the beginning.
  std::set<VariableKey> readByCheck(SourceRange raise) const;

private:
  void take(std::size_t program, const ir::ProgramStatement& statement);
  void takeCall(std::size_t program, const ir::Call& call);

  const ir::ProgramFile& file_;
  const stdlib::Control& control_;
  std::map<VariableKey, std::set<VariableKey>> from_;
  std::map<VariableKey, std::set<double>> constants_; // that are stored with it
  std::set<std::pair<VariableKey, VariableKey>> copies_;
};

} // namespace dotek::verify
