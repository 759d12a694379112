// Cycles of tests/shops where a macro of a vendor stops, is not known, or is written as several calls.
#include "driver/Driver.h"
#include "support/Worker.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <string>
#include <vector>

namespace dotek::tests {

namespace {

struct Shop {
  const char* shop;
  const char* cycle;
  const char* routine;
  const char* to;
  const char* macros; // "": none
  const char* control;
  std::vector<std::string> assume = {};
};

void take(const Shop& of, targets::TranslationOptions& out) {
  const std::string shops = (root() / "tests/shops").string() + "/";
  out.inputs = {shops + of.shop + "/" + of.cycle};
  out.source.prog = shops + of.shop + "/post.txt";
  out.source.routine = of.routine;
  out.common.data = {shops + "data"};
  out.to = of.to;
  out.control = of.control;
  if (*of.macros != 0) out.probeMacros = of.macros;
  out.common.probeCodes = {"M31", "M32"};
  out.common.scriptProgram = runningProgram();
  for (const std::string& one : of.assume)
    out.common.assume.insert(one);
}

std::string converted(const Shop& of) {
  driver::ConvertOptions options;
  take(of, options);
  const driver::Outcome outcome = driver::convert(options);
  REQUIRE_MESSAGE(outcome.status == 0, renderText(outcome.diagnostics, outcome.sources, 0));
  return outcome.files.front().text;
}

// Messages and verdict.
std::string verified(const Shop& of, const std::string& text = "") {
  const TestFolder scratch("dotek-verify-shops");
  driver::VerifyOptions options;
  take(of, options);
  options.cases = 20;
  options.jobs = 1;
  if (!text.empty()) options.translation = scratch.write("edited", text);
  const driver::Outcome outcome = driver::verify(options);
  return renderText(outcome.diagnostics, outcome.sources, 0) + outcome.output;
}

bool agrees(const std::string& said) {
  return said.find("\nAGREES: 20 of 20 drawn cases") != std::string::npos;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE_MESSAGE(at != std::string::npos, from << " is not in\n" << text);
  return text.replace(at, from.size(), to);
}

const Shop kSlot{"inspection", "JT.Slot.Datum", "probeOps", "fanuc", "dotek", "fanuc-31i-b"};

} // namespace

TEST_CASE("verify: a limit of the vendor's call and the translation's own comparison") {
  const std::string said = verified(kSlot);
  CHECK_MESSAGE(agrees(said), said);
  // Where the source stops, others were drawn, and it is said.
  CHECK(said.find("[verify-replaced]") != std::string::npos);
  CHECK(said.find("alarm: OUT OF POSITION") != std::string::npos);
  const std::string good = converted(kSlot);
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"(OUT OF POSITION)", "(OUT OF TOLERANCE)"}, // another limit
           {"IF[2.*ABS[#136", "IF[ABS[#136"},           // half of it
           {"GT ABS[#13]]THEN", "GT 0]THEN"},           // always
           {"IF[2.*ABS[#136", "IF[0*ABS[#136"}})        // never
    CHECK_MESSAGE(verified(kSlot, replaced(good, from, to)).find("\nDIFFERS") != std::string::npos,
                  from << " to " << to);
}

TEST_CASE("verify: an angle's touches lie on steps of the control") {
  const std::string said =
      verified({"inspection", "JT.Edge.Angle", "probeOps", "fanuc", "dotek", "fanuc-31i-b"});
  CHECK_MESSAGE(agrees(said), said);
}

TEST_CASE("verify: a corner as two calls of single surfaces") {
  const Shop corner{"inspection", "JT.Vice.Corner", "probeOps", "fanuc", "easyprobe", "fanuc-31i-b"};
  const std::string said = verified(corner);
  CHECK_MESSAGE(agrees(said), said);
  const std::string good = converted(corner);
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"Y[#25-#27] J#25", "Y[#25-#27] J#24"}, // another nominal
           {"X[#24-#28] I#24", "X[#28-#24] I#24"}, // the other way
           {"G65 P9023 S[#19+53.] Y", "G65 P9023 S[#19+54.] Y"}})
    CHECK_MESSAGE(verified(corner, replaced(good, from, to)).find("\nDIFFERS") != std::string::npos,
                  from << " to " << to);
}

TEST_CASE("verify: calls that no source states, made alike") {
  for (const Shop& one :
       {Shop{"inspection", "JT.Pitch.Report", "probeOps", "fanuc", "inspection-plus", "fanuc-31i-b"},
        Shop{"toolchange", "MX.Outside.Corner", "measure", "fanuc", "inspection-plus", "fanuc-0i-md"}}) {
    const std::string said = verified(one);
    CHECK_MESSAGE(agrees(said), said);
    CHECK_MESSAGE(said.find("[verify-unstated]") != std::string::npos, said);
  }
  const Shop corner{"toolchange", "MX.Outside.Corner", "measure", "fanuc", "inspection-plus", "fanuc-0i-md"};
  const std::string good = converted(corner);
  const std::size_t call = good.find("G65 P9816");
  REQUIRE(call != std::string::npos);
  const std::string line = good.substr(call, good.find('\n', call) - call);
  CHECK(verified(corner, replaced(good, line, line + " Q3.")).find("\nDIFFERS") != std::string::npos);
  CHECK(verified(corner, replaced(good, line, line.substr(0, line.rfind(' ')))).find("\nDIFFERS") !=
        std::string::npos);
  CHECK(verified(corner, replaced(good, line, "(" + line + ")")).find("\nDIFFERS") != std::string::npos);
}

TEST_CASE("verify: blocks that jumps lead to keep the numbers of the Prog in a fragment") {
  const std::string said = verified({"direct", "DP.Top.Zero", "touch", "fusion", "dotek", "fanuc-0i-md"});
  CHECK_MESSAGE(agrees(said), said);
}

TEST_CASE("verify: Mikroprog searches as far as the call says, and sets a corner face by face") {
  const std::vector<std::string> assume = {"Q7", "Q10", "Q13"};
  for (const char* cycle : {"JT.Bore.Zero", "JT.Vice.Corner"}) {
    const std::string said =
        verified({"inspection", cycle, "probeOps", "mikroprog", "", "mikroprog-mill", assume});
    CHECK_MESSAGE(agrees(said), said);
  }
}

} // namespace dotek::tests
