// The commands that the pages of docs/ show: each runs as it is printed, or says here why not. README and the
// tutorials, which also show what is printed, are Manual.test.cpp's; rules and messages have tests of their
// own.
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/Process.h"
#include "tests/Skips.h"

#include <algorithm>
#include <cctype>
#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

// What is not run, by the beginning of the command; "": on each page.
struct NotRun {
  std::string_view page, begin, reason;
};
constexpr NotRun kNotRun[] = {
    {"", "./dev ", "builds, tests or measures Dotek itself; the subcommand is looked up"},
    {"cli.md", "dotek ", "a synopsis; its flags are compared with --help"},
    {"fusion-kernel.md", "dotek ", "a synopsis; its flags are compared with --help"},
    {"install.md", "sudo apt install", "changes the machine; Install.test.cpp unpacks the package"},
    {"install.md", "cmake --install", "Package.test.cpp installs below a prefix of its own"},
    {"library.md", "cmake ", "Package.test.cpp builds both projects"},
    {"mikroprog.md", "dotek convert MERENI.OSA.X", "the cycle is of the corpus"},
    {"performance.md", "rm -rf build", "builds Dotek from empty"},
    {"performance.md", "dotek verify CYCLE", "takes a cycle of the corpus"},
    {"testing.md", "ctest ", "runs the tests, this one too"},
    {"testing.md", "tests/shops/cycles.py", "runs for minutes"},
};

// Their status is 1, since there is a finding.
constexpr std::pair<std::string_view, std::string_view> kFinds[] = {
    {"ci.md", "dotek lint programs posts --format sarif > dotek.sarif"},
    {"run-my-macro.md", "dotek sim examples/macros/bore.nc --call \"D16. Z-5.\""},
    {"run-my-macro.md", "dotek sim examples/macros/bore.nc --call \"D30.\""},
    {"run-my-macro.md", "dotek sim examples/macros/bore.nc --call \"D30. Z-5.\" --part"},
    {"run-my-macro.md", "dotek sim examples/macros/tool-break.nc --call \"T5.\" --tool 5 --length 87.4"},
    {"fusion-lathe.md", "dotek run-post s280.cps examples/s280-job.toml --check"},
};

// A repository with a program that has a known finding, a post and cycles, and the branch `main` of its
// origin.
constexpr std::string_view kRepository = R"(mkdir programs posts cycles
cp examples/macros/*.nc programs; cp examples/post.txt posts; cp examples/cycles/*.cycle cycles
printf 'O1001\nG90 G21\nGOTO 50\nN10 M30\n' >programs/O1001.nc
dotek lint programs posts --write-baseline known.json --quiet >/dev/null
export HOME=$PWD GIT_CONFIG_NOSYSTEM=1
git init -q -b main; git config user.name n; git config user.email n@n
git add -A; git commit -q -m all; git update-ref refs/remotes/origin/main HEAD
printf 'O1002\nG90 G21\nN10 M30\n' >programs/O1002.nc
)";

// What a page takes for granted.
const std::map<std::string, std::string, std::less<>>& setups() {
  static const std::string kPart =
      R"(cp examples/macros/plate.toml part.toml; cp examples/macros/mill.toml machine.toml
printf '%%\nO1000 (FACE)\nG90 G21 G54\nG0 X0 Y0 Z50.\nG1 Z1. F500\nX100. F200\nG0 Z50.\nM30\n%%\n' >part.nc
printf '%%\nO1000\nG90 G21 G54\nG43 H1 Z20.\nG0 X60. Y-10.\nG31 Z5. F500.\nM30\n%%\n' >probe.nc
printf '%%\nO1000\nG90 G21 G53 G0 Z0\nG53 X-10. Y-10.\nG91 G31 Z-5. F500.\nM30\n%%\n' >travel.nc
mkdir macros; printf '%%\nO9000\n#501=#500*2\nM99\n%%\n' >macros/O9000.nc
printf '%%\nO1\nG65 P9000\nM30\n%%\n' >main.nc
printf 'N10 G90\nN20 G0 X10 Y10\nN30 M30\n' >PART.SUF
printf '%%\nO1001\nT0101\nG0 X40. Z2.\nG90 X30. Z-20. F.2\nG0 X100. Z50.\nM30\n%%\n' >shaft.nc
)";
  static const std::map<std::string, std::string, std::less<>> all = {
      {"ci.md", std::string(kRepository) +
                    R"(dotek lint programs --format sarif --fail-on never 2>/dev/null >after.sarif
jq -r '.runs[].results[] | [.locations[0].physicalLocation.artifactLocation.uri, .ruleId,
       (.partialFingerprints | to_entries[].value), (.relatedLocations // [] | length)] | @tsv' after.sarif | sort >before.txt
)"},
      {"part.md", kPart},
      {"pocket-6m.md",
       R"({ echo %; cat examples/pocket-6m/main.nc $(ls examples/pocket-6m/macros/*.nc | grep -v O15) | grep -v '^%'
printf 'O15\n#105=0\nM99\n%%\n'; } >pocket.nc
)"},
      {"sim.md", kPart},
  };
  return all;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    out.push_back(line);
  return out;
}

bool isCommand(std::string_view line) {
  static constexpr std::string_view kWords[] = {"dotek ", "./dev ", "cmake ", "sudo ",  "rm ",
                                                "git ",   "jq ",    "ctest ", "mkdir ", "tests/",
                                                "comm ",  "test ",  "DOTEK_"};
  return std::any_of(std::begin(kWords), std::end(kWords),
                     [&](std::string_view word) { return line.starts_with(word); });
}

// Each with its further lines, without the four blanks.
std::vector<std::string> commandsOf(const std::string& page) {
  std::vector<std::string> out;
  bool open = false;
  for (const std::string& line : linesOf(page)) {
    const std::string text = line.starts_with("    ") ? line.substr(4) : "";
    if (open) {
      out.back() += "\n" + text;
    } else {
      if (!isCommand(text)) continue;
      out.push_back(text);
    }
    const std::string code = out.back().substr(0, out.back().find("  # ")); // a comment may hold a quote
    open = text.ends_with('\\') || std::count(code.begin(), code.end(), '\'') % 2 == 1;
  }
  return out;
}

const NotRun* notRun(const std::string& page, std::string command) {
  while (command.starts_with("DOTEK_")) // a variable of its environment
    command.erase(0, command.find(' ') + 1);
  const auto* const found = std::find_if(std::begin(kNotRun), std::end(kNotRun), [&](const NotRun& one) {
    return (one.page.empty() || one.page == page) && command.starts_with(one.begin);
  });
  return found == std::end(kNotRun) ? nullptr : found;
}

int wantedStatus(const std::string& page, const std::string& command) {
  return std::any_of(std::begin(kFinds), std::end(kFinds),
                     [&](const auto& one) { return one.first == page && command.starts_with(one.second); });
}

std::map<std::string, std::string> pages() {
  std::map<std::string, std::string> out;
  for (const auto& entry : fs::directory_iterator(root() / "docs"))
    if (entry.path().extension() == ".md") out[entry.path().filename().string()] = readAll(entry.path());
  return out;
}

void prepare(const ProcessFolder& folder, const std::string& page) {
  fs::copy(root() / "examples", folder.path("examples"), fs::copy_options::recursive);
  const auto setup = setups().find(page);
  if (setup == setups().end()) return;
  const ShellResult result = folder.run(setup->second);
  REQUIRE_MESSAGE(result.status == 0, page << ": " << result.err);
}

// Flags of a text: "--set".
std::set<std::string> flagsOf(const std::string& text) {
  std::set<std::string> out;
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) {
    std::size_t end = at + 2;
    while (end < text.size() &&
           (std::islower(static_cast<unsigned char>(text[end])) != 0 || text[end] == '-'))
      ++end;
    if (end > at + 2) out.insert(text.substr(at, end - at));
    at = end;
  }
  return out;
}

// The steps of a workflow, as GitHub gives them to a shell.
std::vector<std::string> stepsOf(const std::string& page) {
  std::vector<std::string> out;
  std::size_t indent = std::string::npos; // of `run: |`
  for (const std::string& line : linesOf(page)) {
    const std::size_t first = line.find_first_not_of(" -");
    if (indent != std::string::npos) {
      const std::size_t column = line.find_first_not_of(' ');
      if (column == std::string::npos || column > indent) {
        out.back() += line.substr(std::min(line.size(), indent + 2)) + "\n";
        continue;
      }
      indent = std::string::npos;
    }
    if (first == std::string::npos || first < 4 || line.substr(first, 5) != "run: ") continue;
    const std::string text = line.substr(first + 5);
    out.push_back(text == "|" ? "" : text + "\n");
    if (text == "|") indent = first;
  }
  return out;
}

} // namespace

TEST_CASE("documents: the commands of each page run as they are printed") {
  int ran = 0;
  std::map<std::string_view, int> left; // by reason
  std::set<const NotRun*> used;
  std::size_t number = 0;
  for (const auto& [page, text] : pages()) {
    const std::vector<std::string> commands = commandsOf(text);
    if (commands.empty()) continue;
    const bool listed = fewDraws() && number++ % 4 != 0; // its commands do not run
    const ProcessFolder folder;
    bool prepared = false;
    for (const std::string& command : commands) {
      if (const NotRun* const one = notRun(page, command)) {
        ++left[one->reason];
        used.insert(one);
        continue;
      }
      if (listed) continue;
      if (command.starts_with("jq ") && folder.run("command -v jq").status != 0) {
        skip("there is no jq");
        break;
      }
      if (!prepared) prepare(folder, page);
      prepared = true;
      const ShellResult result = folder.run("set -o pipefail\n" + command);
      CHECK_MESSAGE(result.status == wantedStatus(page, command), page << ": " << command << "\nends with "
                                                                       << result.status << " and "
                                                                       << result.out << result.err);
      ++ran;
    }
  }
  for (const auto& [reason, count] : left)
    MESSAGE("not run: " << count << ": " << reason);
  for (const NotRun& one : kNotRun)
    CHECK_MESSAGE(used.contains(&one), one.page << ": " << one.begin << " is nowhere");
  CHECK(ran > (fewDraws() ? 10 : 40));
}

TEST_CASE("documents: a synopsis has flags that the command has, and each subcommand of ./dev is one") {
  const std::string dev = readAll(root() / "dev");
  for (const auto& [page, text] : pages()) {
    for (std::string command : commandsOf(text)) {
      while (command.starts_with("DOTEK_"))
        command.erase(0, command.find(' ') + 1);
      if (!command.starts_with("./dev ")) continue;
      const std::string name = command.substr(6, command.find_first_of(" \n", 6) - 6);
      CHECK_MESSAGE(dev.find("\ncmd_" + name + "() {") != std::string::npos, page << ": " << command);
    }
  }
  for (const char* page : {"cli.md", "fusion-kernel.md"}) {
    std::string command; // whose lines these are
    std::set<std::string> known;
    int flags = 0;
    const std::string text = readAll(root() / "docs" / page);
    for (const std::string& line : linesOf(text.substr(0, text.find("\n## ")))) {
      if (line.starts_with("    dotek ")) {
        std::istringstream words(line.substr(10));
        std::string sub;
        words >> command >> sub;
        std::vector<std::string> arguments = {command};
        if (command == "new") arguments.push_back(sub);
        arguments.emplace_back("--help");
        known = flagsOf(runDotek(arguments, root()).out);
      } else if (line.starts_with("    READING:")) {
        known = flagsOf(runDotek({"convert", "--help"}, root()).out);
      } else if (!line.starts_with("     ")) {
        known.clear();
        continue;
      }
      for (const std::string& flag : flagsOf(line)) {
        if (known.empty()) break;
        CHECK_MESSAGE(known.contains(flag), page << ": " << command << " has no " << flag);
        ++flags;
      }
    }
    CHECK(flags > 4);
  }
}

TEST_CASE("documents: the steps of the workflow of ci.md run in a repository of programs") {
  const ProcessFolder folder;
  if (folder.run("command -v git").status != 0) return skip("there is no git");
  fs::copy(root() / "examples", folder.path("examples"), fs::copy_options::recursive);
  const ShellResult made = folder.run(std::string(kRepository));
  REQUIRE_MESSAGE(made.status == 0, made.err);
  const std::string environment = "export HOME=$PWD GITHUB_WORKSPACE=$PWD GITHUB_BASE_REF=main "
                                  "GITHUB_STEP_SUMMARY=$PWD/summary.md\nset -eo pipefail\n";
  int ran = 0, left = 0;
  for (const std::string& step : stepsOf(readAll(root() / "docs" / "ci.md"))) {
    // As in GitHub's shell: installing and building change the machine.
    if (step.starts_with("apt-get ") || step.find("./dev package") != std::string::npos) {
      ++left;
      continue;
    }
    const ShellResult result = folder.run(environment + step);
    CHECK_MESSAGE(result.status == 0,
                  step << "\nends with " << result.status << " and " << result.out << result.err);
    ++ran;
  }
  MESSAGE("not run: " << left << ": steps of the workflow that install and build");
  CHECK(ran == 5);
  CHECK(left == 3);
  CHECK(folder.read("dotek.sarif").find("\"version\": \"2.1.0\"") != std::string::npos);
  CHECK(!folder.read("summary.md").empty());

  // A defect that is new fails the first of them and is in the report.
  folder.write("programs/O1003.nc", "O1003\nG90 G21\nGOTO 50\nN10 M30\n");
  const ShellResult found =
      folder.run(environment + "dotek lint programs posts --baseline known.json --format github");
  CHECK(found.status == 1);
  CHECK(found.out.find("::error file=programs/O1003.nc,line=3") != std::string::npos);
}
