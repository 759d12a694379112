// Every JSON that a command prints keeps to its schema of docs/schemas: those of the goldens, and those of
// runs that fail.
#include "tests/GoldenRunner.h"
#include "tests/Process.h"
#include "tests/Skips.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

constexpr const char* kCheck = R"(
import glob, json, sys
import jsonschema
faults = 0
def strict(name): raise ValueError('no JSON number: ' + name)
for path in sorted(glob.glob('*.json')):
    kind = path.split('.')[1]
    name = '/../../tests/third_party/sarif-2.1.0.json' if kind == 'sarif' else '/' + kind + '.schema.json'
    schema = json.load(open(sys.argv[1] + name))
    try:
        jsonschema.validate(json.load(open(path, encoding='utf-8'), parse_constant=strict), schema)
    except Exception as error:
        faults += 1
        print(path, str(error)[:600])
sys.exit(1 if faults else 0)
)";

bool haveSchemas(const ProcessFolder& folder) {
  if (folder.run("python3 -c 'import jsonschema'").status == 0) return true;
  skip("there is no python3-jsonschema");
  return false;
}

ShellResult check(const ProcessFolder& folder) {
  folder.write("check.py", kCheck);
  return folder.run("python3 check.py '" + (root() / "docs" / "schemas").string() + "'");
}

} // namespace

TEST_CASE("JSON of the goldens keeps to its schema") {
  const ProcessFolder folder;
  if (!haveSchemas(folder)) return;
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root() / "tests" / "golden")) {
    if (entry.path().filename() != "cmd") continue;
    std::istringstream lines(readAll(entry.path()));
    int written = 0; // what begins as a document, whatever flag asked for it
    for (std::string line; std::getline(lines, line);) {
      const std::vector<std::string> arguments = splitArguments(line);
      const auto has = [&](std::string_view what) {
        return std::any_of(arguments.begin(), arguments.end(), [&](const std::string& one) {
          return one == what || one.ends_with("=" + std::string(what));
        });
      };
      const bool sarif = has("sarif"), json = has("json") || has("--json");
      if (!sarif && !json) continue;
      const CommandResult result = runDotek(arguments, entry.path().parent_path());
      ++written;
      const char* const kind = sarif                            ? "sarif"
                               : arguments.front() == "sim"     ? "sim"
                               : arguments.front() == "outline" ? "outline"
                                                                : "findings";
      folder.write(fmt::format("{}.{}.json", ++count, kind), result.out);
    }
    int documents = 0;
    std::istringstream printed(readAll(entry.path().parent_path() / "stdout"));
    for (std::string line; std::getline(printed, line);)
      documents += line == "{" || line == "[" || line == "[]" ? 1 : 0;
    CHECK_MESSAGE(documents <= written, entry.path().string() << " prints JSON that is not checked here");
  }
  CHECK(count > 10);
  const CommandResult map =
      runDotek({"convert", "examples/surface-x", "--prog", "examples/mill-post.txt", "--to", "fanuc", "--map",
                folder.path("1.map.json"), "-o", folder.path("o.nc")},
               root());
  CHECK_MESSAGE(map.status == 0, map.err);
  const CommandResult post = runDotek(
      {"run-post", "post.cps", "job.toml", "--map", folder.path("2.map.json"), "-o", folder.path("p.nc")},
      root() / "tests" / "golden" / "run-post" / "formats");
  CHECK_MESSAGE(post.status == 0, post.err);
  const std::string program = folder.path("\xE9\xE2\x80\xAE.nc");
  folder.write("\xE9\xE2\x80\xAE.nc", "%\nO1\nGOTO 7\nM30\n%\n");
  runDotek({"lint", program, "--write-baseline", folder.path("1.baseline.json")}, root());
  CHECK_FALSE(folder.read("1.baseline.json").empty());
  folder.write("1.gitlab.json", runDotek({"lint", program, "--format", "gitlab"}, root()).out);
  folder.write("2.gitlab.json",
               runDotek({"lint", "examples/macros/bore.nc", "--format", "gitlab"}, root()).out);
  const ShellResult checked = check(folder);
  CHECK_MESSAGE(checked.status == 0, checked.out << checked.err);
  // The check itself fails where something is wrong.
  folder.write("x.sim.json", "{\"ending\": \"program-end\"}");
  CHECK(check(folder).status == 1);
  folder.write("x.sim.json", "{\"ending\": \"not-run\", \"control\": null, \"blocks\": NaN}");
  CHECK(check(folder).status == 1);
}

TEST_CASE("the report of verify as JSON keeps to its schema, whatever came out") {
  const ProcessFolder folder;
  if (!haveSchemas(folder)) return;
  const std::string root = "'" + dotek::tests::root().string() + "/examples/";
  folder.run("cp -r " + root + "surface-x' .; cp " + root + "post.txt' .; cp " + root +
             "cycles/bore.cycle' .");
  folder.write("p.nc", "%\nO1\nG90 G0 X1.\n#100=1.\nM30\n%\n");
  folder.write("other.nc", "%\nO8000\nG90 G0 X1.\nM99\n%\n");
  const std::string cycle = "surface-x --prog post.txt --form thesis-a --assume probe-on --cases 10 ";
  int count = 0;
  for (const std::string& command :
       {"verify " + cycle, "verify " + cycle + "--to fanuc", "verify " + cycle + "--to fusion",
        "verify " + cycle + "--to fanuc --translation other.nc",
        "verify " + cycle + "--to fanuc --set X=12 --seed 18446744073709551615",
        "verify " + cycle + "--to fanuc --date $'\\x9b\\xff' --remark $'\\x1b[2J'",
        "verify " + cycle +
            "--to mikroprog --control mikroprog-mill --clearance 5 --host tool_radius=3 --host "
            "overtravel=5 --host return_feed=500",
        std::string("verify surface-x --prog post.txt --form thesis-a --to fanuc --cases 10"),
        std::string("verify p.nc --to fanuc --cases 10"),
        std::string("verify bore.cycle --to fanuc --cases 10")}) {
    const std::string report = fmt::format("{}.verify.json", ++count);
    const ShellResult result = folder.run(fmt::format("dotek {} -o {}", command, report));
    CHECK_MESSAGE(result.status < 2, command << "\n" << result.err);
    CHECK_MESSAGE(!folder.read(report).empty(), command);
  }
  const ShellResult converted =
      folder.run("dotek convert surface-x --prog post.txt --form thesis-a --assume probe-on "
                 "--to fanuc --verify --report last.verify.json -o o.nc");
  CHECK_MESSAGE(converted.status == 0, converted.err);
  const ShellResult checked = check(folder);
  CHECK_MESSAGE(checked.status == 0, checked.out << checked.err);
}

TEST_CASE("sim --json prints one object, whatever happens") {
  const ProcessFolder folder;
  if (!haveSchemas(folder)) return;
  folder.write("p.nc", "%\nO1\nG90 G0 X1.\nM30\n%\n");
  folder.write("nul.nc", std::string("G0 X1.\0\n", 8));
  folder.write("utf16.nc", std::string("\xFF\xFEG\0", 4));
  folder.write("broken.nc", "%\nO1\n#1=[\nIF THEN\nM30\n");
  folder.write("big.nc", "%\nO1\n#1=1\nWHILE[#1 LT 5]DO1\n#2=EXP[#1*900.]\n#1=#1+1.\nEND1\nG0 X[#2]\nM30\n");
  folder.write("p.suf", "%\nN1 G0 X1\nN2 M30\n");
  folder.write("part.toml", "schema = 1\n");
  folder.write("\xE9.nc", "%\nO1\n#1=\nM30\n%\n");
  folder.run("mkdir folder; ln -s loop loop");
  int count = 0;
  for (const std::string& command : std::vector<std::string>{"p.nc",
                                                             "missing.nc",
                                                             "folder",
                                                             "loop",
                                                             "nul.nc",
                                                             "utf16.nc",
                                                             "broken.nc",
                                                             "big.nc",
                                                             "p.suf",
                                                             "$'\\xe9.nc'",
                                                             "p.nc --control none",
                                                             "p.nc --var x=1",
                                                             "p.nc --programs missing",
                                                             "p.nc --part missing",
                                                             "p.nc --machine part.toml",
                                                             "p.nc --part part.toml --machine part.toml",
                                                             "p.nc --svg none/x",
                                                             "p.nc --html p.nc",
                                                             "p.nc --trace folder",
                                                             "p.nc --data missing",
                                                             "p.nc --limit kept-bytes=1",
                                                             "p.nc --from suf",
                                                             "p.suf --var 1=2",
                                                             "p.nc --control",
                                                             "p.nc --nonsense",
                                                             "p.nc --at 1,2",
                                                             "p.nc --set ''",
                                                             "p.nc --limit steps=x",
                                                             "p.nc second.nc third.nc --var",
                                                             "$(printf 'n%.0s' $(seq 300))"}) {
    const ShellResult result = folder.run("dotek sim --json " + command);
    CHECK_MESSAGE(result.status < 3, command << result.err);
    CHECK_MESSAGE(nlohmann::json::accept(result.out), command << "\n" << result.out << result.err);
    CHECK_MESSAGE(result.err.find("defect of Dotek") == std::string::npos, command << result.err);
    folder.write(fmt::format("{}.sim.json", ++count), result.out);
  }
  const ShellResult checked = check(folder);
  CHECK_MESSAGE(checked.status == 0, checked.out << checked.err);
}

TEST_CASE("a wrong command line of lint is a finding of its document") {
  const ProcessFolder folder;
  if (!haveSchemas(folder)) return;
  folder.write("p.nc", "%\nO1\nM30\n%\n");
  int count = 0;
  for (const char* rest : {"p.nc --nonsense", "p.nc --select no-such-rule", "p.nc --set a",
                           "p.nc --limit a=1", "missing.nc", "", "p.nc --fail-on sometimes"}) {
    const ShellResult json = folder.run(fmt::format("dotek lint --format json {}", rest));
    CHECK_MESSAGE(json.status == 2, rest << json.err);
    CHECK_MESSAGE(nlohmann::json::parse(json.out).size() == 1, json.out);
    folder.write(fmt::format("{}.findings.json", ++count), json.out);
    const ShellResult sarif = folder.run(fmt::format("dotek lint {} --format=sarif", rest));
    CHECK(sarif.status == 2);
    CHECK_MESSAGE(nlohmann::json::parse(sarif.out)["runs"][0]["results"].size() == 1, sarif.out);
  }
  CHECK(folder.run("dotek lint --format json p.nc --nonsense").out.find("command-line") != std::string::npos);
  const ShellResult checked = check(folder);
  CHECK_MESSAGE(checked.status == 0, checked.out << checked.err);
}

TEST_CASE("each command that is asked for a document prints its own, also where it does not run") {
  const ProcessFolder folder;
  if (!haveSchemas(folder)) return;
  folder.write("p.nc", "%\nO1\nM30\n%\n");
  int count = 0;
  for (const char* rest : {"--encoding x", "--nosuch", "--control x", "--data nosuch", "--limit x", "-o p.nc",
                           "- --stdin-filename x.nc <&-"}) {
    const ShellResult outline = folder.run(fmt::format("dotek outline --json p.nc {}", rest));
    CHECK_MESSAGE(outline.status == 2, rest << outline.err);
    folder.write(fmt::format("{}.outline.json", ++count), outline.out);
    const ShellResult sim = folder.run(fmt::format("dotek sim --json p.nc {}", rest));
    if (sim.status == 2) folder.write(fmt::format("{}.sim.json", ++count), sim.out);
    for (const char* format : {"json", "sarif", "gitlab"}) {
      const ShellResult lint = folder.run(fmt::format("dotek lint --format {} p.nc {}", format, rest));
      folder.write(
          fmt::format("{}.{}.json", ++count, std::string_view(format) == "json" ? "findings" : format),
          lint.out);
    }
  }
  for (const char* rest : {"p.nc --statistics", "p.nc --write-baseline p.nc"})
    for (const char* format : {"json", "sarif", "gitlab"}) {
      const ShellResult lint = folder.run(fmt::format("dotek lint --format {} {}", format, rest));
      CHECK_MESSAGE(lint.status == 2, rest << lint.err);
      folder.write(
          fmt::format("{}.{}.json", ++count, std::string_view(format) == "json" ? "findings" : format),
          lint.out);
    }
  // Another command has no document.
  for (const char* command : {"fmt --json p.nc", "renumber --format json p.nc", "sim --format json p.nc"})
    CHECK(folder.run(fmt::format("dotek {}", command)).out.empty());
  const ShellResult checked = check(folder);
  CHECK_MESSAGE(checked.status == 0, checked.out << checked.err);
}

TEST_CASE("what the system refuses is a message and no defect of Dotek") {
  const ProcessFolder folder;
  folder.write("p.nc", "%\nO1\nG90 G0 X1.\nM30\n%\n");
  folder.run("ln -s loop loop; mkdir sub; ln -s ../p.nc 'a=b'; ln -s 'x=y' 'x=y'");
  const std::string name = "$(printf 'n%.0s' $(seq 300))";
  for (const std::string& command : std::vector<std::string>{
           "lint loop", "lint p.nc --set a=1 'x=y'", "lint p.nc --set a=1 n=" + name, "lint " + name,
           "post loop --prog p.nc", "post p.nc --prog loop", "convert loop --to fanuc",
           "convert p.nc --to fanuc --job loop", "convert sub --prog sub --to fanuc", "sim loop",
           "sim p.nc --programs loop", "sim p.nc --part loop --machine loop", "sim p.nc --data loop",
           "dump loop", "dump sub --stage ir", "new form f --prog loop",
           "verify p.nc --to fanuc --translation loop", "verify loop --to fanuc"}) {
    const ShellResult result = folder.run("dotek " + command);
    CHECK_MESSAGE(result.status > 0, command);
    CHECK_MESSAGE(result.status < 3, command << "\n" << result.err);
    CHECK_MESSAGE(result.err.find("defect of Dotek") == std::string::npos, command << result.err);
    CHECK_MESSAGE((result.out + result.err).find("error") != std::string::npos, command);
  }
}

TEST_CASE("little memory is a message, of worker threads too") {
  const ProcessFolder folder;
  folder.write("p.nc", "%\nO1\nG90 G0 X1.\n#100=1.\nM30\n%\n");
  // Under a sanitizer an address space is as large as it gets.
  if (folder.run("ulimit -v 400000; dotek --version").status != 0) {
    skip("the program needs more address space than a limit leaves");
    return;
  }
  int refused = 0;
  for (int limit = 20'000; limit <= 400'000; limit += 20'000) {
    // What loads the program has too little.
    if (folder.run(fmt::format("ulimit -v {}; dotek --version", limit)).status != 0) continue;
    const ShellResult result =
        folder.run(fmt::format("ulimit -v {}; dotek verify p.nc --to fanuc --cases 300 --jobs 4", limit));
    CHECK_MESSAGE(result.status <= 2, limit << ": " << result.status << result.err);
    if (result.err.find("[out-of-memory]") != std::string::npos) ++refused;
  }
  MESSAGE("refused for want of memory: " << refused);
}
