// A converted program does what its source does: both are run as text, and everything that a run shows is
// compared.
#include "backends/fanuc/Program.h"
#include "tests/Draws.h"
#include "tests/unit/RandomMacroB.h"
#include "tests/unit/RunHarness.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <regex>
#include <sstream>

using namespace dotek;
using namespace dotek::tests;
namespace fanuc = backends::fanuc;

namespace {

// All that a run shows but the places of its blocks.
struct Shown {
  bool ran = false;
  std::string told; // where it did not: why
  std::string trace, output;
  std::string end;
  std::uint32_t alarm = 0;
  std::map<std::uint32_t, std::string> variables;
};

Shown runText(const std::string& text, const stdlib::Control& control, std::uint32_t deleted) {
  Shown out;
  MacroFile parsed(text);
  const auto file = frontend::macrob::lower(parsed.file, control, parsed.sources, parsed.diagnostics);
  out.told = parsed.told();
  if (!file) return out;
  std::vector<const ir::Program*> programs;
  for (const ir::Program& program : file->programs)
    programs.push_back(&program);
  const sim::Bytecode code = sim::compile(programs, control, parsed.sources);
  sim::Machine machine(control);
  machine.setBlockDelete(deleted);
  sim::Trace trace([&](std::string_view piece) { out.trace += piece; });
  machine.setTrace(&trace);
  Limits limits;
  limits.simSteps = 200000;
  sim::Run run(machine, code, limits);
  run.run();
  machine.setTrace(nullptr);
  trace.flush();
  const sim::RunEnd& end = machine.end();
  out.ran = true;
  out.output = run.output();
  out.end = fmt::format("{} {}", static_cast<int>(end.ending), end.text);
  out.alarm = end.number;
  for (const auto& [number, value] : machine.written())
    out.variables[number] = sim::isNull(value) ? "null" : numberText(value);
  return out;
}

bool overLimit(const Shown& shown) {
  return shown.end.starts_with(std::to_string(static_cast<int>(sim::Ending::Limit)));
}

// What differs first; "": nothing. A run that came to the limit of its steps is compared as far as both went.
std::string difference(const Shown& source, const Shown& result) {
  if (!result.ran) return "the result is not read: " + result.told;
  if (overLimit(source) || overLimit(result)) {
    const std::size_t common = std::min(source.trace.size(), result.trace.size());
    return source.trace.compare(0, common, result.trace, 0, common) == 0 ? "" : "trace before the limit";
  }
  if (source.end != result.end) return fmt::format("end: `{}`, `{}`", source.end, result.end);
  if (source.alarm != result.alarm) return fmt::format("alarm: {}, {}", source.alarm, result.alarm);
  if (source.output != result.output) return "output:\n" + source.output + "\n" + result.output;
  if (source.trace != result.trace) return "trace:\n" + source.trace + "\n" + result.trace;
  if (source.variables != result.variables) {
    for (const auto& [number, value] : source.variables) {
      const auto found = result.variables.find(number);
      const std::string other = found == result.variables.end() ? "not written" : found->second;
      if (other != value) return fmt::format("#{}: {}, {}", number, value, other);
    }
    return "a variable more is written";
  }
  return "";
}

using Renumber = std::optional<std::pair<std::uint64_t, std::uint64_t>>;

struct Converted {
  std::string text; // "" where it was refused
  std::string told;
  std::vector<std::vector<std::uint64_t>> before; // N numbers, program by program
};

Converted convert(const std::string& text, const stdlib::Control& from, const stdlib::Control& to,
                  const Renumber& renumber = {}) {
  Converted out;
  MacroFile parsed(text);
  const auto file = frontend::macrob::lower(parsed.file, from, parsed.sources, parsed.diagnostics);
  out.told = "lowered: " + parsed.told();
  if (!file) return out;
  for (const ir::Program& program : file->programs) {
    out.before.emplace_back();
    for (const ir::ProgramStatement& statement : program.body)
      if (const auto* label = std::get_if<ir::Label>(&statement.node))
        if (const std::uint64_t number = program.labels[label->label].number; number != 0)
          out.before.back().push_back(number);
  }
  Diagnostics found;
  const fanuc::ProgramOptions options{to, from, {}, renumber, false};
  const auto lines = fanuc::emitPrograms(*file, options, parsed.sources, found);
  found.sort();
  out.told.clear();
  for (const Diagnostic& one : found.all())
    if (one.severity == Severity::Error) out.told += std::string(one.code) + " ";
  if (lines)
    for (const backends::EmittedLine& line : *lines)
      out.text += line.text + "\n";
  return out;
}

// N numbers of a text, program by program, read from its lines alone.
std::vector<std::vector<std::uint64_t>> numbersOf(const std::string& text) {
  static const std::regex kHeader("[O:<].*");
  static const std::regex kNumber("(?:/[1-9]? *)?N([0-9]+).*");
  std::vector<std::vector<std::uint64_t>> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, kHeader) || (out.empty() && line != "%" && !line.empty())) out.emplace_back();
    if (std::regex_match(line, match, kNumber)) out.back().push_back(std::stoull(match[1]));
  }
  return out;
}

// Kept: every number is in the result, in order. Free: a number that is added appears once, and no GOTO of
// the source names it. "": all holds.
std::string numbersKept(const std::string& source, const Converted& result) {
  const auto after = numbersOf(result.text);
  if (after.size() != result.before.size()) return "another count of programs";
  static const std::regex kGoto("GOTO *0*([0-9]+)");
  std::vector<std::uint64_t> named;
  for (std::sregex_iterator at(source.begin(), source.end(), kGoto), end; at != end; ++at)
    named.push_back(std::stoull((*at)[1]));
  for (std::size_t i = 0; i < after.size(); ++i) {
    std::size_t next = 0;
    std::vector<std::uint64_t> added;
    for (const std::uint64_t number : after[i]) {
      if (next < result.before[i].size() && result.before[i][next] == number)
        ++next;
      else
        added.push_back(number);
    }
    if (next != result.before[i].size()) return fmt::format("N{} is gone", result.before[i][next]);
    for (const std::uint64_t number : added) {
      if (std::count(after[i].begin(), after[i].end(), number) != 1)
        return fmt::format("N{} is added and not free", number);
      if (std::count(named.begin(), named.end(), number) != 0)
        return fmt::format("N{} is added, and a GOTO of the source names it", number);
    }
  }
  return "";
}

struct Pair {
  std::string name;
  stdlib::Control from, to;
  Renumber renumber = {};
  bool mayRefuse = false;
};

// Controls of one arithmetic: where values are kept otherwise, results differ by right.
std::vector<Pair> pairs() {
  const stdlib::Control modern = controlOf("fanuc-31i-b");
  const stdlib::Control older = controlOf("fanuc-0i-md");
  stdlib::Control modernAsOlder = modern;
  modernAsOlder.arithmetic = older.arithmetic;
  stdlib::Control olderAsModern = older;
  olderAsModern.arithmetic = modern.arithmetic;
  // The 31i-B as if it knew no THEN, no joins and no function without brackets.
  stdlib::Control plain = modern;
  plain.name = "plain";
  plain.ifThen = plain.joinedConditions = plain.thenGoto = plain.bareFunctions = false;
  return {
      {"31i-B", modern, modern},
      {"0i-MD", older, older, {}, true}, // programs of the 31i-B are no programs of the 0i-MD
      {"31i-B renumbered", modern, modern, std::pair<std::uint64_t, std::uint64_t>(1, 1), true},
      {"31i-B to 0i-MD", modern, olderAsModern, {}, true},
      {"0i-MD to 31i-B", older, modernAsOlder, {}, true},
      {"31i-B to one without THEN", modern, plain, {}, true},
  };
}

// What is wrong with the conversion of this text; "": nothing. `refused` says why there is none.
std::string fault(const std::string& text, const Pair& pair, std::uint32_t deleted, std::string& refused) {
  refused.clear();
  const Converted result = convert(text, pair.from, pair.to, pair.renumber);
  if (result.text.empty()) {
    refused = result.told;
    // Brackets that the layout adds for safety may lie deeper than the control takes.
    const bool may = pair.mayRefuse || result.told.find("brackets-there") != std::string::npos;
    return may ? "" : "refused: " + result.told;
  }
  const std::string differs =
      difference(runText(text, pair.from, deleted), runText(result.text, pair.to, deleted));
  if (!differs.empty()) return differs + "\n--- converted:\n" + result.text;
  if (!pair.renumber)
    if (const std::string kept = numbersKept(text, result); !kept.empty())
      return kept + "\n--- converted:\n" + result.text;
  const Converted again = convert(result.text, pair.to, pair.to, pair.renumber);
  if (again.text != result.text)
    return fmt::format("converted again it changes ({}):\n{}\n--- first:\n{}", again.told, again.text,
                       result.text);
  return "";
}

std::uint32_t programs() {
  const char* text = std::getenv("DOTEK_RANDOM_PROGRAMS");
  const int number = text == nullptr ? 0 : std::atoi(text);
  return number > 0 ? static_cast<std::uint32_t>(number) : draws(300U, 60U);
}

// With the blocks taken away that a fault does not need.
std::string shrunk(std::string text, const std::function<bool(const std::string&)>& differs) {
  for (std::size_t chunk = 64; chunk > 0; chunk /= 2) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
      lines.push_back(line);
    for (std::size_t at = 0; at < lines.size();) {
      std::string less;
      for (std::size_t i = 0; i < lines.size(); ++i)
        if (i < at || i >= at + chunk) less += lines[i] + "\n";
      if (differs(less)) {
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at),
                    lines.begin() + static_cast<std::ptrdiff_t>(std::min(at + chunk, lines.size())));
        text = less;
      } else {
        at += chunk;
      }
    }
  }
  return text;
}

} // namespace

TEST_CASE("convert traces: made-up programs do the same as their conversions") {
  const std::vector<Pair> all = pairs();
  std::map<std::string, std::uint32_t> compared;
  std::map<std::string, std::map<std::string, int>> refusals;
  int faults = 0;
  for (std::uint32_t seed = 1; seed <= programs() && faults < 4; ++seed) {
    const bool modern = seed % 3 != 0;
    const std::string text = randomMacroB(seed, modern);
    const std::uint32_t deleted = seed % 4 == 0 ? 0b110 : 0;
    for (const Pair& pair : all) {
      std::string refused;
      const std::string what = fault(text, pair, deleted, refused);
      if (!refused.empty()) ++refusals[pair.name][refused.substr(0, 60)];
      if (refused.empty()) ++compared[pair.name];
      if (what.empty()) continue;
      ++faults;
      const auto kind = [](const std::string& told) {
        return told.substr(0, told.find_first_of("\n`0123456789"));
      };
      const std::string small = shrunk(text, [&](const std::string& less) {
        return kind(fault(less, pair, deleted, refused)) == kind(what);
      });
      FAIL_CHECK("seed " << seed << ", " << pair.name << ": " << fault(small, pair, deleted, refused)
                         << "\n--- source:\n"
                         << small);
      break;
    }
  }
  if (faults > 0) return;
  for (const Pair& pair : all) {
    std::string why;
    for (const auto& [reason, count] : refusals[pair.name])
      why += fmt::format("{} x {}; ", count, reason);
    // A conversion that refuses everything would pass all else.
    CHECK_MESSAGE(compared[pair.name] * 8 >= programs(),
                  pair.name << " " << compared[pair.name] << ": " << why);
    if (std::getenv("DOTEK_RANDOM_PROGRAMS") != nullptr)
      MESSAGE(pair.name << ": " << compared[pair.name] << " compared; refused: " << why);
  }
}

TEST_CASE("convert traces: written programs of each kind of statement") {
  const std::vector<Pair> all = pairs();
  const char* const kPrograms[] = {
      // G66 in G66, arguments from its block, moves by each kind
      "O1\nG0G90\nG66P91A#1B2.\nX1.\nG66P92C[1+1]\nN20Z2.\nG91X1.\nG67\nG90Y5.\nG67\nX9.\nM30\nO91\n"
      "#100=#100+#2\nY[#100]\nIF[#1EQ#0]THEN#101=7\nM99\nO92\nZ[#3*2]\nZ7.\nM99\n",
      // M98 with L, with words before it, the locals of the caller
      "O1\nG0\n#1=2\nX3.M98P50L3\nM98P50\n#100=#1\nM30\nO50\n#1=#1+1\nX#1\nM99\n",
      "O1\nM98P30050\nM30\nO50\n#100=#100+1\nM99\n",
      // M99 P, a number of the caller; skipped by a jump
      "O1\nG65P60A1.\n#100=1\nN50#101=2\nG65P60\n#102=3\nN51#103=4\nM30\nO60\nIF[#1EQ#0]GOTO7\nM99P50\nN7"
      "M99P51\n",
      "O1\n#100=#100+1\nIF[#100GE3]GOTO9\nM99\nN9M30\n",
      // printed text, with everything in it
      "O1\nPOPEN\n#100=-12.3456\nDPRNT[X*#100[43]A-B/#1[20]]\nIF[#100LT0]THEN#101=1\nDPRNT[]\nPCLOS\nM30\n",
      // window of the PMC: bits of a byte
      "O1\n#3962=3220\n#3963=5\n#100=#3963AND1\nIF[[#3963AND4]EQ0]GOTO3\n#101=#3963\nN3M30\n",
      // canned cycles and arcs
      "O1\nG17G90G0X0Y0Z10.\nG99G81X5.Y5.Z-5.R2.F100.\nX10.K2\nG91X3.K3\nG80G90\nG83X1.Z-9.R1.Q2.F50.\n"
      "G98X2.\nG80\nM30\n",
      "O1\nG17G90G0X0Y0Z0\nG1X10.F200.\nG2X20.Y10.R10.\nG3X10.Y20.I-10.J0\nG2X10.Y20.I5.\nG18G2X15.Z5.R5.\n"
      "M30\n",
      // offsets, shifts, dwell
      "O1\nG90G0X1.Y1.\nG10L2P2X#1Y5.Z-3.\nG55X0\n#100=#5242\nG52X2.Y-1.\nX0Y0\nG52X0Y0\nG4P500\nG4X1.5\n"
      "#101=#5041\nM30\n",
      "O1\nG10L2P1X[1+2]\n#5222=#5221*2\nG54G0X0Y0\n#100=#5021\n#101=#5022\nM30\n",
      // stop and alarm
      "O1\n#3006=1(LOOK [HERE])\n#100=1\nIF[#100EQ1]THEN#3000=21(BROKEN TOOL)\nM30\n",
      "O1\n#3000=#1+7(COMPUTED)\nM30\n",
      // block delete of every kind of block
      "O1\n/#100=1\n/2#101=2\n/3GOTO5\nN4#102=3\n/N5#103=4\n/2IF[#1EQ#0]THEN#104=5\n/2 G65P70A1.\n/G0X5.\n"
      "/2M98P70\nM30\nO70\n#105=#105+1\nM99\n",
      "O1\n#1=0\n/2N7#1=#1+1\nIF[#1LT3]GOTO8\nM30\nN8#1=#1+1\nGOTO7\n",
      // THEN with each statement that may appear there
      "O1\nIF[#1EQ#0]THEN#100=#1\nIF[#1NE#0]THEN#101=1\nIF[1LT2]THEN#[100+2]=-#1\nIF[1GT2]THEN#3006=1(NO)\n"
      "IF[1LT2]THENGOTO5\n#103=1\nN5IF[1LT2]THENDPRNT[A#100[20]]\nM30\n",
      "O1\nIF[[#1EQ#0]AND[#2EQ#0]]THEN#100=1\nIF[[1EQ2]OR[#2EQ#0]]GOTO7\n#101=1\nN7IF[[1EQ1]XOR[2EQ2]]GOTO8\n"
      "#102=2\nN8M30\n",
      // loops in loops, left by a jump, entered again, with the same number twice
      "O1\n#1=0\nWHILE[#1LT3]DO1\n#2=0\nDO2\n#3=0\nWHILE[[#3LT4]AND[#100LT90]]DO3\n#3=#3+1\n#100=#100+"
      "1\nEND3\n"
      "#2=#2+1\nIF[#2GE2]GOTO5\nEND2\nN5#1=#1+1\nEND1\nWHILE[#1LT9]DO1\n#1=#1+2\nEND1\n#101=#1\nM30\n",
      // duplicate numbers: the search goes forward from the jump, then from the top
      "O1\nGOTO2\nN1#100=1\nGOTO3\nN2\nGOTO1\nN1#100=2\nN3M30\n",
      "O1\nGOTO2\nN1#100=1\nGOTO3\nN1#100=3\nGOTO3\nN2\nGOTO1\nN3\n",
      "O1\nGOTO0002\n#100=1\nN02#101=1\nM30\n",
      // numbers that a computed jump finds
      "O1\n#1=3\nGOTO[#1*10]\nN10#100=1\nN20#100=2\nN30#100=3\nGOTO#1\nN3#101=5\nM30\n",
      // null and minus, precedence, functions with and without brackets
      "O1\n#100=-#1\n#101=[#1]\n#102=#1\n#103=2+12AND10\n#104=1OR2*4\n#105=10-4-3\n#106=10-[4-3]\n#107=12/"
      "[3*2]\n"
      "#108=-2*-3\n#109=-[2+3]*2\n#110=[-2]*[-3]\n#111=2--3\n#112=SIN[30]*2\n#113=ATAN[1]/[2]\n"
      "#114=[ATAN[1]]/[2]\n#115=10/ATAN[1]/[2]\n#116=ATAN[1]/[2]/2\n#117=-ATAN[1]/[-1]\nM30\n",
      "O1\n#1=5\n#5=7\n#7=9\n#100=#[#1]\n#101=#[#[#1]]\n#[#[#1]+#1]=3\n#[100+#1]=#[#1]+1\nM30\n",
      // an error inside an expression, in each place
      "O1\n#100=1\nWHILE[1/#1GT0]DO1\nEND1\nM30\n",
      "O1\nIF[[1EQ2]AND[1/0EQ1]]GOTO5\nN5M30\n",
      "O1\n#100=1\nG0X[SQRT[-1]]\nM30\n",
      "O1\nGOTO77\nM30\n",
      "O1\nG65P77A1.\nM30\n",
      "O1\nG65P1\nM30\n",
      "O1\n#100=#100+1\nM98P1\nM30\n",
      "O1\n#1=#99\nM30\n",
      "O1\n#[#0]=1\nM30\n",
      // arguments: both kinds, repeated letters, null
      "O1\nG65P80A1.B2.I-3.I4.D5.\nG65P80I1.J2.K3.I4.J5.K6.I7.\nG65P80X#1Y-[2+1]Z[#1]M3\nG65A4.P80L2B5\nM30\n"
      "O80\n#100=#100+1\n#[500+#100]=#1\n#[510+#100]=#4\n#[520+#100]=#7\n#[530+#100]=#24\n#[540+#100]=#13\n"
      "#[550+#100]=#2\nM99\n",
      // comments anywhere, empty comments, a program of comments
      "(HEAD)\n%\nO1(TITLE)(MORE)\n(A)N5(B)G0(C)X1.(D)\n()\n#100(E)=(F)1(G)\n;\n\nM30(END)\n%\n",
      // no number, no header, no end
      "G0X1.\n#100=1\n",
      "O1\nM30\nO2\nM99\nO3\n",
  };
  for (const char* text : kPrograms) {
    for (const Pair& pair : all) {
      for (const std::uint32_t deleted : {0U, 0b110U}) {
        std::string refused;
        const std::string what = fault(text, pair, deleted, refused);
        CHECK_MESSAGE(what.empty(), pair.name << ": " << what << "\n--- source:\n" << std::string(text));
        if (std::getenv("DOTEK_RANDOM_PROGRAMS") != nullptr && !refused.empty() && deleted == 0)
          MESSAGE(pair.name << " refuses: " << refused << "\n" << std::string(text));
      }
    }
  }
}

TEST_CASE("convert traces: a program called by a code") {
  stdlib::Control control = controlOf("fanuc-31i-b");
  const std::string text = "O1\nG5101A2.X#1\nG0X1.\nN10G5101\nM30\nO9101\n#100=#100+1\n#101=#1\nM99\n";
  std::string refused;
  for (const Renumber& renumber : {Renumber(), Renumber(std::pair<std::uint64_t, std::uint64_t>(100, 5))})
    CHECK(fault(text, {"31i-B", control, control, renumber}, 0, refused) == "");
}

TEST_CASE("convert traces: M99 P into blocks that are renumbered") {
  const stdlib::Control control = controlOf("fanuc-31i-b");
  const Pair pair{"31i-B", control, control, std::pair<std::uint64_t, std::uint64_t>(100, 10), true};
  const auto told = [&](const std::string& text) {
    std::string refused;
    const std::string what = fault(text, pair, 0, refused);
    return what.empty() ? refused : what;
  };
  const std::string macro = "O2\nM99P5\n";
  CHECK(told("O1\nN1G65P2\n#100=1\nN5#101=1\nM30\n" + macro) == "");
  CHECK(told("O1\nN1M98P2\n#100=1\nN5#101=1\nM30\n" + macro) == "");
  // Called by a code, which names no program.
  CHECK(told("O1\nN1G5101\n#100=1\nN5#101=1\nM30\nO9101\nM99P5\n") == "");
  // Which of two it is depends on the place of the call.
  CHECK(told("O1\nN5#100=#100+1\nIF[#100GT3]GOTO7\nG65P2\nN5#101=1\nN7M30\n" + macro) == "renumber-callers ");
}

TEST_CASE("convert traces: the comparison sees each kind of difference") {
  const stdlib::Control control = controlOf("fanuc-31i-b");
  const std::string text = "O1\nPOPEN\n#100=1\nG0X1.\nDPRNT[A]\n#3000=5(A)\n";
  const Shown source = runText(text, control, 0);
  REQUIRE(source.ran);
  CHECK(difference(source, source) == "");
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{{"#100=1", "#100=2"},
                                                                                 {"X1.", "X2."},
                                                                                 {"[A]", "[B]"},
                                                                                 {"=5", "=6"},
                                                                                 {"(A)", "(C)"},
                                                                                 {"#3000=5(A)", "M30"}}) {
    std::string other = text;
    other.replace(other.rfind(from), from.size(), to);
    CHECK_MESSAGE(difference(source, runText(other, control, 0)) != "", from);
  }
  Converted result{"O1\nN5 #1=1\nN5\nN7\n", "", {{5}}};
  CHECK(numbersKept("", result) != "");
  result.text = "O1\n/2N5 #1=1\nN7\n";
  CHECK(numbersKept("", result) == "");
  CHECK(numbersKept("GOTO 007", result) != "");
  result.before = {{5, 6}};
  CHECK(numbersKept("", result) != "");
}
