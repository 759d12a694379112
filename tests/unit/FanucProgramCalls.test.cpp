// Programs whose probing calls become those of another set: lines, blocks and results.
#include "backends/fanuc/Program.h"
#include "backends/fanuc/ProgramCalls.h"
#include "frontend/macrob/Lower.h"
#include "sim/vendor/VendorMacros.h"
#include "stdlib/DataFiles.h"
#include "tests/MeasuringCycles.h"
#include "tests/unit/ContactWorld.h"
#include "tests/unit/RunHarness.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace dotek;
using tests::MacroFile;
namespace fanuc = backends::fanuc;

namespace {

stdlib::MacroSet macros(std::string_view name) {
  return *stdlib::MacroSet::load(stdlib::DataFiles(), name);
}

// Inspection Plus with its results `shift` variables further on.
stdlib::MacroSet shifted(std::uint32_t shift) {
  stdlib::MacroSet out = macros("inspection-plus");
  out.name = "own";
  out.title = "Own";
  for (stdlib::MacroSignature& signature : out.signatures) {
    signature.program += 1000;
    for (stdlib::MacroResult& result : signature.results)
      result.variable += shift;
  }
  out.scratch = {{135 + shift, 149 + shift}};
  return out;
}

struct Translated {
  ir::ProgramFile file;
  std::string text;  // blocks of the programs; "" where it was refused
  std::string codes; // of what was reported, notes of the calls aside
};

Translated translate(const std::string& source, const std::vector<stdlib::MacroSet>& sets,
                     std::size_t wanted) {
  const auto control = *stdlib::Control::load(stdlib::DataFiles(), "fanuc-0i-md");
  MacroFile parsed("O1\n" + source);
  auto file = frontend::macrob::lower(parsed.file, control, parsed.sources, parsed.diagnostics);
  INFO(source << parsed.told());
  REQUIRE(file);
  Diagnostics found;
  Translated out;
  if (fanuc::translateCalls(*file, {sets[wanted], sets, control, {}}, found)) {
    const auto lines =
        fanuc::emitPrograms(*file, {control, control, {}, {}, false}, parsed.sources, parsed.diagnostics);
    REQUIRE(lines);
    for (std::size_t i = 2; i + 1 < lines->size(); ++i)
      out.text += (*lines)[i].text + "\n";
  }
  found.sort();
  for (const Diagnostic& one : found.all())
    if (one.code != "calls-translated" && one.code != "call-translated")
      out.codes += (out.codes.empty() ? "" : " ") + std::string(one.code);
  out.file = std::move(*file);
  return out;
}

Translated toOwn(const std::string& source) {
  return translate(source, {macros("inspection-plus"), shifted(40)}, 1);
}
Translated toEasy(const std::string& source) {
  return translate(source, {macros("easyprobe"), macros("inspection-plus")}, 0);
}

} // namespace

TEST_CASE("calls of another set: a result moves with its reads") {
  const Translated out = toOwn("G65P9811X20.\n#600=#135\nIF[#135GT20.]THEN#601=1\nDPRNT[#135[33]]\nM99\n");
  CHECK(out.text == "G65 P10811 X20.\n#600=#175\nIF[#175 GT 20.]THEN #601=1\nDPRNT[#175[33]]\nM99\n");
  CHECK(out.codes == "result-moved result-moved result-moved");
  // What the program stores itself stays where it is.
  CHECK(toOwn("G65P9811X20.\n#135=1\n#600=#135\nM99\n").text == "G65 P10811 X20.\n#135=1\n#600=#135\nM99\n");
}

TEST_CASE("calls of another set: a read that several may have set") {
  const std::string ways = "IF[#1EQ1]GOTO10\n{}GOTO20\nN10{}N20#600=#135\nM99\n";
  const auto read = [&](const char* one, const char* other) {
    return toOwn(fmt::format(fmt::runtime(ways), one, other)).codes;
  };
  CHECK(read("G65P9811X1.\n", "G65P9814D30.\n") == "result-moved");
  CHECK(read("G65P9811X1.\n", "#135=1\n") == "result-not-translated");
  CHECK(read("G65P9811X1.\n", "G65P9811Y1.\n") == "result-not-translated");
  CHECK(read("G65P9811X1.\n", "\n") == "result-not-translated");
  // The target's result is overwritten by the program before it is read.
  CHECK(toOwn("G65P9811X1.\n#175=1\n#600=#135\nM99\n").codes == "store-scratch result-not-translated");
  // The first time round nothing was measured; a block that may be passed over keeps what was there.
  CHECK(toOwn("WHILE[#1LT3]DO1\n#600=#135\nG65P9811X1.\nEND1\nM99\n").codes == "result-not-translated");
  CHECK(toOwn("G65P9811X1.\n/G65P9811Y1.\n#600=#135\nM99\n").codes == "result-not-translated");
  CHECK(toOwn("G65P9811X1.\n/G65P9811X2.\n#600=#135\nM99\n").codes == "result-moved");
}

TEST_CASE("calls of another set: programs of the file that are called between") {
  CHECK(toOwn("G65P9811X1.\nM98P2\n#600=#135\nM99\nO2\n#1=1\nM98P3\nM99\nO3\n#2=1\nM99\n").codes ==
        "result-moved");
  CHECK(toOwn("G65P9811X1.\nM98P2\n#600=#135\nM99\nO2\n#1=1\nM98P3\nM99\nO3\n#135=1\nM99\n").codes ==
        "result-not-translated");
  // Programs that call one another, of which one measures.
  CHECK(toOwn("G65P9811X1.\nM98P3\n#600=#135\nM99\nO2\nM98P3\nG65P9810Z5.\nM99\nO3\nM98P2\nM99\n").codes ==
        "result-not-translated");
}

TEST_CASE("calls of another set: what is put before a call has lines of its own, after the block's label") {
  const Translated out =
      toEasy("#1=1\nN10(A)G90G65P9811X#24S1(B)\nN20G65P9811Z5.S1\n/N30G65P9832\nGOTO10\nM99\n");
  CHECK(out.codes.empty());
  CHECK(out.text == "#1=1\nN10(A) G90(B)\nG53\nIF[#24 EQ #0]THEN #3000=150(X IS MISSING)\n"
                    "G65 P9023 S54. X[[#24-#5041]*[1+10/ABS[#24-#5041]]] I#24\nN20 G53\nG65 P9023 S54. "
                    "Z[[5.-[#5043-#5083]]*[1+10/ABS[5.-[#5043-#5083]]]] K5.\n"
                    "/N30 M31\nGOTO 10\nM99\n");
  std::uint32_t last = 0;
  for (const ir::ProgramStatement& statement : out.file.programs[0].body) {
    CHECK(statement.origin.block >= last);
    CHECK(statement.origin.block <= last + 1);
    last = statement.origin.block;
  }
  // The result read again is itself.
  MacroFile again("O1\n" + out.text);
  const auto control = *stdlib::Control::load(stdlib::DataFiles(), "fanuc-0i-md");
  const auto file = frontend::macrob::lower(again.file, control, again.sources, again.diagnostics);
  REQUIRE(file);
  const auto lines =
      fanuc::emitPrograms(*file, {control, control, {}, {}, false}, again.sources, again.diagnostics);
  REQUIRE(lines);
  std::string text;
  for (std::size_t i = 2; i + 1 < lines->size(); ++i)
    text += (*lines)[i].text + "\n";
  CHECK(text == out.text);
}

TEST_CASE("calls of another set: the alarm of the checks is one that the file does not raise") {
  std::string raises;
  for (int n = 150; n <= 200; ++n)
    raises += fmt::format("#3000={}\n", n);
  CHECK(toEasy("G65P9811X#24S1\n" + raises + "M99\n").text.find("THEN #3000=149(") != std::string::npos);
}

TEST_CASE("calls of another set: calls that two sets know belong to none") {
  stdlib::MacroSet twin = macros("inspection-plus");
  twin.name = "twin";
  CHECK(translate("G65P9811X1.S1\nM99\n", {macros("easyprobe"), macros("inspection-plus"), twin}, 0).codes ==
        "calls-of-several-sets");
  // The one that is wanted is taken.
  CHECK(translate("G65P9811X1.S1\nM99\n", {macros("easyprobe"), macros("inspection-plus"), twin}, 2)
            .codes.empty());
}

TEST_CASE("calls of another set: both programs set the same offset on the same part") {
  const std::string source = "G90G54G0X2.Y1.Z-1.\n#1=20.\n#2=3\nG65P9811X#1S#2\nG65P9811Z-9.S4\nM30\n";
  const auto run = [](const std::string& text, const char* set) {
    const stdlib::Control control = *stdlib::Control::load(stdlib::DataFiles(), "fanuc-0i-md");
    const stdlib::MacroSet known = macros(set);
    sim::VendorMacros meaning(known, control, tests::measuringCycles());
    meaning.setStylusRadius(3);
    tests::ContactWorld world(3);
    world.wall(20.3, 0, 180);
    world.halfSpace({0, 0, -8.75}, {0, 0, 1});
    const tests::MacroRun done("O1\n" + text, control, &world, &meaning);
    return fmt::format("{} {:.3f} {:.3f}", done.end(), done.machine->read(5261).value_or(-1),
                       done.machine->read(5283).value_or(-1));
  };
  const std::string expected = run(source, "inspection-plus");
  CHECK(expected == "end 0.300 0.250");
  const std::vector<stdlib::MacroSet> sets = {macros("dotek"), macros("easyprobe"),
                                              macros("inspection-plus")};
  for (std::size_t wanted = 0; wanted < 2; ++wanted) {
    const Translated out = translate(source, sets, wanted);
    CAPTURE(out.text);
    CHECK(out.text.find("P98") == std::string::npos);
    CHECK(run(out.text, sets[wanted].name.c_str()) == expected);
  }
}
