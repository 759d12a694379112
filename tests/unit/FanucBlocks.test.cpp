// Blocks, modes, the probe's switch, alarms and comments of the Fanuc back end.
#include "FanucHelper.h"
#include "backends/common/PlainText.h"

#include <functional>

using namespace dotek;
using namespace dotek::tests;

namespace {

using Lines = std::vector<std::string>;

ir::Move travel(ir::Motion motion, ir::Axis axis, double value, ir::Frame frame) {
  ir::Move out;
  out.motion = motion;
  out.axes[ir::indexOf(axis)] = ir::Coordinate{number(value), frame, nullptr};
  return out;
}

} // namespace

TEST_CASE("fanuc blocks: statements of one block share a line in the source's order") {
  Maker cycle;
  const auto joined = [&](auto node) -> ir::CycleStatement& {
    ir::CycleStatement& out = cycle.add(node);
    out.origin.block = 4;
    out.origin.addresses = "GGXMGF";
    return out;
  };
  joined(ir::SetMode{ir::Mode::WorkSystem, number(54)});
  joined(ir::SetMode{ir::Mode::Absolute, nullptr});
  ir::Move move = travel(ir::Motion::Rapid, ir::Axis::X, -10, ir::Frame::Work);
  move.feed = number(500);
  joined(move);
  joined(ir::Coolant{ir::Coolant::State::Flood});
  cycle.add(ir::Coolant{}).origin.block = 5;
  const Emission out = Target().emit(cycle.cycle);
  checkProgram(out);
  CHECK(out.body() == Lines{"G54 G90 X-10. M8 G0 F500.", "M9"});
  CHECK(out.has("G#33 G#32 G#31 G#30 G#29 F#28"));
}

TEST_CASE("fanuc blocks: distance mode") {
  SUBCASE("travel is absolute where the position is known") {
    Maker cycle;
    cycle.add(travel(ir::Motion::Rapid, ir::Axis::X, -10, ir::Frame::Work));
    cycle.add(travel(ir::Motion::Rapid, ir::Axis::X, 4, ir::Frame::Here));
    CHECK(Target().emit(cycle.cycle).body() == Lines{"G0 X-10.", "G0 X-6."});
  }
  SUBCASE("travel stays travel under G91, and a coordinate does not") {
    Maker cycle;
    cycle.add(ir::SetMode{ir::Mode::Incremental, nullptr});
    cycle.add(travel(ir::Motion::Feed, ir::Axis::X, 4, ir::Frame::Here));
    cycle.add(travel(ir::Motion::Feed, ir::Axis::X, 4, ir::Frame::Work));
    CHECK(Target().emit(cycle.cycle).body() == Lines{"G91", "G1 X4.", "G90 G1 X4.", "G91"});
  }
  SUBCASE("travel from an unknown place is written as travel") {
    Maker cycle;
    const ir::LabelId skip = cycle.cycle.addLabel({"skip", {}});
    const VariableId a = cycle.field("a", 1);
    cycle.add(ir::Branch{ir::compare(Relation::Greater, use(a), number(0)), skip});
    cycle.add(travel(ir::Motion::Rapid, ir::Axis::X, 7, ir::Frame::Work));
    cycle.add(ir::Label{skip});
    cycle.add(travel(ir::Motion::Rapid, ir::Axis::X, 4, ir::Frame::Here));
    CHECK(Target().emit(cycle.cycle).body() ==
          Lines{"IF[#1 GT 0.]GOTO 10", "G0 X7.", "N10 G91 G0 X4.", "G90"});
  }
}

TEST_CASE("fanuc blocks: frames that moves cannot have") {
  Maker machine;
  machine.add(travel(ir::Motion::Rapid, ir::Axis::Z, 0, ir::Frame::Machine));
  CHECK(Target().emit(machine.cycle).has("G53 G0 Z0."));
  Maker feed;
  feed.add(travel(ir::Motion::Feed, ir::Axis::Z, 0, ir::Frame::Machine));
  CHECK(Target().emit(feed.cycle).codes() == std::set<std::string>{"frame-refused"});
  Maker guarded;
  guarded.add(travel(ir::Motion::Protected, ir::Axis::Z, 0, ir::Frame::Machine));
  CHECK(Target().emit(guarded.cycle).codes().contains("frame-refused"));
  Maker contact;
  ir::Move move = travel(ir::Motion::Feed, ir::Axis::X, 1, ir::Frame::Work);
  move.point = ir::ProbePoint::Contact;
  contact.add(move);
  CHECK(Target().emit(contact.cycle).codes() == std::set<std::string>{"frame-refused"});
}

TEST_CASE("fanuc blocks: codes come from the control's table") {
  Maker cycle;
  cycle.add(ir::Spindle{ir::Spindle::State::Clockwise, number(1000)}).origin.addresses = "SM";
  cycle.add(ir::Dwell{number(0.5)});
  cycle.add(ir::Stop{true, "Check (it)"});
  const Emission out = Target().emit(cycle.cycle);
  checkProgram(out);
  CHECK(out.body() == Lines{"S1000 M3", "G4 X0.5", "M1"});
  CHECK(out.has("(Check [it])"));
  Maker mist;
  mist.add(ir::Coolant{ir::Coolant::State::Mist});
  CHECK(Target("easyprobe", "fanuc-6m").emit(mist.cycle).codes() == std::set<std::string>{"no-code"});
  Maker turn;
  turn.add(ir::SetMode{ir::Mode::FeedPerRevolution, nullptr});
  CHECK(Target().emit(turn.cycle).codes() == std::set<std::string>{"feed-per-revolution"});
}

TEST_CASE("fanuc blocks: switching the probe") {
  SurfaceCycle cycle;
  CHECK(Target("easyprobe", "fanuc-31i-b").emit(cycle.cycle).codes().contains("no-probe-code"));
  std::erase_if(cycle.cycle.body, [](const ir::CycleStatement& statement) {
    return std::holds_alternative<ir::ProbePower>(statement.node);
  });
  SUBCASE("a source that never switches it on is reported") {
    const Emission out = Target().emit(cycle.cycle);
    CHECK(out.codes().contains("probe-not-switched"));
    CHECK(out.holds("DOES NOT SWITCH THE PROBE ON"));
    CHECK_FALSE(out.holds("M31"));
  }
  SUBCASE("or it is added") {
    Target target("inspection-plus");
    target.options.probePower = backends::fanuc::ProbePowerMode::Macro;
    const Emission out = target.emit(cycle.cycle);
    CHECK_FALSE(out.codes().contains("probe-not-switched"));
    CHECK(out.body().front() == "G65 P9832");
    CHECK(out.body().back() == "G65 P9833");
  }
  SUBCASE("but not where the source does it") {
    cycle.add(ir::ProbePower{true});
    Target target;
    target.options.probePower = backends::fanuc::ProbePowerMode::Macro;
    const Lines body = target.emit(cycle.cycle).body();
    CHECK(std::count(body.begin(), body.end(), "M31") == 1);
    CHECK(body.back() == "M32");
  }
}

TEST_CASE("fanuc blocks: a block without a meaning is copied to a control that has its codes") {
  Maker cycle;
  ir::OpaqueBlock block;
  block.words.push_back({'N', ir::constant(90, {}, "90"), {}});
  block.words.push_back({'G', ir::constant(30, {}, "30"), {}});
  block.words.push_back({'Z', ir::constant(0, {}, "0."), {}});
  cycle.add(block);
  const Emission out = Target().emit(cycle.cycle);
  CHECK(out.body() == Lines{"G30 Z0."});
  CHECK(out.codes().empty()); // the lowering has given it
  CHECK(Target("easyprobe", "fanuc-31i-b").emit(cycle.cycle).body() == Lines{"G30 Z0."});
  cycle.cycle.body.clear();
  block.words[1].value = ir::constant(10, {}, "10");
  cycle.add(block);
  CHECK(Target("easyprobe", "fanuc-31i-b").emit(cycle.cycle).codes() ==
        std::set<std::string>{"data-input-refused"});
}

TEST_CASE("fanuc blocks: jumps, loops and the end") {
  Maker cycle;
  const VariableId n = cycle.field("n", 3, ir::Kind::Count);
  const VariableId i = cycle.cycle.add(local("i"));
  const ir::LabelId top = cycle.cycle.addLabel({"top", {}}), out = cycle.cycle.addLabel({"out", {}});
  cycle.add(ir::Assign{i, number(1)});
  cycle.add(ir::Label{top});
  cycle.add(ir::Branch{ir::compare(Relation::Greater, use(i), use(n)), out});
  cycle.move(ir::Motion::Rapid, ir::Axis::X, ir::binary(BinaryOp::Multiply, use(i), number(10)));
  cycle.add(ir::Assign{i, plus(use(i), number(1))});
  cycle.add(ir::Jump{top});
  cycle.add(ir::Label{out});
  cycle.add(ir::Return{});
  cycle.add(ir::Coolant{});
  const Emission emission = Target().emit(cycle.cycle);
  checkProgram(emission);
  CHECK(emission.body() == Lines{"#28=1.", "N10 IF[#28 GT #1]GOTO 20", "G0 X[#28*10.]", "#28=#28+1.",
                                 "GOTO 10", "N20 GOTO 30", "M9"});
  CHECK(emission.has("N30 G#33 G#32 G#31 G#30 F#29"));
  // The number of touches decides on moves: no default is taken.
  CHECK(emission.holds("(ARGUMENT A MISSING)"));
}

TEST_CASE("fanuc blocks: a helper of a loop is no place for a value that stays") {
  Maker cycle;
  const VariableId d = cycle.field("d", 1);
  const VariableId late = cycle.cycle.add(local("late"));
  const ir::LabelId top = cycle.cycle.addLabel({"top", {}});
  cycle.add(ir::Label{top});
  cycle.move(ir::Motion::Rapid, ir::Axis::X, ir::unary(UnaryOp::Round, use(d)));
  cycle.add(ir::Assign{late, number(7)});
  cycle.add(ir::Branch{ir::compare(Relation::Less, use(d), use(late)), top});
  const Emission out = Target().emit(cycle.cycle);
  CHECK(out.has("N10 #28=ROUND[#7]"));
  CHECK(out.has("#27=7."));
}

TEST_CASE("fanuc blocks: sequence numbers that run out") {
  Maker cycle;
  Target target;
  target.control.sequenceLast = 3;
  const VariableId a = cycle.field("a", 1);
  for (int i = 0; i < 4; ++i) {
    const ir::LabelId next = cycle.cycle.addLabel({"next", {}});
    cycle.add(ir::Branch{ir::compare(Relation::Equal, use(a), number(i)), next});
    cycle.add(ir::Coolant{});
    cycle.add(ir::Label{next});
  }
  CHECK(target.emit(cycle.cycle).codes() == std::set<std::string>{"too-many-jumps"});
  target.control.sequenceLast = 4; // steps of 1 where steps of 10 do not fit
  CHECK(target.emit(cycle.cycle).holds("N4 "));
}

TEST_CASE("fanuc alarms: text") {
  const auto alarm = [](std::string message, bool plain = false) {
    Maker cycle;
    cycle.refuseIf(ir::compare(Relation::Less, use(cycle.field("a", 1)), number(0)), std::move(message));
    Target target;
    target.options.plainMessages = plain;
    return target.emit(cycle.cycle);
  };
  CHECK(alarm("Hodnota (a) - 1/2!").holds("#3000=100(HODNOTA A - 1/2)"));
  CHECK(alarm("").holds("#3000=100(VALUES REFUSED)"));
  const Emission cut = alarm("Prilis mala hodnota najezdu v ose X");
  CHECK(cut.holds("#3000=100(PRILIS MALA HODNOTA)"));
  CHECK(cut.has("(PRILIS MALA HODNOTA NAJEZDU V OSE X)"));
  CHECK(cut.codes() == std::set<std::string>{"message-cut"});
  CHECK(alarm("P\xC5\x99\xC3\xADli\xC5\xA1").codes() == std::set<std::string>{"message-characters"});
  CHECK(alarm("a < 0").codes() == std::set<std::string>{"message-characters"});
  CHECK(alarm("P\xC5\x99\xC3\xADli\xC5\xA1", true).holds("#3000=100(PRILIS)"));
}

TEST_CASE("fanuc alarms: numbers of the source first, and not too many") {
  Maker cycle;
  const VariableId a = cycle.field("a", 1);
  cycle.move(ir::Motion::Rapid, ir::Axis::X, use(a));
  for (int i = 0; i < 3; ++i)
    cycle.refuseIf(ir::compare(Relation::Less, use(a), number(-i)), "M" + std::to_string(i));
  Target target;
  const Emission out = target.emit(cycle.cycle);
  CHECK(out.holds("#3000=102(M2)"));
  CHECK(out.holds("#3000=103(ARGUMENT A MISSING)"));
  target.control.alarmLast = 102;
  CHECK(target.emit(cycle.cycle).codes() == std::set<std::string>{"too-many-alarms"});
}

TEST_CASE("fanuc comments: ASCII, with square brackets for round ones") {
  Maker cycle;
  cycle.add(ir::Comment{"M\xC4\x9B\xC5\x99"
                        "en\xC3\xAD (osa X) 100%"});
  const Emission out = Target().emit(cycle.cycle);
  checkProgram(out);
  CHECK(out.has("(Mereni [osa X] 100)"));
  CHECK(out.codes() == std::set<std::string>{"comment-plain"});
  Maker plain;
  plain.add(ir::Comment{"OSA X"});
  CHECK(Target().emit(plain.cycle).codes().empty());
}

TEST_CASE("fanuc header: ranges that the checks allow") {
  const auto range = [](const std::function<void(Maker&, VariableId)>& checks) {
    Maker cycle;
    const VariableId a = cycle.field("a", 5);
    cycle.move(ir::Motion::Rapid, ir::Axis::X, use(a));
    checks(cycle, a);
    const auto texts = Target().emit(cycle.cycle).texts();
    for (const std::string& text : texts)
      if (text.starts_with("(A #1 A")) return text.substr(text.find("GIVE") + 4);
    return std::string("no row");
  };
  const auto less = [](VariableId a, double b) { return ir::compare(Relation::Less, use(a), number(b)); };
  const auto more = [](VariableId a, double b) { return ir::compare(Relation::Greater, use(a), number(b)); };
  CHECK(range([](Maker&, VariableId) {}) == ")");
  CHECK(range([&](Maker& m, VariableId a) {
          m.refuseIf(less(a, 1), "low");
          m.refuseIf(more(a, 9.5), "high");
        }).find(" 1 TO 9.5)") != std::string::npos);
  CHECK(range([&](Maker& m, VariableId a) { m.refuseIf(less(a, 1), "low"); }).find(" FROM 1)") !=
        std::string::npos);
  CHECK(range([&](Maker& m, VariableId a) {
          m.refuseIf(ir::compare(Relation::GreaterEqual, use(a), number(9)), "high");
        }).find(" BELOW 9)") != std::string::npos);
  // Two intervals, and one that depends on another argument.
  CHECK(range([&](Maker& m, VariableId a) {
          m.refuseIf(ir::join(ir::Connective::And, more(a, 1), less(a, 3)), "between");
        }).find("SEE ALARMS") != std::string::npos);
  CHECK(range([&](Maker& m, VariableId a) {
          const VariableId b = m.field("b", 0);
          m.refuseIf(ir::compare(Relation::Less, use(a), use(b)), "below b");
        }).find("SEE ALARMS") != std::string::npos);
}

TEST_CASE("plain text: accents, folding") {
  using namespace dotek::backends;
  CHECK(plainText("Pr\xC5\xAFm\xC4\x9B"
                  "r \xC3\x98 5 \xE2\x80\x93 6")
            .text == "Prumer O 5 - 6");
  CHECK(plainText("e\xCC\x81"
                  "")
            .text == "e");
  CHECK(plainText("\xE4\xBD\xA0").lost);
  CHECK_FALSE(plainText("abc").changed);
  CHECK(plainText("a\tb").text == "a b");
  CHECK(wrapWords("one two three", 7) == Lines{"one two", "three"});
  CHECK(wrapWords("abcdefgh", 3) == Lines{"abc", "def", "gh"});
  CHECK(wrapWords("  ", 3).empty());
}
