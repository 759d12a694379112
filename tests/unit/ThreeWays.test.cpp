// One cycle, three ways to the machine: what the post prints, and the converted program with a vendor's
// macros by their meaning or with our own by their text. They leave the same offsets.
#include "driver/Driver.h"
#include "sim/vendor/VendorMacros.h"
#include "tests/GoldenRunner.h"
#include "tests/MeasuringCycles.h"
#include "tests/policy/Tree.h"
#include "tests/unit/OwnMacros.h"

#include <cctype>
#include <map>
#include <random>
#include <set>

using namespace dotek;
using namespace dotek::tests;
namespace fs = std::filesystem;

namespace {

constexpr double kBall = 3, kLength = 50, kClearance = 15;
constexpr Vector kG54 = {100, -200, -300}; // on the machine
constexpr int kSets = 6;

using Values = std::map<std::string, double>; // by name of the field

struct Case {
  std::string folder;
  std::string prog;
  driver::NamedTexts mapped = {};
  bool recover = false;
  // Values of one operation, where the probe is before (G54), and the part with its error.
  std::function<void(std::mt19937&, Values&, Vector&, ContactWorld&)> make;
  driver::NamedTexts fixed = {}; // by --set; `make` gives the same values
  // The target is the nominal, so macros that add the error to the offset set it themselves: words of that
  // call.
  std::string setByMacro = {};
};

struct Result {
  std::vector<double> offsets; // G54 to G59, X Y Z each
  double kept = 0;             // #550; 0: was not written
  sim::Position end{};         // of the machine
};

// What all paths begin with: six systems that differ, the tool's length, a feed.
std::string setup(const Vector& start) {
  std::string out = fmt::format("O1\nG21G17G40G49G80G90G94G54\nG10L10P1R{}.\n", kLength);
  for (int system = 0; system < 6; ++system)
    for (int axis = 0; axis < 3; ++axis)
      out += fmt::format("#{}={:.3f}\n", 5221 + 20 * system + axis,
                         kG54[axis] + (system == 0 ? 0 : 7. * system + axis));
  out += "#520=3.\n#521=500.\n#522=50.\n#523=0.5\n#117=1000.\n";
  return out + fmt::format("G0X{:.3f}Y{:.3f}\nG43H1Z{:.3f}\nF800.\n", start[0], start[1], start[2]);
}

std::string withoutPercent(const std::string& text) {
  std::string out;
  for (const std::string& line : linesOf(text))
    if (line != "%") out += line + "\n";
  return out;
}

Result runs(const std::string& text, const std::string& control, const std::string& macros,
            ContactWorld& world) {
  const stdlib::Control profile = controlOf(control);
  const stdlib::MacroSet set = *stdlib::MacroSet::load(stdlib::DataFiles(), macros);
  sim::VendorMacros meaning(set, profile, measuringCycles());
  meaning.setStylusRadius(kBall);
  LongTool signal(world, kLength);
  const MacroRun run(text, profile, &signal, &meaning);
  CAPTURE(text);
  CAPTURE(run.machine->end().text);
  CAPTURE(run.text());
  REQUIRE(run.end() == "end");
  CHECK(run.run->earlyReads().empty());
  Result out;
  for (std::uint32_t system = 0; system < 6; ++system)
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      out.offsets.push_back(*run.machine->read(5221 + 20 * system + axis));
  const std::string kept = run.at(550);
  if (!kept.empty() && kept != "null") out.kept = *parseNumber(kept);
  out.end = run.machine->machinePosition();
  return out;
}

void same(const Result& one, const Result& other) {
  for (std::size_t i = 0; i < one.offsets.size(); ++i) {
    CAPTURE(i);
    CAPTURE(one.offsets[i]);
    CAPTURE(other.offsets[i]);
    CHECK(std::abs(one.offsets[i] - other.offsets[i]) < 1e-3);
  }
  CHECK(std::abs(one.kept - other.kept) < 1e-3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    CAPTURE(one.end[axis]);
    CAPTURE(other.end[axis]);
    CHECK(std::abs(one.end[axis] - other.end[axis]) < 1e-3);
  }
}

std::string upper(std::string text) {
  for (char& c : text)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

// "(X #24 NAME ...": the letters by name, as the header says the machinist.
std::map<std::string, char> lettersOf(const std::string& program) {
  std::map<std::string, char> out;
  for (const std::string& line : linesOf(program)) {
    if (line.size() < 6 || line[0] != '(' || line[2] != ' ' || line[3] != '#') continue;
    const std::size_t begin = line.find_first_not_of(' ', line.find(' ', 3));
    out.emplace(line.substr(begin, line.find(' ', begin) - begin), line[1]);
  }
  return out;
}

struct Counts {
  int ran = 0;
  std::map<std::string, int> refused; // by code
};

// What may reject a conversion here; everything else is a defect.
const std::set<std::string> kReasons = {
    "no-probe-code",        // the control has no code for the probe, and the set has no macro
    "start-unknown",        // the target wants a coordinate, and the place of the probe is not known
    "no-skip-position",     // our own macros need it
    "opaque-block-refused", // G43 is copied to the control that the source was written for
};

std::optional<std::string> converted(const Case& one, const std::string& control, const std::string& macros,
                                     Counts& counts) {
  driver::ConvertOptions convert;
  convert.inputs = {one.folder};
  convert.source.prog = one.prog;
  convert.common.recover = one.recover;
  convert.common.field = one.mapped;
  convert.common.set = one.fixed;
  convert.to = "fanuc";
  convert.control = control;
  convert.probeMacros = macros;
  const driver::Outcome outcome = driver::convert(convert);
  if (outcome.status == 0) return withoutPercent(outcome.output);
  CHECK(outcome.status == 1);
  std::set<std::string> codes;
  for (const Diagnostic& diagnostic : outcome.diagnostics.all())
    if (diagnostic.severity == Severity::Error) codes.insert(std::string(diagnostic.code));
  CHECK_FALSE(codes.empty());
  for (const std::string& code : codes) {
    CHECK_MESSAGE(kReasons.contains(code),
                  code << " in " << one.folder << " for " << control << ", " << macros);
    ++counts.refused[code];
  }
  return std::nullopt;
}

// The words of the call, with every argument that the header names.
std::string callOf(const std::string& program, const Values& values) {
  std::string out = "G65P8000";
  for (const auto& [name, letter] : lettersOf(program)) {
    double value = 0;
    if (name == "CLEARANCE") {
      value = kClearance;
    } else if (name == "TOOL_RADIUS") {
      value = kBall;
    } else {
      const auto found = std::find_if(values.begin(), values.end(),
                                      [&](const auto& one) { return upper(one.first) == name; });
      REQUIRE_MESSAGE(found != values.end(), name);
      value = found->second;
    }
    out += fmt::format("{}{:.3f}", letter, value);
  }
  return out;
}

void compare(const Case& one, const std::string& control, Counts& counts) {
  CAPTURE(one.folder);
  CAPTURE(control);
  std::map<std::string, std::string> programs; // by macro set
  for (const char* macros : {"easyprobe", "inspection-plus", "dotek"})
    if (auto program = converted(one, control, macros, counts)) programs.emplace(macros, std::move(*program));
  std::mt19937 random(7);
  for (int set = 0; set < kSets; ++set) {
    CAPTURE(set);
    Values values;
    Vector start{};
    ContactWorld world(kBall);
    one.make(random, values, start, world);
    driver::PostOptions post;
    post.folders = {one.folder};
    post.source.prog = one.prog;
    post.common.recover = one.recover;
    post.common.field = one.mapped;
    post.common.host = {{"clearance", numberText(kClearance)}, {"tool_radius", numberText(kBall)}};
    for (const auto& [name, value] : values)
      post.common.set.emplace_back(name, numberText(value));
    const driver::Outcome posted = driver::post(post);
    REQUIRE_MESSAGE(posted.status == 0, renderText(posted.diagnostics, posted.sources, 10));
    if (control == "fanuc-31i-b" && posted.output.find("M31") != std::string::npos) continue; // not its code
    const Result expected = runs(setup(start) + posted.output + "M30\n", control, "easyprobe", world);
    // Something was measured: an offset differs from what it was.
    const Result before = runs(setup(start) + "M30\n", control, "easyprobe", world);
    CHECK(before.offsets != expected.offsets);
    for (const auto& [macros, program] : programs) {
      CAPTURE(macros);
      const std::string text = setup(start) + callOf(program, values) + "\nM30\n" + program;
      same(expected, runs(text + (macros == "dotek" ? ownMacros() : ""), control, macros, world));
      ++counts.ran;
      if (!one.setByMacro.empty() && std::string_view(macros) != "easyprobe") {
        CHECK(program.find(one.setByMacro) != std::string::npos);
        CHECK(program.find("#[5223+[#19") == std::string::npos); // and not by the program
      }
      if (macros != "dotek") continue;
      // The signatures of our macros say what their text does.
      same(expected, runs(text, control, macros, world));
      CHECK(program.find("#523 WAY BACK") != std::string::npos);
    }
  }
}

void report(const Counts& counts) {
  std::string refused;
  for (const auto& [code, count] : counts.refused)
    refused += fmt::format(" {} {}", count, code);
  MESSAGE("converted programs that left the offsets of the posted one: "
          << counts.ran << "; refused:" << (refused.empty() ? " none" : refused));
}

double between(std::mt19937& random, double low, double high) {
  return std::round(std::uniform_real_distribution<double>(low, high)(random) * 100) / 100;
}
double side(std::mt19937& random) {
  return random() % 2 == 0 ? 1 : -1;
}
double systemOf(std::mt19937& random) {
  return 54 + static_cast<int>(random() % 6);
}
// The coordinate that a feature gets: in the active system near the old one, as later moves count from it.
double nominal(std::mt19937& random, double system, double expected) {
  return system == 54 ? expected + between(random, -1, 1) : between(random, -90, 90);
}

// A face across an axis, expected at `from` + `travel`. Along Z it lies on this side of it: the tip goes no
// farther.
double face(std::mt19937& random, std::size_t axis, double from, double travel, ContactWorld& world) {
  const double direction = travel < 0 ? -1 : 1;
  Vector point{}, normal{};
  point[axis] = kG54[axis] + from + travel + direction * between(random, -2, axis == 2 ? -0.1 : 2);
  normal[axis] = -direction;
  world.halfSpace(point, normal);
  return from + travel;
}

std::string example(const std::string& name) {
  return (root() / "examples" / name).generic_string();
}

// A face along X or Y: travel, nominal, depth.
auto alongAxis(std::size_t axis, Vector start, std::string travel, std::string wanted, std::string depth,
               std::string retract) {
  return [=](std::mt19937& random, Values& values, Vector& at, ContactWorld& world) {
    at = start;
    const double way = side(random) * between(random, 10, 40);
    const double system = systemOf(random);
    values = {
        {travel, way}, {"G", system}, {depth, between(random, -20, -1)}, {retract, between(random, 30, 60)}};
    values[wanted] = nominal(random, system, face(random, axis, start[axis], way, world));
  };
}

} // namespace

TEST_CASE("examples: posted and converted leave the same offsets") {
  Counts counts;
  const std::string mill = example("mill-post.txt"), plain = example("post.txt");
  const auto bore = [](std::mt19937& random, Values& values, Vector& at, ContactWorld& world) {
    at = {50, 40, 50}; // where the post sends it, too
    const double system = systemOf(random), diameter = between(random, 15, 60);
    values = {
        {"G", system}, {"D", diameter}, {"Z", between(random, -20, -1)}, {"R", between(random, 30, 60)}};
    values["I"] = nominal(random, system, 50);
    values["J"] = nominal(random, system, 40);
    world.bore(kG54[0] + 50 + between(random, -1, 1), kG54[1] + 40 + between(random, -1, 1),
               diameter + between(random, -1, 1));
  };
  const auto surfaceZ = [](std::mt19937& random, Values& values, Vector& at, ContactWorld& world) {
    at = {20, 20, 50};
    const double system = systemOf(random), from = between(random, 5, 10), way = between(random, -20, -10);
    values = {{"G", system}, {"D", way}, {"W", from}, {"R", between(random, 30, 60)}};
    values["K"] = nominal(random, system, face(random, 2, from, way, world));
  };
  // The face gets the coordinate at which it is expected.
  const auto expected = [](std::mt19937& random, Values& values, Vector& at, ContactWorld& world) {
    at = {20, 20, 50};
    values = {{"G", systemOf(random)}, {"W", 8}, {"D", -12.5}, {"K", -4.5}, {"R", between(random, 30, 60)}};
    face(random, 2, 8, -12.5, world);
  };
  // Between two walls and a floor.
  const auto corner = [](std::mt19937& random, Values& values, Vector& at, ContactWorld& world) {
    at = {-15, 10, 50};
    const double system = systemOf(random);
    values = {{"G", system},
              {"Z", between(random, 5, 9)},
              {"R", between(random, 30, 60)},
              {"WC", between(random, 9, 12)},
              {"UB", between(random, -17, -12)},
              {"VB", between(random, 8, 12)},
              {"UC", between(random, -17, -12)},
              {"VC", between(random, 8, 12)},
              {"XA", side(random) * between(random, 15, 30)},
              {"YB", side(random) * between(random, 15, 30)},
              {"ZC", between(random, -18, -13)}};
    values["I"] = nominal(random, system, face(random, 0, at[0], values["XA"], world));
    values["J"] = nominal(random, system, face(random, 1, values["VB"], values["YB"], world));
    values["K"] = nominal(random, system, face(random, 2, values["WC"], values["ZC"], world));
  };
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b"}) {
    compare({example("surface-x"), plain, {}, false, alongAxis(0, {0, 0, 50}, "X", "I", "Z", "R")}, control,
            counts);
    compare({example("surface-x"), mill, {}, false, alongAxis(0, {-15, 10, 50}, "X", "I", "Z", "R")}, control,
            counts);
    compare({example("surface-y"), mill, {}, false, alongAxis(1, {10, 15, 50}, "Y", "J", "Z", "R")}, control,
            counts);
    compare({example("surface-z"), mill, {}, false, surfaceZ}, control, counts);
    compare({example("bore"), mill, {}, false, bore}, control, counts);
    compare({example("corner-xyz"), mill, {}, false, corner}, control, counts);
    compare({example("surface-z"),
             mill,
             {},
             false,
             expected,
             {{"W", "8"}, {"D", "-12.5"}, {"K", "-4.5"}},
             "Z-4.5 S["},
            control, counts);
  }
  report(counts);
  CHECK(counts.ran >= 5 * kSets);
}

TEST_CASE("corpus cycles: posted and converted leave the same offsets") {
  fs::path corpusFolder;
  if (!haveCorpus(corpusFolder)) return;
  const std::string prog = (corpusFolder / "compost" / "probe-routines.txt").generic_string();
  const auto folder = [&](const char* name) { return (corpusFolder / "gibbs" / name).generic_string(); };
  const auto axisZ = [](std::mt19937& random, Values& values, Vector& at, ContactWorld& world) {
    at = {4, 5, 50};
    const double system = systemOf(random), from = between(random, 5, 10), way = between(random, -30, -10);
    values = {{"G", system}, {"d", way}, {"C", from}, {"Zb", between(random, 30, 60)}};
    values["K"] = nominal(random, system, face(random, 2, from, way, world));
  };
  const auto bore = [](std::mt19937& random, Values& values, Vector& at, ContactWorld& world) {
    at = {-3, 8, 60};
    const double system = systemOf(random), diameter = between(random, 15, 60);
    values = {
        {"G", system}, {"D", diameter}, {"Z", between(random, -20, -1)}, {"Zb", between(random, 30, 60)}};
    values["X"] = nominal(random, system, at[0]);
    values["Y"] = nominal(random, system, at[1]);
    world.bore(kG54[0] + at[0] + between(random, -1, 1), kG54[1] + at[1] + between(random, -1, 1),
               diameter + between(random, -1, 1));
  };
  // Between two walls and a floor.
  const auto corner = [](std::mt19937& random, Values& values, Vector& at, ContactWorld& world) {
    at = {2, 3, 60};
    const double system = systemOf(random);
    values = {{"G", system},
              {"Zb", between(random, 40, 60)},
              {"KA", between(random, 5, 9)},
              {"KB", between(random, 5, 9)},
              {"KC", between(random, 9, 12)},
              {"IB", between(random, -1, 4)},
              {"JB", between(random, -1, 4)},
              {"IC", between(random, -1, 4)},
              {"JC", between(random, -1, 4)},
              {"a", side(random) * between(random, 15, 30)},
              {"b", side(random) * between(random, 15, 30)},
              {"c", between(random, -18, -13)}};
    values["X"] = nominal(random, system, face(random, 0, at[0], values["a"], world));
    values["Y"] = nominal(random, system, face(random, 1, values["JB"], values["b"], world));
    values["Z"] = nominal(random, system, face(random, 2, values["KC"], values["c"], world));
  };
  const Case cases[] = {
      {folder("MERENI.OSA.X"), prog, {{"X", "a"}}, true, alongAxis(0, {3, 4, 60}, "a", "I", "Z", "Zb")},
      {folder("MERENI.OSA.Y"), prog, {{"Y", "b"}}, true, alongAxis(1, {3, 4, 60}, "b", "J", "Z", "Zb")},
      {folder("MERENI.OSA.Z"), prog, {{"Z", "d"}}, true, axisZ},
      {folder("MERENI.STRED.OTVOR"), prog, {}, true, bore},
      {folder("MERENI.OSA.XYZ"), prog, {}, true, corner},
  };
  Counts counts;
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b"})
    for (const Case& one : cases)
      compare(one, control, counts);
  report(counts);
  // On the first control each cycle ran with each set.
  CHECK(counts.ran >= 5 * 3 * kSets);
}

TEST_CASE("our own macros are refused for a control that cannot tell the skip position") {
  Counts counts;
  const Case one{example("surface-z"), example("mill-post.txt"), {}, false, {}};
  CHECK_FALSE(converted(one, "fanuc-6m", "dotek", counts));
  CHECK(counts.refused.contains("no-skip-position"));
}
