#include "driver/SimMikroprog.h"

#include "project/SufProgram.h"
#include "support/Decimal.h"
#include "support/Files.h"
#include "support/messages/Commands.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <filesystem>
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

bool placeDatum(const stdlib::Setup::Zero& datum, std::string_view saidBy,
                const stdlib::MikroprogControl& control, const std::optional<std::array<double, 3>>& part,
                sim::Machine& machine, Diagnostics& diagnostics) {
  const auto wrong = [&](const std::string& why) {
    diagnostics.report<diag::SetupFlag>({}, saidBy, why);
    return false;
  };
  if (datum.ofPart && !part)
    return wrong("it is to be where the part is, and there is none; `--part PART.toml` names it");
  const bool hasY = datum.place[1] != stdlib::kNoCoordinate;
  if (!datum.ofPart && hasY != control.hasAxis('Y'))
    return wrong(fmt::format("`{}` takes {} numbers in mm of the machine, one for each of {}, or `part`",
                             control.name, control.axes.size(), control.axes));
  sim::Position zero{};
  std::copy_n((datum.ofPart ? *part : datum.place).begin(), 3, zero.begin());
  if (!datum.ofPart && !hasY) zero[1] = 0;
  machine.setZero(0, zero);
  return true;
}

std::optional<OtherSufs> loadOthers(const std::string& path, const ir::Program& program,
                                    const stdlib::MikroprogControl& control, project::Session& session) {
  namespace fs = std::filesystem;
  OtherSufs out;
  if (isStream(path)) return out; // has no folder
  const fs::path folder = fs::path(path).parent_path();
  const std::string own = fs::path(path).filename().string();
  std::vector<const ir::Program*> open = {&program};
  for (std::size_t i = 0; i < open.size(); ++i)
    for (const std::string& name : sim::mikroprog::programsRunBy(*open[i], control)) {
      std::error_code error;
      const fs::path file = folder / name;
      if (out.byName.contains(name) || name.find_first_of("/\\:") != std::string::npos) continue;
      if (name == own) {
        out.byName.emplace(name, &program);
        continue;
      }
      if (!fs::is_regular_file(file, error)) continue;
      const std::optional<FileId> id = session.read(file.string(), Encoding::Cp852);
      auto other =
          id ? project::readSuf(*id, control, session.sources(), session.diagnostics()) : std::nullopt;
      if (!other) return std::nullopt;
      open.push_back(&out.programs.emplace_back(std::move(*other)));
      out.byName.emplace(name, open.back());
    }
  return out;
}

} // namespace dotek::driver
