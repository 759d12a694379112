#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/ToolLength.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace dotek::lint::rule {
namespace {

// Where a program returns under G49, on one path at least.
struct LeftOff {
  const ir::ProgramStatement* exit = nullptr;
  const ir::ProgramStatement* code = nullptr; // G49
  bool probes = false, changesTool = false;
};

// Branches that ask whether the caller has a length in force: what follows goes by the answer.
std::vector<bool> asksForLength(const ir::Program& program) {
  constexpr std::uint32_t kOfLengths = 4008; // #4008: G43, G44 or G49
  std::set<std::uint32_t> copies{kOfLengths};
  for (const ir::ProgramStatement& one : program.body)
    if (const auto* store = std::get_if<ir::Store>(&one.node))
      if (const auto number = storedNumber(one); number && variableNumber(*store->value) == kOfLengths)
        copies.insert(*number);
  std::vector<bool> out;
  for (const ir::ProgramStatement& one : program.body) {
    bool asks = false;
    if (const auto* branch = std::get_if<ir::Branch>(&one.node); branch != nullptr && branch->condition)
      ir::eachNode(branch->condition, [&](const ir::Expression& node) {
        const auto number =
            std::holds_alternative<ir::MachineVariable>(node.node) ? variableNumber(node) : std::nullopt;
        asks = asks || (number && copies.contains(*number));
      });
    out.push_back(asks);
  }
  return out;
}

std::optional<LeftOff> leftOff(const NcProgram& nc) {
  LeftOff out;
  const ir::Program& program = nc.program;
  const auto& others = nc.otherCodes();
  for (const ir::ProgramStatement& one : program.body) {
    if (statedOffset(one, others) == Offset::Off) out.code = &one;
    out.probes = out.probes || skipOf(one) != nullptr;
    const auto* block = std::get_if<ir::NcBlock>(&one.node);
    out.changesTool = out.changesTool || (block != nullptr && hasCode(*block, 'M', 6));
  }
  if (out.code == nullptr) return std::nullopt;
  const std::vector<bool> asks = asksForLength(program);
  const auto states = ir::factsBefore<Offset>(
      program.body, nc.flow(), Offset::AsBefore,
      [&](std::size_t at, std::size_t, Offset offset) {
        if (asks[at]) return Offset::Either;
        return statedOffset(program.body[at], others).value_or(offset);
      },
      [](Offset& into, Offset other) {
        // One path under G49 is enough: the caller goes on in it.
        if (into == other || into == Offset::Off) return false;
        const Offset merged = other == Offset::Off ? Offset::Off : Offset::Either;
        const bool changed = into != merged;
        into = merged;
        return changed;
      });
  for (std::size_t i = 0; i < program.body.size(); ++i)
    if (std::holds_alternative<ir::Exit>(program.body[i].node) && states[i] == Offset::Off) {
      out.exit = &program.body[i];
      return out;
    }
  return std::nullopt;
}

// A move along Z to a coordinate of the work system.
bool movesZ(const ir::ProgramStatement& statement) {
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  return block != nullptr && hasWord(*block, 'Z') && !hasCode(*block, 'G', 53) &&
         (isPlainMove(*block) || skipOf(statement) != nullptr);
}

using Programs = std::map<std::uint32_t, LeftOff>;

// Callers under G43 that go on with Z after such a program.
void checkCaller(const NcProgram& nc, const Programs& programs, Report& report) {
  const auto& body = nc.program.body;
  const auto left = [&](std::size_t at) {
    const auto called = calledProgram(body[at]);
    return called ? programs.find(*called) : programs.end();
  };
  bool calls = false;
  for (std::size_t i = 0; i < body.size(); ++i)
    calls = calls || left(i) != programs.end();
  if (!calls) return;
  const auto& others = nc.otherCodes();
  // 0: under no G43; 1: under it; else 2 more than the place of the call that has taken it off.
  const auto states = ir::factsBefore<std::size_t>(
      body, nc.flow(), std::size_t{0},
      [&](std::size_t at, std::size_t, std::size_t state) -> std::size_t {
        if (const auto stated = statedOffset(body[at], others)) return *stated == Offset::On ? 1 : 0;
        if (state == 1 && left(at) != programs.end()) return at + 2;
        return state > 1 && movesZ(body[at]) ? 0 : state;
      },
      [](std::size_t& into, std::size_t other) {
        if (into == other || into == 0) return false;
        into = 0;
        return true;
      });
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!states[i] || *states[i] < 2 || !movesZ(body[i]) || statedOffset(body[i], others)) continue;
    const std::size_t call = *states[i] - 2;
    const auto of = left(call);
    report
        .at(body[i].origin.range(),
            "O{:04} has taken the tool length off, and this Z is one of the spindle: the tool goes deeper by "
            "its length; write G43 H and Z again after the call, or in O{:04} before M99",
            of->first, of->first)
        .note(body[call].origin.range(), "it is called here, under G43")
        .note(of->second.code->origin.range(), "G49 is here");
  }
}

void check(const Project& project, Report& report) {
  const ToolLengths& lengths = toolLengthsOf(project);
  Programs programs;
  for (const auto& nc : programsOf(project)) {
    const ir::Program& program = nc->program;
    if (program.number == 0 || endsProgram(program)) continue;
    const auto left = leftOff(*nc);
    if (!left) continue;
    const auto number = static_cast<std::uint32_t>(program.number);
    programs.emplace(number, *left);
    // Callers among the files say for themselves whether they go on without it.
    if (lengths.called().contains(number) || !left->probes || left->changesTool || lengths.measuresTool(*nc))
      continue;
    report
        .at(left->exit->origin.range(),
            "the program returns with G49 in force; the caller's next Z is one of the spindle, and the tool "
            "goes deeper by its length; write `G43 H#4111` before M99, or keep `#4008` and give it back")
        .note(left->code->origin.range(), "G49 is here");
  }
  if (programs.empty()) return;
  for (const auto& nc : programsOf(project))
    checkCaller(*nc, programs, report);
}

} // namespace

DOTEK_LINT_RULE(length_left_off){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
