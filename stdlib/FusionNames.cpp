#include "stdlib/FusionNames.h"

#include "stdlib/Toml.h"

#include <algorithm>

namespace dotek::stdlib {

namespace {

// The place in the list, a bit of its own, or the value of another name.
FusionNames::Family familyOf(const TomlDocument& document, const TomlTable& table) {
  FusionNames::Family out;
  out.name = table.value("name").text();
  static_cast<void>(table.value("grade").text());
  static_cast<void>(table.value("source").text());
  out.names = table.value("names").texts();
  const bool flags = table.value("flags").flag();
  std::map<std::string, std::string, std::less<>> alike;
  for (const TomlEntry& entry : table.value("alike").table().entries())
    alike[entry.key] = entry.value.text();
  std::map<std::string, std::uint32_t, std::less<>> values;
  for (const std::string& name : out.names) {
    if (alike.contains(name)) continue;
    const auto place = static_cast<std::uint32_t>(values.size());
    if (flags && place >= 31) document.fail(table.range(), "a family with `flags` has at most 31 names");
    values[name] = flags ? 1U << std::min(place, 31U) : place;
  }
  for (const std::string& name : out.names) {
    const auto other = alike.find(name);
    const auto value = values.find(other == alike.end() ? name : other->second);
    if (value == values.end())
      document.fail(table.range(), "`" + other->second + "` in `alike` is no name of the family");
    out.values.push_back(value == values.end() ? 0 : value->second);
  }
  return out;
}

} // namespace

FusionNames FusionNames::load(const DataFiles& files) {
  FusionNames out;
  const DataFile* const file = files.find("fusion", "names");
  if (file == nullptr) throw DataError("fusion/names.toml is not there");
  const TomlDocument document = TomlDocument::parse(*file);
  const TomlTable root = document.root();
  static_cast<void>(root.value("grade").text());
  static_cast<void>(root.value("source").text());
  const auto take = [&](std::string_view key, std::set<std::string, std::less<>>& into) {
    for (std::string& name : root.value(key).texts()) {
      out.all.insert(name);
      into.insert(std::move(name));
    }
  };
  take("entries", out.entries);
  take("hooks", out.hooks);
  take("functions", out.functions);
  take("variables", out.variables);
  take("classes", out.classes);
  take("javascript", out.javascript);
  take("valued", out.valued);
  take("absent", out.absent);
  for (const TomlTable& table : root.value("family").tables()) {
    const Family& family = out.families.emplace_back(familyOf(document, table));
    out.all.insert(family.names.begin(), family.names.end());
  }
  static_cast<void>(document.finish());
  return out;
}

} // namespace dotek::stdlib
