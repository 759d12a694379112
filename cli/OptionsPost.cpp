// Flags of `dotek post` and `dotek dump`.
#include "cli/Options.h"

namespace dotek::cli {

void addPost(CLI::App& app, Raw& raw) {
  CLI::App* post =
      app.add_subcommand("post", "run the Prog for a cycle and print the NC blocks the CAM would print");
  post->add_option("FOLDER", raw.inputs, "folders of the cycles");
  addSource(*post, raw);
  addValues(*post, raw);
  post->add_option("--seq", raw.sequence, "first sequence number and step (10:10)")->type_name("START:STEP");
  post->add_option("-o", raw.output, "write the program to a file")->type_name("OUT");
  addForce(*post, raw);
  addIncludes(*post, raw);
  addCommon(*post, raw);
}

void addDump(CLI::App& app, Raw& raw) {
  CLI::App* dump = app.add_subcommand("dump", "print what a stage makes of an input");
  dump->add_option("INPUT", raw.inputs, "files, or folders of cycles");
  dump->add_option("--stage", raw.stage,
                   "tokens, ast, path: the moves of ToolPath.mac, or ir: what convert works on")
      ->check(CLI::IsMember({"tokens", "ast", "path", "ir"}));
  addSource(*dump, raw);
  addTarget(*dump, raw);
  addValues(*dump, raw);
  addIncludes(*dump, raw);
  addCommon(*dump, raw);
}

// What a stage does not read may name anything, and nothing would say that it is wrong.
void checkDump(const Raw& raw) {
  if (raw.stage == "ir") return;
  struct Flag {
    const char* name;
    bool given;
    bool ofPath = false; // read by `--stage path`, too
  };
  const Flag flags[] = {
      {"--control", !raw.control.empty()},
      {"--prog", !raw.prog.empty()},
      {"--form", !raw.form.empty()},
      {"--routine", !raw.routine.empty()},
      {"--cycle", !raw.cycle.empty()},
      {"--job", !raw.job.empty()},
      {"--field", !raw.field.empty()},
      {"--recover", raw.recover},
      {"--set", !raw.set.empty(), true},
      {"--host", !raw.host.empty(), true},
      {"--clearance", !raw.clearance.empty(), true},
      {"--assume", !raw.assume.empty(), true},
  };
  for (const Flag& flag : flags)
    if (flag.given && !(flag.ofPath && raw.stage == "path"))
      throw UsageError(std::string(flag.name) + " changes nothing of --stage " + raw.stage +
                       "; it is read by " + (flag.ofPath ? "--stage path and --stage ir" : "--stage ir"));
}

} // namespace dotek::cli
