// What a target cannot take: a value out of range, an axis or a message that it does not have, a reserved
// name, too many digits, a block without a translation. Refused, or noted, at its line; never silent.
#include "DataFolder.h"
#include "FusionHelper.h"

using namespace dotek;
using namespace dotek::tests;

namespace {

constexpr std::uint32_t kLine = 6; // of the block under test

// A cycle of three fields and a branch that prints one block, then measures.
class OneBlock {
public:
  OneBlock() {
    folder_.write("odd/DefineData.txt", "! Odd\nX = 12\nvar = 1\nG = 55\n");
    folder_.write("odd/CycleData.dlg", "dialog \"Odd\", 0, 0, 200, 100\ninput 10, 10, 50, 20, X, X\n"
                                       "input 10, 30, 50, 20, var, var\ninput 10, 50, 50, 20, G, G\n"
                                       "ok 10, 70, 40, 20\ncancel 60, 70, 40, 20\n");
    folder_.write("odd/ToolPath.mac", "callback_returncode = 0\n");
    message("Too great");
  }

  void message(const std::string& text) {
    folder_.write("odd/CycleData.mac", "callback_returncode = 0\n:ask\ndialog \"CycleData.dlg\"\n"
                                       "if var <= 5 then goto good\nmessage \"" +
                                           text + "\"\ngoto ask\n:good\n");
  }
  void nominal(const std::string& text) { nominal_ = text; }
  void define(const std::string& text) { folder_.write("odd/DefineData.txt", text); }

  driver::Outcome convert(const std::string& target, const std::string& block,
                          const std::function<void(driver::ConvertOptions&)>& change = {}) {
    folder_.write("post.txt", "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\nprobe:\nIF CycleType?('odd')\n"
                              " SeqC ' G90 G0 X1. Y2. Z60.' EOL\n SeqC ' " +
                                  block +
                                  "' EOL\n SeqC ' M5 M9' EOL\n SeqC ' G65 P9770 Z10. F500.' EOL\n"
                                  " SeqC ' G65 P9023 S'OpFieldData#('G')' X'OpFieldData#('X')' " +
                                  nominal_ + " EOL\nEND\nRETURN\n");
    driver::ConvertOptions out;
    out.inputs = {folder_.path() + "/odd"};
    out.source.prog = folder_.path() + "/post.txt";
    out.to = target;
    if (target == "mikroprog") {
      out.control = "mikroprog-mill";
      out.common.host = {{"clearance", "5"},      {"tool_radius", "3"}, {"overtravel", "5"},
                         {"return_feed", "1000"}, {"start_x", "0"},     {"start_y", "0"}};
    }
    if (change) change(out);
    return driver::convert(out);
  }

private:
  DataFolder folder_;
  std::string nominal_ = "I'OpFieldData#('var')";
};

// Codes of the diagnostics of `severity` in a line of a file whose name ends so; line 0: any.
std::set<std::string> codesAt(const driver::Outcome& outcome, Severity severity, const std::string& file,
                              std::uint32_t line) {
  std::set<std::string> out;
  for (const Diagnostic& one : outcome.diagnostics.all()) {
    if (one.severity != severity || !one.range.hasPlace()) continue;
    if (!outcome.sources.file(one.range.file).name().ends_with(file)) continue;
    if (line != 0 && outcome.sources.line(one.range) != line) continue;
    out.emplace(one.code);
  }
  return out;
}

using Codes = std::set<std::string>;
const char* const kTargets[] = {"fanuc", "mikroprog", "fusion"};

} // namespace

TEST_CASE("a word out of its range is refused for every target") {
  OneBlock one;
  for (const char* target : kTargets) {
    CAPTURE(target);
    for (const char* block :
         {"G1 X3. F-500.", "G1 X3. F0.", "F0", "G4 X-1.", "G4 P-5", "M3 S-100", "G65 P9770 Z20. F-5.",
          "G65 P9770 Z20. F0", "G65 P9023 S55. D0 I1. J1.", "G65 P9023 S55. D-3. I1. J1."}) {
      CAPTURE(block);
      const driver::Outcome refused = one.convert(target, block);
      CHECK(refused.status == 1);
      CHECK(codesAt(refused, Severity::Error, "post.txt", kLine) == Codes{"value-out-of-range"});
    }
    for (const char* block : {"G1 X3. F500.", "G4 X0.", "M3 S0"})
      CHECK_MESSAGE(one.convert(target, block).status == 0, block);
    const driver::Outcome system = one.convert(target, "G65 P9023 S60. X5. I1.");
    CHECK(codesAt(system, Severity::Error, "post.txt", kLine) == Codes{"no-work-system"});
  }
}

TEST_CASE("a field out of the range of the dialog's checks is refused for every target") {
  OneBlock one;
  for (const char* target : kTargets) {
    CAPTURE(target);
    const auto given = one.convert(target, "M9", [](auto& options) { options.common.set = {{"var", "6"}}; });
    CHECK(given.status == 1);
    CHECK(codesAt(given, Severity::Error, "CycleData.mac", 5) == Codes{"values-rejected"});
    const auto system = one.convert(target, "M9", [](auto& options) { options.common.set = {{"G", "60"}}; });
    CHECK(codesAt(system, Severity::Error, "post.txt", 9) == Codes{"no-work-system"});
  }
}

TEST_CASE("a default out of the range of the checks is reported at its line for every target") {
  OneBlock one;
  one.define("! Odd\nX = 12\nvar = 6\nG = 55\n");
  const auto fanuc = one.convert("fanuc", "M9");
  CHECK(fanuc.status == 0);
  CHECK(codesAt(fanuc, Severity::Warning, "DefineData.txt", 3).contains("default-turned-away"));
  CHECK(codesAt(one.convert("mikroprog", "M9"), Severity::Error, "DefineData.txt", 3) ==
        Codes{"field-needed"});
  const auto fusion = one.convert("fusion", "M9");
  CHECK(fusion.status == 0);
  CHECK(codesAt(fusion, Severity::Warning, "DefineData.txt", 3).contains("default-turned-away"));
}

TEST_CASE("a field that leads to a word out of its range is refused when folded, or stops the fragment") {
  OneBlock one;
  one.define("! Odd\nX = 12\nvar = -4\nG = 55\n");
  one.nominal("I1.'");
  for (const char* block : {"G1 X5. F'OpFieldData#('var')'", "G65 P9770 Z9. F'OpFieldData#('var')'",
                            "G4 X'OpFieldData#('var')'", "M3 S'OpFieldData#('var')'"}) {
    CAPTURE(block);
    const auto refused = one.convert("mikroprog", block);
    CHECK(codesAt(refused, Severity::Error, "post.txt", kLine) == Codes{"value-out-of-range"});
  }
  const auto fusion = one.convert("fusion", "G65 P9770 Z9. F'OpFieldData#('var')'",
                                  [](auto& options) { options.probeMacros = "inspection-plus"; });
  CHECK_MESSAGE(fusion.status == 0, messagesOf(fusion));
  CHECK(fusion.output.find("if (var_ <= 0) {") != std::string::npos);
}

TEST_CASE("an axis that the target lacks is refused at its line") {
  OneBlock one;
  const auto lathe = [](auto& options) { options.control = "mikroprog-s280"; };
  CHECK(codesAt(one.convert("mikroprog", "G0 Y5.", lathe), Severity::Error, "post.txt", 0) ==
        Codes{"axis-missing"});
  for (const char* block : {"G0 A5.", "G0 C5.", "G0 U5."}) {
    CAPTURE(block);
    CHECK(codesAt(one.convert("mikroprog", block), Severity::Error, "post.txt", kLine) ==
          Codes{"opaque-block-refused"});
    // The control of the source may have it.
    CHECK(codesAt(one.convert("fanuc", block), Severity::Note, "post.txt", kLine) == Codes{"opaque-block"});
    CHECK(codesAt(one.convert("fusion", block), Severity::Note, "post.txt", kLine) == Codes{"opaque-block"});
    CHECK(codesAt(one.convert("fanuc", block, [](auto& options) { options.control = "fanuc-31i-b"; }),
                  Severity::Error, "post.txt", kLine) == Codes{"axis-not-known"});
    CHECK(codesAt(one.convert("fanuc", block,
                              [](auto& options) {
                                options.control = "fanuc-31i-b";
                                options.common.assume = {"same-axes"};
                              }),
                  Severity::Note, "post.txt", kLine) == Codes{"opaque-block"});
  }
}

TEST_CASE("a message that the control cannot show is refused or told at its line") {
  OneBlock one;
  const std::string odd = "P\xC5\x99\xC3\xADli\xC5\xA1 <velk\xC3\xA9>";
  one.message(odd);
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b", "fanuc-6m"}) {
    CAPTURE(control);
    const auto refused = one.convert("fanuc", "M9", [&](auto& options) { options.control = control; });
    CHECK(codesAt(refused, Severity::Error, "CycleData.mac", 5).contains("message-characters"));
  }
  // A script may hold every character; the checks of a folded program have passed.
  const auto fusion = one.convert("fusion", "M9");
  CHECK(fusion.status == 0);
  CHECK(fusion.output.find("P\\u0159\\u00EDli\\u0161 <velk\\u00E9>") != std::string::npos);
  CHECK(one.convert("mikroprog", "M9").status == 0);

  one.message("Too great");
  const std::string accent = "(\xC5\x98"
                             "EZ)";
  for (const std::string& block : {accent, "M0 " + accent}) {
    CAPTURE(block);
    CHECK(codesAt(one.convert("fanuc", block), Severity::Note, "post.txt", kLine) == Codes{"comment-plain"});
    CHECK(codesAt(one.convert("mikroprog", block), Severity::Note, "post.txt", kLine) ==
          Codes{"comment-plain"});
    CHECK(codesAt(one.convert("fusion", block), Severity::Warning, "post.txt", kLine) ==
          Codes{"fusion-not-ascii"});
  }
  CHECK(one.convert("mikroprog", "M0 " + accent).output.find(" M0 ;REZ\r\n") != std::string::npos);
}

TEST_CASE("an alarm is a stop with its text on a control without alarms") {
  OneBlock one;
  const auto mikroprog = one.convert("mikroprog", "#3000=5(HALT)");
  CHECK(mikroprog.status == 0);
  CHECK(codesAt(mikroprog, Severity::Note, "post.txt", kLine) == Codes{"alarm-stops"});
  CHECK(mikroprog.output.find(" M0 ;HALT\r\n") != std::string::npos);
  CHECK(mikroprog.output.find(";AN ALARM IS A STOP WITH ITS TEXT") != std::string::npos);
  // Printed as it is.
  for (const char* set : {"easyprobe", "inspection-plus"}) {
    const auto fusion =
        one.convert("fusion", "#3000=5(HALT)", [&](auto& options) { options.probeMacros = set; });
    CHECK(codesAt(fusion, Severity::Note, "post.txt", kLine).empty());
    CHECK(fusion.output.find("\"#3000=5(HALT)\"") != std::string::npos);
  }
}

TEST_CASE("a name that JavaScript reserves is reported at its line") {
  OneBlock one;
  const auto fusion = one.convert("fusion", "M9");
  CHECK(fusion.status == 0);
  CHECK(codesAt(fusion, Severity::Note, "DefineData.txt", 3) == Codes{"reserved-name"});
  CHECK(fusion.output.find("var var_ = ") != std::string::npos);
  CHECK(fusion.output.find("var var = ") == std::string::npos);
}

TEST_CASE("a value with more digits than its format keeps is reported at its line for every target") {
  OneBlock one;
  const auto finer = [](auto& options) { options.common.set = {{"var", "1.23456"}, {"X", "-12.5"}}; };
  CHECK(codesAt(one.convert("fanuc", "M9", finer), Severity::Warning, "post.txt", 9) ==
        Codes{"number-rounded"});
  CHECK(codesAt(one.convert("mikroprog", "M9", finer), Severity::Warning, "post.txt", 9) ==
        Codes{"number-rounded"});
  CHECK(codesAt(one.convert("fusion", "M9", finer), Severity::Warning, "post.txt", 9) ==
        Codes{"fusion-digits"});
  for (const char* target : kTargets) {
    CAPTURE(target);
    const auto wide = one.convert(target, "M9", [](auto& options) { options.common.set = {{"X", "12345"}}; });
    CHECK(codesAt(wide, Severity::Error, "post.txt", 9) == Codes{"value-does-not-fit"});
  }
  // A literal of the block.
  CHECK(codesAt(one.convert("fanuc", "G0 X1.23456"), Severity::Warning, "post.txt", kLine) ==
        Codes{"number-rounded"});
  CHECK(codesAt(one.convert("mikroprog", "G0 X1.23456"), Severity::Warning, "post.txt", kLine) ==
        Codes{"number-rounded"});
  CHECK(one.convert("fusion", "G0 X1.23456").output.find("\"G0 X1.23456\"") != std::string::npos);
}

TEST_CASE("a block without a translation is copied with a note to its own control, else refused") {
  OneBlock one;
  for (const char* block : {"G43 H1", "T5", "M6", "G2 X5. Y5. R3. F100.", "G10 L2 P1 X0.", "G53 X0. Y0."}) {
    CAPTURE(block);
    const auto fanuc = one.convert("fanuc", block);
    CHECK(codesAt(fanuc, Severity::Note, "post.txt", kLine).contains("opaque-block"));
    CHECK(fanuc.output.find(std::string("\n") + block + "\n") != std::string::npos);
    const auto fusion = one.convert("fusion", block);
    CHECK(codesAt(fusion, Severity::Note, "post.txt", kLine).contains("opaque-block"));
    CHECK(fusion.output.find("\"" + std::string(block) + "\"") != std::string::npos);
    // The length of the probe is what Mikroprog has by itself.
    const bool length = std::string_view(block).starts_with("G43");
    CHECK(codesAt(one.convert("mikroprog", block), Severity::Error, "post.txt", kLine) ==
          (length ? Codes{} : Codes{"opaque-block-refused"}));
  }
}

TEST_CASE("a copied block goes where its codes mean the same, and beside other macros where it leaves their "
          "modes") {
  OneBlock one;
  const auto set = [](auto& options) { options.probeMacros = "inspection-plus"; };
  const auto other = [](auto& options) { options.control = "fanuc-6m"; };
  for (const char* block : {"G43 H1", "T5", "M6"}) {
    CAPTURE(block);
    const auto fusion = one.convert("fusion", block, set);
    CHECK(fusion.output.find("\"" + std::string(block) + "\"") != std::string::npos);
    // Where the axes are after a tool change is in no table: the control is asked.
    CHECK((fusion.output.find("X[#504") != std::string::npos) == (std::string_view(block) == "M6"));
    const auto fanuc = one.convert("fanuc", block, other);
    CHECK(fanuc.output.find(std::string("\n") + block + "\n") != std::string::npos);
  }
  for (const char* block : {"G10 L2 P1 X0.", "M77"}) {
    CAPTURE(block);
    const auto fusion = one.convert("fusion", block, set);
    if (std::string_view(block) == "M77")
      CHECK(codesAt(fusion, Severity::Error, "post.txt", kLine) == Codes{"fusion-opaque"});
    else // an offset: where the axes are is asked of the control
      CHECK(fusion.output.find("\"" + std::string(block) + "\"") != std::string::npos);
    CHECK(codesAt(one.convert("fanuc", block, other), Severity::Error, "post.txt", kLine) ==
          Codes{std::string_view(block) == "M77" ? "opaque-block-refused" : "data-input-refused"});
  }
}
