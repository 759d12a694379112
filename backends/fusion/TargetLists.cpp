#include "backends/fusion/TargetLists.h"

#include "backends/fusion/Emit.h"
#include "frontend/gibbs/Ast.h"
#include "support/Decimal.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace dotek::targets {

namespace fusion = backends::fusion;

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

} // namespace dotek::targets
