// Translations for Mikroprog and Fusion, sound and damaged: a damaged one never agrees.
#include "driver/Driver.h"
#include "support/Worker.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace dotek::tests {

namespace {

using Names = std::vector<std::pair<std::string, std::string>>;

const std::string kExamples = (root() / "examples").string() + "/";
const Names kValues = {{"X", "15"}, {"I", "0"}, {"G", "56"}, {"Z", "-5"}, {"R", "50"}};
const Names kHosts = {{"clearance", "5"}, {"tool_radius", "3"}, {"overtravel", "5"}, {"return_feed", "1000"},
                      {"start_x", "-15"}, {"start_y", "10"},    {"start_z", "60"}};

driver::VerifyOptions options(const std::string& to) {
  driver::VerifyOptions out;
  out.inputs = {kExamples + "surface-x"};
  out.source.prog = kExamples + "post.txt";
  out.to = to;
  out.common.scriptProgram = runningProgram();
  if (to == "mikroprog") out.control = "mikroprog-mill";
  out.cases = 40;
  out.jobs = 1;
  return out;
}

void addTo(driver::CommonOptions& common, const Names& sets, const Names& hosts) {
  for (const auto& [name, value] : sets)
    common.set.emplace_back(name, value);
  for (const auto& [name, value] : hosts)
    common.host.emplace_back(name, value);
}

std::string converted(const std::string& to) {
  driver::ConvertOptions convert;
  convert.inputs = {kExamples + "surface-x"};
  convert.source.prog = kExamples + "post.txt";
  convert.to = to;
  if (to == "mikroprog") {
    convert.control = "mikroprog-mill";
    addTo(convert.common, kValues, kHosts);
  }
  const driver::Outcome outcome = driver::convert(convert);
  REQUIRE(outcome.status == 0);
  return outcome.files.front().text;
}

// What the last line says of the drawn cases.
std::string lastLine(const std::string& text) {
  const std::size_t end = text.size() - 1, begin = text.rfind('\n', end - 1) + 1;
  return text.substr(begin, std::min(text.find(';', begin), end) - begin);
}

// The text with its first `from` replaced.
std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE_MESSAGE(at != std::string::npos, from << " is not in\n" << text);
  return text.replace(at, from.size(), to);
}

driver::Outcome verified(const std::string& to, const std::string& text) {
  const TestFolder scratch("dotek-verify-targets");
  driver::VerifyOptions run = options(to);
  run.cases = 20;
  run.allowEdits = true; // the cases alone are to show it
  run.translation = scratch.write("edited", text);
  if (to == "mikroprog") addTo(run.common, kValues, kHosts);
  return driver::verify(run);
}

} // namespace

TEST_CASE("sound translations agree on every target") {
  for (const char* to : {"fusion", "mikroprog"}) {
    const driver::Outcome outcome = driver::verify(options(to));
    CHECK_MESSAGE(outcome.status == 0, to);
    CHECK(lastLine(outcome.output) == "AGREES: 40 of 40 drawn cases");
  }
  driver::VerifyOptions lathe = options("mikroprog");
  lathe.control = "mikroprog-s280";
  CHECK(lastLine(driver::verify(lathe).output) == "AGREES: 40 of 40 drawn cases");
  driver::VerifyOptions byHand = options("mikroprog");
  byHand.datum = "operator";
  CHECK(lastLine(driver::verify(byHand).output) == "AGREES: 40 of 40 drawn cases");
  for (const char* set : {"inspection-plus", "dotek"}) {
    driver::VerifyOptions other = options("fusion");
    other.probeMacros = set;
    CHECK_MESSAGE(lastLine(driver::verify(other).output) == "AGREES: 40 of 40 drawn cases", set);
  }
}

TEST_CASE("what convert writes for the same values is what verify runs on Mikroprog") {
  const driver::Outcome outcome = verified("mikroprog", converted("mikroprog"));
  CHECK(outcome.status == 0);
  CHECK(lastLine(outcome.output) == "AGREES: 20 of 20 drawn cases");
}

TEST_CASE("the report says whether a program of Mikroprog is edited") {
  const auto report = [](const std::string& text) {
    const TestFolder scratch("dotek-verify-targets");
    driver::VerifyOptions run = options("mikroprog");
    run.cases = 5;
    run.format = targets::ReportFormat::Json;
    run.allowEdits = true; // the cases alone are to show it
    run.translation = scratch.write("edited", text);
    addTo(run.common, kValues, kHosts);
    return driver::verify(run).files.at(0).text;
  };
  const std::string good = converted("mikroprog");
  CHECK(report(good).find("\"edited\": false") != std::string::npos);
  CHECK(report(edited(good, "G92 X-3", "G92 X3")).find("\"edited\": true") != std::string::npos);
}

TEST_CASE("a damaged program of Mikroprog never agrees") {
  const std::string good = converted("mikroprog");
  const std::vector<std::pair<std::string, std::string>> kDamage = {
      {"G92 X-3", "G92 X3"},                        // the radius has the wrong sign
      {"G92 X-3", "G92 X0"},                        // no radius
      {"G92 X-3", "G92 Y-3"},                       // the wrong axis
      {" G92 X-3", " ;G92 X-3"},                    // no datum
      {"M25 @SURFACEX.SOU", ""},                    // no record
      {"G1 X-15", "G1 X-14"},                       // not back to where it began
      {"G1 X-15 F1000", ""},                        // not back at all
      {"G31 X5 L900", "G31 X5 L910"},               // a missing surface in the wrong tail
      {"G31 X5 L900", "G31 X-5 L900"},              // too short
      {"G31 X5 L900", "G31 X6 L900"},               // another overtravel
      {"G31 Z-5 L100", "G31 Z-4 L100"},             // not deep enough
      {"G31 Z-5 L100", "G0 Z-5"},                   // no protection
      {"N90 G27 L910", "N90 M9"},                   // contact goes on
      {"N90 G27 L910", "N90 G27 L100"},             // the same by a jump
      {"G23 L910 O7", "G23 L990 O7"},               // contact before the chain ends without a word
      {"N40 G23 L910 O7", "N40 M9"},                // nobody asks for it
      {"N10 G17 G90 G94", "N10 M9"},                // no modes of its own
      {"N10 G17 G90 G94", "N10 G18 G90 G94"},       // another plane
      {"N10 G17 G90 G94", "N10 G17 G90 G91 G94"},   // the last one counts
      {"N10 G17 G90 G94", "N10 G17 G90"},           // whatever the feed is
      {"N903 G1 Z60", "N903 G1 Z61"},               // up to another height
      {"N913 G1 Z60 F1000", "N913 G1 Z60 F2000"},   // as fast as nobody wants it
      {"N900 M0 ;SONDA NENASLA PLOCHU", "N900 M9"}, // no tail
      {"N906 G27 L990", "N906 G27 L60"},            // the tail goes back to work
      {"N903 G1 Z", "N903 G1 X"},                   // the tail goes aside
      {"N903 G1 Z", "N903 G1 Z-"},                  // down
      {"N903 G1 Z", "N903 G0 Z"},                   // up at top speed
      {"N903 G1 Z", "N903 M9 ;"},                   // not up
      {"N913 G1 Z", "N913 M9 ;"},                   // the same after contact
      {"G0 X-15 Y10", "G0 X-15 Y11"},               // another start
      {"M5", "M3 S100"},                            // the spindle turns
      {"M9", ""},                                   // nobody switches the coolant off
      {"N50 G0 X-15 Y10", "N50 M9"},                // not to the start point
  };
  for (const auto& [from, to] : someOf(kDamage)) {
    const driver::Outcome outcome = verified("mikroprog", edited(good, from, to));
    CHECK_MESSAGE(outcome.status == 1, from << " to " << to);
    CHECK_MESSAGE(lastLine(outcome.output) == "DIFFERS: 20 of 20 drawn cases", from << " to " << to);
  }
}

TEST_CASE("verify: a record of Mikroprog after its datum holds what was set, not what was found") {
  const std::string good = converted("mikroprog");
  const std::string kRecord = "M25 @SURFACEX.SOU", kDatum = "G92 X-3";
  const std::size_t record = good.find(kRecord), datum = good.find(kDatum);
  REQUIRE(record < datum);
  REQUIRE(datum != std::string::npos);
  std::string turned = good;
  turned.replace(datum, kDatum.size(), kRecord);
  turned.replace(record, kRecord.size(), kDatum);
  const driver::Outcome outcome = verified("mikroprog", turned);
  CHECK(outcome.status == 1);
  const std::string said = renderText(outcome.diagnostics, outcome.sources, 0);
  CHECK_MESSAGE(said.find("a record after the datum") != std::string::npos, said);
}

TEST_CASE("verify: a program of Mikroprog asks, switches off and goes to its start before it moves") {
  const std::string good = converted("mikroprog");
  const std::string beginning =
      "N20 M5\r\nN30 M9\r\nN40 G23 L910 O7 ;PROBE ALREADY IN CONTACT\r\nN50 G0 X-15 Y10\r\n";
  const std::pair<std::string, std::string> kOrders[] = {
      {"N20 G0 X-15 Y10\r\nN30 M5\r\nN40 M9\r\nN50 G23 L910 O7\r\n",
       "nothing asks for contact before the program"},
      {"N20 M9\r\nN30 G23 L910 O7\r\nN40 G31 X-15 Y10 L50\r\nN45 G27 L910\r\nN50 M5\r\n",
       "the spindle turns at a protected move"},
      {"N20 M5\r\nN30 G23 L910 O7\r\nN40 G31 X-15 Y10 L50\r\nN45 G27 L910\r\nN50 M9\r\n",
       "the coolant flows at a protected move"},
      {"N20 M5\r\nN30 M9\r\nN40 G23 L910 O7\r\nN50 M9\r\n", "does not go there first"},
  };
  for (const auto& [order, text] : kOrders) {
    const driver::Outcome outcome = verified("mikroprog", edited(good, beginning, order));
    CHECK_MESSAGE(lastLine(outcome.output) == "DIFFERS: 20 of 20 drawn cases", order);
    const std::string said = renderText(outcome.diagnostics, outcome.sources, 0);
    CHECK_MESSAGE(said.find(text) != std::string::npos, said);
  }
}

TEST_CASE("a damaged fragment never agrees") {
  const std::string good = converted("fusion");
  CHECK(lastLine(verified("fusion", good).output) == "AGREES: 20 of 20 drawn cases");
  const std::vector<std::pair<std::string, std::string>> kDamage = {
      {"writeBlock(\"M31\");", ""},                                          // the probe stays off
      {"writeBlock(\"M5\");", "writeBlock(\"M3 S100\");"},                   // the spindle turns
      {"\" X\" + XText", "\" Y\" + XText"},                                  // another axis
      {"\" I\" + IText", "\" I\" + XText"},                                  // another field
      {"\"surfaceX_I\"", "\"surfaceX_X\""},                                  // another property
      {"cycle.clearance", "cycle.retract"},                                  // another host input
      {"Z\" + ZText", "Z-\" + ZText"},                                       // the sign
      {"writeBlock(\"G65 P9770 Z\" + RText", "writeBlock(\"G0 Z\" + RText"}, // no protection
  };
  for (const auto& [from, to] : someOf(kDamage)) {
    const driver::Outcome outcome = verified("fusion", edited(good, from, to));
    CHECK_MESSAGE(outcome.status == 1, from << " to " << to);
    CHECK_MESSAGE(outcome.output.starts_with("DIFFERS: "), from << " to " << to);
  }
}

TEST_CASE("a fragment has to do with what a drilling operation has, and searches as far as the source") {
  driver::ConvertOptions convert;
  convert.inputs = {kExamples + "surface-x"};
  convert.source.prog = kExamples + "post.txt";
  convert.to = "fusion";
  convert.probeMacros = "dotek";
  const driver::Outcome written = driver::convert(convert);
  REQUIRE(written.status == 0);
  const std::string good = written.files.front().text;
  const TestFolder scratch("dotek-verify-targets");
  const auto verdictOf = [&](const std::string& text) {
    driver::VerifyOptions run = options("fusion");
    run.probeMacros = "dotek";
    run.allowEdits = true; // the cases alone are to show it
    run.translation = scratch.write("edited.js", text);
    const driver::Outcome outcome = driver::verify(run);
    return outcome.output.substr(0, outcome.output.find(':'));
  };
  CHECK(verdictOf(good) == "AGREES");
  CHECK(verdictOf(edited(good, "G65 P8811 X\" + ", "G65 P8811 Q2. X\" + ")) == "DIFFERS");
  CHECK(verdictOf(edited(good, "\"G65 P8811 X\" + ",
                         "\"G65 P8811 Q\" + cycle.probeOvertravel + \" X\" + ")) != "AGREES");
}

TEST_CASE("a fragment without its checks takes what the dialog rejects") {
  std::string text = converted("fusion");
  for (std::size_t at = 0; (at = text.find("error(localize(", at)) != std::string::npos; at += 4)
    text.replace(at, 5, "String");
  for (std::size_t at = 0; (at = text.find("return;", at)) != std::string::npos; at += 2)
    text.replace(at, 7, ";");
  driver::VerifyOptions run = options("fusion");
  const TestFolder scratch("dotek-verify-targets");
  run.allowEdits = true; // the cases alone are to show it
  run.translation = scratch.write("unchecked.js", text);
  run.cases = 200;
  const driver::Outcome outcome = driver::verify(run);
  CHECK(outcome.status == 1);
  // The document in inches, which the callers of eight cases have, passes as well.
  CHECK(outcome.output.starts_with("DIFFERS: 8 of 200 drawn cases"));
  CHECK(outcome.output.find("edge cases: 0 of 20") == std::string::npos);
}

} // namespace dotek::tests
