// Scripts in a process of their own: what they give, what stops them, and what becomes of the process.
#include "script/Script.h"
#include "support/Worker.h"
#include "tests/Process.h"

#include <csignal>
#include <cstring>
#include <doctest/doctest.h>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace dotek::tests {

namespace {

using script::Fault;
using script::Runner;
using script::Texts;

script::Options limited(std::uint32_t seconds = 1, std::uint32_t memory = 16, std::uint32_t output = 10'000) {
  script::Options out({runningProgram()}, Limits());
  out.seconds = seconds;
  out.memory = memory;
  out.output = output;
  return out;
}

// The fault of a run of one script whose value is the function; "": it gives a value.
Fault faultOf(Runner& runner, const std::string& text, const std::string& argument = "1") {
  if (auto fault = runner.load({{"main", text}})) return *fault;
  auto answer = runner.run(argument);
  const Fault* fault = std::get_if<Fault>(&answer);
  return fault != nullptr ? *fault : Fault{Fault::Kind::Script, "", "", 0};
}

Texts valueOf(Runner& runner, const std::string& argument) {
  auto answer = runner.run(argument);
  REQUIRE_MESSAGE(std::holds_alternative<Texts>(answer), std::get<Fault>(answer).text);
  return std::get<Texts>(answer);
}

std::string bodyOf(const std::string& body) {
  return "(function (input) {\n" + body + "\nreturn [];\n})";
}

} // namespace

TEST_CASE("a script gives texts for a value") {
  Runner runner(limited());
  REQUIRE_FALSE(runner.load({{"main", "var a = 'x';\n(function (input) { return [a + b(input.n), '']; })"},
                             {"more", "function b(n) { return n + 1; }"}}));
  CHECK(valueOf(runner, R"({"n": 2})") == Texts{"x3", ""});
  CHECK(valueOf(runner, R"({"n": "\u00e9\ud83d\ude00"})") == Texts{"x\xC3\xA9\xF0\x9F\x98\x80"
                                                                   "1",
                                                                   ""});
  // Anything may be loaded in its place.
  CHECK(faultOf(runner, bodyOf("a();")).text.find("'a' undefined") != std::string::npos);
}

TEST_CASE("each run of a script finds it as it was loaded") {
  Runner runner(limited());
  REQUIRE_FALSE(runner.load({{"main", "var n = 0, list = [];\n"
                                      "(function () { n += 1; list.push(n); Object.prototype.m = n;"
                                      " return [String(n), String(list.length), String(({}).m)]; })"}}));
  for (int i = 0; i < 3; ++i)
    CHECK(valueOf(runner, "null") == Texts{"1", "1", "1"});
}

TEST_CASE("what a script throws is a fault with its place") {
  Runner runner(limited());
  Fault fault = faultOf(runner, bodyOf("\nnobody();"));
  CHECK(fault.kind == Fault::Kind::Script);
  CHECK(fault.text.find("nobody") != std::string::npos);
  CHECK(fault.source == "main");
  CHECK(fault.line == 3);
  fault = faultOf(runner, "var a = 1;\nvar = 2;");
  CHECK(fault.text.starts_with("SyntaxError"));
  CHECK(fault.line == 2);
  CHECK(faultOf(runner, bodyOf("throw null;")).text == "it throws `null`");
  CHECK(faultOf(runner, bodyOf("throw undefined;")).text == "it throws `undefined`");
  CHECK(faultOf(runner, bodyOf("throw '';")).text == "it throws an empty text");
  CHECK(faultOf(runner, bodyOf("throw {toString: function () { throw new Error('inner'); }};"))
            .text.find("inner") != std::string::npos);
  CHECK(faultOf(runner, bodyOf("throw {toString: function () { return this; }};")).kind ==
        Fault::Kind::Script);
  const std::string text =
      faultOf(runner, bodyOf("var s = 'abc'; while (s.length < 100000) s += s; throw new Error(s);")).text;
  CHECK(text.size() < 400);
  CHECK(text.ends_with(" ..."));
  CHECK(faultOf(runner, bodyOf("var e = new Error('x'); Object.defineProperty(e, 'stack', {get: function () "
                               "{ throw e; }}); throw e;"))
            .text == "Error: x");
}

TEST_CASE("a value that is no list of texts is a fault") {
  Runner runner(limited());
  for (const char* value :
       {"null", "undefined", "1", "'x'", "{}", "[1]", "[null]", "[{}]", "new Array(1000000000)",
        "{length: 2, 0: 'a', 1: 'b'}", "new Proxy([], {get: function () { throw 'p'; }})"}) {
    const Fault fault = faultOf(runner, std::string("(function () { return ") + value + "; })");
    CHECK_MESSAGE(!fault.text.empty(), value);
  }
  CHECK(faultOf(runner, "(function () { var a = ['']; Object.defineProperty(a, 0, {get: function () { throw "
                        "new Error('got'); }}); return a; })")
            .text.find("got") != std::string::npos);
  for (const char* value : {"null", "undefined", "{}", "'f'"})
    CHECK_MESSAGE(!faultOf(runner, "(" + std::string(value) + ")").text.empty(), value);
  CHECK(!faultOf(runner, "(function () { return []; })", "{no JSON").text.empty());
}

TEST_CASE("a script without an end is stopped, also one that catches everything") {
  for (const char* body :
       {"for (;;) {}", "for (;;) try { for (;;) {} } catch (e) {}",
        "throw {toString: function () { for (;;) {} }};",
        "return [{toString: function () { return 'x'; }}, /(x+x+)+y/.test(new Array(99).join('x')), "
        "(function () { for (;;) {} }())];"}) {
    Runner runner(limited());
    const Fault fault = faultOf(runner, bodyOf(body));
    CHECK_MESSAGE(fault.kind == Fault::Kind::Stopped, body);
    CHECK_MESSAGE(fault.text.find("--limit script-seconds") != std::string::npos, body);
    // Nothing more comes of it, and at once.
    CHECK(std::get<Fault>(runner.run("1")).text == fault.text);
    CHECK(runner.load({{"main", bodyOf("")}})->text == fault.text);
  }
}

TEST_CASE("runs that are slow together are stopped") {
  Runner runner(limited());
  REQUIRE_FALSE(runner.load({{"main", bodyOf("for (var i = 0; i < 30000000; ++i) {}")}}));
  std::variant<Texts, Fault> answer = Texts();
  for (int i = 0; i < 1000 && std::holds_alternative<Texts>(answer); ++i)
    answer = runner.run("1");
  REQUIRE(std::holds_alternative<Fault>(answer));
  CHECK(std::get<Fault>(answer).kind == Fault::Kind::Stopped);
}

TEST_CASE("a script without measure is stopped, or has to do with an exception") {
  Runner runner(limited());
  for (const char* body : {"var s = 'x'; for (;;) s += s;", "var a = []; for (;;) a.push(a.length + 'x');",
                           "return [new Array(100000000).join('x')];",
                           "var o = {}; for (var i = 0;; ++i) o['k' + i] = {o: o};"}) {
    const Fault fault = faultOf(runner, bodyOf(body));
    CHECK_MESSAGE(fault.kind == Fault::Kind::Stopped, body << ": " << fault.text);
    CHECK_MESSAGE(fault.text.find("--limit script-memory") != std::string::npos, fault.text);
  }
  CHECK(faultOf(runner, bodyOf("function f() { return f() + 1; } f();")).text.starts_with("RangeError"));
  CHECK(faultOf(runner, bodyOf("var s = ''; while (s.length < 6000) s += '['; return [s, s];"))
            .text.find("--limit script-output") != std::string::npos);
  CHECK(!faultOf(runner, "var a = " + std::string(100'000, '[')).text.empty());
  CHECK(!faultOf(runner, bodyOf("JSON.parse(new Array(100000).join('['));")).text.empty());
  // Whoever catches the lack of memory may go on.
  REQUIRE_FALSE(
      runner.load({{"main", "(function () { var s = 'x'; try { for (;;) s += s; } catch (e) { s = ''; } "
                            "return ['done']; })"}}));
  CHECK(valueOf(runner, "1") == Texts{"done"});
  CHECK(valueOf(runner, "1") == Texts{"done"});
}

TEST_CASE("the engine's own object is none of a script's business") {
  Runner runner(limited());
  REQUIRE_FALSE(runner.load({{"main", "(function () { return [typeof Duktape]; })"}}));
  CHECK(valueOf(runner, "1") == Texts{"undefined"});
}

TEST_CASE("without a program there is a refusal that says so") {
  const auto refused = [](const std::string& program) {
    script::Options options;
    options.program = program;
    Runner runner(options);
    const auto fault = runner.load({{"main", "1"}});
    REQUIRE(fault.has_value());
    CHECK(fault->kind == Fault::Kind::NoWorker);
    CHECK(std::get<Fault>(runner.run("1")).kind == Fault::Kind::NoWorker);
    return fault->text;
  };
  CHECK(refused("").find("CommonOptions::scriptProgram") != std::string::npos);
  CHECK(refused("/nowhere/dotek").find("No such file") != std::string::npos);
  CHECK(refused(std::filesystem::temp_directory_path().string()).find("does not start") != std::string::npos);
  CHECK(refused("/bin/true").find("exit status 0") != std::string::npos); // no worker
  script::Options large = limited();
  large.memory = 1U << 30;
  const auto noRoom = Runner(large).load({{"main", "1"}});
  REQUIRE(noRoom.has_value());
  CHECK(noRoom->kind == Fault::Kind::NoWorker);
  CHECK(noRoom->text.find("script-memory") != std::string::npos);
  Runner never(limited());
  CHECK(std::get<Fault>(never.run("1")).kind == Fault::Kind::NoWorker);
}

TEST_CASE("what a worker comes to is said, and none is left") {
  const ProcessFolder folder;
  // A program in a worker's place, which ends in its own way after the greeting was asked for.
  folder.write("dies", "#!/bin/sh\nkill -SEGV $$\n");
  folder.write("talks", "#!/bin/sh\nprintf '\\004\\000\\000\\000\\000\\000\\000\\000' >&0\nexec sleep 100\n");
  folder.write("floods", "#!/bin/sh\nprintf '\\377\\377\\377\\177' >&0\nexec sleep 100\n");
  for (const char* name : {"dies", "talks", "floods"}) {
    std::filesystem::permissions(folder.path(name), std::filesystem::perms::owner_all);
    script::Options options;
    options.program = folder.path(name);
    const auto fault = Runner(options).load({{"main", "1"}});
    REQUIRE(fault.has_value());
    CHECK(fault->kind == Fault::Kind::NoWorker);
    const char* const expected = std::strcmp(name, "dies") == 0 ? "signal 11" : "version of Dotek";
    CHECK_MESSAGE(fault->text.find(expected) != std::string::npos, fault->text);
  }
  // The same for one that is silent.
  std::string why;
  auto silent = Worker::start("/bin/sleep", {"100"}, why);
  REQUIRE(silent);
  CHECK_FALSE(silent->ask("frame", 100, std::chrono::milliseconds(50)));
  CHECK(silent->end().kind == Worker::End::Kind::Silent);
  CHECK_FALSE(silent->ask("frame", 100, std::chrono::milliseconds(50)));
}

TEST_CASE("frames of texts") {
  CHECK(unpacked(packed({"a", "", std::string_view("\0\n", 2)})) == Texts{"a", "", std::string("\0\n", 2)});
  CHECK(unpacked("") == Texts{});
  CHECK_FALSE(unpacked("abc"));
  CHECK_FALSE(unpacked(std::string_view("\5\0\0\0abcd", 8)));
}

} // namespace dotek::tests
