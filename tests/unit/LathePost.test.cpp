// The lathe post of `new post`: the figures of the thesis, its listings, and what the post refuses.
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <map>
#include <sstream>
#include <string>
#include <vector>

using namespace dotek;
using namespace dotek::tests;

namespace {

std::string example(const std::string& name) {
  return (root() / "examples" / name).string();
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    out.push_back(line.substr(0, line.find_last_not_of("\r ") + 1));
  return out;
}

// Without its N number.
std::string bare(const std::string& block) {
  if (!block.starts_with('N')) return block;
  const std::size_t end = block.find_first_not_of("0123456789", 1);
  return end != std::string::npos && end > 1 && block[end] == ' ' ? block.substr(end + 1) : block;
}

bool holds(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

bool isOfOneRun(const std::string& block) {
  return holds(block, "vytvoril") || holds(block, "vytvoreno") || holds(block, "nazev projektu") ||
         holds(block, "Minut");
}

struct Lathe {
  TestFolder folder{"dotek-lathe"};
  Lathe() {
    const CommandResult made =
        runDotek({"new", "post", "--from", example("s280-post.toml"), "-o", "s280.cps"}, folder.path());
    CHECK_MESSAGE(made.status == 0, made.err);
  }
  CommandResult run(std::vector<std::string> more = {},
                    const std::string& job = example("s280-job.toml")) const {
    std::vector<std::string> all{"run-post", "s280.cps", job};
    all.insert(all.end(), more.begin(), more.end());
    return runDotek(all, folder.path());
  }
};

// One turning operation.
std::string jobOf(const std::string& steps, const std::string& more = "", const std::string& tool = "") {
  return "schema = 1\n" + more + "[[section]]\ntype = \"TYPE_TURNING\"\nfeed_mode = \"per-revolution\"\n" +
         "tool = { number = 2, type = \"TOOL_TURNING_GENERAL\"" + tool + " }\nstep = [" + steps + "]\n";
}

// A listing, or a figure, by its number in the file.
std::map<int, std::string> numbered(const std::string& text, const std::string& mark) {
  std::map<int, std::string> out;
  int figure = 0;
  for (const std::string& line : linesOf(text)) {
    if (line.starts_with(mark)) {
      const std::size_t at = line.find_first_of("0123456789");
      figure = at != std::string::npos ? std::stoi(line.substr(at)) : 100 * figure; // a part without a number
    } else if (figure != 0) {
      out[figure] += line + "\n";
    }
  }
  return out;
}

} // namespace

TEST_CASE("lathe post: the job of the examples prints the blocks of the figures") {
  std::filesystem::path corpus;
  if (!haveCorpus(corpus)) return;
  std::vector<std::string> printed;
  const Lathe lathe;
  const CommandResult result = lathe.run();
  CHECK_MESSAGE(result.status == 0, result.err);
  for (const std::string& line : linesOf(result.out))
    printed.push_back(bare(line));
  std::erase_if(printed, isOfOneRun);
  for (const auto& [figure, text] : numbered(readAll(corpus / "mikroprog" / "figures.suf"), ";-----")) {
    std::vector<std::string> blocks;
    for (const std::string& line : linesOf(text)) {
      if (line.empty()) continue;
      const bool wrapped = !blocks.empty() && bare(line) == line && !line.starts_with(';');
      if (wrapped)
        blocks.back() += " " + line;
      else
        blocks.push_back(bare(line));
    }
    std::erase_if(blocks, isOfOneRun);
    REQUIRE(!blocks.empty());
    CAPTURE(figure);
    for (const std::string& block : blocks) {
      CAPTURE(block);
      CHECK(std::find(printed.begin(), printed.end(), block) != printed.end());
    }
    CHECK(std::search(printed.begin(), printed.end(), blocks.begin(), blocks.end()) != printed.end());
  }
}

TEST_CASE("lathe post: it lints clean, and what it writes does") {
  const Lathe lathe;
  const CommandResult post = runDotek({"lint", "s280.cps"}, lathe.folder.path());
  CHECK_MESSAGE(post.status == 0, post.out);
  CHECK(post.out.empty());
  const CommandResult checked =
      lathe.run({"--check", "--control", "mikroprog-s280", "--property", "stopCondition=O20"});
  CHECK_MESSAGE(checked.status == 0, checked.err);
}

TEST_CASE("lathe post: spindle, tool change, threads and cycles") {
  const Lathe lathe;
  const std::string out = lathe.run().out;
  // 120 m/min at 40 mm are 955 rev/min.
  CHECK(holds(out, "M4 S955\nN"));
  CHECK(holds(out, " G4 E5\n"));
  CHECK(holds(out, " G96 A2000\n"));
  CHECK(holds(out, " G81 Z-12 F100\n"));
  CHECK(holds(out, " G83 Z-40 W10 F80\n"));
  CHECK(holds(out, " G85 Z-38 F60\n"));
  CHECK(holds(out, " G4 E0.5\n"));
  CHECK(holds(out, " G33 X31 Z-15 K1.5\n"));
  CHECK(holds(out, " G33 X30.4 Z-15 K1.5\n"));
  CHECK(holds(out, " M0 ;Zkontroluj nastroj.\n"));
  CHECK(holds(out, " M29 @scr.sou;Otoc kus\n"));
  CHECK(holds(out, " G4 E1\nN600 G4 E2\n"));
  CHECK(holds(out, " G2 X41.199 Z-25 R5 FP1\n"));
  const std::string cycle = lathe.run({"--property", "threads=cycle"}).out;
  CHECK(holds(cycle, " G0 X31.2 Z5\n"));
  CHECK(holds(cycle, " G78 X29.36 Z-15 U0.4 K1.5\n")); // the feed is in force
}

TEST_CASE("lathe post: the feed and the pitch of a thread cycle") {
  const Lathe lathe;
  const auto thread = [&](const std::string& pitch) {
    lathe.folder.write(
        "t.toml",
        "schema = 1\n[properties]\nthreads = \"cycle\"\nshowNumbers = false\n[[section]]\ntype = "
        "\"TYPE_TURNING\"\nfeed_mode = \"per-revolution\"\ntool = { number = 2, type = "
        "\"TOOL_TURNING_THREADING\", spindleRPM = 300 }\nparameters = { \"operation:threadDepth\" = 1.0 }\n"
        "step = [{ rapid = [18.0, 0.0, 5.0] }, { cycle = \"thread-turning\", points = [[15.0, 0.0, -15.0], "
        "[14.2, 0.0, -15.0]], with = { clearance = 18.0, pitch = " +
            pitch +
            ", incrementalX = 0.0, "
            "incrementalZ = -20.0 } }]\n");
    return lathe.run({}, "t.toml");
  };
  // F100 is per minute: G95 of the operation would make it 100 mm a turn.
  CHECK(holds(thread("2.0").out, "G94\nG78 X28.4 Z-15 U0.2 K2 F100\n"));
  CHECK(holds(thread("3.5").err, "A pitch of 3.5 is above the limit of the control, 3."));
}

TEST_CASE("lathe post: what it refuses and what it warns of") {
  const Lathe lathe;
  const auto said = [&](const std::string& job) {
    lathe.folder.write("j.toml", job);
    return lathe.run({}, "j.toml").err;
  };
  const std::string move = "{ rapid = [20.0, 0.0, 5.0] }";
  CHECK(holds(said(jobOf(move, "unit = \"in\"\n")), "The control has no inches"));
  CHECK(holds(said("schema = 1\n[[section]]\ntool = { number = 2 }\nstep = [" + move + "]\n"),
              "no driven tools"));
  CHECK(holds(said("schema = 1\n[[section]]\ntype = \"TYPE_TURNING\"\ntool = { number = 9, type = "
                   "\"TOOL_TURNING_GENERAL\" }\nstep = [" +
                   move + "]\n"),
              "Tool 9: the turret has places 1 to 8."));
  CHECK(holds(said(jobOf("{ command = \"TOOL_MEASURE\" }")), "Funkci (TOOL_MEASURE) stroj nepodporuje"));
  CHECK(holds(said(jobOf("{ cycle = \"tapping\", points = [[0.0, 0.0, -5.0]], with = { clearance = 20.0, "
                         "retract = 2.0 } }")),
              "no tapping"));
  CHECK(holds(said(jobOf("{ cycle = \"drilling\", points = [[5.0, 0.0, -5.0]], with = { clearance = 20.0, "
                         "retract = 2.0 } }")),
              "on the axis"));
}

TEST_CASE("lathe post: a description that is wrong is refused at its place") {
  const TestFolder folder("dotek-lathe-wrong");
  const auto said = [&](const std::string& text) {
    folder.write("d.toml", text);
    return runDotek({"new", "post", "--from", "d.toml"}, folder.path()).err;
  };
  CHECK(holds(said("schema = 1\n"), "`control` is missing"));
  CHECK(holds(said("schema = 1\ncontrol = \"mikroprog-mill\"\n"), "no lathe with the axes X and Z"));
  CHECK(holds(said("schema = 1\ncontrol = \"fanuc-31i-b\"\n"), "no control `fanuc-31i-b`"));
  CHECK(holds(said("schema = 1\ncontrol = \"mikroprog-s280\"\n[texts]\nclean = \"vy\xC4\x8Disti\"\n"),
              "ASCII"));
  CHECK(holds(said("schema = 1\ncontrol = \"mikroprog-s280\"\n[properties]\nthreads = \"G76\"\n"), "passes"));
  CHECK(holds(said("schema = 1\ncontrol = \"mikroprog-s280\"\n[properties]\nsafeX = 1\n"), "safeX"));
}

// Listings of the thesis that are whole, with what they need around them.
TEST_CASE("lathe post: the whole listings of the thesis run") {
  std::filesystem::path corpus;
  if (!haveCorpus(corpus)) return;
  const std::map<int, std::string> listings =
      numbered(readAll(corpus / "fusion" / "s280-listings.js"), "// -----");
  const std::string formats =
      "var gFormat = createFormat({prefix:\"G\", decimals:1}), mFormat = createFormat({prefix:\"M\", "
      "decimals:1});\n"
      "var plainFormat = createFormat({decimals:3}), toolFormat = plainFormat, secFormat = plainFormat;\n"
      "var milliFormat = createFormat({decimals:0}), zFormat = plainFormat, xFormat = "
      "createFormat({decimals:3, scale:2});\n"
      "var gMotionModal = createModal({force:true}, gFormat), gCycleModal = createModal({}, gFormat), "
      "gRetractModal = "
      "createModal({}, gFormat);\n"
      "var xOutput = createVariable({prefix:\"X\"}, xFormat), yOutput = createVariable({prefix:\"Y\"}, "
      "plainFormat), "
      "zOutput = createVariable({prefix:\"Z\"}, plainFormat);\n"
      "var feedOutput = createVariable({prefix:\"F\"}, plainFormat), pitchOutput = "
      "createVariable({prefix:\"K\", "
      "force:true}, plainFormat);\n"
      "var threadP1Output = createVariable({prefix:\"P\", force:true}, plainFormat), threadP2Output = "
      "threadP1Output;\n"
      "var threadQOutput = createVariable({prefix:\"Q\", force:true}, plainFormat), threadROutput = "
      "createVariable({"
      "prefix:\"R\", force:true}, plainFormat);\n"
      "function writeBlock() { writeWords(arguments); }\nfunction writeComment(text) { writeln(\";\" + "
      "text); }\n"
      "var _x = 10, _y = 0, _z = -15, x = 10, z = -15, threadPitch = 1.5, seconds = 0.5, milliseconds = "
      "500;\n"
      "var TF = false, threadHeight = 1, firstDepthOfCut = 0.2, minimumDepthOfCut = 0.1, materialAllowance = "
      "0;\n"
      "var pcode = 1060, codes = {A: 76}, inverted = 1;\n";
  struct Snippet {
    int figure;
    std::string before, after, printed;
  };
  const std::string threadCycle = "cycle = {pitch: 1.5, incrementalX: 0};\n";
  const Snippet kWhole[] = {
      {29, "",
       "function onOpen() { writeBlock(getProperty(\"M1everysection\"), getProperty(\"writeG98\")); }",
       "true false\n"},
      {31, "function writeToolBlock() { writeBlock(arguments); }\nfunction onSection() {\n", "}",
       "M6 T2\n;rough\n"},
      {35, "properties = {writeG98: true};\nfunction onOpen() {\n", "}", "G98\n"},
      {41, "function onOpen() {\n", "}", "G4 P500\n"},
      {42, "function onOpen() {\n", "}", "G4 E0.5\n"},
      {44, "", "function onOpen() { onPassThrough(\"G4 E1,M8\"); }", "G4 E1\nM8\n"},
      {47, "function onOpen() {\n", "}", "G32 X20 Y0 Z-15 K1.5\n"},
      {48, "function onOpen() {\n", "}", "G33 X20 Z-15 K1.5\n"},
      {49, "properties = {type: \"A\"};\nfunction onSection() {\n" + threadCycle, "}",
       "G76 P1060 Q0.1 R0\nG76 X20 Z-15 P1 Q0.2 K1.5\n"},
      {50, "function onSection() {\n" + threadCycle, "}", "G0 X22\nG78 X20 Z-15 Q0.2 K1.5 F100\n"}};
  const TestFolder folder("dotek-listings");
  folder.write("job.toml", "schema = 1\n[[section]]\ntool = { number = 2, comment = \"rough\" }\n");
  std::map<int, std::string> rest = listings;
  for (const Snippet& one : kWhole) {
    CAPTURE(one.figure);
    REQUIRE(listings.contains(one.figure));
    folder.write("post.cps", "capabilities = CAPABILITY_MILLING;\n" + formats + one.before +
                                 listings.at(one.figure) + one.after);
    const CommandResult result = runDotek({"run-post", "post.cps", "job.toml"}, folder.path());
    CHECK_MESSAGE(result.out == one.printed, result.err);
    rest.erase(one.figure);
  }
  // The others, as docs/fusion-lathe.md lists them: lint names what is misprinted or cut off.
  const std::string page = readAll(root() / "docs" / "fusion-lathe.md");
  std::string named;
  for (const auto& [figure, text] : rest) {
    CAPTURE(figure);
    folder.write("listing.cps",
                 "description = \"listing\";\nfunction onOpen() {}\nfunction onClose() {}\n" + text);
    const CommandResult found = runDotek({"lint", "listing.cps"}, folder.path());
    CHECK(holds(found.out, "[post-unread]"));
    named += (named.empty() ? "" : ", ") + std::to_string(figure);
    CHECK((holds(page, "| " + std::to_string(figure) + " |") || holds(page, std::to_string(figure) + ", ") ||
           holds(page, ", " + std::to_string(figure))));
  }
  CHECK(named == "30, 32, 34, 36, 43, 45, 46");
  std::string misspelt = listings.at(30);
  misspelt.replace(misspelt.rfind(','), 1, ";");
  folder.write("listing.cps",
               "description = \"listing\";\nfunction onOpen() {}\nfunction onClose() {}\n" + misspelt);
  CHECK(holds(runDotek({"lint", "listing.cps"}, folder.path()).out, "onChange"));
}
