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

namespace {

// "#520" or "520"; nothing: it is none.
std::optional<std::uint32_t> numberOf(std::string_view text) {
  if (text.starts_with('#')) text.remove_prefix(1);
  std::uint32_t out = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc() || end != text.data() + text.size() || out == 0) return std::nullopt;
  return out;
}

std::string heading(std::string_view what, std::string_view name, std::uint32_t number) {
  return fmt::format("{} {} IN #{}", what, upperCase(name), number);
}

} // namespace

KeptResults keepResults(ir::Cycle& cycle, const NamedTexts& given, Diagnostics& diagnostics) {
  KeptResults out;
  std::map<std::string, std::uint32_t> wanted;
  for (const auto& [name, text] : given) {
    const std::optional<std::uint32_t> number = numberOf(text);
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
