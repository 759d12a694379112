// Flags of `dotek convert`.
#include "cli/Options.h"
#include "targets/Target.h"

namespace dotek::cli {

void addOfProgram(CLI::App& command, Raw& raw) {
  command
      .add_option("--defaults", raw.defaultsMode,
                  "an omitted argument that moves the probe: alarm, or use its default")
      ->check(CLI::IsMember({"alarm", "use"}));
  addSeveral(command, "--arg", raw.letters, "letter of an argument", "NAME=LETTER");
  command
      .add_option("--probe-power", raw.probePower,
                  "the probe is switched where the source does it, or by the program itself")
      ->check(CLI::IsMember({"source", "macro"}));
}

void addConvert(CLI::App& app, Raw& raw) {
  CLI::App* convert = app.add_subcommand(
      "convert", "turn cycles into programs that stay on the control, or programs into those of another");
  convert->add_option("INPUT", raw.inputs, "folders of cycles, files of programs");
  addTranslation(*convert, raw, "language to write: " + targets::targetNames());
  convert->add_option("--renumber", raw.renumber, "number the blocks of programs anew; jumps follow")
      ->type_name("START:STEP");
  addSeveral(*convert, "--default", raw.defaults, "default of an argument that may be left out",
             "NAME=VALUE");
  addOfProgram(*convert, raw);
  convert->add_option("--program-number", raw.programNumber, "O number of the program (8000)")
      ->type_name("N");
  addSeveral(*convert, "--var", raw.variables,
             "of a program, with --to mikroprog: run it with this value of a variable, and write the plain "
             "blocks of the run",
             "N=VALUE");
  convert->add_flag("--whole-post", raw.wholePost, "with --to fusion: the smallest post around the cycles");
  convert
      ->add_option("--helpers", raw.helpersFile,
                   "with --to fusion: write the functions that fragments share to a file, once for all "
                   "cycles of a post")
      ->type_name("FILE.js");
  CLI::Option* verify = convert->add_flag(
      "--verify", raw.verify, "run 200 cases of source and result first; write nothing that differs");
  CLI::Option* report =
      convert
          ->add_option("--report", raw.report,
                       "with --verify: write what it found, also where it differs; .html, .md and .json: a "
                       "document to hand over; of several inputs one each, FILE-NAME.html")
          ->type_name("FILE.html")
          ->check(noReport, "")
          ->needs(verify);
  convert->add_option("--date", raw.date, "date that the report bears (none)")
      ->type_name("DATE")
      ->needs(report);
  convert->add_option("--remark", raw.remark, "line below its title: customer, order, machine (none)")
      ->type_name("TEXT")
      ->needs(report);
  convert->add_option("--map", raw.mapFile, "write which line comes from where, as JSON")->type_name("FILE");
  CLI::Option* output =
      convert->add_option("-o", raw.output, "write the program to a file")->type_name("OUT");
  CLI::Option* folder = convert->add_option("-d", raw.outputFolder, "write each program to a file of DIR")
                            ->type_name("DIR")
                            ->excludes(output);
  convert
      ->add_flag(
          "--keep-going", raw.keepGoing,
          "with -d: write the good ones of several inputs, list those that are refused, and exit with 1")
      ->needs(folder);
  convert->add_flag("--quiet", raw.quiet, "no summary and no progress, only what was found");
  addForce(*convert, raw, ", and in the folder of -d programs of another cycle");
  addIncludes(*convert, raw);
  addCommon(*convert, raw);
}

std::optional<std::uint32_t> programNumberOf(const Raw& raw) {
  if (raw.programNumber.empty()) return std::nullopt;
  const auto number = wholeNumber(raw.programNumber);
  if (!number || *number == 0 || *number > 99999999)
    throw UsageError("--program-number takes a whole number such as 8010, not `" + raw.programNumber + "`");
  return static_cast<std::uint32_t>(*number);
}

driver::ConvertOptions convertOf(const Raw& raw) {
  driver::ConvertOptions out;
  fillTranslation(raw, out);
  if (!raw.renumber.empty()) {
    out.renumber = startAndStep("--renumber", raw.renumber);
    if (out.renumber->first == 0)
      throw UsageError("--renumber begins at 1 or above, as N0 is no block number");
  }
  out.programNumber = programNumberOf(raw);
  out.letters = pairsOf("--arg", raw.letters);
  out.defaults = pairsOf("--default", raw.defaults);
  out.useDefaults = raw.defaultsMode == "use";
  out.switchProbe = raw.probePower == "macro";
  out.wholePost = raw.wholePost;
  out.variables = pairsOf("--var", raw.variables);
  if (!out.variables.empty() && !raw.mapFile.empty())
    throw UsageError("--map names lines of the source, and with --var the blocks of a run are written; their "
                     "comments say from which line each comes");
  out.helpersApart = !raw.helpersFile.empty();
  out.verify = raw.verify;
  out.keepGoing = raw.keepGoing;
  if (!raw.report.empty()) out.report = reportFormatOf(raw.report);
  out.date = raw.date;
  out.remark = raw.remark;
  if (out.helpersApart && out.wholePost)
    throw UsageError(
        "--whole-post holds all that it needs; --helpers goes with parts that are pasted into a post");
  if (out.keepGoing && out.wholePost)
    throw UsageError("--whole-post makes one file of all inputs; --keep-going goes with a file for each");
  return out;
}

} // namespace dotek::cli
