// Runs compiled programs on a machine.
#pragma once

#include "ir/Arithmetic.h"
#include "sim/machine/Arguments.h"
#include "sim/machine/Bytecode.h"
#include "sim/machine/LoopTrail.h"
#include "sim/machine/Machine.h"
#include "sim/machine/MacroMeaning.h"
#include "sim/machine/MissWatcher.h"
#include "sim/machine/RunListener.h"
#include "support/Limits.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dotek::sim {

// A variable that motion changes was read, or an offset written, while blocks of motion may still have been
// waiting.
struct EarlyRead {
  SourceRange range; // of the block
  std::uint32_t number = 0;
};

// A common variable that nobody had set when the program computed with it.
struct UnsetRead {
  SourceRange range; // of the block
  std::uint32_t number = 0;
};

class Run {
public:
  // All outlive the run. `meaning`: macros without text; nullptr: none.
  Run(Machine& machine, const Bytecode& code, const Limits& limits, MacroMeaning* meaning = nullptr);

  // The first program, to its end: Machine::end() says how it came.
  void run();
  // What DPRNT and BPRNT printed, bytes.
  const std::string& output() const { return output_; }
  bool portIsOpen() const { return portOpen_; } // POPEN without PCLOS after it
  // Each place once, in the order of the run.
  const std::vector<EarlyRead>& earlyReads() const { return early_; }
  // Before the run: motion of the caller may be waiting, and what a macro without text has moved last may be,
  // too. Offsets that are written then are noted as well.
  void expectMotion();
  const std::vector<EarlyRead>& earlyWrites() const { return earlyWrites_; }
  // Before the run: notes where one of these common variables counts as 0, since nobody has set it. A run
  // that watches takes longer.
  void watchUnset(std::set<std::uint32_t> numbers) { unset_ = std::move(numbers); }
  // Before the run: notes where these common variables are written, and what. Such a run takes longer, too.
  void watchWrites(const std::set<std::uint32_t>& numbers);
  struct Written {
    double value = 0; // kUnknown: a macro without text has written over it at once
    SourceRange range;
  };
  // After the run, in its order; of very many the first ones and the last.
  std::vector<Written> writesOf(std::uint32_t number) const;
  // Before the run: values are followed that come from where a skip move
  // has ended that met nothing. The watcher outlives the run.
  void watchMisses(MissWatcher* watcher);
  // Before the run: once the probe has touched, numbers that lie no farther apart are equal where `<`, `>`,
  // `<=` and `>=` compare them, as if what was measured fell on a limit exactly; not in `macros` and what
  // they call. Such a run takes longer, too.
  void setTie(double tie, std::set<std::uint64_t> macros) {
    tie_ = tie;
    untied_ = std::move(macros);
  }
  // Before the run: M98 of a program that is not there does nothing, and the watcher hears of it; else it is
  // the control's alarm.
  void passOverAbsent() { passesOverAbsent_ = true; }
  // Of the value, or of the words, that the machine is given now: the miss that they come from; 0: none.
  std::uint32_t missInHand() const { return missInHand_; }
  void setListener(RunListener* listener) { listener_ = listener; }        // before the run; outlives it
  const std::vector<UnsetRead>& unsetReads() const { return unsetReads_; } // each number once
  // How often M99 has begun the main program anew.
  std::uint64_t passes() const { return passes_; }
  // The block, or the word of it, at which the run ended.
  SourceRange place() const;
  // The statement there; only while the run goes on.
  const ir::ProgramStatement& statement() const { return code_.statementOf(place_); }
  // The number of the program that holds it; 0: none.
  std::uint64_t program() const { return levels_.empty() ? 0 : levels_.back().routine->number; }
  // Of a run that met the limit of steps: what is known of the loop in which it went round, which is where it
  // ended; "": none was found.
  std::string loopText() const;
  // The calls that were open then, the outermost first.
  std::vector<SourceRange> openCalls() const;
  // Programs that the control has and that could not be read, with their files: a call of one ends the run as
  // inconclusive.
  void setUnreadable(std::map<std::uint64_t, std::string> files) { unreadable_ = std::move(files); }

private:
  struct Level {
    const Routine* routine = nullptr;
    std::uint32_t caller = 0;      // place of the instruction that called
    std::uint32_t repeats = 1;     // passes that are left, this one too
    std::uint32_t entry = kNoCell; // where they begin, if not at the first block
    bool macro = false;
    bool byCode = false;           // codes that call programs are ordinary ones here
    std::uint32_t modalCalls = 0;  // of those in force, how many act here
    std::vector<double> arguments; // kept for repeats alone
  };
  // What a call hands over: locals by number.
  struct Request {
    std::uint64_t program = 0;
    std::uint32_t repeats = 1;
    bool macro = true, byCode = false;
    std::uint32_t modalCalls = 0;
  };
  struct ModalCall {
    std::uint64_t program = 0;
    std::uint32_t repeats = 1;
    bool eachBlock = false;
    std::vector<double> arguments;
  };

  // Watched: a cell may hold what a macro left and nobody knows; who reads it ends the run.
  template <bool kDecimal8, bool kWatched> bool execute();
  bool knows(std::uint32_t cell); // false: it does not, and the run has ended
  // By the instruction that runs, which has yet to write; `done`: it has.
  void noteWritten(std::uint32_t cell, bool done = false);
  void keepWrite(std::uint32_t cell, bool done);
  void noteUnset(std::uint32_t number);
  void noteUnsetCell(std::uint32_t cell);
  void tellRead(std::uint32_t number, double value);
  void tellMeasured(std::uint32_t cell); // where it holds such a value
  void followMeasured(const Instruction& at, unsigned operands);
  void takeMeasured(); // after a macro without text
  void tellWritten(std::uint32_t number, double value);
  void tellBlock(const BlockSlots& slots);
  bool beginAnew(); // M99 of the main program; false: the run has ended
  bool fail(ir::ArithmeticError error, bool tangent, bool bits);

  // ---- RunLoop.cpp
  struct AskedLoop {
    std::optional<LoopTrail::Edge> edge;
    std::vector<std::pair<std::uint32_t, double>> values; // by cell, of what its end depends on
    bool changes = false;                                 // one of them, or something that is no cell
    std::uint32_t rounds = 0;
  };
  struct EndlessLoop {
    const ir::ProgramStatement* head = nullptr;
    std::vector<std::pair<std::uint32_t, double>>
        constant; // variables by number: all that its end depends on
  };
  void keepFuel();
  bool spend(std::uint32_t steps);
  const ir::ProgramStatement& headOf(std::uint32_t place) const;
  void watchLoop(AskedLoop& loop) const;
  void followLoop();
  void endInLoop();

  // ---- RunMisses.cpp
  // What a value has of a skip move that met nothing: which one, and by how much it would be another one if
  // the move had ended at other places of its path.
  struct FromMiss {
    std::uint32_t miss = 0;
    std::array<double, 4> off{};
  };
  FromMiss fromMiss(std::uint32_t cell) const;
  FromMiss fromMissOf(double number) const;
  FromMiss ofVariable(std::uint32_t number) const;
  template <class Function> FromMiss computed(const Instruction& at, bool both, Function function) const;
  template <class Holds> void askMiss(const Instruction& at, bool both, Holds holds);
  bool leadsToAlarm(std::uint32_t place);
  std::uint32_t missOf(std::uint32_t cell) const { return fromMiss(cell).miss; }
  void followMiss(const Instruction& at);
  void checkShift();
  void enterMisses();
  void leaveMisses();
  std::vector<std::pair<std::uint32_t, double>> valuesOfMisses() const;
  void forgetChanged(const std::vector<std::pair<std::uint32_t, double>>& before);

  // ---- RunBlock.cpp
  bool block(const BlockSlots& slots);
  bool fill(const BlockSlots& slots, std::uint32_t without);
  void addCode(char letter, double value, bool exact);
  bool callByCode(const BlockSlots& slots, std::uint32_t at, const stdlib::CallCode& code);
  bool callOnBlock(const BlockSlots& slots, const ModalCall& modal);
  bool executeWords(const BlockSlots& slots);
  // G70: the blocks of P to Q of the same program, then rapid to where it began.
  bool beginContour(const BlockSlots& slots);
  bool endContour();
  bool toIncrement(char letter, double& value);

  // ---- RunCall.cpp
  bool call(const CallSlots& slots);
  bool modalOff();
  bool begin(const Request& request);
  bool callBlock(const CallSlots& slots, const Routine& routine);
  bool beginPass(const Level& level);
  void leaveLevel(const Level& level);
  bool repeatsOf(double value, std::uint32_t& repeats);
  bool exit(std::uint32_t cell);
  bool textEnd();
  bool jumpTo(const Routine& routine, std::uint32_t from, double number);
  bool raise(double number, const std::string& text);

  // ---- RunDialect.cpp
  bool callPlace(std::uint32_t entry);
  bool leavePlace(const std::string& fault);
  bool round(); // false: the run has ended

  // ---- RunPrint.cpp
  bool openPort(bool open);
  bool print(const ir::Print& print);
  bool printDecimal(const ir::PrintPiece& piece, double value, std::string& out);
  bool printBinary(const ir::PrintPiece& piece, double value, std::string& out);

  bool readAt(double number, double& value);
  bool writeAt(double number, double value);
  void expectAhead();
  void noteStops();
  void noteRead(std::uint32_t number);
  void noteWrite(std::uint32_t number);
  bool refuse(std::string why) { return machine_.inconclusive(std::move(why)); }
  double cell(std::uint32_t at) const { return cells_[at]; }

  struct Contour {
    std::uint32_t end = 0, back = 0; // places: after its last block, and after the cycle
    Position start{};
  };
  std::optional<Contour> contour_; // that runs

  Machine& machine_;
  const Bytecode& code_;
  const Limits& limits_;
  MacroMeaning* meaning_;
  RunListener* listener_ = nullptr;
  bool passesOverAbsent_ = false;
  const stdlib::Control& control_;
  double* cells_ = nullptr;
  std::uint32_t place_ = 0; // of the instruction that runs, then of the next
  std::uint64_t fuel_ = 0;  // steps that are left until something happens
  std::uint64_t followed_ = 0;
  std::optional<LoopTrail> trail_;
  std::optional<AskedLoop> asked_;
  std::optional<EndlessLoop> loop_;
  std::vector<Level> levels_;
  std::vector<ModalCall> modal_;
  std::vector<double> locals_; // of the next call, by number
  ir::NcWords words_;
  bool ahead_ = false;         // blocks of motion may be waiting
  bool skipAhead_ = false;     // a skip move among them, whose position is not known before it
  bool limited_ = false;       // G103 P1: the control does not read ahead
  bool expectsMotion_ = false; // also at the beginning, and after macros without text
  bool portOpen_ = false;
  std::string output_;
  std::vector<EarlyRead> early_, earlyWrites_;
  std::set<std::uint32_t> unset_;
  std::vector<UnsetRead> unsetReads_;
  MissWatcher* misses_ = nullptr;
  bool followsMisses_ = false;                         // there has been one
  std::vector<FromMiss> fromMiss_, argumentMisses_;    // by cell; by local of the next call
  std::vector<std::vector<FromMiss>> savedMisses_;     // locals of the callers
  std::map<const ir::ProgramStatement*, bool> alarms_; // of leadsToAlarm()
  std::uint32_t missInHand_ = 0, cellCount_ = 0;
  std::set<std::uint32_t>
      measured_; // cells of common variables that a macro without text left; for a listener
  std::uint64_t passes_ = 0;
  std::vector<double> lastPass_; // the machine as the last pass began
  // Jumps back so far, and the machine at one of them: at which, how deep in calls.
  std::uint64_t rounds_ = 0, keptRound_ = 0;
  std::uint32_t roundPlace_ = 0;
  std::size_t roundLevels_ = 0;
  std::vector<double> roundState_;
  std::map<std::uint64_t, std::string> unreadable_;
  std::vector<bool> readEarly_; // by instruction
  struct Write {
    std::uint32_t place = 0; // of the instruction
    double value = 0;        // known once the next one comes
  };
  bool tiesHere() const; // the tie holds where the run is
  double tie_ = 0;
  std::set<std::uint64_t> untied_;           // numbers of programs
  std::vector<std::uint32_t> watchedWrites_; // by cell: the index in writes_ and 1; 0: not watched
  std::vector<std::vector<Write>> writes_;
};

} // namespace dotek::sim
