#include "verify/Variables.h"

#include "ir/Dataflow.h"
#include "ir/Walk.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

namespace dotek::verify {

namespace {

constexpr std::uint32_t kBehind = 9; // variables after the constant of a computed number
constexpr double kStep = 0.001;

// The number of a variable that the text names; nothing: it is computed.
std::optional<std::uint32_t> numberOf(const ir::ExpressionPtr& number) {
  const double* value = number ? ir::constantValue(number) : nullptr;
  if (value == nullptr || !(*value >= 0) || *value > 99999999) return std::nullopt;
  return static_cast<std::uint32_t>(std::lround(*value));
}

struct Operands {
  std::set<std::uint32_t> variables;
  std::set<double> constants;
};

// What an expression or a condition is made of; numbers of variables are no constants of it.
template <class Tree> Operands operandsOf(const Tree& tree) {
  Operands out;
  std::set<const ir::Expression*> numbers;
  ir::eachNode(tree, [&](const ir::Expression& node) {
    if (const auto* use = std::get_if<ir::MachineVariable>(&node.node)) {
      if (use->number) numbers.insert(use->number.get());
      if (const auto number = numberOf(use->number)) out.variables.insert(*number);
    } else if (const auto* constant = std::get_if<ir::Constant>(&node.node);
               constant && !numbers.contains(&node)) {
      out.constants.insert(constant->value);
    }
  });
  return out;
}

class Walk {
public:
  Walk(const ir::ProgramFile& file, const stdlib::Control& control,
       const std::vector<const stdlib::MacroSet*>& sets)
      : file_(file), control_(control), sets_(sets) {}

  std::vector<ProgramVariable> run() {
    for (std::size_t i = 0; i < file_.programs.size(); ++i)
      readsOf(file_.programs[i], i == 0);
    for (const ir::Program& program : file_.programs)
      for (const ir::ProgramStatement& statement : program.body)
        usesIn(statement);
    std::vector<ProgramVariable> out;
    for (const auto& [number, variable] : found_)
      out.push_back(variable);
    return out;
  }

private:
  using Written = std::set<std::uint32_t>;

  void readsOf(const ir::Program& program, bool main) {
    const auto behind = [&](std::size_t at, std::size_t, Written fact) {
      const ir::ProgramStatement& statement = program.body[at];
      const auto* store = std::get_if<ir::Store>(&statement.node);
      if (store != nullptr && statement.blockDelete == 0)
        if (const auto number = numberOf(store->number)) fact.insert(*number);
      return fact;
    };
    const auto meet = [](Written& into, const Written& other) {
      const std::size_t before = into.size();
      std::erase_if(into, [&](std::uint32_t number) { return !other.contains(number); });
      return into.size() != before;
    };
    const auto facts = ir::factsBefore<Written>(program.body, {}, behind, meet);
    for (std::size_t i = 0; i < program.body.size(); ++i) {
      if (!facts[i]) continue; // no path leads there
      ir::eachNode(program.body[i], [&](const ir::Expression& node) {
        const auto* use = std::get_if<ir::MachineVariable>(&node.node);
        if (use == nullptr) return;
        const auto number = numberOf(use->number);
        if (!number)
          addComputed(use->number);
        else if (!main || !facts[i]->contains(*number))
          add(*number, main);
      });
    }
  }

  void add(std::uint32_t number, bool main) {
    const bool local = number >= 1 && number <= control_.locals;
    const bool known = local ? main : control_.isCommon(number) || isSignal(number);
    if (!known) return;
    for (const stdlib::MacroSet* set : sets_)
      if (sets_.size() > 1 ? usesVariable(*set, number) : needsVariable(*set, number)) return;
    ProgramVariable& variable = found_[number];
    variable.number = number;
    variable.local = local;
    if (isSignal(number)) variable.use = VariableUse::Signal;
  }

  void addComputed(const ir::ExpressionPtr& number) {
    for (const double constant : operandsOf(number).constants) {
      if (constant < 1 || constant > 99999 || constant != std::floor(constant)) continue;
      const auto first = static_cast<std::uint32_t>(constant);
      for (std::uint32_t n = first; n <= first + kBehind; ++n)
        if (control_.isCommon(n)) add(n, false);
    }
  }

  // An input of the machine whose state nothing tells.
  bool isSignal(std::uint32_t number) const {
    return std::any_of(control_.state.begin(), control_.state.end(), [&](const stdlib::StateRange& range) {
      return range.first <= number && number <= range.last && range.word && !range.initial && !range.null &&
             range.access == stdlib::StateRange::Access::ReadOnly;
    });
  }

  void mark(const ir::ExpressionPtr& expression, VariableUse use) {
    if (!expression) return;
    for (const std::uint32_t number : operandsOf(expression).variables)
      if (const auto at = found_.find(number); at != found_.end())
        at->second.use = std::max(at->second.use, use);
  }

  void usesIn(const ir::ProgramStatement& statement) {
    ir::eachNode(statement, [&](const ir::Expression& node) {
      if (const auto* use = std::get_if<ir::MachineVariable>(&node.node))
        mark(use->number, VariableUse::Whole);
    });
    match(
        statement,
        [&](const ir::OneOf<ir::Store, ir::JumpTo> auto& node) { mark(node.number, VariableUse::Whole); },
        [&](const ir::NcBlock& node) {
          for (const ir::Word& word : node.words)
            mark(word.value, useOfLetter(word.address));
        },
        [&](const ir::Call& node) {
          mark(node.program, VariableUse::Whole);
          mark(node.repeats, VariableUse::Whole);
          for (const ir::CallArgument& argument : node.arguments)
            mark(argument.value, useOfArgument(node, argument.letter));
        },
        [&](const ir::Branch& node) { compared(node.condition); },
        [&](const ir::Loop& node) {
          if (node.condition) compared(node.condition);
        },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Move, ir::Measure, ir::ProbePower, ir::Comment,
                           ir::LoopEnd, ir::Exit, ir::Raise, ir::Notice, ir::Port, ir::Print,
                           ir::NameVariables> auto&) {});
  }

  static VariableUse useOfLetter(char letter) {
    if (letter == 'F') return VariableUse::Feed;
    return ir::isAddressIn(ir::kWholeAddresses, letter) ? VariableUse::Whole : VariableUse::Length;
  }

  VariableUse useOfArgument(const ir::Call& call, char letter) const {
    const auto program = numberOf(call.program);
    if (!program) return VariableUse::Length;
    for (const stdlib::MacroSet* set : sets_) {
      for (const stdlib::MacroSignature* signature : set->of(*program)) {
        if (const stdlib::MacroArgument* argument = signature->find(letter)) return useOfRole(*argument);
      }
    }
    return VariableUse::Length;
  }

  static VariableUse useOfRole(const stdlib::MacroArgument& argument) {
    using Role = stdlib::ArgumentRole;
    if (argument.role == Role::System)
      return argument.systemCode == stdlib::SystemCode::Index ? VariableUse::SystemIndex
                                                              : VariableUse::System;
    if (argument.selector) return VariableUse::Whole;
    if (argument.kind == ir::Kind::Feed) return VariableUse::Feed;
    if (argument.kind == ir::Kind::Angle) return VariableUse::Angle;
    const bool isSigned = argument.role == Role::Target || argument.role == Role::Nominal ||
                          argument.role == Role::Depth || argument.role == Role::Point;
    return isSigned ? VariableUse::Length : VariableUse::Size;
  }

  void compared(const ir::ConditionPtr& condition) {
    if (const auto* junction = std::get_if<ir::Junction>(&condition->node)) {
      compared(junction->left);
      compared(junction->right);
      return;
    }
    if (const auto* inner = std::get_if<ir::Not>(&condition->node)) return compared(inner->inner);
    const Operands operands = operandsOf(condition);
    bool null = std::holds_alternative<ir::IsNull>(condition->node);
    ir::eachNode(condition, [&](const ir::Expression& node) {
      null = null || std::holds_alternative<ir::NullValue>(node.node);
    });
    null = null || operands.variables.contains(0); // #0
    for (const std::uint32_t number : operands.variables) {
      const auto at = found_.find(number);
      if (at == found_.end()) continue;
      at->second.askedForNull = at->second.askedForNull || null;
      at->second.constants.insert(operands.constants.begin(), operands.constants.end());
    }
  }

  const ir::ProgramFile& file_;
  const stdlib::Control& control_;
  const std::vector<const stdlib::MacroSet*>& sets_;
  std::map<std::uint32_t, ProgramVariable> found_;
};

bool holds(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& ranges, std::uint32_t number) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [&](const auto& range) { return range.first <= number && number <= range.second; });
}

double toStep(double value) {
  return std::round(value / kStep) * kStep;
}

double nthOf(const std::set<double>& values, std::uint64_t n) {
  return *std::next(values.begin(), static_cast<std::ptrdiff_t>(n % values.size()));
}

double plainValue(VariableUse use, Random& random) {
  constexpr double kLeast = -3, kMost = 6.3; // powers of two: 0.125 to 79 mm
  const double spread = toStep(std::exp2(random.between(kLeast, kMost)));
  switch (use) {
  case VariableUse::Length: {
    if (random.chance(0.25)) return static_cast<double>(random.whole(-10, 10));
    return random.chance(0.4) ? -spread : spread;
  }
  case VariableUse::Size: return random.chance(0.25) ? static_cast<double>(random.whole(1, 30)) : spread;
  case VariableUse::Angle:
    return random.chance(0.3) ? 15.0 * static_cast<double>(random.whole(-12, 12))
                              : toStep(random.between(-180, 180));
  case VariableUse::Feed: return static_cast<double>(random.whole(50, 2000));
  case VariableUse::Whole: return static_cast<double>(random.whole(0, 12));
  case VariableUse::SystemIndex: return static_cast<double>(random.whole(1, 6));
  case VariableUse::System: return static_cast<double>(random.whole(54, 59));
  case VariableUse::Signal: return static_cast<double>(random.whole(0, 1));
  }
  return 0;
}

} // namespace

bool needsVariable(const stdlib::MacroSet& set, std::uint32_t number) {
  const stdlib::ProbingFacts& facts = set.probing;
  for (const auto& one : {facts.feedVariable, facts.radiusX, facts.radiusY, facts.offsetX, facts.offsetY})
    if (one == number) return true;
  if (facts.vectorFirst && facts.vectorLast && *facts.vectorFirst <= number && number <= *facts.vectorLast)
    return true;
  return set.needsSkipPosition && holds(set.scratch, number);
}

bool usesVariable(const stdlib::MacroSet& set, std::uint32_t number) {
  if (holds(set.scratch, number) || holds(set.overwritten, number) || needsVariable(set, number)) return true;
  return std::any_of(set.signatures.begin(), set.signatures.end(), [&](const stdlib::MacroSignature& one) {
    return std::any_of(one.results.begin(), one.results.end(),
                       [&](const stdlib::MacroResult& result) { return result.variable == number; });
  });
}

std::vector<ProgramVariable> variablesOf(const ir::ProgramFile& file, const stdlib::Control& control,
                                         const std::vector<const stdlib::MacroSet*>& sets) {
  return file.programs.empty() ? std::vector<ProgramVariable>{} : Walk(file, control, sets).run();
}

std::optional<double> drawValue(const ProgramVariable& variable, Random& random) {
  const bool chooses = variable.use >= VariableUse::Whole;
  if (variable.askedForNull && random.chance(0.2)) return std::nullopt;
  if (!variable.constants.empty() && variable.use < VariableUse::SystemIndex && random.chance(0.3)) {
    constexpr double kBeside[] = {0, -1, 1, -kStep, kStep};
    const double near = nthOf(variable.constants, random.below(variable.constants.size())) +
                        kBeside[random.below(chooses ? 3 : 5)];
    if (variable.use != VariableUse::Size || near > 0) return toStep(near);
  }
  return plainValue(variable.use, random);
}

std::optional<double> edgeValue(const ProgramVariable& variable, std::uint64_t index) {
  std::vector<std::optional<double>> edges = {std::nullopt, 0.0,  -1.0, kStep, -kStep, 0.0004, 99999.999, 1e6,
                                              -99999.999,   54.5, 60.0, 1.0,   0.5};
  for (const double constant : variable.constants)
    for (const double beside : {0.0, -kStep, kStep})
      edges.emplace_back(constant + beside);
  if (variable.use == VariableUse::Signal) edges = {0.0, 1.0};
  return edges[index % edges.size()];
}

} // namespace dotek::verify
