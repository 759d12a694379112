// Runs a program of Mikroprog in a world and tells, step by step, what it does. What is compared with the
// posted program is in docs/verify.md.
#pragma once

#include "sim/machine/Mikroprog.h"
#include "sim/machine/World.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dotek::verify {

// Positions are those of the stylus's lowest point in coordinates of the machine, without the tool's length.
struct MikroprogStep {
  enum class Kind : std::uint8_t {
    Rapid,
    Feed,
    Protected, // G31: without contact the program goes on, with one it ends in the collision tail
    Search,    // G31: with contact the program goes on, without one it ends in the not-found tail
    Record,    // M25
    Value,     // M26
    Datum,     // G92
    Stop,      // M0
  };
  Kind kind = Kind::Feed;
  sim::Point3 from, to;
  sim::Point3 aim;                        // of a G31: where it ends without contact
  std::optional<sim::ProbeEvent> contact; // of a Search
  std::optional<bool> spindle, coolant;   // as M3 to M9 have said by then
  sim::Point3 zero;                       // Datum: of the active system, after it
  double value = 0;                       // Value: P90
  std::string text;                       // Stop
  std::uint32_t line = 0;                 // of the program's text

  bool moves() const { return kind <= Kind::Search; }
};

struct MikroprogRecord {
  enum class Ending : std::uint8_t {
    Finished,
    NotFound,  // in the tail of a surface that is not there
    Collision, // in the tail of a contact where none is expected
    Broken,    // a fault of the control, or what it does is not known
  };
  Ending ending = Ending::Finished;
  std::string why; // Broken
  std::uint32_t endLine = 0;
  std::vector<MikroprogStep> steps;
  // What the probe, its stem or its body meets, and in which line.
  std::vector<std::pair<sim::ProbeEvent, std::uint32_t>> events;
  sim::Point3 start, end;
  // That ran; probe moves of no length do not count. A guard is a question for O7.
  std::size_t searches = 0, protectedMoves = 0, guards = 0;
  // The first step after what was asked for (Interference); nothing: it did not come to that.
  std::optional<std::size_t> disturbed;
};

// What the probe tells against what is there, each by its number in the run from 0.
struct Interference {
  std::optional<std::size_t> missing;  // this search finds nothing
  std::optional<std::size_t> obstacle; // this protected move is stopped half way
  std::optional<std::size_t> touching; // this guard finds contact
};

class MikroprogStand {
public:
  // Both outlive the stand. The tool's length ends at the ball's lowest point.
  MikroprogStand(const stdlib::MikroprogControl& control, const sim::BlockList& program);

  // `start` and `zero`: where the stylus's lowest point is and the active system has its zero, in
  // coordinates of the machine. The probe is on all the time. The world is restarted.
  MikroprogRecord run(sim::World& world, const sim::Point3& start, const sim::Point3& zero,
                      const Interference& interference = {}) const;

private:
  enum class Tail : std::uint8_t { None, NotFound, Collision };
  Tail tailAt(std::size_t block) const;
  void classify();

  const stdlib::MikroprogControl& control_;
  const sim::BlockList& program_;
  std::map<std::uint32_t, MikroprogStep::Kind> probeMoves_; // by line
  std::string fault_;                                       // of the program's shape; "": none
  std::uint32_t faultLine_ = 0;
};

// Whether the run went as far as the interference, then stopped and ended in the tail that is meant for it:
// nothing moved any more, no datum was set. "" or what it did instead.
std::string whyNotCaught(const MikroprogRecord& record, MikroprogRecord::Ending tail);

} // namespace dotek::verify
