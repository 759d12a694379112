#include "lint/NcProgram.h"
#include "lint/ToolLength.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dotek::lint::rule {
namespace {

// What touches may be a tool whose length is not known yet: the program, or one that it calls, gives an
// entry of the table of tools a new value, or nobody knows what the called one does.
bool mayMeasureTool(const NcProgram& nc) {
  const ToolLengths& lengths = toolLengthsOf(nc.project);
  if (lengths.measuresTool(nc)) return true;
  const Probing& probing = probingOf(nc.project);
  bool own = false;
  for (const ir::ProgramStatement& statement : nc.program.body) {
    if (callOf(statement) == nullptr) continue;
    const ProbeStep step = probing.step(statement);
    if (step.kind == ProbeStep::Kind::PackCall) return true;
    if (step.kind != ProbeStep::Kind::OwnCall && step.kind != ProbeStep::Kind::Call) continue;
    if (!probing.isOwn(step.program)) return true;
    own = true;
  }
  if (!own) return false;
  bool out = !lengths.switching().empty() &&
             std::any_of(nc.program.body.begin(), nc.program.body.end(), [&](const auto& statement) {
               const auto called = calledProgram(statement);
               return called && lengths.switching().contains(*called);
             });
  for (const auto& other : programsOf(nc.project))
    out = out || lengths.measuresTool(*other);
  return out;
}

void check(const NcProgram& nc, Report& report) {
  const auto& facts = nc.machining();
  std::optional<bool> measures;
  // Numbers that are always some steps away from the tool's are a second set of offsets.
  int same = 0, apart = 0;
  bool anyH = false;
  std::set<int> tools;
  const ir::Word* wrong = nullptr;
  int wrongTool = 0;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const auto* block = std::get_if<ir::NcBlock>(&nc.program.body[i].node);
    if (block == nullptr || !facts[i]) continue;
    const ir::Word* code = codeWord(*block, 'G', 43);
    if (code == nullptr) code = codeWord(*block, 'G', 44);
    const ir::Word* h = firstWord(*block, "H");
    const int tool = codeWord(*block, 'M', 6) != nullptr
                         ? static_cast<int>(wordValue(*block, 'T').value_or(facts[i]->called))
                         : facts[i]->tool;
    if (facts[i]->probes && code != nullptr && !measures) measures = mayMeasureTool(nc);
    if (facts[i]->probes && measures == true) {
      anyH = anyH || h != nullptr;
      continue;
    }
    if (tool > 0) tools.insert(tool);
    if (code == nullptr) {
      anyH = anyH || h != nullptr;
      continue;
    }
    if (h == nullptr) {
      if (anyH) continue; // H is modal
      report.at(code->range, "G43 has no H, and none was before; the control takes up no length, or that of "
                             "the program before, and "
                             "the tool goes into the part; write H with the number of the offset");
      return;
    }
    anyH = true;
    const double* number = ir::constantValue(h->value);
    if (number == nullptr) continue;
    if (*number == 0) {
      report.at(h->range, "H0 takes up no length; Z counts from the nose of the spindle, and the tool goes "
                          "into the part by its "
                          "length; write the number of the offset, or G49 where none is meant");
      return;
    }
    if (tool <= 0) continue;
    if (*number == tool) {
      ++same;
    } else {
      ++apart;
      // A second set lies tens above the first one.
      const bool second = std::fmod(std::abs(*number - tool), 10) == 0 && (*number > tool || tool > 99);
      if (wrong == nullptr && !second) {
        wrong = h;
        wrongTool = tool;
      }
    }
  }
  if (wrong == nullptr || apart > 1 || (same == 0 && tools.size() > 1)) return;
  report.at(wrong->range,
            "T{} is in the spindle, and this takes up the length of another number; where each tool has the "
            "offset of "
            "its own number, the tool is too high or goes into the part; write H{}",
            wrongTool, wrongTool);
}

} // namespace

DOTEK_LINT_RULE(length_offset_number){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
