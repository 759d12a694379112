#include "lint/PostedBlocks.h"

#include "frontend/compost/Post.h"
#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"
#include "lint/Analyses.h"
#include "lint/Run.h"
#include "stdlib/HostInputs.h"

#include <algorithm>
#include <iterator>

namespace dotek::lint {
namespace {

// What holds for a part of a program, whoever runs it and with which values.
constexpr std::string_view kRules[] = {
    "contact-of-other-axis", "coordinate-as-distance", "distance-as-coordinate", "jump-to-itself",
    "length-offset-number",  "loop-never-ends",        "loop-without-step",      "machine-move-incremental",
    "offset-of-no-axis",     "skip-never-tested",      "skip-starts-in-contact", "skip-without-feed",
    "tool-length-in-target", "variable-out-of-range",  "work-offset-number",
};

// A value with which a cycle is called as a rule.
double usualHost(std::string_view name) {
  if (name == "clearance") return 50;
  if (name == "retract") return 20;
  if (name == "tool_radius") return 3;
  if (name == "tool_number" || name == "tool_offset") return 20;
  if (name == "overtravel") return 5;
  return name.ends_with("feed") ? 500 : 0;
}

std::vector<compost::PostedLine> posted(const Project& project, const Joined& joined) {
  std::map<std::string, double> values;
  for (const gibbs::Field& field : gibbs::declaredFields(*joined.cycle))
    if (field.value) values.emplace(gibbs::foldCase(field.name.text), *field.value);
  Diagnostics found;
  compost::PostSettings settings{project.sources, *project.form, project.limits, {}};
  compost::PostRun run(*joined.prog, settings, found);
  compost::Operation now;
  now.cycle = joined.cycle->name;
  for (const stdlib::HostInput& host : stdlib::kHostInputs)
    now.hosts.emplace(host.name, usualHost(host.name));
  bool known = true;
  now.field = [&](const std::string& name, SourceRange) -> std::optional<double> {
    const auto at = values.find(gibbs::foldCase(name));
    known = known && at != values.end();
    return known ? std::optional(at->second) : std::nullopt;
  };
  run.run(*joined.routine, now);
  std::vector<compost::PostedLine> out = run.finish();
  if (found.hasErrors() || !known) out.clear();
  return out;
}

// The line of the Prog that printed the place. No place: none did.
SourceRange placeIn(const std::vector<compost::PostedLine>& lines, SourceRange range,
                    const SourceFile& text) {
  const std::uint32_t line = range.hasPlace() ? text.lineOf(range.begin) : 0;
  return line >= 2 && line - 2 < lines.size() ? lines[line - 2].range : SourceRange{};
}

void lintOne(const Project& project, const Joined& joined, Diagnostics& diagnostics,
             const std::function<bool(const NamedRule&)>& wanted) {
  const std::vector<compost::PostedLine> lines = posted(project, joined);
  if (lines.empty()) return;
  std::string text = "O1\n";
  for (const compost::PostedLine& line : lines)
    text += line.text + "\n";
  text += "M99\n";
  SourceMap sources;
  const FileId id = sources.add(SourceFile("posted", std::move(text), Encoding::Utf8));
  Diagnostics found;
  const macrob::File tree = macrob::parse(id, sources, project.limits, found);
  if (found.hasErrors()) return;
  auto lowered = macrob::lower(tree, *project.postControl, sources, found);
  if (!lowered) return;
  Project one{sources, project.limits, project.gibbsKeywords, project.compostKeywords};
  one.macroSets = project.macroSets;
  one.form = project.form;
  one.control = one.postControl = project.postControl;
  one.programs.push_back({&tree, std::make_shared<const ir::ProgramFile>(std::move(*lowered))});
  one.analyses = std::make_shared<Analyses>();
  found = Diagnostics();
  runRules(one, found, found, wanted);
  const SourceFile& file = sources.file(id);
  for (Diagnostic finding : found.all()) {
    finding.range = placeIn(lines, finding.range, file);
    if (!finding.range.hasPlace()) continue;
    finding.fix.reset();
    std::vector<DiagnosticNote> notes;
    for (DiagnosticNote& note : finding.notes) {
      note.range = placeIn(lines, note.range, file);
      if (note.range.hasPlace()) notes.push_back(std::move(note));
    }
    finding.notes = std::move(notes);
    diagnostics.add(std::move(finding));
  }
}

} // namespace

void lintPosted(const Project& project, Diagnostics& diagnostics,
                const std::function<bool(const NamedRule&)>& wanted) {
  if (project.postControl == nullptr || project.form == nullptr) return;
  const auto holds = [&](const NamedRule& rule) {
    return wanted(rule) && std::find(std::begin(kRules), std::end(kRules), rule.id) != std::end(kRules);
  };
  for (const Joined& joined : project.joined)
    if (joined.routine != nullptr) lintOne(project, joined, diagnostics, holds);
}

} // namespace dotek::lint
