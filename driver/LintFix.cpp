#include "driver/LintFix.h"

#include "support/FileIdentity.h"
#include "support/Files.h"
#include "support/Output.h"
#include "support/messages/Lint.h"

#include <algorithm>
#include <map>
#include <utility>

namespace dotek::driver {
namespace {

constexpr std::uint32_t kMostNotes = 20; // of one rule in a file

bool meet(const Edit& a, const Edit& b) {
  if (a.range.file != b.range.file) return false;
  if (a.range.begin == b.range.begin) return true;
  return a.range.begin < b.range.end && b.range.begin < a.range.end;
}

std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return text;
}

// Where a line of the file begins now; its end where it has fewer lines.
SourceRange placeOf(FileId id, const MadeFix& one, const SourceMap& sources) {
  const std::string_view text = sources.file(id).bytes();
  std::size_t at = 0;
  for (std::uint32_t line = 1; line < one.line && at < text.size(); ++line) {
    const std::size_t end = text.find('\n', at);
    at = end == std::string_view::npos ? text.size() : end + 1;
  }
  const std::size_t end = std::min(text.find('\n', at), text.size());
  const auto begin = static_cast<std::uint32_t>(std::min(at + one.column - 1, end));
  return {id, begin, begin};
}

std::string changed(const MadeFix& one) {
  if (one.before.empty()) return fmt::format("`{}` was put in", one.after);
  if (one.after.empty()) return fmt::format("`{}` was taken out", one.before);
  return fmt::format("`{}` -> `{}`", one.before, one.after);
}

} // namespace

void reportFixes(const std::vector<MadeFix>& made, Outcome& outcome) {
  for (FileId id = 0; id < outcome.sources.size(); ++id) {
    std::map<std::string_view, std::uint32_t> byRule;
    for (const MadeFix& one : made)
      if (one.file == outcome.sources.file(id).name()) ++byRule[one.code];
    for (const auto& [code, count] : byRule)
      if (count > kMostNotes)
        outcome.diagnostics.report<diag::FixesApplied>({id, 0, 0}, code, fmt::format("{} places", count));
    for (const MadeFix& one : made)
      if (one.file == outcome.sources.file(id).name() && byRule[one.code] <= kMostNotes)
        outcome.diagnostics.report<diag::FixesApplied>(placeOf(id, one, outcome.sources), one.code,
                                                       changed(one));
  }
}

std::vector<OutputFile> safeFixes(const Outcome& outcome, std::vector<MadeFix>& made) {
  std::vector<Edit> edits;
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
    for (const Edit& edit : d.fix->edits) {
      const SourceFile& file = outcome.sources.file(edit.range.file);
      const LineColumn place = file.place(edit.range.begin);
      made.push_back({file.name(), place.line, place.column, std::string(d.code),
                      oneLine(outcome.sources.textUtf8(edit.range)), oneLine(edit.text)});
    }
  }
  std::sort(edits.begin(), edits.end(),
            [](const Edit& a, const Edit& b) { return a.range.begin > b.range.begin; });
  std::map<std::string, std::string> texts;
  for (const Edit& edit : edits) {
    const SourceFile& file = outcome.sources.file(edit.range.file);
    const auto [at, added] = texts.try_emplace(file.name(), file.bytes());
    at->second.replace(edit.range.begin, edit.range.end - edit.range.begin, edit.text);
  }
  std::vector<OutputFile> out;
  for (auto& [name, text] : texts)
    out.push_back({name, std::move(text)});
  return out;
}

std::vector<MadeFix> applySafeFixes(const Outcome& outcome, const Limits& limits, bool force,
                                    Diagnostics& diagnostics) {
  std::vector<MadeFix> made;
  std::vector<OutputFile> texts = safeFixes(outcome, made);
  std::vector<NamedText> writes;
  for (OutputFile& file : texts) {
    const auto before = readBytes(file.name, limits, diagnostics);
    if (!before) return {};
    if (before->starts_with(kByteOrderMark) && !file.text.starts_with(kByteOrderMark))
      file.text.insert(0, kByteOrderMark);
    writes.push_back({file.name, &file.text});
  }
  if (!writeAll(writes, "", {force, nullptr}, diagnostics)) return {};
  return made;
}

} // namespace dotek::driver
