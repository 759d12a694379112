// Posts and programs as a customer has them: their own tool offset and system, offsets as arguments, checks
// that reject most values, modes that are put back; and the document that is handed over.
#include "driver/Driver.h"
#include "support/Sha256.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace dotek::tests {

namespace {

// The routine with the blocks before its probe is switched on, and the words of the touch.
std::string postWith(const std::string& before, const std::string& touch) {
  return "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\n\nprobe:\nIF CycleType?('surface-x')\n" + before +
         " SeqC SpinOff EOL\n SeqC CoolOff EOL\n SeqC ' M31' EOL\n SeqC ' G65 P9770' ZCP1 ' F3000' EOL\n"
         " SeqC ' G65 P9770 Z'OpFieldData#('Z')' F500' EOL\n"
         " SeqC ' G65 P9023 S'OpFieldData#('G')" +
         touch +
         "' I'OpFieldData#('I') EOL\n SeqC ' G65 P9770 Z'OpFieldData#('R')' F3000' EOL\n SeqC ' M32' "
         "EOL\nEND\n"
         "RETURN\n";
}

driver::VerifyOptions cycle(const std::string& prog, const std::string& to) {
  driver::VerifyOptions out;
  out.inputs = {(root() / "examples/surface-x").string()};
  out.source.prog = prog;
  out.to = to;
  out.cases = 60;
  out.jobs = 1;
  return out;
}

driver::VerifyOptions programs(const std::string& path, std::uint64_t cases = 60) {
  driver::VerifyOptions out;
  out.inputs = {path};
  out.to = "fanuc";
  out.cases = cases;
  out.jobs = 1;
  out.common.assume.insert("probe-on");
  return out;
}

std::string told(const driver::Outcome& outcome) {
  std::string out = outcome.output;
  for (const Diagnostic& one : outcome.diagnostics.all()) {
    out += std::string(one.code) + ": " + one.message + "\n";
    for (const DiagnosticNote& note : one.notes)
      out += "  " + note.message + "\n";
  }
  return out;
}

const std::string kTouch = "' X'OpFieldData#('X')";

} // namespace

TEST_CASE("verify: a post selects its own work system and tool offset") {
  const TestFolder folder("dotek-verify-customer");
  const std::string blocks[] = {" SeqC ' G54' EOL\n SeqC ' G43 H7 D1' EOL\n", " SeqC ' G58 G43 H12' EOL\n"};
  for (const std::string& before : blocks) {
    const std::string prog = folder.write("own.txt", postWith(before, kTouch));
    const driver::Outcome path = driver::verify(cycle(prog, ""));
    CHECK_MESSAGE(path.output == "AGREES: 60 of 60 drawn cases\n", told(path));
    const driver::Outcome fanuc = driver::verify(cycle(prog, "fanuc"));
    CHECK_MESSAGE(fanuc.output.starts_with("AGREES: 60 of 60 drawn cases"), told(fanuc));
  }
}

TEST_CASE("verify: a tool length that the translation lacks, or puts in force later, is a difference") {
  const TestFolder folder("dotek-verify-customer");
  const std::string prog = folder.write("own.txt", postWith(" SeqC ' G43 H7' EOL\n", kTouch));
  driver::ConvertOptions convert;
  convert.inputs = cycle(prog, "fanuc").inputs;
  convert.source.prog = prog;
  convert.to = "fanuc";
  const std::string text = driver::convert(convert).output;
  const std::string block = "G43 H7\n";
  const std::size_t at = text.find(block);
  REQUIRE_MESSAGE(at != std::string::npos, text);
  const std::string without = text.substr(0, at) + text.substr(at + block.size());
  const std::size_t next = without.find("\nG65", at); // the first protected move, after the probe is on
  REQUIRE(next != std::string::npos);
  const std::size_t after = without.find('\n', next + 1) + 1;
  const std::string later = without.substr(0, after) + block + without.substr(after);
  const auto judged = [&](const std::string& translation) {
    driver::VerifyOptions options = cycle(prog, "fanuc");
    options.allowEdits = true; // the cases alone are to show it
    options.translation = folder.write("edited.nc", translation);
    const driver::Outcome outcome = driver::verify(options);
    return outcome.output + told(outcome);
  };
  CHECK_MESSAGE(judged(text).starts_with("AGREES"), judged(text));
  CHECK_MESSAGE(judged(without).starts_with("DIFFERS"), judged(without));
  CHECK_MESSAGE(judged(later).starts_with("DIFFERS"), judged(later));
}

TEST_CASE("verify: a tool offset that is mixed up, or written otherwise, is a difference") {
  const TestFolder folder("dotek-verify-customer");
  const std::string text = "%\nO100\nG54G90\nG43H5Z100.\nG0X0Y0\nZ5.\nG31Z-4.F100\n#[2000+9]=#5063\nM30\n%\n";
  const std::string source = folder.write("tool.nc", text);
  CHECK(driver::verify(programs(source)).output.starts_with("AGREES"));
  for (const auto& [from, to, aspect] :
       {std::tuple("H5", "H6", "path differs"),
        std::tuple("2000+9", "2000+8", "tool offset differs: tool offset 8")}) {
    std::string other = text;
    other.replace(other.find(from), std::string(from).size(), to);
    driver::VerifyOptions options = programs(source);
    options.allowEdits = true; // the cases alone are to show it
    options.translation = folder.write("edited.nc", other);
    const driver::Outcome outcome = driver::verify(options);
    CHECK(outcome.output.starts_with("DIFFERS: 60 of 60"));
    CHECK_MESSAGE(told(outcome).find(aspect) != std::string::npos, told(outcome));
  }
}

TEST_CASE("verify: arguments that choose an offset are drawn as one, through copies and calls") {
  const TestFolder folder("dotek-verify-customer");
  const std::string source = folder.write(
      "choose.nc",
      "%\nO9100\nIF[#19 NE FIX[#19]]GOTO91\nIF[#19 LT 1]GOTO91\nIF[#19 GT 90]GOTO91\n"
      "IF[#7 LT 54]GOTO92\nIF[#7 GT 59]GOTO92\nG65P9101H#19A#7\nM99\n"
      "N91#3000=91(TOOL)\nN92#3000=92(SYSTEM)\n"
      "O9101\n#20=#11\n#21=2000+#20\nG#1\nG43H#20Z60.\n#[#21]=#[#21]+0.1\nG10L2P[#1-53]X1.\nM99\n%\n");
  const driver::Outcome outcome = driver::verify(programs(source));
  CHECK_MESSAGE(outcome.output.starts_with("AGREES: 60 of 60"), told(outcome));
}

TEST_CASE("verify: checks that reject most values are met one after the other") {
  const TestFolder folder("dotek-verify-customer");
  const std::string source = folder.write(
      "checks.nc",
      "%\nO9200\nIF[#1 LT 31.]GOTO91\nIF[#1 GT 45.]GOTO91\nIF[#2 LE #1]GOTO92\nIF[#2 GT [#1+5.]]GOTO92\n"
      "IF[#19 LT 201]GOTO93\nIF[#19 GT 240]GOTO93\nG0X#1Y#2\n#500=#19\nM99\n"
      "N91#3000=91(A)\nN92#3000=92(B)\nN93#3000=93(S)\n%\n");
  const driver::Outcome outcome = driver::verify(programs(source, 100));
  CHECK_MESSAGE(outcome.output.starts_with("AGREES:"), told(outcome));
}

TEST_CASE("verify: where no values are found, the check and the flag are named") {
  const TestFolder folder("dotek-verify-customer");
  const std::string source =
      folder.write("never.nc", "%\nO9300\nIF[[#1*#1] NE 12345.678]THEN #3000=5(A IS WRONG)\nG0X#2\nM99\n%\n");
  const driver::Outcome outcome = driver::verify(programs(source, 10));
  CHECK(outcome.output.starts_with("UNDECIDED: 10 of 10"));
  CHECK_MESSAGE(told(outcome).find("this check rejected 4000 draws; `--var 1=VALUE` fixes what it reads") !=
                    std::string::npos,
                told(outcome));

  driver::VerifyOptions options = cycle(folder.write("post.txt", postWith("", kTouch)), "");
  options.common.set = {{"R", "-900"}};
  options.common.set.emplace_back("Z", "900");
  const driver::Outcome cycles = driver::verify(options);
  CHECK(cycles.status == 1);
  CHECK_MESSAGE(told(cycles).find("The retract height lies below the touch") != std::string::npos,
                told(cycles));
  CHECK(told(cycles).find(" of them: ") != std::string::npos);
}

TEST_CASE("verify: a return to the reference point is no fault of one side") {
  const TestFolder folder("dotek-verify-customer");
  const std::string source = folder.write("home.nc", "%\nO100\nG91G28Z0\nG90G0X10.\nG1Z-5.F100\nM30\n%\n");
  const driver::Outcome outcome = driver::verify(programs(source));
  CHECK_MESSAGE(outcome.output.starts_with("AGREES: 60 of 60"), told(outcome));
}

TEST_CASE("convert: modal codes that a program keeps and puts back") {
  const TestFolder folder("dotek-verify-customer");
  driver::VerifyOptions options = programs(folder.write(
      "saved.nc", "%\nO9400\n#1=#4001\n#3=#4003\nG91G1X[#24]F300\nG#1G#3\nX1.\nG#4012\nM99\n%\n"));
  options.fromControl = "fanuc-31i-b";
  options.control = "fanuc-0i-md";
  const driver::Outcome saved = driver::verify(options);
  CHECK_MESSAGE(saved.output.starts_with("AGREES: 60 of 60"), told(saved));
  // Not what an argument may be, nor what is set on one path alone, nor anything else.
  for (const std::string& kept :
       {std::string("IF[#1 EQ #0]THEN #1=#4001\n"), std::string("IF[#9 GT 1]GOTO5\n#1=#4001\nN5\n"),
        std::string("#1=#4001\n#1=#1+1\n"), std::string("#1=#4101\n"), std::string()}) {
    options.inputs = {folder.write("open.nc", "%\nO9401\n" + kept + "G0X1.\nG#1\nM99\n%\n")};
    const driver::Outcome open = driver::verify(options);
    CHECK_MESSAGE(told(open).find("code-computed") != std::string::npos, kept << told(open));
  }
}

TEST_CASE("verify: a difference names the pair that differs") {
  const TestFolder folder("dotek-verify-customer");
  // The sign that the macro draws is not the one that is posted: no fault of the translation.
  const std::string wrong = folder.write("wrong.txt", postWith("", "' X-'OpFieldData#('X')"));
  const std::string outcome = told(driver::verify(cycle(wrong, "fanuc")));
  CHECK_MESSAGE(outcome.find("(drawn path against post, in 60 of 60 cases)") != std::string::npos, outcome);
  CHECK(outcome.find("source against translation") == std::string::npos);
  CHECK(outcome.find("the translation does the same as the post") != std::string::npos);
}

TEST_CASE("verify: the document says the same in each format, and escapes what it shows") {
  const TestFolder folder("dotek-verify-customer");
  const std::string source = folder.write(
      "a&b.nc", "%\nO100(<B> & `C`)\nG0X#1\nIF[#1 LT 3]GOTO9\nG1Z5.F100(</pre><script>)\nN9M30\n%\n");
  driver::VerifyOptions options = programs(source);
  options.translation =
      folder.write("edited.nc", "%\nO100\nG0X#1\nIF[#1 LT 3]GOTO9\nG1Z6.F100(</pre><script>)\nN9M30\n%\n");
  const auto report = [&](targets::ReportFormat format) {
    options.format = format;
    const driver::Outcome outcome = driver::verify(options);
    REQUIRE(outcome.files.size() == 1);
    return outcome.files.front().text;
  };
  const std::string html = report(targets::ReportFormat::Html);
  CHECK(html.find("<strong>DIFFERS</strong>") != std::string::npos);
  CHECK(html.find("a&amp;b.nc") != std::string::npos);
  CHECK(html.find("<script") == std::string::npos);
  CHECK(html.find("a&b.nc") == std::string::npos);
  CHECK(html.find("source against translation") != std::string::npos);
  CHECK(html.find("G1Z6.F100") != std::string::npos); // both texts
  CHECK(html.find("G1Z5.F100") != std::string::npos);
  CHECK(html.find("<svg") != std::string::npos);
  CHECK(html == report(targets::ReportFormat::Html));
  options.jobs = 2;
  CHECK(html == report(targets::ReportFormat::Html));
  const std::string json = report(targets::ReportFormat::Json);
  CHECK(json.find("\"verdict\": \"DIFFERS\"") != std::string::npos);
  CHECK(json.find("\"date\": null") != std::string::npos);
  const std::string markdown = report(targets::ReportFormat::Markdown);
  CHECK(markdown.find("**DIFFERS: ") != std::string::npos);
  CHECK(markdown.find("    >     5  G1Z6.F100") != std::string::npos);
  options.date = "2026-11-22";
  CHECK(report(targets::ReportFormat::Json).find("\"date\": \"2026-11-22\"") != std::string::npos);
  options.format = targets::ReportFormat::Text;
  CHECK(driver::verify(options).files.empty());
}

TEST_CASE("verify: the document lists the data files that decide what is posted") {
  const TestFolder folder("dotek-verify-customer");
  const std::string text = "schema = 1\nextends = \"fanuc-0i-md\"\ntitle = \"The shop's mill\"\n";
  const std::string control = folder.write("mill.toml", text);
  driver::VerifyOptions options = programs(folder.write("a.nc", "%\nO100\nG0X#1\nM30\n%\n"), 10);
  options.format = targets::ReportFormat::Json;
  options.common.data = {control};
  const driver::Outcome outcome = driver::verify(options);
  REQUIRE(outcome.files.size() == 1);
  const std::string& report = outcome.files.front().text;
  CHECK_MESSAGE(report.find("mill.toml") != std::string::npos, told(outcome));
  CHECK(report.find(sha256(text)) != std::string::npos);
  CHECK(report.find("built in") == std::string::npos);
}

TEST_CASE("verify: the document says what the form only assumes and what the translation changes") {
  const TestFolder folder("dotek-verify-customer");
  driver::VerifyOptions options = cycle(folder.write("own.txt", postWith("", kTouch)), "fanuc");
  options.source.form = "thesis-a";
  options.cases = 20;
  const auto report = [&](targets::ReportFormat format) {
    options.format = format;
    const driver::Outcome outcome = driver::verify(options);
    REQUIRE(outcome.files.size() == 1);
    return outcome.files.front().text;
  };
  const std::string json = report(targets::ReportFormat::Json);
  const std::size_t assumed = json.find("\"about\": \"form\"");
  REQUIRE(assumed != std::string::npos);
  CHECK(json.find("\"code\": \"form-assumed\"", assumed) != std::string::npos);
  CHECK(json.find("\"about\": \"translation\"") != std::string::npos);
  CHECK(json.find("\"code\": \"message-cut\"") != std::string::npos);
  CHECK(json.find("warnings-left-to-lint") == std::string::npos);
  const std::string html = report(targets::ReportFormat::Html);
  CHECK(html.find("<h2>What the form assumes</h2>") < html.find("<h2>Files</h2>"));
  CHECK(html.find("<code>ZCP1</code>") != std::string::npos);
  const std::string markdown = report(targets::ReportFormat::Markdown);
  CHECK(markdown.find("\n## What the form assumes\n") != std::string::npos);
  CHECK(markdown.find("\n## What the translation changes or leaves open\n") != std::string::npos);
  CHECK(markdown.find("the alarm says `") != std::string::npos); // a name stays code
  // A text that was edited by hand is none that convert speaks of.
  options.translation = folder.write("mine.nc", "(MINE)\n" + driver::convert([&] {
                                                               driver::ConvertOptions convert;
                                                               convert.inputs = options.inputs;
                                                               convert.source = options.source;
                                                               convert.to = "fanuc";
                                                               return convert;
                                                             }())
                                                                 .output);
  const std::string edited = report(targets::ReportFormat::Json);
  CHECK(edited.find("\"about\": \"form\"") != std::string::npos);
  CHECK(edited.find("\"about\": \"translation\"") == std::string::npos);
}

TEST_CASE("verify: undecided edge cases have a reason, and the document the command and the customer") {
  driver::VerifyOptions options = cycle((root() / "examples/post.txt").string(), "fanuc");
  options.source.form = "thesis-a";
  options.cases = 1000;
  options.remark = "Novak <s.r.o.>, order 4711";
  options.programNumber = 8123;
  options.format = targets::ReportFormat::Json;
  const driver::Outcome outcome = driver::verify(options);
  CHECK_MESSAGE(outcome.output.find(", 4 undecided") != std::string::npos, outcome.output);
  CHECK_MESSAGE(told(outcome).find("verify-edge-idle: 4 of 100 edge cases are undecided: ") !=
                    std::string::npos,
                told(outcome));
  REQUIRE(outcome.files.size() == 1);
  const std::string& json = outcome.files.front().text;
  CHECK(json.find("\"edge\": true") != std::string::npos);
  CHECK(json.find("\"file\": \"O8123.nc\"") != std::string::npos);
  CHECK(json.find("--to fanuc --program-number 8123") != std::string::npos);
  options.cases = 20;
  options.format = targets::ReportFormat::Html;
  const std::string html = driver::verify(options).files.front().text;
  CHECK(html.find("Novak &lt;s.r.o.&gt;, order 4711") != std::string::npos);
  // What convert has written is not edited.
  const TestFolder folder("dotek-verify-customer");
  driver::ConvertOptions convert;
  convert.inputs = options.inputs;
  convert.source = options.source;
  convert.to = "fanuc";
  convert.programNumber = 8123;
  options.translation = folder.write("O8123.nc", driver::convert(convert).output);
  CHECK(driver::verify(options).files.front().text.find("translation, edited") == std::string::npos);
  options.programNumber = 8124;
  CHECK(driver::verify(options).files.front().text.find("translation, edited") != std::string::npos);
}

} // namespace dotek::tests
