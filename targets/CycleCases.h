// One case of a cycle, drawn and run on both sides. A runner is used by one thread.
#pragma once

#include "frontend/compost/Post.h"
#include "project/Compilation.h"
#include "project/CycleFolder.h"
#include "project/Fields.h"
#include "project/Lowering.h"
#include "project/Session.h"
#include "sim/geometry/Probe.h"
#include "sim/machine/Bytecode.h"
#include "sim/vendor/VendorMacros.h"
#include "stdlib/MacroSet.h"
#include "targets/Subject.h"
#include "targets/Verification.h"
#include "verify/Compare.h"
#include "verify/Draw.h"
#include "verify/Random.h"
#include "verify/Stand.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dotek::targets {

class NominalFields;

class CaseRunner final : public CaseSubject {
public:
  CaseRunner(const VerifyOptions& options, const VerifyPlan& plan);
  ~CaseRunner() override;

  // Reads the source; false: reported to session().
  bool load();
  // Before the first case, once the plan is complete.
  bool prepare();

  Session& session() override { return session_; }
  SourceRange place() const override { return {folder_->place, 0, 0}; }
  const CycleFolder& folder() const { return *folder_; }
  LoweringInputs& inputs() { return *inputs_; }
  Compilation& compilation() { return compilation_; }

  std::optional<verify::Case> draw(std::uint64_t index) override;
  std::optional<verify::Case> another(std::uint64_t index) override;
  verify::Case edge(std::uint64_t index) override { return settled(draws_->edge(index)); }
  CaseResult run(const verify::Case& drawn) override;
  // What the folder does with the values of another source's case, in its world and for its caller: the
  // checks of its dialog, and its posted program, in which `stores` are kept.
  struct Performed {
    bool rejected = false;                // by the dialog
    std::string text;                     // what it says then, or why nothing can be run
    std::optional<verify::Record> record; // places are of the posted text; nothing: rejected, or no program
    std::vector<frontend::compost::PostedLine> lines; // of that text
  };
  Performed perform(const verify::Case& values, sim::World& world, const verify::Entry& entry,
                    const std::set<std::uint32_t>& stores, verify::Stand::Way way);
  // What the folder draws for these values beside what its posted program does with them, on the part that it
  // draws; places are of its macro. Nothing where the values are rejected, or nothing is drawn.
  std::vector<verify::Difference> drawnBeside(const verify::Case& values, const verify::Entry& entry,
                                              double tolerance);
  // The line of its Prog that printed a place of the posted text; no place: none did.
  static SourceRange progPlace(SourceRange posted, const std::vector<frontend::compost::PostedLine>& lines);

  std::vector<std::pair<std::string, SourceRange>> droppedDigits(const verify::Case& drawn) override;
  std::vector<Rejection> rejections() const override;
  VerifySides sides() const override;
  std::optional<CasePictures> pictures(const verify::Case& drawn) override;

private:
  struct Posted; // the posted program of one case
  struct Values; // of one case, after the checks
  class Questions;
  std::unique_ptr<Values> check(verify::Case drawn, bool settle);
  void setsActive(verify::Case& proposal) const;
  void takeFirstValues(verify::Case& proposal, verify::Random random) const;
  std::optional<verify::Case> drawFrom(std::uint64_t index, std::uint32_t tries, std::uint32_t end,
                                       bool wide);
  // A target that writes a program for each case, and nothing was found for this one: what is refused
  // whatever the path is comes before what the path lacks.
  void askConversion(std::uint64_t index);
  bool passesUnstated() const;
  bool halvesBetweenSteps(const ir::Program& program) const;
  double pathTolerance(const Values& values) const;
  double roundingOf(const ir::Program& program, bool byWords) const;
  verify::Case settled(verify::Case drawn);
  void takeSelected(verify::Case& drawn, bool others);
  verify::Case coarser(verify::Case drawn, double unit) const;
  std::unique_ptr<Values> attempt(const verify::Case& proposal);
  std::unique_ptr<Values> attemptAsIs(const verify::Case& proposal);
  void takeValues(verify::Case& drawn) const;
  bool knowsValues();
  void roundHosts(verify::Case& drawn) const;
  bool isGiven(const char* host) const; // by --host or a replay
  void startOnRetract(verify::Case& drawn) const;
  void clearOnRetract(verify::Case& drawn, const verify::DrawnPath& path) const;
  bool leadToNominal(std::unique_ptr<Values>& values);
  std::optional<std::vector<double>> nominalMisses(const verify::Case& drawn);
  std::string whyNotCorrected(const Values& values, const sim::Part& nominal, double off) const;
  std::string whyNotClear(const Values& values) const;
  std::string whyAboveHome(const Values& values) const;
  bool makePart(Values& values) const;
  bool takeStatedPart(Values& values);
  void misplace(Values& values) const;
  sim::Point3 zeroOf(const verify::Case& drawn) const;
  void findReads(Values& values);
  void findLeftOver(Values& values);
  bool isGiven(std::uint32_t variable) const; // by --var
  void drawVariables(Values& values);
  bool post(Values& values);
  bool readPosted(Values& values);
  void findMacros(const ir::Program& program);
  verify::Entry entryOf(const Values& values, bool probeOn) const;
  verify::Record runPosted(const Values& values, sim::World& world, bool probeOn,
                           verify::Stand::Way way) const;
  verify::Record runPosted(const Values& values, sim::World& world, const verify::Entry& entry,
                           verify::Stand::Way way, const verify::Interference& interference = {}) const;
  std::string whyNotMeasured(Values& values);
  TargetRun runTarget(const Values& values, sim::World& world, bool probeOn, const verify::Record* source,
                      ShownRun* shown = nullptr, bool asks = true);
  std::optional<sim::Part> partBeside(const Values& values, const verify::PartError& more,
                                      const SourceQuestions::Growth& grown) const;
  bool meetsLimit(const Values& values, bool probeOn);
  void runAtBounds(const verify::Case& drawn, CaseResult& result);
  void runAtLimits(const Values& drawn, bool probeOn, CaseResult& result);
  void addFinding(CaseResult& result, const verify::Difference& difference, const Values& values) const;
  CaseResult runOne(const verify::Case& drawn);
  void noteAlarm(const verify::Record& source, const Values& values);
  void noteEndless(const verify::Case& drawn);
  void noteStopped(const TargetRun& ran, const verify::Case& drawn);
  void takeRun(CaseResult& result, TargetRun ran, const Values& values, const verify::Record* source) const;
  void noteProbe(CaseResult& result, const verify::Record& record, const Values& values) const;
  void comparePath(CaseResult& result, const Values& values, const verify::Record* source) const;
  bool movesItself(const Values& values) const;
  SourceRange sourceOf(SourceRange posted, const Values& values) const;

  const VerifyOptions& options_;
  const VerifyPlan& plan_;
  Session session_;
  Compilation compilation_;
  LoweringInputs* inputs_ = nullptr;
  CycleFolder* folder_ = nullptr;
  const frontend::compost::Routine* routine_ = nullptr;
  std::optional<FieldTable> fields_;
  std::optional<verify::Draws> draws_;
  std::optional<verify::Draws> wide_;                 // limits of what is measured are often far beyond it
  std::map<std::uint32_t, SourceRange> branchAlarms_; // that the Prog has printed in this case, by place
  std::vector<SourceRange> met_; // of these, in which runs have ended since the last result
  bool rests_ = false;           // Values::rests of those that are made next
  std::string refusal_;
  SourceRange refusedAt_;   // by a check
  Rejections rejected_;     // of the last draw()
  bool unreadable_ = false; // the path cannot be run, whatever is drawn
  std::optional<bool>
      selects_; // the post selects a work system or a tool offset by itself; nothing: not known
  std::unique_ptr<Values> drawn_; // of draw(), for the next run()
  std::uint32_t tries_ = 0;       // proposals of the last draw() or another()
  std::uint32_t others_ = 0;      // cases that another() has drawn for the last draw()
  std::vector<std::pair<std::uint32_t, double>> variables_; // of --var
  std::set<std::uint32_t>
      switches_; // macros of the source's control that switch the probe and do nothing else
  std::set<std::pair<std::size_t, std::size_t>> atBounds_; // comparisons and fields that were met so far
  std::map<std::string, bool> moving_; // fields of which Questions knows whether they move something

  const stdlib::MacroSet* sourceSet_ = nullptr;
  sim::MeasuringCycles measuring_;                   // that its calls stand for
  mutable std::optional<verify::Stand> sourceStand_; // told what the posted program guards, before each run
  std::unique_ptr<Verification> target_;             // nullptr: no translation
  std::unique_ptr<NominalFields> nominal_;           // where target_ wants it
};

} // namespace dotek::targets
