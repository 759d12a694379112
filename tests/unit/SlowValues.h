// Values and arithmetic of Macro B for the slow evaluator (SlowMacroB.h): written from the tables of the
// language and from nothing that the product runs, so that both can be compared.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace dotek::tests {

// Why a run ends, thrown from any depth of the evaluator.
struct SlowStop {
  enum class Kind { ProgramEnd, TextEnd, Alarm, Budget, Unsupported };
  Kind kind = Kind::Unsupported;
  int alarm = 0;
  std::string reason; // of Unsupported
};
[[noreturn]] void raiseAlarm(int number);
// The tables leave open what the machine does.
[[noreturn]] void leftOpen(const std::string& what);

struct SlowValue {
  double number = 0; // 0 of null
  bool null = true;
  // Came through a function whose last bit may differ between two implementations. A decision that such a
  // value takes close to a tie is not comparable.
  bool doubtful = false;
};

class SlowArithmetic {
public:
  // `decimal8`: each result has 8 significant decimal digits, and is 0 or of magnitude 1e-29 to 1e47.
  explicit SlowArithmetic(bool decimal8) : decimal8_(decimal8) {}

  // A doubtful value stood close to a tie somewhere.
  bool fragile() const { return fragile_; }

  // A number that the machine holds: alarm 111 where it does not.
  SlowValue held(double number, bool doubtful);
  // Null counts as 0 in all of these.
  SlowValue operate(const std::string& op, SlowValue left, SlowValue right);
  SlowValue negated(SlowValue value);
  // `unit`: what ROUND rounds to.
  SlowValue apply(const std::string& name, const std::vector<SlowValue>& arguments, double unit);
  // Of EQ and NE null is a value of its own.
  bool compare(const std::string& op, SlowValue left, SlowValue right);
  // To the nearest whole number, half away from zero.
  double whole(SlowValue value);
  // To the nearest thousandth, half away from zero.
  double thousandths(SlowValue value);
  // As DPRNT prints it: the digits before the point padded by blanks, more digits where they do not suffice;
  // a minus is before the first digit and takes a place of its own.
  std::string printed(SlowValue value, int integerDigits, int decimals);

private:
  void tie(SlowValue value, double unit);
  void checkDecimals(SlowValue value, int places);
  void near(SlowValue value, double place);
  SlowValue bits(const std::string& op, SlowValue left, SlowValue right);
  SlowValue angle(const std::string& name, SlowValue value);
  SlowValue coded(const std::string& name, SlowValue value);
  SlowValue twoArguments(const std::string& name, SlowValue first, SlowValue second);

  bool decimal8_ = false;
  bool fragile_ = false;
};

} // namespace dotek::tests
