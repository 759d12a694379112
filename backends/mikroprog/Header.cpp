// What is above the blocks: cycle, control, values, what the program relies on, what is dropped.
#include "backends/common/PlainText.h"
#include "backends/mikroprog/State.h"
#include "stdlib/HostInputs.h"
#include "support/Decimal.h"

#include <fmt/format.h>

namespace dotek::backends::mikroprog {

namespace {

constexpr std::size_t kWidth = 70;

void add(std::vector<std::string>& out, const std::string& text) {
  for (const std::string& line : wrapWords(plainText(text).text, kWidth))
    out.push_back(";" + line);
}

} // namespace

std::vector<std::string> headerLines(const State& state) {
  const EmitOptions& options = state.options;
  std::vector<std::string> out;
  add(out, "CYCLE " + state.cycle.name + (state.cycle.title.empty() ? "" : ": " + state.cycle.title));
  add(out, "FOR " + state.control.title);
  if (!options.values.empty()) add(out, "VALUES OF THE FIELDS:");
  for (const NamedValue& value : options.values)
    add(out, fmt::format("  {} = {} ({})", value.name, numberText(value.value), value.from));
  bool any = false;
  for (const stdlib::HostInput& host : stdlib::kHostInputs) {
    const auto given = options.hosts.find(std::string(host.name));
    if (given == options.hosts.end()) continue;
    if (!any) add(out, "GIVEN WITH --host OR BY A JOB:");
    any = true;
    add(out, fmt::format("  {} = {}", host.name, numberText(given->second)));
  }
  if (!state.relied.empty()) add(out, "RELIES ON WHAT NO SOURCE STATES (docs/mikroprog.md):");
  for (const std::uint32_t number : state.relied)
    add(out, fmt::format("  Q{}: {}", number, state.control.question(number)->title));
  if (!state.remarks.empty()) add(out, "DROPPED OR CHANGED:");
  for (const std::string& remark : state.remarks)
    add(out, "  " + remark);
  return out;
}

} // namespace dotek::backends::mikroprog
