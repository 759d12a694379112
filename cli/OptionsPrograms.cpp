// Flags of `dotek outline`, `dotek renumber` and `dotek flatten`.
#include "cli/Options.h"

#include <CLI/CLI.hpp>

namespace dotek::cli {

void addOutline(CLI::App& app, Raw& raw) {
  CLI::App* command = app.add_subcommand(
      "outline", "programs of a file, their N numbers, calls, jumps and variables, with the lines");
  command->add_option("FILE", raw.inputs, "NC programs; `-` is standard input");
  command->add_flag("--json", raw.json, "print it as JSON");
  addCommon(*command, raw);
}

void addRenumber(CLI::App& app, Raw& raw) {
  CLI::App* command = app.add_subcommand(
      "renumber", "number the blocks of programs anew, with the jumps that go to them; changes the files");
  command->add_option("FILE", raw.inputs, "NC programs");
  command->add_option("--start", raw.start, "the first number (10)")->type_name("N");
  command->add_option("--step", raw.step, "from one number to the next (10)")->type_name("N");
  command->add_flag("--all", raw.all, "number blocks that have no number, too");
  command
      ->add_option("--range", raw.range, "of each program the blocks from N to N alone, as numbered before")
      ->type_name("A:B");
  command->add_option("--control", raw.control, "control whose greatest number counts")->type_name("NAME");
  command->add_option("-o", raw.output, "write to a file (`-`: print) and leave the input; one input")
      ->type_name("OUT");
  addForce(*command, raw);
  addCommon(*command, raw);
}

void addFlatten(CLI::App& app, Raw& raw) {
  CLI::App* command = app.add_subcommand(
      "flatten", "run a program of macro B and print the plain blocks that it makes, as one program");
  command->add_option("PROGRAM", raw.inputs, "the program")->expected(1);
  addTarget(*command, raw);
  addSeveral(*command, "--var", raw.variables, "value of a variable before the program begins", "N=VALUE");
  addFolders(*command, "--programs", raw.programs, "folder of programs that can be called");
  command
      ->add_option("--probe-macros", raw.probeMacros,
                   "set of probing macros that calls without a program mean (all)")
      ->type_name("SET");
  addPart(*command, raw, "part that the probe touches");
  addSetup(*command, raw);
  command->add_option("-o", raw.output, "write to a file instead of standard output")->type_name("OUT");
  addForce(*command, raw);
  addIncludes(*command, raw);
  addCommon(*command, raw);
}

driver::RenumberCommandOptions renumberOf(const Raw& raw) {
  driver::RenumberCommandOptions out;
  constexpr std::uint64_t kMost = 99999999;
  out.start = countOf("--start", raw.start, out.start, 1, kMost);
  out.step = countOf("--step", raw.step, out.step, 1, 99999);
  out.all = raw.all;
  out.control = raw.control;
  if (raw.range.empty()) return out;
  const std::size_t colon = raw.range.find(':');
  const auto first = wholeNumber(std::string_view(raw.range).substr(0, colon));
  const auto last =
      colon == std::string::npos ? std::nullopt : wholeNumber(std::string_view(raw.range).substr(colon + 1));
  if (!first || !last)
    throw UsageError("--range takes A:B, the N numbers of two blocks such as 100:250, not `" + raw.range +
                     "`");
  out.range = std::pair(*first, *last);
  return out;
}

} // namespace dotek::cli
