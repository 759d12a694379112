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
  options.folders = {"examples/cycles/bore.cycle"};
  const driver::Outcome out = driver::preview(options);
  CHECK(out.status == 2);
  CHECK(out.output.empty());
  REQUIRE(!out.diagnostics.empty());
  CHECK(out.diagnostics.all().front().code == "file-not-readable");
}

} // namespace
} // namespace dotek::tests
