// The table of docs/mikroprog-functions.md: every function of the profile, and what the machine does at it.
#include "DataFolder.h"
#include "MikroprogHelper.h"
#include "sim/machine/Trace.h"
#include "support/Files.h"
#include "tests/GoldenRunner.h"

using namespace dotek;
using namespace dotek::tests;
using sim::Ending;

namespace {

struct Row {
  std::string code, grade, block, expected;
};

std::string trimmed(std::string text) {
  const auto drop = std::string_view(" `");
  const std::size_t from = text.find_first_not_of(drop), to = text.find_last_not_of(drop);
  return from == std::string::npos ? "" : text.substr(from, to - from + 1);
}

std::vector<Row> rows() {
  const std::string page = readAll(root() / "docs" / "mikroprog-functions.md");
  std::vector<Row> out;
  for (std::size_t at = 0; (at = page.find("\n| `", at)) != std::string::npos; ++at) {
    const std::string line = page.substr(at + 3, page.find('\n', at + 1) - at - 3);
    std::vector<std::string> cells;
    for (std::size_t from = 0; from < line.size();) {
      const std::size_t end = std::min(line.find(" |", from), line.size());
      cells.push_back(line.substr(from, end - from));
      from = end + 2;
    }
    REQUIRE_MESSAGE(cells.size() == 5, line);
    out.push_back({trimmed(cells[0]), trimmed(cells[2]), trimmed(cells[3]), trimmed(cells[4])});
  }
  return out;
}

// "a / b" as lines.
std::string lines(std::string text, const std::string& end) {
  for (std::size_t at = 0; (at = text.find(" / ", at)) != std::string::npos;)
    text.replace(at, 3, end);
  return text.empty() ? "" : text + end;
}

struct Ran {
  Ending ending = Ending::Running;
  std::string trace, why;
};

Ran run(const std::vector<std::pair<std::string, std::string>>& files,
        const stdlib::MikroprogControl& control) {
  SourceMap sources;
  std::deque<ir::Program> programs;
  sim::mikroprog::OtherPrograms others;
  for (const auto& [name, text] : files) {
    programs.push_back(readBack(text, control, sources));
    others.emplace(name, &programs.back());
  }
  const sim::mikroprog::Profile profile(control);
  sim::Machine machine(profile.machine, profile.dialect);
  const sim::Bytecode code = sim::mikroprog::compile(programs.front(), profile, sources, others);
  Ran out;
  {
    sim::Trace trace([&](std::string_view piece) { out.trace += piece; });
    machine.setTrace(&trace);
    Limits limits;
    limits.simSteps = 100'000;
    sim::Run(machine, code, limits).run();
    machine.setTrace(nullptr);
  }
  for (std::size_t at = 0; (at = out.trace.find(".000000", at)) != std::string::npos;)
    out.trace.erase(at, 7);
  for (std::size_t at = 0; (at = out.trace.find("00000\n", at)) != std::string::npos;)
    out.trace.erase(at, 5);
  for (std::size_t at = 0; (at = out.trace.find("00000 ", at)) != std::string::npos;)
    out.trace.erase(at, 5);
  out.ending = machine.end().ending;
  out.why = machine.end().text;
  return out;
}

const stdlib::MikroprogControl& lathe() {
  static const auto control = loadMikroprog("mikroprog-s280");
  return control;
}
Ran chained(const std::string& main, const std::string& other,
            const stdlib::MikroprogControl& control = lathe()) {
  return run({{"A.SUF", main}, {"B.SUF", other}}, control);
}
bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("docs/mikroprog-functions.md has each function once, and the machine does what it says") {
  const std::vector<Row> all = rows();
  const stdlib::MikroprogControl& control = lathe();
  REQUIRE(all.size() == control.functions.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Row& row = all[i];
    CAPTURE(row.code);
    CHECK(row.code == control.functions[i].code());
    CHECK(row.grade == control.functions[i].grade);
    CHECK(has(" " + row.block + " ", " " + row.code + " "));
    const std::string begin = "feed X40 Z5 F100\n";
    const Ran ran = chained("N10 G1 X40 Z5 F100\n" + lines(row.block, "\n") +
                                "N50 M30\nN100 M0 ;THERE\nN110 M30\nN200 M0 ;SUB\nN210 M17\n",
                            "N10 G0 X10\nN20 M30\n");
    if (row.expected.starts_with("ends: ")) {
      CHECK((ran.ending == Ending::Inconclusive || ran.ending == Ending::Alarm));
      CHECK_MESSAGE(has(ran.why, row.expected.substr(6)), ran.why);
      continue;
    }
    CHECK_MESSAGE(ran.ending == Ending::ProgramEnd, ran.why);
    const std::string wanted = row.expected == "nothing" ? "" : lines(row.expected, "\n");
    CHECK(ran.trace == begin + wanted + (wanted.ends_with("end\n") ? "" : "end\n"));
  }
}

TEST_CASE("mikroprog machine: G28 runs a program and goes on where its state makes no difference") {
  const std::string main = "N10 G0 X30 Z2\nN20 G28 @B.SUF\nN30 G0 X50\nN40 M30\n";
  CHECK(chained(main, "N10 G1 X20 Z0 F100\nN20 M30\n").trace ==
        "rapid X30 Z2\nfeed X20 Z0 F100\nrapid X50 Z0\nend\n");
  // It has subprograms of its own, and numbers of its own.
  CHECK(chained(main, "N10 G26 L40\nN30 M30\nN40 G0 Z1\nN50 M17\n").trace ==
        "rapid X30 Z2\nrapid X30 Z1\nrapid X50 Z1\nend\n");
  CHECK(chained("N10 G28 @B.SUF L30\nN20 M30\n", "N10 G0 X1\nN30 G0 X3\nN40 M30\n").trace ==
        "rapid X3 Z0\nend\n");
  CHECK(chained("N10 G28 @B.SUF L50\nN20 M30\n", "N10 M30\n").ending == Ending::Alarm);
  // One runs the next one.
  CHECK(run({{"A.SUF", "N10 G28 @B.SUF\nN20 G0 X1\nN30 M30\n"},
             {"B.SUF", "N10 G28 @C.SUF\nN20 G0 X2\nN30 M30\n"},
             {"C.SUF", "N10 G0 X3\nN20 M30\n"}},
            lathe())
            .trace == "rapid X3 Z0\nrapid X2 Z0\nrapid X1 Z0\nend\n");
}

TEST_CASE("mikroprog machine: what a program that G28 runs finds and leaves is not stated") {
  const auto why = [&](const std::string& main, const std::string& other) {
    const Ran ran = chained(main, other);
    CHECK_MESSAGE(ran.ending == Ending::Inconclusive, main << other);
    return ran.why;
  };
  const std::string plain = "N10 G0 X1\nN20 M30\n", call = "N20 G28 @B.SUF\nN30 M30\n";
  CHECK(has(why("N10 G91\n" + call, plain), "(Q25)"));
  CHECK(has(why("N10 G24\n" + call, plain), "write G90"));
  CHECK(has(why("N10 G95\n" + call, plain), "write G94"));
  CHECK(has(why("N10 G17\n" + call, plain), "write G18"));
  CHECK(has(why("N10 G41\n" + call, plain), "write G40"));
  CHECK(has(why("N10 G51 Z5\n" + call, plain), "write G50"));
  CHECK(has(why("N10 G92 Z5\n" + call, plain), "write G98"));
  CHECK(has(why(call, "N10 G91\nN20 M30\n"), "before its M30"));
  CHECK(has(why(call, "N10 M3 S500\nN20 M30\n"), "write M5"));
  CHECK(has(why(call, "N10 M8\nN20 M30\n"), "write M9"));
  CHECK(chained(call, "N10 M3 S500\nN20 M8\nN30 M9\nN40 M5\nN50 M30\n").ending == Ending::ProgramEnd);
  // Motion, feed and parameters of the caller are not known in it, nor its own afterwards.
  CHECK(has(why("N10 G1 X5 F100\n" + call, "N10 X1\nN20 M30\n"), "not known"));
  CHECK(has(why("N10 G1 X5 F100\n" + call, "N10 G1 X1\nN20 M30\n"), "feed"));
  CHECK(has(why("N10 G1 X5 F100\n" + call, "N10 G81 Z-5\nN20 M30\n"), "feed"));
  CHECK(has(why("N10 P1=5\n" + call, "N10 G0 ZP1\nN20 M30\n"), "P1"));
  CHECK(has(why("N10 P1=5\nN20 G28 @B.SUF\nN30 G0 ZP1\nN40 M30\n", "N10 P1=6\nN20 M30\n"), "P1"));
  CHECK(chained("N10 P1=5\nN20 G28 @B.SUF\nN30 G0 ZP1\nN40 M30\n", "N10 P2=6\nN20 P1=5\nN30 M30\n").ending ==
        Ending::ProgramEnd);
  // Not at hand, itself, from its subprogram, without an end.
  CHECK(has(why("N10 G28 @X.SUF\nN20 M30\n", plain), "X.SUF"));
  CHECK(has(why("N10 G28 @A.SUF\nN20 M30\n", plain), "A.SUF"));
  CHECK(has(why(call, "N10 G26 L30\nN20 M30\nN30 G27 L20\nN40 M17\n"), "subprogram"));
  CHECK(has(why(call, "N10 G0 X1\n"), "no M30"));
  CHECK(chained(call, "N10 G28 @B.SUF\nN20 M30\n").ending != Ending::ProgramEnd);
}

TEST_CASE("mikroprog machine: a profile that answers Q25 takes the state over") {
  auto control = lathe();
  control.questions.push_back({25, "the state is that of the caller", true});
  CHECK(chained("N10 G1 X5 F100\nN20 P1=7\nN30 G28 @B.SUF\nN40 Z2\nN50 M30\n",
                "N10 G91\nN20 Z1\nN30 Z1\nN40 M30\n", control)
            .trace == "feed X5 Z0 F100\nfeed X5 Z1 F100\nfeed X5 Z2 F100\nfeed X5 Z4 F100\nend\n");
}

TEST_CASE("mikroprog machine: M61 runs M61.MAC where the profile answers Q25, up to its M30") {
  const std::vector<std::pair<std::string, std::string>> files = {
      {"A.SUF", "N10 G0 X5\nN20 M61\nN30 G0 Z3\nN40 M62\nN50 M30\n"},
      {"M61.MAC", "N10 G0 Z1\nN20 G26 L40\nN30 M30\nN40 G0 Z2\nN50 M17\n"}};
  CHECK(has(run(files, lathe()).why, "(Q25)"));
  auto control = lathe();
  control.questions.push_back({25, "the state is that of the caller", true});
  const Ran ran = run(files, control);
  CHECK(ran.trace == "rapid X5 Z0\nrapid X5 Z1\nrapid X5 Z2\nrapid X5 Z3\n");
  CHECK(has(ran.why, "no program `M62.MAC`"));
}

TEST_CASE("sim runs the programs of the folder that G28 names, and reports what is wrong in them") {
  const DataFolder folder;
  folder.write("A.SUF", "N10 G0 X30 Z2\nN20 G28 @B.SUF\nN30 M30\n");
  folder.write("B.SUF", "N10 G0 X20\nN20 G28 @C.SUF\nN30 M30\n");
  folder.write("C.SUF", "N10 G0 X10\nN20 M30\n");
  const auto sim = [&] { return runDotek({"sim", "A.SUF", "--control", "mikroprog-s280"}, folder.path()); };
  CHECK(has(sim().out, "rapid X10.000000 Z2.000000\nend\n"));
  CHECK(sim().status == 0);
  folder.write("C.SUF", "N10 G0 X10\nN20 G73 Z1\nN30 M30\n");
  CHECK(has(sim().err, "C.SUF:2:5"));
  CHECK(sim().status == 1);
}
