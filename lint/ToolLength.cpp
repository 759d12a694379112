#include "lint/ToolLength.h"

#include "ir/Match.h"
#include "ir/SharedMap.h"
#include "ir/Walk.h"
#include "lint/IndirectWrites.h"
#include "lint/LengthNumbers.h"
#include "lint/OffsetStates.h"
#include "lint/Skips.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace dotek::lint {
namespace {

constexpr std::uint32_t kLastLocal = 33;
constexpr std::uint32_t kFirstSystem = 1000;

struct Read {
  std::uint32_t number = 0;
  SourceRange range;
};

// What a value holds of the length of the tool.
struct Held {
  double lengths = 0;
  bool unknown = false;
  bool maybeAdded = false, maybeTaken = false; // a value that may be the length is a term, with + or with -
  std::optional<Read> read;                    // where the length comes from
  std::optional<Read> length;                  // #5083 itself is a term
  const LengthNumbers::Wear* wear = nullptr;   // the wear of a tool is a term

  bool none() const { return lengths == 0 && !unknown; }
  bool free() const { return maybeAdded || maybeTaken; }
  bool operator==(const Held& other) const {
    return lengths == other.lengths && unknown == other.unknown && maybeAdded == other.maybeAdded &&
           maybeTaken == other.maybeTaken && wear == other.wear &&
           read.has_value() == other.read.has_value() && length.has_value() == other.length.has_value();
  }
};

Held unknownHeld() {
  Held out;
  out.unknown = true;
  return out;
}

Held sum(const Held& a, const Held& b, bool subtract) {
  Held out;
  out.lengths = a.lengths + (subtract ? -b.lengths : b.lengths);
  out.unknown = a.unknown || b.unknown;
  out.maybeAdded = a.maybeAdded || (subtract ? b.maybeTaken : b.maybeAdded);
  out.maybeTaken = a.maybeTaken || (subtract ? b.maybeAdded : b.maybeTaken);
  out.read = a.read ? a.read : b.read;
  out.length = a.length ? a.length : b.length;
  out.wear = a.wear != nullptr ? a.wear : b.wear;
  return out;
}

Held times(const Held& a, double factor) {
  Held out = a;
  out.lengths = a.lengths * factor;
  if (factor < 0) std::swap(out.maybeAdded, out.maybeTaken);
  return out;
}

// Of a value that neither a sum nor a multiple is.
Held mixed(const Held& a, const Held& b) {
  if (!a.none() || !b.none()) return unknownHeld();
  Held out;
  out.maybeAdded = a.free() || b.free();
  out.wear = a.wear != nullptr ? a.wear : b.wear;
  return out;
}

struct Fact {
  ir::SharedMap<Held> values; // of variables that the program has set
  // A computed number may have set any of the locals, of the common variables below #500, of those from
  // there.
  std::uint8_t lost = 0;
  Offset offset = Offset::AsBefore;
};

// An argument is no length of a tool; what is left in a common variable may be.
Held entryValue(std::uint32_t number) {
  Held out;
  out.maybeAdded = number > kLastLocal;
  return out;
}

Held merged(Held into, const Held& other) {
  if (into.lengths != other.lengths) into.unknown = true;
  if (into.unknown) into.lengths = 0;
  into.unknown = into.unknown || other.unknown;
  into.maybeAdded = into.maybeAdded || other.maybeAdded;
  into.maybeTaken = into.maybeTaken || other.maybeTaken;
  if (!into.read) into.read = other.read;
  if (!into.length) into.length = other.length;
  if (into.wear == nullptr) into.wear = other.wear;
  return into;
}

bool merge(Fact& into, const Fact& other) {
  // A variable that only one of the two has set is what it was at the entry for the other.
  bool changed = into.values.unite(other.values, merged, [](std::uint32_t number, const Held& held) {
    return merged(held, entryValue(number));
  });
  if ((other.lost & ~into.lost) != 0) {
    into.lost = static_cast<std::uint8_t>(into.lost | other.lost);
    changed = true;
  }
  if (into.offset != other.offset && into.offset != Offset::Either) {
    into.offset = Offset::Either;
    changed = true;
  }
  return changed;
}

std::uint8_t kindOf(std::uint32_t number) {
  return number < 100 ? 1 : number < 500 ? 2 : 4;
}
constexpr std::uint8_t kEachKind = 7;

constexpr double kMostTolerance = 10; // mm; more is no tolerance of a contact

class Search {
public:
  Search(const ir::Program& program, const Project& project, const LengthNumbers& numbers,
         const std::set<std::uint32_t>& switching, std::optional<CalledUnder> called)
      : program_(program), project_(project), numbers_(numbers), switching_(switching), called_(called),
        macro_(!endsProgram(program)), writes_(program) {}

  std::vector<LengthLeftIn> run() {
    if (!readsPosition() && !readsLength()) return {};
    Fact entry;
    if (called_) entry.offset = called_->offset;
    // A macro that measures tools runs without an offset; one that takes the length off does not.
    if (measuresTool() && !readsLength()) entry.offset = Offset::Off;
    const auto& body = program_.body;
    const auto facts = ir::factsBefore<Fact>(
        body, entry,
        [&](std::size_t at, std::size_t, Fact fact) {
          step(body[at], fact);
          return fact;
        },
        [](Fact& into, const Fact& other) { return merge(into, other); });
    for (std::size_t i = 0; i < body.size(); ++i)
      if (facts[i]) noteHeights(body[i], *facts[i]);
    const auto modes = distanceModes(body, ir::flowOf(body));
    for (std::size_t i = 0; i < body.size(); ++i) {
      if (!facts[i]) continue;
      absolute_ = modes[i] && statedMode(body[i]).value_or(*modes[i]) == DistanceMode::Absolute;
      judge(body[i], *facts[i]);
    }
    return std::move(found_);
  }

  // An entry of the table of tools gets a new value: the length of a tool that has none in force. What is
  // added to the old one corrects it, by a contact under an offset as any other.
  bool measuresTool() const {
    std::set<std::uint32_t> kept;
    for (const ir::ProgramStatement& statement : program_.body) {
      if (const auto* store = std::get_if<ir::Store>(&statement.node)) {
        const auto number = storedNumber(statement);
        const bool old = readsToolOffset(store->value, kept);
        if (isToolOffset(number, store->number)) {
          if (!old) return true;
        } else if (number && old)
          kept.insert(*number);
      }
      const auto* block = std::get_if<ir::NcBlock>(&statement.node);
      if (block == nullptr || !hasCode(*block, 'G', 10)) continue;
      const auto l = wordValue(*block, 'L');
      const bool geometry = l && (*l == 10 || *l == 12); // G10 L11, L13: the wear, which a part shows
      if (!geometry || hasCode(*block, 'G', 91)) continue;
      const bool adds = std::any_of(block->words.begin(), block->words.end(), [&](const ir::Word& word) {
        return word.address == 'R' && word.value != nullptr && readsToolOffset(word.value, kept);
      });
      if (!adds) return true;
    }
    return false;
  }

private:
  bool readsPosition() const { return reads(numbers_.positions); }
  bool readsLength() const { return reads(numbers_.length); }

  bool reads(const std::set<std::uint32_t>& numbers) const {
    for (const ir::ProgramStatement& statement : program_.body) {
      bool found = false;
      eachRead(statement,
               [&](std::uint32_t number, SourceRange) { found = found || numbers.contains(number); });
      if (found) return true;
    }
    return false;
  }

  bool isToolOffset(const std::optional<std::uint32_t>& number, const ir::ExpressionPtr& computed) const {
    if (number) return numbers_.isToolOffset(*number);
    const auto first = ir::firstNumber(computed);
    return first && numbers_.isToolOffset(*first + 1);
  }

  // It reads an entry of the table of tools, or a variable that one was kept in.
  bool readsToolOffset(const ir::ExpressionPtr& value, const std::set<std::uint32_t>& kept) const {
    bool out = false;
    ir::eachNode(value, [&](const ir::Expression& one) {
      const auto* variable = std::get_if<ir::MachineVariable>(&one.node);
      if (variable == nullptr) return;
      const auto number = variableNumber(one);
      out = out || isToolOffset(number, variable->number) || (number && kept.contains(*number));
    });
    return out;
  }

  Held variable(const ir::Expression& expression, const Fact& fact) const {
    const ir::ExpressionPtr& computed = std::get<ir::MachineVariable>(expression.node).number;
    const auto number = variableNumber(expression);
    if (!number) {
      const auto first = ir::firstNumber(computed);
      Held out; // a zero point of a work system holds none
      // #[2000+n]: n is the number of an offset.
      out.wear = first ? numbers_.wearOf(*first + 1) : nullptr;
      out.maybeAdded = out.wear == nullptr && (!first || !zeroTable(*first));
      return out;
    }
    const bool off = fact.offset == Offset::Off;
    const bool position = numbers_.positions.contains(*number);
    Held out;
    if (position || numbers_.machine.contains(*number) || numbers_.length.contains(*number)) {
      if (off) return out;
      out.lengths = 1;
      if (position) out.read = Read{*number, expression.range};
      if (numbers_.length.contains(*number)) out.length = Read{*number, expression.range};
      return out;
    }
    if (const Held* held = fact.values.find(*number)) return *held;
    if (*number < kFirstSystem)
      return (fact.lost & kindOf(*number)) != 0 ? unknownHeld() : entryValue(*number);
    out.wear = numbers_.wearOf(*number);
    out.maybeAdded = out.wear == nullptr && numbers_.isToolOffset(*number);
    return out;
  }

  // The first variable of a table of zero points: #[5203+..].
  bool zeroTable(std::uint32_t first) const {
    return numbers_.zeroes.contains(first) || numbers_.zeroes.contains(first + LengthNumbers::kZ) ||
           numbers_.zeroes.contains(first + 20);
  }

  Held held(const ir::ExpressionPtr& value, const Fact& fact) const {
    if (const auto* unary = std::get_if<ir::Unary>(&value->node)) {
      const Held operand = held(unary->operand, fact);
      switch (unary->op) {
      case ir::UnaryOp::Negate: return times(operand, -1);
      case ir::UnaryOp::NullAsZero:
      case ir::UnaryOp::Round:
      case ir::UnaryOp::RoundIncrement:
      case ir::UnaryOp::AddPoint: return operand;
      case ir::UnaryOp::Absolute:
      case ir::UnaryOp::Truncate:
      case ir::UnaryOp::RoundUp:
      case ir::UnaryOp::SquareRoot:
      case ir::UnaryOp::Sine:
      case ir::UnaryOp::Cosine:
      case ir::UnaryOp::Tangent:
      case ir::UnaryOp::ArcSine:
      case ir::UnaryOp::ArcCosine:
      case ir::UnaryOp::ArcTangent:
      case ir::UnaryOp::Logarithm:
      case ir::UnaryOp::Exponential:
      case ir::UnaryOp::FromBcd:
      case ir::UnaryOp::ToBcd: return mixed(operand, {});
      }
      return mixed(operand, {});
    }
    if (const auto* binary = std::get_if<ir::Binary>(&value->node)) {
      const Held left = held(binary->left, fact);
      const Held right = held(binary->right, fact);
      const double* factor = ir::constantValue(binary->right);
      switch (binary->op) {
      case ir::BinaryOp::Add: return sum(left, right, false);
      case ir::BinaryOp::Subtract: return sum(left, right, true);
      case ir::BinaryOp::Divide:
        return factor != nullptr && *factor != 0 ? times(left, 1 / *factor) : mixed(left, right);
      case ir::BinaryOp::Multiply:
        if (factor != nullptr) return times(left, *factor);
        factor = ir::constantValue(binary->left);
        return factor != nullptr ? times(right, *factor) : mixed(left, right);
      case ir::BinaryOp::Modulo:
      case ir::BinaryOp::Direction:
      case ir::BinaryOp::BitAnd:
      case ir::BinaryOp::BitOr:
      case ir::BinaryOp::BitXor:
      case ir::BinaryOp::ValueOr:
      case ir::BinaryOp::RoundedAnd:
      case ir::BinaryOp::RoundedOr:
      case ir::BinaryOp::RoundedXor:
      case ir::BinaryOp::RoundedModulo:
      case ir::BinaryOp::Power:
      case ir::BinaryOp::Bearing: return mixed(left, right);
      }
      return mixed(left, right);
    }
    if (std::holds_alternative<ir::MachineVariable>(value->node)) return variable(*value, fact);
    return {};
  }

  void step(const ir::ProgramStatement& statement, Fact& fact) const {
    if (const auto stated = statedOffset(statement)) fact.offset = *stated;
    if (const auto* store = std::get_if<ir::Store>(&statement.node)) {
      if (const auto number = storedNumber(statement)) {
        if (*number < kFirstSystem) fact.values.set(*number, held(store->value, fact));
      } else {
        lose(writes_.range(store->number), fact);
      }
    }
    const ir::Call* call = callOf(statement);
    if (call == nullptr) return;
    if (call->kind == ir::CallKind::Subprogram) // shares the locals
      for (std::uint32_t local = 1; local <= kLastLocal; ++local)
        if (fact.values.find(local) != nullptr) fact.values.set(local, unknownHeld());
    const double* number = call->program ? ir::constantValue(call->program) : nullptr;
    if (number != nullptr && *number >= 0 && *number < 1e9 &&
        switching_.contains(static_cast<std::uint32_t>(*number)))
      fact.offset = Offset::Either;
  }

  // What is written by a computed number may have set any variable of the range.
  static void lose(const std::optional<NumberRange>& range, Fact& fact) {
    constexpr std::uint32_t kMostSingle = 64;
    const NumberRange all = range.value_or(NumberRange{1, kFirstSystem - 1});
    if (all.first >= kFirstSystem) return;
    const std::uint32_t last = std::min(all.last, kFirstSystem - 1);
    if (last - all.first < kMostSingle) {
      for (std::uint32_t number = all.first; number <= last; ++number)
        fact.values.set(number, unknownHeld());
      return;
    }
    const bool each = all.first < 100 && last >= 500;
    fact.lost =
        static_cast<std::uint8_t>(fact.lost | kindOf(all.first) | kindOf(last) | (each ? kEachKind : 0));
    fact.values.transform(
        [&](std::uint32_t number, const Held& held) { return all.contains(number) ? unknownHeld() : held; });
  }

  void report(LengthLeftIn::Place place, SourceRange range, const ir::ExpressionPtr& value,
              const Fact& fact) {
    const Held one = held(value, fact);
    if (one.unknown || one.lengths == 0 || fact.offset == Offset::Off) return;
    if (one.lengths > 0 ? one.maybeTaken : one.maybeAdded) return;
    // The length taken off a coordinate that never held it.
    const bool taken = !one.read && one.length && one.lengths < 0 && place == LengthLeftIn::Place::Move;
    if (!one.read && !(taken && absolute_)) return;
    const Read& read = taken ? *one.length : *one.read;
    const std::uint32_t length = numbers_.length.empty() ? 0 : *numbers_.length.begin();
    LengthLeftIn found{place, range, value->range, one.lengths, read.number, read.range, length};
    found.taken = taken;
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
      if (binary != nullptr && binary->op == ir::BinaryOp::Subtract)
        judgePair(binary->left, binary->right, fact);
    });
    if (const ir::ConditionPtr* condition = ir::conditionOf(statement); condition != nullptr && *condition)
      judgeCondition(*condition, fact);
  }

  void judge(const ir::ProgramStatement& statement, Fact fact) {
    if (const auto stated = statedOffset(statement)) fact.offset = *stated;
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
    const bool offset = hasCode(block, 'G', 10) && isZeroInput(block) && maySetZero(fact);
    if (!offset && !isPlainMove(block) && (skipOf(statement) == nullptr || hasCode(block, 'G', 53))) return;
    for (const ir::Word& word : block.words)
      if (word.address == 'Z')
        report(offset ? LengthLeftIn::Place::WorkOffset : LengthLeftIn::Place::Move, word.range, word.value,
               fact);
  }

  // A write of a variable that is the Z of a zero.
  void judgeStore(const ir::ProgramStatement& statement, const ir::Store& store, const Fact& fact) {
    const auto number = storedNumber(statement);
    const auto first = number ? number : ir::firstNumber(store.number);
    const bool zero =
        first && (number ? numbers_.zeroes.contains(*first)
                         : numbers_.zeroes.contains(*first) || numbers_.zeroes.contains(*first + 20));
    if (zero) report(LengthLeftIn::Place::WorkOffset, statement.origin.range(), store.value, fact);
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

  const ir::Program& program_;
  const Project& project_;
  const LengthNumbers& numbers_;
  const std::set<std::uint32_t>& switching_;
  std::optional<CalledUnder> called_; // by programs of the files
  bool macro_;                        // it returns: what is in force is its caller's
  IndirectWrites writes_;
  bool absolute_ = false;           // G90 is in force at the statement that is judged
  std::vector<double> targets_;     // of absolute skip moves along Z
  std::set<std::uint32_t> heights_; // variables of which absolute Z words are computed
  std::vector<LengthLeftIn> found_;
};

} // namespace

struct ToolLengths::Known {
  explicit Known(const Project& project)
      : numbers(project), switching(switchingPrograms(project)), called(calledUnder(project, switching)) {}

  LengthNumbers numbers;
  std::set<std::uint32_t> switching;
  std::map<std::uint32_t, CalledUnder> called;
};

ToolLengths::ToolLengths(const Project& project)
    : project_(project), known_(std::make_unique<const Known>(project)) {}

ToolLengths::~ToolLengths() = default;

std::vector<LengthLeftIn> ToolLengths::leftIn(const ir::Program& program) const {
  const auto called = known_->called.find(static_cast<std::uint32_t>(program.number));
  return Search(program, project_, known_->numbers, known_->switching,
                called == known_->called.end() ? std::nullopt : std::optional(called->second))
      .run();
}

bool ToolLengths::measuresTool(const ir::Program& program) const {
  return Search(program, project_, known_->numbers, known_->switching, std::nullopt).measuresTool();
}

const std::set<std::uint32_t>& ToolLengths::switching() const {
  return known_->switching;
}

const std::map<std::uint32_t, CalledUnder>& ToolLengths::called() const {
  return known_->called;
}

} // namespace dotek::lint
