// The manual in the program, the examples of each help, and the commands of README and tutorials: all run.
#include "cli/Help.h"
#include "tests/GoldenRunner.h"
#include "tests/Goldens.h"
#include "tests/Process.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <filesystem>
#include <sstream>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

std::vector<std::string> linesOfText(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    out.push_back(line);
  return out;
}

void copyExamples(const ProcessFolder& folder) {
  fs::copy(root() / "examples", folder.path("examples"), fs::copy_options::recursive);
}

// What fails says so: a status that is not 0 comes with a finding.
bool saysWhy(const ShellResult& result) {
  return result.status == 0 || result.out.find("error: ") != std::string::npos ||
         result.out.find("warning: ") != std::string::npos ||
         result.out.find("::error ") != std::string::npos;
}

// The text with the output of each command `    $ COMMAND` as it is now. A command goes on to the END of its
// here-document, or after a `\`.
std::string ranAgain(const std::string& text) {
  const ProcessFolder folder;
  copyExamples(folder);
  const std::vector<std::string> lines = linesOfText(text);
  std::string out;
  for (std::size_t i = 0; i < lines.size();) {
    out += lines[i] + "\n";
    if (!lines[i].starts_with("    $ ")) {
      ++i;
      continue;
    }
    std::string command = lines[i].substr(6);
    const bool document = command.ends_with("<<'END'");
    for (++i; i < lines.size() && (document ? !command.ends_with("\nEND") : command.ends_with("\\")); ++i) {
      out += lines[i] + "\n";
      command += "\n" + (lines[i].size() > 4 ? lines[i].substr(4) : "");
    }
    while (i < lines.size() && lines[i].starts_with("    ") && !lines[i].starts_with("    $ "))
      ++i;
    const ShellResult result = folder.run("exec 2>&1\n" + command);
    CHECK_MESSAGE(saysWhy(result), command << " ends with " << result.status << " and " << result.out);
    for (const std::string& line : linesOfText(result.out))
      out += line.empty() ? "    \n" : "    " + line + "\n";
  }
  return out;
}

} // namespace

TEST_CASE("manual: README and tutorials show what their commands print") {
  std::vector<fs::path> pages = {root() / "README.md"};
  for (const auto& entry : fs::directory_iterator(root() / "docs" / "tutorials"))
    pages.push_back(entry.path());
  std::sort(pages.begin(), pages.end());
  CHECK(pages.size() >= 5);
  int rewritten = 0;
  for (const fs::path& page : pages) {
    const std::string text = readAll(page);
    CHECK_MESSAGE(text.find("\n    $ dotek ") != std::string::npos, page.string());
    const std::string difference =
        settle({page.parent_path(), page, ""}, ranAgain(text), settings().update, rewritten);
    CHECK_MESSAGE(difference.empty(), page.string() << ": " << difference);
  }
}

TEST_CASE("manual: the examples of each command run, and its page is there") {
  const std::string overview = runDotek({"--help"}, root()).out;
  const std::size_t at = overview.find("\nSubcommands:\n");
  REQUIRE(at != std::string::npos);
  const ProcessFolder folder;
  copyExamples(folder);
  int commands = 0;
  for (const std::string& line : linesOfText(overview.substr(at + 14))) {
    const std::string command = line.size() > 2 ? line.substr(2, line.find(' ', 2) - 2) : "";
    if (command.empty()) continue;
    ++commands;
    const std::string help = runDotek({command, "--help"}, root()).out;
    const std::size_t more = help.find("\nMore: `dotek help ");
    REQUIRE_MESSAGE(more != std::string::npos, command);
    const std::string topic = help.substr(more + 19, help.find('`', more + 19) - more - 19);
    CHECK_MESSAGE(!dotek::cli::helpOn(topic).empty(), command << ": " << topic);
    CHECK_MESSAGE(help.find("(docs/", more) != std::string::npos, command);
    const std::size_t examples = help.find("\nExamples:\n");
    REQUIRE_MESSAGE(examples != std::string::npos, command);
    if (command == "lsp") continue; // an editor that starts it: LspEditors.test.cpp runs one
    const ShellResult result = folder.run("set -e\n" + help.substr(examples + 11, more - examples - 11));
    CHECK_MESSAGE(result.status == 0, command << ": " << result.err);
  }
  CHECK(commands > 15);
}

TEST_CASE("manual: each part of `dotek new` has its examples, and they run") {
  const std::string overview = runDotek({"new", "--help"}, root()).out;
  const std::size_t at = overview.find("\nSubcommands:\n");
  REQUIRE(at != std::string::npos);
  const ProcessFolder folder;
  copyExamples(folder);
  int parts = 0;
  for (const std::string& line : linesOfText(overview.substr(at + 14))) {
    if (line.empty()) break; // examples follow
    if (line.size() < 3 || !line.starts_with("  ") || line[2] == ' ') continue;
    const std::string part = line.substr(2, line.find(' ', 2) - 2);
    const std::string help = runDotek({"new", part, "--help"}, root()).out;
    const std::size_t more = help.find("\nMore: `dotek help "), examples = help.find("\nExamples:\n");
    REQUIRE_MESSAGE(more != std::string::npos, part);
    REQUIRE_MESSAGE(examples != std::string::npos, part);
    const std::string topic = help.substr(more + 19, help.find('`', more + 19) - more - 19);
    CHECK_MESSAGE(!dotek::cli::helpOn(topic).empty(), part << ": " << topic);
    const ShellResult result =
        folder.run("rm -f shop.cps\nset -e\n" + help.substr(examples + 11, more - examples - 11));
    CHECK_MESSAGE(result.status == 0, part << ": " << result.err);
    ++parts;
  }
  CHECK(parts == 6);
}

TEST_CASE("manual: a misspelt command, part of a command or flag is answered with the one that is meant") {
  const auto said = [](const std::vector<std::string>& arguments) { return runDotek(arguments, root()).err; };
  CHECK(said({"lintt", "a.nc"}).find("did you mean `lint`?") != std::string::npos);
  CHECK(said({"new", "cicle", "x"}).find("did you mean `cycle`?") != std::string::npos);
  CHECK(said({"--verion"}).find("did you mean `--version`?") != std::string::npos);
  CHECK(runDotek({"help", "LINT"}, root()).status == 0);
  CHECK(runDotek({"explain", "GOTO-TARGET-MISSING"}, root()).status == 0);
}

TEST_CASE("manual: dotek help prints every page of docs/, and those that the program makes") {
  int pages = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root() / "docs")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".md" && extension != ".json") continue;
    ++pages;
    fs::path name = fs::relative(entry.path(), root() / "docs");
    CHECK_MESSAGE(dotek::cli::helpOn(name.generic_string()) == readAll(entry.path()), name.string());
    if (extension == ".md")
      CHECK(dotek::cli::helpOn(name.replace_extension().generic_string()) == readAll(entry.path()));
  }
  CHECK(pages > 300);
  CHECK(runDotek({"help", "rules"}, root()).out == readAll(root() / "docs" / "rules" / "README.md"));
  const std::string messages = runDotek({"help", "messages"}, root()).out;
  for (const auto& entry : fs::directory_iterator(root() / "docs" / "messages"))
    CHECK_MESSAGE(messages.find(" messages/" + entry.path().stem().string() + " ") != std::string::npos,
                  entry.path().string());
  const auto indented = [](const std::string& text) {
    std::string out;
    for (const std::string& line : linesOfText(text))
      out += line.empty() ? "\n" : "    " + line + "\n";
    return out;
  };
  const std::string commands = runDotek({"help", "commands"}, root()).out;
  CHECK(commands.starts_with("# Commands\n\n" + indented(runDotek({"--help"}, root()).out)));
  for (const char* command : {"lint", "flatten", "help"})
    CHECK_MESSAGE(commands.find("\n## " + std::string(command) + "\n\n" +
                                indented(runDotek({command, "--help"}, root()).out)) != std::string::npos,
                  command);
  const std::string controls = runDotek({"help", "controls"}, root()).out;
  CHECK(controls.find(indented(runDotek({"list", "controls", "fanuc-31i-b"}, root()).out)) !=
        std::string::npos);
  CHECK(runDotek({"help", "cycles-library"}, root()).out ==
        "# Cycles of the library\n\n" + runDotek({"doc"}, root()).out);
}

TEST_CASE("manual: dotek help prints a page, the section of a command, or the list") {
  CHECK(runDotek({"help", "cycles"}, root()).out == readAll(root() / "docs" / "cycles.md"));
  CHECK(runDotek({"help", "docs/cycles.md"}, root()).out == readAll(root() / "docs" / "cycles.md"));
  CHECK(runDotek({"help", "my-first-cycle"}, root()).out ==
        readAll(root() / "docs" / "tutorials" / "my-first-cycle.md"));
  CHECK(runDotek({"help", "dump"}, root()).out.starts_with("## dump\n"));
  CHECK(runDotek({"help", "list"}, root()).out.starts_with("## explain, list\n"));
  const CommandResult list = runDotek({"help"}, root());
  CHECK(list.status == 0);
  CHECK(list.out.starts_with(runDotek({"--help"}, root()).out));
  for (const dotek::cli::HelpPage& page : dotek::cli::helpPages())
    CHECK_MESSAGE(list.out.find("\n  " + std::string(page.name.substr(0, page.name.find(".md"))) + " ") !=
                      std::string::npos,
                  page.name);
  // A command that has no page or section of its own; the code of a message.
  for (const char* command : {"check", "lsp"})
    CHECK(runDotek({"help", command}, root()).out == runDotek({command, "--help"}, root()).out);
  for (const char* topic : {"rules/small-letter", "small-letter"})
    CHECK(runDotek({"help", topic}, root()).err.find("`dotek explain small-letter`") != std::string::npos);
  const CommandResult misspelt = runDotek({"help", "cycels"}, root());
  CHECK(misspelt.status == 2);
  CHECK(misspelt.err.find("did you mean `cycles`?") != std::string::npos);
}

TEST_CASE("manual: a cell of the table beside other tools that says no says why") {
  int cells = 0;
  for (const std::string& line : linesOfText(readAll(root() / "docs" / "peers.md"))) {
    if (!line.starts_with("| ") || line.starts_with("| |")) continue;
    std::istringstream row(line.substr(1));
    for (std::string cell; std::getline(row, cell, '|'); ++cells)
      CHECK_MESSAGE((cell != " no " && cell.find_first_not_of(' ') != std::string::npos), line);
  }
  CHECK(cells > 100);
}
