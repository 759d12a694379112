#include "lint/NcProgram.h"
#include "lint/ToolLength.h"

#include <algorithm>
#include <map>

namespace dotek::lint::rule {
namespace {

using Place = LengthLeftIn::Place;

// `Z#101` becomes `Z[#101-#5083]`; nothing where the length is in it otherwise than once.
std::optional<Edit> repair(const LengthLeftIn& one, const SourceMap& sources) {
  // Where the wear is taken off, the length has to come in its place.
  // What a call passes on may be right in other calls.
  if (one.taken || one.wear || one.passed.hasPlace() || !one.value.hasPlace() || one.length == 0 ||
      (one.lengths != 1 && one.lengths != -1))
    return std::nullopt;
  std::string text(sources.text(one.value));
  const bool bracketed = text.starts_with('[') && text.ends_with(']') && text.find(']') == text.size() - 1;
  if (bracketed) text = text.substr(1, text.size() - 2);
  const std::string taken = fmt::format("{}{}#{}", text, one.lengths > 0 ? '-' : '+', one.length);
  return Edit{one.value, one.assigned ? taken : "[" + taken + "]"};
}

// What the text that is underlined becomes by the edit.
std::string becomes(SourceRange range, const Edit& edit, const SourceMap& sources) {
  const SourceRange at = edit.range;
  if (at.file != range.file || at.begin < range.begin || at.end > range.end) return edit.text;
  return fmt::format("{}{}{}", sources.text({range.file, range.begin, at.begin}), edit.text,
                     sources.text({range.file, at.end, range.end}));
}

std::string_view subjectOf(Place place) {
  switch (place) {
  case Place::WorkOffset: return "this work offset is";
  case Place::ToolOffset: return "this offset of a tool is";
  case Place::Move:
  case Place::Argument:
  case Place::Difference: return "this Z is";
  }
  return "this Z is";
}

std::string wearText(const LengthLeftIn::Wear& wear) {
  return fmt::format("`#[{}+n]`, which is taken off, is the wear of a tool and not its length on a Fanuc "
                     "with both (on a Haas it is the length)",
                     wear.wear);
}

std::string wearCure(const LengthLeftIn& one) {
  return fmt::format("take #{} off, or `#[{}+n]+#[{}+n]`", one.length, one.wear->geometry, one.wear->wear);
}

Diagnostic& reportDifference(const LengthLeftIn& one, Report& report) {
  if (one.wear)
    return report.at(
        one.range,
        "#{} holds the length of the tool too, and {}; under G43 the difference is wrong by that "
        "length; {}",
        one.read, wearText(*one.wear), wearCure(one));
  return report.at(
      one.range,
      "#{} holds the length of the tool too, and the height that it is compared with does not; under G43 the "
      "difference is wrong by that length; take #{} off",
      one.read, one.length);
}

// The mistake the other way round.
Diagnostic& reportTaken(const LengthLeftIn& one, Report& report) {
  return report.at(
      one.range,
      "#{} is taken off this Z, which is a coordinate of the work system and holds no length of a tool; "
      "under G43 the move goes too low by that length, into the part; leave it away: it comes off what is "
      "read "
      "from #5043 or #5063",
      one.read);
}

// What speaks of a control whose positions hold the length by inference alone; nullptr: no doubt.
const std::string* doubtOf(const Project& project) {
  if (project.control == nullptr || !project.control->withToolLength) return nullptr;
  const stdlib::LengthInPositions& with = *project.control->withToolLength;
  return with.grade == "inferred" ? &with.source : nullptr;
}

void check(const NcProgram& nc, Report& report) {
  const Project& project = nc.project;
  // One position that is read leads to one finding, at its first coordinate.
  std::map<std::pair<FileId, std::uint32_t>, std::size_t> places; // of positions, in `read`
  std::vector<std::vector<LengthLeftIn>> read;
  for (const LengthLeftIn& one : toolLengthsOf(project).leftIn(nc)) {
    const auto [place, added] = places.try_emplace({one.readAt.file, one.readAt.begin}, read.size());
    if (added) read.emplace_back();
    read[place->second].push_back(one);
  }
  for (const std::vector<LengthLeftIn>& all : read) {
    const LengthLeftIn& first = all.front();
    Diagnostic& found =
        first.taken ? reportTaken(first, report)
        : first.place == Place::Difference
            ? reportDifference(first, report)
            : report.at(first.range,
                        "{0} computed from #{1}, which holds the length of the tool too, and {5}; "
                        "under G43 {2} "
                        "{3} by that length; {4}",
                        subjectOf(first.place), first.read,
                        first.place == Place::WorkOffset ? "the zero lies" : "the tool goes",
                        first.lengths > 0 ? "too high" : "too low, into the part,",
                        first.wear ? wearCure(first) : fmt::format("take #{} off", first.length),
                        first.wear ? wearText(*first.wear) : std::string("nothing takes it off"));
    if (first.call.hasPlace()) found.note(first.call, "the program is called here, under G43");
    if (first.readAt.hasPlace() &&
        (first.readAt.file != first.range.file || first.readAt.end <= first.range.begin ||
         first.readAt.begin >= first.range.end))
      found.note(first.readAt, "the position is read here");
    if (first.passed.hasPlace()) found.note(first.passed, "this call passes it on");
    const std::string* const doubt = first.taken ? nullptr : doubtOf(project);
    if (doubt != nullptr)
      found.note(first.readAt.hasPlace() ? first.readAt : first.range,
                 fmt::format("that #{} holds the length is inferred for {}: {}", first.read,
                             project.control->title, *doubt));
    Fix fix{Fix::Applicability::Display, "", {}};
    for (const LengthLeftIn& one : all) {
      if (one.range.begin != first.range.begin) found.note(one.range, "another coordinate computed from it");
      if (doubt != nullptr) continue; // a length taken off twice puts the tool into the part
      if (auto edit = repair(one, project.sources)) fix.edits.push_back(std::move(*edit));
    }
    if (!fix.edits.empty()) {
      fix.title = fmt::format("write `{}`", becomes(first.range, fix.edits.front(), project.sources));
      found.fix = std::move(fix);
    }
  }
}

} // namespace

DOTEK_LINT_RULE(tool_length_in_target){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
