#include "cli/Arguments.h"

#include "cli/Cli.h"
#include "lint/Rule.h"
#include "project/InputKind.h"
#include "support/Decimal.h"
#include "support/NearestName.h"
#include "targets/Target.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>
#include <ostream>
#include <sstream>

namespace dotek::cli {
namespace {

class UsageError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// What CLI11 fills; turned into Arguments afterwards.
struct Raw {
  std::vector<std::string> inputs;
  std::vector<std::string> set, field, host, assume, limit, data;
  std::string job, encoding, from, prog, routine, cycle, form, clearance, sequence, output;
  std::string format = "text";
  std::string select, ignore;
  std::string failOn;
  bool fix = false;
  std::string stage = "ast";
  std::vector<std::string> letters, defaults;
  std::string to, control, fromControl, renumber, probeMacros, programNumber, outputFolder, mapFile;
  std::string defaultsMode = "alarm";
  std::string probePower = "source";
  std::string datum;
  std::vector<std::string> variables;
  std::vector<std::string> programs;
  std::string traceFile, svgFile, htmlFile;
  std::string part, machine, partError, translation;
  std::vector<std::string> values; // --value
  std::string cases, seed, jobs, minProved, tolerance, activeSystem;
  bool replay = false;
  bool json = false, quiet = false;
  std::uint32_t maxErrors = 50;
  bool recover = false;
  bool wholePost = false;
  bool verify = false;
};

std::pair<std::string, std::string> splitPair(const std::string& flag, const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0) throw UsageError(flag + " takes NAME=VALUE, not `" + text + "`");
  return {text.substr(0, at), text.substr(at + 1)};
}

std::optional<std::uint64_t> wholeNumber(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// START:STEP of two whole numbers, the step not 0.
std::pair<std::uint64_t, std::uint64_t> startAndStep(const std::string& flag, const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto start = wholeNumber(std::string_view(text).substr(0, colon));
  const auto step =
      colon == std::string::npos ? std::nullopt : wholeNumber(std::string_view(text).substr(colon + 1));
  if (!start || !step || *step == 0 || *start > 99999999 || *step > 99999)
    throw UsageError(flag + " takes START:STEP, two whole numbers such as 90:10, not `" + text + "`");
  return {*start, *step};
}

std::set<std::string> codes(const std::string& text, bool all) {
  std::set<std::string> out;
  std::istringstream in(text);
  for (std::string code; std::getline(in, code, ',');) {
    if (!code.empty()) out.insert(code);
  }
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

void applyLimit(const std::string& text, Limits& limits) {
  const auto [name, value] = splitPair("--limit", text);
  const std::optional<std::uint64_t> number = wholeNumber(value);
  const auto table = limitTable();
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&, &key = name](const LimitInfo& l) { return l.name == key; });
  if (found == table.end()) throw UsageError("no limit `" + name + "`; `dotek list limits` prints them");
  if (!number || *number == 0 || *number > 1u << 30)
    throw UsageError("--limit " + name + " takes a whole number from 1 to 1073741824, not `" + value + "`");
  limits.*found->member = static_cast<std::uint32_t>(*number);
}

driver::CommonOptions commonOf(const Raw& raw) {
  driver::CommonOptions out;
  if (!raw.job.empty()) out.job = raw.job;
  for (const std::string& text : raw.set)
    out.set.push_back(splitPair("--set", text));
  for (const std::string& text : raw.field)
    out.field.push_back(splitPair("--field", text));
  for (const std::string& text : raw.host)
    out.host.push_back(splitPair("--host", text));
  if (!raw.clearance.empty()) out.host.emplace_back("clearance", raw.clearance);
  out.assume.insert(raw.assume.begin(), raw.assume.end());
  out.recover = raw.recover;
  if (!raw.encoding.empty()) {
    out.encoding = encodingByName(raw.encoding);
    if (!out.encoding)
      throw UsageError("--encoding takes utf-8, cp1250 or cp852, not `" + raw.encoding + "`");
  }
  for (const std::string& text : raw.limit)
    applyLimit(text, out.limits);
  out.data = raw.data;
  if (!raw.from.empty()) {
    if (!project::kindByName(raw.from))
      throw UsageError("--from takes prog, mac, dlg, define, nc, listing or suf, not `" + raw.from + "`");
    out.from = raw.from;
  }
  return out;
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
  for (const std::string& text : raw.letters)
    out.letters.push_back(splitPair("--arg", text));
  for (const std::string& text : raw.defaults)
    out.defaults.push_back(splitPair("--default", text));
  out.useDefaults = raw.defaultsMode == "use";
  out.switchProbe = raw.probePower == "macro";
  out.datum = raw.datum;
  out.wholePost = raw.wholePost;
  out.verify = raw.verify;
  return out;
}

std::uint64_t countOf(const std::string& flag, const std::string& text, std::uint64_t otherwise,
                      std::uint64_t least, std::uint64_t most) {
  if (text.empty()) return otherwise;
  const auto number = wholeNumber(text);
  if (!number || *number < least || *number > most)
    throw UsageError(fmt::format("{} takes a whole number from {} to {}, not `{}`", flag, least, most, text));
  return *number;
}

double numberOf(const std::string& flag, const std::string& text, double otherwise, double least,
                double most) {
  if (text.empty()) return otherwise;
  const auto number = parseNumber(text);
  if (!number || !(*number >= least && *number <= most))
    throw UsageError(fmt::format("{} takes a number from {} to {}, not `{}`", flag, numberText(least),
                                 numberText(most), text));
  return *number;
}

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

driver::VerifyOptions verifyOf(const Raw& raw) {
  driver::VerifyOptions out;
  out.to = raw.to;
  out.control = raw.control;
  out.fromControl = raw.fromControl;
  if (!raw.probeMacros.empty()) out.probeMacros = raw.probeMacros;
  if (!raw.part.empty()) out.part = raw.part;
  if (!raw.machine.empty()) out.machine = raw.machine;
  if (!raw.translation.empty()) out.translation = raw.translation;
  constexpr std::uint64_t kMostCases = 10'000'000, kMostSeed = UINT64_MAX, kMostJobs = 256;
  out.cases = countOf("--cases", raw.cases, raw.replay ? 1 : out.cases, 1, kMostCases);
  out.seed = countOf("--seed", raw.seed, out.seed, 0, kMostSeed);
  out.jobs = static_cast<std::uint32_t>(countOf("--jobs", raw.jobs, 0, 1, kMostJobs));
  out.minProved = numberOf("--min-proved", raw.minProved, out.minProved, 0, 100);
  out.tolerance = numberOf("--tolerance", raw.tolerance, out.tolerance, 0, 10);
  if (!raw.partError.empty()) out.partError = placeOf(raw.partError);
  if (!raw.activeSystem.empty())
    out.activeSystem = static_cast<std::uint32_t>(countOf("--active-system", raw.activeSystem, 54, 54, 59));
  out.datum = raw.datum;
  for (const std::string& text : raw.variables)
    out.variables.push_back(splitPair("--var", text));
  out.replay = raw.replay;
  for (const std::string& text : raw.values)
    out.values.push_back(splitPair("--value", text));
  if (!out.values.empty() && !out.replay)
    throw UsageError("--value goes with --replay; --set fixes a value in all cases");
  return out;
}

void fill(const Raw& raw, Arguments& parsed) {
  parsed.inputs = raw.inputs;
  parsed.common = commonOf(raw);
  if (!raw.prog.empty()) parsed.source.prog = raw.prog;
  if (!raw.routine.empty()) parsed.source.routine = raw.routine;
  if (!raw.cycle.empty()) parsed.source.cycle = raw.cycle;
  if (!raw.form.empty()) parsed.source.form = raw.form;
  parsed.convert = convertOf(raw);
  parsed.verify = verifyOf(raw);
  parsed.outputFolder = raw.outputFolder;
  parsed.mapFile = raw.mapFile;
  parsed.output = raw.output;
  parsed.maxErrors = raw.maxErrors;
  if (!raw.sequence.empty()) parsed.sequence = startAndStep("--seq", raw.sequence);
  parsed.json = raw.format == "json" || raw.json;
  parsed.quiet = raw.quiet;
  parsed.traceFile = raw.traceFile;
  parsed.svgFile = raw.svgFile;
  parsed.htmlFile = raw.htmlFile;
  parsed.sim.svg = !raw.svgFile.empty();
  parsed.sim.html = !raw.htmlFile.empty();
  if (!raw.part.empty()) parsed.sim.part = raw.part;
  if (!raw.machine.empty()) parsed.sim.machine = raw.machine;
  parsed.sim.control = raw.control;
  parsed.sim.json = raw.json;
  parsed.sim.programs = raw.programs;
  if (!raw.probeMacros.empty()) parsed.sim.probeMacros = raw.probeMacros;
  for (const std::string& text : raw.variables)
    parsed.sim.variables.push_back(splitPair("--var", text));
  parsed.sarif = raw.format == "sarif";
  if (!raw.select.empty()) parsed.lint.select = codes(raw.select, true);
  parsed.lint.ignore = codes(raw.ignore, false);
  parsed.lint.control = raw.control;
  parsed.lint.fix = raw.fix;
  if (!raw.failOn.empty())
    parsed.lint.failOn = raw.failOn == "never"   ? driver::FailOn::Never
                         : raw.failOn == "note"  ? driver::FailOn::Note
                         : raw.failOn == "error" ? driver::FailOn::Error
                                                 : driver::FailOn::Warning;
  parsed.stage = raw.stage == "tokens" ? driver::Stage::Tokens
                 : raw.stage == "path" ? driver::Stage::Path
                 : raw.stage == "ir"   ? driver::Stage::Ir
                                       : driver::Stage::Ast;
}

void addCommon(CLI::App& app, Raw& raw) {
  app.add_option("--encoding", raw.encoding, "utf-8, cp1250 or cp852 instead of the recognised encoding");
  app.add_option("--from", raw.from, "kind of the inputs: prog, mac, dlg, define, nc, listing or suf");
  app.add_option("--max-errors", raw.maxErrors, "print at most N errors; 0 prints all")->type_name("N");
  app.add_option("--limit", raw.limit, "set a limit (see `dotek list limits`)")
      ->type_name("NAME=N")
      ->allow_extra_args(false);
  app.add_option("--data", raw.data, "folder whose data files are added or replace built-in ones")
      ->type_name("DIR")
      ->allow_extra_args(false);
}

void addValues(CLI::App& app, Raw& raw) {
  app.add_option("--set", raw.set, "value of a field")->type_name("NAME=VALUE")->allow_extra_args(false);
  app.add_option("--host", raw.host, "value that the CAM knows of the operation (see `dotek list hosts`)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  app.add_option("--clearance", raw.clearance, "short for --host clearance=Z")->type_name("Z");
  app.add_option("--assume", raw.assume, "name the reading of a construct that is not documented")
      ->type_name("NAME")
      ->allow_extra_args(false);
}

// What says where the post is.
void addSource(CLI::App& app, Raw& raw) {
  app.add_option("--prog", raw.prog, "the Prog (text of the ComPost post)")->type_name("PROG.txt");
  app.add_option("--form", raw.form, "what the post's Form decides, as data")->type_name("NAME");
  app.add_option("--routine", raw.routine, "routine to run for an operation");
  app.add_option("--cycle", raw.cycle, "name of the cycle, if it is not the folder's");
  app.add_option("--job", raw.job, "a whole program as a list of operations")->type_name("JOB.toml");
  app.add_option("--field", raw.field, "the post's field FIELD is the macro's variable VARIABLE")
      ->type_name("FIELD=VARIABLE")
      ->allow_extra_args(false);
  app.add_flag("--recover", raw.recover, "accept the repairs that diagnostics offer");
}

void addTarget(CLI::App& app, Raw& raw) {
  app.add_option("--control", raw.control, "profile of the control (see `dotek list controls`)")
      ->type_name("NAME");
}

void addPost(CLI::App& app, Raw& raw) {
  CLI::App* post =
      app.add_subcommand("post", "run the Prog for a cycle and print the NC blocks the CAM would print");
  post->add_option("FOLDER", raw.inputs, "folders of the cycles");
  addSource(*post, raw);
  addValues(*post, raw);
  post->add_option("--seq", raw.sequence, "first sequence number and step (10:10)")->type_name("START:STEP");
  post->add_option("-o", raw.output, "write the program to a file")->type_name("OUT");
  addCommon(*post, raw);
}

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
  convert->add_option("--default", raw.defaults, "default of an argument that may be left out")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  convert
      ->add_option("--defaults", raw.defaultsMode,
                   "an omitted argument that moves the probe: alarm, or use its default")
      ->check(CLI::IsMember({"alarm", "use"}));
  convert->add_option("--arg", raw.letters, "letter of an argument")
      ->type_name("NAME=LETTER")
      ->allow_extra_args(false);
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
  addCommon(*convert, raw);
}

void addLint(CLI::App& app, Raw& raw) {
  CLI::App* lint = app.add_subcommand("lint", "check macros, dialogs, cycle folders and posts");
  lint->add_option("PATH", raw.inputs, "files and folders");
  lint->add_option("--format", raw.format, "text, json or sarif")
      ->check(CLI::IsMember({"text", "json", "sarif"}));
  lint->add_flag("--fix", raw.fix, "make the repairs that change no motion, coordinate or meaning");
  lint->add_option("--form", raw.form, "what the Form of the post decides (see `dotek list forms`)")
      ->type_name("NAME");
  lint->add_option("--field", raw.field, "the post's field FIELD is the macro's variable VARIABLE")
      ->type_name("FIELD=VARIABLE")
      ->allow_extra_args(false);
  addValues(*lint, raw);
  lint->add_option("--select", raw.select, "only these codes, separated by commas, or all")
      ->type_name("CODES");
  lint->add_option("--ignore", raw.ignore, "not these codes")->type_name("CODES");
  lint->add_option("--fail-on", raw.failOn, "exit with 1 from this severity on (warning)")
      ->check(CLI::IsMember({"note", "warning", "error", "never"}));
  addTarget(*lint, raw);
  addCommon(*lint, raw);
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
  addCommon(*dump, raw);
}

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
  addCommon(*sim, raw);
}

void addVerify(CLI::App& app, Raw& raw) {
  CLI::App* verify = app.add_subcommand(
      "verify", "run a source and its translation on many drawn cases and compare what they do");
  verify->add_option("INPUT", raw.inputs, "folder of a cycle, or file of programs");
  verify
      ->add_option("--to", raw.to,
                   "language of the translation: " + targets::targetNames() +
                       "; without it the path of the macro is compared with the posted program")
      ->type_name("TARGET");
  addTarget(*verify, raw);
  verify
      ->add_option("--from-control", raw.fromControl,
                   "profile of the control that programs are written for (that of --control)")
      ->type_name("NAME");
  verify->add_option("--probe-macros", raw.probeMacros, "probing macros that the translation calls")
      ->type_name("SET");
  addSource(*verify, raw);
  addValues(*verify, raw);
  verify->add_option("--datum", raw.datum, "of mikroprog: g92 or operator")->type_name("g92|operator");
  verify
      ->add_option("--translation", raw.translation,
                   "look at this program instead of what convert writes: the same one, edited by hand")
      ->type_name("FILE");
  verify
      ->add_option("--var", raw.variables,
                   "value of a variable before the programs begin, instead of a drawn one")
      ->type_name("N=VALUE")
      ->allow_extra_args(false);
  verify->add_option("--part", raw.part, "the part that is probed (made from the source where left out)")
      ->type_name("PART.toml");
  verify->add_option("--machine", raw.machine, "probe and travel of the machine")->type_name("MACHINE.toml");
  verify->add_option("--cases", raw.cases, "cases to draw (1000)")->type_name("N");
  verify->add_option("--seed", raw.seed, "which cases are drawn (1)")->type_name("S");
  verify->add_option("--min-proved", raw.minProved, "share of the cases that has to be proved (95)")
      ->type_name("PERCENT");
  verify->add_option("--tolerance", raw.tolerance, "what counts as equal (0.000001)")->type_name("MM");
  verify->add_option("--jobs", raw.jobs, "cases that run at one time (one for each processor)")
      ->type_name("N");
  verify->add_option("--part-error", raw.partError, "where the part is, off its nominal place; of a replay")
      ->type_name("X,Y,Z,TURN");
  verify->add_option("--active-system", raw.activeSystem, "work system in force at entry; of a replay")
      ->type_name("N");
  verify->add_option("--value", raw.values, "value of a field or a host input; of a replay")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  verify->add_flag("--replay", raw.replay, "run the one case whose values are given");
  verify->add_option("-o", raw.output, "write the report to a file")->type_name("REPORT");
  addCommon(*verify, raw);
}

void addNew(CLI::App& app, Raw& raw) {
  CLI::App* command = app.add_subcommand("new", "begin a data file");
  command->require_subcommand(1);
  CLI::App* form =
      command->add_subcommand("form", "what the Form of a post decides, from the keywords of its Prog");
  form->add_option("NAME", raw.inputs, "name of the form")->required()->expected(1);
  form->add_option("--prog", raw.prog, "the Prog (text of the ComPost post)")->type_name("PROG.txt");
  form->add_option("-o", raw.output, "write the form to a file")->type_name("FILE");
  addCommon(*form, raw);
}

// CLI11 would only say that a command is missing.
void checkCommand(const CLI::App& app, const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments.front().starts_with('-')) return;
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    known.push_back(command->get_name());
  if (std::find(known.begin(), known.end(), arguments.front()) != known.end()) return;
  const std::string near = nearestName(arguments.front(), known);
  throw UsageError("no command `" + arguments.front() + "`" +
                   (near.empty() ? "" : "; did you mean `" + near + "`?") +
                   "; `dotek --help` prints the commands");
}

// `--set A=1 B=2` means `--set A=1 --set B=2`: pairs that follow a flag of pairs belong to it.
std::vector<std::string> spreadPairs(const std::vector<std::string>& arguments) {
  constexpr std::array<std::string_view, 7> kPairFlags = {"--set", "--field", "--host", "--default",
                                                          "--arg", "--var",   "--value"};
  std::vector<std::string> out;
  std::string flag;
  bool first = false;
  for (const std::string& argument : arguments) {
    const bool isFlag = std::find(kPairFlags.begin(), kPairFlags.end(), argument) != kPairFlags.end();
    const std::size_t equals = argument.find('=');
    const bool isPair = equals != std::string::npos && equals > 0 && !argument.starts_with('-') &&
                        argument.find_first_of("/\\.") >= equals;
    if (isFlag) {
      flag = argument;
      first = true;
    } else if (!flag.empty() && !first && isPair && !std::filesystem::exists(argument)) {
      out.push_back(flag);
    } else if (!first) {
      flag.clear();
    } else {
      first = false;
    }
    out.push_back(argument);
  }
  return out;
}

} // namespace

std::optional<int> parseArguments(const std::vector<std::string>& arguments, Arguments& parsed,
                                  std::ostream& out, std::ostream& err) {
  Raw raw;
  CLI::App app("Dotek, a compiler for the languages of CNC probing", "dotek");
  app.set_version_flag("--version", "dotek 0.1.0");
  app.require_subcommand(1);
  addPost(app, raw);
  addConvert(app, raw);
  addLint(app, raw);
  addDump(app, raw);
  addSim(app, raw);
  addVerify(app, raw);
  addNew(app, raw);
  CLI::App* explain = app.add_subcommand("explain", "say what a message means and what to do");
  explain->add_option("CODE", raw.inputs, "the name in brackets after a message")->required()->expected(1);
  CLI::App* list = app.add_subcommand("list", "print a table");
  list->add_option("WHAT", raw.inputs,
                   "cycles, controls, macros, forms, rules, targets, hosts, limits or assumptions")
      ->required()
      ->expected(1);
  addCommon(*list, raw);
  try {
    checkCommand(app, arguments);
    std::vector<std::string> reversed = spreadPairs(arguments);
    std::reverse(reversed.begin(), reversed.end());
    app.parse(reversed);
    const std::string command = app.get_subcommands().front()->get_name();
    parsed.command = command == "post"      ? Command::Post
                     : command == "convert" ? Command::Convert
                     : command == "lint"    ? Command::Lint
                     : command == "dump"    ? Command::Dump
                     : command == "explain" ? Command::Explain
                     : command == "sim"     ? Command::Sim
                     : command == "verify"  ? Command::Verify
                     : command == "new"     ? Command::New
                                            : Command::List;
    fill(raw, parsed);
    return std::nullopt;
  } catch (const CLI::Success& success) {
    std::ostringstream text;
    app.exit(success, text, text);
    out << text.str();
    return kDone;
  } catch (const CLI::ParseError& error) {
    err << "dotek: error: " << error.what() << "; `dotek --help` prints the commands\n";
    return kUsage;
  } catch (const UsageError& error) {
    err << "dotek: error: " << error.what() << "\n";
    return kUsage;
  }
}

} // namespace dotek::cli
