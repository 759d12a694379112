// Flags of `dotek new`, `dotek explain` and `dotek list`.
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
}

void addExplain(CLI::App& app, Raw& raw) {
  CLI::App* explain = app.add_subcommand("explain", "say what a message means and what to do");
  explain->add_option("CODE", raw.inputs, "the name in brackets after a message")->required()->expected(1);
}

void addList(CLI::App& app, Raw& raw) {
  CLI::App* list = app.add_subcommand("list", "print a table");
  list->add_option("WHAT", raw.inputs,
                   "cycles, controls, macros, forms, rules, messages, targets, hosts, limits or assumptions")
      ->required()
      ->expected(1);
  addCommon(*list, raw);
}

} // namespace dotek::cli
