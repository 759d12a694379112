#include "stdlib/MacroSet.h"

#include "DataFolder.h"
#include "stdlib/DataFiles.h"
#include "stdlib/ReadCall.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::stdlib;

namespace {

MacroSet macros(std::string_view name) {
  std::optional<MacroSet> out = MacroSet::load(DataFiles(), name);
  REQUIRE(out);
  return std::move(*out);
}

// Loads macros/own.toml: what is wrong with it, without the path. "" where it loads.
std::string setError(const std::string& text) {
  const tests::DataFolder folder;
  const std::string path = folder.write("macros/own.toml", text);
  DataFiles files;
  Diagnostics diagnostics;
  REQUIRE(files.addFolder(folder.path(), Limits{}, diagnostics));
  try {
    const std::optional<MacroSet> set = MacroSet::load(files, "own");
    CHECK(set->origin == path);
  } catch (const DataError& error) {
    const std::string what = error.what();
    REQUIRE(what.starts_with(path + ":"));
    return what.substr(path.size() + 1);
  }
  return "";
}

const std::string kHead = "schema = 1\n"
                          "title = 'Own'\n"
                          "[[scratch]]\n" // line 3
                          "first = 100\nlast = 149\ngrade = 'inferred'\nsource = 'x'\n";

// A signature from line 8 on; `keys` begins on line 14.
std::string signature(const std::string& intent, const std::string& keys) {
  return kHead + "[[signature]]\nprogram = 1\ntitle = 'one'\nintent = '" + intent +
         "'\ngrade = 'inferred'\nsource = 'x'\n" + keys;
}

std::string surface(const std::string& arguments) {
  return signature("surface", "arguments = [\n" + arguments + "]\n"); // first argument: line 15
}

const std::string kX = "{letter='X',role='target',axis='X',frame='work',required=true},\n";
const std::string kError = "{letter='S',role='system',code='index',rule='error',point=false},\n";
const std::string kNominal =
    "{letter='S',role='system',code='g-number',rule='nominal',point=true,required=true},\n";

} // namespace

TEST_CASE("every built-in macro set loads, and every signature has a grade and a source") {
  const DataFiles files;
  CHECK(files.list("macros").size() >= 2);
  for (const DataFile* file : files.list("macros")) {
    CAPTURE(file->name);
    const MacroSet set = macros(file->name);
    CHECK(set.name == file->name);
    CHECK(set.origin == "built in");
    CHECK_FALSE(set.title.empty());
    CHECK_FALSE(set.scratch.empty());
    for (const MacroSignature& signature : set.signatures) {
      CAPTURE(signature.title);
      CHECK(signature.program != 0);
      CHECK_FALSE(signature.grade.empty());
      CHECK_FALSE(signature.source.empty());
      for (const MacroArgument& argument : signature.arguments) {
        CHECK(std::string("GLNOP").find(argument.letter) == std::string::npos);
        const bool named =
            argument.role == ArgumentRole::System && argument.systemCode == SystemCode::GNumber;
        CHECK(argument.point == (named || !argument.selector));
      }
    }
  }
  CHECK_FALSE(MacroSet::load(files, "easy"));
}

TEST_CASE("EasyProbe: facts of the reference") {
  const MacroSet set = macros("easyprobe");
  REQUIRE(set.find(Intent::ProtectedMove) != nullptr);
  const MacroSignature& move = *set.find(Intent::ProtectedMove);
  CHECK(move.program == 9770);
  CHECK(move.anyOf == "XYZ");
  CHECK(move.find('Z')->frame == ir::Frame::Work);
  CHECK(move.find('F')->kind == ir::Kind::Feed);
  CHECK(move.results.empty());
  for (const ir::Axis axis : ir::kAxes) {
    const char letter = ir::letterOf(axis);
    CAPTURE(letter);
    REQUIRE(set.find(Intent::Surface, axis) != nullptr);
    const MacroSignature& surface = *set.find(Intent::Surface, axis);
    CHECK(surface.program == 9023);
    CHECK(surface.arguments.size() == 3);
    const MacroArgument& travel = *surface.find(ArgumentRole::Target, axis);
    CHECK(travel.letter == letter);
    CHECK(travel.frame == ir::Frame::Here);
    CHECK(travel.required);
    const MacroArgument& nominal = *surface.find(ArgumentRole::Nominal, axis);
    CHECK(nominal.letter == "IJK"[ir::indexOf(axis)]);
    CHECK(nominal.required);
    const MacroArgument& system = *surface.find(ArgumentRole::System, axis);
    CHECK(system.letter == 'S');
    CHECK(system.systemCode == SystemCode::GNumber);
    CHECK(system.systemRule == SystemRule::Nominal);
    CHECK(system.point);
    CHECK(system.selector);
    CHECK(system.kind == ir::Kind::WorkOffset);
    REQUIRE(surface.results.size() == 1);
    CHECK(surface.results[0].name == ir::ResultName::Main);
    CHECK(surface.results[0].variable == 138);
    CHECK_FALSE(surface.results[0].documented);
  }
  const MacroSignature& bore = *set.find(Intent::Bore);
  CHECK(bore.program == 9023);
  CHECK(bore.find('D')->role == ArgumentRole::Diameter);
  CHECK(bore.find('D')->kind == ir::Kind::Length);
  CHECK(bore.find(ArgumentRole::Nominal, ir::Axis::Y)->letter == 'J');
  CHECK(bore.find(ArgumentRole::Nominal, ir::Axis::Z) == nullptr);
  CHECK(set.find(Intent::ProbeOn) == nullptr);
  CHECK(set.calls(9023));
  CHECK_FALSE(set.calls(9811));
  CHECK(set.of(9023).size() == 4);
}

TEST_CASE("Inspection Plus: facts of the reference") {
  const MacroSet set = macros("inspection-plus");
  CHECK(set.find(Intent::ProtectedMove)->program == 9810);
  CHECK(set.find(Intent::ProbeOn)->program == 9832);
  CHECK(set.find(Intent::ProbeOff)->program == 9833);
  for (const ir::Axis axis : ir::kAxes) {
    const MacroSignature& surface = *set.find(Intent::Surface, axis);
    CHECK(surface.program == 9811);
    CHECK(surface.find(ArgumentRole::Target, axis)->frame == ir::Frame::Work);
    const MacroArgument& system = *surface.find('S');
    CHECK_FALSE(system.required);
    CHECK(system.systemCode == SystemCode::Index);
    CHECK(system.systemRule == SystemRule::Error);
    CHECK_FALSE(system.point);
    CHECK(surface.results.at(0).variable == 135 + ir::indexOf(axis));
    CHECK(surface.results.at(0).documented);
    CHECK_FALSE(surface.results.at(1).documented); // a distance or a size: sources differ
  }
  const MacroSignature& bore = *set.find(Intent::Bore);
  CHECK(bore.program == 9814);
  CHECK(bore.find('D')->required);
  CHECK(bore.find('S')->systemRule == SystemRule::Error);
  REQUIRE(bore.find(Output::Size) != nullptr);
  CHECK(bore.find(Output::Size)->name == ir::ResultName::Size);
  CHECK(bore.find(Output::Size)->variable == 138);
  CHECK(bore.find(Output::Size)->documented);
  // #100 to #149, in pieces of different certainty
  CHECK(set.scratch.at(0).first == 100);
  for (std::size_t i = 1; i + 1 < set.scratch.size(); ++i)
    CHECK(set.scratch[i].first == set.scratch[i - 1].second + 1);
  CHECK(set.scratch.at(set.scratch.size() - 2).second == 149);
  CHECK(set.scratch.back() == std::pair<std::uint32_t, std::uint32_t>(500, 517));
  CHECK(set.overwritten.size() == 2);
  CHECK(set.probing.overtravel == 10);
  CHECK(set.probing.radiusX == 500);
  CHECK(set.find(MacroAlarm::PathObstructed)->number == 86);
  CHECK_FALSE(set.find(MacroAlarm::OutOfPosition)->number);
  CHECK(set.find(MacroAlarm::UpperLimit) == nullptr);
}

TEST_CASE("letters of a call and the signature that they fit") {
  struct Row {
    const char* set;
    std::uint32_t program;
    const char* letters;
    const char* title; // "" for none
    char unknown;
    const char* missing;
    bool ambiguous;
  };
  const Row kRows[] = {
      {"easyprobe", 9770, "ZF", "protected move", 0, "", false},
      {"easyprobe", 9770, "XY", "protected move", 0, "", false},
      {"easyprobe", 9770, "F", "", 0, "X or Y or Z", false},
      {"easyprobe", 9770, "", "", 0, "X or Y or Z", false},
      {"easyprobe", 9770, "XM", "", 'M', "", false},
      {"easyprobe", 9023, "SXI", "single surface along X", 0, "", false},
      {"easyprobe", 9023, "YJS", "single surface along Y", 0, "", false},
      {"easyprobe", 9023, "SZK", "single surface along Z", 0, "", false},
      {"easyprobe", 9023, "DSIJ", "bore", 0, "", false},
      {"easyprobe", 9023, "SX", "", 0, "I", false},
      {"easyprobe", 9023, "XI", "", 0, "S", false},
      {"easyprobe", 9023, "X", "", 0, "S and I", false},
      {"easyprobe", 9023, "DSI", "", 0, "J", false},
      {"easyprobe", 9023, "SI", "", 0, "X", false},
      {"easyprobe", 9023, "S", "", 0, "X and I or Y and J or Z and K", false},
      {"easyprobe", 9023, "SXJ", "", 0, "", true},   // the nominal of another axis
      {"easyprobe", 9023, "SXYIJ", "", 0, "", true}, // two surfaces in one call
      {"easyprobe", 9023, "DSXIJ", "", 0, "", true}, // a bore with a travel
      {"easyprobe", 9023, "ASXI", "", 'A', "", false},
      {"easyprobe", 9811, "X", "", 0, "", false}, // no program of the set
      {"inspection-plus", 9811, "X", "single surface along X", 0, "", false},
      {"inspection-plus", 9811, "YS", "single surface along Y", 0, "", false},
      {"inspection-plus", 9811, "S", "", 0, "X or Y or Z", false},
      {"inspection-plus", 9811, "", "", 0, "X or Y or Z", false},
      {"inspection-plus", 9811, "XY", "", 0, "", false}, // refused
      {"inspection-plus", 9811, "YQ", "single surface along Y", 0, "", false},
      {"inspection-plus", 9811, "YB", "", 'B', "", false},
      {"inspection-plus", 9814, "D", "bore", 0, "", false},
      {"inspection-plus", 9814, "DS", "bore", 0, "", false},
      {"inspection-plus", 9814, "S", "", 0, "D", false},
      {"inspection-plus", 9814, "DZ", "boss, or bore with an island", 0, "", false},
      {"inspection-plus", 9814, "DR", "", 0, "Z", false}, // R beside the hole: at which height?
      {"inspection-plus", 9814, "DST", "", 0, "", false}, // refused
      {"inspection-plus", 9812, "X", "pocket along X", 0, "", false},
      {"inspection-plus", 9812, "YZRQ", "web along Y, or pocket with an island", 0, "", false},
      {"inspection-plus", 9820, "ZIJS", "stock allowance on a Z face", 0, "", false},
      {"inspection-plus", 9820, "ZIK", "", 0, "", true},
      {"inspection-plus", 9823, "ABCD", "bore by three points", 0, "", false},
      {"inspection-plus", 9823, "ABD", "", 0, "C", false},
      {"inspection-plus", 9834, "", "feature to feature: remember", 0, "", false},
      {"inspection-plus", 9834, "XYHM", "feature to feature: distances in X and Y", 0, "", false},
      {"inspection-plus", 9843, "XD", "angle of an X face", 0, "", false},
      {"inspection-plus", 9817, "DE", "", 0, "", false}, // packs disagree: no program of the set
      {"inspection-plus", 9832, "", "probe on", 0, "", false},
      {"inspection-plus", 9832, "W", "probe on", 0, "", false},
      {"inspection-plus", 9833, "", "probe off", 0, "", false},
      {"inspection-plus", 9833, "W", "", 'W', "", false},
  };
  const MacroSet sets[] = {macros("easyprobe"), macros("inspection-plus")};
  for (const Row& row : kRows) {
    CAPTURE(row.program);
    CAPTURE(row.letters);
    const MacroSet& set = sets[row.set == sets[0].name ? 0 : 1];
    const CallReading got = readCall(set, row.program, row.letters);
    CHECK((got.signature == nullptr ? "" : got.signature->title) == row.title);
    CHECK((got.refusal == CallRefusal::UnknownLetter ? got.letter() : 0) == row.unknown);
    CHECK(refusalText(got).empty() == (got.signature != nullptr));
    CHECK(got.missing == row.missing);
    CHECK((got.refusal == CallRefusal::Ambiguous) == row.ambiguous);
  }
}

TEST_CASE("two signatures that fit are ambiguous, and the letters that lack are together") {
  MacroSet set; // no file can hold this: the loader refuses it
  MacroSignature one;
  one.program = 1;
  const auto argument = [](char letter, bool required) {
    MacroArgument out;
    out.letter = letter;
    out.required = required;
    return out;
  };
  one.arguments.push_back(argument('X', true));
  set.signatures = {one, one};
  CHECK(readCall(set, 1, "X").refusal == CallRefusal::Ambiguous);
  CHECK(readCall(set, 1, "X").signature == nullptr);
  set.signatures.pop_back();
  set.signatures[0].arguments.push_back(argument('Y', false));
  set.signatures[0].arguments.push_back(argument('Z', false));
  set.signatures[0].anyOf = "YZ";
  CHECK(readCall(set, 1, "").missing == "X and (Y or Z)");
}

TEST_CASE("a macro set of one's own") {
  CHECK(setError(signature("probe-on", "")) == "");
  CHECK(setError(surface(kX)) == "");
  CHECK(setError(surface(kX + kError)) == "");
  CHECK(setError(surface(kNominal + "{letter='X',role='target',axis='X',frame='here',required=true},\n"
                                    "{letter='I',role='nominal',axis='X',required=true},\n")) == "");
  CHECK(setError(signature("bore", "arguments = [{letter='D',role='diameter',required=true}]\n")) == "");
}

TEST_CASE("defects of a macro set, with line and column") {
  CHECK(setError("title = 'x'\n") == "1:1: `schema = 1` is missing; it is expected as the first key");
  CHECK(setError("schema = 1\n") == "1:1: `title` is missing; what lists print is expected");
  CHECK(setError(signature("probe-on", "titel = 'x'\n")) ==
        "14:1: unknown key `titel`; the nearest known one "
        "is `title`");
  CHECK(setError(signature("proben", "")).starts_with("11:10: `intent` is \"proben\"; one of"));
  CHECK(setError(kHead + "[[scratch]]\nfirst = 149\nlast = 160\ngrade = 'inferred'\nsource = 'x'\n") ==
        "8:1: #149 to #160 overlaps #100 to #149");
  CHECK(setError(kHead + "[[scratch]]\nfirst = 5\nlast = 4\ngrade = 'inferred'\nsource = 'x'\n") ==
        "8:1: #5 to #4 is no range");
  for (const char letter : {'G', 'L', 'N', 'O', 'P'}) {
    const std::string name(1, letter);
    CHECK(setError(surface("{letter='" + name + "',role='feed'},\n")) ==
          "15:9: `" + name + "` is never an argument of G65");
  }
  CHECK(setError(surface("{letter='XX',role='feed'},\n")) == "15:9: `XX` is no letter from A to Z");
  CHECK(setError(surface("{letter='x',role='feed'},\n")) == "15:9: `x` is no letter from A to Z");
  CHECK(setError(surface(kX + "{letter='X',role='feed'},\n")) == "16:9: `X` is given twice");
  CHECK(
      setError(surface(kNominal + kX + "{letter='J',role='feed'},\n{letter='I',role='nominal',axis='X'},\n"))
          .starts_with("18:9: `I` follows `J`: controls read I, J, K in that order"));
  CHECK(setError(surface("{letter='X',role='target',axis='X'},\n")) ==
        "15:1: `frame` is missing; work or here is expected");
  CHECK(setError(surface("{letter='X',role='target',frame='work'},\n")) ==
        "15:1: `axis` is missing; X, Y or Z is expected");
  CHECK(setError(surface(kX + "{letter='S',role='system',code='index',rule='error'},\n"))
            .starts_with("16:1: `point` is missing"));
  CHECK(setError(surface(kX + "{letter='D',role='feed'},\n{letter='F',role='feed'},\n")) ==
        "17:18: `F` means what `D` means already");
  CHECK(setError(surface(kX + "{letter='F',role='feed',frame='work'},\n")).starts_with("16:25: unknown key"));
  // what an intent needs
  CHECK(setError(surface("")) ==
        "8:1: a surface has one target, which is required; other axes are signatures "
        "of their own");
  CHECK(setError(surface("{letter='X',role='target',axis='X',frame='work'},\n"))
            .starts_with("8:1: a surface has one target, which is required"));
  CHECK(setError(surface(kX + "{letter='D',role='diameter'},\n")) == "8:1: a surface has no diameter");
  CHECK(setError(surface(kX + "{letter='I',role='nominal',axis='X'},\n"))
            .starts_with("8:1: a nominal coordinate counts in the system that the call sets"));
  CHECK(setError(surface(kX + kError + "{letter='I',role='nominal',axis='X'},\n"))
            .starts_with("8:1: a nominal coordinate counts in the system that the call sets"));
  CHECK(setError(surface(kX + kNominal)) ==
        "8:1: the system gets a nominal coordinate of X, and none is given");
  CHECK(setError(surface(kX + kNominal + "{letter='J',role='nominal',axis='Y',required=true},\n")) ==
        "8:1: the system gets a nominal coordinate of X, and Y is given");
  CHECK(setError(surface(kX + kNominal + "{letter='I',role='nominal',axis='X'},\n")) ==
        "8:1: `I` is not required and `S` is, which needs it");
  CHECK(setError(signature("bore", "")) == "8:1: a bore has a diameter, which is required");
  CHECK(setError(signature("bore", "arguments = [{letter='D',role='diameter',required=true}," + kX + "]\n"))
            .starts_with("8:1: a bore is measured from where the probe is"));
  CHECK(setError(signature("probe-off", "arguments = [" + kX + "]\n"))
            .starts_with("8:1: a call that switches the probe"));
  CHECK(setError(signature("protected-move", "")) == "8:1: a protected move has no target");
  CHECK(setError(signature("protected-move",
                           "arguments = [{letter='X',role='target',axis='X',frame='work'}]\n")) ==
        "8:1: a call without any target would fit; name the letters in `any_of`");
  CHECK(setError(signature("protected-move", "arguments = [" + kX + kError + "]\n")) ==
        "8:1: a protected move measures nothing and sets nothing");
  // any_of
  const std::string optional = "arguments = [{letter='X',role='target',axis='X',frame='work'}]\n";
  CHECK(setError(signature("protected-move", optional + "any_of = 'X'\n")) == "");
  CHECK(setError(signature("protected-move", optional + "any_of = ''\n")).starts_with("15:10: `any_of` is"));
  CHECK(setError(signature("protected-move", optional + "any_of = 'XY'\n")) ==
        "15:10: `Y` in `any_of` is no argument of the call");
  CHECK(setError(signature("protected-move", optional + "any_of = 'XX'\n")) ==
        "15:10: `X` appears twice in `any_of`");
  CHECK(setError(signature("protected-move", "arguments = [" + kX + "]\nany_of = 'X'\n")) ==
        "16:10: `X` in `any_of` is required: the rule says nothing");
  // results
  const auto results = [](const std::string& list) {
    return setError(surface(kX) + "results = [\n" + list + "]\n"); // first result: line 18
  };
  CHECK(results("{name='position-x',variable=135},\n") == "");
  CHECK(results("{name='main',variable=138},\n").starts_with("18:7: `main` is a result that no document"));
  CHECK(results("{name='main',variable=138,documented=false},\n") == "");
  CHECK(results("{name='position-x',variable=135},\n{name='position-x',variable=136},\n") ==
        "19:7: `position-x` is given twice");
  CHECK(results("{name='position-x',variable=135},\n{name='size',variable=135},\n") ==
        "19:23: #135 holds another result already");
  CHECK(results("{name='size',variable=500},\n") ==
        "18:23: #500 is in no `[[scratch]]`, and the call writes it");
  // two readings of one call
  const std::string again = "[[signature]]\nprogram = 1\ntitle = 'two'\nintent = 'surface'\ngrade = "
                            "'inferred'\nsource = 'x'\narguments = [\n";
  CHECK(setError(surface(kX) + again + kX + "]\n") == "18:11: a call of P1 with X means `one` and `two`");
  CHECK(setError(surface(kX + kError) + again + kX + "]\n") ==
        "19:11: a call of P1 with X means `one` and `two`");
  CHECK(setError(surface(kX + kError) + again +
                 "{letter='Y',role='target',axis='Y',frame='work',required=true},\n" + kError + "]\n") == "");
  CHECK(setError(signature("probe-on", "") + "[[signature]]\nprogram = 1\ntitle = 'two'\nintent = "
                                             "'probe-off'\ngrade = 'inferred'\nsource = 'x'\n") ==
        "15:11: a call of P1 with no letters means `one` and `two`");
}

TEST_CASE("letters that exclude each other: the rule that a call breaks") {
  const MacroSet set = macros("inspection-plus");
  const auto refused = [&](std::uint32_t program, std::string_view letters) {
    const RefusedLetters* rule = readCall(set, program, letters).excluded;
    return rule == nullptr ? std::string() : rule->letters + ":" + rule->text;
  };
  CHECK(refused(9811, "XST") == "ST:");
  CHECK(refused(9814, "DHS") == "SH:");
  CHECK(refused(9812, "XTM") == "TM:TM INPUT MIXED");
  CHECK(refused(9811, "XY") == "XY:XY INPUT MIXED");
  CHECK(refused(9810, "XY") == "");
  CHECK(refused(9814, "DS") == "");
}

TEST_CASE("letters and the locals that they set") {
  CHECK(localOf('A') == 1);
  CHECK(localOf('D') == 7);
  CHECK(localOf('K') == 6);
  CHECK(localOf('Z') == 26);
  for (const char letter : {'G', 'L', 'N', 'O', 'P', 'a'})
    CHECK(localOf(letter) == 0);
  for (char letter = 'A'; letter <= 'Z'; ++letter)
    if (localOf(letter) != 0) CHECK(letterOfLocal(localOf(letter)) == letter);
  for (const std::uint32_t local : {0U, 10U, 27U, 33U})
    CHECK(letterOfLocal(local) == 0);
}

TEST_CASE("shared arguments and results, alarms, facts of probing: defects with line and column") {
  const std::string group = "[[arguments]]\nname = 'more'\ngrade = 'inferred'\nsource = 'x'\n" // line 8
                            "list = [{letter='Q',role='overtravel'}]\n";
  const std::string use =
      "[[signature]]\nprogram = 1\ntitle = 'one'\nintent = 'surface'\ngrade = 'inferred'\n"
      "source = 'x'\narguments = [" + // line 13
      kX.substr(0, kX.size() - 2) +
      "]\n";
  CHECK(setError(kHead + group + use + "groups = ['more']\n") == "");
  CHECK(setError(kHead + group + use + "groups = ['less']\n") == "20:11: there is no group `less`");
  CHECK(setError(kHead + group + use) == "8:1: no signature names `more`");
  CHECK(setError(kHead + group + group + use + "groups = ['more']\n") == "14:8: `more` is given twice");
  const std::string any =
      "[[signature]]\nprogram = 1\ntitle = 'one'\nintent = 'probe-on'\ngrade = 'inferred'\n"
      "source = 'x'\n";
  const auto alarm = [&](const std::string& list) {
    return setError(kHead + "[[alarms]]\ngrade = 'inferred'\nsource = 'x'\nlist = [" + list + "]\n" + any);
  };
  CHECK(alarm("'probe-fail 93: PROBE FAIL', 'probe-open: PROBE OPEN'") == "");
  CHECK(alarm("'fail 93: PROBE FAIL'").find("is no alarm") != std::string::npos);
  CHECK(alarm("'probe-fail 93'").find("is no alarm") != std::string::npos);
  CHECK(alarm("'probe-fail 9x: A'").find("goes from 0 to 999") != std::string::npos);
  CHECK(alarm("'probe-fail 93: A', 'probe-fail 94: B'").find("is given twice") != std::string::npos);
  const std::string certain = "grade = 'inferred'\nsource = 'x'\n";
  CHECK(setError(kHead + "[probing]\novertravel = 0\n" + certain + any).find("above 0") != std::string::npos);
  CHECK(
      setError(kHead + "[stylus]\nradius_x = 500\nlength_to = 'tip'\n" + certain + any).find("go together") !=
      std::string::npos);
  CHECK(setError(kHead + "[caller]\nneeds = '#520'\n" + certain + any) == "");
  CHECK(setError(kHead + "[caller]\n" + certain + any).find("nothing is needed") != std::string::npos);
  const std::string values = "[caller]\nvalues = [{variable=521,value=0.5}]\n";
  CHECK(setError(kHead + values + certain + any).find("that `needs` reports") != std::string::npos);
  CHECK(setError(kHead + values + "needs = '#521'\n" + certain + any) == "");
  CHECK(setError(kHead + any + "[[refused]]\nprograms = [1]\nletters = 'ST'\n" + certain)
            .find("P1 has no argument `S`") != std::string::npos);
  // what intents need
  const auto round = [&](const std::string& intent, const std::string& arguments) {
    return setError(signature(intent, "arguments = [" + arguments + "]\n"));
  };
  const std::string d = "{letter='D',role='diameter',required=true}";
  CHECK(round("boss", d) == "8:1: a boss has an argument `depth`, which is required");
  CHECK(round("boss", d + ",{letter='Z',role='depth',required=true}") == "");
  CHECK(round("pocket", d).starts_with("8:1: a pocket has one width, which is required"));
  CHECK(round("inner-corner", kX).starts_with("8:1: a corner has targets in X and Y"));
  CHECK(round("angle", kX) == "8:1: an angle has an argument `spacing`, which is required");
  CHECK(round("angled-surface", d).starts_with("8:1: an angled surface has an argument `direction`"));
  CHECK(round("three-point-bore", d)
            .starts_with("8:1: what three points measure has an argument `first-angle`"));
}

TEST_CASE("a call is read once: arguments by role, or one refusal in words") {
  const MacroSet set = macros("easyprobe");
  const CallReading call = readCall(set, 9023, "SXI");
  REQUIRE(call.signature != nullptr);
  CHECK(call.signature == set.find(Intent::Surface, ir::Axis::X));
  REQUIRE(call.arguments.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(call.arguments[i].at == i);
    CHECK(call.arguments[i].meaning->letter == "SXI"[i]);
  }
  CHECK(call.find(ArgumentRole::System)->at == 0);
  CHECK(call.find(ArgumentRole::Target, ir::Axis::X)->at == 1);
  CHECK(call.find(ArgumentRole::Target, ir::Axis::Y) == nullptr);
  CHECK(call.find(ArgumentRole::Diameter) == nullptr);
  CHECK(refusalText(call) == "");

  const auto refused = [](std::string_view name, std::uint32_t program, std::string_view letters) {
    const MacroSet of = macros(name);
    const CallReading reading = readCall(of, program, letters);
    CHECK(reading.arguments.empty());
    CHECK(reading.find(ArgumentRole::Target) == nullptr);
    return refusalText(reading);
  };
  CHECK(refused("easyprobe", 9811, "X") == "`easyprobe` has no macro P9811");
  CHECK(refused("easyprobe", 9023, "SXXI") ==
        "the call of program `9023` of `easyprobe` has `X` more than once");
  CHECK(refused("easyprobe", 9023, "SXIW") ==
        "program `9023` of `easyprobe` has no argument `W` that Dotek knows");
  CHECK(refused("easyprobe", 9023, "XI") == "the call of program `9023` of `easyprobe` lacks S");
  CHECK(refused("easyprobe", 9023, "SXYIJ") ==
        "the call of program `9023` of `easyprobe` with `SXYIJ` has more than one meaning");
  CHECK(refused("inspection-plus", 9811, "XST") ==
        "program `9811` of `inspection-plus` does not take S and T together");
}

TEST_CASE("a set says whether some of its calls do what no source states") {
  CHECK(!macros("easyprobe").hasUnstated());
  CHECK(macros("inspection-plus").hasUnstated()); // the way round an outer corner
}
