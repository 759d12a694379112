// Private to Verify*.cpp: one case of a cycle, drawn and run on both sides. A runner is used by one thread.
#pragma once

#include "driver/CycleFolder.h"
#include "driver/Fields.h"
#include "driver/Lowering.h"
#include "driver/Session.h"
#include "frontend/compost/Post.h"
#include "sim/Bytecode.h"
#include "sim/Probe.h"
#include "stdlib/MacroSet.h"
#include "verify/Compare.h"
#include "verify/Draw.h"
#include "verify/Stand.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dotek::driver {

// A translation as text, with what its lines come from.
struct Translation {
  std::string name, text;
  std::uint32_t number = 0; // O number
  std::vector<OutputArgument> arguments;
  // By line from 0: files and lines; empty: made up. Nothing: not known, of a line that was edited.
  std::vector<std::optional<std::set<std::pair<std::string, std::uint32_t>>>> sources;
};

// What all cases share.
struct VerifyPlan {
  std::vector<verify::DrawField> fields;
  std::map<std::string, double> fixedHosts;
  std::map<std::string, int> hostDecimals; // of host inputs that the post prints
  std::string sourceMacros, targetMacros;  // names of sets; "": none
  std::optional<Translation> translation;  // nothing: the path stands beside the posted program
  std::optional<sim::MachineFile> machine;
  std::optional<sim::Part> part; // of --part; nothing: made from the path of each case
};

// A difference in places that the user has: the source's files, lines of the translation.
struct CaseFinding {
  verify::Aspect aspect = verify::Aspect::Path;
  std::string text;
  SourceRange source;
  SourceRange posted;           // beside a path: the Prog's line
  std::uint32_t targetLine = 0; // from 1; 0: none
};

// Refused: the translation raises an alarm of its own before anything moves. NoProgram: the source prints
// none, or no source tells what it does.
enum class CaseVerdict : std::uint8_t { Proved, Idle, Differ, Refused, NoProgram };

struct CaseResult {
  CaseVerdict verdict = CaseVerdict::Idle;
  std::vector<CaseFinding> findings;
  std::string why; // nothing is proved; "" where it is
  SourceRange whyAt;
  // Protected moves that ran with the probe off, the first of the case; and whether the spindle was stopped
  // only behind it.
  std::optional<SourceRange> unprotected;
  bool spindleLater = false;
  std::optional<SourceRange> unarmed; // the first measuring move with the probe off
  std::string trace;                  // of the translation; only where VerifyOptions::traces wants it
};

class CaseRunner {
public:
  CaseRunner(const VerifyOptions& options, const VerifyPlan& plan);
  ~CaseRunner();

  // Reads the source; false: reported to session().
  bool load();
  // Before the first case, once the plan is complete.
  bool prepare();

  Session& session() { return session_; }
  const CycleFolder& folder() const { return *folder_; }
  LoweringInputs& inputs() { return *inputs_; }

  // The case of this number; nothing: no values were found within the attempts.
  std::optional<verify::Case> draw(std::uint64_t index);
  verify::Case edge(std::uint64_t index) { return settled(draws_->edge(index)); }
  // The case that `draw` gave last is run without another look at it.
  CaseResult run(const verify::Case& drawn);
  // Fields whose picture drops digits of a value that is finer than its last place: printed where.
  std::vector<std::pair<std::string, SourceRange>> droppedDigits(const verify::Case& drawn);
  // Why the last proposal of draw() was turned away.
  const std::string& lastRefusal() const { return refusal_; }

private:
  struct Posted; // the posted program of one case
  struct Values; // of one case, behind the checks
  std::unique_ptr<Values> check(const verify::Case& drawn, bool settle);
  verify::Case settled(const verify::Case& drawn);
  void roundHosts(verify::Case& drawn) const;
  bool makePart(Values& values) const;
  void misplace(Values& values) const;
  sim::Point3 zeroOf(const verify::Case& drawn) const;
  bool post(Values& values);
  bool readPosted(Values& values);
  verify::Record runPosted(const Values& values, sim::World& world, bool probeOn, verify::Stand::Way way);
  std::string whyNotMeasured(Values& values);
  verify::Record runTranslation(const Values& values, sim::World& world, bool probeOn, std::string& trace);
  sim::Probe probeOf(const verify::Case& drawn) const;
  verify::Entry entryOf(const verify::Case& drawn, bool probeOn) const;
  void addFinding(CaseResult& result, const verify::Difference& difference, const Values& values) const;
  void compareRejection(CaseResult& result, const Values& values, const verify::Record& target) const;
  void noteProbe(CaseResult& result, const verify::Record& record, const Values& values) const;
  void comparePath(CaseResult& result, const Values& values) const;
  void compareGeometry(CaseResult& result, const Values& values, const verify::Record& target) const;
  bool madeUp(std::uint32_t line) const;
  bool samePlace(SourceRange source, std::uint32_t targetLine) const;
  double resultTolerance() const;
  SourceRange sourceOf(SourceRange posted, const Values& values) const;
  std::uint32_t targetLine(SourceRange range) const;

  const VerifyOptions& options_;
  const VerifyPlan& plan_;
  Session session_;
  std::optional<LoweringInputs> inputs_;
  std::optional<CycleFolder> folder_;
  const frontend::compost::Routine* routine_ = nullptr;
  std::optional<FieldTable> fields_;
  std::optional<verify::Draws> draws_;
  std::string refusal_;
  std::unique_ptr<Values> drawn_; // of draw(), for the next run()

  // The translation, ready to run: its own map of sources, the programs, what runs.
  struct Ready;
  std::shared_ptr<Ready> ready_;
  const stdlib::MacroSet* sourceSet_ = nullptr;
  const stdlib::MacroSet* targetSet_ = nullptr;
  std::optional<verify::Stand> sourceStand_, targetStand_;
};

} // namespace dotek::driver
