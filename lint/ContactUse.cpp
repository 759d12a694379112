#include "lint/ContactUse.h"

#include "ir/Extremes.h"
#include "ir/Walk.h"
#include "lint/AfterSkip.h"
#include "lint/AskedVariables.h"

#include <algorithm>
#include <map>
#include <vector>

namespace dotek::lint {
namespace {

constexpr std::uint32_t kFirstCommon = 100;
constexpr std::uint32_t kFirstSystem = 1000;
constexpr std::uint32_t kPosition = 5001; // #5021 and #5041 are followed as this one
constexpr std::uint32_t kContact = 5061;
constexpr std::uint32_t kAxes = 3;

// Numbers of variables whose values come from the contact, ascending.
using Numbers = std::vector<std::uint32_t>;

bool has(const Numbers& numbers, std::uint32_t one) {
  return std::binary_search(numbers.begin(), numbers.end(), one);
}

void put(Numbers& numbers, std::uint32_t one, bool in) {
  const auto at = std::lower_bound(numbers.begin(), numbers.end(), one);
  const bool there = at != numbers.end() && *at == one;
  if (in && !there) numbers.insert(at, one);
  if (!in && there) numbers.erase(at);
}

bool addAll(Numbers& into, const Numbers& other) {
  Numbers both;
  std::set_union(into.begin(), into.end(), other.begin(), other.end(), std::back_inserter(both));
  const bool grows = both.size() != into.size();
  into = std::move(both);
  return grows;
}

std::uint32_t plainNumber(std::uint32_t number) {
  for (const std::uint32_t first : {5021U, 5041U})
    if (number >= first && number < first + kAxes) return kPosition + number - first;
  return number;
}

bool anyRead(const ir::ExpressionPtr& tree, const Numbers& numbers) {
  bool out = false;
  ir::eachNode(tree, [&](const ir::Expression& node) {
    if (out || !std::holds_alternative<ir::MachineVariable>(node.node)) return;
    const auto number = variableNumber(node);
    out = number && has(numbers, plainNumber(*number));
  });
  return out;
}

class Walk {
public:
  Walk(const NcProgram& nc, std::size_t skip) : nc_(nc), skip_(skip) {}

  std::optional<ContactUse> run(std::size_t& steps) {
    const auto& body = nc_.program.body;
    Numbers start;
    for (std::uint32_t axis = 0; axis < kAxes; ++axis)
      if ((axesOf(*skipOf(body[skip_])) & 1U << axis) != 0) {
        put(start, kContact + axis, true);
        put(start, kPosition + axis, true);
      }
    leave(skip_, start);
    while (!open_.empty() && !use_.asked) {
      if (steps == 0) return std::nullopt;
      --steps;
      const std::size_t at = *open_.begin();
      open_.erase(open_.begin());
      if (ir::isComputedJump(body[at])) return std::nullopt;
      Numbers numbers = before_.at(at);
      look(at, numbers);
      step(at, numbers);
      leave(at, numbers);
    }
    use_.leadsOn = leadsOn();
    return use_;
  }

private:
  bool reads(std::size_t at, const Numbers& numbers) const {
    const auto all = nc_.reads(at);
    return std::any_of(all.begin(), all.end(),
                       [&](const VariableRead& read) { return has(numbers, plainNumber(read.number)); });
  }

  void look(std::size_t at, const Numbers& numbers) {
    const ir::ProgramStatement& statement = nc_.program.body[at];
    const ir::Call* call = callOf(statement);
    const ir::ConditionPtr* condition = ir::conditionOf(statement);
    const bool asks =
        call != nullptr || (condition != nullptr && *condition && !ir::keepsExtreme(nc_.program.body, at));
    use_.asked = use_.asked || (asks && reads(at, numbers));
    if (call != nullptr && call->kind == ir::CallKind::Subprogram) // it has the same locals
      for (const std::uint32_t one : numbers)
        use_.asked = use_.asked || (one < kFirstCommon && askersOf(nc_.project).othersAsk(nc_.program, one));
  }

  void step(std::size_t at, Numbers& numbers) {
    const ir::ProgramStatement& statement = nc_.program.body[at];
    if (const auto* block = std::get_if<ir::NcBlock>(&statement.node)) {
      const bool uses = reads(at, numbers);
      if (hasCode(*block, 'G', 10)) sunk_ = sunk_ || uses;
      if (moves(*block)) move(at, *block, numbers);
      if (uses)
        for (const VariableRead& read : nc_.reads(at))
          movedBy_.insert(read.number);
      return;
    }
    if (std::holds_alternative<ir::Print>(statement.node)) sunk_ = sunk_ || reads(at, numbers);
    const auto* store = std::get_if<ir::Store>(&statement.node);
    if (store == nullptr) return;
    const bool from = anyRead(store->value, numbers);
    const auto into = storedNumber(statement);
    if (!into || *into >= kFirstSystem) {
      sunk_ = sunk_ || from;
      return;
    }
    if (readsContact(store->value)) {
      if (from)
        taken_.insert(*into);
      else if (at > skip_ && has(numbers, *into))
        overwritten_.insert(*into);
    } else if (from && *into >= kFirstCommon) {
      results_.insert(*into);
    }
    if (from) use_.held.insert(*into);
    put(numbers, *into, from);
  }

  static bool readsContact(const ir::ExpressionPtr& value) {
    bool out = false;
    ir::eachNode(value, [&](const ir::Expression& node) {
      const auto number = variableNumber(node);
      out = out || (number && contactAxis(*number));
    });
    return out;
  }

  bool leadsOn() const {
    const auto all = [](const std::set<std::uint32_t>& some, const std::set<std::uint32_t>& of) {
      return std::includes(of.begin(), of.end(), some.begin(), some.end());
    };
    return !sunk_ && !taken_.empty() && all(taken_, overwritten_) && all(results_, movedBy_);
  }

  // Where it goes, and for a G31 where it stops, comes from the contact if its target does.
  void move(std::size_t at, const ir::NcBlock& block, Numbers& numbers) const {
    const bool isSkip = skipOf(nc_.program.body[at]) != nullptr;
    const DistanceMode before = nc_.modes()[at].value_or(DistanceMode::Unknown);
    const DistanceMode mode = statedMode(nc_.program.body[at]).value_or(before);
    const bool absolute = mode == DistanceMode::Absolute || mode == DistanceMode::AsBefore;
    for (std::uint32_t axis = 0; axis < kAxes; ++axis) {
      const auto word = std::find_if(block.words.begin(), block.words.end(), [&](const ir::Word& one) {
        return one.address == static_cast<char>('X' + axis);
      });
      bool from = has(numbers, kPosition + axis);
      if (word != block.words.end())
        from = anyRead(word->value, numbers) || (from && !absolute) || at == skip_;
      put(numbers, kPosition + axis, from);
      if (isSkip) put(numbers, kContact + axis, from && word != block.words.end());
    }
  }

  void leave(std::size_t at, const Numbers& numbers) {
    for (const std::size_t to : nc_.flow().next[at]) {
      const bool ends = to >= nc_.program.body.size();
      Numbers arriving = numbers;
      if (ends)
        std::erase_if(arriving, [](std::uint32_t one) { return one < kFirstCommon || one >= kFirstSystem; });
      const std::size_t place = ends ? 0 : to;
      if (arriving.empty()) continue;
      const auto [known, isNew] = before_.try_emplace(place);
      if (addAll(known->second, arriving) || isNew) open_.insert(place);
    }
  }

  const NcProgram& nc_;
  std::size_t skip_;
  ContactUse use_;
  std::set<std::uint32_t> taken_, overwritten_; // hold the contact; that of a later G31 instead
  std::set<std::uint32_t> results_, movedBy_;   // commons computed from it; variables in its moves
  bool sunk_ = false;                           // it is in an offset, or printed
  std::map<std::size_t, Numbers> before_;
  std::set<std::size_t> open_;
};

} // namespace

std::optional<ContactUse> contactUse(const NcProgram& nc, std::size_t skip, std::size_t& steps) {
  return Walk(nc, skip).run(steps);
}

} // namespace dotek::lint
