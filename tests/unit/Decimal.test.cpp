#include "support/Decimal.h"

#include <doctest/doctest.h>

using namespace dotek;

TEST_CASE("numbers print shortest, without exponent and without -0") {
  CHECK(numberText(5) == "5");
  CHECK(numberText(-0.25) == "-0.25");
  CHECK(numberText(-0.0) == "0");
  CHECK(numberText(1200000) == "1200000");
  CHECK(numberText(0.1 + 0.2) == "0.30000000000000004");
  CHECK(numberText(1e22) == "10000000000000000000000");
  CHECK(numberText(1e-7) == "0.0000001");
}

TEST_CASE("rounding is half away from zero on the shortest decimal text") {
  CHECK(fixedText(1.005, 2) == "1.01"); // the double lies below 1.005
  CHECK(fixedText(-1.005, 2) == "-1.01");
  CHECK(fixedText(0.0004, 3) == "0.000");
  CHECK(fixedText(-0.0004, 3) == "0.000");
  CHECK(fixedText(999.9996, 3) == "1000.000");
  CHECK(fixedText(0.05, 1) == "0.1");
  CHECK(fixedText(0.5, 0) == "1");
  CHECK(fixedText(120, 3) == "120.000");
}

TEST_CASE("parseNumber takes decimal numbers only") {
  CHECK(parseNumber("-5") == -5.0);
  CHECK(parseNumber(".5") == 0.5);
  CHECK(parseNumber("5.") == 5.0);
  CHECK(parseNumber("+3.25") == 3.25);
  for (const char* bad : {"", "-", ".", "1e3", "1,5", " 1", "1 ", "0x1", "inf", "nan", "--1", "1.2.3"})
    CHECK(!parseNumber(bad));
}
