// Which value a posted field gets, and what `post` refuses before it runs anything.
#include "driver/Driver.h"
#include "tests/unit/DataFolder.h"

#include <algorithm>
#include <doctest/doctest.h>

using namespace dotek;
using dotek::tests::DataFolder;

namespace {

// One cycle `gauge` with a dialog of one input, and a Prog that prints field `L`.
class Project {
public:
  Project() {
    file("DefineData.txt", "a = 7\n");
    file("CycleData.dlg", "dialog \"t\", 0, 0, 400, 400\nlabel 10, 20, 50, 20, \"L\"\n"
                          "input 80, 20, 50, 20, a, a\nok 1, 300, 50, 20\ncancel 80, 300, 50, 20\n");
    file("CycleData.mac", "dialog \"CycleData.dlg\"\n");
    file("ToolPath.mac", "callback_returncode = 0\n");
    prog("main:\nIF CycleType?('gauge')\n SeqC ' X'OpFieldData#('L') EOL\nEND\nRETURN\n");
    options.folders = {folder_.path() + "/gauge"};
  }
  void file(const std::string& name, const std::string& text) { folder_.write("gauge/" + name, text); }
  void prog(const std::string& routines) {
    options.source.prog = folder_.write("prog.txt", "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\n" + routines);
  }
  void job(const std::string& text) { options.common.job = folder_.write("job.toml", text); }

  driver::Outcome post() const { return driver::post(options); }

  driver::PostOptions options;

private:
  DataFolder folder_;
};

std::vector<std::string> errors(const driver::Outcome& outcome) {
  std::vector<std::string> codes;
  for (const Diagnostic& d : outcome.diagnostics.all()) {
    if (d.severity == Severity::Error) codes.emplace_back(d.code);
  }
  return codes;
}

using Codes = std::vector<std::string>;

} // namespace

TEST_CASE("a field given by --field and by --set is refused, not silently one of the two") {
  Project project;
  project.options.common.field = {{"L", "a"}};
  CHECK(project.post().output == "N10 X7.\n");
  project.options.common.set = {{"L", "8"}};
  const driver::Outcome outcome = project.post();
  CHECK(errors(outcome) == Codes{"given-twice"});
  CHECK(outcome.status == 2);
}

TEST_CASE("a field of the macro given in two cases is given twice") {
  Project project;
  project.options.common.set = {{"a", "1"}, {"A", "2"}, {"L", "3"}};
  CHECK(errors(project.post()) == Codes{"given-twice"});
  project.options.common.set = {{"L", "3"}};
  project.job("schema = 1\noperation = [ { cycle = \"gauge\", set = { a = 1.0, A = 2.0 } } ]\n");
  const driver::Outcome outcome = project.post();
  CHECK(errors(outcome) == Codes{"given-twice"});
  CHECK(outcome.status == 1); // it is in a file
}

TEST_CASE("a wrong name on the command line is the only finding") {
  Project project;
  project.options.common.field = {{"l", "a"}};
  CHECK(errors(project.post()) == Codes{"unknown-name"});
  project.options.common.field.clear();
  project.options.common.set = {{"l", "4"}};
  CHECK(errors(project.post()) == Codes{"no-such-field"});
  project.options.common.set = {{"L", "4"}};
  project.options.source.routine = "Main";
  CHECK(errors(project.post()) == Codes{"no-such-routine"});
  project.options.source.routine.reset();
  project.options.common.assume = {"missing-field-zer"};
  CHECK(errors(project.post()) == Codes{"unknown-assumption"});
}

TEST_CASE("two inputs with the label: both are proposed") {
  Project project;
  project.file("DefineData.txt", "a = 7\nb = 8\n");
  project.file("CycleData.dlg",
               "dialog \"t\", 0, 0, 400, 400\nlabel 10, 20, 50, 20, \"L\"\ninput 80, 20, 50, 20, a, a\n"
               "label 10, 60, 50, 20, \"L [mm]\"\ninput 80, 60, 50, 20, b, b\n"
               "ok 1, 300, 50, 20\ncancel 80, 300, 50, 20\n");
  const driver::Outcome outcome = project.post();
  REQUIRE(errors(outcome) == Codes{"missing-field"});
  const auto found = std::find_if(outcome.diagnostics.all().begin(), outcome.diagnostics.all().end(),
                                  [](const Diagnostic& d) { return d.code == "missing-field"; });
  CHECK(found->message.find("`--field L=a` or `--field L=b`") != std::string::npos);
}

TEST_CASE("a first value in a form that no source shows is not posted") {
  Project project;
  project.options.common.field = {{"L", "a"}};
  for (const char* value : {".5", "5.", "1e2", "-.5"}) {
    CAPTURE(value);
    project.file("DefineData.txt", std::string("a = ") + value + "\n");
    CHECK(errors(project.post()) == Codes{"unverified-construct-run"});
  }
  for (const char* value : {"--5", "2*3", "-(-5)", "\"x\""}) {
    CAPTURE(value);
    project.file("DefineData.txt", std::string("a = ") + value + "\n");
    CHECK(errors(project.post()) == Codes{"field-without-value"});
  }
  project.options.common.set = {{"a", "5"}};
  CHECK(project.post().output == "N10 X5.\n");
  project.options.common.set.clear();
  project.file("DefineData.txt", "a = 1e2\n");
  project.options.common.assume = {"exponent"};
  CHECK(project.post().output == "N10 X100.\n");
}

TEST_CASE("what the macro adds to a field does not add up over the points of an operation") {
  Project project;
  project.file("DefineData.txt", "a = 7\nL = 1\n");
  project.file("CycleData.mac", "dialog \"CycleData.dlg\"\nL = L + a\n");
  project.job(
      "schema = 1\noperation = [ { cycle = \"gauge\", at = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]] } ]\n");
  CHECK(project.post().output == "N10 X8.\nN20 X8.\nN30 X8.\n");
}

TEST_CASE("a field that the routine prints outside its branch takes --set and --field") {
  Project project;
  project.prog("main:\n SetFlagF('on')\n IF CycleType?('gauge') SetFlag('on') END\n"
               " IF Flag?('on') SeqC ' X'OpFieldData#('L') EOL END\nRETURN\n");
  project.options.source.routine = "main";
  project.options.common.set = {{"L", "3"}};
  CHECK(project.post().output == "N10 X3.\n");
  project.options.common.set.clear();
  project.options.common.field = {{"L", "a"}};
  CHECK(project.post().output == "N10 X7.\n");
}

TEST_CASE("a radius or an offset number that cannot be meant is refused") {
  Project project;
  project.options.common.field = {{"L", "a"}};
  for (const auto& [name, value] : {std::pair{"tool_radius", "-3"}, std::pair{"tool_radius", "0"},
                                    std::pair{"tool_offset", "1.5"}, std::pair{"tool_number", "-1"}}) {
    CAPTURE(name);
    project.options.common.host = {{name, value}};
    CHECK(errors(project.post()) == Codes{"host-input-range"});
  }
  project.options.common.host.clear();
  project.job("schema = 1\ntool = { number = 1, offset = 1, radius = -3.0 }\noperation = [ { cycle = "
              "\"gauge\" } ]\n");
  CHECK(errors(project.post()) == Codes{"toml-value"});
  project.job("schema = 1\noperation = [ { cycle = \"gauge\", at = [] } ]\n");
  CHECK(errors(project.post()) == Codes{"toml-value"});
}

TEST_CASE("a program number is found with the zeros before it, and only as the first word") {
  Project project;
  project.options.common.field = {{"L", "a"}};
  const auto warned = [&](const char* first) {
    project.prog(
        std::string("begin: '") + first +
        "' EOL RETURN\nmain:\nIF CycleType?('gauge')\n SeqC ' X'OpFieldData#('L') EOL\nEND\nRETURN\n");
    project.job("schema = 1\nprogram = { number = 20 }\nroutines = { start = \"begin\" }\n"
                "operation = [ { cycle = \"gauge\" } ]\n");
    const driver::Outcome outcome = project.post();
    CHECK(outcome.status == 0);
    const auto& all = outcome.diagnostics.all();
    return std::any_of(all.begin(), all.end(),
                       [](const Diagnostic& d) { return d.code == "program-number-not-printed"; });
  };
  CHECK_FALSE(warned("O20"));
  CHECK_FALSE(warned("O0020 (PLATE)"));
  CHECK(warned("O200"));
  CHECK(warned("(SEE O20)"));
}

TEST_CASE("an input that opens with another value than its field is a warning") {
  Project project;
  project.options.common.field = {{"L", "a"}};
  project.file("DefineData.txt", "a = 7\nb = 8\n");
  const auto warned = [&](const std::string& initial) {
    project.file("CycleData.dlg",
                 "dialog \"t\", 0, 0, 400, 400\ninput 80, 20, 50, 20, a" + initial +
                     "\ninput 80, 60, 50, 20, b, B\nok 1, 300, 50, 20\ncancel 80, 300, 50, 20\n");
    const driver::Outcome outcome = project.post();
    CHECK(outcome.output == "N10 X7.\n");
    const auto& all = outcome.diagnostics.all();
    return std::any_of(all.begin(), all.end(),
                       [](const Diagnostic& d) { return d.code == "input-opens-with-other"; });
  };
  CHECK_FALSE(warned(""));
  CHECK_FALSE(warned(", A"));
  CHECK_FALSE(warned(", 7.0"));
  CHECK(warned(", 25"));
  CHECK(warned(", b"));
}

TEST_CASE("a routine of other cycles only is said before its fields are missed") {
  Project project;
  project.options.source.routine = "main";
  project.options.source.cycle = "plug";
  project.options.common.set = {{"L", "1"}};
  const driver::Outcome outcome = project.post();
  CHECK(errors(outcome) == Codes{"nothing-posted"});
  CHECK(outcome.status == 1);
}
