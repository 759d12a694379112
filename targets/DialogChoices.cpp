#include "targets/DialogChoices.h"

#include "frontend/gibbs/Ast.h"

#include <optional>

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

} // namespace

std::map<ir::VariableId, std::vector<DialogChoice>>
dialogChoices(const project::CycleFolder& folder, const ir::Cycle& cycle, const SourceMap& sources) {
  std::map<ir::VariableId, std::vector<DialogChoice>> out;
  if (folder.cycle == nullptr || !folder.cycle->dialog) return out;
  const Encoding encoding = sources.file(folder.cycle->dialog->file).encoding();
  std::map<std::string, ir::VariableId> ids;
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
    if (cycle.variable(id).role == ir::Role::Parameter)
      ids.emplace(gibbs::foldCase(cycle.variable(id).name), id);
  std::vector<std::optional<ir::VariableId>> lists; // in the order of creation, which is their number
  for (const gibbs::Control& control : folder.cycle->dialog->controls) {
    const std::string kind = gibbs::foldCase(control.kind.text);
    const auto found = control.variable ? ids.find(gibbs::foldCase(control.variable->text)) : ids.end();
    if (kind == gibbs::foldCase("CHECK") && found != ids.end()) out[found->second] = {{0, "no"}, {1, "yes"}};
    if (kind == gibbs::foldCase("DROPDOWN_NEW"))
      lists.push_back(found == ids.end() ? std::nullopt : std::optional(found->second));
    if (kind != gibbs::foldCase("DROPDOWN_ADD") || control.arguments.size() != 3) continue;
    const auto list = numberOf(*control.arguments[0]);
    const auto value = numberOf(*control.arguments[2]);
    const auto* text = std::get_if<gibbs::TextLiteral>(&control.arguments[1]->node);
    if (!list || !value || text == nullptr || *list < 1 || *list > static_cast<double>(lists.size()))
      continue;
    if (const auto id = lists[static_cast<std::size_t>(*list) - 1])
      out[*id].push_back({*value, toUtf8(text->text, encoding)});
  }
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

} // namespace dotek::targets
