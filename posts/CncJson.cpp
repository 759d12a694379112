#include "posts/CncJson.h"

namespace dotek::posts::cnc {

std::string jsonOf(const Named& named) {
  if (const auto* text = std::get_if<std::string>(&named.value)) return jsonText(*text);
  if (const auto* whole = std::get_if<std::int32_t>(&named.value)) return std::to_string(*whole);
  if (const auto* real = std::get_if<double>(&named.value)) return jsonNumber(*real);
  return numbers(std::get<Double3>(named.value));
}

std::string step(std::string_view record, std::string_view member, const std::string& json) {
  JsonObject out;
  out.add("record", jsonText(record));
  if (!member.empty()) out.add(member, json);
  return out.text();
}

std::string parameterStep(const std::string& name, const std::string& json) {
  JsonObject out;
  out.add("record", jsonText("parameter"));
  out.add("name", jsonText(name));
  out.add("value", json);
  return out.text();
}

std::string objectOf(const Values& values) {
  JsonObject out;
  for (const auto& [name, json] : values.all())
    out.add(name, json);
  return out.text();
}

} // namespace dotek::posts::cnc
