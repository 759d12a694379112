// What one run of a program did, in terms that two programs for different machines and macros can be compared
// by. Positions are those of the stylus's lowest point in coordinates of the machine: machine position
// without the tool's length (mm).
#pragma once

#include "sim/machine/Machine.h"
#include "sim/machine/World.h"
#include "sim/picture/Picture.h"
#include "stdlib/MacroSet.h"
#include "support/Source.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dotek::verify {

enum class Switch : std::uint8_t { NotSwitched, Off, On };

// What is on while the machine moves.
struct Surroundings {
  Switch probe = Switch::Off;
  std::uint8_t spindle = 0; // 0 off, 1 clockwise, 2 counterclockwise
  sim::Machine::Coolant coolant = sim::Machine::Coolant::NotSwitched;
  double speed = 0; // S; 0 while the spindle is off
  bool operator==(const Surroundings&) const = default;
};

constexpr std::uint32_t kExtendedSystem = 5410; // and n: G54.1 Pn, where G numbers name work systems

// What coordinates count from.
struct WorkFrame {
  std::uint32_t system = 0; // G number, kExtendedSystem + n for G54.1 Pn; 0: not looked at
  double toolLength = 0;    // in force, mm
};

// A straight piece of the path. A measuring call is one piece of no length, where it begins.
struct Piece {
  sim::PathKind kind = sim::PathKind::Feed;
  sim::Point3 from, to;
  Surroundings with;
  SourceRange range; // in the program that ran
  // As programmed, for the move itself; nothing: a rapid, or what the control or a macro takes by itself.
  std::optional<double> feed = {};
  // Codes in force, times ten: of the plane and of the kind of feed; of a call of the distance, too. 0: not
  // looked at.
  std::array<std::uint32_t, 3> modes = {};
  WorkFrame frame = {}; // where it begins
  bool goesOn = false;  // of a macro that is told to raise no alarm where it meets something
};

// Where a surface is expected, or was found. In X and Y the ball's centre is one radius before it, in Z
// its lowest point touches.
struct Touch {
  sim::Point3 point;
  sim::Point3 direction; // of the motion, length 1
  double way = 0;        // of the ball before it, mm; 0: not known
};

// A call, or a bare skip move, that measures.
struct Measure {
  std::vector<Touch> nominal;            // by the arguments; empty: the call states none
  std::vector<sim::ProbeEvent> contacts; // of the world, in order
  sim::Point3 start, end;
  Surroundings with;
  SourceRange range;
  // Zeros that the call has moved: G number and axis to where they lie after it, as Record::zeros.
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> datums;
  SourceRange datumRange = {}; // of a bare skip move: the block that set the last of them; none: `range`
  std::optional<sim::Point3> aim = {}; // of a bare skip move: where it ends without contact
  bool travels = false;                // it looks along a travel, which may lead beyond the surface
  // Of a travel: the surface that Entry::drawn shows on it, as `nominal` counts.
  std::optional<sim::Point3> drawn = {};
  // Arguments of the call that say neither where a surface is nor what is set: how far it searches, tools,
  // tolerances, what is printed.
  std::map<stdlib::ArgumentRole, double> options = {};
  // What no source says of the call, which the run has passed over; "" where all is known.
  std::string unstated = {};
  // Of a call its number, 0 else, and the letters that it gives, by local.
  std::uint32_t program = 0;
  std::vector<std::pair<std::uint32_t, double>> locals = {};
  std::optional<double> letter(char letter) const;
};

// It touches at an angle in the plane XY. Words lead there that are rounded to the control's step: such a
// path may lie so far (mm) beside the one that another macro takes.
bool isOblique(const Measure& measure);
inline constexpr double kObliqueWord = 0.0015;

// Something that motion changes, or that changes motion, was used while motion before it may not have ended.
struct EarlyUse {
  SourceRange range; // of the block
  std::uint32_t number = 0;
  bool write = false; // of an offset; else a position was read
};

// What a program does beside moving, where its control has codes for it.
struct Mark {
  enum class Kind : std::uint8_t {
    Position, // the control writes where it is to a file
    Value,    // or a value
    Datum,    // the position is set: the machine is still, its coordinates change
    Stop,     // the operator reads `text`
  };
  Kind kind = Kind::Stop;
  std::size_t pieces = 0; // that came before it
  sim::Point3 at;
  sim::Point3 zero; // of the active system, after it
  double value = 0;
  std::string text;
  SourceRange range;
};

// What a program does between its moves, outside of calls that count as one thing.
struct Deed {
  enum class Kind : std::uint8_t {
    Subprogram, // M98 of a program that is not at hand: `value` is its number
    ToolChange, // M6: `value` is the tool that T has named
    Auxiliary,  // M `value`: the spindle is oriented (M19), an optional stop
    Stop,       // the operator reads `text`; `value`: n of #3006=n, 0 where there is none
    Dwell,      // seconds
  };
  Kind kind = Kind::Auxiliary;
  double value = 0;
  std::string text;
  sim::Point3 at;
  std::size_t measures = 0; // that had begun before it
  Surroundings with;
  SourceRange range;
  std::set<std::string> written = {}; // work offsets that had been written before a stop: "G54 X"
};

// A protected move called for where the machine is already: it moves nothing, but from another place it
// would.
struct IdleMove {
  std::uint32_t program = 0;             // of the macro; 0: of a cycle
  std::size_t pieces = 0;                // that came before it
  std::optional<double> feed = {};       // an argument
  std::map<std::uint32_t, double> given; // arguments by local
  SourceRange range;
};

// A question whether the probe is in contact, by what had come before it.
struct Question {
  std::size_t pieces = 0, marks = 0;
};

// The probe is switched: what is in force there, as of Piece, and what is on before.
struct SwitchCall {
  std::uint32_t program = 0; // of the macro; 0: by a code
  std::array<std::uint32_t, 3> modes = {};
  Surroundings with;
  SourceRange range;
};

// A variable or an offset got a value.
struct Write {
  double value = 0; // sim::kUnknown: not known; of a tool's offset by how much it changes
  SourceRange range;
  std::size_t pieces = 0; // that came before it; of a variable not looked at
};

enum class Ending : std::uint8_t { Finished, Alarm, Inconclusive };

struct Record {
  Ending ending = Ending::Finished;
  std::uint32_t alarm = 0; // as the control shows it; 0: its number is not known
  std::string text;        // of the alarm, or why it is inconclusive
  SourceRange endedAt;
  bool overLimit = false; // inconclusive: a limit of Dotek
  bool ofValue = false;   // inconclusive: a macro's argument has a value that no source gives a meaning
  std::string alarmKind;  // of a probing macro's alarm, as all sets call it; "" for others

  std::vector<Piece> pieces;
  std::vector<Measure> measures;
  std::vector<Mark> marks;
  std::vector<Deed> deeds;
  std::vector<SwitchCall> switches;
  std::vector<IdleMove> idle;
  // The program's own #1, #2 .. (from the second entry on) where it first moves or has called a macro; empty:
  // it does neither.
  std::vector<double> locals;
  // What went wrong on the path (no contacts, no misses), and where in the program.
  std::vector<std::pair<sim::ProbeEvent, SourceRange>> events;
  // Work offsets that were written: G number (54 to 59; 54.1 Pn as kExtendedSystem + n) and axis (0 to 2
  // always, a further one where it is not 0), to the machine position of the zero. 52 and 92: by how much
  // these have shifted all of them.
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> zeros;
  std::map<std::uint32_t, sim::Machine::ToolOffset> tools; // entries of the tool table that were changed
  std::optional<std::uint32_t> tool;                       // that T has named last; nothing: that at entry
  std::map<std::uint32_t, double> stores; // variables that the program itself writes; kNull is a value
  // How these, and offsets ("G54 X", "tool 5", "radius of tool 5"), were written, in order; of very many the
  // first ones and the last.
  std::map<std::uint32_t, std::vector<Write>> storeWrites;
  std::map<std::string, std::vector<Write>> offsetWrites;
  bool knowsStores = false; // where variables are written is known
  // Of the variables that are watched (Stand::watchStores) those that it leaves with another value.
  std::map<std::uint32_t, double> strays;
  std::string printed;   // by DPRNT and BPRNT, bytes
  bool portOpen = false; // at the end
  sim::Point3 start, end;
  Surroundings before, after; // what is on at entry and at the end
  bool pathMoved = false;     // by a datum (Stand::Way::MovePath)
  // Skip moves of a length that ran: bare ones that look for a surface, bare ones and macros that are to meet
  // nothing; and calls that measure.
  std::size_t searches = 0, protectedMoves = 0, calls = 0;
  std::vector<Question> questions;
  // What had come before the first thing after what was asked for (Interference.h): pieces and marks;
  // nothing: it did not come to that.
  std::optional<std::pair<std::size_t, std::size_t>> disturbed;
  // Modal codes by group, times ten, at entry and at the end.
  std::array<std::uint32_t, 32> modalBefore{}, modalAfter{};
  // What G68 leaves: degrees, and where it takes the zero of the active system, in its coordinates; nothing:
  // it is off.
  std::optional<std::array<double, 4>> turn = {};
  double feedBefore = 0, feedAfter = 0; // F in force
  // At the end the motion code, or F, is what a macro of the vendor has left.
  bool motionOfMacro = false, feedOfMacro = false;
  SourceRange lastBlock;       // that ran
  std::vector<EarlyUse> early; // each place once
  // By axis, measures before the program writes an offset along it for the first time, not within a call;
  // nothing: it does not.
  std::array<std::optional<std::size_t>, 3> ownOffsets{};
  std::vector<sim::PictureMove> moves; // every motion, for pictures; only where asked for
};

} // namespace dotek::verify
