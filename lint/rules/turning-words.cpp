#include "ir/Flow.h"
#include "lint/NcProgram.h"
#include "lint/Turning.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace dotek::lint::rule {
namespace {

using stdlib::Function;

constexpr double kTolerance = 0.03; // mm, of the ends of an arc

bool hasAnyOf(const ir::NcBlock& block, const stdlib::Control& control,
              std::initializer_list<Function> functions) {
  return std::any_of(functions.begin(), functions.end(),
                     [&](Function one) { return wordOf(block, control, one) != nullptr; });
}

// Blocks of a program in the order of the text; what a jump or a call may change is forgotten there.
class Blocks {
public:
  Blocks(const NcProgram& nc, Report& report)
      : nc_(nc), control_(*nc.project.control), turning_(*control_.turning), report_(report) {}

  void run() {
    std::set<ir::LabelId> targets;
    bool computed = false, main = false;
    for (const ir::ProgramStatement& statement : nc_.program.body) {
      if (const auto target = ir::targetOf(statement)) targets.insert(*target);
      computed = computed || ir::isComputedJump(statement);
      main = main || ir::endsProgram(statement);
    }
    if (main) lead_ = Lead::None;
    for (const ir::ProgramStatement& statement : nc_.program.body) {
      const auto* label = std::get_if<ir::Label>(&statement.node);
      if (callOf(statement) != nullptr || (label != nullptr && (computed || targets.contains(label->label))))
        forget();
      if (const auto* block = std::get_if<ir::NcBlock>(&statement.node)) look(*block);
      if (ir::endsProgram(statement) || std::holds_alternative<ir::Exit>(statement.node)) forget();
    }
  }

private:
  enum class Lead : std::uint8_t { None, Feed, Given };

  void forget() {
    lead_ = Lead::Given;
    at_ = {};
    motion_ = -1;
    first_ = nullptr;
  }

  void look(const ir::NcBlock& block) {
    for (const int code : {0, 1, 2, 3})
      if (hasCode(block, 'G', code)) motion_ = code;
    if (hasAnyOf(block, control_,
                 {Function::Thread, Function::TurningCycle, Function::ThreadingCycle, Function::FacingCycle}))
      motion_ = kOther;
    const bool keeps =
        hasAnyOf(block, control_,
                 {Function::Dwell, Function::DataInput, Function::MacroCall, Function::ModalCall,
                  Function::SetPosition, Function::ContourFinish, Function::ContourRough,
                  Function::PeckAlongZ, Function::PeckAlongX, Function::ThreadPasses});
    if (!keeps) twice(block);
    contour(block);
    thread(block);
    if (motion_ == 2 || motion_ == 3) arc(block);
    if (hasAnyOf(block, control_,
                 {Function::ReferenceReturn, Function::SecondReferenceReturn, Function::MachineCoordinates,
                  Function::SetPosition, Function::WorkSystem, Function::LocalShift}) ||
        hasWord(block, 'T'))
      at_ = {};
    else if (!keeps && motion_ >= 0 && motion_ < kOther)
      at_ = endOf(block);
  }

  // X and U, Z and W
  void twice(const ir::NcBlock& block) {
    for (const auto& [axis, increment] : turning_.increments) {
      const ir::Word* const by = firstWord(block, {&increment, 1});
      if (by == nullptr || !hasWord(block, axis)) continue;
      report_.at(by->range,
                 "`{1}` beside `{0}`: the block gives the same axis a position and a distance; which of them "
                 "counts is not certain, and the tool goes where nobody means; write one of them",
                 axis, increment);
      return;
    }
  }

  // The two blocks of G71 to G73.
  void contour(const ir::NcBlock& block) {
    const ir::Word* const code = wordOf(block, control_, Function::ContourRough);
    if (code == nullptr) {
      if (firstWord(block, "XZUW") != nullptr) first_ = nullptr;
      return;
    }
    if (firstWord(block, "PQ") != nullptr) {
      first_ = nullptr;
      return;
    }
    if (first_ != nullptr && *ir::constantValue(first_->value) == *ir::constantValue(code->value))
      report_
          .at(code->range,
              "the second of two blocks has no P and Q, so the cycle has no contour; the control stops with "
              "an alarm; write the N numbers of the contour's first and last block")
          .note(first_->range, "the first block is here");
    first_ = code;
  }

  void thread(const ir::NcBlock& block) {
    const bool given = firstWord(block, "FE") != nullptr;
    const ir::Word* code = nullptr;
    for (const Function one : {Function::Thread, Function::ThreadingCycle, Function::ThreadPasses})
      if (code == nullptr) code = wordOf(block, control_, one);
    const bool passes = wordOf(block, control_, Function::ThreadPasses) != nullptr;
    if (code == nullptr || firstWord(block, "XZUW") == nullptr) {
      if (given) lead_ = code == nullptr && motion_ > 0 && motion_ < kOther ? Lead::Feed : Lead::Given;
      return;
    }
    if (passes && hasWord(block, 'P') && !hasWord(block, 'Q') && firstWord(block, "ADK") == nullptr)
      report_.at(code->range, "the thread has no Q, the depth of its first pass; the control stops with an "
                              "alarm or cuts the depth of another thread; write Q");
    if (!given && lead_ != Lead::Given)
      report_.at(code->range,
                 "a thread without its lead{}; the control stops with an alarm, or the thread gets another "
                 "lead; write F with the lead",
                 lead_ == Lead::Feed ? ", and the F before it is the feed of a cut" : "");
    lead_ = Lead::Given;
  }

  // Programmed X (a diameter where the control counts those) and Z after the block.
  std::array<std::optional<double>, 2> endOf(const ir::NcBlock& block) const {
    auto out = at_;
    for (std::size_t i = 0; i < 2; ++i) {
      const char axis = i == 0 ? 'X' : 'Z', increment = turning_.incrementOf(axis);
      const ir::Word *const to = firstWord(block, {&axis, 1}), *const by = firstWord(block, {&increment, 1});
      if (to != nullptr)
        out[i] = certain(*to);
      else if (by != nullptr)
        out[i] = out[i] && certain(*by) ? std::optional(*out[i] + *certain(*by)) : std::nullopt;
    }
    return out;
  }

  // What a number without a point counts may be increments.
  std::optional<double> certain(const ir::Word& word) const {
    const double* value = ir::constantValue(word.value);
    if (value == nullptr) return std::nullopt;
    if (*value != 0 && ir::numberWithoutPoint(word.value) != nullptr &&
        control_.countsIncrements(word.address))
      return std::nullopt;
    return *value;
  }

  void arc(const ir::NcBlock& block) {
    const ir::Word* const radius = firstWord(block, "R");
    if (radius == nullptr || firstWord(block, "XZUW") == nullptr || firstWord(block, "IKYV") != nullptr)
      return;
    const auto end = endOf(block);
    const auto r = certain(*radius);
    if (!r || !at_[0] || !at_[1] || !end[0] || !end[1]) return;
    const double dx = (*end[0] - *at_[0]) / (turning_.diameters ? 2 : 1), dz = *end[1] - *at_[1];
    const double chord = std::hypot(dx, dz);
    if (std::abs(*r) > 0 && chord / 2 - std::abs(*r) > kTolerance)
      report_.at(
          radius->range,
          "the ends of this arc are {:.3f} apart and its radius is {:.3f}, less than half of that; the "
          "control stops with alarm 20; correct the end point or R",
          chord, std::abs(*r));
  }

  static constexpr int kOther = 4; // G32, and the cycles that come back

  const NcProgram& nc_;
  const stdlib::Control& control_;
  const stdlib::TurningFacts& turning_;
  Report& report_;
  Lead lead_ = Lead::Given;
  int motion_ = -1;
  std::array<std::optional<double>, 2> at_{};
  const ir::Word* first_ = nullptr; // code of the first of two blocks
};

void check(const NcProgram& nc, Report& report) {
  if (isForLathe(nc.project)) Blocks(nc, report).run();
}

} // namespace

DOTEK_LINT_RULE(turning_words){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
