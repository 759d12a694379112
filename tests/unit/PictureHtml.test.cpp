#include "sim/picture/PictureResult.h"
#include "support/Decimal.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"
#include "tests/unit/PictureHelper.h"

#include <cstdio>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;
using namespace dotek::sim;
using namespace dotek::tests;
using nlohmann::json;

namespace {

std::string between(const std::string& text, const std::string& open, const std::string& close) {
  const std::size_t at = text.find(open);
  REQUIRE(at != std::string::npos);
  const std::size_t end = text.find(close, at + open.size());
  REQUIRE(end != std::string::npos);
  return text.substr(at + open.size(), end - at - open.size());
}

json dataOf(const std::string& page) {
  return json::parse(between(page, "<script id=\"data\" type=\"application/json\">", "</script>"));
}

// A folder for one test.
} // namespace

TEST_CASE("html: the page holds the moves, contacts, errors and blocks of the picture") {
  const Picture picture = borePicture();
  const std::string page = pictureHtml(picture);
  const json data = dataOf(page);
  REQUIRE(data["way"].size() == picture.moves.size() * 6);
  Point3 before{};
  std::size_t jump = 0;
  for (std::size_t i = 0; i < picture.moves.size(); ++i) {
    const PictureMove& move = picture.moves[i];
    const json& way = data["way"];
    CHECK(way[i * 6] == static_cast<int>(move.kind));
    CHECK(way[i * 6 + 1] == (move.probeOn ? 1 : 0));
    CHECK(way[i * 6 + 2] == move.block);
    const double to[] = {move.to.x, move.to.y, move.to.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
      CHECK(dotek::fixedText(way[i * 6 + 3 + axis].get<double>(), 6) == dotek::fixedText(to[axis], 6));
    if (i == 0 || !(move.from == before)) {
      CHECK(data["jumps"][jump][0] == i);
      CHECK(data["jumps"][jump][2].get<double>() == doctest::Approx(move.from.y));
      ++jump;
    }
    before = move.to;
  }
  CHECK(data["jumps"].size() == jump);
  REQUIRE(data["contacts"].size() == picture.contacts.size());
  CHECK(data["contacts"][5][0].get<double>() == doctest::Approx(-179.7));
  CHECK(data["contacts"][5][3] == picture.contacts[5].move);
  REQUIRE(data["errors"].size() == 1);
  CHECK(data["errors"][0][4] == picture.errors[0].text);
  CHECK(data["errors"][0][3] == picture.moves.size() - 1);
  CHECK(data["errors"][0][5] == picture.blocks.size() - 1);
  REQUIRE(data["blocks"].size() == picture.blocks.size());
  CHECK(data["blocks"][2][0] == picture.blocks[2].text);
  CHECK(data["blocks"][2][1] == "bore.nc:3");
  CHECK(data["kinds"][3]["name"] == "measuring");
  CHECK(data["probe"]["ball"] == 3);
  CHECK(data["probe"]["length"] == 177);
  REQUIRE(data["mesh"]["triangles"].size() > 3000);
  const std::size_t vertices = data["mesh"]["vertices"].size() / 3;
  for (const json& corner : data["mesh"]["triangles"])
    CHECK(corner.get<std::size_t>() < vertices);
  for (std::size_t i = 0; i < vertices; i += 50) {
    const auto at = [&](std::size_t axis) {
      return data["region"][axis].get<double>() +
             data["mesh"]["vertices"][i * 3 + axis].get<double>() * data["mesh"]["unit"].get<double>();
    };
    CHECK(std::abs(picture.part->distance({at(0), at(1), at(2)})) < 0.3);
  }
  CHECK(page == pictureHtml(picture));
}

TEST_CASE("html: the page needs nothing but itself") {
  Picture picture = borePicture();
  picture.title = "</script><b>&";
  picture.blocks[0].text = "</script><script>alert(1)</script> <!--";
  const std::string page = pictureHtml(picture);
  for (const char* outside :
       {"http:", "https:", "//cdn", "@import", "url(", "src=", "fetch(", "XMLHttpRequest", "import("})
    CHECK_MESSAGE(page.find(outside) == std::string::npos, outside);
  for (std::size_t at = page.find("href="); at != std::string::npos; at = page.find("href=", at + 1))
    CHECK(page.substr(at, 13) == "href=\"data:,\"");
  CHECK(page.find("alert(1)</script>") == std::string::npos);
  CHECK(page.find("<title>&lt;/script&gt;&lt;b&gt;&amp;</title>") != std::string::npos);
  CHECK(dataOf(page)["blocks"][0][0] == picture.blocks[0].text);
  std::size_t scripts = 0;
  for (std::size_t at = page.find("<script"); at != std::string::npos; at = page.find("<script", at + 1))
    ++scripts;
  CHECK(scripts == 3);
  CHECK(page.find("@TITLE@") == std::string::npos);
  CHECK(page.find("@SCRIPT@") == std::string::npos);
  for (const char* id : {"slider", "position", "blocks", "view", "x", "y", "z", "kind", "power", "errors",
                         "work-x", "gauge-z", "zoom-in", "zoom-out", "fit", "projection"})
    CHECK_MESSAGE(page.find(std::string("id=\"") + id + "\"") != std::string::npos, id);
}

TEST_CASE("html: valid data whatever the picture") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Picture empty;
  json data = dataOf(pictureHtml(empty));
  CHECK(data["way"].empty());
  CHECK(data["mesh"]["triangles"].empty());
  Picture odd = borePicture();
  odd.moves[2].to = {nan, 1e300, -1e300};
  odd.probe.bodyDiameter = nan;
  odd.probe.length = std::numeric_limits<double>::infinity();
  odd.contacts[0] = {{nan, 0, 0}, 5000};
  odd.blocks[0].text = "\xFF\x01";
  const std::string page = pictureHtml(odd);
  data = dataOf(page);
  CHECK(data["way"][2 * 6 + 3].is_null());
  CHECK(data["contacts"][0][3] == odd.moves.size() - 1);
  CHECK(page.find("moves without a number, or beyond 1 km: 1;") != std::string::npos);
  CHECK(dataOf(pictureHtml(empty))["probe"].is_null());
  CHECK(pictureHtml(empty).find("no probe is stated") != std::string::npos);
  PartBuilder builder;
  builder.halfSpace({0, 0, 0}, {0, 0, 1});
  empty.part = *finish(builder);
  CHECK(dataOf(pictureHtml(empty))["mesh"]["triangles"].size() > 100);
}

TEST_CASE("html: a very long run is thinned, and says so") {
  Picture large;
  Point3 at{};
  for (std::size_t i = 0; i < 600'000; ++i) {
    const Point3 to{100 * std::cos(static_cast<double>(i) * 0.37),
                    100 * std::sin(static_cast<double>(i) * 0.73), 0};
    large.moves.push_back({PathKind::Feed, at, to, true, i});
    at = to;
  }
  large.contacts = {{{1, 2, 3}, 400'000}};
  large.errors = {{{1, 2, 3}, "here", 500'001}};
  const std::string page = pictureHtml(large);
  CHECK(page.size() < 40'000'000);
  CHECK(page.find("600000 moves: one of 3 is on the page") != std::string::npos);
  const json data = dataOf(page);
  const json& numbers = data["numbers"];
  REQUIRE(numbers.size() * 6 == data["way"].size());
  CHECK(numbers.size() < 250'000);
  CHECK(numbers.back() == 599'999);
  CHECK(numbers[data["contacts"][0][3].get<std::size_t>()] == 400'000);
  CHECK(numbers[data["errors"][0][3].get<std::size_t>()] == 500'001);
  CHECK(data["jumps"].size() == 1); // each begins where the one before it ends
}

TEST_CASE("html: node finds no fault in the scripts") {
  if (std::system("node --version >/dev/null 2>&1") != 0) {
    MESSAGE("skipped: no node");
    return;
  }
  for (const char* name : {"picture.js", "picture-view.js"}) {
    const std::string command = "node --check '" + (root() / "sim" / "picture" / name).string() + "'";
    CHECK_MESSAGE(std::system(command.c_str()) == 0, name);
  }
  CHECK(pictureHtml(Picture{}).find(readAll(root() / "sim" / "picture" / "picture.js")) != std::string::npos);
}

TEST_CASE("html: in Chromium the slider moves the probe and the numbers are those of the picture") {
  Picture picture = borePicture();
  picture.frames = {{"G54", {-300, -200, -223}}};
  picture.blocks.front().program = "O0612";
  RunFacts facts;
  facts.end.ending = Ending::Alarm;
  facts.end.number = 3004;
  // The probe hit the part before the end of its move, and stands there.
  picture.errors[0].at.x += 4;
  facts.events[static_cast<std::size_t>(Outcome::RapidIntoPart)] = 1;
  picture.result = resultOf(picture, facts);
  const TestFolder scratch("dotek-page");
  std::ofstream(scratch / "page.html", std::ios::binary) << pictureHtml(picture);
  const std::string command = "bash '" + (root() / "tests" / "accept" / "page-in-chromium.sh").string() +
                              "' '" + (scratch / "page.html").string() + "' >'" +
                              (scratch / "found").string() + "' 2>&1";
  const int status = std::system(command.c_str());
  const std::string found = readAll(scratch / "found");
  if (status == 77 << 8) {
    std::printf("html in Chromium: skipped: %s", found.c_str());
    return;
  }
  CAPTURE(found);
  REQUIRE(status == 0);
  const json result = json::parse(found);
  CHECK(result["faults"].empty());
  REQUIRE(result["shown"].size() == picture.moves.size());
  for (std::size_t i = 0; i < picture.moves.size(); ++i) {
    const json& shown = result["shown"][i];
    CHECK(shown[0] == i);
    const Point3 at = i + 1 == picture.moves.size() ? picture.errors[0].at : picture.moves[i].to;
    CHECK(shown[1] == dotek::fixedText(at.x, 3));
    CHECK(shown[2] == dotek::fixedText(at.y, 3));
    CHECK(shown[3] == dotek::fixedText(at.z, 3));
  }
}
