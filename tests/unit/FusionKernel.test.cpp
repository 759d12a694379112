// The double of the post kernel against documented and observed results.
#include "FusionHelper.h"
#include "backends/fusion/KernelText.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>

using namespace dotek;
using namespace dotek::tests;
namespace fusion = backends::fusion;
namespace fs = std::filesystem;

namespace {

std::string cases() {
  return readAll(root() / "tests" / "fusion" / "KernelCases.js");
}

} // namespace

TEST_CASE("the kernel's double prints what the kernel prints") {
  const std::string found = evaluated(cases() + "\nkernelCases();");
  CHECK(found == "80 cases\n");
}

TEST_CASE("the kernel's double reports a wrong result") {
  // The comparison itself can fail.
  const std::string found = evaluated(
      "createFormat = function () { return {format: function () { return \"?\"; }, getPrefix: "
      "function () { return \"\"; }, areDifferent: function () { return true; }, isSignificant: "
      "function () { return true; }, getMinimumValue: function () { return 1; }, getError: function "
      "() { return 1; }, getResultingValue: function () { return 1; }, setNumberOfDecimals: function "
      "() {}, setPrefix: function () {}, getNumberOfDecimals: function () { return 1; }}; };\n" +
      cases() + "\nkernelCases();");
  CHECK(found.find("whole: ? instead of 80.") != std::string::npos);
}

TEST_CASE("the engine says what is wrong with a script") {
  CHECK(evaluated("let a = 1;").starts_with("throws: "));
  CHECK(evaluated("nobody();").find("nobody") != std::string::npos);
  CHECK(evaluated("createFormat({}).format(\"1\")").find("is no number") != std::string::npos);
}
