#include "frontend/cycle/Kinds.h"

#include <array>
#include <utility>

namespace dotek::frontend::cycle {

using Base = Quantity::Base;

bool Quantity::isNumeric() const {
  switch (base) {
  case Base::Flag:
  case Base::Text:
  case Base::Choice:
  case Base::WorkOffset: return false;
  default: return true;
  }
}

bool Quantity::fits(const Quantity& other) const {
  if (base == Base::Unknown || other.base == Base::Unknown) return true;
  if (base == Base::Zero) return other.isNumeric();
  if (other.base == Base::Zero) return isNumeric();
  // A tool offset is a number.
  if ((base == Base::ToolOffset && other.base == Base::Number) ||
      (base == Base::Number && other.base == Base::ToolOffset))
    return true;
  return base == other.base && (base != Base::Length || power == other.power);
}

std::string quantityText(const Quantity& quantity) {
  switch (quantity.base) {
  case Base::Unknown: return "a value";
  case Base::Zero: return "0";
  case Base::Number: return "a number without unit";
  case Base::Length:
    return quantity.power == 1   ? "a length"
           : quantity.power == 2 ? "an area"
           : quantity.power == 3 ? "a volume"
                                 : "a power of a length";
  case Base::Angle: return "an angle";
  case Base::Feed: return "a feed";
  case Base::Time: return "a time";
  case Base::Flag: return "a condition";
  case Base::Text: return "a text";
  case Base::Choice: return "a choice";
  case Base::WorkOffset: return "a work offset";
  case Base::ToolOffset: break;
  }
  return "a tool offset";
}

std::string_view unitFor(const Quantity& quantity) {
  switch (quantity.base) {
  case Base::Length: return quantity.power == 1 ? "mm" : "";
  case Base::Angle: return "deg";
  case Base::Feed: return "mm/min";
  case Base::Time: return "s";
  default: return "";
  }
}

Quantity quantityOf(const Type& type) {
  switch (type.name) {
  case TypeName::Length: return {Base::Length, 1, nullptr};
  case TypeName::Angle: return {Base::Angle, 1, nullptr};
  case TypeName::Feed: return {Base::Feed, 1, nullptr};
  case TypeName::Time: return {Base::Time, 1, nullptr};
  case TypeName::Count:
  case TypeName::Ratio: return {Base::Number, 1, nullptr};
  case TypeName::Flag: return {Base::Flag, 1, nullptr};
  case TypeName::Text: return {Base::Text, 1, nullptr};
  case TypeName::Choice: return {Base::Choice, 1, &type.choices};
  case TypeName::WorkOffset: return {Base::WorkOffset, 1, nullptr};
  case TypeName::ToolOffset: break;
  }
  return {Base::ToolOffset, 1, nullptr};
}

void addHosts(Symbols& symbols) {
  constexpr std::array<std::pair<const char*, Base>, 7> kHosts = {{{"ball_radius", Base::Length},
                                                                   {"overtravel", Base::Length},
                                                                   {"retract", Base::Length},
                                                                   {"approach_feed", Base::Feed},
                                                                   {"measuring_feed", Base::Feed},
                                                                   {"yes", Base::Flag},
                                                                   {"no", Base::Flag}}};
  for (const auto& [name, base] : kHosts) {
    Symbol symbol;
    symbol.role = Symbol::Role::Host;
    symbol.quantity = {base, 1, nullptr};
    symbol.read = true;
    symbols.emplace(name, symbol);
  }
}

} // namespace dotek::frontend::cycle
