// The frame of lint: suppressions, fixes, dotek.toml, SARIF.
#include "support/messages/Lint.h"
#include "tests/GoldenRunner.h"
#include "tests/Process.h"
#include "tests/unit/DataFolder.h"

#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

struct Run {
  int status = 0;
  std::vector<std::string> findings; // "FILE:LINE code"
};

Run lint(const DataFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "lint");
  arguments.insert(arguments.end(), {"--format", "json"});
  const CommandResult result = runDotek(arguments, folder.path());
  Run run{result.status, {}};
  REQUIRE_MESSAGE(nlohmann::json::accept(result.out), result.err << result.out);
  for (const auto& one : nlohmann::json::parse(result.out))
    run.findings.push_back(one["file"].get<std::string>() + ":" + std::to_string(one["line"].get<int>()) +
                           " " + one["code"].get<std::string>());
  return run;
}

using Findings = std::vector<std::string>;

const std::string kDuplicate = "progStart:\n SeqC SpinOff EOL\n SeqC ' M5' EOL\nRETURN\n";

} // namespace

TEST_CASE("lint: a rule that is off by default runs where it is selected, and for all") {
  const DataFolder folder;
  folder.write("p.txt", "progStart:\n SeqC ' G43 H1''' EOL\nRETURN\n");
  CHECK(lint(folder, {"p.txt"}).findings.empty());
  CHECK(lint(folder, {"p.txt", "--select", "empty-literal"}).findings == Findings{"p.txt:2 empty-literal"});
  CHECK(lint(folder, {"p.txt", "--select", "all"}).findings == Findings{"p.txt:2 empty-literal"});
  CHECK(lint(folder, {"p.txt", "--select", "all", "--ignore", "empty-literal"}).findings.empty());
  CHECK(lint(folder, {"p.txt", "--select", "all"}).status == 0);
  CHECK(lint(folder, {"p.txt", "--select", "all", "--fail-on", "note"}).status == 1);
}

TEST_CASE("lint: comments suppress on their line, on the next, in a region and in a file") {
  const DataFolder folder;
  const auto findings = [&](const std::string& text) {
    folder.write("p.txt", text);
    return lint(folder, {"p.txt"}).findings;
  };
  const std::string code = "literal-duplicates-command";
  CHECK(findings(kDuplicate) == Findings{"p.txt:3 " + code});
  CHECK(findings("progStart:\n SeqC SpinOff EOL\n SeqC ' M5' EOL { dotek: ignore " + code + " }\nRETURN\n")
            .empty());
  CHECK(
      findings("progStart:\n SeqC SpinOff EOL\n { dotek: ignore " + code + " }\n\n SeqC ' M5' EOL\nRETURN\n")
          .empty());
  CHECK(findings("{ dotek: ignore-file " + code + " }\n" + kDuplicate).empty());
  CHECK(findings("{DOTEK : IGNORE-FILE Literal-Duplicates-Command, field-not-defined -- agreed}\n" +
                 kDuplicate) == Findings{});
  CHECK(findings("progStart:\n SeqC SpinOff EOL\n {dotek: ignore-start " + code +
                 "}\n SeqC ' M5' EOL\n {dotek: "
                 "ignore-end " +
                 code + "}\n SeqC ' M5' EOL\nRETURN\n") == Findings{"p.txt:6 " + code});
  // A comment of another line suppresses nothing, and says so.
  CHECK(findings("progStart: { dotek: ignore " + code + " }\n SeqC SpinOff EOL\n SeqC ' M5' EOL\nRETURN\n") ==
        Findings{"p.txt:1 suppression-unused", "p.txt:3 " + code});
}

TEST_CASE("lint: suppressions in macros, dialogs, DefineData.txt and programs, of messages too") {
  const DataFolder folder;
  folder.write("a.mac", "goto nowhere ! dotek: ignore undefined-label\n");
  folder.write("d.dlg", "dialog \"x\", 1, 1, 200, 100\n! dotek: ignore control-outside-window\n"
                        "ok 190, 20, 70, 24\ncancel 20, 60, 70, 24\n");
  folder.write("o.nc", "%\nO1\n#501=#501 (DOTEK: IGNORE ASSIGNED-TO-ITSELF)\nM30\n%\n");
  folder.write("touch/DefineData.txt", "a = 1\n! dotek: ignore duplicate-definition\nA = 2\n");
  CHECK(lint(folder, {"a.mac", "d.dlg", "o.nc"}).findings.empty());
  CHECK(lint(folder, {"touch", "--ignore", "cycle-file-missing"}).findings.empty());
}

TEST_CASE("lint: suppressions in the comments of Mikroprog") {
  const DataFolder folder;
  const auto findings = [&](const std::string& text) {
    folder.write("p.suf", text);
    return lint(folder, {"p.suf", "--select", "all"}).findings;
  };
  const std::string begin = "N10 G18 G90 G94\n", end = "N90 M30\n";
  CHECK(findings(begin + "N20 G92 Z0\n" + end) == Findings{"p.suf:2 suf-datum-lasts"});
  CHECK(findings(begin + "N20 G92 Z0 ;dotek: ignore suf-datum-lasts\n" + end).empty());
  CHECK(findings(begin + "; DOTEK: IGNORE SUF-DATUM-LASTS -- MEANT\nN20 G92 Z0\n" + end).empty());
  CHECK(findings(";dotek: ignore-file suf-no-end\n" + begin).empty());
  CHECK(
      findings(";dotek: ignore-start suf-datum-lasts\nN20 G92 Z0\n;dotek: ignore-end suf-datum-lasts\n" + end)
          .empty());
  // A line that cannot be read keeps its comment, and messages of the reader are findings, too.
  CHECK(findings(begin + "N20 (WORK ;dotek: ignore suf-other-control\n" + end).empty());
  CHECK(findings(begin + "N20 G92 Z0 ;dotek: ignore suf-datum-last\n" + end) ==
        Findings{"p.suf:2 suf-datum-lasts", "p.suf:2 suppression-unknown"});
  CHECK(findings(begin + "N20 G92 Z0 ;dotek: ignored suf-datum-lasts\n" + end) ==
        Findings{"p.suf:2 suf-datum-lasts", "p.suf:2 suppression-form"});
  CHECK(findings(begin + "N20 G0 Z0 ;dotek: ignore suf-datum-lasts\n" + end) ==
        Findings{"p.suf:2 suppression-unused"});
}

TEST_CASE("lint: what is wrong with a suppression") {
  const DataFolder folder;
  const auto findings = [&](const std::string& comment) {
    folder.write("a.mac", "! dotek: " + comment + "\nmessage \"x\"\n");
    return lint(folder, {"a.mac"}).findings;
  };
  CHECK(findings("ignore undefined-label") == Findings{"a.mac:1 suppression-unused"});
  CHECK(findings("ignore undefind-label") == Findings{"a.mac:1 suppression-unknown"});
  CHECK(findings("ignore") == Findings{"a.mac:1 suppression-form"});
  CHECK(findings("silence undefined-label") == Findings{"a.mac:1 suppression-form"});
  CHECK(findings("ignore-start undefined-label") ==
        Findings{"a.mac:1 suppression-form", "a.mac:1 suppression-unused"});
  CHECK(findings("ignore-end undefined-label") == Findings{"a.mac:1 suppression-form"});
  // Of a rule that does not run nothing is known.
  CHECK(findings("ignore return-code-constant").empty());
  CHECK(findings("ignore field-not-defined").empty());
}

TEST_CASE("lint --fix makes the safe repairs and says what is left") {
  const DataFolder folder;
  const std::string text =
      "\xEF\xBB\xBFprogStart:\r\n SetFlag('a')\r\n IF Flag? ('a')\r\n  SeqC' M32''' EOL\r\n"
      "  SeqC ' G0 Z5. F100' EOL\r\n END\r\nRETURN\r\n";
  const std::string path = folder.write("p.txt", text);
  folder.write("same.txt", kDuplicate);
  const Run shown = lint(folder, {"p.txt", "--select", "all"});
  CHECK(readAll(path) == text);
  CHECK(shown.findings.size() == 4);
  const Run run = lint(folder, {"p.txt", "--select", "all", "--fix"});
  CHECK(run.findings == Findings{"p.txt:3 " + std::string(dotek::diag::FixesApplied::code),
                                 "p.txt:4 " + std::string(dotek::diag::FixesApplied::code),
                                 "p.txt:4 " + std::string(dotek::diag::FixesApplied::code),
                                 "p.txt:5 feed-on-rapid"});
  CHECK(readAll(path) == "\xEF\xBB\xBFprogStart:\r\n SetFlag('a')\r\n IF Flag?('a')\r\n  SeqC ' M32' EOL\r\n"
                         "  SeqC ' G0 Z5. F100' EOL\r\n END\r\nRETURN\r\n");
  CHECK(lint(folder, {"p.txt", "--select", "all", "--fix"}).findings == Findings{"p.txt:5 feed-on-rapid"});
  // Nothing that is not wanted is repaired, and nothing that is only shown.
  folder.write("p.txt", text);
  CHECK(lint(folder, {"p.txt", "--fix"}).findings.empty());
  CHECK(readAll(path) == text);
  const std::string open = "main:\n IF CycleType?('x')\n  ' A' EOL\nRETURN\n";
  const std::string prog = folder.write("open.txt", open);
  lint(folder, {"open.txt", "--fix"});
  CHECK(readAll(prog) == open);
}

TEST_CASE("lint --fix --diff prints what --fix would write, and changes nothing") {
  const DataFolder folder;
  const std::string text = "progStart:\r\n SetFlag('a')\r\n IF Flag? ('a')\r\n  SeqC' M32''' EOL\r\n"
                           "  SeqC ' G0 Z5. F100' EOL\r\n END\r\nRETURN\r\n";
  const std::string path = folder.write("p.txt", text);
  const CommandResult shown =
      runDotek({"lint", "p.txt", "--select", "all", "--fix", "--diff"}, folder.path());
  CHECK(readAll(path) == text);
  CHECK(shown.status == 1);
  CHECK(shown.out ==
        "--- p.txt\n+++ p.txt\n@@ -1,7 +1,7 @@\n progStart:\r\n  SetFlag('a')\r\n- IF Flag? ('a')\r\n"
        "-  SeqC' M32''' EOL\r\n+ IF Flag?('a')\r\n+  SeqC ' M32' EOL\r\n"
        "   SeqC ' G0 Z5. F100' EOL\r\n  END\r\n RETURN\r\n");
  CHECK(shown.err == "3 repairs in 1 file would be made; nothing is changed\n");
  // What one repair lays bare is in it: applied, it is what --fix writes.
  lint(folder, {"p.txt", "--select", "all", "--fix"});
  const CommandResult none = runDotek({"lint", "p.txt", "--select", "all", "--fix", "--diff"}, folder.path());
  CHECK(none.out == "");
  CHECK(none.status == 0); // a note is left
  CHECK(runDotek({"lint", "p.txt", "--diff"}, folder.path()).status == 2);
  for (const std::vector<std::string>& other :
       {std::vector<std::string>{"--statistics"}, {"--write-baseline", "known.json"}, {"--format", "json"}}) {
    std::vector<std::string> arguments = {"lint", "p.txt", "--fix", "--diff"};
    arguments.insert(arguments.end(), other.begin(), other.end());
    CHECK_MESSAGE(runDotek(arguments, folder.path()).status == 2, other.front());
  }
}

TEST_CASE("lint: dotek.toml is found above the input and says what is wanted") {
  const DataFolder folder;
  folder.write("dotek.toml",
               "schema = 1\n[lint]\nignore = [\"literal-duplicates-command\"]\nfail-on = \"note\"\n"
               "[lint.severity]\nempty-literal = \"error\"\n");
  folder.write("posts/p.txt", "progStart:\n SeqC SpinOff EOL\n SeqC ' M5''' EOL\nRETURN\n");
  Run run = lint(folder, {"posts/p.txt"});
  CHECK(run.findings == Findings{"posts/p.txt:3 empty-literal"});
  CHECK(run.status == 1);
  CHECK(lint(folder, {"posts", "--fail-on", "never"}).status == 0);
  CHECK(lint(folder, {"posts/p.txt", "--select", "literal-duplicates-command"}).findings.empty());
  // The nearest file counts, alone.
  folder.write("posts/dotek.toml", "schema = 1\n[lint]\nselect = [\"literal-duplicates-command\"]\n");
  CHECK(lint(folder, {"posts/p.txt"}).findings == Findings{"posts/p.txt:3 literal-duplicates-command"});
}

TEST_CASE("lint: a dotek.toml that is not understood stops the run") {
  const DataFolder folder;
  folder.write("p.txt", kDuplicate);
  const auto run = [&](const std::string& text) {
    folder.write("dotek.toml", text);
    return lint(folder, {"p.txt"});
  };
  Run unknown = run("schema = 1\n[lint]\nignroe = []\n");
  CHECK(unknown.findings == Findings{"dotek.toml:3 toml-unknown-key"});
  CHECK(unknown.status == 2);
  CHECK(run("schema = 1\n[lint]\nignore = [\"no-such-rule\"]\n").findings ==
        Findings{"dotek.toml:3 toml-value"});
  CHECK(run("schema = 1\n[lint.severity]\nempty-literal = \"loud\"\n").findings ==
        Findings{"dotek.toml:3 toml-value"});
  CHECK(run("[lint]\n").status == 2);
}

TEST_CASE("lint --format sarif is SARIF 2.1.0") {
  const DataFolder folder;
  folder.write("my post.txt", "progStart:\n SeqC SpinOff EOL\n SeqC' M5''' EOL\nRETURN\n");
  folder.write("a.mac", "goto nowhere\nmessage \"\xE1\"\n");
  const CommandResult result = runDotek(
      {"lint", "my post.txt", "a.mac", "missing.mac", "--select", "all", "--format", "sarif"}, folder.path());
  const auto log = nlohmann::json::parse(result.out);
  const auto& run = log["runs"][0];
  CHECK(log["version"] == "2.1.0");
  CHECK(run["results"].size() >= 4);
  for (const auto& one : run["results"])
    CHECK(run["tool"]["driver"]["rules"][one["ruleIndex"].get<std::size_t>()]["id"] == one["ruleId"]);
  CHECK(run["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "my%20post.txt");
  const std::string file = folder.write("out.sarif", result.out);
  const fs::path schema = root() / "tests" / "third_party" / "sarif-2.1.0.json";
  if (std::system("python3 -c 'import jsonschema' > /dev/null 2>&1") != 0) {
    std::cout << "skipped: no python3-jsonschema, SARIF is not held against its schema\n";
    return;
  }
  const std::string check =
      "python3 -c \"import json, sys, jsonschema; "
      "jsonschema.validate(json.load(open(sys.argv[1])), json.load(open(sys.argv[2])))\" '" +
      file + "' '" + schema.string() + "' > /dev/null 2>&1";
  CHECK(std::system(check.c_str()) == 0);
  // The check itself fails where something is wrong.
  folder.write("out.sarif", "{\"version\": \"2.1.0\"}");
  CHECK(std::system(check.c_str()) != 0);
}

TEST_CASE("lint: colours are the same characters with sequences between; a file gets none unless asked") {
  const DataFolder folder;
  folder.write("p.txt", kDuplicate);
  const auto out = [&](const std::string& when) {
    return runDotek({"lint", "p.txt", "--color", when}, folder.path()).out;
  };
  const std::string plain = out("auto");
  CHECK(plain.find('\x1b') == std::string::npos);
  CHECK(out("never") == plain);
  std::string painted = out("always");
  CHECK(painted.find("\x1b[1;35mwarning:\x1b[0m") != std::string::npos);
  for (std::size_t at = 0; (at = painted.find('\x1b', at)) != std::string::npos;)
    painted.erase(at, painted.find('m', at) + 1 - at);
  CHECK(painted == plain);
  CHECK(runDotek({"lint", "p.txt", "--color", "sometimes"}, folder.path()).status == 2);
}

TEST_CASE("lint --quiet prints what was found and no summary") {
  const DataFolder folder;
  folder.write("p.txt", kDuplicate);
  const CommandResult loud = runDotek({"lint", "."}, folder.path());
  const CommandResult quiet = runDotek({"lint", ".", "--quiet"}, folder.path());
  CHECK(loud.err != "");
  CHECK(quiet.err == "");
  CHECK(quiet.out == loud.out);
  CHECK(quiet.status == loud.status);
}

TEST_CASE("lint --stdin-filename: the text of an editor under the name of its file") {
  const ProcessFolder folder;
  folder.run("mkdir sub");
  folder.write("sub/p.txt", "progStart:\n SeqC ' G43 H1' EOL\nRETURN\n"); // what is saved is clean
  folder.write("sub/dotek.toml", "schema = 1\n[lint]\nfail-on = \"error\"\n");
  folder.write("typed", kDuplicate);
  const auto run = [&](const std::string& arguments) {
    return folder.run("dotek " + arguments + " < typed");
  };
  const ShellResult found = run("lint --stdin-filename sub/p.txt -");
  CHECK(found.out.starts_with("sub/p.txt:3:"));
  CHECK(found.status == 0); // by the settings beside the file
  CHECK(run("lint --stdin-filename new.txt -").out.starts_with("new.txt:3:"));
  CHECK(run("lint --stdin-filename sub/p.txt sub/p.txt").status == 2);
  CHECK(run("lint --fix --stdin-filename sub/p.txt -").status == 2);
  folder.write("typed", "progStart:\n SeqC' M32''' EOL\nRETURN\n");
  CHECK(run("lint --fix --diff --select all --stdin-filename sub/p.txt -").out ==
        "--- sub/p.txt\n+++ sub/p.txt\n@@ -1,3 +1,3 @@\n progStart:\n- SeqC' M32''' EOL\n+ SeqC ' M32' EOL\n "
        "RETURN\n");
}

TEST_CASE("lint --fix --diff is a patch that patch and git apply take, and it does what --fix does") {
  const ProcessFolder folder;
  const std::string filler = "RETURN\none:\n SeqC ' G0 Z5. F100' EOL\n SeqC ' G0 Z6. F100' EOL\nRETURN\n";
  const std::string lf = "progStart:\n{ \xE4\xF6\tBohrung }\n SeqC' M32''' EOL\n" + filler + filler +
                         "two:\n SeqC' M33''' EOL\n RETURN";
  std::string crlf;
  for (const char c : lf)
    crlf += c == '\n' ? "\r\n" : std::string(1, c);
  for (const std::string& text : {lf, crlf, lf + "\n", crlf + "\r\n"}) {
    folder.write("posts/p q.txt", text);
    const std::string lint = "dotek lint 'posts/p q.txt' --select all --fix";
    const ShellResult shown = folder.run(lint + " --diff > p.diff");
    REQUIRE_MESSAGE(shown.status == 1, shown.err);
    folder.run("cp -r posts kept");
    const ShellResult patch = folder.run("patch --binary -p0 < p.diff");
    CHECK_MESSAGE(patch.status == 0, patch.out);
    const std::string patched = folder.read("posts/p q.txt");
    folder.run("rm -rf posts; cp -r kept posts");
    const ShellResult git = folder.run("git apply -p0 p.diff");
    CHECK_MESSAGE(git.status == 0, git.err);
    CHECK(folder.read("posts/p q.txt") == patched);
    folder.run("rm -rf posts; mv kept posts");
    folder.run(lint);
    CHECK(folder.read("posts/p q.txt") == patched);
    CHECK(patched != text);
  }
}

TEST_CASE("lint: where a profile infers that a position holds the length, no repair is proposed") {
  const DataFolder folder;
  folder.write("o.nc", "O9101\nG90 G31 Z-20. F100\nG53\n#101=#5063\nG90 G0 Z#101\nM99\n");
  const auto of = [&](const std::string& control) {
    return runDotek({"lint", "o.nc", "--select", "tool-length-in-target", "--control", control},
                    folder.path())
        .out;
  };
  const std::string sure = of("fanuc-31i-b"), inferred = of("haas-ngc");
  CHECK(sure.find("[tool-length-in-target]") != std::string::npos);
  CHECK(sure.find("fix by hand") != std::string::npos);
  CHECK(inferred.find("[tool-length-in-target]") != std::string::npos);
  CHECK(inferred.find("is inferred for Haas NGC") != std::string::npos);
  CHECK(inferred.find("fix by hand") == std::string::npos);
}

TEST_CASE("lint: the length that is to be taken off is shown in the text that is underlined") {
  const DataFolder folder;
  const auto proposed = [&](const std::string& block) {
    folder.write("o.nc", "O9101\nG90 G31 Z[#26-4.] F100\nG53\n#1=#5063\n" + block + "\nM99\n");
    const std::string out =
        runDotek({"lint", "o.nc", "--select", "tool-length-in-target"}, folder.path()).out;
    const std::string before = "write `";
    const std::size_t at = out.find(before, out.find("fix by hand"));
    return at == std::string::npos
               ? out
               : out.substr(at + before.size(), out.find('`', at + before.size()) - at - before.size());
  };
  CHECK(proposed("#140=#1-#26") == "[#1-#5083]-#26");
  CHECK(proposed("G0 Z[#1+5.]") == "Z[#1+5.-#5083]");
  CHECK(proposed("G10 L2 P1 Z#1") == "Z[#1-#5083]");
  CHECK(proposed("#2005=#2005-#1") == "#2005=#2005-#1+#5083");
}

TEST_CASE("lint: what convert refuses of a macro for certain is a warning, and once") {
  const DataFolder folder;
  fs::create_directories(folder.path() + "/probe-z");
  const auto with = [&](const std::string& checks) {
    folder.write("probe-z/DefineData.txt", "X = 12\n");
    folder.write("probe-z/CycleData.dlg", "dialog \"Z\", 40, 40, 420, 230\n"
                                          "label 20, 15, 60, 24, \"X\"\ninput 90, 15, 70, 24, X, X\n"
                                          "ok 90, 180, 70, 24\ncancel 180, 180, 70, 24\n");
    folder.write("probe-z/CycleData.mac", ":ask\ndialog \"CycleData.dlg\"\n" + checks +
                                              "if wrong > 0 then message \"Correct it\"\n"
                                              "if wrong > 0 then goto ask\n");
    folder.write("probe-z/ToolPath.mac", "op = callback_op\nadd_custom_drill_cycle_path 0, 5\n");
    Findings out;
    for (const std::string& one : lint(folder, {"probe-z"}).findings)
      if (one.find("read-before-set") != std::string::npos || one.find("undefined") != std::string::npos ||
          one.find("cam-value") != std::string::npos)
        out.push_back(one);
    return out;
  };
  CHECK(with("wrong = 0\nif X < 1 then wrong = 1\n").empty());
  CHECK(with("if X < 1 then wrong = 1\n") == Findings{"probe-z/CycleData.mac:4 read-before-set"});
  // What nothing sets is named as such alone.
  CHECK(with("wrong = 0\nif X < limit then wrong = 1\n") ==
        Findings{"probe-z/CycleData.mac:4 undefined-variable"});
  CHECK(with("wrong = 0\nget_tool_data 3, MTOOL_RADIUS, r\nif X < r then wrong = 1\n") ==
        Findings{"probe-z/CycleData.mac:5 cam-value"});
}

TEST_CASE("lint: without a control what each profile refuses is reported") {
  const DataFolder folder;
  folder.write("o.nc", "O1\n#100=#50603\n#4001=1\nM30\n");
  CHECK(lint(folder, {"o.nc"}).findings ==
        Findings{"o.nc:2 system-variable-unknown", "o.nc:3 read-only-written"});
  CHECK(lint(folder, {"o.nc", "--ignore", "system-variable-unknown"}).findings ==
        Findings{"o.nc:3 read-only-written"});
}
