#include "targets/CycleFields.h"

#include "frontend/gibbs/Ast.h"
#include "frontend/gibbs/Cycle.h"
#include "ir/Evaluate.h"
#include "ir/Fold.h"
#include "ir/Match.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"
#include "support/Picture.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <variant>

namespace dotek::targets {

namespace gibbs = frontend::gibbs;

namespace {

std::optional<double> numberIn(const gibbs::Expression& expression) {
  if (const auto* unary = std::get_if<gibbs::Unary>(&expression.node)) {
    const std::optional<double> inner = numberIn(*unary->operand);
    if (!inner || unary->op != gibbs::UnaryOperator::Minus) return std::nullopt;
    return 0 - *inner;
  }
  const auto* number = std::get_if<gibbs::NumberLiteral>(&expression.node);
  return number == nullptr ? std::nullopt : std::optional(number->value);
}

// By folded name of the field: the entries of its list, both states of its check box.
std::map<std::string, std::vector<double>> offeredIn(const CycleFolder& folder) {
  std::map<std::string, std::vector<double>> out;
  if (!folder.cycle->dialog) return out;
  std::vector<std::string> lists; // by number, from 1
  for (const gibbs::Control& control : folder.cycle->dialog->controls) {
    const std::string kind = gibbs::foldCase(control.kind.text);
    const std::string field = control.variable ? gibbs::foldCase(control.variable->text) : "";
    if (kind == gibbs::foldCase("CHECK") && !field.empty()) out[field] = {0, 1};
    if (kind == gibbs::foldCase("DROPDOWN_NEW")) lists.push_back(field);
    if (kind != gibbs::foldCase("DROPDOWN_ADD") || control.arguments.size() != 3) continue;
    const auto list = numberIn(*control.arguments[0]), value = numberIn(*control.arguments[2]);
    if (!list || !value || *list < 1 || *list > static_cast<double>(lists.size())) continue;
    const std::string& name = lists[static_cast<std::size_t>(*list) - 1];
    if (!name.empty()) out[name].push_back(*value);
  }
  return out;
}

// 1 where 1 to 6 are G54 to G59, as the first value, the list or the checks show.
double firstSystemOf(const verify::DrawField& field) {
  constexpr double kCode = 54, kMost = 6;
  const auto isIndex = [](double value) { return value >= 1 && value <= kMost; };
  const auto isCode = [](double value) { return value >= kCode && value < kCode + kMost; };
  std::vector<double> shown = field.choices;
  if (field.initial) shown.insert(shown.begin(), *field.initial);
  for (const double value : shown)
    if (isIndex(value) || isCode(value)) return isIndex(value) ? 1 : kCode;
  const auto compared = [&](double value) {
    return std::find(field.thresholds.begin(), field.thresholds.end(), value) != field.thresholds.end();
  };
  const auto bounded = [&](int first) { // `< first`, `< first + 6` and the like
    return compared(first) || compared(first - 1) || compared(first + kMost - 1) || compared(first + kMost);
  };
  return !bounded(kCode) && (compared(kMost) || compared(kMost + 1)) ? 1 : kCode;
}

// What the dialog, the first value or the checks show to stand for G54.1 P1 and following.
void findExtended(verify::DrawField& field, const stdlib::MacroSet& macros, const stdlib::Control& control) {
  const auto argument = [&]() -> const stdlib::MacroArgument* {
    for (const stdlib::MacroSignature& signature : macros.signatures)
      for (const stdlib::MacroArgument& one : signature.arguments)
        if (one.role == stdlib::ArgumentRole::System && one.extendedFirst != 0) return &one;
    return nullptr;
  }();
  if (argument == nullptr || !control.variables.extendedX) return;
  const auto isExtended = [&](double value) {
    const std::uint32_t n = stdlib::extendedSystem(*argument, value);
    return n != 0 && static_cast<int>(n) <= control.variables.extendedCount;
  };
  const auto isOne = [&](double value) { return field.systemOf(value) != 0; };
  if (!field.choices.empty()) {
    std::copy_if(field.choices.begin(), field.choices.end(), std::back_inserter(field.extended), isExtended);
    field.extendedAlone = std::none_of(field.choices.begin(), field.choices.end(), isOne);
    return;
  }
  const bool begins = field.initial && isExtended(*field.initial);
  const bool shown = begins || std::any_of(field.thresholds.begin(), field.thresholds.end(), isExtended);
  for (std::uint32_t n = 1; shown && isExtended(stdlib::extendedNumber(*argument, n)); ++n)
    field.extended.push_back(stdlib::extendedNumber(*argument, n));
  const auto compares = [&](double least, double most) {
    return std::any_of(field.thresholds.begin(), field.thresholds.end(),
                       [&](double value) { return value >= least && value <= most; });
  };
  const double first = argument->extendedFirst;
  field.extendedAlone = begins && compares(first - 1, first) && !compares(1, 6) && !compares(54, 59);
}

void add(verify::DrawField field, const LoweringInputs& inputs, VerifyPlan& plan,
         const stdlib::MacroSet* macros) {
  for (const auto& [given, value] : inputs.sets)
    if (gibbs::foldCase(given) == gibbs::foldCase(field.name)) field.fixed = value;
  if (field.kind == ir::Kind::WorkOffset) {
    field.firstSystem = firstSystemOf(field);
    if (macros != nullptr && inputs.sourceControl) findExtended(field, *macros, *inputs.sourceControl);
    // A control without these systems refuses them.
    if (inputs.control && !inputs.control->variables.extendedX && !field.extendedAlone) {
      std::erase_if(field.choices, [&](double value) { return field.systemOf(value) == 0; });
      field.extended.clear();
    }
  }
  if (field.kind == ir::Kind::ToolOffset)
    for (const auto& control : {inputs.control, inputs.sourceControl})
      if (control) field.most = std::min<double>(field.most, control->variables.toolCount);
  plan.fields.push_back(std::move(field));
}

bool computesPlaces(const ir::Cycle& cycle) {
  const auto kept = [](const ir::ExpressionPtr& value) {
    bool out = false;
    ir::eachNode(value, [&](const ir::Expression& node) {
      out = out || std::holds_alternative<ir::MachineVariable>(node.node) ||
            std::holds_alternative<ir::MeasuredResult>(node.node);
    });
    return out;
  };
  // An offset that the program sets moves what comes after it.
  constexpr double kFirstOfMachine = 1000;
  const auto sets = [](const ir::CycleStatement& one) {
    const auto* store = std::get_if<ir::Store>(&one.node);
    const double* number = store == nullptr ? nullptr : ir::constantValue(store->number);
    return store != nullptr &&
           (number != nullptr ? *number >= kFirstOfMachine
                              : ir::firstNumber(store->number).value_or(0) >= kFirstOfMachine);
  };
  if (std::any_of(cycle.body.begin(), cycle.body.end(), sets)) return true;
  for (const ir::CycleStatement& one : cycle.body) {
    bool found = false;
    const bool moves = ir::match(
        one,
        [](const ir::OneOf<ir::Move, ir::Measure, ir::CallCycle, ir::OpaqueBlock, ir::Port,
                           ir::Print> auto&) { return true; },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Comment, ir::Assign,
                           ir::ProbePower, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell,
                           ir::Stop, ir::Alarm> auto&) { return false; });
    if (moves) ir::eachSlot(one, [&](const ir::ExpressionPtr& value) { found = found || kept(value); });
    if (found) return true;
  }
  return false;
}

// Parameters that the body compares with what was measured, alone on their side, and does not read elsewhere.
std::set<ir::VariableId> limitsOf(const ir::Cycle& cycle) {
  const auto isMeasured = [](const ir::ExpressionPtr& value) {
    bool out = false;
    ir::eachNode(value, [&](const ir::Expression& node) {
      out = out || std::holds_alternative<ir::MachineVariable>(node.node) ||
            std::holds_alternative<ir::MeasuredResult>(node.node);
    });
    return out;
  };
  std::map<ir::VariableId, std::size_t> reads, compared;
  const auto count = [](std::map<ir::VariableId, std::size_t>& into) {
    return [&into](const ir::Expression& node) {
      if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) ++into[use->variable];
    };
  };
  const std::function<void(const ir::Condition&)> look = [&](const ir::Condition& condition) {
    ir::match(
        condition,
        [&](const ir::Comparison& node) {
          for (const auto& [one, other] :
               {std::pair(node.left, node.right), std::pair(node.right, node.left)}) {
            std::map<ir::VariableId, std::size_t> alone;
            ir::eachNode(one, count(alone));
            if (alone.size() == 1 && !isMeasured(one) && isMeasured(other))
              compared[alone.begin()->first] += alone.begin()->second;
          }
        },
        [&](const ir::Not& node) { look(*node.inner); },
        [&](const ir::Junction& node) {
          look(*node.left);
          look(*node.right);
        },
        [](const ir::OneOf<ir::IsNull, ir::Truth> auto&) {});
  };
  for (const ir::CycleStatement& one : cycle.body) {
    ir::eachNode(one, count(reads));
    if (const ir::ConditionPtr* condition = ir::conditionOf(one)) look(**condition);
  }
  std::set<ir::VariableId> out;
  for (const auto& [id, times] : compared)
    if (reads[id] == times) out.insert(id);
  return out;
}

// What a question of the body reads, and what that is computed from.
std::set<ir::VariableId> askedIn(const ir::Cycle& cycle) {
  std::set<ir::VariableId> out;
  const auto take = [&](const ir::Expression& node) {
    if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) out.insert(use->variable);
  };
  for (const ir::CycleStatement& one : cycle.body)
    if (const ir::ConditionPtr* condition = ir::conditionOf(one); condition != nullptr && *condition)
      ir::eachNode(*condition, take);
  for (std::size_t before = 0; before != out.size();) {
    before = out.size();
    for (const auto* list : {&cycle.checks, &cycle.body})
      for (const ir::CycleStatement& one : *list)
        if (const auto* assign = std::get_if<ir::Assign>(&one.node);
            assign != nullptr && out.contains(assign->variable))
          ir::eachNode(assign->value, take);
  }
  return out;
}

// By parameters that say at which angle a face is expected: that of the faces that a path shows, which are
// across its touches.
std::map<ir::VariableId, double> faceAnglesOf(const ir::Cycle& cycle) {
  constexpr double kSame = 1e-9;
  std::map<ir::VariableId, double> out;
  for (const ir::CycleStatement& statement : cycle.body) {
    const auto* call = std::get_if<ir::CallCycle>(&statement.node);
    if (call == nullptr || !call->axis) continue;
    const double face = *call->axis == ir::Axis::X ? 90 : 0;
    for (const ir::CycleArgument& given : call->arguments) {
      if (given.parameter != stdlib::roleName(stdlib::ArgumentRole::FaceAngle)) continue;
      std::set<ir::VariableId> read;
      ir::eachNode(given.value, [&](const ir::Expression& node) {
        if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) read.insert(use->variable);
      });
      if (read.size() != 1 || cycle.variable(*read.begin()).role != ir::Role::Parameter) continue;
      const auto at = [&](double value) {
        ir::Environment known(cycle.variables.size());
        known[*read.begin()] = ir::Scalar::of(value);
        return ir::evaluate(*given.value, known);
      };
      const ir::Scalar none = at(0), one = at(1), two = at(2);
      if (!none.known() || !one.known() || !two.known()) continue;
      const double slope = one.value - none.value;
      const bool straight = std::abs(two.value - none.value - 2 * slope) < kSame;
      if (straight && std::abs(slope) > kSame) out[*read.begin()] = (face - none.value) / slope;
    }
  }
  return out;
}

// A face has two directions: the one nearer to the first value.
double besideFirst(double face, const verify::DrawField& field) {
  constexpr double kHalfTurn = 180;
  return field.initial ? *field.initial + std::remainder(face - *field.initial, kHalfTurn) : face;
}

// The height at the entry is read before anything moves.
bool readsEntryHeight(const ir::Cycle& cycle, const stdlib::Control& control) {
  bool reads = false;
  for (const ir::CycleStatement& statement : cycle.body) {
    const bool moves = ir::match(
        statement, [](const ir::OneOf<ir::Move, ir::Measure> auto&) { return true; },
        [](const ir::CallCycle& call) { return call.moves; },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Comment, ir::Assign,
                           ir::ProbePower, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell,
                           ir::Stop, ir::Alarm, ir::OpaqueBlock, ir::Port, ir::Print> auto&) {
          return false;
        });
    if (moves) break;
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
      const double* number = variable == nullptr ? nullptr : ir::constantValue(variable->number);
      if (number == nullptr) return;
      for (const auto& first : {control.variables.blockEnd, control.variables.position})
        reads = reads || (first && *number == *first + static_cast<int>(ir::indexOf(ir::Axis::Z)));
    });
  }
  return reads;
}

// Of host inputs that the form prints, for a branch of which nothing says it.
void takePictures(const LoweringInputs& inputs, VerifyPlan& plan) {
  if (inputs.form)
    for (const auto* entries : {&inputs.form->commands, &inputs.form->numerics})
      for (const auto& [name, entry] : *entries)
        if (!entry.value.empty() && !entry.picture.empty())
          if (const auto picture = Picture::parse(entry.picture); std::holds_alternative<Picture>(picture))
            plan.hostDecimals.emplace(entry.value, std::get<Picture>(picture).decimals());
}

} // namespace

void takeFields(const LoweredCycle& lowered, const CycleFolder& folder, const LoweringInputs& inputs,
                VerifyPlan& plan) {
  std::map<ir::VariableId, int> decimals;
  for (const ir::PrintedBlock& block : lowered.printed)
    for (const ir::PrintedPiece& piece : block.pieces)
      if (piece.picture) {
        const auto [at, added] = decimals.emplace(piece.variable, piece.picture->decimals());
        if (!added) at->second = std::min(at->second, piece.picture->decimals());
      }
  // A picture finer than the least increment of a control prints what that one rounds.
  for (const auto& control : {inputs.control, inputs.sourceControl})
    if (control)
      for (auto& [id, places] : decimals)
        places = std::min(places, static_cast<int>(control->decimals));
  for (const auto& [id, places] : decimals)
    if (const ir::Variable& host = lowered.cycle.variable(id); host.role == ir::Role::Host)
      plan.hostDecimals.emplace(host.name, places);
  if (lowered.printed.empty()) takePictures(inputs, plan);
  plan.computesPlaces = computesPlaces(lowered.cycle);
  if (inputs.sourceControl) plan.startsOnRetract = readsEntryHeight(lowered.cycle, *inputs.sourceControl);
  plan.bounds = std::make_shared<verify::Bounds>(lowered.cycle);
  const std::set<double> compared = ir::constantsOf(lowered.cycle.checks);
  const std::set<ir::VariableId> limits = limitsOf(lowered.cycle);
  const std::set<ir::VariableId> asked = askedIn(lowered.cycle);
  const std::map<ir::VariableId, double> faces = faceAnglesOf(lowered.cycle);
  const std::map<std::string, std::vector<double>> offered = offeredIn(folder);
  for (ir::VariableId id = 0; id < lowered.cycle.variables.size(); ++id) {
    const ir::Variable& variable = lowered.cycle.variable(id);
    if (variable.role != ir::Role::Parameter) continue;
    verify::DrawField field;
    field.name = variable.name;
    field.kind = variable.kind;
    field.initial = variable.defaultValue;
    field.thresholds.assign(compared.begin(), compared.end());
    if (const auto places = decimals.find(id); places != decimals.end()) field.decimals = places->second;
    // What nothing reads may be anything.
    if (const auto list = offered.find(gibbs::foldCase(variable.name));
        list != offered.end() && ir::uses(lowered.cycle, id))
      field.choices = list->second;
    if (const auto face = faces.find(id); face != faces.end()) field.usual = besideFirst(face->second, field);
    field.decides = asked.contains(id);
    if (limits.contains(id)) field.thresholds.push_back(kBeyondMeasured);
    add(std::move(field), inputs, plan, lowered.macros);
  }
}

void takeDeclaredFields(const CycleFolder& folder, const LoweringInputs& inputs, VerifyPlan& plan) {
  takePictures(inputs, plan);
  const std::map<std::string, std::vector<double>> offered = offeredIn(folder);
  for (const gibbs::Field& declared : gibbs::declaredFields(*folder.cycle)) {
    verify::DrawField field;
    field.name = declared.name.text;
    field.initial = declared.value;
    if (const auto list = offered.find(gibbs::foldCase(field.name)); list != offered.end())
      field.choices = list->second;
    add(std::move(field), inputs, plan, nullptr);
  }
}

} // namespace dotek::targets
