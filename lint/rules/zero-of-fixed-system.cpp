#include "ir/Walk.h"
#include "lint/AfterSkip.h"

#include <map>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kFirstZero = 5221, kLastZero = 5323;
constexpr std::uint32_t kLastLocal = 33;

struct Sum {
  std::uint32_t zero = 0, position = 0; // 0: no term is one
  SourceRange range;                    // of the zero
  void add(const Sum& other) {
    if (zero == 0) {
      zero = other.zero;
      range = other.range;
    }
    if (position == 0) position = other.position;
  }
};

bool isZero(std::uint32_t number) {
  return number >= kFirstZero && number <= kLastZero && (number - kFirstZero) % 20 < 3;
}

// Coordinates that count from the zero in force; #5021 counts from the machine's.
bool isWorkPosition(std::uint32_t number) {
  const bool machine = number >= 5021 && number <= 5023;
  return positionAxis(number).has_value() && !machine;
}

class Search {
public:
  Search(const NcProgram& nc, Report& report) : nc_(nc), report_(report) {}

  void run() {
    if (endsProgram(nc_.program) || choosesSystem()) return;
    for (const ir::ProgramStatement& statement : nc_.program.body)
      step(statement);
  }

private:
  // G54 to G59 or a further one: it knows which zero is in force.
  bool choosesSystem() const {
    for (const ir::ProgramStatement& statement : nc_.program.body) {
      const auto* block = std::get_if<ir::NcBlock>(&statement.node);
      if (block != nullptr && lint::choosesSystem(*block)) return true;
    }
    return false;
  }

  Sum sumOf(const ir::ExpressionPtr& value) const {
    Sum out;
    if (value == nullptr) return out;
    if (const auto* binary = std::get_if<ir::Binary>(&value->node)) {
      out = sumOf(binary->left);
      out.add(sumOf(binary->right));
      return out;
    }
    if (const auto* unary = std::get_if<ir::Unary>(&value->node)) return sumOf(unary->operand);
    const auto number = variableNumber(*value);
    if (!number) return out;
    if (isZero(*number)) out = {*number, 0, value->range};
    if (isWorkPosition(*number)) out.position = *number;
    if (const auto found = sums_.find(*number); found != sums_.end()) out = found->second;
    return out;
  }

  void step(const ir::ProgramStatement& statement) {
    if (const auto* store = std::get_if<ir::Store>(&statement.node)) {
      const auto number = storedNumber(statement);
      if (number && *number <= kLastLocal)
        sums_[*number] = sumOf(store->value);
      else if (!number && ir::firstNumber(store->number).value_or(0) >= kFirstZero - 20)
        judge(statement, sumOf(store->value));
    }
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr || !hasCode(*block, 'G', 10) || wordValue(*block, 'L') != 2.0) return;
    if (!hasWord(*block, 'P') || wordValue(*block, 'P')) return;
    for (const ir::Word& word : block->words)
      if (word.address == 'X' || word.address == 'Y' || word.address == 'Z')
        judge(statement, sumOf(word.value));
  }

  void judge(const ir::ProgramStatement& statement, const Sum& sum) {
    if (sum.zero == 0 || sum.position == 0) return;
    const std::uint32_t system = (sum.zero - kFirstZero) / 20;
    report_
        .at(sum.range.hasPlace() ? sum.range : statement.origin.range(),
            "#{} is the zero of G{}, whichever system is in force, and #{} counts from the one in force; the "
            "offset that is written is that of an argument, so under another system than G{} it gets a wrong "
            "value; take #[{}+20*[#4014-53]], or write G{} before the touch",
            sum.zero, 54 + system, sum.position, 54 + system, 5201 + (sum.zero - kFirstZero) % 20,
            54 + system)
        .note(statement.origin.range(), "the offset is written here");
  }

  const NcProgram& nc_;
  Report& report_;
  std::map<std::uint32_t, Sum> sums_; // of locals
};

void check(const NcProgram& nc, Report& report) {
  Search(nc, report).run();
}

} // namespace

DOTEK_LINT_RULE(zero_of_fixed_system){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
