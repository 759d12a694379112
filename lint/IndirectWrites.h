// Which variables a write of a computed number may set: `#[110+#100]=..`.
#pragma once

#include "ir/Program.h"

#include <cstdint>
#include <map>
#include <optional>

namespace dotek::lint {

// Whole numbers, both ends in it.
struct NumberRange {
  std::uint32_t first = 0, last = 0;
  bool contains(std::uint32_t number) const { return number >= first && number <= last; }
};

// What counters of the program may be, as its loops say.
class IndirectWrites {
public:
  explicit IndirectWrites(const ir::Program& program);
  // Of the variables below 1000: between the ends of what is added to the base where those are known, else
  // those of the kind of the base, locals, #100 to #499 or #500 to #999. Nothing: there is no base, and it
  // may set any.
  std::optional<NumberRange> range(const ir::ExpressionPtr& number) const;
  // The one variable that the number can mean: of `#[100+1]`, and of `#[#5]` where the program sets #5 once.
  std::optional<std::uint32_t> single(const ir::ExpressionPtr& number) const;
  // As ir::firstNumber(), also where the number was computed before: 2200 of `#[#5]` after `#5=2200+#20`.
  std::optional<std::uint32_t> firstNumber(const ir::ExpressionPtr& number) const;

private:
  struct Bounds {
    double low = 0, high = 0;
  };
  std::optional<Bounds> bounds(const ir::ExpressionPtr& value) const;

  std::optional<std::uint32_t> firstNumber(const ir::ExpressionPtr& number, int depth) const;

  std::map<std::uint32_t, Bounds> counters_;
  std::map<std::uint32_t, ir::ExpressionPtr> once_; // what variables get that are set once
};

} // namespace dotek::lint
