// Faults planted by seed into the frame of every translation of the shops' cycles, by operators: `verify`
// sees them, whatever the program does (docs/verify-faults.md).
#include "driver/Driver.h"
#include "support/Decimal.h"
#include "support/Worker.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"
#include "tests/policy/Tree.h"
#include "tests/unit/FaultJudge.h"
#include "tests/unit/FragmentFaults.h"
#include "tests/unit/FrameFaults.h"
#include "verify/Random.h"

#include <array>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

using namespace dotek;
using namespace dotek::tests;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kCases = 300;   // every tenth as an edge case: each bound is met, as by default
constexpr std::uint64_t kFewCases = 12; // that show that a translation agrees
constexpr std::array<const char*, 3> kSets = {"inspection-plus", "dotek", "easyprobe"};

struct Translation {
  std::string name;
  driver::VerifyOptions options;
  std::string text;
  std::optional<Told> few, many; // of its cases as it is, once they are needed
};

// What is converted and agrees: with each macro set, or with one in turn for each folder.
std::vector<Translation> translations(bool eachSet, const char* to = "fanuc") {
  std::size_t turn = 0;
  std::vector<Translation> out;
  const fs::path shops = root() / "tests" / "shops";
  for (const char* shop :
       {"direct", "easyprobe", "flags", "inspection", "origins", "repeats", "toolchange"}) {
    std::vector<fs::path> folders;
    for (const auto& entry : fs::directory_iterator(shops / shop))
      if (entry.is_directory()) folders.push_back(entry.path());
    std::sort(folders.begin(), folders.end());
    for (const fs::path& folder : folders) {
      if (fewDraws() && out.size() >= 4) return out; // each is verified without a fault first
      const std::size_t first = turn++;
      for (std::size_t n = 0; n < kSets.size(); ++n) {
        const char* const set = kSets[(first + n) % kSets.size()];
        Translation one;
        one.name = folder.filename().string() + ", " + to + ", " + set;
        one.options.inputs = {folder.generic_string()};
        one.options.source.prog = (shops / shop / "post.txt").generic_string();
        one.options.common.data = {(shops / "data").generic_string()};
        one.options.common.limits.simSteps = 20000; // a fault may make a loop endless
        one.options.to = to;
        one.options.common.scriptProgram = runningProgram();
        one.options.probeMacros = set;
        one.options.cases = kFewCases;
        one.options.jobs = 1;
        driver::ConvertOptions convert;
        static_cast<targets::TranslationOptions&>(convert) = one.options;
        const driver::Outcome written = driver::convert(convert);
        if (written.status != 0) continue;
        one.text = written.files.front().text;
        if (driver::verify(one.options).status != 0) continue;
        one.options.cases = kCases;
        out.push_back(std::move(one));
        if (!eachSet) break;
      }
    }
  }
  return out;
}

// Motion and calls of macros, after which blocks may be waiting.
bool moves(const std::string& line) {
  return std::regex_search(line, std::regex("^(N\\d+ ?)?(G65|G66|G31|G0|G1|G28|G53.*[XYZ]|[XYZ])"));
}

// A position while the machine moves, an offset that moves it: not the end of the block before (#5001).
bool hasToWait(const std::string& line) {
  static const std::regex reads("#(50[2-9]\\d|\\[50[2-9]\\d)"),
      writes("^#(\\[?5[23]\\d\\d|\\[?[27]\\d\\d\\d)\\b.*=");
  return std::regex_search(line, reads) || std::regex_search(line, writes);
}

// Control profiles, [read_ahead]: these blocks are done before the next one is read. Our own macros for a
// protected move and for a bore end in a G31.
bool stopsReading(const std::string& line) {
  return line == "G53" || std::regex_search(line, std::regex("^(N\\d+ ?)?G65 ?P88(10|14)\\b")) ||
         std::regex_search(line, std::regex("^(N\\d+ ?)?(G\\d+ )*G31\\b"));
}

// Why nothing waits for the G53 of this line, or nothing has moved since the one before it. "": it counts.
std::string_view whyNoWait(const std::string& program, std::size_t at) {
  const std::vector<std::string> lines = linesOf(program);
  bool moved = true;
  for (std::size_t i = 0; i < at; ++i)
    moved = !stopsReading(lines[i]) && (moved || moves(lines[i]));
  if (!moved) return "nothing has moved since the G53 or the G31 before it";
  for (std::size_t i = at + 1; i < lines.size() && !moves(lines[i]) && lines[i] != "G53"; ++i)
    if (hasToWait(lines[i])) return "";
  return "what follows reads the end of the block before, and writes nothing that moves";
}

// The motion mode is put back by our own macros, too, and nothing else in the program sets it.
bool isMotionModeOfMacros(const Fault& fault, const std::string& program) {
  std::smatch kept;
  if (!std::regex_search(program, kept, std::regex("#(\\d+)=#4001\\b"))) return false;
  const std::string back = "G#" + kept[1].str() + " ";
  const bool unkept = fault.before == kept[0].str() && fault.after.empty(); // G of a null local is no word
  // In its place a mode of the caller's that is in force at the end, or put back beside it, comes once more.
  const bool another = fault.before == kept[0].str() &&
                       std::regex_match(fault.after, std::regex("#" + kept[1].str() + "=#40\\d\\d"));
  if (!unkept && !another && (!fault.before.starts_with(back) || fault.after.starts_with(back))) return false;
  for (const std::string& line : linesOf(program)) {
    if (line.starts_with("(")) continue;
    if (std::regex_search(line, std::regex("(^|[^0-9A-Z#])G0?[0-3](?![0-9])"))) return false;
    if (std::regex_search(line, std::regex("G65 ?P(?!88)"))) return false;
  }
  return true;
}

std::set<std::string> modeWords(const std::string& line) {
  std::set<std::string> out;
  std::istringstream words(line);
  for (std::string word; words >> word;)
    out.insert(word);
  return out;
}

// Codes of one modal group: the later of two counts.
std::string groupOfWord(const std::string& word) {
  for (const auto& [name, codes] : {std::pair("distance", " G90 G91 "), std::pair("feed", " G94 G95 "),
                                    std::pair("plane", " G17 G18 G19 ")})
    if (std::string(codes).find(" " + word + " ") != std::string::npos) return name;
  return word;
}

// What the fault leaves out is set by blocks of the source before anything moves under it, calls or jumps. A
// macro that only switches the probe looks at none of it (docs/vendor-macros.md).
bool isSetAgain(const Fault& fault, const std::string& program) {
  std::set<std::string> lost;
  for (const std::string& word : modeWords(fault.before))
    if (!modeWords(fault.after).contains(word)) lost.insert(groupOfWord(word));
  const std::vector<std::string> lines = linesOf(program);
  for (std::size_t i = fault.line + 1; i < lines.size() && !lost.empty(); ++i) {
    const std::string& line = lines[i];
    if (line.starts_with("(")) continue;
    for (const std::string& word : modeWords(line))
      lost.erase(groupOfWord(word));
    if (lost.empty()) break;
    if (std::regex_search(line, std::regex("^G65 ?P983[23]$"))) continue;
    if (std::regex_search(line, std::regex("[XYZ][-#0-9.\\[]|G65|G31|IF|GOTO|^N"))) return false;
  }
  return lost.empty();
}

// "IF[#19+53. LT 54.]": by how much the local is away from where it turns; nothing: it is no such line.
struct LocalBound {
  std::string local, relation;
  double bound = 0;
};
std::optional<LocalBound> localBound(const std::string& line) {
  static const std::regex form("^IF\\[(#\\d+)(?:([+-][0-9.]+))? (LT|GT|LE|GE) (-?[0-9.]+)\\]");
  std::smatch found;
  if (!std::regex_search(line, found, form)) return std::nullopt;
  const double added = found[2].matched ? parseNumber(found[2].str()).value_or(0) : 0;
  return LocalBound{found[1], found[3], parseNumber(found[4].str()).value_or(0) - added};
}

// An earlier check of the same local at the same place ends in an alarm already: by itself, or by the number
// of an alarm that is raised before this line.
bool isCheckedBefore(const Fault& fault, const std::string& program) {
  const std::optional<LocalBound> own = localBound(fault.before);
  if (!own || fault.before.find("THEN #3000=") == std::string::npos) return false;
  const std::vector<std::string> lines = linesOf(program);
  static const std::regex chooses("THEN (#\\d+)=([0-9.]+)$");
  for (std::size_t i = 0; i < fault.line; ++i) {
    const std::optional<LocalBound> one = localBound(lines[i]);
    if (!one || one->local != own->local || one->relation != own->relation || one->bound != own->bound)
      continue;
    if (lines[i].find("THEN #3000=") != std::string::npos) return true;
    std::smatch chosen;
    if (!std::regex_search(lines[i], chosen, chooses)) continue;
    const std::string raises = fmt::format("IF[{} EQ {}]THEN #3000=", chosen[1].str(), chosen[2].str());
    for (std::size_t k = i + 1; k < fault.line; ++k)
      if (lines[k].starts_with(raises)) return true;
  }
  return false;
}

// Without an effect, whoever calls. "" where there is one.
std::string_view whyNothing(const Fault& fault, const std::string& program) {
  if (fault.before.find("#4014 LT 54.") != std::string::npos ||
      fault.before.find("#4014 GT 59.") != std::string::npos)
    return "no code of the group lies there, the question for whole numbers meets G54.1";
  if (fault.kind == "take no default" && fault.before.ends_with("=0.")) {
    const std::string local = fault.before.substr(fault.before.rfind('#'));
    const std::string variable = local.substr(0, local.find('='));
    const bool bare = std::regex_search(program, std::regex("[A-Z]" + variable + "(?![0-9])"));
    if (!bare) return "null counts as 0 in a formula";
  }
  if (fault.kind == "do not set a mode" &&
      (fault.after.find("G40") == std::string::npos || fault.after.find("G80") == std::string::npos))
    return "G40 and G80 are demanded of the caller";
  if (fault.kind == "do not set a mode" && isSetAgain(fault, program))
    return "blocks of the source set it again before anything moves";
  if (fault.kind == "do not check" && isCheckedBefore(fault, program))
    return "an earlier check of the same bound ends in an alarm already";
  if (fault.kind == "do not wait for the axes") return whyNoWait(program, fault.line);
  if ((fault.kind == "do not put a mode back" || fault.kind == "do not keep a mode" ||
       fault.kind == "keep the mode of another group") &&
      isMotionModeOfMacros(fault, program))
    return "the macros put the motion mode back, and nothing else sets it";
  return "";
}

} // namespace

TEST_CASE("verify sees faults in the frame of programs") {
  std::size_t wanted = draws<std::size_t>(30, 3);
  if (const char* text = std::getenv("DOTEK_FRAME_FAULTS"))
    wanted = static_cast<std::size_t>(parseNumber(text).value_or(1000));
  const std::vector<Translation> all = translations(std::getenv("DOTEK_FRAME_FAULTS") != nullptr);
  REQUIRE(all.size() >= (fewDraws() ? 4 : 10));
  struct Place {
    const Translation* in = nullptr;
    Fault fault;
  };
  std::map<std::string_view, std::vector<Place>> places;
  for (const Translation& one : all)
    for (const std::string_view kind : frameFaultKinds())
      for (Fault& fault : frameFaultsOf(kind, one.text))
        if (whyNothing(fault, one.text).empty()) places[kind].push_back({&one, std::move(fault)});
  struct Counts {
    std::size_t drawn = 0, seen = 0;
  };
  std::map<std::string_view, Counts> counts;
  verify::Random random(1);
  std::string survivors;
  const TestFolder folder("dotek-frame-faults");
  std::size_t most = 0;
  for (const auto& [kind, list] : places)
    most += list.size();
  wanted = std::min(wanted, most);
  // The operators in turn, so that each has its share; those whose places are used up are passed over.
  for (std::size_t turn = 0, left = wanted; left > 0; ++turn) {
    std::vector<Place>& list = places[frameFaultKinds()[turn % frameFaultKinds().size()]];
    if (list.empty()) continue;
    const std::size_t at = random.below(list.size());
    const Place place = std::move(list[at]);
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(at));
    --left;
    driver::VerifyOptions options = place.in->options;
    options.allowEdits = true; // the cases alone are to show it
    options.translation = folder.write("faulty.nc", withFault(place.in->text, place.fault));
    Counts& count = counts[place.fault.kind == "" ? "" : frameFaultKinds()[turn % frameFaultKinds().size()]];
    ++count.drawn;
    // Most of them show in the first cases.
    options.cases = kFewCases;
    bool seen = driver::verify(options).status == 1;
    options.cases = kCases;
    seen = seen || driver::verify(options).status == 1;
    if (seen)
      ++count.seen;
    else
      survivors += fmt::format("  {}: {}\n", place.in->name, place.fault.text());
  }
  std::string table;
  Counts sum;
  for (const std::string_view kind : frameFaultKinds()) {
    const Counts& one = counts[kind];
    table += fmt::format("{:42}{:>6} drawn{:>6} seen\n", kind, one.drawn, one.seen);
    sum.drawn += one.drawn;
    sum.seen += one.seen;
  }
  MESSAGE(fmt::format("{} faults in the frames of {} translations, {} seen\n{}{}", sum.drawn, all.size(),
                      sum.seen, table, survivors));
  CHECK(sum.seen * 100 >= sum.drawn * 99);
}

namespace {

// A family of operators, with what it is planted into.
struct Family {
  const char* name;
  const char* target;
};
constexpr Family kFrame = {"frame", "fanuc"}, kMotion = {"motion", "fanuc"},
                 kFragment = {"fragment", "fusion"};

struct PlantedKind {
  const Family* family = nullptr;
  std::string_view kind;
  struct Place {
    Translation* in = nullptr;
    Fault fault;
  };
  std::vector<Place> places;
  std::size_t all = 0, drawn = 0, notRead = 0, nothing = 0, seen = 0, survived = 0;
};

// What ends a loop that would never end stops nothing else.
bool countsSteps(const Fault& fault) {
  return fault.before.find("if (++steps > ") != std::string::npos;
}

// A job file holds 32-bit numbers: sums of these are exact, and none of them is half a thousandth.
bool meetsNoSum(const Fault& fault) {
  return fault.kind == "turn a bound" && fault.before.find(" > 0.0005)") != std::string::npos;
}

// The G31 before it waits as well, and the work system that comes in the place of the G53 is in force.
bool waitsAlready(const Fault& fault, const std::string& fragment) {
  static const std::regex block("^ *writeBlock\\(\"(G\\d+)\"\\);$"), system("\"G(5[4-9])[ \"]");
  std::smatch now, then, last;
  if (!std::regex_match(fault.before, now, block) || now[1] != "G53") return false;
  const bool dropped = fault.after.empty();
  if (!dropped && !std::regex_match(fault.after, then, block)) return false;
  const std::vector<std::string> lines = linesOf(fragment);
  if (fault.line == 0 || lines[fault.line - 1].find("writeBlock(\"G31 ") == std::string::npos) return false;
  std::string inForce;
  for (std::size_t i = 0; i < fault.line; ++i)
    if (std::regex_search(lines[i], last, system) && lines[i].find("writeBlock(") != std::string::npos)
      inForce = "G" + last[1].str();
  return dropped || then[1] == inForce;
}

// The picture of a value that the checks before it keep between two constants, both of which it prints.
bool fitsAlways(const Fault& fault, const std::string& fragment) {
  static const std::regex check("^ *if \\((\\w+)Text === null\\) \\{$");
  std::smatch found;
  if (fault.kind != "do not check" || !std::regex_match(fault.before, found, check)) return false;
  const std::string name = found[1];
  bool above = false, below = false;
  const std::vector<std::string> lines = linesOf(fragment);
  for (std::size_t i = 0; i < fault.line; ++i) {
    above = above || std::regex_match(lines[i], std::regex(" *if \\(" + name + " < -?\\d{1,3}\\) \\{"));
    below = below || std::regex_match(lines[i], std::regex(" *if \\(" + name + " > -?\\d{1,3}\\) \\{"));
  }
  return above && below;
}

std::string_view whyNothingOfFragment(const Fault& fault, const std::string& fragment) {
  if (countsSteps(fault)) return "what ends a loop that would never end stops nothing else";
  if (meetsNoSum(fault)) return "no sum of 32-bit numbers is that bound";
  if (fitsAlways(fault, fragment)) return "checks before it keep the value where it fits";
  if (waitsAlready(fault, fragment)) return "the G31 before the G53 waits as well";
  return "";
}

std::vector<PlantedKind> plantedKinds(std::vector<Translation>& all) {
  std::vector<PlantedKind> out;
  for (const std::string_view kind : frameFaultKinds())
    out.push_back({&kFrame, kind, {}});
  for (const std::string_view kind : faultKinds())
    out.push_back({&kMotion, kind, {}});
  for (const std::string_view kind : fragmentFaultKinds())
    out.push_back({&kFragment, kind, {}});
  for (Translation& one : all) {
    const FaultWords words = faultWordsOf(one.text);
    for (PlantedKind& kind : out) {
      if (one.options.to != kind.family->target) continue;
      const std::vector<Fault> faults = kind.family == &kFrame    ? frameFaultsOf(kind.kind, one.text)
                                        : kind.family == &kMotion ? faultsOf(kind.kind, one.text, words)
                                                                  : fragmentFaultsOf(kind.kind, one.text);
      for (const Fault& fault : faults)
        if (kind.family == &kFrame
                ? whyNothing(fault, one.text).empty()
                : kind.family != &kFragment || whyNothingOfFragment(fault, one.text).empty())
          kind.places.push_back({&one, fault});
    }
  }
  for (PlantedKind& kind : out)
    kind.all = kind.places.size();
  return out;
}

enum class Came : std::uint8_t { NotRead, Nothing, Seen, Survived };

// Traces of cases that agree without the fault say whether a program does something else.
bool changes(const Told& right, const Told& told) {
  return std::any_of(right.agreeing.begin(), right.agreeing.end(), [&](std::uint64_t number) {
    const auto trace = told.traces.find(number);
    return trace == told.traces.end() || trace->second != right.traces.at(number);
  });
}

Came plant(PlantedKind::Place& place, const Family& family, const TestFolder& folder) {
  driver::VerifyOptions options = place.in->options;
  options.allowEdits = true; // the cases alone are to show it
  options.translation = folder.write("faulty", withFault(place.in->text, place.fault));
  bool changed = &family != &kMotion;
  for (const std::uint64_t cases : {kFewCases, kCases}) { // most of them show in the first cases
    options.cases = cases;
    const Told told = toldBy(options);
    if (told.status == 1) return Came::Seen;
    if (told.status != 0) return Came::NotRead;
    if (&family != &kMotion) continue;
    std::optional<Told>& right = cases == kFewCases ? place.in->few : place.in->many;
    if (!right) {
      driver::VerifyOptions without = place.in->options;
      without.cases = cases;
      right = toldBy(without);
    }
    changed = changed || changes(*right, told);
  }
  return changed ? Came::Survived : Came::Nothing;
}

} // namespace

TEST_CASE("verify sees faults in the motion and the frame of what becomes of the shops' cycles") {
  // A measurement on demand: how many are seen is in docs/verify-faults.md.
  const char* const given = std::getenv("DOTEK_SHOP_FAULTS");
  if (given == nullptr) return;
  const auto wanted = static_cast<std::size_t>(parseNumber(given).value_or(1000));
  std::uint64_t seed = 1;
  if (const char* text = std::getenv("DOTEK_FAULTS_SEED"))
    seed = static_cast<std::uint64_t>(parseNumber(text).value_or(1));
  std::vector<Translation> all = translations(true);
  for (Translation& one : translations(true, "fusion"))
    all.push_back(std::move(one));
  REQUIRE(all.size() >= 20);
  std::vector<PlantedKind> kinds = plantedKinds(all);
  verify::Random random(seed);
  const TestFolder folder("dotek-shop-faults");
  std::string survivors;
  std::size_t drawn = 0;
  // The operators in turn, so that each has its share; those whose places are used up are passed over.
  const auto left = [&] {
    return std::any_of(kinds.begin(), kinds.end(),
                       [](const PlantedKind& one) { return !one.places.empty(); });
  };
  for (std::size_t turn = 0; drawn < wanted && left(); ++turn) {
    PlantedKind& kind = kinds[turn % kinds.size()];
    if (kind.places.empty()) continue;
    const std::size_t at = random.below(kind.places.size());
    PlantedKind::Place place = std::move(kind.places[at]);
    kind.places.erase(kind.places.begin() + static_cast<std::ptrdiff_t>(at));
    ++drawn;
    ++kind.drawn;
    const Came came = plant(place, *kind.family, folder);
    ++(came == Came::NotRead   ? kind.notRead
       : came == Came::Nothing ? kind.nothing
       : came == Came::Seen    ? kind.seen
                               : kind.survived);
    if (came == Came::Survived) {
      survivors += fmt::format("  {}: {}\n", place.in->name, place.fault.text());
      fmt::print("survived {} {}: {}\n", drawn, place.in->name, place.fault.text());
    }
  }
  std::string table = "| of | operator | places | drawn | not read | without effect | seen | survived |\n"
                      "|---|---|---|---|---|---|---|---|\n";
  PlantedKind sum;
  for (const PlantedKind& one : kinds) {
    table += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", one.family->name, one.kind, one.all,
                         one.drawn, one.notRead, one.nothing, one.seen, one.survived);
    sum.all += one.all, sum.drawn += one.drawn, sum.notRead += one.notRead, sum.nothing += one.nothing;
    sum.seen += one.seen, sum.survived += one.survived;
  }
  table += fmt::format("| all | | {} | {} | {} | {} | {} | {} |\n", sum.all, sum.drawn, sum.notRead,
                       sum.nothing, sum.seen, sum.survived);
  MESSAGE(fmt::format("{} faults by seed {} in {} translations\n{}{}", sum.drawn, seed, all.size(), table,
                      survivors));
  CHECK((sum.survived == 0 || sum.survived * 100 <= sum.seen + sum.survived));
}
