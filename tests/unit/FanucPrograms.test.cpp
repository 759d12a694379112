#include "backends/fanuc/Program.h"
#include "frontend/macrob/Lower.h"
#include "ir/Print.h"
#include "support/messages/Fanuc.h"
#include "tests/Draws.h"
#include "tests/unit/MacroBHelper.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <random>
#include <regex>

using namespace dotek;
using tests::MacroFile;
namespace fanuc = backends::fanuc;

namespace {

stdlib::Control control(const std::string& name) {
  const auto found = stdlib::Control::load(stdlib::DataFiles(), name);
  REQUIRE(found);
  return *found;
}

struct Converted {
  std::string text; // "" where it was refused
  std::string told; // codes
  std::string ir;   // of the source
};

std::string codes(Diagnostics& diagnostics) {
  diagnostics.sort();
  std::string out;
  for (const Diagnostic& one : diagnostics.all())
    out += (out.empty() ? "" : " ") + std::string(one.code);
  return out;
}

Converted convert(const std::string& source, const std::string& from, const std::string& to) {
  MacroFile parsed(source);
  const stdlib::Control here = control(from);
  const stdlib::Control there = control(to);
  const auto file = frontend::macrob::lower(parsed.file, here, parsed.sources, parsed.diagnostics);
  INFO(source << parsed.told());
  REQUIRE(file);
  Diagnostics found;
  const fanuc::ProgramOptions options{there, here, {}, {}, false};
  const auto lines = fanuc::emitPrograms(*file, options, parsed.sources, found);
  Converted out{"", codes(found), ir::print(*file, nullptr)};
  if (lines)
    for (const backends::EmittedLine& line : *lines)
      out.text += line.text + "\n";
  return out;
}

// The blocks of one program, without what is around them.
std::string blocks(const std::string& source, const std::string& from = "fanuc-31i-b",
                   const std::string& to = "") {
  const Converted out = convert("O1\n" + source, from, to.empty() ? from : to);
  if (out.text.empty()) return out.told;
  const std::size_t begin = out.text.find("O1\n") + 3;
  return out.text.substr(begin, out.text.size() - begin - 2);
}

} // namespace

TEST_CASE("macro B programs: the fewest brackets that keep the value") {
  CHECK(blocks("#1=[#2*#3]+[#4]\n") == "#1=#2*#3+#4\n");
  CHECK(blocks("#1=#2-[#3-#4]\n") == "#1=#2-[#3-#4]\n");
  CHECK(blocks("#1=[#2-#3]-#4\n") == "#1=#2-#3-#4\n");
  CHECK(blocks("#1=#2/[#3*#4]*[#5+1.]\n") == "#1=#2/[#3*#4]*[#5+1.]\n");
  CHECK(blocks("#1=#2AND[#3OR7]\n") == "#1=#2 AND [#3 OR 7]\n");
  CHECK(blocks("#1=SIN#2\n") == "#1=SIN[#2]\n");
  CHECK(blocks("#1=[ATAN[#2]]/[#3]\n") == "#1=[ATAN[#2]]/#3\n");
  CHECK(blocks("#1=#2*ATAN[#3]/[#4]\n") == "#1=#2*[ATAN[#3]/[#4]]\n");
  CHECK(blocks("#1=-#2*-[3]\n") == "#1=-#2*[-[3]]\n");
  CHECK(blocks("#1=POW[#2+1,3]MOD2\n") == "#1=POW[#2+1,3] MOD 2\n");
}

TEST_CASE("macro B programs: null stays null where it was") {
  CHECK(blocks("#1=#2\n#1=[#2]\n#1=-#2\n") == "#1=#2\n#1=[#2]\n#1=-#2\n");
  CHECK(blocks("G0X#1Y[#1]Z-#1A[-#1]\n") == "G0 X#1 Y[#1] Z-#1 A[-#1]\n");
  CHECK(blocks("IF[#1EQ[#2]]GOTO5\nN5\n") == "IF[#1 EQ [#2]]GOTO 5\nN5\n");
  CHECK(blocks("IF[[#1]GT[#2]]GOTO5\nN5\n") == "IF[#1 GT #2]GOTO 5\nN5\n");
}

TEST_CASE("macro B programs: a number in brackets after an address is no count of increments") {
  CHECK(blocks("G0X[10]Y0\n", "fanuc-0i-md", "fanuc-6m") == "G0 X[10] Y0\n");
  CHECK(blocks("G0X10Y5.\n", "fanuc-0i-md", "fanuc-6m") == "G0 X10. Y5.\n");
  CHECK(blocks("G0X10Y-1500\n", "fanuc-6m", "fanuc-0i-md") == "G0 X0.01 Y-1.5\n");
  CHECK(blocks("G65P10X10D10A-7\n", "fanuc-6m", "fanuc-0i-md") == "G65 P10 X0.01 D10 A-0.007\n");
}

TEST_CASE("macro B programs: THEN and joined conditions on a control without them") {
  const auto old = [](const std::string& text) { return blocks(text, "fanuc-0i-md", "fanuc-6m"); };
  CHECK(old("IF[#1LT2]THEN#3=4\nN7M99\n") == "IF[#1 GE 2]GOTO 10\n#3=4\nN10\nN7 M99\n");
  CHECK(old("N9999IF[#1EQ#0]THEN#3=4\n") == "N9999 IF[#1 NE #0]GOTO 9998\n#3=4\nN9998\n");
  CHECK(old("/IF[#1LT2]THEN#3=4\n") == "/IF[#1 GE 2]GOTO 10\n/#3=4\nN10\n");
  CHECK(old("N5IF[[#1EQ1]OR[#2EQ2]]GOTO5\n") == "N5 IF[#1 EQ 1]GOTO 5\nIF[#2 EQ 2]GOTO 5\n");
  CHECK(old("N5IF[[#1EQ1]AND[#2EQ2]]GOTO5\n") == "N5 IF[#1 NE 1]GOTO 10\nIF[#2 EQ 2]GOTO 5\nN10\n");
  CHECK(old("WHILE[[#1LT5]AND[#2LT6]]DO1\nEND1\n") == "WHILE[#1 LT 5]DO1\nIF[#2 GE 6]GOTO 10\nEND1\nN10\n");
  // A number that a GOTO without a block names is not free either.
  CHECK(old("GOTO50\nIF[#1LT2]THEN#3=4\n") == "GOTO 50\nIF[#1 GE 2]GOTO 60\n#3=4\nN60\n");
  CHECK(old("IF[[#1EQ1]OR[SQRT[#2]EQ2]]GOTO5\nN5\n") == "joined-elsewhere");
}

TEST_CASE("macro B programs: another count of digits is reported, once, where it matters") {
  const auto told = [](const std::string& text, const std::string& to) {
    return convert("O1\n" + text, "fanuc-31i-b", to).told;
  };
  CHECK(told("#1=#2/3\nIF[#1*3EQ#2]GOTO5\nN5M30\n", "fanuc-0i-md") == "arithmetic-elsewhere");
  CHECK(told("#1=SIN[#2]\n", "fanuc-0i-md") == "arithmetic-elsewhere");
  CHECK(told("#1=#1+1\n#2=-#1\nG0X#1Y[ABS[#2]]\n", "fanuc-0i-md") == "");
  CHECK(told("#1=#2/3\n", "fanuc-31i-b") == "");
}

TEST_CASE("macro B programs: variables under their numbers on the other control") {
  CHECK(blocks("#5242=#5242+1.\n", "fanuc-0i-md", "fanuc-6m") == "#2602=#2602+1.\n");
  CHECK(blocks("#1=#2503\n", "fanuc-6m", "fanuc-0i-md") == "#1=#5261\n");
  CHECK(blocks("#1=#4001\n", "fanuc-0i-md", "fanuc-6m") == "#1=#4001\n");
  CHECK(blocks("#3003=1\n#1=#3004\n", "fanuc-0i-md", "fanuc-31i-b") == "#3003=1\n#1=#3004\n");
  CHECK(blocks("#1=#4014\n", "fanuc-0i-md", "fanuc-6m") == "variable-elsewhere");
  CHECK(blocks("#1=#2001\n", "fanuc-6m", "fanuc-0i-md") == "variable-elsewhere");
  CHECK(blocks("#1=#3962\n", "fanuc-31i-b", "fanuc-0i-md") == "variable-elsewhere");
  CHECK(blocks("#1=#[500+#2]\n", "fanuc-31i-b", "fanuc-0i-md") == "#1=#[500+#2]\n");
  CHECK(blocks("#1=#[2000+#2]\n", "fanuc-6m", "fanuc-0i-md") == "variable-number-computed");
}

TEST_CASE("macro B programs: variables of cycles are no part of them") {
  ir::ProgramFile file;
  ir::Program& program = file.programs.emplace_back();
  const stdlib::Control here = control("fanuc-0i-md");
  const fanuc::ProgramOptions options{here, here, {}, {}, false};
  const auto told = [&](ir::ProgramStatement statement) {
    program.body = {std::move(statement)};
    Diagnostics found;
    CHECK_FALSE(fanuc::emitPrograms(file, options, SourceMap(), found));
    return codes(found);
  };
  ir::ProgramStatement statement;
  statement.node = ir::Store{ir::constant(500), ir::variable(0)};
  CHECK(told(statement) == diag::StatementNotOfProgram::code);
}

TEST_CASE("macro B programs: a jump without a number of the text gets one") {
  ir::ProgramFile file;
  ir::Program& program = file.programs.emplace_back();
  const ir::LabelId begin = program.addLabel({0, "", {}});
  const ir::LabelId numbered = program.addLabel({30, "030", {}});
  const auto add = [&](auto node) { program.body.emplace_back().node = std::move(node); };
  add(ir::Label{begin});
  add(ir::Store{ir::constant(1), ir::constant(2)});
  add(ir::Jump{begin});
  add(ir::Label{numbered});
  const stdlib::Control here = control("fanuc-0i-md");
  Diagnostics found;
  const auto lines = fanuc::emitPrograms(file, {here, here, {}, {}, false}, SourceMap(), found);
  REQUIRE(lines);
  std::string text;
  for (const backends::EmittedLine& line : *lines)
    text += line.text + "|";
  CHECK(text == "%|N40|#1=2|GOTO 40|N030|%|");
}

// ---- generated programs
// ------------------------------------------------------------------------------------

namespace {

class Generator {
public:
  explicit Generator(unsigned seed) : random_(seed) {}

  std::string program() {
    std::string out = "O1(MADE UP)\n";
    for (int i = 1; i <= 12; ++i) {
      if (pick(4) == 0) out += pick(2) == 0 ? "/" : "/3";
      if (i % 3 == 0) out += fmt::format("N{}", i * 10);
      out += statement() + (pick(5) == 0 ? "(REMARK)" : "") + "\n";
    }
    return out + "WHILE" + condition(2) + "DO1\n" + statement() + "\nEND1\nM99\n";
  }

private:
  int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  std::string statement() {
    switch (pick(9)) {
    case 0: return "G1X" + word() + "Y" + word() + "F" + word();
    case 1: return "IF" + condition(2) + "GOTO" + std::to_string(30 * (1 + pick(4)));
    case 2: return "IF" + condition(2) + "THEN#" + std::to_string(1 + pick(9)) + "=" + expression(2);
    case 3: return "G65P9010A" + word() + "B" + word();
    case 4: return "G91G0Z" + word() + "M98P20L2";
    case 5: return "GOTO" + std::to_string(30 * (1 + pick(4)));
    case 6: return "#[" + expression(1) + "]=" + expression(2);
    default: return "#" + std::to_string(1 + pick(9)) + "=" + expression(3);
    }
  }

  std::string word() {
    switch (pick(5)) {
    case 0: return "#" + std::to_string(1 + pick(9));
    case 1: return "-#" + std::to_string(1 + pick(9));
    case 2: return std::to_string(pick(50)) + ".";
    case 3: return "-" + std::to_string(pick(50));
    default: return "[" + expression(2) + "]";
    }
  }

  std::string expression(int depth) {
    if (depth == 0 || pick(4) == 0) {
      switch (pick(4)) {
      case 0: return std::to_string(pick(100)) + (pick(2) == 0 ? "." : "");
      case 1: return "[#" + std::to_string(1 + pick(9)) + "]";
      case 2: return "[-" + std::to_string(pick(9)) + "]";
      default: return "#" + std::to_string(1 + pick(9));
      }
    }
    static const char* const kFunctions[] = {"SIN", "ABS", "ROUND", "FIX", "ATAN", "SQRT"};
    static const char* const kOperators[] = {"+", "-", "*", "/", "AND", "OR", "XOR", "MOD"};
    switch (pick(6)) {
    case 0: return std::string(kFunctions[pick(6)]) + "[" + expression(depth - 1) + "]";
    case 1: return "[" + expression(depth - 1) + "]";
    case 2: return "[-" + std::string("[") + expression(depth - 1) + "]]";
    case 3: return "ATAN[" + expression(depth - 1) + "]/[" + expression(depth - 1) + "]";
    default: return expression(depth - 1) + kOperators[pick(8)] + expression(depth - 1);
    }
  }

  std::string condition(int depth) {
    static const char* const kRelations[] = {"EQ", "NE", "GT", "GE", "LT", "LE"};
    static const char* const kJoins[] = {"AND", "OR", "XOR"};
    if (depth == 0 || pick(3) > 0) return "[" + expression(1) + kRelations[pick(6)] + expression(1) + "]";
    return "[" + condition(depth - 1) + kJoins[pick(3)] + condition(depth - 1) + "]";
  }

  std::mt19937 random_;
};

// Digits and what is where in the text do not count.
std::string withoutPlaces(const std::string& text) {
  return std::regex_replace(text, std::regex(" ;.*"), "");
}

} // namespace

TEST_CASE("macro B programs: the result means the same as its source, and is its own result") {
  const stdlib::Control profile = control("fanuc-31i-b");
  int printed = 0;
  const int programs = tests::draws(400);
  for (int seed = 0; seed < programs; ++seed) {
    const std::string source = Generator(static_cast<unsigned>(seed)).program();
    MacroFile parsed(source);
    // More brackets than the control takes are refused before.
    if (!frontend::macrob::lower(parsed.file, profile, parsed.sources, parsed.diagnostics)) continue;
    const Converted first = convert(source, "fanuc-31i-b", "fanuc-31i-b");
    INFO(source << first.told);
    if (first.text.empty()) {
      CHECK(first.told.find("brackets-there") != std::string::npos);
      continue;
    }
    ++printed;
    const Converted second = convert(first.text, "fanuc-31i-b", "fanuc-31i-b");
    INFO(first.text);
    CHECK(second.text == first.text);
    CHECK(withoutPlaces(second.ir) == withoutPlaces(first.ir));
  }
  CHECK(printed > programs / 2);
}
