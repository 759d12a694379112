// Where cycles of tests/shops stop: with which text, after what, and where they try again.
#include "tests/Draws.h"
#include "tests/unit/ShopRuns.h"

#include <algorithm>

namespace dotek::tests {

namespace {

bool differs(const Shop& of, const std::string& text) {
  return verified(of, text).find("\nDIFFERS") != std::string::npos;
}

} // namespace

TEST_CASE("verify: an alarm of the branch keeps its text with the macros of another set") {
  const Shop skewed{"classes", "SG.Vinkel.Bas", "matcykel", "fanuc", "dotek", "fanuc-0i-md"};
  const std::string good = converted(skewed);
  CHECK_MESSAGE(agrees(verified(skewed)), verified(skewed));
  CHECK(differs(skewed, replaced(good, "\n#3000=105(DETALJ SNED I SKRUVSTYCKE)",
                                 "\n#3000=101(AVSTAND 10 TILL 300 MM)")));
  const Shop heights{"chained", "TM.Ecart.Deux", "palpage", "fusion", "dotek", "fanuc-0i-md"};
  const std::string fragment = converted(heights);
  CHECK_MESSAGE(agrees(verified(heights)), verified(heights));
  CHECK(differs(heights, replaced(fragment, "(PIECE MAL POSEE)", "(PIECE BIEN POSEE)")));
}

TEST_CASE("verify: coordinates that the cycle leaves turned are turned alike") {
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b"}) {
    const Shop edge{"zones", "HF.Kante.Drehen", "taster", "fanuc", "inspection-plus", control};
    const std::string good = converted(edge);
    CHECK_MESSAGE(agrees(verified(edge)), verified(edge));
    const std::size_t at = good.find("\nG68 ");
    REQUIRE(at != std::string::npos);
    const std::string line = good.substr(at, good.find('\n', at + 1) - at);
    const std::string angle = line.substr(line.find(" R") + 2);
    CHECK(differs(edge, replaced(good, line, "")));
    CHECK(differs(edge, replaced(good, line, "\nG69")));
    CHECK(differs(edge, replaced(good, line, replaced(line, " R" + angle, " R-" + angle))));
    CHECK(differs(edge, replaced(good, line, replaced(line, " X#", " Y#"))));
    CHECK(differs(edge, replaced(good, line, line + "\nG69")));
  }
}

TEST_CASE("verify: the offset of the fourth axis is compared") {
  const Shop table{"szabo", "SZ.Asztal.Szog", "meres", "fanuc", "inspection-plus", "fanuc-0i-md"};
  const std::string good = converted(table);
  CHECK_MESSAGE(agrees(verified(table)), verified(table));
  CHECK(differs(table, replaced(good, "]+#537", "]-#537")));
  const std::size_t at = good.find("\n#[5204");
  REQUIRE(at != std::string::npos);
  CHECK(differs(table, replaced(good, good.substr(at, good.find('\n', at + 1) - at), "")));
}

TEST_CASE("verify: work offsets beyond G59 keep the numbers of the source in the argument") {
  for (const char* control : someOf<const char*>({"haas-ngc", "fanuc-31i-b"})) {
    const Shop slot{"vandoorn", "VD_SLEUF_G154", "meten", "fanuc", "inspection-plus", control};
    CHECK_MESSAGE(agrees(verified(slot)), verified(slot));
  }
  const Shop bore{"szabo", "SZ.Furat.Osztaly", "meres", "fanuc", "inspection-plus", "haas-ngc"};
  CHECK_MESSAGE(agrees(verified(bore)), verified(bore));
  const std::string good = converted(bore);
  CHECK_MESSAGE(good.find("154.01") != std::string::npos, good);
  CHECK(differs(bore, replaced(good, "154.01", "154.02")));
}

TEST_CASE("verify: work offsets beyond G59 are set with Dotek's own macros, by the program where a limit "
          "comes first") {
  for (const char* control : {"haas-ngc", "fanuc-0i-md"}) {
    const Shop slot{"vandoorn", "VD_SLEUF_G154", "meten", "fanuc", "dotek", control};
    const std::string good = converted(slot);
    CHECK_MESSAGE(good.find("\n#[7002+20*ROUND[[#28-154.01]*100]]=") != std::string::npos, good);
    CHECK_MESSAGE(agrees(verified(slot)), verified(slot));
    CHECK(differs(slot, replaced(good, "#[7002+", "#[7022+")));
  }
  const Shop printed{"vandoorn", "VD_SLEUF_G154", "meten", "fusion", "dotek", "haas-ngc"};
  const std::string fragment = converted(printed);
  CHECK_MESSAGE(agrees(verified(printed)), verified(printed));
  CHECK(differs(printed, replaced(fragment, "7002 +", "7022 +")));
}

TEST_CASE(
    "verify: Dotek's own macros with their settings elsewhere leave the variables of the branch alone") {
  const auto coded = [](const Shop& of, std::string_view code) {
    driver::ConvertOptions options;
    take(of, options);
    const driver::Outcome outcome = driver::convert(options);
    std::string text;
    for (const Diagnostic& one : outcome.diagnostics.all())
      if (one.code == code) text += one.message + "\n";
    return text;
  };
  Shop wall{"moreira", "MR.Parede.Incl", "medir", "fanuc", "dotek", "fanuc-0i-md"};
  CHECK(coded(wall, "store-calibration").find("`--probe-macros dotek@900`") != std::string::npos);
  wall.macros = "dotek@900";
  const std::string good = converted(wall);
  CHECK(good.find("(SET BEFORE THE FIRST CALL: #900 RADIUS") != std::string::npos);
  CHECK_MESSAGE(agrees(verified(wall)), verified(wall));
  wall.to = "fusion";
  wall.control = "fanuc-31i-b";
  CHECK_MESSAGE(agrees(verified(wall)), verified(wall));
  wall.to = "fanuc";
  wall.control = "haas-ngc";
  wall.macros = "dotek@760"; // no variables of a Haas
  CHECK(coded(wall, "macro-variables-lost").find("#760 to #763") != std::string::npos);
}

TEST_CASE("verify: a Haas dwells by P, and another control has no G103") {
  const Shop here{"vandoorn", "VD_HOEK_BUITEN", "meten", "fanuc", "inspection-plus", "haas-ngc"};
  const std::string own = converted(here);
  CHECK_MESSAGE(own.find("G4 P1\n") != std::string::npos, own);
  CHECK_MESSAGE(agrees(verified(here)), verified(here));
  const Shop there{"vandoorn", "VD_HOEK_BUITEN", "meten", "fanuc", "inspection-plus", "fanuc-31i-b"};
  const std::string other = converted(there);
  CHECK_MESSAGE(other.find("G103") == std::string::npos, other);
  driver::ConvertOptions options;
  take(there, options);
  const driver::Outcome outcome = driver::convert(options);
  CHECK(std::any_of(outcome.diagnostics.all().begin(), outcome.diagnostics.all().end(),
                    [](const Diagnostic& one) { return one.code == "read-ahead-left-out"; }));
  CHECK_MESSAGE(agrees(verified(there)), verified(there));
}

TEST_CASE("verify: the offset before and after, signed deviations, a contact asked for late") {
  for (const Shop& shop :
       {Shop{"irunza", "TI.Cara.Lado", "palpador", "fanuc", "dotek", "fanuc-0i-md"},
        Shop{"szabo", "SZ.Furat.Osztaly", "meres", "fanuc", "inspection-plus", "fanuc-31i-b"},
        Shop{"nordlund", "ND.Top.Gentag", "taster", "fanuc", "dotek", "fanuc-0i-md"},
        Shop{"nordlund", "ND.Emne.Findes", "taster", "fanuc", "inspection-plus", "fanuc-31i-b"}}) {
    const std::string said = verified(shop);
    CHECK_MESSAGE(("\n" + said).find("\nAGREES") != std::string::npos, said);
  }
}

TEST_CASE("verify: a bore that is measured until it repeats meets the end of its loop") {
  for (const char* macros : someOf<const char*>({"inspection-plus", "dotek"})) {
    const Shop hole{"retries", "LS-HOLE-RETRY", "probeIt", "fanuc", macros, "fanuc-31i-b"};
    const std::string good = converted(hole), said = verified(hole);
    CHECK_MESSAGE(("\n" + said).find("\nAGREES") != std::string::npos, said); // one may be undecided
    for (const auto& [from, to] : someOf(std::vector<std::pair<std::string, std::string>>{
             {"GE 3.]GOTO", "GE 2.]GOTO"},                               // once less
             {"IF[ABS[#612-#611] LE", "IF[[#612-#611] LE"},              // each smaller one repeats
             {"GOTO 10\n", "GOTO 30\n"},                                 // what does not repeat is taken
             {"\n#3000=103(HOLE DOES NOT REPEAT)", "\n(#3000=103)"}})) { // and so it is
      CAPTURE(from);
      CHECK(differs(hole, replaced(good, from, to)));
    }
  }
}

TEST_CASE("verify: an alarm of the dialog that is cut though the control shows all of it is another one") {
  const Shop corner{"bounded", "LK-TWO-FACE", "probes", "fanuc", "dotek", "fanuc-31i-b"};
  const std::string good = converted(corner);
  CHECK_MESSAGE(agrees(verified(corner)), verified(corner));
  CHECK(differs(corner, replaced(good, "(ALONG 2 MM OR MORE)\n", "(ALONG 2 MM)\n")));
}

TEST_CASE("verify: a height that the operator reads before it sets the offset") {
  const Shop step{"classes", "SG.Steg.Hojd", "matcykel", "fanuc", "inspection-plus", "fanuc-31i-b"};
  const std::string good = converted(step);
  CHECK_MESSAGE(agrees(verified(step)), verified(step));
  const std::size_t at = good.find("IF[ABS[#628");
  REQUIRE(at != std::string::npos);
  const std::string line = good.substr(at, good.find('\n', at) + 1 - at);
  const std::string later = replaced(good, line, "");
  const std::size_t next = later.find("#5223=");
  REQUIRE(next != std::string::npos);
  const std::string set = later.substr(next, later.find('\n', next) + 1 - next);
  CHECK(differs(step, replaced(later, set, set + line)));
}

TEST_CASE("verify: a protected move that asks whether a part is there") {
  for (const char* macros : {"inspection-plus", "dotek"}) {
    const Shop part{"retries", "LS-PART-CHECK", "probeIt", "fanuc", macros, "fanuc-31i-b"};
    const std::string good = converted(part);
    CHECK_MESSAGE(agrees(verified(part)), verified(part));
    for (const auto& [from, to] : someOf(std::vector<std::pair<std::string, std::string>>{
             {"[#148 EQ 7.]", "[#148 NE 7.]"}, // an alarm with a part
             {"\n#3000=101(NO PART IN VISE)", "\n#3000=100(ALLOW LOW IS 0.5 TO 8 MM)"}, // another alarm
             {"Z#28 F500. M1", "Z#28 F500."}})) {                                       // no question
      CAPTURE(from);
      CHECK(differs(part, replaced(good, from, to)));
    }
  }
}

TEST_CASE("verify: a size that is computed with the shop's variable of the ball meets its limits") {
  for (const char* macros : {"", "dotek"}) {
    const Shop bore{"loops", "WT.Otwor", "sondaRen", "fanuc", macros, "fanuc-31i-b"};
    const std::string good = converted(bore);
    CHECK_MESSAGE(agrees(verified(bore)), verified(bore));
    CHECK(differs(bore, replaced(good, "+2.*#700", "-2.*#700")));
  }
}

TEST_CASE("verify: the header of a translation says what its arguments are") {
  const Shop part{"retries", "LS-PART-CHECK", "probeIt", "fanuc", "inspection-plus", "fanuc-31i-b"};
  const std::string good = converted(part);
  for (const auto& [from, to] : someOf(std::vector<std::pair<std::string, std::string>>{
           {"GIVE    0.5 TO 8", "3       0.5 TO 8"},       // a default that it has not
           {"0.5 TO 8 ALLOW", "0.5 TO 9 ALLOW"},           // another range
           {"A #1  ZNOM      MM ", "A #1  ZNOM      DEG"}, // another unit
           {"TOP Z, WHERE THE STOCK TOP)\n(                                      SHOULD BE)",
            "ALLOW LOW, LOWER THAN THIS: NO)\n(                                      PART)"}, // of another
                                                                                              // one
           {"(CALL: G65 P8000 A0. B3. ", "(CALL: G65 P8000 A0. "}, // a call that it refuses
           {"\nO8000", "\nO8001"},                                 // another program than the call names
           {"A #1  ZNOM", "A #2  ZNOM"},
           {"(ALARM 101 ", "(ALARM 121 "},
           {", TOOL LENGTH ACTIVE", ""},
           {", NO MIRROR)\n(IMAGE", ")\n("},
           {"(MOVE THE PROBE: X Y ", "(MOVE THE PROBE: X "}})) {
    CAPTURE(from);
    CHECK(differs(part, replaced(good, from, to)));
  }
  const std::string reworded = replaced(good, "TOP Z, WHERE THE STOCK TOP", "TOP OF THE STOCK, WHERE IT");
  CHECK(agrees(verified(part, reworded)));
}

TEST_CASE("Fusion: a branch that compares what the macros of another set leave elsewhere") {
  const Shop webs{"results", "WF-WEB-PAIR", "probing", "fusion", "dotek", "fanuc-31i-b"};
  const std::string good = converted(webs);
  CHECK(good.find("\"IF[ABS[[#138-[\" + WXText + \"]]]GT\"") != std::string::npos);
  CHECK_MESSAGE(agrees(verified(webs)), verified(webs));
  CHECK(differs(webs, replaced(good, "[#138-[\" + WXText", "[#138-[\" + WYText")));
}

TEST_CASE("Fusion: a title with the words of another field") {
  const Shop step{"classes", "SG.Steg.Hojd", "matcykel", "fusion", "inspection-plus", "fanuc-31i-b"};
  const std::string good = converted(step);
  CHECK_MESSAGE(agrees(verified(step)), verified(step));
  CHECK(differs(step, replaced(good, "\"Tolerans, pa steget\"", "\"Steghojd, pa ritning\"")));
  CHECK(agrees(verified(step, replaced(good, "\"Tolerans, pa steget\"", "\"Tolerans for steget\""))));
}

TEST_CASE("convert: the tool length that a call of another set corrects") {
  const Shop length{"series", "KS.Delka.Nastroje", "sonda", "fanuc", "dotek", "fanuc-31i-b"};
  const std::string good = converted(length);
  CHECK_MESSAGE(agrees(verified(length)), verified(length));
  for (const auto& [from, to] : someOf(std::vector<std::pair<std::string, std::string>>{
           {"]-#15*#16", "]+#15*#16"},                         // the wrong way
           {"#[2200+#20]=", "#[2000+#20]="},                   // the wear
           {"IF[ABS[#16] LT #22]", "IF[ABS[#16] GT #22]"}})) { // within the band
    CAPTURE(from);
    CHECK(differs(length, replaced(good, from, to)));
  }
}

TEST_CASE("convert: results and calibration of a Haas's own macros") {
  Shop sizes{"retries", "LS-WEB-Y", "probeIt", "fanuc", "inspection-plus", "fanuc-31i-b"};
  CHECK(converted(sizes).find("#615=#138\n") != std::string::npos); // of a branch for a Haas
  CHECK_MESSAGE(agrees(verified(sizes)), verified(sizes));
  const Shop block{"inspection", "JT.Edge.Angle", "probeOps", "fanuc", "inspection-plus", "haas-ngc"};
  CHECK_MESSAGE(agrees(verified(block)), verified(block));
  CHECK(converted(block).find("=#13") == std::string::npos);
}

TEST_CASE("verify: the check of a local shift along the axis whose offset a fragment writes") {
  const Shop side{"zones", "HF.Flaeche.Y", "taster", "fusion", "dotek", "fanuc-0i-md"};
  const std::string good = converted(side);
  CHECK_MESSAGE(agrees(verified(side)), verified(side));
  const std::size_t at = good.find("  writeBlock(\"IF[ABS[#5022-#5042");
  REQUIRE(at != std::string::npos);
  const std::string line = good.substr(at, good.find('\n', at) + 1 - at);
  CHECK(differs(side, replaced(good, line, "")));
}

TEST_CASE("verify: the group of a Fusion property is one that is defined") {
  const Shop side{"zones", "HF.Flaeche.Y", "taster", "fusion", "dotek", "fanuc-0i-md"};
  const std::string good = converted(side);
  CHECK(differs(side, replaced(good, "\n  group: \"hfFlaecheY\"", "\n  group: \"hfflaecheY\"")));
  CHECK(agrees(verified(side, replaced(good, "\n  group: \"hfFlaecheY\"", "\n  group: \"probing\""))));
}

} // namespace dotek::tests
