// What `verify` sees beside the cases as they are drawn: a system in force that is set, touches that find
// nothing, values that the dialog alone rejects.
#include "driver/Driver.h"
#include "support/Worker.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"
#include "tests/policy/Tree.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

struct Shop {
  const char *shop, *cycle, *to, *set;
};

void take(targets::TranslationOptions& options, const Shop& of) {
  const auto shops = root() / "tests" / "shops";
  options.inputs = {(shops / of.shop / of.cycle).generic_string()};
  options.source.prog = (shops / of.shop / "post.txt").generic_string();
  options.common.data = {(shops / "data").generic_string()};
  options.common.scriptProgram = runningProgram();
  options.to = of.to;
  options.probeMacros = of.set;
}

std::string converted(const Shop& of) {
  driver::ConvertOptions options;
  take(options, of);
  const driver::Outcome outcome = driver::convert(options);
  REQUIRE_MESSAGE(outcome.status == 0, renderText(outcome.diagnostics, outcome.sources, 0));
  return outcome.files.front().text;
}

// `said`: takes what it reports; nullptr: nobody reads it.
int verified(const Shop& of, const std::string& text, std::uint64_t cases = 40, std::string* said = nullptr) {
  const TestFolder folder("dotek-shop-frame");
  driver::VerifyOptions options;
  take(options, of);
  options.cases = cases;
  options.jobs = 1;
  options.allowEdits = true; // the cases alone are to show it
  options.translation = folder.write("edited", text);
  const driver::Outcome outcome = driver::verify(options);
  if (said != nullptr) *said = renderText(outcome.diagnostics, outcome.sources, 0);
  return outcome.status;
}

std::string without(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.rfind(from);
  REQUIRE_MESSAGE(at != std::string::npos, from << " is not in\n" << text);
  return text.replace(at, from.size(), to);
}

} // namespace

TEST_CASE("convert: a work offset that the dialog computes is checked before the branch loads its tool") {
  for (const char* cycle : {"AL.Bossage.Trois", "AL.Epaisseur.Y"}) {
    const std::string text = converted({"origins", cycle, "fanuc", "inspection-plus"});
    const std::size_t last = text.rfind("(NO SUCH WORK OFFSET)");
    REQUIRE(last != std::string::npos);
    CHECK(last < text.find("T30 M6"));
    CHECK(verified({"origins", cycle, "fanuc", "inspection-plus"}, text) == 0);
    // The branch leaves no tool length, as it does on the source's control.
    CHECK(text.find("G49") != std::string::npos);
  }
}

TEST_CASE("verify: the path may end its touch anywhere on a G31 that goes on far beyond it") {
  for (const char* cycle : {"KR.Mittel.Z", "KR.Dicke.Y", "KR.Ecke.Innen"}) {
    CAPTURE(cycle);
    const Shop shop{"repeats", cycle, "fanuc", "inspection-plus"};
    CHECK(verified(shop, converted(shop)) == 0);
  }
}

TEST_CASE("verify: the retract after a measure that sets the system in force") {
  const Shop corner{"inspection", "JT.Vice.Corner", "fanuc", "dotek"};
  const std::string text = converted(corner);
  CHECK(verified(corner, text) == 0);
  CHECK(verified(corner, without(text, "G65 P8810 Z#13\n", "")) == 1);
}

TEST_CASE("verify: each touch that finds nothing ends with the alarm of the source") {
  const Shop top{"direct", "DP.Top.Zero", "fusion", "dotek"};
  const std::string text = converted(top);
  CHECK(verified(top, text) == 0);
  CHECK(verified(top, without(text, "writeBlock(\"IF[#541LE[", "writeln(\"(\" + \"")) == 1);
}

TEST_CASE("verify: what is measured turns a check just where it turns in the source") {
  // A part of another thickness, or a surface a step from the end of the search, on either side.
  for (const char* to : someOf<const char*>({"fanuc", "fusion"})) {
    const Shop thick{"repeats", "KR.Dicke.Y", to, "inspection-plus"};
    const bool fusion = std::string_view(to) == "fusion";
    const std::string text = converted(thick);
    CAPTURE(text);
    CHECK(verified(thick, text) == 0);
    CHECK(verified(thick,
                   without(text, fusion ? "]LE\" + TOL" : "] GT #", fusion ? "]LT\" + TOL" : "] GE #")) == 1);
    const std::size_t at = text.rfind('\n', text.find("DICKE PRUEFEN"));
    REQUIRE(at != std::string::npos);
    CHECK(verified(thick, std::string(text).erase(at, text.find('\n', at + 1) - at)) == 1);
  }
  const Shop bore{"direct", "DP.Bore.Zero", "fanuc", "dotek"};
  const std::string text = converted(bore);
  CHECK(verified(bore, text) == 0);
  for (const auto& [from, to] :
       {std::pair("[#544 LE #", "[#544 LT #"), std::pair("[#541 GE #", "[#541 GT #")})
    CHECK(verified(bore, without(text, from, to)) == 1);
}

TEST_CASE("verify: a stop that is cut, and macros that refuse a mode of the post, are no difference") {
  for (const Shop& shop : {Shop{"direct", "DP.Side.Zero", "fanuc", "inspection-plus"},
                           Shop{"easyprobe", "Brandl.Hoehe.Z", "fusion", "dotek"},
                           Shop{"toolchange", "MX.Arc.Centre", "fusion", "dotek"}}) {
    CAPTURE(shop.cycle);
    CHECK(verified(shop, converted(shop), 12) == 0);
  }
}

TEST_CASE(
    "verify: a fragment runs under any modes of the post around it, and leaves the probe as the source") {
  const Shop bore{"direct", "DP.Bore.Zero", "fusion", "inspection-plus"};
  const std::string text = converted(bore);
  CHECK(verified(bore, text, 12) == 0);
  CHECK(verified(bore, without(text, "  writeBlock(\"G90 G94\");\n", ""), 12) == 1);
  const Shop thick{"repeats", "KR.Dicke.Y", "fusion", "inspection-plus"};
  const std::string other = converted(thick);
  CHECK(verified(thick, other, 12) == 0);
  const std::size_t alarm = other.find("  writeBlock(\"#3000=120");
  const std::size_t off = other.rfind("  writeBlock(\"M32\");\n", alarm);
  REQUIRE(off != std::string::npos);
  CHECK(verified(thick, std::string(other).erase(off, 21), 12) == 1);
  // A plane of retract that fits no word.
  CHECK(verified(thick, without(other, "if (clearanceText === null) {", "if (false) {"), 12) == 1);
}

TEST_CASE("verify: a check of a fragment that only another error hides") {
  const Shop face{"easyprobe", "Brandl.Flaeche.X", "fusion", "dotek"};
  const std::string text = converted(face);
  CHECK(verified(face, without(text, "if (RUECKZUG < (TIEFE + 5)) {", "if (false) {")) == 1);
}

TEST_CASE("verify: the alarm of another check is not that of the dialog") {
  const Shop slot{"flags", "NK.Rowek.X", "fanuc", "dotek"};
  const std::string text = converted(slot);
  const std::size_t at = text.find("IF[#28 EQ 2.]THEN #3000=101");
  REQUIRE(at != std::string::npos);
  std::string said;
  CHECK(verified(slot, std::string(text).erase(at, text.find('\n', at) + 1 - at), 600, &said) == 1);
  // The message of the dialog stands in no other quotation.
  CAPTURE(said);
  CHECK(said.find("`the dialog of") == std::string::npos);
  CHECK(said.find("; the program stops with `") != std::string::npos);
}
