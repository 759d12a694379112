#include "sim/machine/SafeMoves.h"

#include "ir/Extremes.h"
#include "ir/Walk.h"
#include "sim/machine/BackJumps.h"
#include "sim/machine/SkipWants.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string_view>

namespace dotek::sim {
namespace {

// Where the last block ended, the machine and the tool are, and the last skip signal came: an axis each.
constexpr double kFirstPlace = 5001, kFirstSkip = 5061, kLastSkip = 5080;
constexpr std::size_t kAxesOfKind = 20;
constexpr std::uint64_t kFirstCommon = 100;
constexpr double kFirstOffset = 2000; // locals and common variables are below

bool does(const ir::ProgramStatement& statement, stdlib::Function function, const stdlib::Control& control) {
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  return block != nullptr && std::any_of(block->words.begin(), block->words.end(), [&](const ir::Word& word) {
           const double* code = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
           if (code == nullptr || !(*code >= 0 && *code < 1e5)) return false;
           const stdlib::CodeInfo* info =
               control.find('G', static_cast<std::uint32_t>(std::lround(*code * 10)));
           return info != nullptr && info->function == function;
         });
}

enum class Reads : std::uint8_t { Other, Place, Skip };

// What the variable of this number holds of a move that has ended, and of which axis; of a computed number
// the constant that it counts from decides, and without one it may be any.
Reads readsWhat(const ir::MachineVariable& variable, std::optional<std::size_t>& axis) {
  if (const double* number = ir::constantValue(variable.number)) {
    if (!(*number >= kFirstPlace && *number <= kLastSkip)) return Reads::Other;
    axis = static_cast<std::size_t>(*number - kFirstPlace) % kAxesOfKind;
    return *number >= kFirstSkip ? Reads::Skip : Reads::Place;
  }
  const std::optional<std::uint32_t> first = ir::firstNumber(variable.number);
  if (!first) return Reads::Skip;
  const double least = *first;
  return least < kFirstPlace - 1 || least > kLastSkip ? Reads::Other
         : least >= kFirstSkip - 1                    ? Reads::Skip
                                                      : Reads::Place;
}

struct Ended {
  bool skip = false;
  std::bitset<kAxesOfKind> places; // by axis
};
Ended endsRead(const ir::ProgramStatement& statement) {
  Ended out;
  ir::eachNode(statement, [&](const ir::Expression& node) {
    const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
    if (variable == nullptr) return;
    std::optional<std::size_t> axis;
    const Reads what = readsWhat(*variable, axis);
    if (what == Reads::Skip) out.skip = true;
    if (what == Reads::Place && axis) out.places.set(*axis);
    if (what == Reads::Place && !axis) out.places.set();
  });
  return out;
}

constexpr std::string_view kAxisAddresses = "XYZ";

// The axes that a block names, by their place among the variables of positions.
std::bitset<kAxesOfKind> axesOf(const ir::ProgramStatement& statement) {
  std::bitset<kAxesOfKind> out;
  if (const auto* block = std::get_if<ir::NcBlock>(&statement.node))
    for (const ir::Word& word : block->words)
      if (const std::size_t axis = kAxisAddresses.find(word.address); axis != std::string_view::npos)
        out.set(axis);
  return out;
}

// Afterwards the machine may be elsewhere.
bool mayMove(const ir::ProgramStatement& statement) {
  if (std::holds_alternative<ir::Call>(statement.node)) return true;
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  return block != nullptr && std::any_of(block->words.begin(), block->words.end(), [](const ir::Word& word) {
           return std::string_view("ABCUVWXYZ").find(word.address) != std::string_view::npos;
         });
}

// The condition of the statement, where it asks about what it compares: a search for the greatest or the
// least value does not. nullptr: none.
const ir::ConditionPtr* questionAt(const std::vector<ir::ProgramStatement>& body, std::size_t at) {
  const ir::ConditionPtr* condition = ir::conditionOf(body[at]);
  return condition == nullptr || !*condition || ir::keepsExtreme(body, at) ? nullptr : condition;
}

BlockSet::value_type blockOf(const ir::ProgramStatement& statement) {
  const SourceRange range = statement.origin.range();
  return {range.file, range.begin};
}

// A variable: its number, or the constant that its computed number counts from. nothing: it may be any.
std::optional<std::uint64_t> keyOf(const ir::ExpressionPtr& number) {
  constexpr std::uint64_t kComputed = std::uint64_t(1) << 32;
  if (const double* value = ir::constantValue(number))
    return *value >= 0 && *value < 1e9 ? std::optional(static_cast<std::uint64_t>(std::lround(*value)))
                                       : std::nullopt;
  const std::optional<std::uint32_t> first = ir::firstNumber(number);
  return first ? std::optional(kComputed + *first) : std::nullopt;
}

// Follows copies of where skip moves have ended through one program, in the order of the text.
class Copies {
public:
  explicit Copies(const ir::Program& program) : program_(program) {
    std::map<ir::LabelId, std::size_t> labels;
    for (std::size_t i = 0; i < program.body.size(); ++i)
      if (const auto* label = std::get_if<ir::Label>(&program.body[i].node)) labels[label->label] = i;
    for (std::size_t i = 0; i < program.body.size(); ++i) {
      if (const auto target = jumpOf(program.body[i]))
        if (const auto label = labels.find(*target); label != labels.end()) jumps_.add(i, label->second);
      const ir::ConditionPtr* condition = questionAt(program.body, i);
      if (condition == nullptr) continue;
      ir::eachNode(*condition, [&](const ir::Expression& node) {
        const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
        const auto key = variable == nullptr ? std::nullopt : keyOf(variable->number);
        if (key && (readers_[*key].empty() || readers_[*key].back() != i)) readers_[*key].push_back(i);
      });
    }
    jumps_.close();
  }

  // `tests`: whether the program of this number has a condition that reads this local.
  void follow(const std::function<bool(std::uint64_t program, std::uint32_t local)>& tests) {
    now_.clear();
    for (std::size_t at = 0; at < program_.body.size(); ++at)
      step(at, tests);
    for (const auto& [key, copy] : now_)
      askAgain(key, copy, program_.body.size());
  }

  BlockSet asking;
  std::map<std::uint64_t, BlockSet> held; // blocks whose copies a variable has held at some time
  std::set<std::uint64_t> tested;         // variables that a condition reads
  bool sharesLocals = false;              // M98

private:
  // Blocks whose copies this value comes from; a position that `here` reads is one of its own.
  template <class Tree> BlockSet sources(const Tree& tree, const BlockSet::value_type& here) const {
    BlockSet out;
    ir::eachNode(tree, [&](const ir::Expression& node) {
      const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
      if (variable == nullptr) return;
      std::optional<std::size_t> axis;
      if (readsWhat(*variable, axis) != Reads::Other) out.insert(here);
      const std::optional<std::uint64_t> key = keyOf(variable->number);
      if (const auto found = key ? now_.find(*key) : now_.end(); found != now_.end())
        out.insert(found->second.blocks.begin(), found->second.blocks.end());
    });
    return out;
  }
  void ask(std::size_t at) {
    if (const ir::ConditionPtr* condition = questionAt(program_.body, at))
      asking.merge(sources(*condition, blockOf(program_.body[at])));
  }
  // What a variable holds, and since which statement.
  struct Copy {
    BlockSet blocks;
    std::size_t since = 0;
  };
  // Conditions before a jump that leads back to them see what the variable holds there. `until`: the
  // statement that writes the next copy.
  void askAgain(std::uint64_t key, const Copy& copy, std::size_t until) {
    const auto found = readers_.find(key);
    if (copy.blocks.empty() || found == readers_.end()) return;
    const std::vector<std::size_t>& readers = found->second;
    // Between two conditions the first of them is the last one before each jump.
    auto next = std::upper_bound(readers.begin(), readers.end(), copy.since);
    for (std::size_t from = copy.since; from < until; ++next) {
      const bool last = next == readers.end() || *next >= until;
      if (next != readers.begin() && jumps_.leastTarget(from, last ? until : *next + 1) <= *std::prev(next)) {
        asking.insert(copy.blocks.begin(), copy.blocks.end());
        return;
      }
      if (last) return;
      from = *next;
    }
  }
  static std::optional<ir::LabelId> jumpOf(const ir::ProgramStatement& statement) {
    if (const auto* jump = std::get_if<ir::Jump>(&statement.node)) return jump->target;
    if (const auto* branch = std::get_if<ir::Branch>(&statement.node)) return branch->target;
    if (const auto* end = std::get_if<ir::LoopEnd>(&statement.node)) return end->begin;
    return std::nullopt;
  }
  template <class Tests> void step(std::size_t at, const Tests& tests) {
    const ir::ProgramStatement& statement = program_.body[at];
    const BlockSet::value_type here = blockOf(statement);
    if (const ir::ConditionPtr* condition = questionAt(program_.body, at)) {
      ir::eachNode(*condition, [&](const ir::Expression& node) {
        const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
        if (const auto key = variable == nullptr ? std::nullopt : keyOf(variable->number))
          tested.insert(*key);
      });
      ask(at);
    }
    if (const auto* store = std::get_if<ir::Store>(&statement.node)) {
      const std::optional<std::uint64_t> key = keyOf(store->number);
      if (!key) return;
      Copy copy{sources(store->value, here), at};
      Copy& now = now_[*key];
      askAgain(*key, now, at);
      now = std::move(copy);
      held[*key].insert(now.blocks.begin(), now.blocks.end());
    }
    if (const auto* call = std::get_if<ir::Call>(&statement.node)) {
      sharesLocals = sharesLocals || call->kind == ir::CallKind::Subprogram;
      const double* number = call->program ? ir::constantValue(call->program) : nullptr;
      for (const ir::CallArgument& argument : call->arguments)
        if (number != nullptr && *number >= 0 && *number < 1e9 &&
            tests(static_cast<std::uint64_t>(std::lround(*number)), argument.local))
          asking.merge(sources(argument.value, here));
    }
  }

  const ir::Program& program_;
  BackJumps jumps_;
  std::map<std::uint64_t, std::vector<std::size_t>> readers_; // conditions by the variables that they read
  std::map<std::uint64_t, Copy> now_;
};

// A store whose variable conditions alone read, up to the next store into it: `#651=#5063-#5083`, and
// `IF[#651 GT 2.]GOTO 800`. The first of these conditions; nothing: the value is kept.
std::optional<std::size_t> askedAlone(const std::vector<ir::ProgramStatement>& body, std::size_t store) {
  const auto* kept = std::get_if<ir::Store>(&body[store].node);
  const auto key =
      kept == nullptr || ir::constantValue(kept->number) == nullptr ? std::nullopt : keyOf(kept->number);
  if (!key) return std::nullopt;
  constexpr std::size_t kFar = 4000; // statements; farther away a value that is not kept is not looked for
  std::optional<std::size_t> out;
  for (std::size_t i = store + 1; i < body.size(); ++i) {
    if (i - store > kFar) return std::nullopt;
    bool reads = false;
    ir::eachNode(body[i], [&](const ir::Expression& node) {
      const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
      reads = reads || (variable != nullptr && keyOf(variable->number) == key);
    });
    if (reads && questionAt(body, i) == nullptr) return std::nullopt;
    if (reads && !out) out = i;
    const auto* next = std::get_if<ir::Store>(&body[i].node);
    if (next != nullptr && keyOf(next->number) == key) break;
  }
  return out;
}

} // namespace

BlockSet safeMoves(const std::vector<const ir::Program*>& programs, const stdlib::Control& control) {
  BlockSet out;
  for (const ir::Program* program : programs) {
    const auto& body = program->body;
    std::set<std::size_t> watched;
    const auto skipBetween = [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i)
        if (does(body[i], stdlib::Function::Skip, control)) return true;
      return false;
    };
    for (std::size_t at = 0; at < body.size(); ++at) {
      if (!does(body[at], stdlib::Function::Skip, control)) continue;
      const auto axes = axesOf(body[at]);
      bool compared = false, kept = false, moved = false;
      for (std::size_t i = at + 1; i < body.size() && !kept; ++i) {
        if (does(body[i], stdlib::Function::Skip, control)) break;
        const Ended read = endsRead(body[i]);
        if (read.skip || (!moved && (read.places & axes).any())) {
          const std::optional<std::size_t> asked = askedAlone(body, i);
          const bool asks = questionAt(body, i) != nullptr || (asked && !skipBetween(i, *asked));
          (asks ? compared : kept) = true;
        }
        moved = moved || mayMove(body[i]);
      }
      if (compared && !kept) watched.insert(at);
    }
    const std::set<std::size_t> touches = wantingContact(*program, watched, control);
    for (const std::size_t at : watched)
      if (!touches.contains(at)) out.insert(blockOf(body[at]));
  }
  return out;
}

BlockSet askingBlocks(const std::vector<const ir::Program*>& programs) {
  std::map<std::uint64_t, std::set<std::uint64_t>> testedBy; // by O number
  std::vector<Copies> all;
  for (const ir::Program* program : programs)
    all.emplace_back(*program);
  for (const bool calls : {false, true}) { // conditions of all programs are known the second time
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].follow([&](std::uint64_t program, std::uint32_t local) {
        const auto found = testedBy.find(program);
        return calls && found != testedBy.end() && found->second.contains(local);
      });
      if (programs[i]->number != 0) testedBy[programs[i]->number] = all[i].tested;
    }
  }
  const bool locals = std::any_of(all.begin(), all.end(), [](const Copies& one) { return one.sharesLocals; });
  std::map<std::uint64_t, std::size_t> testing; // how many programs test a variable
  for (const Copies& one : all)
    for (const std::uint64_t key : one.tested)
      ++testing[key];
  BlockSet out;
  for (Copies& one : all) {
    // What one program keeps in a common variable another one may look at.
    for (const auto& [key, blocks] : one.held) {
      const auto found = testing.find(key);
      const std::size_t own = one.tested.contains(key) ? 1 : 0;
      if ((key >= kFirstCommon || locals) && found != testing.end() && found->second > own)
        out.insert(blocks.begin(), blocks.end());
    }
    out.merge(one.asking);
  }
  return out;
}

std::set<std::uint32_t> neverSet(const std::vector<const ir::Program*>& programs) {
  constexpr double kFirstShared = 34, kLastShared = 999;
  std::set<std::uint32_t> out, set;
  const auto put = [&](std::set<std::uint32_t>& into, const ir::ExpressionPtr& number) {
    const double* value = number ? ir::constantValue(number) : nullptr;
    if (value != nullptr && *value >= kFirstShared && *value <= kLastShared)
      into.insert(static_cast<std::uint32_t>(std::lround(*value)));
  };
  for (const ir::Program* program : programs)
    for (const ir::ProgramStatement& statement : program->body) {
      ir::eachNode(statement, [&](const ir::Expression& node) {
        if (const auto* variable = std::get_if<ir::MachineVariable>(&node.node)) put(out, variable->number);
      });
      if (const auto* store = std::get_if<ir::Store>(&statement.node)) put(set, store->number);
      if (const auto* print = std::get_if<ir::Print>(&statement.node))
        for (const ir::PrintPiece& piece : print->pieces)
          if (piece.number && *piece.number >= kFirstShared && *piece.number <= kLastShared)
            out.insert(*piece.number);
    }
  for (const std::uint32_t number : set)
    out.erase(number);
  return out;
}

bool mayWriteOffsets(const std::vector<const ir::Program*>& programs, const stdlib::Control& control) {
  return std::any_of(programs.begin(), programs.end(), [&](const ir::Program* program) {
    return std::any_of(program->body.begin(), program->body.end(), [&](const ir::ProgramStatement& one) {
      if (does(one, stdlib::Function::DataInput, control)) return true;
      const auto* store = std::get_if<ir::Store>(&one.node);
      const double* number = store == nullptr ? nullptr : ir::constantValue(store->number);
      return store != nullptr && (number == nullptr || *number >= kFirstOffset);
    });
  });
}

} // namespace dotek::sim
