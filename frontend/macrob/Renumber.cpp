#include "frontend/macrob/Renumber.h"

#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Constant.h"
#include "frontend/macrob/Walk.h"
#include "support/messages/Fanuc.h"
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

// A program among those of all files.
struct Place {
  std::size_t input = 0;
  const Program* program = nullptr;
  bool first = false; // of its file
};

class Renumbering {
public:
  Renumbering(std::span<const RenumberInput> inputs, const SourceMap& sources, Diagnostics& diagnostics)
      : inputs_(inputs), sources_(sources), diagnostics_(diagnostics), ranged_(inputs.size()) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (inputs[i].file->hasErrors) continue;
      for (const Program& program : inputs[i].file->programs)
        places_.push_back({i, &program, &program == &inputs[i].file->programs.front()});
    }
    numbers_.resize(places_.size());
    for (std::size_t i = 0; i < places_.size(); ++i)
      if (const auto& name = programAt(i).name) named_[static_cast<double>(name->number)].push_back(i);
  }

  std::vector<std::optional<std::string>> run() {
    for (std::size_t i = 0; i < places_.size(); ++i)
      number(i);
    for (std::size_t i = 0; i < places_.size(); ++i)
      follow(i);
    std::vector<std::optional<std::string>> out(inputs_.size());
    if (failed_) return out;
    warnOfCalls();
    std::stable_sort(changes_.begin(), changes_.end(),
                     [](const Change& a, const Change& b) { return a.range.begin < b.range.begin; });
    for (std::size_t i = 0; i < inputs_.size(); ++i)
      if (!inputs_[i].file->hasErrors) out[i] = changed(inputs_[i].file->file);
    return out;
  }
  bool ranged(std::size_t input) const { return ranged_[input]; }

private:
  std::string changed(FileId file) const {
    const std::string_view text = sources_.file(file).bytes();
    std::string out;
    std::size_t at = 0;
    for (const Change& change : changes_) {
      if (change.range.file != file) continue;
      out += text.substr(at, change.range.begin - at);
      out += change.text;
      at = change.range.end;
    }
    return out += text.substr(at);
  }

  const Program& programAt(std::size_t which) const { return *places_[which].program; }

  // The programs that a call of this one may mean.
  std::vector<std::size_t> called(std::size_t from, double number) const {
    std::vector<std::size_t> own, others;
    const auto named = named_.find(number);
    if (named == named_.end()) return own;
    for (const std::size_t i : named->second)
      (places_[i].input == places_[from].input ? own : others).push_back(i);
    return own.empty() ? others : own;
  }
  // M98 P21002 is O1002 twice on some controls.
  std::vector<std::size_t> called(std::size_t from, const Call& call, double number) const {
    std::vector<std::size_t> out = called(from, number);
    if (out.empty() && call.repeat == nullptr && number > 9999) return called(from, std::fmod(number, 10000));
    return out;
  }

  template <class Visit> void eachCall(std::size_t which, const Visit& visit) const {
    for (const Block& block : programAt(which).blocks) {
      const auto* words = std::get_if<Words>(&block.body);
      const auto call = words == nullptr ? std::nullopt : callOf(*words);
      if (call && call->program != nullptr && call->kind != CallKind::Return) visit(*call);
    }
  }

  // One that is not given may return to a block by its old number. Once a file.
  void warnOfCalls() {
    std::set<std::size_t> told;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const auto& fresh = numbers_[i].fresh;
      if (std::none_of(fresh.begin(), fresh.end(), [](const auto& one) { return one.first != one.second; }))
        continue;
      eachCall(i, [&](const Call& call) {
        const auto number = literal(*call.program);
        if ((number && !called(i, call, *number).empty()) || !told.insert(places_[i].input).second) return;
        diagnostics_.report<diag::RenumberCalls>(call.program->range, "", ", nor in another that is given",
                                                 "; give their files in the same command");
      });
    }
  }

  void refuse(SourceRange range, const std::string& why, const std::string& remedy) {
    failed_ = true;
    diagnostics_.report<diag::NotRenumbered>(range, sources_.textUtf8(range), why, remedy);
  }

  // New numbers of a program's own blocks.
  void number(std::size_t which) {
    const Program& program = programAt(which);
    const RenumberOptions& options = inputs_[places_[which].input].options;
    const FileId file = inputs_[places_[which].input].file->file;
    Numbers& numbers = numbers_[which];
    for (const Block& block : program.blocks)
      if (block.sequenceNumber) ++numbers.count[block.sequenceNumber->value];
    std::size_t begin = 0, end = program.blocks.size();
    if (options.range) {
      const auto at = [&](std::uint64_t n) {
        const auto found =
            std::find_if(program.blocks.begin(), program.blocks.end(), [&](const Block& block) {
              return block.sequenceNumber && block.sequenceNumber->value == n;
            });
        return static_cast<std::size_t>(found - program.blocks.begin());
      };
      begin = at(options.range->first);
      end = at(options.range->second);
      if (begin >= program.blocks.size() || end >= program.blocks.size() || end < begin) return;
      ++end;
      ranged_[places_[which].input] = true;
    }
    std::uint64_t next = options.start;
    std::set<std::uint64_t> given;
    for (std::size_t i = begin; i < end; ++i) {
      const Block& block = program.blocks[i];
      const auto& old = block.sequenceNumber;
      if (!old && (!options.all || std::holds_alternative<std::monostate>(block.body))) continue;
      if (next > options.last) {
        failed_ = true;
        diagnostics_.report<diag::NumbersTaken>(block.range, next, options.last);
        return;
      }
      if (old) {
        changes_.push_back({old->range, fmt::format("N{}", next)});
        numbers.fresh.emplace(old->value, next);
      } else {
        const std::uint32_t place = block.blockDelete ? block.blockDelete->range.end : block.range.begin;
        const std::string_view text = sources_.file(file).bytes();
        const bool blank = place < text.size() && (text[place] == ' ' || text[place] == '\t');
        changes_.push_back({{file, place, place},
                            fmt::format("{}N{}{}", block.blockDelete && block.blockDelete->number ? " " : "",
                                        next, blank ? "" : " ")});
      }
      given.insert(next);
      next += options.step;
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
    for (const Block& block : programAt(which).blocks) {
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
    for (const Block& block : programAt(which).blocks) {
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
    if (call && call->kind == CallKind::Subprogram && call->program == nullptr && call->block != nullptr)
      return word(which, *call->block, "a subprogram of the same program");
    if (!call || call->program == nullptr) return;
    if (call->kind == CallKind::Return) return followReturn(which, *call->program);
    if (call->kind != CallKind::Subprogram || q == nullptr) return;
    const auto program = literal(*call->program);
    const auto to = program ? called(which, *program) : std::vector<std::size_t>();
    if (to.empty())
      return refuse(q->range,
                    "begins another program at one of its blocks, and that program is in no file given",
                    "give its file in the same command, or put both programs into one");
    if (to.size() > 1)
      return refuse(q->range, "begins another program at one of its blocks, and several files given have it",
                    "give the file that is meant alone");
    word(to.front(), *q, "a block");
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
    const auto& name = programAt(which).name;
    bool unclear = false;
    for (std::size_t i = 0; name && i < places_.size(); ++i)
      eachCall(i, [&](const Call& call) {
        const auto program = literal(*call.program);
        if (!program) {
          // Of another file only where it has such a block.
          if (places_[i].input == places_[which].input || numbers_[i].count.contains(number))
            callers.insert(i);
          return;
        }
        const std::vector<std::size_t> to = called(i, call, *program);
        if (std::find(to.begin(), to.end(), which) == to.end()) return;
        callers.insert(i);
        unclear = unclear || to.size() > 1;
      });
    if (unclear)
      return refuse(word.range,
                    "goes to a block of a caller, and several files given have a program of this number",
                    "renumber those that belong together by themselves");
    const bool own = numbers_[which].count.contains(number);
    if (callers.empty() && own && (places_[which].first || endsRun(programAt(which)))) callers.insert(which);
    if (callers.empty())
      return refuse(
          word.range,
          own ? "goes to a block of a program that is in no file given"
              : fmt::format("goes to N{}, which no block of the program has, and no caller of it is given",
                            number),
          own ? "give the file of the caller in the same command, or put both programs into one"
              : "give the file of the caller in the same command, or the block its number");
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
    for (const Block& block : programAt(which).blocks) {
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

  std::span<const RenumberInput> inputs_;
  const SourceMap& sources_;
  Diagnostics& diagnostics_;
  std::vector<bool> ranged_; // by input
  std::vector<Place> places_;
  std::map<double, std::vector<std::size_t>> named_; // places, by the number of the program
  std::vector<Numbers> numbers_;                     // by place
  std::vector<Change> changes_;
  std::set<std::pair<std::size_t, std::uint32_t>> followed_; // program, variable
  std::set<const Expression*> compared_;
  bool failed_ = false;
};

} // namespace

std::vector<std::optional<std::string>> renumber(std::span<const RenumberInput> inputs,
                                                 const SourceMap& sources, Diagnostics& diagnostics) {
  Renumbering renumbering(inputs, sources, diagnostics);
  std::vector<std::optional<std::string>> out = renumbering.run();
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto& [file, options] = inputs[i];
    if (!options.range || renumbering.ranged(i) || file->hasErrors || diagnostics.hasErrors()) continue;
    diagnostics.report<diag::NotRenumbered>(
        {file->file, 0, 0}, fmt::format("--range {}:{}", options.range->first, options.range->second),
        "names blocks that no program of the file has in this order",
        "name the numbers of two blocks of one program");
    out[i].reset();
  }
  return out;
}

std::optional<std::string> renumber(const File& file, const RenumberOptions& options,
                                    const SourceMap& sources, Diagnostics& diagnostics) {
  const RenumberInput input{&file, options};
  return std::move(renumber(std::span(&input, 1), sources, diagnostics).front());
}

} // namespace dotek::frontend::macrob
