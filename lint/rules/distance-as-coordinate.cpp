#include "ir/Walk.h"
#include "lint/NcProgram.h"

#include <algorithm>
#include <set>

namespace dotek::lint::rule {
namespace {

const ir::Word* wordOf(const ir::NcBlock& block, char address) {
  for (const ir::Word& word : block.words)
    if (word.address == address && word.value != nullptr) return &word;
  return nullptr;
}

// Numbers of the variables of which the value is computed; nothing: one of them is computed itself.
std::optional<std::set<std::uint32_t>> variablesOf(const ir::ExpressionPtr& value) {
  std::set<std::uint32_t> out;
  bool known = true;
  ir::eachNode(value, [&](const ir::Expression& node) {
    if (!std::holds_alternative<ir::MachineVariable>(node.node)) return;
    const auto number = variableNumber(node);
    known = known && number.has_value();
    if (number) out.insert(*number);
  });
  return known ? std::optional(out) : std::nullopt;
}

// A G31 under G91, a way back that is counted from its contact under G90, and a second G31 to a value that is
// made of what the first one took for a distance.
void check(const NcProgram& nc, Report& report) {
  const auto& body = nc.program.body;
  const auto& modes = nc.modes();
  for (const auto& [axis, bit] : {std::pair{'X', 1U}, std::pair{'Y', 2U}, std::pair{'Z', 4U}}) {
    std::size_t distance = body.size(), back = body.size(); // the first G31, the way back
    std::set<std::uint32_t> distances;
    for (std::size_t i = 0; i < body.size(); ++i) {
      const auto* block = std::get_if<ir::NcBlock>(&body[i].node);
      if (block == nullptr || !modes[i]) continue;
      const ir::Word* const word = wordOf(*block, axis);
      const bool skip = skipOf(body[i]) != nullptr;
      if (word == nullptr || (!skip && !isPlainMove(body[i]))) {
        if (axesOf(*block) != 0) distance = body.size(); // elsewhere
        continue;
      }
      const auto mode = statedMode(body[i]).value_or(*modes[i]);
      const auto read = variablesOf(word->value);
      if (skip && mode == DistanceMode::Incremental && read) {
        distance = i;
        distances = *read;
        back = body.size();
        continue;
      }
      if (distance == body.size() || mode != DistanceMode::Absolute || !read) {
        distance = body.size();
        continue;
      }
      if (!skip) {
        const auto own = static_cast<AxisSet>(bit);
        const bool fromContact = std::any_of(
            read->begin(), read->end(), [own](std::uint32_t number) { return contactAxis(number) == own; });
        back = fromContact ? i : body.size();
        if (!fromContact) distance = body.size();
        continue;
      }
      const bool same =
          !read->empty() && std::includes(distances.begin(), distances.end(), read->begin(), read->end());
      if (back != body.size() && same)
        report
            .at(word->range,
                "G90 is in force at this G31, and its target is computed from what the G31 before took for a "
                "distance; it goes to that coordinate, near the zero of the work system, and touches only "
                "where "
                "the surface happens to lie on the path; write G91 into the block")
            .note(body[distance].origin.range(), "the same under G91")
            .note(body[back].origin.range(), "G90 since here or before");
      distance = body.size();
    }
  }
}

} // namespace

DOTEK_LINT_RULE(distance_as_coordinate){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
