#include "ir/Flow.h"
#include "lint/NcProgram.h"
#include "lint/Turning.h"

#include <algorithm>
#include <array>
#include <set>

namespace dotek::lint::rule {
namespace {

using stdlib::Function;

// M codes that leave the spindle as it is; all others of a builder may start one.
constexpr std::array kNeutral = {0.0,  1.0,  2.0,  7.0,  8.0,  9.0,  10.0, 11.0, 23.0,
                                 24.0, 30.0, 40.0, 41.0, 42.0, 43.0, 44.0, 68.0, 69.0};

// Of a main program, in the order of the text.
class Modes {
public:
  Modes(const NcProgram& nc, Report& report) : nc_(nc), control_(*nc.project.control), report_(report) {}

  void run() {
    std::set<ir::LabelId> targets;
    bool computed = false, main = false;
    for (const ir::ProgramStatement& statement : nc_.program.body) {
      if (const auto target = ir::targetOf(statement)) targets.insert(*target);
      computed = computed || ir::isComputedJump(statement);
      main = main || ir::endsProgram(statement);
    }
    if (!main) return; // who calls it may have set them
    for (const ir::ProgramStatement& statement : nc_.program.body) {
      const auto* label = std::get_if<ir::Label>(&statement.node);
      if (callOf(statement) != nullptr ||
          (label != nullptr && (computed || targets.contains(label->label)))) {
        feed_ = spindle_ = Certain::Unknown;
        radius_ = nullptr;
        motion_ = -1;
      }
      if (const auto* block = std::get_if<ir::NcBlock>(&statement.node)) look(*block);
      if (ir::endsProgram(statement)) break;
    }
  }

private:
  void look(const ir::NcBlock& block) {
    bool other = false; // takes the words, or is a builder's
    for (const ir::Word& word : block.words) {
      const double* code = ir::constantValue(word.value);
      if (word.address == 'G' && code == nullptr) other = true;
      if (word.address == 'M') spindle(code);
    }
    for (const int code : {0, 1, 2, 3, 32, 34})
      if (hasCode(block, 'G', code)) motion_ = code;
    bool cycle = false, contour = false;
    for (const Function one : {Function::TurningCycle, Function::FacingCycle, Function::ThreadingCycle})
      if (wordOf(block, control_, one) != nullptr) {
        motion_ = kCycle;
        cycle = true;
      }
    for (const Function one :
         {Function::PeckAlongZ, Function::PeckAlongX, Function::ThreadPasses, Function::CannedCycle})
      cycle = cycle || wordOf(block, control_, one) != nullptr;
    for (const Function one : {Function::ContourRough, Function::ContourFinish})
      contour = contour || wordOf(block, control_, one) != nullptr;
    for (const Function one :
         {Function::Dwell, Function::DataInput, Function::MacroCall, Function::ModalCall,
          Function::SetPosition, Function::ReferenceReturn, Function::SecondReferenceReturn,
          Function::MachineCoordinates, Function::LocalShift, Function::Skip})
      other = other || wordOf(block, control_, one) != nullptr;
    compensation(block);
    if (hasWord(block, 'F')) feed_ = Certain::Yes;
    const bool axes = firstWord(block, "XZUW") != nullptr;
    const bool cuts = !other && axes && (cycle || (!contour && motion_ >= 1)) && motion_ != 0;
    if (!cuts && !(contour && hasWord(block, 'P'))) return;
    if (feed_ == Certain::No && motion_ != 32 && motion_ != 34 && !contour) {
      report_.at(
          block.words.front().range,
          "no feed was given on the path to this cut; the control stops with alarm 11, or moves at the "
          "feed of the program before; write F");
      feed_ = Certain::Unknown;
    }
    if (spindle_ == Certain::No) {
      report_.at(block.words.front().range,
                 "the spindle does not turn here: no block before it has M3 or M4; the tool is pushed into "
                 "the part and breaks; write S and M3 before");
      spindle_ = Certain::Unknown;
    }
  }

  void spindle(const double* code) {
    if (code != nullptr && (*code == 3 || *code == 4))
      spindle_ = Certain::Yes;
    else if (code == nullptr || std::find(kNeutral.begin(), kNeutral.end(), *code) == kNeutral.end())
      spindle_ = Certain::Unknown; // M5, too: bars are pulled at feed with the spindle off
    if (code != nullptr && (*code == 2 || *code == 30) && radius_ != nullptr)
      report_.at(radius_->range,
                 "the compensation of the tool's nose that begins here is not ended; the next "
                 "tool and the next part begin with it; write G40 where the contour ends");
  }

  void compensation(const ir::NcBlock& block) {
    for (const Function one : {Function::CutterCompLeft, Function::CutterCompRight})
      if (const ir::Word* word = wordOf(block, control_, one)) radius_ = word;
    if (wordOf(block, control_, Function::CutterCompOff) != nullptr) radius_ = nullptr;
  }

  static constexpr int kCycle = 90;

  const NcProgram& nc_;
  const stdlib::Control& control_;
  Report& report_;
  Certain feed_ = Certain::No, spindle_ = Certain::No;
  int motion_ = -1;
  const ir::Word* radius_ = nullptr; // of G41 or G42 in force
};

void check(const NcProgram& nc, Report& report) {
  if (isForLathe(nc.project)) Modes(nc, report).run();
}

} // namespace

DOTEK_LINT_RULE(turning_modes){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
