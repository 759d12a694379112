#include "project/Assumptions.h"
#include "tests/GoldenRunner.h"

#include <doctest/doctest.h>

using namespace dotek;

TEST_CASE("docs/gibbs.md lists every assumption") {
  const std::string page = tests::readAll(tests::root() / "docs" / "gibbs.md");
  for (const auto& [name, reading] : project::assumptionTable()) {
    INFO(name);
    CHECK(page.find("`" + name + "`") != std::string::npos);
  }
}

TEST_CASE("a misspelt assumption is refused") {
  Diagnostics diagnostics;
  project::checkAssumptions({"block-if", "Drilling?=yes", "Drilling?=no"}, diagnostics);
  CHECK(diagnostics.empty());
  project::checkAssumptions({"blok-if"}, diagnostics);
  project::checkAssumptions({"Drilling?=maybe"}, diagnostics);
  REQUIRE(diagnostics.all().size() == 2);
  CHECK(diagnostics.all()[0].code == "unknown-assumption");
  CHECK(diagnostics.all()[0].message.find("`block-if`") != std::string::npos);
}
