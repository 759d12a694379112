#include "cli/Arguments.h"

#include "cli/Build.h"
#include "cli/Cli.h"
#include "cli/Documents.h"
#include "cli/Help.h"
#include "cli/Mistakes.h"
#include "cli/Options.h"
#include "lint/Catalog.h"
#include "project/Assumptions.h"
#include "support/Ascii.h"
#include "support/FileIdentity.h"
#include "support/NearestName.h"
#include "support/Printable.h"
#include "support/Version.h"
#include "support/Worker.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
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
  parsed.runPost = runPostOf(raw);
  parsed.lint = lintOf(raw);
  parsed.sim = simOf(raw);
  parsed.device = deviceOf(raw);
  parsed.renumber = renumberOf(raw);
  if (raw.outputFolder != "-") parsed.outputFolder = raw.outputFolder; // else standard output
  parsed.mapFile = raw.mapFile;
  parsed.helpersFile = raw.helpersFile;
  parsed.reportFile = raw.report;
  parsed.output = raw.output;
  parsed.standardInputName = raw.standardInputName;
  if (!raw.standardInputName.empty()) {
    if (std::count(raw.inputs.begin(), raw.inputs.end(), "-") == 0)
      throw UsageError("--stdin-filename names what comes by standard input, and `-` is no input here");
    if ((raw.fix || raw.write) && !raw.diff)
      throw UsageError("with --stdin-filename there is no file to write; --diff prints what would change");
  }
  parsed.maxErrors = raw.maxErrors;
  if (!raw.sequence.empty()) parsed.sequence = startAndStep("--seq", raw.sequence);
  parsed.json = raw.json;
  parsed.format = raw.format;
  parsed.quiet = raw.quiet;
  parsed.color = raw.color == "always"  ? ColorMode::Always
                 : raw.color == "never" ? ColorMode::Never
                                        : ColorMode::Auto;
  parsed.force = raw.force;
  parsed.write = raw.write;
  parsed.check = raw.check;
  parsed.diff = raw.diff;
  parsed.traceFile = raw.traceFile;
  parsed.svgFile = raw.svgFile;
  parsed.stockMapFile = raw.stockMap;
  parsed.htmlFile = raw.htmlFile;
  parsed.watch = raw.watch;
  parsed.statistics = raw.statistics;
  parsed.baselineFile = raw.writeBaseline;
  if (parsed.command == Command::Dump) checkDump(raw);
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
    {"post", Command::Post, addPost},
    {"run-post", Command::RunPost, addRunPost},
    {"convert", Command::Convert, addConvert},
    {"lint", Command::Lint, addLint},
    {"dump", Command::Dump, addDump},
    {"sim", Command::Sim, addSim},
    {"verify", Command::Verify, addVerify},
    {"new", Command::New, addNew},
    {"init", Command::Init, addInit},
    {"explain", Command::Explain, addExplain},
    {"list", Command::List, addList},
    {"check", Command::Check, addCheck},
    {"fmt", Command::Fmt, addFmt},
    {"doc", Command::Doc, addDoc},
    {"preview", Command::Preview, addPreview},
    {"lsp", Command::Lsp, addLsp},
    {"outline", Command::Outline, addOutline},
    {"renumber", Command::Renumber, addRenumber},
    {"flatten", Command::Flatten, addFlatten},
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
  if (!any) {
    CLI::App* help = app.add_subcommand("help", "print a page of the manual, or which pages there are");
    help->add_option("TOPIC", raw.inputs, "a page, or a command")->expected(0, 1);
  }
  for (CLI::App* command : app.get_subcommands(nullptr)) {
    command->footer(helpFooter(command->get_name()));
    for (CLI::App* part : command->get_subcommands(nullptr))
      part->footer(helpFooter(command->get_name() + " " + part->get_name()));
  }
}

// What `dotek --help` prints; help() of a program whose command is named is that of the command.
std::string overviewOf(const CLI::App& app) {
  return app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal);
}

// The same, and what each command prints.
std::string helpOfAll(const CLI::App& app) {
  std::vector<CommandFlagsText> commands;
  for (const CLI::App* command : app.get_subcommands(nullptr))
    commands.push_back({command->get_name(), command->help(app.get_name())});
  return commandsPage(overviewOf(app), commands);
}

// `dotek help [TOPIC]`.
int printHelp(const CLI::App& app, std::vector<std::string> topics, std::ostream& out) {
  if (!topics.empty() && helpOn(topics.front()).empty()) topics.front() = lowerCase(topics.front());
  if (topics.empty()) {
    out << overviewOf(app) << "\n" << helpTopics();
    return kDone;
  }
  std::string page = topics.front() == kCommandsTopic ? helpOfAll(app) : helpOn(topics.front());
  for (const CLI::App* command : app.get_subcommands(nullptr)) // of some no page says more
    if (page.empty() && command->get_name() == topics.front()) page = command->help(app.get_name());
  if (page.empty()) {
    const std::string code = topics.front().substr(topics.front().rfind('/') + 1);
    if (const auto codes = lint::codeTable(); std::any_of(
            codes.begin(), codes.end(), [&](const lint::CodeInfo& info) { return info.code == code; }))
      throw UsageError("no page `" + topics.front() + "`; `dotek explain " + code + "` prints what it means");
    const std::string near = nearestName(topics.front(), helpTopicNames());
    throw UsageError("no page `" + topics.front() + "`" +
                     (near.empty() ? "" : "; did you mean `" + near + "`?") + "; `dotek help` lists them");
  }
  out << page;
  return kDone;
}

// CLI11 would only say that a command is missing.
void checkCommand(const CLI::App& app, const std::vector<std::string>& arguments) {
  const auto like = [](const std::string& word, const std::vector<std::string>& known) {
    const std::string near = nearestName(word, known);
    return near.empty() ? std::string() : "; did you mean `" + near + "`?";
  };
  if (arguments.empty()) return;
  const auto isKnown = [](const std::string& word, const std::vector<std::string>& known) {
    return std::find(known.begin(), known.end(), word) != known.end();
  };
  if (arguments.front().starts_with('-')) {
    const std::vector<std::string> flags = {"--help", "-h", "--version"};
    if (arguments.front().starts_with("--") && !isKnown(arguments.front(), flags))
      throw UsageError("no flag `" + arguments.front() + "` before a command" +
                       like(arguments.front(), flags) + "; `dotek --help` prints the commands");
    return;
  }
  std::vector<std::string> known = {"help"};
  for (const CommandFlags& one : kCommands)
    known.emplace_back(one.name);
  if (isKnown(arguments.front(), known)) {
    // `new` has commands of its own.
    std::vector<std::string> parts;
    for (const CLI::App* command : app.get_subcommands(nullptr))
      if (command->get_name() == arguments.front())
        for (const CLI::App* part : command->get_subcommands(nullptr))
          parts.push_back(part->get_name());
    if (parts.empty() || arguments.size() < 2 || arguments[1].starts_with('-') ||
        isKnown(arguments[1], parts))
      return;
    throw UsageError("`dotek " + arguments.front() + "` makes no `" + arguments[1] + "`" +
                     like(arguments[1], parts) + "; `dotek " + arguments.front() +
                     " --help` prints what it makes");
  }
  throw UsageError("no command `" + arguments.front() + "`" + like(arguments.front(), known) +
                   "; `dotek --help` prints the commands");
}

// A flag whose value is an empty text, such as that of a variable of a script which is not set, would count
// as not given.
// `-q`, `--json`: a flag, whether or not the command has it, and no number or name.
bool looksLikeFlag(std::string_view value) {
  if (value.size() < 2 || value.front() != '-') return false;
  const auto isLetter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  if (value[1] != '-') return value.size() == 2 && isLetter(value[1]);
  return value.size() > 2 && isLetter(value[2]) &&
         std::all_of(value.begin() + 2, value.end(), [&](char c) { return isLetter(c) || c == '-'; });
}

void refuseWrongValues(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    for (const CLI::Option* option : command->get_options()) {
      const auto& values = option->results();
      for (const std::string& value : values)
        if (!option->get_positional() && looksLikeFlag(value))
          throw UsageError(
              fmt::format("{} needs a value, and `{}` after it is a flag", option->get_name(), value));
      if (!option->get_positional() && std::find(values.begin(), values.end(), "") != values.end())
        throw UsageError(
            option->get_name() + " needs a value, and its value is empty" +
            (option->get_name() == "--call" ? "; `--call \" \"` calls a macro without arguments" : ""));
    }
    refuseWrongValues(*command);
  }
}

bool isPair(const std::string& argument) {
  const std::size_t equals = argument.find('=');
  return equals != std::string::npos && equals > 0 && !argument.starts_with('-') &&
         argument.find_first_of("/\\.") >= equals;
}

// An argument after `--assume NAME` that is another name, or a misprint of one.
bool isMeantAsAssumption(const std::string& argument) {
  if (project::isAssumption(argument)) return true;
  return argument.find_first_of("/\\.") == std::string::npos && !argument.starts_with('-') &&
         !nearestName(argument, project::assumptionTable()).empty();
}

// `--set A=1 B=2` means `--set A=1 --set B=2`: pairs that follow a flag of pairs belong to it, and names that
// follow `--assume` to that. What is the name of a file is an input, unless it could be both.
std::vector<std::string> spreadPairs(const std::vector<std::string>& arguments) {
  constexpr std::string_view kAssume = "--assume";
  constexpr std::array<std::string_view, 11> kFlags = {"--set",    "--field",    "--host",  "--default",
                                                       "--arg",    "--var",      "--value", "--limit",
                                                       "--result", "--property", kAssume};
  std::vector<std::string> out;
  std::string flag;      // whose values may follow
  bool first = false;    // the next argument is its value
  std::error_code error; // what cannot be a file's name is none
  for (const std::string& argument : arguments) {
    const std::string name = argument.substr(0, argument.find('='));
    const bool isFlag = std::find(kFlags.begin(), kFlags.end(), name) != kFlags.end();
    const auto follows = [&] {
      if (flag != kAssume) return isPair(argument) && !std::filesystem::exists(argument, error);
      if (!std::filesystem::exists(argument, error)) return isMeantAsAssumption(argument);
      if (project::isAssumption(argument))
        throw UsageError("`" + argument + "` after --assume is an assumption and a file; write `--assume " +
                         argument + "`, or `./" + argument + "` for the file");
      return false;
    };
    if (isFlag) {
      flag = name;
      first = name == argument;
    } else if (first) {
      first = false;
    } else if (!flag.empty() && follows()) {
      out.push_back(flag);
    } else {
      flag.clear();
    }
    out.push_back(argument);
  }
  return out;
}

// What another run must be given to be the same.
std::string commandText(const std::vector<std::string>& arguments) {
  std::string out;
  for (const std::string& argument : arguments)
    out += argument + '\0';
  return out;
}

// What tells one program from another, also of one commit.
std::string buildText() {
  std::error_code error;
  const std::filesystem::path program = runningProgram();
  const auto size = std::filesystem::file_size(program, error);
  const auto time = std::filesystem::last_write_time(program, error).time_since_epoch().count();
  return fmt::format("{} {} {} {} {}", kVersion, builtCommit(), dataVersion(), size, time);
}

// A wrong command line. Who asked for a document gets it, whatever was read of the rest.
int refuse(const std::vector<std::string>& arguments, const std::string& text, std::ostream& out,
           std::ostream& err) {
  err << "dotek: error: " << printable(text) << "\n";
  std::string format = "text";
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    constexpr std::string_view kFormat = "--format";
    if (arguments[i] == kFormat && i + 1 < arguments.size())
      format = arguments[i + 1];
    else if (arguments[i].starts_with(fmt::format("{}=", kFormat)))
      format = arguments[i].substr(kFormat.size() + 1);
  }
  const bool json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
  driver::Outcome outcome;
  outcome.status = kUsage;
  outcome.diagnostics.report<diag::CommandLine>({}, text);
  if (!arguments.empty()) out << notRunDocument(arguments.front(), json, format, outcome);
  return kUsage;
}

} // namespace

std::string_view commandName(Command command) {
  const auto at = std::find_if(std::begin(kCommands), std::end(kCommands),
                               [&](const CommandFlags& one) { return one.command == command; });
  return at == std::end(kCommands) ? "" : at->name;
}

std::optional<int> parseArguments(const std::vector<std::string>& arguments, Arguments& parsed,
                                  std::ostream& out, std::ostream& err) {
  Raw raw;
  CLI::App app("Dotek, a compiler for the languages of CNC probing", "dotek");
  app.set_version_flag("--version",
                       fmt::format("dotek {} (commit {}, data {})", kVersion, builtCommit(), dataVersion()));
  app.require_subcommand(1);
  declareCommands(app, arguments, raw);
  try {
    checkCommand(app, arguments);
    std::vector<std::string> reversed = spreadPairs(arguments);
    std::reverse(reversed.begin(), reversed.end());
    app.parse(reversed);
    refuseWrongValues(app);
    const std::string command = app.get_subcommands().front()->get_name();
    if (command == "help") return printHelp(app, raw.inputs, out);
    for (const CommandFlags& one : kCommands)
      if (one.name == command) parsed.command = one.command;
    if (parsed.command == Command::New && app.get_subcommands().front()->got_subcommand("cycle"))
      parsed.command = Command::NewCycle;
    if (parsed.command == Command::New && app.get_subcommands().front()->got_subcommand("macros"))
      parsed.command = Command::NewMacros;
    if (parsed.command == Command::New && app.get_subcommands().front()->got_subcommand("job"))
      parsed.command = Command::NewJob;
    if (parsed.command == Command::New && app.get_subcommands().front()->got_subcommand("post"))
      parsed.command = Command::NewPost;
    fill(raw, parsed);
    parsed.cache = {raw.cache, commandText(arguments), buildText()};
    return std::nullopt;
  } catch (const CLI::Success& success) {
    std::ostringstream text;
    app.exit(success, text, text);
    out << text.str();
    return kDone;
  } catch (const CLI::ParseError& error) {
    return refuse(arguments, mistakeOf(error, app, arguments), out, err);
  } catch (const UsageError& error) {
    return refuse(arguments, error.what(), out, err);
  }
}

} // namespace dotek::cli
