// A measured value that is exactly a limit of the branch: a question that asks GT where the source asks GE.
#include "driver/Driver.h"
#include "support/Worker.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"
#include "tests/policy/Tree.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

struct Limit {
  const char *shop, *cycle, *set, *control;
  const char *from, *to; // "": as it is written
};

std::string verified(const Limit& of) {
  const auto shops = root() / "tests" / "shops";
  const auto take = [&](targets::TranslationOptions& options) {
    options.inputs = {(shops / of.shop / of.cycle).generic_string()};
    options.source.prog = (shops / of.shop / "post.txt").generic_string();
    options.common.data = {(shops / "data").generic_string()};
    options.common.scriptProgram = runningProgram();
    options.common.probeCodes = {"M31", "M32"};
    options.to = "fanuc";
    options.probeMacros = of.set;
    options.control = of.control;
  };
  driver::ConvertOptions convert;
  take(convert);
  const driver::Outcome made = driver::convert(convert);
  REQUIRE_MESSAGE(made.status == 0, renderText(made.diagnostics, made.sources, 0));
  std::string text = made.files.front().text;
  const std::string from = of.from;
  const std::size_t at = text.find(from);
  REQUIRE_MESSAGE(at != std::string::npos, text);
  text.replace(at, from.size(), of.to);
  const TestFolder folder("dotek-ties");
  driver::VerifyOptions options;
  take(options);
  options.cases = 20;
  options.jobs = 1;
  options.allowEdits = true;
  options.translation = folder.write("edited", text);
  const driver::Outcome outcome = driver::verify(options);
  return renderText(outcome.diagnostics, outcome.sources, 0) + outcome.output;
}

void isSeen(const Limit& limit) {
  CAPTURE(std::string(limit.cycle));
  CAPTURE(std::string(limit.to));
  Limit same = limit;
  same.to = same.from;
  CHECK(verified(same).find("AGREES: 20 of 20 drawn cases") != std::string::npos);
  CHECK(verified(limit).find("DIFFERS: ") != std::string::npos);
}

} // namespace

TEST_CASE("verify: a limit of the branch is met exactly, with fifteen digits and with other macros, too") {
  for (const Limit& limit : someOf<Limit>({
           {"classes", "SG.Tapp.Klass", "inspection-plus", "fanuc-31i-b", "IF[#621 GT #28]",
            "IF[#621 GE #28]"},
           {"classes", "SG.Tapp.Klass", "inspection-plus", "fanuc-31i-b", "IF[#621 LT #27]",
            "IF[#621 LE #27]"},
           {"classes", "SG.Steg.Hojd", "inspection-plus", "fanuc-31i-b", "] GT #8]", "] GE #8]"},
       }))
    isSeen(limit);
}

TEST_CASE("verify: a flag that a limit chooses is another way, also where nothing else follows from it") {
  isSeen({"zones", "HF.Flaeche.Y", "inspection-plus", "fanuc-31i-b", "IF[#545 LE #25+#27]",
          "IF[#545 LT #25+#27]"});
}
