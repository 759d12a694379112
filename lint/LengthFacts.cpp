#include "lint/LengthFacts.h"

#include "ir/Dataflow.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"

#include <algorithm>

namespace dotek::lint {
namespace {

constexpr std::uint32_t kMostSingle = 64; // variables that are looked at one by one

// `#[100+#9]`: a number and what is added to it.
struct Table {
  double base = 0;
  ir::ExpressionPtr index;
};
std::optional<Table> tableOf(const ir::ExpressionPtr& number) {
  const auto* sum = number ? std::get_if<ir::Binary>(&number->node) : nullptr;
  if (sum == nullptr || sum->op != ir::BinaryOp::Add) return std::nullopt;
  if (const double* base = ir::constantValue(sum->left)) return Table{*base, sum->right};
  if (const double* base = ir::constantValue(sum->right)) return Table{*base, sum->left};
  return std::nullopt;
}

} // namespace

std::vector<Passing> LengthFacts::passings(const std::set<std::uint32_t>& own) {
  std::vector<Passing> out;
  const auto& body = program_.body;
  const auto isOwn = [&](const ir::ProgramStatement& one) {
    const auto called = calledProgram(one);
    return called && own.contains(*called);
  };
  if (std::none_of(body.begin(), body.end(), isOwn) || (!readsPosition() && !getsPosition())) return out;
  const auto facts = factsFrom(entryFact());
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!facts[i] || !isOwn(body[i])) continue;
    Passing one{*calledProgram(body[i]), facts[i]->offset, passedBy(*callOf(body[i]), *facts[i])};
    const auto holds = [](const auto& value) { return value.second.lengths != 0 && value.second.read; };
    if (std::none_of(one.values.begin(), one.values.end(), holds)) continue;
    for (auto& [number, held] : one.values) {
      if (!held.read) continue;
      // What came from another program before is one call too far to be said.
      if (held.read->passed.hasPlace())
        held = unknownHeld();
      else
        held.read->passed = body[i].origin.range();
    }
    out.push_back(std::move(one));
  }
  return out;
}

std::set<std::uint32_t> LengthFacts::stored() const {
  std::set<std::uint32_t> out;
  for (const ir::ProgramStatement& statement : program_.body) {
    const auto* store = std::get_if<ir::Store>(&statement.node);
    if (store == nullptr) continue;
    auto number = storedNumber(statement);
    if (!number) number = nc_.writes().single(store->number);
    const NumberRange all =
        number ? NumberRange{*number, *number}
               : nc_.writes().range(store->number).value_or(NumberRange{1, kFirstSystem - 1});
    for (std::uint32_t one = all.first; one <= std::min(all.last, kFirstSystem - 1); ++one)
      out.insert(one);
  }
  return out;
}

Values LengthFacts::leftBehind(const std::set<std::uint32_t>& stored) const {
  Values out;
  std::optional<Fact> exit;
  if (readsPosition()) {
    const auto& body = program_.body;
    const auto facts = factsFrom(entryFact());
    for (std::size_t i = 0; i < body.size(); ++i) {
      if (!facts[i] || !std::holds_alternative<ir::Exit>(body[i].node)) continue;
      if (exit)
        merge(*exit, *facts[i]);
      else
        exit = facts[i];
    }
  }
  for (const std::uint32_t number : stored) {
    const Held* held = exit ? exit->values.find(number) : nullptr;
    out.emplace_back(number, held == nullptr || held->free() ? unknownHeld() : *held);
  }
  return out;
}

Fact LengthFacts::entryFact() const {
  Fact entry;
  if (called_) entry.offset = called_->offset;
  // A macro that measures tools runs without an offset; one that takes the length off does not.
  if (measuresTool() && !readsLength()) entry.offset = Offset::Off;
  return entry;
}

std::vector<std::optional<Fact>> LengthFacts::factsFrom(const Fact& entry) const {
  const auto& body = program_.body;
  return ir::factsBefore<Fact>(
      body, nc_.flow(), entry,
      [&](std::size_t at, std::size_t, Fact fact) {
        step(body[at], fact);
        return fact;
      },
      [](Fact& into, const Fact& other) { return merge(into, other); });
}

Values LengthFacts::passedBy(const ir::Call& call, const Fact& fact) const {
  Values out;
  const bool locals = call.kind == ir::CallKind::Subprogram;
  fact.values.each([&](std::uint32_t number, const Held& held) {
    if (locals || number > kLastLocal) out.emplace_back(number, held);
  });
  for (const ir::CallArgument& argument : call.arguments)
    if (argument.value != nullptr && argument.local != 0)
      out.emplace_back(argument.local, held(argument.value, fact));
  return out;
}

bool LengthFacts::measuresTool() const {
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

bool LengthFacts::readsPosition() const {
  if (reads(numbers_.positions)) return true;
  // #[5060+#9]
  bool out = false;
  for (const std::size_t at : nc_.computedReads())
    ir::eachNode(program_.body[at], [&](const ir::Expression& one) {
      const auto* variable = std::get_if<ir::MachineVariable>(&one.node);
      const auto first = variable != nullptr ? ir::firstNumber(variable->number) : std::nullopt;
      const auto next = first ? numbers_.positions.lower_bound(*first) : numbers_.positions.end();
      out = out || (next != numbers_.positions.end() && *next <= *first + LengthNumbers::kZ + 1);
    });
  return out;
}

bool LengthFacts::readsLength() const {
  return reads(numbers_.length);
}

bool LengthFacts::getsPosition() const {
  if (left_ == nullptr || left_->empty()) return false;
  return std::any_of(program_.body.begin(), program_.body.end(), [&](const ir::ProgramStatement& one) {
    const auto called = calledProgram(one);
    const auto left = called ? left_->find(*called) : left_->end();
    return left != left_->end() && std::any_of(left->second.begin(), left->second.end(),
                                               [](const auto& value) { return value.second.lengths != 0; });
  });
}

bool LengthFacts::reads(const std::set<std::uint32_t>& numbers) const {
  const auto all = nc_.reads();
  return std::any_of(all.begin(), all.end(),
                     [&](const VariableRead& read) { return numbers.contains(read.number); });
}

bool LengthFacts::isToolOffset(const std::optional<std::uint32_t>& number,
                               const ir::ExpressionPtr& computed) const {
  if (number) return numbers_.isToolOffset(*number);
  const auto first = nc_.writes().firstNumber(computed);
  return first && numbers_.isToolOffset(*first + 1);
}

bool LengthFacts::readsToolOffset(const ir::ExpressionPtr& value, const std::set<std::uint32_t>& kept) const {
  bool out = false;
  ir::eachNode(value, [&](const ir::Expression& one) {
    const auto* variable = std::get_if<ir::MachineVariable>(&one.node);
    if (variable == nullptr) return;
    const auto number = variableNumber(one);
    out = out || isToolOffset(number, variable->number) || (number && kept.contains(*number));
  });
  return out;
}

Held LengthFacts::variable(const ir::Expression& expression, const Fact& fact) const {
  const ir::ExpressionPtr& computed = std::get<ir::MachineVariable>(expression.node).number;
  auto number = variableNumber(expression);
  if (!number) number = nc_.writes().single(computed);
  if (!number) {
    const auto first = nc_.writes().firstNumber(computed);
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
    out.off = off;
    if (off) return out;
    out.lengths = 1;
    if (position) out.read = PositionRead{*number, expression.range};
    if (numbers_.length.contains(*number)) out.length = PositionRead{*number, expression.range};
    return out;
  }
  if (const Held* held = fact.values.find(*number)) return *held;
  if (*number < kFirstSystem) return (fact.lost & kindOf(*number)) != 0 ? unknownHeld() : entryValue(*number);
  out.wear = numbers_.wearOf(*number);
  out.maybeAdded = out.wear == nullptr && numbers_.isToolOffset(*number);
  return out;
}

bool LengthFacts::zeroTable(std::uint32_t first) const {
  return numbers_.zeroes.contains(first) || numbers_.zeroes.contains(first + LengthNumbers::kZ) ||
         numbers_.zeroes.contains(first + 20);
}

Held LengthFacts::held(const ir::ExpressionPtr& value, const Fact& fact) const {
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

void LengthFacts::step(const ir::ProgramStatement& statement, Fact& fact) const {
  if (const auto stated = statedOffset(statement, nc_.otherCodes())) fact.offset = *stated;
  if (const auto* store = std::get_if<ir::Store>(&statement.node)) {
    auto number = storedNumber(statement);
    if (!number) number = nc_.writes().single(store->number);
    if (number) {
      if (*number < kFirstSystem) fact.values.set(*number, held(store->value, fact));
    } else {
      const auto range = nc_.writes().range(store->number);
      const Values copied = range ? copiedBeside(*store, *range, fact) : Values{};
      lose(range, fact);
      for (const auto& [one, held] : copied)
        fact.values.set(one, held);
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
  const auto called = left_ != nullptr ? calledProgram(statement) : std::nullopt;
  const auto left = called ? left_->find(*called) : LeftBehind::const_iterator();
  if (!called || left == left_->end()) return;
  for (const auto& [variable, held] : left->second)
    if (variable > kLastLocal || call->kind == ir::CallKind::Subprogram) fact.values.set(variable, held);
}

Values LengthFacts::copiedBeside(const ir::Store& store, const NumberRange& range, const Fact& fact) const {
  Values out;
  const auto table = tableOf(store.number);
  if (!table || range.first >= kFirstSystem || range.last - range.first >= kMostSingle) return out;
  for (std::uint32_t number = range.first; number <= std::min(range.last, kFirstSystem - 1); ++number) {
    bool beside = false;
    const auto value = ir::rewrite(store.value, [&](const ir::ExpressionPtr& one) -> ir::ExpressionPtr {
      const auto* variable = std::get_if<ir::MachineVariable>(&one->node);
      const auto other = variable != nullptr ? tableOf(variable->number) : std::nullopt;
      if (!other || !ir::equal(other->index, table->index)) return one;
      beside = true;
      return ir::machineVariable(ir::constant(other->base + number - table->base), one->range);
    });
    if (!beside) return out;
    const Held one = held(value, fact);
    if (one.unknown || one.lengths == 0) continue;
    const Held* before = fact.values.find(number); // it may be set in another round
    out.emplace_back(number, merged(before != nullptr ? *before : entryValue(number), one));
  }
  return out;
}

void LengthFacts::lose(const std::optional<NumberRange>& range, Fact& fact) {
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

} // namespace dotek::lint
