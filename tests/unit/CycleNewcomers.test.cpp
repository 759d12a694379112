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
      // Titles and the order of a declaration.
      {"parameter far : length = 8 mm  From the start down",
       "`parameter far : length = 8 mm \"From the start down\"`"},
      {"parameter far : length From the edge require far > 0 mm",
       "`parameter far : length \"From the edge\" require far > 0 mm`"},
      {"parameter far : length = 8 mm from_the_start", "`parameter far : length = 8 mm \"from the start\"`"},
      {"result far : length Way", "`result far : length \"Way\"`"},
      {"parameter far : work_offset = G54 optional \"Far\"",
       "`parameter far : work_offset optional \"Far\"`"},
      {"parameter far : length \"Far\" = 5 mm", "`parameter far : length = 5 mm \"Far\"`"},
      {"parameter far : length range 1 mm to 9 mm \"Far\"",
       "`parameter far : length \"Far\" range 1 mm to 9 mm`"},
      {"result far : length = 0 mm \"Far\"", "`result far : length \"Far\"`"},
      {"parameter far : length \"Far\" range 1 mm, 50 mm", "`range 1 mm to 50 mm`"},
      {"parameter far : length \"Far\" range 1 mm - 50 mm", "`range 1 mm to 50 mm`"},
      {"parameter far : length \"Far\" range 1..50 mm", "`range 1 mm to 50 mm`"},
      {"parameter far : length \"Far\" range -5 mm, -1 mm", "`range -5 mm to -1 mm`"},
      {"parameter far : choice of left right = left \"Far\"", "`parameter far : choice of left, right"},
      {"parameter far : choice of left or right", "`parameter far : choice of left, right`"},
      {"parameter far : choice left, right", "`parameter far : choice of left, right`"},
      {"parameter far : length \"Far\" range from 1 mm to 5 mm", "`range 1 mm to 5 mm`"},
      {"parameter far : length \"Far\" require > 0 mm", "require far > 0 mm`"},
      {"parameter end : length \"Far\"", "`end_value`"},
      {"touch x by gap -> then", "`then_value`"},
      {"parameter far : length = 5 cm \"Far\"", "`cm` is no unit"},
      // Two statements in a line.
      {"spindle off probe on", "`probe on` in the next one"},
      {"size = gap; probe on", "`probe on` in the next one"},
      {"size = gap;", "take out the `;`"},
      {"size = gap * 2 far = gap", "`far = gap` in the next one"},
      {"call bore diameter = 30 mm depth = 5 mm -> hole",
       "`call bore diameter = 30 mm, depth = 5 mm -> hole`"},
      // Conditions.
      {"if 0 mm < edge.at < 5 mm then\nend", "`0 mm < edge.at and edge.at < 5 mm`"},
      {"if gap > 1 mm and < 5 mm then\nend", "`gap > 1 mm and gap < 5 mm`"},
      {"if given gap and > 1 mm then\nend", "`given gap and gap > 1 mm`"},
      {"if gap given then\nend", "`if given gap then`"},
      {"if gap is given then\nend", "`if given gap then`"},
      {"if gap is not given then\nend", "`if not given gap then`"},
      {"if gap not given then\nend", "`if not given gap then`"},
      {"if gap exists then\nend", "`if given gap then`"},
      // Touches and offsets.
      {"touch x by gap feed 50 mm/min -> far", "`touch x by gap -> far`"},
      {"touch x by gap, y by gap -> far", "`touch along x 1, y 1 by 10 mm -> far`"},
      {"touch x by gap -> far overtravel 3 mm", "`touch x by gap overtravel 3 mm -> far`"},
      {"set G54: edge.at becomes x 0, y 0", "`set G54: edge.at becomes x 0, top.at becomes y 0`"},
      {"set G54: edge.at becomes x = 0 mm", "`set G54: edge.at becomes x 0 mm`"},
      {"move to G53 z 0 mm", "`move to machine z 0 mm`"},
      {"protected move G53 z 0 mm", "`protected move to machine z 0 mm`"},
      {"move to G55 z 0 mm", "`move to work G55 z 0 mm`"},
      {"move to machine G53 z 0 mm", "`move to machine z 0 mm`"},
      {"move to z 0 mm G53", "`move to machine z 0 mm`"},
      {"move machine z 0 mm", "`move to machine z 0 mm`"},
      {"move to x 5 mm y 10 mm", "`move to x 5 mm, y 10 mm`"},
      {"set G53: edge.at becomes x 0 mm", "those are `G54` to `G59`"},
      {"set G60: edge.at becomes x 0 mm", "those are `G54` to `G59`"},
      {"set 54: edge.at becomes x 0 mm", "write `G54`"},
      // Words and numbers.
      {"probe_on", "`probe on`"},
      {"move_to x 5 mm", "`move to x 5 mm`"},
      {"break", "`while CONDITION at most 10 times`"},
      {"message \"ok\"", "`stop \"text\"`"},
      {"case gap\nsize = gap\nend", "`if side is left then`"},
      {"protected move by y 1_000 mm", "`1000`"},
      {"protected move by y 1 000 mm", "`1000`"},
      {"protected move by y 1 000,5 mm", "`1000.5`"},
      {"dwell 500", "`0.5 s` where these are milliseconds, else `500 s`"},
      {"size = edge.at + probe_radius", "did you mean `ball_radius`?"},
      {"size = gap * 180 / pi", "angles have their unit"},
      {"size = left.at\nsize = left.at + left.error", "nothing is called `left`"},
      {"touch x by gap\nsize = left.at\nsize = left.at + left.error", "`touch x by gap -> left`"},
      {"far = gap > 1 mm\nif far is 1 then\nend", "write `far`"},
      {"far = gap > 1 mm\nif far is 0 then\nend", "write `not far`"},
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

TEST_CASE("cycles: what a line that could not be read began or asked for is no further mistake") {
  const auto errors = [](const std::string& text) {
    SourceMap sources;
    Diagnostics diagnostics;
    const cycle::File file = cycle::parse(sources.add(SourceFile("one.cycle", text, Encoding::Utf8)), sources,
                                          Limits(), diagnostics);
    cycle::check(file, sources, diagnostics);
    std::string out;
    for (const Diagnostic& one : diagnostics.all())
      if (one.severity == Severity::Error) out += one.message + " [" + std::string(one.code) + "]\n";
    return out;
  };
  const auto count = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  const std::string rest = "parameter gap : length = 5 mm \"Gap\" require gap > 0 mm\n"
                           "parameter limit : length optional \"Limit\"\n";
  const std::string run = "touch x by gap -> edge\nprotected move to start\nprobe off\n";
  for (const std::string& text :
       {"cycle one \"One\" ; Seite\n" + rest + "probe on\n" + run,
        "cycle one-side\n" + rest + "probe on\n" + run,
        "# Side\ncycle one \"One\"\n" + rest + "probe on\n" + run,
        "%\ncycle one \"One\"\n" + rest + "probe on\n" + run,
        "cycle one \"One\"\n" + rest + "probe_on\n" + run,
        "cycle one \"One\"\n" + rest + "probe on M19\n" + run,
        "cycle one \"One\"\n" + rest + "spindle off probe on\n" + run,
        "cycle one \"One\"\n" + rest + "probe on\n" + run +
            "if limit is given then\n  if edge.at > limit then\n    alarm \"Far\"\n  end\nend\n",
        "cycle one \"One\"\nparameter Gap : length = 5 mm \"Gap\" require gap > 0 mm\nprobe on\n" + run}) {
    const std::string found = errors(text);
    CHECK_MESSAGE(count(found) == 1, text << found);
  }
}

TEST_CASE("cycles: a letter that no call hands over, or that two parameters wish for, is an error") {
  int count = 0;
  std::string found = errorsOf("", count);
  CHECK(count == 0);
  for (const auto& [line, says] :
       {std::pair{"parameter far : length \"Far\" letter G", "a call takes G, L, N, O and P for itself"},
        std::pair{"parameter far : length \"Far\" letter d", "write one capital"},
        std::pair{"parameter far : length \"Far\" letter D\nparameter wide : length \"Wide\" letter D",
                  "is wished for twice"}}) {
    SourceMap sources;
    Diagnostics diagnostics;
    const std::string text = "cycle one \"One\"\n" + std::string(line) + "\nsize = 1 mm\n";
    const cycle::File file = cycle::parse(sources.add(SourceFile("one.cycle", text, Encoding::Utf8)), sources,
                                          Limits(), diagnostics);
    cycle::check(file, sources, diagnostics);
    found.clear();
    for (const Diagnostic& one : diagnostics.all())
      if (one.severity == Severity::Error) found += one.message + " [" + std::string(one.code) + "]\n";
    CHECK_MESSAGE(found.find(says) != std::string::npos, line << "\n" << found);
    CHECK_MESSAGE(std::count(found.begin(), found.end(), '\n') == 1, line << "\n" << found);
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

TEST_CASE("cycles: values and coordinates as drawings and G code have them are one message each") {
  constexpr Slip kSlips[] = {
      {"far = 5 [mm]", "write `5 mm`"},
      {"far = 5 (mm)", "write `5 mm`"},
      {"parameter far : length = 5 [mm] \"Far\"", "write `5 mm`"},
      {"parameter share : ratio = 50 % \"Share\"", "write `0.5`"},
      {"size = gap * 12.5%", "write `0.125`"},
      {"parameter most : length = +/- 0.1 mm \"Tolerance\"", "write `0.1 mm`"},
      {"if edge.error > +/- gap then\nend", "`abs(error) > tolerance`"},
      {"protected move to X10 Y20", "write `protected move to x 10 mm, y 20 mm`"},
      {"protected move X10 Y-20.5", "write `protected move to x 10 mm, y -20.5 mm`"},
      {"rapid move to X10. mm, Z+5.", "write `rapid move to x 10 mm, z 5 mm`"},
      {"move by A90", "write `move by a 90 deg`"},
      {"feed move by z -2 mm F 200", "write `feed move by z -2 mm feed 200 mm/min`"},
      {"feed move by z -2 mm F200", "write `feed move by z -2 mm feed 200 mm/min`"},
      {"feed move by Z-2 F200.", "write `feed move by z -2 mm feed 200 mm/min`"},
      {"alarm \"Off by \" + edge.error", "`report \"Off by \" measured edge.error`"},
      {"stop \"Off by \", edge.error", "`report \"Off by \" measured edge.error`"},
      {"protected move by x gap * cos(90 * 2)", "write `90 deg * 2`"},
      {"protected move by x gap * cos(2 * 90)", "write `2 deg * 90`"},
      {"protected move by x 2 * 3", "write `2 mm * 3`"},
      {"if size > gap then alarm \"Far\" end", "write `alarm` in a line of its own"},
      {"if size > gap then alarm \"Far\"; end // far", "write `alarm` in a line of its own"},
      {"if size > gap then\n  stop \"Far\"\nend\nelse if size > 1 mm then\n  stop \"Near\"\nend",
       "the `end` of line 10 has closed it; take that `end` out"},
      {"if size > gap then\n  stop \"Far\"\nend\nelse\n  stop \"Near\"\nend",
       "the `end` of line 10 has closed it; take that `end` out"},
      {"far = 1\nif far is 1 or 2 then\n  stop \"Far\"\nend", "write `far is 1 or far is 2`"},
      {"far = 1\nif far is not 1 or 2 then\n  stop \"Far\"\nend", "write `far is not 1 and far is not 2`"},
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

TEST_CASE("cycles: a choice on one side of `or` is one message, and a missing `end` no second one") {
  const auto said = [](const std::string& text) {
    SourceMap sources;
    Diagnostics diagnostics;
    const cycle::File file = cycle::parse(sources.add(SourceFile("one.cycle", text, Encoding::Utf8)), sources,
                                          Limits(), diagnostics);
    cycle::check(file, sources, diagnostics);
    std::string out;
    for (const Diagnostic& one : diagnostics.all())
      out += one.message + " [" + std::string(one.code) + "]\n";
    return out;
  };
  const std::string sides =
      "cycle one \"One\"\nparameter side : choice of left, right, front = left \"Side\"\n"
      "spindle off\nprobe on\n";
  CHECK(said(sides + "if side is left or right or front then\n  touch x by 5 mm\nend\nprobe off\n") ==
        "`or` joins two whole comparisons; write `side is left or side is right` [half-comparison]\n");
  CHECK(said("cycle one \"One\"\nspindle off\nprobe on\ntouch x by 5 mm -> far else\n  alarm \"Not there\"\n"
             "probe off\n") ==
        "this `touch .. else` has no `end`; write `end` where what depends on it is over "
        "[block-not-closed]\n");
}

TEST_CASE("cycles: what hardly anybody means is a warning, once, and what looks like it is none") {
  const auto warned = [](const std::string& lines) {
    SourceMap sources;
    Diagnostics diagnostics;
    const std::string text = "cycle one \"One\"\n"
                             "parameter gap  : length = 5 mm \"Gap\"\n"
                             "result    size : length        \"Size\"\n"
                             "spindle off\nprobe on\nsize = gap\nk = 0\n" +
                             lines + "probe off\nif k > 90 then\n  stop \"Late\"\nend\n";
    const cycle::File file = cycle::parse(sources.add(SourceFile("one.cycle", text, Encoding::Utf8)), sources,
                                          Limits(), diagnostics);
    cycle::check(file, sources, diagnostics);
    std::string out;
    for (const Diagnostic& one : diagnostics.all())
      out += (out.empty() ? "" : " ") + std::string(one.code);
    return out;
  };
  const std::string touch = "touch x by gap -> side\n";
  struct Lines {
    std::string text;
    const char* warnings;
  };
  for (const Lines& one : {
           Lines{touch + "touch x by -gap -> side\nsize = side.at\n", "found-twice"},
           Lines{touch + "size = side.at\ntouch x by -gap -> side\nsize = size - side.at\n", ""},
           Lines{touch + "if size > 3 mm then\n  size = side.at\nend\ntouch x by -gap -> side\n", ""},
           Lines{touch + "touch y by side.error + gap -> side\nsize = side.at\n", ""},
           Lines{"for i = 5 to 1\n  " + touch + "end\n", "loop-never-runs"},
           Lines{"for i = 1 to 5 step -1\n  " + touch + "end\n", "loop-never-runs"},
           Lines{"for i = 5 to 1 step -1\n  " + touch + "end\n", ""},
           Lines{"for i = 1 to 1\n  " + touch + "end\n", ""},
           Lines{"while k < 3 at most 10 times\n  " + touch + "end\n", "loop-unchanged"},
           Lines{"while k < 3 at most 10 times\n  " + touch + "  k = k + 1\nend\n", ""},
           Lines{touch + "while side.error > 1 mm at most 10 times\n  " + touch + "end\n", ""},
           Lines{touch + "if abs(side.error) > -0.1 mm then\n  stop \"Far\"\nend\n", "compared-always"},
           Lines{touch + "if -0.1 mm < abs(side.error) then\n  stop \"Far\"\nend\n", "compared-always"},
           Lines{touch + "if abs(side.error) < 0 mm then\n  stop \"Far\"\nend\n", "compared-always"},
           Lines{touch + "if abs(side.error) >= 0 mm then\n  stop \"Far\"\nend\n", "compared-always"},
           Lines{touch + "if abs(side.error) > 0 mm then\n  stop \"Far\"\nend\n", ""},
           Lines{touch + "if side.error > -0.1 mm then\n  stop \"Far\"\nend\n", ""},
           Lines{touch + "size = side.at - side.at\n", "compared-always"},
           Lines{touch + "size = side.at - gap\n", ""},
           Lines{touch + "if side.error > 0.1 mm and side.error < -0.1 mm then\n  stop \"Far\"\nend\n",
                 "compared-always"},
           Lines{touch + "if side.error < 0.1 mm or -0.1 mm < side.error then\n  stop \"Far\"\nend\n",
                 "compared-always"},
           Lines{touch + "if side.error > 0.1 mm or side.error < -0.1 mm then\n  stop \"Far\"\nend\n", ""},
           Lines{touch + "if side.error > -0.1 mm and side.error < 0.1 mm then\n  stop \"Far\"\nend\n", ""},
           Lines{touch + "touch y by gap -> far\nsize = side.at + far.at / 2\n", "mean-divisor"},
           Lines{touch + "touch y by gap -> far\nsize = (side.at + far.at) / 3\n", "mean-divisor"},
           Lines{touch + "touch y by gap -> far\nsize = (side.at + far.at) / 2\n", ""},
           Lines{touch + "touch y by gap -> far\nsize = (side.at + far.at) / 4\n", ""},
           Lines{touch + "touch y by gap -> far\nsize = side.at - far.at / 2\n", ""},
           Lines{"sum = 0 mm\nfor i = 1 to 5\n  " + touch + "  sum = sum + side.at\nend\nsize = sum / 4\n",
                 "mean-divisor"},
           Lines{"sum = 0 mm\nrepeat 5 times\n  " + touch + "  sum = sum + side.at\nend\nsize = sum / 5\n",
                 ""},
           Lines{touch + "spare = side.at * 2\n", "name-unread"},
           Lines{touch + "spare = side.at * 2\nsize = spare\n", ""},
       }) {
    CAPTURE(one.text);
    CHECK(warned(one.text) == one.warnings);
  }
}

TEST_CASE(
    "cycles: moves that nothing watches, an end below the start and a spindle that turns are warnings") {
  const auto warned = [](const std::string& lines, const std::string& before) {
    SourceMap sources;
    Diagnostics diagnostics;
    const std::string text = "cycle one \"One\"\nparameter low : length = 5 mm \"Low\"\n" + before +
                             "probe on\n" + lines + "probe off\nif low > 9 mm then\n  alarm \"Low\"\nend\n";
    const cycle::File file = cycle::parse(sources.add(SourceFile("one.cycle", text, Encoding::Utf8)), sources,
                                          Limits(), diagnostics);
    cycle::check(file, sources, diagnostics);
    std::string out;
    for (const Diagnostic& one : diagnostics.all())
      out += std::string(one.code) + ' ';
    return out;
  };
  struct Lines {
    const char* text;
    const char* warnings;
  };
  for (const Lines& one : {
           Lines{
               "protected move by z -low\ntouch x by 5 mm\nrapid move by x 30 mm\nprotected move to start\n",
               "move-unwatched "},
           Lines{"protected move by z -low\nfeed move by y 2 mm feed 100 mm/min\nprotected move to start\n",
                 "move-unwatched "},
           Lines{"protected move by z -low\ntouch x by 5 mm\nmove to start\n", "move-unwatched "},
           Lines{
               "protected move by z -low\ntouch x by 5 mm\nprotected move by z low\nrapid move by x 30 mm\n",
               ""},
           Lines{"protected move by z -low\ntouch x by 5 mm\nrapid move by z low\nrapid move by x 30 mm\n",
                 ""},
           Lines{"rapid move by x 30 mm\nprotected move by z -low\nprotected move to start\n", ""},
           Lines{"protected move by z -low\ntouch x by 5 mm\n", "ends-lower "},
           Lines{"protected move by z -low\ntouch x by 5 mm\nif low > 3 mm then\n  protected move to "
                 "start\nend\n",
                 "ends-lower "},
           Lines{"protected move by z -2 * low\ntouch x by 5 mm\nprotected move to z start.z\n", ""},
           Lines{"rapid move by z low\nrapid move by x 9 mm\nrapid move by z -low\n", ""},
           Lines{"touch x by 5 mm\n", ""},
       }) {
    CAPTURE(one.text);
    CHECK(warned(one.text, "spindle off\n") == one.warnings);
  }
  CHECK(warned("touch x by 5 mm\n", "") == "spindle-unstopped ");
  CHECK(warned("call bore diameter = 20 mm\n", "").find("spindle-unstopped") == std::string::npos);
}

} // namespace dotek::tests
