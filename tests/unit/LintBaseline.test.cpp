// lint --baseline, --statistics and the forms of code hosts, by the program.
#include "support/CodeHosts.h"
#include "tests/Process.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace dotek;
using namespace dotek::tests;
using Json = nlohmann::json;

namespace {

const std::string kOld = "O7411\nG0Z5.\nGOTO40\nN30M99\n";

} // namespace

TEST_CASE("baseline: what is known is passed over, what is new fails, what is gone is counted") {
  const ProcessFolder folder;
  folder.write("O7411.nc", kOld);
  CHECK(folder.run("dotek lint O7411.nc").status == 1);
  CHECK(folder.run("dotek lint O7411.nc --write-baseline known.json").status == 0);
  CHECK(Json::parse(folder.read("known.json"))["schema"] == 1);
  const ShellResult known = folder.run("dotek lint O7411.nc --baseline known.json");
  CHECK(known.status == 0);
  CHECK(known.out.empty());
  CHECK(known.err.find("1 of the baseline left out") != std::string::npos);

  // Lines before it change nothing; the same mistake once more is new.
  folder.write("O7411.nc", "O7411\n(NEW LINE)\nG0Z5.\nGOTO40\nGOTO50\nN30M99\n");
  const ShellResult more =
      folder.run("dotek lint O7411.nc --select goto-target-missing --baseline known.json");
  CHECK(more.status == 1);
  CHECK(more.out.find("N50") != std::string::npos);
  CHECK(more.out.find("N40") == std::string::npos);

  folder.write("O7411.nc", "O7411\nG0Z5.\nGOTO30\nN30M99\n");
  const ShellResult gone =
      folder.run("dotek lint O7411.nc --select goto-target-missing --baseline known.json");
  CHECK(gone.status == 0);
  CHECK(gone.err.find("1 of it no longer found") != std::string::npos);
}

TEST_CASE("baseline: a file is the same however it is named, and wherever the command runs") {
  const ProcessFolder folder;
  folder.run("mkdir shop lists");
  folder.write("shop/O7411.nc", kOld);
  CHECK(folder.run("dotek lint shop --write-baseline lists/known.json").status == 0);
  CHECK(Json::parse(folder.read("lists/known.json"))["findings"][0]["file"] == "../shop/O7411.nc");
  for (const char* command : {"dotek lint ./shop --baseline lists/known.json",
                              "dotek lint \"$PWD/shop\" --baseline lists/known.json",
                              "cd shop; dotek lint . --baseline ../lists/known.json",
                              "cd lists; dotek lint ../shop/O7411.nc --baseline known.json"}) {
    const ShellResult result = folder.run(command);
    CHECK_MESSAGE(result.status == 0, command << result.out << result.err);
    CHECK(result.err.find("1 of the baseline left out") != std::string::npos);
  }
  // A list of other files says so, and does not ask to be written anew.
  folder.run("cp -r shop other");
  const ShellResult other = folder.run("dotek lint other --baseline lists/known.json");
  CHECK(other.status == 1);
  CHECK(other.err.find("write it anew") == std::string::npos);
}

TEST_CASE(
    "baseline: a run that looks at a part of the files calls nothing of the others gone, and keeps it") {
  const ProcessFolder folder;
  folder.run("git init -q; git config user.email a@b.c; git config user.name A; mkdir mill lathe");
  folder.write("mill/O7411.nc", kOld);
  folder.write("mill/O7412.nc", "O7412\nG0Z5.\nGOTO70\nN30M99\n");
  folder.write("lathe/O7413.nc", "O7413\nG0Z5.\nGOTO80\nN30M99\n");
  folder.run("dotek lint . --write-baseline known.json; git add .; git commit -qm A");
  for (const char* command :
       {"dotek lint mill/O7412.nc --baseline known.json", "dotek lint mill --baseline known.json",
        "dotek lint . --baseline known.json --changed-since HEAD",
        "dotek lint . --baseline known.json --select hash-missing"}) {
    const ShellResult result = folder.run(command);
    CHECK_MESSAGE(result.status == 0, command << result.out << result.err);
    CHECK_MESSAGE(result.err.find("no longer found") == std::string::npos, command << result.err);
  }
  // A file that is gone takes its findings with it, where the run looks.
  folder.run("rm mill/O7411.nc");
  CHECK(folder.run("dotek lint mill --baseline known.json").err.find("1 of it no longer found") !=
        std::string::npos);
  CHECK(folder.run("dotek lint lathe --baseline known.json").err.find("no longer found") ==
        std::string::npos);
  const ShellResult part = folder.run("dotek lint mill --write-baseline known.json");
  CHECK(part.err.find("1 of the baseline stays") != std::string::npos);
  CHECK(Json::parse(folder.read("known.json"))["findings"].size() == 2);
  CHECK(folder.run("dotek lint . --baseline known.json").status == 0);
  folder.write("known.json", "not a baseline");
  const ShellResult anew = folder.run("dotek lint . --write-baseline known.json");
  CHECK(anew.status == 0);
  CHECK(anew.err.find("was no baseline") != std::string::npos);
  CHECK(Json::parse(folder.read("known.json"))["findings"].size() == 2);
}

TEST_CASE("baseline: a run on a part of a folder keeps what only a run on the whole folder can find") {
  const ProcessFolder folder;
  folder.run("mkdir mill");
  folder.write("mill/O7411.nc", kOld);
  folder.write("dotek.toml", "schema = 1\n[[lint.path]]\npath = \"lahte/**\"\nignore = [\"indentation\"]\n");
  folder.run("dotek lint . --write-baseline known.json");
  REQUIRE(folder.read("known.json").find("path-unused") != std::string::npos);
  CHECK(folder.run("dotek lint mill --baseline known.json").err.find("no longer found") == std::string::npos);
  folder.run("dotek lint mill --write-baseline known.json");
  const ShellResult all = folder.run("dotek lint . --baseline known.json");
  CHECK_MESSAGE(all.status == 0, all.out);
  // What it finds no more is gone all the same.
  folder.write("dotek.toml", "schema = 1\n");
  CHECK(folder.run("dotek lint . --baseline known.json").err.find("no longer found") != std::string::npos);
}

TEST_CASE("baseline: a place more of an accepted finding is new") {
  const ProcessFolder folder;
  const auto lint = [&](const std::string& lines) {
    folder.write("O1.nc", "O1(A)\n" + lines + "G1 X10. F200.\nM30\n");
    return folder.run("dotek lint O1.nc --select goto-target-missing --baseline known.json");
  };
  const std::string five = "IF[#5 EQ #0]GOTO 50\n", six = "IF[#6 EQ #0]GOTO 50\n";
  folder.write("O1.nc", "O1(A)\n" + five + "G1 X10. F200.\nM30\n");
  folder.run("dotek lint O1.nc --select goto-target-missing --write-baseline known.json");
  CHECK(lint(five).status == 0);
  CHECK(lint("(MOVED)\n" + five + "G0 Z5.\n").status == 0);
  for (const std::string& lines : {five + six, six + five, five + five, five + "G0 Z5.\n" + six}) {
    const ShellResult more = lint(lines);
    CHECK_MESSAGE(more.status == 1, lines);
    CHECK_MESSAGE(more.out.find("goto-target-missing") != std::string::npos, lines);
  }
  CHECK(lint(six).status == 1);
  // Both accepted: each of them alone is, too; one in the place of the other is not.
  lint(five + six);
  folder.run("dotek lint O1.nc --select goto-target-missing --write-baseline known.json");
  for (const std::string& lines : {five + six, "N1 G0 Z5.\n" + five + "(BETWEEN)\n" + six, five, six})
    CHECK_MESSAGE(lint(lines).status == 0, lines);
  CHECK(lint(five + six).err.find("no longer found") == std::string::npos);
  CHECK(lint("").err.find("1 of it no longer found") != std::string::npos);
  CHECK(lint(five + "IF[#7 EQ #0]GOTO 50\n").status == 1);
  // Lists without places stay what they were.
  folder.run("sed -i '/places/,/]/d; s/\\(\"fingerprint\".*\\),$/\\1/' known.json");
  CHECK(folder.read("known.json").find("places") == std::string::npos);
  CHECK(lint(five).status == 0);
  CHECK(lint(five).err.find("older version") == std::string::npos);
  const ShellResult blind = lint(five + six);
  CHECK(blind.status == 0);
  CHECK(blind.err.find("1 of them with further places") != std::string::npos);
}

TEST_CASE("baseline: what is no baseline lets nothing pass") {
  const ProcessFolder folder;
  folder.write("O7411.nc", kOld);
  for (const char* text :
       {"", "[]",
        "{\"schema\":1,\"findings\":[{\"file\":\"a\",\"code\":\"b\",\"fingerprint\":\"c\",\"places\":[1]}]}",
        "{\"schema\":2,\"findings\":[]}", "{\"schema\":1,\"findings\":[{\"file\":1}]}", "O7411"}) {
    folder.write("known.json", text);
    const ShellResult result = folder.run("dotek lint O7411.nc --baseline known.json");
    CHECK(result.status == 2);
    CHECK_MESSAGE(result.out.find("baseline-unreadable") != std::string::npos, result.out << result.err);
  }
  CHECK(folder.run("dotek lint O7411.nc --baseline missing.json").status == 2);
  CHECK(folder.run("dotek lint O7411.nc --write-baseline O7411.nc").status == 2); // an input
  CHECK(folder.read("O7411.nc") == kOld);
}

TEST_CASE("lint for GitHub and GitLab, and how often each code is found") {
  const ProcessFolder folder;
  folder.write("a,b.nc", kOld);
  const ShellResult github = folder.run("dotek lint a,b.nc --format github");
  CHECK(github.out.find(
            "::error file=a%2Cb.nc,line=3,endLine=3,col=5,endColumn=7,title=goto-target-missing::") == 0);
  const Json gitlab = Json::parse(folder.run("dotek lint a,b.nc --format gitlab").out);
  REQUIRE(!gitlab.empty());
  CHECK(gitlab[0]["check_name"] == "goto-target-missing");
  CHECK(gitlab[0]["location"]["path"] == "a,b.nc");
  CHECK(gitlab[0]["location"]["lines"]["begin"] == 3);
  CHECK(gitlab[0]["severity"] == "major");
  CHECK(gitlab[0]["fingerprint"].get<std::string>().size() == 64);
  CHECK(folder.run("dotek lint a,b.nc --statistics --format json").status == 2);
  CHECK(folder.run("dotek lint a,b.nc --statistics").out.find("1  error    goto-target-missing") !=
        std::string::npos);

  SourceMap sources;
  Diagnostics found;
  found.add({"some-code", Severity::Note, {}, "100%\nsure", {}, std::nullopt});
  CHECK(renderGithub(found, sources) == "::notice title=some-code::100%25%0Asure\n");
}
