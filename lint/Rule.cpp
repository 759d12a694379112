#include "lint/Rule.h"

#include "lint/Page.h"

#include <algorithm>
#include <vector>

namespace dotek::lint {

std::string_view tierName(Tier tier) {
  switch (tier) {
  case Tier::Text: return "text";
  case Tier::Syntax: return "syntax";
  case Tier::Ir: return "ir";
  case Tier::Bundle: return "bundle";
  }
  return "";
}

const NamedRule* findRule(std::string_view id) {
  const auto all = rules();
  const auto found = std::lower_bound(
      all.begin(), all.end(), id, [](const NamedRule& rule, std::string_view key) { return rule.id < key; });
  return found != all.end() && found->id == id ? &*found : nullptr;
}

std::string summaryOf(const CodeInfo& info) {
  return firstSentence(info.rule != nullptr ? proseOf(pageOf(info.code)) : std::string(info.explanation));
}

std::span<const CodeInfo> codeTable() {
  static const std::vector<CodeInfo> kTable = [] {
    std::vector<CodeInfo> table;
    for (const MessageInfo& info : messageTable())
      table.push_back({info.code, info.severity, true, nullptr, info.explanation});
    for (const NamedRule& named : rules())
      table.push_back({named.id, named.rule->severity, named.rule->byDefault, named.rule, {}});
    std::sort(table.begin(), table.end(),
              [](const CodeInfo& a, const CodeInfo& b) { return a.code < b.code; });
    return table;
  }();
  return kTable;
}

} // namespace dotek::lint
