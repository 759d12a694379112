// Calls of the vendor's macros, built from their signatures.
#include "backends/fanuc/State.h"
#include "ir/Linear.h"
#include "support/messages/Fanuc.h"

#include <algorithm>

namespace dotek::backends::fanuc {

namespace {

struct CallWord {
  char letter = 0;
  std::string text; // letter and value
};

// In the order of the source's block where it names all of them, else of the signature. I, J, K in that
// order, since argument specification II would read them otherwise.
void order(std::vector<CallWord>& arguments, const std::string& addresses) {
  const auto at = [&](const CallWord& argument) { return addresses.find(argument.letter); };
  if (std::all_of(arguments.begin(), arguments.end(),
                  [&](const CallWord& argument) { return at(argument) != std::string::npos; }))
    std::stable_sort(arguments.begin(), arguments.end(),
                     [&](const CallWord& a, const CallWord& b) { return at(a) < at(b); });
  const auto isIjk = [](const CallWord& a) { return a.letter >= 'I' && a.letter <= 'K'; };
  std::vector<CallWord> ijk;
  std::copy_if(arguments.begin(), arguments.end(), std::back_inserter(ijk), isIjk);
  std::stable_sort(ijk.begin(), ijk.end(),
                   [](const CallWord& a, const CallWord& b) { return a.letter < b.letter; });
  auto next = ijk.begin();
  for (CallWord& argument : arguments)
    if (isIjk(argument)) argument = *next++;
}

void writeCall(State& state, const stdlib::MacroSignature& signature, std::vector<CallWord> arguments,
               const ir::Origin& origin) {
  order(arguments, state.options.foreignMacros ? "" : origin.addresses);
  std::string text = "G65 P" + std::to_string(signature.program);
  for (const CallWord& argument : arguments)
    text += " " + argument.text;
  state.sheet.add(text, origin);
}

Form formOf(const stdlib::MacroArgument& argument) {
  if (!argument.selector && argument.role != stdlib::ArgumentRole::System) return Form::Length;
  return argument.point ? Form::Selector : Form::Whole;
}

const stdlib::MacroSignature* signatureFor(State& state, stdlib::Intent intent, ir::Axis axis,
                                           std::string_view what, SourceRange range) {
  const auto* signature = state.macros.find(intent, axis);
  if (signature == nullptr) state.refuse<diag::MacroSetCannot>(range, state.macros.title, what);
  return signature;
}

void warnIfOff(State& state, const ir::Origin& origin) {
  const auto& body = state.cycle.body;
  const bool switched = std::any_of(body.begin(), body.end(), [](const ir::CycleStatement& statement) {
    const auto* power = std::get_if<ir::ProbePower>(&statement.node);
    return power != nullptr && power->on;
  });
  if (switched || state.options.probePower == ProbePowerMode::Macro) return;
  if (!state.reported.insert("probe off").second) return;
  state.diagnostics.report<diag::ProbeNotSwitched>(origin.range());
  state.remarks.push_back("THIS PROGRAM DOES NOT SWITCH THE PROBE ON: THE CALLER DOES");
}

// One measurement on its way into a call.
class Call {
public:
  Call(State& state, const ir::Measure& measure, const stdlib::MacroSignature& signature,
       const ir::Origin& origin)
      : state_(state), measure_(measure), signature_(signature), origin_(origin) {}

  void write() {
    for (const ir::Axis axis : ir::kAxes)
      if (measure_.setting && nominal(axis) != nullptr && !isMeasured(axis))
        state_.refuse<diag::MacroSetCannot>(origin_.range(), state_.macros.title,
                                            "an offset of an axis that it does not measure");
    setByCall_ = findRule();
    if (measure_.setting) guardSystem(state_, measure_.setting->system, origin_);
    std::vector<CallWord> arguments;
    for (const stdlib::MacroArgument& argument : signature_.arguments)
      if (auto text = value(argument)) arguments.push_back({argument.letter, std::move(*text)});
    if (state_.failed) return;
    writeCall(state_, signature_, std::move(arguments), origin_);
    keepResults(state_, measure_, origin_);
    if (!measure_.setting || setByCall_) return;
    for (const ir::Axis axis : ir::kAxes)
      if (measure_.setting->nominal[ir::indexOf(axis)] != nullptr)
        writeOffset(state_, *measure_.setting, axis, signature_, origin_);
  }

private:
  const ir::ExpressionPtr& nominal(ir::Axis axis) const {
    return measure_.setting->nominal[ir::indexOf(axis)];
  }

  // Whether the macro itself sets what the source sets.
  bool findRule() {
    if (!measure_.setting) return false;
    const auto* system = signature_.find(stdlib::ArgumentRole::System, measure_.axis);
    if (system == nullptr) return false;
    if (system->systemRule == stdlib::SystemRule::Nominal) return true;
    // The offset changes by measured minus target: right only where the target is the nominal.
    for (const ir::Axis axis : measured()) {
      const ir::ExpressionPtr target = expected(axis);
      if (nominal(axis) == nullptr || target == nullptr ||
          !ir::provenEqual(target, nominal(axis), state_.cycle))
        return false;
    }
    return true;
  }

  std::vector<ir::Axis> measured() const {
    if (measure_.feature == ir::Feature::Bore) return {ir::Axis::X, ir::Axis::Y};
    return {measure_.axis};
  }

  bool isMeasured(ir::Axis axis) const {
    const auto all = measured();
    return std::find(all.begin(), all.end(), axis) != all.end();
  }

  // Where the source expects the feature, work coordinates; nullptr: not known.
  ir::ExpressionPtr expected(ir::Axis axis) {
    if (measure_.feature == ir::Feature::Bore) return workPosition(state_, axis);
    if (measure_.target->frame == ir::Frame::Here) {
      const ir::ExpressionPtr here = workPosition(state_, axis);
      return here == nullptr ? nullptr : tidy(ir::binary(ir::BinaryOp::Add, here, measure_.target->value));
    }
    return place(state_, *measure_.target, axis, ir::Frame::Work, origin_.range());
  }

  // Letter and value of an argument; nothing where it is not written.
  std::optional<std::string> value(const stdlib::MacroArgument& argument) {
    ir::ExpressionPtr expression;
    switch (argument.role) {
    case stdlib::ArgumentRole::Target:
      if (measure_.target)
        expression = place(state_, *measure_.target, argument.axis, argument.frame, origin_.range());
      break;
    case stdlib::ArgumentRole::Diameter: expression = measure_.diameter; break;
    case stdlib::ArgumentRole::Nominal:
      if (measure_.setting) expression = nominal(argument.axis);
      break;
    case stdlib::ArgumentRole::System:
      if (measure_.setting && setByCall_) expression = systemNumber(argument);
      break;
    default: break; // a cycle says nothing of it
    }
    if (expression != nullptr) return word(state_, argument.letter, expression, formOf(argument), origin_);
    if (!argument.required || state_.failed) return std::nullopt;
    if (argument.role == stdlib::ArgumentRole::System || argument.role == stdlib::ArgumentRole::Nominal)
      state_.refuse<diag::NeedsOffset>(origin_.range(), state_.macros.title, std::string(1, argument.letter));
    else
      state_.refuse<diag::MacroArgumentMissing>(origin_.range(), signature_.program,
                                                std::string(1, argument.letter));
    return std::nullopt;
  }

  ir::ExpressionPtr systemNumber(const stdlib::MacroArgument& argument) const {
    const ir::ExpressionPtr& system = measure_.setting->system;
    if (argument.systemCode == stdlib::SystemCode::GNumber) return system;
    return ir::binary(ir::BinaryOp::Subtract, system, ir::constant(53), system->range);
  }

  State& state_;
  const ir::Measure& measure_;
  const stdlib::MacroSignature& signature_;
  const ir::Origin& origin_;
  bool setByCall_ = false;
};

} // namespace

void writeProtectedMove(State& state, const ir::Move& move, const ir::Origin& origin) {
  warnIfOff(state, origin);
  if (isOfContact(state, move, origin)) return;
  const auto* signature =
      signatureFor(state, stdlib::Intent::ProtectedMove, ir::Axis::X, "a protected move", origin.range());
  if (signature == nullptr) return;
  std::vector<CallWord> arguments;
  for (const ir::Axis axis : ir::kAxes)
    if (move.axes[ir::indexOf(axis)] && signature->find(stdlib::ArgumentRole::Target, axis) == nullptr)
      state.refuse<diag::MacroSetCannot>(origin.range(), state.macros.title,
                                         std::string("a protected move along ") + ir::letterOf(axis));
  for (const stdlib::MacroArgument& argument : signature->arguments) {
    ir::ExpressionPtr expression;
    if (argument.role == stdlib::ArgumentRole::Feed) expression = move.feed;
    if (argument.role == stdlib::ArgumentRole::Target) {
      const auto& coordinate = move.axes[ir::indexOf(argument.axis)];
      if (!coordinate) continue;
      expression = place(state, *coordinate, argument.axis, argument.frame, origin.range());
    }
    if (expression != nullptr)
      arguments.push_back(
          {argument.letter, word(state, argument.letter, expression, formOf(argument), origin)});
    else if (argument.required)
      state.refuse<diag::MacroArgumentMissing>(origin.range(), signature->program,
                                               std::string(1, argument.letter));
  }
  if (state.failed) return;
  if (move.feed == nullptr && state.reported.insert("feed").second)
    state.remarks.push_back("A PROTECTED MOVE STATES NO FEED: P" + std::to_string(signature->program) +
                            " TAKES ITS OWN OR THE LAST ONE");
  writeCall(state, *signature, std::move(arguments), origin);
}

void writeMeasure(State& state, const ir::Measure& measure, const ir::Origin& origin) {
  warnIfOff(state, origin);
  const bool bore = measure.feature == ir::Feature::Bore;
  const auto* signature = signatureFor(
      state, bore ? stdlib::Intent::Bore : stdlib::Intent::Surface, measure.axis,
      bore ? std::string("a bore") : std::string("a surface along ") + ir::letterOf(measure.axis),
      origin.range());
  if (signature != nullptr) Call(state, measure, *signature, origin).write();
}

void writeProbePower(State& state, bool on, const ir::Origin& origin) {
  if (const auto* signature = state.macros.find(on ? stdlib::Intent::ProbeOn : stdlib::Intent::ProbeOff)) {
    writeCall(state, *signature, {}, origin);
    return;
  }
  const auto* code = state.control.find(on ? stdlib::Function::ProbeOn : stdlib::Function::ProbeOff);
  if (code == nullptr) {
    state.refuse<diag::NoProbeCode>(origin.range(), state.control.title, state.macros.title,
                                    on ? "on" : "off");
    return;
  }
  state.sheet.add(codeText(*code), origin);
}

} // namespace dotek::backends::fanuc
