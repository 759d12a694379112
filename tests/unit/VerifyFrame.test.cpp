// The frame around the motion of a translation: what it owes its caller, whoever that is. Each damage is one
// that a programmer makes by hand in a program that is right.
#include "driver/Driver.h"
#include "support/Worker.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <string>
#include <vector>

namespace dotek::tests {

namespace {

struct Source {
  const char* folder;
  const char* prog;
  const char* macros;
  const char *x = "", *y = ""; // where the post goes first
};

void take(const Source& source, targets::TranslationOptions& out, const std::string& to) {
  const std::string examples = (root() / "examples").string() + "/";
  out.inputs = {examples + source.folder};
  out.source.prog = *source.prog == '/' ? source.prog : examples + source.prog;
  out.source.form = "thesis-a";
  out.to = to;
  out.probeMacros = source.macros;
  out.common.scriptProgram = runningProgram();
  if (*source.x != 0) out.common.host = {{"start_x", source.x}, {"start_y", source.y}};
}

std::string converted(const Source& source, const std::string& to) {
  driver::ConvertOptions options;
  take(source, options, to);
  const driver::Outcome outcome = driver::convert(options);
  REQUIRE(outcome.status == 0);
  return outcome.files.front().text;
}

// What verify says of a text in the place of the conversion.
struct Said {
  int status = 0;
  std::string text; // messages and verdict
};

Said verified(const Source& source, const std::string& to, const std::string& text,
              std::uint64_t cases = 20) {
  const TestFolder scratch("dotek-verify-frame");
  driver::VerifyOptions options;
  take(source, options, to);
  options.cases = cases;
  options.jobs = 1;
  options.allowEdits = true; // the cases alone are to show it
  options.translation = scratch.write("edited", text);
  const driver::Outcome outcome = driver::verify(options);
  return {outcome.status, renderText(outcome.diagnostics, outcome.sources, 0) + outcome.output};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE_MESSAGE(at != std::string::npos, from << " is not in\n" << text);
  return text.replace(at, from.size(), to);
}

// The first line of the code, header aside, that holds `part`.
std::string lineWith(const std::string& text, const std::string& part) {
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) {
    const std::size_t begin = text.rfind('\n', at) + 1;
    if (text[begin] != '(') return text.substr(begin, text.find('\n', at) + 1 - begin);
  }
  return "";
}

struct Damage {
  std::string part;     // of the line
  std::string from, to; // "": the line goes
  std::string says;
};

void check(const Source& source, const std::vector<Damage>& damages, std::uint64_t cases = 20) {
  const std::string good = converted(source, "fanuc");
  CAPTURE(good);
  CHECK(verified(source, "fanuc", good).status == 0);
  for (const Damage& damage : someOf(damages)) {
    CAPTURE(damage.part);
    const std::string line = lineWith(good, damage.part);
    REQUIRE_FALSE(line.empty());
    const std::string text =
        replaced(good, line, damage.from.empty() ? "" : replaced(line, damage.from, damage.to));
    const Said said = verified(source, "fanuc", text, cases);
    CAPTURE(said.text);
    CHECK(said.status == 1);
    CHECK(said.text.find("DIFFERS") != std::string::npos);
    CHECK(said.text.find(damage.says) != std::string::npos);
  }
}

constexpr Source kFace = {"surface-x", "post.txt", "easyprobe"};

} // namespace

TEST_CASE("verify sees what a called program does not switch, return to or put back") {
  check(kFace, {
                   {"M5", "", "", "spindle off against "},
                   {"M9", "", "", "coolant off against "},
                   {"M99", "M99", "M30", "it ends in place of going back to its caller (M99)"},
                   {"=#4001", "", "", ""},
                   {"=#4001", "#4001", "#4003", "called under G"},
                   {"=#4002", "#4002", "#4001", "of group 2"},
                   {"=#4003", "#4003", "#4005", "of group 3"},
                   {"=#4005", "#4005", "#4003", "of group 5"},
                   {"=#4109", "#4109", "#4119", "it leaves F"},
                   {"G90 G94 G17", "", "", ""},
                   {"G90 G94 G17", "G90 ", "", ""},
                   {" F#", "", "", "called under "},
               });
}

TEST_CASE("verify calls a program without each argument") {
  check(kFace,
        {
            {"ARGUMENT X MISSING", "", "", "called without X (X): `ARGUMENT X MISSING` has to stop it"},
            {"ARGUMENT Z MISSING", "MISSING", "IS MISSING", "called without Z (Z)"},
            {"EQ #0]THEN #19=55.", "55.", "57.", "called without S (G), for which 55 is the default"},
            {"EQ #0]THEN #4=0.", "", "", "called without I (I), for which 0 is the default"},
        });
}

TEST_CASE("verify calls a program by those who break what it demands") {
  std::vector<Damage> damages;
  for (const char* alarm : {"NOT METRIC", "ROTATION ACTIVE", "SCALING ACTIVE", "CUTTER COMPENSATION ON",
                            "CANNED CYCLE ACTIVE", "TOOL LENGTH NOT ACTIVE", "LOCAL SHIFT ACTIVE"})
    damages.push_back({alarm, "", "", std::string("`") + alarm + "` has to stop it before anything moves"});
  damages.push_back({"WORK OFFSET NOT 54 TO 59", "", "", "called with S 54.5"});
  damages.push_back({"#4014 LT 54.", "", "", "called where #4014 is 53: `G54 TO G59 NOT ACTIVE`"});
  damages.push_back({"#4014 GT 59.", "", "", "called where #4014 is 60: `G54 TO G59 NOT ACTIVE`"});
  damages.push_back({"NE FIX[#4014]", "", "", "called with G54.1 in force"});
  damages.push_back({"#4009 NE 80.", "NE 80.", "EQ 73.", "called with G74 in force"});
  check(kFace, damages);
  // Along Z where the program writes an offset of Z by itself.
  check({"surface-z", "mill-post.txt", "dotek", "20", "20"},
        {{"ABS[#5023", "", "", "called after G52 Z3.: `LOCAL SHIFT ACTIVE` has to stop it"}});
}

TEST_CASE("verify calls a program from beside the start that it was converted for") {
  check({"surface-z", "mill-post.txt", "easyprobe", "20", "20"},
        {{"START NOT AT X20", "", "", "called from X20.02: `START NOT AT X20` has to stop it"},
         {"START NOT AT Y20", "", "", "called from Y20.02: `START NOT AT Y20` has to stop it"},
         {"ABS[#5021", "", "", "called after G52 X3.: `LOCAL SHIFT ACTIVE` has to stop it"},
         {"ABS[#5022", "", "", "called after G52 Y3.: `LOCAL SHIFT ACTIVE` has to stop it"}});
}

TEST_CASE("verify calls a program with a tool offset that is none") {
  const TestFolder scratch("dotek-verify-offset");
  const std::string post = readAll(root() / "examples/post.txt");
  const std::string prog = scratch.write(
      "post.txt", replaced(post, " SeqC ' M31' EOL\n", " SeqC ' M31' EOL\n SeqC ' G43 H'ToolOffset# EOL\n"));
  check({"surface-x", prog.c_str(), "easyprobe"},
        {{"TOOL OFFSET NOT ABOVE 0", "", "", "called with B 0: `TOOL OFFSET NOT ABOVE 0` has to stop it"},
         {"TOOL OFFSET NOT ABOVE 0", "LE 0.", "LT 0.", "called with B 0"},
         {"TOOL OFFSET NOT ABOVE 0", "LE 0.", "EQ 0.", "called with B -1"}});
}

TEST_CASE("verify calls a program at each value where a check of the dialog turns") {
  check(kFace, {{"THE TRAVEL IS NOT LONGER)", "", "", "called with X"},
                {"THE RETRACT HEIGHT LIES)", "", "", "the dialog rejects the values, and the program moves"},
                {"ABS[#24] LE", "LE", "LT", "called with X"}});
}

TEST_CASE("verify sees what is read or written while the axes still move") {
  check(kFace, {{"G53", "", "", "reads #5021 before the motion before it has ended, the source does not"}});
  const Source source{"surface-x", "post.txt", "inspection-plus"};
  const std::string good = converted(source, "fanuc");
  const std::size_t write = good.find("\n#[5221");
  REQUIRE(write != std::string::npos);
  const std::size_t wait = good.rfind("G53\n", write);
  REQUIRE(wait != std::string::npos);
  const Said said = verified(source, "fanuc", good.substr(0, wait) + good.substr(wait + 4));
  CHECK(said.status == 1);
  CHECK(said.text.find(" before the motion before it has ended, the source does not") != std::string::npos);
}

TEST_CASE("verify sees a bound that depends on the radius, and a search made shorter") {
  const std::string good = converted(kFace, "fanuc");
  const std::string bound = lineWith(good, "ABS[#24]");
  REQUIRE_FALSE(bound.empty());
  const bool includes = bound.find(" LE ") != std::string::npos;
  check(kFace, {{"ABS[#24]", includes ? " LE " : " LT ", includes ? " LT " : " LE ", ""}}, 60);
  check(kFace, {{"G65 P9023", "\n", " Q2.\n", ""}});
  check({"surface-x", "post.txt", "inspection-plus"},
        {{"G65 P9811", "\n", " Q2.\n", "the source has no overtravel, the translation overtravel 2"}});
}

TEST_CASE("verify sees what a fragment owes its post") {
  const Source source{"surface-x", "post.txt", "easyprobe"};
  const std::string good = converted(source, "fusion");
  CAPTURE(good);
  CHECK(verified(source, "fusion", good, 10).status == 0);
  const std::vector<Damage> damages = {
      {"xOutput.reset();", "", "", "`xOutput` not reset"},
      {"var clearance = surfaceX_given(", "surfaceX_given(cycle.clearance)", "cycle.clearance",
       "the fragment warns of more digits than are printed"},
      {"gMotionModal.reset();", "", "", "`gMotionModal` not reset"},
      {"surfaceX_write(x, y, z);", ";", "; return false;", "does not return true"},
      {"case \"surfaceX\":", "surfaceX", "surfaceY", ""},
      {"unit !== MM", "unit !== MM", "false", "a document in inches has to be an error"},
      {"writeBlock(\"M5\")", "writeBlock", "writeln", "written without its number"},
      {"value: 55", "55", "57", "as its property is defined"},
      {"value: 12", "12", "13", "as its property is defined"},
      {"_isNumber(X)", "!surfaceX_isNumber(X)", "false", "a text as `X` has to be an error"},
      {"return true;", "true", "false", "a probing operation has to be an error"},
      {"toolRadius <= 0", "<=", "<", "a ball without a radius has to be an error"},
      {"G % 1 !== 0", "G % 1 !== 0", "false", "a half as `G` has to be an error"},
      {"XText === null", "XText === null", "false", "does not fit and has to be an error"},
      {"if (!isFirstCyclePoint())", "!isFirst", "false && !isFirst",
       "a further point of the operation has to be an error"},
      {"value: \"none\",", "none", "surfaceX", "begins with `surfaceX`"},
      {"values.push(", "", "", "does not offer `surfaceX`"},
      {"scope: \"operation\"", "operation", "post", "has the scope `post`"},
      {"var IText", "####.##", "####.#", "the post prints other digits"},
      {"title: \"Depth of the touch", "Depth of the touch", "Height to retract to",
       "has the title `Height to retract to`, which the dialog gives to `R`"},
  };
  for (const Damage& damage : someOf(damages)) {
    CAPTURE(damage.part);
    const std::string line = lineWith(good, damage.part);
    REQUIRE_FALSE(line.empty());
    const std::string text =
        replaced(good, line, damage.from.empty() ? "" : replaced(line, damage.from, damage.to));
    const Said said = verified(source, "fusion", text, 10);
    CAPTURE(said.text);
    CHECK(said.status == 1);
    CHECK(said.text.find(damage.says) != std::string::npos);
  }
}

} // namespace dotek::tests
