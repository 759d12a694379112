#include "sim/machine/SkipWants.h"

#include "ir/Dataflow.h"
#include "ir/Linear.h"
#include "ir/Match.h"
#include "ir/Walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::sim {
namespace {

constexpr std::size_t kMostStatements = 4000; // more is no macro that measures
constexpr std::size_t kMostValues = 200'000;  // variables by statements: what is kept
constexpr std::string_view kAxes = "XYZ";
constexpr std::uint32_t kBlockEnd = 5001, kPlace = 5041, kSkip = 5061, kLength = 5081;
constexpr std::uint32_t kFirstCommon = 100;

using Form = std::optional<ir::LinearForm>;
enum class Mode : std::uint8_t { Unknown, Absolute, Incremental };

ir::LinearForm symbol(std::string name) {
  return {0, {{std::move(name), 1}}};
}

Form sum(const Form& a, const Form& b, double factor = 1) {
  return a && b ? ir::add(*a, *b, factor) : std::nullopt;
}

// `name` becomes `value`.
Form replaced(const Form& form, const std::string& name, const Form& value) {
  if (!form) return form;
  const auto found = form->terms.find(name);
  if (found == form->terms.end()) return form;
  ir::LinearForm rest = *form;
  rest.terms.erase(name);
  return sum(rest, value, found->second);
}

// The end of the skip move `at` along an axis, which its condition reads.
std::string endOf(std::size_t at, std::size_t axis) {
  return "end " + std::to_string(at) + kAxes[axis];
}

// Values before a statement, as sums of multiples of what is not known. What is in no map is as it was at
// `since`.
struct Values {
  std::map<std::uint32_t, ir::LinearForm> variables;
  std::map<std::size_t, ir::LinearForm> places; // by axis
  std::array<std::string, 3> placesSince{"0", "0", "0"};
  std::string localsSince = "0", commonSince = "0";
  Mode mode = Mode::Unknown;
  bool modeMixed = false;
  std::optional<std::size_t> skip;            // the last one
  std::map<std::string, ir::LinearForm> ends; // of it, where they are put in
  bool operator==(const Values&) const = default;

  ir::LinearForm variable(std::uint32_t number) const {
    const auto found = variables.find(number);
    if (found != variables.end()) return found->second;
    return symbol("#" + std::to_string(number) + " " + (number < kFirstCommon ? localsSince : commonSince));
  }
  ir::LinearForm place(std::size_t axis) const {
    const auto found = places.find(axis);
    if (found != places.end()) return found->second;
    return symbol(std::string(1, kAxes[axis]) + " " + placesSince[axis]);
  }
};

struct Codes {
  bool skip = false, absolute = false, incremental = false, other = false;
};

class Wants {
public:
  Wants(const ir::Program& program, const stdlib::Control& control)
      : body_(program.body), control_(control), flow_(ir::flowOf(body_)) {
    for (std::size_t i = 0; i < body_.size(); ++i)
      if (const auto* label = std::get_if<ir::Label>(&body_[i].node)) labels_[label->label] = i;
    findAlarms();
    facts_ = ir::factsBefore(
        body_, flow_, Values{},
        [&](std::size_t at, std::size_t to, Values values) {
          after(at, values);
          joined_ = to;
          return values;
        },
        [&](Values& into, const Values& other) { return meet(into, other); });
  }

  bool contact(std::size_t skip) const { return asksForContact(skip) || touchesAgain(skip); }

private:
  Codes codesOf(const ir::NcBlock& block) const {
    Codes out;
    // Without an axis G53 moves nothing; programs write it to wait for the end of the move.
    const bool moves = std::any_of(block.words.begin(), block.words.end(), [](const ir::Word& word) {
      return std::string_view("ABCUVWXYZ").find(word.address) != std::string_view::npos;
    });
    for (const ir::Word& word : block.words) {
      if (word.address != 'G') continue;
      const double* code = ir::constantValue(word.value);
      const bool fits = code != nullptr && *code >= 0 && *code < 1e5;
      const stdlib::CodeInfo* info =
          fits ? control_.find('G', static_cast<std::uint32_t>(std::lround(*code * 10))) : nullptr;
      switch (info == nullptr ? stdlib::Function::Other : info->function) {
      case stdlib::Function::Skip: out.skip = true; break;
      case stdlib::Function::Absolute: out.absolute = true; break;
      case stdlib::Function::Incremental: out.incremental = true; break;
      case stdlib::Function::Rapid:
      case stdlib::Function::Feed:
      case stdlib::Function::PathMode:
      case stdlib::Function::FeedPerMinute:
      case stdlib::Function::CutterCompOff: break;
      case stdlib::Function::MachineCoordinates: out.other = out.other || moves; break;
      default: out.other = true;
      }
    }
    return out;
  }

  // The last word of this axis; nullptr: none.
  static const ir::Word* wordOf(const ir::NcBlock& block, std::size_t axis) {
    const ir::Word* out = nullptr;
    for (const ir::Word& word : block.words)
      if (word.address == kAxes[axis]) out = &word;
    return out;
  }

  Form form(const ir::ExpressionPtr& expression, const Values& values) const {
    if (const double* value = ir::constantValue(expression)) return ir::LinearForm{*value, {}};
    if (const auto* use = std::get_if<ir::MachineVariable>(&expression->node)) {
      const double* number = ir::constantValue(use->number);
      if (number == nullptr || !(*number >= 1 && *number < 1e6)) return std::nullopt;
      return variable(static_cast<std::uint32_t>(std::lround(*number)), values);
    }
    if (const auto* node = std::get_if<ir::Unary>(&expression->node)) {
      const Form inner = form(node->operand, values);
      if (node->op == ir::UnaryOp::NullAsZero) return inner;
      if (node->op == ir::UnaryOp::Negate) return sum(ir::LinearForm{}, inner, -1);
      if (node->op == ir::UnaryOp::Absolute && inner && inner->terms.empty())
        return ir::LinearForm{std::abs(inner->constant), {}};
      return std::nullopt;
    }
    const auto* node = std::get_if<ir::Binary>(&expression->node);
    if (node == nullptr) return std::nullopt;
    const Form left = form(node->left, values), right = form(node->right, values);
    if (!left || !right) return std::nullopt;
    if (node->op == ir::BinaryOp::Add) return sum(left, right);
    if (node->op == ir::BinaryOp::Subtract) return sum(left, right, -1);
    if (node->op == ir::BinaryOp::Multiply && left->terms.empty()) return ir::add({}, *right, left->constant);
    if (node->op == ir::BinaryOp::Multiply && right->terms.empty())
      return ir::add({}, *left, right->constant);
    if (node->op == ir::BinaryOp::Divide && right->terms.empty() && right->constant != 0)
      return ir::add({}, *left, 1 / right->constant);
    return std::nullopt;
  }

  ir::LinearForm variable(std::uint32_t number, const Values& values) const {
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
      const auto n = static_cast<std::uint32_t>(axis);
      if (number == kBlockEnd + n || number == kPlace + n) return atEnds(values.place(axis), values);
      if (number == kSkip + n && values.skip) return atEnds(symbol(endOf(*values.skip, axis)), values);
      // A program that takes the length away compares the position without it.
      if (number == kLength + n) return {};
    }
    return atEnds(values.variable(number), values);
  }
  static ir::LinearForm atEnds(ir::LinearForm form, const Values& values) {
    for (const auto& [name, value] : values.ends)
      if (const Form now = replaced(form, name, value)) form = *now;
    return form;
  }

  // Where a move of this block ends along the axis.
  Form target(const ir::NcBlock& block, std::size_t axis, const Values& values, Mode mode) const {
    const ir::Word* word = wordOf(block, axis);
    if (word == nullptr) return values.place(axis);
    const ir::Constant* plain = ir::numberWithoutPoint(word->value);
    if (mode == Mode::Unknown || (plain != nullptr && plain->value != 0)) return std::nullopt;
    const Form written = form(word->value, values);
    return mode == Mode::Absolute ? written : sum(values.place(axis), written);
  }

  static void forgetPlaces(Values& values, const std::string& since) {
    values.places.clear();
    values.placesSince.fill(since);
    values.skip.reset();
  }
  static void forgetVariables(Values& values, const std::string& since, bool locals) {
    std::erase_if(values.variables, [&](const auto& one) { return locals || one.first >= kFirstCommon; });
    if (locals) values.localsSince = since;
    values.commonSince = since;
  }

  void block(std::size_t at, const ir::NcBlock& block, Values& values) const {
    const Codes codes = codesOf(block);
    if (codes.absolute || codes.incremental) {
      values.mode = codes.absolute ? Mode::Absolute : Mode::Incremental;
      values.modeMixed = codes.absolute && codes.incremental;
    }
    const std::string since = std::to_string(at);
    if (codes.skip) values.skip = at;
    if (codes.other) return forgetPlaces(values, since);
    std::array<Form, 3> ends;
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis)
      ends[axis] = target(block, axis, values, values.modeMixed ? Mode::Unknown : values.mode);
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
      if (wordOf(block, axis) == nullptr) continue;
      values.places.erase(axis);
      values.placesSince[axis] = since;
      if (codes.skip)
        values.places[axis] = symbol(endOf(at, axis));
      else if (ends[axis])
        values.places[axis] = *ends[axis];
    }
  }

  void after(std::size_t at, Values& values) const {
    const ir::ProgramStatement& statement = body_[at];
    const std::string since = std::to_string(at);
    if (statement.blockDelete != 0) { // may be passed over
      forgetPlaces(values, since);
      forgetVariables(values, since, true);
      values.modeMixed = true;
      return;
    }
    if (const auto* nc = std::get_if<ir::NcBlock>(&statement.node)) return block(at, *nc, values);
    if (const auto* call = std::get_if<ir::Call>(&statement.node)) {
      forgetPlaces(values, since);
      // What the program itself has written it keeps over a macro that leaves it alone: else it is lost to
      // the condition as well.
      if (call->kind == ir::CallKind::Macro)
        values.commonSince = since;
      else
        forgetVariables(values, since, true);
      return;
    }
    const auto* store = std::get_if<ir::Store>(&statement.node);
    if (store == nullptr) return;
    const double* number = ir::constantValue(store->number);
    if (number == nullptr || !(*number >= 1 && *number < 1e6)) return forgetVariables(values, since, true);
    const auto key = static_cast<std::uint32_t>(std::lround(*number));
    values.variables[key] = form(store->value, values).value_or(symbol("#" + since));
  }

  // What differs is one unknown of this place.
  bool meet(Values& into, const Values& other) const {
    if (into == other) return false;
    const Values before = into;
    const std::string here = "at " + std::to_string(joined_);
    std::set<std::uint32_t> variables;
    for (const Values* one : {&before, &other})
      for (const auto& [key, form] : one->variables)
        variables.insert(key);
    for (const std::uint32_t key : variables) {
      const ir::LinearForm value = before.variable(key);
      into.variables[key] =
          value == other.variable(key) ? value : symbol("#" + std::to_string(key) + " " + here);
    }
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
      const ir::LinearForm value = before.place(axis);
      into.places[axis] =
          value == other.place(axis) ? value : symbol(std::string(1, kAxes[axis]) + " " + here);
    }
    if (before.localsSince != other.localsSince) into.localsSince = here;
    if (before.commonSince != other.commonSince) into.commonSince = here;
    if (before.mode != other.mode || other.modeMixed) into.modeMixed = true;
    if (before.skip != other.skip) into.skip.reset();
    return !(into == before);
  }

  std::optional<bool> holds(const ir::ConditionPtr& condition, const Values& values) const {
    if (const auto* not_ = std::get_if<ir::Not>(&condition->node)) {
      const std::optional<bool> inner = holds(not_->inner, values);
      return inner ? std::optional(!*inner) : std::nullopt;
    }
    if (const auto* pair = std::get_if<ir::Junction>(&condition->node)) {
      const std::optional<bool> left = holds(pair->left, values), right = holds(pair->right, values);
      const bool decides = pair->op == ir::Connective::Or;
      if (left == decides || right == decides) return decides;
      return left && right ? std::optional(!decides) : std::nullopt;
    }
    const auto* node = std::get_if<ir::Comparison>(&condition->node);
    if (node == nullptr) return std::nullopt;
    const Form difference = sum(form(node->left, values), form(node->right, values), -1);
    if (!difference || !difference->terms.empty()) return std::nullopt;
    const double value = difference->constant;
    switch (node->relation) {
    case ir::Relation::Equal:
    case ir::Relation::Same: return value == 0;
    case ir::Relation::NotEqual:
    case ir::Relation::Different: return value != 0;
    case ir::Relation::Less: return value < 0;
    case ir::Relation::Greater: return value > 0;
    case ir::Relation::LessEqual: return value <= 0;
    case ir::Relation::GreaterEqual: return value >= 0;
    }
    return std::nullopt;
  }

  // Where every way leads to an alarm, and none touches or ends before.
  void findAlarms() {
    alarms_.resize(body_.size());
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t at = body_.size(); at-- > 0;) {
        const ir::Next& next = flow_.next[at];
        const bool goes = !ir::endsProgram(body_[at]) && !isSkip(at) && !next.empty() &&
                          std::all_of(next.begin(), next.end(),
                                      [&](std::size_t to) { return to < body_.size() && alarms_[to]; });
        const bool alarm = ir::match(
            body_[at], [](const ir::Raise&) { return true; },
            [](const ir::OneOf<ir::Exit, ir::JumpTo, ir::Loop, ir::LoopEnd> auto&) { return false; },
            [&](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Comment, ir::NcBlock,
                                ir::Call, ir::Notice, ir::Port, ir::Print, ir::NameVariables> auto&) {
              return goes;
            });
        if (alarm == alarms_[at]) continue;
        alarms_[at] = alarm;
        changed = true;
      }
    }
  }
  bool isSkip(std::size_t at) const {
    const auto* block = std::get_if<ir::NcBlock>(&body_[at].node);
    return block != nullptr && codesOf(*block).skip;
  }

  // Before `at` the machine is where the skip move ended, or moves that name no axis of it followed.
  std::optional<bool> alarmsAtEnd(std::size_t skip, std::size_t at) const {
    const auto* branch = std::get_if<ir::Branch>(&body_[at].node);
    // After a call the end is known of the variable alone that keeps it.
    if (branch == nullptr || !branch->condition || !facts_[at] || facts_[at]->skip.value_or(skip) != skip)
      return std::nullopt;
    const auto label = labels_.find(branch->target);
    if (label == labels_.end()) return std::nullopt;
    const bool taken = alarms_[label->second];
    if (at + 1 >= body_.size() || taken == alarms_[at + 1]) return std::nullopt;
    const auto& block = std::get<ir::NcBlock>(body_[skip].node);
    const Mode stated = modeIn(skip);
    for (const Mode mode : {Mode::Absolute, Mode::Incremental}) {
      if (stated != Mode::Unknown && stated != mode) continue;
      Values values = *facts_[at];
      for (std::size_t axis = 0; axis < kAxes.size(); ++axis)
        if (const Form end = target(block, axis, *facts_[skip], mode)) values.ends[endOf(skip, axis)] = *end;
      const std::optional<bool> holdsThere = holds(branch->condition, values);
      if (holdsThere) return *holdsThere == taken;
    }
    return std::nullopt;
  }
  Mode modeIn(std::size_t at) const {
    const Codes codes = codesOf(std::get<ir::NcBlock>(body_[at].node));
    if (codes.absolute) return Mode::Absolute;
    if (codes.incremental) return Mode::Incremental;
    return facts_[at]->modeMixed ? Mode::Unknown : facts_[at]->mode;
  }

  bool asksForContact(std::size_t skip) const {
    if (!facts_[skip]) return false;
    bool wants = false;
    for (std::size_t at = skip + 1; at < body_.size() && !isSkip(at); ++at) {
      const std::optional<bool> alarm = readsEnd(at, skip) ? alarmsAtEnd(skip, at) : std::nullopt;
      if (alarm == false) return false;
      wants = wants || alarm == true;
    }
    return wants;
  }
  // A condition on where the move has ended, or on a variable that was computed from that.
  bool readsEnd(std::size_t at, std::size_t skip) const {
    const ir::ConditionPtr* condition = ir::conditionOf(body_[at]);
    if (condition == nullptr || !*condition) return false;
    bool out = false;
    ir::eachNode(*condition, [&](const ir::Expression& node) {
      const auto* use = std::get_if<ir::MachineVariable>(&node.node);
      const double* number = use == nullptr ? nullptr : ir::constantValue(use->number);
      if (number == nullptr || !(*number >= 1 && *number < 1e6)) return;
      out = out || (*number >= kBlockEnd && *number <= kSkip + 2) ||
            (facts_[at] && holdsEnd(facts_[at]->variable(static_cast<std::uint32_t>(*number)), skip));
    });
    return out;
  }
  static bool holdsEnd(const ir::LinearForm& form, std::size_t skip) {
    return std::any_of(form.terms.begin(), form.terms.end(), [&](const auto& term) {
      for (std::size_t axis = 0; axis < kAxes.size(); ++axis)
        if (term.first == endOf(skip, axis)) return true;
      return false;
    });
  }

  // The one axis that a block moves; nothing: none, or another one, too.
  std::optional<std::size_t> axisOf(const ir::NcBlock& block) const {
    std::optional<std::size_t> out;
    for (const ir::Word& word : block.words) {
      if (std::string_view("ABCUVW").find(word.address) != std::string_view::npos) return std::nullopt;
      const std::size_t axis = kAxes.find(word.address);
      if (axis == std::string_view::npos) continue;
      if (out && *out != axis) return std::nullopt;
      out = axis;
    }
    return out;
  }
  // Which way a block moves along the axis: -1, 0, 1; nothing: not known. A travel that is a variable alone
  // counts as above 0: `Z-#2` leads down, as it does with a number in the place of #2.
  std::optional<int> wayOf(std::size_t at, std::size_t axis) const {
    if (!facts_[at]) return std::nullopt;
    const auto& block = std::get<ir::NcBlock>(body_[at].node);
    const Values& values = *facts_[at];
    const Mode stated = modeIn(at);
    if (stated == Mode::Unknown && values.modeMixed) return std::nullopt;
    const Mode mode = stated == Mode::Unknown ? Mode::Absolute : stated;
    const Form way = sum(target(block, axis, values, mode), values.place(axis), -1);
    if (!way) return std::nullopt;
    if (way->terms.size() == 1 && way->constant == 0) return way->terms.begin()->second > 0 ? 1 : -1;
    if (!way->terms.empty()) return std::nullopt;
    return way->constant > 0 ? 1 : way->constant < 0 ? -1 : 0;
  }
  bool touchesAgain(std::size_t skip) const {
    const std::optional<std::size_t> axis = axisOf(std::get<ir::NcBlock>(body_[skip].node));
    const std::optional<int> way = axis ? wayOf(skip, *axis) : std::nullopt;
    if (!way || *way == 0) return false;
    bool back = false;
    for (std::size_t at = skip + 1; at < body_.size(); ++at) {
      const auto* block = std::get_if<ir::NcBlock>(&body_[at].node);
      if (block == nullptr) {
        if (std::holds_alternative<ir::Call>(body_[at].node) || ir::isComputedJump(body_[at])) return false;
        continue;
      }
      const Codes codes = codesOf(*block);
      if (codes.other) return false;
      bool moves = false;
      for (const ir::Word& word : block->words)
        moves = moves || std::string_view("ABCUVWXYZ").find(word.address) != std::string_view::npos;
      if (!moves) continue;
      if (axisOf(*block) != axis) return false;
      const std::optional<int> next = wayOf(at, *axis);
      if (codes.skip) return back && next == way;
      if (next != -*way) return false;
      back = true;
    }
    return false;
  }

  const std::vector<ir::ProgramStatement>& body_;
  const stdlib::Control& control_;
  ir::ProgramFlow flow_;
  std::map<ir::LabelId, std::size_t> labels_;
  std::vector<std::optional<Values>> facts_;
  std::vector<bool> alarms_;
  std::size_t joined_ = 0; // where `meet` puts two ways together
};

} // namespace

std::set<std::size_t> wantingContact(const ir::Program& program, const std::set<std::size_t>& skips,
                                     const stdlib::Control& control) {
  std::set<std::size_t> out;
  const bool computed = std::any_of(program.body.begin(), program.body.end(),
                                    [](const auto& statement) { return ir::isComputedJump(statement); });
  if (skips.empty() || computed || program.body.size() > kMostStatements) return out;
  std::set<double> written;
  for (const ir::ProgramStatement& statement : program.body)
    if (const auto* store = std::get_if<ir::Store>(&statement.node))
      if (const double* number = ir::constantValue(store->number)) written.insert(*number);
  if (written.size() * program.body.size() > kMostValues) return out;
  const Wants wants(program, control);
  for (const std::size_t skip : skips)
    if (wants.contact(skip)) out.insert(skip);
  return out;
}

} // namespace dotek::sim
