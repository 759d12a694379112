// Flags of `dotek run-post`.
#include "cli/Options.h"

namespace dotek::cli {

void addRunPost(CLI::App& app, Raw& raw) {
  CLI::App* run =
      app.add_subcommand("run-post", "run a post of Fusion on a job and print the program that it writes");
  run->add_option(
         "POST", raw.inputs,
         "the post (.cps), then the job (.toml, or .cnc of Autodesk); `dotek new job --from POST` begins one")
      ->expected(1, 2);
  CLI::Option* matrix =
      run->add_option("--matrix", raw.matrix,
                      "instead of a job: each operation of a kind, probing, drilling or turning")
          ->type_name("KIND");
  addSeveral(*run, "--property", raw.properties, "a property of the post", "NAME=VALUE");
  run->add_option("--unit", raw.unit, "unit of the output where no job says it (mm)")
      ->check(CLI::IsMember({"mm", "in"}));
  run->add_option("--diff", raw.otherPost,
                  "run another version of the post too, and show where the programs differ")
      ->type_name("POST");
  run->add_option("--expect", raw.expect, "the program that is expected; another one is status 1")
      ->type_name("NC");
  CLI::Option* check =
      run->add_flag("--check", raw.check, "lint the program that the post writes, and with --part run it");
  run->add_option("--control", raw.control, "control that the program is checked for")
      ->type_name("NAME")
      ->needs(check);
  addPart(*run, raw, "part on which --check runs the program; without --machine with the probe of the job");
  for (const char* const flag : {"--part", "--machine"})
    run->get_option(flag)->needs(check);
  run->add_option("-o", raw.output, "write the program to a file")->type_name("OUT");
  run->add_option("--map", raw.mapFile, "write which lines of the post wrote each line of the program (JSON)")
      ->type_name("FILE");
  check->excludes(matrix);
  addForce(*run, raw);
  addIncludes(*run, raw);
  addCommon(*run, raw);
}

driver::RunPostOptions runPostOf(const Raw& raw) {
  driver::RunPostOptions out;
  if (!raw.inputs.empty()) out.post = raw.inputs.front();
  if (raw.inputs.size() > 1) out.job = raw.inputs[1];
  out.matrix = raw.matrix;
  if (!raw.otherPost.empty()) out.diff = raw.otherPost;
  if (!raw.expect.empty()) out.expect = raw.expect;
  if (!raw.unit.empty()) out.inch = raw.unit == "in";
  out.properties = pairsOf("--property", raw.properties);
  out.map = !raw.mapFile.empty();
  out.check = raw.check;
  out.control = raw.control;
  if (raw.output != "-") out.name = raw.output;
  if (!raw.part.empty()) out.part = raw.part;
  if (!raw.machine.empty()) out.machine = raw.machine;
  return out;
}

} // namespace dotek::cli
