#include "targets/KeptResults.h"

#include "ir/CycleNames.h"
#include "support/Ascii.h"
#include "support/NearestName.h"
#include "support/messages/Cycle.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <map>
#include <optional>

namespace dotek::targets {

std::optional<std::uint32_t> resultNumber(std::string_view text) {
  if (text.starts_with('#')) text.remove_prefix(1);
  std::uint32_t out = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc() || end != text.data() + text.size() || out == 0) return std::nullopt;
  return out;
}

namespace {

std::string heading(std::string_view what, std::string_view name, std::uint32_t number) {
  return fmt::format("{} {} IN #{}", what, upperCase(name), number);
}

} // namespace

KeptResults keepResults(ir::Cycle& cycle, const NamedTexts& given, Diagnostics& diagnostics,
                        const std::function<std::optional<std::uint32_t>(const std::string& name)>& handed) {
  KeptResults out;
  std::map<std::string, std::uint32_t> wanted;
  for (const auto& [name, text] : given) {
    const std::optional<std::uint32_t> number = resultNumber(text);
    if (!number || !wanted.emplace(name, *number).second || !out.numbers.insert(*number).second)
      diagnostics.report<diag::CycleResultNumber>({}, name, text);
  }
  std::set<std::string> known;
  std::vector<ir::CycleStatement> body;
  for (ir::CycleStatement& statement : cycle.body) {
    const auto* call = std::get_if<ir::CallCycle>(&statement.node);
    const bool stored = call != nullptr && call->cycle == ir::kKeep;
    if (call == nullptr || (call->cycle != ir::kResults && !stored)) {
      body.push_back(std::move(statement));
      continue;
    }
    if (stored && std::any_of(call->arguments.begin(), call->arguments.end(),
                              [&](const auto& one) { return !wanted.contains(one.parameter); })) {
      for (const ir::CycleArgument& one : call->arguments)
        known.insert(one.parameter);
      body.push_back(std::move(statement)); // who writes the program refuses it
      continue;
    }
    for (const ir::CycleArgument& one : call->arguments) {
      const bool first = known.insert(one.parameter).second;
      const auto at = wanted.find(one.parameter);
      const auto back = handed == nullptr || stored ? std::nullopt : handed(one.parameter);
      if (back) {
        if (first) out.headings.push_back(heading("HANDS BACK", one.parameter, *back));
        body.push_back({ir::Store{ir::constant(*back), one.value}, statement.origin});
        continue;
      }
      if (at == wanted.end()) {
        if (first) out.lost.push_back(one.parameter);
        continue;
      }
      if (stored) out.stored.insert(at->second);
      if (first) out.headings.push_back(heading(stored ? "STORED" : "RESULT", one.parameter, at->second));
      body.push_back({ir::Store{ir::constant(at->second), one.value}, statement.origin});
    }
  }
  std::sort(out.lost.begin(), out.lost.end());
  cycle.body = std::move(body);
  for (const auto& [name, number] : wanted) {
    if (known.contains(name)) continue;
    const std::string near = nearestName(name, known);
    diagnostics.report<diag::CycleResultUnknown>({}, name, cycle.name,
                                                 near.empty() ? "" : "; did you mean `" + near + "`?");
  }
  return out;
}

} // namespace dotek::targets
