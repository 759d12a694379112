#include "lint/NcProgram.h"
#include "lint/ProgBlocks.h"
#include "lint/Skips.h"

#include <algorithm>
#include <charconv>

namespace dotek::lint::rule {
namespace {

enum class Switch : std::uint8_t { None, On, Off };

Switch switchOf(const std::vector<ProgWord>& words, const Project& project) {
  if (const MacroMeaning meaning = meaningOf(project, macroCalled(words)); meaning.set != nullptr)
    return meaning.intent == stdlib::Intent::ProbeOn    ? Switch::On
           : meaning.intent == stdlib::Intent::ProbeOff ? Switch::Off
                                                        : Switch::None;
  for (const ProgWord& word : words) {
    std::uint32_t code = 0;
    const auto [end, error] =
        std::from_chars(word.digits.data(), word.digits.data() + word.digits.size(), code);
    if (word.address != 'M' || error != std::errc() || end != word.digits.data() + word.digits.size())
      continue;
    const auto of = [&](const stdlib::Control& control) {
      const stdlib::CodeInfo* info = control.find('M', code * 10);
      if (info != nullptr && info->function == stdlib::Function::ProbeOn) return Switch::On;
      return info != nullptr && info->function == stdlib::Function::ProbeOff ? Switch::Off : Switch::None;
    };
    if (project.postControl)
      if (const Switch found = of(*project.postControl); found != Switch::None) return found;
    if (project.control)
      if (const Switch found = of(*project.control); found != Switch::None) return found;
    for (const stdlib::Control& control : project.controls)
      if (const Switch found = of(control); found != Switch::None) return found;
  }
  return Switch::None;
}

struct Switches {
  SourceRange on, off; // the first ones
};

void add(Switches& into, const std::vector<ProgBlock>& blocks, const Project& project) {
  for (const ProgBlock& block : blocks) {
    const Switch found = switchOf(wordsOf(block, nullptr), project);
    if (found == Switch::On && !into.on.hasPlace()) into.on = block.range;
    if (found == Switch::Off && !into.off.hasPlace()) into.off = block.range;
  }
}

void checkPost(const compost::Program& prog, const Project& project, Report& report) {
  Switches all;
  bool measures = false;
  for (const compost::Item& item : prog.items) {
    const auto* routine = std::get_if<compost::Routine>(&item);
    if (routine == nullptr) continue;
    if (!routine->returnRange) return; // told already; what is missing may be after it
    const std::vector<ProgBlock>& blocks = blocksOf(routine->body, prog, project);
    add(all, blocks, project);
    for (const ProgBlock& block : blocks)
      measures = measures || meaningOf(project, macroCalled(wordsOf(block, nullptr))).measures();
  }
  if (!measures) return;
  if (all.on.hasPlace() && !all.off.hasPlace())
    report.at(all.on,
              "the post switches the probe on and never off; its battery runs down, and the next tool may "
              "turn with the interlock of the probe in force; switch it off after the measurements");
  if (all.off.hasPlace() && !all.on.hasPlace())
    report.at(all.off,
              "the post switches the probe off and never on; without power it gives no signal, and the "
              "machine drives the stylus into the part; switch it on before the measurements");
}

// Branches of one routine: one that only switches off, or only on, where others do both, or where one that
// measures only switches on and another one only off.
void checkBranches(const Project& project, Report& report) {
  for (const Siblings& siblings : siblingsOf(project)) {
    std::vector<Switches> each(siblings.branches.size());
    bool both = false, onAlone = false, offAlone = false;
    for (std::size_t i = 0; i < each.size(); ++i) {
      const std::vector<ProgBlock>& blocks = siblings.branches[i].blocks;
      add(each[i], blocks, project);
      const bool on = each[i].on.hasPlace(), off = each[i].off.hasPlace();
      const bool measures = std::any_of(blocks.begin(), blocks.end(), [&](const ProgBlock& block) {
        return meaningOf(project, macroCalled(wordsOf(block, nullptr))).measures();
      });
      both = both || (on && off);
      onAlone = onAlone || (measures && on && !off);
      offAlone = offAlone || (measures && off && !on);
    }
    if (!both && !(onAlone && offAlone)) continue;
    for (std::size_t i = 0; i < each.size(); ++i) {
      const bool on = each[i].on.hasPlace();
      if (on == each[i].off.hasPlace()) continue;
      report.at(on ? each[i].on : each[i].off,
                "the branch for `{}` switches the probe {} and not {}{}; write both", siblings.branches[i].id,
                on ? "on" : "off", on ? "off" : "on",
                both ? ", as other branches do" : ", and no other branch runs with it");
    }
  }
}

void checkProgram(const ir::Program& program, const Probing& probing, Report& report) {
  const ir::ProgramStatement* off = nullptr;
  bool touches = false;
  for (const ir::ProgramStatement& statement : program.body) {
    switch (probing.step(statement).kind) {
    case ProbeStep::Kind::On: return;
    case ProbeStep::Kind::Off:
      if (off == nullptr) off = &statement;
      break;
    case ProbeStep::Kind::OwnCall:
    case ProbeStep::Kind::Call:
    case ProbeStep::Kind::PackCall: touches = true; break;
    default: touches = touches || skipOf(statement) != nullptr; break;
    }
  }
  // What measures with a macro of a pack is reported as probe-not-switched-on.
  if (off != nullptr && touches && endsProgram(program))
    report.at(off->origin.range(),
              "the program switches the probe off and never on; without power it gives no "
              "signal, and the machine drives the stylus into the part; switch it on before "
              "the first touch");
}

void check(const Project& project, Report& report) {
  for (const compost::Program* prog : project.progs)
    if (!prog->hasErrorNodes) checkPost(*prog, project, report);
  checkBranches(project, report);
}

void checkOne(const NcProgram& nc, Report& report) {
  checkProgram(nc.program, probingOf(nc.project), report);
}

} // namespace

DOTEK_LINT_RULE(probe_switch_unpaired){
    .severity = Severity::Warning,
    .tier = Tier::Bundle,
    .check = check,
    .program = checkOne,
};

} // namespace dotek::lint::rule
