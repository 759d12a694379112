// Flags of `dotek verify`.
#include "cli/Options.h"
#include "support/Decimal.h"
#include "targets/Target.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>

namespace dotek::cli {

namespace {

// X,Y,Z,TURN.
std::array<double, 4> placeOf(const std::string& text) {
  std::array<double, 4> out{};
  std::istringstream in(text);
  std::size_t count = 0;
  for (std::string one; std::getline(in, one, ','); ++count) {
    const auto number = parseNumber(one);
    if (!number || count >= out.size())
      throw UsageError("--part-error takes X,Y,Z,TURN in mm and degrees, not `" + text + "`");
    out[count] = *number;
  }
  if (count != out.size())
    throw UsageError("--part-error takes X,Y,Z,TURN in mm and degrees, not `" + text + "`");
  return out;
}

std::string endingOf(const std::string& path) {
  std::string end = std::filesystem::path(path).extension().string();
  std::transform(end.begin(), end.end(), end.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  return end;
}

} // namespace

targets::ReportFormat reportFormatOf(const std::string& path) {
  using targets::ReportFormat;
  const std::string end = endingOf(path);
  return end == ".html" || end == ".htm" ? ReportFormat::Html
         : end == ".md"                  ? ReportFormat::Markdown
         : end == ".json"                ? ReportFormat::Json
                                         : ReportFormat::Text;
}

std::string noReport(const std::string& path) {
  const std::string end = endingOf(path);
  for (const char* other : {".pdf", ".doc", ".docx", ".odt", ".xls", ".xlsx", ".ods", ".csv", ".xml", ".rtf"})
    if (end == other)
      return "a report is a text, or a document where its name ends in .html, .md or .json; print the page "
             "of "
             ".html for a PDF";
  return "";
}

void addVerify(CLI::App& app, Raw& raw) {
  CLI::App* verify = app.add_subcommand(
      "verify", "run a source and its translation on many drawn cases and compare what they do");
  verify->add_option("INPUT", raw.inputs, "folder of a cycle, or file of programs");
  addTranslation(*verify, raw,
                 "language of the translation: " + targets::targetNames() +
                     "; without it the path of the macro is compared with the posted program");
  CLI::Option* const translation =
      verify
          ->add_option("--translation", raw.translation,
                       "look at this program instead of what convert writes: the same one, edited by hand")
          ->type_name("FILE");
  verify
      ->add_flag("--allow-edits", raw.allowEdits,
                 "of --translation: lines that no case tells from what convert writes are warnings")
      ->needs(translation);
  addOfProgram(*verify, raw);
  addSeveral(*verify, "--default", raw.defaults, "default of an argument, first value of a field of a dialog",
             "NAME=VALUE");
  addSeveral(*verify, "--var", raw.variables,
             "value of a variable before the programs begin, instead of a drawn one", "N=VALUE");
  verify->add_option("--part", raw.part, "the part that is probed (made from the source where left out)")
      ->type_name("PART.toml");
  verify->add_option("--machine", raw.machine, "probe and travel of the machine")->type_name("MACHINE.toml");
  verify->add_option("--cases", raw.cases, "cases to draw (1000)")->type_name("N");
  verify->add_option("--seed", raw.seed, "which cases are drawn (1)")->type_name("S");
  CLI::Option* const agreed =
      verify->add_option("--min-agreed", raw.minAgreed, "share of the cases that has to agree (95)")
          ->type_name("PERCENT");
  verify->add_option("--min-proved", raw.minAgreed)->group("")->excludes(agreed); // the name it had
  verify->add_option("--tolerance", raw.tolerance, "what counts as equal (0.000001)")->type_name("MM");
  verify->add_option("--jobs", raw.jobs, "cases that run at one time (one for each processor)")
      ->type_name("N");
  verify->add_option("--part-error", raw.partError, "where the part is, off its nominal place; of a replay")
      ->type_name("X,Y,Z,TURN");
  verify->add_option("--active-system", raw.activeSystem, "work system in force at entry; of a replay")
      ->type_name("N");
  addSeveral(*verify, "--value", raw.values, "value of a field or a host input; of a replay", "NAME=VALUE");
  verify->add_flag("--replay", raw.replay, "run the one case whose values are given");
  verify
      ->add_option(
          "-o", raw.output,
          "write the report to a file; .html, .md and .json: a document with files, cases and differences")
      ->type_name("REPORT")
      ->check(noReport, "");
  verify->add_option("--date", raw.date, "date that the document bears (none)")->type_name("DATE");
  verify->add_option("--remark", raw.remark, "line below its title: customer, order, machine (none)")
      ->type_name("TEXT");
  verify->add_option("--program-number", raw.programNumber, "O number of the translation (8000)")
      ->type_name("N");
  verify->add_flag("--quiet", raw.quiet, "no summary and no progress, only what was found");
  addForce(*verify, raw);
  addIncludes(*verify, raw);
  addCommon(*verify, raw);
}

driver::VerifyOptions verifyOf(const Raw& raw) {
  driver::VerifyOptions out;
  out.format = reportFormatOf(raw.output);
  out.date = raw.date;
  out.remark = raw.remark;
  out.programNumber = programNumberOf(raw);
  fillTranslation(raw, out);
  if (!raw.part.empty()) out.part = raw.part;
  if (!raw.machine.empty()) out.machine = raw.machine;
  if (!raw.translation.empty()) out.translation = raw.translation;
  constexpr std::uint64_t kMostCases = 10'000'000, kMostSeed = UINT64_MAX, kMostJobs = 256;
  out.cases = countOf("--cases", raw.cases, raw.replay ? 1 : out.cases, 1, kMostCases);
  out.seed = countOf("--seed", raw.seed, out.seed, 0, kMostSeed);
  out.jobs = static_cast<std::uint32_t>(countOf("--jobs", raw.jobs, 0, 1, kMostJobs));
  out.minAgreed = numberOf("--min-agreed", raw.minAgreed, out.minAgreed, 0, 100);
  out.tolerance = numberOf("--tolerance", raw.tolerance, out.tolerance, 0, 10);
  if (!raw.partError.empty()) out.partError = placeOf(raw.partError);
  if (!raw.activeSystem.empty())
    out.activeSystem = static_cast<std::uint32_t>(countOf("--active-system", raw.activeSystem, 54, 54, 59));
  out.variables = pairsOf("--var", raw.variables);
  out.defaults = pairsOf("--default", raw.defaults);
  out.allowEdits = raw.allowEdits;
  out.letters = pairsOf("--arg", raw.letters);
  out.useDefaults = raw.defaultsMode == "use";
  out.switchProbe = raw.probePower == "macro";
  if (out.switchProbe) out.common.assume.insert("probe-on");
  out.replay = raw.replay;
  out.values = pairsOf("--value", raw.values);
  if (!out.values.empty() && !out.replay)
    throw UsageError("--value goes with --replay; --set fixes a value in all cases");
  return out;
}

} // namespace dotek::cli
