#include "lint/AfterSkip.h"

#include "ir/Walk.h"

#include <algorithm>

namespace dotek::lint {
namespace {

constexpr std::size_t kMostAfter = 400; // more is no macro that measures
constexpr std::uint32_t kFirstSystem = 1000;

const ir::Word* wordOf(const ir::NcBlock& block, char address) {
  const auto found = std::find_if(block.words.begin(), block.words.end(),
                                  [&](const ir::Word& word) { return word.address == address; });
  return found == block.words.end() ? nullptr : &*found;
}

} // namespace

std::optional<std::vector<std::size_t>> afterSkip(const NcProgram& nc, std::size_t skip) {
  const auto& body = nc.program.body;
  std::vector<bool> seen(body.size());
  std::vector<std::size_t> out, open{skip};
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    if (ir::isComputedJump(body[at])) return std::nullopt;
    for (const std::size_t to : nc.flow().next[at]) {
      if (to >= body.size() || skipOf(body[to]) != nullptr || seen[to]) continue;
      seen[to] = true;
      out.push_back(to);
      if (out.size() > kMostAfter) return std::nullopt;
      open.push_back(to);
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::optional<AxisSet> positionAxis(std::uint32_t variable) {
  for (const std::uint32_t first : {5001U, 5021U, 5041U, 5061U})
    if (variable >= first && variable <= first + 2) return static_cast<AxisSet>(1U << (variable - first));
  return std::nullopt;
}

bool askedAlone(const NcProgram& nc, std::size_t store) {
  const auto& body = nc.program.body;
  const auto variable = storedNumber(body[store]);
  bool asked = false;
  for (std::size_t i = store + 1; variable && i < body.size() && i - store <= kMostAfter; ++i) {
    const auto all = nc.reads(i);
    const bool reads =
        std::any_of(all.begin(), all.end(), [&](const VariableRead& one) { return one.number == *variable; });
    if (reads && ir::conditionOf(body[i]) == nullptr) return false;
    asked = asked || reads;
    if (storedNumber(body[i]) == variable) break;
  }
  return asked;
}

bool mayAskControl(const ir::ProgramStatement& statement) {
  if (callOf(statement) != nullptr) return true;
  if (const auto* block = std::get_if<ir::NcBlock>(&statement.node))
    return hasCode(*block, 'M', 78) || hasCode(*block, 'M', 79);
  const ir::ConditionPtr* condition = ir::conditionOf(statement);
  if (condition == nullptr || !*condition) return false;
  bool out = false;
  ir::eachNode(*condition, [&](const ir::Expression& node) {
    if (!std::holds_alternative<ir::MachineVariable>(node.node)) return;
    const auto number = variableNumber(node);
    out = out || !number || *number >= kFirstSystem;
  });
  return out;
}

bool sameWord(const ir::NcBlock& a, const ir::NcBlock& b, char address) {
  const ir::Word* one = wordOf(a, address);
  const ir::Word* other = wordOf(b, address);
  if (one == nullptr || other == nullptr) return one == other;
  return one->value != nullptr && other->value != nullptr && ir::equal(one->value, other->value);
}

bool sameTarget(const ir::NcBlock& a, const ir::NcBlock& b) {
  return axesOf(a) != 0 && axesOf(a) == axesOf(b) && sameWord(a, b, 'X') && sameWord(a, b, 'Y') &&
         sameWord(a, b, 'Z');
}

} // namespace dotek::lint
