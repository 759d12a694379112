#include "frontend/cycle/Lowering.h"
#include "ir/Match.h"
#include "ir/Walk.h"
#include "support/messages/Cycle.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace dotek::frontend::cycle {

ir::Kind kindOfType(TypeName type) {
  switch (type) {
  case TypeName::Length: return ir::Kind::Length;
  case TypeName::Angle: return ir::Kind::Angle;
  case TypeName::Feed: return ir::Kind::Feed;
  case TypeName::Flag: return ir::Kind::Flag;
  case TypeName::Text: return ir::Kind::Text;
  case TypeName::Count:
  case TypeName::Choice: return ir::Kind::Count;
  case TypeName::WorkOffset: return ir::Kind::WorkOffset;
  case TypeName::ToolOffset: return ir::Kind::ToolOffset;
  // Counts and ratios mix in the language; seconds are no kind of the IR.
  case TypeName::Time:
  case TypeName::Ratio: break;
  }
  return ir::Kind::Number;
}

namespace {

std::string legendOf(const Type& type) {
  std::string out;
  if (type.name == TypeName::Flag) return "0 no, 1 yes";
  if (type.name == TypeName::Time) return "seconds";
  for (std::size_t i = 0; i < type.choices.size(); ++i)
    out += fmt::format("{}{} {}", i == 0 ? "" : ", ", i + 1, type.choices[i].text);
  return out;
}

const std::vector<Name>* choicesOfType(const Type& type) {
  return type.name == TypeName::Choice ? &type.choices : nullptr;
}

const Expression& within(const Expression& expression) {
  const auto* bracketed = std::get_if<Bracketed>(&expression.node);
  return bracketed == nullptr ? expression : within(*bracketed->inner);
}

} // namespace

// "at_x" gives "AT X OUT OF RANGE" on a control.
std::string Lowering::alarmText(const std::string& name) {
  std::string out = name;
  std::replace(out.begin(), out.end(), '_', ' ');
  return out + " out of range";
}

void Lowering::declarations(const File& file) {
  for (const Statement* const declared : cycle::declarations(file)) {
    const Statement& statement = *declared;
    if (const auto* one = std::get_if<Parameter>(&statement.node)) {
      for (const Name& name : one->names)
        declareParameter(*one, name);
      clauses(*one);
    }
    if (const auto* one = std::get_if<Result>(&statement.node)) result(*one);
    if (const auto* one = std::get_if<Require>(&statement.node))
      demand(*one->condition, one->message ? one->message->text : "require not met", statement.range);
  }
  for (const Statement& statement : file.body.statements)
    if (std::holds_alternative<Needs>(statement.node)) probe_ = Probe::On;
}

void Lowering::declareParameter(const Parameter& parameter, const Name& name) {
  ir::Variable variable;
  variable.name = name.text;
  variable.role = ir::Role::Parameter;
  variable.kind = kindOfType(parameter.type.name);
  variable.unit = std::string(ir::kindUnit(variable.kind));
  variable.range = name.range;
  variable.optional = parameter.optional;
  if (parameter.title) variable.meaning = parameter.title->text;
  if (const std::string legend = legendOf(parameter.type); !legend.empty())
    variable.meaning += (variable.meaning.empty() ? "" : ": ") + legend;
  taken_.insert(variable.name);
  if (variable.kind == ir::Kind::Text) refuse<diag::TextParameter>(name.range, name.text);
  Meaning meaning;
  meaning.kind = variable.kind;
  meaning.choices = choicesOfType(parameter.type);
  const std::vector<Name>* choices = meaning.choices;
  const ir::VariableId id = cycle_.add(std::move(variable));
  for (const Clause& clause : parameter.clauses)
    if (clause.kind == Clause::Kind::Letter && clause.letter && clause.letter->text.size() == 1)
      letters_[id] = clause.letter->text[0];
  meaning.value = ir::variable(id, name.range);
  if (!parameter.optional) meaning.given = true;
  scope_.names[name.text] = meaning;
  if (parameter.value != nullptr) {
    const std::size_t before = out_->size();
    const ir::ExpressionPtr initial = value(*parameter.value, choices);
    if (const double* known = ir::constantValue(initial); known != nullptr && out_->size() == before) {
      cycle_.variables[id].defaultValue = *known;
      cycle_.variables[id].defaultDigits = std::get<ir::Constant>(initial->node).digits;
    } else {
      // Computed where the caller gives none; what computes it is passed over where he does.
      std::vector<ir::CycleStatement> steps(
          std::make_move_iterator(out_->begin() + static_cast<std::ptrdiff_t>(before)),
          std::make_move_iterator(out_->end()));
      out_->resize(before);
      cycle_.variables[id].optional = true;
      const ir::LabelId given = label(name.text + "_given", name.range);
      emit(ir::Branch{ir::negate(ir::isNull(ir::variable(id), name.range)), given}, parameter.value->range);
      for (ir::CycleStatement& step : steps)
        out_->push_back(std::move(step));
      emit(ir::Assign{id, initial}, parameter.value->range, "default");
      place(given, parameter.value->range);
    }
  }
  // A number that is none of the names is a slip of the caller.
  const double last = choices != nullptr ? static_cast<double>(choices->size()) : 1;
  if (choices == nullptr && parameter.type.name != TypeName::Flag) return;
  const ir::ExpressionPtr read = ir::variable(id, name.range);
  const ir::LabelId fine = label(name.text + "_fine", name.range);
  if (parameter.optional) emit(ir::Branch{ir::isNull(read, name.range), fine}, name.range);
  for (double one = choices == nullptr ? 0 : 1; one <= last; ++one)
    emit(ir::Branch{ir::compare(ir::Relation::Equal, read, ir::constant(one), name.range), fine}, name.range);
  emit(ir::Alarm{alarmText(name.text)}, name.range);
  place(fine, name.range);
}

void Lowering::clauses(const Parameter& parameter) {
  for (const Clause& clause : parameter.clauses) {
    const std::string message = clause.text ? clause.text->text : alarmText(parameter.names.front().text);
    std::optional<ir::LabelId> absent;
    const auto skipAbsent = [&](const Name& name) {
      const Meaning& meaning = scope_.names.at(name.text);
      if (meaning.given || clause.first == nullptr) return;
      if (!absent) absent = label(name.text + "_absent", clause.range);
      emit(ir::Branch{ir::isNull(meaning.value, clause.range), *absent}, clause.range);
    };
    if (clause.kind == Clause::Kind::Require) {
      const bool missing = std::any_of(parameter.names.begin(), parameter.names.end(), [&](const Name& name) {
        return scope_.names.at(name.text).given == false;
      });
      if (missing) continue;
      for (const Name& name : parameter.names)
        skipAbsent(name);
      demand(*clause.first, message, clause.range);
      if (absent) place(*absent, clause.range);
    }
    if (clause.kind != Clause::Kind::Range) continue;
    for (const Name& name : parameter.names) {
      absent.reset();
      const Meaning meaning = scope_.names.at(name.text);
      if (meaning.given == false) continue;
      skipAbsent(name);
      const ir::ExpressionPtr low = value(*clause.first), high = value(*clause.second);
      const ir::LabelId wrong = label(name.text + "_wrong", clause.range);
      const ir::LabelId fine = label(name.text + "_fine", clause.range);
      emit(ir::Branch{ir::compare(ir::Relation::Less, meaning.value, low, clause.range), wrong},
           clause.range);
      emit(ir::Branch{ir::compare(ir::Relation::LessEqual, meaning.value, high, clause.range), fine},
           clause.range);
      place(wrong, clause.range);
      emit(ir::Alarm{clause.text ? clause.text->text : alarmText(name.text)}, clause.range);
      place(fine, clause.range);
      if (absent) place(*absent, clause.range);
      const auto* use = std::get_if<ir::VariableUse>(&meaning.value->node);
      if (use == nullptr || !isParameter(use->variable)) continue;
      const Sign least = signOf(low), most = signOf(high);
      if (!least.above && !most.below) continue;
      Sign& known = signs_[use->variable];
      known.above = known.above || least.above;
      known.below = known.below || most.below;
      known.apart = known.apart || (least.above && least.apart) || (most.below && most.apart);
    }
  }
}

void Lowering::result(const Result& result) {
  for (const Name& name : result.names) {
    Meaning meaning;
    meaning.kind = kindOfType(result.type.name);
    meaning.choices = choicesOfType(result.type);
    if (scope_.names.contains(name.text)) continue; // of a call before with the same name
    const ir::VariableId id = local(name.text, meaning.kind, name.range);
    ir::Variable& variable = cycle_.variables[id];
    if (!scope_.inlined) results_.emplace_back(name.text, id);
    if (result.title) variable.meaning = result.title->text;
    if (const std::string legend = legendOf(result.type); !legend.empty())
      variable.meaning += (variable.meaning.empty() ? "" : ": ") + legend;
    meaning.variable = id;
    meaning.value = ir::variable(id, name.range);
    scope_.names[name.text] = meaning;
  }
}

void Lowering::demand(const Expression& condition, const std::string& message, SourceRange range) {
  if (decided(condition) == true) return;
  const ir::LabelId fine = label("fine", range);
  const std::size_t before = out_->size();
  branch(condition, true, fine);
  if (out_->size() == before + 1 && isDemanded(out_->back())) {
    out_->resize(before);
    return;
  }
  emit(ir::Alarm{message}, range);
  place(fine, range);
  bound(condition);
}

// Of a check that a called cycle makes again: the cycle itself has made it, of what does not change. One of
// the cycle itself is noted.
bool Lowering::isDemanded(const ir::CycleStatement& check) {
  const auto* asked = std::get_if<ir::Branch>(&check.node);
  if (asked == nullptr) return false;
  if (scope_.inlined)
    return std::any_of(demanded_.begin(), demanded_.end(),
                       [&](const ir::ConditionPtr& one) { return ir::equal(one, asked->condition); });
  bool lasts = out_ == &cycle_.checks && nested_ == 0;
  ir::eachNode(check, [&](const ir::Expression& node) {
    const auto* use = std::get_if<ir::VariableUse>(&node.node);
    if (use == nullptr) return;
    const ir::Variable& variable = cycle_.variable(use->variable);
    lasts = lasts && variable.role != ir::Role::Local && !variable.optional;
  });
  if (lasts) demanded_.push_back(asked->condition);
  return false;
}

// Of the cycle itself, or of one that is called: its own copy of what the call gives. What is the caller's is
// known only after the call.
bool Lowering::isParameter(ir::VariableId id) const {
  return cycle_.variable(id).role == (scope_.inlined ? ir::Role::Local : ir::Role::Parameter);
}

// What the check says of the sign of parameters.
void Lowering::bound(const Expression& condition) {
  const Expression& whole = within(condition);
  const auto* both = std::get_if<Binary>(&whole.node);
  if (both == nullptr) return;
  if (both->op == BinaryOp::And) {
    bound(*both->left);
    bound(*both->right);
    return;
  }
  if (both->op == BinaryOp::IsNot) {
    const Meaning* const meaning = meaningOf(*both->left);
    const auto* use = meaning == nullptr || meaning->value == nullptr
                          ? nullptr
                          : std::get_if<ir::VariableUse>(&meaning->value->node);
    const std::size_t before = out_->size();
    const bool parameter = use != nullptr && isParameter(use->variable);
    const ir::ExpressionPtr other = parameter ? value(*both->right) : nullptr;
    out_->resize(before);
    const double* const zero = other == nullptr ? nullptr : ir::constantValue(other);
    if (zero != nullptr && *zero == 0) signs_[use->variable].apart = true;
    return;
  }
  const bool greater = both->op == BinaryOp::Greater || both->op == BinaryOp::GreaterEqual;
  const bool less = both->op == BinaryOp::Less || both->op == BinaryOp::LessEqual;
  if (!greater && !less) return;
  const bool strict = both->op == BinaryOp::Greater || both->op == BinaryOp::Less;
  const auto learn = [&](const Expression& side, const Expression& other, bool above) {
    const Meaning* meaning = meaningOf(side);
    if (meaning == nullptr || meaning->value == nullptr) return;
    const auto* use = std::get_if<ir::VariableUse>(&meaning->value->node);
    const std::size_t before = out_->size();
    if (use == nullptr || !isParameter(use->variable)) return;
    const Sign sign = signOf(value(other));
    out_->resize(before);
    if (!(above ? sign.above : sign.below)) return;
    Sign& known = signs_[use->variable];
    (above ? known.above : known.below) = true;
    known.apart = known.apart || strict || sign.apart;
  };
  learn(*both->left, *both->right, greater);
  learn(*both->right, *both->left, less);
}

} // namespace dotek::frontend::cycle
