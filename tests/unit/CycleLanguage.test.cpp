// The cycle language on random cycles: the layout is read as the same cycle, and laying it out again changes
// nothing. The seed is fixed: a failure repeats.
#include "frontend/cycle/Check.h"
#include "frontend/cycle/Parse.h"
#include "project/CycleFiles.h"
#include "support/messages/Cycle.h"
#include "tests/Draws.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <iterator>
#include <random>
#include <string>

namespace dotek::tests {
namespace {

namespace cycle = frontend::cycle;

class Writer {
public:
  explicit Writer(std::uint32_t seed) : engine_(seed) {}

  std::string cycle() {
    std::string out = "cycle drawn \"Drawn\"\n";
    for (int i = 0; i < 3; ++i)
      out += comment() + "parameter p" + std::to_string(i) + blank() + ":" + blank() + "length" +
             (once(3) ? " optional" : " = " + number() + "mm") +
             " \"Gr\xC3\xB6\xC3\x9F"
             "e\"" +
             (once(2) ? " range 0 mm to " + number() + " mm" : "") + end();
    return out + block(3);
  }

private:
  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(engine_() % bound); }
  bool once(std::uint32_t times) { return below(times) == 0; }
  template <class Texts> std::string one(const Texts& texts) {
    return texts[below(static_cast<std::uint32_t>(std::size(texts)))];
  }
  std::string blank() { return std::string(below(3), ' '); }
  std::string comment() { return once(4) ? "  // a comment\n" : once(5) ? "\n\n" : ""; }
  std::string end() { return (once(5) ? " // after" : "") + std::string("\n"); }
  std::string number() {
    static constexpr const char* kNumbers[] = {"0", "1", "05.50", ".25", "12.", "3.14159", "100"};
    return one(kNumbers);
  }
  std::string name() {
    static constexpr const char* kNames[] = {"p0",       "tolerance", "radius",    "step",
                                             "right.at", "start.x",   "overtravel"};
    return one(kNames);
  }
  std::string value(int depth) {
    if (depth == 0 || once(3)) {
      if (once(3)) return number() + blank() + "mm";
      return once(3) ? name() : number();
    }
    static constexpr const char* kOperators[] = {"+", " - ", "*", " / "};
    switch (below(5)) {
    case 0: return "-" + value(depth - 1);
    case 1: return "(" + value(depth - 1) + ")";
    case 2: return "max(" + value(depth - 1) + " , " + value(depth - 1) + ")";
    default: return value(depth - 1) + one(kOperators) + value(depth - 1);
    }
  }
  std::string condition(int depth) {
    static constexpr const char* kRelations[] = {"<", " <= ", ">", " >= ", " is ", " is not "};
    if (depth == 0 || once(3)) return once(4) ? "given p0" : value(1) + one(kRelations) + value(1);
    switch (below(3)) {
    case 0: return "not " + condition(depth - 1);
    case 1: return "(" + condition(depth - 1) + ")";
    default: return condition(depth - 1) + (once(2) ? " and " : " or\n") + condition(depth - 1);
    }
  }
  std::string statement(int depth) {
    switch (below(depth > 0 ? 14 : 9)) {
    case 0: return "probe on" + end();
    case 1: return "protected  move by z " + value(2) + end();
    case 2: return "move to work G54.1 P7 x " + value(1) + " , machine z 0" + end();
    case 3: return "touch " + std::string(once(3) ? "once " : "") + "x by " + value(2) + "->right" + end();
    case 4: return "total=" + value(3) + end();
    case 5: return "set G55 : " + value(1) + " becomes x " + value(1) + " , 0 mm becomes y 1 mm" + end();
    case 6:
      return "call other_cycle first_of_them = " + value(2) + " , second_of_them = " + value(2) +
             ", third_of_them = " + value(2) + " -> it" + end();
    case 7: return "report \"R\" measured " + value(1) + " tolerance " + value(1) + end();
    case 8: return "alarm \"// no comment, \xC3\xA9\"" + end();
    case 9: return "repeat 3 times" + end() + block(depth - 1) + "end" + end();
    case 10: return "for i = 1 to 3 step 2\n" + block(depth - 1) + comment() + "end\n";
    case 11: return "while " + condition(1) + " at most 5 times\n" + block(depth - 1) + "end\n";
    case 12:
      return "touch along x 1, y " + value(1) + " to " + value(1) + " else" + end() + block(depth - 1) +
             "end\n";
    default:
      return "if " + condition(2) + " then" + end() + block(depth - 1) + comment() +
             (once(2) ? "else if " + condition(1) + " then\n" + block(depth - 1) : "") +
             (once(2) ? comment() + "else" + end() + block(depth - 1) : "") + "end" + end();
    }
  }
  std::string block(int depth) {
    std::string out;
    for (std::uint32_t i = below(4); i > 0; --i)
      out += comment() + blank() + statement(depth);
    return out;
  }

  std::mt19937 engine_;
};

struct Reading {
  SourceMap sources;
  Diagnostics diagnostics;
  cycle::File file;

  explicit Reading(const std::string& text)
      : file(cycle::parse(sources.add(SourceFile("drawn.cycle", text, Encoding::Utf8)), sources, Limits(),
                          diagnostics)) {}
  // Without the places.
  std::string tree() const {
    std::string out;
    std::string dump = cycle::dumpAst(file, sources);
    for (std::size_t at = 0; at < dump.size();) {
      const std::size_t line = std::min(dump.find('\n', at), dump.size());
      const std::size_t place = dump.find_first_not_of(' ', at);
      const std::size_t text = std::min(dump.find(' ', place), line);
      out += dump.substr(at, place - at) + dump.substr(text, line - text) + "\n";
      at = line + 1;
    }
    return out;
  }
};

TEST_CASE("cycles: the layout is the same cycle, and stays as it is") {
  for (std::uint32_t seed = 1; seed <= draws(300U); ++seed) {
    const std::string text = Writer(seed).cycle();
    INFO(text);
    const Reading first(text);
    REQUIRE_MESSAGE(!first.file.hasErrorNodes, renderText(first.diagnostics, first.sources, 0));
    const std::string laidOut = cycle::layOut(first.file);
    const Reading second(laidOut);
    REQUIRE(!second.file.hasErrorNodes);
    CHECK(second.tree() == first.tree());
    CHECK(cycle::layOut(second.file) == laidOut);
  }
}

TEST_CASE("cycles: what dotek new writes is laid out, and nothing is wrong with it") {
  const std::string draft = project::cycleDraft("step_height");
  Reading reading(draft);
  cycle::check(reading.file, reading.sources, reading.diagnostics);
  // The file of the test has another name than the cycle.
  for (const Diagnostic& found : reading.diagnostics.all())
    CHECK_MESSAGE(found.code == diag::CycleFileName::code, found.message);
  CHECK(cycle::layOut(reading.file) == draft);
}

TEST_CASE("cycles: ends of other languages close their blocks, and each is one message") {
  Reading reading("cycle other \"Other words\"\nparameter wide : length \"Width\"\nneeds probe\n"
                  "if wide > 5 mm then\n  move by z 1 mm\nelseif wide > 3 mm then\n  move by z 2 mm\nelse\n"
                  "  move by z 3 mm\nendif\nfor i = 1 to 3\n  repeat 2 times\n    move by z 1 mm\n  done\n"
                  "next i\n");
  std::string found;
  for (const Diagnostic& one : reading.diagnostics.all())
    found += one.message + "\n";
  CHECK(found == "no statement begins with `elseif`; write `else if CONDITION then`\n"
                 "no statement begins with `endif`; a block ends with `end`\n"
                 "no statement begins with `done`; a block ends with `end`\n"
                 "no statement begins with `next`; a block ends with `end`\n");
  CHECK(reading.file.hasErrorNodes);
}

TEST_CASE(
    "cycles: a bracket that is left open is reported at its line, and a value on the next line is read") {
  const auto messages = [](const std::string& lines) {
    Reading reading("cycle d \"T\"\nparameter gap : length = 5 mm \"G\"\nresult got : length \"G\"\nspindle "
                    "off\nprobe on\ntouch x by gap -> face\nprobe off\n" +
                    lines);
    cycle::check(reading.file, reading.sources, reading.diagnostics);
    std::string found;
    for (const Diagnostic& one : reading.diagnostics.all())
      if (one.severity == Severity::Error)
        found += fmt::format("{}: {}\n", reading.sources.file(one.range.file).place(one.range.begin).line,
                             one.message);
    return found;
  };
  CHECK(messages("got = abs(face.at\nother = got * got\n") ==
        "8: the bracket that opens here is not closed; write `)`\n");
  CHECK(messages("got = abs(face.at\nif gap > 3 mm then\nend\n") ==
        "8: the bracket that opens here is not closed; write `)`\n");
  // Within brackets a statement may go on.
  CHECK(messages("other = gap\ngot = abs(\nother\n- face.at)\n") == "");
  CHECK(messages("other = gap\ngot = max(other,\nface.at\n)\n") == "");
  CHECK(messages("other = gap\ngot = abs(face.at -\nother)\n") == "");
}

TEST_CASE(
    "cycles: a type of another language counts as the one that is meant, and capitals of axes are named") {
  Reading reading(
      "cycle d \"T\"\nparameter n : number = 3 \"N\"\nneeds probe\nrepeat n times\n  touch X by 5 mm -> "
      "face\nend\n");
  cycle::check(reading.file, reading.sources, reading.diagnostics);
  std::string found;
  for (const Diagnostic& one : reading.diagnostics.all())
    if (one.severity == Severity::Error) found += one.message + "\n";
  CHECK(found.find("did you mean `count`?") != std::string::npos);
  CHECK(found.find("has no unit") == std::string::npos);
  CHECK(found.find("axes are written small: `x`") != std::string::npos);
  CHECK(found.find("x_value") == std::string::npos);
}

TEST_CASE("cycles: any bytes end in a diagnostic, not in a crash") {
  std::mt19937 engine(7);
  for (std::uint32_t seed = 1; seed <= draws(200U); ++seed) {
    std::string text = Writer(seed).cycle();
    for (int i = 0; i < 5 && !text.empty(); ++i) {
      const std::size_t at = engine() % text.size();
      switch (engine() % 4) {
      case 0: text[at] = static_cast<char>(engine() % 256); break;
      case 1: text.erase(at, 1 + engine() % 20); break;
      case 2: text.insert(at, text.substr(engine() % text.size(), engine() % 30)); break;
      default: text.insert(at, 1, "()\"\n,;#="[engine() % 8]);
      }
    }
    Reading reading(text);
    cycle::check(reading.file, reading.sources, reading.diagnostics);
    CHECK((!reading.file.hasErrorNodes || reading.diagnostics.hasErrors()));
  }
}

} // namespace
} // namespace dotek::tests
