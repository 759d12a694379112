// What is installed beside the program: manual, completions, licences; and the Debian package.
#include "support/Version.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/Process.h"
#include "tests/Skips.h"

#include <doctest/doctest.h>
#include <string>
#include <vector>

using namespace dotek::tests;

namespace {

std::string source() {
  return "SOURCE='" + root().string() + "'\nBUILD=$(dirname \"$DOTEK\")\n";
}

bool have(const ProcessFolder& folder, const std::string& tools) {
  for (const std::string& tool : splitArguments(tools)) {
    if (folder.run("command -v " + tool).status == 0) continue;
    skip("there is no " + tool);
    return false;
  }
  return true;
}

const std::vector<std::string> kCommands = {
    "post",    "run-post", "convert", "lint", "dump", "sim",     "verify", "new",     "init",
    "explain", "list",     "check",   "fmt",  "doc",  "preview", "lsp",    "outline", "renumber"};

} // namespace

TEST_CASE("install: each command has a manual page, made twice alike") {
  const ProcessFolder folder;
  if (!have(folder, "python3 gzip")) return;
  const ShellResult made =
      folder.run(source() + "for out in one two; do python3 $SOURCE/packaging/manual.py --dotek $DOTEK --cli "
                            "$SOURCE/docs/cli.md --out $out --epoch 1700000000; done; diff -r one two");
  REQUIRE_MESSAGE(made.status == 0, made.out << made.err);
  for (const std::string& command : kCommands) {
    const ShellResult page = folder.run("gzip -dc one/man/man1/dotek-" + command + ".1.gz");
    CHECK_MESSAGE(page.status == 0, command);
    CHECK_MESSAGE(page.out.find(".SH OPTIONS") != std::string::npos, command);
  }
  const std::string lint = folder.run("gzip -dc one/man/man1/dotek-lint.1.gz").out;
  CHECK(lint.find("\\fB\\-\\-baseline\\fR") != std::string::npos);
  CHECK(lint.find("2023-11-14") != std::string::npos);
}

TEST_CASE("install: the version is the same wherever it is written") {
  const std::string version(dotek::kVersion);
  const std::string member = "\n  \"version\": \"" + version + "\",\n";
  CHECK(readAll(root() / "editors" / "vscode" / "package.json").find(member) != std::string::npos);
  const std::string lock = readAll(root() / "editors" / "vscode" / "package-lock.json");
  CHECK(lock.find(member) != std::string::npos);
  CHECK(lock.find("\n      \"name\": \"dotek\",\n      \"version\": \"" + version + "\",\n") !=
        std::string::npos);
  // The newest changes are of it.
  const std::string changes = readAll(root() / "CHANGELOG.md");
  CHECK(changes.substr(changes.find("\n## ") + 1).starts_with("## " + version));
  CHECK(runDotek({"--version"}, root()).out.starts_with("dotek " + version + " "));
}

TEST_CASE("install: the completions know commands, flags and values") {
  const ProcessFolder folder;
  if (!have(folder, "python3")) return;
  REQUIRE(folder
              .run(source() +
                   "python3 $SOURCE/packaging/manual.py --dotek $DOTEK --cli $SOURCE/docs/cli.md --out out")
              .status == 0);
  const auto completed = [&](const std::string& words) {
    return folder
        .run("PATH=$(dirname \"$DOTEK\"):$PATH\nsource out/bash-completion/completions/dotek\ncompopt() { :; "
             "}\n"
             "COMP_WORDS=(" +
             words + ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_dotek\necho \" ${COMPREPLY[*]} \"")
        .out;
  };
  CHECK(completed("dotek con").find(" convert ") != std::string::npos);
  CHECK(completed("dotek lint --base").find(" --baseline ") != std::string::npos);
  CHECK(completed("dotek convert --to f").find(" fanuc ") != std::string::npos);
  CHECK(completed("dotek sim --control fanuc-31").find(" fanuc-31i-b ") != std::string::npos);
  CHECK(completed("dotek explain open-if").find(" open-if-at-return ") != std::string::npos);
  CHECK(completed("dotek explain goto-t").find(" goto-target-missing ") != std::string::npos);
  CHECK(completed("dotek explain NC") == "  \n");
  CHECK(completed("dotek lint --select approach-unch").find(" approach-unchecked ") != std::string::npos);
  CHECK(completed("dotek list controls haas").find(" haas-ngc ") != std::string::npos);
  CHECK(completed("dotek help tutorials/my").find(" tutorials/my-first-cycle ") != std::string::npos);
  CHECK(completed("dotek new macros d").find(" dotek ") != std::string::npos);
  CHECK(completed("dotek list cyc").find(" cycles ") != std::string::npos);
  for (const auto& [shell, file] : {std::pair{"zsh", "zsh/vendor-completions/_dotek"},
                                    std::pair{"fish", "fish/vendor_completions.d/dotek.fish"}}) {
    if (!have(folder, shell)) continue;
    const ShellResult read = folder.run(std::string(shell) + " -n out/" + file);
    CHECK_MESSAGE(read.status == 0, shell << ": " << read.err);
  }
}

TEST_CASE("install: the site has each page, and its links lead somewhere") {
  const ProcessFolder folder;
  if (!have(folder, "python3 pandoc")) return;
  const ShellResult made = folder.run(
      source() + "python3 $SOURCE/packaging/site.py --dotek $DOTEK --docs $SOURCE/docs --out site");
  REQUIRE_MESSAGE(made.status == 0, made.out << made.err);
  for (const char* name :
       {"index", "tutorials/my-first-cycle", "rules/README", "commands", "controls", "cycles-library", "cli"})
    CHECK_MESSAGE(!folder.read(std::string("site/") + name + ".html").empty(), name);
  const ShellResult broken = folder.run(R"(cd site && python3 - <<'END'
import glob, os, re
for page in glob.glob("**/*.html", recursive=True):
    for target in re.findall(r'(?:href|src)="([^"#]+)', open(page, encoding="utf-8").read()):
        if "://" not in target and not os.path.exists(os.path.join(os.path.dirname(page), target)):
            print(page, target)
END)");
  CHECK(broken.status == 0);
  CHECK(broken.out == "");
}

TEST_CASE("install: two packages of one program have the same bytes, and hold what belongs to it") {
  if (fewDraws()) return skip("a package is made of the program without the sanitizers");
  const ProcessFolder folder;
  if (!have(folder, "python3 cmake dpkg-deb dpkg-shlibdeps strip")) return;
  const ShellResult made = folder.run(
      source() +
      "for out in one two; do $SOURCE/packaging/deb.sh $BUILD $out; done; cmp one/*.deb two/*.deb");
  REQUIRE_MESSAGE(made.status == 0, made.out << made.err);
  const std::string listed = folder.run("dpkg-deb -c one/*.deb").out;
  for (const char* name :
       {"/usr/bin/dotek\n", "/usr/share/man/man1/dotek.1.gz\n",
        "/usr/share/bash-completion/completions/dotek\n", "/usr/share/doc/dotek/copyright\n",
        "/usr/share/doc/dotek/docs/cycles.md\n", "/usr/share/doc/dotek/examples/post.txt\n",
        "/usr/share/dotek/controls/fanuc-31i-b.toml\n", "/usr/share/dotek/macrob/dotek.nc\n",
        "/usr/share/doc/dotek/docs/schemas/sim.schema.json\n",
        "/usr/share/doc/dotek/.pre-commit-hooks.yaml\n"})
    CHECK_MESSAGE(listed.find(name) != std::string::npos, name << " is not in " << listed);
  CHECK(listed.find(".h\n") == std::string::npos);
  CHECK(listed.find(".a\n") == std::string::npos);
  CHECK(folder.run("dpkg-deb -f one/*.deb Depends").out.find("libc6 (>= ") != std::string::npos);
  // As unpacked, it runs.
  const ShellResult used = folder.run(
      "dpkg-deb -x one/*.deb tree; tree/usr/bin/dotek lint tree/usr/share/doc/dotek/examples/surface-x");
  CHECK_MESSAGE(used.status == 0, used.out << used.err);
}
