// What the parts of the back end share while they write one program.
#pragma once

#include "backends/mikroprog/Sheet.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Mikroprog.h"

#include <algorithm>
#include <array>
#include <deque>

namespace dotek::backends::mikroprog {

// One axis while the program runs as planned: every surface where the source expects it.
struct AxisState {
  std::optional<double> at; // in the coordinates of the source, mm; nothing: not known
  double shift = 0;         // of the control's coordinate against the source's, since a datum was set
  bool datum = false;       // a datum was set
};

// A subprogram after M30.
struct Subprogram {
  Mark entry = 0;
  Sheet sheet;
};

struct State {
  State(const ir::Cycle& cycleOf, const EmitOptions& optionsOf, Diagnostics& report)
      : cycle(cycleOf), options(optionsOf), control(optionsOf.control), diagnostics(report) {}

  template <class Id, class... Args> Diagnostic& refuse(SourceRange range, const Args&... args) {
    failed = true;
    return diagnostics.report<Id>(range, args...);
  }
  Mark mark() { return nextMark++; }
  // Code of a function: code("jump") is "G27".
  std::string code(std::string_view what) const { return control.function(what).code(); }
  double host(std::string_view name) const { return options.hosts.at(std::string(name)); }

  void reaches(ir::Axis axis, double place) {
    if (axis == ir::Axis::Z) highest = std::max(highest.value_or(place), place);
  }

  // mm beyond what is expected: of the call that is being written, else for the whole program.
  double overtravel() const { return overtravelGiven ? *overtravelGiven : host("overtravel"); }

  const ir::Cycle& cycle;
  const EmitOptions& options;
  const stdlib::MikroprogControl& control;
  Diagnostics& diagnostics;

  Sheet sheet; // the main program
  std::deque<Subprogram> subprograms;
  Mark nextMark = 0;
  Mark notFound = 0, collision = 0, end = 0;
  bool usesNotFound = false, usesCollision = false, usesEnd = false;

  std::array<AxisState, 3> axes;
  std::array<std::optional<double>, 3> start; // where the cycle begins, in the coordinates of the source
  std::optional<double> highest;              // Z that the program goes to, in the coordinates of the source
  double raised = 0;                          // by how much Z counts more after a datum, at most; mm
  std::optional<double> feed;                 // in force in the source, mm/min
  std::optional<std::string> datumSystem;     // work offset of the source that G92 has set
  bool guarded = false;                       // O7 was asked since the last stop
  std::size_t guards = 0, probeMoves = 0;
  std::set<std::uint32_t> relied;           // questions that the program relies on
  std::vector<std::string> remarks;         // of the header: what is dropped or changed
  std::set<std::string> remarked;           // what is said once
  std::set<const ir::CycleStatement*> done; // written before their place
  std::optional<double> overtravelGiven;
  std::optional<std::vector<DrawnSurface>> drawn; // EmitOptions::drawnSurfaces, once it was asked
  bool oneOfSeveral = false; // of the touches of a cycle: each goes back to where the cycle began
  bool failed = false;
};

ir::Origin made(std::string reason, const ir::Origin& from = {});

// ---- Places.cpp ----

// A number as a word takes it: rounded to the control's decimals (a warning), refused where it is too long.
std::string numberWord(State& state, double value, SourceRange range);
// "X-10": `value` in coordinates of the control, X of a lathe still a radius.
std::string axisWord(State& state, ir::Axis axis, double value, SourceRange range);
// The same for a comment: "X8", a diameter where the control counts one, and nothing is reported.
std::string shownPlace(const State& state, ir::Axis axis, double value);
// A length along the axis for a remark: "40 MM", "80 MM (DIAMETER)".
std::string shownLength(const State& state, ir::Axis axis, double value);
// The value of a folded expression; refuses what only the running program could know.
std::optional<double> valueOf(State& state, const ir::ExpressionPtr& value, SourceRange range);
// The same; refuses a number below 0, and 0 where `zero` is not allowed. `what` for the message: "a feed".
std::optional<double> rangedValueOf(State& state, char letter, const ir::ExpressionPtr& value,
                                    std::string_view what, bool zero, SourceRange range);
// A coordinate in the coordinates of the source.
std::optional<double> placeOf(State& state, const ir::Coordinate& coordinate, ir::Axis axis,
                              SourceRange range);
// Where the probe is, in the coordinates of the source; refuses where nothing tells.
std::optional<double> hereOf(State& state, ir::Axis axis, SourceRange range);
// Refuses an axis that the control does not have.
bool checkAxis(State& state, ir::Axis axis, SourceRange range);
// The program relies on these readings. false where one is not taken as given: refused, with all numbers.
bool relyOn(State& state, const std::vector<std::uint32_t>& questions, std::string_view what,
            SourceRange range);
// Printable ASCII for a comment or the panel; a note where a character is lost.
std::string asciiText(State& state, const std::string& text, SourceRange range);

// ---- Probing.cpp ----

// O7 before the first probe move of a chain.
void guard(State& state, const ir::Origin& origin);
// false: refused, `system` is none of G54 to G59.
bool guardSystem(State& state, double system, SourceRange range);
// Before a datum by G92, which sets the active system whatever the source names; false: refused.
bool onlyDatum(State& state, const std::string& system, SourceRange range);
// A move that must meet nothing.
void protectedMove(State& state, const ir::Move& move, const ir::Origin& origin);
// A move to where contact is wanted: G31 with L to the tail.
void search(State& state, ir::Axis axis, double target, const ir::Origin& origin, std::string comment);
void record(State& state, const ir::Origin& origin);
// The statement at `index` of the body measures.
void measure(State& state, const ir::Measure& measure, std::size_t index);

// ---- Bore.cpp ----

// What is touched from outside, from above its middle: how far beside the ball its walls are on the way down,
// and how deep the touches are (Z, in the coordinates of the source); mm.
struct Outside {
  double clearance = 0, depth = 0;
};
// What has a middle: "bore", and what its size is called: "a diameter".
struct Feature {
  std::string_view name, size;
  std::optional<Outside> outside = {};
};
// The middle between walls along each of `axes`, X and Y or one of them, from about where the probe is.
void middle(State& state, const std::vector<ir::Axis>& axes, const Feature& feature,
            const ir::ExpressionPtr& size, const std::optional<ir::OffsetSetting>& setting,
            const ir::Origin& origin);

// ---- Cycles.cpp ----

// A cycle by the touches that it consists of; refused where G31 cannot do it.
void cycle(State& state, const ir::CallCycle& cycle, std::size_t index);

// ---- Header.cpp ----

std::vector<std::string> headerLines(const State& state);

} // namespace dotek::backends::mikroprog
