// Calls of the vendor's macros, built from their signatures.
#include "backends/common/CycleTolerances.h"
#include "backends/common/CycleTouches.h"
#include "backends/common/MacroCall.h"
#include "backends/common/ToolCorrection.h"
#include "backends/fanuc/OwnCycles.h"
#include "backends/fanuc/State.h"
#include "ir/Linear.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace dotek::backends::fanuc {

bool isAtPosition(State& state, const ir::CallCycle& cycle, ir::Axis axis) {
  return workPosition(state, axis) == nullptr &&
         std::none_of(cycle.arguments.begin(), cycle.arguments.end(), [&](const ir::CycleArgument& one) {
           return one.frame && one.parameter.back() == "xyz"[ir::indexOf(axis)];
         });
}

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

Form formOf(const State& state, const stdlib::MacroArgument& argument, const ir::ExpressionPtr& value) {
  const double* const known = value == nullptr ? nullptr : ir::constantValue(value);
  if (known != nullptr && argument.role == stdlib::ArgumentRole::System &&
      stdlib::extendedSystem(argument, *known) != 0 && *known != std::trunc(*known))
    return Form::Length; // S154.01
  if (!argument.selector && argument.role != stdlib::ArgumentRole::System) return Form::Length;
  // Without a point a letter that counts lengths would count least increments.
  return argument.point || state.control.isLength(argument.letter) ? Form::Selector : Form::Whole;
}

// Numbers that the maker of the control gives to macros of its own, beside other sets' (haas.md, 6).
bool isTaken(const State& state, std::uint32_t program) {
  constexpr std::uint32_t kFirst = 9000;
  const auto& package = state.control.package;
  return package && package->set != state.macros.name && program >= kFirst;
}

// Nothing is written where something was refused.
void writeCall(State& state, const MacroCall& call, const ir::Origin& origin) {
  if (isTaken(state, call.signature->program)) {
    if (state.reported.insert("taken programs").second)
      state.refuse<diag::MacroProgramTaken>(origin.range(), state.control.title, call.signature->program,
                                            state.macros.title, state.control.package->title,
                                            state.control.package->set);
    state.failed = true;
    return;
  }
  std::vector<CallWord> arguments;
  for (const GivenArgument& one : call.arguments)
    arguments.push_back({one.argument->letter, word(state, one.argument->letter, one.value,
                                                    formOf(state, *one.argument, one.value), origin)});
  if (!state.failed) refuseMissing(state, state.macros, call, origin.range());
  if (state.failed) return;
  if (call.endsAtSurface)
    state.diagnostics.report<diag::SearchEndsAtSurface>(origin.range(), call.signature->program);
  order(arguments, state.options.foreignMacros ? "" : origin.addresses);
  std::string text = "G65 P" + std::to_string(call.signature->program);
  for (const CallWord& argument : arguments)
    text += " " + argument.text;
  state.sheet.add(text, origin);
}

CallValues valuesFor(State& state, const ir::Origin& origin) {
  CallValues out;
  out.cycle = &state.cycle;
  out.place = [&state, &origin](const ir::Coordinate& coordinate, ir::Axis axis, ir::Frame frame) {
    const SourceRange range = origin.range();
    const bool travels = coordinate.system == nullptr && coordinate.frame != frame &&
                         (coordinate.frame == ir::Frame::Here || frame == ir::Frame::Here);
    const ir::ExpressionPtr now =
        travels && workPosition(state, axis) == nullptr ? positionNow(state, axis, origin) : nullptr;
    if (now == nullptr) return place(state, coordinate, axis, frame, range);
    if (frame == ir::Frame::Work)
      return ir::binary(ir::BinaryOp::Add, now, coordinate.value, coordinate.value->range);
    const ir::ExpressionPtr work = place(state, coordinate, axis, ir::Frame::Work, range);
    return work == nullptr ? nullptr : ir::binary(ir::BinaryOp::Subtract, work, now, work->range);
  };
  if (state.options.source != nullptr) {
    out.beyond = [&state](ir::Axis axis) { return overtravelOf(state.options.source, axis); };
    return out;
  }
  // A cycle states surfaces; how far is searched beyond them is a value of the machine.
  out.travelsToSurface = true;
  out.beyond = [&state](ir::Axis axis) {
    const auto given = state.options.fixed.find("overtravel");
    return given != state.options.fixed.end() ? ir::constant(given->second)
                                              : overtravelOf(&state.macros, axis);
  };
  return out;
}

void warnIfOff(State& state, const ir::Origin& origin) {
  const auto& body = state.cycle.body;
  const bool switched = std::any_of(body.begin(), body.end(), [](const ir::CycleStatement& statement) {
    return ir::switchesProbe(statement) == true;
  });
  if (switched || state.options.probePower == ProbePowerMode::Macro) return;
  if (!state.reported.insert("probe off").second) return;
  if (!state.options.calledFrom) state.diagnostics.report<diag::ProbeNotSwitched>(origin.range());
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
    if (measure_.setting)
      guardSystem(state_, measure_.setting->system, origin_,
                  extendedSystems(state_, signature_, values.setsSystem));
    keepPositions(state_, origin_);
    ir::Measure sent = measure_;
    if (sent.setting && values.setsSystem)
      sent.setting->system = systemForCall(state_, sent.setting->system, signature_, origin_);
    writeCall(state_, macroCall(signature_, sent, values), origin_);
    if (state_.failed) return;
    reportSearch();
    keepResults(state_, origin_);
    if (!measure_.setting || values.setsSystem) return;
    for (const ir::Axis axis : ir::kAxes)
      if (measure_.setting->nominal[ir::indexOf(axis)] != nullptr)
        writeOffset(state_, *measure_.setting, axis, signature_, origin_);
  }

private:
  void reportSearch() {
    const auto on = searchesOn(state_.options.source, state_.macros, signature_, measure_);
    if (!on || !state_.reported.insert("search").second) return;
    state_.diagnostics.report<diag::SearchGoesOn>(origin_.range(), signature_.program, numberText(*on));
    state_.remarks.push_back("SEARCHES " + numberText(*on) + " MM BEYOND THE END OF A TRAVEL OF THE SOURCE");
  }
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

// Where the source expects the feature along the axis, work coordinates; nullptr: not known.
ir::ExpressionPtr expectedAt(State& state, const ir::CallCycle& cycle, ir::Axis axis,
                             const ir::Origin& origin) {
  const auto target = std::find_if(cycle.arguments.begin(), cycle.arguments.end(), [&](const auto& one) {
    return one.frame && one.parameter.back() == "xyz"[ir::indexOf(axis)];
  });
  if (target == cycle.arguments.end()) return awayFrom(workPosition(state, axis), cycle, axis);
  return place(state, {target->value, *target->frame, nullptr}, axis, ir::Frame::Work, origin.range());
}

// The same for what is read after the call: a position that is not known while the program is written is read
// into locals before it.
class Expected {
public:
  Expected(State& state, const ir::Origin& origin) : state_(state), origin_(origin) {}
  ~Expected() { state_.freeHelpers.insert(state_.freeHelpers.end(), taken_.begin(), taken_.end()); }
  Expected(const Expected&) = delete;
  Expected& operator=(const Expected&) = delete;

  ir::ExpressionPtr at(const ir::CallCycle& cycle, ir::Axis axis) {
    ir::ExpressionPtr& known = known_[ir::indexOf(axis)];
    if (known == nullptr)
      known = isAtPosition(state_, cycle, axis) ? awayFrom(read(axis), cycle, axis)
                                                : expectedAt(state_, cycle, axis, origin_);
    return known;
  }

private:
  ir::ExpressionPtr read(ir::Axis axis) {
    const ir::ExpressionPtr now = positionNow(state_, axis, origin_);
    const std::uint32_t local = now == nullptr ? 0 : state_.helper();
    if (local == 0) return nullptr;
    std::erase(state_.helpers, local); // it lasts until the call has been dealt with
    taken_.push_back(local);
    assign(state_, fmt::format("#{}", local), now, origin_);
    state_.waited = state_.sheet.size(); // nothing moves in between
    return systemVariable(static_cast<int>(local));
  }

  State& state_;
  const ir::Origin& origin_;
  std::array<ir::ExpressionPtr, 3> known_;
  std::vector<std::uint32_t> taken_;
};

// Whether the macro itself sets the offset as the cycle does. Where not, or where it wants the nominal, that
// gets its value: the coordinate at which the feature is expected.
bool setsByItself(State& state, ir::CallCycle& cycle, const stdlib::MacroSignature& signature, bool checked,
                  const ir::Origin& origin, Expected& expected) {
  ir::CycleSetting& setting = *cycle.setting;
  const auto system =
      std::find_if(signature.arguments.begin(), signature.arguments.end(),
                   [](const auto& argument) { return argument.role == stdlib::ArgumentRole::System; });
  const bool has = system != signature.arguments.end();
  const bool corrects = has && system->systemRule == stdlib::SystemRule::Error;
  const auto isSet = [](const ir::ExpressionPtr& nominal) { return nominal != nullptr; };
  if (corrects && !checked && std::none_of(setting.nominal.begin(), setting.nominal.end(), isSet))
    return true;
  for (const ir::Axis axis : ir::kAxes) {
    ir::ExpressionPtr& nominal = setting.nominal[ir::indexOf(axis)];
    if (!setting.axes[ir::indexOf(axis)] || nominal != nullptr) continue;
    nominal = expected.at(cycle, axis);
    if (nominal == nullptr && !state.failed)
      state.refuse<diag::StartUnknown>(origin.range(), std::string(1, ir::letterOf(axis)));
    if (nominal == nullptr) return false;
  }
  return has && !corrects && !checked;
}

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
  if (move.feed == nullptr && state.reported.insert("feed").second) {
    state.diagnostics.report<diag::ProtectedMoveFeed>(origin.range(), signature->program);
    state.remarks.push_back("A PROTECTED MOVE STATES NO FEED: P" + std::to_string(signature->program) +
                            " TAKES ITS OWN OR THE LAST ONE");
  }
  writeCall(state, call, origin);
}

void writeMeasure(State& state, const ir::Measure& measure, const ir::Origin& origin) {
  warnIfOff(state, origin);
  if (const auto* signature = signatureOf(state.macros, measure))
    Measurement(state, measure, *signature, origin).write();
  else
    state.refuse<diag::MacroSetCannot>(origin.range(), state.macros.title, featureName(measure));
}

void writeCycle(State& state, const ir::CallCycle& given, const ir::Origin& origin) {
  if (writeOwnCycle(state, given, origin)) return;
  if (given.moves) warnIfOff(state, origin);
  const stdlib::MacroSignature* signature = signatureOf(state.macros, given);
  if (signature == nullptr) {
    const std::vector<ir::Measure> touches = touchesOf(given);
    for (const ir::Measure& touch : touches)
      writeMeasure(state, touch, origin);
    if (touches.empty())
      state.refuse<diag::MacroSetCannot>(origin.range(), state.macros.title, featureName(given));
    return;
  }
  if (const std::string open = openMeaning(*signature, given, state.macros); !open.empty()) {
    state.refuse<diag::CycleOpen>(origin.range(), featureName(given), given.set, open, given.set);
    return;
  }
  ir::CallCycle cycle = given;
  CallValues values = valuesFor(state, origin);
  Expected expected(state, origin);
  const auto along = [&](const ir::CallCycle& of, ir::Axis axis) {
    const ir::ExpressionPtr at = expected.at(of, axis);
    return at == nullptr ? nullptr : tidy(at);
  };
  const std::vector<Tolerance> tolerances = takeTolerances(cycle, state.macros, *signature, along);
  const auto correction = takeToolCorrection(cycle, state.options.source, *signature, along);
  if (cycle.setting) {
    values.setsSystem = setsByItself(state, cycle, *signature, !tolerances.empty(), origin, expected);
    if (state.failed) return;
    guardSystem(state, cycle.setting->system, origin, extendedSystems(state, *signature, values.setsSystem));
  }
  if (cycle.setting && values.setsSystem)
    cycle.setting->system = systemForCall(state, cycle.setting->system, *signature, origin);
  const MacroCall call = macroCall(*signature, cycle, values);
  for (const std::string& parameter : call.notTaken) {
    if (stdlib::isPrintout(parameter)) {
      state.diagnostics.report<diag::PrintLeftOut>(origin.range(), state.macros.title);
      state.sheet.comment("PRINT OF THE SOURCE LEFT OUT", origin);
      continue;
    }
    state.refuse<diag::ParameterNotTaken>(origin.range(), stdlib::parameterWords(parameter),
                                          signature->program, state.macros.title, given.set);
  }
  if (state.failed) return;
  keepPositions(state, origin);
  writeCall(state, call, origin);
  if (state.failed) return;
  keepResults(state, origin);
  ir::Origin compared = origin;
  compared.reason = "tolerance of the source's macro";
  for (const Tolerance& one : tolerances) {
    alarmIf(state, ir::compare(ir::Relation::Greater, tidy(one.error), one.limit), one.text, compared);
    state.releaseHelpers();
  }
  if (correction) writeToolCorrection(state, *correction, origin);
  if (!cycle.setting || values.setsSystem) return;
  const ir::OffsetSetting setting{cycle.setting->system, cycle.setting->nominal};
  for (const ir::Axis axis : ir::kAxes)
    if (cycle.setting->axes[ir::indexOf(axis)]) writeOffset(state, setting, axis, *signature, origin);
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
