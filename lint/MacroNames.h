// What the statements of GibbsCAM macros read and write, and the checks of a cycle.
#pragma once

#include "lint/Project.h"

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::lint {

struct NameUse {
  const gibbs::Name* name = nullptr;
  std::string key; // folded
  bool reads = false, writes = false;
  bool parameter = false; // a word that a command takes as such, no variable
};

// Names of all statements of a macro, in the order of the text. A word of a command that the table is not
// sure of reads and writes. Computed once a project.
const std::vector<NameUse>& namesOf(const gibbs::Macro& macro, const Project& project);
// What namesOf() keeps.
std::vector<NameUse> collectNames(const gibbs::Macro& macro, const Project& project);
// Names that an expression reads, folded.
std::set<std::string> readsOf(const gibbs::Expression& expression);

// The expression without blanks, folded.
std::string squeezed(const gibbs::Expression& expression, const Project& project);

// Macros of the folder: CycleData.mac, ToolPath.mac and those that they call.
std::vector<const gibbs::Macro*> macrosOf(const gibbs::Cycle& cycle);
// Folded names of DefineData.txt and of inputs.
std::set<std::string> fieldsOf(const gibbs::Cycle& cycle);
// Folded name of what the post prints for `field`: the first variable that --field or dotek.toml names for it
// and that is among `declared`, else the field.
std::string printedFor(const Project& project, const std::set<std::string>& declared,
                       const std::string& field);
// Variables of the macro that hold the radius of the tool, folded.
std::set<std::string> radiusNames(const gibbs::Macro& macro, const Project& project);
// Folded name of the command after a THEN, or of a statement of its own; "" for another statement.
std::string commandName(const gibbs::Statement& statement);
// IF with one comparison.
const gibbs::Comparison* onlyComparison(const gibbs::Statement& statement);
// One line with its statements, outer ones first.
void eachStatement(const gibbs::Macro& macro, const std::function<void(const gibbs::Statement&)>& visit);
// A number, maybe with a sign and brackets; nullopt: something else.
std::optional<double> plainNumber(const gibbs::Expression& expression);
// The variable that is alone, brackets aside; nullptr: something else.
const gibbs::Name* plainName(const gibbs::Expression& expression);
// v of ABS(v); nullptr: something else.
const gibbs::Name* absoluteOf(const gibbs::Expression& expression);

} // namespace dotek::lint
