#include "lint/ToolLength.h"

#include "ir/Match.h"
#include "ir/Walk.h"
#include "lint/LengthFacts.h"
#include "lint/Skips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace dotek::lint {
namespace {

constexpr std::uint32_t kBlockEndZ = 5003;
constexpr double kMostTolerance = 10; // mm; more is no tolerance of a contact

// Canned cycles, whose R is a coordinate under G90 as Z is.
bool isCannedCycle(const ir::NcBlock& block) {
  constexpr std::array<double, 12> kCycles = {73, 74, 76, 81, 82, 83, 84, 85, 86, 87, 88, 89};
  return hasAnyCode(block, 'G', kCycles);
}

class Search : public LengthFacts {
public:
  using LengthFacts::LengthFacts;

  // `given`: what callers may pass, of which nothing is known but that it may hold the length.
  std::vector<LengthLeftIn> run(const std::set<std::uint32_t>& given) {
    if (!readsPosition() && !readsLength() && !getsPosition()) return {};
    Fact entry = entryFact();
    for (const std::uint32_t number : given) {
      Held maybe;
      maybe.maybeAdded = true;
      entry.values.set(number, maybe);
    }
    return judged(entry);
  }

  // With what the call passes: coordinates that are computed from it.
  std::vector<LengthLeftIn> runPassed(const Passing& passing) {
    Fact entry = entryFact();
    if (passing.offset != Offset::AsBefore) entry.offset = passing.offset;
    for (const auto& [number, held] : passing.values)
      entry.values.set(number, held);
    std::vector<LengthLeftIn> all = judged(entry);
    std::erase_if(all, [](const LengthLeftIn& one) {
      return one.taken || !one.passed.hasPlace() || one.place == LengthLeftIn::Place::Difference;
    });
    return all;
  }

private:
  std::vector<LengthLeftIn> judged(const Fact& entry) {
    const auto& body = program_.body;
    const auto facts = factsFrom(entry);
    for (std::size_t i = 0; i < body.size(); ++i)
      if (facts[i]) noteHeights(body[i], *facts[i]);
    const auto& modes = nc_.modes();
    for (std::size_t i = 0; i < body.size(); ++i) {
      if (!facts[i]) continue;
      const auto mode =
          modes[i] ? std::optional(statedMode(body[i]).value_or(*modes[i])) : statedMode(body[i]);
      absolute_ = modes[i] && mode == DistanceMode::Absolute;
      incremental_ = mode == DistanceMode::Incremental;
      judge(body[i], *facts[i]);
    }
    return std::move(found_);
  }

  void report(LengthLeftIn::Place place, SourceRange range, const ir::ExpressionPtr& value,
              const Fact& fact) {
    reportHeld(place, range, value->range, held(value, fact), fact);
  }

  void reportHeld(LengthLeftIn::Place place, SourceRange range, SourceRange value, const Held& one,
                  const Fact& fact, bool assigned = false) {
    if (one.unknown || one.lengths == 0 || fact.offset == Offset::Off) return;
    if (one.lengths > 0 ? one.maybeTaken : one.maybeAdded) return;
    // The length taken off a coordinate that never held it.
    const bool taken = !one.read && one.length && one.lengths < 0 && place == LengthLeftIn::Place::Move;
    if (!one.read && !(taken && absolute_)) return;
    const PositionRead& read = taken ? *one.length : *one.read;
    const std::uint32_t length = numbers_.length.empty() ? 0 : *numbers_.length.begin();
    LengthLeftIn found{place, range, value, one.lengths, read.number, read.range, length};
    found.assigned = assigned;
    found.taken = taken;
    if (!taken) found.passed = read.passed;
    if (one.wear != nullptr) found.wear = {one.wear->wear.first - 1, one.wear->geometry};
    if (fact.offset == Offset::On && called_ && called_->offset == Offset::On) found.call = called_->call;
    found_.push_back(std::move(found));
  }

  // Variables of which a Z is computed that holds no length: an argument, or what the program has taken it
  // off.
  void noteHeights(const ir::ProgramStatement& statement, const Fact& fact) {
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr || hasCode(*block, 'G', 91) ||
        (!isPlainMove(*block) && skipOf(statement) == nullptr))
      return;
    for (const ir::Word& word : block->words) {
      if (word.address != 'Z' || word.value == nullptr) continue;
      if (const double* number = ir::constantValue(word.value);
          number != nullptr && skipOf(statement) != nullptr)
        targets_.push_back(*number);
      if (const Held z = held(word.value, fact); !z.none() || z.free() || z.wear != nullptr) continue;
      ir::eachNode(word.value, [&](const ir::Expression& one) {
        if (!std::holds_alternative<ir::MachineVariable>(one.node)) return;
        if (const auto number = variableNumber(one)) heights_.insert(*number);
      });
    }
  }

  bool isHeight(const ir::ExpressionPtr& value, const Fact& fact) const {
    if (const Held one = held(value, fact); !one.none() || one.free() || one.wear != nullptr) return false;
    bool out = false;
    ir::eachNode(value, [&](const ir::Expression& one) {
      if (!std::holds_alternative<ir::MachineVariable>(one.node)) return;
      const auto number = variableNumber(one);
      out = out || (number && heights_.contains(*number));
    });
    return out;
  }

  void judgePair(const ir::ExpressionPtr& left, const ir::ExpressionPtr& right, const Fact& fact) {
    for (const auto& [position, height] : {std::pair{left, right}, std::pair{right, left}}) {
      if (!isHeight(height, fact)) continue;
      report(LengthLeftIn::Place::Difference, spanning(left->range, right->range), position, fact);
      return;
    }
  }

  void judgeCondition(const ir::ConditionPtr& condition, const Fact& fact) {
    ir::match(
        *condition,
        [&](const ir::Comparison& one) {
          if (one.relation == ir::Relation::Same || one.relation == ir::Relation::Different) return;
          judgePair(one.left, one.right, fact);
          judgeSize(one, fact);
        },
        [&](const ir::Not& one) { judgeCondition(one.inner, fact); },
        [&](const ir::Junction& one) {
          judgeCondition(one.left, fact);
          judgeCondition(one.right, fact);
        },
        [](const ir::OneOf<ir::IsNull, ir::Truth> auto&) {});
  }

  // ABS of a contact against a tolerance, under an offset that the program states: the height that was looked
  // for may be a number, or 0, which is not written.
  void judgeSize(const ir::Comparison& comparison, const Fact& fact) {
    if (fact.offset != Offset::On) return;
    for (const auto& [side, bound] :
         {std::pair{comparison.left, comparison.right}, std::pair{comparison.right, comparison.left}}) {
      const auto* size = std::get_if<ir::Unary>(&side->node);
      const double* number = ir::constantValue(bound);
      if (size == nullptr || size->op != ir::UnaryOp::Absolute) {
        judgeLimit(side, number, fact);
        continue;
      }
      const Held other = held(bound, fact);
      if (!other.none() || other.free() || (number != nullptr && std::abs(*number) > kMostTolerance))
        continue;
      report(LengthLeftIn::Place::Difference, size->operand->range, size->operand, fact);
    }
  }

  // A contact against a number, as a limit of one side: a number as small as a tolerance, or that of the end
  // of a skip move, is no height of a spindle.
  void judgeLimit(const ir::ExpressionPtr& side, const double* number, const Fact& fact) {
    if (number == nullptr) return;
    const bool height = std::abs(*number) <= kMostTolerance ||
                        std::any_of(targets_.begin(), targets_.end(),
                                    [&](double target) { return std::abs(*number - target) <= 1; });
    const Held one = held(side, fact);
    if (height && !one.free()) report(LengthLeftIn::Place::Difference, side->range, side, fact);
  }

  // Under an offset that nothing of the program takes back, a height is where the tool's end is.
  void judgeDifferences(const ir::ProgramStatement& statement, const Fact& fact) {
    ir::eachNode(statement, [&](const ir::Expression& one) {
      const auto* binary = std::get_if<ir::Binary>(&one.node);
      if (binary == nullptr || binary->op != ir::BinaryOp::Subtract) return;
      // Taken off the end of the block, which holds no length, the position gives the length.
      bool end = false;
      for (const ir::ExpressionPtr& side : {binary->left, binary->right})
        ir::eachNode(side,
                     [&](const ir::Expression& node) { end = end || variableNumber(node) == kBlockEndZ; });
      if (!end) judgePair(binary->left, binary->right, fact);
    });
    if (const ir::ConditionPtr* condition = ir::conditionOf(statement); condition != nullptr && *condition)
      judgeCondition(*condition, fact);
  }

  void judge(const ir::ProgramStatement& statement, Fact fact) {
    if (const auto stated = statedOffset(statement, nc_.otherCodes())) fact.offset = *stated;
    ir::match(
        statement, [&](const ir::NcBlock& block) { judgeBlock(statement, block, fact); },
        [&](const ir::Call&) {
          if (const ir::Call* call = callOf(statement)) judgeCall(*call, fact);
        },
        [&](const ir::Store& store) {
          if (maySetZero(fact)) judgeStore(statement, store, fact);
        },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Comment, ir::JumpTo, ir::Loop, ir::LoopEnd,
                           ir::Exit, ir::Raise, ir::Notice, ir::Port, ir::Print, ir::NameVariables> auto&) {
        });
    judgeDifferences(statement, fact); // of a coordinate the move or the offset says more
  }

  // A macro is called under G43, or its own `#5083` is 0; a program that says nothing of lengths has none.
  bool maySetZero(const Fact& fact) const {
    return fact.offset == Offset::On || (macro_ && fact.offset == Offset::AsBefore);
  }

  // G10 L2, L20: the zero of a work system.
  static bool isZeroInput(const ir::NcBlock& block) {
    const auto l = wordValue(block, 'L');
    return l == 2.0 || l == 20.0;
  }

  void judgeBlock(const ir::ProgramStatement& statement, const ir::NcBlock& block, const Fact& fact) {
    if (hasCode(block, 'G', 10)) judgeToolInput(block, fact);
    // G52: a zero within the zero of the work system.
    const bool offset =
        ((hasCode(block, 'G', 10) && isZeroInput(block)) || hasCode(block, 'G', 52)) && maySetZero(fact);
    if (!offset && !isPlainMove(block) && (skipOf(statement) == nullptr || hasCode(block, 'G', 53))) return;
    const bool cycle = !incremental_ && isCannedCycle(block);
    for (const ir::Word& word : block.words)
      if (word.address == 'Z' || (cycle && word.address == 'R'))
        report(offset ? LengthLeftIn::Place::WorkOffset : LengthLeftIn::Place::Move, word.range, word.value,
               fact);
  }

  // A write of a variable that is the Z of a zero.
  void judgeStore(const ir::ProgramStatement& statement, const ir::Store& store, const Fact& fact) {
    const auto number = storedNumber(statement);
    const auto first = number ? number : nc_.writes().firstNumber(store.number);
    const bool zero =
        first && (number ? numbers_.zeroes.contains(*first)
                         : numbers_.zeroes.contains(*first) || numbers_.zeroes.contains(*first + 20));
    if (zero)
      reportHeld(LengthLeftIn::Place::WorkOffset, statement.origin.range(), store.value->range,
                 held(store.value, fact), fact, true);
    if (!isToolOffset(number, store.number)) return;
    const bool wear = project_.control != nullptr && isWear(number, store.number);
    const Correction one =
        correction(store.value, fact, [&](const ir::Expression&, const ir::ExpressionPtr& entry) {
          return ir::equal(entry, store.number);
        });
    if (one.added || (wear && measuredUnderLength(fact)))
      reportHeld(LengthLeftIn::Place::ToolOffset, statement.origin.range(), store.value->range, one.held,
                 fact, true);
  }

  // G10 L10 and L11: the length of a tool and its wear.
  void judgeToolInput(const ir::NcBlock& block, const Fact& fact) {
    const auto l = wordValue(block, 'L');
    if ((l != 10.0 && l != 11.0) || !maySetZero(fact)) return;
    const bool wear = l == 11.0;
    for (const ir::Word& word : block.words) {
      if (word.address != 'R' || word.value == nullptr) continue;
      const Correction one =
          correction(word.value, fact, [&](const ir::Expression& variable, const ir::ExpressionPtr& entry) {
            return isToolOffset(variableNumber(variable), entry) &&
                   isWear(variableNumber(variable), entry) == wear;
          });
      if (one.added || incremental_ || (wear && !numbers_.wears.empty() && measuredUnderLength(fact)))
        reportHeld(LengthLeftIn::Place::ToolOffset, word.range, word.value->range, one.held, fact);
    }
  }

  // A new value is the length of a tool that is measured, and of a wear only where none is in force.
  bool measuredUnderLength(const Fact& fact) const {
    return readsLength() || (project_.control != nullptr && fact.offset == Offset::On);
  }

  bool isWear(const std::optional<std::uint32_t>& number, const ir::ExpressionPtr& computed) const {
    const auto first = number ? number : nc_.writes().firstNumber(computed);
    return first && numbers_.wearOf(number ? *number : *first + 1) != nullptr;
  }

  // A sum, and whether the old entry of the table is a term; `held` is what the rest holds.
  struct Correction {
    Held held;
    bool added = false;
  };
  Correction correction(const ir::ExpressionPtr& value, const Fact& fact, const auto& isEntry,
                        bool plus = true) const {
    if (const auto* unary = std::get_if<ir::Unary>(&value->node);
        unary != nullptr && unary->op == ir::UnaryOp::NullAsZero)
      return correction(unary->operand, fact, isEntry, plus);
    if (const auto* binary = std::get_if<ir::Binary>(&value->node);
        binary != nullptr && (binary->op == ir::BinaryOp::Add || binary->op == ir::BinaryOp::Subtract)) {
      const bool subtract = binary->op == ir::BinaryOp::Subtract;
      const Correction left = correction(binary->left, fact, isEntry, plus);
      const Correction right = correction(binary->right, fact, isEntry, plus != subtract);
      return {sum(left.held, right.held, subtract), left.added || right.added};
    }
    const auto* variable = std::get_if<ir::MachineVariable>(&value->node);
    if (plus && variable != nullptr && isEntry(*value, variable->number)) return {{}, true};
    return {held(value, fact), false};
  }

  // Arguments along Z that a probing macro takes as coordinates of the work system.
  void judgeCall(const ir::Call& call, const Fact& fact) {
    const double* number = call.program ? ir::constantValue(call.program) : nullptr;
    if (call.kind != ir::CallKind::Macro || number == nullptr || !(*number >= 0 && *number < 1e9)) return;
    const auto program = static_cast<std::uint32_t>(*number);
    std::string letters;
    for (const ir::CallArgument& argument : call.arguments)
      letters += argument.letter;
    for (const stdlib::MacroSet& set : project_.macroSets) {
      if (!set.calls(program) || !mayBeOf(set, program, letters)) continue;
      const stdlib::CallReading reading = readKnown(set, program, letters);
      if (reading.signature == nullptr) continue;
      for (const ir::CallArgument& argument : call.arguments) {
        const stdlib::MacroArgument* meaning = reading.signature->find(argument.letter);
        const bool coordinate = meaning != nullptr && argument.value != nullptr &&
                                ((meaning->role == stdlib::ArgumentRole::Target &&
                                  meaning->axis == ir::Axis::Z && meaning->frame == ir::Frame::Work) ||
                                 meaning->role == stdlib::ArgumentRole::Depth);
        if (coordinate) report(LengthLeftIn::Place::Argument, argument.range, argument.value, fact);
      }
      return;
    }
  }

  bool macro_ = !endsProgram(program_); // it returns: what is in force is its caller's
  bool incremental_ = false;            // G91 is
  bool absolute_ = false;               // G90 is in force at the statement that is judged
  std::vector<double> targets_;         // of absolute skip moves along Z
  std::set<std::uint32_t> heights_;     // variables of which absolute Z words are computed
  std::vector<LengthLeftIn> found_;
};

} // namespace

struct ToolLengths::Known {
  explicit Known(const Project& of)
      : project(of), numbers(of), switching(switchingPrograms(of)), called(calledUnder(of, switching)) {
    std::map<std::uint32_t, std::size_t> count;
    const NcPrograms& programs = programsOf(project);
    for (const auto& nc : programs)
      ++count[numberOf(*nc)];
    for (const auto& [number, times] : count)
      if (number != 0 && times == 1) own.insert(number);
    const auto stored = storedByCalled();
    for (const auto& nc : programs) {
      const auto found = stored.find(numberOf(*nc));
      if (found != stored.end() && !found->second.empty())
        left.emplace(found->first, search(*nc, nullptr).leftBehind(found->second));
    }
    for (const auto& nc : programs)
      for (Passing& one : search(*nc, &left).passings(own))
        passed[one.callee].push_back(std::move(one));
  }

  static std::uint32_t numberOf(const NcProgram& nc) { return static_cast<std::uint32_t>(nc.program.number); }

  // What programs that are called may set, by themselves and by what they call.
  std::map<std::uint32_t, std::set<std::uint32_t>> storedByCalled() const {
    std::map<std::uint32_t, std::set<std::uint32_t>> out;
    std::map<std::uint32_t, std::set<std::uint32_t>> calls;
    for (const auto& nc : programsOf(project)) {
      const std::uint32_t number = numberOf(*nc);
      if (!own.contains(number) || !called.contains(number)) continue;
      out[number] = search(*nc, nullptr).stored();
      for (const ir::ProgramStatement& statement : nc->program.body)
        if (const auto callee = calledProgram(statement)) calls[number].insert(*callee);
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [caller, callees] : calls)
        for (const std::uint32_t callee : callees)
          if (const auto inner = out.find(callee); inner != out.end()) {
            const std::size_t before = out[caller].size();
            out[caller].insert(inner->second.begin(), inner->second.end());
            changed = changed || out[caller].size() != before;
          }
    }
    return out;
  }

  Search search(const NcProgram& nc, const LeftBehind* leftBehind) const {
    const auto under = called.find(numberOf(nc));
    return Search(nc, numbers, switching, under == called.end() ? std::nullopt : std::optional(under->second),
                  leftBehind);
  }

  const Project& project;
  LengthNumbers numbers;
  std::set<std::uint32_t> switching;
  std::map<std::uint32_t, CalledUnder> called;
  std::set<std::uint32_t> own; // numbers that one program of the files has
  LeftBehind left;
  std::map<std::uint32_t, std::vector<Passing>> passed; // by the program that gets it
};

ToolLengths::ToolLengths(const Project& project) : known_(std::make_unique<const Known>(project)) {}

ToolLengths::~ToolLengths() = default;

std::vector<LengthLeftIn> ToolLengths::leftIn(const NcProgram& nc) const {
  const std::uint32_t number = Known::numberOf(nc);
  const auto passed = known_->own.contains(number) ? known_->passed.find(number) : known_->passed.end();
  std::set<std::uint32_t> given;
  if (passed != known_->passed.end())
    for (const Passing& one : passed->second)
      for (const auto& [variable, held] : one.values)
        if (held.lengths != 0) given.insert(variable);
  std::vector<LengthLeftIn> out = known_->search(nc, &known_->left).run(given);
  if (passed == known_->passed.end()) return out;
  // More calls of one program pass what others do, and each is a walk through it.
  constexpr std::size_t kMostCalls = 8;
  for (std::size_t i = 0; i < std::min(kMostCalls, passed->second.size()); ++i)
    for (LengthLeftIn& found : known_->search(nc, &known_->left).runPassed(passed->second[i]))
      out.push_back(std::move(found));
  return out;
}

bool ToolLengths::measuresTool(const NcProgram& nc) const {
  return known_->search(nc, nullptr).measuresTool();
}

const std::set<std::uint32_t>& ToolLengths::switching() const {
  return known_->switching;
}

const std::map<std::uint32_t, CalledUnder>& ToolLengths::called() const {
  return known_->called;
}

} // namespace dotek::lint
