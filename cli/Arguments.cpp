#include "cli/Arguments.h"

#include "cli/Cli.h"
#include "cli/Options.h"
#include "support/FileIdentity.h"
#include "support/NearestName.h"
#include "support/Printable.h"
#include "support/Version.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <ostream>
#include <sstream>

namespace dotek::cli {
namespace {

void fill(const Raw& raw, Arguments& parsed) {
  parsed.inputs = withoutRepeats(raw.inputs);
  parsed.common = commonOf(raw);
  if (!raw.prog.empty()) parsed.source.prog = raw.prog;
  if (!raw.routine.empty()) parsed.source.routine = raw.routine;
  if (!raw.cycle.empty()) parsed.source.cycle = raw.cycle;
  if (!raw.form.empty()) parsed.source.form = raw.form;
  parsed.convert = convertOf(raw);
  parsed.verify = verifyOf(raw);
  parsed.lint = lintOf(raw);
  parsed.sim = simOf(raw);
  parsed.outputFolder = raw.outputFolder;
  parsed.mapFile = raw.mapFile;
  parsed.output = raw.output;
  parsed.maxErrors = raw.maxErrors;
  if (!raw.sequence.empty()) parsed.sequence = startAndStep("--seq", raw.sequence);
  parsed.json = raw.format == "json" || raw.json;
  parsed.quiet = raw.quiet;
  parsed.force = raw.force;
  parsed.traceFile = raw.traceFile;
  parsed.svgFile = raw.svgFile;
  parsed.htmlFile = raw.htmlFile;
  parsed.sarif = raw.format == "sarif";
  parsed.stage = raw.stage == "tokens" ? driver::Stage::Tokens
                 : raw.stage == "path" ? driver::Stage::Path
                 : raw.stage == "ir"   ? driver::Stage::Ir
                                       : driver::Stage::Ast;
}

struct CommandFlags {
  std::string_view name;
  Command command;
  void (*add)(CLI::App& app, Raw& raw);
};
constexpr CommandFlags kCommands[] = {
    {"post", Command::Post, addPost}, {"convert", Command::Convert, addConvert},
    {"lint", Command::Lint, addLint}, {"dump", Command::Dump, addDump},
    {"sim", Command::Sim, addSim},    {"verify", Command::Verify, addVerify},
    {"new", Command::New, addNew},    {"explain", Command::Explain, addExplain},
    {"list", Command::List, addList},
};

// A command that is named first is the only one that is declared: declaring all flags takes longer than many
// a command. Else all are, for the help.
void declareCommands(CLI::App& app, const std::vector<std::string>& arguments, Raw& raw) {
  const auto named = [&](const CommandFlags& one) {
    return !arguments.empty() && arguments.front() == one.name;
  };
  const bool any = std::any_of(std::begin(kCommands), std::end(kCommands), named);
  for (const CommandFlags& one : kCommands)
    if (!any || named(one)) one.add(app, raw);
}

// CLI11 would only say that a command is missing.
void checkCommand(const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments.front().starts_with('-')) return;
  std::vector<std::string> known;
  for (const CommandFlags& one : kCommands)
    known.emplace_back(one.name);
  if (std::find(known.begin(), known.end(), arguments.front()) != known.end()) return;
  const std::string near = nearestName(arguments.front(), known);
  throw UsageError("no command `" + arguments.front() + "`" +
                   (near.empty() ? "" : "; did you mean `" + near + "`?") +
                   "; `dotek --help` prints the commands");
}

// A flag whose value is an empty text, such as that of a variable of a script which is not set, would count
// as not given.
void refuseEmptyValues(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    for (const CLI::Option* option : command->get_options()) {
      const auto& values = option->results();
      if (!option->get_positional() && std::find(values.begin(), values.end(), "") != values.end())
        throw UsageError(option->get_name() + " needs a value, and its value is empty");
    }
    refuseEmptyValues(*command);
  }
}

// `--set A=1 B=2` means `--set A=1 --set B=2`: pairs that follow a flag of pairs belong to it.
std::vector<std::string> spreadPairs(const std::vector<std::string>& arguments) {
  constexpr std::array<std::string_view, 7> kPairFlags = {"--set", "--field", "--host", "--default",
                                                          "--arg", "--var",   "--value"};
  std::vector<std::string> out;
  std::string flag;
  bool first = false;
  std::error_code error; // what cannot be a file's name is none
  for (const std::string& argument : arguments) {
    const bool isFlag = std::find(kPairFlags.begin(), kPairFlags.end(), argument) != kPairFlags.end();
    const std::size_t equals = argument.find('=');
    const bool isPair = equals != std::string::npos && equals > 0 && !argument.starts_with('-') &&
                        argument.find_first_of("/\\.") >= equals;
    if (isFlag) {
      flag = argument;
      first = true;
    } else if (!flag.empty() && !first && isPair && !std::filesystem::exists(argument, error)) {
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
  app.set_version_flag("--version", "dotek " + std::string(kVersion));
  app.require_subcommand(1);
  declareCommands(app, arguments, raw);
  try {
    checkCommand(arguments);
    std::vector<std::string> reversed = spreadPairs(arguments);
    std::reverse(reversed.begin(), reversed.end());
    app.parse(reversed);
    refuseEmptyValues(app);
    const std::string command = app.get_subcommands().front()->get_name();
    for (const CommandFlags& one : kCommands)
      if (one.name == command) parsed.command = one.command;
    fill(raw, parsed);
    return std::nullopt;
  } catch (const CLI::Success& success) {
    std::ostringstream text;
    app.exit(success, text, text);
    out << text.str();
    return kDone;
  } catch (const CLI::ParseError& error) {
    err << "dotek: error: " << printable(error.what()) << "; `dotek --help` prints the commands\n";
    return kUsage;
  } catch (const UsageError& error) {
    err << "dotek: error: " << printable(error.what()) << "\n";
    return kUsage;
  }
}

} // namespace dotek::cli
