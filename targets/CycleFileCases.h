// One case of a file of the cycle language: its meaning runs beside what a target writes of it. A runner is
// used by one thread.
#pragma once

#include "project/Compilation.h"
#include "targets/Subject.h"
#include "targets/Verification.h"
#include "verify/CycleStand.h"
#include "verify/Draw.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dotek::targets {

class CycleFileRunner final : public CaseSubject {
public:
  // Both outlive it.
  CycleFileRunner(const VerifyOptions& options, const VerifyPlan& plan);
  ~CycleFileRunner() override;

  // Reads the cycle; false: reported to session().
  bool load();
  // What is drawn, after load(); --set fixes it.
  std::vector<verify::DrawField> fields() const;
  // Before the first case, once the plan is complete.
  bool prepare();

  LoweringInputs& inputs() { return *inputs_; }
  Compilation& compilation() { return compilation_; }
  const ir::Cycle& cycle() const { return lowered_->cycle; }

  Session& session() override { return session_; }
  SourceRange place() const override { return lowered_->cycle.range; }
  std::optional<verify::Case> draw(std::uint64_t index) override;
  verify::Case edge(std::uint64_t index) override;
  CaseResult run(const verify::Case& drawn) override;
  std::vector<Rejection> rejections() const override;
  std::vector<SourceRange> alarms() const override;
  std::vector<SourceRange> unreached(const Places& reached) const override;
  VerifySides sides() const override;
  std::optional<CasePictures> pictures(const verify::Case& drawn) override;

private:
  struct Played; // the cycle's own run of a case
  class Questions;
  class OtherParts;
  std::unique_ptr<Played> play(verify::Case drawn, bool drawError);
  verify::Record runCycle(const verify::Case& drawn, sim::World& world, bool keepMoves,
                          const verify::Interference& interference = {}, sim::CycleWay* way = nullptr) const;
  sim::CycleInputs inputsOf(const verify::Case& drawn) const;
  verify::Entry entryOf(const verify::Case& drawn) const;
  sim::MachineLimits limits() const;
  void leaveOut(verify::Case& drawn) const;
  void settle(verify::Case& drawn) const;
  bool isField(const std::string& name) const;
  bool knowsValues();
  verify::Case replayed(verify::Case drawn) const;
  TargetRun runTarget(const Played& played, ShownRun* shown = nullptr);
  TargetRun runTarget(const Played& played, SourceQuestions* questions, ShownRun* shown);
  void runAtBounds(const verify::Case& drawn, CaseResult& result);
  void runOnOtherParts(const Played& played, CaseResult& result);
  // Both sides have run so.
  void noteCompared(const verify::Record& record, const sim::CycleWay& way);
  CaseResult runBoth(const verify::Case& drawn);
  void takeDifferences(CaseResult& result, const TargetRun& ran) const;

  const VerifyOptions& options_;
  const VerifyPlan& plan_;
  Session session_;
  Compilation compilation_;
  LoweringInputs* inputs_ = nullptr;
  CycleFolder* folder_ = nullptr;
  std::optional<LoweredCycle> lowered_; // with the stores of --result
  std::set<std::uint32_t> stores_;
  bool needsProbe_ = false; // its caller switches the probe on
  bool stopsSpindle_ = false, stopsCoolant_ = false;
  std::vector<verify::DrawField> fields_;
  std::optional<verify::Draws> draws_;
  Limits limitsOfCycle_;
  std::optional<verify::CycleStand> stand_;
  std::unique_ptr<Verification> target_;
  std::unique_ptr<Played> drawn_;  // of draw(), for the next run()
  Rejections rejected_;            // of the last draw()
  std::vector<SourceRange> met_;   // alarms that both sides ran to since the last result
  std::vector<bool> reached_;      // statements of the body that both sides ran
  std::vector<SourceRange> newly_; // of these, since the last result
};

} // namespace dotek::targets
