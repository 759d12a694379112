// No name, message, title or routine of the corpus outside tests, docs and examples: knowledge of one shop's
// cycles belongs in data that the shop writes.
#include "tests/GoldenRunner.h"
#include "tests/policy/Tree.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <set>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

bool mayKnow(const TreeFile& file) {
  return file.below("tests") || file.below("docs") || file.below("examples");
}

// `names` in lower case.
void checkAbsent(const std::set<std::string>& names) {
  for (const TreeFile& file : tree()) {
    if (mayKnow(file)) continue;
    const std::string text = lowerCase(file.text);
    for (const std::string& name : names)
      CHECK_MESSAGE(findWord(text, name) == std::string::npos, file.path << " names `" << name << "`");
  }
}

// What is between the first `open` after `from` and the next `close`.
std::string between(const std::string& line, char open, char close) {
  const std::size_t begin = line.find(open);
  const std::size_t end = begin == std::string::npos ? begin : line.find(close, begin + 1);
  return end == std::string::npos ? "" : line.substr(begin + 1, end - begin - 1);
}

std::set<std::string> namesOfDialog(const fs::path& path) {
  std::set<std::string> out;
  for (const std::string& line : linesOf(readAll(path))) {
    const std::string word = lowerCase(line.substr(0, line.find(' ')));
    const std::string text = lowerCase(between(line, '"', '"'));
    if (word == "dialog" || (word == "label" && text.size() > 12) || word == "image") out.insert(text);
  }
  return out;
}

std::set<std::string> messagesOfMacro(const fs::path& path) {
  std::set<std::string> out;
  for (const std::string& line : linesOf(readAll(path))) {
    const std::size_t at = findWord(lowerCase(line), "message");
    if (at != std::string::npos) out.insert(lowerCase(between(line.substr(at), '"', '"')));
  }
  return out;
}

// Routines and cycle names of a post.
std::set<std::string> namesOfProg(const fs::path& path) {
  std::set<std::string> out;
  for (const std::string& line : linesOf(readAll(path))) {
    const std::size_t colon = line.find(':');
    if (colon != std::string::npos && colon > 6 && line.find_first_of(" '{(") > colon)
      out.insert(lowerCase(line.substr(0, colon)));
    if (line.find("CycleType?") != std::string::npos) out.insert(lowerCase(between(line, '\'', '\'')));
  }
  return out;
}

} // namespace

TEST_CASE("policy: names of the corpus, as known") {
  checkAbsent({"mereni",     "mereni.osa.x",   "mereni.stred.otvor", "defprobecycle", "ckmacrodrilling",
               "getspeed",   "getspeedspinon", "doofston",           "dospinoff",     "dofeedmode",
               "neplatna",   "prilis mala",    "ustaveni",           "souradnice",    "hloubka mereni",
               "toto makro", "hodnota",        "bezpecnostni",       "obr.probe",     "seznam nastroju"});
}

TEST_CASE("policy: names of the corpus, as read from it") {
  fs::path corpus;
  if (!haveCorpus(corpus)) return;
  std::set<std::string> names;
  for (const auto& folder : fs::directory_iterator(corpus / "gibbs")) {
    names.insert(lowerCase(folder.path().filename().string()));
    names.merge(namesOfDialog(folder.path() / "CycleData.dlg"));
    for (const char* file : {"CycleData.mac", "ToolPath.mac"})
      names.merge(messagesOfMacro(folder.path() / file));
  }
  for (const auto& file : fs::directory_iterator(corpus / "compost"))
    names.merge(namesOfProg(file.path()));
  names.erase("");
  CHECK(names.size() > 40);
  CHECK(names.contains("defprobecycle"));
  checkAbsent(names);
}
