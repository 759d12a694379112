// A skip move that meets nothing, and what the program makes of its end.
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <string>
#include <string_view>

using namespace dotek::tests;

namespace {

// A block of 50 x 50 x 20, its upper face at Z0; the macro is called beside it, at X-20, with Z-5.
class Bench {
public:
  explicit Bench(const char* name) : folder(name) {
    folder.write("part.toml",
                 "schema = 1\n[place]\nshift = [-300.0, -200.0, -400.0]\n[[shape]]\nkind = \"box\"\n"
                 "min = [0.0, 0.0, -20.0]\nmax = [50.0, 50.0, 0.0]\n");
    folder.write(
        "machine.toml",
        "schema = 1\n[setup]\ntool = 2\nwork_offset = { G54 = \"part\" }\nat = [-20, 20, 15]\n"
        "[probe]\nball_diameter = 6\nlength = 80\nlength_to = \"tip\"\npre_travel = 0.005\non = true\n");
  }
  // What `sim` says of the body of O9002, and the pictures that it writes.
  CommandResult run(const std::string& body,
                    const std::string& flags = "--quiet --svg run.svg --html run.html") {
    folder.write("m.nc", "O9002\nG90\n" + body + "M99\nN91 #3000=1(NONE)\n");
    CommandResult out = runDotek(
        splitArguments("sim m.nc --part part.toml --machine machine.toml --call \"Z-5. X-15.\" " + flags),
        folder.path());
    svg = out.status <= 1 ? readAll(folder / "run.svg") : "";
    html = out.status <= 1 ? readAll(folder / "run.html") : "";
    return out;
  }
  bool fails(const std::string& body) {
    const CommandResult out = run(body);
    CAPTURE(out.err);
    CHECK((out.status == 1) == (out.err.find("[miss-measured]") != std::string::npos));
    CHECK((svg.find(">FAIL: MEASURED WITHOUT A TOUCH<") != std::string::npos) == (out.status == 1));
    return out.status == 1;
  }

  TestFolder folder;
  std::string svg, html;
};

constexpr const char* kDown = "G31 Z#26 F1000\n"; // beside the part: nothing is there
constexpr const char* kAway = "G31 X#24 F50\n";   // ends 10 mm before the face

bool holds(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}
std::size_t countOf(const std::string& text, std::string_view part) {
  std::size_t out = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++out;
  return out;
}

} // namespace

TEST_CASE("miss: a skip position that is used without a question fails the run, in both pictures") {
  Bench bench("dotek-miss-used");
  const std::string down = std::string(kDown) + "IF[#5003 GT [#26+.1]]GOTO91\n";
  const CommandResult out =
      bench.run(down + kAway + "#101=#5061+3.\nG0 X-20.\n" + kAway + "#102=#5061\nG0 Z15.\n#5221=#102\n");
  CAPTURE(out.err);
  CHECK(out.status == 1);
  CHECK(countOf(out.err, "[miss-measured]") == 2);
  CHECK(holds(out.err, "m.nc:5:1: error"));
  CHECK(holds(out.err, "`#101=#5061+3.` takes that end for the surface"));
  CHECK_FALSE(holds(out.err, "[probe-miss]")); // the move down is asked about
  for (const std::string& picture : {bench.svg, bench.html}) {
    CHECK(holds(picture, "id=\"banner\" class=\"fail\""));
    CHECK(holds(picture, "<title>FAIL: MEASURED WITHOUT A TOUCH - "));
    CHECK(holds(picture, "2 measuring moves met nothing, and the program took their ends for the surface"));
    CHECK(holds(picture, "2 misses"));
    CHECK(holds(picture, "no touch along X+: end of the move, no surface"));
    CHECK(holds(picture, "G54 X set from -300.000 to -15.000 (+285.000), after a miss"));
    CHECK(holds(picture, "run on Fanuc 0i-MD, machining centre (fanuc-0i-md)"));
  }
  CHECK(holds(bench.svg, ">error (0)<"));
  CHECK(holds(bench.svg, ">miss (2); 2 taken for the surface (full)<"));
  CHECK(holds(bench.svg, ">M1,2<")); // the mark at their end, in the views
  CHECK(holds(bench.svg, ">M2<"));   // the list
  CHECK(holds(bench.html, "miss (2)"));
  CHECK(holds(bench.html, "<tr class=\"feature missed\">"));
  CHECK(holds(bench.html, "<tr class=\"offset missed\">"));

  const CommandResult json =
      bench.run(std::string(kAway) + "#5221=#5061\n", "--json --svg run.svg --html run.html");
  CHECK(holds(json.out, "\"outcome\": \"miss\", \"used\": true"));
  CHECK(holds(json.out, "\"missed\": true, \"afterMiss\": true"));
  CHECK(holds(json.out, "\"ending\": \"program-end\""));
  const CommandResult text = bench.run(std::string(kAway) + "#5221=#5061\n", "--svg run.svg --html run.html");
  CHECK(holds(text.out, "run on Fanuc 0i-MD, machining centre (fanuc-0i-md)\nmeasured, mm"));
}

TEST_CASE("miss: what asks whether a skip move has touched") {
  Bench bench("dotek-miss-asked");
  const std::string away = kAway;
  CHECK(bench.fails(away + "#1=#5061\n"));
  CHECK(bench.fails(away + "#1=#[5060+1]\n"));
  CHECK(bench.fails(away + "G0 X[#5061-2.]\n"));
  CHECK(bench.fails(away + "IF[#24 EQ #0]GOTO91\n#1=#5061\n")); // about something else
  CHECK(bench.fails("IF[#1 GT 0]GOTO91\n" + away + "#1=#5061\n"));
  // The position itself, a copy, a copy of a copy, later in a common variable.
  CHECK_FALSE(bench.fails(away + "IF[#5061 GT 0]GOTO91\n#1=#5061\n"));
  CHECK_FALSE(bench.fails(away + "IF[#5041 GT 0]GOTO91\n#1=#5061\n"));
  CHECK_FALSE(bench.fails(away + "#1=#5061\nIF[#1 GT 0]GOTO91\n"));
  CHECK_FALSE(bench.fails(away + "#1=#5061\n#2=[#1+3.]/2\nG0 X-20.\nIF[ABS[#2] GT 90.]GOTO91\n"));
  CHECK_FALSE(
      bench.fails("WHILE[#1 LT 0]DO1\n" + away + "#1=#5061\nG0 X-20.\nIF[#2 EQ 1]THEN #1=1\n#2=1\nEND1\n"));
  CHECK_FALSE(bench.fails(away + "IF[#5061 LT 0]THEN #1=#5061\n"));
  // Nothing reads it.
  CHECK_FALSE(bench.fails(away));
  CHECK(holds(bench.svg, ">PASS, WITH MISSES<"));
  CHECK(holds(bench.svg, ">miss (1)<"));
  // After another move #5001 tells of that one.
  CHECK(bench.fails(away + "G0 X-20.\nIF[#5001 GT 0]GOTO91\n#1=#5061\n"));
}

TEST_CASE("miss: #5001 and #5041 that an IF looks at after the move make it one to a position") {
  Bench bench("dotek-miss-meant");
  const auto passes = [&](const std::string& body) {
    const CommandResult out = bench.run(body);
    CAPTURE(out.err);
    return out.status == 0 && holds(bench.svg, ">PASS<") && !holds(out.err, "probe-miss");
  };
  CHECK(passes("G31 Z#26 F1000\nIF[#5003 GT [#26+.1]]GOTO91\n"));
  CHECK(passes("G31 Z#26 F1000\nIF[ABS[#5043-#5083-#26] GT 0.05]GOTO91\n#1=#5041\n#2=#5042\n"));
  CHECK_FALSE(passes("G31 Z#26 F1000\nIF[#5043 GT [#26+.1]]GOTO91\n#1=#5043\n")); // kept: it measures
  CHECK_FALSE(passes("G31 Z#26 F1000\nIF[#5001 GT 100.]GOTO91\n"));               // of another axis
  CHECK_FALSE(passes("G31 Z#26 F1000\nG0 X-21.\nIF[#5003 GT 100.]GOTO91\n"));     // of another move
}

TEST_CASE("miss: a program that is called asks for its caller, and a common variable for both") {
  Bench bench("dotek-miss-calls");
  const auto fails = [&](const std::string& caller, const std::string& called) {
    bench.folder.write("m.nc", "O9002\nG90\n" + caller + "M99\nN91 #3000=1(NONE)\nO9003\n" + called +
                                   "M99\nN91 #3000=1(NONE)\n");
    const CommandResult out = runDotek(
        splitArguments("sim m.nc --part part.toml --machine machine.toml --call \"Z-5. X-15.\" --quiet"),
        bench.folder.path());
    CAPTURE(out.err);
    return out.status == 1 && holds(out.err, "[miss-measured]");
  };
  CHECK(fails("M98 P9003\n#1=#5061\n", "G31 X-15. F50\n"));
  CHECK_FALSE(fails("M98 P9003\nIF[#5061 GT 0]GOTO91\n", "G31 X-15. F50\n"));
  CHECK_FALSE(fails("G31 X-15. F50\n#101=#5061\nM98 P9003\n", "IF[#101 GT 0]GOTO91\n"));
  CHECK_FALSE(fails("G31 X-15. F50\nG65 P9003 A#5061\n", "IF[#1 GT 0]GOTO91\n"));
  CHECK(fails("G31 X-15. F50\nG65 P9003 A#5061\n", "#100=#1\n"));
}

TEST_CASE("miss: a skip move that begins in contact names the move before it") {
  Bench bench("dotek-miss-start");
  // The ball's centre comes to X-3 at the face; back by less than the 0.005 to its signal.
  const CommandResult out = bench.run("G31 Z#26 F1000\nIF[#5003 GT 0]GOTO91\nG31 X5. F1000\nG91 G0 X-0.002\n"
                                      "G90 G31 X5. F50\n#1=#5061\n");
  CAPTURE(out.err);
  CHECK(out.status == 1);
  CHECK(holds(out.err, "m.nc:7:1: error: the stylus is in contact already where this skip move begins, at "));
  CHECK(holds(out.err, "the move before it, in line 6, ended with the ball 0.003 mm inside the part"));
  CHECK(holds(out.err, "m.nc:6:1: note: the move before it"));
  CHECK(holds(out.err, "[contact-at-start]"));
  CHECK(holds(bench.svg, ">PROBE FAULT<"));
  CHECK(holds(bench.svg, "in line 6"));
}

TEST_CASE("miss: an offset that is set from one fails the run, whatever IF has looked at the value") {
  Bench bench("dotek-miss-written");
  const std::string tolerance = "G0 X-20.\nIF[ABS[#1] GT 50.]GOTO91\n";
  const auto fails = [&](const std::string& body) {
    const CommandResult out = bench.run(body);
    CAPTURE(body);
    CAPTURE(out.err);
    const bool found = holds(out.err, "[miss-written]");
    CHECK((out.status == 1) == found);
    CHECK(holds(bench.svg, "FAIL: OFFSET SET WITHOUT A TOUCH") == found);
    CHECK(holds(bench.html, "FAIL: OFFSET SET WITHOUT A TOUCH") == found);
    return found;
  };
  const std::string away = kAway;
  // Wear, a work system by a computed number, G10, through copies, from #5041 and #5021.
  CHECK(fails(away + "#1=#5061\n" + tolerance + "#2002=#2002-#1\n"));
  CHECK(holds(bench.svg, "after a miss"));
  CHECK(fails(away + "#1=#5061+3.\n" + tolerance + "#4=#1/2.\n#[5201+20]=#5221+#4\n"));
  CHECK(fails(away + "#1=#5041\n" + tolerance + "G10 L2 P1 X#1\n"));
  CHECK(fails(away + "#101=#5021\nIF[ABS[#101] GT 500.]GOTO91\n#[2000+2]=#101\n"));
  // The end of the block, also by way of a copy; not once the machine has gone on, and not of another axis.
  CHECK(fails(away + "#5241=#5221+#5001+3.\n"));
  CHECK(fails(away + "#1=#5001\n#2=#1\n" + tolerance + "#2002=#2002-#2\n"));
  CHECK_FALSE(fails(away + "G0 X-20.\n#2002=#5001/1000.\n"));
  CHECK_FALSE(fails(away + "#2002=#5002/1000.\n"));
  // Overwritten by a touch, or by a number; of another axis; not written at all.
  CHECK_FALSE(fails(away + "#1=#5061\n" + tolerance + "#1=0.02\n#2002=#2002-#1\n"));
  CHECK_FALSE(fails(std::string(kDown) + "IF[#5003 GT 0]GOTO91\nG31 X5. F50\n#2=#5061\nG0 X-20.\n" + away +
                    "#1=#5061\n" + tolerance + "#2002=#2\n"));
  CHECK_FALSE(fails(away + "#1=#5061\n#3=#5062\n" + tolerance + "#2002=#3\n"));
  CHECK_FALSE(fails(away + "#1=#5061\n" + tolerance));
  // What asks first comes to its alarm.
  const CommandResult asked = bench.run(away + "IF[#5061 GE [#24-.01]]GOTO91\n#2002=#5061\n");
  CHECK(holds(asked.err, "3001"));
  CHECK_FALSE(holds(asked.err, "[miss-written]"));
}

TEST_CASE(
    "miss: a value is followed into a program that sets the offset, and a number of the caller is not") {
  Bench bench("dotek-miss-handed");
  const auto fails = [&](const std::string& caller, const std::string& called) {
    bench.folder.write("m.nc", "O9002\nG90\n" + caller + "M99\nN91 #3000=1(NONE)\nO9003\n" + called +
                                   "M99\nN91 #3000=1(NONE)\n");
    const CommandResult out = runDotek(
        splitArguments("sim m.nc --part part.toml --machine machine.toml --call \"Z-5. X-15.\" --quiet"),
        bench.folder.path());
    CAPTURE(out.err);
    return holds(out.err, "[miss-written]");
  };
  const std::string away = std::string(kAway) + "#1=#5061\nIF[ABS[#1] GT 50.]GOTO91\n";
  CHECK(fails(away + "G65 P9003 C#1\n", "#2002=#3\n"));
  CHECK(fails(away + "#110=#1\nM98 P9003\n", "#2002=#110\n"));
  CHECK_FALSE(fails(away + "G65 P9003 C0.02\n", "#2002=#3\n#1=#3\n"));
  CHECK_FALSE(fails("#4=0.5\n" + away + "G65 P9003 C0.02\n#2002=#4\n", "#4=#3\n"));
  // The locals of the caller are its own again.
  CHECK(fails(away + "G65 P9003 C0.02\n#2002=#1\n", "#1=#3\n"));
}

TEST_CASE("miss: coordinates that are turned or shifted by one fail the run") {
  Bench bench("dotek-miss-shifts");
  const auto fails = [&](const std::string& body) {
    const CommandResult out = bench.run(body);
    CAPTURE(body);
    CAPTURE(out.err);
    const bool found = holds(out.err, "[miss-in-shift]");
    CHECK(holds(bench.svg, "FAIL: SHIFTED WITHOUT A TOUCH") == found);
    return found && out.status == 1;
  };
  const std::string away = std::string(kAway) + "#1=#5061\nIF[ABS[#1] GT 50.]GOTO91\nG0 X-20.\n";
  CHECK(fails(away + "G68 X0 Y0 R[ATAN[#1-2.]/[40.]]\nG69\n"));
  CHECK(fails(away + "#2=#1+3.\nG52 X#2\nG52 X0\n"));
  CHECK(fails(away + "G92 X#1\n"));
  // Where it stopped gets coordinates, and nothing has asked.
  CHECK(fails(std::string(kAway) + "G92 X-3.\n"));
  CHECK(fails(std::string(kAway) + "G4 P100\nG92 X-3. Y0\n"));
  CHECK_FALSE(fails(std::string(kAway) + "G92 Y0\n"));
  CHECK_FALSE(fails(std::string(kAway) + "G0 X-20.\nG92 X-3.\n"));
  CHECK_FALSE(fails(std::string(kAway) + "IF[#5061 GE [#24-.01]]GOTO91\nG92 X-3.\n"));
  CHECK_FALSE(fails("G31 Z#26 F1000\nIF[#5063 GT [#26+.1]]GOTO91\nG31 X5. F50\nG92 X-3.\n")); // it touched
  CHECK_FALSE(fails(away + "G52 X1.5\nG52 X0\n"));
  CHECK_FALSE(fails(away + "#1=2.\nG68 X0 Y0 R#1\nG69\n"));
}

TEST_CASE("miss: one that the program's IF cannot see is reported as that") {
  Bench bench("dotek-miss-unseen");
  const auto unseen = [&](const std::string& body) {
    const CommandResult out = bench.run(body);
    CAPTURE(out.err);
    CHECK(out.status == 0);
    const bool told = holds(out.err, "[miss-not-seen]");
    CHECK(holds(bench.svg, ">PASS, A MISS NOT SEEN<") == told);
    CHECK(holds(bench.html, "<strong>PASS, A MISS NOT SEEN</strong>") == told);
    return told;
  };
  // Z goes from 15 to -5. A limit that no place of the move meets, of a variable that holds something else.
  const std::string down = kDown;
  CHECK(unseen("#2=-9000.\n" + down + "IF[#5063-#5083 LT #2]GOTO91\n"));
  CHECK(holds(bench.svg, ">miss (1)<")); // a move that only an IF looks at is drawn as one that measures
  CHECK(unseen("#2=-9000.\n" + down + "#1=#5063\nG0 Z15.\nIF[#1 LE #2]THEN #3000=1(BROKEN)\n"));
  // The IF over the alarm looks at what was set before.
  CHECK(unseen("#2=0\n" + down + "G0 Z15.\nIF[#2 GT 1.]THEN #3000=1(BROKEN)\n"));
  CHECK(unseen("#2=0\n" + down + "G0 Z15.\nIF[#2 GT 1.]GOTO91\n"));
  // Each of these would come out otherwise elsewhere.
  CHECK_FALSE(unseen(down + "IF[#5063-#5083 GT #26+.1]GOTO91\n"));
  CHECK_FALSE(unseen(down + "#1=#5063-#5083\nG0 Z15.\nIF[ABS[#1-#26] LT 0.01]THEN #2=1\n"));
  CHECK_FALSE(unseen(down + "#1=#5063-#5083\nG0 Z15.\nIF[#1 EQ #26]GOTO92\nGOTO91\nN92\n"));
  CHECK_FALSE(unseen(down + "#30=0\nIF[#5063-#5083 GT #26+.1]THEN #30=1\nG0 Z15.\nIF[#30 EQ 1]GOTO91\n"));
  CHECK_FALSE(unseen(down)); // nothing asks: a note, as before

  const CommandResult json =
      bench.run("#2=-9000.\n" + down + "IF[#5063 LT #2]GOTO91\n", "--json --svg run.svg --html run.html");
  CHECK(holds(json.out, "\"outcome\": \"miss\", \"seen\": false"));
  // One that the next move finds was an approach.
  CHECK_FALSE(unseen("#2=0\nG0 Z-5.\nG31 X-15. F1000\nG31 X5. F50\n#1=#5061\nIF[#2 GT 1.]GOTO91\n"));
}

TEST_CASE("miss: a search for the greatest or the least value asks nothing") {
  Bench bench("dotek-miss-extreme");
  const std::string touch = std::string(kDown) + "#9=#5063-#5083\nG0 Z15.\n";
  for (const std::string search :
       {"IF[#9 GT #22]THEN #22=#9\n", "IF[#22 LT #9]THEN #22=#9\n",
        "IF[#9 LE #22]GOTO5\n#22=#9\n#23=#4\nN5\n", "IF[ABS[#9] GT #22]THEN #22=ABS[#9]\n",
        "IF[#9 GT #22]GOTO4\nGOTO5\nN4 #22=#9\nN5\n"}) {
    CAPTURE(search);
    CHECK(bench.fails("#22=-99.\n#4=1\n" + touch + search + "#131=#22\n"));
  }
  CHECK(bench.fails("#22=-99.\n" + std::string(kDown) +
                    "IF[#5063 GT #22]THEN #22=#5063-#5083\nG0 Z15.\n#131=#22\n"));
  // A flag, an alarm, or a question afterwards is one.
  CHECK(!bench.fails("#22=-99.\n" + touch + "IF[#9 GT #22]THEN #150=1\n"));
  for (const std::string asked :
       {"IF[#9 LT -4.9]GOTO91\n", "IF[#9 GT #22]THEN #22=#9\nIF[#22 LT [#26+0.01]]GOTO91\n"})
    CHECK_FALSE(holds(bench.run("#22=-99.\n" + touch + asked).err, "[miss-measured]"));
}

TEST_CASE("miss: the blind IF is named, and no search beside it") {
  Bench bench("dotek-miss-blind");
  const CommandResult out =
      bench.run("#22=-999.\n#4=0\nWHILE[#4 LT 3]DO1\nG31 Z#26 F1000\n"
                "IF[#5063 LE [#26-1.]]THEN #3000=40(NO CONTACT)\n#9=#5063-#5083\nG0 Z15.\n"
                "IF[#9 GT #22]THEN #22=#9\n#4=#4+1\nEND1\n#131=#22\n");
  CAPTURE(out.err);
  CHECK(holds(out.err, "[miss-not-seen]"));
  CHECK(holds(out.err, "m.nc:7:"));
  CHECK(!holds(out.err, "m.nc:10:"));
}
