#include "frontend/cycle/Lower.h"

#include "frontend/cycle/Lowering.h"
#include "ir/Flow.h"
#include "ir/Fold.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"
#include "support/messages/Cycle.h"

#include <utility>

namespace dotek::frontend::cycle {
namespace {

constexpr ir::LabelId kNoLabel = ~ir::LabelId{0};

// Labels in the order of their places; variables that nothing names any more are taken out. Gives the new
// ids.
std::map<ir::VariableId, ir::VariableId> compact(ir::Cycle& cycle) {
  std::vector<ir::LabelName> labels = std::exchange(cycle.labels, {});
  cycle.labelNames.clear();
  cycle.labelsSeen = 0;
  std::vector<ir::LabelId> newLabel(labels.size(), kNoLabel);
  for (auto* list : {&cycle.checks, &cycle.body})
    for (ir::CycleStatement& statement : *list)
      if (auto* label = std::get_if<ir::Label>(&statement.node)) {
        newLabel[label->label] = cycle.addLabel(labels[label->label]);
        label->label = newLabel[label->label];
      }
  std::vector<bool> used(cycle.variables.size());
  for (auto* list : {&cycle.checks, &cycle.body})
    for (ir::CycleStatement& statement : *list) {
      if (auto* jump = std::get_if<ir::Jump>(&statement.node)) jump->target = newLabel[jump->target];
      if (auto* branch = std::get_if<ir::Branch>(&statement.node)) branch->target = newLabel[branch->target];
      if (const auto* assign = std::get_if<ir::Assign>(&statement.node)) used[assign->variable] = true;
      ir::eachNode(statement, [&](const ir::Expression& node) {
        if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) used[use->variable] = true;
      });
    }
  std::vector<ir::Variable> variables = std::exchange(cycle.variables, {});
  std::map<ir::VariableId, ir::VariableId> names;
  for (ir::VariableId id = 0; id < variables.size(); ++id) {
    const bool stays = used[id] || variables[id].role == ir::Role::Parameter;
    if (stays) names[id] = cycle.add(std::move(variables[id]));
  }
  ir::rename(cycle.checks, names);
  ir::rename(cycle.body, names);
  return names;
}

} // namespace

Lowering::Lowering(const File& file, const SourceMap& sources, Diagnostics& diagnostics)
    : file_(file), sources_(sources), diagnostics_(diagnostics) {}

ir::LabelId Lowering::label(std::string_view name, SourceRange range) {
  return cycle_.addLabel({std::string(name), range});
}

ir::VariableId Lowering::local(std::string_view name, ir::Kind kind, SourceRange range) {
  ir::Variable variable;
  const std::string whole = scope_.prefix + std::string(name);
  variable.name = whole;
  if (!taken_.insert(whole).second) {
    int& number = numbers_.try_emplace(whole, 2).first->second;
    do
      variable.name = whole + "_" + std::to_string(number++);
    while (!taken_.insert(variable.name).second);
  }
  variable.kind = kind;
  variable.range = range;
  return cycle_.add(std::move(variable));
}

std::optional<Lowered> Lowering::run() {
  const Header* header = file_.header();
  if (header == nullptr) return std::nullopt;
  cycle_.name = header->name.text;
  cycle_.range = header->name.range;
  if (header->title) cycle_.title = header->title->text;
  out_ = &cycle_.checks;
  declarations(file_);
  out_ = &cycle_.body;
  declareTouches(file_.body);
  block(file_.body);
  leaveResults(results_, cycle_.range);
  if (failed_) return std::nullopt;
  warnMixed();
  warnDeviations();
  resolvePlaces();
  if (failed_) return std::nullopt;
  outline();
  for (auto* list : {&cycle_.checks, &cycle_.body})
    for (ir::CycleStatement& statement : *list)
      statement.origin.place = 0;
  dropUnread();
  ir::fold(cycle_, {});
  const std::map<ir::VariableId, ir::VariableId> names = compact(cycle_);
  Lowered out{std::move(cycle_), {}, {}, {}, macroCalls_};
  for (const auto& [id, letter] : letters_)
    out.letters.emplace(names.at(id), letter);
  return out;
}

std::optional<Lowered> lower(const File& file, const SourceMap& sources, Diagnostics& diagnostics,
                             const CallForms& forms) {
  Programs programs;
  Lowering lowering(file, sources, diagnostics);
  lowering.callPrograms(programs, forms.programLevels);
  lowering.callMacros(forms.macros);
  std::optional<Lowered> out = lowering.run();
  if (!out) return std::nullopt;
  out->programs = std::move(programs.list);
  out->inPlace = std::move(programs.inPlace);
  return out;
}

} // namespace dotek::frontend::cycle
