#include "lint/NcProgram.h"

#include <array>

namespace dotek::lint::rule {
namespace {

// What a mode does where nobody expects it.
struct Facts {
  Mode mode;
  std::string_view name, end, harm;
};
constexpr std::array kFacts = {
    Facts{Mode::CannedCycle, "a canned cycle", "G80", "the next position is drilled"},
    Facts{Mode::Compensation, "cutter compensation", "G40",
          "the next tool or program moves beside its path, or the control stops with an alarm"},
    Facts{Mode::Rotation, "a rotation by G68", "G69", "what follows is turned"},
    Facts{Mode::Scaling, "a scaling by G51", "G50", "what follows is scaled"},
    Facts{Mode::Polar, "polar coordinates by G16", "G15",
          "X and Y of what follows are a radius and an angle"},
};

void check(const NcProgram& nc, Report& report) {
  const auto& facts = nc.machining();
  const auto& body = nc.program.body;
  std::array<bool, kModes> told{};
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const auto* block = std::get_if<ir::NcBlock>(&body[i].node);
    if (block == nullptr || !facts[i]) continue;
    const bool ends = ir::endsProgram(body[i]);
    const bool changes = codeWord(*block, 'M', 6) != nullptr;
    const bool returns = codeWord(*block, 'G', 28) != nullptr || codeWord(*block, 'G', 30) != nullptr;
    const Machining now = within(*block, i, *facts[i]);
    for (const Facts& one : kFacts) {
      const Machining::Modal& modal = now.mode(one.mode);
      const auto index = static_cast<std::size_t>(one.mode);
      // Rotations and the like may go over a tool change.
      const bool tool = one.mode == Mode::CannedCycle || one.mode == Mode::Compensation;
      if (modal.on != Certain::Yes || modal.since >= body.size() || told[index]) continue;
      if (!ends && !(tool && (changes || (returns && one.mode == Mode::Compensation)))) continue;
      told[index] = true;
      report
          .at(body[modal.since].origin.range(), "{} begins here and no {} ends it before {}; {}; write {}",
              one.name, one.end,
              ends      ? "the program ends"
              : changes ? "the tool change"
                        : "the way to the reference point",
              one.harm, one.end)
          .note(body[i].origin.range(), "it is still on here");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(mode_left_on){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
