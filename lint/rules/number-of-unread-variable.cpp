#include "ir/Walk.h"
#include "lint/Skips.h"

#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace dotek::lint::rule {
namespace {

constexpr double kFirstCommon = 100;
constexpr double kLastCommon = 999;

// Codes in force and positions of the machine: a number alone that is one of these was to be read.
bool isSystem(double number) {
  return (number > 4000 && number <= 4130) || (number > 5000 && number <= 5083);
}

void check(const Project& project, Report& report) {
  // Of a program: what it sets, and numbers without a point in calculations.
  struct Numbers {
    std::map<std::uint32_t, SourceRange> stored, used;
  };
  std::vector<Numbers> programs;
  std::set<std::uint32_t> read; // in any
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    Numbers& mine = programs.emplace_back();
    // `#7=5063`, and `#[#7]` later: the number is meant.
    std::set<std::uint32_t> counts;
    for (const ir::ProgramStatement& statement : program.body)
      ir::eachNode(statement, [&](const ir::Expression& node) {
        const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
        if (variable == nullptr) return;
        ir::eachNode(variable->number, [&](const ir::Expression& inner) {
          if (!std::holds_alternative<ir::MachineVariable>(inner.node)) return;
          if (const auto number = variableNumber(inner)) counts.insert(*number);
        });
      });
    for (const ir::ProgramStatement& statement : program.body) {
      if (const auto number = storedNumber(statement)) mine.stored.emplace(*number, statement.origin.range());
      eachRead(statement, [&](std::uint32_t number, SourceRange) { read.insert(number); });
      std::set<const ir::Expression*> indices; // numbers of variables
      ir::eachNode(statement, [&](const ir::Expression& node) {
        if (const auto* variable = std::get_if<ir::MachineVariable>(&node.node))
          indices.insert(variable->number.get());
      });
      const bool words = std::holds_alternative<ir::NcBlock>(statement.node) ||
                         callOf(statement) != nullptr || std::holds_alternative<ir::Raise>(statement.node);
      const auto* store = std::get_if<ir::Store>(&statement.node);
      const auto* whole = store == nullptr ? nullptr : std::get_if<ir::Constant>(&store->value->node);
      const auto target = storedNumber(statement);
      if (whole != nullptr && !(target && counts.contains(*target)) && isSystem(whole->value) &&
          whole->digits.find('.') == std::string::npos)
        report.at(store->value->range.hasPlace() ? store->value->range : statement.origin.range(),
                  "{0} is a number here, and #{0} is a state of the control; write `#{0}` if that is meant",
                  whole->digits);
      // #500=500+#1, and #[150+141]: the number itself is where its variable belongs.
      bool lost = false;
      if (store != nullptr && target && std::holds_alternative<ir::Binary>(store->value->node))
        ir::eachNode(store->value, [&](const ir::Expression& node) {
          const auto* constant = std::get_if<ir::Constant>(&node.node);
          lost = lost || (constant != nullptr && constant->value == *target && *target >= kFirstCommon &&
                          constant->digits.find('.') == std::string::npos && !indices.contains(&node));
        });
      const auto* sum = store == nullptr ? nullptr : std::get_if<ir::Binary>(&store->number->node);
      // `#[158+1]` counts on from a base.
      const double* base = sum == nullptr ? nullptr : ir::constantValue(sum->left);
      const double* step = sum == nullptr ? nullptr : ir::constantValue(sum->right);
      lost = lost || (base != nullptr && step != nullptr && *base >= kFirstCommon && *step >= kFirstCommon);
      if (lost)
        report.at(statement.origin.range(),
                  "a number is here where its variable belongs; the control calculates "
                  "with the number; write the `#` before it");
      if (words) continue;
      std::set<const ir::Expression*> inNumber; // of the number of the variable that is set
      if (store != nullptr)
        ir::eachNode(store->number, [&](const ir::Expression& node) { inNumber.insert(&node); });
      ir::eachNode(statement, [&](const ir::Expression& node) {
        const auto* constant = std::get_if<ir::Constant>(&node.node);
        if (constant == nullptr || indices.contains(&node)) return;
        if (store != nullptr && inNumber.contains(&node)) return;
        if (constant->value < kFirstCommon || constant->value > kLastCommon ||
            constant->digits.find('.') != std::string::npos || constant->value != std::floor(constant->value))
          return;
        mine.used.emplace(static_cast<std::uint32_t>(constant->value),
                          node.range.hasPlace() ? node.range : statement.origin.range());
      });
    }
  });
  for (const Numbers& one : programs)
    for (const auto& [number, range] : one.used) {
      const auto at = one.stored.find(number);
      if (at == one.stored.end() || read.contains(number)) continue;
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
