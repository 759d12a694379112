// The facts of a lathe: [turning], and the profile that has them.
#include "stdlib/ControlFacts.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"
#include "tests/unit/ControlText.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::stdlib;
using namespace dotek::tests;

namespace {

std::string turning(const std::string& what) {
  return changed("words =", "turning = {" + what + ",grade='assumed',source='x'}\nwords =");
}

} // namespace

TEST_CASE("a lathe's control: the codes of system A, each fact with its source") {
  const Control lathe = *Control::load(DataFiles(), "fanuc-0i-tf");
  REQUIRE(lathe.turning);
  CHECK(lathe.turning->diameters);
  CHECK(lathe.turning->axisOf('U') == 'X');
  CHECK(lathe.turning->axisOf('H') == 'C');
  CHECK(lathe.turning->axisOf('Q') == 0);
  CHECK(lathe.turning->incrementOf('Z') == 'W');
  CHECK(lathe.turning->axes == "XZ");
  CHECK(lathe.turning->startCodes == std::vector<std::uint32_t>{180, 990});
  const auto does = [&](std::uint32_t code) { return lathe.find('G', code * 10)->function; };
  CHECK(does(90) == Function::TurningCycle);
  CHECK(does(92) == Function::ThreadingCycle);
  CHECK(does(94) == Function::FacingCycle);
  CHECK(does(32) == Function::Thread);
  CHECK(does(50) == Function::SetPosition);
  CHECK(does(98) == Function::FeedPerMinute);
  CHECK(does(99) == Function::FeedPerRevolution);
  CHECK(does(70) == Function::ContourFinish);
  CHECK(does(73) == Function::ContourRough);
  CHECK(does(74) == Function::PeckAlongZ);
  CHECK(does(75) == Function::PeckAlongX);
  CHECK(does(76) == Function::ThreadPasses);
  CHECK(lathe.find('G', 910) == nullptr);
  CHECK(lathe.find(Function::Absolute) == nullptr);
  CHECK(lathe.find(Function::CannedCycle) == nullptr);
  for (const std::uint32_t code : {900u, 920u, 940u, 320u, 0u})
    CHECK(lathe.find('G', code)->group == 1);
  for (const ControlFact& fact : controlFacts(DataFiles(), "fanuc-0i-tf")) {
    CAPTURE(fact.section);
    CAPTURE(fact.key);
    if (fact.section == "title") continue;
    CHECK_FALSE(fact.grade.empty());
    CHECK_FALSE(fact.source.empty());
  }
  const DataFiles data;
  for (const DataFile* file : data.list("controls"))
    if (file->name != "fanuc-0i-tf") CHECK_FALSE(Control::load(data, file->name)->turning);
}

TEST_CASE("[turning] says what is wrong with it") {
  const std::string good = "x='diameter',increments=['XU','ZW'],axes='XZ',start=['G54'],offset_digits=2";
  CHECK(turning(good) == "");
  CHECK(turning("x='radius',increments=[],axes='',start=[],offset_digits=1") == "");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return turning(text.replace(text.find(from), from.size(), to));
  };
  CHECK(with("'ZW'", "'XW'").find("`XW` is no axis with the address of its increments") != std::string::npos);
  CHECK(with("'ZW'", "'ZU'").find("`ZU` is no axis") != std::string::npos);
  CHECK(with("'ZW'", "'Z'").find("`Z` is no axis") != std::string::npos);
  CHECK(with("axes='XZ'", "axes='XX'").find("`XX` are no axes, each once") != std::string::npos);
  CHECK(with("axes='XZ'", "axes='XQ'").find("`XQ` are no axes") != std::string::npos);
  CHECK(with("'G54'", "'G18'").find("`G18` is no G code of the control") != std::string::npos);
  CHECK(with("'G54'", "'M3'").find("`M3` is no G code") != std::string::npos);
  CHECK(with("offset_digits=2", "offset_digits=5") != "");
  CHECK(with("x='diameter',", "") != "");
}

TEST_CASE("nothing is converted from the programs of a lathe, or into them") {
  const TestFolder folder("dotek-control-of-lathe");
  folder.write("o.nc", "O0081\nG0 X40. Z2.\nM30\n");
  const std::string surface = (root() / "examples/surface-x").string(),
                    post = (root() / "examples/post.txt").string();
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"convert", "o.nc", "--to", "fanuc", "--control", "fanuc-0i-tf",
                                 "--from-control", "fanuc-0i-md"},
        {"convert", "o.nc", "--to", "fanuc", "--control", "fanuc-31i-b", "--from-control", "fanuc-0i-tf"},
        {"verify", "o.nc", "--to", "fanuc", "--control", "fanuc-0i-tf", "--from-control", "fanuc-0i-md"},
        {"convert", surface, "--prog", post, "--to", "fanuc", "--control", "fanuc-0i-tf"}}) {
    const CommandResult out = runDotek(arguments, folder.path());
    CAPTURE(out.err);
    CHECK(out.status != 0);
    CHECK(out.out.empty());
    CHECK(out.err.find("[control-of-lathe]") != std::string::npos);
  }
}
