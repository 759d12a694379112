// The folder of a custom drill cycle as one unit. Nothing here opens a file: the caller parses what exists.
#pragma once

#include "frontend/gibbs/Labels.h"
#include "frontend/gibbs/Parse.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::frontend::gibbs {

struct Cycle {
  std::string name;   // of the folder
  std::string folder; // as messages print it
  std::optional<DefineData> defineData;
  std::optional<Dialog> dialog; // CycleData.dlg
  std::optional<Macro> cycleData;
  std::optional<Macro> toolPath;
  // Macros that #INCLUDE and CALL bring in, and dialogs beside CycleData.dlg, as far as they were found.
  // They outlive the cycle.
  std::vector<const Macro*> others;
  std::vector<const Dialog*> otherDialogs;
  // Names of all files in the folder, upper case; empty where they are not known.
  std::set<std::string> files;
};

// Findings that need more than one file: variables that nothing sets, dialog inputs and fields that do not
// meet, a dialog that is not there.
void checkCycle(const Cycle& cycle, const ParseContext& context);

// A value that the cycle keeps for the operation, and that the post reads by name.
struct Field {
  Name name;                   // as written where it is declared
  std::optional<double> value; // nothing: the first value is no plain number
  SourceRange valueRange;
  bool fromDialog = false;         // DefineData.txt lacks it: the dialog's input gives the default
  std::optional<InputLabel> label; // of the first input that writes the field
  // Reading that the way the value is written asks for (`exponent`, `bare-fraction`); "" for none.
  std::string_view assumption = {};
};

// Definitions of DefineData.txt in their order, then dialog inputs with a constant default that it lacks.
// The cycle outlives the result.
std::vector<Field> declaredFields(const Cycle& cycle);

} // namespace dotek::frontend::gibbs
