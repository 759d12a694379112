// Flags of `dotek new`, `dotek check`, `dotek fmt`, `dotek doc`, `dotek preview`, `dotek explain` and `dotek
// list`.
#include "cli/Options.h"

namespace dotek::cli {

void addNew(CLI::App& app, Raw& raw) {
  CLI::App* command = app.add_subcommand("new", "begin a data file");
  command->require_subcommand(1);
  CLI::App* form =
      command->add_subcommand("form", "what the Form of a post decides, from the keywords of its Prog");
  form->add_option("NAME", raw.inputs, "name of the form")->required()->expected(1);
  form->add_option("--prog", raw.prog, "the Prog (text of the ComPost post)")->type_name("PROG.txt");
  form->add_option("-o", raw.output, "write the form to a file")->type_name("FILE");
  addForce(*form, raw);
  addCommon(*form, raw);
  CLI::App* control =
      command->add_subcommand("control", "what a machine has otherwise than a control that Dotek knows");
  control->add_option("NAME", raw.inputs, "name of the control")->required()->expected(1);
  control->add_option("--from", raw.fromControl, "the control that it extends (see `dotek list controls`)")
      ->type_name("NAME")
      ->required();
  control->add_option("-o", raw.output, "write the control to a file")->type_name("FILE");
  addForce(*control, raw);
  addProbeCodes(*control, raw);
  addFolders(*control, "--data", raw.data, "folder whose data files are added or replace built-in ones");
  CLI::App* job =
      command->add_subcommand("job", "a job for a post of Fusion, with the post's own properties");
  job->add_option("--from", raw.inputs, "the post")->type_name("POST.cps")->required()->expected(1);
  job->add_option("-o", raw.output, "write the job to a file")->type_name("JOB.toml");
  addForce(*job, raw);
  addIncludes(*job, raw);
  addFolders(*job, "--data", raw.data, "folder whose data files are added or replace built-in ones");
  CLI::App* post = command->add_subcommand(
      "post", "a post of Fusion for a lathe with Mikroprog, from a description of the machine");
  post->add_option("--from", raw.inputs, "the description, as examples/s280-post.toml")
      ->type_name("DESCRIPTION.toml")
      ->required()
      ->expected(1);
  post->add_option("-o", raw.output, "write the post to a file")->type_name("POST.cps");
  addForce(*post, raw);
  addFolders(*post, "--data", raw.data, "folder whose data files are added or replace built-in ones");
  CLI::App* cycle = command->add_subcommand("cycle", "a cycle of your own, with a comment to each part");
  cycle->add_option("NAME", raw.inputs, "name of the cycle: small letters, digits and `_`")
      ->required()
      ->expected(1);
  cycle->add_option("-o", raw.output, "write the cycle to a file")->type_name("FILE");
  addForce(*cycle, raw);
  CLI::App* macros = command->add_subcommand(
      "macros",
      "the programs of a set of probing macros that Dotek has the text of, for the control's memory");
  macros->add_option("NAME", raw.inputs, "the set: `dotek` is the one that is built in")
      ->required()
      ->expected(1);
  macros->add_option("-o", raw.output, "write the programs to a file")->type_name("FILE");
  addForce(*macros, raw);
  addFolders(*macros, "--data", raw.data, "folder whose data files are added or replace built-in ones");
}

void addInit(CLI::App& app, Raw& raw) {
  CLI::App* init = app.add_subcommand("init", "begin the settings of a folder: a dotek.toml with comments");
  init->add_option("FOLDER", raw.inputs, "the folder; this one if left out")->expected(0, 1);
  addTarget(*init, raw);
  init->add_flag("--force", raw.force, "replace the dotek.toml that is there");
  addFolders(*init, "--data", raw.data, "folder whose data files are added or replace built-in ones");
}

void addCheck(CLI::App& app, Raw& raw) {
  CLI::App* check =
      app.add_subcommand("check", "say what is wrong with cycles (.cycle), whatever their values");
  check->add_option("FILE", raw.inputs, "files of the cycle language; `-` is standard input");
  check->add_option("--format", raw.format, "text, json or sarif")
      ->check(CLI::IsMember({"text", "json", "sarif"}));
  addStandardInput(*check, raw);
  addCommon(*check, raw);
}

void addFmt(CLI::App& app, Raw& raw) {
  CLI::App* fmt =
      app.add_subcommand("fmt", "print a cycle (.cycle) or an NC program in the one layout of its language");
  fmt->add_option("FILE", raw.inputs, "files of the cycle language, NC programs; `-` is standard input");
  CLI::Option* write = fmt->add_flag("--write", raw.write, "change the files instead; several may be given");
  fmt->add_flag("--check", raw.check,
                "print the names of files that would change; status 1 where there are any")
      ->excludes(write);
  fmt->add_flag("--diff", raw.diff, "print the lines that would change, and how")->excludes(write);
  fmt->add_option("-o", raw.output, "write the text to a file")->type_name("OUT")->excludes(write);
  addForce(*fmt, raw);
  addStandardInput(*fmt, raw);
  addCommon(*fmt, raw);
}

void addDoc(CLI::App& app, Raw& raw) {
  CLI::App* doc = app.add_subcommand("doc", "pages of cycles: parameters, results, what they refuse");
  doc->add_option("INPUT", raw.inputs, "cycles, or folders of cycles; none: the library");
  doc->add_option("-o", raw.outputFolder, "write a catalogue of HTML and Markdown to a folder")
      ->type_name("SITE");
  addForce(*doc, raw);
  addCommon(*doc, raw);
}

void addLsp(CLI::App& app, Raw&) {
  CLI::App* lsp = app.add_subcommand("lsp", "language server for editors, on standard input and output");
  lsp->add_flag("--stdio")->description("what editors pass; there is no other way");
}

void addPreview(CLI::App& app, Raw& raw) {
  CLI::App* preview = app.add_subcommand("preview", "the dialog of a cycle as a page (HTML)");
  preview->add_option("FOLDER", raw.inputs,
                      "the folder of a GibbsCAM cycle, or a file of the cycle language");
  preview->add_option("-o", raw.output, "write the page to a file")->type_name("OUT");
  addForce(*preview, raw);
  addValues(*preview, raw);
  addIncludes(*preview, raw);
  addCommon(*preview, raw);
}

void addExplain(CLI::App& app, Raw& raw) {
  CLI::App* explain = app.add_subcommand("explain", "say what a message means and what to do");
  explain->add_option("CODE", raw.inputs, "the name in brackets after a message")->required()->expected(1);
}

void addList(CLI::App& app, Raw& raw) {
  CLI::App* list = app.add_subcommand("list", "print a table");
  list->add_option("WHAT", raw.inputs,
                   "cycles, controls, macros, forms, rules, messages, targets, hosts, limits or assumptions; "
                   "`controls NAME`: the facts of one control, with the files that state them; "
                   "`macros NAME`: the calls of one set, with what each letter means")
      ->required()
      ->expected(1, 2);
  addCommon(*list, raw);
}

} // namespace dotek::cli
