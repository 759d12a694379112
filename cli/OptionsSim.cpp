// Flags of `dotek sim`.
#include "cli/Options.h"
#include "support/FileIdentity.h"

namespace dotek::cli {

void addSim(CLI::App& app, Raw& raw) {
  CLI::App* sim = app.add_subcommand("sim", "run an NC program on a machine and print what it does");
  sim->add_option("PROGRAM", raw.inputs, "the program")->expected(1);
  addTarget(*sim, raw);
  sim->add_option("--var", raw.variables, "value of a variable before the program begins")
      ->type_name("N=VALUE")
      ->allow_extra_args(false);
  sim->add_option("--programs", raw.programs, "folder of programs that can be called")
      ->type_name("DIR")
      ->allow_extra_args(false);
  sim->add_option("--probe-macros", raw.probeMacros,
                  "set of probing macros that calls without a program mean (all)")
      ->type_name("SET");
  sim->add_option("--part", raw.part, "part that the probe touches; needs --machine")->type_name("PART.toml");
  sim->add_option("--machine", raw.machine, "probe and travel of the machine")->type_name("MACHINE.toml");
  sim->add_option("--svg", raw.svgFile, "write a picture of the run, three views")->type_name("OUT");
  sim->add_option("--html", raw.htmlFile, "write a page that shows the run in space")->type_name("OUT");
  sim->add_flag("--quiet", raw.quiet, "no trace");
  sim->add_flag("--json", raw.json, "print how the run ended as JSON, and no trace");
  sim->add_option("--trace", raw.traceFile, "write the trace to a file")->type_name("OUT");
  addForce(*sim, raw);
  addCommon(*sim, raw);
}

driver::SimOptions simOf(const Raw& raw) {
  driver::SimOptions out;
  out.svg = !raw.svgFile.empty();
  out.html = !raw.htmlFile.empty();
  if (!raw.part.empty()) out.part = raw.part;
  if (!raw.machine.empty()) out.machine = raw.machine;
  out.control = raw.control;
  out.json = raw.json;
  out.programs = withoutRepeats(raw.programs);
  if (!raw.probeMacros.empty()) out.probeMacros = raw.probeMacros;
  for (const std::string& text : raw.variables)
    out.variables.push_back(splitPair("--var", text));
  return out;
}

} // namespace dotek::cli
