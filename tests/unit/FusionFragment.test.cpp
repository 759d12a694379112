// Parts of Fusion posts, run on the double of the kernel.
#include "FusionHelper.h"
#include "support/Picture.h"
#include "tests/Draws.h"

#include <cstdlib>
#include <fstream>
#include <random>

using namespace dotek;
using namespace dotek::tests;
namespace fusion = backends::fusion;
namespace fs = std::filesystem;

namespace {

std::string example(const std::string& name) {
  return (root() / "examples" / name).generic_string();
}
std::string ownPost() {
  return (root() / "tests" / "fusion" / "post.txt").generic_string();
}

struct Case {
  std::string folder, prog, prefix;
  std::vector<std::string> fields;
  driver::NamedTexts mapped = {}; // the post's field = the macro's variable
  bool recover = false;
};

// Random values: what the fragment prints is what `post` prints; what the dialog rejects is an error in
// both.
void equalsPost(const Case& one) {
  driver::ConvertOptions convert = toFusion(one.folder, one.prog);
  convert.common.recover = one.recover;
  convert.common.field = one.mapped;
  const std::string fragment = fragmentOf(convert);
  std::mt19937 random(6);
  std::uniform_int_distribution<int> place(-99999, 99999);
  std::uniform_int_distribution<int> system(53, 60);
  std::uniform_int_distribution<int> scale(1, 3);
  const int sets = draws(60, 6);
  int printed = 0, refused = 0;
  for (int set = 0; set < sets || printed < sets / 4; ++set) {
    REQUIRE_MESSAGE(set < 50 * sets, one.folder << ": only " << printed << " value sets pass the checks");
    driver::PostOptions post;
    post.folders = {one.folder};
    post.source.prog = one.prog;
    post.common.recover = one.recover;
    post.common.field = one.mapped;
    fusion::RunInput input;
    const double clearance = place(random) / 100.0;
    input.toolDiameter = 6;
    input.cycle["clearance"] = clearance;
    post.common.host = {{"clearance", numberText(clearance)}, {"tool_radius", "3"}};
    for (const std::string& field : one.fields) {
      const double value =
          field == "G" ? system(random) : place(random) / (scale(random) == 1 ? 100.0 : 1000.0);
      post.common.set.emplace_back(field, numberText(value));
      input.properties[one.prefix + "_" + field] = value;
    }
    const driver::Outcome posted = driver::post(post);
    const fusion::RunResult run = runFragment(fragment, one.prefix, input);
    REQUIRE_MESSAGE(!run.fault, faultOf(run));
    CHECK_FALSE(run.wroteAfterError);
    CHECK_MESSAGE(run.ok() == (posted.status == 0), reportOf(run) << "\n" << messagesOf(posted));
    if (posted.status != 0) {
      CHECK(run.text.empty());
      ++refused;
      continue;
    }
    CHECK(withoutNumbers(run.text) == withoutNumbers(posted.output));
    ++printed;
  }
  CHECK((refused > 0 || fewDraws()));
}

// A cycle of one field `V` that a post prints with the picture.
struct PictureCycle {
  fs::path folder = fs::temp_directory_path() / "dotek-fusion-picture";
  explicit PictureCycle(const std::string& picture) {
    fs::create_directories(folder);
    write("DefineData.txt", "V = 1\n");
    write("CycleData.dlg",
          "dialog \"One value\", 0, 0, 200, 100\ninput 10, 10, 50, 20, V, V\nok 10, 50, 40, 20\n"
          "cancel 60, 50, 40, 20\n");
    write("CycleData.mac", "callback_returncode = 0\ndialog \"CycleData.dlg\"\n");
    write("ToolPath.mac", "callback_returncode = 0\n");
    write("post.txt",
          "#1 = '" + picture +
              "'\nFORMAT(OpFieldData#,1)\nprobe:\nIF CycleType?('dotek-fusion-picture')\n SeqC ' G4 "
              "X'OpFieldData#('V') EOL\nEND\nRETURN\n");
  }
  ~PictureCycle() { fs::remove_all(folder); }
  PictureCycle(const PictureCycle&) = delete;
  PictureCycle& operator=(const PictureCycle&) = delete;

  fusion::RunResult run(double value) const {
    if (fragment_.empty())
      fragment_ = fragmentOf(toFusion(folder.generic_string(), (folder / "post.txt").generic_string()));
    fusion::RunInput input;
    input.properties["dotekFusionPicture_V"] = value;
    return runFragment(fragment_, "dotekFusionPicture", input);
  }
  std::string printed(double value) const {
    const fusion::RunResult result = run(value);
    CHECK_MESSAGE(result.ok(), reportOf(result));
    const auto lines = withoutNumbers(result.text);
    REQUIRE(lines.size() == 1);
    REQUIRE(lines[0].starts_with("G4 X"));
    return lines[0].substr(4);
  }

private:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
  }
  mutable std::string fragment_;
};

// The block that measures; point (100, 50), G54, overtravel 10.
std::string measuringBlock(const Case& one, const std::map<std::string, double>& values) {
  driver::ConvertOptions convert = toFusion(one.folder, one.prog);
  convert.common.recover = one.recover;
  convert.common.field = one.mapped;
  convert.common.host = {{"overtravel", "10"}};
  convert.probeMacros = "inspection-plus";
  fusion::RunInput input;
  input.points = {{100, 50, 0}};
  input.cycle["clearance"] = 5;
  for (const auto& [name, value] : values)
    input.properties[one.prefix + "_" + name] = value;
  const fusion::RunResult run = runFragment(fragmentOf(convert), one.prefix, input);
  if (!run.ok()) {
    CHECK(run.text.empty());
    return run.fault ? run.fault->text : "error: " + run.errors.front();
  }
  std::string out;
  for (const std::string& line : withoutNumbers(run.text))
    if (line.starts_with("G65 P9811") || line.starts_with("G65 P9814")) out += line;
  return out;
}

} // namespace

TEST_CASE("a fragment of EasyProbe prints what the post prints, whatever the values are") {
  const std::string post = ownPost();
  equalsPost({example("surface-x"),
              (root() / "examples" / "post.txt").generic_string(),
              "surfaceX",
              {"G", "X", "I", "Z", "R"}});
  equalsPost({example("surface-x"), post, "surfaceX", {"G", "X", "I", "Z", "R"}});
  equalsPost({example("surface-y"), post, "surfaceY", {"G", "Y", "J", "Z", "R"}});
  equalsPost({example("surface-z"), post, "surfaceZ", {"G", "D", "K", "W", "R"}});
  equalsPost({example("bore"), post, "bore", {"G", "D", "I", "J", "Z", "R"}});
  equalsPost({example("corner-xyz"),
              (root() / "examples" / "mill-post.txt").generic_string(),
              "cornerXyz",
              {"G", "XA", "I", "YB", "J", "ZC", "K", "UB", "VB", "UC", "VC", "WC", "Z", "R"}});
}

TEST_CASE("corpus: a fragment of EasyProbe prints what the post prints") {
  fs::path folder;
  if (!haveCorpus(folder)) return;
  const std::string prog = (folder / "compost" / "probe-routines.txt").generic_string();
  const auto cycle = [&](const std::string& name) { return (folder / "gibbs" / name).generic_string(); };
  equalsPost({cycle("MERENI.OSA.X"), prog, "mereniOsaX", {"G", "a", "I", "Z", "Zb"}, {{"X", "a"}}, true});
  equalsPost({cycle("MERENI.OSA.Y"), prog, "mereniOsaY", {"G", "b", "J", "Z", "Zb"}, {{"Y", "b"}}, true});
  equalsPost({cycle("MERENI.OSA.Z"), prog, "mereniOsaZ", {"G", "d", "C", "K", "Zb"}, {{"Z", "d"}}, true});
  equalsPost({cycle("MERENI.OSA.XYZ"),
              prog,
              "mereniOsaXyz",
              {"G", "a", "b", "c", "X", "Y", "Z", "KA", "IB", "JB", "KB", "IC", "JC", "KC", "Zb"},
              {},
              true});
  equalsPost(
      {cycle("MERENI.STRED.OTVOR"), prog, "mereniStredOtvor", {"G", "D", "X", "Y", "Z", "Zb"}, {}, true});
}

TEST_CASE("the fragment prints every picture as the table says") {
  // Columns: 1.2, -1.2, 120, .0012, 0.
  struct Row {
    const char* picture;
    std::array<const char*, 5> texts;
  };
  constexpr double kValues[] = {1.2, -1.2, 120, 0.0012, 0};
  for (const Row& row :
       std::initializer_list<Row>{{"###.####", {"1.2", "-1.2", "120.", ".0012", ""}},
                                  {"###.####;0", {"1.2", "-1.2", "120.", ".0012", "0"}},
                                  {"###.####;0.", {"1.2", "-1.2", "120.", ".0012", "0."}},
                                  {"###.###0", {"1.2000", "-1.2000", "120.0000", ".0012", ".0000"}},
                                  {"0##^####", {"0012", "-0012", "120", "0000012", "000"}},
                                  {"###^0000", {"12000", "-12000", "1200000", "0012", "0000"}},
                                  {"###^0000;0;5", {"12000", "-12000", "1200000", "0010", "0"}},
                                  {"###^###0", {"12000", "-12000", "1200000", "12", "0"}},
                                  {"000^0000", {"0012000", "-0012000", "1200000", "0000012", "0000000"}}}) {
    const PictureCycle cycle(row.picture);
    for (std::size_t i = 0; i < row.texts.size(); ++i) {
      CAPTURE(row.picture);
      CAPTURE(kValues[i]);
      CHECK(cycle.printed(kValues[i]) == row.texts[i]);
    }
  }
}

TEST_CASE("pictures of the fragment are the pictures of post") {
  std::mt19937 random(62);
  std::uniform_int_distribution<int> digits(-99999999, 99999999), places(0, 8);
  for (const char* text :
       {"####.##;0", "##0.0##", "###.###;0;5", "####^##0", "0000.0", "###", "####.####;0;25"}) {
    const PictureCycle cycle(text);
    const auto parsed = Picture::parse(text);
    const auto& picture = std::get<Picture>(parsed);
    for (int i = 0; i < draws(150); ++i) {
      double value = digits(random);
      for (int place = places(random); place > 0; --place)
        value /= 10;
      CAPTURE(text);
      CAPTURE(value);
      const Picture::Printed wanted = picture.print(value);
      const fusion::RunResult run = cycle.run(value);
      REQUIRE(!run.fault);
      CHECK(run.ok() == (wanted.fit != Picture::Fit::DoesNotFit));
      if (run.ok()) CHECK(withoutNumbers(run.text) == withoutNumbers("N1 G4 X" + wanted.text));
      if (run.ok()) CHECK(run.warnings.empty() == (std::abs(wanted.value.value() - value) <= 1e-9));
    }
  }
}

TEST_CASE("measuring blocks of Inspection Plus") {
  const std::string post = ownPost();
  const Case x{example("surface-x"), post, "surfaceX", {}};
  CHECK(measuringBlock(x, {{"X", 7}, {"I", 107}, {"G", 54}}) == "G65 P9811 X107. Q10. S1.");
  CHECK(measuringBlock(x, {{"X", -7}, {"I", 93}, {"G", 59}}) == "G65 P9811 X93. Q10. S6.");
  CHECK(measuringBlock(x, {{"X", 7}, {"I", 107.0000005}, {"G", 54}}) == "G65 P9811 X107. Q10. S1.");
  CHECK(measuringBlock(x, {{"X", 7}, {"I", 107.001}, {"G", 54}})
            .starts_with("error: surface-x: the start and"));
  CHECK(measuringBlock(x, {{"X", 7}, {"I", 0}, {"G", 54}}).starts_with("error: "));
  CHECK(measuringBlock(x, {{"X", 2}, {"I", 102}, {"G", 54}}) ==
        "error: The travel is not longer than the radius of the ball");
  CHECK(measuringBlock({example("surface-y"), post, "surfaceY", {}}, {{"Y", 7}, {"J", 57}, {"G", 54}}) ==
        "G65 P9811 Y57. Q10. S1.");
  // The travel of this one goes beyond the face by its own default values: the blocks set the offset
  // themselves.
  CHECK(measuringBlock({example("surface-z"), post, "surfaceZ", {}},
                       {{"W", -1}, {"D", -4}, {"K", -5}, {"G", 54}}) == "G65 P9811 Z-5. Q10.");
  CHECK(measuringBlock({example("bore"), post, "bore", {}}, {{"D", 40}, {"I", 100}, {"J", 50}, {"G", 54}}) ==
        "G65 P9814 D40. Q10. S1.");
  CHECK(measuringBlock({example("bore"), post, "bore", {}}, {{"D", 40}, {"I", 100}, {"J", 51}, {"G", 54}})
            .starts_with("error: "));
}

TEST_CASE("corpus: measuring blocks of Inspection Plus") {
  fs::path folder;
  if (!haveCorpus(folder)) return;
  const std::string prog = (folder / "compost" / "probe-routines.txt").generic_string();
  const auto of = [&](const std::string& name, const std::string& prefix, driver::NamedTexts mapped) {
    return Case{(folder / "gibbs" / name).generic_string(), prog, prefix, {}, std::move(mapped), true};
  };
  CHECK(measuringBlock(of("MERENI.OSA.X", "mereniOsaX", {{"X", "a"}}), {{"a", 7}, {"I", 107}, {"G", 54}}) ==
        "G65 P9811 X107. Q10. S1.");
  CHECK(measuringBlock(of("MERENI.OSA.Y", "mereniOsaY", {{"Y", "b"}}), {{"b", 7}, {"J", 57}, {"G", 54}}) ==
        "G65 P9811 Y57. Q10. S1.");
  CHECK(measuringBlock(of("MERENI.OSA.Z", "mereniOsaZ", {{"Z", "d"}}),
                       {{"C", -1}, {"d", -4}, {"K", -5}, {"G", 54}}) == "G65 P9811 Z-5. Q10. S1.");
  CHECK(measuringBlock(of("MERENI.STRED.OTVOR", "mereniStredOtvor", {}),
                       {{"D", 40}, {"X", 100}, {"Y", 50}, {"G", 54}}) == "G65 P9814 D40. Q10. S1.");
}

TEST_CASE("what the operation lacks is an error, and nothing is printed") {
  const std::string fragment = fragmentOf(toFusion(example("surface-x"), ownPost()));
  fusion::RunInput input;
  const fusion::RunResult noPlane = runFragment(fragment, "surfaceX", input);
  CHECK(noPlane.errors == std::vector<std::string>{"surface-x: cycle.clearance is no number"});
  CHECK(noPlane.text.empty());
  input.cycle["clearance"] = 5;
  CHECK(runFragment(fragment, "surfaceX", input).ok());
  input.properties["surfaceX_G"] = 54.5;
  CHECK(runFragment(fragment, "surfaceX", input).errors ==
        std::vector<std::string>{"surface-x: G is no whole number"});
  input.properties["surfaceX_G"] = 54;
  input.properties["surfaceX_I"] = 12345;
  CHECK(runFragment(fragment, "surfaceX", input).errors ==
        std::vector<std::string>{"surface-x: I does not fit ####.##;0"});
  input.properties["surfaceX_I"] = 1.234;
  const fusion::RunResult lost = runFragment(fragment, "surfaceX", input);
  CHECK(lost.ok());
  CHECK(lost.warnings.size() == 1);
  input.inch = true;
  const fusion::RunResult inch = runFragment(fragment, "surfaceX", input);
  CHECK(inch.errors.size() == 1);
  CHECK(inch.text.empty());
}

TEST_CASE("numbers that a job keeps in 32 bits print, compare and warn as those that were typed") {
  const auto inJob = [](double value) { return static_cast<double>(static_cast<float>(value)); };
  const std::string fragment = fragmentOf(toFusion(example("surface-x"), ownPost()));
  driver::ConvertOptions others = toFusion(example("surface-x"), ownPost());
  others.probeMacros = "inspection-plus";
  const std::string ours = fragmentOf(others);
  for (const double travel : {5.08, -12.34, 99.99, 7.1, 250.07, -999.91, 3.19}) {
    CAPTURE(travel);
    fusion::RunInput typed;
    typed.toolDiameter = 6.36; // the check asks for more than the radius: 3.18
    typed.cycle = {{"clearance", 5.08}};
    typed.points = {{-15.24, 1000.01, 60.96}};
    typed.properties = {{"surfaceX_X", travel},
                        {"surfaceX_I", travel - 15.24},
                        {"surfaceX_Z", -5.33},
                        {"surfaceX_G", 56},
                        {"surfaceX_R", 43.18}};
    fusion::RunInput kept = typed;
    kept.toolDiameter = inJob(typed.toolDiameter);
    for (double& place : kept.points.front())
      place = inJob(place);
    for (auto* values : {&kept.cycle, &kept.properties})
      for (auto& [name, value] : *values)
        value = inJob(value);
    for (const std::string& one : {fragment, ours}) {
      const fusion::RunResult wanted = runFragment(one, "surfaceX", typed);
      const fusion::RunResult run = runFragment(one, "surfaceX", kept);
      REQUIRE(wanted.ok());
      CHECK(run.errors.empty());
      CHECK(run.warnings == wanted.warnings);
      CHECK(run.warnings.empty());
      CHECK(run.text == wanted.text);
    }
  }
  // On the bound of a check neither side is above the other.
  fusion::RunInput bound;
  bound.toolDiameter = inJob(6.38);
  bound.cycle["clearance"] = 5;
  bound.properties = {{"surfaceX_X", inJob(3.19)}, {"surfaceX_I", 0}};
  CHECK(runFragment(fragment, "surfaceX", bound).errors.size() == 1);
}

TEST_CASE("a whole post runs from beginning to end") {
  driver::ConvertOptions convert = toFusion(example("surface-x"), ownPost());
  convert.inputs.push_back(example("bore"));
  convert.wholePost = true;
  const std::string post = fragmentOf(convert);
  fusion::RunInput input;
  input.cycle["clearance"] = 5;
  input.points = {{1, 2, 3}};
  const fusion::RunResult run = runPost(post, "bore", input);
  CHECK_MESSAGE(run.ok(), reportOf(run));
  const auto lines = withoutNumbers(run.text);
  CHECK(lines.front() == "%");
  CHECK(lines.back() == "%");
  CHECK(std::count(lines.begin(), lines.end(), "G65 P9023 D40. S55. I0 J0") == 1);
  CHECK(runPost(post, "surfaceX", input).text.find("P9023 S55. X12. I0") != std::string::npos);
  CHECK(runPost(post, "nothing", input).errors.size() == 1);
  // Nothing moves between two points, so a measurement at the second would start at the first.
  input.points.push_back({4, 5, 6});
  const fusion::RunResult further = runPost(post, "bore", input);
  REQUIRE(further.errors.size() == 1);
  CHECK(further.errors.front().find("further point of the operation") != std::string::npos);
  const auto printed = withoutNumbers(further.text);
  CHECK(std::count(printed.begin(), printed.end(), "G65 P9023 D40. S55. I0 J0") == 1);
}

TEST_CASE("fragments share their functions: --helpers gives them once, whatever the cycles") {
  std::string helpers, post;
  for (const auto& [folder, prefix] : {std::pair("surface-x", "surfaceX"), std::pair("bore", "bore")}) {
    CAPTURE(folder);
    driver::ConvertOptions convert = toFusion(example(folder), ownPost());
    const std::string alone = fragmentOf(convert);
    convert.helpersApart = true;
    const driver::Outcome outcome = driver::convert(convert);
    REQUIRE(outcome.status == 0);
    REQUIRE_FALSE(outcome.helpers.empty());
    CHECK((helpers.empty() || helpers == outcome.helpers));
    helpers = outcome.helpers;
    const std::string functions = std::string("function ") + prefix + "_";
    CHECK(outcome.output.find(functions + "write(") != std::string::npos);
    CHECK(outcome.output.find(functions + "dispatch(") != std::string::npos);
    CHECK(outcome.output.find(functions + "picture(") == std::string::npos);
    CHECK(outcome.output.find(functions + "given(") == std::string::npos);
    CHECK(outcome.output.find("dotekShared_picture(") != std::string::npos);
    CHECK(outcome.output.find("pasted once before this part") != std::string::npos);
    post += outcome.output;
    fusion::RunInput input;
    input.cycle["clearance"] = 5.1;
    input.points = {{1.25, -2, 3}};
    const fusion::RunResult wanted = runFragment(alone, prefix, input);
    REQUIRE(wanted.ok());
    CHECK(runFragment(helpers + post, prefix, input).text == wanted.text);
    // `convert --verify` runs the fragment as it is written, with the functions before it.
    convert.verify = true;
    convert.common.scriptProgram = runningProgram();
    const driver::Outcome verified = driver::convert(convert);
    CHECK_MESSAGE(verified.status == 0, messagesOf(verified));
  }
}

TEST_CASE("jumps of the checks that are no ifs are steps") {
  const std::string side = (root() / "tests" / "golden" / "convert" / "goto-chain").generic_string();
  const std::string fragment = fragmentOf(toFusion(side + "/side", side + "/prog.txt"));
  CHECK(fragment.find("switch (step)") != std::string::npos);
  const auto outcome = [&](double offset, double reach) {
    fusion::RunInput input;
    input.cycle["clearance"] = 5;
    input.properties = {{"side_Ofs", offset}, {"side_Reach", reach}, {"side_Top", 40}, {"side_Depth", -5}};
    const fusion::RunResult run = runFragment(fragment, "side", input);
    CHECK(!run.fault);
    return run.errors.empty() ? std::string("printed") : run.errors.front();
  };
  CHECK(outcome(54, 10) == "printed");
  CHECK(outcome(54, -10) == "printed");
  CHECK(outcome(53, 10) == "OFFSET 54 TO 59 ONLY");
  CHECK(outcome(54, -1) == "WAY TOO SHORT FOR THE BALL");
  CHECK(outcome(54, 1) == "WAY TOO SHORT FOR THE BALL");
}

TEST_CASE("node prints the same text") {
  if (std::system("node --version >/dev/null 2>&1") != 0) {
    MESSAGE("skipped: there is no node here");
    return;
  }
  const fs::path script = fs::temp_directory_path() / "dotek-fusion-node.js";
  const fs::path output = fs::temp_directory_path() / "dotek-fusion-node.txt";
  const std::pair<const char*, const char*> cycles[] = {
      {"surface-x", "surfaceX"}, {"surface-y", "surfaceY"}, {"surface-z", "surfaceZ"}, {"bore", "bore"}};
  for (const auto& [folder, prefix] : cycles) {
    const std::string fragment = fragmentOf(toFusion(example(folder), ownPost()));
    fusion::RunInput input;
    input.points = {{100, 50, 0}};
    input.cycle["clearance"] = 5.25;
    std::ofstream(script, std::ios::binary) << fusion::scriptFor(fragment, prefix, input);
    const std::string command = "node -e 'require(\"vm\").runInThisContext(require(\"fs\").readFileSync(\"" +
                                script.string() + "\", \"utf8\"))' >" + output.string();
    REQUIRE(std::system(command.c_str()) == 0);
    const fusion::RunResult run = runFragment(fragment, prefix, input);
    CHECK(run.ok());
    CHECK(!run.text.empty());
    CHECK(readAll(output) == run.text + "\n");
  }
  fs::remove(script);
  fs::remove(output);
}
