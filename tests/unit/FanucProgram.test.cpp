// Whole programs of the Fanuc back end: layout, folding, macro sets, controls.
#include "FanucHelper.h"

using namespace dotek;
using namespace dotek::tests;

namespace {

// Address and number of each word, whatever zeros and points it is written with.
std::vector<std::string> words(const std::string& line) {
  std::vector<std::string> out;
  if (line.starts_with("(") || line.starts_with("O") || line.find('=') != std::string::npos) return {line};
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t begin = line.find_first_not_of(' ', at);
    if (begin == std::string::npos) break;
    const std::size_t end = std::min(line.find(' ', begin), line.size());
    const std::string word = line.substr(begin, end - begin);
    if (word[0] != 'N') out.push_back(word.substr(0, 1) + std::to_string(std::stod(word.substr(1))));
    at = end;
  }
  return out;
}

std::vector<std::vector<std::string>> wordsOf(const std::vector<std::string>& lines) {
  std::vector<std::vector<std::string>> out;
  for (const std::string& line : lines)
    out.push_back(words(line));
  return out;
}

} // namespace

TEST_CASE("fanuc: a surface for the macro set of the source") {
  const SurfaceCycle cycle;
  const Target target;
  const Emission out = target.emit(cycle.cycle);
  checkProgram(out);
  // Letters: S, X, I and Z fill arguments; Zb has none and gets the first that is free, hosts after it.
  CHECK(out.body() == std::vector<std::string>{"G65 P9770 Z#2", "M5", "M9", "M31", "G65 P9770 Z5. F1000.",
                                               "G65 P9770 Z#26 F200.", "G65 P9023 S#19 X#24 I#4", "#550=#138",
                                               "G0 Z#1 F5000.", "M32"});
  CHECK(out.texts()[1] == "O8000(ONE SURFACE)");
  CHECK(out.codes() == std::set<std::string>{"letter-of-other-field", "message-cut", "protected-move-feed"});
}

TEST_CASE("fanuc: folded with all values it gives the posted blocks") {
  SurfaceCycle cycle;
  cycle.fixAll();
  const Target target;
  const Emission out = target.emit(cycle.cycle);
  checkProgram(out);
  const std::vector<std::string> posted = {"N90 G65 P9770 Z50.",
                                           "N100 M5",
                                           "N110 M9",
                                           "M31",
                                           "N120 G65 P9770 Z5 F1000",
                                           "N130 G65 P9770 Z-5. F200",
                                           "N140 G65 P9023 S56. X10. I0",
                                           "#550=#138",
                                           "N160 G0 Z50. F5000",
                                           "N170 M32"};
  CHECK(wordsOf(out.body()) == wordsOf(posted));
  CHECK(out.has("(NO ARGUMENTS)"));
}

TEST_CASE("fanuc: a bore, folded with all values, gives the posted blocks") {
  Maker cycle;
  const VariableId d = cycle.field("D", 30), i = cycle.field("I", 30), j = cycle.field("J", 30);
  const VariableId g = cycle.field("G", 56, ir::Kind::WorkOffset);
  const VariableId back = cycle.field("Zb", 50), depth = cycle.field("Z", -5);
  cycle.move(ir::Motion::Protected, ir::Axis::Z, number(50));
  cycle.add(ir::Spindle{});
  cycle.add(ir::Coolant{});
  cycle.add(ir::ProbePower{true});
  cycle.move(ir::Motion::Protected, ir::Axis::Z, number(5), number(1000));
  cycle.move(ir::Motion::Protected, ir::Axis::Z, use(depth), number(200));
  ir::Measure measure;
  measure.feature = ir::Feature::Bore;
  measure.diameter = use(d);
  measure.setting = ir::OffsetSetting{use(g), {use(i), use(j), nullptr}};
  cycle.add(measure).origin.addresses = "GPDSIJ";
  cycle.add(ir::Store{number(550), ir::result(ir::ResultName::Main)});
  cycle.move(ir::Motion::Rapid, ir::Axis::Z, use(back), number(5000));
  ir::fold(cycle.cycle, {{d, 30}, {i, 30}, {j, 30}, {g, 56}, {back, 50}, {depth, -5}});
  const Emission out = Target().emit(cycle.cycle);
  checkProgram(out);
  const std::vector<std::string> posted = {"N90 G65 P9770 Z50.",
                                           "N100 M5",
                                           "N110 M9",
                                           "N120 M31",
                                           "N130 G65 P9770 Z5. F1000",
                                           "N140 G65 P9770 Z-5. F200",
                                           "N150 G65 P9023 D30. S56. I30. J30.",
                                           "#550=#138",
                                           "N170 G0 Z50 F5000"};
  CHECK(wordsOf(out.body()) == wordsOf(posted));
  CHECK(out.holds("(THE PROBE STAYS ON)"));
}

TEST_CASE("fanuc: arguments that are omitted, defaults and alarms") {
  const SurfaceCycle cycle;
  Target target;
  SUBCASE("what moves nothing gets its default") {
    const Emission out = target.emit(cycle.cycle);
    CHECK(out.has("IF[#4 EQ #0]THEN #4=0."));
    CHECK(out.has("IF[#19 EQ #0]THEN #19=56."));
    CHECK(out.has("IF[#24 EQ #0]THEN #3000=102(ARGUMENT X MISSING)"));
    CHECK(out.has("IF[#26 EQ #0]THEN #3000=104(ARGUMENT Z MISSING)"));
    CHECK(out.has("IF[#3 EQ #0]THEN #3000=106(ARGUMENT C MISSING)"));
  }
  SUBCASE("--defaults use takes them all, but a host input has none") {
    target.options.defaults = backends::fanuc::Defaults::Use;
    const Emission out = target.emit(cycle.cycle);
    CHECK(out.has("IF[#24 EQ #0]THEN #24=10."));
    CHECK(out.has("IF[#26 EQ #0]THEN #26=-5."));
    CHECK(out.holds("(ARGUMENT B MISSING)"));
    CHECK_FALSE(out.holds("(ARGUMENT X MISSING)"));
  }
}

TEST_CASE("fanuc: the order of the parts") {
  const SurfaceCycle cycle;
  const Emission out = Target().emit(cycle.cycle);
  const std::vector<std::string> parts = {"O8000(",
                                          "(CALL: G65 P8000",
                                          "IF[#24 EQ #0]",
                                          "IF[#4006 NE 21.]",
                                          "(THE WORK OFFSET",
                                          "#3000=101(TRAVEL TOO",
                                          "#33=#4001",
                                          "G90 G94 G17 G40 G80",
                                          "G65 P9770 Z#2",
                                          "G#33",
                                          "M99"};
  std::size_t before = 0;
  for (const std::string& part : parts) {
    const std::size_t at = out.find(part, before);
    CHECK_MESSAGE(at < out.texts().size(), part << " does not follow\n" << out.all());
    before = at;
  }
  CHECK(out.has("G#33 G#32 G#31 G#30 F#29"));
  for (const std::string line : {"#33=#4001", "#32=#4002", "#31=#4003", "#30=#4005", "#29=#4109"})
    CHECK(out.has(line));
}

TEST_CASE("fanuc: a control without IF .. THEN and joined conditions") {
  Maker only;
  only.cycle.name = "six";
  const VariableId g = only.field("G", 56, ir::Kind::WorkOffset);
  only.refuseIf(ir::join(ir::Connective::Or, ir::compare(Relation::Less, use(g), number(54)),
                         ir::compare(Relation::Greater, use(g), number(59))),
                "Wrong");
  only.refuseIf(ir::join(ir::Connective::And, ir::compare(Relation::Greater, use(g), number(55)),
                         ir::compare(Relation::Less, use(g), number(57))),
                "Reserved");
  only.move(ir::Motion::Protected, ir::Axis::Z, number(5));
  const Emission out = Target("inspection-plus", "fanuc-6m").emit(only.cycle);
  checkProgram(out);
  CHECK_FALSE(out.holds("THEN"));
  CHECK_FALSE(out.holds("]AND["));
  CHECK_FALSE(out.holds("]OR["));
  // What is read back: which alarm comes for which value.
  const auto alarmFor = [&](double value) {
    const auto lines = out.texts();
    const auto target = [&](const std::string& text) {
      const std::string label = "N" + text.substr(text.find("GOTO ") + 5) + " ";
      return out.find(label);
    };
    for (std::size_t i = out.find("IF[#1 LT 54.]"); i < lines.size(); ++i) {
      const std::string& text = lines[i];
      if (text.find("(WRONG)") != std::string::npos) return 100;
      if (text.find("(RESERVED)") != std::string::npos) return 101;
      if (text.find("#4001") != std::string::npos) return 0;
      const auto at = text.find("IF[#1 ");
      if (at == std::string::npos) continue;
      const std::string relation = text.substr(at + 6, 2);
      const double other = std::stod(text.substr(at + 9));
      const bool holds = relation == "LT"   ? value < other
                         : relation == "GT" ? value > other
                         : relation == "LE" ? value <= other
                                            : value >= other;
      if (holds) i = target(text) - 1;
    }
    return -1;
  };
  CHECK(alarmFor(53) == 100);
  CHECK(alarmFor(54) == 0);
  CHECK(alarmFor(55) == 0);
  CHECK(alarmFor(56) == 101);
  CHECK(alarmFor(59) == 0);
  CHECK(alarmFor(60) == 100);
}

TEST_CASE("fanuc: what the 6M cannot tell is in the header") {
  SurfaceCycle cycle;
  ir::Measure& touch = std::get<ir::Measure>(cycle.cycle.body[6].node);
  touch.setting.reset();
  const Emission out = Target("inspection-plus", "fanuc-6m").emit(cycle.cycle);
  checkProgram(out);
  // Which group of modal variables holds the work system is not known, so a shift cannot be computed.
  CHECK_FALSE(out.holds("#4014"));
  CHECK_FALSE(out.holds("LOCAL SHIFT ACTIVE"));
  std::string header;
  for (const std::string& text : out.texts())
    if (text.starts_with("(")) header += text.substr(1, text.size() - 2) + " ";
  const std::size_t at = header.find("NOT CHECKED:");
  REQUIRE(at != std::string::npos);
  CHECK(header.find("NO LOCAL SHIFT", at) != std::string::npos);
  CHECK(header.find("NO ROTATION", at) != std::string::npos);
  // Rotation and scaling are options that it may lack: the code itself is asked for.
  CHECK(out.holds("IF[#4016 NE 68.]GOTO "));
}

TEST_CASE("fanuc: every line knows where it comes from") {
  SurfaceCycle cycle;
  SourceMap sources;
  const FileId file = sources.add(SourceFile("post.txt", "one line\n", Encoding::Utf8));
  for (auto* list : {&cycle.cycle.checks, &cycle.cycle.body})
    for (ir::CycleStatement& statement : *list)
      statement.origin.ranges = {{file, 0, 3}};
  const Emission out = Target().emit(cycle.cycle);
  REQUIRE(out.lines);
  for (const auto& line : *out.lines) {
    const bool ours = !line.text.starts_with("(") && line.ranges.empty();
    if (ours) CHECK_MESSAGE(!line.reason.empty(), line.text);
    if (line.text.find("P9023") != std::string::npos) CHECK(line.ranges.size() == 1);
  }
}

TEST_CASE("fanuc: the program number has to fit") {
  const SurfaceCycle cycle;
  Target target;
  target.options.programNumber = 10000;
  CHECK(target.emit(cycle.cycle).codes() == std::set<std::string>{"program-number"});
  target.options.programNumber = 20;
  CHECK(target.emit(cycle.cycle).has("O0020(ONE SURFACE)"));
}

TEST_CASE("fanuc: a path without a measurement says so") {
  Maker cycle;
  cycle.cycle.name = "path";
  cycle.cycle.measurementStated = false;
  const VariableId depth = cycle.field("depth", -3);
  cycle.host("retract");
  cycle.move(ir::Motion::Protected, ir::Axis::Z, use(depth), nullptr, ir::Frame::Retract);
  cycle.move(ir::Motion::Protected, ir::Axis::X, number(4), nullptr, ir::Frame::Start);
  Target target("inspection-plus");
  SUBCASE("the retract plane is handed over, the start is read") {
    const Emission out = target.emit(cycle.cycle);
    checkProgram(out);
    CHECK(out.holds("(THE SOURCE STATES A PATH ONLY"));
    CHECK(out.body() == std::vector<std::string>{"G65 P9810 Z[#2+#1]", "G65 P9810 X[#28+4.]"});
    CHECK(out.has("#28=#5001"));
    CHECK(out.codes() == std::set<std::string>{"probe-not-switched", "protected-move-feed"});
  }
  SUBCASE("or both are fixed, and the start is checked") {
    target.options.fixed = {{"retract", 20}, {"start_x", -10}};
    const Emission out = target.emit(cycle.cycle);
    checkProgram(out);
    CHECK(out.body() == std::vector<std::string>{"G65 P9810 Z[20.+#1]", "G65 P9810 X-6."});
    CHECK(out.has("IF[ABS[#5001+10.] GT 0.01]THEN #3000=101(START NOT AT X-10)"));
  }
  SUBCASE("without a retract plane it is refused") {
    cycle.cycle.variables[1].name = "something";
    CHECK(target.emit(cycle.cycle).codes().contains("retract-unknown"));
  }
}
