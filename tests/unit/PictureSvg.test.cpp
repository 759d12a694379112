#include "sim/picture/PicturePlanes.h"
#include "sim/picture/PictureResult.h"
#include "sim/picture/PictureText.h"
#include "sim/picture/PictureView.h"
#include "tests/GoldenRunner.h"
#include "tests/unit/PictureHelper.h"

#include <algorithm>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

using namespace dotek::sim;
using namespace dotek::tests;

namespace {

// What is wrong with a text as XML; empty: nothing. As strict as these files need.
std::string xmlFault(const std::string& text) {
  std::vector<std::string> open;
  std::set<std::string> ids;
  for (std::size_t at = 0; at < text.size();) {
    const auto c = static_cast<unsigned char>(text[at]);
    if (c < 0x20 && c != '\n') return "control character at " + std::to_string(at);
    if (c == '&') {
      const std::size_t end = text.find(';', at);
      const std::string name = text.substr(at + 1, end - at - 1);
      if (name != "amp" && name != "lt" && name != "gt" && name != "quot" && name != "#39")
        return "entity " + name;
    }
    if (c == '>') return "> at " + std::to_string(at);
    if (c != '<') {
      ++at;
      continue;
    }
    ++at;
    const bool closes = text[at] == '/';
    if (closes) ++at;
    const std::size_t nameEnd = text.find_first_of(" />\n", at);
    const std::string name = text.substr(at, nameEnd - at);
    at = nameEnd;
    if (closes) {
      if (open.empty() || open.back() != name) return "</" + name + "> closes nothing";
      open.pop_back();
      if (text[at] != '>') return "</" + name + " has no end";
      ++at;
      if (open.empty())
        return text.find_first_not_of('\n', at) == std::string::npos ? "" : "text after the end";
      continue;
    }
    std::set<std::string> attributes;
    for (;;) {
      at = text.find_first_not_of(" \n", at);
      if (at == std::string::npos) return "no end of <" + name;
      if (text[at] == '>' || text[at] == '/') break;
      const std::size_t equals = text.find("=\"", at);
      if (equals == std::string::npos) return "attribute of <" + name;
      const std::string attribute = text.substr(at, equals - at);
      if (!attributes.insert(attribute).second) return "twice " + attribute;
      const std::size_t end = text.find('"', equals + 2);
      const std::string value = text.substr(equals + 2, end - equals - 2);
      if (value.find('<') != std::string::npos) return "< in " + attribute;
      if (value.find("nan") != std::string::npos || value.find("inf") != std::string::npos)
        return attribute + " is " + value;
      if (attribute == "id" && !ids.insert(value).second) return "two elements " + value;
      at = end + 1;
    }
    if (text[at] == '/') {
      ++at;
    } else {
      open.push_back(name);
    }
    if (text[at] != '>') return "no end of <" + name;
    ++at;
  }
  return "it does not end";
}

std::size_t countOf(const std::string& text, const std::string& what) {
  std::size_t out = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++out;
  return out;
}

double attribute(const std::string& text, const std::string& element, const std::string& name) {
  const std::size_t at = text.find(element);
  REQUIRE(at != std::string::npos);
  const std::size_t value = text.find(" " + name + "=\"", at);
  REQUIRE(value != std::string::npos);
  return std::stod(text.substr(value + name.size() + 3));
}

} // namespace

TEST_CASE("picture texts: what XML and scripts may hold") {
  CHECK(xmlText("a<b>&\"'\x01\t") == "a&lt;b&gt;&amp;&quot;&#39;  ");
  CHECK(xmlText("\xC5\x99\xE8x\xED\xA0\x80\xC0\xAF") ==
        "\xC5\x99\xEF\xBF\xBDx\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
  CHECK(xmlText("\xF0\x9F\x98\x80!") == "\xF0\x9F\x98\x80!");
  // A name that turns the order of letters, or steers a terminal, is shown as in messages.
  CHECK(xmlText("a\xE2\x80\xAE"
                "b\xC2\x9B"
                "c\xE2\x81\xA6") == "a?b?c?");
  CHECK(jsonText("a\xE2\x80\xAE"
                 "b\xC2\x9B") == "\"a?b?\"");
  CHECK(xmlText("abcdef", 3) == "abc\xE2\x80\xA6");
  CHECK(jsonText("</script>\"\\\n") == "\"\\u003c/script\\u003e\\\"\\\\ \"");
  CHECK(shortNumber(12.500, 2) == "12.5");
  CHECK(shortNumber(-0.001, 2) == "0");
  CHECK(shortNumber(-100, 0) == "-100");
  CHECK(shortNumber(1200, 3) == "1200");
}

TEST_CASE("svg: three views, the kinds of moves, contacts, errors, legend, scale") {
  const std::string svg = pictureSvg(borePicture());
  CHECK(xmlFault(svg) == "");
  for (const char* id : {"XY", "XZ", "YZ", "legend", "scale", "errors"})
    CHECK(countOf(svg, std::string("id=\"") + id + "\"") == 1);
  for (const char* kind : {"rapid", "feed", "protected", "measuring"}) {
    CHECK(countOf(svg, std::string("<path class=\"") + kind + "\"") == 3);
    CHECK(countOf(svg, std::string(">") + kind + " move<") == 1);
  }
  for (const char* contact : {">3<", ">1,2<", ">5<", ">6<", ">3,4<"})
    CHECK(svg.find(contact) != std::string::npos);
  CHECK(countOf(svg, ">E1<") == 4); // in three views and in the list
  CHECK(svg.find("bore.nc:20: the probe runs into the part in rapid &lt;G0&gt;; the stylus breaks") !=
        std::string::npos);
  CHECK(svg.find(">XY at Z -407.970, through contact 1<") != std::string::npos);
  CHECK(countOf(svg, "fill=\"url(#cut)\"") == 4);
  CHECK(svg.find("the path leaves the picture in 2 moves") != std::string::npos);
  CHECK(svg.find("http") == svg.find("http://www.w3.org/2000/svg"));
  CHECK(countOf(svg, "http") == 1);
  CHECK(svg.size() < 60'000);
  CHECK(svg == pictureSvg(borePicture()));
}

TEST_CASE("svg: crosses have a rim that lifts them off the hatching, labels stay within their view") {
  CHECK(countOf(pictureSvg(borePicture()),
                "stroke=\"#ffffff\" stroke-width=\"6\" stroke-linecap=\"round\"") == 3);
  // A narrow view, that of a long way down onto the setter.
  PictureMaker make;
  make.picture.setter.emplace();
  make.picture.setter->at = {-50, -40, -430};
  make.picture.setter->diameter = 20;
  make.start({-50, -40, -130});
  make.block("G31 Z-430.");
  make.move(PathKind::Measuring, {-50, -40, -430});
  const std::string svg = pictureSvg(make.picture);
  constexpr double kWidth = 6.9 * 11 + 2;
  std::size_t labels = 0;
  for (const char* view : {"2", "1", "0"}) {
    const std::string clip = std::string("id=\"clip") + view + "\"";
    const double left = attribute(svg, clip, "x"), width = attribute(svg, clip, "width");
    const std::string name = view[0] == '2'   ? "<g id=\"XY\""
                             : view[0] == '1' ? "<g id=\"XZ\""
                                              : "<g id=\"YZ\"";
    const std::size_t begin = svg.find(name), end = svg.find(">tool setter<", begin);
    REQUIRE(end != std::string::npos);
    const std::size_t text = svg.rfind("<text", end);
    const double middle = std::strtod(svg.c_str() + svg.find("x=\"", text) + 3, nullptr);
    CHECK(middle - kWidth / 2 >= left);
    CHECK(middle - kWidth / 2 <= left + std::max(width - kWidth, 2.5));
    ++labels;
  }
  CHECK(labels == 3);
}

TEST_CASE("svg: kinds of moves differ in colour and in line") {
  std::set<std::string> colours, lines;
  for (const PathKind kind : {PathKind::Rapid, PathKind::Feed, PathKind::Protected, PathKind::Measuring}) {
    colours.insert(pathStyle(kind).colour);
    lines.insert(std::string(pathStyle(kind).dashes) + "/" + pathStyle(kind).width);
  }
  CHECK(colours.size() == 4);
  CHECK(lines.size() == 4);
  CHECK(colours.count(kErrorColour) == 0);
}

TEST_CASE("svg: one scale for the three views and the bar") {
  Picture picture = borePicture();
  picture.errors.clear();
  const std::string svg = pictureSvg(picture);
  const Region region = regionOf(picture);
  const double xWidth = attribute(svg, "id=\"clip2\"", "width"),
               yHeight = attribute(svg, "id=\"clip2\"", "height");
  const double scale = xWidth / (region.most.x - region.least.x);
  CHECK(yHeight / (region.most.y - region.least.y) == doctest::Approx(scale).epsilon(1e-4));
  CHECK(attribute(svg, "id=\"clip1\"", "width") == xWidth);
  CHECK(attribute(svg, "id=\"clip0\"", "width") == yHeight);
  CHECK(attribute(svg, "id=\"clip0\"", "height") == attribute(svg, "id=\"clip1\"", "height"));
  CHECK(attribute(svg, "id=\"clip1\"", "x") == attribute(svg, "id=\"clip2\"", "x"));
  CHECK(attribute(svg, "id=\"clip0\"", "y") == attribute(svg, "id=\"clip1\"", "y"));
  const std::string bar = svg.substr(svg.find("id=\"scale\""), 400);
  CHECK(bar.find(">20 mm<") != std::string::npos);
  CHECK(std::stod(bar.substr(bar.find("v8h") + 3)) == doctest::Approx(20 * scale).epsilon(1e-3));
  CHECK(roundLength(1) == 1);
  CHECK(roundLength(4.99) == 2);
  CHECK(roundLength(5) == 5);
  CHECK(roundLength(99) == 50);
  CHECK(roundLength(0.03) == doctest::Approx(0.02));
}

TEST_CASE("svg: a contact is where it is") {
  Picture picture;
  picture.moves = {{PathKind::Measuring, {0, 0, 0}, {40, 30, 20}, true, 0}};
  picture.contacts = {{{10, 20, 5}, 0}};
  const Region region = regionOf(picture);
  const std::string svg = pictureSvg(picture);
  const std::string view = svg.substr(svg.find("<g id=\"YZ\""));
  const double scale = attribute(svg, "id=\"clip2\"", "width") / (region.most.x - region.least.x);
  const double left = attribute(svg, "id=\"clip0\"", "x"), top = attribute(svg, "id=\"clip0\"", "y");
  const std::string dot = "r=\"3.2\" stroke-width";
  const std::size_t at = view.rfind("<circle", view.find(dot));
  CHECK(attribute(view.substr(at), "<circle", "cx") ==
        doctest::Approx(left + (20 - region.least.y) * scale).epsilon(1e-4));
  CHECK(attribute(view.substr(at), "<circle", "cy") ==
        doctest::Approx(top + (region.most.z - 5) * scale).epsilon(1e-4));
}

TEST_CASE("svg: valid whatever the picture") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  std::vector<Picture> pictures;
  pictures.emplace_back();
  pictures.back().title = "nothing <&> \x02 \xFF";
  pictures.push_back(borePicture());
  pictures.back().part.reset();
  pictures.push_back(borePicture());
  pictures.back().moves.clear(); // contacts and errors name moves that are not there
  pictures.push_back(borePicture());
  pictures.back().moves[3].to = {1e300, -1e300, 0};
  pictures.back().moves[4].to = {nan, 0, inf};
  pictures.back().contacts[0].point = {nan, nan, nan};
  pictures.back().errors[0].at = {-inf, 0, 0};
  pictures.back().probe.ballDiameter = nan;
  pictures.push_back(borePicture());
  for (PictureMove& move : pictures.back().moves) {
    move.from = {-9e5, 9e5, -9e5};
    move.to = {9e5, -9e5, 9e5};
    move.block = 99;
  }
  pictures.emplace_back(); // one place
  pictures.back().moves.push_back({PathKind::Feed, {1, 2, 3}, {1, 2, 3}, true, 0});
  pictures.emplace_back(); // a material without end
  PartBuilder builder;
  builder.halfSpace({0, 0, 0}, {0.3, 0.2, 1});
  pictures.back().part = *finish(builder);
  pictures.push_back(borePicture());
  for (int i = 0; i < 100; ++i) // long texts without blanks, many errors
    pictures.back().errors.push_back({{-200, -150, -380.0 + i}, std::string(500, 'x') + "\xC5\x99", 3});
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    CAPTURE(i);
    const std::string svg = pictureSvg(pictures[i]);
    CHECK(xmlFault(svg) == "");
    CHECK(svg.size() < 200'000);
    for (const char* element : {"<svg", "id=\"clip2\"", "id=\"clip1\"", "id=\"clip0\""}) {
      CHECK(attribute(svg, element, "width") >= 1);
      CHECK(attribute(svg, element, "width") < 3000);
      CHECK(attribute(svg, element, "height") < 4000);
    }
  }
  CHECK(pictureSvg(pictures[0]).find("no probe is stated") != std::string::npos);
  CHECK(pictureSvg(pictures[1]).find("no probe is stated") == std::string::npos);
  const std::string lost = pictureSvg(pictures[3]);
  CHECK(lost.find("2 moves not drawn") != std::string::npos);
  CHECK(lost.find("2 marks without a place on the sheet") != std::string::npos);
  CHECK(pictureSvg(pictures.back()).find(">and 71 more<") != std::string::npos);
}

TEST_CASE("svg: python reads it as XML") {
  if (std::system("python3 -c 'import xml.dom.minidom' >/dev/null 2>&1") != 0) {
    MESSAGE("skipped: no python3");
    return;
  }
  const auto path = std::filesystem::temp_directory_path() / "dotek-picture.svg";
  std::ofstream(path, std::ios::binary) << pictureSvg(borePicture());
  const std::string check =
      "python3 -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' '" + path.string() + "'";
  CHECK(std::system(check.c_str()) == 0);
  std::filesystem::remove(path);
}

TEST_CASE("svg: bounded for a long run") {
  Picture large;
  large.part = platePart();
  Point3 at{-300, -200, -390};
  for (int i = 0; i < 200'000; ++i) {
    const Point3 to{-240 + 70 * std::cos(i * 0.37), -160 + 50 * std::sin(i * 0.73),
                    -390 + 5 * std::sin(i * 0.01)};
    large.moves.push_back({i % 7 == 0 ? PathKind::Rapid : PathKind::Feed, at, to, true, 0});
    if (i % 100 == 0) large.contacts.push_back({to, static_cast<std::size_t>(i)});
    at = to;
  }
  const std::string svg = pictureSvg(large);
  CHECK(svg.find("200000 moves: what is shorter than half a pixel is joined") != std::string::npos);
  CHECK(svg.find("2000 contacts: the first 400 are drawn") != std::string::npos);
  CHECK(svg.size() < 40'000'000);
}

// docs/pictures.md shows it; `--update` writes it. Another compiler may place a point a hundredth of a pixel
// away.
TEST_CASE("svg: the example of the documents is what the picture gives") {
  Picture picture = borePicture();
  picture.frames = {{"G54", {-300, -200, -223}}};
  RunFacts facts;
  facts.end.ending = Ending::ProgramEnd;
  facts.events[static_cast<std::size_t>(Outcome::RapidIntoPart)] = 1;
  picture.result = resultOf(picture, facts);
  const std::string now = pictureSvg(picture);
  const std::filesystem::path path = root() / "docs" / "picture-example.svg";
  if (settings().update) std::ofstream(path, std::ios::binary) << now;
  const std::string shown = readAll(path);
  std::size_t i = 0, k = 0;
  while (i < shown.size() && k < now.size()) {
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    if (!isDigit(shown[i]) || !isDigit(now[k])) {
      REQUIRE_MESSAGE(shown[i] == now[k], "docs/picture-example.svg, from byte " << i);
      ++i, ++k;
      continue;
    }
    std::size_t first = 0, second = 0;
    REQUIRE(std::stod(shown.substr(i, 12), &first) ==
            doctest::Approx(std::stod(now.substr(k, 12), &second)).epsilon(1e-3));
    i += first;
    k += second;
  }
  CHECK(i == shown.size());
  CHECK(k == now.size());
}
