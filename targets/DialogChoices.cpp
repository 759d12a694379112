#include "targets/DialogChoices.h"

#include "frontend/gibbs/Ast.h"
#include "ir/Fold.h"
#include "project/CycleCatalogue.h"
#include "project/CycleFiles.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dotek::targets {

namespace gibbs = frontend::gibbs;

namespace {

std::optional<double> numberOf(const gibbs::Expression& expression) {
  const auto* unary = std::get_if<gibbs::Unary>(&expression.node);
  const auto* number =
      std::get_if<gibbs::NumberLiteral>(unary != nullptr ? &unary->operand->node : &expression.node);
  if (number == nullptr) return std::nullopt;
  const bool minus = unary != nullptr && unary->op == gibbs::UnaryOperator::Minus;
  return minus && number->value != 0 ? -number->value : number->value;
}

std::string notInList(const std::string& name) {
  return name + " is not in its list";
}

bool isWhole(double value) {
  return value == std::trunc(value);
}

// Joined in pairs, as a condition nests no deeper than that.
ir::ConditionPtr oneOf(const ir::ExpressionPtr& value, const std::vector<double>& values) {
  if (values.size() == 1) return ir::compare(ir::Relation::Equal, value, ir::constant(values.front()));
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  return ir::join(ir::Connective::Or, oneOf(value, {values.begin(), half}),
                  oneOf(value, {half, values.end()}));
}

// An alarm of the checks where the parameter does not meet it.
void demand(ir::Cycle& cycle, ir::VariableId id, const ir::ConditionPtr& offered) {
  const ir::LabelId label = cycle.addLabel({"offered", {}});
  ir::Origin origin;
  if (cycle.variable(id).range.hasPlace()) origin.ranges.push_back(cycle.variable(id).range);
  origin.reason = "list of the dialog";
  cycle.checks.push_back({ir::Branch{offered, label}, origin});
  cycle.checks.push_back({ir::Alarm{notInList(cycle.variable(id).name)}, origin});
  cycle.checks.push_back({ir::Label{label}, origin});
}

} // namespace

ChoiceLists dialogChoices(const project::CycleFolder& folder, const SourceMap& sources) {
  ChoiceLists out;
  if (folder.cycle == nullptr || !folder.cycle->dialog) return out;
  const Encoding encoding = sources.file(folder.cycle->dialog->file).encoding();
  std::vector<std::string> lists; // in the order of creation, which is their number
  for (const gibbs::Control& control : folder.cycle->dialog->controls) {
    const std::string kind = gibbs::foldCase(control.kind.text);
    const std::string field = control.variable ? gibbs::foldCase(control.variable->text) : "";
    if (kind == gibbs::foldCase("CHECK") && !field.empty()) out[field] = {{0, "no"}, {1, "yes"}};
    if (kind == gibbs::foldCase("DROPDOWN_NEW")) lists.push_back(field);
    if (kind != gibbs::foldCase("DROPDOWN_ADD") || control.arguments.size() != 3) continue;
    const auto list = numberOf(*control.arguments[0]);
    const auto value = numberOf(*control.arguments[2]);
    const auto* text = std::get_if<gibbs::TextLiteral>(&control.arguments[1]->node);
    if (!list || !value || text == nullptr || *list < 1 || *list > static_cast<double>(lists.size()))
      continue;
    if (const std::string& name = lists[static_cast<std::size_t>(*list) - 1]; !name.empty())
      out[name].push_back({*value, toUtf8(text->text, encoding)});
  }
  return out;
}

std::map<ir::VariableId, std::vector<DialogChoice>>
dialogChoices(const project::CycleFolder& folder, const ir::Cycle& cycle, const SourceMap& sources) {
  std::map<ir::VariableId, std::vector<DialogChoice>> out;
  const auto offered = dialogChoices(folder, sources);
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    const auto list = cycle.variable(id).role == ir::Role::Parameter
                          ? offered.find(gibbs::foldCase(cycle.variable(id).name))
                          : offered.end();
    if (list != offered.end()) out.emplace(id, list->second);
  }
  return out;
}

ChoiceLists listsOfCycle(const std::string& file, const project::CommonOptions& options) {
  ChoiceLists out;
  project::Session session(options);
  project::CycleFiles files(session);
  const auto* const tree = files.linked(file);
  if (tree == nullptr) return out;
  for (const auto& row : project::cyclePage(*tree).parameters)
    if (std::vector<DialogChoice> choices = choicesOfType(row.kind); !choices.empty())
      out.emplace(gibbs::foldCase(row.name), std::move(choices));
  return out;
}

std::vector<DialogChoice> choicesOfType(std::string_view type) {
  constexpr std::string_view kChoice = "choice of ", kComma = ", ";
  if (type == "flag") return {{0, "no"}, {1, "yes"}};
  std::vector<DialogChoice> out;
  if (!type.starts_with(kChoice)) return out;
  type.remove_prefix(kChoice.size());
  while (!type.empty()) {
    const std::size_t comma = std::min(type.find(kComma), type.size());
    out.push_back({static_cast<double>(out.size() + 1), std::string(type.substr(0, comma))});
    type.remove_prefix(std::min(comma + kComma.size(), type.size()));
  }
  return out;
}

bool takesNoOther(ir::Kind kind, const std::vector<double>& offered) {
  constexpr std::size_t kSystems = 6;
  const std::set<double> values(offered.begin(), offered.end());
  return !values.empty() && values != std::set<double>{0, 1} &&
         (kind != ir::Kind::WorkOffset || values.size() != kSystems);
}

std::vector<double> besideList(const verify::DrawField& field) {
  if (!takesNoOther(field.kind, field.choices)) return {};
  const auto [least, most] = std::minmax_element(field.choices.begin(), field.choices.end());
  std::vector<double> out = {*most + 1, *least - 1};
  const double between = *least + 0.5;
  if (between < *most &&
      std::find(field.choices.begin(), field.choices.end(), between) == field.choices.end())
    out.push_back(between);
  return out;
}

std::string whyNotOffered(const std::vector<verify::DrawField>& fields, const verify::Case& drawn) {
  for (const verify::DrawField& field : fields) {
    const auto value = drawn.values.find(field.name);
    if (value != drawn.values.end() && takesNoOther(field.kind, field.choices) &&
        std::find(field.choices.begin(), field.choices.end(), value->second) == field.choices.end())
      return notInList(field.name);
  }
  return "";
}

void confineToLists(ir::Cycle& cycle, const std::map<ir::VariableId, std::vector<DialogChoice>>& choices,
                    Diagnostics& diagnostics) {
  constexpr std::size_t kFew = 3; // values
  for (const auto& [id, list] : choices) {
    std::set<double> values;
    for (const DialogChoice& one : list)
      values.insert(one.value);
    if (!ir::uses(cycle, id) || !takesNoOther(cycle.variable(id).kind, {values.begin(), values.end()}))
      continue;
    ir::Variable& variable = cycle.variables[id];
    if (variable.defaultValue && !values.contains(*variable.defaultValue)) {
      diagnostics.report<diag::DefaultTurnedAway>(
          variable.range, variable.name, numberText(*variable.defaultValue), notInList(variable.name));
      variable.defaultValue.reset();
    }
    const ir::ExpressionPtr value = ir::variable(id);
    const double least = *values.begin(), most = *values.rbegin();
    if (values.size() > kFew && most - least + 1 == static_cast<double>(values.size()) && isWhole(least)) {
      demand(cycle, id, ir::compare(ir::Relation::GreaterEqual, value, ir::constant(least)));
      demand(cycle, id, ir::compare(ir::Relation::LessEqual, value, ir::constant(most)));
      demand(cycle, id, ir::compare(ir::Relation::Equal, ir::unary(ir::UnaryOp::Truncate, value), value));
    } else {
      demand(cycle, id, oneOf(value, {values.begin(), values.end()}));
    }
  }
}

} // namespace dotek::targets
