// Where cycles of tests/shops stop: with which text, after what, and where they try again.
#include "tests/unit/ShopRuns.h"

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

TEST_CASE("verify: a bore that is measured until it repeats meets the end of its loop") {
  for (const char* macros : {"inspection-plus", "dotek"}) {
    const Shop hole{"retries", "LS-HOLE-RETRY", "probeIt", "fanuc", macros, "fanuc-31i-b"};
    const std::string good = converted(hole), said = verified(hole);
    CHECK_MESSAGE(("\n" + said).find("\nAGREES") != std::string::npos, said); // one may be undecided
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"GE 3.]GOTO", "GE 2.]GOTO"},                              // once less
             {"IF[ABS[#612-#611] LE", "IF[[#612-#611] LE"},             // each smaller one repeats
             {"GOTO 10\n", "GOTO 30\n"},                                // what does not repeat is taken
             {"\n#3000=103(HOLE DOES NOT REPEAT)", "\n(#3000=103)"}}) { // and so it is
      CAPTURE(from);
      CHECK(differs(hole, replaced(good, from, to)));
    }
  }
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

} // namespace dotek::tests
