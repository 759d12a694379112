#include "ir/Walk.h"
#include "lint/NcProgram.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

namespace dotek::lint::rule {
namespace {

// Where the lengths and radii of tools lie on a Fanuc beside #2001 and the following, with a digit less:
// inputs and outputs of the PMC, and nothing.
constexpr std::array<double, 4> kBases = {1000, 1100, 1200, 1300};
// The tool: T and H in force, arguments T and H.
constexpr std::array<std::uint32_t, 4> kTools = {4120, 4111, 20, 11};

// The number of the tool to which one of the bases is added; nothing: another number.
std::optional<std::pair<double, std::uint32_t>> baseOf(const ir::ExpressionPtr& number) {
  const auto* sum = number == nullptr ? nullptr : std::get_if<ir::Binary>(&number->node);
  if (sum == nullptr || sum->op != ir::BinaryOp::Add) return std::nullopt;
  for (const auto& [base, tool] : {std::pair{sum->left, sum->right}, std::pair{sum->right, sum->left}}) {
    const double* constant = ir::constantValue(base);
    const auto* asZero = std::get_if<ir::Unary>(&tool->node);
    const auto variable = variableNumber(asZero != nullptr ? *asZero->operand : *tool);
    if (constant == nullptr || !variable) continue;
    if (std::find(kBases.begin(), kBases.end(), *constant) != kBases.end() &&
        std::find(kTools.begin(), kTools.end(), *variable) != kTools.end())
      return std::pair{*constant, *variable};
  }
  return std::nullopt;
}

void check(const NcProgram& nc, Report& report) {
  std::set<std::uint32_t> written;
  for (const ir::ProgramStatement& statement : nc.program.body)
    if (const auto number = storedNumber(statement)) written.insert(*number);
  std::set<double> told;
  const auto judge = [&](const ir::ExpressionPtr& number, SourceRange range) {
    const auto base = baseOf(number);
    // What the program counts itself is no tool.
    if (!base || written.contains(base->second) || !told.insert(base->first).second) return;
    report.at(
        range,
        "#[{0:.0f}+#{1}] is no offset of a tool: {2}; the offset stays as it is, and the tool cuts with "
        "the old one; a digit is missing: #[{0:.0f}0+#{1}]",
        base->first, base->second,
        base->first < 1200 ? fmt::format("#{:.0f} and the following are signals of the machine", base->first)
                           : std::string("no control has such variables"));
  };
  for (const ir::ProgramStatement& statement : nc.program.body) {
    if (const auto* store = std::get_if<ir::Store>(&statement.node); store != nullptr && store->number)
      judge(store->number, statement.origin.range());
    ir::eachNode(statement, [&](const ir::Expression& node) {
      if (const auto* read = std::get_if<ir::MachineVariable>(&node.node))
        judge(read->number, node.range.hasPlace() ? node.range : statement.origin.range());
    });
  }
}

} // namespace

DOTEK_LINT_RULE(output_for_tool_offset){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
