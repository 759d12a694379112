// Jobs of Autodesk: records, what a post is given for them, and where reading stops.
#include "posts/Cnc.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"
#include "tests/unit/CncWriter.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace dotek;
using namespace dotek::tests;
namespace cnc = dotek::posts::cnc;

namespace {

// Prints each call of the engine, as the post of Autodesk that dumps a job does.
constexpr std::string_view kDump =
    R"JS(capabilities = CAPABILITY_MILLING | CAPABILITY_TURNING | CAPABILITY_JET;
allowedCircularPlanes = undefined;
function say(name, list) { writeln(name + " " + Array.prototype.slice.call(list).join(" ")); }
function onOpen() { writeln("open"); }
function onParameter(name, value) { writeln(name + "=" + value + (typeof value == "number" ? "" : " (text)")); }
function onSection() {
  writeln("section offset " + currentSection.workOffset + " forward " + currentSection.workPlane.forward);
  writeln("tool " + [tool.number, tool.diameter, tool.taperAngle, tool.clockwise, tool.type == TOOL_DRILL,
    tool.coolant == COOLANT_FLOOD, tool.description, tool.holderLength, tool.holderDiameter].join(" "));
}
function onRapid() { say("rapid", arguments); }
function onLinear() { say("linear", arguments); }
function onCircular() { say("circular", arguments); writeln("full " + isFullCircle() + " plane " + getCircularPlane()); }
function onRapid5D() { say("rapid5", arguments); }
function onLinear5D() { say("linear5", arguments); }
function onMovement(now) { writeln("movement " + (now == MOVEMENT_LEAD_IN ? "lead in" : now == MOVEMENT_RAPID ? "rapid" : "other")); }
function onRadiusCompensation() { writeln("compensation " + (radiusCompensation == RADIUS_COMPENSATION_LEFT ? "left" : radiusCompensation == RADIUS_COMPENSATION_RIGHT ? "right" : "off")); }
function onCommand(command) { writeln(command == COMMAND_OPTIONAL_STOP ? "optional stop" : command == COMMAND_POWER_ON ? "power" : "command"); }
function onPower(on) { writeln("on " + on); }
function onComment(text) { writeln("(" + text + ")"); }
function onPassThrough(text) { writeln("<" + text + ">"); }
function onDwell(seconds) { writeln("dwell " + seconds); }
function onSpindleSpeed(rpm) { writeln("rpm " + rpm); }
function onCycle() { writeln("cycle " + cycleType + " bottom " + cycle.bottom + " dwell " + cycle.dwell + " clearance " + cycle.clearance); }
function onCyclePoint(x, y, z) { say("point", arguments); }
function onCycleEnd() { writeln("cycle end"); }
function onSectionEnd() { writeln("section end"); }
function onClose() { writeln("close"); }
)JS";

CommandResult run(const std::string& bytes) {
  const TestFolder folder("dotek-cnc");
  folder.write("dump.cps", kDump);
  folder.write("job.cnc", bytes);
  return runDotek({"run-post", "dump.cps", "job.cnc"}, folder.path());
}

bool holds(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

CncWriter drilled() {
  CncWriter out;
  out.text("http://www.cimco-software.com/namespace/nc/parameter/product-id", "fusion360")
      .integer("leads-supported", 1);
  out.word(14).singles({-50, -25, -51, 50, 25, 0});
  out.operation("drill", {}, {1, 3, 1, 1, 4.2, 118, 5000, 0});
  return out;
}

} // namespace

TEST_CASE("cnc: names, texts and numbers of the records are those of the file") {
  CncWriter file;
  const std::size_t first = file.size();
  file.text("operation:context", "M\xfcnze")
      .wide("autodeskcam:path", u"\u00d8\\\U0001F600")
      .integer("kind", -2);
  file.number("tolerance", 0.01).word(14).singles({-1, -2, -3.5, 1, 2, 0});
  const auto read = cnc::read(file.bytes());
  REQUIRE(std::holds_alternative<cnc::File>(read));
  const auto& records = std::get<cnc::File>(read).records;
  REQUIRE(records.size() == 6);
  CHECK(std::get<cnc::File>(read).version == std::array<std::uint8_t, 3>{2, 1, 0});
  CHECK(records[1].offset == first);
  const auto named = [&](std::size_t i) { return std::get<cnc::Named>(records[i].value); };
  CHECK(named(1).name == "operation:context");
  CHECK(std::get<std::string>(named(1).value) == "M\xc3\xbcnze");
  CHECK(std::get<std::string>(named(2).value) == "\xc3\x98\\\xf0\x9f\x98\x80");
  CHECK(std::get<std::int32_t>(named(3).value) == -2);
  CHECK(std::get<double>(named(4).value) == 0.01);
  CHECK(std::get<cnc::Box>(records[5].value).lower == cnc::Single3{-1, -2, -3.5});
}

TEST_CASE("cnc: an unknown record stops with its offset and its code") {
  CncWriter file;
  file.integer("leads-supported", 1);
  const std::size_t offset = file.size();
  file.word(4711).words(3);
  const auto read = cnc::read(file.bytes());
  REQUIRE(std::holds_alternative<cnc::Fault>(read));
  CHECK(std::get<cnc::Fault>(read).offset == offset);
  CHECK(std::get<cnc::Fault>(read).text == "record 4711 is not known to Dotek");
  const CommandResult result = run(file.bytes());
  CHECK(result.status == 1);
  CHECK(result.out.empty());
  CHECK(
      holds(result.err, fmt::format("`job.cnc` is not read beyond byte {}: record 4711 is not known to Dotek "
                                    "[cnc-unread]",
                                    offset)));
}

TEST_CASE("cnc: a post is given the parameters, moves and cycles in the order of the engine") {
  CncWriter file = drilled();
  file.rapid(-25, 10, 15).cycle("http://www.autodesk.com/namespace/nc/cycle/drilling");
  file.length("clearance", 5).length("retract", 4).length("stock", -1).length("depth", 16.26180648803711);
  file.length("feedrate", 400)
      .linear(-25, 10, -17.26180648803711, 400, 2, 1)
      .linear(25, 10, -17.2618, 400, 2, 2);
  file.cycleEnd().rapid(25, 10, 15).end();
  const CommandResult result = run(file.bytes());
  CHECK(result.err.empty());
  CHECK(result.status == 0);
  CHECK(result.out == "open\n"
                      "product-id=fusion360 (text)\n"
                      "leads-supported=1\n"
                      "notes= (text)\n"
                      "operation-strategy=drill (text)\n"
                      "operation-comment=Bohrung \xc3\x98 (text)\n"
                      "operation:tolerance=0.01\n"
                      "movement:lead_in=1000\n"
                      "section offset 1 forward (0, 0, 1)\n"
                      "tool 3 4.2 2.059488517353309 true true true cutter 5 30\n"
                      "rapid -25 10 15\n"
                      "clearance=5\n"
                      "retract=4\n"
                      "stock=-1\n"
                      "depth=16.26180648803711\n"
                      "feedrate=400\n"
                      "movement other\n"
                      "cycle drilling bottom -17.26180648803711 dwell 0 clearance 5\n"
                      "point -25 10 -17.26180648803711\n"
                      "point 25 10 -17.26180076599121\n"
                      "cycle end\n"
                      "movement rapid\n"
                      "rapid 25 10 15\n"
                      "section end\n"
                      "close\n");
}

TEST_CASE("cnc: movements, compensation, arcs and five axes") {
  CncWriter file;
  file.operation("contour2d", {}, {});
  file.rapid(33, -8.6, 15)
      .linear(33, -8.5, 0, 500, 1, 128)
      .arc(false, {34, -7.5, 0, 33, -7.5, 0, 0, 0, 1}, 500, 1);
  file.arc(true, {34, -7.5, 0, 35, -7.5, 0, 0, 1, 0}, 500, 1).linear(1, 2, 3, 500, 1, 256);
  file.word(121).singles({1, 2, 3, 0, 0.6, 0.8}).word(0);
  file.word(120).singles({2, 2, 3, 0, 0.6, 0.8, 700}).half(8).half(14).word(103).single(900).end();
  const CommandResult result = run(file.bytes());
  CHECK(result.err.empty());
  CHECK(holds(result.out, "rapid 33 -8.600000381469727 15\n"
                          "movement lead in\n"
                          "compensation left\n"
                          "linear 33 -8.5 0 500\n"
                          "compensation off\n"
                          "circular false 33 -7.5 0 34 -7.5 0 500\n"
                          "full false plane 0\n"
                          "circular true 35 -7.5 0 34 -7.5 0 500\n"
                          "full true plane 1\n"
                          "compensation right\n"
                          "linear 1 2 3 500\n"
                          "movement rapid\n"
                          "compensation off\n"
                          "rapid5 1 2 3 0 0.6000000238418579 0.800000011920929\n"
                          "movement other\n"
                          "linear5 2 2 3 0 0.6000000238418579 0.800000011920929 700"));
  CHECK(holds(result.out, "rpm 900\nsection end\n"));
}

TEST_CASE("cnc: what lies between operations comes before the next one, or at the end") {
  CncWriter file;
  file.integer("leads-supported", 1).mark().word(16).latin("mount the vice");
  file.operation("face", {}, {}).rapid(0, 0, 15).command(29).end();
  file.mark().command(2).mark().word(102).single(1.5).word(0).mark().word(200).latin("G4 X1.");
  const CommandResult result = run(file.bytes());
  CHECK(result.err.empty());
  CHECK(holds(result.out, "open\nleads-supported=1\n(mount the vice)\nnotes="));
  CHECK(holds(result.out,
              "rapid 0 0 15\non true\npower\nsection end\noptional stop\ndwell 1.5\n<G4 X1.>\nclose\n"));
}

TEST_CASE("cnc: a work plane is a matrix in the coordinates of its setup") {
  CncWriter file;
  CncWriter::Place place;
  place.plane = {1, 0, 0, 0, 0.8, -0.6, 0, 0.6, 0.8}; // its third column is the axis of the tool
  file.operation("face", place, {}).rapid(0, 0, 15).end();
  CHECK(holds(run(file.bytes()).out, "forward (0, -0.6000000238418579, 0.800000011920929)"));
}

TEST_CASE("cnc: turning says its spindle mode, and when the feed follows the spindle") {
  const auto turned = [](int surface, int perRevolution) {
    CncWriter file;
    file.mark().integer("operation:tool_isTurning", 1);
    file.integer("operation:tool_useConstantSurfaceSpeed", surface);
    file.integer("operation:tool_useFeedPerRevolution", perRevolution);
    file.context({1, 1, 1}).tool({23, 3, 1, 1, 0, 0, 500, 1.5}).begin();
    file.linear(10, 0, 5, 750, 2)
        .command(12)
        .linear(10, 0, -20, 750, 2)
        .command(13)
        .linear(12, 0, -20, 750, 2);
    file.end();
    const TestFolder folder("dotek-cnc");
    folder.write("lathe.cps", "capabilities = CAPABILITY_TURNING;\n"
                              "function onSection() { writeln(tool.getSpindleMode() == "
                              "SPINDLE_CONSTANT_SURFACE_SPEED ? \"G96\" : \"G97\"); }\n"
                              "function onLinear(x, y, z) { writeln((isSpeedFeedSynchronizationActive() ? "
                              "\"G32\" : \"G1\") + \" Z\" + z); }\n");
    folder.write("job.cnc", file.bytes());
    return runDotek({"run-post", "lathe.cps", "job.cnc"}, folder.path());
  };
  CHECK(turned(0, 0).out == "G97\nG1 Z5\nG32 Z-20\nG1 Z-20\n");
  CHECK(turned(1, 0).out == "G96\nG1 Z5\nG32 Z-20\nG1 Z-20\n");
  CHECK(holds(turned(0, 1).err,
              "an operation with feed per revolution: whether its moves hold it is not known"));
}

TEST_CASE("cnc: heights with a place are those of the first point") {
  CncWriter file({2, 4, 0});
  file.operation("drill", {}, {1, 3, 1, 1, 4.2, 118, 5000, 0});
  file.cycle("http://www.cimco-software.com/namespace/nc/cycle/drilling");
  file.word(18).latin("clearance").real(-25).real(10).real(5);
  CncWriter apart = file;
  file.linear(-25, 10, -17, 400, 2, 3).cycleEnd().end();
  CHECK(holds(run(file.bytes()).out, "clearance=5\n"));
  apart.linear(-24, 10, -17, 400, 2, 3).cycleEnd().end();
  CHECK(holds(run(apart.bytes()).err,
              "`clearance` of a cycle lies elsewhere than its first point [cnc-not-run]"));
}

TEST_CASE("cnc: what is not known is refused by name, with its place") {
  const auto refusal = [](const CncWriter& file) {
    const CommandResult result = run(file.bytes());
    CHECK(result.status == 1);
    CHECK(result.out.empty());
    return result.err;
  };
  CncWriter file;
  file.operation("face", {}, {});
  CHECK(holds(refusal(CncWriter(file).command(99).end()), "command 99 is not known to Dotek [cnc-not-run]"));
  CHECK(holds(refusal(CncWriter(file).linear(0, 0, 0, 1, 77).end()),
              "movement 77 is not known to Dotek [cnc-not-run]"));
  CHECK(holds(refusal(CncWriter(file).linear(0, 0, 0, 1, 1, 64).end()),
              "flags 64 of a move are not known to Dotek [cnc-unread]"));
  CHECK(holds(refusal(CncWriter(file)), "the file ends within an operation"));
  CHECK(holds(refusal(CncWriter().rapid(0, 0, 0)), "a move lies outside of the operations"));
  CHECK(holds(refusal(CncWriter().operation("face", {2}, {}).end()),
              "unit 2 of an operation is not known to Dotek"));
  CHECK(holds(refusal(CncWriter().operation("face", {1, 1, 2}, {}).end()),
              "type 2 of an operation is not known to Dotek"));
  CHECK(holds(refusal(CncWriter().operation("face", {}, {77}).end()),
              "tool type 77 (``) is not known to Dotek"));
  CHECK(
      holds(refusal(CncWriter().operation("face", {}, {5, 1, 9}).end()), "coolant 9 is not known to Dotek"));
  CncWriter::Place place;
  place.origin = {200, 0, 51};
  CHECK(holds(refusal(CncWriter().operation("face", place, {}).end()),
              "the work plane has an origin of its own, (200, 0, 51)"));
  CHECK(
      holds(refusal(CncWriter(file).word(140).words(5).end()), "jobs of additive manufacturing are not run"));
}

TEST_CASE("cnc: a tool whose number is in no file is taken by the name of its type") {
  CncWriter file;
  file.mark()
      .text("operation:tool_type", "bull nose end mill")
      .context({})
      .tool({7})
      .begin()
      .rapid(0, 0, 5)
      .end();
  CHECK(run(file.bytes()).status == 0);
}

TEST_CASE("cnc: another version is read, and said") {
  CncWriter file({2, 9, 0});
  file.operation("face", {}, {}).rapid(0, 0, 5).end();
  const CommandResult result = run(file.bytes());
  CHECK(result.status == 0);
  CHECK(holds(result.err, "`job.cnc` is of version 2.9.0, which Dotek has not met"));
  CHECK(holds(result.err, "[cnc-version]"));
}

TEST_CASE("cnc: other commands name the command that takes such a job") {
  const TestFolder folder("dotek-cnc-kind");
  folder.write("job.cnc", drilled().bytes());
  const CommandResult result = runDotek({"lint", "job.cnc"}, folder.path());
  CHECK_MESSAGE(holds(result.out, "(a job of Autodesk's CAM, which `dotek run-post POST.cps JOB.cnc` runs)"),
                result.out);
}

TEST_CASE("cnc: a file that is cut off or damaged anywhere is read or refused, in its size") {
  CncWriter whole = drilled();
  whole.rapid(0, 0, 5).cycle("probing-x").number("depth", 5).linear(0, 0, 0, 1, 2).cycleEnd().end();
  const std::string& bytes = whole.bytes();
  for (std::size_t size = 0; size < bytes.size(); ++size)
    static_cast<void>(cnc::read(bytes.substr(0, size)));
  for (std::size_t at = 0; at + 4 <= bytes.size(); ++at) { // lengths and counts beyond the file
    std::string damaged = bytes;
    damaged.replace(at, 4, "\xff\xff\xff\xff");
    static_cast<void>(cnc::read(damaged));
  }
  CHECK(std::holds_alternative<cnc::File>(cnc::read(bytes)));
  CHECK(cnc::isCnc(bytes));
  CHECK_FALSE(cnc::isCnc("schema = 1\n"));
  CHECK_FALSE(cnc::isCnc(""));
}
