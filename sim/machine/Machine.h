// A virtual machine tool with its control: what the blocks of a program do to modal state, position, offsets
// and variables. A scanner of plain text and a running macro program drive the same object. What the machine
// does not know ends the run as inconclusive; it never skips a word or a code.
#pragma once

#include "ir/NcWords.h"
#include "sim/machine/Cells.h"
#include "sim/machine/CodeTable.h"
#include "sim/machine/Dialect.h"
#include "sim/machine/MotionWatcher.h"
#include "sim/machine/Rotation.h"
#include "sim/machine/Trace.h"
#include "sim/machine/Value.h"
#include "stdlib/Control.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::sim {

enum class Ending : std::uint8_t {
  Running,
  ProgramEnd,   // M2, M30
  TextEnd,      // `%` after the blocks, or the next program begins
  Return,       // M99
  Alarm,        // of the control, or #3000
  Inconclusive, // Dotek does not know what the control would do
  Limit,        // a limit of Dotek: `--limit`
  Call,         // G65, G66, M98: the caller runs it
};

// Where a program is, for alarms.
struct Frame {
  std::uint32_t program = 0;  // O number; 0: none
  std::uint32_t sequence = 0; // last N number; 0: none
  std::uint64_t line = 0;
  bool macro = false; // called with arguments, so with locals of its own
};

// Why and where a run ended.
struct RunEnd {
  Ending ending = Ending::Running;
  std::uint32_t number = 0; // of an alarm, as the control shows it; 0: its number is not known
  std::string text;         // of an alarm what the control shows; else what Dotek does not know
  char letter = 0;          // the word that the text speaks of; 0: the block
  std::uint32_t which = 0;  // of several words with this letter, from 0
  bool ofValue = false;     // inconclusive: an argument has a value that no source gives a meaning
  std::uint64_t line = 0;
  std::vector<Frame> stack; // the outermost first
};

// A straight move that asks for the probe's contact.
struct SkipMove {
  Position from, to;               // of the active work system
  Position machineFrom, machineTo; // of the machine, tool length included
  double feed = 0;                 // as programmed
  bool positions = false;          // meant to meet nothing: a protected move of a vendor's macro
};
class SkipSignal {
public:
  virtual ~SkipSignal() = default;
  // The share of the path, 0 to 1, at which the signal comes; nothing: it does not come.
  virtual std::optional<double> contact(const SkipMove& move) = 0;
  // Whether it is there while the machine is; `here` has no length.
  virtual bool isThere(const SkipMove& here) { return contact(here).has_value(); }
};

struct PlaneAxes;
struct OffsetQueue;

// Of a path that cutter compensation offsets: the moves that wait for the next one.
class OffsetState {
public:
  OffsetState();
  OffsetState(const OffsetState& other);
  OffsetState& operator=(const OffsetState& other);
  ~OffsetState();
  bool active() const { return queue_ != nullptr; }

private:
  friend class OffsetWork;
  std::unique_ptr<OffsetQueue> queue_;
};

class Machine {
public:
  // `control` outlives the machine. Nothing else is needed; the trace and the signal may be added.
  explicit Machine(const stdlib::Control& control, Dialect dialect = {});

  void setTrace(Trace* trace);                               // nullptr: quiet
  void setSkipSignal(SkipSignal* signal) { skip_ = signal; } // nullptr: G31 ends the run as inconclusive
  // nullptr: nobody watches. Watched blocks take the long way. The watcher, and the signal, may end the run
  // by inconclusive().
  void setWatcher(MotionWatcher* watcher);
  // Where the machine is before the program begins; without it all axes are at its zero.
  void startAt(const Position& machine);
  // A motion that a watcher or the signal has ended comes no farther than here.
  void stopAt(const Position& machine);
  MotionWatcher* watcher() const { return watcher_; }
  void setCallLimit(std::uint32_t calls) { callLimit_ = calls; }        // calls within calls
  void setBlockDelete(std::uint32_t levels) { deleteLevels_ = levels; } // bit n: the switch of `/n` is on

  // Cutter compensation: an outside corner is an arc about it. Else the control prolongs the moves, as a
  // Fanuc does by default.
  void roundOffsetCorners(bool round) { roundsCorners_ = round; }
  // The motions that a watcher sees are those of the offset path.
  bool offsetsPath() const;

  std::uint32_t blockDelete() const { return deleteLevels_; }

  // Runs one block. false: the run has ended, end() says how; blocks after that do nothing.
  bool execute(const ir::NcWords& words);
  const RunEnd& end() const { return end_; }
  bool running() const { return end_.ending == Ending::Running; }
  std::uint64_t blocks() const { return blocks_; }

  // ---- state
  // Of the active work system, mm and degrees; not turned by G68.
  const Position& position() const { return work_; }
  Position machinePosition() const; // the tool's length included
  // As far as they are known: NaN for other axes. That of the machine may be known where a parameter decides
  // whether the tool's length stays in force.
  Position knownPosition() const { return knownOf(work_, uncertain_); }
  Position knownMachinePosition() const;
  // Where the zero of G54 (0) to G59 (5) lies, in coordinates of the machine: with the external offset.
  Position zeroOf(std::uint32_t system) const;
  // What G52 and G92 have added to the zeros of all work systems.
  const Position& localShift() const { return local_; }
  const Position& positionShift() const { return shift_; }
  const Rotation& rotation() const { return rotation_; } // G68
  // Before the program begins: the same, and the length of a tool, whatever variables the control has for
  // them.
  void setZero(std::uint32_t system, const Position& zero);
  void setToolLength(std::uint32_t tool, double length);
  // Wear and geometry of its offset, mm; 0 where there is no such offset.
  double toolLengthOf(std::uint32_t tool) const;
  // From now on a tool length without a Z moves the coordinates and not the machine. Else what moves is not
  // known, a parameter of the control says it: Z is lost.
  void keepPlaceOnToolLength() { lengthKeepsPlace_ = true; }
  // A tool length stays in force over a move to a place of the machine in Z, which no source says of every
  // control.
  void keepToolLength() { keepsLength_ = true; }
  void putTool(std::uint32_t tool); // into the spindle, before the program begins
  // Before the program begins: what turns and flows, and a code in force (times ten) that changes nothing but
  // what programs read of its group.
  void startSpindle(std::uint8_t direction) { spindle_ = direction; }
  void presetModal(std::uint32_t group, std::uint32_t tenths) {
    if (group < kGroups) groups_[group] = tenths;
  }
  // Moves the zero of the active system along an axis, and the machine with it: its coordinates stay.
  void moveZero(std::size_t axis, double by);
  // An entry of the tool table, mm. Without a geometry of its own the whole length is `wear`.
  struct ToolOffset {
    double wear = 0, geometry = 0;
    bool operator==(const ToolOffset&) const = default;
  };
  const std::vector<ToolOffset>& toolTable() const { return tools_; } // by number; 0 is none
  // Zeros of G54.1 Pn, mm of the machine; the first one is of no system.
  const std::vector<Position>& extendedZeros() const { return extended_; }
  std::uint32_t tool() const { return toolNumber_; } // that T has named last; 0: none
  // The active work system, with all that shifts it, is the machine's own.
  bool isAtMachineZero() const { return offset_ == Position{}; }
  const Position& skipPosition() const { return skipped_; }
  std::uint8_t mode(Slot slot) const { return modes_[slot]; }
  // Code in force of a modal group, times ten; 0: none was given and none is in force at the start.
  std::uint32_t modalCode(std::uint32_t group) const { return group < kGroups ? groups_[group] : 0; }
  double feed() const { return feed_; } // mm/min or mm per revolution
  double spindleSpeed() const { return speed_; }
  std::uint8_t spindle() const { return spindle_; } // 0 off, 1 clockwise, 2 counterclockwise
  double toolLength() const { return toolLength_; } // in force, added to Z
  // The block that runs goes to a place of the machine: G28, G30, G53.
  bool goesToMachine() const;
  // Why the watcher does not know where the machine is, and what settles it.
  std::string lostWhy() const;
  // All that a program can see or set of the machine: two that are the same run the same.
  std::vector<double> snapshot() const;
  enum class Coolant : std::uint8_t { NotSwitched, Off, Flood, Mist };
  Coolant coolant() const { return coolant_; }               // what the program switched last
  void startCoolant(Coolant coolant) { coolant_ = coolant; } // before the program begins
  // Axes (bits in the order of kAxisLetters) whose position is not known, since what moved them is not.
  std::uint32_t uncertain() const { return uncertain_; }
  std::uint32_t movedAxes() const { return shown_; }
  double seconds() const { return seconds_; }
  // The last block moved an axis, or told one to move to where it is.
  bool moved() const { return moved_; }
  const stdlib::Control& control() const { return *control_; }
  bool isLathe() const { return turning_ != nullptr; }
  bool countsDiameters() const { return turning_ != nullptr && turning_->diameters; }
  // What a user reads of X is a diameter, whatever its words are to the machine.
  bool showsDiameters() const { return countsDiameters() || dialect_.showsDiameters; }
  Trace* trace() const { return trace_; }

  // ---- variables of macros
  // The value (kNull: null). nullopt: the run has ended, with alarm 115 or as inconclusive.
  std::optional<double> read(std::uint32_t number);
  // false: the run has ended (115, 116, or inconclusive). #3000 and #3006 are `raise` and `message`.
  bool write(std::uint32_t number, double value);
  // The same, of what a macro without text has measured.
  bool writeMeasured(std::uint32_t number, double value);
  // The variables that it has written so since this was last asked.
  std::vector<std::uint32_t> takeMeasured() { return std::exchange(measured_, {}); }
  // Before the program begins: system variables that a program cannot write, too.
  bool preset(std::uint32_t number, double value);
  double local(std::uint32_t number) const { return cells_[number]; } // 1 to control.locals
  void setLocal(std::uint32_t number, double value) { cells_[number] = value; }
  std::uint32_t level() const { return level_; } // of macro calls, 0 in the main program
  // The cells of the layout, then those that were added; good until the next addCells().
  const CellLayout& layout() const { return layout_; }
  double* cells() { return cells_.data(); }
  // More cells for a running program; gives the first.
  std::uint32_t addCells(std::uint32_t count);
  // A value that a motion still in the queue may change: a position, the window of the PMC.
  bool changesWithMotion(std::uint32_t number) const;
  // Where a skip move ended: the next one alone changes it.
  bool isSkipPosition(std::uint32_t number) const;
  // An offset, of a work system or of a tool: where a motion that waits in the queue leads may change with
  // it.
  bool movesPositions(std::uint32_t number) const;
  // The common variables and the locals of the main program that were written, by number.
  std::vector<std::pair<std::uint32_t, double>> written() const;
  // Of a common variable as it is; kFresh: nobody wrote it, or there is none of this number.
  double common(std::uint32_t number) const {
    const std::uint32_t cell = layout_.cellOf(number);
    return cell == CellLayout::kNone ? kFresh : cells_[cell];
  }
  // To the least input increment, as a word of a length is; in the unit in force.
  double toIncrement(double value) const {
    return rounded(value, control_->decimals + (modes_[kUnits] != 0 ? 1 : 0));
  }

  // ---- calls; the caller finds the program and runs it
  // A call with arguments gets a level of its own, its locals are null. false: too deep, an alarm.
  bool enter(const Frame& callee);
  void leave();
  Frame& frame() { return stack_.back(); }
  // The block with this N number is reached.
  void sequence(std::uint32_t number) {
    stack_.back().sequence = number;
    modalWords_['N' - 'A'] = number;
  }
  void beginProgram(std::uint32_t number);   // the main one
  void noteModal(stdlib::Function function); // a code that the caller carries out

  // ---- macros that run by their meaning (MacroMeaning.h)
  enum class Probe : std::uint8_t { NotSwitched, On, Off };
  Probe probe() const { return probe_; } // what the program switched last
  void switchProbe(bool on);
  // Straight to `end` of the active system, at a feed that is not stated; the probe's contact ends the move
  // there: true. nullopt: the run has ended. `positions`: it is meant to meet nothing.
  // `action`: of the trace.
  std::optional<bool> probeTo(const Position& end, bool positions = false,
                              std::string_view action = "probing");
  bool travelTo(const Position& end); // without watching for contact; false: the run has ended
  // What the macro leaves there is not known: who reads it ends the run. `number`: of a common variable.
  void forget(std::uint32_t number);
  bool hasUnknown() const { return hasUnknown_; } // a cell may hold kUnknown (Value.h)
  void forgetMotion(std::optional<double> feed);  // the code of group 1, and the feed unless it is given
  bool knowsMotion() const { return !motionForgotten_; } // and forgetMotion() was not the last that set them
  bool knowsFeed() const { return !feedForgotten_; }
  std::size_t extendedSystem() const { return extendedNow_; }  // n of G54.1 Pn
  void remark(std::string_view action, std::string_view text); // a line of the trace
  bool raiseUnnumbered(std::string_view text);                 // an alarm whose number is not known; false

  // ---- cycles that run by their meaning (MachineCycle.cpp)
  // Straight to `end` of the active system. `feed`: stays in force; nothing: the one in force. false: the run
  // has ended.
  bool goTo(const Position& end, MotionKind kind, std::optional<double> feed);
  void setFeed(double feed) { feed_ = feed; } // mm/min
  // G54 (0) to G59 (5), or G54.1 Pn (n).
  struct WorkSystem {
    std::uint32_t index = 0;
    bool extended = false;
    bool operator==(const WorkSystem&) const = default;
  };
  // By its number: 54 to 59, 5410 + n for G54.1 Pn; nothing: the machine has none of it.
  std::optional<WorkSystem> workSystem(double number) const;
  WorkSystem activeSystem() const;
  static std::string nameOf(const WorkSystem& system); // "G54", "G54.1 P3"
  // Its own value, mm, without what shifts all of them.
  double offsetOf(const WorkSystem& system, std::size_t axis) const;
  bool writeOffset(const WorkSystem& system, std::size_t axis, double value); // false: the run has ended
  // Of its offset; the length in force stays.
  void writeTool(std::uint32_t tool, bool radius, double value);
  bool selectSystem(const WorkSystem& system); // as above
  void switchSpindle(std::uint8_t direction, std::optional<double> speed);
  void switchCoolant(Coolant coolant);
  void dwellFor(double seconds);

  // ---- what only lathes have (MachineTurning.cpp)
  // The block finishes along a contour: the caller runs the blocks of P to Q, then goes back.
  bool finishesContour(const ir::NcWords& words) const;
  bool rapidTo(const Position& end); // in the plane ZX; false: the run has ended

  // ---- what only some dialects have (MachineDialect.cpp)
  const Dialect& dialect() const { return dialect_; }
  // A length of tool (mm) that no code has put in force.
  void holdTool(double length);
  // Zero of the active system in coordinates of the machine, whatever has moved it; the tool's length aside.
  const Position& activeZero() const { return offset_; }
  enum class Skip : std::uint8_t {
    None, // no skip move yet
    Missed,
    Touched,
    Pressed, // it began in contact
  };
  Skip lastSkip() const { return lastSkip_; }
  bool hasTouched() const { return touched_; } // a skip move, or a macro's, has met something
  // A skip move stops so far beyond the contact, mm, as reads of the present position see it until the next
  // move: axes brake, and #5061 alone holds where the signal came. Moves are not affected.
  void stopBeyond(double distance) { stopsBeyond_ = distance; }
  // Whether the skip moves to come are meant to meet nothing: a contact ends the program.
  void expectNoContact(bool none) { skipPositions_ = none; }
  // nullopt: no signal was given.
  std::optional<bool> signalIsThere();
  bool hasSkipSignal() const { return skip_ != nullptr; }
  // The origin of the active system lies there in it, whatever shift was in force; {}: none is.
  void shiftLocally(const Position& origin);
  bool threadTo(const Position& end, double lead); // straight, false: the run has ended
  // Rapid to the machine's zero in these axes (bits); the coordinates that G92 has set end.
  bool runToReference(std::uint32_t axes);
  // A line of the trace for a cycle of which no more is known than that it comes back to where it began.
  void traceRound(std::string_view name, const Position& corner);
  void pause(std::string_view text); // a stop for the operator, who reads it; "" for none
  // The control writes a file: where it is, or a value.
  void record(std::string_view file, std::optional<double> value);
  void countBlock(std::uint64_t line); // one that leaves no words for the machine
  void atLine(std::uint64_t line);     // of what is reported and traced from now on

  // ---- ends
  bool raise(stdlib::Alarm alarm, char letter = 0);                             // false
  bool raise(std::uint32_t n, std::string_view text);                           // #3000 = n (text); false
  void message(double number, std::string_view text);                           // #3006
  bool finish();                                                                // false
  bool overLimit(std::string what);                                             // false
  bool inconclusive(std::string why, char letter = 0, std::uint32_t which = 0); // false
  bool meaningless(std::string why, char letter = 0); // the same, because of an argument's value
  // Time goes by: #3001, #3002. Dwells do it by themselves; moves take no time.
  void advance(double seconds) { seconds_ += seconds; }

private:
  friend class OffsetWork; // MachineOffset.cpp
  double
  offsetRadius() const;     // by D in force, mm to the left; 0: none, or the profile does not say where it is
  bool stop(Ending ending); // false
  // Axes whose position is lost by this code, which runs now.
  void lose(std::uint32_t axes, std::string_view code);
  std::string lostText(std::uint32_t axes) const; // which of them, since when and what settles it
  bool motionKnown();                             // false: the run has ended
  bool feedKnown();
  bool executeLong(const ir::NcWords& words);
  bool runBlock(const ir::NcWords& words);
  bool readCodes(const ir::NcWords& words);
  bool checkWords(const ir::NcWords& words);
  bool settings(const ir::NcWords& words);
  bool miscellaneous(const ir::NcWords& words);
  bool stops(const ir::NcWords& words);
  bool oneShot(const ir::NcWords& words);
  bool changeToolLength(const ir::NcWords& words);
  bool changeSystem(const ir::NcWords& words);

  bool dwell(const ir::NcWords& words);
  bool dataInput(const ir::NcWords& words);
  bool setRadius(std::uint32_t tool, bool wear, double value, bool add);
  bool localShift(const ir::NcWords& words);
  bool setPosition(const ir::NcWords& words);
  bool limitsSpindle(const ir::NcWords& words) const; // its S is no speed, but the limit of G92 S
  bool rotationOn(const ir::NcWords& words);
  void rotationOff();
  std::optional<double> rotationAngle(const ir::NcWords& words);
  bool refuseTurned(std::string_view what); // where G68 is on: false, the run has ended
  bool machineMove(const ir::NcWords& words);
  bool reference(const ir::NcWords& words, bool first);
  bool skipMove(const ir::NcWords& words);
  bool move(const ir::NcWords& words);
  bool cannedCycle(const ir::NcWords& words);
  const ir::NcWords& turned(const ir::NcWords& words); // U and W as increments of X and Z
  bool takesTool(std::uint32_t number);
  bool singleCycle(const ir::NcWords& words);
  bool pecks(const ir::NcWords& words, std::size_t along, std::size_t across);
  std::optional<double> pecked(const ir::NcWords& words, char letter); // in mm; nothing: the run has ended
  bool refusedCycle(const ir::NcWords& words);
  bool leg(std::string_view action, MotionKind kind, const Position& end);
  bool arc(const ir::NcWords& words, const Position& end);
  bool plainArc(const ir::NcWords& words, const PlaneAxes& plane, const Position& end) const;
  // To `end`, about a centre that lies by `first` and `second` from here.
  void arcTo(const PlaneAxes& plane, const Position& end, std::uint32_t axes, double first, double second);
  bool cyclePeck(const ir::NcWords& words); // Q and P of a canned cycle; false: the run has ended

  // Of the block that runs, along the axis.
  bool isIncremental(std::size_t axis) const {
    return modes_[kDistance] != 0 || (block_.increments >> axis & 1) != 0;
  }
  // End point of the axes in the block, in the work system; false where an axis is not known or the value
  // does not fit.
  bool target(const ir::NcWords& words, Position& end);
  bool turnTarget(const ir::NcWords& words, Position& end, std::uint32_t unknown);
  // Bits of the axes that a block moves: under G68 one of the plane moves both.
  std::uint32_t movedBy(const ir::NcWords& words) const;
  // After a move to a place in the machine's coordinates.
  void movedInMachine(std::uint32_t axes);
  double lengthOf(const ir::NcWords& words,
                  char letter) const; // mm or degrees, rounded to the least increment
  double rounded(double value, int places) const;
  void updateOffsets();
  bool applyOffsets(); // of a running program; false: the run has ended
  // A position that a variable holds, `axis` of it.
  std::optional<double> turnedVariable(std::uint32_t number, std::size_t axis, const Position& work,
                                       const Position& latched);
  static Position knownOf(Position position, std::uint32_t unknown);
  void traceMove(std::string_view action, const Position& end, bool feed);
  // Says the watcher of a motion of `axes` (bits) to where the machine is now. `certain`: it is known.
  void tellMotion(MotionKind kind, std::uint32_t axes, bool certain = true);
  void tellTo(MotionKind kind, const Position& to, std::uint32_t lost);
  // An arc about a centre that lies by `first` and `second` from its begin, as chords. `work_` is its end.
  void tellArc(const PlaneAxes& plane, std::uint32_t axes, double first, double second,
               const Position& begin);
  void tellHole(const Position& hole, std::uint32_t axes, std::size_t depth);
  const Code* cannedCode() const; // in force; nullptr: none
  const Position& systemOffset() const {
    return modes_[kSystem] == kExtended ? extended_[extendedNow_] : systems_[modes_[kSystem]];
  }

  struct Place; // what a system variable stands for
  bool find(std::uint32_t number, Place& place) const;
  std::optional<double> readSystem(std::uint32_t number, const Place& place); // lengths in mm
  bool inInches(const Place& place) const; // the program reads and writes it in inches now
  double unitOf(const Place& place) const; // mm that 1 is there
  bool findState(std::uint32_t number, Place& place) const;
  std::optional<double> readState(std::uint32_t number, const Place& place);
  bool writeState(std::uint32_t number, const Place& place, double value, bool preset);
  // Of a State: it holds a tool's radius, true: the wear of it.
  std::optional<bool> radiusIn(const Place& place) const;
  bool store(std::uint32_t number, double value, bool preset);
  std::uint32_t windowBytes(const Place& place) const; // 0: the address lies outside

  const stdlib::Control* control_;      // a pointer: a machine can be assigned
  const stdlib::TurningFacts* turning_; // of the control; nullptr: a mill
  Dialect dialect_;
  CodeTable table_;
  Trace* trace_ = nullptr;
  SkipSignal* skip_ = nullptr;
  MotionWatcher* watcher_ = nullptr;
  std::uint32_t deleteLevels_ = 0;

  // What the short way of execute() reads, together.
  std::array<std::uint8_t, kSlots> modes_{};
  std::uint32_t long_ = 0;      // not 0: every block goes the long way, also when the run has ended
  std::uint32_t uncertain_ = 0; // part of that
  std::uint32_t shown_ = 7;
  std::uint32_t needPoint_ = 0; // letters that count increments without a point
  std::uint32_t mostPlaces_ = 3;
  double widest_ = 1e5; // a word of this size has too many digits
  double feed_ = 0;
  double arcTolerance_ = -1; // negative: not known
  std::uint64_t blocks_ = 0;
  Position work_{};

  std::array<std::uint32_t, kGroups> groups_{};
  std::array<double, 26> modalWords_{}; // B D F H M N O S T; others unused
  double speed_ = 0;
  std::uint8_t spindle_ = 0; // 0 off, 1 clockwise, 2 counterclockwise
  std::uint8_t shownSpindle_ = 0;
  Coolant coolant_ = Coolant::NotSwitched;
  double shownSpeed_ = 0;
  Position offset_{}; // sum of what lies between work and machine, tool length aside
  Position external_{}, local_{}, shift_{};
  std::array<Position, 6> systems_{};
  std::vector<Position> extended_;
  std::size_t extendedNow_ = 0;
  Rotation rotation_;
  std::uint32_t afterRotation_ = 0; // axes of which the next word has to be absolute, since G69 turned back
  double toolLength_ = 0;           // added to Z
  bool lengthKeepsPlace_ = false;
  std::uint32_t toolNumber_ = 0;
  std::vector<ToolOffset> tools_;
  std::vector<double> toolRadii_;        // that cycles have set, by number
  Position skipped_{}, skippedTurned_{}; // in the work system, and as the program counts under G68
  // Canned cycles: the level at the cycle's begin, and what stays in force within it.
  double initialLevel_ = 0, cycleR_ = 0, cycleDepth_ = 0;
  bool hasR_ = false, hasDepth_ = false;
  double cyclePeck_ = 0, cycleDwell_ = 0; // mm; seconds
  OffsetState offsets_;
  bool roundsCorners_ = false;
  double seconds_ = 0, timerBase_ = 0, hoursBase_ = 0;
  // Of a lathe: the block with increments as words of their axes; ends and taper that the single cycle in
  // force repeats; the return after a peck by axis, which the first of two blocks gives.
  ir::NcWords turnedWords_;
  Position cycleEnd_{};
  double cycleTaper_ = 0;
  std::uint32_t cycleAxes_ = 0;
  std::array<std::optional<double>, 3> peckReturn_;

  CellLayout layout_;
  std::vector<double> cells_;
  std::vector<std::uint32_t> measured_;
  std::vector<double> saved_;                             // locals of the levels below
  std::vector<std::pair<std::uint32_t, double>> presets_; // cell and value
  std::map<std::uint32_t, double> givenOffsets_; // tool offsets of unknown meaning that preset() gave a value
  std::vector<double> state_;                    // by range of the control; kFresh: not known
  std::vector<std::uint8_t> pmc_;
  double pmcAddress_ = -1;
  Probe probe_ = Probe::NotSwitched;
  Skip lastSkip_ = Skip::None;
  bool touched_ = false;
  double stopsBeyond_ = 0;
  Position beyond_{}; // of the last skip move
  bool skipPositions_ = false;
  bool motionForgotten_ = false, feedForgotten_ = false;
  bool hasUnknown_ = false; // a cell may hold kUnknown
  std::uint32_t level_ = 0;
  std::uint32_t callLimit_ = 32;
  bool moved_ = false;
  // For the watcher: where the machine is, axes of which that is not known, and whether the tool's length
  // may have been cancelled by a reference return.
  Position at_{};
  std::uint32_t lost_ = 0;
  std::string_view lostBy_; // the last code that took positions away, and its line
  std::uint64_t lostLine_ = 0;
  bool keepsLength_ = false;
  bool lengthInDoubt_ = false;
  std::vector<Frame> stack_;
  RunEnd end_;

  // Of the block that runs the long way.
  struct BlockCodes {
    stdlib::Function oneShot = stdlib::Function::Other;
    bool hasOneShot = false;
    std::uint32_t slots = 0;                   // bit by Slot
    std::array<std::uint8_t, kSlots> before{}; // modes before the block
    std::uint32_t call = 0;                    // not 0: a call or a return is in the block
    bool endsRotation = false;
    std::uint32_t increments = 0; // of a lathe: axes (bits by number) whose words are increments
  } block_;
};

} // namespace dotek::sim
