// The drawn path of the shops' cycles beside what their posts print (docs/verify.md).
#include "driver/Driver.h"
#include "support/Worker.h"
#include "tests/GoldenRunner.h"
#include "tests/policy/Tree.h"
#include "verify/CompareLeft.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <string>

using namespace dotek;
using namespace dotek::tests;

namespace {

int status(const std::string& shop, const std::string& folder) {
  const std::filesystem::path shops = root() / "tests" / "shops";
  driver::VerifyOptions options;
  options.inputs.push_back((shops / shop / folder).generic_string());
  options.source.prog = (shops / shop / "post.txt").generic_string();
  options.common.data.push_back((shops / "data").generic_string());
  options.common.scriptProgram = runningProgram();
  options.cases = 40;
  options.jobs = 1;
  return driver::verify(options).status;
}

verify::Record idle(std::uint32_t program, double feed, double x) {
  verify::Record record;
  record.idle.push_back({program, 3, feed, {{24, x}}, {}});
  return record;
}

} // namespace

TEST_CASE("verify: the drawn path begins on the clearance plane that the post prints") {
  CHECK(status("flags", "NK.Rowek.X") == 0);
  CHECK(status("inspection", "JT.Vice.Corner") == 0);
}

TEST_CASE("verify: the drawn path comes back from a bare skip move as the program does") {
  CHECK(status("direct", "DP.Top.Zero") == 0);
  CHECK(status("repeats", "KR.Mittel.Z") == 0);
  CHECK(status("repeats", "KR.Ecke.Innen") == 0);
}

TEST_CASE("verify: the way to the tool change and back is not drawn") {
  CHECK(status("origins", "AL.Epaisseur.Y") == 0);
  CHECK(status("origins", "AL.Bossage.Trois") == 0);
}

TEST_CASE("verify: a drawn path that begins lower than its program moves differs") {
  CHECK(status("direct", "DP.Side.Zero") == 1);
}

TEST_CASE("verify: a protected move that stays where it is has its words, too") {
  verify::CompareRules rules;
  rules.sameAlarmNumbers = true;
  CHECK(verify::compareIdleMoves(idle(9810, 3500, 1), idle(9810, 3500, 1), rules).empty());
  CHECK(verify::compareIdleMoves(idle(9810, 3500, 1), idle(9810, 3501, 1), rules).size() == 1);
  CHECK(verify::compareIdleMoves(idle(9810, 3500, 1), idle(9810, 3500, 2), rules).size() == 1);
  // Another set's macro has letters of its own, but no other feed.
  rules.sameAlarmNumbers = false;
  CHECK(verify::compareIdleMoves(idle(9810, 3500, 1), idle(8810, 3500, 2), rules).empty());
  CHECK(verify::compareIdleMoves(idle(9810, 3500, 1), idle(8810, 3501, 1), rules).size() == 1);
  CHECK(verify::compareIdleMoves(idle(9810, 3500, 1), verify::Record(), rules).empty());
}
