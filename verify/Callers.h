// Who calls a program that `convert` writes for a control: callers with all kinds of modes in force, and such
// that break what the program demands of them. What it owes to each is the contract in docs/convert.md,
// computed here from the source and the control's profile alone.
#pragma once

#include "ir/Program.h"
#include "stdlib/Control.h"
#include "verify/Record.h"
#include "verify/Stand.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::verify {

// Distance, plane, kind of feed and motion, as many as the control has codes for: a block of NC for
// Entry::blocks. The same `stream` gives the same.
std::string callerModes(const stdlib::Control& control, std::uint64_t stream);

// A caller who breaks a demand, and the text of the alarm that has to stop him before anything moves.
struct BrokenCaller {
  std::string who; // "with G20 in force"
  std::string alarm;
  // For Entry: `blocks` and `modal`.
  std::string blocks;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> modal;
  sim::Point3 away = {};     // of his place beside Entry::start; with a shift his coordinates are the same
  char shifts = 0;           // the axis along which a local shift is in force; 0: none
  bool ofToolLength = false; // not demanded by a program that puts a length in force itself
};
// `shown` is what a control with messages of so many characters shows of `text`: the whole, or where it is
// longer its beginning.
bool showsAlarm(std::string_view shown, std::string_view text, std::size_t length);

// `shiftOfZ`: the program writes an offset along Z by itself, so no shift of Z may be in force either.
// `starts`: where it has to be called, by axis, where that is fixed.
std::vector<BrokenCaller> brokenCallers(const stdlib::Control& control, bool shiftOfZ,
                                        const std::map<char, double>& starts = {});

// A caller who has another work system or tool length in force than the program selects for itself, in the
// same place: the program runs as it does under the one that it selects.
struct OtherCaller {
  std::string who; // "under G57"
  Entry entry;
  bool ofModes = false; // macros may refuse it before anything is measured
};
// `posted`: what the source prints; `entry`: as it runs else. `stream` chooses.
std::vector<OtherCaller> otherCallers(const ir::Program& posted, const stdlib::Control& control,
                                      const Entry& entry, std::uint64_t stream);
// Each with one mode in force that the source's own run does not begin with: the distance, the kind of feed,
// the plane, the motion.
std::vector<OtherCaller> otherModes(const stdlib::Control& control, const Entry& entry);
// In the same place, and with all zeros where they are, an external offset is in force; nothing: programs of
// the control cannot see one.
std::optional<Entry> withExternalOffset(const stdlib::Control& control, const Entry& entry);
// A mode that a caller of a program has in force, for Entry on the one and the other control.
struct ModeInForce {
  std::string who; // "under G91", as the first control has it
  struct Side {
    std::string blocks;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> modal;
  };
  Side source, target;
};
// Those that both controls have: of the distance, the kind of feed, the plane, the motion, and cutter
// compensation and a canned cycle as far as a program asks for them.
std::vector<ModeInForce> modesInForce(const stdlib::Control& source, const stdlib::Control& target);
// Some block has a G code of this function.
bool hasCode(const ir::Program& program, const stdlib::Control& control, stdlib::Function function);

// It comes, without a jump before, to a block that takes a tool's length (G43) from an offset that is not
// above 0.
bool takesNoOffset(const ir::Program& program, const stdlib::Control& control);

// Modal groups that the program has to leave as it found them, and F; "" or what it leaves otherwise.
// `source`: what the original leaves, which counts for groups that no bare code puts back; nullptr: nothing.
std::string whyNotPutBack(const stdlib::Control& control, const Record& ran, const Record* source);

} // namespace dotek::verify
