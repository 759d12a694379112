#include "lint/NcProgram.h"
#include "lint/ToolLength.h"

#include <algorithm>
#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

// 0: not known, or stopped; else one more than the place of the M3 or M4 that turns it.
using Turned = std::size_t;

enum class Spindle : std::uint8_t { Turns, Stops, MayEither };

// What the block says of the spindle; nothing: it says nothing. A change of tools and an orientation stop it.
std::optional<Spindle> statedSpindle(const ir::ProgramStatement& statement) {
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  if (block == nullptr) return std::nullopt;
  std::optional<Spindle> out;
  for (const ir::Word& word : block->words) {
    if (word.address != 'M') continue;
    const double* code = ir::constantValue(word.value);
    if (code == nullptr)
      out = Spindle::MayEither;
    else if (*code == 3 || *code == 4 || *code == 13 || *code == 14)
      out = Spindle::Turns;
    else if (*code == 5 || *code == 6 || *code == 19 || *code == 0 || *code == 1)
      out = Spindle::Stops;
    else if (*code > 30 && *code != 98 && *code != 99)
      out = Spindle::MayEither; // of the machine's builder
  }
  return out;
}

struct Own {
  bool skips = false, statesSpindle = false, measuresTool = false;
};

bool turnsSpindle(const NcProgram& nc) {
  const auto& body = nc.program.body;
  return std::any_of(body.begin(), body.end(),
                     [](const ir::ProgramStatement& one) { return statedSpindle(one) == Spindle::Turns; });
}

void checkProgram(const NcProgram& nc, const std::map<std::uint32_t, Own>& own, bool measuresTool,
                  Report& report) {
  const auto& body = nc.program.body;
  const auto states = ir::factsBefore<Turned>(
      body, nc.flow(), Turned{0},
      [&](std::size_t at, std::size_t, Turned turned) -> Turned {
        if (const auto stated = statedSpindle(body[at])) return *stated == Spindle::Turns ? at + 1 : 0;
        if (callOf(body[at]) == nullptr) return turned;
        // A macro of a vendor stops the spindle, or says that it has to stand.
        const auto called = calledProgram(body[at]);
        const auto found = called ? own.find(*called) : own.end();
        return found == own.end() || found->second.statesSpindle ? 0 : turned;
      },
      [](Turned& into, Turned other) {
        if (into == other || into == 0) return false;
        if (other == 0) into = 0;
        return other == 0;
      });
  std::set<Turned> told;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!states[i] || *states[i] == 0) continue;
    const auto called = calledProgram(body[i]);
    const auto found = called ? own.find(*called) : own.end();
    // A tool that turns backwards against the second input is measured itself.
    const ir::NcBlock* skip = skipOf(body[i]);
    const auto* turning = std::get_if<ir::NcBlock>(&body[*states[i] - 1].node);
    if (skip != nullptr && wordValue(*skip, 'P').value_or(1) >= 2 && turning != nullptr &&
        hasCode(*turning, 'M', 4))
      continue;
    const bool calls = found != own.end() && found->second.skips && !found->second.statesSpindle &&
                       !found->second.measuresTool;
    if ((!calls && (skipOf(body[i]) == nullptr || measuresTool)) || !told.insert(*states[i]).second) continue;
    report
        .at(body[i].origin.range(),
            "{} while the spindle turns; a probe that turns measures wrong, and its stylus or its cable "
            "breaks; write M5, or M19, before it",
            calls ? fmt::format("O{:04} probes (G31)", *called) : std::string("this G31 probes"))
        .note(body[*states[i] - 1].origin.range(), "the spindle is switched on here");
  }
}

void check(const Project& project, Report& report) {
  const NcPrograms& programs = programsOf(project);
  if (std::none_of(programs.begin(), programs.end(), [](const auto& nc) { return turnsSpindle(*nc); }))
    return;
  const ToolLengths& lengths = toolLengthsOf(project);
  const Probing& probing = probingOf(project);
  std::map<std::uint32_t, Own> own;
  for (const auto& nc : programs) {
    const ir::Program& program = nc->program;
    if (program.number == 0) continue;
    Own one;
    one.skips = probing.skips(static_cast<std::uint32_t>(program.number));
    one.statesSpindle =
        std::any_of(program.body.begin(), program.body.end(), [](const ir::ProgramStatement& statement) {
          return statedSpindle(statement).has_value();
        });
    one.measuresTool = one.skips && lengths.measuresTool(*nc);
    own.emplace(static_cast<std::uint32_t>(program.number), one);
  }
  for (const auto& nc : programs)
    if (turnsSpindle(*nc)) checkProgram(*nc, own, lengths.measuresTool(*nc), report);
}

} // namespace

DOTEK_LINT_RULE(probe_with_spindle_on){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
