#include "verify/Variables.h"

#include "ir/Dataflow.h"
#include "ir/NumberSet.h"
#include "ir/Walk.h"
#include "stdlib/RadiusOffsets.h"
#include "verify/VariableFlow.h"

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

// What the text shows of one variable.
struct Shown {
  VariableUse use = VariableUse::Length;
  bool askedForNull = false;
  std::set<double> constants;
  std::set<std::uint32_t> comparedTo;

  bool take(const Shown& other) {
    const bool more = other.use > use || (other.askedForNull && !askedForNull);
    const std::size_t before = constants.size();
    use = std::max(use, other.use);
    askedForNull = askedForNull || other.askedForNull;
    constants.insert(other.constants.begin(), other.constants.end());
    comparedTo.insert(other.comparedTo.begin(), other.comparedTo.end());
    return more || constants.size() != before;
  }
};

class Walk {
public:
  Walk(const ir::ProgramFile& file, const stdlib::Control& control,
       const std::vector<const stdlib::MacroSet*>& sets)
      : file_(file), control_(control), sets_(sets), flow_(file, control) {}

  std::vector<ProgramVariable> run() {
    for (std::size_t i = 0; i < file_.programs.size(); ++i)
      readsOf(file_.programs[i], i == 0);
    for (program_ = 0; program_ < file_.programs.size(); ++program_)
      for (const ir::ProgramStatement& statement : file_.programs[program_].body)
        usesIn(statement);
    // What a copy is used for, the original is.
    for (bool again = true; again;) {
      again = false;
      for (const auto& [copy, original] : flow_.copies()) {
        const auto shown = shown_.find(copy);
        if (shown != shown_.end() && copy != original)
          again = shown_[original].take(Shown(shown->second)) || again;
      }
    }
    std::vector<ProgramVariable> out;
    for (auto& [number, variable] : found_) {
      if (const auto shown = shown_.find(flow_.key(0, number)); shown != shown_.end()) {
        variable.use = std::max(variable.use, shown->second.use);
        variable.askedForNull = shown->second.askedForNull;
        variable.constants = shown->second.constants;
        variable.comparedTo = shown->second.comparedTo;
      }
      out.push_back(variable);
    }
    return out;
  }

private:
  using Written = ir::NumberSet;

  void readsOf(const ir::Program& program, bool main) {
    const auto behind = [&](std::size_t at, std::size_t, Written fact) {
      const ir::ProgramStatement& statement = program.body[at];
      const auto* store = std::get_if<ir::Store>(&statement.node);
      if (store != nullptr && statement.blockDelete == 0)
        if (const auto number = numberOf(store->number)) fact.insert(*number);
      return fact;
    };
    const auto meet = [](Written& into, const Written& other) { return into.intersect(other); };
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
      shown_[flow_.key(program_, number)].take({use, false, {}, {}});
  }

  // #[2000+#1], or #[#2] after #2=2000+#1: what is computed chooses an entry of that table.
  void markNumber(const ir::ExpressionPtr& number) {
    const Operands operands = flow_.expanded(program_, number);
    const VariableUse use = useOfNumber(operands.constants);
    for (const std::uint32_t one : operands.variables)
      shown_[flow_.key(program_, one)].take({use, false, {}, {}});
  }

  VariableUse useOfNumber(const std::set<double>& constants) const {
    const stdlib::SystemVariables& v = control_.variables;
    const auto within = [](double value, const std::optional<int>& first, int count) {
      return first && value >= *first - count && value <= *first + count;
    };
    const stdlib::RadiusOffsets radii = stdlib::radiusOffsets(control_);
    VariableUse out = VariableUse::Whole;
    for (const double one : constants) {
      if (within(one, radii.wear, v.toolCount) || within(one, radii.geometry, v.toolCount) ||
          within(one, v.toolWear, v.toolCount) || within(one, v.toolGeometry, v.toolCount) ||
          within(one, v.toolWearToo, v.toolCount) || within(one, v.toolGeometryToo, v.toolCount))
        out = std::max(out, VariableUse::ToolOffset);
      if (v.extendedStep > 0 && within(one, v.extendedX, v.extendedStep))
        out = std::max(out, VariableUse::Extended);
      if (v.systemStep > 0 && within(one, v.workOffsetX, v.systemStep))
        out = std::max(out, constants.contains(54) || constants.contains(53) ? VariableUse::System
                                                                             : VariableUse::SystemIndex);
    }
    return out;
  }

  void usesIn(const ir::ProgramStatement& statement) {
    ir::eachNode(statement, [&](const ir::Expression& node) {
      if (const auto* use = std::get_if<ir::MachineVariable>(&node.node))
        if (use->number && !numberOf(use->number)) markNumber(use->number);
    });
    match(
        statement,
        [&](const ir::OneOf<ir::Store> auto& node) {
          if (node.number && !numberOf(node.number)) markNumber(node.number);
        },
        [&](const ir::OneOf<ir::JumpTo> auto& node) { mark(node.number, VariableUse::Whole); },
        [&](const ir::NcBlock& node) { words(node); },
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
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Comment, ir::LoopEnd, ir::Exit, ir::Raise, ir::Notice,
                           ir::Port, ir::Print, ir::NameVariables> auto&) {});
  }

  void words(const ir::NcBlock& block) {
    using stdlib::Function;
    bool input = false, extended = false, dwell = false;
    double kind = -1; // L of G10
    for (const ir::Word& word : block.words) {
      const double* value = ir::constantValue(word.value);
      if (value == nullptr || *value < 0 || *value > 99999) continue;
      if (word.address == 'L') kind = *value;
      if (word.address != 'G') continue;
      const stdlib::CodeInfo* info = control_.find('G', static_cast<std::uint32_t>(std::lround(*value * 10)));
      const Function function = info == nullptr ? Function::Other : info->function;
      input = input || function == Function::DataInput;
      extended = extended || function == Function::ExtendedWorkSystem;
      dwell = dwell || function == Function::Dwell;
    }
    for (const ir::Word& word : block.words)
      mark(word.value, useOfWord(word, input, extended, dwell, kind));
  }

  static VariableUse useOfWord(const ir::Word& word, bool input, bool extended, bool dwell, double kind) {
    switch (word.address) {
    case 'F':
    case 'S': return VariableUse::Feed;
    case 'H':
    case 'D':
    case 'T': return VariableUse::ToolOffset;
    case 'G': {
      // The codes that programs are given are work systems; others they save and put back.
      const std::set<double> constants = operandsOf(word.value).constants;
      return constants.contains(53) ? VariableUse::SystemIndex : VariableUse::System;
    }
    case 'P':
      if (extended) return VariableUse::Extended;
      if (dwell) return VariableUse::Size;
      if (!input) return VariableUse::Whole;
      return kind == 2    ? VariableUse::SystemIndex
             : kind == 20 ? VariableUse::Extended
                          : VariableUse::ToolOffset;
    default:
      return ir::isAddressIn(ir::kWholeAddresses, word.address) ? VariableUse::Whole : VariableUse::Length;
    }
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
    Shown shown;
    shown.constants = operands.constants;
    if (program_ == 0) shown.comparedTo = operands.variables;
    shown.askedForNull = std::holds_alternative<ir::IsNull>(condition->node);
    ir::eachNode(condition, [&](const ir::Expression& node) {
      shown.askedForNull = shown.askedForNull || std::holds_alternative<ir::NullValue>(node.node);
      // A number that is compared with itself rounded is whole.
      const auto* unary = std::get_if<ir::Unary>(&node.node);
      const bool rounds =
          unary != nullptr && (unary->op == ir::UnaryOp::Truncate || unary->op == ir::UnaryOp::Round ||
                               unary->op == ir::UnaryOp::RoundUp);
      if (rounds && operands.variables.size() == 1) shown.use = VariableUse::Whole;
    });
    shown.askedForNull = shown.askedForNull || operands.variables.contains(0); // #0
    for (const std::uint32_t number : operands.variables)
      shown_[flow_.key(program_, number)].take(shown);
  }

  const ir::ProgramFile& file_;
  const stdlib::Control& control_;
  const std::vector<const stdlib::MacroSet*>& sets_;
  const VariableFlow flow_;
  std::size_t program_ = 0; // whose statements are looked at
  std::map<VariableKey, Shown> shown_;
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
  case VariableUse::ToolOffset: return static_cast<double>(random.whole(1, 20));
  case VariableUse::Extended: return static_cast<double>(random.whole(1, 48));
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

std::optional<double> drawValue(const ProgramVariable& variable, std::uint32_t attempt, Random& random) {
  const bool chooses = variable.use >= VariableUse::Whole;
  if (variable.askedForNull && random.chance(0.2)) return std::nullopt;
  const std::set<double>& constants = variable.constants;
  if (!constants.empty() && variable.use < VariableUse::SystemIndex) {
    constexpr std::uint32_t kInVain = 4;
    if (attempt >= kInVain && constants.size() > 1 && random.chance(0.5)) {
      const std::uint64_t n = random.below(constants.size() - 1);
      const double inside = random.between(nthOf(constants, n), nthOf(constants, n + 1));
      return chooses || random.chance(0.3) ? std::round(inside) : toStep(inside);
    }
    if (random.chance(0.3)) {
      constexpr double kBeside[] = {0, -1, 1, -kStep, kStep};
      const double near =
          nthOf(constants, random.below(constants.size())) + kBeside[random.below(chooses ? 3 : 5)];
      if (variable.use != VariableUse::Size || near > 0) return toStep(near);
    }
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
