// Cycles of tests/shops where a macro of a vendor stops, is not known, or is written as several calls.
#include "tests/Draws.h"
#include "tests/unit/ShopRuns.h"

namespace dotek::tests {

namespace {

const Shop kSlot{"inspection", "JT.Slot.Datum", "probeOps", "fanuc", "dotek", "fanuc-31i-b"};

} // namespace

TEST_CASE("verify: a limit of the vendor's call and the translation's own comparison") {
  const std::string said = verified(kSlot);
  CHECK_MESSAGE(agrees(said), said);
  // Where the source stops, others were drawn, and it is said.
  CHECK(said.find("[verify-replaced]") != std::string::npos);
  CHECK(said.find("alarm: OUT OF POSITION") != std::string::npos);
  const std::string good = converted(kSlot);
  for (const auto& [from, to] : someOf(std::vector<std::pair<std::string, std::string>>{
           {"(OUT OF POSITION)", "(OUT OF TOLERANCE)"}, // another limit
           {"IF[2.*ABS[#136", "IF[ABS[#136"},           // half of it
           {"GT ABS[#13]]THEN", "GT 0]THEN"},           // always
           {"IF[2.*ABS[#136", "IF[0*ABS[#136"}}))       // never
    CHECK_MESSAGE(verified(kSlot, replaced(good, from, to)).find("\nDIFFERS") != std::string::npos,
                  from << " to " << to);
}

TEST_CASE("verify: an angle's touches lie on steps of the control") {
  const std::string said =
      verified({"inspection", "JT.Edge.Angle", "probeOps", "fanuc", "dotek", "fanuc-31i-b"});
  CHECK_MESSAGE(agrees(said), said);
}

TEST_CASE("verify: a bore by three touches at angles, with our own macro") {
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b"}) {
    const Shop arc{"toolchange", "MX.Arc.Centre", "measure", "fanuc", "dotek", control};
    const std::string said = verified(arc);
    CHECK_MESSAGE(agrees(said), said);
    const std::string good = converted(arc);
    const std::size_t at = good.find("G65 P8823");
    REQUIRE(at != std::string::npos);
    const std::string line = good.substr(at, good.find('\n', at) - at);
    for (const auto& [from, to] : someOf(std::vector<std::pair<std::string, std::string>>{
             {"A#", "A-#"}, {" S#", " S1+#"}, {"P8823", "P8814"}, {line, "(" + line + ")"}})) {
      const std::string wrong = replaced(line, from, to);
      CHECK_MESSAGE(!agrees(verified(arc, replaced(good, line, wrong))), wrong);
    }
  }
}

TEST_CASE("verify: a corner as two calls of single surfaces") {
  const Shop corner{"inspection", "JT.Vice.Corner", "probeOps", "fanuc", "easyprobe", "fanuc-31i-b"};
  const std::string said = verified(corner);
  CHECK_MESSAGE(agrees(said), said);
  const std::string good = converted(corner);
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"J#25", "J#24"},                 // another nominal
                                                        {"X[[#24-#28]*", "X[[#28-#24]*"}, // the other way
                                                        {"G65 P9023 S[#19+53.] Y", "G65 P9023 S[#19+54.] Y"}})
    CHECK_MESSAGE(verified(corner, replaced(good, from, to)).find("\nDIFFERS") != std::string::npos,
                  from << " to " << to);
}

TEST_CASE("verify: calls that no source states, made alike") {
  for (const Shop& one :
       {Shop{"inspection", "JT.Pitch.Report", "probeOps", "fanuc", "inspection-plus", "fanuc-31i-b"},
        Shop{"toolchange", "MX.Outside.Corner", "measure", "fanuc", "inspection-plus", "fanuc-0i-md"}}) {
    const std::string said = verified(one);
    CHECK_MESSAGE(agrees(said), said);
    CHECK_MESSAGE(said.find("[verify-unstated]") != std::string::npos, said);
  }
  const Shop corner{"toolchange", "MX.Outside.Corner", "measure", "fanuc", "inspection-plus", "fanuc-0i-md"};
  const std::string good = converted(corner);
  const std::size_t call = good.find("G65 P9816");
  REQUIRE(call != std::string::npos);
  const std::string line = good.substr(call, good.find('\n', call) - call);
  CHECK(verified(corner, replaced(good, line, line + " Q3.")).find("\nDIFFERS") != std::string::npos);
  CHECK(verified(corner, replaced(good, line, line.substr(0, line.rfind(' ')))).find("\nDIFFERS") !=
        std::string::npos);
  CHECK(verified(corner, replaced(good, line, "(" + line + ")")).find("\nDIFFERS") != std::string::npos);
}

TEST_CASE("verify: holes one after the other, above whose plate the probe travels") {
  Shop row{"series", "KS.Otvory.Rada", "sonda", "fanuc", "inspection-plus", "fanuc-31i-b"};
  row.cases = 60;
  const std::string said = verified(row);
  CHECK_MESSAGE(said.find("\nAGREES: 60 of 60 drawn cases") != std::string::npos, said);
}

TEST_CASE("verify: a zone of position in a loop, where the place is read from the control") {
  for (const char* control : someOf<const char*>({"fanuc-0i-md", "fanuc-31i-b"})) {
    const Shop spigot{"zones", "HF.Zapfen.Lage", "taster", "fanuc", "dotek", control};
    const std::string good = converted(spigot);
    CHECK_MESSAGE(agrees(verified(spigot)), verified(spigot));
    for (const auto& [from, to] : someOf(std::vector<std::pair<std::string, std::string>>{
             {"=#5041\n", "=#5042\n"}, {"=#5042\n", "=0.\n"}, {"2.*SQRT[", "SQRT["}}))
      CHECK_MESSAGE(verified(spigot, replaced(good, from, to)).find("\nDIFFERS") != std::string::npos,
                    from << " to " << to);
  }
}

TEST_CASE("verify: a fragment writes the offset of what its macro sets none for") {
  const Shop slot{"series", "KS.Drazka.Sikma", "sonda", "fusion", "dotek", "fanuc-31i-b"};
  const std::string good = converted(slot);
  CHECK_MESSAGE(agrees(verified(slot)), verified(slot));
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"+#135-[", "+#136-["}, {"+#136-[", "-#136-["}})
    CHECK_MESSAGE(verified(slot, replaced(good, from, to)).find("\nDIFFERS") != std::string::npos,
                  from << " to " << to);
}

TEST_CASE("verify: a result that the ways leave in different variables is copied on each of them") {
  for (const char* macros : {"dotek", "inspection-plus"}) {
    const Shop face{"chained", "TM.Face.Laterale", "palpage", "fusion", macros, "fanuc-0i-md"};
    const std::string good = converted(face);
    CHECK_MESSAGE(agrees(verified(face)), verified(face));
    CHECK(good.find("#581=#135") < good.find("#581=#136"));
    for (const auto& [from, to] : someOf(std::vector<std::pair<std::string, std::string>>{
             {"#581=#136", "#581=#135"}, {"  writeBlock(\"#581=#135\");\n", ""}}))
      CHECK_MESSAGE(verified(face, replaced(good, from, to)).find("\nDIFFERS") != std::string::npos,
                    from << " to " << to);
  }
}

TEST_CASE("verify: G10 of a listed work offset, for another control") {
  const Shop height{"touches", "BR-ALTEZZA", "tasta", "fanuc", "easyprobe", "fanuc-31i-b"};
  const std::string good = converted(height);
  CHECK_MESSAGE(agrees(verified(height)), verified(height));
  CHECK(verified(height, replaced(good, "G10 L2 P#16", "G10 L2 P1")).find("\nDIFFERS") != std::string::npos);
}

TEST_CASE("verify: blocks that jumps lead to keep the numbers of the Prog in a fragment") {
  const std::string said = verified({"direct", "DP.Top.Zero", "touch", "fusion", "dotek", "fanuc-0i-md"});
  CHECK_MESSAGE(agrees(said), said);
}

TEST_CASE("verify: Mikroprog searches as far as the call says, and sets a corner face by face") {
  const std::vector<std::string> assume = {"Q7", "Q10", "Q13"};
  for (const char* cycle : {"JT.Bore.Zero", "JT.Vice.Corner"}) {
    const std::string said =
        verified({"inspection", cycle, "probeOps", "mikroprog", "", "mikroprog-mill", assume});
    CHECK_MESSAGE(agrees(said), said);
  }
}

TEST_CASE("verify: a top that Mikroprog meets at an edge leaves the height of its tails") {
  driver::VerifyOptions options;
  take({"inspection", "JT.Vice.Corner", "probeOps", "mikroprog", "", "mikroprog-mill", {"Q7", "Q10", "Q13"}},
       options);
  options.cases = 60;
  options.seed = 2;
  options.jobs = 1;
  const driver::Outcome outcome = driver::verify(options);
  const std::string said = renderText(outcome.diagnostics, outcome.sources, 0) + outcome.output;
  CHECK_MESSAGE(outcome.output.starts_with("AGREES"), said);
}

TEST_CASE("verify: a height whose travel goes on beyond the surface, as a fragment for another set") {
  const Shop height{"easyprobe", "Brandl.Hoehe.Z", "messen", "fusion", "inspection-plus", "fanuc-0i-md"};
  const std::string good = converted(height);
  // VORZ + MESSWEG is UEBER below SOLL for all values: no S could say so.
  CHECK(good.find(" S\"") == std::string::npos);
  CHECK(good.find("LOCAL SHIFT ACTIVE") != std::string::npos);
  CHECK(good.find("do not lead to the nominal") == std::string::npos);
  const std::string said = verified(height);
  CHECK_MESSAGE(agrees(said), said);
  // The offset without the nominal.
  const std::size_t write = good.find("+#137-");
  REQUIRE(write != std::string::npos);
  const std::string wrong = verified(height, replaced(good, "+#137-", "+#137+"));
  CHECK_MESSAGE(wrong.find("\nDIFFERS") != std::string::npos, wrong);
}

TEST_CASE("verify: three touches at angles, and four round a spigot, are where the path draws them") {
  for (const Shop& one :
       {Shop{"toolchange", "MX.Arc.Centre", "measure", "fanuc", "inspection-plus", "fanuc-0i-md"},
        Shop{"inspection", "JT.Spigot.Cutter", "probeOps", "fanuc", "inspection-plus", "fanuc-31i-b"}}) {
    CAPTURE(one.cycle);
    const std::string said = verified(one);
    CHECK_MESSAGE(agrees(said), said);
  }
  const Shop arc{"toolchange", "MX.Arc.Centre", "measure", "fanuc", "inspection-plus", "fanuc-0i-md"};
  const std::string good = converted(arc);
  const std::size_t call = good.find("G65 P9823 A");
  REQUIRE(call != std::string::npos);
  const std::string wrong = verified(arc, std::string(good).replace(call + 10, 1, "A-"));
  CHECK_MESSAGE(wrong.find("\nDIFFERS") != std::string::npos, wrong);
}

TEST_CASE("verify: a branch without a call may store where a set keeps its calibration") {
  for (const char* set : {"easyprobe", "inspection-plus"}) {
    CAPTURE(set);
    const std::string said = verified({"direct", "DP.Rail.Slope", "touch", "fanuc", set, "fanuc-0i-md"});
    CHECK_MESSAGE(agrees(said), said);
  }
}

TEST_CASE("verify: Mikroprog finds the middle of a web and a boss from outside") {
  for (const char* cycle : {"NK.Zebro.Y", "NK.Czop.Srodek", "NK.Rowek.X"})
    for (const bool byOperator : {false, true}) {
      Shop one{"flags", cycle, "pomiar", "mikroprog", "", "mikroprog-mill", {}};
      if (byOperator)
        one.datum = "operator";
      else
        one.assume = {"Q7", "Q10", "Q13"};
      const std::string said = verified(one);
      CHECK_MESSAGE(agrees(said), said);
    }
}

TEST_CASE("verify: Mikroprog measures between walls without a datum, by contacts alone") {
  const TestFolder folder("dotek-verify-no-datum");
  std::string post = readAll(root() / "tests/shops/flags/post.txt");
  for (const char* before : {"('LUZ')' S'OpFieldData#('UKL') EOL", "('LUZ')' S'OpFieldData#('UKL') EOL",
                             "X'OpFieldData#('SZER')' S'OpFieldData#('UKL') EOL"}) {
    const std::string call = before;
    post = replaced(post, call, call.substr(0, call.find("' S'")) + " EOL");
  }
  for (const char* cycle : {"NK.Zebro.Y", "NK.Czop.Srodek", "NK.Rowek.X"}) {
    driver::VerifyOptions options;
    take({"flags", cycle, "pomiar", "mikroprog", "", "mikroprog-mill"}, options);
    options.source.prog = folder.write("post.txt", post);
    folder.write("dotek.toml", "schema = 1\nform = \"nk-31i\"\n");
    options.cases = 20;
    options.jobs = 1;
    const driver::Outcome outcome = driver::verify(options);
    const std::string said = renderText(outcome.diagnostics, outcome.sources, 0) + outcome.output;
    CHECK_MESSAGE(agrees(said), said);
  }
}

TEST_CASE("verify: each damage to the way round a web is seen") {
  Shop web{"flags", "NK.Zebro.Y", "pomiar", "mikroprog", "", "mikroprog-mill", {"Q7", "Q10", "Q13"}};
  web.host = {{"clearance", "20"}, {"tool_radius", "3"}, {"overtravel", "5"}, {"return_feed", "1000"},
              {"start_x", "-15"},  {"start_y", "10"},    {"start_z", "60"}};
  web.set = {{"PX", "0"},  {"PY", "20"}, {"PZ", "4"}, {"SZER", "25"},
             {"GZ", "-5"}, {"LUZ", "5"}, {"UKL", "3"}};
  const std::string good = converted(web);
  CHECK_MESSAGE(agrees(verified(web, good)), verified(web, good));
  for (const auto& [from, to] : someOf(std::vector<std::pair<std::string, std::string>>{
           {"G92 Y-5 ", "G92 Y0 "},            // another share of the way off the wall
           {"G1 Y-5 F1000", "G1 Y-4 F1000"},   // the two ways off the walls are not alike
           {"P90=P90+5\r\n", "P90=P90+6\r\n"}, // the record
           {"G31 Z4 L", "G31 Z-4 L"},          // does not come up
           {"G31 Z-5 L", "G31 Z-4 L"},         // touches higher
           {"G92 Y20\r\n", "G92 Y21\r\n"}}))
    CHECK_MESSAGE(!agrees(verified(web, replaced(good, from, to))), from << " to " << to);
  web.assume.clear();
  web.datum = "operator";
  const std::string byHand = converted(web);
  CHECK_MESSAGE(agrees(verified(web, byHand)), verified(web, byHand));
  // The half of the width is 12.5, the ball 3, the clearance 5.
  for (const auto& [from, to] : someOf(std::vector<std::pair<std::string, std::string>>{
           {"G31 Y40.5 L", "G31 Y36.5 L"},         // down too near
           {"G31 Y-0.5 L", "G31 Y3.5 L"},          // the same on the other side
           {"G1 Y40.5 F1000", "G1 Y50 F1000"},     // too far off the wall
           {"G1 Y-0.5 F1000", "G1 Y-10 F1000"},    // the same
           {"G31 Z4 L", "G31 Z5 L"},               // not as high as it began
           {"G1 Y40.5 F1000", "G1 Y40.5 F2000"}})) // another feed
    CHECK_MESSAGE(!agrees(verified(web, replaced(byHand, from, to))), from << " to " << to);
  // After the stop of the operator it is asked again.
  const std::size_t asked = byHand.rfind("G23 L910 O7");
  REQUIRE(asked > byHand.find("M0 ;"));
  CHECK_FALSE(agrees(verified(web, std::string(byHand).replace(asked, 11, "M9"))));
}

TEST_CASE(
    "convert to Fusion refuses what the branch keeps where the target's macros keep their calibration") {
  const TestFolder folder("dotek-fusion-calibration");
  const std::filesystem::path shops = root() / "tests/shops";
  driver::ConvertOptions options;
  take({"flags", "NK.Skos.Zebro", "pomiar", "fusion", "dotek", "fanuc-31i-b"}, options);
  options.source.prog =
      folder.write("post.txt", replaced(readAll(shops / "flags/post.txt"), "' #542=#138'", "' #523=#138'"));
  folder.write("dotek.toml", "schema = 1\nform = \"nk-31i\"\n");
  const auto said = [&] {
    const driver::Outcome outcome = driver::convert(options);
    return std::to_string(outcome.status) + renderText(outcome.diagnostics, outcome.sources, 0);
  };
  CHECK(said().find("[store-calibration]") != std::string::npos);
  options.probeMacros = "inspection-plus";
  CHECK_MESSAGE(said().starts_with("0"), said());
}

TEST_CASE("verify: how far beside a feature the probe goes down") {
  for (const char* set : {"inspection-plus", "dotek"}) {
    const Shop boss{"flags", "NK.Czop.Srodek", "pomiar", "fanuc", set, "fanuc-31i-b"};
    const std::string good = converted(boss);
    CHECK(agrees(verified(boss, good)));
    CHECK(verified(boss, replaced(good, " R#18", " R[#18+1.]")).find("clearance") != std::string::npos);
  }
}

TEST_CASE("verify: what switches the probe is called under the modes of the source") {
  const Shop face{"inspection", "JT.Face.Datum", "probeOps", "fanuc", "inspection-plus", "fanuc-31i-b"};
  const std::string good = converted(face);
  CHECK(agrees(verified(face, good)));
  const std::string later = replaced(replaced(good, "\nG90 G94", "\nG94"), "P9832\n", "P9832\nG90\n");
  const std::string said = verified(face, later);
  CHECK_MESSAGE(said.find("P9832 called under G90 against G91") != std::string::npos, said);
}

TEST_CASE("verify: a fragment shows the message of the dialog for values that it rejects") {
  Shop boss{"flags", "NK.Czop.Srodek", "pomiar", "fusion", "inspection-plus", ""};
  const std::string good = converted(boss);
  boss.cases = 300;
  CHECK(verified(boss, good).find("AGREES") != std::string::npos);
  const std::string said = verified(boss, replaced(good, "\"Czop za maly\"", "\"Czop za duzy\""));
  CHECK_MESSAGE(said.find("stops with `Czop za duzy`") != std::string::npos, said);
}

TEST_CASE("verify: another set's results in a fragment count within the grid of contacts") {
  for (const char* cycle : {"NK.Rowek.X", "NK.Skos.Sciana", "NK.Skos.Zebro", "NK.Czop.Trzy"}) {
    const std::string said = verified({"flags", cycle, "pomiar", "fusion", "dotek", "fanuc-31i-b"});
    CHECK_MESSAGE(agrees(said), said);
  }
}

TEST_CASE("verify: Mikroprog finds the middle of a pocket between two walls") {
  // The slot of the toolroom without the zone that no control of that kind compares.
  const TestFolder folder("dotek-verify-pocket");
  const std::filesystem::path shops = root() / "tests/shops";
  std::filesystem::copy(shops / "inspection/JT.Slot.Datum", folder / "JT.Slot.Datum");
  driver::VerifyOptions options;
  options.source.prog = folder.write(
      "post.txt", replaced(readAll(shops / "inspection/post.txt"), "' M'OpFieldData#('ZONE') EOL", " EOL"));
  options.inputs = {(folder / "JT.Slot.Datum").string()};
  options.source.routine = "probeOps";
  options.common.data = {(shops / "data").string()};
  options.to = "mikroprog";
  options.control = "mikroprog-mill";
  options.cases = 20;
  options.jobs = 1;
  options.datum = "operator";
  const driver::Outcome outcome = driver::verify(options);
  const std::string said = renderText(outcome.diagnostics, outcome.sources, 0) + outcome.output;
  CHECK_MESSAGE(outcome.output.starts_with("AGREES"), said);
}

} // namespace dotek::tests
