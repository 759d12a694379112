// What copied blocks leave in force, program numbers, feeds, stops and the retract plane of the Fanuc back
// end.
#include "FanucHelper.h"

using namespace dotek;
using namespace dotek::tests;

namespace {

using Codes = std::set<std::string>;
using Lines = std::vector<std::string>;

// "G68 X0. R30."
ir::OpaqueBlock copied(const std::string& text) {
  ir::OpaqueBlock out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string digits = text.substr(at + 1, end - at - 1);
    out.words.push_back({text[at], ir::constant(std::stod(digits), {}, digits), {}});
    at = end + 1;
  }
  return out;
}

Emission emitCopied(const Lines& blocks) {
  Maker cycle;
  for (const std::string& block : blocks)
    cycle.add(copied(block));
  return Target().emit(cycle.cycle);
}

Codes codesOf(const Lines& blocks) {
  return emitCopied(blocks).codes();
}

std::string restored(const Emission& emission) {
  const std::size_t at = emission.find("G#");
  REQUIRE(at < emission.texts().size());
  return emission.texts()[at];
}

} // namespace

TEST_CASE("fanuc copied: a tool length stays as demanded, and the header says that its number changed") {
  const Emission out = emitCopied({"G43 H2."});
  CHECK(out.codes().empty());
  CHECK(out.find("CHANGES THAT ARE NOT PUT BACK: G43") < out.texts().size());
}

TEST_CASE("fanuc copied: what a bare code cannot put back is refused") {
  const Codes refused = {"mode-not-restored"};
  CHECK(codesOf({"G49"}) == refused);
  CHECK(codesOf({"G44 H2."}) == refused);
  CHECK(codesOf({"H3"}) == refused);
  CHECK(codesOf({"G41 D1"}) == refused);
  CHECK(codesOf({"G68 X0. Y0. R30."}) == refused);
  CHECK(codesOf({"G51 X0. Y0. P2000"}) == refused);
  CHECK(codesOf({"G52 Y5."}) == refused);
  CHECK(codesOf({"G92 X0."}) == refused);
  CHECK(codesOf({"G81 Z-5. R2."}) == refused);
  CHECK(codesOf({"G51.1 X0."}) == refused);
  CHECK(codesOf({"G0 G90 G40 G49 G80", "T5 M6"}) == refused);
  // The message names the path out.
  CHECK(emitCopied({"G68 X0. Y0. R30."}).all().find("write `G69`") != std::string::npos);
}

TEST_CASE("fanuc copied: a rotation by what was measured is what the cycle leaves") {
  const auto turned = [](ir::ExpressionPtr angle, bool moves) {
    Maker cycle;
    ir::OpaqueBlock block = copied("G68 X0. Y0. R30.");
    block.words[3].value = std::move(angle);
    cycle.add(std::move(block));
    if (moves) cycle.move(ir::Motion::Rapid, ir::Axis::X, number(5));
    return Target().emit(cycle.cycle);
  };
  const ir::ExpressionPtr read = ir::machineVariable(number(547));
  CHECK(turned(read, false).codes().empty());
  CHECK(turned(read, false).holds("CHANGES THAT ARE NOT PUT BACK: G68"));
  CHECK(turned(minus(number(0), read), false).codes().empty());
  CHECK(turned(read, true).codes() == Codes{"mode-not-restored"}); // the move would be turned
  CHECK(turned(number(30), false).codes() == Codes{"mode-not-restored"});
}

TEST_CASE("fanuc copied: a control whose dwell takes P gets whole milliseconds") {
  const auto dwell = [](ir::ExpressionPtr seconds, const char* control) {
    Maker cycle;
    cycle.add(ir::Dwell{std::move(seconds)});
    return Target("inspection-plus", control).emit(cycle.cycle);
  };
  CHECK(dwell(number(0.5), "fanuc-31i-b").holds("G4 X0.5"));
  CHECK(dwell(number(0.5), "haas-ngc").holds("G4 P500"));
  CHECK(dwell(ir::machineVariable(number(500)), "fanuc-31i-b").holds("G4 X#500"));
  CHECK(dwell(ir::machineVariable(number(500)), "haas-ngc").codes() == Codes{"dwell-computed"});
}

TEST_CASE("fanuc copied: what ends as the caller provides it is not refused") {
  CHECK(codesOf({"G68 X0. Y0. R30.", "G69"}).empty());
  CHECK(codesOf({"G51 X0. Y0. P2000", "G50"}).empty());
  CHECK(codesOf({"G41 D1", "G40"}).empty());
  CHECK(codesOf({"G81 Z-5. R2.", "G80"}).empty());
  CHECK(codesOf({"G40 G80 G69 G50"}).empty());
  CHECK(codesOf({"G52 X5. Y5.", "G52 X0. Y0."}).empty());
  CHECK(codesOf({"G52 X5. Y5.", "G52 X0."}) == Codes{"mode-not-restored"}); // Y stays
  CHECK(codesOf({"G69", "G68 R30."}) == Codes{"mode-not-restored"});
  CHECK(codesOf({"G28 Z0.", "G10 L2 P1 X0. H1"}).empty());
  Maker cycle;
  cycle.add(copied("G41 D1"));
  cycle.add(ir::SetMode{ir::Mode::CutterCompOff, nullptr});
  CHECK(Target().emit(cycle.cycle).codes().empty());
}

TEST_CASE("fanuc copied: G10 with other words than both controls are known to read alike names them") {
  const auto toAnother = [](const std::string& block, bool computed) {
    Maker cycle;
    const VariableId system = cycle.field("WCS", 54, ir::Kind::WorkOffset);
    ir::OpaqueBlock given = copied(block);
    if (computed) given.words[2].value = minus(use(system), number(53));
    cycle.add(std::move(given));
    return Target("inspection-plus", "fanuc-31i-b").emit(cycle.cycle);
  };
  CHECK(toAnother("G10 L2 P2 Z5.", false).codes().empty());
  CHECK(toAnother("G10 L20 P2 Y5.", false).codes().empty());
  CHECK(toAnother("G90 G10 L2 P2 Z5.", false).codes().empty());
  CHECK(toAnother("G91 G10 L2 P2 Z5.", false).codes().empty());
  CHECK(toAnother("G17 G10 L2 P2 Z5.", false).codes() == Codes{"data-input-refused"});
  CHECK(toAnother("G10 L11 P2 R5.", false).codes().empty());
  const Emission computed = toAnother("G10 L2 P2 Y5.", true);
  CHECK(computed.codes() == Codes{"data-input-refused"});
  CHECK(computed.all().find("`P` is computed") != std::string::npos);
  CHECK(computed.all().find("`#[5222+20*[n-54]]=`") != std::string::npos);
  CHECK(toAnother("G10 L2 P0 Y5.", false).all().find("it has `P0`") != std::string::npos);
  CHECK(toAnother("G10 L20 P60 Y5.", false).all().find("it has `L20`") != std::string::npos);
  CHECK(toAnother("G10 L12 P2 R5.", false).all().find("take the block out") != std::string::npos);
}

TEST_CASE("fanuc copied: G10 of a listed work offset is read alike by both controls") {
  const auto toAnother = [](const std::vector<double>& offered, double base) {
    Maker cycle;
    const VariableId field = cycle.field("WCS", 54),
                     system = cycle.cycle.add(named("system", ir::Role::Local, ir::Kind::Number));
    cycle.cycle.checks.push_back(statement(ir::Assign{system, minus(use(field), number(base))}));
    ir::OpaqueBlock given = copied("G10 L2 P2 Y5.");
    given.words[2].value = use(system);
    cycle.add(std::move(given));
    Target target("inspection-plus", "fanuc-31i-b");
    for (const double value : offered)
      target.options.choices[field].push_back({value, ""});
    return target.emit(cycle.cycle);
  };
  const Emission listed = toAnother({54, 55, 59}, 53);
  CHECK(listed.codes().empty());
  CHECK_MESSAGE(listed.holds("G10 L2 P#"), listed.all());
  CHECK(toAnother({}, 53).codes() == Codes{"data-input-refused"});
  CHECK(toAnother({54, 60}, 53).codes() == Codes{"data-input-refused"});   // P7
  CHECK(toAnother({54, 55}, 54).codes() == Codes{"data-input-refused"});   // P0: the external offset
  CHECK(toAnother({54.5, 55}, 53).codes() == Codes{"data-input-refused"}); // P1.5
}

TEST_CASE("fanuc copied: one path through the branch is enough to refuse") {
  Maker cycle;
  const VariableId a = cycle.field("a", 1);
  const ir::LabelId over = cycle.cycle.addLabel({"over", {}});
  cycle.add(copied("G68 R30."));
  cycle.add(ir::Branch{ir::compare(Relation::Less, use(a), number(0)), over});
  cycle.add(copied("G69"));
  cycle.add(ir::Label{over});
  cycle.move(ir::Motion::Rapid, ir::Axis::X, use(a));
  CHECK(Target().emit(cycle.cycle).codes() == Codes{"mode-not-restored"});
}

TEST_CASE("fanuc copied: groups that a bare code puts back are kept") {
  const auto words = [](const std::string& line) { return std::count(line.begin(), line.end(), '#'); };
  const auto plain = words(restored(emitCopied({"G30 Z0."}))); // motion, plane, distance, feed mode, F
  CHECK(plain == 5);
  const Emission out = emitCopied({"G55 G61 G98", "G64"});
  CHECK(words(restored(out)) == plain + 3); // work system, 15, 10; a group once
  CHECK(out.holds("=#4014"));
  CHECK(out.holds("=#4015"));
  CHECK(out.holds("=#4010"));
  CHECK(words(restored(emitCopied({"G18 G91 G95 G2 X1. R5."}))) == plain);
  // The caller is in G54 to G59, which an alarm makes sure.
  const Emission extended = emitCopied({"G54.1 P2"});
  CHECK(extended.holds("=#4014"));
  CHECK(extended.codes().empty());
}

TEST_CASE("fanuc copied: a further work system has another code on the Haas") {
  const auto emitted = [](const Lines& blocks) {
    Maker cycle;
    for (const std::string& block : blocks)
      cycle.add(copied(block));
    Target target("inspection-plus", "haas-ngc");
    return target.emit(cycle.cycle);
  };
  const Emission out = emitted({"G54.1 P2"});
  CHECK(out.codes().empty());
  CHECK(out.has("G154 P2"));
  CHECK_FALSE(out.holds("G54.1"));
  CHECK(emitted({"G54.1 P21"}).codes().contains("opaque-block-refused")); // by variable it has 20
  CHECK(emitted({"G154 P2"}).codes().contains("opaque-block-refused"));
  CHECK(emitted({"G54.1 P2", "G154 P2"}).codes().contains("opaque-block-refused"));
}

TEST_CASE("fanuc copied: an auxiliary code leaves the probe where it is") {
  const auto emitted = [](const char* block) {
    Maker cycle;
    cycle.move(ir::Motion::Rapid, ir::Axis::X, number(5));
    cycle.add(copied(block));
    cycle.surface(ir::Axis::X, number(10), nullptr, nullptr);
    Target target("inspection-plus");
    stdlib::CodeInfo air;
    air.letter = 'M';
    air.tenths = 1410;
    air.function = stdlib::Function::Auxiliary;
    target.source.codes.push_back(air);
    target.control.codes.push_back(air);
    return target.emit(cycle.cycle);
  };
  CHECK(emitted("M141").has("G65 P9811 X15."));
  CHECK_FALSE(emitted("M77").has("G65 P9811 X15."));
}

TEST_CASE("fanuc copied: what nothing is known of is said") {
  const Emission out = emitCopied({"T5 M6", "M98 P100", "M77"});
  CHECK(out.has("(CHANGES THAT ARE NOT PUT BACK: M6 M98 M77)"));
  CHECK(out.holds("=#4014"));
  CHECK(out.codes().empty());
  CHECK_FALSE(emitCopied({"G30 Z0. M8"}).holds("NOT PUT BACK"));
  const Emission unknown = emitCopied({"G123", "G123"});
  CHECK(unknown.codes() == Codes{"copied-code-unknown"});
  CHECK(unknown.diagnostics.all().size() == 1);
}

TEST_CASE("fanuc copied: no offset is written while a copied code may be in force") {
  const auto measured = [](const Lines& blocks) {
    Maker cycle;
    for (const std::string& block : blocks)
      cycle.add(copied(block));
    cycle.move(ir::Motion::Protected, ir::Axis::X, number(-10), number(500));
    cycle.surface(ir::Axis::X, number(10), number(56), number(1)); // the target is not the nominal
    cycle.add(copied("G69"));
    return Target("inspection-plus").emit(cycle.cycle).codes();
  };
  CHECK(measured({}) == Codes{"probe-not-switched"});
  CHECK(measured({"G68 R30.", "G69"}) == Codes{"probe-not-switched"});
  CHECK(measured({"G68 R30."}).contains("offset-write-unsafe"));
  CHECK(measured({"M98 P100"}).contains("offset-write-unsafe"));
}

TEST_CASE("fanuc: a program takes the number of no macro") {
  const SurfaceCycle cycle;
  const auto codes = [&](std::uint32_t given, std::string_view set) {
    Target target(set);
    target.options.programNumber = given;
    return target.emit(cycle.cycle).codes();
  };
  CHECK(codes(9023, "easyprobe") == Codes{"program-number-taken"});
  CHECK(codes(9770, "easyprobe") == Codes{"program-number-taken"});
  CHECK(codes(9811, "inspection-plus") == Codes{"program-number-taken"});
  CHECK_FALSE(codes(9811, "easyprobe").contains("program-number-taken"));
  CHECK(codes(9000, "easyprobe").contains("program-number-of-code"));
  CHECK(codes(9029, "easyprobe").contains("program-number-of-code"));
  CHECK_FALSE(codes(8999, "easyprobe").contains("program-number-of-code"));
  CHECK_FALSE(codes(9030, "easyprobe").contains("program-number-of-code"));
}

TEST_CASE("fanuc: a feed move without a feed is reported of") {
  Maker cycle;
  cycle.move(ir::Motion::Feed, ir::Axis::X, number(1));
  const Emission out = Target().emit(cycle.cycle);
  CHECK(out.codes() == Codes{"feed-not-stated"});
  CHECK(out.holds("A FEED MOVE STATES NO FEED"));
  Maker stated;
  stated.move(ir::Motion::Rapid, ir::Axis::X, number(0), number(500));
  stated.move(ir::Motion::Feed, ir::Axis::X, number(1));
  CHECK(Target().emit(stated.cycle).codes().empty());
  // A macro leaves another feed after it.
  stated.move(ir::Motion::Protected, ir::Axis::Z, number(1), number(200));
  stated.move(ir::Motion::Feed, ir::Axis::X, number(2));
  CHECK(Target().emit(stated.cycle).codes() == Codes{"feed-not-stated", "probe-not-switched"});
}

TEST_CASE("fanuc: a stop with a message shows it") {
  Maker cycle;
  cycle.add(ir::Stop{false, "Look (here)"});
  cycle.add(ir::Stop{false, ""});
  CHECK(Target().emit(cycle.cycle).body() == Lines{"#3006=1(LOOK HERE)", "M0"});
  Target without;
  without.control.variables.message.reset();
  CHECK(without.emit(cycle.cycle).body() == Lines{"M0", "M0"});
  CHECK(without.emit(cycle.cycle).has("(Look [here])"));
  Maker numbered;
  numbered.add(ir::Stop{false, "Look", 5});
  const Emission kept = Target().emit(numbered.cycle);
  CHECK(kept.body() == Lines{"#3006=5(LOOK)"});
  CHECK(kept.codes().empty());
  const Emission lost = without.emit(numbered.cycle);
  CHECK(lost.body() == Lines{"M0"});
  CHECK(lost.codes() == Codes{"message-number-lost"});
  Maker longer;
  longer.add(ir::Stop{false, "Clean the stylus and the surface"});
  const Emission cut = Target().emit(longer.cycle);
  CHECK(cut.body() == Lines{"#3006=1(CLEAN THE STYLUS AND THE)"});
  CHECK(cut.codes() == Codes{"message-cut"});
}

TEST_CASE("fanuc alarms: the header shows no letter that was dropped") {
  Maker cycle;
  const VariableId a = cycle.field("a", 1);
  cycle.move(ir::Motion::Rapid, ir::Axis::X, use(a));
  cycle.refuseIf(ir::compare(Relation::Less, use(a), number(0)), "a < 0");
  Target target;
  target.options.plainMessages = true;
  const Emission out = target.emit(cycle.cycle);
  CHECK(out.has("(ALARM 100 A 0)"));
  CHECK_FALSE(out.holds("<"));
}
