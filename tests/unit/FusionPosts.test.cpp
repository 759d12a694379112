// Posts of Fusion that run: the kernel against a second one, and what stops a post.
#include "driver/RunPost.h"
#include "stdlib/FusionNames.h"
#include "support/Worker.h"
#include "support/messages/Verify.h"
#include "tests/GoldenRunner.h"
#include "tests/Process.h"
#include "tests/Skips.h"
#include "tests/policy/Tree.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <doctest/doctest.h>
#include <filesystem>
#include <set>
#include <string>

namespace fs = std::filesystem;
using namespace dotek;
using namespace dotek::tests;

namespace {

// What a command prints; nullopt: it fails.
std::optional<std::string> printed(const std::string& command) {
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string out;
  std::array<char, 4096> part{};
  for (std::size_t read = 0; (read = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    out.append(part.data(), read);
  return pclose(pipe) == 0 ? std::optional(out) : std::nullopt;
}

bool haveNode() {
  return printed("node --version 2>/dev/null").has_value();
}

} // namespace

TEST_CASE("fusion posts: a second kernel, written from the reference, prints the same blocks") {
  if (!haveNode()) return skip("node, which runs the second kernel, is not there");
  const fs::path second = root() / "tests" / "fusion" / "SecondKernel.js";
  for (const fs::path& post :
       {root() / "tests/fusion/posts/old.cps", root() / "tests/golden/run-post/matrix/mill.cps",
        root() / "tests/fusion/posts/words.cps"}) {
    INFO(post.string());
    const auto wanted = printed("node '" + second.string() + "' '" + post.string() + "'");
    REQUIRE(wanted);
    const CommandResult ours =
        runDotek({"run-post", post.filename().string(), "--matrix", "probing"}, post.parent_path().string());
    CHECK_MESSAGE(ours.status == 0, ours.err);
    CHECK(ours.out == *wanted);
  }
}

TEST_CASE("fusion posts: where no script can be run the post is not at fault") {
  driver::RunPostOptions options;
  options.post = (root() / "tests/fusion/posts/old.cps").string();
  options.matrix = "probing";
  options.common.scriptProgram = "/nowhere";
  const driver::Outcome outcome = driver::runPost(options);
  CHECK(outcome.status == 2);
  const auto& all = outcome.diagnostics.all();
  CHECK(std::any_of(all.begin(), all.end(),
                    [](const Diagnostic& one) { return one.code == diag::ScriptNotRun::code; }));
}

TEST_CASE("fusion posts: an include that includes itself is named, and one that ends is run") {
  const ProcessFolder folder;
  folder.write("a.js", "include(\"b.js\");\n");
  folder.write("b.js", "include(\"a.js\");\n");
  folder.write("endless.cps", "include(\"a.js\");\n");
  folder.write("once.js", "if (count < 5) { count += 1; include(\"once.js\"); }\n");
  folder.write("ends.cps", "var count = 0;\ninclude(\"once.js\");\n");
  const ShellResult endless = folder.run("dotek new job --from endless.cps");
  CHECK(endless.status == 1);
  CHECK_MESSAGE(endless.err.find("a file that includes itself has no end") != std::string::npos, endless.err);
  CHECK_MESSAGE(endless.err.find("b.js, a.js, b.js") != std::string::npos, endless.err);
  const ShellResult ends = folder.run("dotek new job --from ends.cps");
  CHECK_MESSAGE(ends.status == 0, ends.err);
}

TEST_CASE("fusion posts: scripts without an end are stopped with the limit that they meet") {
  const ProcessFolder folder;
  folder.write("job.toml", "schema = 1\n\n[[section]]\ntool = { number = 1 }\n");
  const auto stopped = [&](const std::string& body, const std::string& message) {
    INFO(body);
    folder.write("post.cps", "function onOpen() {\n" + body + "\n}\n");
    const ShellResult run = folder.run("dotek run-post post.cps job.toml --limit script-seconds=1; ls");
    CHECK_MESSAGE(run.err.find(message) != std::string::npos, run.err);
    CHECK(run.out == "job.toml\npost.cps\n");
  };
  stopped("for (;;) {}", "it has no end or is too slow");
  stopped("try { for (;;) {} } finally { for (;;) {} }", "it has no end or is too slow");
  stopped("var a = 'a'; for (var i = 0; i < 40; ++i) { a += 'a'; } a = /^(a+)+$/.test(a + '!');",
          "it has no end or is too slow");
  stopped("[3, 2, 1].sort(function () { for (;;) {} });", "it has no end or is too slow");
  stopped("var s = 'x'; for (;;) { s += s; }", "it needs more than 64 MB of memory");
  stopped("var a = [1]; for (;;) { a = a.concat(a); }", "it needs more than 64 MB of memory");
  stopped("for (;;) { log('much'); }", "it needs more than 64 MB of memory");
  stopped("for (;;) { writeln('0123456789'); }", "it wrote more than");
  stopped("redirectToFile('../out'); for (;;) { writeln('0123456789'); }", "it wrote more than");
  stopped("var o = {}; o.o = o; JSON.stringify(o);", "cyclic input");
  stopped("(function f() { f(); }());", "its calls are nested without end");
  stopped("var o = {toString: function () { return '' + this; }}; writeln(o);",
          "its calls are nested without end");
  stopped("JSON.parse(new Array(100000).join('['));", "recursion limit");
  stopped("include('post.cps');", "include: `post.cps`");
}

TEST_CASE("fusion posts: the kernel and the list of its names agree") {
  const stdlib::DataFiles data;
  const auto names = stdlib::FusionNames::load(data);
  const ProcessFolder folder;
  // What a post finds, beside what it declares itself.
  folder.write("post.cps",
               "function onOpen() {\n  var own = (function () { return this; }()) || this;\n"
               "  Object.getOwnPropertyNames(own).sort().forEach(function (name) { writeln(name); });\n}\n");
  folder.write("job.toml", "schema = 1\n\n[[section]]\ntool = { number = 1 }\n");
  const ShellResult shown = folder.run("dotek run-post post.cps job.toml");
  REQUIRE_MESSAGE(shown.status == 0, shown.err);
  const std::vector<std::string> lines = linesOf(shown.out);
  const std::set<std::string, std::less<>> found(lines.begin(), lines.end());
  // Of the engine that carries out the script.
  const std::set<std::string, std::less<>> engine = {
      "Buffer", "CBOR",        "Duktape",           "TextDecoder", "TextEncoder",
      "onOpen", "performance", "Uint8ClampedArray", "dotekEs6",    "dotekPrepare"};
  std::string unlisted, lacking;
  for (const std::string& name : found)
    if (!name.empty() && !names.all.contains(name) && !engine.contains(name)) unlisted += name + " ";
  CHECK(unlisted == "");
  for (const auto* list : {&names.functions, &names.variables, &names.classes, &names.entries, &names.valued})
    for (const std::string& name : *list)
      if (found.contains(name) == names.absent.contains(name)) lacking += name + " ";
  for (const auto& family : names.families)
    for (const std::string& name : family.names)
      if (!found.contains(name)) lacking += name + " ";
  CHECK(lacking == "");
  for (const std::string& name : names.absent) {
    INFO(name);
    folder.write("post.cps", "function onOpen() {\n  writeln(" + name + ");\n}\n");
    const ShellResult run = folder.run("dotek run-post post.cps job.toml");
    CHECK(run.status == 1);
    CHECK(run.err.find("the post fails: `" + name + "` of Fusion is not carried out by Dotek's kernel") !=
          std::string::npos);
  }
}

TEST_CASE("fusion posts: lines of a buffer are those of who wrote them there") {
  driver::RunPostOptions options;
  options.post = (root() / "tests/golden/run-post/buffers/post.cps").string();
  options.job = (root() / "tests/golden/run-post/buffers/job.toml").string();
  options.map = true;
  options.common.scriptProgram = runningProgram();
  const driver::Outcome outcome = driver::runPost(options);
  REQUIRE(outcome.status == 0);
  REQUIRE(outcome.maps.size() == 1);
  std::string out;
  for (const MappedLine& line : outcome.maps.front().lines)
    out += line.reason + "\n";
  CHECK(outcome.output == "%\nM98 P1\nO1\nG65 P9811 X1\nG80G65 P9811 X2\nG80\nM99\n");
  CHECK(out == "onOpen\nonCycleEnd\nonClose\nonCyclePoint\nonCyclePoint\nonCyclePoint\nonClose\n");
}

TEST_CASE(
    "fusion posts: a program of macro B is called with what the operation gives, and its text follows") {
  const ProcessFolder folder;
  folder.write("face.nc",
               "%\nO9001(FACE)\nIF[#23EQ#0]THEN#3000=1(W IS MISSING)\n#1=#5041\nG65P9811X[#1+#23]\n"
               "IF[ABS[#138]LE#17]GOTO10\n#3000=2(BEYOND THE LIMIT)\nN10M99\n%\n");
  folder.write(
      "job.toml",
      "schema = 1\n\n[[section]]\nstrategy = \"drill\"\ntool = { number = 7, type = \"TOOL_PROBE\" }\n"
      "properties = { face_give_W = \"1\", face_W = 12.5 }\n\n[[section.step]]\ncycle = \"drilling\"\n"
      "points = [[1.0, 2.0, -3.0]]\nwith = { clearance = 25.0, retract = 5.0, feedrate = 100.0 }\n");
  const ShellResult run = folder.run(
      "dotek convert face.nc --to fusion --whole-post -o face.cps && dotek run-post face.cps job.toml");
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(run.out.find("G90 G0 Z25.\nX1. Y2.\nZ-3.\nG65 P9001 W12.5\nM30\nO9001(FACE)\n") != std::string::npos);
  // What is decided on the measured value stays text.
  CHECK(run.out.find("IF[ABS[#138] LE #17]GOTO 10\n#3000=2(BEYOND THE LIMIT)\nN10 M99\n%\n") !=
        std::string::npos);
  const ShellResult fragment = folder.run("dotek convert face.nc --to fusion && dotek lint face.cps");
  CHECK(fragment.out.find("properties.face_W") != std::string::npos);
  CHECK(fragment.out.find("properties.face_A ") == std::string::npos); // #1 is given by the program itself
}

TEST_CASE("fusion posts: a job that `new job` writes runs") {
  const ProcessFolder folder;
  folder.write("drill.cps",
               "description = \"Reads all of a drilling cycle\";\ncapabilities = CAPABILITY_MILLING;\n"
               "var format = createFormat({decimals:1});\nfunction onCyclePoint(x, y, z) {\n"
               "  writeWords(format.format(cycle.dwell), format.format(cycle.incrementalDepth),\n"
               "    format.format(cycle.retractFeedrate), format.format(cycle.plungeFeedrate));\n}\n");
  folder.write("lathe.cps",
               "capabilities = CAPABILITY_TURNING;\nfunction onCircular() {\n"
               "  writeWords(isTurning(), tool.isTurningTool(), getCircularPlane() == PLANE_ZX);\n}\n");
  const ShellResult drill =
      folder.run("dotek new job --from drill.cps -o d.toml && dotek run-post drill.cps d.toml");
  CHECK_MESSAGE(drill.status == 0, drill.err);
  CHECK(drill.out == "0 5 400 200\n0 5 400 200\n");
  const ShellResult lathe =
      folder.run("dotek new job --from lathe.cps -o l.toml && dotek run-post lathe.cps l.toml");
  CHECK_MESSAGE(lathe.status == 0, lathe.err);
  CHECK(lathe.out == "true true true\n");
}
