// A cycle as a file of the cycle language.
#pragma once

#include "backends/common/EmittedLine.h"
#include "ir/Cycle.h"
#include "stdlib/Control.h"
#include "support/Diagnostics.h"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::backends::cycle {

// A value that the dialog of the source offers for a parameter, and what it says of it.
struct Choice {
  double value = 0;
  std::string title; // UTF-8
};

struct EmitOptions {
  // Of the language: a word that is no name, and the name that it proposes instead.
  std::function<bool(std::string_view)> isReserved;
  std::function<std::string(std::string_view)> proposeName;
  std::map<ir::VariableId, std::vector<Choice>> choices;
  std::set<ir::VariableId> fixed; // values that are put in: no parameters any more
  // Whose words the source writes: what it says with variables of that control has words in the language.
  // nullptr: none.
  const stdlib::Control* control = nullptr;
};

// What a parameter of the source is called in the cycle. Value in the cycle = value of the source + shift.
struct ParameterName {
  std::string name;
  double shift = 0;      // of a work offset that the source counts from 1: 53
  std::size_t names = 0; // of a choice: how many; 0: it is none
};

struct Emitted {
  std::string name;                                        // of the cycle
  std::vector<EmittedLine> lines;                          // each one statement; not laid out yet
  std::map<std::string, ParameterName> parameters;         // fields and host inputs, by the source's name
  std::vector<std::pair<std::string, std::uint32_t>> kept; // results, and the variables that the source
                                                           // leaves them in
};

// nullopt: it has no form in the language; reported at its lines.
std::optional<Emitted> emit(const ir::Cycle& cycle, const EmitOptions& options, Diagnostics& diagnostics);

} // namespace dotek::backends::cycle
