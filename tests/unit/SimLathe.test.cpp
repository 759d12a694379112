// Programs for a lathe on the virtual machine: what means something else there is not run as a mill's.
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"
#include "tests/unit/RunHarness.h"

#include <doctest/doctest.h>
#include <string>

using namespace dotek::tests;

namespace {

CommandResult simulate(const std::string& text) {
  const TestFolder folder("dotek-sim-lathe");
  folder.write("o.nc", text);
  return runDotek({"sim", "o.nc"}, folder.path());
}

bool holds(const std::string& text, std::string_view part) {
  CAPTURE(text);
  return text.find(part) != std::string::npos;
}

constexpr const char* kRest = "X15.8\nG0 X40. Z5.\nG0 X120. Z120.\nM30\n";

} // namespace

TEST_CASE("sim of a lathe: a turning cycle, a thread, a facing cycle end as inconclusive") {
  for (const std::string head : {"G50 S2000\nT0202\n", "T0202\n", "G28 U0 W0\n"})
    for (const std::string block : {"G90 X17. Z-12. F.2", "G92 X16.4 Z-9. F1.5", "G94 X2. Z-1. F.1"}) {
      const CommandResult out =
          simulate("%\nO0071\n" + head + "G97 S700 M3\nG0 X40. Z5.\n" + block + "\n" + kRest);
      CHECK(out.status == 1);
      CHECK(holds(out.err, "[run-inconclusive]"));
      CHECK(holds(out.err, "the program is for a lathe"));
      CHECK(!holds(out.err, "shift-left-on"));
    }
  // The thread shows it by itself.
  const CommandResult thread = simulate("O0072\nG0 X40. Z5.\nG92 X16.4 Z-9. F1.5\n" + std::string(kRest));
  CHECK(thread.status == 1);
  CHECK(holds(thread.err, "cuts a thread"));
  CHECK(simulate("O0072\nT0202\nG0 X40. Z5.\nG1 X30. F.2\nM30\n").status == 0);
}

TEST_CASE("sim of a lathe: a macro, too, and an increment") {
  const MacroRun run("O9071\nG50 S2000\n#1=3\nG0 X40. Z5.\nG1 U#1 F.2\nM99\n");
  CHECK(holds(run.end(), "inconclusive: the program is for a lathe: line 3 limits the speed"));
  CHECK(run.text() == "G1 U#1 F.2");
  CHECK(holds(MacroRun("O9072\nG50 S2000\n#1=3\nG10 P#1 X.2\nM99\n").end(), "is the offset of a tool"));
  CHECK(MacroRun("O9073\nG50 S2000\n#1=3\nG90 G0 X#1\nM30\n").end() != "end");
  CHECK(MacroRun("O9074\nG50 S2000\nG90\n#1=3\nG0 X#1\nM30\n").end() == "end");
}

TEST_CASE("sim of a mill: Y, M6 or G43 show it, and its codes run") {
  CHECK(MacroRun("O1\nT202\nG92 X0 Y0 Z0 F100\n#1=3\nG90 G0 X#1\nM30\n").end() == "end");
  CHECK(MacroRun("O1\nT202 M6\n#1=3\nG90 G0 X#1\nM30\n").end() == "end");
  CHECK(MacroRun("O1\nG43 H1 Z5.\nG92 X0 Z0 F100\n#1=3\nG90 G0 X#1\nM30\n").end() == "end");
  const CommandResult out = simulate("%\nO0073\nT202\nG90 G0 X3. Y4. Z5.\nG1 Z-1. F100\nM30\n%\n");
  CHECK(out.status == 0);
}
