#include "backends/common/ToolLength.h"

#include "ir/Evaluate.h"
#include "ir/Flow.h"
#include "ir/Walk.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>

namespace dotek::backends {

namespace {

bool putsLength(const ir::OpaqueBlock& block, const stdlib::Control& control) {
  return std::any_of(block.words.begin(), block.words.end(), [&](const ir::Word& word) {
    const double* code = word.address == 'G' && word.value ? ir::constantValue(word.value) : nullptr;
    const auto* info = code == nullptr || *code < 0 || *code > 9999
                           ? nullptr
                           : control.find('G', static_cast<std::uint32_t>(std::lround(*code * 10)));
    return info != nullptr && info->function == stdlib::Function::ToolLengthPlus;
  });
}

bool leadsPast(const std::vector<std::vector<std::size_t>>& next, std::size_t statement) {
  std::vector<bool> seen(next.size() + 1);
  std::vector<std::size_t> open = {0};
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    if (at == statement || (at < seen.size() && seen[at])) continue;
    if (at >= next.size() || next[at].empty()) return true;
    seen[at] = true;
    open.insert(open.end(), next[at].begin(), next[at].end());
  }
  return false;
}

} // namespace

std::vector<LengthOffset> lengthOffsets(const ir::Cycle& cycle, const stdlib::Control& control) {
  std::vector<LengthOffset> out;
  for (std::size_t i = 0; i < cycle.body.size(); ++i) {
    const auto* block = std::get_if<ir::OpaqueBlock>(&cycle.body[i].node);
    if (block == nullptr || !putsLength(*block, control)) continue;
    for (const ir::Word& word : block->words)
      if (word.address == 'H' && word.value)
        out.push_back({i, &word, !leadsPast(ir::successors(cycle.body), i)});
  }
  return out;
}

bool isOfArguments(const ir::Cycle& cycle, const ir::ExpressionPtr& number) {
  bool out = true;
  ir::eachNode(number, [&](const ir::Expression& node) {
    if (std::holds_alternative<ir::MachineVariable>(node.node) ||
        std::holds_alternative<ir::MeasuredResult>(node.node))
      out = false;
    const auto* use = std::get_if<ir::VariableUse>(&node.node);
    if (use == nullptr) return;
    const bool written =
        std::any_of(cycle.body.begin(), cycle.body.end(), [&](const ir::CycleStatement& statement) {
          const auto* assign = std::get_if<ir::Assign>(&statement.node);
          return assign != nullptr && assign->variable == use->variable;
        });
    out = out && !written && cycle.variable(use->variable).role != ir::Role::Local;
  });
  return out;
}

void refuseNoLength(const ir::Cycle& cycle, const std::map<ir::VariableId, double>& fixed,
                    const stdlib::Control& control, const stdlib::Control& target, Diagnostics& diagnostics) {
  ir::Environment environment(cycle.variables.size());
  for (const auto& [id, value] : fixed)
    environment[id] = ir::Scalar::of(value);
  for (const LengthOffset& offset : lengthOffsets(cycle, control)) {
    const ir::Scalar number = ir::evaluate(*offset.word->value, environment);
    if (!number.known()) continue;
    const SourceRange range =
        offset.word->range.hasPlace() ? offset.word->range : cycle.body[offset.at].origin.range();
    if (target.variables.toolCount > 0 && number.value > target.variables.toolCount)
      diagnostics.report<diag::NoSuchToolOffset>(range, numberText(number.value), target.title,
                                                 target.variables.toolCount);
    // A constant is the post's own.
    if (number.value > 0 || ir::constantValue(offset.word->value) != nullptr) continue;
    std::string fields;
    ir::eachNode(offset.word->value, [&](const ir::Expression& node) {
      const auto* use = std::get_if<ir::VariableUse>(&node.node);
      if (use == nullptr) return;
      fields += (fields.empty() ? "`" : ", `") + cycle.variable(use->variable).name +
                "` = " + numberText(environment[use->variable].value);
    });
    diagnostics.report<diag::NoToolLength>(range, fields, numberText(number.value));
  }
}

} // namespace dotek::backends
