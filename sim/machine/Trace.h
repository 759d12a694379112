// The canonical trace of a run: one line an action, numbers with six decimals, never "-0", lengths in mm. No
// line of it depends on the spelling of the program, so that two programs which do the same have the same
// trace.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace dotek::sim {

inline constexpr std::size_t kAxes = 9;
inline constexpr char kAxisLetters[kAxes + 1] = "XYZABCUVW";
using Position = std::array<double, kAxes>; // mm and degrees, in the order of kAxisLetters

class Trace {
public:
  // `sink` takes the text in pieces of whole lines, also when this object ends. With `lines` each line begins
  // with the line of the program.
  explicit Trace(std::function<void(std::string_view)> sink, bool lines = false);
  ~Trace();
  Trace(const Trace&) = delete;
  Trace& operator=(const Trace&) = delete;

  void at(std::uint64_t line) { line_ = line; }
  // Positions as a lathe shows them: no Y that has not moved, and X twice where `diameters`.
  void showLathe(bool diameters) {
    lathe_ = true;
    diameters_ = diameters;
  }
  // Begins a line with its action, adds to it, ends it.
  Trace& begin(std::string_view action);
  Trace& word(std::string_view name, double value); // " X1.500000"
  Trace& text(std::string_view text);               // " flood"
  // X, Y, Z, and of the other axes those that the run has moved (`shown`, bits in the order of the axes).
  Trace& position(const Position& position, std::uint32_t shown);
  void end();
  void flush();
  // Lines of a motion that waits for the one after it: the place that they belong to, and the lines from
  // `begin` on taken there. Gives how long they are. While `hold` nothing is given away.
  std::size_t place() const { return text_.size(); }
  std::size_t takeTo(std::size_t place, std::size_t begin);
  void hold(bool hold) { held_ = hold; }
  std::uint64_t line() const { return line_; }

private:
  std::function<void(std::string_view)> sink_;
  bool lines_;
  bool lathe_ = false, diameters_ = false, held_ = false;
  std::uint64_t line_ = 0;
  std::string text_;
};

// Six decimals, half away from zero on the shortest decimal text, no "-0".
void appendFixed6(std::string& out, double value);

} // namespace dotek::sim
