// What the back end for Mikroprog writes, and what it refuses.
#include "DataFolder.h"
#include "MikroprogHelper.h"
#include "tests/GoldenRunner.h"

using namespace dotek;
using namespace dotek::tests;

namespace {

// A cycle of statements that begin with spindle and coolant at rest.
struct Statements : Maker {
  Statements() {
    cycle.name = "statements";
    add(ir::Spindle{});
    add(ir::Coolant{});
  }
  template <class Node> explicit Statements(Node node) : Statements() { add(std::move(node)); }
};

ir::Move moveOf(ir::Motion motion, ir::Axis axis, ir::Coordinate to) {
  ir::Move out;
  out.motion = motion;
  out.axes[ir::indexOf(axis)] = std::move(to);
  return out;
}

std::set<std::string> codesOf(const ir::Cycle& cycle) {
  return MikroprogTarget().emit(cycle).codes();
}

} // namespace

TEST_CASE("mikroprog: the profiles hold every function of the lathe, the mill takes them over") {
  const auto lathe = loadMikroprog("mikroprog-s280"), mill = loadMikroprog("mikroprog-mill");
  for (const auto* control : {&lathe, &mill}) {
    const auto count = [&](char letter) {
      return std::count_if(control->functions.begin(), control->functions.end(),
                           [&](const auto& one) { return one.letter == letter; });
    };
    CHECK(count('G') == 47);
    CHECK(count('M') == 29);
    for (const auto& one : control->functions)
      CHECK_FALSE(one.source.empty());
  }
  for (const auto& one : mill.functions)
    CHECK(one.grade == "inferred");
  CHECK(lathe.find('G', 78)->find('K')->most == 3.0);
  CHECK_FALSE(lathe.find('G', 73)->usable);
  CHECK(lathe.find('G', 18)->start);
  CHECK(mill.find('G', 17)->start);
  CHECK(lathe.find('G', 31)->forbids == "F");
  CHECK(lathe.find('M', 6)->find('T')->use == stdlib::AddressUse::Needed);
  CHECK(lathe.find('G', 31)->find('Y') == nullptr);
  CHECK(mill.find('G', 31)->find('Y') != nullptr);
  CHECK(lathe.question(22) == nullptr);
  CHECK_FALSE(mill.question(10)->assumed);
  CHECK(lathe.find('G', 54)->code() == "G54");
}

TEST_CASE("mikroprog: a profile with a defect does not load") {
  const std::string good(stdlib::DataFiles().find("mikroprog", "mikroprog-s280")->text);
  const auto loads = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    REQUIRE_MESSAGE(at != std::string::npos, from);
    text.replace(at, from.size(), to);
    const DataFolder folder;
    folder.write("mikroprog/mine.toml", text);
    stdlib::DataFiles files;
    Diagnostics diagnostics;
    REQUIRE(files.addFolder(folder.path(), Limits{}, diagnostics));
    try {
      return stdlib::MikroprogControl::load(files, "mine").has_value();
    } catch (const stdlib::DataError&) {
      return false;
    }
  };
  CHECK(loads("schema = 1", "schema = 1"));
  CHECK_FALSE(loads("axes = \"XZ\"", "axes = \"XW\""));
  CHECK_FALSE(loads("diameter = \"X\"", "diameter = \"Y\""));
  CHECK_FALSE(loads("code = \"G1\"", "code = \"G0\""));
  CHECK_FALSE(loads("code = \"G1\"", "code = \"H1\""));
  CHECK_FALSE(loads("use = \"given\"", "use = \"maybe\""));
  CHECK_FALSE(loads("grade = \"observed\"", "grade = \"sure\""));
  CHECK_FALSE(loads("function = \"probe-move\"\n", ""));
  CHECK_FALSE(loads("letter = \"X\"", "letter = \"Y\""));
  CHECK_FALSE(loads("ZDE MA BYT {}", "ZDE"));
  CHECK_FALSE(loads("forbids = \"F\"", "forbids = \"L\""));
  CHECK_FALSE(loads("number = 20", "number = 18"));
  CHECK_FALSE(loads("title = \"rapid move\"", "name = \"rapid move\""));
}

TEST_CASE("mikroprog: a program is ASCII, its jumps have targets, lint finds nothing that is wrong") {
  for (const ir::Axis axis : ir::kAxes) {
    SurfaceCycle cycle(axis);
    // A travel of Z that leads past 0 would need the surface that a path draws.
    cycle.fixAll(axis == ir::Axis::Z ? -40 : 0);
    MikroprogTarget target;
    const auto emission = target.emit(cycle.cycle);
    REQUIRE(emission.lines);
    for (const auto& line : *emission.lines) {
      CHECK(line.text.size() <= 80);
      CHECK(std::all_of(line.text.begin(), line.text.end(), [](char c) { return c >= ' ' && c < 127; }));
    }
    std::set<std::string> findings;
    SourceMap sources;
    readBack(emission.text(), target.control, sources, &findings);
    CHECK(findings.empty());
    const DataFolder folder;
    folder.write("test.suf", emission.text());
    const auto linted = [&](const std::string& ignored) {
      return runDotek({"lint", "test.suf", "--select", "all", "--ignore", ignored}, folder.path()).out;
    };
    CHECK(linted("suf-datum-lasts").empty());
    CHECK(linted("suf-word").find("[suf-datum-lasts]") != std::string::npos);
    CHECK(emission.codes().contains("probe-power-dropped"));
    CHECK(emission.codes().contains("result-dropped"));
  }
}

TEST_CASE("mikroprog: a long program keeps its tails and subprograms after it") {
  Statements long_;
  for (int i = 0; i < 120; ++i)
    long_.move(ir::Motion::Rapid, ir::Axis::X, number(i));
  long_.move(ir::Motion::Protected, ir::Axis::Z, number(5));
  MikroprogTarget target;
  const auto emission = target.emit(long_.cycle);
  REQUIRE(emission.lines);
  CHECK(emission.lines->back().text == "N1390 M30");
  CHECK(emission.has("G23 L1310 O7"));
  SourceMap sources;
  readBack(emission.text(), target.control, sources);
}

TEST_CASE("mikroprog: statements and their functions") {
  Statements list;
  list.add(ir::Dwell{number(1.5)});
  list.add(ir::Stop{false, "Look", 5});
  list.add(ir::SetMode{ir::Mode::PlaneYZ, nullptr});
  list.add(ir::SetMode{ir::Mode::CutterCompOff, nullptr});
  list.move(ir::Motion::Feed, ir::Axis::X, number(1.23456), number(250));
  list.move(ir::Motion::Feed, ir::Axis::X, number(2));
  list.add(ir::Spindle{ir::Spindle::State::CounterClockwise, number(500)});
  list.add(ir::Coolant{ir::Coolant::State::Flood});
  list.add(ir::Alarm{"Bad"});
  const auto emission = MikroprogTarget().emit(list.cycle);
  const std::vector<std::string> wanted = {
      "G17 G90 G94",    "G0 X-10 Y10", "M5",      "M9", "G4 E1.5", "M0",       "G19",      "G40",
      "G1 X1.235 F250", "G1 X2 F250",  "M4 S500", "M8", "M0",      "G27 L990", "G27 L990", "M30"};
  CHECK(emission.blocks() == wanted);
  CHECK(emission.text().find("M0 ;Look") != std::string::npos);
  CHECK(emission.codes().contains("number-rounded"));
  CHECK(emission.codes().contains("message-number-lost"));
}

TEST_CASE("mikroprog: what the control cannot say is refused") {
  const std::set<std::string> cannot = {"mikroprog-cannot"};
  CHECK(codesOf(Statements(ir::SetMode{ir::Mode::WorkSystem, number(56)}).cycle) == cannot);
  CHECK(codesOf(Statements(ir::Stop{true, ""}).cycle) == cannot);
  CHECK(codesOf(Statements(ir::Coolant{ir::Coolant::State::Mist}).cycle) == cannot);
  CHECK(codesOf(Statements(ir::Spindle{ir::Spindle::State::Clockwise, nullptr}).cycle) == cannot);
  CHECK(codesOf(Statements(ir::Store{number(550), number(5)}).cycle) == cannot);
  CHECK(codesOf(Statements(ir::Dwell{ir::machineVariable(number(500))}).cycle) == cannot);
  CHECK(codesOf(
            Statements(moveOf(ir::Motion::Feed, ir::Axis::X, {number(1), ir::Frame::Work, nullptr})).cycle) ==
        cannot);
  CHECK(codesOf(Statements(moveOf(ir::Motion::Rapid, ir::Axis::X, {number(1), ir::Frame::Machine, nullptr}))
                    .cycle) == cannot);
  CHECK(codesOf(Statements(moveOf(ir::Motion::Rapid, ir::Axis::X, {number(1), ir::Frame::Work, number(55)}))
                    .cycle) == cannot);
  CHECK(codesOf(Statements(moveOf(ir::Motion::Rapid, ir::Axis::Z, {number(1), ir::Frame::Here, nullptr}))
                    .cycle) == std::set<std::string>{"position-needed"});
  CHECK(codesOf(Statements(ir::SetMode{ir::Mode::FeedPerRevolution, nullptr}).cycle) ==
        std::set<std::string>{"feed-per-revolution"});
  CHECK(codesOf(Statements(ir::SetMode{ir::Mode::CannedCycleOff, nullptr}).cycle) ==
        std::set<std::string>{"mode-dropped"});
  CHECK(codesOf(Statements(ir::OpaqueBlock{}).cycle) == std::set<std::string>{"opaque-block-refused"});
  const auto opaque = [](std::vector<std::pair<char, int>> words) {
    ir::OpaqueBlock block;
    for (const auto& [letter, value] : words)
      block.words.push_back({letter, number(value), {}});
    return codesOf(Statements(std::move(block)).cycle);
  };
  // The length of the probe is that of M6; D without G41 and G42 changes nothing.
  CHECK(opaque({{'G', 43}, {'H', 1}, {'D', 1}}) == std::set<std::string>{"mode-dropped"});
  CHECK(opaque({{'G', 43}, {'H', 1}}) == std::set<std::string>{"mode-dropped"});
  const std::set<std::string> kept = {"opaque-block-refused"};
  CHECK(opaque({{'G', 43}}) == kept);
  CHECK(opaque({{'G', 44}, {'H', 1}}) == kept);
  CHECK(opaque({{'G', 43}, {'H', 1}, {'Z', 50}}) == kept);
  CHECK(opaque({{'G', 41}, {'D', 1}, {'H', 1}}) == kept);
  Statements branch;
  const ir::LabelId label = branch.cycle.addLabel({"on", {}});
  branch.add(ir::Branch{ir::compare(ir::Relation::Less, ir::machineVariable(number(500)), number(1)), label});
  CHECK(codesOf(branch.cycle) == std::set<std::string>{"flow-refused"});
}

TEST_CASE("mikroprog: questions that are open are refused with their numbers") {
  Statements list;
  ir::Measure bore;
  bore.feature = ir::Feature::Bore;
  bore.diameter = number(30);
  bore.setting.emplace();
  bore.setting->system = number(56);
  bore.setting->nominal = {number(0), number(0), nullptr};
  list.add(bore);
  const auto refused = MikroprogTarget().emit(list.cycle);
  CHECK(refused.codes() == std::set<std::string>{"questions-open"});
  for (const char* number : {"Q7", "Q10", "Q13"})
    CHECK(refused.diagnostics.all().front().message.find(number) != std::string::npos);
  MikroprogTarget some;
  some.options.assumed = {10, 13};
  const auto one = some.emit(list.cycle);
  CHECK(one.diagnostics.all().front().message.find("Q10") == std::string::npos);
  CHECK(one.diagnostics.all().front().message.find("Q7") != std::string::npos);
  some.options.assumed = {7, 10, 13};
  CHECK(some.emit(list.cycle).lines);
  some.options.hosts["tool_radius"] = 15;
  CHECK(some.emit(list.cycle).codes().contains("mikroprog-cannot"));
}

TEST_CASE("mikroprog: a datum of a second work offset would take the place of the first") {
  const auto cycle = [](double first, double second) {
    Maker maker;
    maker.cycle.name = "step";
    maker.add(ir::Spindle{});
    maker.add(ir::Coolant{});
    maker.move(ir::Motion::Protected, ir::Axis::Z, number(-5));
    maker.surface(ir::Axis::X, number(10), number(first), number(0));
    maker.surface(ir::Axis::X, number(10), number(second), number(0));
    return maker.cycle;
  };
  MikroprogTarget target;
  CHECK(target.emit(cycle(54, 54)).lines);
  const auto refused = target.emit(cycle(54, 55));
  CHECK_FALSE(refused.lines);
  CHECK(refused.codes().contains("datum-of-several-systems"));
  target.options.datum = backends::mikroprog::Datum::Operator;
  CHECK(target.emit(cycle(54, 55)).lines);
}

TEST_CASE("mikroprog: spindle and coolant rest before the first probe move, or a warning says so") {
  Maker maker;
  maker.cycle.name = "late";
  maker.move(ir::Motion::Protected, ir::Axis::Z, number(50));
  maker.add(ir::Spindle{});
  const auto emission = MikroprogTarget().emit(maker.cycle);
  CHECK(emission.blocks()[2] == "M5");
  CHECK(emission.codes().contains("moved-before"));
  CHECK(emission.codes().contains("spindle-not-stopped")); // of the coolant
  Maker turning;
  turning.cycle.name = "turning";
  turning.move(ir::Motion::Protected, ir::Axis::Z, number(50));
  turning.add(ir::Spindle{ir::Spindle::State::Clockwise, number(100)});
  turning.add(ir::Spindle{});
  const auto turned = MikroprogTarget().emit(turning.cycle);
  CHECK_FALSE(turned.codes().contains("moved-before"));
  CHECK(turned.codes().contains("spindle-not-stopped"));
  // Each names what its own source has for it.
  const auto text = [](const MikroprogEmission& one) {
    std::string out;
    for (const Diagnostic& d : one.diagnostics.all())
      if (d.code == "spindle-not-stopped") out += d.message + "\n";
    return out;
  };
  CHECK(text(emission).find("write M9 into the branch") != std::string::npos);
  CHECK(text(emission).find("turning") == std::string::npos);
  MikroprogTarget fromFile;
  fromFile.options.cycleFile = true;
  const std::string both = text(fromFile.emit(turning.cycle));
  CHECK(both.find("write `spindle off` before it") != std::string::npos);
  CHECK(both.find("write `coolant off` before it") != std::string::npos);
  CHECK(both.find("branch") == std::string::npos);
}

TEST_CASE("mikroprog: where the start is known, all is off before anything moves") {
  Maker maker;
  maker.cycle.name = "after";
  maker.move(ir::Motion::Rapid, ir::Axis::X, number(20));
  maker.add(ir::Spindle{});
  maker.move(ir::Motion::Protected, ir::Axis::Z, number(50));
  maker.add(ir::Coolant{});
  MikroprogTarget target;
  target.options.hosts["start_z"] = 60;
  const auto emission = target.emit(maker.cycle);
  const std::vector<std::string> blocks = emission.blocks();
  REQUIRE(blocks.size() > 5);
  CHECK(std::vector<std::string>(blocks.begin() + 1, blocks.begin() + 6) ==
        std::vector<std::string>{"M5", "M9", "G23 L910 O7", "G0 X-10 Y10", "G0 X20"});
  CHECK_FALSE(emission.codes().contains("spindle-not-stopped"));
  std::string said;
  for (const Diagnostic& one : emission.diagnostics.all())
    said += one.message + "\n";
  CHECK(said.find("M5 comes before the first move;") != std::string::npos);
  CHECK(said.find("M9 comes before the first probe move;") != std::string::npos);
  // What turns first is the source's own business.
  Maker turning;
  turning.cycle.name = "turning";
  turning.add(ir::Spindle{ir::Spindle::State::Clockwise, number(100)});
  turning.add(ir::Spindle{});
  turning.move(ir::Motion::Protected, ir::Axis::Z, number(50));
  CHECK(target.emit(turning.cycle).blocks()[1] == "G23 L910 O7");
}

TEST_CASE("mikroprog: what a program needs of the operation") {
  SurfaceCycle cycle;
  const auto mill = loadMikroprog("mikroprog-mill"), lathe = loadMikroprog("mikroprog-s280");
  using backends::mikroprog::missingHosts;
  const std::vector<std::string> all = {"tool_radius", "clearance", "overtravel",
                                        "return_feed", "start_x",   "start_y"};
  CHECK(missingHosts(cycle.cycle, mill, {}) == all);
  CHECK(missingHosts(cycle.cycle, lathe, {}).size() == 5);
  CHECK(missingHosts(cycle.cycle, mill, {{"tool_radius", 3}, {"start_y", 1}}).size() == 4);
  CHECK_FALSE(backends::mikroprog::movesY(cycle.cycle));
  CHECK(backends::mikroprog::movesY(SurfaceCycle(ir::Axis::Y).cycle));
  CHECK(backends::mikroprog::shortFileName("surface-x") == "SURFACEX");
  CHECK(backends::mikroprog::shortFileName("a.long.name.xyz") == "ALOMEXYZ");
  CHECK(backends::mikroprog::shortFileName("-") == "CYCLE");
}
