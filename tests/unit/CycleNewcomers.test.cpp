// What newcomers write in a cycle: one message each, with what to write in its place.
#include "frontend/cycle/Check.h"
#include "frontend/cycle/Parse.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <string>

namespace dotek::tests {
namespace {

namespace cycle = frontend::cycle;

struct Slip {
  const char* line;
  const char* says; // in the only error
};

std::string errorsOf(const std::string& lines, int& count) {
  SourceMap sources;
  Diagnostics diagnostics;
  const std::string text = "cycle one \"One\"\n"
                           "parameter gap  : length = 5 mm \"Gap\"\n"
                           "result    size : length        \"Size\"\n"
                           "spindle off\nprobe on\n"
                           "touch x by gap -> edge\nsize = edge.at\n" +
                           lines + "probe off\n";
  const cycle::File file = cycle::parse(sources.add(SourceFile("one.cycle", text, Encoding::Utf8)), sources,
                                        Limits(), diagnostics);
  cycle::check(file, sources, diagnostics);
  std::string out;
  for (const Diagnostic& one : diagnostics.all()) {
    if (one.severity != Severity::Error) continue;
    out += one.message + " [" + std::string(one.code) + "]\n";
    ++count;
  }
  return out;
}

} // namespace

TEST_CASE("cycles: a touch that is given like a value is one message, and its name is known") {
  for (const char* const line :
       {"left = touch x by 9 mm", "let left = touch x by 9 mm", "left := touch x by 9 mm",
        "left -> touch x by 9 mm", "left <- touch x by 9 mm", "var left touch x by 9 mm",
        "left = touch x by 9 mm -> other", "touch x by 9 mm = left", "touch x by 9 mm := left",
        "touch x by 9 mm <- left", "touch x by 9 mm left", "touch left x by 9 mm"}) {
    CAPTURE(line);
    int count = 0;
    const std::string found = errorsOf(
        std::string(line) + "\nsize = left.at - edge.at\nif left.error > gap then\n  stop \"Far\"\nend\n",
        count);
    CAPTURE(found);
    CHECK(count == 1);
    CHECK(found.find("`touch x by 9 mm -> left`") != std::string::npos);
    const std::string text = line;
    const bool compares = text.starts_with("touch x by 9 mm ") && !text.ends_with(" mm left");
    CHECK(compares == (found.find("[touch-name-sign]") != std::string::npos));
  }
}

TEST_CASE("cycles: slips of newcomers are one message each, with what to write") {
  constexpr Slip kSlips[] = {
      {"let far = gap * 2", "`far = gap * 2`"},
      {"size := gap", "`size = gap`"},
      {"size == gap", "`size = gap`"},
      {"size += 1 mm", "`size = size + 1 mm`"},
      {"size++", "`size = size + 1`"},
      {"gap * 2 -> size", "`size = gap * 2`"},
      {"size <- gap", "`size = gap`"},
      {"size = abs edge.error", "`abs(edge.error)`"},
      {"size = gap ^ 2", "`square(value)`"},
      {"hole = call bore diameter = 30 mm", "`call bore diameter = 30 mm -> hole`"},
      {"hole = bore diameter = 30 mm", "`call bore diameter = 30 mm -> hole`"},
      {"bore diameter = 30 mm -> hole", "`call bore diameter = 30 mm -> hole`"},
      {"call bore(diameter = 30 mm) -> hole", "`call bore diameter = 30 mm -> hole`"},
      {"call bore 30 mm -> hole", "`call bore parameter = 30 mm -> hole`"},
      {"touch x 10 mm -> far", "`touch x by 10 mm -> far`"},
      {"touch x+ by 10 mm -> far", "the sign of the distance says which way"},
      {"touch +x by 10 mm -> far", "the sign of the distance says which way"},
      {"move x 5 mm", "`move to x 5 mm` or `move by x 5 mm`"},
      {"move z by -5 mm", "`move by z -5 mm`"},
      {"move to x = 5 mm", "`move to x 5 mm`"},
      {"move to x5 mm", "`x 5 mm`"},
      {"move to 5 mm", "`move to x 5 mm`"},
      {"move by dx 5 mm", "`move by x 5 mm`"},
      {"move protected by z -5 mm", "`protected move by z -5 mm`"},
      {"rapid to x 5 mm", "`rapid move to x 5 mm`"},
      {"set tool 5 wear 0.1 mm", "`set tool T length_wear T.length_wear + change`"},
      {"set tool 5 length wear 0.1 mm", "`set tool T length_wear T.length_wear + change`"},
      {"set tool T5 length 80 mm", "`set tool 5 length 80 mm`"},
      {"set G54 x 0 mm", "`set G54: right.at becomes x 0 mm`"},
      {"set G54: x 0 mm", "`set G54: right.at becomes x 0 mm`"},
      {"# a comment", "a comment begins with `//`"},
      {"/* a comment */", "a comment begins with `//`"},
      {"(a comment)", "a comment begins with `//`"},
      {"-- a comment", "a comment begins with `//`"},
      {"#100 = 5", "`#100` is a variable of a control"},
      {"g0 x5", "`g0` is G code"},
      {"wait 1 s", "`dwell 0.5 s`"},
      {"exit", "`alarm \"what is wrong\"`"},
      {"function far", "`call NAME`"},
      {"turn probe off", "`probe off`"},
      {"measure x by 10 mm", "`touch x by 10 mm -> NAME`"},
      {"parameter far = 5 mm", "`parameter far : length = 5 mm`"},
      {"parameter length far", "`parameter far : length`"},
      {"parameter far length", "`parameter far : length`"},
      {"if size > gap {\nend", "`if size > gap then`"},
      {"if size > gap:\nend", "`if size > gap then`"},
      {"if size > gap\nend", "`if size > gap then`"},
      {"while size > gap\nend", "`while size > gap at most 10 times`"},
      {"repeat 3\nend", "`repeat 3 times`"},
      {"for i in 1 to 4\nend", "`for i = 1 to 4`"},
      {"for i = 1, 4\nend", "`for i = 1 to 4`"},
      {"for i = 1 to 4 do\nend", "`for i = 1 to 4`"},
      {"for far = 1 mm, 2 mm, 3 mm\nend", "goes through no list"},
  };
  for (const Slip& slip : kSlips) {
    CAPTURE(slip.line);
    int count = 0;
    const std::string found = errorsOf(std::string(slip.line) + "\n", count);
    CAPTURE(found);
    CHECK(count == 1);
    CHECK(found.find(slip.says) != std::string::npos);
  }
}

TEST_CASE("cycles: words of other languages stay free as names") {
  int count = 0;
  const std::string found = errorsOf("wait = 1 mm\nexit = wait + gap\nmeasure = exit\nlet = measure\n"
                                     "length_wear = let\nwear = length_wear\nsize = wear\n",
                                     count);
  CHECK_MESSAGE(count == 0, found);
}

TEST_CASE("cycles: a name with a choice goes to another one of the same list") {
  SourceMap sources;
  Diagnostics diagnostics;
  const std::string text = "cycle one \"One\"\n"
                           "parameter side  : choice of left, right = left \"Side\"\n"
                           "parameter other : choice of up, down = up       \"Other\"\n"
                           "result    which : choice of left, right        \"Side that was taken\"\n"
                           "kept = side\nif kept is not left then\n  kept = right\nend\n"
                           "which = kept\nif side is kept then\n  which = side\nend\nwhich = other\n";
  const cycle::File file = cycle::parse(sources.add(SourceFile("one.cycle", text, Encoding::Utf8)), sources,
                                        Limits(), diagnostics);
  cycle::check(file, sources, diagnostics);
  std::string found;
  for (const Diagnostic& one : diagnostics.all())
    if (one.severity == Severity::Error) found += one.message + "\n";
  CHECK(found == "`other` is none of the names that may be chosen: `left`, `right`\n");
}

} // namespace dotek::tests
