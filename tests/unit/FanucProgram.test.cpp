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
  // Letters: S, X, I and Z fill arguments; Zb has none and gets the first that is free, hosts behind it.
  CHECK(out.body() == std::vector<std::string>{"G65 P9770 Z#2", "M5", "M9", "M31", "G65 P9770 Z5. F1000.",
                                               "G65 P9770 Z#26 F200.", "G65 P9023 S#19 X#24 I#4", "#550=#138",
                                               "G0 Z#1 F5000.", "M32"});
  CHECK(out.texts()[1] == "O8000(ONE SURFACE)");
  CHECK(out.codes().empty());
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
  SurfaceCycle cycle;
  const Target target("inspection-plus", "fanuc-6m");
  // No store of a result: the offset cannot be written there, so the target is the nominal.
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
  const Emission out = target.emit(only.cycle);
  checkProgram(out);
  CHECK_FALSE(out.holds("THEN"));
  CHECK_FALSE(out.holds("]AND["));
  CHECK_FALSE(out.holds("]OR["));
  // Or: either jump goes to the alarm, else over it.
  const std::size_t at = out.find("IF[#7 GE 54.]GOTO ");
  CHECK(at < out.texts().size());
}
