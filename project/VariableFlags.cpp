#include "project/VariableFlags.h"

#include "support/Decimal.h"
#include "support/messages/Sim.h"

#include <charconv>

namespace dotek::project {

std::vector<std::pair<std::uint32_t, double>> variablesOf(const NamedTexts& given, Diagnostics& diagnostics) {
  std::vector<std::pair<std::uint32_t, double>> out;
  for (const auto& [name, text] : given) {
    const std::string_view digits = name.starts_with('#') ? std::string_view(name).substr(1) : name;
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const std::optional<double> value = parseNumber(text);
    if (error != std::errc() || end != digits.data() + digits.size() || number == 0)
      diagnostics.report<diag::VariableFlag>({}, name + "=" + text, "it takes NUMBER=VALUE");
    else if (!value)
      diagnostics.report<diag::VariableFlag>({}, name + "=" + text, "the value is no number");
    else
      out.emplace_back(number, *value);
  }
  return out;
}

} // namespace dotek::project
