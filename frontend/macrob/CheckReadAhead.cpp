// Positions that are read before the motion to them is done.
#include "frontend/macrob/BlockWords.h"
#include "frontend/macrob/Check.h"
#include "frontend/macrob/ReadAhead.h"
#include "frontend/macrob/Walk.h"
#include "stdlib/ReadAhead.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dotek::frontend::macrob {
namespace {

constexpr std::string_view kAxes = "XYZABCUVW";

// A position of the first axes, from the variable of X on.
bool isAmong(std::uint32_t number, std::optional<int> first) {
  constexpr std::uint32_t kMostAxes = 6;
  return first && number >= static_cast<std::uint32_t>(*first) &&
         number < static_cast<std::uint32_t>(*first) + kMostAxes;
}

// What a block is to the motion before it.
enum class Step : std::uint8_t {
  Keeps, // the motion may run on
  Ends,  // it is done, or nothing is known of the block
  Moves, // the block moves by itself
  Skips, // by a skip move
};

Step stepOf(const Words& words, const stdlib::Control& control) {
  // Codes that neither move nor wait.
  static constexpr std::array kQuiet = {0.0,  1.0,  2.0,  3.0,  17.0, 18.0, 19.0, 20.0, 21.0, 40.0, 41.0,
                                        42.0, 43.0, 44.0, 49.0, 54.0, 55.0, 56.0, 57.0, 58.0, 59.0, 61.0,
                                        64.0, 69.0, 80.0, 90.0, 91.0, 93.0, 94.0, 95.0, 98.0, 99.0};
  bool axis = false, skips = false, dwells = false;
  for (const nc::Word& word : words.words) {
    axis = axis || kAxes.find(word.address) != std::string_view::npos;
    if (word.address == 'M' || word.address == 'T') return Step::Ends; // the builder's
    if (word.address != 'G') continue;
    const auto code = literal(word);
    if (!code || stdlib::stopsReadingAhead(control, 'G', *code)) return Step::Ends;
    skips = skips || *code == 31;
    dwells = dwells || *code == 4;
    const bool cycle = *code >= 73 && *code <= 89;
    if (*code != 31 && *code != 4 && !cycle && std::find(kQuiet.begin(), kQuiet.end(), *code) == kQuiet.end())
      return Step::Ends;
  }
  return dwells || !axis ? Step::Keeps : skips ? Step::Skips : Step::Moves;
}

// G103 of the block, where the control has it.
std::optional<bool> limitOf(const Words& words, const stdlib::Control& control) {
  if (findCode(words, 'G', 103) == nullptr) return std::nullopt;
  const nc::Word* p = findWord(words, 'P');
  return stdlib::readAheadLimit(control, p == nullptr ? std::nullopt : literal(*p));
}

bool hasCode(const Block& block, char letter, double code) {
  const auto* words = std::get_if<Words>(&block.body);
  return words != nullptr && findCode(*words, letter, code) != nullptr;
}

// Whether G103 P1 is in force before each block on all ways to it, those of GOTO and M97 P among them. Empty:
// the program has no G103.
class Limits {
public:
  Limits(const Program& program, const stdlib::Control& control) : blocks_(program.blocks) {
    if (std::none_of(blocks_.begin(), blocks_.end(), [](const Block& one) { return hasCode(one, 'G', 103); }))
      return;
    for (std::size_t i = 0; i < blocks_.size(); ++i)
      if (blocks_[i].sequenceNumber) numbered_[blocks_[i].sequenceNumber->value].push_back(i);
    before_.resize(blocks_.size());
    arrive(0, false);
    while (!open_.empty()) {
      const std::size_t at = open_.back();
      open_.pop_back();
      leave(at, control);
    }
  }
  bool before(std::size_t block) const { return !before_.empty() && before_[block] == true; }

private:
  void arrive(std::size_t at, bool limited) {
    if (at >= blocks_.size() || before_[at] == false || before_[at] == limited) return;
    before_[at] = limited;
    open_.push_back(at);
  }
  void arriveAt(const std::optional<double>& number, bool limited) {
    if (number && !(*number >= 0 && *number < 1e15)) return;
    if (number) {
      if (const auto found = numbered_.find(static_cast<std::uint64_t>(*number)); found != numbered_.end())
        for (const std::size_t at : found->second)
          arrive(at, limited);
    } else if (!std::exchange(computed_[limited ? 1 : 0], true)) { // to every number
      for (const auto& [value, places] : numbered_)
        for (const std::size_t at : places)
          arrive(at, limited);
    }
  }
  void leave(std::size_t at, const stdlib::Control& control) {
    const Block& block = blocks_[at];
    bool limited = *before_[at];
    bool falls = !std::holds_alternative<Goto>(block.body);
    if (const Goto* jump = gotoOf(block)) arriveAt(literal(*jump->target), limited);
    if (const auto* words = std::get_if<Words>(&block.body)) {
      limited = limitOf(*words, control).value_or(limited);
      if (const nc::Word* p = findWord(*words, 'P'); p != nullptr && hasCode(block, 'M', 97))
        arriveAt(literal(*p), limited);
      for (const double code : {2.0, 30.0, 99.0})
        falls = falls && findCode(*words, 'M', code) == nullptr;
    }
    if (falls || block.blockDelete) arrive(at + 1, limited);
  }

  const std::vector<Block>& blocks_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> numbered_;
  std::vector<std::optional<bool>> before_; // nothing: no way leads there
  std::vector<std::size_t> open_;
  std::array<bool, 2> computed_{}; // a jump by a computed number has arrived without the limit, with it
};

// Follows the text: nothing is known of a block that jumps arrive at.
class EarlyReads {
public:
  EarlyReads(const stdlib::Control& control, Report& report) : control_(control), report_(report) {}

  // `limited`: before the block the control reads one block ahead only.
  void look(const Block& block, bool limited) {
    limited_ = limited;
    if (limited_) moving_ = skipping_ = nullptr;
    if (moving_ != nullptr || skipping_ != nullptr)
      walk(block, [&](const Expression& expression, bool) {
        if (const auto number = variableNumber(expression)) read(expression.range, *number);
      });
    if (block.target || std::holds_alternative<Goto>(block.body) ||
        std::holds_alternative<Unread>(block.body))
      moving_ = skipping_ = nullptr;
    if (const auto* words = std::get_if<Words>(&block.body)) step(block, *words);
  }

private:
  // Reported once for each motion.
  void read(SourceRange range, std::uint32_t number) {
    const stdlib::SystemVariables& variables = control_.variables;
    const Block* motion = isAmong(number, variables.machine) || isAmong(number, variables.position) ? moving_
                          : isAmong(number, variables.skip) ? skipping_
                                                            : nullptr;
    if (motion == nullptr) return;
    reportReadAhead(range, number, control_, report_).note(motion->range, "the motion");
    if (motion == moving_) moving_ = nullptr;
    if (motion == skipping_) skipping_ = nullptr;
  }

  void step(const Block& block, const Words& words) {
    if (limitOf(words, control_)) return;
    const Step step = stepOf(words, control_);
    if (step == Step::Ends) moving_ = skipping_ = nullptr;
    if (limited_ || (step != Step::Moves && step != Step::Skips)) return;
    moving_ = &block;
    if (step == Step::Skips) skipping_ = &block;
  }

  const stdlib::Control& control_;
  Report& report_;
  bool limited_ = false;            // G103 P1
  const Block* moving_ = nullptr;   // may still run
  const Block* skipping_ = nullptr; // the skip move among what may still run
};

} // namespace

Diagnostic& reportReadAhead(SourceRange read, std::uint32_t variable, const stdlib::Control& control,
                            Report& report) {
  return isAmong(variable, control.variables.skip)
             ? report.at(read,
                         "#{} is read while the skip move before it may still run; the control reads ahead "
                         "and gives the position of an earlier one; put {} between",
                         variable, stdlib::waitAdvice(control))
             : report.at(read,
                         "#{} is read while the motion before it may still run; the control reads ahead and "
                         "gives a position on the path; put {} between",
                         variable, stdlib::waitAdvice(control));
}

void positionReadEarly(const CheckedProgram& input, Report& report) {
  if (input.control == nullptr || input.control->readAheadStops.empty()) return;
  EarlyReads reads(*input.control, report);
  const Limits limits(input.program, *input.control);
  for (std::size_t i = 0; i < input.program.blocks.size(); ++i)
    reads.look(input.program.blocks[i], limits.before(i));
}

} // namespace dotek::frontend::macrob
