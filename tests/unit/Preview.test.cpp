// `dotek preview`: the page shows what the dialog holds, and no text of an input becomes markup.
#include "driver/Preview.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <string>

namespace dotek::tests {
namespace {

// A cycle with one field A: rejected above 5, one move to A.
struct Cycle {
  TestFolder folder{"dotek-preview"};
  Cycle() {
    folder.write("DefineData.txt", "A = 3\nB = 7\n");
    folder.write("CycleData.dlg", "dialog \"<script>alert(1)</script>\", 40, 40, 300, 200\n"
                                  "label 20, 20, 60, 24, \"A [mm]\"\n"
                                  "input 90, 20, 70, 24, A, A\n"
                                  "label 170, 20, 100, 24, \"Depth & \xC5\xBE\"\n"
                                  "dropdown_new 20, 60, 100, 24, B, 0\n"
                                  "dropdown_add 1, \"first <i>\", 1\n"
                                  "image 10, 100, 20, 20, \"part.bmp\"\n"
                                  "cancel 230, 160, 60, 28\n"
                                  "ok 130, 160, 60, 28\n");
    folder.write("CycleData.mac", ":ask\ndialog \"CycleData.dlg\"\n"
                                  "if A > 5 then message \"<b>too deep</b>\"\n"
                                  "if A > 5 then goto ask\n");
    folder.write("ToolPath.mac", "add_custom_drill_cycle_path feed_z, 0 - A\n");
  }
  driver::Outcome run(const driver::NamedTexts& set = {}) const {
    driver::PreviewOptions options;
    options.folders = {folder.path().string()};
    options.common.set = set;
    return driver::preview(options);
  }
};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("preview: labels, inputs with their values, and notes for what is not shown") {
  const driver::Outcome out = Cycle().run();
  REQUIRE(out.status == 0);
  CHECK(holds(out.output, "default-src 'none'"));
  CHECK(holds(out.output, "left:90px;top:20px;width:70px;height:24px"));
  CHECK(holds(out.output, "value=\"3\""));
  CHECK(holds(out.output, "title=\"A [mm]: Depth &amp; \xC5\xBE\""));
  CHECK(holds(out.output, "not shown: <code>image 10"));
  // A value that is no choice of its list is shown as it is, not as the first choice.
  CHECK(holds(out.output, "<option selected>7</option><option>first &lt;i&gt;</option>"));
  CHECK(holds(out.output, "The values pass."));
}

TEST_CASE("preview: the messages of the checks for values that are given") {
  const driver::Outcome out = Cycle().run({{"A", "6"}});
  REQUIRE(out.status == 0);
  CHECK(holds(out.output, "value=\"6\""));
  CHECK(holds(out.output, "&lt;b&gt;too deep&lt;/b&gt;"));
  CHECK(holds(out.output, "The values are rejected."));
}

TEST_CASE("preview: a value that the macro changes is named, and each move has a line") {
  const Cycle cycle;
  cycle.folder.write("CycleData.mac", "dialog \"CycleData.dlg\"\nB = 2 * A\n");
  cycle.folder.write("ToolPath.mac", "add_custom_drill_cycle_path feed_z, 0 - A\n"
                                     "add_custom_drill_cycle_path feed_z, 5\n");
  const driver::Outcome out = cycle.run();
  REQUIRE(out.status == 0);
  CHECK_MESSAGE(holds(out.output, "the path is drawn with those that no input holds: B = 6"), out.output);
  const std::size_t moves = out.output.find("<pre>");
  REQUIRE(moves != std::string::npos);
  CHECK_MESSAGE(out.output.find("-3", moves) < out.output.find('\n', moves), out.output.substr(moves));
  CHECK(out.output.find('5', out.output.find('\n', moves)) < out.output.find("</pre>", moves));
}

TEST_CASE("preview: no text of an input becomes markup") {
  const driver::Outcome out = Cycle().run();
  CHECK(!holds(out.output, "<script"));
  CHECK(holds(out.output, "&lt;script&gt;"));
}

TEST_CASE("preview: what is no folder of a cycle is refused") {
  driver::PreviewOptions options;
  options.folders = {(root() / "examples/macros/bore.nc").string()};
  const driver::Outcome out = driver::preview(options);
  CHECK(out.status == 2);
  CHECK(out.output.empty());
  REQUIRE(!out.diagnostics.empty());
  CHECK(out.diagnostics.all().front().code == "file-not-readable");
}

TEST_CASE("preview: a file of the cycle language shows the dialog that is written of it") {
  const TestFolder folder("dotek-preview-cycle");
  driver::PreviewOptions options;
  options.folders = {folder.write("slot.cycle", R"(cycle slot "Slot along x"
parameter wide : length        "Width of the slot" require wide > 2 * ball_radius "Slot is narrow"
parameter low  : length = 4 mm "Depth of the touches" require low > 0 mm "Depth is not above 0"
result    size : length        "Width found"
spindle off
probe on
protected move by z -low
touch x by wide / 2 -> right
touch x by -wide / 2 -> left
protected move to start
probe off
size = right.at - left.at
if abs(size - wide) > 0.1 mm then
  alarm "Slot is out of tolerance"
end
)")};
  // What the dialog shows first is the user's.
  const driver::Outcome without = driver::preview(options);
  CHECK(without.status != 0);
  CHECK(without.output.empty());
  std::string said;
  for (const Diagnostic& one : without.diagnostics.all())
    said += one.message + "\n";
  CHECK_MESSAGE(holds(said, "write `--set wide=VALUE`"), said);

  options.common.set = {{"wide", "20"}};
  options.common.host = {{"tool_radius", "3"}, {"retract", "5"}};
  const driver::Outcome out = driver::preview(options);
  REQUIRE(out.status == 0);
  CHECK(holds(out.output, "Slot along x"));
  CHECK(holds(out.output, "Width of the slot"));
  CHECK(holds(out.output, "value=\"20\""));
  CHECK(holds(out.output, "value=\"4\""));
  CHECK(holds(out.output, "The values pass."));
  CHECK(holds(out.output, "<polyline"));

  options.common.set = {{"wide", "5"}};
  const driver::Outcome narrow = driver::preview(options);
  CHECK_MESSAGE(holds(narrow.output, "Slot is narrow"), narrow.output);
}

} // namespace
} // namespace dotek::tests
