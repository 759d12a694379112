#include "lint/MacroNames.h"
#include "lint/ProgBlocks.h"
#include "support/NearestName.h"
#include "support/WriteInstead.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

void collect(const compost::Condition& condition, std::vector<const compost::Word*>& out) {
  for (const compost::ConditionTerm& term : condition.terms) {
    if (compost::cycleTested(term) != nullptr) out.push_back(std::get_if<compost::Word>(&term.operand));
    if (const auto* inner = std::get_if<std::unique_ptr<compost::Condition>>(&term.operand))
      collect(**inner, out);
  }
}

// One letter lost, added or swapped with its neighbour, or another case or mark between the words.
bool misspelt(const std::string& a, const std::string& b) {
  const auto letters = [](const std::string& text) {
    std::string out;
    for (const char c : gibbs::foldCase(text))
      if (std::isalnum(static_cast<unsigned char>(c)) != 0) out += c;
    return out;
  };
  std::string one = letters(a);
  std::string other = letters(b);
  if (one == other) return true;
  if (nameDistance(one, other, 1) != 1 || std::min(one.size(), other.size()) < 3) return false;
  if (one.size() != other.size() && std::min(one.size(), other.size()) < 4) return false;
  if (one.size() != other.size()) return true;
  std::sort(one.begin(), one.end());
  std::sort(other.begin(), other.end());
  return one == other;
}

// Where a routine keeps a list of cycles and lacks the folder, more letters may differ: one name goes on
// where the other ends (`floor.len`, `floor.lenght`), or a quarter of the letters are lost, added or swapped.
bool misspeltInList(const std::string& a, const std::string& b) {
  constexpr std::size_t kLeastStem = 5;
  const std::string one = gibbs::foldCase(a), other = gibbs::foldCase(b);
  if (one.size() == other.size()) return false;
  const std::string& shorter = one.size() < other.size() ? one : other;
  const std::string& longer = one.size() < other.size() ? other : one;
  if (shorter.size() >= kLeastStem && longer.starts_with(shorter)) return true;
  const std::size_t most = shorter.size() / 4;
  return most > 0 && nameDistance(one, other, most) <= most;
}

// Words of names that are close on purpose differ in one of these where they end, or in one of the first few
// where they begin: axes, sides, directions.
bool tellsApart(char a, char b, bool begins) {
  constexpr std::string_view kFamilies[] = {"xyz", "uvw", "lr", "ijk", "abcd", "pm", "pn", "ie", "io", "hl"};
  constexpr std::size_t kBegin = 3;
  return std::any_of(
      std::begin(kFamilies), begins ? kFamilies + kBegin : std::end(kFamilies), [&](std::string_view family) {
        return family.find(a) != std::string_view::npos && family.find(b) != std::string_view::npos;
      });
}

// One letter in the place of another within a word: `OV-Costula` for `OV-Costola`. A digit, a word of one or
// two letters, or the last or first letter of a word where it is a member of a family makes another name:
// `probe.x` and `probe.y`, `FaceX` and `FaceY`, `XWeb` and `YWeb`, `bore1` and `bore2`.
bool otherLetter(const std::string& a, const std::string& b) {
  constexpr std::size_t kLeastWord = 3;
  if (a.size() != b.size()) return false;
  const auto fold = [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); };
  const auto is = [](int (*kind)(int), char c) { return kind(static_cast<unsigned char>(c)) != 0; };
  std::size_t at = a.size();
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (fold(a[i]) == fold(b[i])) continue;
    if (at != a.size()) return false;
    at = i;
  }
  if (at == a.size() || !is(std::isalpha, a[at]) || !is(std::isalpha, b[at])) return false;
  // Words end at a mark, at a digit, and before a capital letter that follows a small one.
  const auto joins = [&](std::size_t left) {
    const bool letters = is(std::isalpha, b[left]) && is(std::isalpha, b[left + 1]);
    return letters && !(is(std::islower, b[left]) && is(std::isupper, b[left + 1]));
  };
  std::size_t begin = at, end = at + 1;
  while (begin > 0 && joins(begin - 1))
    --begin;
  while (end < b.size() && joins(end - 1))
    ++end;
  const bool first = at == begin, last = at + 1 == end;
  return end - begin >= kLeastWord && !((first || last) && tellsApart(fold(a[at]), fold(b[at]), !last));
}

void check(const Project& project, Report& report) {
  std::set<std::string> folders;
  for (const gibbs::Cycle* cycle : project.cycles)
    folders.insert(cycle->name);
  for (const compost::Program* prog : project.progs) {
    struct Test {
      const compost::Word* word = nullptr;
      const compost::Routine* routine = nullptr;
    };
    std::vector<Test> tests;
    std::map<const compost::Routine*, std::set<std::string>> testedIn;
    std::map<std::string, std::set<const compost::Routine*>> testing; // by the name that they test
    for (const compost::Item& item : prog->items) {
      const auto* routine = std::get_if<compost::Routine>(&item);
      if (routine == nullptr) continue;
      eachStatement(routine->body, [&](const compost::Statement& statement) {
        if (const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement)) {
          std::vector<const compost::Word*> words;
          collect((*branch)->condition, words);
          for (const compost::Word* word : words) {
            tests.push_back({word, routine});
            testedIn[routine].insert(word->arguments.front().text);
            testing[word->arguments.front().text].insert(routine);
          }
        }
      });
    }
    // The one name without a folder and the one folder without a branch, where all others fit.
    std::vector<std::string> nameless, left;
    for (const auto& [name, routines] : testing)
      if (!folders.contains(name)) nameless.push_back(name);
    for (const std::string& folder : folders)
      if (!testing.contains(folder)) left.push_back(folder);
    const bool onePair = testing.size() > 2 && nameless.size() == 1 && left.size() == 1;
    for (const Test& test : tests) {
      const compost::Literal& id = test.word->arguments.front();
      const std::set<std::string>& beside = testedIn[test.routine];
      // A name that several routines test is the name of a cycle, wherever its folder is.
      const bool elsewhere = testing.at(id.text).size() > 1;
      if (folders.contains(id.text)) continue;
      // All others that the Prog tests are linted with it: this one is the name of none.
      const bool alone =
          testing.size() > 2 && std::all_of(testing.begin(), testing.end(), [&](const auto& one) {
            return one.first == id.text || folders.contains(one.first);
          });
      const bool listsFolders = std::any_of(beside.begin(), beside.end(),
                                            [&](const std::string& name) { return folders.contains(name); });
      for (const std::string& folder : folders) {
        // A folder that the Prog prints for already is not the one that is meant.
        std::string one = gibbs::foldCase(id.text);
        std::string other = gibbs::foldCase(folder);
        std::sort(one.begin(), one.end());
        std::sort(other.begin(), other.end());
        // The same letters in another order are no name of their own.
        const bool same = one == other;
        // Routines that keep the same list: this one lacks the folder and has what is nearly its name.
        const bool inItsPlace = !elsewhere && beside.size() > 1 && !beside.contains(folder);
        const bool free = same || inItsPlace || alone ||
                          compost::printingRoutines(*prog, project.compostKeywords, folder).empty();
        const bool near = misspelt(id.text, folder) || (listsFolders && otherLetter(id.text, folder)) ||
                          (inItsPlace && listsFolders && misspeltInList(id.text, folder)) ||
                          (onePair && left.front() == folder &&
                           nameDistance(gibbs::foldCase(id.text), gibbs::foldCase(folder), 1) <= 1);
        if (!free || !near) continue;
        report
            .at(id.range,
                "no folder has the name `{}`; did you mean `{}`? the branch is taken for no operation",
                id.text, folder)
            .fix = writeInstead(id.range, "'" + folder + "'");
        break;
      }
    }
  }
}

} // namespace

DOTEK_LINT_RULE(cycle_name_differs){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
