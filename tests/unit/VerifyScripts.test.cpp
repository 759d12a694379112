// verify of a Fusion fragment that was edited by hand, badly: each edit ends in a message, exit status 1, and
// soon.
#include "driver/Driver.h"
#include "support/Worker.h"
#include "support/messages/Verify.h"
#include "tests/GoldenRunner.h"
#include "tests/Process.h"
#include "tests/policy/Tree.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <string>

namespace dotek::tests {

namespace {

const std::string kWrite = "function surfaceX_write(x, y, z) {\n";

class Edited {
public:
  Edited() {
    driver::ConvertOptions convert;
    convert.inputs = {(root() / "examples" / "surface-x").string()};
    convert.source.prog = (root() / "examples" / "post.txt").string();
    convert.to = "fusion";
    text_ = driver::convert(convert).output;
    REQUIRE(text_.find(kWrite) != std::string::npos);
  }

  std::string before(const std::string& code) const { return code + "\n" + text_; }
  std::string after(const std::string& code) const { return text_ + "\n" + code + "\n"; }
  std::string within(const std::string& code) const { return replaced(kWrite, kWrite + code + "\n"); }
  std::string replaced(const std::string& from, const std::string& to) const {
    std::string out = text_;
    const std::size_t at = out.find(from);
    REQUIRE_MESSAGE(at != std::string::npos, from);
    return out.replace(at, from.size(), to);
  }
  const std::string& text() const { return text_; }

  driver::Outcome verified(const std::string& text, std::uint32_t jobs = 1, std::uint64_t cases = 10) const {
    driver::VerifyOptions options;
    options.inputs = {(root() / "examples" / "surface-x").string()};
    options.source.prog = (root() / "examples" / "post.txt").string();
    options.to = "fusion";
    options.common.assume.insert("probe-on");
    options.common.scriptProgram = runningProgram();
    options.common.limits.scriptSeconds = 1;
    options.common.limits.scriptMemory = 8;
    options.cases = cases;
    options.jobs = jobs;
    folder_.write("edited.js", text);
    options.allowEdits = true; // the cases alone are to show it
    options.translation = folder_.path("edited.js");
    return driver::verify(options);
  }

private:
  std::string text_;
  ProcessFolder folder_;
};

std::string report(const driver::Outcome& outcome) {
  return renderText(outcome.diagnostics, outcome.sources, 10) + outcome.output;
}

bool has(const driver::Outcome& outcome, std::string_view code) {
  const auto& all = outcome.diagnostics.all();
  return std::any_of(all.begin(), all.end(), [&](const Diagnostic& one) { return one.code == code; });
}

} // namespace

TEST_CASE("an edited fragment that cannot be read is one message at its line") {
  const Edited edited;
  const std::string kBad[] = {
      edited.before("var = 1;"),
      edited.before("let a = 1;"),
      edited.before("const f = (a) => a;\nclass B {}"),
      edited.within("if (x > 0 {"),
      edited.text().substr(0, edited.text().rfind('}')),
      edited.after("}"),
      edited.after("/* never closed"),
      edited.after("return;"),
      edited.after("nobody();"),
      edited.after("throw null;"),
      edited.after("undefined.x = 1;"),
      edited.before("var a = " + std::string(100'000, '(') + ";"),
      edited.before("Object.freeze(this); var later = 1; throw new Error('no');"),
      "\x7F"
      "ELF\x01\x02",
      "<html>\n<body>not found</body>\n</html>\n",
  };
  for (const std::string& text : kBad) {
    const driver::Outcome outcome = edited.verified(text);
    INFO(text.substr(0, 60) << "\n" << report(outcome));
    CHECK(outcome.status == 1);
    CHECK(outcome.output.empty());
    REQUIRE(has(outcome, diag::ScriptFails::code));
    const Diagnostic& found = outcome.diagnostics.all().front();
    CHECK(found.range.hasPlace());
  }
  const driver::Outcome third = edited.verified("var a = 1;\n\nvar 1 = 2;\n" + edited.text());
  const Diagnostic& found = third.diagnostics.all().front();
  CHECK(third.sources.line(found.range) == 3);
}

TEST_CASE("an edited fragment that is stopped is one message with the case") {
  const Edited edited;
  const std::string kBad[] = {
      edited.before("for (;;) {}"),
      edited.within("for (;;) {}"),
      edited.within("while (true) { try { for (;;) {} } catch (e) {} }"),
      edited.within("var s = 'x'; for (;;) s += s;"),
      edited.within("var a = []; for (;;) a.push(new Array(1000).join('x') + a.length);"),
      edited.within("for (;;) writeBlock('G0 X0');"),
      edited.within("for (var i = 0; i < 300000; ++i) writeBlock('G0 X0');"),
      edited.within("for (;;) error('x');"),
      edited.within("error(new Array(2000000).join('x'));"),
      edited.within("throw {toString: function () { for (;;) {} }};"),
      edited.within("Object.defineProperty(tool, 'diameter', {get: function () { for (;;) {} }});"),
      edited.within("/(a|b|ab)*(a|b|ab)*(a|b|ab)*c/.test(new Array(200).join('ab'));\nfor (;;) {}"),
  };
  for (const std::string& text : kBad) {
    const driver::Outcome outcome = edited.verified(text);
    INFO(text.substr(text.find(kWrite), 120) << "\n" << report(outcome));
    CHECK(outcome.status == 1);
    CHECK(outcome.output.empty());
    REQUIRE(has(outcome, diag::TranslationStopped::code));
    CHECK(report(outcome).find("--limit script-") != std::string::npos);
  }
  // The case is that of the first, however many look.
  const std::string text = edited.within("if (x > 0 && y > 0) for (;;) {}");
  const std::string one = report(edited.verified(text, 1, 100)),
                    three = report(edited.verified(text, 3, 100));
  CHECK_MESSAGE(one.find("with these values: dotek verify") != std::string::npos, one);
  CHECK(one == three);
}

TEST_CASE("an edited fragment that fails or does something else differs") {
  const Edited edited;
  const std::pair<std::string, const char*> kBad[] = {
      {edited.within("function f() { return f() + 1; } f();"), "RangeError"},
      {edited.within("throw null;"), "it throws `null`"},
      {edited.within("throw '';"), "it throws an empty text"},
      {edited.within("throw {toString: function () { throw new Error('odd'); }};"), "odd"},
      {edited.within("throw {};"), "it throws"},
      {edited.within("throw new Error(new Array(100000).join('long'));"), " ... (source"},
      {edited.within(
           "Object.defineProperty(tool, 'lengthOffset', {get: function () { throw new Error('got'); }});"
           "tool.lengthOffset;"),
       "got"},
      {edited.within("writeBlock({toString: function () { throw new Error('text'); }});"), "text"},
      {edited.after("dotekRun = function () { return null; };"), "it replaces `dotekRun`"},
      {edited.after("dotekState = null;"), "it replaces `dotekState`"},
      {edited.within("dotekState.text = {};"), "cannot be read"},
      {edited.within("dotekState.errors = null;"), "fails"},
      {edited.after("writeln = function () {};"), "it replaces `writeln`"},
      {edited.after("Math = null;"), "it replaces `Math`"},
      {edited.within("Math.floor = function () { return 0; };"), "it replaces `Math.floor`"},
      {edited.after("Array.prototype.push = function () {};"), "it replaces `Array.prototype.push`"},
      {edited.after("Array.prototype.join = function () { return null; };"), "it replaces"},
      {edited.after("String.prototype.substring = function () { throw 1; };"), "it replaces"},
      {edited.after("Number = function () { return NaN; };"), "it replaces `Number`"},
      {edited.after("surfaceX_write = function () {};"), "path differs"},
      {edited.after("surfaceX_write = function () { return null; };"), "path differs"},
      {edited.after("surfaceX_write = null;"), "not callable"},
      {edited.after("surfaceX_dispatch = null;"), "there is no function `surfaceX_dispatch`"},
      {edited.replaced(kWrite, "function surface_write(x, y, z) {\n"), "surfaceX_write"},
      {edited.after("writeBlock = undefined;"), "writeBlock"},
      {edited.after("writeBlock('G0 X0');"), "differs"},
      {edited.after("error('stop');"), "stop"},
      {edited.within("writeBlock('\\u0000\\ud800(');"), "the text of the fragment cannot be read"},
      {edited.within("error('late');"), "beside its error"},
      {"", "there is no function `surfaceX_dispatch`"},
      {"\n\n\n", "there is no function `surfaceX_dispatch`"},
  };
  for (const auto& [text, words] : kBad) {
    const driver::Outcome outcome = edited.verified(text);
    INFO(text.substr(std::min(text.size(), text.find(kWrite)), 120) << "\n" << report(outcome));
    CHECK(outcome.status == 1);
    CHECK((has(outcome, diag::VerifyDiffers::code) || has(outcome, diag::ScriptFails::code) ||
           has(outcome, diag::VerifyTooFew::code)));
    CHECK(report(outcome).find(words) != std::string::npos);
  }
  // The line that throws is shown.
  const std::string shown = report(edited.verified(edited.within("nobody.x = 1;")));
  CHECK_MESSAGE(shown.find("note: of the translation\n  nobody.x = 1;") != std::string::npos, shown);
}

TEST_CASE("what a fragment prints may not go on for ever either") {
  const Edited edited;
  const std::vector<std::pair<std::string, std::string>> loops = {
      {"writeBlock('M99');", "the last pass has changed nothing"},
      {"writeln('N1'); writeln('GOTO1');", "--limit sim-steps"}};
  for (const auto& [loop, words] : loops) {
    const driver::Outcome outcome = edited.verified(edited.within(loop), 2, 100);
    INFO(loop << "\n" << report(outcome));
    CHECK(outcome.status == 1);
    REQUIRE(has(outcome, diag::TranslationStopped::code));
    CHECK(report(outcome).find(words) != std::string::npos);
  }
}

TEST_CASE("an edit that changes nothing agrees, and no case knows of another") {
  const Edited edited;
  const std::string kGood[] = {
      edited.text(),
      edited.before("'use strict';"),
      edited.before("\"use strict\"; later = 1;"),
      edited.before("var count;\nArray.prototype.last = function () { return this[this.length - 1]; };"),
      edited.within("if (this.count) { return; }\nthis.count = 1;"),
      edited.within("if (typeof seen !== 'undefined') { return; }\nseen = true;"),
      edited.within("if (({}).seen) { return; }\nObject.prototype.seen = true;"),
      edited.after("// after the end"),
  };
  for (const std::string& text : kGood) {
    const driver::Outcome outcome = edited.verified(text);
    INFO(report(outcome));
    CHECK(outcome.status == 0);
    CHECK(outcome.output.starts_with("AGREES: 10 of 10 drawn cases"));
  }
}

TEST_CASE("without a program that runs scripts there is a refusal with its reason") {
  driver::VerifyOptions options;
  options.inputs = {(root() / "examples" / "surface-x").string()};
  options.source.prog = (root() / "examples" / "post.txt").string();
  options.to = "fusion";
  driver::Outcome outcome = driver::verify(options);
  CHECK(outcome.status == 2);
  CHECK(outcome.output.empty());
  CHECK_MESSAGE(has(outcome, diag::ScriptNotRun::code), report(outcome));
  options.common.scriptProgram = "/nowhere";
  outcome = driver::verify(options);
  CHECK(outcome.status == 2);
  CHECK(report(outcome).find("No such file") != std::string::npos);
}

TEST_CASE("a process that runs scripts ends with the one that started it") {
  const ProcessFolder folder;
  folder.write("edited.js", Edited().within("for (;;) {}"));
  const std::string verify = "verify '" + (root() / "examples" / "surface-x").string() + "' --prog '" +
                             (root() / "examples" / "post.txt").string() +
                             "' --to fusion --allow-edits --translation edited.js --limit script-seconds=60";
  // Its children are the workers; each of them has gone a moment after it.
  const ShellResult result = folder.run("\"$DOTEK\" " + verify + R"( & P=$!
for i in $(seq 200); do W=$(pgrep -P $P) && break; sleep 0.05; done
test -n "$W" || echo "no worker"
kill -TERM $P; wait $P; echo "status $?"
for i in $(seq 200); do kill -0 $W 2>/dev/null || break; sleep 0.05; done
kill -0 $W 2>/dev/null && echo "left over"
exit 0)");
  CHECK_MESSAGE(result.out == "status 143\n", (result.out + result.err));
  // One that is killed is said.
  const ShellResult killed = folder.run("\"$DOTEK\" " + verify + R"( 2>said & P=$!
for i in $(seq 200); do W=$(pgrep -P $P) && break; sleep 0.05; done
# It runs the script, and does not only start, when it has used a second of the processor.
for i in $(seq 2000); do set -- $(cat /proc/$W/stat); test ${14} -gt 100 && break; sleep 0.05; done
kill -ABRT $W; wait $P; echo "status $?"; cat said)");
  CHECK_MESSAGE(killed.out.starts_with("status 1\n"), killed.out);
  CHECK_MESSAGE(killed.out.find("signal 6") != std::string::npos, killed.out);
  // The command is no one's but Dotek's.
  const ShellResult typed = folder.run("dotek script-worker </dev/null");
  CHECK(typed.status == 2);
  CHECK(typed.err.find("started by Dotek itself") != std::string::npos);
}

TEST_CASE("verify of a fragment sees titles of a list that were exchanged") {
  const std::filesystem::path shops = root() / "tests" / "shops";
  driver::VerifyOptions options;
  options.inputs = {(shops / "included" / "HB_Anschlag").string()};
  options.source.prog = (shops / "included" / "post.txt").string();
  options.common.data = {(shops / "data").string()};
  options.to = "fusion";
  options.common.scriptProgram = runningProgram();
  options.cases = 10;
  options.jobs = 1;
  driver::ConvertOptions convert;
  static_cast<targets::TranslationOptions&>(convert) = options;
  std::string text = driver::convert(convert).output;
  const std::size_t one = text.find("\"links\""), other = text.find("\"rechts\"");
  REQUIRE_MESSAGE((one != std::string::npos && other != std::string::npos), text);
  const ProcessFolder folder;
  folder.write("edited.js", text);
  options.allowEdits = true; // the cases alone are to show it
  options.translation = folder.path("edited.js");
  CHECK(driver::verify(options).status == 0);
  text.replace(other, 8, "\"links\"");
  text.replace(one, 7, "\"rechts\"");
  folder.write("edited.js", text);
  const driver::Outcome outcome = driver::verify(options);
  CHECK(outcome.status == 1);
  CHECK(renderText(outcome.diagnostics, outcome.sources, 0).find("calls 1 `rechts` against `links`") !=
        std::string::npos);
}

} // namespace dotek::tests
