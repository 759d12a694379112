// Kinds of values with their dimension, and the names of a cycle with theirs.
#pragma once

#include "frontend/cycle/Ast.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::frontend::cycle {

struct Quantity {
  enum class Base : std::uint8_t {
    Unknown, // of a broken part, or of a name that was reported: fits everything
    Zero,    // a bare 0: of any kind
    Number,  // counts and ratios
    Length,
    Angle,
    Feed,
    Time,
    Flag,
    Text,
    Choice,
    WorkOffset,
    ToolOffset
  };
  Base base = Base::Unknown;
  int power = 1;                              // of a length: 2 is an area
  const std::vector<Name>* choices = nullptr; // of Choice; nullptr: of the others

  bool fits(const Quantity& other) const;
  bool isNumeric() const;
};
// "a length", "an angle", "a number without unit".
std::string quantityText(const Quantity& quantity);
// "mm", "deg"; "" for those that have none.
std::string_view unitFor(const Quantity& quantity);
Quantity quantityOf(const Type& type);

struct Symbol {
  enum class Role : std::uint8_t { Parameter, Result, Local, Counter, Touch, Call, Host };
  Role role = Role::Local;
  Quantity quantity;
  SourceRange range;                    // where it is declared or given first; no place: of a host
  const Parameter* parameter = nullptr; // of Parameter
  bool direction = false;               // of Touch: along a direction, or on more than one axis
  const File* cycle = nullptr;          // of Call; nullptr: unknown
  bool read = false;
};
using Symbols = std::map<std::string, Symbol, std::less<>>;

// Values that the machine or the project gives: ball_radius, overtravel, ...
void addHosts(Symbols& symbols);

} // namespace dotek::frontend::cycle
