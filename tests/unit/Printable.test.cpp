// What a name or a text looks like on a terminal and in JSON, whatever its bytes.
#include "support/Printable.h"

#include "tests/Draws.h"
#include "tests/Process.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace dotek;
using namespace dotek::tests;

TEST_CASE("what would steer a terminal is shown as a question mark") {
  CHECK(printable("a\x1B[31mb") == "a?[31mb");
  CHECK(printable("a\tb\nc\x7F") == "a b?c?");
  CHECK(printable("\xC2\x9B"
                  "31m") == "?31m"); // C1 as UTF-8
  CHECK(printable("\x9B"
                  "31m") == "?31m"); // C1 as a byte
  CHECK(printable("\xE2\x80\xAE"
                  "cn.exe\xE2\x81\xA6") == "?cn.exe?"); // marks of direction
  CHECK(printable("m\xC4\x9B\xC5\x99 \xE2\x82\xAC \xF0\x9F\x94\xA7") ==
        "m\xC4\x9B\xC5\x99 \xE2\x82\xAC \xF0\x9F\x94\xA7");
  CHECK(printable("\xC4") == "?");
  CHECK(printable("\xE2\x82") == "??");
  CHECK(printable("\xED\xA0\x80") == "???"); // a surrogate is no letter
}

TEST_CASE("of a text of several lines the ends of the lines and the tabs stay") {
  CHECK(printableLines("a\tb\nc") == "a\tb\nc");
  CHECK(printableLines("a\x1B\tb\r\n\r\nc\rd\n") == "a?\tb\r\n\r\nc?d\n");
  CHECK(printableLines("\xE2\x80\xAE\n\xC4\x9B") == "?\n\xC4\x9B");
  CHECK(printableLines("").empty());
}

TEST_CASE("a JSON string takes any bytes") {
  const std::string text = "a\"\\\x01\n\x7F\xC2\x85\xE2\x80\xAE\xC4\x9B\xE9";
  const std::string json = jsonString(text);
  CHECK(json == "\"a\\\"\\\\\\u0001\\n\\u007f\\u0085\\u202e\xC4\x9B\\\\xE9\"");
  CHECK(nlohmann::json::parse(json) == "a\"\\\x01\n\x7F\xC2\x85\xE2\x80\xAE\xC4\x9B\\xE9");
  CHECK(escapeMarks("[\"\xE2\x80\xAE\"]") == "[\"\\u202e\"]");
}

TEST_CASE("names of files are shown as texts of messages are") {
  const ProcessFolder folder;
  const std::string names[] = {"a\x1B[2Jb.nc",
                               "c1\xC2\x9B"
                               "2J.nc",
                               "\xE2\x80\xAE"
                               "cn.nc",
                               "raw\x9B.nc",
                               "nl\nx.nc",
                               "\xE9.nc"};
  for (const std::string& name : names) {
    if (fewDraws() && &name != names && &name != names + 4) continue;
    folder.write(name, "%\nO1\nG90 G0 X1.\n#3000=1(A\x1B[2JB)\nM30\n%\n");
    const std::string quoted = "$'" + [&] {
      std::string out;
      for (const char c : name)
        out += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
      return out;
    }() + "'";
    for (const std::string command : {"lint --select all ",
                                      "lint --select all --format json ",
                                      "lint --select all --format sarif ",
                                      "sim ",
                                      "sim --json ",
                                      "sim --svg no/such ",
                                      "convert --to fanuc --renumber x ",
                                      "convert --to fanuc --map - --control fanuc-6m ",
                                      "dump --stage ir ",
                                      "dump --stage ast ",
                                      "convert --to fanuc -o ./",
                                      "nosuch ",
                                      "post ",
                                      "explain ",
                                      "list ",
                                      "sim --var ",
                                      "sim --limit ",
                                      "sim --control ",
                                      "verify --to fanuc --cases 20 ",
                                      "outline ",
                                      "outline --json ",
                                      "renumber --range 5:1 ",
                                      "fmt --diff ",
                                      "fmt --check ",
                                      "lint --format github ",
                                      "lint --format gitlab ",
                                      "lint --statistics ",
                                      "lint --baseline ",
                                      "run-post ",
                                      "run-post --expect ",
                                      "new job --from ",
                                      "preview ",
                                      "doc ",
                                      "convert --to cycle ",
                                      "convert --to gibbs "}) {
      const ShellResult result = folder.run("dotek " + command + quoted);
      const std::string all = result.out + result.err;
      for (const std::string bad : {"\x1B", "\xC2\x9B", "\xE2\x80\xAE", "nl\nx"})
        CHECK_MESSAGE(all.find(bad) == std::string::npos, command << "\n" << all);
      CHECK_MESSAGE(printable(all).find("\xEF\xBF\xBD") == std::string::npos, command);
      CHECK_MESSAGE(result.status < 3, command << "\n" << all);
      if (command.find("json") != std::string::npos || command.find("sarif") != std::string::npos)
        CHECK_MESSAGE(nlohmann::json::accept(result.out), command << "\n" << result.out);
    }
  }
}

TEST_CASE("no text of an input or a flag steers the terminal or begins a line of its own") {
  const ProcessFolder folder;
  const std::string evil = "a\x1B[31m\xE2\x80\xAE\nfake";
  const std::string quoted = "$'a\\x1b[31m\\xe2\\x80\\xae\\nfake'";
  folder.write("list/" + evil + ".xyz", "\x01\x02");
  folder.write("list/p.nc", "%\nO1\nG90 G0 X1. (A\x1B[31m\xE2\x80\xAE)\n#500=1.\nM30\n%\n");
  folder.write("forms/" + evil + ".txt", "progStart:\n SeqC SpinOff EOL\nRETURN\n");
  const std::string post = "description = 'x';\nproperties = {a: {title: 'a\\u001b[31m\\u202e\\nfake', type: "
                           "'boolean', value: true}};\nfunction onOpen() { writeln('%'); }\nfunction "
                           "onCyclePoint() { error('a\\u001b[31m\\u202e\\nfake'); }\n";
  folder.write("posts/" + evil + ".cps", post);
  folder.write("post.cps", post);
  folder.write("data/controls/evil.toml",
               "schema = 1\ntitle = \"a\\u001b[31m\\u202e\\nfake\"\nextends = \"fanuc-31i-b\"\n");
  folder.write("spare.cycle", "cycle spare \"a\x1B[31m\xE2\x80\xAE\"\nspindle off\n");
  for (const std::string& command :
       {std::string("lint list"), std::string("doc spare.cycle"), std::string("list controls --data data"),
        std::string("list controls evil --data data"), std::string("lint --list-skipped list"),
        std::string("lint --format sarif list"), std::string("dump --stage tokens list/p.nc"),
        std::string("dump --stage ast list/p.nc"), std::string("dump --stage ir list/p.nc"),
        "sim --show 500=" + quoted + " list/p.nc", "sim --json --show 500=" + quoted + " list/p.nc",
        "new form f --prog forms/" + quoted + ".txt", "new job --from posts/" + quoted + ".cps",
        std::string("run-post post.cps --matrix probing"), std::string("run-post post.cps --matrix drilling"),
        "convert --keep-going -d out --to fanuc list/p.nc " + quoted}) {
    const ShellResult result = folder.run("dotek " + command);
    const std::string all = result.out + result.err;
    const bool shown = all.find("?[31m") != std::string::npos || all.find("\\u001b") != std::string::npos ||
                       all.find("\\x1B") != std::string::npos || command.starts_with("dump --stage ir");
    CHECK_MESSAGE(shown, command << "\n" << all);
    for (const std::string bad : {"\x1B", "\xE2\x80\xAE", "\nfake"})
      CHECK_MESSAGE(all.find(bad) == std::string::npos, command << "\n" << all);
    CHECK_MESSAGE(result.status < 3, command << "\n" << all);
  }
}
