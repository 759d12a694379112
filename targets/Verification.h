// How a target runs its text on the cases of `verify` and compares it with the source.
#pragma once

#include "frontend/compost/Post.h"
#include "ir/Program.h"
#include "project/Compilation.h"
#include "project/CycleFolder.h"
#include "project/Lowering.h"
#include "project/Session.h"
#include "sim/machine/World.h"
#include "targets/Subject.h"
#include "verify/Compare.h"
#include "verify/DrawnPath.h"
#include "verify/Interference.h"
#include "verify/Stand.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dotek::targets {

// Of a position whose word is rounded, and of what is met from there: in steps of the word's last digit.
inline constexpr double kRoundedWord = 0.6;
// An increment of a word, where one control computes with eight digits and the other with fifteen; mm.
inline constexpr double kOtherArithmetic = 0.0011;

// What the source does with other values of the case at hand, in the same part: by it a translation that is
// called with arguments is held to the contract of docs/convert.md.
class SourceQuestions {
public:
  virtual ~SourceQuestions() = default;
  enum class Answer : std::uint8_t { Runs, Rejected, None }; // by the dialog; None: nothing can be run
  struct Ran {
    Answer answer = Answer::None;
    verify::Record record; // of Runs
    // The post prints fewer digits of some value than it has: the run is that of another one.
    bool losesDigits = false;
  };
  // `name`: of a field or a host input.
  virtual Ran with(const std::string& name, double value) = 0;
  // The source's program is another one with some of the values, though it may move alike.
  virtual bool prints(const std::string& /*field*/, const std::vector<double>& /*values*/) { return false; }
  // With it the source takes a tool's length from an offset that is not above 0 (`G43 H0`).
  virtual bool takesNoOffset(const std::string& /*name*/, double /*value*/) { return false; }
  // The values of the case, called from another state.
  virtual Ran from(const verify::Entry& entry) = 0;
  // The values of the case, where bare skip moves find something else.
  virtual Ran disturbed(const verify::Interference& interference) = 0;
  // Some value of the field makes the path, or what is measured, another one.
  virtual bool moves(const std::string& field) = 0;
  // With some value of the field or the host input the dialog rejects the others.
  virtual bool rejectsSome(const std::string& name) = 0;
  // How many touches the drawn path has, each a surface of the part; 0: none is drawn.
  virtual std::size_t touches() const { return 0; }
  // How much farther along its touch a surface lies, mm.
  struct Growth {
    double by = 0; // mm along the touch
    std::optional<std::size_t> touch =
        std::nullopt;       // that surface alone, in the order of the path; else each
    std::size_t count = 1;  // surfaces from `touch` on
    sim::Point3 moved = {}; // mm, all of them
    bool uneven = false;    // each by a multiple of `by` of its own
    double tie = 0;         // mm: sim::World::setTie
  };
  // The values of the case where the part is off by `more` besides, and surfaces lie farther; `look` gets the
  // run and its part, unless there is none.
  virtual void elsewhere(const verify::PartError& more, const Growth& grown,
                         const std::function<void(const verify::Record&, sim::World&)>& look);
  // The source itself says what it does without the argument, and the cases leave it out.
  virtual bool maySkip(const std::string& name) = 0;
};

// For a picture: the translation's run with its moves, that of the caller who sees the first difference.
struct ShownRun {
  std::optional<verify::Record> record; // nothing: it did not run
  std::string who;                      // "called under G49"; "": as the source runs
};

// One case as a translation sees it.
struct TargetCase {
  const verify::Case& drawn;
  const verify::Entry& entry;
  const std::set<std::uint32_t>& stores; // common variables that the source writes
  sim::World& world;
  // What the source did. nullptr: the dialog rejects the values, or there is no Prog.
  const verify::Record* source = nullptr;
  // Without a Prog: what is compared instead; nullptr: there is one, or the macro draws nothing.
  const verify::DrawnPath* path = nullptr;
  bool rejected = false;           // by the dialog
  std::string_view rejection = {}; // what it says then
  bool losesDigits = false;        // the post prints fewer digits of a value than it has, or computes it
  // What the source does where each datum that it sets moves the path that follows, as it does in the target.
  std::function<verify::Record()> inItsDatums = {};
  // Where the source says what its record shows at a place of the posted program.
  std::function<SourceRange(SourceRange)> sourceOf = {};
  // Callers who break what the translation demands are looked at, too. nullptr: not in this case.
  SourceQuestions* questions = nullptr;
  const ir::Program* posted = nullptr;                       // nullptr: there is no Prog
  std::span<const frontend::compost::PostedLine> lines = {}; // as the Prog prints them, with its N numbers
  ShownRun* shown = nullptr;                                 // to be filled; nullptr: nobody looks
  // A number that is the same for the same values, for what the caller has in force.
  std::uint64_t stream = 0;
  double rounding = 0; // mm, by which words of one side may be rounded where the other's are not
};

// The source's run as it usually is, beside one that `other` begins: where that has another tool length in
// force, the run under the own one on the same machine, on which a change of the length alone moves no axis.
// `kept` keeps it.
const verify::Record& usualRun(const TargetCase& now, const verify::Entry& other,
                               std::optional<verify::Record>& kept);

// A difference, and the line of the translation that shows it: by number where the plan holds its text, as
// text where that is of this case alone.
struct TargetDifference {
  verify::Difference difference;
  std::uint32_t line = 0; // from 1; 0: none
  std::string text;       // "" where there is none
};

struct TargetRun {
  // Nothing is written for these values, or the translation stops with an error before anything moves.
  bool refused = false;
  bool undecided = false; // the two cannot be compared
  bool ofValues = false;  // undecided for these values; others may tell more
  std::string why;        // it is refused or undecided; "": the reason is that of the source
  std::string stopped;    // the translation can be run no more, for these values or others: why; "": it can
  std::vector<TargetDifference> differences;
  std::string trace; // only where VerifyOptions::traces wants it

  void differs(verify::Aspect aspect, std::string text, std::string line = "");
  // The same, shown by a line of the plan's translation.
  void differsAt(verify::Aspect aspect, std::string text, std::uint32_t line);
};

class Verification {
public:
  Verification() = default;
  virtual ~Verification() = default;
  Verification(const Verification&) = delete;
  Verification& operator=(const Verification&) = delete;
  // Whether it takes only values with which start and travel lead to the coordinate that a surface gets.
  virtual bool needsNominal() const { return false; }
  // Whether both sides compare what is measured alike to the last digit.
  virtual bool meetsLimitsAlike() const { return false; }
  // Whether what it measures can be made to count as equal to a limit, as in the source
  // (sim::World::setTie).
  virtual bool takesTies() const { return false; }
  // Whether each datum moves the path that follows: it then has to fit the part wherever the datums are.
  virtual bool datumsMovePath() const { return false; }
  // Which values the caller of a cycle gives, after prepare(): what he may leave out as he likes, always or
  // never.
  enum class Given : std::uint8_t { AsDrawn, Always, Never };
  virtual Given given(const std::string& /*parameter*/) const { return Given::AsDrawn; }
  // Before the first case. false: reported to the session.
  virtual bool prepare() = 0;
  // The session's diagnostics are this run's own.
  virtual TargetRun run(const TargetCase& now) = 0;
};

// What both sides share; all outlive the verification.
struct VerificationSource {
  const VerifyOptions& options;
  const VerifyPlan& plan;
  Session& session; // of the compilation
  LoweringInputs& inputs;
  const CycleFolder& folder;
  Compilation& compilation;
};

} // namespace dotek::targets
