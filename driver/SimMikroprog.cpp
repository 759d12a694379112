#include "driver/SimMikroprog.h"

#include "support/Decimal.h"
#include "support/messages/Commands.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::driver {

bool setParameters(const project::NamedTexts& given, const sim::mikroprog::Profile& profile,
                   sim::Machine& machine, Diagnostics& diagnostics) {
  bool all = true;
  for (const auto& [name, text] : given) {
    const std::optional<double> value = parseNumber(text);
    if (value && sim::mikroprog::preset(machine, profile, name, *value)) continue;
    diagnostics.report<diag::VariableFlag>(
        {}, name + "=" + text,
        value
            ? fmt::format("a program of `{}` takes parameters (P5=3), inputs and fields of the operator that "
                          "it has (O1=1, O20=0) and stored shifts of its axes (G52.Z=-12)",
                          profile.control.name)
            : std::string("the value is no number"));
    all = false;
  }
  return all;
}

std::optional<stdlib::Setup::Zero> takeDatum(stdlib::Setup& setup) {
  const auto at = std::find_if(setup.zeros.begin(), setup.zeros.end(),
                               [](const stdlib::Setup::Zero& one) { return one.system == kDatum; });
  if (at == setup.zeros.end()) return std::nullopt;
  const stdlib::Setup::Zero out = *at;
  setup.zeros.erase(at);
  return out;
}

bool placeDatum(const stdlib::Setup::Zero& datum, const stdlib::MikroprogControl& control,
                const std::optional<std::array<double, 3>>& part, sim::Machine& machine,
                Diagnostics& diagnostics) {
  const auto wrong = [&](const std::string& why) {
    diagnostics.report<diag::SetupFlag>({}, "--datum", why);
    return false;
  };
  if (datum.ofPart && !part)
    return wrong("it is to be where the part is, and there is none; `--part PART.toml` names it");
  const bool hasY = datum.place[1] != kNoCoordinate;
  if (!datum.ofPart && hasY != control.hasAxis('Y'))
    return wrong(fmt::format("`{}` takes {} numbers in mm of the machine, one for each of {}, or `part`",
                             control.name, control.axes.size(), control.axes));
  sim::Position zero{};
  std::copy_n((datum.ofPart ? *part : datum.place).begin(), 3, zero.begin());
  if (!datum.ofPart && !hasY) zero[1] = 0;
  machine.setZero(0, zero);
  return true;
}

} // namespace dotek::driver
