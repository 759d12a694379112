// Flags of `dotek convert`.
#include "cli/Options.h"
#include "targets/Target.h"

namespace dotek::cli {

void addConvert(CLI::App& app, Raw& raw) {
  CLI::App* convert = app.add_subcommand(
      "convert", "turn cycles into programs that stay on the control, or programs into those of another");
  convert->add_option("INPUT", raw.inputs, "folders of cycles, files of programs");
  convert->add_option("--to", raw.to, "language to write: " + targets::targetNames())->type_name("TARGET");
  addTarget(*convert, raw);
  convert
      ->add_option("--from-control", raw.fromControl,
                   "profile of the control that programs are written for (that of --control)")
      ->type_name("NAME");
  convert->add_option("--renumber", raw.renumber, "number the blocks of programs anew; jumps follow")
      ->type_name("START:STEP");
  convert
      ->add_option("--probe-macros", raw.probeMacros,
                   "probing macros that the program calls (see `dotek list macros`)")
      ->type_name("SET");
  addSource(*convert, raw);
  addValues(*convert, raw);
  addSeveral(*convert, "--default", raw.defaults, "default of an argument that may be left out",
             "NAME=VALUE");
  convert
      ->add_option("--defaults", raw.defaultsMode,
                   "an omitted argument that moves the probe: alarm, or use its default")
      ->check(CLI::IsMember({"alarm", "use"}));
  addSeveral(*convert, "--arg", raw.letters, "letter of an argument", "NAME=LETTER");
  convert
      ->add_option("--probe-power", raw.probePower,
                   "the probe is switched where the source does it, or by the program itself")
      ->check(CLI::IsMember({"source", "macro"}));
  convert
      ->add_option("--datum", raw.datum,
                   "of mikroprog: g92 sets the active system, operator stops for an entry by hand")
      ->type_name("g92|operator");
  convert->add_option("--program-number", raw.programNumber, "O number of the program (8000)")
      ->type_name("N");
  convert->add_flag("--whole-post", raw.wholePost, "with --to fusion: the smallest post around the cycles");
  convert->add_flag("--verify", raw.verify,
                    "run 200 cases of source and result first; write nothing that differs");
  convert->add_option("--map", raw.mapFile, "write which line comes from where, as JSON")->type_name("FILE");
  CLI::Option* output =
      convert->add_option("-o", raw.output, "write the program to a file")->type_name("OUT");
  convert->add_option("-d", raw.outputFolder, "write each program to a file of DIR")
      ->type_name("DIR")
      ->excludes(output);
  addForce(*convert, raw);
  addIncludes(*convert, raw);
  addCommon(*convert, raw);
}

driver::ConvertOptions convertOf(const Raw& raw) {
  driver::ConvertOptions out;
  out.to = raw.to;
  out.control = raw.control;
  out.fromControl = raw.fromControl;
  if (!raw.renumber.empty()) {
    out.renumber = startAndStep("--renumber", raw.renumber);
    if (out.renumber->first == 0)
      throw UsageError("--renumber begins at 1 or above, as N0 is no block number");
  }
  if (!raw.probeMacros.empty()) out.probeMacros = raw.probeMacros;
  if (!raw.programNumber.empty()) {
    const auto number = wholeNumber(raw.programNumber);
    if (!number || *number == 0 || *number > 99999999)
      throw UsageError("--program-number takes a whole number such as 8010, not `" + raw.programNumber + "`");
    out.programNumber = static_cast<std::uint32_t>(*number);
  }
  out.letters = pairsOf("--arg", raw.letters);
  out.defaults = pairsOf("--default", raw.defaults);
  out.useDefaults = raw.defaultsMode == "use";
  out.switchProbe = raw.probePower == "macro";
  out.datum = raw.datum;
  out.wholePost = raw.wholePost;
  out.verify = raw.verify;
  return out;
}

} // namespace dotek::cli
