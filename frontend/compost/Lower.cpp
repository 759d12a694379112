#include "frontend/compost/Lower.h"

#include "frontend/compost/LowerRun.h"
#include "support/messages/Nc.h"

#include <algorithm>

namespace dotek::frontend::compost {
namespace {

struct Called {
  std::uint32_t program = 0;
  SourceRange range;
};

std::vector<Called> programsOf(const std::vector<nc::Block>& blocks) {
  std::vector<Called> out;
  for (const nc::Block& block : blocks) {
    SourceRange range = block.range;
    for (const nc::Word& word : block.words) {
      if (word.address == 'P') range = word.range;
    }
    for (const std::uint32_t program : nc::programsCalled(block))
      out.push_back({program, range});
  }
  return out;
}

std::string namesOf(const std::vector<const stdlib::MacroSet*>& sets) {
  std::string out;
  for (const stdlib::MacroSet* set : sets)
    out += (out.empty() ? "`" : ", `") + set->name + "`";
  return out.empty() ? "none" : out;
}

// The one set that knows all programs; nullptr: none is called, or it was reported and `ok` is false.
const stdlib::MacroSet* chooseSet(const std::vector<Called>& called, const LowerSettings& settings,
                                  Diagnostics& diagnostics, bool& ok) {
  ok = true;
  if (called.empty()) return nullptr;
  std::vector<const stdlib::MacroSet*> fitting = settings.macros;
  for (const Called& one : called) {
    std::vector<const stdlib::MacroSet*> left;
    std::copy_if(fitting.begin(), fitting.end(), std::back_inserter(left),
                 [&](const stdlib::MacroSet* set) { return set->calls(one.program); });
    if (left.empty()) {
      // Known to another set, or to none.
      ok = false;
      const bool anywhere = std::any_of(settings.macros.begin(), settings.macros.end(),
                                        [&](const stdlib::MacroSet* set) { return set->calls(one.program); });
      if (anywhere)
        diagnostics.report<diag::MixedMacroSets>(one.range, one.program, namesOf(fitting));
      else
        diagnostics.report<diag::UnknownMacro>(one.range, one.program, namesOf(settings.macros));
      return nullptr;
    }
    fitting = std::move(left);
  }
  if (fitting.size() == 1) return fitting.front();
  ok = false;
  diagnostics.report<diag::SeveralMacroSets>(called.front().range, namesOf(fitting));
  return nullptr;
}

} // namespace

std::optional<Lowered> lowerRoutine(const Program& program, const Routine& routine,
                                    const std::string& cycleId, ir::Cycle& cycle,
                                    const LowerSettings& settings, Diagnostics& diagnostics) {
  LowerRun run(program, cycleId, settings, diagnostics);
  run.run(routine);
  bool ok = true;
  Lowered lowered;
  lowered.macros = chooseSet(programsOf(run.blocks()), settings, diagnostics, ok);
  if (!ok) return std::nullopt;
  nc::LiftContext context{settings.control, lowered.macros, cycle, diagnostics};
  context.fixed = settings.fixed;
  context.encoding = settings.sources.file(program.file).encoding();
  if (!nc::liftAll(run.blocks(), context, lowered.body)) ok = false;
  nc::reportPictures(context);
  if (!ok || run.hasFailed()) return std::nullopt;
  lowered.printed = run.takePrinted();
  return lowered;
}

} // namespace dotek::frontend::compost
