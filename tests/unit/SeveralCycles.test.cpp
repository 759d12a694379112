// Flags and reports of one command over several cycles.
#include "tests/GoldenRunner.h"
#include "tests/unit/DataFolder.h"

#include <doctest/doctest.h>
#include <filesystem>

using namespace dotek::tests;

namespace fs = std::filesystem;

namespace {

CommandResult post(const std::vector<std::string>& cycles, const std::string& field) {
  std::vector<std::string> all = {"post"};
  all.insert(all.end(), cycles.begin(), cycles.end());
  for (const char* one :
       {"--prog", "examples/mill-post.txt", "--clearance", "5", "--host", "tool_radius=3", "--field"})
    all.emplace_back(one);
  all.push_back(field);
  return runDotek(all, root());
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t out = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++out;
  return out;
}

} // namespace

TEST_CASE("--field: the field that a cycle declares itself is not passed over in silence") {
  const CommandResult one = post({"examples/surface-x"}, "X=R");
  CHECK(one.err.find("`surface-x` declares a field `X` itself") != std::string::npos);
  CHECK(one.err.find("[field-passed-over]") != std::string::npos);
  CHECK(one.out.find("X40.") != std::string::npos);
  // Of several those that lack it; here none does, and that is said.
  const CommandResult several = post({"examples/surface-x", "examples/surface-y"}, "X=R");
  CHECK(several.out.find("X40.") == std::string::npos);
  CHECK(several.err.find("--field") != std::string::npos);
}

TEST_CASE("convert --verify --report: each report lists what concerns its input") {
  const DataFolder folder;
  const std::string report = folder.path() + "/r.md";
  const CommandResult run =
      runDotek({"convert", "examples/surface-x", "examples/surface-y", "--prog", "examples/mill-post.txt",
                "--to", "fanuc", "-d", folder.path() + "/out", "--verify", "--report", report},
               root());
  REQUIRE_MESSAGE(run.status <= 1, run.err); // the path of these examples is another than that of this post
  for (const std::string name : {"x", "y"}) {
    const std::string text = readAll(fs::path(folder.path()) / ("r-surface-" + name + ".md"));
    const std::string left =
        text.substr(text.find("leaves open"), text.find("## Files") - text.find("leaves open"));
    CAPTURE(left);
    CHECK(count(left, "examples/surface-" + std::string(name == "x" ? "y" : "x")) == 0);
    CHECK(count(left, "examples/mill-post.txt:" + std::string(name == "x" ? "49" : "40")) == 0);
  }
}

TEST_CASE("convert --verify --report: the command in a report makes the same program") {
  const DataFolder folder;
  const CommandResult run = runDotek({"convert", "examples/surface-x", "examples/surface-y", "--prog",
                                      "examples/mill-post.txt", "--to", "fanuc", "-d", folder.path() + "/out",
                                      "--verify", "--report", folder.path() + "/r.md"},
                                     root());
  REQUIRE_MESSAGE(run.status <= 1, run.err); // as above
  CHECK(count(readAll(fs::path(folder.path()) / "r-surface-x.md"), "--program-number") == 0);
  CHECK(count(readAll(fs::path(folder.path()) / "r-surface-y.md"), "--program-number 8001") > 0);
}

TEST_CASE("sim: the codes that switch the probe come from dotek.toml, too") {
  const DataFolder folder;
  folder.write("run.nc", "G21 G90 G54\nM71\nG0 X5.\nM72\nM30\n");
  CHECK(runDotek({"sim", "run.nc", "--quiet"}, folder.path()).status == 1);
  folder.write("dotek.toml", "schema = 1\nprobe_on = \"M71\"\nprobe_off = \"M72\"\n");
  const CommandResult known = runDotek({"sim", "run.nc", "--quiet"}, folder.path());
  CHECK_MESSAGE(known.status == 0, known.err);
  fs::remove(fs::path(folder.path()) / "dotek.toml");
  folder.write("job.toml",
               "schema = 1\nprobe_on = \"M71\"\nprobe_off = \"M72\"\n[setup]\ntool = 1\nlength = 100.0\n");
  const CommandResult byJob = runDotek({"sim", "run.nc", "--quiet", "--job", "job.toml"}, folder.path());
  CHECK_MESSAGE(byJob.status == 0, byJob.err);
}

TEST_CASE("verify and convert: the codes that switch the probe of a program come from dotek.toml, too") {
  const DataFolder folder;
  const std::string program = "O1000\nG21 G90 G54\nM71\nG31 X#1 F100.\n#500=#5061\nM72\nM99\n";
  folder.write("run.nc", program);
  const std::vector<std::string> verify = {"verify",    "run.nc",      "--to",    "fanuc",
                                           "--control", "fanuc-0i-md", "--cases", "20"};
  CHECK(runDotek(verify, folder.path()).out.find("DOES NOT AGREE") == std::string::npos);
  CHECK(runDotek(verify, folder.path()).out.find("UNDECIDED") != std::string::npos);
  folder.write("dotek.toml", "schema = 1\nprobe_on = \"M71\"\nprobe_off = \"M72\"\n");
  const CommandResult known = runDotek(verify, folder.path());
  CHECK_MESSAGE(known.out.find("AGREES: 20 of 20") != std::string::npos, known.out << known.err);
  // A flag is before the file.
  std::vector<std::string> other = verify;
  other.insert(other.end(), {"--probe-on", "M73"});
  CHECK(runDotek(other, folder.path()).out.find("AGREES: 20 of 20") == std::string::npos);
  fs::create_directory(fs::path(folder.path()) / "old");
  folder.write("old/run.nc", program);
  folder.write("old/dotek.toml", "schema = 1\nprobe_on = \"M75\"\n");
  const CommandResult two =
      runDotek({"convert", "run.nc", "old/run.nc", "--to", "fanuc", "-d", "out"}, folder.path());
  CHECK(two.status == 1);
  CHECK_MESSAGE(two.err.find("[probe-codes-differ]") != std::string::npos, two.err);
}

TEST_CASE("sim: the picture of a run whose lengths count at the tip shows the probe") {
  const DataFolder folder;
  folder.write("mill.toml",
               "schema = 1\n[probe]\nlength = 0.0\nlength_to = \"tip\"\non = true\nball_diameter = 6.0\n");
  folder.write("run.nc", "G21 G90 G54\nG0 X5.\nM30\n");
  const CommandResult run =
      runDotek({"sim", "run.nc", "--quiet", "--machine", "mill.toml", "--html", "run.html"}, folder.path());
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK(readAll(fs::path(folder.path()) / "run.html").find("no probe is stated") == std::string::npos);
}
