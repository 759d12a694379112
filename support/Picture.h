// Number pictures of a ComPost post: '###.##;0'. The rules are those of docs/compost.md, "Pictures".
#pragma once

#include "support/Decimal.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace dotek {

struct PictureError {
  std::uint32_t offset = 0; // bytes from the start of the picture
  std::uint32_t length = 1;
  std::string message; // in the words of diagnostics
};

// body [; zero [; step]]
class Picture {
public:
  static std::variant<Picture, PictureError> parse(std::string_view text);

  enum class Fit : std::uint8_t { Exact, LosesDecimals, DoesNotFit };
  struct Printed {
    Fit fit = Fit::Exact;
    std::string text; // "" where it does not fit
    Decimal value;    // what `text` stands for
  };
  // `value` is finite. Rounds half away from zero on the shortest decimal text, or to the step.
  Printed print(double value) const;

  const std::string& text() const { return text_; }
  // Characters before the first placeholder: sign and factor marks whose meaning is not known. A picture
  // with a prefix must not be printed with.
  const std::string& prefix() const { return prefix_; }
  // The point is implied (`^`), an unverified reading of the character.
  bool impliedPoint() const { return point_ == Point::Implied; }
  bool printsPoint() const { return point_ == Point::Printed; }
  int integerPlaces() const { return static_cast<int>(integer_.size()); }
  int decimals() const { return static_cast<int>(fraction_.size()); }
  // 0 prints no digit at all: an address before it would appear bare.
  bool zeroPrintsNothing() const;

private:
  enum class Point : std::uint8_t { None, Printed, Implied };
  std::string text_;
  std::string prefix_;
  std::string integer_;  // placeholders # and 0
  std::string fraction_; // placeholders # and 0
  Point point_ = Point::None;
  bool hasZero_ = false;
  std::string zero_;
  std::uint32_t step_ = 1; // in units of the last place
};

} // namespace dotek
