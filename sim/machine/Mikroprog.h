// The machine after a program of Mikroprog, as far as programs that Dotek writes need it: moves, the probe,
// G92, jumps, subprograms, P90. What no source states is taken as the profile's questions take it; what is
// unknown beyond that ends the run as inconclusive. Lengths are mm, X of a lathe is kept as a radius.
#pragma once

#include "sim/machine/BlockList.h"
#include "sim/machine/Machine.h"
#include "stdlib/MikroprogControl.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dotek::sim {

enum class MikroprogEnding : std::uint8_t {
  Running,
  ProgramEnd, // M30
  Fault,      // of the control: G31 finds nothing and has no L, M17 without a call, a jump to nowhere
  Crash,      // a move without the probe's watch meets the part
  Inconclusive,
  Endless, // more blocks than allowed
};

struct MikroprogEvent {
  enum class Kind : std::uint8_t {
    Contact, // G31 was stopped
    NoContact,
    Record, // M25: `text` is the file
    Value,  // M26: `value` is P90
    Datum,  // G92
    Stop,   // M0: `text` is what the panel shows
  };
  Kind kind = Kind::Contact;
  std::uint64_t block = 0;          // N; 0: none
  std::array<double, 3> position{}; // of the active system, after the event
  std::array<double, 3> machine{};  // of the machine
  double value = 0;
  std::string text;
};

class MikroprogMachine {
public:
  // `control` and `program` outlive the machine.
  MikroprogMachine(const stdlib::MikroprogControl& control, const BlockList& program);

  // nullptr: no part, G31 ends the run as inconclusive. O7 asks it with a move of no length.
  void setSkipSignal(SkipSignal* signal) { signal_ = signal; }
  // Without a watcher the signal is asked in each motion, and one that does not watch for it crashes. With
  // one the signal is for G31 and O7, and the watcher sees to the rest; it may end the run by inconclusive().
  void setWatcher(MotionWatcher* watcher) { watcher_ = watcher; }
  void setTrace(Trace* trace) { trace_ = trace; } // nullptr: quiet
  // Where the machine is before the program; the active system counts from the machine's zero.
  void setPosition(const std::array<double, 3>& machine) { machine_ = machine; }
  // Zero of the active system at the start, in coordinates of the machine.
  void setOffset(const std::array<double, 3>& offset) { offset_ = offset; }

  // Runs to an end, at most so many blocks and 100,000 events.
  void run(std::uint64_t mostBlocks = 100000);
  void inconclusive(std::string why) { stop(MikroprogEnding::Inconclusive, std::move(why)); }

  MikroprogEnding ending() const { return ending_; }
  const std::string& why() const { return why_; }  // of a fault, a crash, an inconclusive end
  std::uint32_t line() const { return line_; }     // of the text, of the block that ran last
  std::vector<std::uint32_t> openCalls() const;    // lines of the calls that are open, the outermost first
  std::uint64_t blocks() const { return blocks_; } // that ran
  const std::vector<MikroprogEvent>& events() const { return events_; }
  // What M3, M4, M5 and M8, M9 said last; nothing: none of them yet.
  std::optional<bool> spindle() const { return spindle_; }
  std::optional<bool> coolant() const { return coolant_; }
  // What the panel showed last; "" for nothing.
  std::string lastStop() const;
  std::array<double, 3> position() const; // of the active system
  const std::array<double, 3>& machinePosition() const { return machine_; }
  const std::array<double, 3>& offset() const { return offset_; }
  std::optional<double> parameter(std::uint32_t number) const;
  const std::map<std::uint32_t, double>& parameters() const { return parameters_; } // that have a value

private:
  bool stop(MikroprogEnding ending, std::string why); // false
  bool block(const ListedBlock& block);
  bool assign(const ir::Store& store);
  std::optional<double> value(const ir::ExpressionPtr& expression);
  std::optional<double> word(const ListedBlock& block, char address);
  std::optional<double> scaled(const ListedBlock& block, std::size_t axis);
  bool target(const ListedBlock& block, std::array<double, 3>& to, bool& any);
  bool jump(const ListedBlock& block);
  std::optional<bool> condition(std::uint32_t number);
  bool move(const ListedBlock& block, const std::string& motion);
  bool probe(const ListedBlock& block);
  bool setPosition(const ListedBlock& block);
  bool call(const ListedBlock& block);
  bool function(const ListedBlock& block, const std::string& what);
  std::array<double, 3> inSystem(const std::array<double, 3>& machine) const;
  SkipMove skipMove(const std::array<double, 3>& to) const;
  void tell(MotionKind kind, const std::array<double, 3>& from);
  void traceMove(std::string_view action, bool feed);
  void event(MikroprogEvent::Kind kind, std::string text = "", double value = 0);

  const stdlib::MikroprogControl& control_;
  const BlockList& program_;
  SkipSignal* signal_ = nullptr;
  MotionWatcher* watcher_ = nullptr;
  Trace* trace_ = nullptr;
  std::array<double, 3> machine_{}, offset_{};
  std::map<std::uint32_t, double> parameters_;
  std::vector<std::size_t> returns_;
  std::string motion_ = "rapid";
  bool incremental_ = false;
  double feed_ = 0;
  std::optional<bool> spindle_, coolant_;
  std::size_t next_ = 0;
  std::uint64_t number_ = 0, blocks_ = 0;
  std::uint32_t line_ = 0;
  MikroprogEnding ending_ = MikroprogEnding::Running;
  std::string why_;
  std::vector<MikroprogEvent> events_;
};

} // namespace dotek::sim
