// What is certain of a machining program before each of its statements: spindle, tool, its length, modes.
#pragma once

#include "lint/Probing.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace dotek::lint {

// Unknown: a called program or a code of the builder decides, or paths disagree.
enum class Certain : std::uint8_t { No, Yes, Unknown };

// Modes that stay in force until a code ends them.
enum class Mode : std::uint8_t { CannedCycle, Compensation, Rotation, Scaling, Polar };
inline constexpr std::size_t kModes = 5;

struct Machining {
  static constexpr std::size_t kNowhere = SIZE_MAX;
  struct Modal {
    Certain on = Certain::No;
    std::size_t since = kNowhere; // statement that put it in force; kNowhere: several
    bool operator==(const Modal&) const = default;
  };

  Certain spindle = Certain::No;
  Certain speed = Certain::No;  // an S above 0 was given
  Certain length = Certain::No; // G43 or G44
  Certain offset = Certain::No; // a D was given
  std::array<Modal, kModes> modes;
  int tool = -1;                 // in the spindle, by T and M6; -1: not known
  int called = -1;               // by T, not put in yet; -1: none
  int lengthOf = -1;             // tool for which a block of the program last took up a length
  Certain taken = Certain::No;   // a length was taken up since the last tool change
  std::size_t change = kNowhere; // statement of that tool change; kNowhere: the start, or several
  bool probes = false;  // the tool in the spindle is a probe, or measures itself: its feed moves are no cuts
  int distance = 0;     // 90, 91; 0: not known
  int motion = -1;      // 0 to 3; -1: not known
  bool lowered = false; // a feed move went down since the last rapid along Z
  std::optional<double> z; // programmed, while it is absolute and written out

  const Modal& mode(Mode one) const { return modes[static_cast<std::size_t>(one)]; }
  bool operator==(const Machining&) const = default;
};

// The modes that the codes of a block put in force, which hold for its words.
Machining within(const ir::NcBlock& block, std::size_t at, Machining before);
// The cycle that the block begins, 73 to 89; 0: none.
int cycleOf(const ir::NcBlock& block);
// The word of this code; nullptr: there is none.
const ir::Word* codeWord(const ir::NcBlock& block, char address, double code);
const ir::Word* firstWord(const ir::NcBlock& block, std::string_view letters);

// Of a main program of a milling machine (it ends with M30 or M2, and changes a tool or takes up a length);
// empty: another program. Nothing where no path leads. `touches`: the statement moves a tool until it
// touches, or calls what does.
std::vector<std::optional<Machining>>
machiningBefore(const ir::Program& program, const ir::ProgramFlow& flow,
                const std::function<bool(const ir::ProgramStatement&)>& touches);

} // namespace dotek::lint
