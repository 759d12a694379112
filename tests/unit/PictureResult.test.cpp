// How a run went, at a glance: words of the banner, and colours that can be read.
#include "sim/picture/PictureResult.h"
#include "sim/picture/PicturePage.h"
#include "sim/picture/PictureReport.h"
#include "sim/picture/PictureView.h"
#include "tests/unit/PictureHelper.h"

#include <cmath>
#include <doctest/doctest.h>
#include <map>

using namespace dotek::sim;
using namespace dotek::tests;

namespace {

double luminance(const std::string& hex) {
  CAPTURE(hex);
  REQUIRE(hex.size() == 7);
  const auto part = [&](std::size_t at) {
    const double c = std::stoi(hex.substr(at, 2), nullptr, 16) / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5);
}
// As WCAG 2 defines it.
double contrast(const std::string& a, const std::string& b) {
  const double first = luminance(a), second = luminance(b);
  return (std::max(first, second) + 0.05) / (std::min(first, second) + 0.05);
}

// The variables of the style sheet from a mark on.
std::map<std::string, std::string> coloursAfter(const std::string& mark) {
  const std::string style(pageStyle());
  const std::size_t at = style.find(mark);
  REQUIRE(at != std::string::npos);
  const std::string block = style.substr(at, style.find('}', at) - at);
  std::map<std::string, std::string> out;
  for (std::size_t i = block.find("--"); i != std::string::npos; i = block.find("--", i + 2)) {
    const std::size_t colon = block.find(':', i), end = block.find(';', i);
    out[block.substr(i + 2, colon - i - 2)] =
        block.substr(colon + 2, std::min<std::size_t>(7, end - colon - 2));
  }
  return out;
}

RunFacts factsOf(Ending ending, std::uint32_t number = 0, const std::string& text = "") {
  RunFacts out;
  out.end.ending = ending;
  out.end.number = number;
  out.end.text = text;
  out.block = {"#3000=7(WEB TOO WIDE)", "web.nc:41", "O0412"};
  return out;
}
void happen(RunFacts& facts, Outcome outcome, std::uint64_t times = 1) {
  facts.events[static_cast<std::size_t>(outcome)] += times;
}

} // namespace

TEST_CASE("colours: the path, marks and texts have a contrast of 4.5:1 or more, in light and in dark") {
  for (const char* mark : {":root {", ":root:not(.on-paper) {"}) {
    CAPTURE(mark);
    const auto colours = coloursAfter(mark);
    REQUIRE(colours.size() > 15);
    for (const char* ground : {"paper", "part-least", "part-most"})
      for (const char* drawn : {"rapid", "feed", "protected", "measuring", "error", "contact"})
        CHECK_MESSAGE(contrast(colours.at(drawn), colours.at(ground)) >= 4.5, drawn << " on " << ground);
    for (const char* ground : {"paper", "page", "chosen", "hover", "button"})
      CHECK_MESSAGE(contrast(colours.at("ink"), colours.at(ground)) >= 4.5, "ink on " << ground);
    for (const char* text : {"dim", "note", "link", "error"})
      CHECK_MESSAGE(contrast(colours.at(text), colours.at("paper")) >= 4.5, text);
  }
}

TEST_CASE("colours: the SVG draws with those of the page on paper, and its grounds are as light") {
  const auto page = coloursAfter(":root {");
  for (const PathKind kind : {PathKind::Rapid, PathKind::Feed, PathKind::Protected, PathKind::Measuring}) {
    CHECK(pathStyle(kind).colour == page.at(std::string(pathKindName(kind))));
    for (const char* ground :
         {"#ffffff", "#f7f8fa", "#edf0f3", "#c3cad3"}) // sheet, material and its hatching
      CHECK_MESSAGE(contrast(pathStyle(kind).colour, ground) >= 4.5, pathKindName(kind) << " on " << ground);
  }
  CHECK(kErrorColour == page.at("error"));
  CHECK(kContactColour == page.at("contact"));
}

TEST_CASE("colours: white on a banner") {
  for (const Verdict verdict : {Verdict::Pass, Verdict::Doubt, Verdict::Fail})
    CHECK(contrast("#ffffff", std::string(bannerColour(verdict))) >= 4.5);
}

TEST_CASE("result: an alarm is the banner of both pictures, with number, text and place") {
  Picture picture = borePicture();
  picture.errors.clear();
  picture.frames = {{"G55", {-300, -200, -250}}};
  RunFacts facts = factsOf(Ending::Alarm, 3007, "WEB <TOO> WIDE");
  facts.callers = "O0412, called by O9000";
  const PictureResult result = resultOf(picture, facts);
  CHECK(result.verdict == Verdict::Fail);
  CHECK(result.word == "ALARM 3007");
  CHECK(result.text == "WEB <TOO> WIDE");
  CHECK(result.place == "O0412, called by O9000; web.nc:41");
  CHECK(result.block == "#3000=7(WEB TOO WIDE)");
  // The last move ends with the ball's centre at Z-407, 177 below the gauge line.
  CHECK(result.position == "G55 X123.300 Y50.000 Z20.000; machine X-176.700 Y-150.000 Z-410.000 (tip), "
                           "Z-230.000 (gauge line); mm");
  CHECK_FALSE(result.error.has_value());
  CHECK(endingText(facts) == "ALARM 3007: WEB <TOO> WIDE");
  picture.result = result;
  for (const std::string& shown : {pictureSvg(picture), pictureHtml(picture)}) {
    CHECK(shown.find("id=\"banner\" class=\"fail\"") != std::string::npos);
    CHECK(shown.find("WEB &lt;TOO&gt; WIDE") != std::string::npos);
    CHECK(shown.find("<title>ALARM 3007 - ") != std::string::npos);
    for (const char* number : {"X-176.700", "Z-410.000", " (tip), ", "Z-230.000"})
      CHECK(shown.find(number) != std::string::npos);
  }
}

TEST_CASE("result: a run that passes with warnings says how many") {
  Picture picture = borePicture();
  picture.errors.clear();
  RunFacts facts = factsOf(Ending::ProgramEnd);
  facts.warnings = 2;
  const PictureResult result = resultOf(picture, facts);
  CHECK(result.word == "PASS");
  CHECK(result.text == "the program came to its end; 2 warnings, listed below");
  CHECK(result.counts.back() == "2 warnings");
}

TEST_CASE("result: every ending has a word and a verdict") {
  Picture picture = borePicture();
  picture.errors.clear();
  const auto word = [&](const RunFacts& facts) { return resultOf(picture, facts).word; };
  const auto verdict = [&](const RunFacts& facts) { return resultOf(picture, facts).verdict; };
  for (const Ending ending : {Ending::ProgramEnd, Ending::TextEnd}) {
    CHECK(word(factsOf(ending)) == "PASS");
    CHECK(verdict(factsOf(ending)) == Verdict::Pass);
    CHECK(endingText(factsOf(ending)) == "");
  }
  CHECK(word(factsOf(Ending::Alarm, 0, "X")) == "ALARM");
  CHECK(resultOf(picture, factsOf(Ending::Alarm, 3001)).text == "the alarm has no text");
  for (const Ending ending : {Ending::Inconclusive, Ending::Call, Ending::Return}) {
    CHECK(word(factsOf(ending, 0, "why")) == "INCONCLUSIVE");
    CHECK(verdict(factsOf(ending, 0, "why")) == Verdict::Doubt);
  }
  CHECK(word(factsOf(Ending::Limit)) == "STOPPED");
  RunFacts unread = factsOf(Ending::Running);
  unread.unread = "the comment has no `)`";
  CHECK(word(unread) == "NOT READ");
  CHECK(verdict(unread) == Verdict::Fail);
  picture.part.reset();
  const auto saysNoPart = [&] {
    return resultOf(picture, factsOf(Ending::ProgramEnd)).text.find("no part") != std::string::npos;
  };
  CHECK_FALSE(saysNoPart()); // a tool setter was touched
  picture.contacts.clear();
  CHECK(saysNoPart());
}

TEST_CASE("result: a collision comes before the alarm that follows from it; a miss is no plain pass") {
  const Picture picture = borePicture(); // its only error is a rapid into the part, in block 20
  RunFacts facts = factsOf(Ending::Alarm, 3092, "PROBE OPEN");
  happen(facts, Outcome::RapidIntoPart);
  happen(facts, Outcome::EarlyContact);
  happen(facts, Outcome::Miss, 2);
  const PictureResult result = resultOf(picture, facts);
  CHECK(result.word == "COLLISION");
  CHECK(result.text == "the probe runs into the part in rapid <G0>; then ALARM 3092: PROBE OPEN");
  CHECK(result.place == "bore.nc:20");
  CHECK(result.error == 0);
  CHECK(result.block == "G0 X-200.");
  CHECK(result.counts ==
        std::vector<std::string>{"1 collision", "1 probe fault", "2 misses", "6 contacts", "20 moves"});

  RunFacts travel = factsOf(Ending::ProgramEnd);
  happen(travel, Outcome::OutsideTravel);
  CHECK(resultOf(picture, travel).word == "OVER-TRAVEL");
  CHECK(resultOf(picture, travel).verdict == Verdict::Fail);

  RunFacts missed = factsOf(Ending::ProgramEnd);
  happen(missed, Outcome::Miss);
  Picture clean = picture;
  clean.errors.clear();
  CHECK(resultOf(clean, missed).word == "PASS, WITH MISSES");
  CHECK(resultOf(clean, missed).verdict == Verdict::Doubt);
  // The miss is the worst of that run: the pictures show it, though a touch comes after it.
  clean.errors.push_back({clean.moves[3].to, "met nothing", 3, std::nullopt, PictureError::Kind::Miss});
  CHECK(resultOf(clean, missed).error == 0);
  CHECK(resultOf(clean, missed).place == "bore.nc:4");
  clean.errors.clear();
}
