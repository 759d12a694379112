// Flags of `dotek lint`.
#include "cli/Options.h"
#include "lint/Rule.h"
#include "support/Files.h"
#include "support/NearestName.h"

#include <algorithm>
#include <set>

namespace dotek::cli {

namespace {

std::set<std::string> codes(const std::vector<std::string>& given, bool all) {
  const std::vector<std::string> list = listOf(given);
  const std::set<std::string> out(list.begin(), list.end());
  for (const std::string& code : out) {
    const auto table = lint::codeTable();
    if ((all && code == "all") || std::any_of(table.begin(), table.end(),
                                              [&](const lint::CodeInfo& info) { return info.code == code; }))
      continue;
    NearestName nearest(code);
    for (const lint::CodeInfo& info : table)
      nearest.offer(info.code);
    const std::string near = nearest.result().empty() ? "" : "; did you mean `" + nearest.result() + "`?";
    throw UsageError("no message or rule `" + code + "`" + near + "; `dotek list rules` prints them");
  }
  return out;
}

// What is kept is found again from files alone.
void refuseCache(const Raw& raw) {
  const char* const other = raw.fix                      ? "--fix, which changes files"
                            : !raw.writeBaseline.empty() ? "--write-baseline, which writes a file"
                            : !raw.changedSince.empty()  ? "--changed-since, which asks git"
                            : !raw.programs.empty()      ? "--programs, which reads further folders"
                            : raw.followLinks            ? "--follow-links, which leaves the folders"
                                                         : nullptr;
  if (other != nullptr) throw UsageError(std::string("--cache keeps no result of ") + other);
  for (const std::string& input : raw.inputs)
    if (isStream(input))
      throw UsageError("--cache keeps no result of `" + inputName(input) + "`, which can be read only once");
}

} // namespace

void addLint(CLI::App& app, Raw& raw) {
  CLI::App* lint = app.add_subcommand("lint", "check macros, dialogs, cycle folders and posts");
  lint->add_option("PATH", raw.inputs, "files and folders");
  lint->add_option("--format", raw.format, "text, json, sarif, github, gitlab or html")
      ->check(CLI::IsMember({"text", "json", "sarif", "github", "gitlab", "html"}));
  lint->add_flag("--follow-links", raw.followLinks, "of folders: also links that lead out of them");
  lint->add_flag("--list-skipped", raw.listSkipped, "of folders: name each file that is skipped");
  lint->add_flag("--statistics", raw.statistics, "how often each code is found, instead of the findings");
  lint->add_option("--baseline", raw.baseline, "pass over the findings that this file lists")
      ->type_name("FILE");
  lint->add_option("--write-baseline", raw.writeBaseline, "list the findings of now in a file for --baseline")
      ->type_name("FILE");
  lint->add_option("--changed-since", raw.changedSince,
                   "only findings of files that git calls changed since this commit, branch or tag")
      ->type_name("REF");
  lint->add_option("--cache", raw.cache,
                   "keep the result in this folder, and take it from there while no file changes")
      ->type_name("FOLDER");
  CLI::Option* fix =
      lint->add_flag("--fix", raw.fix, "make the repairs that change no motion, coordinate or meaning");
  lint->add_flag("--diff", raw.diff, "with --fix: print the lines that would change, and how; change nothing")
      ->needs(fix);
  lint->add_option("--form", raw.form, "what the Form of the post decides (see `dotek list forms`)")
      ->type_name("NAME");
  addSeveral(*lint, "--field", raw.field, "the post's field FIELD is the macro's variable VARIABLE",
             "FIELD=VARIABLE");
  addValues(*lint, raw);
  addFolders(*lint, "--programs", raw.programs,
             "folder of programs that can be called: read, and not reported on");
  addSeveral(*lint, "--select", raw.select, "only this code, or all", "CODE");
  addSeveral(*lint, "--ignore", raw.ignore, "not this code", "CODE");
  lint->add_option("--fail-on", raw.failOn, "exit with 1 from this severity on (warning)")
      ->check(CLI::IsMember({"note", "warning", "error", "never"}));
  addTarget(*lint, raw);
  lint->add_flag("--quiet", raw.quiet, "no summary and no progress, only what was found");
  lint->add_flag("--watch", raw.watch, "run again whenever a file changes, until it is interrupted");
  addForce(*lint, raw);
  addStandardInput(*lint, raw);
  addIncludes(*lint, raw);
  addCommon(*lint, raw);
}

driver::LintOptions lintOf(const Raw& raw) {
  driver::LintOptions out;
  // A patch is no list of findings. (CLI11 would list what excludes a flag in the order of addresses.)
  if (raw.fix && raw.diff && (raw.format != "text" || raw.statistics || !raw.writeBaseline.empty()))
    throw UsageError("--fix --diff prints a patch, which has no --format, --statistics or --write-baseline");
  if (raw.statistics && raw.format != "text")
    throw UsageError("--statistics prints a table of the codes, which has no --format");
  if (raw.watch && (raw.fix || !raw.writeBaseline.empty()))
    throw UsageError(
        "--watch reads files that somebody edits; --fix and --write-baseline would write beside them");
  if (raw.watch &&
      std::any_of(raw.inputs.begin(), raw.inputs.end(), [](const std::string& one) { return one == "-"; }))
    throw UsageError("--watch takes files and folders; what comes by standard input does not change");
  if (!raw.cache.empty()) refuseCache(raw);
  if (!raw.select.empty()) out.select = codes(raw.select, true);
  out.ignore = codes(raw.ignore, false);
  out.control = raw.control;
  out.fix = raw.fix;
  if (!raw.baseline.empty()) out.baseline = raw.baseline;
  if (!raw.writeBaseline.empty()) out.writeBaseline = raw.writeBaseline;
  out.programs = raw.programs;
  out.changedSince = raw.changedSince;
  out.listSkipped = raw.listSkipped;
  out.force = raw.force;
  out.followLinks = raw.followLinks;
  if (!raw.failOn.empty())
    out.failOn = raw.failOn == "never"   ? driver::FailOn::Never
                 : raw.failOn == "note"  ? driver::FailOn::Note
                 : raw.failOn == "error" ? driver::FailOn::Error
                                         : driver::FailOn::Warning;
  return out;
}

} // namespace dotek::cli
