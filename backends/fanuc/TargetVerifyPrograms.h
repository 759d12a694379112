// Private to Target*.cpp: programs of macro B against their conversion.
#pragma once

#include "backends/fanuc/TargetText.h"
#include "ir/Program.h"
#include "sim/machine/Bytecode.h"
#include "sim/vendor/VendorMacros.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"
#include "targets/Stage.h"
#include "targets/Subject.h"
#include "verify/Callers.h"
#include "verify/Rehearsal.h"
#include "verify/Stand.h"
#include "verify/VariableFlow.h"
#include "verify/Variables.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dotek::targets {

class ProgramRunner final : public ProgramSubject {
public:
  ProgramRunner(const VerifyOptions& options, const VerifyPlan& plan);
  ~ProgramRunner() override;

  bool load() override;
  std::optional<std::vector<verify::DrawField>> fields() override;
  const std::map<std::string, double>& hosts() const override { return hosts_; }
  std::string sourceMacros() const override { return sourceSet_ == nullptr ? "" : sourceSet_->name; }
  std::string targetMacros() const override { return targetSet_ == nullptr ? "" : targetSet_->name; }
  bool prepare() override;

  Session& session() override { return session_; }
  SourceRange place() const override { return {file_, 0, 0}; }
  std::optional<verify::Case> draw(std::uint64_t index) override;
  verify::Case edge(std::uint64_t index) override;
  CaseResult run(const verify::Case& drawn) override;
  VerifySides sides() const override;
  std::optional<CasePictures> pictures(const verify::Case& drawn) override;

private:
  // One side: what runs, on which control.
  struct Side {
    const stdlib::Control* control = nullptr;
    const stdlib::MacroSet* set = nullptr;
    const sim::Bytecode* code = nullptr;
    verify::Stand* stand = nullptr;
  };
  // Of a program that ends with M99: what calls it, on both sides.
  struct Caller {
    std::string text;
    std::uint32_t callee = 0; // O number
    std::optional<ir::ProgramFile> source;
  };
  struct Played;

  bool addCaller();
  bool compileSource(const stdlib::Control& control, sim::Bytecode& out, verify::Stand& stand);
  // How often what was drawn has been rejected: by the number of a variable, and of everything else (0).
  using Tries = std::map<std::uint32_t, std::uint32_t>;
  verify::Case propose(std::uint64_t index, const Tries& tries) const;
  std::set<std::uint32_t> rejectedBy(const verify::Record& record) const;
  bool otherValuesMayDo(const verify::Record& record) const;
  bool lacksProgram(const verify::Record& record) const; // it ended at a call of a program that is not there
  std::unique_ptr<Played> play(verify::Case drawn, bool drawError);
  // What the probe meets besides, and what the caller has in force; nullptr: the usual modes.
  struct Beside {
    verify::Interference by;
    const verify::ModeInForce* mode = nullptr;
  };
  verify::Record runSide(const Side& side, const verify::Case& drawn, sim::World& world,
                         verify::Stand::Way way, const Beside& beside) const;
  verify::Record runSide(const Side& side, const verify::Case& drawn, sim::World& world,
                         verify::Stand::Way way) const {
    return runSide(side, drawn, world, way, {});
  }
  // On the part of a case.
  verify::Record runBeside(const Side& side, const Played& played, const Beside& beside) const;
  Side sourceSide() const { return {&*sourceControl_, sourceSet_, &sourceCode_, sourceStand_.get()}; }
  Side targetSide() const { return {&*targetControl_, targetSet_, &translation_.code(), targetStand_.get()}; }
  Side sourceAsTargetSide() const {
    return {&*sourceAsTarget_, sourceSet_, &sourceAsTargetCode_, sourceAsTargetStand_.get()};
  }
  // One of the two goes back to its caller, the other ends.
  std::optional<verify::Difference> compareReturn(const verify::Record& source,
                                                  const verify::Record& target) const;
  // Where the probe meets something else, and under other modes of the caller.
  std::vector<verify::Difference> compareBeside(const Played& played, const verify::Record& target) const;
  std::vector<verify::Difference> compareDisturbed(const Side& source, const Played& played,
                                                   const verify::Record& target) const;
  std::vector<verify::Difference> compareUnder(const verify::ModeInForce& mode, const Side& source,
                                               const Played& played) const;
  verify::Record runTarget(const Played& played) const;
  verify::CompareRules rules() const;
  std::vector<verify::Difference> differences(const Played& played, const verify::Record& target);
  SourceRange inSource(SourceRange range) const { return range.file == file_ ? range : SourceRange{}; }
  sim::MachineLimits limits() const { return plan_.machine ? plan_.machine->limits : sim::MachineLimits{}; }
  bool assumesProbe() const { return options_.common.assume.contains("probe-on"); }

  const VerifyOptions& options_;
  const VerifyPlan& plan_;
  Session session_;
  Limits sourceLimits_, targetLimits_; // of one run
  FileId file_ = kNoFile;
  std::optional<stdlib::Control> sourceControl_, targetControl_, sourceAsTarget_;
  const stdlib::MacroSet* sourceSet_ = nullptr; // nullptr: none is called
  const stdlib::MacroSet* targetSet_ = nullptr;
  sim::MeasuringCycles measuring_;      // of both
  std::map<std::string, double> hosts_; // given
  std::optional<ir::ProgramFile> programs_, macros_;
  std::optional<Caller> caller_;
  std::vector<verify::ProgramVariable> variables_; // to draw
  std::unique_ptr<verify::VariableFlow> flow_;     // of the source
  std::map<std::uint32_t, double> fixed_;
  bool stopsSpindle_ = false, stopsCoolant_ = false; // by codes of the programs
  std::set<std::uint32_t> stores_;                   // common variables that count
  sim::Bytecode sourceCode_, sourceAsTargetCode_;
  std::unique_ptr<verify::Stand> sourceStand_, targetStand_, sourceAsTargetStand_;
  FanucText translation_;
  std::unique_ptr<Played> drawn_; // of draw(), for the next run()
};

} // namespace dotek::targets
