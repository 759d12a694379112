// Private to CycleCases*.cpp: one case on its path from values to what is compared.
#pragma once

#include "ir/Program.h"
#include "sim/machine/SafeMoves.h"
#include "targets/CycleCases.h"
#include "verify/Variables.h"

namespace dotek::targets {

// The posted program, ready to run.
struct CaseRunner::Posted {
  SourceMap sources;
  ir::ProgramFile file;
  sim::Bytecode code;
  sim::BlockSet watching; // bare skip moves that go to a position
  std::set<std::uint32_t> stores;
  std::vector<verify::ProgramVariable> reads; // common variables, before anything writes them
  std::set<std::uint32_t>
      leftOver; // common variables that it writes before it reads them: they hold anything before
  bool stopsSpindle = false, stopsCoolant = false; // by codes of its own
};

struct CaseRunner::Values {
  verify::Case drawn;
  FieldTable fields;
  std::optional<verify::DrawnPath> path; // of the machine
  std::optional<sim::Part> part;
  bool rejected = false; // by the dialog
  std::string rejection;
  SourceRange rejectedAt;
  std::vector<frontend::compost::PostedLine> lines;
  std::optional<SourceRange> spindleOff; // the first block that stops the spindle, as posted
  bool losesDigits = false;              // the post prints fewer digits of a value than it has
  bool rests = false;                    // what no picture holds is posted in full
  double rounding = 0; // mm, by which words of one side may be rounded where the other's are not
  std::unique_ptr<Posted> posted;
  std::optional<verify::Record> rehearsal;
  std::map<std::uint32_t, double> presets = {}; // variables that the macros of the translation want
  std::optional<std::uint64_t> caller = {};     // whose caller it has; nothing: one of its own values
};

// Runs of the source beside those of one case. What it learns of the fields is kept for the next.
class CaseRunner::Questions final : public SourceQuestions {
public:
  // All outlive it; `world` holds the part of the case.
  Questions(CaseRunner& runner, const Values& values, sim::World& world, bool probeOn)
      : runner_(runner), values_(values), world_(world), probeOn_(probeOn) {}
  Ran with(const std::string& field, double value) override;
  bool prints(const std::string& field, const std::vector<double>& values) override;
  bool takesNoOffset(const std::string& name, double value) override;
  Ran from(const verify::Entry& entry) override;
  Ran disturbed(const verify::Interference& interference) override;
  std::size_t touches() const override { return values_.path ? values_.path->touches.size() : 0; }
  void elsewhere(const verify::PartError& more, const Growth& grown,
                 const std::function<void(const verify::Record&, sim::World&)>& look) override;
  bool moves(const std::string& field) override;
  bool rejectsSome(const std::string& name) override;
  bool maySkip(const std::string& name) override;

private:
  bool setsActive(const std::string& field, double value) const;
  Ran play(const std::string& field, double value, verify::Stand::Way way);

  CaseRunner& runner_;
  const Values& values_;
  sim::World& world_;
  const bool probeOn_;
};

} // namespace dotek::targets
