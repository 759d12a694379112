#include "backends/fanuc/ProgramResults.h"

#include "backends/common/MovedMacros.h"
#include "backends/fanuc/ProgramVariables.h"
#include "ir/Dataflow.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"
#include "stdlib/CalledProgram.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace dotek::backends::fanuc {

namespace {

constexpr std::uint32_t kFirstSystem = 1000;
constexpr std::uint32_t kSkipAxes = 6;

std::optional<std::uint32_t> wholeOf(const ir::ExpressionPtr& expression) {
  const double* value = expression ? ir::constantValue(expression) : nullptr;
  if (value == nullptr || *value < 0 || *value > 99999999) return std::nullopt;
  return static_cast<std::uint32_t>(std::lround(*value));
}

bool within(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& ranges, std::uint32_t variable) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [&](const auto& range) { return range.first <= variable && variable <= range.second; });
}

// The macros work there, or leave a result there.
bool uses(const stdlib::MacroSet& set, std::uint32_t variable) {
  return within(set.scratch, variable) ||
         std::any_of(set.signatures.begin(), set.signatures.end(), [&](const stdlib::MacroSignature& one) {
           return std::any_of(one.results.begin(), one.results.end(),
                              [&](const stdlib::MacroResult& result) { return result.variable == variable; });
         });
}

// Who may have set a variable last: the index of a call, or one of these.
enum : int { kEntry = -1, kOwn = -2, kOutside = -3 };
using Setters = std::set<int>;
using Fact = std::vector<Setters>; // by index of the variable

class Results {
public:
  Results(ir::Program& program, const ir::ProgramFile& file, const TranslateSettings& settings,
          Diagnostics& diagnostics)
      : program_(program), file_(file), settings_(settings), diagnostics_(diagnostics) {}

  void run() {
    findNumbers();
    findCalls();
    auto facts = ir::factsBefore<Fact>(
        program_.body, Fact(numbers_.size(), Setters{kEntry}),
        [&](std::size_t at, std::size_t, const Fact& fact) { return behind(at, fact); },
        [](Fact& into, const Fact& other) {
          bool changed = false;
          for (std::size_t i = 0; i < into.size(); ++i)
            for (const int one : other[i])
              changed = into[i].insert(one).second || changed;
          return changed;
        });
    const std::vector<ir::ProgramStatement> source = program_.body; // calls as they were
    source_ = &source;
    for (std::size_t at = 0; at < program_.body.size(); ++at) {
      fact_ = facts[at] ? *facts[at] : Fact(numbers_.size(), Setters{kOutside});
      statement(program_.body[at]);
    }
  }

private:
  const stdlib::MacroSet& from() const { return settings_.source; }
  const stdlib::MacroSet& to() const { return settings_.target; }

  bool isSkip(std::uint32_t variable) const {
    const std::optional<int>& first = settings_.control.variables.skip;
    return first && variable >= static_cast<std::uint32_t>(*first) &&
           variable < static_cast<std::uint32_t>(*first) + kSkipAxes;
  }
  bool concerns(std::uint32_t variable) const {
    return uses(from(), variable) || uses(to(), variable) || isSkip(variable);
  }

  // ---- who sets what

  void findNumbers() {
    const auto add = [&](std::optional<std::uint32_t> number) {
      if (number && concerns(*number)) indices_.try_emplace(*number, 0);
    };
    for (const ir::ProgramStatement& statement : program_.body) {
      ir::eachNode(statement, [&](const ir::Expression& node) {
        if (const auto* machine = std::get_if<ir::MachineVariable>(&node.node)) add(wholeOf(machine->number));
      });
      if (const auto* print = std::get_if<ir::Print>(&statement.node))
        for (const ir::PrintPiece& piece : print->pieces)
          add(piece.number);
    }
    if (indices_.empty()) return;
    for (const stdlib::MacroSignature& signature : to().signatures)
      for (const stdlib::MacroResult& result : signature.results)
        add(result.variable);
    for (auto& [number, index] : indices_) {
      index = numbers_.size();
      numbers_.push_back(number);
    }
  }

  // Calls that leave the same after it count as one.
  void findCalls() {
    findKeeping();
    std::map<std::string, int> first;
    for (std::size_t at = 0; at < program_.body.size(); ++at) {
      const auto* call = std::get_if<ir::Call>(&program_.body[at].node);
      if (call == nullptr || call->kind == ir::CallKind::Off) continue;
      const auto number = calledProgram(*call, settings_.control);
      if (!number || !from().calls(*number)) {
        const bool modal = call->kind == ir::CallKind::AfterMoves || call->kind == ir::CallKind::EachBlock;
        modal_ = modal_ || (modal && !keeps(*call));
        continue;
      }
      std::string key = fmt::format("{}{}", *number, call->repeats ? "L" : "");
      for (const ir::CallArgument& argument : call->arguments)
        key += fmt::format(" {}{}", argument.letter, argument.local);
      calls_[at] = first.try_emplace(key, static_cast<int>(at)).first->second;
    }
    for (const ir::Program& one : file_.programs)
      for (const ir::ProgramStatement& statement : one.body)
        if (const auto* exit = std::get_if<ir::Exit>(&statement.node))
          returnsElsewhere_ = returnsElsewhere_ || exit->block != nullptr;
  }

  bool keeps(const ir::Call& call) const {
    const auto number = calledProgram(call, settings_.control);
    return number && keeps_.contains(*number);
  }
  // Programs of the file that neither measure, nor store such a variable, nor call one that is not there or
  // does so.
  void findKeeping() {
    for (const ir::Program& one : file_.programs)
      if (one.number != 0 && one.number <= UINT32_MAX) keeps_.insert(static_cast<std::uint32_t>(one.number));
    for (bool changed = true; changed;) {
      changed = false;
      for (const ir::Program& one : file_.programs) {
        const bool keep =
            std::all_of(one.body.begin(), one.body.end(), [&](const ir::ProgramStatement& statement) {
              return match(
                  statement,
                  [&](const ir::Store& node) {
                    const auto stored = wholeOf(node.number);
                    return stored && !concerns(*stored);
                  },
                  [&](const ir::Call& node) { return node.kind == ir::CallKind::Off || keeps(node); },
                  [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Comment, ir::NcBlock, ir::JumpTo,
                                     ir::Loop, ir::LoopEnd, ir::Exit, ir::Raise, ir::Notice, ir::Port,
                                     ir::Print, ir::NameVariables> auto&) { return true; });
            });
        changed = (!keep && keeps_.erase(static_cast<std::uint32_t>(one.number)) != 0) || changed;
      }
    }
  }

  Fact behind(std::size_t at, const Fact& before) {
    Fact fact = before;
    const ir::ProgramStatement& statement = program_.body[at];
    const bool maybe = statement.blockDelete != 0;
    const auto set = [&](std::size_t index, int setter, bool alone) {
      if (alone && !maybe) fact[index].clear();
      fact[index].insert(setter);
    };
    match(
        statement,
        [&](const ir::Call& node) {
          const auto known = calls_.find(at);
          const bool outside = known == calls_.end() && node.kind != ir::CallKind::Off && !keeps(node);
          for (std::size_t i = 0; i < fact.size() && (outside || known != calls_.end()); ++i)
            set(i, outside ? kOutside : known->second, true);
        },
        [&](const ir::Store& node) {
          const auto number = wholeOf(node.number);
          if (const auto found = number ? indices_.find(*number) : indices_.end(); found != indices_.end())
            set(found->second, kOwn, true);
        },
        [&](const ir::NcBlock& node) {
          for (std::size_t i = 0; i < fact.size(); ++i) {
            if (isSkip(numbers_[i]) && skips(node)) set(i, kOwn, true);
            if (modal_) set(i, kOutside, false);
          }
        },
        [&](const ir::Label&) {
          for (std::size_t i = 0; i < fact.size() && returnsElsewhere_; ++i)
            set(i, kOutside, false);
        },
        [](const ir::OneOf<ir::Jump, ir::Branch, ir::Comment, ir::JumpTo, ir::Loop, ir::LoopEnd, ir::Exit,
                           ir::Raise, ir::Notice, ir::Port, ir::Print, ir::NameVariables> auto&) {});
    return fact;
  }

  bool skips(const ir::NcBlock& block) const {
    return std::any_of(block.words.begin(), block.words.end(), [&](const ir::Word& word) {
      const double* value = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
      if (value == nullptr || *value < 0 || *value > 9999) return false;
      const auto* code = settings_.control.find('G', static_cast<std::uint32_t>(std::lround(*value * 10)));
      return code != nullptr && code->function == stdlib::Function::Skip;
    });
  }

  // ---- reads and stores

  void statement(ir::ProgramStatement& statement) {
    range_ = statement.origin.range();
    if (const auto* store = std::get_if<ir::Store>(&statement.node)) stored(*store);
    ir::rewrite(statement, [&](const ir::ExpressionPtr& expression) { return used(expression); });
    if (auto* print = std::get_if<ir::Print>(&statement.node))
      for (ir::PrintPiece& piece : print->pieces)
        if (piece.number) piece.number = there(*piece.number, range_);
  }

  ir::ExpressionPtr used(const ir::ExpressionPtr& expression) {
    const auto* machine = std::get_if<ir::MachineVariable>(&expression->node);
    if (machine == nullptr) return expression;
    const SourceRange range = expression->range.hasPlace() ? expression->range : range_;
    const auto number = wholeOf(machine->number);
    if (!number) {
      computed(machine->number, range);
      return expression;
    }
    const std::uint32_t moved = there(*number, range);
    if (moved == *number) return expression;
    return ir::machineVariable(ir::constant(moved, machine->number->range, std::to_string(moved)),
                               expression->range);
  }

  void refuse(SourceRange range, const std::string& why) {
    diagnostics_.report<diag::ResultNotTranslated>(range, to().name, why);
  }

  // The variable that holds in the result what `number` holds in the source.
  std::uint32_t there(std::uint32_t number, SourceRange range) {
    const auto found = indices_.find(number);
    if (found == indices_.end()) return number;
    std::set<std::uint32_t> variables;
    for (const int setter : fact_[found->second]) {
      const TranslatedVariable one = behindSetter(number, setter);
      if (!one.refusal.empty()) {
        refuse(range, one.refusal);
        return number;
      }
      variables.insert(one.variable);
    }
    if (variables.size() == 1 && *variables.begin() == number) return number;
    const bool moved = variables.size() == 1 && isOfCalls(*variables.begin());
    if (!moved) {
      refuse(range,
             fmt::format("what #{} holds is in #{} then, by the path that led here or by what the program "
                         "stores there",
                         number, fmt::join(variables, ", #")));
      return number;
    }
    diagnostics_.report<diag::ResultMoved>(range, number, to().title, *variables.begin());
    return *variables.begin();
  }

  bool isOfCalls(std::uint32_t number) const {
    const auto found = indices_.find(number);
    return found != indices_.end() && std::all_of(fact_[found->second].begin(), fact_[found->second].end(),
                                                  [](int setter) { return setter >= 0; });
  }

  TranslatedVariable behindSetter(std::uint32_t number, int setter) {
    if (setter == kOwn) return {"", number};
    if (setter >= 0) {
      const ir::ProgramStatement& call = (*source_)[static_cast<std::size_t>(setter)];
      if (!isSkip(number)) return translateResult(std::get<ir::Call>(call.node), number, settings_);
      return {fmt::format("#{} is where the last touch of a macro ended, and other macros touch otherwise",
                          number),
              0};
    }
    if (isSkip(number)) return {"", number};
    if (setter == kOutside)
      return {fmt::format("a program that is called on the path here may have measured, or may have set #{}",
                          number),
              0};
    if (uses(from(), number))
      return {fmt::format("no probing call comes before on each path here, so what #{} holds is not known",
                          number),
              0};
    return {fmt::format("the macros of `{}` overwrite #{}, which the program does not set before", to().name,
                        number),
            0};
  }

  void stored(const ir::Store& store) {
    const auto number = wholeOf(store.number);
    if (!number) return computed(store.number, range_);
    if (to().keepsCalibration(*number)) {
      diagnostics_.report<diag::StoreCalibration>(range_, *number, to().title,
                                                  storeRemedy(to(), settings_.control, numbersOf(file_)));
    } else if (uses(to(), *number) && !uses(from(), *number)) {
      if (told_.insert(*number).second) diagnostics_.report<diag::StoreScratch>(range_, *number, to().title);
    } else if (from().keepsCalibration(*number) || from().probing.feedVariable == *number) {
      if (told_.insert(*number).second)
        diagnostics_.report<diag::StoreForSource>(range_, *number, from().title, to().title);
    }
  }

  // #[600+#1]: above all that either set uses as long as #1 counts up.
  void computed(const ir::ExpressionPtr& number, SourceRange range) {
    const std::optional<std::uint32_t> base = ir::firstNumber(number);
    if (base && *base >= kFirstSystem) return;
    std::uint32_t last = 0;
    for (const stdlib::MacroSet* set : {&from(), &to()}) {
      for (const auto& [begin, end] : set->scratch)
        last = std::max(last, end);
      for (const stdlib::MacroSignature& signature : set->signatures)
        for (const stdlib::MacroResult& result : signature.results)
          last = std::max(last, result.variable);
    }
    if (!base || *base <= last)
      diagnostics_.report<diag::ResultNumberComputed>(range, from().title, to().title, last);
    else if (told_.insert(0).second)
      diagnostics_.report<diag::ResultNumberOpen>(range, last);
  }

  ir::Program& program_;
  const ir::ProgramFile& file_;
  const TranslateSettings& settings_;
  Diagnostics& diagnostics_;
  std::map<std::uint32_t, std::size_t> indices_; // of the variables that are followed
  std::vector<std::uint32_t> numbers_;           // by index
  std::map<std::size_t, int> calls_;             // probing calls: the first that leaves the same
  std::set<std::uint32_t> keeps_;                // programs of the file that leave all of them alone
  bool modal_ = false;                           // a G66 may run something after any move
  bool returnsElsewhere_ = false;                // a program of the file ends with M99 P
  const std::vector<ir::ProgramStatement>* source_ = nullptr;
  Fact fact_; // before the statement
  SourceRange range_;
  std::set<std::uint32_t> told_; // variables; 0: a computed number
};

} // namespace

std::optional<std::uint32_t> calledProgram(const ir::Call& call, const stdlib::Control& control) {
  const auto number = wholeOf(call.program);
  if (!number || *number == 0) return std::nullopt;
  const bool counts = call.kind == ir::CallKind::Subprogram && !call.repeats;
  return counts ? static_cast<std::uint32_t>(stdlib::subprogramCall(*number, control).program) : *number;
}

void translateResults(ir::Program& program, const ir::ProgramFile& file, const TranslateSettings& settings,
                      Diagnostics& diagnostics) {
  Results(program, file, settings, diagnostics).run();
}

} // namespace dotek::backends::fanuc
