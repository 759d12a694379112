// Two ways to one result: `post` runs the Prog on values; `convert` lowers it and folds the same values.
// Block for block both say the same.
#include "driver/Driver.h"
#include "support/Decimal.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/policy/Tree.h"

#include <cctype>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <random>

using namespace dotek;
using namespace dotek::tests;
namespace fs = std::filesystem;

namespace {

// A block with its blanks, its N number and the path numbers are written taken away: G65 P9770 Z5. ->
// G65P9770Z5
std::string canonical(const std::string& block) {
  std::string out;
  for (std::size_t at = 0; at < block.size();) {
    const char c = block[at];
    if (c == '(') return out + block.substr(at);
    if (c == ' ') {
      ++at;
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-') {
      std::size_t end = at + 1;
      while (end < block.size() &&
             (std::isdigit(static_cast<unsigned char>(block[end])) != 0 || block[end] == '.'))
        ++end;
      const auto number = parseNumber(block.substr(at, end - at));
      REQUIRE_MESSAGE(number, block);
      const std::string text = numberText(*number);
      if (!(out == "N"))
        out += text;
      else
        out.clear();
      at = end;
    } else {
      out += c;
      ++at;
    }
  }
  return out;
}

std::vector<std::string> postedBlocks(const std::string& text) {
  std::vector<std::string> out;
  for (const std::string& line : linesOf(text)) {
    if (!line.empty()) out.push_back(canonical(line));
  }
  return out;
}

// The lines of the converted program that the map traces to the Prog.
std::vector<std::string> convertedBlocks(const driver::Outcome& outcome, const std::string& prog) {
  const auto lines = linesOf(outcome.output);
  const auto map = nlohmann::json::parse(renderLineMap(outcome.maps, outcome.sources));
  std::vector<std::string> out;
  for (const auto& row : map.at(0).at("lines")) {
    const bool fromProg = !row.at("sources").empty() && row.at("sources").at(0).at("file") == prog;
    const bool madeUp = !row.at("reason").get<std::string>().empty();
    if (fromProg && !madeUp) out.push_back(canonical(lines.at(row.at("line").get<std::size_t>() - 1)));
  }
  return out;
}

std::string messages(const driver::Outcome& outcome) {
  return renderText(outcome.diagnostics, outcome.sources, 10);
}

struct Case {
  std::string folder;
  std::string prog;
  std::vector<std::string> fields; // those to vary
  driver::NamedTexts mapped = {};
  bool recover = false;
};

void folds(const Case& one) {
  std::mt19937 random(20);
  std::uniform_int_distribution<int> place(-9999, 9999);
  std::uniform_int_distribution<int> system(54, 59);
  const int sets = draws(200, 6);
  int done = 0;
  for (int attempt = 0; done < sets && attempt < 20 * sets; ++attempt) {
    driver::PostOptions post;
    post.folders = {one.folder};
    post.source.prog = one.prog;
    post.common.recover = one.recover;
    post.common.field = one.mapped;
    post.common.host = {{"clearance", numberText(place(random) / 100.0)}, {"tool_radius", "3"}};
    for (const std::string& field : one.fields)
      post.common.set.emplace_back(field, numberText(field == "G" ? system(random) : place(random) / 100.0));
    const driver::Outcome posted = driver::post(post);
    if (posted.status != 0) continue; // the dialog rejects the values
    driver::ConvertOptions convert;
    convert.inputs = post.folders;
    convert.common = post.common;
    convert.source = post.source;
    convert.to = "fanuc";
    const driver::Outcome converted = driver::convert(convert);
    REQUIRE_MESSAGE(converted.status == 0, messages(converted));
    CHECK(convertedBlocks(converted, one.prog) == postedBlocks(posted.output));
    ++done;
  }
  CHECK_MESSAGE(done == sets, one.folder << ": only " << done << " value sets pass the checks");
}

std::string example(const std::string& name) {
  return (root() / "examples" / name).generic_string();
}

} // namespace

TEST_CASE("folding the conversion of the examples gives the posted blocks") {
  for (const char* prog : {"post.txt", "mill-post.txt"}) {
    CAPTURE(prog);
    if (std::string(prog) == "post.txt") {
      folds({example("surface-x"), example(prog), {"G", "X", "I", "Z", "R"}});
      continue;
    }
    folds({example("surface-x"), example(prog), {"G", "X", "I", "Z", "R"}});
    folds({example("surface-y"), example(prog), {"G", "Y", "J", "Z", "R"}});
    folds({example("surface-z"), example(prog), {"G", "D", "K", "W", "R"}});
    folds({example("bore"), example(prog), {"G", "D", "I", "J", "Z", "R"}});
    folds({example("corner-xyz"),
           example(prog),
           {"G", "XA", "YB", "ZC", "UB", "VB", "UC", "VC", "WC", "I", "J", "K", "Z", "R"}});
  }
}

TEST_CASE("folding the conversion of the corpus cycles gives the posted blocks") {
  fs::path corpusFolder;
  if (!haveCorpus(corpusFolder)) return;
  const std::string prog = (corpusFolder / "compost" / "probe-routines.txt").generic_string();
  const auto folder = [&](const char* name) { return (corpusFolder / "gibbs" / name).generic_string(); };
  folds({folder("MERENI.OSA.X"), prog, {"a", "I", "G", "Zb", "Z"}, {{"X", "a"}}, true});
  folds({folder("MERENI.OSA.Y"), prog, {"b", "J", "G", "Zb", "Z"}, {{"Y", "b"}}, true});
  folds({folder("MERENI.OSA.Z"), prog, {"d", "C", "Zb", "K", "G"}, {{"Z", "d"}}, true});
  folds({folder("MERENI.STRED.OTVOR"), prog, {"D", "X", "Y", "G", "Z", "Zb"}, {}, true});
  folds({folder("MERENI.OSA.XYZ"),
         prog,
         {"Zb", "X", "Y", "Z", "KA", "G", "IB", "JB", "KB", "IC", "JC", "KC", "a", "b", "c"},
         {},
         true});
}
