#include "support/Picture.h"

#include <cmath>
#include <doctest/doctest.h>
#include <random>

using namespace dotek;

namespace {

Picture picture(const std::string& text) {
  CAPTURE(text);
  auto parsed = Picture::parse(text);
  REQUIRE(std::holds_alternative<Picture>(parsed));
  return std::get<Picture>(parsed);
}

PictureError failure(const std::string& text) {
  CAPTURE(text);
  auto parsed = Picture::parse(text);
  REQUIRE(std::holds_alternative<PictureError>(parsed));
  return std::get<PictureError>(parsed);
}

std::string print(const std::string& text, double value) {
  return picture(text).print(value).text;
}

} // namespace

TEST_CASE("pictures print the published table") {
  const double values[] = {1.2, -1.2, 120, .0012, 0};
  const struct {
    const char* picture;
    const char* printed[5];
  } rows[] = {
      {"###.####", {"1.2", "-1.2", "120.", ".0012", ""}},
      {"###.####;0", {"1.2", "-1.2", "120.", ".0012", "0"}},
      {"###.####;0.", {"1.2", "-1.2", "120.", ".0012", "0."}},
      {"###.###0", {"1.2000", "-1.2000", "120.0000", ".0012", ".0000"}},
      {"0##^####", {"0012", "-0012", "120", "0000012", "000"}},
      {"###^0000", {"12000", "-12000", "1200000", "0012", "0000"}},
      {"###^0000;0;5", {"12000", "-12000", "1200000", "0010", "0"}},
      {"###^###0", {"12000", "-12000", "1200000", "12", "0"}},
      {"000^0000", {"0012000", "-0012000", "1200000", "0000012", "0000000"}},
  };
  for (const auto& row : rows) {
    for (int i = 0; i < 5; ++i) {
      CAPTURE(row.picture);
      CAPTURE(values[i]);
      CHECK(print(row.picture, values[i]) == row.printed[i]);
    }
  }
}

TEST_CASE("the picture of the probing posts") {
  for (const auto& [value, text] :
       {std::pair{50.0, "50."}, {-5.0, "-5."}, {56.0, "56."}, {0.0, "0"}, {0.5, ".5"}, {-0.25, "-.25"}})
    CHECK(print("###.##;0", value) == text);
  CHECK(print("###", 1) == "1");
  CHECK(print("###", 0) == "");
  CHECK(print("##0", 0) == "0");
  CHECK(print("##0.0#", 0.126) == "0.13");
  CHECK(print(".###", 0.25) == ".25");
}

TEST_CASE("rounding is half away from zero, and zero has no sign") {
  CHECK(print("###.##;0", 1.005) == "1.01"); // the double lies below 1.005
  CHECK(print("###.##;0", -1.005) == "-1.01");
  CHECK(print("###.##;0", -0.004) == "0");
  CHECK(print("##0.00", -0.004) == "0.00");
  CHECK(print("##0.00", -0.0) == "0.00");
  CHECK(print("###.##;0", 0.005) == ".01");
  CHECK(print("###", 9.5) == "10");
}

TEST_CASE("fit of a value") {
  using Fit = Picture::Fit;
  const Picture p = picture("###.##;0");
  CHECK(p.print(999.99).fit == Fit::Exact);
  CHECK(p.print(0).fit == Fit::Exact);
  CHECK(p.print(1.234).fit == Fit::LosesDecimals);
  CHECK(p.print(0.001).fit == Fit::LosesDecimals);
  CHECK(p.print(1.234).value.value() == 1.23);
  CHECK(p.print(1000).fit == Fit::DoesNotFit);
  CHECK(p.print(-1000).text == "");
  CHECK(p.print(999.994).text == "999.99");
  CHECK(p.print(999.995).fit == Fit::DoesNotFit); // rounding makes the fourth digit
  CHECK(p.print(1e300).fit == Fit::DoesNotFit);
  CHECK(p.print(5e-324).fit == Fit::LosesDecimals);
  CHECK(picture(".##").print(1).fit == Fit::DoesNotFit);
}

TEST_CASE("rounding step") {
  CHECK(print("###.##;0;5", 1.22) == "1.2");
  CHECK(print("###.##;0;5", 1.225) == "1.25"); // half way between 1.20 and 1.25
  CHECK(print("###.##;0;5", -1.225) == "-1.25");
  CHECK(print("###.##;0;5", 1.2249) == "1.2");
  CHECK(print("###.##;0;5", 0.02) == "0");
  CHECK(print("###;0;2", 3) == "4");
  CHECK(print("###;0;2", 2.999) == "2");
  CHECK(print("###.##;0;25", 99.88) == "100.");
  CHECK(print("##.##;0;25", 99.87) == "99.75");
  CHECK(picture("##.##;0;25").print(99.88).fit == Picture::Fit::DoesNotFit);
  CHECK(picture("###;0;4294967295").print(5).text == "0");
  CHECK(picture("###.##;0;5").print(1e300).fit == Picture::Fit::DoesNotFit);
}

TEST_CASE("characters before the first placeholder are kept as prefix") {
  const Picture p = picture("+-###.##;0");
  CHECK(p.prefix() == "+-");
  CHECK(p.integerPlaces() == 3);
  CHECK(p.decimals() == 2);
  CHECK(picture("3+ ##.#").prefix() == "3+ ");
  CHECK(picture("###.##").prefix().empty());
  CHECK(picture(".##").prefix().empty());
  CHECK(picture("-.##").prefix() == "-");
}

TEST_CASE("what a picture says of itself") {
  CHECK(picture("###.##").zeroPrintsNothing());
  CHECK(picture("###").zeroPrintsNothing());
  CHECK_FALSE(picture("###.##;0").zeroPrintsNothing());
  CHECK_FALSE(picture("##0.##").zeroPrintsNothing());
  CHECK(picture("##^##").impliedPoint());
  CHECK(picture("##.##").printsPoint());
  CHECK_FALSE(picture("##").printsPoint());
  CHECK(picture("##.##;0").text() == "##.##;0");
}

TEST_CASE("defects of a picture, with their place") {
  for (const char* bad : {"",         ";",       "abc",      ".",      ";0",
                          "^;0",      "##..##",  "##.#.",    "..##",   "##,##",
                          "# #",      "##.##mm", "##.##;",   "##;0;",  "##;;5",
                          "##;0;0",   "##;0;-1", "##;0;1.5", "##;0;x", "##;0;99999999999",
                          "##;0;5;1", ";;;",     "##\"##"})
    failure(bad);
  CHECK(failure("##.;").offset == 3);
  CHECK(failure("##.#.#").offset == 4);
  CHECK(failure("##,##").offset == 2);
  CHECK(failure("##\xC4\x8D#").length == 2);
  CHECK(failure("##\xE8#").length == 1); // CP1250
  CHECK(failure("##;0;x5").offset == 5);
  CHECK(failure("##;0;x5").length == 2);
  CHECK(failure("##;0;1;").offset == 6);
}

TEST_CASE("a value with no more decimals than the picture reads back from a printed point") {
  std::mt19937_64 random(20240501);
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
  for (int round = 0; round < 20000; ++round) {
    std::string text;
    const int whole = 1 + pick(5);
    const int places = pick(5);
    for (int i = 0; i < whole; ++i)
      text += pick(2) == 0 ? '#' : '0';
    text += '.';
    for (int i = 0; i < places; ++i)
      text += pick(2) == 0 ? '#' : '0';
    text += ";0";
    const auto scale = static_cast<std::int64_t>(std::pow(10, whole + places));
    const double value =
        static_cast<double>(static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(2 * scale - 1)) -
                            (scale - 1)) /
        std::pow(10, places);
    const Picture::Printed printed = picture(text).print(value);
    CAPTURE(text);
    CAPTURE(value);
    REQUIRE(printed.fit == Picture::Fit::Exact);
    REQUIRE(parseNumber(printed.text) == value);
    REQUIRE(printed.value.value() == value);
  }
}
