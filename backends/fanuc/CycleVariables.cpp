// Variables and copied blocks of the source on the control that is written: by what they mean in both
// profiles.
#include "backends/fanuc/ProgramVariables.h"
#include "backends/fanuc/State.h"
#include "backends/fanuc/TranslateCall.h"
#include "backends/fanuc/WrittenFirst.h"
#include "ir/CycleNames.h"
#include "ir/Evaluate.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"
#include "stdlib/RadiusOffsets.h"
#include "stdlib/VariableNumbers.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace dotek::backends::fanuc {

namespace {

constexpr std::uint32_t kFirstSystem = 1000; // the first variable that is the control's own

// The offsets of work systems lie in the same variables.
bool samePlaces(const stdlib::Control& one, const stdlib::Control& other) {
  const stdlib::SystemVariables& a = one.variables;
  const stdlib::SystemVariables& b = other.variables;
  return a.externalX == b.externalX && a.workOffsetX == b.workOffsetX && a.systemStep == b.systemStep &&
         a.axisStep == b.axisStep;
}

std::optional<std::uint32_t> wholeOf(const ir::ExpressionPtr& number) {
  const ir::ExpressionPtr simple = tidy(number);
  const double* value = ir::constantValue(simple);
  if (value == nullptr || !(*value >= 0 && *value < 1e9) || *value != std::floor(*value)) return std::nullopt;
  return static_cast<std::uint32_t>(*value);
}

// `number` with the constant `from` of its sum as `to`; nullptr: it has no such term.
ir::ExpressionPtr countedFrom(const ir::ExpressionPtr& number, std::uint32_t from, std::uint32_t to) {
  if (const double* value = ir::constantValue(number))
    return *value == from ? ir::constant(to, number->range) : nullptr;
  const auto* sum = std::get_if<ir::Binary>(&number->node);
  if (sum == nullptr || sum->op != ir::BinaryOp::Add) return nullptr;
  if (const ir::ExpressionPtr left = countedFrom(sum->left, from, to))
    return ir::binary(sum->op, left, sum->right, number->range);
  const ir::ExpressionPtr right = countedFrom(sum->right, from, to);
  return right ? ir::binary(sum->op, sum->left, right, number->range) : nullptr;
}

// A number that counts on: `first` and `step` times a value.
struct Counted {
  double first = 0, step = 0;
};

// `from` in the place of each of the two, as `to`: `5201+20*n` as `2500+n`. nullptr: `number` has another
// form.
ir::ExpressionPtr countedAs(const ir::ExpressionPtr& number, const Counted& from, const Counted& to) {
  const auto* sum = std::get_if<ir::Binary>(&number->node);
  if (sum == nullptr || sum->op != ir::BinaryOp::Add) return nullptr;
  const auto isFirst = [&](const ir::ExpressionPtr& term) {
    const double* value = ir::constantValue(term);
    return value != nullptr && *value == from.first;
  };
  const ir::ExpressionPtr& other = isFirst(sum->left) ? sum->right : sum->left;
  const auto* product = std::get_if<ir::Binary>(&other->node);
  if ((!isFirst(sum->left) && !isFirst(sum->right)) || product == nullptr ||
      product->op != ir::BinaryOp::Multiply)
    return nullptr;
  const double *left = ir::constantValue(product->left), *right = ir::constantValue(product->right);
  if ((left == nullptr) == (right == nullptr) || *(left != nullptr ? left : right) != from.step)
    return nullptr;
  const ir::ExpressionPtr& counter = left != nullptr ? product->right : product->left;
  const ir::ExpressionPtr steps =
      to.step == 1 ? counter
                   : ir::binary(ir::BinaryOp::Multiply, ir::constant(to.step), counter, other->range);
  return ir::binary(ir::BinaryOp::Add, ir::constant(to.first), steps, number->range);
}

class Variables {
public:
  explicit Variables(State& state) : state_(state) {}

  void run() {
    for (auto* list : {&state_.cycle.checks, &state_.cycle.body})
      for (ir::CycleStatement& statement : *list) {
        range_ = statement.origin.range();
        at_ = list == &state_.cycle.body ? &statement : nullptr;
        ir::rewrite(statement, [&](const ir::ExpressionPtr& node) { return used(node); });
        if (auto* store = std::get_if<ir::Store>(&statement.node)) stored(*store);
        if (auto* print = std::get_if<ir::Print>(&statement.node)) printed(*print);
      }
  }

private:
  bool same() const { return state_.control.name == state_.options.sourceControl.name; }

  ir::ExpressionPtr used(const ir::ExpressionPtr& expression) {
    const auto* machine = std::get_if<ir::MachineVariable>(&expression->node);
    if (machine == nullptr || ir::readTool(*expression)) return expression;
    const SourceRange range = expression->range.hasPlace() ? expression->range : range_;
    const auto number = wholeOf(machine->number);
    if (!number) {
      const ir::ExpressionPtr there = computed(machine->number, range);
      return there == machine->number ? expression : ir::machineVariable(there, expression->range);
    }
    if (*number <= state_.control.locals ||
        (same() && *number < kFirstSystem && !state_.control.isCommon(*number))) {
      state_.refuse<diag::MachineVariableRefused>(range, numberText(*number), state_.control.title);
      return expression;
    }
    const auto there = moved(*number, range);
    if (!there || *there == *number) return expression;
    return ir::machineVariable(ir::constant(*there, machine->number->range), expression->range);
  }

  void printed(ir::Print& print) {
    if (!same() && state_.reported.insert("port").second)
      state_.diagnostics.report<diag::OutputNotKnown>(range_, state_.control.title);
    for (ir::PrintPiece& piece : print.pieces) {
      if (!piece.number) continue;
      const std::uint32_t number = *piece.number;
      if (number <= state_.control.locals) {
        state_.refuse<diag::MachineVariableRefused>(range_, std::to_string(number), state_.control.title);
        continue;
      }
      if (const auto there = resultThere(number); there && !*there)
        refuseElsewhere(
            number, range_,
            fmt::format(
                "holds a result of {}, which the macros of {} leave elsewhere (`#600=#{}` in a block before "
                "keeps it in a variable of your own)",
                state_.options.source->title, state_.macros.title, number));
      else
        piece.number = moved(number, range_).value_or(number);
    }
  }

  // Nothing: no result of another set than the target's. Else whether the target's leaves it in a known
  // place.
  std::optional<bool> resultThere(std::uint32_t number) {
    const stdlib::MacroSet* const source = state_.options.source;
    if (source == nullptr || isSame(*source, state_.macros)) return std::nullopt;
    const bool result =
        std::any_of(source->overwritten.begin(), source->overwritten.end(),
                    [&](const auto& range) { return range.first <= number && number <= range.second; });
    if (!result) return std::nullopt;
    return packaged(number) && isWrittenFirst(number);
  }

  // What the macros of the source overwrite, where the target has them with other variables.
  std::optional<std::uint32_t> packaged(std::uint32_t number) const {
    const stdlib::MacroSet* const source = state_.options.source;
    if (source == nullptr || isSame(*source, state_.macros)) return std::nullopt;
    return packagedVariable(*source, state_.macros, number);
  }

  std::optional<std::uint32_t> moved(std::uint32_t number, SourceRange range) {
    if (const auto there = packaged(number); there && isWrittenFirst(number)) return there;
    const VariableThere there = variableThere(number, state_.options.sourceControl, state_.control);
    if (!there.number) {
      if (there.onlyKeptOtherwise && isWrittenFirst(number)) return number;
      refuseElsewhere(number, range, there.why);
      return std::nullopt;
    }
    if (*there.number != number && state_.reported.insert("variable " + std::to_string(number)).second)
      state_.diagnostics.report<diag::VariableMoved>(range, number, there.what, *there.number,
                                                     state_.control.title);
    return there.number;
  }

  // Where it is met first: a branch that keeps its values there uses it in most of its blocks.
  void refuseElsewhere(std::uint32_t number, SourceRange range, const std::string& why) {
    if (refused_.insert(number).second) state_.refuse<diag::VariableElsewhere>(range, number, why);
  }

  // A call that measures, of the same set as the source's, leaves a result there.
  bool leaves(const ir::CycleStatement& statement, std::uint32_t number) const {
    const auto* call = std::get_if<ir::CallCycle>(&statement.node);
    const bool measures =
        std::holds_alternative<ir::Measure>(statement.node) || (call != nullptr && !call->results.empty());
    const stdlib::MacroSet* const source = state_.options.source;
    if (!measures || source == nullptr || source->name != state_.macros.name) return false;
    const auto& overwritten = source->overwritten;
    return std::any_of(overwritten.begin(), overwritten.end(),
                       [&](const auto& range) { return range.first <= number && number <= range.second; });
  }

  // By the branch, before the statement that reads it.
  bool isWrittenFirst(std::uint32_t number) {
    if (at_ == nullptr) return false;
    const auto& body = state_.cycle.body;
    auto [found, isNew] = unwritten_.try_emplace(number);
    if (!flow_) flow_ = ir::flowOf(body);
    if (isNew)
      found->second = reachedUnwritten(body, *flow_, [&](const ir::CycleStatement& statement) {
        const auto* store = std::get_if<ir::Store>(&statement.node);
        return store != nullptr ? wholeOf(store->number) == number : leaves(statement, number);
      });
    return !found->second[static_cast<std::size_t>(at_ - body.data())];
  }

  // The number on the control that is written.
  ir::ExpressionPtr computed(const ir::ExpressionPtr& number, SourceRange range) {
    const auto base = ir::firstNumber(number);
    const stdlib::Control& source = state_.options.sourceControl;
    if (base && stdlib::isOfTools(source, *base)) return ofTools(number, *base, range);
    // Over the offsets of work systems, where they lie as on the source's control: `#[5201+20*#1]`, and
    // `#[5200+20*#1+#2]` with the axis as a number.
    if (base && *base >= kFirstSystem && sameOffsets() && stdlib::isOfOffsets(state_.control, *base) &&
        (!isBeyond(*base) || sameBeyond(number)))
      return number;
    if (base && !sameOffsets())
      if (const ir::ExpressionPtr there = ofSystems(number, *base)) return there;
    refuseComputed(base, range);
    return number;
  }

  // An offset of G54 to G59 by a computed system, where the two controls have them in other places; nullptr:
  // it is none, or its axis is computed as well.
  ir::ExpressionPtr ofSystems(const ir::ExpressionPtr& number, std::uint32_t base) const {
    const stdlib::SystemVariables& from = state_.options.sourceControl.variables;
    const stdlib::SystemVariables& to = state_.control.variables;
    if (!from.workOffsetX || !to.workOffsetX || from.axisStep != 1 || from.systemStep <= 0) return nullptr;
    constexpr int kLastAxis = 3; // the fourth: #5204, and #2801 of a 6M (fanuc-macro-b.md, 1.10)
    // #5201 of `#[5201+20*n]` is one system before G54.
    const int before = static_cast<int>(base) - (*from.workOffsetX - from.systemStep);
    if (before < 0 || before >= 7 * from.systemStep || before % from.systemStep > kLastAxis) return nullptr;
    const int system = before / from.systemStep - 1, axis = before % from.systemStep;
    const int first = *to.workOffsetX + system * to.systemStep + axis * to.axisStep;
    return countedAs(number, {static_cast<double>(base), static_cast<double>(from.systemStep)},
                     {static_cast<double>(first), static_cast<double>(to.systemStep)});
  }

  ir::ExpressionPtr ofTools(const ir::ExpressionPtr& number, std::uint32_t base, SourceRange range) {
    const VariableThere there = variableThere(base + 1, state_.options.sourceControl, state_.control);
    if (!there.number) {
      refuseElsewhere(base, range, there.why);
      return number;
    }
    if (*there.number == base + 1) return number;
    if (const ir::ExpressionPtr moved = countedFrom(number, base, *there.number - 1)) return moved;
    state_.refuse<diag::VariableNumberComputed>(range, state_.control.title,
                                                state_.options.sourceControl.title);
    return number;
  }

  void refuseComputed(std::optional<std::uint32_t> base, SourceRange range) {
    if (base && state_.options.sourceControl.isCommon(*base) && !state_.control.isCommon(*base))
      refuseElsewhere(*base, range, variableThere(*base, state_.options.sourceControl, state_.control).why);
    else if (!base || *base <= state_.control.locals || !state_.control.isCommon(*base))
      state_.refuse<diag::MachineVariableRefused>(range, "[..]", state_.control.title);
    else if (!same() && !holdsVariablesOf(state_.control, state_.options.sourceControl)) {
      if (!sharesVariablesFrom(*base, state_.control, state_.options.sourceControl))
        state_.refuse<diag::VariableNumberComputed>(range, state_.control.title,
                                                    state_.options.sourceControl.title);
      else if (state_.reported.insert("variable number").second)
        state_.diagnostics.report<diag::VariableNumberOpen>(range, state_.options.sourceControl.title,
                                                            state_.control.title);
    }
  }

  // Of the systems beyond G59, which a control may have fewer of.
  bool isBeyond(std::uint32_t base) const {
    const stdlib::SystemVariables& v = state_.control.variables;
    return v.extendedX && static_cast<int>(base) + v.extendedStep + 1 >= *v.extendedX;
  }
  bool sameBeyond(const ir::ExpressionPtr& number) const {
    const stdlib::SystemVariables& from = state_.options.sourceControl.variables;
    const stdlib::SystemVariables& to = state_.control.variables;
    if (from.extendedX != to.extendedX || from.extendedStep != to.extendedStep) return false;
    return from.extendedCount <= to.extendedCount ||
           confinedTo(state_, number, *to.extendedX, *to.extendedX + to.extendedCount * to.extendedStep - 1);
  }

  bool sameOffsets() const { return samePlaces(state_.control, state_.options.sourceControl); }

  void stored(ir::Store& store) {
    const auto number = wholeOf(store.number);
    if (!number) {
      store.number = computed(store.number, range_);
      return;
    }
    if (*number < kFirstSystem) { // Flow.cpp looks at the common ones
      if (const auto there = packaged(*number)) store.number = ir::constant(*there, store.number->range);
      return;
    }
    const auto there = moved(*number, range_);
    if (!there) return;
    if (state_.control.isReadOnly(*there))
      state_.refuse<diag::VariableReadOnly>(range_, *there, state_.control.title);
    store.number = ir::constant(*there, store.number->range);
  }

  State& state_;
  SourceRange range_;
  const ir::CycleStatement* at_ = nullptr; // of the body; nullptr: of the checks
  std::optional<ir::ProgramFlow> flow_;    // of the body, once it is asked for
  std::map<std::uint32_t, std::vector<bool>> unwritten_;
  std::set<std::uint32_t> refused_;
};

bool isSystem(double number) {
  return number >= 1 && number <= 6 && number == std::floor(number);
}

// Each value of the list of one field, which the program's checks confine it to, makes it 1 to 6.
bool isSystemByList(const State& state, const ir::Expression& number) {
  return std::any_of(state.options.choices.begin(), state.options.choices.end(), [&](const auto& list) {
    const ir::VariableId input = list.first; // a binding cannot be captured by clang 14
    const std::vector<Choice>& choices = list.second;
    return !choices.empty() && std::all_of(choices.begin(), choices.end(), [&](const Choice& choice) {
      ir::Environment environment(state.cycle.variables.size());
      environment[input] = ir::Scalar::of(choice.value);
      const ir::Scalar there = ir::evaluate(number, withLocals(state.cycle, std::move(environment)));
      return there.known() && isSystem(there.value);
    });
  });
}

// G10 itself, and G90 and G91 beside it: the one sets, the other adds (haas.md, 5).
bool isOfDataInput(const ir::Word& word, double number) {
  return word.address == 'G' && (number == 10 || number == 90 || number == 91);
}

// `G10 L2 P1 X.. Y.. Z..` writes an offset on both: P1 to P6 are the systems of the group that both tell.
bool writesWorkOffset(const State& state, const ir::OpaqueBlock& block) {
  bool offset = false;
  for (const ir::Word& word : block.words) {
    const double* number = word.value == nullptr ? nullptr : ir::constantValue(word.value);
    if (std::string_view("XYZN").find(word.address) != std::string_view::npos) continue;
    if (number == nullptr) {
      if (word.address != 'P' || word.value == nullptr ||
          !(isSystemByList(state, *word.value) || confinedTo(state, word.value, 1, 6)))
        return false;
    } else if (word.address == 'L' && *number == 2) {
      offset = true;
    } else if (!isOfDataInput(word, *number) && !(word.address == 'P' && isSystem(*number))) {
      return false;
    }
  }
  return offset && workSystemVariable(state.options.sourceControl) && workSystemVariable(state.control);
}

const double* valueOf(const ir::OpaqueBlock& block, char address) {
  for (const ir::Word& word : block.words)
    if (word.address == address) return word.value == nullptr ? nullptr : ir::constantValue(word.value);
  return nullptr;
}

// `G10 L10 P.. R..` writes a tool's length and `L11` its wear, where both have the two in variables; `L20 P1`
// the first of the systems beyond G59 (haas.md, 5). Radii are none of them: a control may hold diameters.
bool writesToolOrExtended(const State& state, const ir::OpaqueBlock& block) {
  const double* const kind = valueOf(block, 'L');
  if (kind == nullptr) return false;
  const bool tool = *kind == 10 || *kind == 11;
  const std::string_view words = tool ? "GLPRN" : "GLPXYZN";
  if ((!tool && *kind != 20) ||
      std::any_of(block.words.begin(), block.words.end(), [&](const ir::Word& word) {
        const double* number = word.value == nullptr ? nullptr : ir::constantValue(word.value);
        return words.find(word.address) == std::string_view::npos ||
               (word.address == 'G' && (number == nullptr || !isOfDataInput(word, *number)));
      }))
    return false;
  const stdlib::SystemVariables &from = state.options.sourceControl.variables, &to = state.control.variables;
  if (tool) return from.toolGeometry && from.toolWear && to.toolGeometry && to.toolWear;
  if (!from.extendedX || !to.extendedX) return false;
  const int most = std::min(from.extendedCount, to.extendedCount);
  return std::any_of(block.words.begin(), block.words.end(), [&](const ir::Word& word) {
    if (word.address != 'P' || word.value == nullptr) return false;
    const double* const system = ir::constantValue(word.value);
    return system != nullptr ? *system >= 1 && *system <= most && *system == std::floor(*system)
                             : confinedTo(state, word.value, 1, most);
  });
}

// What the block has beside what both controls are known to read alike: "its `P` is computed", "it has
// `L20`".
std::string unlikeWorkOffset(const ir::OpaqueBlock& block) {
  for (const ir::Word& word : block.words) {
    if (std::string_view("XYZN").find(word.address) != std::string_view::npos) continue;
    const double* number = word.value == nullptr ? nullptr : ir::constantValue(word.value);
    if (word.address == 'G' && number != nullptr && isOfDataInput(word, *number)) continue;
    if (word.address == 'L' && number != nullptr && *number == 2) continue;
    if (word.address == 'P' && number != nullptr && isSystem(*number)) continue;
    return number == nullptr ? fmt::format("its `{}` is computed", word.address)
                             : fmt::format("it has `{}{}`", word.address, numberText(*number));
  }
  return "it has no `L2`";
}

// "`#[5223+20*[n-54]]=` sets an offset of G54 to G59 in Z": of the first axis of the block.
std::string offsetByVariable(const ir::OpaqueBlock& block, const stdlib::Control& control) {
  const stdlib::SystemVariables& v = control.variables;
  for (const ir::Word& word : block.words)
    if (const auto at = std::string_view("XYZ").find(word.address); at != std::string_view::npos)
      return fmt::format("`#[{}+{}*[n-54]]=` sets an offset of G54 to G59 in {}",
                         *v.workOffsetX + static_cast<int>(at) * v.axisStep, v.systemStep, word.address);
  return "";
}

void refuseDataInput(State& state, const ir::OpaqueBlock& block, SourceRange range) {
  const stdlib::Control& from = state.options.sourceControl;
  const bool byVariable = workSystemVariable(from) && workSystemVariable(state.control) &&
                          from.variables.workOffsetX && samePlaces(from, state.control);
  const std::string remedy = byVariable ? offsetByVariable(block, state.control) : "";
  state.refuse<diag::DataInputRefused>(range, from.title, state.control.title, unlikeWorkOffset(block),
                                       remedy.empty() ? "take the block out of the branch"
                                                      : remedy + " on both");
}

} // namespace

void translateVariables(State& state) {
  Variables(state).run();
  translateExtendedSystem(state);
}

std::string copiedText(State& state, const ir::OpaqueBlock& block, const ir::Origin& origin) {
  const stdlib::Control& from = state.options.sourceControl;
  const bool same = state.control.name == from.name;
  const bool reads = from.decimal == state.control.decimal && from.increment == state.control.increment;
  const bool offset = !same && (writesWorkOffset(state, block) || writesToolOrExtended(state, block));
  std::string text, foreign;
  bool axis = false;      // it is one beside X, Y and Z
  bool unlisted = false;  // the code that is foreign, by the control of the source
  bool dataInput = false; // it is the code of both, and its words are what may differ
  for (const ir::Word& given : block.words) {
    if (given.address == 'N') continue; // the source's own numbering
    const double* number = given.value == nullptr ? nullptr : ir::constantValue(given.value);
    // Whether the other machine has the axis, and what it moves there, is in no table.
    if (!same && !state.options.sameAxes && foreign.empty() &&
        std::string_view("ABCUVW").find(given.address) != std::string_view::npos) {
      foreign = std::string(1, given.address) + (number == nullptr ? ".." : numberText(*number));
      axis = true;
    }
    if (!same && (given.address == 'G' || given.address == 'M')) {
      const double tenths = number == nullptr ? -1 : std::round(*number * 10);
      const auto* here = tenths < 0 ? nullptr : from.find(given.address, static_cast<std::uint32_t>(tenths));
      const auto* there =
          tenths < 0 ? nullptr : state.control.find(given.address, static_cast<std::uint32_t>(tenths));
      const bool translated = state.extendedTranslated && there != nullptr &&
                              there->function == stdlib::Function::ExtendedWorkSystem;
      const bool known =
          translated || (here != nullptr && there != nullptr && here->function == there->function &&
                         here->function != stdlib::Function::Other &&
                         (offset || here->function != stdlib::Function::DataInput)); // its words differ
      if (!known && foreign.empty()) {
        foreign = std::string(1, given.address) + (number == nullptr ? ".." : numberText(*number));
        unlisted = here == nullptr && number != nullptr;
        dataInput = here != nullptr && there != nullptr && here->function == there->function &&
                    here->function == stdlib::Function::DataInput;
      }
    }
    text += text.empty() ? "" : " ";
    if (given.value == nullptr) {
      text += given.address;
    } else if (ir::numberWithoutPoint(given.value) != nullptr && from.isLength(given.address) && !reads) {
      // Without a point the two controls would read other lengths.
      const double value =
          from.decimal == stdlib::DecimalMode::Increment ? *number * from.increment : *number;
      text += word(state, given.address, ir::constant(value, given.range), Form::Length, origin);
    } else {
      // The control refuses a point there, which a picture of lengths may have printed.
      const bool whole = number != nullptr && *number == std::round(*number) &&
                         std::string_view("MST").find(given.address) != std::string_view::npos;
      text += word(state, given.address, given.value, whole ? Form::Whole : Form::Source, origin);
    }
  }
  if (dataInput) {
    refuseDataInput(state, block, origin.range());
    return "";
  }
  if (axis) {
    state.refuse<diag::AxisNotKnown>(origin.range(), foreign, state.control.title);
    return "";
  }
  if (!foreign.empty()) {
    Diagnostic& refused = state.refuse<diag::OpaqueBlockRefused>(
        origin.range(), foreign,
        unlisted ? fmt::format("the machine of the post, by its form {}, which does not list it", from.title)
                 : from.title,
        state.control.title);
    if (unlisted)
      refused.note({}, "`control = \"NAME\"` in the form (docs/compost.md) says for which control the post "
                       "writes; `--probe-on` and `--probe-off` name the codes of the probe");
    return "";
  }
  return text;
}

bool isSettable(const stdlib::Control& control, std::uint32_t number) {
  if (control.isReadOnly(number)) return false;
  const stdlib::SystemVariables& v = control.variables;
  const auto offsets = [&](const std::optional<int>& first, int systems, int step) {
    for (int system = 0; first && system < systems; ++system)
      for (int axis = 0; axis < 4; ++axis)
        if (static_cast<int>(number) == *first + system * step + axis * v.axisStep) return true;
    return false;
  };
  const auto tools = [&](const std::optional<int>& base) {
    return base && static_cast<int>(number) > *base && static_cast<int>(number) <= *base + v.toolCount;
  };
  const stdlib::RadiusOffsets radii = stdlib::radiusOffsets(control);
  return tools(radii.wear) || tools(radii.geometry) || offsets(v.externalX, 1, 0) ||
         offsets(v.workOffsetX, 6, v.systemStep) || offsets(v.extendedX, v.extendedCount, v.extendedStep) ||
         tools(v.toolWear) || tools(v.toolGeometry) || tools(v.toolWearToo) || tools(v.toolGeometryToo) ||
         (v.timer && static_cast<int>(number) == *v.timer) ||
         (v.hours && static_cast<int>(number) == *v.hours);
}

} // namespace dotek::backends::fanuc
