#include "lint/BranchSteps.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace dotek::lint {
namespace {

// Each branch sees what the others of its cycle print: of more branches for one cycle the rest is not looked
// at.
constexpr std::size_t kMostOfOneCycle = 100;
constexpr std::size_t kCallers = 4; // routines that call one another, from the branch outward

std::optional<double> codeOf(const ProgWord& word) {
  double value = 0;
  const char* end = word.digits.data() + word.digits.size();
  const auto [at, error] = std::from_chars(word.digits.data(), end, value);
  return error == std::errc() && at == end ? std::optional(value) : std::nullopt;
}

bool calls(const compost::Statement& statement, const std::string& routine) {
  const auto* word = std::get_if<compost::Word>(&statement);
  return word != nullptr && word->kind == compost::WordKind::Command && word->name == routine;
}

// Statements of a list by the cycles that they run for. Of a Prog with a thousand branches each branch sees
// its own IFs and not those of all others.
struct Plan {
  std::vector<std::size_t> always;                      // for any cycle, as far as the list shows it
  std::map<std::string, std::vector<std::size_t>> ofId; // IFs without ELSE that test for cycles
  std::map<const compost::If*, std::size_t> ifs;
};
// By the address of the list.
using Plans = std::map<const std::vector<compost::Statement>*, Plan>;

const Plan& planOf(const std::vector<compost::Statement>& statements, Plans& plans) {
  const auto [at, isNew] = plans.try_emplace(&statements);
  if (!isNew) return at->second;
  for (std::size_t i = 0; i < statements.size(); ++i) {
    const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statements[i]);
    const auto ids = branch == nullptr || !(*branch)->elseBody.empty()
                         ? std::nullopt
                         : compost::cyclesOf((*branch)->condition);
    if (branch != nullptr) at->second.ifs.emplace(branch->get(), i);
    if (!ids) at->second.always.push_back(i);
    for (const std::string& id : ids.value_or(std::set<std::string>()))
      at->second.ofId[id].push_back(i);
  }
  return at->second;
}

// The routines of a Prog that hold a command, by its name, in the order of the text.
using Callers = std::map<std::string, std::vector<const compost::Routine*>>;

Callers callersIn(const compost::Program& prog) {
  Callers out;
  for (const compost::Item& item : prog.items) {
    const auto* routine = std::get_if<compost::Routine>(&item);
    if (routine == nullptr) continue;
    eachStatement(routine->body, [&](const compost::Statement& statement) {
      const auto* word = std::get_if<compost::Word>(&statement);
      if (word == nullptr || word->kind != compost::WordKind::Command) return;
      std::vector<const compost::Routine*>& callers = out[word->name];
      if (callers.empty() || callers.back() != routine) callers.push_back(routine);
    });
  }
  return out;
}

// Blocks that a routine prints for one cycle before and after a place.
class Around {
public:
  Around(const Project& project, const compost::Program& prog, Plans& plans, BranchSteps& into)
      : project_(project), prog_(prog), plans_(plans), into_(into) {}

  // `at`: the place is this IF, or a call of a routine of this name.
  void look(const compost::Routine& routine, const compost::If* at, const std::string& callee) {
    at_ = at;
    callee_ = &callee;
    found_ = false;
    walk(routine.body);
    flush();
  }

private:
  bool isPlace(const compost::Statement& statement) const {
    if (at_ == nullptr) return calls(statement, *callee_);
    const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement);
    return branch != nullptr && branch->get() == at_;
  }

  void walk(const std::vector<compost::Statement>& statements) {
    const Plan& plan = planOf(statements, plans_);
    std::vector<std::size_t> shown = plan.always;
    if (const auto own = plan.ofId.find(into_.id); own != plan.ofId.end()) {
      shown.clear();
      std::merge(plan.always.begin(), plan.always.end(), own->second.begin(), own->second.end(),
                 std::back_inserter(shown));
    }
    // The place itself, whatever else it tests for.
    if (const auto place = plan.ifs.find(at_); place != plan.ifs.end())
      if (const auto at = std::lower_bound(shown.begin(), shown.end(), place->second);
          at == shown.end() || *at != place->second)
        shown.insert(at, place->second);
    std::size_t next = 0;
    for (const std::size_t i : shown) {
      if (i != std::exchange(next, i + 1)) flush(); // an IF of another cycle is between
      const compost::Statement& statement = statements[i];
      if (isPlace(statement)) {
        flush();
        found_ = true;
      } else if (const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement)) {
        flush();
        const auto ids = compost::cyclesOf((*branch)->condition);
        if (!ids || ids->contains(into_.id)) walk((*branch)->thenBody);
        flush();
        walk((*branch)->elseBody);
        flush();
      } else {
        one(statement);
      }
    }
    if (next != statements.size()) flush();
  }

  void one(const compost::Statement& statement) {
    if (std::holds_alternative<compost::EndOfLine>(statement)) return flush();
    if (const auto* literal = std::get_if<compost::Literal>(&statement)) {
      line_.pieces.push_back({ProgPiece::Kind::Text, literal->range, literal, nullptr, "", 0});
    } else if (const auto* word = std::get_if<compost::Word>(&statement)) {
      if (word->kind == compost::WordKind::Boolean) return;
      const compost::Routine* routine =
          word->kind == compost::WordKind::Command ? compost::findRoutine(prog_, word->name) : nullptr;
      if (routine != nullptr) {
        flush();
        for (const ProgBlock& block : blocksOf(routine->body, prog_, project_))
          add(block);
        return;
      }
      line_.pieces.push_back({pieceKind(*word, project_), word->range, nullptr, word, "", 0});
    }
  }

  void flush() {
    if (!line_.pieces.empty()) add(line_);
    line_ = {};
  }

  void add(const ProgBlock& block) {
    (found_ ? into_.after : into_.before).push_back(deedsOf(block, project_));
  }

  const Project& project_;
  const compost::Program& prog_;
  Plans& plans_;
  BranchSteps& into_;
  const compost::If* at_ = nullptr;
  const std::string* callee_ = nullptr;
  bool found_ = false;
  ProgBlock line_;
};

void lookAround(const Project& project, const compost::Program& prog, const Callers& callers,
                const compost::Routine& routine, const compost::If* at, Plans& plans, BranchSteps& into) {
  Around around(project, prog, plans, into);
  around.look(routine, at, routine.name);
  std::vector<const compost::Routine*> seen = {&routine};
  for (std::size_t i = 0; i < seen.size() && seen.size() <= kCallers; ++i) {
    const auto callsIt = callers.find(seen[i]->name);
    if (callsIt == callers.end()) continue;
    for (const compost::Routine* other : callsIt->second) {
      if (std::find(seen.begin(), seen.end(), other) != seen.end()) continue;
      around.look(*other, nullptr, seen[i]->name);
      seen.push_back(other);
    }
  }
}

} // namespace

BlockDeeds deedsOf(const ProgBlock& block, const Project& project) {
  BlockDeeds out;
  const std::vector<ProgWord> words = wordsOf(block, project.form, true);
  bool home = false;
  bool skip = false;
  for (const ProgWord& word : words) {
    const auto code = codeOf(word);
    if (!code) continue;
    if (word.address == 'M') {
      out.stopsSpindle = out.stopsSpindle || *code == 5 || *code == 6 || *code == 19;
      out.stopsCoolant = out.stopsCoolant || *code == 9;
    } else if (word.address == 'G') {
      home = home || *code == 28 || *code == 30 || *code == 53;
      skip = skip || (*code >= 31 && *code < 32);
      if (*code == 90 || *code == 91) {
        out.absolute = *code == 90;
        out.incremental = *code == 91;
      }
    }
  }
  const bool z = findWord(words, 'Z') != nullptr;
  if (const std::uint32_t program = macroCalled(words)) {
    const MacroMeaning meaning = meaningOf(project, program);
    using stdlib::Intent;
    out.measures = meaning.measures();
    // With Z, a width or a diameter is measured from outside, whichever signature comes first.
    out.outside =
        out.measures && z && meaning.intent != Intent::Surface && meaning.intent != Intent::StockAllowance;
    out.movesZ = (z || printsUnknown(block, project.form)) && meaning.set != nullptr &&
                 meaning.intent == Intent::ProtectedMove;
    out.switchesProbeOn = meaning.set != nullptr && meaning.intent == Intent::ProbeOn;
    return out;
  }
  const bool call = findWord(words, 'P') != nullptr;
  out.measures = skip && (z || findWord(words, 'X') != nullptr || findWord(words, 'Y') != nullptr);
  out.movesZ = z && !out.measures && (!call || home);
  return out;
}

std::vector<BranchSteps> branchSteps(const Project& project) {
  std::vector<BranchSteps> out;
  Plans plans;
  std::map<const compost::Program*, Callers> callers;
  for (const Siblings& siblings : siblingsOf(project)) {
    if (siblings.prog->hasErrorNodes || !siblings.routine->returnRange) continue;
    const auto [of, isNew] = callers.try_emplace(siblings.prog);
    if (isNew) of->second = callersIn(*siblings.prog);
    std::map<std::string, std::size_t> seen; // branches by their cycle
    for (const CycleBranch& branch : siblings.branches) {
      if (++seen[branch.id] > kMostOfOneCycle) continue;
      BranchSteps one{siblings.prog, branch.id, branch.ref.branch->ifRange, {}, {}, {}};
      for (const ProgBlock& block : branch.blocks)
        one.steps.push_back({deedsOf(block, project), block.range, block.conditional});
      lookAround(project, *siblings.prog, of->second, *siblings.routine, branch.ref.branch, plans, one);
      out.push_back(std::move(one));
    }
  }
  return out;
}

} // namespace dotek::lint
