// Calls of the vendor's macros, built from their signatures.
#include "backends/common/MacroCall.h"
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

Form formOf(const stdlib::MacroArgument& argument) {
  if (!argument.selector && argument.role != stdlib::ArgumentRole::System) return Form::Length;
  return argument.point ? Form::Selector : Form::Whole;
}

// Nothing is written where something was refused.
void writeCall(State& state, const MacroCall& call, const ir::Origin& origin) {
  std::vector<CallWord> arguments;
  for (const GivenArgument& one : call.arguments)
    arguments.push_back(
        {one.argument->letter, word(state, one.argument->letter, one.value, formOf(*one.argument), origin)});
  if (!state.failed) refuseMissing(state, state.macros, call, origin.range());
  if (state.failed) return;
  order(arguments, state.options.foreignMacros ? "" : origin.addresses);
  std::string text = "G65 P" + std::to_string(call.signature->program);
  for (const CallWord& argument : arguments)
    text += " " + argument.text;
  state.sheet.add(text, origin);
}

CallValues valuesFor(State& state, const ir::Origin& origin) {
  CallValues out;
  out.place = [&state, &origin](const ir::Coordinate& coordinate, ir::Axis axis, ir::Frame frame) {
    return place(state, coordinate, axis, frame, origin.range());
  };
  return out;
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

// One measurement, its call and what the call leaves to do.
class Measurement {
public:
  Measurement(State& state, const ir::Measure& measure, const stdlib::MacroSignature& signature,
              const ir::Origin& origin)
      : state_(state), measure_(measure), signature_(signature), origin_(origin) {}

  void write() {
    if (setsAnotherAxis(measure_))
      state_.refuse<diag::MacroSetCannot>(origin_.range(), state_.macros.title,
                                          "an offset of an axis that it does not measure");
    CallValues values = valuesFor(state_, origin_);
    values.setsSystem = findRule();
    if (measure_.setting) guardSystem(state_, measure_.setting->system, origin_);
    writeCall(state_, macroCall(signature_, measure_, values), origin_);
    if (state_.failed) return;
    keepResults(state_, measure_, origin_);
    if (!measure_.setting || values.setsSystem) return;
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
    for (const ir::Axis axis : measuredAxes(measure_)) {
      const ir::ExpressionPtr target = expected(axis);
      if (nominal(axis) == nullptr || target == nullptr ||
          !ir::provenEqual(target, nominal(axis), state_.cycle))
        return false;
    }
    return true;
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

  State& state_;
  const ir::Measure& measure_;
  const stdlib::MacroSignature& signature_;
  const ir::Origin& origin_;
};

} // namespace

void writeProtectedMove(State& state, const ir::Move& move, const ir::Origin& origin) {
  warnIfOff(state, origin);
  if (isOfContact(state, move, origin)) return;
  const auto* signature = state.macros.find(stdlib::Intent::ProtectedMove);
  if (signature == nullptr) {
    state.refuse<diag::MacroSetCannot>(origin.range(), state.macros.title, "a protected move");
    return;
  }
  if (const auto axis = axisNotTaken(*signature, move))
    state.refuse<diag::MacroSetCannot>(origin.range(), state.macros.title,
                                       std::string("a protected move along ") + ir::letterOf(*axis));
  const MacroCall call = macroCall(*signature, move, valuesFor(state, origin));
  if (state.failed) return;
  if (move.feed == nullptr && state.reported.insert("feed").second)
    state.remarks.push_back("A PROTECTED MOVE STATES NO FEED: P" + std::to_string(signature->program) +
                            " TAKES ITS OWN OR THE LAST ONE");
  writeCall(state, call, origin);
}

void writeMeasure(State& state, const ir::Measure& measure, const ir::Origin& origin) {
  warnIfOff(state, origin);
  if (const auto* signature = signatureOf(state.macros, measure))
    Measurement(state, measure, *signature, origin).write();
  else
    state.refuse<diag::MacroSetCannot>(origin.range(), state.macros.title, featureName(measure));
}

void writeProbePower(State& state, bool on, const ir::Origin& origin) {
  if (const auto* signature = state.macros.find(on ? stdlib::Intent::ProbeOn : stdlib::Intent::ProbeOff)) {
    writeCall(state, {signature, {}, {}}, origin);
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
