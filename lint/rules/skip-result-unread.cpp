#include "ir/Linear.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"
#include "lint/AfterSkip.h"

#include <algorithm>
#include <set>

namespace dotek::lint::rule {
namespace {

// What of a statement tells where the G31 has stopped: a condition, a call, the skip position or that of the
// machine. A copy of #5001 or #5041 is a place to go back to.
bool asks(const ir::ProgramStatement& statement) {
  if (mayAskControl(statement)) return true;
  bool out = false;
  ir::eachNode(statement, [&](const ir::Expression& node) {
    if (!std::holds_alternative<ir::MachineVariable>(node.node)) return;
    const auto number = variableNumber(node);
    const bool machine = number && *number >= 5021 && *number <= 5023;
    out = out || !number || machine || contactAxis(*number);
  });
  return out;
}

// The G31s that are reached from this one before anything else moves, and whether something else moves first
// on a way to one.
struct Following {
  std::vector<std::size_t> skips;
  bool moves = false; // a move, and later a G31
  bool goesOn = false;
};

using Form = ir::LinearForm;

std::optional<Form> less(const std::optional<Form>& a, const std::optional<Form>& b) {
  return a && b ? ir::add(*a, *b, -1) : std::nullopt;
}

// Both ways are of one line, to opposite sides, whatever the variables hold.
bool areOpposite(const Form& a, const Form& b) {
  double ratio = 0;
  if (a.terms.empty())
    ratio = a.constant == 0 || !b.terms.empty() ? 0 : b.constant / a.constant;
  else if (const auto at = b.terms.find(a.terms.begin()->first); at != b.terms.end())
    ratio = at->second / a.terms.begin()->second;
  return ratio < 0 && ir::add(b, a, -ratio) == Form{};
}

std::optional<Form> targetOf(const ir::NcBlock& block, char axis) {
  for (const ir::Word& word : block.words)
    if (word.address == axis && word.value != nullptr)
      return ir::linear(ir::rewrite(word.value,
                                    [](const ir::ExpressionPtr& node) {
                                      const auto* one = std::get_if<ir::Unary>(&node->node);
                                      const bool form =
                                          one != nullptr && (one->op == ir::UnaryOp::NullAsZero ||
                                                             one->op == ir::UnaryOp::RoundIncrement);
                                      return form ? one->operand : node;
                                    }),
                        {});
  return std::nullopt;
}

// The next G31 goes back the way that this one has come: none of the two is an approach to the other.
bool comesBack(const NcProgram& nc, std::size_t skip, std::size_t next) {
  const auto& body = nc.program.body;
  const ir::NcBlock& one = *skipOf(body[skip]);
  const AxisSet axes = axesOf(one);
  if (axes != 1 && axes != 2 && axes != 4) return false;
  const char axis = axes == 1 ? 'X' : axes == 2 ? 'Y' : 'Z';
  for (const std::size_t at : {skip, next})
    if (statedMode(body[at]).value_or(nc.modes()[at].value_or(DistanceMode::Unknown)) ==
        DistanceMode::Incremental)
      return false;
  // Where it begins: the last target in the text, with no way in between.
  std::optional<Form> from;
  for (std::size_t at = skip; at-- > 0 && !from;) {
    const auto& goesTo = nc.flow().next[at];
    if (goesTo.size() != 1 || *goesTo.begin() != at + 1 || callOf(body[at]) != nullptr) break;
    const auto* block = std::get_if<ir::NcBlock>(&body[at].node);
    if (block == nullptr || !hasWord(*block, axis)) continue;
    if (!isPlainMove(*block)) break;
    from = targetOf(*block, axis);
    if (!from) break;
  }
  const std::optional<Form> to = targetOf(one, axis), then = targetOf(*skipOf(body[next]), axis);
  const std::optional<Form> there = less(to, from), back = less(then, to);
  return there && back && areOpposite(*there, *back);
}

// Fast to the face and slowly on it, or back a little and to the same place once more.
bool goesOn(const NcProgram& nc, std::size_t skip, std::size_t next, bool moved, bool small) {
  const ir::NcBlock& one = *skipOf(nc.program.body[skip]);
  const ir::NcBlock& other = *skipOf(nc.program.body[next]);
  return axesOf(one) == axesOf(other) && (!moved || small || sameTarget(one, other));
}

Following following(const NcProgram& nc, std::size_t skip, const std::vector<std::size_t>& after) {
  const auto& body = nc.program.body;
  struct Way {
    std::size_t at = 0;
    bool moved = false, small = true; // by distances alone
  };
  Following out;
  std::vector<Way> open{{skip}};
  std::set<std::size_t> seen;
  while (!open.empty()) {
    const Way way = open.back();
    open.pop_back();
    for (const std::size_t to : nc.flow().next[way.at]) {
      if (to >= body.size() || !seen.insert(to).second) continue;
      if (skipOf(body[to]) != nullptr) {
        out.goesOn = out.goesOn ||
                     (goesOn(nc, skip, to, way.moved, way.small) && (way.moved || !comesBack(nc, skip, to)));
        if (!way.moved) out.skips.push_back(to);
        continue;
      }
      if (!isPlainMove(body[to])) {
        open.push_back({to, way.moved, way.small});
        continue;
      }
      out.moves = true;
      const auto& block = std::get<ir::NcBlock>(body[to].node);
      const bool distance = hasCode(block, 'G', 91) ||
                            (nc.modes()[to] == DistanceMode::Incremental && !hasCode(block, 'G', 90));
      if (axesOf(block) == axesOf(*skipOf(body[skip]))) open.push_back({to, true, way.small && distance});
    }
  }
  // A move that ends the measuring goes away from the part.
  out.moves = out.moves && std::any_of(after.begin(), after.end(), [&](std::size_t at) {
                const auto& next = nc.flow().next[at];
                return std::any_of(next.begin(), next.end(), [&](std::size_t to) {
                  return to < body.size() && skipOf(body[to]) != nullptr;
                });
              });
  return out;
}

void check(const NcProgram& nc, Report& report) {
  const auto& body = nc.program.body;
  const auto reads = nc.reads();
  if (std::none_of(reads.begin(), reads.end(),
                   [](const VariableRead& one) { return contactAxis(one.number).has_value(); }))
    return;
  for (const std::size_t i : nc.skips()) {
    if (mayAskControl(body[i])) continue;
    const auto after = afterSkip(nc, i);
    if (!after || std::any_of(after->begin(), after->end(), [&](std::size_t at) { return asks(body[at]); }))
      continue;
    const Following next = following(nc, i, *after);
    if (next.goesOn || (next.skips.empty() && !next.moves)) continue;
    report.at(
        body[i].origin.range(),
        "nothing reads where this G31 stopped, and the program goes on from there as if it had arrived; "
        "after "
        "an early contact the next moves begin at the wrong place, with the stylus against the part; compare "
        "#5061 to #5063 with its target after it, and end in an alarm");
  }
}

} // namespace

DOTEK_LINT_RULE(skip_result_unread){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
