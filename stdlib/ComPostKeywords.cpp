#include "stdlib/ComPostKeywords.h"

#include "stdlib/DataFiles.h"
#include "stdlib/StoredTables.h"
#include "stdlib/Toml.h"
#include "support/NearestName.h"

#include <fmt/format.h>

namespace dotek::stdlib {
namespace {

constexpr std::pair<std::string_view, KeywordKind> kKinds[] = {
    {"flow", KeywordKind::Flow},           {"command", KeywordKind::Command},
    {"numeric", KeywordKind::Numeric},     {"boolean", KeywordKind::Boolean},
    {"directive", KeywordKind::Directive}, {"sequence", KeywordKind::Sequence}};

KeywordKind kindOf(const std::string& name) {
  for (const auto& [text, kind] : kKinds) {
    if (text == name) return kind;
  }
  return KeywordKind::Command;
}

char suffixOf(KeywordKind kind) {
  if (kind == KeywordKind::Numeric) return '#';
  return kind == KeywordKind::Boolean ? '?' : '\0';
}

} // namespace

ComPostKeywords TableStore::readComPost(const DataFiles& files) {
  const DataFile* file = files.find("keywords", "compost");
  if (file == nullptr) throw DataError("keywords/compost.toml is missing");
  const TomlDocument document = TomlDocument::parse(*file);
  const TomlTable root = document.root();
  root.value("language").choice({"compost"});

  ComPostKeywords keywords;
  const auto gradeAndSource = [](const TomlTable& table, std::string& source) {
    source = table.require("source", "where the fact comes from").text();
    return table.require("grade", "D, O, I or U").choice({"D", "O", "I", "U"})[0];
  };
  for (const TomlTable& table : root.value("keyword").tables()) {
    ComPostKeyword keyword;
    keyword.kind = kindOf(table.require("kind", "a kind")
                              .choice({"flow", "command", "numeric", "boolean", "directive", "sequence"}));
    keyword.argument = table.value("argument").flag();
    const std::string prints = table.require("prints", "yes, no or maybe").choice({"yes", "no", "maybe"});
    keyword.prints = prints == "yes" ? Prints::Yes : prints == "no" ? Prints::No : Prints::Maybe;
    keyword.grade = gradeAndSource(table, keyword.source);
    keyword.summary = table.require("summary", "what it does").text();

    const TomlValue place = table.require("name", "a keyword");
    keyword.name = place.text();
    const char suffix = suffixOf(keyword.kind);
    const bool marked =
        keyword.name.size() > 1 && (keyword.name.ends_with('#') || keyword.name.ends_with('?'));
    if (marked != (suffix != '\0') || (marked && keyword.name.back() != suffix))
      document.fail(
          place.range(),
          fmt::format(
              "the suffix of `{}` does not fit its kind: a numeric keyword ends in #, a boolean one in ?, "
              "others in none",
              keyword.name));
    if (marked) keyword.name.pop_back();
    const std::string name = keyword.name;
    if (!keywords.keywords_.emplace(name, std::move(keyword)).second)
      document.fail(place.range(), fmt::format("`{}` is given twice", name));
  }
  if (const TomlValue entries = root.value("entry_points")) {
    const TomlTable table = entries.table();
    std::string source;
    gradeAndSource(table, source);
    for (const std::string& name : table.require("names", "a list of routines").texts())
      keywords.entryPoints_.insert(name);
  }
  document.finish();
  return keywords;
}

const ComPostKeyword* ComPostKeywords::find(std::string_view name) const {
  const auto at = keywords_.find(name);
  return at == keywords_.end() ? nullptr : &at->second;
}

std::string ComPostKeywords::caseVariant(std::string_view name) const {
  for (const auto& [known, unused] : keywords_) {
    if (known != name && known.size() == name.size() && nameDistance(known, name, 0) == 0) return known;
  }
  return "";
}

std::string ComPostKeywords::nearest(std::string_view name) const {
  return nearestName(name, keywords_);
}

bool ComPostKeywords::isEntryPoint(std::string_view name) const {
  return entryPoints_.contains(name);
}

} // namespace dotek::stdlib
