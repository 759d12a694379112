#include "stdlib/FusionNames.h"

#include "stdlib/Toml.h"

namespace dotek::stdlib {

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
  for (const TomlTable& table : root.value("family").tables()) {
    Family& family = out.families.emplace_back();
    family.name = table.value("name").text();
    family.names = table.value("names").texts();
    out.all.insert(family.names.begin(), family.names.end());
  }
  static_cast<void>(document.finish());
  return out;
}

} // namespace dotek::stdlib
