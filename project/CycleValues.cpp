#include "project/CycleValues.h"

#include "frontend/cycle/Link.h"
#include "support/Decimal.h"
#include "support/NearestName.h"
#include "support/messages/Commands.h"
#include "support/messages/Sim.h"

#include <cmath>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace dotek::project {

namespace cycle = frontend::cycle;

namespace {

constexpr double kInch = 25.4;

struct Measured {
  double value = 0;
  std::string unit; // as written
};

// A number, and what follows it; nothing: it begins with none.
std::optional<Measured> measured(std::string_view text) {
  std::size_t end = text.find_first_not_of("+-.0123456789");
  if (end == std::string_view::npos) end = text.size();
  const std::optional<double> value = parseNumber(text.substr(0, end));
  while (end < text.size() && text[end] == ' ')
    ++end;
  if (!value) return std::nullopt;
  return Measured{*value, std::string(text.substr(end))};
}

// Factors of the units of a kind.
std::optional<double> withUnit(std::string_view text,
                               std::initializer_list<std::pair<std::string_view, double>> units) {
  const auto number = measured(text);
  if (!number) return std::nullopt;
  if (number->unit.empty()) return number->value;
  for (const auto& [unit, factor] : units)
    if (number->unit == unit) return number->value * factor;
  return std::nullopt;
}

std::optional<double> whole(std::string_view text, double least, double most) {
  const std::optional<double> value = parseNumber(text);
  if (!value || *value != std::floor(*value) || *value < least || *value > most) return std::nullopt;
  return value;
}

} // namespace

std::optional<double> cycleValue(const cycle::Type& type, std::string_view text, std::string& wants) {
  using cycle::TypeName;
  switch (type.name) {
  case TypeName::Length:
    wants = "a length: `5`, `5mm` or `0.2in`";
    return withUnit(text, {{"mm", 1}, {"in", kInch}});
  case TypeName::Angle: wants = "an angle: `30` or `30deg`"; return withUnit(text, {{"deg", 1}});
  case TypeName::Feed:
    wants = "a feed: `500`, `500mm/min` or `20in/min`";
    return withUnit(text, {{"mm/min", 1}, {"in/min", kInch}});
  case TypeName::Time: wants = "a time: `0.5` or `0.5s`"; return withUnit(text, {{"s", 1}});
  case TypeName::Count: wants = "a whole number, without a unit"; return whole(text, -1e9, 1e9);
  case TypeName::Ratio: wants = "a number without a unit"; return parseNumber(text);
  case TypeName::Flag:
    wants = "`yes` or `no`";
    if (text == "yes" || text == "1") return 1;
    if (text == "no" || text == "0") return 0;
    return std::nullopt;
  case TypeName::WorkOffset: {
    wants = "a work offset, `G54` to `G59`";
    if (!text.empty() && (text[0] == 'G' || text[0] == 'g')) text.remove_prefix(1);
    return whole(text, 54, 59);
  }
  case TypeName::ToolOffset:
    wants = "the number of a tool offset, 1 or more";
    if (!text.empty() && (text[0] == 'T' || text[0] == 't')) text.remove_prefix(1);
    return whole(text, 1, 999);
  case TypeName::Choice:
    wants = "one of";
    for (std::size_t i = 0; i < type.choices.size(); ++i) {
      wants += fmt::format("{} `{}`", i == 0 ? "" : ",", type.choices[i].text);
      if (type.choices[i].text == text) return static_cast<double>(i + 1);
    }
    return std::nullopt;
  case TypeName::Text: wants = "nothing: no caller can give a text"; return std::nullopt;
  }
  return std::nullopt;
}

std::map<std::string, double> cycleValues(const cycle::File& file, const NamedTexts& given,
                                          Diagnostics& diagnostics) {
  std::map<std::string, const cycle::Type*> types;
  std::vector<std::string_view> names;
  for (const cycle::Statement* const statement : cycle::declarations(file))
    if (const auto* parameter = std::get_if<cycle::Parameter>(&statement->node))
      for (const cycle::Name& name : parameter->names) {
        types.emplace(name.text, &parameter->type);
        names.push_back(name.text);
      }
  std::map<std::string, double> out;
  for (const auto& [name, text] : given) {
    const auto type = types.find(name);
    if (type == types.end()) {
      const std::string near = nearestName(name, names);
      diagnostics.report<diag::NoSuchParameter>({}, name, file.header() ? file.header()->name.text : "",
                                                near.empty() ? "" : "; did you mean `" + near + "`?");
      continue;
    }
    std::string wants;
    const std::optional<double> value = cycleValue(*type->second, text, wants);
    if (!value) {
      diagnostics.report<diag::ParameterValue>(
          {}, name, text,
          text.find(',') != std::string::npos ? "a decimal point, and flags of their own for several values"
                                              : wants);
      continue;
    }
    if (!out.emplace(name, *value).second) diagnostics.report<diag::GivenTwice>({}, "--set", name);
  }
  return out;
}

} // namespace dotek::project
