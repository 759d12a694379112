#include "backends/fusion/TargetLists.h"

#include "backends/fusion/Emit.h"
#include "frontend/gibbs/Ast.h"
#include "frontend/gibbs/Lower.h"
#include "support/Decimal.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <set>
#include <string_view>

namespace dotek::targets {

namespace fusion = backends::fusion;

namespace {

std::set<std::string> wordsOf(std::string_view text) {
  std::set<std::string> out;
  std::string word;
  for (const char c : std::string(text) + " ") {
    if ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c & 0x80) != 0) {
      word += c;
      continue;
    }
    // Not `to` and `pa`, which are in any title.
    if (word.size() > 2 || word.find_first_of("0123456789") != std::string::npos)
      out.insert(frontend::gibbs::foldCase(word));
    word.clear();
  }
  return out;
}

std::size_t shared(const std::set<std::string>& words, std::string_view text) {
  const std::set<std::string> others = wordsOf(text);
  return static_cast<std::size_t>(std::count_if(
      words.begin(), words.end(), [&](const std::string& one) { return others.contains(one); }));
}

} // namespace

void compareLists(const std::map<std::string, std::vector<DialogChoice>>& lists,
                  const fusion::RunResult& result, const std::string& prefix, TargetRun& out) {
  using frontend::gibbs::foldCase;
  for (const auto& [name, list] : lists) {
    const std::string property = foldCase(fusion::propertyOf(prefix, name));
    const auto folded = [&](const auto& one) { return foldCase(one.first) == property; };
    const auto found = std::find_if(result.offered.begin(), result.offered.end(), folded);
    if (found == result.offered.end() || !out.differences.empty()) continue;
    const auto titled = [&](double value, const std::string* title) {
      return std::find_if(found->second.begin(), found->second.end(), [&](const auto& one) {
        const std::optional<double> id = parseNumber(one.first);
        return id && *id == value && (title == nullptr || one.second == *title);
      });
    };
    for (const DialogChoice& choice : list) {
      if (titled(choice.value, &choice.title) != found->second.end()) continue;
      const auto other = titled(choice.value, nullptr);
      const std::string value = numberText(choice.value);
      out.differs(verify::Aspect::Variable,
                  other == found->second.end()
                      ? fmt::format("the list of `{}` does not offer {}, `{}` of the source", found->first,
                                    value, choice.title)
                      : fmt::format("the list of `{}` calls {} `{}` against `{}`, as the source has it",
                                    found->first, value, other->second, choice.title));
      break;
    }
  }
}

void compareTitles(const std::vector<verify::DrawField>& fields, const project::CycleFolder& folder,
                   const SourceMap& sources, const fusion::RunResult& result, const std::string& prefix,
                   TargetRun& out) {
  namespace gibbs = frontend::gibbs;
  if (folder.cycle == nullptr || !out.differences.empty()) return;
  std::map<std::string, std::string> meanings; // by name of the field, in one case; without one the name
  for (const ir::Variable& field : gibbs::declareCycle(*folder.cycle, sources).variables)
    meanings[gibbs::foldCase(field.name)] = field.meaning.empty() ? field.name : field.meaning;
  for (const verify::DrawField& field : fields) {
    const std::string own = gibbs::foldCase(field.name);
    const std::string property = gibbs::foldCase(fusion::propertyOf(prefix, field.name));
    const auto title = std::find_if(result.titles.begin(), result.titles.end(),
                                    [&](const auto& one) { return gibbs::foldCase(one.first) == property; });
    const auto meaning = meanings.find(own);
    if (title == result.titles.end() || (meaning != meanings.end() && meaning->second == title->second))
      continue;
    // Who edits a title words it otherwise; a title of other words of the dialog is another field's.
    const std::set<std::string> words = wordsOf(title->second);
    const std::size_t mine = meaning == meanings.end() ? 0 : shared(words, meaning->second);
    for (const auto& [name, text] : meanings)
      if (name != own && (text == title->second || shared(words, text) > mine)) {
        out.differs(
            verify::Aspect::Variable,
            text == title->second
                ? fmt::format("the property of `{}` has the title `{}`, which the dialog gives to `{}`",
                              field.name, text, name)
                : fmt::format("the title `{}` of the property of `{}` is nearer to what the dialog says of "
                              "`{}`: `{}`",
                              title->second, field.name, name, text));
        return;
      }
  }
}

} // namespace dotek::targets
