#include "frontend/gibbs/Cycle.h"

#include "frontend/gibbs/Check.h"

#include <map>

namespace dotek::frontend::gibbs {

namespace {

// The literal of a plain number, with at most one sign before it; nullptr for anything else.
const NumberLiteral* plainNumber(const Expression& expression) {
  const auto* unary = std::get_if<Unary>(&expression.node);
  return std::get_if<NumberLiteral>(unary != nullptr ? &unary->operand->node : &expression.node);
}

std::string_view assumptionOf(const Expression& expression) {
  const NumberLiteral* number = plainNumber(expression);
  if (number == nullptr || number->text.empty()) return {};
  if (number->text.find_first_of("eE") != std::string::npos) return "exponent";
  return number->text.front() == '.' || number->text.back() == '.' ? "bare-fraction" : std::string_view{};
}

} // namespace

std::optional<double> plainValue(const Expression& expression) {
  const NumberLiteral* number = plainNumber(expression);
  if (number == nullptr) return std::nullopt;
  const auto* unary = std::get_if<Unary>(&expression.node);
  const bool minus = unary != nullptr && unary->op == UnaryOperator::Minus;
  return minus && number->value != 0 ? -number->value : number->value;
}

std::vector<Field> declaredFields(const Cycle& cycle) {
  std::vector<Field> fields;
  std::map<std::string, std::size_t> index;
  const std::vector<InputLabel> labels =
      cycle.dialog ? inputLabels(*cycle.dialog) : std::vector<InputLabel>{};
  std::map<std::string, const InputLabel*> labelled; // the first of each variable
  for (const InputLabel& label : labels)
    labelled.try_emplace(foldCase(label.variable.text), &label);
  const auto add = [&](Field field) {
    const std::string key = foldCase(field.name.text);
    if (!index.try_emplace(key, fields.size()).second) return;
    if (const auto label = labelled.find(key); label != labelled.end()) field.label = *label->second;
    fields.push_back(std::move(field));
  };
  if (cycle.defineData)
    for (const Definition& definition : cycle.defineData->definitions)
      add({definition.name, plainValue(*definition.value), definition.valueRange, false, std::nullopt,
           assumptionOf(*definition.value)});
  for (const InputLabel& label : labels) {
    const Expression* initial = label.input->initial;
    const std::optional<double> value = initial == nullptr ? std::nullopt : plainValue(*initial);
    add({label.variable, value, initial == nullptr ? label.variable.range : initial->range, true,
         std::nullopt, initial == nullptr ? std::string_view() : assumptionOf(*initial)});
  }
  return fields;
}

} // namespace dotek::frontend::gibbs
