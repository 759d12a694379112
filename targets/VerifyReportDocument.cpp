// The report of verify as a document.
#include "project/FormChoice.h"
#include "support/Decimal.h"
#include "support/Files.h"
#include "support/Sha256.h"
#include "support/Version.h"
#include "support/messages/Commands.h"
#include "targets/Target.h"
#include "targets/Verification.h"
#include "targets/VerifyReport.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <tuple>

namespace dotek::targets {

namespace {

constexpr std::uint32_t kAround = 2; // lines before and after the one that is meant

// What `sha256sum` gives for the file; without a file, for the bytes that were read.
VerifyDocument::File fileOf(const std::string& name, const std::string& bytes, const Limits& limits) {
  Diagnostics ignored;
  std::error_code fault;
  if (std::filesystem::is_regular_file(name, fault))
    if (const auto raw = readBytes(name, limits, ignored))
      if (raw->ends_with(bytes)) return {name, sha256(*raw), raw->size()};
  return {name, sha256(bytes), bytes.size()};
}

VerifyDocument::Finding findingOf(const Diagnostic& one, const SourceMap& sources, const char* about) {
  VerifyDocument::Finding out{
      about, std::string(severityName(one.severity)), std::string(one.code), one.message, "", 0};
  if (!one.range.hasPlace()) return out;
  out.file = sources.file(one.range.file).name();
  out.line = sources.line(one.range);
  return out;
}

} // namespace

void addFindings(const Diagnostics& said, const SourceMap& sources,
                 std::vector<VerifyDocument::Finding>& findings) {
  for (const Diagnostic& one : said.all()) {
    if (one.severity == Severity::Error || one.code == diag::WarningsLeftToLint::code) continue;
    VerifyDocument::Finding finding = findingOf(one, sources, isAboutForm(one.code) ? "form" : "translation");
    if (std::find(findings.begin(), findings.end(), finding) == findings.end())
      findings.push_back(std::move(finding));
  }
}

void VerifyReport::addSaid(std::vector<VerifyDocument::Finding> said, bool edited) {
  document_.edited = edited;
  document_.findings = std::move(said);
  std::stable_sort(document_.findings.begin(), document_.findings.end(), [](const auto& a, const auto& b) {
    return std::tie(a.about, a.file, a.line) < std::tie(b.about, b.file, b.line);
  });
}

VerifyDocument::Excerpt VerifyReport::excerptOf(SourceRange range) {
  VerifyDocument::Excerpt out;
  if (!range.hasPlace()) return out;
  const SourceMap& sources = runner_.session().sources();
  const SourceFile& file = sources.file(range.file);
  out.file = file.name();
  out.line = sources.line(range);
  out.first = out.line > kAround ? out.line - kAround : 1;
  const std::uint32_t last = std::min(out.line + kAround, file.lineCount());
  for (std::uint32_t line = out.first; line <= last; ++line)
    out.lines.push_back(file.lineUtf8(line));
  return out;
}

std::string VerifyReport::pairText() const {
  if (plan_.programs) return "source program against its translation";
  if (plan_.cycleFile) return "the cycle by its own meaning against its translation";
  if (!plan_.translation) return "drawn path against post";
  return options_.source.prog
             ? "posted program against translation, and contacts of the drawn path against the post"
             : "drawn path against translation";
}

void VerifyReport::describeInputs() {
  const Session& session = runner_.session();
  std::set<std::string> named;
  const auto add = [&](const std::string& name, const std::string& bytes) {
    if (named.insert(name).second) document_.inputs.push_back(fileOf(name, bytes, session.limits()));
  };
  for (FileId id = 0; id < session.sources().size(); ++id) {
    const SourceFile& file = session.sources().file(id);
    std::error_code fault;
    if (std::filesystem::is_directory(file.name(), fault)) continue;
    const bool given =
        std::find(options_.inputs.begin(), options_.inputs.end(), file.name()) != options_.inputs.end();
    // What Dotek holds itself is named by its version.
    if (id != translationFile_ && (given || std::filesystem::is_regular_file(file.name(), fault)))
      add(file.name(), file.bytes());
  }
  for (const auto& path : {options_.part, options_.machine, options_.common.job}) {
    Diagnostics ignored;
    if (const auto bytes = path ? readBytes(*path, session.limits(), ignored) : std::nullopt)
      add(*path, *bytes);
  }
  // Forms, controls and macro sets of `--data`, `--control` and dotek.toml: what they say decides each word.
  for (const char* const folder :
       {"controls", "cycles", "forms", "fusion", "keywords", "macrob", "macros", "mikroprog"})
    for (const stdlib::DataFile* file : session.data().list(folder))
      if (!file->builtIn()) add(file->origin, std::string(file->text));
  std::sort(document_.inputs.begin(), document_.inputs.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  const Target* const target = findTarget(options_.to);
  const bool whole = plan_.translation && (target == nullptr || !target->fixesValues || options_.translation);
  if (whole)
    document_.translation = {plan_.translation->name, sha256(plan_.translation->text),
                             plan_.translation->text.size()};
}

void VerifyReport::describe() {
  VerifyDocument& d = document_;
  d.title = options_.inputs.front();
  d.version = kVersion;
  d.date = options_.date;
  d.remark = options_.remark;
  d.command = wholeCommand();
  d.pair = pairText();
  const Target* const target = findTarget(options_.to);
  if (!plan_.translation) {
    d.aspects = {"points of the path", "nominal contacts", "end position"};
  } else if (target != nullptr && target->fixesValues) {
    d.aspects = {"path",   "measures", "paths back",          "records",
                 "datums", "ending",   "spindle and coolant", "other contacts"};
  } else {
    for (auto aspect = verify::Aspect::Ending; aspect <= verify::Aspect::Printed;
         aspect = static_cast<verify::Aspect>(static_cast<int>(aspect) + 1))
      if (aspect != verify::Aspect::Printed || plan_.programs)
        d.aspects.emplace_back(verify::aspectName(aspect));
  }
  const VerifySides sides = runner_.sides();
  d.sourceControl = sides.sourceControl;
  d.form = sides.form;
  if (plan_.translation) {
    d.target = options_.to;
    d.targetControl = sides.targetControl;
    d.targetMacros = plan_.targetMacros;
  }
  d.sourceMacros = plan_.sourceMacros;
  d.seed = options_.seed;
  d.tolerance = options_.tolerance;
  if (plan_.cycleFile) d.wordSteps = kRoundedWord;
  d.minAgreed = options_.minAgreed;
  for (const verify::DrawField& field : plan_.fields)
    if (field.fixed) d.fixed.emplace_back((plan_.programs ? "#" : "") + field.name, numberText(*field.fixed));
  for (const auto& [name, value] : plan_.fixedHosts)
    d.fixed.emplace_back(name, numberText(value));
  d.assumed.assign(options_.common.assume.begin(), options_.common.assume.end());
  describeInputs();
  for (const Diagnostic& one : told_.all()) {
    if (one.code == "verify-differs" || one.code == "verify-path-differs" || one.code == "verify-idle" ||
        one.code == "verify-edge-idle")
      continue;
    d.findings.push_back(findingOf(one, runner_.session().sources(), "cases"));
  }
}

const verify::Case* VerifyReport::shown() const {
  for (const auto& [key, group] : groups_)
    if (!group.edge) return &group.drawn;
  return agreeing_ ? &agreeing_->second : nullptr;
}

// A translation that is written for each case: what is said of the one that is shown, or of the one that
// convert has written.
void VerifyReport::addNotes() {
  const Target* const target = findTarget(options_.to);
  if (target == nullptr || !target->fixesValues || options_.translation || shown() == nullptr) return;
  std::vector<VerifyDocument::Finding> said = std::move(document_.findings);
  if (const ConvertedInput* written = options_.converted.get()) {
    addFindings(written->said, written->sources, said);
  } else {
    Session& session = runner_.session();
    session.diagnostics() = Diagnostics();
    runner_.run(*shown());
    addFindings(session.diagnostics(), session.sources(), said);
  }
  addSaid(std::move(said), document_.edited);
}

void VerifyReport::addPicture() {
  const verify::Case* shown = this->shown();
  const Idle* idle = nullptr;
  // Nothing was decided: what the source does as far as it runs.
  for (auto at = idle_.begin(); shown == nullptr && at != idle_.end(); ++at)
    if (!at->second.edge && at->second.rejected == 0 && (idle == nullptr || at->second.count > idle->count))
      idle = &at->second;
  if (idle != nullptr) shown = &idle->drawn;
  if (shown == nullptr) return;
  const std::optional<CasePictures> pictures = runner_.pictures(*shown);
  if (!pictures) return;
  const bool differs =
      std::any_of(groups_.begin(), groups_.end(), [](const auto& one) { return !one.second.edge; });
  std::string caption =
      idle != nullptr ? fmt::format("The source on a case that is undecided ({}): ", idle->why)
      : differs       ? fmt::format("The source on a case that differs; {}: ", pictures->sourceEnds)
                      : "The source on a case in which both sides agree: ";
  std::string values;
  for (const auto& [name, value] : shown->values)
    values += fmt::format("{}{}{} = {}", values.empty() ? "" : ", ", plan_.programs ? "#" : "", name,
                          numberText(value));
  for (const auto& [name, value] : shown->hosts)
    values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", name, numberText(value));
  caption += values.empty() ? "no values are drawn." : values + ".";
  document_.pictures.push_back({pictures->source, std::move(caption)});
  if (differs && pictures->translation)
    document_.pictures.push_back({*pictures->translation, fmt::format("The translation on the same case; {}.",
                                                                      pictures->translationEnds)});
}

std::string VerifyReport::rendered() const {
  switch (options_.format) {
  case ReportFormat::Text: return "";
  case ReportFormat::Markdown: return markdownOf(document_);
  case ReportFormat::Html: return htmlOf(document_);
  case ReportFormat::Json: return jsonOf(document_);
  }
  return "";
}

} // namespace dotek::targets
