#include "project/VariableFlags.h"

#include "support/Decimal.h"
#include "support/messages/Sim.h"

#include <charconv>
#include <fmt/format.h>
#include <string_view>

namespace dotek::project {
namespace {

// "500" or "#500"; nothing: it is no number of a variable.
std::optional<std::uint32_t> variableNumber(std::string_view name) {
  if (name.starts_with('#')) name.remove_prefix(1);
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size() || number == 0) return std::nullopt;
  return number;
}

} // namespace

std::vector<std::pair<std::uint32_t, double>> variablesOf(const NamedTexts& given, Diagnostics& diagnostics) {
  std::vector<std::pair<std::uint32_t, double>> out;
  for (const auto& [name, text] : given) {
    const std::optional<std::uint32_t> number = variableNumber(name);
    const std::optional<double> value = parseNumber(text);
    if (!number)
      diagnostics.report<diag::VariableFlag>({}, name + "=" + text, "it takes NUMBER=VALUE");
    else if (!value)
      diagnostics.report<diag::VariableFlag>({}, name + "=" + text, "the value is no number");
    else
      out.emplace_back(*number, *value);
  }
  return out;
}

std::vector<ShownVariable> shownVariablesOf(const NamedTexts& given, const stdlib::Control& control,
                                            Diagnostics& diagnostics) {
  std::vector<ShownVariable> out;
  for (const auto& [variable, text] : given) {
    const std::optional<std::uint32_t> number = variableNumber(variable);
    const std::size_t sign = text.find('=');
    ShownVariable one{number.value_or(0), text.substr(0, sign), std::nullopt};
    if (sign != std::string::npos) one.nominal = parseNumber(std::string_view(text).substr(sign + 1));
    const auto wrong = [&, flag = variable + "=" + text](std::string_view why) {
      diagnostics.report<diag::ShowFlag>({}, flag, why);
    };
    if (!number || one.name.empty())
      wrong("it takes NUMBER=NAME or NUMBER=NAME=NOMINAL, as in `100=DIAMETER=30`");
    else if (!control.isCommon(*number))
      wrong(fmt::format("#{} is no common variable of `{}`; a local one ends with its program, and work and "
                        "tool offsets that are written are in the table by themselves",
                        *number, control.name));
    else if (sign != std::string::npos && !one.nominal)
      wrong("the expected value is no number");
    else
      out.push_back(std::move(one));
  }
  return out;
}

} // namespace dotek::project
