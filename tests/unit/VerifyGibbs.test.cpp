// verify --to gibbs: the folder that is written, by its dialog and its branch, beside its source.
#include "driver/Driver.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/Process.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <string>

using namespace dotek;
using namespace dotek::tests;

namespace {

std::string cycle(const char* name) {
  return (root() / "stdlib/cycles" / (std::string(name) + ".cycle")).string();
}

driver::VerifyOptions optionsOf(const std::string& input) {
  driver::VerifyOptions out;
  out.inputs = {input};
  out.to = "gibbs";
  out.control = "fanuc-31i-b";
  out.probeMacros = "inspection-plus";
  out.common.host = {{"approach_feed", "1000"}, {"overtravel", "5"}};
  out.defaults = {{"system", "55"}};
  out.jobs = 1;
  out.cases = draws(40U, 8U);
  return out;
}

std::string said(const driver::Outcome& outcome) {
  std::string out = outcome.output;
  for (const Diagnostic& one : outcome.diagnostics.all())
    out += "\n" + one.message + " [" + std::string(one.code) + "]";
  return out;
}

// "": it stands nowhere.
std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? "" : text.replace(at, from.size(), to);
}

} // namespace

TEST_CASE("verify to gibbs: what is written of a cycle agrees with it") {
  driver::VerifyOptions bore = optionsOf(cycle("bore"));
  bore.defaults.emplace_back("diameter", "40");
  driver::VerifyOptions web = optionsOf(cycle("web-y"));
  for (const auto& one : {std::pair("width", "30"), std::pair("depth", "5"), std::pair("clearance", "8"),
                          std::pair("tolerance", "0.1")})
    web.defaults.emplace_back(one);
  for (const driver::VerifyOptions& options : {bore, web}) {
    const driver::Outcome outcome = driver::verify(options);
    CHECK_MESSAGE(outcome.output.starts_with("AGREES"), said(outcome));
  }
}

TEST_CASE("verify to gibbs: what is written of a folder agrees with it") {
  driver::VerifyOptions options = optionsOf((root() / "tests/golden/cycle/from-cam/ledge").string());
  options.source.prog = (root() / "tests/golden/cycle/from-cam/post.txt").string();
  options.source.form = "thesis-a";
  options.control.clear();
  options.probeMacros.reset();
  options.defaults = {{"NP", "55"}};
  const driver::Outcome outcome = driver::verify(options);
  CHECK_MESSAGE(outcome.output.starts_with("AGREES"), said(outcome));
}

TEST_CASE("verify to gibbs: folders whose macros touch bores, webs and faces at an angle") {
  struct Source {
    const char *area, *name;
  };
  for (const Source& one : {Source{"from-cam", "eyelet"}, {"from-cam", "tongue"}}) {
    driver::VerifyOptions options = optionsOf((root() / "tests/golden/cycle" / one.area / one.name).string());
    options.source.prog = (root() / "tests/golden/cycle" / one.area / "post.txt").string();
    options.source.form = "thesis-a";
    options.control.clear();
    options.probeMacros.reset();
    options.defaults.clear();
    const driver::Outcome outcome = driver::verify(options);
    CHECK_MESSAGE(outcome.output.starts_with("AGREES"), one.name << ": " << said(outcome));
  }
}

TEST_CASE("verify to gibbs: a dialog or a branch that was damaged differs") {
  const std::string convert =
      " --to gibbs --control fanuc-31i-b --probe-macros inspection-plus --host "
      "approach_feed=1000 --host overtravel=5 --default system=55 --default diameter=40 ";
  const ProcessFolder folder;
  REQUIRE(folder.run("dotek convert " + cycle("bore") + convert + "-d out").status == 0);
  const std::string branch = folder.read("out/bore/branch.txt"),
                    checks = folder.read("out/bore/CycleData.mac"),
                    path = folder.read("out/bore/ToolPath.mac"),
                    first = folder.read("out/bore/DefineData.txt");
  const auto verdict = [&](const std::string& cases) {
    return folder.run("dotek verify " + cycle("bore") + convert + "--cases " + cases +
                      " --jobs 1 --allow-edits --translation out/bore/branch.txt");
  };
  const std::string cases = std::to_string(draws(40U, 10U));
  CHECK_MESSAGE(verdict(cases).out.starts_with("AGREES"), branch);

  const auto differs = [&](const std::string& file, const std::string& text, std::string_view from,
                           std::string_view to, const std::string& says = "") {
    CAPTURE(from);
    const std::string damaged = replaced(text, from, to);
    REQUIRE_MESSAGE(!damaged.empty(), text);
    folder.write("out/bore/" + file, damaged);
    const ShellResult result = verdict(cases);
    CHECK_MESSAGE(result.out.starts_with("DIFFERS"), result.out << result.err);
    CHECK_MESSAGE(result.err.find(says) != std::string::npos, result.err);
    folder.write("out/bore/" + file, text);
  };
  differs("branch.txt", branch, "G65 P9833", "G65 P9832");                    // the probe stays on
  differs("branch.txt", branch, "]+#159-", "]-#159-");                        // a sign
  differs("branch.txt", branch, " SeqC ' G65 P9810 Z#150 F1000.' EOL\n", ""); // a retract
  differs("branch.txt", branch, " SeqC SpinOff EOL\n", "");
  differs("branch.txt", branch, " SeqC ' G53' EOL\n SeqC ' #[5221", " SeqC ' #[5221"); // reads ahead
  differs("CycleData.mac", checks, "if depth < 0 then goto", "if depth < 0.5 then goto");
  differs("CycleData.mac", checks, "if diameter >= 2*radius+1 then goto fine", "goto fine");
  differs("CycleData.mac", checks, "No room in the bore", "No bore in the room");
  const char* const drawn = " draws something else than the branch does: ";
  differs("ToolPath.mac", path, "feed_z, at_z-depth", "feed_z, at_z-depth-1", drawn);
  differs("ToolPath.mac", path, "feed_x, at_x_2+diameter/2-radius", "feed_x, at_x_2+diameter/4-radius",
          drawn);
  differs("ToolPath.mac", path, "add_custom_drill_cycle_path feed_z, 0",
          "add_custom_drill_cycle_path feed_z, 5", drawn);
  differs("DefineData.txt", first, "diameter = 40", "diameter = 41",
          "gives diameter the first value 41 against 40, that of the source");
}

TEST_CASE("verify to gibbs: a dialog that asks for something else differs") {
  const ProcessFolder folder;
  const std::string shop = (root() / "tests/shops/inspection").string();
  const std::string source = shop + "/JT.Slot.Datum --prog " + shop + "/post.txt --data " +
                             (root() / "tests/shops/data").string() + " --to gibbs --host clearance=50 ";
  const ShellResult made = folder.run("dotek convert " + source + "-d out");
  REQUIRE_MESSAGE(made.status == 0, made.err);
  const std::string dialog = folder.read("out/JT.Slot.Datum/CycleData.dlg");
  const auto verdict = [&](std::string_view from, std::string_view to) {
    const std::string damaged = replaced(dialog, from, to);
    REQUIRE_MESSAGE(!damaged.empty(), dialog);
    folder.write("out/JT.Slot.Datum/CycleData.dlg", damaged);
    const ShellResult result = folder.run("dotek verify " + source +
                                          "--jobs 1 --cases 8 --allow-edits --translation "
                                          "out/JT.Slot.Datum/branch.txt");
    return result.out + result.err;
  };
  const auto differs = [&](std::string_view from, std::string_view to, std::string_view says) {
    const std::string found = verdict(from, to);
    CHECK_MESSAGE(found.starts_with("DIFFERS"), found);
    CHECK_MESSAGE(found.find(says) != std::string::npos, found);
  };
  const std::string sound = verdict("dialog ", "dialog ");
  CHECK_MESSAGE(sound.starts_with("AGREES"), sound);
  // In other words a text may say the same.
  const std::string reworded = verdict("nominal width", "width as in the drawing");
  CHECK_MESSAGE(reworded.starts_with("AGREES"), reworded);
  differs("\"G55\", 2", "\"G55\", 9", "the list of `WCS` does not offer 2, `G55` of the source");
  differs("\"G56\", 3", "\"G58\", 3", "the list of `WCS` calls 3 `G58` against `G56`");
  differs("dropdown_val 1,", "dropdown_add 1, \"G54.1 P9\", 109\ndropdown_val 1,",
          "the list of `WCS` offers 109");
  differs(", ZONE, ZONE", ", WIDE, WIDE", "no row asks for `ZONE`");
  differs(", ZM, ZM", ", ZM, FLOOR", "the input of `ZM` begins with the value of `FLOOR`");
  differs("\"ZM [mm]\"", "\"FLOOR [mm]\"", "the name beside `ZM` is that of `FLOOR`");
  differs("\"ZM [mm]\"", "\"ZM [inch]\"", "`ZM` is in inch, and counts mm");
  differs("Width, nominal width", "height of the touches", "the text beside `WIDE` is that of `ZM`");
}

TEST_CASE("verify to gibbs: the temporary folder is gone at the end, and on a signal") {
  const ProcessFolder folder;
  const std::string verify =
      "TMPDIR=$PWD/made \"$DOTEK\" verify " + cycle("surface-z") +
      " --to gibbs --control fanuc-31i-b --probe-macros inspection-plus --host "
      "approach_feed=1000 --host overtravel=5 --default system=55 --default distance=12 ";
  folder.run("mkdir made");
  CHECK(folder.run(verify + "--cases 4 --jobs 1").status == 0);
  CHECK(folder.run("ls -A made").out.empty());
  const ShellResult ended = folder.run(
      verify + "--cases 10000000 >/dev/null 2>&1 & run=$!\n" +
      "until ls made/*/*/branch.txt >/dev/null 2>&1; do sleep 0.05; done\nkill -TERM $run\nwait $run\n"
      "echo $?");
  CHECK(ended.out == "143\n");
  CHECK(folder.run("ls -A made").out.empty());
}

TEST_CASE("verify to gibbs: a loop of fixed rounds is written out, with what it decides on contacts") {
  const ProcessFolder folder;
  folder.write("least.cycle", R"(cycle least "Least height of three"
parameter pitch : length = 10 mm require pitch > 0 mm "No pitch"
result lowest : length
result above : length
spindle off
probe on
least = 100 mm
sum = 0 mm
for i = 0 to 2
  protected move to x start.x + i * pitch
  touch z by -5 mm -> face
  least = min(least, face.at)
  if face.at > 0 mm then
    sum = sum + face.at
  end
end
probe off
lowest = least
above = sum
)");
  const std::string to = " --to gibbs --control fanuc-31i-b --probe-macros inspection-plus --host "
                         "approach_feed=1000 --host overtravel=5 --result lowest=#600 --result above=#601 ";
  REQUIRE(folder.run("dotek convert least.cycle" + to + "-d out").status == 0);
  const auto verdict = [&] {
    return folder.run("dotek verify least.cycle" + to +
                      "--jobs 1 --allow-edits --translation out/least/branch.txt --cases " +
                      std::to_string(draws(60U, 10U)));
  };
  const ShellResult sound = verdict();
  CHECK_MESSAGE(sound.out.starts_with("AGREES"), sound.out << sound.err);
  const std::string branch = folder.read("out/least/branch.txt");
  const std::string damaged = replaced(branch, " GT 0.]THEN #151=#151+", " LT 0.]THEN #151=#151+");
  REQUIRE_MESSAGE(!damaged.empty(), branch);
  folder.write("out/least/branch.txt", damaged);
  CHECK_MESSAGE(verdict().out.starts_with("DIFFERS"), damaged);
}

TEST_CASE("convert to gibbs with --verify writes what agrees") {
  const ProcessFolder folder;
  const ShellResult result =
      folder.run("dotek convert " + cycle("surface-z") +
                 " --to gibbs --control fanuc-31i-b --probe-macros inspection-plus --host approach_feed=1000 "
                 "--host overtravel=5 --default system=55 --default distance=12 --verify -d out");
  CHECK_MESSAGE(result.status == 0, result.out << result.err);
  CHECK(result.err.find("[verified]") != std::string::npos);
  CHECK_FALSE(folder.read("out/surface-z/branch.txt").empty());
}
