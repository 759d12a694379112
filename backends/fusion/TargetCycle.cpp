#include "backends/fusion/TargetCycle.h"

#include "ir/Fold.h"
#include "project/CycleCatalogue.h"
#include "project/CycleFiles.h"
#include "targets/DialogChoices.h"
#include "targets/Target.h"

#include <algorithm>

namespace dotek::targets {

namespace fusion = backends::fusion;

namespace target {
extern const Target fanuc; // writes the program
}

// Without the `%` around them.
std::vector<backends::EmittedLine> linesOf(const OutputFile& file, const MappedResult& map) {
  std::vector<backends::EmittedLine> out;
  std::string_view text = file.text;
  for (const MappedLine& line : map.lines) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (text.substr(0, end) != "%")
      out.push_back({std::string(text.substr(0, end)), line.ranges, line.reason});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

std::optional<CalledCycle> calledCycle(const CycleFolder& folder, std::size_t index, const std::string& file,
                                       ConversionContext& context) {
  Session& session = context.session;
  const auto beside = [&] {
    ConversionContext out{context.options, context.compilation, session,
                          context.folders, context.usedSets,    context.inputs};
    out.letters = context.letters;
    return out;
  };
  ConversionContext programs = beside();
  const std::unique_ptr<Conversion> conversion = target::fanuc.convert(programs);
  const bool lowers = conversion->beginCycles() && conversion->cycle(folder, index);
  context.usedDefaults.merge(programs.usedDefaults);
  context.usedLetters.merge(programs.usedLetters);
  ConversionResult& result = programs.result;
  if (!lowers || session.diagnostics().hasErrors() || result.files.empty()) return std::nullopt;
  // Once more for the checks and the fields; what it says has been said.
  Diagnostics said = std::exchange(session.diagnostics(), Diagnostics());
  ConversionContext again = beside();
  std::optional<LoweredSource> source = lowerSource(folder, again);
  CycleFiles files(session);
  const auto* const tree = files.linked(file);
  session.diagnostics() = std::move(said);
  if (!source || tree == nullptr) return std::nullopt;
  context.result.numbers.insert(context.result.numbers.end(), result.numbers.begin(), result.numbers.end());
  CalledCycle out{std::move(source->lowered), {}, result.arguments.front(), result.macros, {}, {}};
  ir::Cycle& cycle = out.lowered.cycle;
  ir::fold(cycle, out.lowered.fixed);
  out.call.number = static_cast<std::uint32_t>(result.numbers.front().first);
  out.call.lines = linesOf(result.files.front(), result.maps.front());
  const CyclePage page = cyclePage(*tree);
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    const ir::Variable& variable = cycle.variable(id);
    if (variable.role == ir::Role::Local) continue;
    for (const OutputArgument& one : out.arguments)
      if (one.name == variable.name) out.call.arguments.push_back({id, one.letter});
    for (const CyclePage::Row& row : page.parameters) {
      if (variable.role != ir::Role::Parameter || row.name != variable.name) continue;
      out.groups[id] = row.group;
      for (DialogChoice& choice : choicesOfType(row.kind))
        out.choices[id].push_back({choice.value, std::move(choice.title)});
    }
  }
  // In the order of the alphabet: of I, J and K out of it the control reads the second set.
  std::sort(out.call.arguments.begin(), out.call.arguments.end(),
            [](const auto& a, const auto& b) { return a.letter < b.letter; });
  return out;
}

} // namespace dotek::targets
