#include "lint/IndirectWrites.h"
#include "lint/LengthNumbers.h"
#include "lint/NcProgram.h"

#include <algorithm>
#include <map>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kLastArgument = 26;

// A sum of multiples of variables; the constant is not needed.
using Terms = std::map<std::uint32_t, double>;

void add(Terms& into, const Terms& other, double factor) {
  for (const auto& [number, value] : other)
    if ((into[number] += factor * value) == 0) into.erase(number);
}

class Sums {
public:
  explicit Sums(const ir::Program& program) {
    for (const ir::ProgramStatement& statement : program.body)
      if (const auto* store = std::get_if<ir::Store>(&statement.node))
        if (const auto number = storedNumber(statement)) stores_[*number].push_back(store);
  }

  bool isGiven(std::uint32_t number) const { return number <= kLastArgument && !stores_.contains(number); }

  // With what the program sets once put in; nothing: it is no sum.
  std::optional<Terms> of(const ir::ExpressionPtr& value, int depth = 0) const {
    constexpr int kMostDepth = 8;
    if (!value || depth > kMostDepth) return std::nullopt;
    if (ir::constantValue(value) != nullptr) return Terms{};
    if (const auto number = variableNumber(*value)) {
      const auto stores = stores_.find(*number);
      if (stores == stores_.end()) return Terms{{*number, 1}};
      return stores->second.size() == 1 ? of(stores->second.front()->value, depth + 1) : std::nullopt;
    }
    if (const auto* unary = std::get_if<ir::Unary>(&value->node)) {
      auto out = of(unary->operand, depth + 1);
      if (unary->op == ir::UnaryOp::NullAsZero) return out;
      if (unary->op != ir::UnaryOp::Negate || !out) return std::nullopt;
      Terms negated;
      add(negated, *out, -1);
      return negated;
    }
    const auto* binary = std::get_if<ir::Binary>(&value->node);
    if (binary == nullptr || (binary->op != ir::BinaryOp::Add && binary->op != ir::BinaryOp::Subtract))
      return std::nullopt;
    auto left = of(binary->left, depth + 1);
    const auto right = of(binary->right, depth + 1);
    if (!left || !right) return std::nullopt;
    add(*left, *right, binary->op == ir::BinaryOp::Add ? 1 : -1);
    return left;
  }

private:
  std::map<std::uint32_t, std::vector<const ir::Store*>> stores_;
};

// Where skip moves along Z look for something; an increment to a position of the machine is that position.
std::vector<Terms> targetsOf(const ir::Program& program, const Sums& sums, const LengthNumbers& numbers) {
  std::vector<Terms> out;
  for (const ir::ProgramStatement& statement : program.body) {
    const ir::NcBlock* skip = skipOf(statement);
    if (skip == nullptr) continue;
    for (const ir::Word& word : skip->words) {
      auto target = word.address == 'Z' ? sums.of(word.value) : std::nullopt;
      if (!target) continue;
      std::erase_if(*target, [&](const auto& term) {
        return term.second == -1 &&
               (numbers.machine.contains(term.first) || numbers.positions.contains(term.first));
      });
      out.push_back(std::move(*target));
    }
  }
  return out;
}

// The entry that the statement writes is the wear of a tool, and this is the value.
struct WearWritten {
  const LengthNumbers::Wear* wear = nullptr;
  ir::ExpressionPtr value;
};
std::optional<WearWritten> wearWritten(const ir::ProgramStatement& statement, const LengthNumbers& numbers,
                                       const IndirectWrites& writes) {
  const auto* store = std::get_if<ir::Store>(&statement.node);
  if (store == nullptr) return std::nullopt;
  auto number = storedNumber(statement);
  if (!number)
    if (const auto first = writes.firstNumber(store->number)) number = *first + 1;
  const LengthNumbers::Wear* wear = number ? numbers.wearOf(*number) : nullptr;
  return wear == nullptr ? std::nullopt : std::optional(WearWritten{wear, store->value});
}

void check(const NcProgram& nc, Report& report) {
  if (nc.project.control == nullptr) return; // whether it is the wear depends on it
  const stdlib::SystemVariables& variables = nc.project.control->variables;
  if (!variables.toolWear || !variables.toolGeometry) return;
  const auto& body = nc.program.body;
  if (nc.skips().empty()) return;
  const LengthNumbers numbers(nc.project);
  const Sums sums(nc.program);
  const std::vector<Terms> targets = targetsOf(nc.program, sums, numbers);
  for (const ir::ProgramStatement& statement : body) {
    const auto written = wearWritten(statement, numbers, nc.writes());
    const auto value = written ? sums.of(written->value) : std::nullopt;
    if (!value) continue;
    Terms rest = *value;
    const auto position = std::find_if(rest.begin(), rest.end(), [&](const auto& term) {
      return term.second == 1 && (numbers.machine.contains(term.first) ||
                                  numbers.positions.contains(term.first) || term.first == variables.skip);
    });
    if (position == rest.end()) continue;
    rest.erase(position);
    for (const Terms& target : targets) {
      // The move looks for the tool at the reference and a length that was given: what is over is this
      // length.
      Terms over = target;
      add(over, rest, 1);
      if (rest.empty() || over.size() != 1 || over.begin()->second != 1 ||
          !sums.isGiven(over.begin()->first) || rest.contains(over.begin()->first))
        continue;
      report.at(statement.origin.range(),
                "this is the whole length of the tool, which the skip move looks for at #{} from the same "
                "reference, and it is written into the wear; the control adds the wear to the length in "
                "#[{}+n], and the tool stays too high by that; write #[{}+n], and 0 into the wear, or take "
                "the length that is known off",
                over.begin()->first, written->wear->geometry, written->wear->geometry);
      break;
    }
  }
}

} // namespace

DOTEK_LINT_RULE(length_in_wear){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
