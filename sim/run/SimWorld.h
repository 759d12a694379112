// The world of a simulated run: the part and the probe of --part and --machine, and the pictures. What
// happens there becomes findings at the block that runs, with the calls that are open.
#pragma once

#include "project/Session.h"
#include "sim/device/Device.h"
#include "sim/geometry/Probe.h"
#include "sim/machine/Machine.h"
#include "sim/machine/MissWatcher.h"
#include "sim/machine/SystemWatcher.h"
#include "sim/machine/World.h"
#include "sim/picture/PictureRecorder.h"
#include "sim/run/Clearance.h"
#include "sim/run/MeasuredLog.h"
#include "sim/run/Options.h"
#include "sim/stock/StockRun.h"
#include "support/OutputFile.h"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace dotek::sim {

using project::Session;

// Where a run is.
struct RunPlace {
  SourceRange range;              // of the block
  std::vector<SourceRange> calls; // the outermost first
  std::uint64_t program = 0;      // O number of the one that holds the block; 0: none
};

class SimWorld final : public SkipSignal, public MotionWatcher, public SystemWatcher, public MissWatcher {
public:
  using PlaceNow = std::function<RunPlace()>;

  // nullptr: an error was reported. `command`: that messages name.
  static std::unique_ptr<SimWorld> load(const SimOptions& options, Session& session,
                                        std::string_view command = "sim");
  // The same for a cycle, which runs on no control: as far as nothing says otherwise the probe is tool 1 and
  // in the spindle. Without a machine's file its stylus is `stylus`, and it begins at X0 Y0 Z0 of G54.
  static std::unique_ptr<SimWorld> loadForCycle(const SimOptions& options, const Probe& stylus,
                                                Session& session);
  // A part that no file gives.
  void setPart(const Part& part) { world_->setPart(part); }
  const Probe& probe() const { return machine_->probe; } // of one for a cycle
  bool hasMachineFile() const { return options_.machine.has_value(); }

  // What the flags and the machine's file say of what is set before the run.
  const Setup& setup() const { return setup_; }
  const std::optional<std::array<double, 3>>& partZero() const {
    return partZero_;
  } // where it is meant to be
  // Sets it on the machine; false: reported. Where the program begins is for attach().
  bool prepare(Machine& machine) const;
  // Where the machine is before the program.
  Position startOf(const Machine& machine) const;
  // Whether the setup puts it within the travel of the machine's file, with the offsets that are set by now;
  // false: reported.
  bool startsWithinTravel(const Machine& machine) const;
  // From now on the machine, which gets its start, asks this world. Nothing else happens where neither a
  // part, nor a machine, nor a picture was asked for.
  void attach(Machine& machine);
  // To be set before the run: asked for each event, and `block` for each motion of a picture; without `block`
  // the place says it.
  void setPlace(PlaceNow place, PictureRecorder::BlockNow block = nullptr) {
    place_ = std::move(place);
    block_ = std::move(block);
  }
  void setCallKind(PictureRecorder::CallKind kind) { callKind_ = std::move(kind); }
  void setReader(MeasuredLog::Reader reader) { log_.setReader(std::move(reader)); }
  // Asked at each skip move: whether its block goes to a position and watches for the part on the way there.
  void setSafeMove(std::function<bool()> safe) { safe_ = std::move(safe); }
  // Asked where the program reads where it has come to: whether the block that runs asks what the last skip
  // move came to (askingBlocks).
  // Runs beside the machine (SimDevice.cpp); nullptr: none. It outlives the run.
  void setDevice(Device* device);
  // The block that runs, where that is known without work: findings name the one before.
  void setRange(std::function<SourceRange()> now) { rangeNow_ = std::move(now); }
  void setAsks(std::function<bool()> asks) { asks_ = std::move(asks); }
  // Asked where an offset is written: the miss that the value comes from (missIn); 0: none.
  void setMissInHand(std::function<std::uint32_t()> miss) { missInHand_ = std::move(miss); }
  // Offsets that are written are kept also where there is neither part nor machine nor picture.
  void keepOffsets() { keepsOffsets_ = true; }

  bool hasPicture() const { return picture_; }
  // Of a macro that is called: what nobody has said of where it begins, where the run has ended because of
  // that, as far as it shows; "": nothing, or it was said.
  std::string startAdvice() const;
  // The run has ended where the machine would leave its travel; what reports the over-travel says so.
  bool endedOutside() const { return endedOutside_; }
  // The radius that the calibration of the stylus would have found; nothing: no machine was given.
  std::optional<double> calibratedRadius() const;

  // A common variable counted as 0 at `range`, since nobody has set it.
  void unsetRead(std::uint32_t number, SourceRange range);
  // What a run came to as a whole, beside what it touched: `found` is a row of the table.
  void addFound(const Measurement& found);
  // Of the pictures; without lines it is none.
  void addList(PictureList list);
  // Collisions of the run, and touches that nothing asked for.
  std::uint64_t collisions() const;
  // What the banner of the pictures calls what ran: "cycle".
  void setSubject(std::string_view subject) { subject_ = subject; }

  // After the run and after reportRest(): the pictures that were asked for.
  std::vector<OutputFile> pictures() const;
  // What was measured, and what was cut, as text; "": nothing.
  std::string measuredTable() const;
  void reportRest(); // what was too much to be reported one by one
  // "measured", "contacts" and "events" of the summary, each on a line that ends with a comma.
  std::string summary() const;
  // "records" and "stops", in the same way.
  std::string notes() const;

  std::optional<double> contact(const SkipMove& move) override;
  bool isThere(const SkipMove& here) override;
  void moved(const MachineMotion& motion) override;
  void probeSwitched(bool on) override;
  void paused(std::string_view text) override;
  void recorded(std::string_view file, std::optional<double> value) override;
  void positionRead(bool skip) override;
  void toolChanged(std::uint32_t number) override;
  void auxiliary(std::uint32_t code) override;
  void lengthNotSet(std::uint32_t offset) override;
  void dwelled(double seconds) override;
  void systemWritten(std::uint32_t variable, double value) override;
  std::optional<double> systemRead(std::uint32_t variable) override;
  void callBegins(std::uint32_t program, std::span<const double> locals) override;
  void callEnded(std::uint32_t program) override;
  void touchBegins(std::span<const PlannedTouch> touches) override;
  void touchEnded() override;
  void reported(const Measurement& line) override { addFound(line); }
  void measured(const Measurement& found) override { log_.measured(found); }
  void offsetWritten(const OffsetWrite& write) override;
  bool hasMisses() const override { return !misses_.empty(); }
  std::uint32_t missIn(std::uint32_t variable) const override;
  double wayIn(std::uint32_t variable) const override;
  void askedAbout(std::uint32_t miss, bool tells, SourceRange block) override;
  bool isOpen() const override;
  void passedAlarm(SourceRange block) override;
  void shiftedBy(std::uint32_t miss) override;
  void placeSet(std::uint32_t axes) override;

private:
  static constexpr std::size_t kMostKept = 10'000; // of contacts and of events, in the summary
  static constexpr std::uint32_t kMostToldAt = 3;  // of each outcome at one block
  static constexpr std::uint32_t kMostTold = Diagnostics::kMostAlike; // of each outcome

  struct Kept {
    ProbeEvent event;
    RunPlace place;
    bool unseen = false; // of a miss: the program came to its end without having seen it
  };
  struct KeptMiss {
    Kept kept;
    std::size_t index = 0, move = 0; // in events_; in the moves of the picture
    bool meant = false;              // an IF looks at its end, and nothing keeps it
    bool seen = false;               // by a condition that would have come out otherwise elsewhere
    SourceRange blind, passed;       // a condition that would not; an IF over an alarm that looks elsewhere
  };
  struct Told {
    std::uint32_t number = 0;
    std::string_view code;
    Severity severity = Severity::Note;
    SourceRange next;        // the first that was not reported
    std::uint64_t block = 0; // the last: which block of the run
  };

  // A skip move that was to measure and met nothing, until it is known what the program makes of its end.
  struct Missed {
    Kept kept;
    std::size_t index = 0; // in events_; beyond its end: it is not kept
    PictureMeasured row;
    bool ended = false, movedOn = false;
    Point3 way{};             // of the motion
    std::uint32_t number = 0; // in misses_, from 1
  };

  SimWorld(const SimOptions& options, Session& session) : options_(options), session_(session) {}
  bool takeBall(const Setup& given);
  bool loadFiles(const Setup& given);
  bool isBesideItsPath(); // by cutter compensation, where that matters: the run has ended
  void takeLength();      // of a tool that is in no list
  bool isActive() const { return world_.has_value() || picture_ || device_ != nullptr || stock_.has_value(); }
  void begin();
  void checkSystem(); // that somebody has set the work system that the probe measures in
  void finishPicture();
  void takeEvents();
  void tell(const ProbeEvent& event, const RunPlace& place);
  void take(const ProbeEvent& event, const RunPlace& place);
  // Before a skip move; the last one, where this goes on from there.
  std::optional<Missed> beginSearch(const SkipMove& move);
  void keepMiss(Kept miss, std::size_t index, bool meant);
  void tellUnseen();  // at the end of the run
  void addWarnings(); // to the picture
  void addInputs();   // the same
  // The axis of a variable along which the last skip move went; nothing: it holds nothing of its end.
  std::optional<std::size_t> axisOfMiss(std::uint32_t variable) const;
  void missEnded(const MachineMotion& motion);
  void checkMiss(const OffsetWrite& write);
  void useMiss();
  void settleMiss(); // nothing more is known of the last one
  // The skip move that begins goes on where the last one met nothing: that was an approach.
  bool goesOn(const SkipMove& move) const;
  void takeBackMiss(const Missed& miss);
  void tellMiss(const Missed& miss);
  // SimDevice.cpp: where the probe is, with the errors of the machine.
  bool isTouching();
  SkipMove shifted(const SkipMove& move) const;
  MachineMotion shifted(const MachineMotion& motion) const;
  // SimFaults.cpp: what is wrong though nothing touches.
  void addFault(Diagnostic diagnostic, Verdict verdict, std::string_view word, const RunPlace& place,
                std::optional<Point3> at = std::nullopt); // of the ball, in the move that runs
  void checkSpindle();
  void stopSpindle();
  void checkLength(const MachineMotion& motion);
  void noteHeight();
  void checkHeight(const MachineMotion& motion);
  void noteEmptyOffset(Diagnostic& finding) const; // of the tool in the spindle, which has a length
  void noteStart(Diagnostic& finding);             // what startText() says, once
  std::string startText() const;
  void noteZeroLeftOut(Diagnostic& finding) const; // of a machine's file, which counts with a part alone
  void tellZeroLeftOut(const Machine& machine);
  // SimStock.cpp: the block of --stock.
  bool loadStockFile(); // false: reported
  void followStock(const MachineMotion& motion);
  void finishStock();
  // SimTouch.cpp: touches that measure something else than the program takes them for.
  void checkEdge(const ProbeEvent& event, const RunPlace& place);
  void checkWear(const OffsetWrite& write);
  void tellToolLengths(); // at the end of the run: offsets of tools whose length the machine's file knows
  void followClearance(const MachineMotion& motion);
  void tellFar(); // at the end of the run
  void addTold(Diagnostic diagnostic, std::size_t kind, const RunPlace& place);
  bool isTold(const ProbeEvent& event) const; // false: it is one too many
  bool isInProtectedCall() const { return !protected_.empty() && protected_.back(); }
  bool isProtected() const;                          // of the skip move that runs: it wants no contact
  bool isMeantToMiss(const ProbeEvent& event) const; // within a protected move
  bool isSame(const ProbeEvent& event); // of the block as one before: another chord of an arc, say
  PictureBlock blockNow() const;
  std::string placeJson(const SourceRange& range) const;
  std::string json(const Kept& kept) const;
  std::string measuredJson() const;

  const SimOptions& options_;
  Device* device_ = nullptr;
  Session& session_;
  std::optional<MachineFile> machine_;
  std::map<std::uint32_t, double> lengthsBefore_;    // of the tools of the machine's file: their offsets
  std::map<std::uint32_t, RunPlace> lengthsWritten_; // where one was last written
  Setup setup_;
  std::optional<std::array<double, 3>> partZero_; // where the part is meant to be
  std::optional<std::uint8_t> zeroLeftOut_;       // a system that was to be there, and there is no part
  std::optional<World> world_;
  std::optional<StockRun> stock_;
  std::optional<StockMargin> stockMargin_;                 // after the run
  std::uint32_t stockAxes_ = 0;                            // bits of X, Y and Z: those that have moved
  std::uint32_t stockTool_ = 0;                            // in the spindle; 0: none was called
  std::set<std::pair<FileId, std::uint32_t>> stockRapids_; // blocks whose rapid was reported
  bool picture_ = false;
  std::string_view subject_ = "program";
  std::string control_; // that the program runs on; "": none
  std::optional<PictureRecorder> recorder_;
  PlaceNow place_;
  PictureRecorder::BlockNow block_;
  PictureRecorder::CallKind callKind_;
  std::vector<bool> protected_; // of the calls that are open: within a protected move
  std::function<bool()> safe_, asks_;
  std::function<SourceRange()> rangeNow_;
  Machine* machineNow_ = nullptr;
  bool spindleStopped_ = false; // by a change of tools or an orientation, whatever M3 said before
  std::pair<std::uint8_t, double> spindleSeen_{0, 0}; // direction and speed, as last looked at
  std::vector<double> lengths_;                       // of the tool, as the calls that are open began
  struct LostLength {
    std::uint32_t program = 0; // that has taken it off
    double length = 0;
  };
  std::optional<LostLength> lostLength_;
  std::set<long long> heightsRead_; // Z of the tool's end where a position was read under G43, thousandths
  std::vector<RunFault> faults_;
  std::set<std::pair<std::string_view, std::uint32_t>> faultsTold_; // code, where its block begins
  SourceRange last_;                                                // the block of the last motion
  std::optional<Missed> missed_;
  std::vector<KeptMiss> misses_;        // at most kMostKept
  std::uint32_t lastMiss_ = 0;          // of misses_, from 1: the last skip move; 0: that was none
  Point3 lastWay_{}, searchWay_{};      // of the last skip move as it ended, as it began
  std::optional<double> heightTouched_; // Z in work coordinates, of a touch along Z alone by the probe
  bool movedOn_ = false;                // since then
  std::set<std::uint32_t> missesTold_;  // as errors
  std::function<std::uint32_t()> missInHand_;
  std::uint64_t usedMisses_ = 0;
  bool keepsOffsets_ = false;
  std::function<std::uint64_t()> line_, blocks_;
  std::function<std::optional<std::uint32_t>()> systemNow_; // 0 to 5: the active one, at the machine's zero
  bool offsetTold_ = false;
  std::set<std::uint32_t> lengthsTold_;
  std::function<RunEnd()> end_;
  std::function<Point3()> work_; // position in work coordinates
  MeasuredLog log_;
  bool touched_ = false; // the last skip move ended at a contact that it wanted
  PictureRecorder::FrameNow frame_;
  int decimals_ = 3;
  std::function<void(std::string)> stop_;  // ends the run as inconclusive
  std::function<void(std::string)> alarm_; // ends it with an alarm of the control
  std::function<void(const Position&)> stopAt_;
  struct Motion {
    Position from{}, to{};
  };
  Motion motion_; // that runs, as the machine reports it
  bool endedOutside_ = false;
  bool startTold_ = false;
  Position start_{}; // of the machine
  std::uint32_t startSystem_ = 0;
  std::function<Position()> position_;
  std::vector<Kept> contacts_, events_;
  struct NotedRecord {
    std::string file;
    std::optional<double> value;
    Position position;
  };
  std::vector<NotedRecord> records_; // of files, and stops: at most kMostKept
  std::vector<std::string> stops_;
  std::uint64_t contactCount_ = 0, eventCount_ = 0;
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    SourceRange range; // of the block that comes nearest, or almost
    std::string system;
    std::optional<std::uint32_t> unset; // as of systemNow_
  };
  std::optional<Clearance> clearance_; // where a part is given, and each motion is known
  Nearest nearest_;
  bool works_ = false;                       // a feed or a skip move was made
  std::array<std::uint64_t, 16> outcomes_{}; // without misses that were meant
  std::array<Told, 16> told_{};              // by outcome
  // By outcome and place: a loop meets the same at the same block each time.
  std::map<std::tuple<std::size_t, FileId, std::uint32_t>, std::uint32_t> toldAt_;
};

} // namespace dotek::sim
