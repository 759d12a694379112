// Files of the cycle language as parts of a Fusion post: the fragment asks, checks, goes to the point and
// calls a program that it carries.
#include "tests/Draws.h"
#include "tests/TestFolder.h"
#include "tests/unit/FusionHelper.h"

#include <algorithm>

using namespace dotek;
using namespace dotek::tests;

namespace {

constexpr std::string_view kFace = R"(// Where the probe is before a face, and what it does.
cycle face "Face with a limit"

parameter wide   : length                       "From here to the face"   letter W  require wide > 2 mm "The width is above 2 mm"
parameter limit  : length optional              "Largest deviation"       letter Q  require limit > 0 mm "The limit is positive"
parameter system : work_offset optional         "Work offset to set"      letter S  group "Datum"
parameter wrong  : choice of stops, goes = goes "Beyond the limit"        letter R
result    found  : length                       "Measured face"

probe on
touch x by wide -> side
probe off
found = side.at
if given limit then
  if abs(side.error) > limit and wrong is stops then
    alarm "Beyond the limit"
  end
end
if given system then
  set system: found becomes x 0 mm
end
)";

driver::ConvertOptions toFusion(const std::string& path) {
  driver::ConvertOptions out;
  out.inputs = {path};
  out.to = "fusion";
  out.control = "fanuc-31i-b";
  out.probeMacros = "inspection-plus";
  out.common.host = {{"approach_feed", "1000"}, {"measuring_feed", "50"}};
  return out;
}

driver::VerifyOptions verifying(const std::string& path) {
  driver::VerifyOptions out;
  static_cast<targets::TranslationOptions&>(out) = toFusion(path);
  out.common.scriptProgram = runningProgram();
  out.cases = draws(20U, 4U);
  out.jobs = 1;
  return out;
}

std::string said(const driver::Outcome& outcome) {
  return outcome.output + messagesOf(outcome);
}

backends::fusion::RunInput faceInput() {
  backends::fusion::RunInput out;
  out.properties = {{"face_wide", 10}};
  out.points = {{1, 2, -3}};
  out.cycle = {{"clearance", 25}};
  return out;
}

} // namespace

TEST_CASE("fusion cycles: the library does by a fragment what it means") {
  for (const char* const name : {"bore", "bore-depth", "boss", "surface-x", "surface-z", "web-x", "channel-y",
                                 "mean-touch-z", "corner-inner", "corner-outer", "rectangle-inside",
                                 "step-height", "edge-angle-x", "bolt-circle-bores"}) {
    CAPTURE(name);
    const std::string path = (root() / "stdlib/cycles" / (std::string(name) + ".cycle")).string();
    const driver::Outcome outcome = driver::verify(verifying(path));
    CHECK_MESSAGE(outcome.status == 0, said(outcome));
    CHECK_MESSAGE(outcome.output.starts_with("AGREES"), outcome.output);
  }
}

TEST_CASE("fusion cycles: fields have units, groups and whether they are given") {
  const TestFolder folder("dotek-fusion-cycles");
  const std::string text = fragmentOf(toFusion(folder.write("face.cycle", std::string(kFace))));
  const auto has = [&](std::string_view line) {
    CAPTURE(line);
    CHECK(text.find(line) != std::string::npos);
  };
  has("properties.face_wide = {\n  title: \"From here to the face\",\n  description: \"wide of face, mm\",\n"
      "  group: \"face\",\n  type: \"number\",\n  scope: \"operation\"\n};");
  has("properties.face_give_system = {");
  has("groupDefinitions.faceGroup1 = {title: \"Probing: Face with a limit, Datum\", order: 102};");
  has("  group: \"faceGroup1\",\n  type: \"integer\",\n  scope: \"operation\"\n};");
  has("    {title: \"stops\", id: \"1\"},\n    {title: \"goes\", id: \"2\"}\n  ],\n  value: \"2\",");
  has("error(localize(\"The width is above 2 mm\"));\n");
  CHECK(text.find("properties.face_give_wide") == std::string::npos);
  CHECK(text.find("properties.face_give_wrong") == std::string::npos);
}

TEST_CASE("fusion cycles: blocks go above, over and down to the point, then call with what is given") {
  const TestFolder folder("dotek-fusion-cycles");
  const std::string text = fragmentOf(toFusion(folder.write("face.cycle", std::string(kFace))));
  backends::fusion::RunInput input = faceInput();
  CHECK(runFragment(text, "face", input).text == "G90 G0 Z25.\nX1. Y2.\nZ-3.\nG65 P8000 R2. W10.\n");
  input.properties["face_give_system"] = 1;
  input.properties["face_system"] = 55;
  input.properties["face_limit"] = 0.05F; // not given: it says nothing
  input.properties["face_wrong"] = 1;
  CHECK(runFragment(text, "face", input).text == "G90 G0 Z25.\nX1. Y2.\nZ-3.\nG65 P8000 R1. S55. W10.\n");
  input.properties["face_give_limit"] = 1;
  CHECK(runFragment(text, "face", input).text.ends_with("G65 P8000 Q0.05 R1. S55. W10.\n"));
  input.properties["face_limit"] = 0;
  CHECK(runFragment(text, "face", input).errors == std::vector<std::string>{"The limit is positive"});
  input.properties["face_limit"] = 1;
  input.properties["face_system"] = 60;
  CHECK(runFragment(text, "face", input).errors.size() == 1);
  input.properties.erase("face_system"); // given, and without a value
  CHECK(runFragment(text, "face", input).errors == std::vector<std::string>{"face: system is no number"});
}

TEST_CASE("fusion cycles: a drilling operation knows no overtravel, so a cycle that reads one asks for it") {
  const TestFolder folder("dotek-fusion-cycles");
  std::string text(kFace);
  text.replace(text.find("by wide"), 7, "by wide overtravel overtravel");
  driver::ConvertOptions options = toFusion(folder.write("face.cycle", text));
  const driver::Outcome refused = driver::convert(options);
  CHECK(refused.status == 1);
  CHECK_MESSAGE(said(refused).find("`--host overtravel=VALUE`") != std::string::npos, said(refused));
  options.common.host.emplace_back("overtravel", "4");
  CHECK(runFragment(fragmentOf(options), "face", faceInput()).ok());
}

TEST_CASE("fusion cycles: a whole post writes the program after the end") {
  const TestFolder folder("dotek-fusion-cycles");
  driver::ConvertOptions options = toFusion(folder.write("face.cycle", std::string(kFace)));
  options.wholePost = true;
  options.results = {{"found", "#150"}};
  options.programNumber = 9100;
  const auto result = runPost(fragmentOf(options), "face", faceInput());
  REQUIRE_MESSAGE(result.ok(), reportOf(result));
  const std::size_t call = result.text.find("G65 P9100 R2. W10."), end = result.text.find("M30\n"),
                    program = result.text.find("\nO9100(FACE WITH A LIMIT)\n"),
                    kept = result.text.find("#150="), back = result.text.find("\nM99\n%\n");
  CHECK(call < end);
  CHECK(end < program);
  CHECK(program < kept);
  CHECK(kept < back);
  CHECK(back != std::string::npos);
}

TEST_CASE("fusion cycles: a change of the fragment is seen") {
  struct Planted {
    const char* was;
    const char* is;
  };
  const TestFolder folder("dotek-fusion-planted");
  const std::string path = folder.write("face.cycle", std::string(kFace));
  const std::string text = fragmentOf(toFusion(path));
  for (const Planted& one : {
           Planted{" + wideText);", ");"},
           Planted{"wideText = \" W\" + wideText;", "wideText = \" W-\" + wideText;"},
           Planted{"wideText = \" W\" + wideText;", "wideText = \" R\" + wideText;"},
           Planted{"forceDecimal: true", "forceDecimal: false"},
           Planted{"\"X\" + xText", "\"X\" + yText"},
           Planted{"writeBlock(\"Z\" + zText);", ""},
           Planted{"  writeBlock(\"G90 G0 Z\" + clearanceText);\n", ""},
           Planted{"writeBlock(\"G65 P8000\"", "writeBlock(\"G65 P8001\""},
           Planted{"face_give_limit\")) === 1 ? ", "face_give_limit\")) === 2 ? "},
           Planted{"wide > 2", "true"},
           Planted{"if (limit > 0)", "if (limit > 50)"},
           Planted{"+#23]\");", "-#23]\");"},
           Planted{"  xOutput.reset();\n", ""},
           Planted{"function face_program() {", "function face_programme() {"},
           Planted{"    return true;\n", "    return false;\n"},
           Planted{"clearance < z", "false"},
           Planted{"unit !== MM", "false"},
       }) {
    CAPTURE(one.was);
    CAPTURE(one.is);
    std::string edited = text;
    const std::size_t at = edited.rfind(one.was);
    REQUIRE(at != std::string::npos);
    edited.replace(at, std::string_view(one.was).size(), one.is);
    driver::VerifyOptions options = verifying(path);
    options.cases = 20;
    options.allowEdits = true; // the cases alone are to show it
    options.translation = folder.write("face.js", edited);
    const driver::Outcome outcome = driver::verify(options);
    CHECK_MESSAGE(outcome.status != 0, said(outcome));
  }
}

TEST_CASE("fusion cycles: a folder beside them takes no flags of programs") {
  driver::ConvertOptions options = toFusion((root() / "examples/surface-x").string());
  options.source.prog = (root() / "examples/post.txt").string();
  options.control.clear();
  options.common.host.clear();
  options.programNumber = 9100;
  const driver::Outcome outcome = driver::convert(options);
  CHECK(outcome.status != 0);
  CHECK_MESSAGE(messagesOf(outcome).find("[fanuc-option]") != std::string::npos, messagesOf(outcome));
}
