// Translations that were damaged where no drawn case goes: what guards a move, what nobody wrote, what the
// caller has in force.
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/Process.h"

#include <array>
#include <doctest/doctest.h>
#include <string>
#include <vector>

using namespace dotek::tests;

namespace {

// A post with one branch for the shipped cycle, in macros of Renishaw.
std::string postWith(const std::string& touch) {
  return "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\n\nprobe:\nIF CycleType?('surface-x')\n"
         " SeqC SpinOff EOL\n SeqC CoolOff EOL\n SeqC ' G65 P9832' EOL\n"
         " SeqC ' G65 P9810' ZCP1 ' F3000.' EOL\n SeqC ' G65 P9810 Z'OpFieldData#('Z')' F500.' EOL\n" +
         touch + " SeqC ' G65 P9810' ZCP1 ' F3000.' EOL\n SeqC ' G65 P9833' EOL\nEND\nRETURN\n";
}

const std::string kTouch = " SeqC ' G65 P9811 X[#5001+'OpFieldData#('X')']' EOL\n";

std::string cycle() {
  return (root() / "examples/surface-x").string();
}

struct Damage {
  const char* edit; // of sed
  const char* said;
};

// `flags` of convert and verify; the whole translation agrees, each damage shows.
void checkDamages(const ProcessFolder& folder, const std::string& source, const std::string& flags,
                  const std::string& suffix, const std::vector<Damage>& damages,
                  const std::string& ofVerify = "") {
  const std::string whole = "whole." + suffix, less = "less." + suffix;
  const ShellResult written = folder.run("dotek convert " + source + flags + " -o " + whole);
  REQUIRE_MESSAGE(written.status == 0, written.out << written.err);
  const std::string verify =
      "dotek verify " + source + flags + ofVerify + " --cases 40 --allow-edits --translation ";
  const ShellResult good = folder.run(verify + whole);
  CHECK_MESSAGE(good.status == 0, good.out << good.err);
  for (const Damage& one : someOf(damages)) {
    CAPTURE(one.edit);
    const ShellResult edited = folder.run(std::string("sed '") + one.edit + "' " + whole + " >" + less +
                                          "; cmp -s " + whole + " " + less + " && echo same");
    REQUIRE(edited.out.empty());
    const ShellResult result = folder.run(verify + less);
    CHECK_MESSAGE(result.status == 1, result.out << result.err);
    CHECK_MESSAGE((result.out + result.err).find(one.said) != std::string::npos, result.out << result.err);
  }
}

} // namespace

TEST_CASE("verify: a protected move that raises no alarm any more is a difference") {
  const ProcessFolder folder;
  folder.write("own.txt", postWith(kTouch));
  checkDamages(folder, cycle() + " --prog own.txt", " --to fanuc --control fanuc-31i-b", "nc",
               {{"s/P9810 Z#26 F500./& M1./", "against one that raises no alarm"}});
}

TEST_CASE(
    "verify: what meets something, or finds nothing, stops a translation to another set as its source") {
  const ProcessFolder folder;
  checkDamages(folder, cycle() + " --prog " + (root() / "examples/post.txt").string(),
               " --to fanuc --control fanuc-0i-md --probe-macros dotek", "nc",
               {{"s/P8810 Z#26.*/& M1./", "one that raises no alarm"},
                {"s/P8811.*/& M1./", "M1, which raises no alarm"}});
  checkDamages(folder, cycle() + " --prog " + (root() / "examples/post.txt").string(),
               " --to fanuc --control fanuc-31i-b --probe-macros inspection-plus", "nc",
               {{"s/P9811.*/& H1./", "size-tolerance"}, {"s/P9810 Z#26.*/& M1./", "raises no alarm"}});
}

TEST_CASE("verify: a variable of the shop that a translation forgets is a difference") {
  const ProcessFolder folder;
  folder.write("own.txt", postWith(kTouch + " SeqC '#610=#135+#540' EOL\n"));
  const std::string flags = " --to fanuc --control fanuc-31i-b";
  const std::string source = cycle() + " --prog own.txt";
  checkDamages(
      folder, source, flags, "nc",
      {{"s/#610=.*/#610=#135/", "#610 is"}, {"s/+#540/-#540/", "#610 is"}, {"s/#540/#541/", "#610 is"}});
  const ShellResult given = folder.run("dotek verify " + source + flags +
                                       " --var 540=3 --cases 40 --allow-edits --translation less.nc");
  CHECK_MESSAGE(given.err.find("--var 540=3") != std::string::npos, given.out << given.err);
}

TEST_CASE("verify: a variable that only the translation writes is a difference") {
  const ProcessFolder folder;
  folder.write("own.txt", postWith(kTouch));
  checkDamages(folder, cycle() + " --prog own.txt", " --to fanuc --control fanuc-31i-b", "nc",
               {{"s/^G65 P9832.*/&\\n#720=1./", "#720: the source does not write it"}});
}

TEST_CASE("verify: the guard against a local shift asks for what the contract says") {
  const ProcessFolder folder;
  folder.write("own.txt", postWith(kTouch));
  checkDamages(folder, cycle() + " --prog own.txt", " --to fanuc --control fanuc-31i-b", "nc",
               {{"/LOCAL SHIFT/s/GT 0.01/GT 0.1/", "after G52 X-0.012"},
                {"/LOCAL SHIFT/s/GT 0.01/GT 2.9/", "after G52"},
                {"/LOCAL SHIFT/s/-#5201//", "with an external offset in force"}});
}

TEST_CASE("verify: programs are called under other modes, and meet what is in their way") {
  const ProcessFolder folder;
  // It keeps the distance, comes down watching, touches, and goes back as it came.
  folder.write("low.nc", "%\nO9300(LOW)\n#30=#4003\nG90G94G17G40G80\n#5=#5003\nG31Z[#5-4.]F500.\n"
                         "IF[ABS[#5063-#5083-[#5-4.]] GT 0.05]THEN #3000=3(IN THE WAY)\n"
                         "G31X[#5001+9.]F100.\n#620=#5061\nG1X[#5061-3.]F500.\nG0Z#5\nG#30\nM99\n%\n");
  checkDamages(folder, "low.nc", " --to fanuc --from-control fanuc-31i-b --control fanuc-31i-b", "nc",
               {{"s/^M99/M30/", "in place of going back to its caller"},
                {"s/G90 *G94/G94/", "called under G91"},
                {"s/G90 *G94/G90/", "called under G95"},
                {"s/G40 *G80/G80/", "called under G41"},
                {"s/^G#30//", "called under G91"},
                {"s/#30=#4003/#30=#4001/", "called under"},
                {"s/^IF.*WAY.*//", "against a measuring move"},
                {"s/GT 0*\\.05/GT .5/", "where protected move 1 meets something"}},
               " --assume probe-on");
}

TEST_CASE(
    "verify: an edited cycle has the defaults and titles of the dialog, and the clearance of the call") {
  const ProcessFolder folder;
  const std::string prog = (root() / "examples/post.txt").string();
  checkDamages(folder, cycle() + " --prog " + prog, " --to cycle", "cycle",
               {{"0,/length = [0-9-]*/s//length = 77/", "default of `"}});
}

TEST_CASE(
    "verify: a clearance beside a boss, and titles that are exchanged, are differences of an edited cycle") {
  const ProcessFolder folder;
  folder.write("knob/DefineData.txt", "SIZE = 30\nDEEP = -8\nAWAY = 5\n");
  folder.write("knob/CycleData.dlg",
               "dialog \"Knob\", 60, 60, 470, 230\nlabel 15, 20, 80, 24, \"Size of the knob [mm]\"\n"
               "input 110, 20, 80, 24, SIZE, SIZE\nlabel 15, 55, 80, 24, \"Height [mm]\"\n"
               "input 110, 55, 80, 24, DEEP, DEEP\nlabel 15, 90, 80, 24, \"Way beside it [mm]\"\n"
               "input 110, 90, 80, 24, AWAY, AWAY\nok 220, 180, 90, 28\ncancel 330, 180, 90, 28\n");
  folder.write("knob/CycleData.mac",
               "callback_returncode = 0\n:again\ndialog \"CycleData.dlg\"\nif SIZE > 2 then goto sized\n"
               "message \"Too small\"\ngoto again\n:sized\nif AWAY > 3 then goto beside\nmessage \"Too "
               "near\"\ngoto again\n"
               ":beside\nif DEEP < 0 then goto done\nmessage \"Too high\"\ngoto again\n:done\n");
  folder.write("knob/ToolPath.mac",
               "callback_returncode = 0\no = callback_op\nget_op_data o, TOOL_NUM, t\nget_tool_data t, "
               "MTOOL_RADIUS, b\n"
               "get_custom_drill_cycle_data retract_plane, p\nr = SIZE/2+b\nw = SIZE/2+b+AWAY\n"
               "add_custom_drill_cycle_path feed_x, w\nadd_custom_drill_cycle_path feed_z, DEEP-p\n"
               "add_custom_drill_cycle_path feed_x, r\nadd_custom_drill_cycle_path feed_x, w\n"
               "add_custom_drill_cycle_path feed_z, 0\nadd_custom_drill_cycle_path feed_x, -w\n"
               "add_custom_drill_cycle_path feed_z, DEEP-p\nadd_custom_drill_cycle_path feed_x, -r\n"
               "add_custom_drill_cycle_path feed_x, -w\nadd_custom_drill_cycle_path feed_z, 0\n"
               "add_custom_drill_cycle_path feed, 0, w, 0\nadd_custom_drill_cycle_path feed_z, DEEP-p\n"
               "add_custom_drill_cycle_path feed_y, r\nadd_custom_drill_cycle_path feed_y, w\n"
               "add_custom_drill_cycle_path feed_z, 0\nadd_custom_drill_cycle_path feed_y, -w\n"
               "add_custom_drill_cycle_path feed_z, DEEP-p\nadd_custom_drill_cycle_path feed_y, -r\n"
               "add_custom_drill_cycle_path feed_y, -w\nadd_custom_drill_cycle_path feed_z, 0\n"
               "add_custom_drill_cycle_path feed_y, 0\n");
  folder.write(
      "knob.txt",
      "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\n\nprobe:\nIF CycleType?('knob')\n"
      " SeqC SpinOff EOL\n SeqC CoolOff EOL\n SeqC ' G65 P9832' EOL\n"
      " SeqC ' G65 P9810' ZCP1 ' F3000.' EOL\n"
      " SeqC ' G65 P9814 D'OpFieldData#('SIZE')' Z'OpFieldData#('DEEP')' R'OpFieldData#('AWAY')' S1' EOL\n"
      " SeqC ' G65 P9833' EOL\nEND\nRETURN\n");
  checkDamages(
      folder, "knob --prog knob.txt", " --to cycle", "cycle",
      {{"s/clearance = away/& + 1 mm/", "clearance"}, {"s/\"Height\"/\"Way beside it\"/", "title of `"}});
}

TEST_CASE("verify: the replay of a difference keeps planes that are one") {
  const ProcessFolder folder;
  REQUIRE(folder
              .run("cp -r " + cycle() +
                   " face && sed -i 's/feed_z, R-plane/feed_z, 0/; s/feed_z, Z-plane/feed_z, Z-plane*2/' " +
                   "face/ToolPath.mac")
              .status == 0);
  REQUIRE(folder
              .run("sed \"s/ Z'OpFieldData#('R')'/' ZCP1 '/\" " + (root() / "examples/post.txt").string() +
                   " >face.txt")
              .status == 0);
  const std::string run = "dotek verify face --cycle surface-x --prog face.txt --cases 60 2>&1 | grep -A9 "
                          "'nominal contact differs' | grep -m1 ";
  const ShellResult told = folder.run(run + "'replay: '");
  REQUIRE_MESSAGE(told.status == 0, told.out << told.err);
  const auto valueOf = [&](const std::string& name) {
    const std::string flag = "--value " + name + "=";
    const std::size_t at = told.out.find(flag);
    return at == std::string::npos
               ? ""
               : told.out.substr(at + flag.size(), told.out.find(' ', at + flag.size()) - at - flag.size());
  };
  CHECK(valueOf("clearance") == valueOf("retract"));
  CHECK(valueOf("clearance") != "0");
  CHECK(!valueOf("clearance").empty());
}

TEST_CASE("verify: a limit of a whole number that a translation lacks is a difference") {
  const ProcessFolder folder;
  const ShellResult made = folder.run(
      "cp -r " + cycle() +
      " . && chmod -R u+w surface-x && sed -i 's/^if wrong = 1 then message.*/if R < 20 then wrong = 4\\n"
      "if R > 60 then wrong = 4\\nif R <> INT(R) then wrong = 4\\n&\\n"
      "if wrong = 4 then message \"Retract 20 to 60\"/' surface-x/CycleData.mac");
  REQUIRE_MESSAGE(made.status == 0, made.err);
  checkDamages(folder, "surface-x --prog " + (root() / "examples/post.txt").string(),
               " --to fanuc --control fanuc-0i-md --probe-macros dotek", "nc",
               {{"/ GT 60\\.\\]/d", "called with R 61: the dialog rejects the values"}});
}

TEST_CASE("verify: a register that is written wrongly is named beside the one that lacks it") {
  const ProcessFolder folder;
  const std::string head = "O9722\nIF[#1EQ#0]THEN#3000=1(A)\nG91G31Z-5.F50\nG90\n";
  folder.write("a.nc", head + "#2005=#1\n#601=#1\nG4X1.\nM99\n");
  folder.write("bad.nc", "%\n" + head + "#2006=#1\n#602=#1\nG4X1.\nM99\n%\n");
  const std::string said =
      folder.run("dotek verify a.nc --to fanuc --allow-edits --translation bad.nc --cases 20").err;
  for (const char* one :
       {"a.nc:5:1: error: tool offset differs: tool offset 5:", "tool offset 6: the source does not write it",
        "a.nc:6:1: error: variable differs: #601:", "#602: the source does not write it",
        "bad.nc:6:1: note: of the translation", "bad.nc:7:1: note: of the translation"})
    CHECK_MESSAGE(said.find(one) != std::string::npos, one, said);
}

TEST_CASE("verify: a difference of a variable names the statements that write it") {
  const ProcessFolder folder;
  const std::string body = "IF[#1EQ#0]THEN#3000=1(A)\nG0X#1\n#101=#1*2\n#5221=#5221+#1\n#103=#101*2\n"
                           "#102=#101+1\nG4X1.\nM99\n";
  folder.write("a.nc", "O9720\n" + body);
  const auto told = [&](const std::string& from, const std::string& to) {
    std::string bad = body;
    bad.replace(bad.find(from), from.size(), to);
    folder.write("bad.nc", "%\nO9720\n" + bad + "%\n");
    return folder.run("dotek verify a.nc --to fanuc --allow-edits --translation bad.nc --cases 20").err;
  };
  for (const auto& [from, to, line] :
       std::vector<std::array<std::string, 3>>{{"#101+1", "#101+2", "7"}, {"#101*2", "#101*3", "6"}}) {
    const std::string said = told(from, to);
    CHECK_MESSAGE(said.find("a.nc:" + line + ":") != std::string::npos, said);
    CHECK_MESSAGE(said.find("bad.nc:" + std::to_string(std::stoi(line) + 1) + ":") != std::string::npos,
                  said);
  }
  // Of several the one that ran last, also where it computes which variable it writes.
  folder.write("a.nc", "O9720\n#102=1\n" + body);
  const std::string again = told("#101+1", "#101+2");
  CHECK_MESSAGE(again.find("a.nc:8:") != std::string::npos, again);
  folder.write("a.nc", "O9720\n#9=100\n" + body.substr(0, body.find("G4")) + "#[#9+2]=#102*2\nM99\n");
  folder.write("bad.nc", "O9720\n#9=100\n" + body.substr(0, body.find("G4")) + "#[#9+2]=#102*3\nM99\n");
  const std::string computed =
      folder.run("dotek verify a.nc --to fanuc --allow-edits --translation bad.nc --cases 20").err;
  CHECK_MESSAGE(computed.find("a.nc:9:1: error: variable differs: #102") != std::string::npos, computed);
  CHECK_MESSAGE(computed.find("bad.nc:9:1: note: of the translation") != std::string::npos, computed);
}

// The touch comes first: a reader who is shown it looks for the fault in the wrong block.
TEST_CASE("verify: a difference of an offset names the statements that write it") {
  const ProcessFolder folder;
  const std::string head = "O9721\nIF[#1EQ#0]THEN#3000=1(A)\n";
  const std::string touch = "G91G31Z-5.F50\nG90\n";
  const auto told = [&](const std::string& write, const std::string& other, const std::string& first = "") {
    folder.write("a.nc", head + first + touch + write + "G4X1.\nM99\n");
    folder.write("bad.nc", "%\n" + head + first + touch + other + "G4X1.\nM99\n%\n");
    return folder.run("dotek verify a.nc --to fanuc --allow-edits --translation bad.nc --cases 20").err;
  };
  struct Offset {
    std::string aspect, write, other;
  };
  for (const Offset& one : std::vector<Offset>{{"work offset", "#5223=#5223+#1\n", "#5223=#5223-#1\n"},
                                               {"work offset", "#[5220+3]=#1\n", "#[5220+3]=#1+1.\n"},
                                               {"work offset", "G90G10L2P1Z#1\n", "G90G10L2P1Z[#1+1.]\n"},
                                               {"tool", "#2001=#1\n", "#2001=-#1\n"},
                                               {"tool", "G90G10L11P3R#1\n", "G90G10L11P3R[#1+1.]\n"}}) {
    for (const std::string& first : {std::string(), one.write}) { // several writes, too
      const std::string said = told(one.write, one.other, first);
      const int line = first.empty() ? 5 : 6;
      const std::size_t at = said.find(" differs: ");
      REQUIRE_MESSAGE(at != std::string::npos, one.write, said);
      CHECK_MESSAGE(
          said.find("a.nc:" + std::to_string(line) + ":1: error: " + one.aspect) != std::string::npos, said);
      CHECK_MESSAGE(said.find("bad.nc:" + std::to_string(line + 1) + ":1: note: of the translation") !=
                        std::string::npos,
                    said);
    }
  }
}

TEST_CASE("verify: a comparison of two touches that is gone shows, whatever digits the controls have") {
  const ProcessFolder folder;
  folder.write("pad/DefineData.txt", "X2 = 40\nG = 55\nMAXI = 0.1\n");
  folder.write("pad/CycleData.dlg",
               "dialog \"Pad\", 60, 60, 470, 230\nlabel 15, 20, 80, 24, \"Second place [mm]\"\n"
               "input 110, 20, 80, 24, X2, X2\nlabel 15, 55, 80, 24, \"Work offset\"\n"
               "input 110, 55, 80, 24, G, G\nlabel 15, 90, 80, 24, \"Out of flat [mm]\"\n"
               "input 110, 90, 80, 24, MAXI, MAXI\nok 220, 180, 90, 28\ncancel 330, 180, 90, 28\n");
  folder.write(
      "pad/CycleData.mac",
      "callback_returncode = 0\n:again\ndialog \"CycleData.dlg\"\nwrong = 0\nif X2 < 10 then wrong = 1\n"
      "if G < 54 then wrong = 2\nif G > 59 then wrong = 2\nif MAXI < 0.02 then wrong = 3\n"
      "if MAXI > 0.2 then wrong = 3\nif wrong > 0 then goto again\n");
  folder.write(
      "pad/ToolPath.mac",
      "callback_returncode = 0\nget_custom_drill_cycle_data x, ox\nget_custom_drill_cycle_data y, oy\n"
      "get_custom_drill_cycle_data retract_plane, oz\n"
      "add_custom_drill_cycle_path feed, -ox, -oy, 5-oz\nadd_custom_drill_cycle_path feed_z, -oz\n"
      "add_custom_drill_cycle_path feed_z, 5-oz\nadd_custom_drill_cycle_path feed_x, X2-ox\n"
      "add_custom_drill_cycle_path feed_z, -oz\nadd_custom_drill_cycle_path feed_z, 5-oz\n");
  folder.write(
      "post.txt",
      "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\n\nprobe:\nIF CycleType?('pad')\n SeqC SpinOff EOL\n"
      " SeqC CoolOff EOL\n SeqC ' M31' EOL\n SeqC ' G65 P9770' ZCP1 ' F3000.' EOL\n"
      " SeqC ' G65 P9770 X0. Y0. F3000.' EOL\n SeqC ' G65 P9770 Z5. F500.' EOL\n"
      " SeqC ' G65 P9023 Z-5. K0. S'OpFieldData#('G') EOL\n SeqC ' #551=#138' EOL\n"
      " SeqC ' G65 P9770 X'OpFieldData#('X2')' F3000.' EOL\n"
      " SeqC ' G65 P9023 Z-5. K0. S'OpFieldData#('G') EOL\n"
      " SeqC ' IF[ABS[#551-#138]LT'OpFieldData#('MAXI')']GOTO40' EOL\n SeqC ' #3000=5(NOT FLAT)' EOL\n"
      " 'N40 G65 P9770' ZCP1 ' F3000.' EOL\n SeqC ' M32' EOL\nEND\nRETURN\n");
  checkDamages(folder, "pad --prog post.txt",
               " --to fanuc --control fanuc-31i-b --probe-on M31 --probe-off M32", "nc",
               {{"/^IF.*NOT FLAT/d", "with the surface of touch 1"},
                {"s/ABS\\[#551-#138\\]/[#551-#138]/", "farther"}});
}

TEST_CASE("convert: a result that several ways lead to is kept on each of them") {
  const ProcessFolder folder;
  const std::string x = "OpFieldData#('X')";
  const std::string touch = "G65 P9023 X'" + x + "' I'OpFieldData#('I')' S'OpFieldData#('G') EOL\n";
  folder.write(
      "own.txt",
      "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\n\nprobe:\nIF CycleType?('surface-x')\n SeqC SpinOff EOL\n"
      " SeqC CoolOff EOL\n SeqC ' M31' EOL\n SeqC ' G65 P9770' ZCP1 ' F3000.' EOL\n"
      " SeqC ' G65 P9770 Z'OpFieldData#('Z')' F500.' EOL\n SeqC ' IF['" +
          x + "'LT0]GOTO20' EOL\n SeqC ' " + touch + " SeqC ' GOTO30' EOL\n 'N20 " + touch +
          " 'N30 #550=#138' EOL\n SeqC ' G65 P9770' ZCP1 ' F3000.' EOL\n SeqC ' M32' EOL\nEND\nRETURN\n");
  const std::string flags =
      cycle() + " --prog own.txt --to fanuc --control fanuc-0i-md --probe-macros inspection-plus";
  const ShellResult written = folder.run("dotek convert " + flags);
  CHECK_MESSAGE(written.out.find("=#135\n") != std::string::npos, written.out << written.err);
  const ShellResult verified = folder.run("dotek verify " + flags + " --cases 40");
  CHECK_MESSAGE(verified.status == 0, verified.out << verified.err);
}

TEST_CASE("convert: a pocket with an island is refused for macros that measure webs alone") {
  const ProcessFolder folder;
  const auto converted = [&](const std::string& sign) {
    folder.write("own.txt", postWith(" SeqC ' G65 P9812 X'OpFieldData#('X')' Z'OpFieldData#('Z')' R" + sign +
                                     "'OpFieldData#('R') EOL\n"));
    return folder.run("dotek convert " + cycle() +
                      " --prog own.txt --to fanuc --probe-macros dotek --probe-on M31 --probe-off M32");
  };
  CHECK(converted("").out.find("G65 P8812 X#24 Z#26 R#18") != std::string::npos);
  const ShellResult island = converted("-");
  CHECK(island.status == 1);
  CHECK_MESSAGE(island.err.find("has no call for `R` of P8812 below 0, which is an island") !=
                    std::string::npos,
                island.err);
}
