// Jumps and loops within a branch, and the modes that hold after them.
#include "tests/unit/NcHelper.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

TEST_CASE("a jump leads to the block of the branch that has the number") {
  CHECK(lifted("IF[#601GT5.]GOTO20\n#602=1\nN20 M5") ==
        "if or_zero(#{601}) > 5. goto N20\nstore 602=1\nN20:\nspindle 0\n");
  CHECK(lifted("GOTO 20\nN20 M5") == "goto N20\nN20:\nspindle 0\n");
  CHECK(lifted("GOTO20\nM5") == "refused: [jump-out-of-branch]");
  CHECK(lifted("GOTO20\nN20 M5\nN20 M9") == "refused: [jump-out-of-branch]");
}

TEST_CASE("IF THEN is an assignment that is jumped over") {
  CHECK(lifted("IF[#601LT1.]THEN#602=2.") == "if or_zero(#{601}) >= 1. goto after\nstore 602=2\nafter:\n");
  Nc nc;
  CHECK(nc.lift("IF[#601LT1.]THEN#3000=5(NOT FOUND)\nM5"));
  CHECK(nc.shown().find("alarm NOT FOUND\nafter:\nspindle 0") != std::string::npos);
}

TEST_CASE("an empty variable equals nothing; in other comparisons it counts as 0") {
  CHECK(lifted("IF[#601EQ#0]GOTO1\nN1 M5").find("null") != std::string::npos);
  CHECK(lifted("IF[#601EQ0]GOTO1\nN1 M5").find("#{601} is 0") != std::string::npos);
}

TEST_CASE("a loop jumps back to its condition") {
  CHECK(lifted("#601=0\nWHILE[#601LT3]DO1\n#601=#601+1\nEND1\nM5") ==
        "store 601=0\nloop:\nif or_zero(#{601}) >= 3 goto end\nstore 601=(u14(#601)+1)\ngoto loop\nend:\n"
        "spindle 0\n");
  CHECK(lifted("WHILE[#601LT3]DO1\nM5") == "refused: [loop-unbalanced]");
  CHECK(lifted("END1") == "refused: [loop-unbalanced]");
  CHECK(lifted("DO1\nDO2\nEND1\nEND2").find("loop-unbalanced") != std::string::npos);
}

TEST_CASE("a loop that nothing goes back to is a loop all the same") {
  Nc nc;
  CHECK(nc.lift("WHILE[#601LT3]DO1\n#3000=1(NO)\nEND1\nM5"));
  CHECK(nc.shown().find("alarm NO\ngoto loop\nend:\nspindle 0") != std::string::npos);
  CHECK(lifted("WHILE[#601LT3]DO1\nGOTO10\nEND1\nN10 M5") ==
        "loop:\nif or_zero(#{601}) >= 3 goto end\ngoto N10\ngoto loop\nend:\nN10:\nspindle 0\n");
}

// Fanuc macro B, reference 1.4: AND with * and /, OR with + and -.
TEST_CASE("AND binds more than OR") {
  const std::string grouped = lifted("IF[[#601EQ1]OR[[#602EQ1]AND[#603EQ1]]]GOTO10\nN10 M5");
  CHECK(grouped.find("refused") == std::string::npos);
  CHECK(lifted("IF[[#601EQ1]OR[#602EQ1]AND[#603EQ1]]GOTO10\nN10 M5") == grouped);
  CHECK(lifted("IF[[#602EQ1]AND[#603EQ1]OR[#601EQ1]]GOTO10\nN10 M5") !=
        lifted("IF[[#602EQ1]AND[[#603EQ1]OR[#601EQ1]]]GOTO10\nN10 M5"));
  CHECK(lifted("IF[[[#602EQ1]AND[#603EQ1]]OR[#601EQ1]]GOTO10\nN10 M5") ==
        lifted("IF[[#602EQ1]AND[#603EQ1]OR[#601EQ1]]GOTO10\nN10 M5"));
}

TEST_CASE("after a label the modes hold in which all paths to it agree") {
  // Both come with G0.
  CHECK(lifted("G0 X1.\nIF[#601GT5.]GOTO2\nG0 Y2.\nN2 Z5.").find("rapid Z=work:5") != std::string::npos);
  CHECK(lifted("G0 X1.\nIF[#601GT5.]GOTO2\nG1 Y2. F50\nN2 Z5.") == "refused: [mode-not-known]");
  // The loop comes back with G1.
  CHECK(lifted("G0 X1.\nWHILE[#601LT3]DO1\nZ5.\nG1 Z-5. F50\nEND1") == "refused: [mode-not-known]");
  CHECK(lifted("G0 X1.\nWHILE[#601LT3]DO1\nG0 Z5.\nG1 Z-5. F50\nEND1\nG0 Z5.").find("refused") ==
        std::string::npos);
  // G91 on one path.
  CHECK(lifted("IF[#601GT5.]GOTO2\nG91\nN2 G0 Z5.") == "refused: [mode-not-known]");
}

TEST_CASE("a variable with a computed number counts from a common one") {
  CHECK(lifted("#[601+#602]=#603") == "store (601+u14(#602))=#603\n");
  CHECK(lifted("#603=#[601+#602]") == "store 603=#(601+u14(#602))\n");
  CHECK(lifted("#[#602]=1") == "refused: [computed-variable]");
  CHECK(lifted("#[5+#602]=1") == "refused: [computed-variable]");
  CHECK(lifted("#[600-#602]=1") == "refused: [computed-variable]");
}
