#include "stdlib/KeywordLists.h"

#include "stdlib/GibbsTables.h"
#include "stdlib/StoredTables.h"

#include <algorithm>

namespace dotek::stdlib {

namespace {

std::string usageOf(const std::vector<CommandSignature>& signatures) {
  return signatures.empty() ? "" : textOf(signatures.front());
}

void sortByName(std::vector<ListedWord>& words) {
  std::sort(words.begin(), words.end(),
            [](const ListedWord& a, const ListedWord& b) { return a.name < b.name; });
}

} // namespace

std::string textOf(const CommandSignature& signature) {
  std::string out = signature.name;
  for (const ArgumentSpec& argument : signature.arguments) {
    out += out == signature.name ? " " : ", ";
    std::string name = argument.name;
    if (name.empty()) name = argument.family;
    for (const std::string& keyword : argument.keywords)
      name += (name.empty() ? "" : "|") + keyword;
    out += argument.optional ? "[" + name + "]" : name;
  }
  return out;
}

std::vector<ListedWord> TableStore::listOf(const ComPostKeywords& keywords) {
  std::vector<ListedWord> out;
  for (const auto& [name, one] : keywords.keywords_) {
    const std::string suffix = one.kind == KeywordKind::Numeric   ? "#"
                               : one.kind == KeywordKind::Boolean ? "?"
                                                                  : "";
    out.push_back({name + suffix, one.summary, ListedWord::Kind::Keyword, one.argument});
  }
  return out;
}

std::vector<ListedWord> TableStore::listOf(const GibbsKeywords& keywords) {
  std::vector<ListedWord> out;
  const GibbsKeywords::Tables& tables = *keywords.tables_;
  for (const auto& [name, command] : tables.commands)
    out.push_back({name, usageOf(command.signatures), ListedWord::Kind::Keyword, false});
  for (const std::string& word : tables.coreWords)
    out.push_back({word, "", ListedWord::Kind::Keyword, false});
  for (const auto& [name, function] : tables.functions)
    out.push_back({name, function.note, ListedWord::Kind::Function, false});
  for (const auto& [folded, name] : tables.variables)
    out.push_back({name, "set by GibbsCAM", ListedWord::Kind::Variable, false});
  for (const auto& [folded, name] : tables.constants)
    out.push_back({name, "constant", ListedWord::Kind::Variable, false});
  for (const auto& [name, control] : tables.controls)
    out.push_back({name, usageOf(control.signatures), ListedWord::Kind::Control, false});
  sortByName(out);
  return out;
}

std::vector<ListedWord> TableStore::parametersOf(const GibbsKeywords& keywords, std::string_view family) {
  std::vector<ListedWord> out;
  const auto found = keywords.tables_->families.find(upperCase(family));
  if (found == keywords.tables_->families.end()) return out;
  for (const auto& [name, kind] : found->second.parameters)
    out.push_back({name, std::string(textOf(kind)), ListedWord::Kind::Keyword, false});
  sortByName(out);
  return out;
}

std::string_view textOf(ParameterKind kind) {
  switch (kind) {
  case ParameterKind::Number: return "number";
  case ParameterKind::Text: return "text";
  case ParameterKind::Mixed: return "number or text";
  case ParameterKind::Keyword: break;
  }
  return "word without a value";
}

std::vector<ListedWord> parametersOf(const GibbsKeywords& keywords, std::string_view family) {
  return TableStore::parametersOf(keywords, family);
}

std::vector<ListedWord> listOf(const ComPostKeywords& keywords) {
  return TableStore::listOf(keywords);
}

std::vector<ListedWord> listOf(const GibbsKeywords& keywords) {
  return TableStore::listOf(keywords);
}

} // namespace dotek::stdlib
