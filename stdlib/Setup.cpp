#include "stdlib/Setup.h"

#include "stdlib/SetupDatum.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::stdlib {

namespace {

constexpr double kFarthest = 20000; // mm
constexpr std::int64_t kMostTool = 999;

std::optional<std::array<double, 3>> point(const TomlDocument& document, const TomlValue& value) {
  const std::vector<double> numbers = value.numbers();
  if (numbers.size() == 3 &&
      std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::abs(n) <= kFarthest; }))
    return std::array{numbers[0], numbers[1], numbers[2]};
  if (value)
    document.fail(value.range(), fmt::format("[X, Y, Z] in mm is expected, each within {}", kFarthest));
  return std::nullopt;
}

std::optional<double> lengthOf(const TomlDocument& document, const TomlValue& value) {
  if (!value) return std::nullopt;
  const double out = value.number();
  if (!(std::abs(out) <= kFarthest))
    document.fail(value.range(), fmt::format("{} mm is no length of a tool", out));
  return out;
}

// [X, Z] of a lathe, [X, Y, Z] of a mill, or "part".
std::optional<Setup::Zero> readDatum(const TomlDocument& document, const TomlValue& value) {
  if (!value) return std::nullopt;
  if (value.isText()) {
    value.choice({"part"});
    return Setup::Zero{kDatum, true, {}};
  }
  const std::vector<double> numbers = value.numbers();
  const bool lathe = numbers.size() == 2;
  if ((lathe || numbers.size() == 3) &&
      std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::abs(n) <= kFarthest; }))
    return Setup::Zero{
        kDatum, false, {numbers[0], lathe ? kNoCoordinate : numbers[1], lathe ? numbers[1] : numbers[2]}};
  document.fail(value.range(),
                fmt::format("[X, Z] of a lathe, [X, Y, Z] of a mill or \"part\" is expected, in mm, each "
                            "within {}",
                            kFarthest));
  return std::nullopt;
}

} // namespace

std::string_view Setup::firstFlag() const {
  return tool             ? "--tool"
         : ballDiameter   ? "--diameter"
         : !zeros.empty() ? "--work-offset"
         : at             ? "--at"
         : !call.empty()  ? "--call"
                          : "";
}

void Setup::override(const Setup& other) {
  if (other.tool && other.tool != tool) length.reset(); // that of another tool
  if (other.tool) tool = other.tool;
  if (other.length) length = other.length;
  if (other.ballDiameter) ballDiameter = other.ballDiameter;
  if (other.at) at = other.at;
  if (!other.call.empty()) call = other.call;
  tools.insert(tools.end(), other.tools.begin(), other.tools.end());
  for (const Zero& zero : other.zeros) {
    std::erase_if(zeros, [&](const Zero& one) { return one.system == zero.system; });
    zeros.push_back(zero);
  }
}

std::optional<std::uint32_t> systemByName(std::string_view name) {
  if (name.size() != 3 || (name[0] != 'G' && name[0] != 'g') || name[1] != '5' || name[2] < '4' ||
      name[2] > '9')
    return std::nullopt;
  return static_cast<std::uint32_t>(name[2] - '4');
}

Setup readSetup(const TomlDocument& document, const TomlTable& table) {
  Setup out;
  if (const TomlValue tool = table.value("tool"))
    out.tool = static_cast<std::uint32_t>(tool.integer(1, 1, kMostTool));
  out.length = lengthOf(document, table.value("length"));
  if (out.length && !out.tool)
    document.fail(table.value("length").range(), "`length` is that of `tool`, which is missing");
  for (const TomlTable& one : table.value("tools").tables()) {
    const auto number = one.require("number", "the number of the tool's offset").integer(1, 1, kMostTool);
    const auto length = lengthOf(document, one.require("length", "what the offset says, mm"));
    if (out.length && out.tool == static_cast<std::uint32_t>(number))
      document.fail(
          one.value("number").range(),
          fmt::format("the length of tool {} is said twice: `length` beside `tool` says it, too", number));
    out.tools.emplace_back(static_cast<std::uint32_t>(number), length.value_or(0));
  }
  for (const TomlEntry& entry : table.value("work_offset").table().entries()) {
    const auto system = systemByName(entry.key);
    if (!system) {
      document.fail(entry.keyRange, fmt::format("`{}` is no work system; G54 to G59 are", entry.key));
      continue;
    }
    if (entry.value.isText()) {
      entry.value.choice({"part"});
      out.zeros.push_back({*system, true, {}});
    } else if (const auto place = point(document, entry.value)) {
      out.zeros.push_back({*system, false, *place});
    }
  }
  if (const auto datum = readDatum(document, table.value("datum"))) out.zeros.push_back(*datum);
  out.at = point(document, table.value("at"));
  out.call = table.value("call").text();
  return out;
}

} // namespace dotek::stdlib
