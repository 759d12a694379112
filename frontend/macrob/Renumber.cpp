#include "frontend/macrob/Renumber.h"

#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Constant.h"
#include "frontend/macrob/Walk.h"
#include "support/messages/Output.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <vector>

namespace dotek::frontend::macrob {
namespace {

constexpr double kNumberInForce = 4114; // the variable that holds the number of the last block
constexpr std::uint32_t kLocals = 33;
constexpr double kLargest = 1e9; // above it, a number is that of no block, program or variable

struct Change {
  SourceRange range; // empty: put in
  std::string text;
};

// Old numbers of one program with their new ones.
struct Numbers {
  std::map<std::uint64_t, std::uint64_t> fresh; // of those that change
  std::map<std::uint64_t, std::size_t> count;   // of all, how many blocks have it
};

std::optional<std::uint64_t> wholeOf(const Expression& expression) {
  const std::optional<double> value = literal(expression);
  if (!value || *value < 0 || *value > kLargest || *value != std::floor(*value)) return std::nullopt;
  return static_cast<std::uint64_t>(*value);
}

const Expression* variableOf(const Expression& expression) {
  const auto* variable = std::get_if<nc::VariableRef>(&expression.node);
  return variable == nullptr ? nullptr : variable->number.get();
}

// #4114, #[4000+114]
bool isNumberInForce(const Expression& expression) {
  const Expression* const number = variableOf(expression);
  return number != nullptr && constantOf(*number) == kNumberInForce;
}

bool endsRun(const Program& program) {
  return std::any_of(program.blocks.begin(), program.blocks.end(), [](const Block& block) {
    const auto* words = std::get_if<Words>(&block.body);
    return words != nullptr && (findCode(*words, 'M', 30) != nullptr || findCode(*words, 'M', 2) != nullptr);
  });
}

class Renumbering {
public:
  Renumbering(const File& file, const RenumberOptions& options, const SourceMap& sources,
              Diagnostics& diagnostics)
      : file_(file), options_(options), sources_(sources), diagnostics_(diagnostics),
        numbers_(file.programs.size()) {}

  std::optional<std::string> run() {
    for (std::size_t i = 0; i < file_.programs.size(); ++i)
      number(i);
    for (std::size_t i = 0; i < file_.programs.size(); ++i)
      follow(i);
    if (failed_) return std::nullopt;
    std::sort(changes_.begin(), changes_.end(),
              [](const Change& a, const Change& b) { return a.range.begin < b.range.begin; });
    const std::string_view text = sources_.file(file_.file).bytes();
    std::string out;
    std::size_t at = 0;
    for (const Change& change : changes_) {
      out += text.substr(at, change.range.begin - at);
      out += change.text;
      at = change.range.end;
    }
    return out += text.substr(at);
  }

private:
  void refuse(SourceRange range, const std::string& why, const std::string& remedy) {
    failed_ = true;
    diagnostics_.report<diag::NotRenumbered>(range, sources_.textUtf8(range), why, remedy);
  }

  // New numbers of a program's own blocks.
  void number(std::size_t which) {
    const Program& program = file_.programs[which];
    Numbers& numbers = numbers_[which];
    for (const Block& block : program.blocks)
      if (block.sequenceNumber) ++numbers.count[block.sequenceNumber->value];
    std::size_t begin = 0, end = program.blocks.size();
    if (options_.range) {
      const auto at = [&](std::uint64_t n) {
        const auto found =
            std::find_if(program.blocks.begin(), program.blocks.end(), [&](const Block& block) {
              return block.sequenceNumber && block.sequenceNumber->value == n;
            });
        return static_cast<std::size_t>(found - program.blocks.begin());
      };
      begin = at(options_.range->first);
      end = at(options_.range->second);
      if (begin >= program.blocks.size() || end >= program.blocks.size() || end < begin) return;
      ++end;
      ranged_ = true;
    }
    std::uint64_t next = options_.start;
    std::set<std::uint64_t> given;
    for (std::size_t i = begin; i < end; ++i) {
      const Block& block = program.blocks[i];
      const auto& old = block.sequenceNumber;
      if (!old && (!options_.all || std::holds_alternative<std::monostate>(block.body))) continue;
      if (next > options_.last) {
        failed_ = true;
        diagnostics_.report<diag::NumbersTaken>(block.range, next, options_.last);
        return;
      }
      if (old) {
        changes_.push_back({old->range, fmt::format("N{}", next)});
        numbers.fresh.emplace(old->value, next);
      } else {
        const std::uint32_t place = block.blockDelete ? block.blockDelete->range.end : block.range.begin;
        const std::string_view text = sources_.file(file_.file).bytes();
        const bool blank = place < text.size() && (text[place] == ' ' || text[place] == '\t');
        changes_.push_back({{file_.file, place, place},
                            fmt::format("{}N{}{}", block.blockDelete && block.blockDelete->number ? " " : "",
                                        next, blank ? "" : " ")});
      }
      given.insert(next);
      next += options_.step;
    }
    for (std::size_t i = 0; i < program.blocks.size(); ++i) {
      const auto& old = program.blocks[i].sequenceNumber;
      if (old && (i < begin || i >= end) && given.contains(old->value))
        refuse(old->range, "lies outside of `--range` and has a number that a block inside would get",
               "take another `--start`");
    }
  }

  // A number that goes to a block of the program.
  void target(std::size_t which, SourceRange range, std::uint64_t number, const std::string& address = "") {
    const Numbers& numbers = numbers_[which];
    const auto count = numbers.count.find(number);
    if (count == numbers.count.end())
      return refuse(range, fmt::format("goes to N{}, which no block of the program has", number),
                    "give the block its number first");
    const auto fresh = numbers.fresh.find(number);
    if (fresh == numbers.fresh.end()) return;
    if (count->second > 1)
      return refuse(range, fmt::format("goes to N{}, which {} blocks have", number, count->second),
                    "give each block a number of its own first");
    changes_.push_back({range, address + std::to_string(fresh->second)});
  }

  void follow(std::size_t which) {
    for (const Block& block : file_.programs[which].blocks) {
      if (const Goto* jump = gotoOf(block)) followGoto(which, *jump);
      if (const auto* words = std::get_if<Words>(&block.body)) followWords(which, *words);
      followConditions(which, block);
      followReads(which, block);
    }
  }

  void followGoto(std::size_t which, const Goto& jump) {
    const Expression& to = *jump.target;
    if (const auto number = wholeOf(to)) return target(which, to.range, *number);
    if (isNumberInForce(to)) return; // whatever the number is
    const auto variable = variableNumber(to);
    if (!variable || *variable == 0 || *variable > kLocals)
      return refuse(jump.range,
                    variable ? "takes its block from a variable that other programs can set"
                             : "computes the number of its block",
                    "write the number, as in `GOTO 100`, or leave the file's numbers as they are");
    followVariable(which, jump, *variable);
  }

  // A local variable that holds numbers of blocks and nothing else.
  void followVariable(std::size_t which, const Goto& jump, std::uint32_t variable) {
    if (!followed_.emplace(which, variable).second) return;
    std::vector<const Expression*> values;
    bool other = false;
    for (const Block& block : file_.programs[which].blocks) {
      const Goto* const here = gotoOf(block);
      const Expression* const asTarget = here == nullptr ? nullptr : here->target.get();
      walk(block, [&](const Expression& expression, bool) {
        const Expression* const number = variableOf(expression);
        if (number == nullptr || &expression == asTarget) return;
        if (const auto read = constantOf(*number); !read || *read == variable) other = true;
      });
      if (const nc::Assignment* set = assignmentOf(block)) {
        const auto to = constantOf(*set->variable);
        if (!to) other = true;
        if (to && *to == variable) values.push_back(set->value.get());
      }
    }
    const bool known =
        !other && !values.empty() && std::all_of(values.begin(), values.end(), [&](const Expression* value) {
          return isNumberInForce(*value) ||
                 (wholeOf(*value) && numbers_[which].count.contains(*wholeOf(*value)));
        });
    if (!known)
      return refuse(
          jump.range,
          fmt::format("takes its block from #{}, which is not only set to numbers of blocks", variable),
          "write the number, as in `GOTO 100`, or leave the file's numbers as they are");
    for (const Expression* value : values)
      if (const auto number = wholeOf(*value)) target(which, value->range, *number);
  }

  void followWords(std::size_t which, const Words& words) {
    const auto find = [&](char address) -> const nc::Word* {
      const auto at = std::find_if(words.words.begin(), words.words.end(),
                                   [&](const nc::Word& word) { return word.address == address; });
      return at == words.words.end() ? nullptr : &*at;
    };
    const nc::Word *const p = find('P'), *const q = find('Q');
    if (const nc::Word* code = findCode(words, 'M', 97); code != nullptr && p != nullptr)
      word(which, *p, "a subprogram of the same program");
    for (const double code : {70, 71, 72, 73}) {
      if (findCode(words, 'G', code) == nullptr || p == nullptr || q == nullptr) continue;
      // G73 with a level R drills: P is a dwell and Q a depth.
      if (find('R') != nullptr && find('Z') != nullptr) continue;
      word(which, *p, "the contour of a cycle");
      word(which, *q, "the contour of a cycle");
    }
    const auto call = callOf(words);
    if (!call || call->program == nullptr) return;
    if (call->kind == CallKind::Return) return followReturn(which, *call->program);
    if (call->kind != CallKind::Subprogram || q == nullptr) return;
    const auto program = literal(*call->program);
    for (std::size_t i = 0; i < file_.programs.size(); ++i) {
      const auto& name = file_.programs[i].name;
      if (program && name && static_cast<double>(name->number) == *program) return word(i, *q, "a block");
    }
    refuse(q->range, "begins another program at one of its blocks, and that program is not in this file",
           "put both programs into one file first");
  }

  void word(std::size_t which, const nc::Word& word, const std::string& what) {
    const auto value = literal(word);
    if (!value || *value < 0 || *value != std::floor(*value))
      return refuse(word.range, "computes the number of " + what, "write the number");
    if (*value > kLargest)
      return refuse(word.range, "names no block: no control has so large a number",
                    "write the number of a block");
    target(which, word.range, static_cast<std::uint64_t>(*value), std::string(1, word.address));
  }

  // M99 P: a block of who called, and of the program itself where nobody did.
  void followReturn(std::size_t which, const nc::Word& word) {
    const auto value = literal(word);
    if (!value || *value < 0 || *value > kLargest || *value != std::floor(*value))
      return refuse(word.range, "computes the number of a block", "write the number");
    const auto number = static_cast<std::uint64_t>(*value);
    std::set<std::size_t> callers;
    const auto& name = file_.programs[which].name;
    for (std::size_t i = 0; name && i < file_.programs.size(); ++i)
      for (const Block& block : file_.programs[i].blocks) {
        const auto* words = std::get_if<Words>(&block.body);
        const auto call = words == nullptr ? std::nullopt : callOf(*words);
        if (!call || call->program == nullptr || call->kind == CallKind::Return) continue;
        const auto program = literal(*call->program);
        if (!program || *program == static_cast<double>(name->number) ||
            (call->repeat == nullptr && *program > 9999 &&
             std::fmod(*program, 10000) == static_cast<double>(name->number)))
          callers.insert(i);
      }
    if (callers.empty() && (which == 0 || endsRun(file_.programs[which]))) callers.insert(which);
    if (callers.empty())
      return refuse(word.range, "goes to a block of a program that is not in this file",
                    "put both programs into one file first");
    std::set<std::uint64_t> fresh;
    for (const std::size_t caller : callers) {
      const auto at = numbers_[caller].fresh.find(number);
      fresh.insert(at == numbers_[caller].fresh.end() ? number : at->second);
    }
    if (fresh.size() > 1)
      return refuse(word.range, "goes to blocks of several programs, whose numbers would differ",
                    "renumber them one after another, with `--range`");
    target(*callers.begin(), word.range, number, "P");
  }

  // IF[#4114 EQ 100]
  void followConditions(std::size_t which, const Block& block) {
    const Condition* const condition = conditionOf(block);
    if (condition == nullptr) return;
    eachComparison(*condition, [&](const Comparison& comparison, SourceRange range) {
      const bool left = isNumberInForce(*comparison.left), right = isNumberInForce(*comparison.right);
      if (!left && !right) return;
      compared_.insert(left ? comparison.left.get() : comparison.right.get());
      const Expression& other = left ? *comparison.right : *comparison.left;
      const auto number = wholeOf(other);
      if (!number || (comparison.op != "EQ" && comparison.op != "NE"))
        return refuse(range, "compares the number of a block with what cannot be followed",
                      "compare with `EQ` or `NE` and one number");
      if (numbers_[which].count.contains(*number)) target(which, other.range, *number);
    });
  }

  // What else is done with #4114: kept in a variable that only GOTO reads it is followed, else not.
  void followReads(std::size_t which, const Block& block) {
    const nc::Assignment* const set = assignmentOf(block);
    const Goto* const jump = gotoOf(block);
    walk(block, [&](const Expression& expression, bool) {
      if (!isNumberInForce(expression) || compared_.contains(&expression)) return;
      if (jump != nullptr && &expression == jump->target.get()) return;
      const auto to =
          set != nullptr && &expression == set->value.get() ? constantOf(*set->variable) : std::nullopt;
      const bool known = to && *to >= 0 && *to <= kLargest;
      if (known && followed_.contains({which, static_cast<std::uint32_t>(*to)})) return;
      if (known && *to <= kLocals && onlyGoto(which, static_cast<std::uint32_t>(*to))) return;
      refuse(expression.range, "reads the number of a block, which changes",
             "take the number from a variable of the program");
    });
  }

  bool onlyGoto(std::size_t which, std::uint32_t variable) const {
    bool other = false;
    for (const Block& block : file_.programs[which].blocks) {
      const Goto* const jump = gotoOf(block);
      const Expression* const asTarget = jump == nullptr ? nullptr : jump->target.get();
      walk(block, [&](const Expression& expression, bool) {
        const Expression* const number = variableOf(expression);
        if (number == nullptr || &expression == asTarget) return;
        if (const auto read = constantOf(*number); !read || *read == variable) other = true;
      });
    }
    return !other;
  }

public:
  bool ranged() const { return ranged_; }

private:
  const File& file_;
  const RenumberOptions& options_;
  const SourceMap& sources_;
  Diagnostics& diagnostics_;
  std::vector<Numbers> numbers_; // by program
  std::vector<Change> changes_;
  std::set<std::pair<std::size_t, std::uint32_t>> followed_; // program, variable
  std::set<const Expression*> compared_;
  bool failed_ = false, ranged_ = false;
};

} // namespace

std::optional<std::string> renumber(const File& file, const RenumberOptions& options,
                                    const SourceMap& sources, Diagnostics& diagnostics) {
  if (file.hasErrors) return std::nullopt;
  Renumbering renumbering(file, options, sources, diagnostics);
  std::optional<std::string> out = renumbering.run();
  if (options.range && !renumbering.ranged() && !diagnostics.hasErrors()) {
    diagnostics.report<diag::NotRenumbered>(
        {file.file, 0, 0}, fmt::format("--range {}:{}", options.range->first, options.range->second),
        "names blocks that no program of the file has in this order",
        "name the numbers of two blocks of one program");
    return std::nullopt;
  }
  return out;
}

} // namespace dotek::frontend::macrob
