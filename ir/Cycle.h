// A module of the IR: cycles with their parameters, checks and body.
#pragma once

#include "ir/Statement.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace dotek::ir {

enum class Role : std::uint8_t {
  Parameter, // a field of the source's cycle
  Host,      // a host input (stdlib/HostInputs.h): what the CAM knew
  Local,     // a variable of the source's macro, or made by lowering
};

struct Variable {
  std::string name; // as the source spells it, UTF-8; of a host its name in the table
  Kind kind = Kind::Number;
  Role role = Role::Local;
  bool optional = false; // the caller may leave it out; without a default a parameter is null then
  std::optional<double> defaultValue; // of a parameter
  std::string defaultDigits;          // as the source writes it
  std::string unit;                   // as the dialog says: "mm"; "" for none
  std::string meaning;                // label of the dialog, UTF-8
  SourceRange range;                  // of the declaration
};

struct LabelName {
  std::string name; // of the source, or made up; unique in the cycle
  SourceRange range;
};

struct Cycle {
  std::string name;
  std::string title; // of the source's dialog, "" for none
  std::vector<Variable> variables;
  std::vector<LabelName> labels;
  // Run first, on the arguments: ends in an Alarm or falls off its end. No motion.
  std::vector<CycleStatement> checks;
  std::vector<CycleStatement> body;
  // The source says what is measured and which offset is set (a branch of a Prog); else only a path is known.
  bool measurementStated = true;
  SourceRange range;

  VariableId add(Variable variable);
  // A name that is taken gets a number: "next", "next_2".
  LabelId addLabel(LabelName label);
  const Variable& variable(VariableId id) const { return variables[id]; }

  // Of addLabel() alone: names that are taken, with the number to try next; how many labels they cover.
  std::unordered_map<std::string, std::uint32_t> labelNames;
  std::size_t labelsSeen = 0;
};

enum class LengthUnit : std::uint8_t { Millimetre, Inch };

struct Module {
  LengthUnit sourceUnit = LengthUnit::Millimetre; // values are mm whatever it is
  std::vector<Cycle> cycles;
};

} // namespace dotek::ir
