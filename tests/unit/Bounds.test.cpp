// Findings of one kind in one file are bounded, and nothing is lost in silence.
#include "frontend/gibbs/Check.h"
#include "support/messages/Common.h"
#include "support/messages/Gibbs.h"
#include "tests/unit/ComPostHelper.h"
#include "tests/unit/GibbsHarness.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

std::size_t count(const Diagnostics& diagnostics, std::string_view code) {
  std::size_t found = 0;
  for (const Diagnostic& d : diagnostics.all())
    found += d.code == code ? 1 : 0;
  return found;
}

} // namespace

TEST_CASE("a macro full of unknown commands gives a bounded list") {
  std::string text = "blorb_zz\n";
  for (int i = 0; i < 3000; ++i)
    text += "vwxq" + std::to_string(i) + " 1\n";
  text += "a = noSuchFunction(1, 2)\n";
  GibbsHarness harness;
  harness.checked(text);
  CHECK(count(harness.diagnostics, frontend::gibbs::unknownCommandCheck.code) == Diagnostics::kMostAlike);
  CHECK(count(harness.diagnostics, diag::TooManyFindings::code) == 1);
  CHECK(count(harness.diagnostics, frontend::gibbs::unknownFunctionCheck.code) ==
        1); // other kinds are still found
  CHECK_FALSE(harness.diagnostics.hasErrors());
  CHECK(harness.diagnostics.full(frontend::gibbs::unknownCommandCheck.code, 0));
  CHECK_FALSE(harness.diagnostics.full(frontend::gibbs::unknownFunctionCheck.code, 0));
}

TEST_CASE("findings of different files are counted apart; equal ones count once") {
  Diagnostics diagnostics;
  for (std::uint32_t i = 0; i < Diagnostics::kMostAlike; ++i)
    for (const FileId file : {FileId{0}, FileId{1}})
      for (int twice = 0; twice < 2; ++twice)
        diagnostics.report<diag::EmptyFile>({file, i, i + 1}, "x");
  CHECK(diagnostics.all().size() == 2 * Diagnostics::kMostAlike);
  CHECK(count(diagnostics, diag::TooManyFindings::code) == 0);
}

TEST_CASE("an error that is not listed leaves an error after it") {
  Diagnostics diagnostics;
  for (std::uint32_t i = 0; i <= Diagnostics::kMostAlike; ++i)
    diagnostics.report<diag::SyntaxError>({0, i, i + 1}, "x").note({0, 0, 1}, "y");
  REQUIRE(diagnostics.all().size() == Diagnostics::kMostAlike + 1);
  // --recover turns errors that it repairs into warnings; what it has not seen stays an error.
  for (Diagnostic& d : diagnostics.all())
    if (d.code == diag::SyntaxError::code) d.severity = Severity::Warning;
  CHECK(diagnostics.hasErrors());
}

TEST_CASE("FORs within one another are bounded") {
  std::string text;
  for (int i = 0; i < 65; ++i)
    text += "for k" + std::to_string(i) + " = 1 to 2\n";
  GibbsHarness deep;
  deep.checked(text + "goto nowhere\n");
  CHECK(deep.codes() == "nesting-too-deep@65:1");
  std::string level = text.substr(0, text.rfind("for "));
  for (int i = 63; i >= 0; --i)
    level += "next k" + std::to_string(i) + "\n";
  GibbsHarness allowed;
  allowed.checked(level);
  CHECK(allowed.codes() == "");
}
