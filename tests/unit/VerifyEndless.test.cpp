// A macro or a Prog that never ends costs verify one run, not one for each case that is drawn.
#include "driver/Driver.h"
#include "support/messages/ComPost.h"
#include "support/messages/Gibbs.h"
#include "tests/GoldenRunner.h"
#include "tests/Process.h"
#include "tests/policy/Tree.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>
#include <string>

namespace dotek::tests {

namespace {

namespace fs = std::filesystem;

// The example with a line more in one of its files.
class Cycle {
public:
  Cycle() {
    fs::copy(root() / "examples" / "surface-x", folder_.path("surface-x"), fs::copy_options::recursive);
    fs::copy(root() / "examples" / "post.txt", folder_.path("post.txt"));
  }
  void after(const std::string& file, const std::string& line, const std::string& more) const {
    std::string text = folder_.read(file);
    const std::size_t at = text.find(line);
    REQUIRE_MESSAGE(at != std::string::npos, line);
    folder_.write(file, text.insert(at + line.size(), more));
  }
  driver::Outcome verified(const std::string& to, std::uint32_t jobs) const {
    driver::VerifyOptions options;
    options.inputs = {folder_.path("surface-x")};
    options.source.prog = folder_.path("post.txt");
    options.source.form = "thesis-a";
    options.to = to;
    options.common.assume.insert("probe-on");
    options.cases = 200;
    options.jobs = jobs;
    return driver::verify(options);
  }

private:
  ProcessFolder folder_;
};

void checkOnce(const Cycle& cycle, const std::string& to, std::string_view code) {
  for (const std::uint32_t jobs : {1U, 3U}) {
    const driver::Outcome outcome = cycle.verified(to, jobs);
    INFO(renderText(outcome.diagnostics, outcome.sources, 10) << outcome.output);
    CHECK(outcome.status == 1);
    CHECK(outcome.output.empty());
    std::size_t errors = 0;
    for (const Diagnostic& one : outcome.diagnostics.all()) {
      if (one.severity != Severity::Error) continue;
      ++errors;
      CHECK(one.code == code);
      CHECK(one.range.hasPlace());
      REQUIRE(!one.notes.empty());
      CHECK(one.notes.back().message.find("with these values: dotek verify ") == 0);
    }
    CHECK(errors == 1);
  }
}

} // namespace

TEST_CASE("a dialog that never ends is found once by verify") {
  const Cycle always, sometimes;
  always.after("surface-x/CycleData.mac", "dialog \"CycleData.dlg\"\n", ":round\nif X = X then goto round\n");
  sometimes.after("surface-x/CycleData.mac", "dialog \"CycleData.dlg\"\n",
                  ":round\nif X > 30 then goto round\n");
  checkOnce(always, "", diag::RunsForever::code); // convert refuses it as it is
  checkOnce(sometimes, "", diag::RunsForever::code);
  checkOnce(sometimes, "fanuc", diag::RunsForever::code);
}

TEST_CASE("a path that never ends is found once by verify") {
  const Cycle cycle;
  cycle.after("surface-x/ToolPath.mac", "get_op_data op, TOOL_NUM, tool\n",
              ":round\nif X > 30 then goto round\n");
  checkOnce(cycle, "", diag::RunsForever::code);
}

TEST_CASE("a Prog that goes on and on is found once by verify") {
  const Cycle cycle;
  // Two calls on each of 21 levels.
  cycle.after("post.txt", " SeqC SpinOff EOL\n", " a0\n");
  std::string routines = "\n";
  for (int i = 0; i < 20; ++i)
    routines += fmt::format("a{0}: a{1} a{1} RETURN\n", i, i + 1);
  cycle.after("post.txt", "RETURN", routines + "a20: RETURN\n");
  checkOnce(cycle, "", diag::PostRunsForever::code);
}

} // namespace dotek::tests
