// Every NC word that the Prog prints is in the result, in a word that means the same, or in a message at its
// line; every refusal says where and why.
#include "FusionHelper.h"
#include "WordCheck.h"
#include "stdlib/DataFiles.h"
#include "support/Decimal.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

const stdlib::DataFiles& data() {
  static const stdlib::DataFiles files;
  return files;
}
const stdlib::MacroSet& setNamed(const std::string& name) {
  static std::map<std::string, stdlib::MacroSet> sets;
  if (!sets.contains(name)) sets.emplace(name, *stdlib::MacroSet::load(data(), name));
  return sets.at(name);
}

struct Cycle {
  std::string folder, prog;
  driver::NamedTexts mapped = {};
  bool recover = false;
  driver::NamedTexts values; // each another, so that no word passes for another
  driver::NamedTexts start;  // where the probe is before
};

constexpr const char* kSets[] = {"", "easyprobe", "inspection-plus", "dotek"};

driver::ConvertOptions optionsFor(const Cycle& cycle, bool folded) {
  driver::ConvertOptions out;
  out.inputs = {cycle.folder};
  out.source.prog = cycle.prog;
  out.common.field = cycle.mapped;
  out.common.recover = cycle.recover;
  if (!folded) return out;
  out.common.set = cycle.values;
  out.common.host = {{"clearance", "17"}, {"tool_radius", "3"}};
  out.common.host.insert(out.common.host.end(), cycle.start.begin(), cycle.start.end());
  return out;
}

std::map<std::string, double> hostsOf(const driver::ConvertOptions& options) {
  std::map<std::string, double> out;
  for (const auto& [name, text] : options.common.host)
    out[name] = *parseNumber(text);
  return out;
}

struct Counts {
  int converted = 0, emitted = 0, translated = 0, explained = 0;
  int linesDropped = 0, wordsDropped = 0; // by the negative tests
  std::map<std::string, int> refused;     // by code
};

// Added by the back end: the source does not say it, or says it in another block.
bool isAddition(const NcWord& word, WordTarget target) {
  if (target == WordTarget::Mikroprog && (word.letter == 'N' || word.letter == 'L' || word.letter == '('))
    return true;
  return word.letter == 'G' && (word.value == "90" || word.value == "0" || word.value == "1");
}
bool isAddition(const ResultLine& line) {
  return line.text == "G53" || !line.reason.empty();
}

// Whether the line comes from a block of the Prog: the dialog's checks are no words.
bool isOf(const ResultLine& line, const std::vector<SourceBlock>& blocks) {
  return std::any_of(line.places.begin(), line.places.end(), [&](const Place& place) {
    return std::any_of(blocks.begin(), blocks.end(),
                       [&](const SourceBlock& block) { return block.place.file == place.file; });
  });
}

// The check fails where something is missing: each line and each word in turn.
void dropEach(const WordCase& how, const std::vector<SourceBlock>& blocks,
              const std::vector<ResultLine>& lines, const driver::Outcome& outcome, Counts& counts) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const ResultLine& line = lines[i];
    if (!isOf(line, blocks) || line.words.empty()) continue;
    CAPTURE(line.text);
    CAPTURE(line.reason);
    std::vector<ResultLine> fewer = lines;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    const bool missed = !checkWords(how, blocks, fewer, outcome).lost.empty();
    CHECK((missed || isAddition(line)));
    counts.linesDropped += missed;
    for (std::size_t w = 0; w < line.words.size() && missed; ++w) {
      CAPTURE(line.words[w].spelled);
      fewer = lines;
      fewer[i] = line.without(w);
      const bool lost = !checkWords(how, blocks, fewer, outcome).lost.empty();
      CHECK((lost || isAddition(line.words[w], how.target)));
      counts.wordsDropped += lost;
    }
  }
}

void refusalsSayWhy(const driver::Outcome& outcome, Counts& counts) {
  int errors = 0;
  for (const Diagnostic& one : outcome.diagnostics.all()) {
    if (one.severity != Severity::Error) continue;
    ++errors;
    CAPTURE(one.code);
    CHECK_FALSE(one.code.empty());
    CHECK(one.message.size() > 20);
    CHECK(one.range.hasPlace());
    if (one.range.hasPlace()) CHECK(outcome.sources.line(one.range) >= 1);
    ++counts.refused[std::string(one.code)];
  }
  CHECK(errors > 0);
  CHECK(outcome.output.empty());
  CHECK(outcome.files.empty());
}

// The blocks are what the CAM would have printed.
void asPosted(const driver::ConvertOptions& options, const std::vector<SourceBlock>& blocks) {
  driver::PostOptions post;
  post.folders = options.inputs;
  post.common = options.common;
  post.common.assume.clear();
  post.source = options.source;
  const driver::Outcome posted = driver::post(post);
  REQUIRE_MESSAGE(posted.status == 0, renderText(posted.diagnostics, posted.sources, 5));
  std::vector<std::string> texts;
  for (const SourceBlock& block : blocks)
    texts.push_back(block.text);
  CHECK(texts == withoutNumbers(posted.output));
}

void prove(const Cycle& cycle, const driver::ConvertOptions& options, WordCase how, Counts& counts,
           bool drops = true) {
  CAPTURE(options.to);
  CAPTURE(options.control);
  CAPTURE(options.probeMacros.value_or(""));
  CAPTURE(cycle.folder);
  CAPTURE(options.common.set.size());
  const driver::Outcome outcome = driver::convert(options);
  if (outcome.status != 0) return refusalsSayWhy(outcome, counts);
  const std::vector<SourceBlock> blocks = sourceBlocks(options);
  const std::vector<ResultLine> lines = resultLines(outcome, how.target);
  if (!options.common.set.empty()) asPosted(options, blocks);
  how.source = &setNamed("easyprobe");
  how.hosts = hostsOf(options);
  const WordReport report = checkWords(how, blocks, lines, outcome);
  for (const std::string& lost : report.lost)
    FAIL_CHECK("neither emitted nor translated nor explained: " << lost);
  // Without its messages the same result leaves unexplained what only they report.
  driver::Outcome silent = outcome;
  silent.diagnostics = {};
  CHECK(checkWords(how, blocks, lines, silent).lost.size() >= static_cast<std::size_t>(report.explained));
  ++counts.converted;
  counts.emitted += report.emitted;
  counts.translated += report.translated;
  counts.explained += report.explained;
  if (drops && report.lost.empty()) dropEach(how, blocks, lines, outcome, counts);
}

void toFanuc(const Cycle& cycle, Counts& counts) {
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b", "fanuc-6m"})
    for (const char* set : kSets)
      for (const bool folded : {true, false}) {
        driver::ConvertOptions options = optionsFor(cycle, folded);
        options.to = "fanuc";
        options.control = control;
        options.useDefaults = !folded;
        if (*set != 0) options.probeMacros = set;
        WordCase how;
        how.macros = &setNamed(*set == 0 ? "easyprobe" : set);
        prove(cycle, options, how, counts, control == std::string("fanuc-0i-md"));
      }
}

void toFusion(const Cycle& cycle, Counts& counts) {
  for (const char* set : kSets)
    for (const bool folded : {true, false}) {
      driver::ConvertOptions options = optionsFor(cycle, folded);
      options.to = "fusion";
      if (*set != 0) options.probeMacros = set;
      WordCase how;
      how.target = WordTarget::Fusion;
      how.macros = &setNamed(*set == 0 ? "easyprobe" : set);
      prove(cycle, options, how, counts);
    }
}

void toMikroprog(const Cycle& cycle, Counts& counts) {
  for (const char* control : {"mikroprog-mill", "mikroprog-s280"})
    for (const char* datum : {"g92", "operator"})
      for (const bool assumed : {true, false}) {
        driver::ConvertOptions options = optionsFor(cycle, true);
        options.to = "mikroprog";
        options.control = control;
        options.datum = datum;
        options.common.host.insert(options.common.host.end(), {{"overtravel", "5"}, {"return_feed", "990"}});
        if (assumed) options.common.assume = {"Q7", "Q10", "Q13"};
        WordCase how;
        how.target = WordTarget::Mikroprog;
        how.byOperator = datum == std::string("operator");
        how.diameters = control == std::string("mikroprog-s280");
        prove(cycle, options, how, counts, assumed);
      }
}

void all(const std::vector<Cycle>& cycles, Counts& counts) {
  for (const Cycle& cycle : cycles) {
    toFanuc(cycle, counts);
    toFusion(cycle, counts);
    toMikroprog(cycle, counts);
    if (fewDraws()) break;
  }
  std::string refused;
  for (const auto& [code, count] : counts.refused)
    refused += fmt::format(" {} {}", count, code);
  MESSAGE(counts.converted << " conversions, words: " << counts.emitted << " emitted, " << counts.translated
                           << " translated, " << counts.explained << " explained; refused:" << refused
                           << "; dropped and missed: " << counts.linesDropped << " lines, "
                           << counts.wordsDropped << " words");
}

std::string example(const std::string& name) {
  return (root() / "examples" / name).generic_string();
}

std::vector<Cycle> examples(const std::string& prog) {
  return {
      {example("surface-x"),
       prog,
       {},
       false,
       {{"X", "19"}, {"I", "4"}, {"G", "57"}, {"Z", "-6"}, {"R", "41"}},
       {{"start_x", "-15"}, {"start_y", "10"}}},
      {example("surface-x"),
       prog,
       {},
       false,
       {{"X", "19"}, {"I", "7.5"}, {"G", "57"}, {"Z", "-6"}, {"R", "41"}},
       {{"start_x", "-15"}, {"start_y", "10"}}},
      {example("surface-y"),
       prog,
       {},
       false,
       {{"Y", "-13"}, {"J", "2"}, {"G", "58"}, {"Z", "-7"}, {"R", "42"}},
       {{"start_x", "10"}, {"start_y", "15"}}},
      {example("surface-z"),
       prog,
       {},
       false,
       {{"W", "11"}, {"D", "-14"}, {"K", "-3"}, {"G", "59"}, {"R", "43"}},
       {{"start_x", "20"}, {"start_y", "21"}}},
      {example("corner-xyz"),
       prog,
       {},
       false,
       {{"XA", "12"},
        {"YB", "13"},
        {"ZC", "-14"},
        {"UB", "1.5"},
        {"VB", "2.5"},
        {"UC", "20"},
        {"VC", "21"},
        {"WC", "10"},
        {"I", "-3"},
        {"J", "15.5"},
        {"K", "-4"},
        {"G", "57"},
        {"Z", "-6"},
        {"R", "44"}},
       {{"start_x", "-15"}, {"start_y", "10"}}},
      {example("bore"),
       prog,
       {},
       false,
       {{"D", "38"}, {"I", "50"}, {"J", "40"}, {"G", "58"}, {"Z", "-9"}, {"R", "45"}},
       {{"start_x", "50"}, {"start_y", "40"}}},
  };
}

} // namespace

TEST_CASE("examples: every NC word of the source is emitted, translated or explained") {
  Counts counts;
  for (const char* prog : {"tests/words/post.txt", "examples/mill-post.txt"})
    all(examples((root() / prog).generic_string()), counts);
  if (fewDraws()) return;
  // Our own source goes to every target, and each kind of proof is needed.
  CHECK(counts.converted > 150);
  CHECK(counts.translated > 1500);
  CHECK(counts.explained > 150);
  CHECK(counts.linesDropped > 1500);
  CHECK(counts.wordsDropped > 4000);
}

TEST_CASE("examples: every NC word of each kind is emitted, translated or explained") {
  Counts counts;
  Cycle cycle = examples((root() / "tests" / "words" / "kinds.txt").generic_string()).front();
  all({cycle}, counts);
  CHECK(counts.converted > 10);
  // A code that the source leaves to what is in force is before the axes.
  driver::ConvertOptions options = optionsFor(cycle, true);
  options.to = "fanuc";
  const std::string program = driver::convert(options).output;
  CHECK(program.find("\nG0 X-14.\n") != std::string::npos);
  CHECK(program.find("\nG0 G91 X-1.\n") != std::string::npos);
}

TEST_CASE("corpus cycles: every NC word of the source is emitted, translated or explained") {
  std::filesystem::path corpusFolder;
  if (!haveCorpus(corpusFolder)) return;
  const std::string prog = (corpusFolder / "compost" / "probe-routines.txt").generic_string();
  const auto folder = [&](const char* name) { return (corpusFolder / "gibbs" / name).generic_string(); };
  Counts counts;
  all({{folder("MERENI.OSA.X"),
        prog,
        {{"X", "a"}},
        true,
        {{"a", "11"}, {"I", "2"}, {"G", "57"}, {"Zb", "51"}, {"Z", "-6"}},
        {{"start_x", "-9"}, {"start_y", "10"}}},
       {folder("MERENI.OSA.Y"),
        prog,
        {{"Y", "b"}},
        true,
        {{"b", "-12"}, {"J", "-1.5"}, {"G", "58"}, {"Zb", "52"}, {"Z", "-7"}},
        {{"start_x", "10"}, {"start_y", "8"}}},
       {folder("MERENI.OSA.Z"),
        prog,
        {{"Z", "d"}},
        true,
        {{"d", "-13"}, {"C", "9"}, {"K", "-4"}, {"G", "59"}, {"Zb", "53"}},
        {{"start_x", "1"}, {"start_y", "2"}}},
       {folder("MERENI.OSA.XYZ"),
        prog,
        {},
        true,
        {{"X", "2"},
         {"Y", "3"},
         {"Z", "-4"},
         {"KA", "-5"},
         {"G", "54"},
         {"IB", "12"},
         {"JB", "-9"},
         {"KB", "-6"},
         {"IC", "13"},
         {"JC", "14"},
         {"KC", "8"},
         {"Zb", "54"},
         {"a", "11"},
         {"b", "12"},
         {"c", "-12"}},
        {{"start_x", "-9"}, {"start_y", "10"}}},
       {folder("MERENI.STRED.OTVOR"),
        prog,
        {},
        true,
        {{"D", "33"}, {"X", "31"}, {"Y", "32"}, {"G", "55"}, {"Z", "-8"}, {"Zb", "49"}},
        {{"start_x", "31"}, {"start_y", "32"}}}},
      counts);
  CHECK((counts.converted > 60 || fewDraws()));
}
