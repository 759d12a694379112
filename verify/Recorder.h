// Writes a Record while a program runs on a machine in a world.
#pragma once

#include "sim/machine/Run.h"
#include "sim/machine/SafeMoves.h"
#include "sim/machine/World.h"
#include "stdlib/MacroSet.h"
#include "verify/Interference.h"
#include "verify/Record.h"

#include <array>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace dotek::verify {

// A move that ends this near before a surface touches it (mm): programs that end a travel on the nominal
// surface.
inline constexpr double kTouchSlack = 1e-6;

class Recorder final : public sim::SkipSignal, public sim::MotionWatcher {
public:
  // All outlive the recorder. `sets`: whose calls are taken as one thing each; a program of one number in
  // several sets is taken by the first.
  Recorder(sim::Machine& machine, sim::World& world, std::vector<const stdlib::MacroSet*> sets,
           double toolLength);

  // Before the run: entry state is taken here.
  void begin(const sim::Run& run, bool keepMoves);
  // The same of what is no program; `place` says where it is.
  void begin(std::function<SourceRange()> place, bool keepMoves);
  std::optional<double> contact(const sim::SkipMove& move) override;
  void moved(const sim::MachineMotion& motion) override;
  void probeSwitched(bool on) override;
  void positionSet() override { mark(Mark::Kind::Datum); }
  void paused(std::string_view text) override {
    mark(Mark::Kind::Stop, text);
    note(Deed::Kind::Stop, 0, text);
  }
  void messaged(double number, std::string_view text) override { note(Deed::Kind::Stop, number, text); }
  void toolChanged(std::uint32_t number) override { note(Deed::Kind::ToolChange, number); }
  void absentCalled(std::uint32_t program) override { note(Deed::Kind::Subprogram, program); }
  void auxiliary(std::uint32_t code) override { note(Deed::Kind::Auxiliary, code); }
  void dwelled(double seconds) override { note(Deed::Kind::Dwell, seconds); }
  void recorded(std::string_view file, std::optional<double> value) override {
    mark(value ? Mark::Kind::Value : Mark::Kind::Position, file, value.value_or(0));
  }
  bool isThere(const sim::SkipMove& here) override;
  void callBegins(std::uint32_t program, std::span<const double> locals) override;
  void callEnded(std::uint32_t program) override;
  void touchedApart() override;
  void callUnstated(std::string_view what, std::span<const double> locals) override;
  void touchBegins(std::span<const sim::PlannedTouch> touches) override;
  void touchEnded() override { endOwn(); }
  void protectedBegins(std::optional<double> feed) override;
  void protectedEnded() override { endOwn(); }
  void offsetWritten(const sim::OffsetWrite& write) override;
  void assumeProbe(Switch probe) { probe_ = probe; }
  // Without a part: each measuring move makes its contact, no other one does. So a run shows all that the
  // program would measure. A bare skip move makes it at this share of its path, or where it comes to the
  // plane of an earlier one; what calls do makes it where they expect their surface, else at its end.
  void rehearse(double share) { rehearsal_ = share; }
  // Blocks of skip moves that are meant to meet nothing, though no vendor's macro makes them. nullptr: none.
  void watchOnly(const sim::BlockSet* blocks) { watching_ = blocks; }

  // Each datum that a call sets moves the active system as well, by as much as the signal came beside the
  // place of its surface, whether the ball gave it or the stem: the path goes on as that of a control which
  // has no other system to set.
  void datumsMovePath() { datumsMovePath_ = true; }
  // Surfaces for Measure::drawn; before begin().
  void expectDrawn(const std::vector<Touch>& surfaces) { drawn_ = surfaces; }
  void interfere(const Interference& interference) { interference_ = interference; }
  // Before begin(): variables for Record::strays. Outlive it.
  void watchStores(const std::set<std::uint32_t>& numbers) { watchedStores_ = &numbers; }

  // After the run. `stores`: common variables whose end values count.
  Record finish(const std::set<std::uint32_t>& stores);

private:
  sim::Point3 lowest(const sim::Position& machine) const;
  sim::Point3 offset() const; // from the active work system to the machine, without the tool's length
  Surroundings surroundings() const;
  // Of the call that is open, with the zeros kept that it begins with.
  Measure begunMeasure();
  SourceRange place() const;
  std::array<std::uint32_t, 3> modes(bool call) const;
  WorkFrame frame() const;
  void addPiece(sim::PathKind kind, const sim::Point3& from, const sim::Point3& to, SourceRange range);
  double rehearsedContact(const sim::SkipMove& move);
  // Of a call's touch, as a share of its path: 1 where no surface is expected on it.
  double expectedContact(const sim::Point3& from, const sim::Point3& direction, double length) const;
  std::optional<double> placedContact(const sim::SkipMove& move, double length, std::size_t search,
                                      std::optional<double> share) const;
  void mark(Mark::Kind kind, std::string_view text = "", double value = 0);
  void note(Deed::Kind kind, double value, std::string_view text = "");
  void movePath(const Measure& measure);
  std::optional<sim::Point3> drawnOnWay(const Measure& measure) const;
  void noteDatums(Measure& measure) const;
  void noteSignal(const sim::ProbeEvent& event);
  void disturb(std::size_t pieces);       // how many belong to it and are still to come
  double obstacleAt(double length) const; // as a share of the path
  bool interferesInCall(double length, std::optional<double>& share);
  bool isMissed(std::optional<std::size_t> wanted, std::size_t number) const;
  // mm that an interference lets a surface be met earlier.
  double nearerBy(std::optional<std::size_t> search) const;
  void takeEvents();
  void noteSystem(const stdlib::MacroSignature& signature, std::span<const double> locals);
  void noteOptions(const stdlib::MacroSignature& signature, std::span<const double> locals,
                   Measure& measure) const;
  void noteEarlyUses();
  void noteLocals();
  void beginOwn();
  void endOwn();
  void endCall();
  std::string alarmKindOf(const sim::RunEnd& end) const;

  sim::Machine& machine_;
  sim::World& world_;
  std::vector<const stdlib::MacroSet*> sets_;
  const double length_;
  std::array<std::uint32_t, 3>
      groups_{}; // modal groups of the plane, the kind of feed, the distance; 0: none
  const sim::Run* run_ = nullptr;
  std::function<SourceRange()> place_;
  bool keepMoves_ = false;
  std::optional<double> rehearsal_; // share of the path of a bare skip move
  std::vector<Touch> rehearsed_;
  const sim::BlockSet* watching_ = nullptr;
  bool datumsMovePath_ = false;
  std::vector<Touch> drawn_;          // expectDrawn()
  std::array<double, 3> pathMoved_{}; // by datums, mm
  Interference interference_;
  bool positions_ = false;         // the skip move that runs is meant to meet nothing
  std::optional<sim::Point3> aim_; // where it ends without contact
  Switch probe_ = Switch::Off;
  Record record_;
  std::size_t events_ = 0;                      // of the world, that were taken
  std::vector<sim::Machine::ToolOffset> tools_; // at entry
  std::vector<sim::Position> extended_;         // zeros of G54.1 Pn at entry
  std::uint32_t tool_ = 0;                      // that T had named before
  const std::set<std::uint32_t>* watchedStores_ = nullptr;
  std::map<std::uint32_t, double> storedBefore_; // of these, at entry
  // A call that counts as one thing, with what it calls itself.
  struct OpenCall {
    std::uint32_t depth = 0; // 0: none
    bool measures = false, moves = false;
    std::uint32_t program = 0;
    sim::Point3 start;
    SourceRange range;
    Surroundings with;
    std::uint32_t system = 0;              // that the call names, 54 to 59; 0: none
    std::array<bool, 3> names{};           // axes whose coordinate it names
    std::array<sim::Position, 6> zeros;    // of G54 to G59, of one that measures
    std::optional<double> feed;            // an argument
    std::map<std::uint32_t, double> given; // arguments by local
    bool goesOn = false;                   // Piece::goesOn
    std::optional<std::size_t> number;     // among the protected moves, or the calls that measure
    std::array<std::uint32_t, 3> modes{};
    WorkFrame frame;
    std::size_t moved = 0;            // touches after which the path was moved (touchedApart)
    std::vector<sim::Point3> signals; // centres of the ball where a measuring move was stopped
  } call_;
};

} // namespace dotek::verify
