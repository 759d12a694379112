#include "ir/Walk.h"
#include "lint/NcProgram.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kFirstCommon = 100;
constexpr std::uint32_t kLastCommon = 999;

bool isCommon(std::uint32_t number) {
  return number >= kFirstCommon && number <= kLastCommon;
}

// Codes in force and positions of the machine: a number alone that is one of these was to be read.
bool isSystem(double number) {
  return (number > 4000 && number <= 4130) || (number > 5000 && number <= 5083);
}

// Numbers of one statement that may be those of variables.
struct Statement {
  std::vector<const ir::Expression*> indices;                           // numbers of variables
  std::vector<std::pair<const ir::Expression*, std::uint32_t>> numbers; // whole, of common variables

  void look(const ir::ProgramStatement& statement) {
    indices.clear();
    numbers.clear();
    ir::eachNode(statement, [&](const ir::Expression& node) {
      if (const auto* variable = std::get_if<ir::MachineVariable>(&node.node)) {
        indices.push_back(variable->number.get());
      } else if (const auto* constant = std::get_if<ir::Constant>(&node.node)) {
        if (constant->value >= kFirstCommon && constant->value <= kLastCommon &&
            constant->value == std::floor(constant->value) && constant->digits.find('.') == std::string::npos)
          numbers.emplace_back(&node, static_cast<std::uint32_t>(constant->value));
      }
    });
  }

  bool isIndex(const ir::Expression* node) const {
    return std::find(indices.begin(), indices.end(), node) != indices.end();
  }
};

// Variables by whose value another one is chosen: `#7=5063`, and `#[#7]` later, means the number.
std::set<std::uint32_t> counters(const NcProgram& nc) {
  std::set<std::uint32_t> out;
  for (const std::size_t at : nc.computedReads())
    ir::eachNode(nc.program.body[at], [&](const ir::Expression& node) {
      const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
      if (variable == nullptr || ir::constantValue(variable->number) != nullptr) return;
      ir::eachNode(variable->number, [&](const ir::Expression& inner) {
        if (!std::holds_alternative<ir::MachineVariable>(inner.node)) return;
        if (const auto number = variableNumber(inner)) out.insert(*number);
      });
    });
  return out;
}

// #500=500+#1, and #[150+141]: the number itself is where its variable belongs.
bool isLost(const ir::Store& store, const std::optional<std::uint32_t>& target, const Statement& seen) {
  // `#[158+1]` counts on from a base.
  const auto* sum = std::get_if<ir::Binary>(&store.number->node);
  const double* base = sum == nullptr ? nullptr : ir::constantValue(sum->left);
  const double* step = sum == nullptr ? nullptr : ir::constantValue(sum->right);
  if (base != nullptr && step != nullptr && *base >= kFirstCommon && *step >= kFirstCommon) return true;
  if (!target || *target < kFirstCommon || !std::holds_alternative<ir::Binary>(store.value->node))
    return false;
  bool out = false;
  ir::eachNode(store.value, [&](const ir::Expression& node) {
    const auto* constant = std::get_if<ir::Constant>(&node.node);
    out = out || (constant != nullptr && constant->value == *target &&
                  constant->digits.find('.') == std::string::npos && !seen.isIndex(&node));
  });
  return out;
}

void check(const Project& project, Report& report) {
  // Of a program: what it sets, and numbers without a point in calculations.
  struct Numbers {
    std::map<std::uint32_t, SourceRange> stored, used;
  };
  std::vector<Numbers> programs;
  std::vector<bool> read(kLastCommon + 1); // in any
  Statement seen;
  for (const auto& nc : programsOf(project)) {
    Numbers& mine = programs.emplace_back();
    const std::set<std::uint32_t> counts = counters(*nc);
    for (const VariableRead& one : nc->reads())
      if (isCommon(one.number)) read[one.number] = true;
    for (const ir::ProgramStatement& statement : nc->program.body) {
      // Words may be any numbers.
      if (std::holds_alternative<ir::NcBlock>(statement.node) || callOf(statement) != nullptr ||
          std::holds_alternative<ir::Raise>(statement.node))
        continue;
      const auto target = storedNumber(statement);
      if (target && isCommon(*target)) mine.stored.emplace(*target, statement.origin.range());
      seen.look(statement);
      const auto* store = std::get_if<ir::Store>(&statement.node);
      const auto* whole = store == nullptr ? nullptr : std::get_if<ir::Constant>(&store->value->node);
      if (whole != nullptr && !(target && counts.contains(*target)) && isSystem(whole->value) &&
          whole->digits.find('.') == std::string::npos)
        report.at(store->value->range.hasPlace() ? store->value->range : statement.origin.range(),
                  "{0} is a number here, and #{0} is a state of the control; write `#{0}` if that is meant",
                  whole->digits);
      if (store != nullptr && isLost(*store, target, seen))
        report.at(statement.origin.range(),
                  "a number is here where its variable belongs; the control calculates "
                  "with the number; write the `#` before it");
      if (seen.numbers.empty()) continue;
      std::set<const ir::Expression*> inNumber; // of the number of the variable that is set
      if (store != nullptr)
        ir::eachNode(store->number, [&](const ir::Expression& node) { inNumber.insert(&node); });
      for (const auto& [node, number] : seen.numbers)
        if (!seen.isIndex(node) && !inNumber.contains(node))
          mine.used.emplace(number, node->range.hasPlace() ? node->range : statement.origin.range());
    }
  }
  for (const Numbers& one : programs)
    for (const auto& [number, range] : one.used) {
      const auto at = one.stored.find(number);
      if (at == one.stored.end() || read[number]) continue;
      report
          .at(range,
              "{0} is a number here, and #{0} is set and read nowhere; the control calculates with {0}; "
              "write "
              "`#{0}` if the variable is meant",
              number)
          .note(at->second, fmt::format("#{} is set here", number));
    }
}

} // namespace

DOTEK_LINT_RULE(number_of_unread_variable){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
