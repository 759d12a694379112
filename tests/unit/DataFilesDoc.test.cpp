// The examples of docs/data-files.md load, and mean what their comments say.
#include "../GoldenRunner.h"
#include "DataFolder.h"
#include "stdlib/Control.h"
#include "stdlib/DataFiles.h"
#include "stdlib/ReadCall.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::stdlib;

TEST_CASE("the examples of docs/data-files.md load") {
  const std::string text = tests::readAll(tests::root() / "docs" / "data-files.md");
  const tests::DataFolder folder;
  int written = 0;
  const std::string fence = "```toml\n# ";
  for (std::size_t at = text.find(fence); at != std::string::npos; at = text.find(fence, at + 1)) {
    const std::size_t name = at + fence.size();
    const std::size_t body = text.find('\n', name) + 1;
    const std::size_t end = text.find("```", body);
    REQUIRE(end != std::string::npos);
    folder.write(text.substr(name, body - 1 - name), text.substr(body, end - body));
    ++written;
  }
  REQUIRE(written == 2);
  DataFiles files;
  Diagnostics diagnostics;
  REQUIRE(files.addFolder(folder.path(), Limits{}, diagnostics));
  CHECK(diagnostics.all().empty());

  const std::optional<Control> control = Control::load(files, "example-mill");
  REQUIRE(control);
  CHECK(control->decimal == DecimalMode::Increment);
  CHECK(control->find('G', 910)->group == 3);
  CHECK(control->find(Function::ProbeOff)->tenths == 320);
  CHECK(control->find('M', 330)->function == Function::Other);
  CHECK_FALSE(control->variables.machine);

  const std::optional<MacroSet> set = MacroSet::load(files, "example-probe");
  REQUIRE(set);
  CHECK(readCall(*set, 9500, "XS").signature == set->find(Intent::Surface, ir::Axis::X));
}

TEST_CASE("docs/data-files.md names every meaning, intent, role and function that files may hold") {
  const std::string text = tests::readAll(tests::root() / "docs" / "data-files.md");
  const auto named = [&](std::string_view word) { return text.find(word) != std::string::npos; };
  for (int i = 1; i <= static_cast<int>(Function::Return); ++i) {
    CAPTURE(functionName(static_cast<Function>(i)));
    CHECK(named(functionName(static_cast<Function>(i))));
  }
  for (int i = 0; i <= static_cast<int>(Intent::ProbeOff); ++i)
    CHECK(named("`" + std::string(intentName(static_cast<Intent>(i))) + "`"));
  for (int i = 0; i <= static_cast<int>(ArgumentRole::Unstated); ++i)
    CHECK(named("`" + std::string(roleName(static_cast<ArgumentRole>(i))) + "`"));
  for (int i = 0; i <= static_cast<int>(Output::ProbeError); ++i)
    CHECK(named("`" + std::string(outputName(static_cast<Output>(i))) + "`"));
  for (int i = 0; i <= static_cast<int>(MacroAlarm::UpperLimit); ++i)
    CHECK(named(macroAlarmName(static_cast<MacroAlarm>(i))));
}
