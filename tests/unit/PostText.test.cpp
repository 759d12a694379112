// What `post` says of blocks whose text is not certain.
#include "driver/Driver.h"
#include "support/messages/ComPost.h"
#include "tests/GoldenRunner.h"
#include "tests/unit/DataFolder.h"

#include <algorithm>
#include <doctest/doctest.h>

using namespace dotek;
using dotek::tests::DataFolder;

namespace {

constexpr std::string_view kHead = "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\n";

// One cycle `web` with a field `X`.
class Project {
public:
  Project() {
    file("DefineData.txt", "X = 10\n");
    file("CycleData.dlg", "dialog \"t\", 0, 0, 400, 400\nlabel 10, 20, 50, 20, \"X\"\n"
                          "input 80, 20, 50, 20, X, X\nok 1, 300, 50, 20\ncancel 80, 300, 50, 20\n");
    file("CycleData.mac", "dialog \"CycleData.dlg\"\n");
    file("ToolPath.mac", "callback_returncode = 0\n");
    options.folders = {folder_.path() + "/web"};
    options.source.form = "thesis-a"; // not taken unasked, so nothing is said of it
  }
  void file(const std::string& name, const std::string& text) { folder_.write("web/" + name, text); }
  // The statements of the cycle's branch.
  driver::Outcome post(const std::string& branch, std::string_view head = kHead) {
    return prog(std::string(head) + "main:\nIF CycleType?('web')\n" + branch + "\nEND\nRETURN\n");
  }
  driver::Outcome prog(const std::string& text) {
    options.source.prog = folder_.write("prog.txt", text);
    return driver::post(options);
  }
  driver::Outcome post() const { return driver::post(options); }
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }
  std::string write(const std::string& name, const std::string& text) { return folder_.write(name, text); }

  driver::PostOptions options;

private:
  DataFolder folder_;
};

using Codes = std::vector<std::string>;

Codes codes(const driver::Outcome& outcome) {
  Codes out;
  for (const Diagnostic& d : outcome.diagnostics.all())
    if (d.code != diag::FormAssumed::code) out.emplace_back(d.code); // tests/unit/NewForm.test.cpp
  return out;
}

} // namespace

TEST_CASE("a routine that is posted is not called unused") {
  Project project;
  const driver::Outcome outcome = project.post(" SeqC ' X'OpFieldData#('X') EOL");
  CHECK(outcome.output == "N10 X10.\n");
  CHECK(codes(outcome).empty());
}

TEST_CASE("a block of a number alone is printed with a warning") {
  Project project;
  const driver::Outcome outcome = project.post(" SeqC SetFlag('q') EOL SeqC ' M1' EOL ' A'SeqC EOL");
  CHECK(outcome.output == "N10\nN20 M1\n AN30\n");
  CHECK(codes(outcome) == Codes{"block-number-alone"});
}

TEST_CASE("bytes that are no printable ASCII are copied, with a warning") {
  Project project;
  const driver::Outcome outcome = project.post(" ' (\x9E \xB0)' EOL ' M1' EOL");
  CHECK(outcome.output == " (\x9E \xB0)\n M1\n");
  CHECK(codes(outcome) == Codes{"text-not-ascii"});
}

TEST_CASE("an apostrophe doubled inside a text is marked") {
  Project project;
  CHECK(codes(project.post(" ' it''s' EOL")) == Codes{"unverified-in-prog"});
  CHECK(codes(project.post(" ' X'OpFieldData#('X')'' EOL")).empty());
  CHECK(codes(project.post(" ' X' 'Y' EOL")).empty());
}

TEST_CASE("FORMAT of a command or of another kind of keyword gives no number its picture") {
  Project project;
  project.options.common.host = {{"clearance", "5"}};
  CHECK(codes(project.post(" SeqC ZCP1 EOL", "#2 = '####.0'\nFORMAT(ZCP1,2)\n")) ==
        Codes{"format-of-command"});
  const Codes kind =
      codes(project.post(" SeqC ' X'OpFieldData#('X') EOL", "#1 = '##.#'\nFORMAT(OpFieldData,1)\n"));
  CHECK(std::find(kind.begin(), kind.end(), "no-picture") != kind.end());
}

TEST_CASE("a flag that a routine sets which has not run is not silently false") {
  Project project;
  const std::string prog = std::string(kHead) +
                           "main:\n IF Flag?('on') ' M32' EOL ELSE ' M5' EOL END\nRETURN\n"
                           "ck:\n IF CycleType?('web') SetFlag('on') END\nRETURN\n"
                           "both: ck main RETURN\n";
  project.options.source.routine = "main";
  driver::Outcome outcome = project.prog(prog);
  CHECK(outcome.output == " M5\n");
  CHECK(codes(outcome) == Codes{"flag-set-elsewhere"});
  project.options.source.routine = "both";
  outcome = project.prog(prog);
  CHECK(outcome.output == " M32\n");
  CHECK(codes(outcome).empty());
}

TEST_CASE("a condition that stays open is an error beside any warning") {
  Project project;
  const driver::Outcome outcome = project.prog(
      std::string(kHead) + "main:\n IF CycleType?('web')\n  IF Flag?('on') OR AbsValue?\n   ' A' EOL "
                           "ELSE ' B' EOL END\n END\nRETURN\nck: SetFlag('on') RETURN\n");
  CHECK(outcome.status == 1);
  CHECK(outcome.output.empty());
}

TEST_CASE("flow words of other languages are told apart") {
  Project project;
  driver::LintOptions lint;
  lint.paths = {project.write("prog.txt", "main:\n SeqC ' A' EOL IF AbsValue? THEN ENDIF\nRETURN\n")};
  const driver::Outcome outcome = driver::lint(lint);
  std::string all;
  for (const Diagnostic& d : outcome.diagnostics.all())
    all += d.message + "\n";
  CHECK(all.find("an IF ends with `END`") != std::string::npos);
  CHECK(all.find("has no THEN") != std::string::npos);
}

TEST_CASE("an empty Prog and a Prog in UTF-16 say what they are") {
  Project project;
  CHECK(codes(project.prog("")) == Codes{"empty-prog"});
  driver::LintOptions lint;
  std::string wide = "\xFF\xFE";
  for (const char letter : tests::readAll(tests::root() / "examples" / "post.txt"))
    wide += std::string{letter, '\0'};
  lint.paths = {project.write("wide.txt", wide)};
  CHECK(codes(driver::lint(lint)) == Codes{"utf16-input"});
}

TEST_CASE("a construct that stops the run is named once") {
  Project project;
  project.file("CycleData.mac",
               "dialog \"CycleData.dlg\"\nif X < 1 or X > 20 then callback_returncode = 1\n");
  CHECK(codes(project.post(" SeqC ' A' EOL")) == Codes{"unverified-construct-run"});
}

TEST_CASE("a dialog that is not there is named once") {
  Project project;
  project.file("CycleData.mac", "dialog \"Nix.dlg\"\n");
  CHECK(codes(project.post(" SeqC ' A' EOL")) == Codes{"dialog-file-missing"});
}

TEST_CASE("a message shown before the dialog is the reason of a return code") {
  Project project;
  project.file("CycleData.mac", "if X > 5 then message \"too long\"\nif X > 5 then callback_returncode = 2\n"
                                "dialog \"CycleData.dlg\"\n");
  const driver::Outcome outcome = project.post(" SeqC ' A' EOL");
  REQUIRE(codes(outcome) == Codes{"values-rejected"});
  CHECK(outcome.diagnostics.all().front().message.find("too long") != std::string::npos);
}

TEST_CASE("what is missing is said once, however often it is printed") {
  Project project;
  CHECK(codes(project.post(" ' L'OpFieldData#('L')' L'OpFieldData#('L') EOL OpFieldData#('L') EOL")) ==
        Codes{"missing-field"});
  CHECK(codes(project.post(" Speed EOL Speed EOL")) == Codes{"command-not-in-form"});
  CHECK(codes(project.post(" ZCP1 EOL ZCP1 EOL")) == Codes{"host-input-needed"});
  project.options.common.assume = {"missing-field-zero"};
  const driver::Outcome outcome = project.post(" ' L'OpFieldData#('L')' L'OpFieldData#('L') EOL");
  CHECK(outcome.output == " L0 L0\n");
  CHECK(codes(outcome) == Codes{"missing-field-zero"});
}

TEST_CASE("checks that depend on no host input do not ask for one") {
  Project project;
  project.file("CycleData.mac", "get_tool_data 5, MTOOL_RADIUS, rad\ndialog \"CycleData.dlg\"\n"
                                "if X < rad then callback_returncode = 1\n");
  CHECK(codes(project.post(" SeqC ' A' EOL")) == Codes{"condition-open"});
}
