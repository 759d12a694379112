#include "driver/LintFix.h"

#include "support/FileIdentity.h"
#include "support/Files.h"
#include "support/Output.h"

#include <algorithm>

namespace dotek::driver {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool meet(const Edit& a, const Edit& b) {
  if (a.range.file != b.range.file) return false;
  if (a.range.begin == b.range.begin) return true;
  return a.range.begin < b.range.end && b.range.begin < a.range.end;
}

} // namespace

std::map<std::string, std::uint32_t> applySafeFixes(const Outcome& outcome, const Limits& limits, bool force,
                                                    Diagnostics& diagnostics) {
  std::vector<Edit> edits;
  std::map<std::string, std::uint32_t> made;
  // A file that was read under two names is mended under the first.
  std::map<FileIdentity, std::string> names;
  const auto isOther = [&](FileId file) {
    const std::string& name = outcome.sources.file(file).name();
    const auto identity = identify(name);
    return identity && names.try_emplace(*identity, name).first->second != name;
  };
  for (const Diagnostic& d : outcome.diagnostics.all()) {
    if (!d.fix || d.fix->applicability != Fix::Applicability::Safe || isOther(d.range.file)) continue;
    const std::string& name = outcome.sources.file(d.range.file).name();
    if (name == inputName("-") || isStream(name)) continue; // there is nothing to write to
    const bool clashes = std::any_of(d.fix->edits.begin(), d.fix->edits.end(), [&](const Edit& edit) {
      return std::any_of(edits.begin(), edits.end(), [&](const Edit& other) { return meet(edit, other); });
    });
    if (clashes) continue;
    edits.insert(edits.end(), d.fix->edits.begin(), d.fix->edits.end());
    ++made[outcome.sources.file(d.range.file).name()];
  }
  if (edits.empty()) return {};
  std::sort(edits.begin(), edits.end(),
            [](const Edit& a, const Edit& b) { return a.range.begin > b.range.begin; });
  std::map<std::string, std::string> texts;
  for (const Edit& edit : edits) {
    const SourceFile& file = outcome.sources.file(edit.range.file);
    const auto [at, added] = texts.try_emplace(file.name(), file.bytes());
    at->second.replace(edit.range.begin, edit.range.end - edit.range.begin, edit.text);
  }
  std::vector<NamedText> writes;
  for (auto& [name, text] : texts) {
    const auto before = readBytes(name, limits, diagnostics);
    if (!before) return {};
    if (before->starts_with(kByteOrderMark) && !text.starts_with(kByteOrderMark))
      text.insert(0, kByteOrderMark);
    writes.push_back({name, &text});
  }
  if (!writeAll(writes, "", {force, nullptr}, diagnostics)) return {};
  return made;
}

} // namespace dotek::driver
