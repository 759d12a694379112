#include "sim/run/SetupRun.h"

#include "sim/machine/Trace.h"
#include "stdlib/MacroSet.h"
#include "stdlib/SetupDatum.h"
#include "support/Ascii.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::sim {

bool prepare(const Setup& setup, const std::optional<std::array<double, 3>>& part, Machine& machine,
             Diagnostics& diagnostics) {
  const auto refuse = [&](std::string_view flag, const std::string& why) {
    diagnostics.report<diag::SetupFlag>({}, flag, why);
    return false;
  };
  const auto most = static_cast<std::uint32_t>(machine.control().variables.toolCount);
  const auto put = [&](std::uint32_t number, double length) {
    if (number > most)
      return refuse("--tool", fmt::format("`{}` has tool offsets up to {}", machine.control().name, most));
    machine.setToolLength(number, length);
    return true;
  };
  for (const auto& [number, length] : setup.tools)
    if (!put(number, length)) return false;
  if (setup.tool) {
    if (setup.length && !put(*setup.tool, *setup.length)) return false;
    if (machine.toolLengthOf(*setup.tool) == 0)
      return refuse("--tool",
                    fmt::format("how long tool {} is, is not known; `--length 120` says it in mm, or "
                                "`length` of [probe] in a machine's file (`--machine`)",
                                *setup.tool));
    machine.putTool(*setup.tool);
  }
  for (const Setup::Zero& zero : setup.zeros) {
    if (zero.system == stdlib::kDatum) {
      if (machine.dialect().firstParameter) continue; // its program places it
      return refuse(
          "datum` of `[setup]",
          "it is for programs of Mikroprog; `work_offset = { G54 = [X, Y, Z] }` sets a work system");
    }
    if (zero.ofPart && !part)
      return refuse(
          "--work-offset",
          fmt::format("G{} is to be where the part is, and there is none; `--part PART.toml` names it",
                      54 + zero.system));
    Position place{};
    std::copy_n((zero.ofPart ? *part : zero.place).begin(), 3, place.begin());
    machine.setZero(zero.system, place);
  }
  return true;
}

bool activate(std::uint32_t system, Machine& machine, Diagnostics& diagnostics) {
  const std::uint32_t tenths = 10 * (54 + system);
  const stdlib::Control& control = machine.control();
  const stdlib::CodeInfo* const code = control.find('G', tenths);
  if (code == nullptr && !control.codes.empty()) {
    diagnostics.report<diag::SetupFlag>({}, "--active-system",
                                        fmt::format("`{}` has no G{}", control.name, 54 + system));
    return false;
  }
  if (code != nullptr && code->group) machine.presetModal(static_cast<std::uint32_t>(*code->group), tenths);
  return machine.selectSystem({system, false});
}

std::optional<Position> startOf(const Setup& setup, const Machine& machine, double probe) {
  if (!setup.at) return std::nullopt;
  Position out = machine.zeroOf(machine.activeSystem().index);
  for (std::size_t i = 0; i < 3; ++i)
    out[i] += (*setup.at)[i];
  out[2] += setup.tool ? machine.toolLengthOf(*setup.tool) : probe;
  return out;
}

bool startsWithinTravel(const Setup& setup, double probe, std::string_view saidBy, bool leftOut,
                        const MachineLimits& limits, const Machine& machine, Diagnostics& diagnostics) {
  const std::optional<Position> start = startOf(setup, machine, probe);
  if (!start) return true;
  const std::uint32_t system = machine.activeSystem().index;
  const std::string name = fmt::format("G{}", 54 + system);
  bool within = true;
  for (std::size_t axis = 0; axis < limits.travel.size(); ++axis) {
    const std::optional<double> end = limits.endBefore(axis, (*start)[axis]);
    if (!end) continue;
    const auto value = [&](double place) { return kAxisLetters[axis] + fixedText(place, 3); };
    diagnostics.report<diag::SetupFlag>(
        {}, saidBy,
        fmt::format(
            "it puts the spindle to machine {}, and the travel ends at {}; the place counts from the "
            "zero of {}{}, and the tool's length is added to it",
            value((*start)[axis]), value(*end), name,
            machine.zeroOf(system) == Position{} && !leftOut
                ? fmt::format(", which nothing has set (`--work-offset {}=part` puts it where the part "
                              "is)",
                              name)
                : ""));
    within = false;
  }
  return within;
}

bool isCall(const Setup& setup, Diagnostics& diagnostics) {
  const std::string_view text = setup.call;
  std::string meant;
  bool slips = false, known = true;
  int depth = 0; // of brackets
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '(') { // a comment
      const std::size_t end = std::min(text.find(')', at), text.size() - 1);
      meant += text.substr(at, end + 1 - at);
      at = end;
      continue;
    }
    depth += c == '[' ? 1 : c == ']' ? -1 : 0;
    if (depth != 0 || (c != '=' && c != ',')) {
      meant += c;
      continue;
    }
    slips = true;
    if (c == ',') {
      if (at + 1 < text.size() && text[at + 1] != ' ') meant += ' ';
      continue;
    }
    while (meant.ends_with(' '))
      meant.pop_back();
    std::size_t digits = meant.size();
    while (digits > 0 && isDigit(meant[digits - 1]))
      --digits;
    if (digits == 0 || digits == meant.size() || meant[digits - 1] != '#') continue; // D=25.
    const char letter =
        meant.size() - digits <= 2
            ? stdlib::letterOfLocal(static_cast<std::uint32_t>(std::stoul(meant.substr(digits))))
            : '\0';
    known = known && letter != 0;
    meant.erase(digits - 1);
    meant += letter;
  }
  if (!slips) return true;
  diagnostics.report<diag::SetupFlag>(
      {}, "--call",
      "arguments are letters with their values, without `=` and `,`" +
          (known ? fmt::format("; write `--call \"{}\"`", meant)
                 : std::string(", and no letter sets some of these variables")));
  return false;
}

std::string callingProgram(const Setup& setup, std::uint64_t number, const Machine& machine,
                           const Position& start) {
  std::string out = "(MADE BY DOTEK FOR --call)\n";
  if (setup.tool) {
    const double zero = machine.zeroOf(machine.activeSystem().index)[2];
    const double z = start[2] - zero - machine.toolLengthOf(*setup.tool);
    out += fmt::format("G90 G0 G43 H{} Z{}\n", *setup.tool, fixedText(z, machine.control().decimals));
  }
  // As it is written in a program, too: `G65 P9103 D25.`
  std::string arguments = setup.call;
  for (const std::string& prefix : {std::string("G65"), fmt::format("P{}", number)}) {
    const std::size_t begin = arguments.find_first_not_of(' ');
    if (begin != std::string::npos &&
        upperCase(std::string_view(arguments).substr(begin, prefix.size())) == prefix &&
        (begin + prefix.size() == arguments.size() || !isDigit(arguments[begin + prefix.size()])))
      arguments.erase(0, begin + prefix.size());
  }
  return out + fmt::format("G65 P{} {}\nM30\n", number, arguments);
}

} // namespace dotek::sim
