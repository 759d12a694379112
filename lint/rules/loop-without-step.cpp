#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kFirstSystem = 1000; // the control changes these itself

struct Loop {
  std::size_t begin = 0, end = 0; // statements of the head and of the END
};

std::vector<Loop> loopsOf(const std::vector<ir::ProgramStatement>& body) {
  std::vector<Loop> out;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const auto* loop = std::get_if<ir::Loop>(&body[i].node);
    if (loop == nullptr) continue;
    for (std::size_t k = i + 1; k < body.size(); ++k) {
      const auto* end = std::get_if<ir::LoopEnd>(&body[k].node);
      if (end == nullptr || end->number != loop->number) continue;
      out.push_back({i, k});
      break;
    }
  }
  return out;
}

// Variables that the loop may set; nothing where it may set any.
std::optional<std::set<std::uint32_t>> storedIn(const std::vector<ir::ProgramStatement>& body,
                                                const Loop& loop, bool computedToo) {
  std::set<std::uint32_t> out;
  for (std::size_t i = loop.begin; i < loop.end; ++i) {
    if (callOf(body[i]) != nullptr) return std::nullopt;
    if (!std::holds_alternative<ir::Store>(body[i].node)) continue;
    const auto number = storedNumber(body[i]);
    if (!number && computedToo) return std::nullopt;
    if (number) out.insert(*number);
  }
  return out;
}

// Leaves the loop by a jump of the text: what loop-never-ends passes over.
bool jumpsOut(const ir::Program& program, const Loop& loop) {
  bool jumps = false;
  for (std::size_t i = loop.begin + 1; i < loop.end; ++i) {
    const auto* branch = std::get_if<ir::Branch>(&program.body[i].node);
    if (branch == nullptr || program.labels[branch->target].number == 0) continue;
    // A loop that waits for a state of the control is meant to turn.
    bool waits = false;
    ir::eachNode(branch->condition, [&](const ir::Expression& node) {
      const auto number = variableNumber(node);
      waits = waits || (number && *number >= kFirstSystem);
    });
    if (waits) return false;
    jumps = true;
  }
  return jumps;
}

void checkProgram(const ir::Program& program, Report& report) {
  const auto& body = program.body;
  for (const Loop& loop : loopsOf(body)) {
    const auto& head = std::get<ir::Loop>(body[loop.begin].node);
    const auto stored = storedIn(body, loop, false);
    if (!stored) continue;
    if (head.condition && jumpsOut(program, loop)) {
      std::set<std::uint32_t> read;
      bool known = true;
      ir::eachNode(head.condition, [&](const ir::Expression& node) {
        if (!std::holds_alternative<ir::MachineVariable>(node.node)) return;
        const auto number = variableNumber(node);
        known = known && number && *number < kFirstSystem;
        if (number) read.insert(*number);
      });
      bool changes = !known || read.empty();
      for (const std::uint32_t number : read)
        changes = changes || stored->contains(number);
      if (!changes)
        report.at(
            body[loop.begin].origin.range(),
            "nothing in this loop changes what its condition looks at, #{}; only a jump leads out of it; "
            "count it in the loop",
            *read.begin());
    }
    // #[#105]=.. in a loop that leaves #105 alone writes the same variable each time.
    for (std::size_t i = loop.begin + 1; i < loop.end; ++i) {
      const auto* store = std::get_if<ir::Store>(&body[i].node);
      if (store == nullptr || storedNumber(body[i])) continue;
      bool moves = false;
      std::optional<std::uint32_t> index;
      ir::eachNode(store->number, [&](const ir::Expression& node) {
        if (!std::holds_alternative<ir::MachineVariable>(node.node)) return;
        const auto number = variableNumber(node);
        moves = moves || !number || stored->contains(*number);
        if (number && !index) index = number;
      });
      if (index && !moves)
        report.at(body[i].origin.range(),
                  "the loop never changes #{0}, the number of the variable that is written here; each turn "
                  "overwrites the value of the one before; count #{0} in the loop",
                  *index);
    }
  }
}

void check(const NcProgram& nc, Report& report) {
  checkProgram(nc.program, report);
}

} // namespace

DOTEK_LINT_RULE(loop_without_step){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
