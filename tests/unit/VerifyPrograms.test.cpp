// Programs of macro B beside their conversion: what is drawn, where the part comes from, what is found.
#include "driver/Driver.h"
#include "project/Programs.h"
#include "sim/machine/Value.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"
#include "tests/unit/MacroBHelper.h"
#include "tests/unit/RandomMacroB.h"
#include "tests/unit/RunHarness.h"
#include "verify/Compare.h"
#include "verify/Rehearsal.h"
#include "verify/Variables.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <map>
#include <unistd.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

namespace fs = std::filesystem;

driver::VerifyOptions optionsFor(const std::string& path, std::uint64_t cases) {
  driver::VerifyOptions out;
  out.inputs = {path};
  out.to = "fanuc";
  out.cases = cases;
  return out;
}

std::string codesOf(const driver::Outcome& outcome) {
  std::string out;
  for (const Diagnostic& one : outcome.diagnostics.all())
    out += std::string(one.code) + " " + one.message + "\n";
  return out;
}

std::map<std::uint32_t, verify::ProgramVariable> variablesIn(const std::string& text,
                                                             const std::string& control = "fanuc-31i-b") {
  MacroFile parsed(text);
  const stdlib::Control profile = controlOf(control);
  const auto file = frontend::macrob::lower(parsed.file, profile, parsed.sources, parsed.diagnostics);
  REQUIRE(file);
  std::map<std::uint32_t, verify::ProgramVariable> out;
  for (const verify::ProgramVariable& one : verify::variablesOf(*file, profile, {}))
    out.emplace(one.number, one);
  return out;
}

// A cycle of macros: an argument that may be missing, a common variable, two measures, a loop.
constexpr std::string_view kPlate = R"(%
O8100(PLATE)
IF[#24EQ#0]GOTO90
#10=#24/3
#101=#10+#602
G65P9832
G0X[#24]Y[#10]
G65P9810Z-5.F1000.
G65P9811Z-10.
#105=#137*2
G65P9833
IF[#101GT50]GOTO91
WHILE[#4LT5]DO1
#4=#4+1
#103=#103+#4
END1
G0Z50.
POPEN
DPRNT[X#24[33]]
PCLOS
M99
N90#3000=101(X IS MISSING)
N91#3000=102(TOO FAR)
%
)";

} // namespace

TEST_CASE("verify: a program draws what it reads before it has written it") {
  const auto found = variablesIn("O1\n#1=5\n#2=#1+#3\n#100=#3\n#101=#100+#102\nIF[#4EQ#0]GOTO5\n#6=1\n"
                                 "N5#7=#6\nG65P2A#500\nM30\nO2\n#9=#8+#102+#510\nM99\n");
  CHECK(!found.contains(1));
  CHECK(!found.contains(2));
  CHECK(found.contains(3));
  CHECK(!found.contains(100));
  CHECK(found.contains(102));
  CHECK(found.contains(4));
  CHECK(found.contains(6));  // one of the paths does not write it
  CHECK(!found.contains(8)); // of a program that is called: its arguments come from the caller
  CHECK(found.contains(500));
  CHECK(found.contains(510));
  CHECK(found.at(4).askedForNull);
  CHECK(!found.at(3).askedForNull);
}

TEST_CASE("verify: what a variable is drawn as follows from its use") {
  using verify::VariableUse;
  const auto found = variablesIn("O1\nG1X#1F#2\nG#3\n#[700+#4]=1\n#20=#[600+#5]\nIF[#6GT12.5]GOTO9\nGOTO#7\n"
                                 "N9M98P#8\n#21=#1000\nM30\n");
  CHECK(found.at(1).use == VariableUse::Length);
  CHECK(found.at(2).use == VariableUse::Feed);
  CHECK(found.at(3).use == VariableUse::System); // the codes that programs are given
  CHECK(found.at(4).use == VariableUse::Whole);
  CHECK(found.at(5).use == VariableUse::Whole);
  CHECK(found.at(7).use == VariableUse::Whole);
  CHECK(found.at(8).use == VariableUse::Whole);
  CHECK(found.at(1000).use == VariableUse::Signal);
  CHECK(found.at(6).constants == std::set<double>{12.5});
  // A computed number that is read stands for those after its constant.
  CHECK(found.contains(600));
  CHECK(found.contains(609));
  CHECK(!found.contains(610));
  CHECK(!found.contains(700));
}

TEST_CASE("verify: values are multiples of 0.001, near constants, and null where it is asked for") {
  verify::ProgramVariable variable;
  variable.number = 24;
  variable.askedForNull = true;
  variable.constants = {40};
  int nulls = 0, near = 0;
  verify::Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const auto value = verify::drawValue(variable, 0, random);
    if (!value) {
      ++nulls;
      continue;
    }
    CHECK(std::abs(*value * 1000 - std::round(*value * 1000)) < 1e-6);
    CHECK(std::abs(*value) <= 80);
    near += std::abs(*value - 40) <= 1.001 ? 1 : 0;
  }
  CHECK(nulls > 100);
  CHECK(near > 150);
  variable.askedForNull = false;
  variable.use = verify::VariableUse::System;
  for (int i = 0; i < 100; ++i) {
    const double system = verify::drawValue(variable, 0, random).value_or(0);
    CHECK(system >= 54);
    CHECK(system <= 59);
    CHECK(system == std::floor(system));
  }
}

TEST_CASE("verify: bare skip moves expect their surface at their end, and the part is towards them") {
  verify::Record rehearsal;
  verify::Measure down;
  down.start = {1, 2, 10};
  down.end = {1, 2, 4};
  verify::Measure side;
  side.start = {0, 0, 0};
  side.end = {5, 0, 0};
  verify::Measure call; // with no path of its own
  call.nominal = {{{3, 3, 3}, {0, 1, 0}}};
  rehearsal.measures = {down, side, call};
  const auto touches = verify::touchesOf(rehearsal, 2);
  REQUIRE(touches.size() == 3);
  CHECK(touches[0].point.z == 4);
  CHECK(touches[0].direction.z == -1);
  CHECK(touches[1].point.x == 7);
  CHECK(touches[1].point.z == 2);
  CHECK(touches[2].point.y == 3);
  verify::Random random(3);
  for (int i = 0; i < 50; ++i) {
    const verify::PartError error = verify::drawError(rehearsal, 2, random);
    CHECK(error.shift.z > 0); // the path leads down
    CHECK(error.shift.x < 0);
    CHECK(error.shift.z <= 0.3);
    CHECK(error.turn == 0);
  }
}

TEST_CASE("verify: a program agrees with its conversion") {
  const TestFolder folder("dotek-verify-programs");
  const std::string path = folder.write("plate.nc", std::string(kPlate));
  for (const char* from : {"fanuc-31i-b", "fanuc-0i-md"}) {
    for (const char* to : {"fanuc-31i-b", "fanuc-0i-md"}) {
      driver::VerifyOptions options = optionsFor(path, 100);
      options.fromControl = from;
      options.control = to;
      const driver::Outcome outcome = driver::verify(options);
      CHECK_MESSAGE(outcome.status == 0, codesOf(outcome));
      CHECK(outcome.output.starts_with("AGREES: 100 of 100 drawn cases"));
      options.jobs = 3;
      CHECK(driver::verify(options).output == outcome.output);
    }
  }
}

TEST_CASE("verify: planted differences of a program are found") {
  const TestFolder folder("dotek-verify-programs");
  const std::string path = folder.write("plate.nc", std::string(kPlate));
  driver::ConvertOptions convert;
  convert.inputs = {path};
  convert.to = "fanuc";
  const std::string text = driver::convert(convert).output;
  const std::pair<const char*, const char*> faults[] = {
      {"#24/3", "#24/4"},
      {"#24/3", "#24*3"},
      {"#10+#602", "#10-#602"},
      {"Y[#10]", "Y[#24]"},
      {"Z-5.", "Z-4."},
      {"P9811 Z-10.", "P9811 Z10."},
      {"#137*2", "#135*2"},
      {"G65 P9833\n", ""},
      {"G65 P9832\n", ""},
      {"#4+1", "#4+2"},
      {"#103+#4", "#103-#4"},
      {"G0 Z50.", "G0 Z5."},
      {"G0 Z50.", "Z50."},
      {"G0 Z50.", "G91 G0 Z50."},
      {"[33]", "[32]"},
      {"=101(", "=111("},
      {"TOO FAR", "TOO NEAR"},
      {"GOTO 90", "GOTO 91"},
      {"EQ #0", "NE #0"},
      {"LT 5]", "LE 5]"},
      {"M99", "#149=1\nM99"},
      {"M99", "G91\nM99"},
      {"M99", "G55\nM99"},
      {"#105=", "#106="},
      {"P9811 Z-10.", "P9810 Z-10."},
  };
  for (const auto& [before, after] : faults) {
    std::string edited = text;
    const std::size_t at = edited.find(before);
    REQUIRE_MESSAGE(at != std::string::npos, before);
    edited.replace(at, std::string_view(before).size(), after);
    driver::VerifyOptions options = optionsFor(path, 200);
    options.allowEdits = true; // the cases alone are to show it
    options.translation = folder.write("edited.nc", edited);
    const driver::Outcome outcome = driver::verify(options);
    CAPTURE(std::string(before) + " -> " + after);
    CHECK(codesOf(outcome).find("verify-differs") != std::string::npos);
    CHECK(outcome.status == 1);
  }
}

TEST_CASE("convert --verify writes nothing that does not agree") {
  const TestFolder folder("dotek-verify-programs");
  const std::string plate = folder.write("plate.nc", std::string(kPlate));
  const std::string good = folder.write("good.nc", "O8001\nG0X#1\nM30\n");
  const std::string digits =
      folder.write("digits.nc", "O8700\n#101=#1/3\n#102=#101*3\nIF[#102EQ#1]GOTO5\nG0X10.\nN5M30\n");
  const std::string missing = folder.write("missing.nc", "O8400\nG65P8401\nM30\n");
  const fs::path root = fs::path(plate).parent_path();
  const auto run = [&](std::vector<std::string> inputs, const std::string& out) {
    std::vector<std::string> arguments = {"convert"};
    arguments.insert(arguments.end(), inputs.begin(), inputs.end());
    for (const char* one : {"--to", "fanuc", "--from-control", "fanuc-31i-b", "--verify", "-d"})
      arguments.emplace_back(one);
    arguments.push_back((root / out).string());
    return runDotek(arguments, root);
  };
  CHECK(run({plate, good}, "a").status == 0);
  CHECK(fs::exists(root / "a" / "plate.nc"));
  CHECK(fs::exists(root / "a" / "good.nc"));
  const CommandResult differs = run({digits}, "b");
  CHECK(differs.status == 1);
  CHECK(differs.err.find("[verify-differs]") != std::string::npos);
  CHECK(differs.err.find("with the arithmetic of fanuc-0i-md the source does the same") != std::string::npos);
  CHECK(!fs::exists(root / "b"));
  // One of several is enough, and all are looked at.
  const CommandResult several = run({missing, good}, "c");
  CHECK(several.status == 1);
  CHECK(several.err.find("good.nc` is verified: AGREES") != std::string::npos);
  CHECK(several.err.find("missing.nc` is not verified: UNDECIDED: 200 of 200") != std::string::npos);
  CHECK(several.err.find("`--keep-going`") != std::string::npos);
  CHECK(!fs::exists(root / "c"));
}

TEST_CASE("verify: random programs agree with their conversion") {
  const TestFolder folder("dotek-verify-programs");
  const int programs = draws(120);
  int agreeing = 0;
  for (int seed = 1; seed <= programs; ++seed) {
    const std::string path = folder.write("random.nc", randomMacroB(static_cast<std::uint32_t>(seed), false));
    driver::VerifyOptions options = optionsFor(path, 10);
    options.common.limits.simSteps = 20000;
    options.fromControl = seed % 2 == 0 ? "fanuc-31i-b" : "fanuc-0i-md";
    options.control = seed % 3 == 0 ? "fanuc-31i-b" : "fanuc-0i-md";
    const driver::Outcome outcome = driver::verify(options);
    for (const Diagnostic& one : outcome.diagnostics.all()) {
      if (one.code != "verify-differs") continue;
      // Eight digits and fifteen may go different ways; nothing else may differ.
      CHECK_MESSAGE(one.message.find("with the arithmetic of") != std::string::npos,
                    seed << ": " << one.message);
    }
    agreeing += outcome.output.starts_with("AGREES: 10 of 10 drawn cases; edge");
  }
  CHECK(agreeing > programs / 6);
}

TEST_CASE("verify: prints, alarms and stores of a translated program count") {
  verify::Record source, target;
  verify::CompareRules rules;
  rules.sameProgram = true;
  target.stores[500] = 1;
  auto found = verify::compare(source, target, rules);
  REQUIRE(found.size() == 1);
  CHECK(found[0].text == "#500: the source does not write it, the translation leaves it at 1");
  source.stores[500] = 1.0000004;
  CHECK(verify::compare(source, target, rules).empty());
  source.stores[500] = 1e9;
  target.stores[500] = 1e9 + 100;
  rules.relative = 1e-6;
  CHECK(verify::compare(source, target, rules).empty());
  rules.relative = 0;
  CHECK(verify::compare(source, target, rules).size() == 1);
  target.stores = source.stores;
  target.printed = "A";
  found = verify::compare(source, target, rules);
  REQUIRE(found.size() == 1);
  CHECK(found[0].aspect == verify::Aspect::Printed);
  source.ending = target.ending = verify::Ending::Alarm;
  source.alarm = target.alarm = 3001;
  source.text = "THE BORE IS TOO SMALL";
  rules.shownText = 10;
  target.text = "THE BORE";                                       // as much as the control shows
  CHECK(verify::compare(source, target, rules).empty() == false); // the text that was printed
  target.printed = "";
  CHECK(verify::compare(source, target, rules).empty());
  rules.shownText = 11; // one more word
  CHECK(verify::compare(source, target, rules).size() == 1);
  rules.shownText = 10;
  target.text = "THE BOSS";
  CHECK(verify::compare(source, target, rules).size() == 1);
  target.text = source.text;
  target.alarm = 3002;
  CHECK(verify::compare(source, target, rules).size() == 1);
}

TEST_CASE("verify: codes in force at the end are compared by meaning where controls group them otherwise") {
  const TestFolder folder("dotek-verify-groups");
  const std::string text = "%\nO12\nG21G90G55\nG0X5.\nG18\nM30\n%\n";
  for (const auto& [from, to] : {std::pair("fanuc-6m", "fanuc-0i-md"), std::pair("fanuc-0i-md", "fanuc-6m"),
                                 std::pair("fanuc-6m", "fanuc-31i-b")}) {
    CAPTURE(from);
    CAPTURE(to);
    driver::VerifyOptions options = optionsFor(folder.write("source.nc", text), 4);
    options.fromControl = from;
    options.control = to;
    const driver::Outcome right = driver::verify(options);
    CHECK_MESSAGE(right.output.starts_with("AGREES"), (right.output + codesOf(right)));
    for (const auto& [one, other] : {std::pair("G18\n", "G19\n"), std::pair("G18\n", "")}) {
      std::string edited = text;
      edited.replace(edited.find(one), std::string(one).size(), other);
      options.allowEdits = true; // the cases alone are to show it
      options.translation = folder.write("edited.nc", edited);
      const driver::Outcome wrong = driver::verify(options);
      CHECK_MESSAGE(wrong.output.starts_with("DIFFERS: 4 of 4"), (wrong.output + codesOf(wrong)));
      CHECK(codesOf(wrong).find("modal state") != std::string::npos);
    }
  }
}

TEST_CASE(
    "verify: macros on G31 with protected moves and checks of their own agree, and faults in them show") {
  const TestFolder folder("dotek-verify-own-macros");
  for (const auto& [name, one, other] :
       {std::tuple("bore", "#101=[#1+#2]/2", "#101=[#1+#2]"),
        std::tuple("bore", "IF[ABS[#5063-#5083-#26] GT 0.01]THEN #28=1", "#28=0"),
        std::tuple("web", "ABS[#5063-#5083-#26] GT 0.01", "ABS[#5063-#5083-#26] GT 100."),
        std::tuple("angle", "G31 X[#30+#7] F2000", "G0 X[#30+#7]"),
        std::tuple("calibrate", "G31 X[#30-#29] F60.", "G31 X[#30-#29+1.] F60."),
        std::tuple("face-z", "G31 Z[#26-4.] F300.", "G31 Z[#26-3.] F300.")}) {
    CAPTURE(name);
    const std::string source = (root() / "examples/macros" / (std::string(name) + ".nc")).string();
    driver::VerifyOptions options = optionsFor(source, 40);
    options.common.assume.insert("probe-on");
    options.minAgreed = 80;
    const driver::Outcome right = driver::verify(options);
    CHECK_MESSAGE(right.output.starts_with("AGREES"), (right.output + codesOf(right)));
    std::ifstream file(source);
    std::string text((std::istreambuf_iterator<char>(file)), {});
    const std::size_t at = text.find(one);
    REQUIRE_MESSAGE(at != std::string::npos, one);
    text.replace(at, std::string(one).size(), other);
    options.allowEdits = true; // the cases alone are to show it
    options.translation = folder.write("edited.nc", text);
    const driver::Outcome wrong = driver::verify(options);
    CHECK_MESSAGE(wrong.output.starts_with("DIFFERS"), (wrong.output + codesOf(wrong)));
  }
}
