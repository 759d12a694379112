// Branches that measure in a loop, go where they have measured, and name what they set by a variable.
#include "tests/unit/ShopRuns.h"

namespace dotek::tests {

namespace {

bool differs(const Shop& of, const std::string& text) {
  return verified(of, text).find("\nDIFFERS") != std::string::npos;
}

} // namespace

TEST_CASE("verify: a slot that is measured again where its width is wrong") {
  const Shop slot{"koskinen", "KK-URA", "mittaus", "fanuc", "inspection-plus", "haas-ngc"};
  CHECK_MESSAGE(agrees(verified(slot)), verified(slot));
  const std::string good = converted(slot);
  CHECK(differs(slot, replaced(good, "IF[#620 LT 3.]", "IF[#620 LT 2.]")));
  CHECK(differs(slot, replaced(good, "#621+#622", "#621-#622")));
}

TEST_CASE("verify: a bore whose middle is the mean of two places that were read") {
  for (const char* control : {"haas-ngc", "fanuc-31i-b"}) {
    const Shop bore{"koskinen", "KK-REIKA", "mittaus", "fanuc", "inspection-plus", control};
    CHECK_MESSAGE(agrees(verified(bore)), verified(bore));
    CHECK(differs(bore, replaced(converted(bore), "#613-#614", "#613+#614")));
  }
}

TEST_CASE("verify: a branch on G31 of its own for Fusion with other macros") {
  for (const char* cycle : {"KK-YLAPINTA", "KK-SARJA", "KK-REUNA"}) {
    const Shop own{"koskinen", cycle, "mittaus", "fusion", "inspection-plus", "haas-ngc"};
    CHECK_MESSAGE(agrees(verified(own)), verified(own));
  }
}

TEST_CASE("verify: a limit of a feed beyond 999") {
  const Shop bore{"moreira", "MR.Furo.Origem", "medir", "fanuc", "inspection-plus", "fanuc-31i-b"};
  CHECK_MESSAGE(agrees(verified(bore)), verified(bore));
  const std::string good = converted(bore);
  REQUIRE(good.find("GT 2000.]") != std::string::npos);
  CHECK(differs(bore, replaced(good, "GT 2000.]", "GT 3000.]")));
}

TEST_CASE(
    "verify: a comparison that stores a result, for Fusion with macros that leave it in the same variable") {
  const Shop webs{"moreira", "MR.Nervuras.X", "medir", "fusion", "dotek", "fanuc-31i-b"};
  const std::string fragment = converted(webs);
  CHECK_MESSAGE(fragment.find("IF[#138GT#529]THEN#529=#138") != std::string::npos, fragment);
  CHECK_MESSAGE(agrees(verified(webs)), verified(webs));
}

} // namespace dotek::tests
