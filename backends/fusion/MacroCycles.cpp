// Calls of another macro set that measure a feature: their offsets and tolerances.
#include "backends/common/CycleTolerances.h"
#include "backends/common/CycleTouches.h"
#include "backends/common/MacroCall.h"
#include "backends/fusion/State.h"
#include "support/messages/Fanuc.h"

#include <algorithm>

namespace dotek::backends::fusion {

void MacroBlocks::cycle(const ir::CallCycle& given, const ir::Origin& origin, std::vector<Text>& lines) {
  const stdlib::MacroSet& macros = state_.options.macros;
  const stdlib::MacroSignature* signature = signatureOf(macros, given);
  if (signature == nullptr) {
    const std::vector<ir::Measure> touches = touchesOf(given);
    for (const ir::Measure& touch : touches)
      measure(touch, origin, lines);
    if (touches.empty())
      state_.refuse<diag::MacroSetCannot>(origin.range(), macros.title, featureName(given));
    return;
  }
  if (const std::string open = openMeaning(*signature, given, macros); !open.empty()) {
    state_.refuse<diag::CycleOpen>(origin.range(), featureName(given), given.set, open, given.set);
    return;
  }
  ir::CallCycle call = given;
  const ExpectedAlong expects = [&](const ir::CallCycle& of, ir::Axis axis) {
    for (const ir::CycleArgument& one : of.arguments)
      if (one.frame && one.parameter.back() == "xyz"[ir::indexOf(axis)])
        return place({one.value, *one.frame, nullptr}, axis, ir::Frame::Work, origin);
    return awayFrom(at_[ir::indexOf(axis)].value, of, axis);
  };
  std::vector<Tolerance> tolerances;
  if (state_.options.control.ifThen) tolerances = takeTolerances(call, macros, *signature, expects);
  CallValues asked = values(origin);
  std::optional<ir::OffsetSetting> own; // what the blocks set themselves, after the tolerances
  if (call.setting) {
    const auto system =
        std::find_if(signature->arguments.begin(), signature->arguments.end(),
                     [](const auto& argument) { return argument.role == stdlib::ArgumentRole::System; });
    const bool takesSystem = system != signature->arguments.end();
    guardSystem(call.setting->system, *signature, takesSystem && tolerances.empty(), origin);
    for (const ir::Axis axis : ir::kAxes) {
      ir::ExpressionPtr& nominal = call.setting->nominal[ir::indexOf(axis)];
      if (!call.setting->axes[ir::indexOf(axis)]) continue;
      if (takesSystem && system->systemRule == stdlib::SystemRule::Error) {
        // It corrects by measured minus expected: a coordinate of its own would be lost.
        if (nominal != nullptr)
          state_.refuse<diag::MacroSetCannot>(origin.range(), macros.title,
                                              "a work offset that gives the feature another coordinate than "
                                              "the expected one");
        continue;
      }
      if (nominal == nullptr)
        nominal = takesSystem ? awayFrom(at_[ir::indexOf(axis)].value, call, axis) : expects(call, axis);
      if (nominal == nullptr)
        state_.refuse<diag::StartUnknown>(origin.range(), std::string(1, ir::letterOf(axis)));
    }
    if (!tolerances.empty() || !takesSystem) {
      own = ir::OffsetSetting{call.setting->system, call.setting->nominal};
      for (const ir::Axis axis : ir::kAxes)
        if (call.setting->axes[ir::indexOf(axis)] && own->nominal[ir::indexOf(axis)] == nullptr)
          own->nominal[ir::indexOf(axis)] = expects(call, axis);
      if (const std::string why = offsetObstacle(*signature, *own); !why.empty()) {
        state_.refuse<diag::OffsetWriteUnsafe>(origin.range(), "the feature", why,
                                               "take the macro set of the source");
        return;
      }
      asked.setsSystem = false;
      checkShift(*own, lines, origin);
    }
  }
  for (const ir::Axis axis : ir::kAxes) {
    expected_[ir::indexOf(axis)].value = awayFrom(at_[ir::indexOf(axis)].value, call, axis);
    for (const ir::CycleArgument& one : call.arguments)
      if (one.frame && one.parameter.back() == "xyz"[ir::indexOf(axis)])
        expected_[ir::indexOf(axis)].value =
            place({one.value, *one.frame, nullptr}, axis, ir::Frame::Work, origin);
  }
  if (call.setting && !own) call.setting->system = systemForCall(call.setting->system, *signature);
  MacroCall out = macroCall(*signature, call, asked);
  for (const std::string& parameter : out.notTaken) {
    if (stdlib::isPrintout(parameter))
      state_.diagnostics.report<diag::PrintLeftOut>(origin.range(), macros.title);
    else
      state_.refuse<diag::ParameterNotTaken>(origin.range(), stdlib::parameterWords(parameter),
                                             signature->program, macros.title, given.set);
  }
  this->call(out, origin, lines);
  for (const Tolerance& one : tolerances)
    if (!state_.failed) alarmAbove(one.error, one.limit, one.text, lines, origin);
  if (own && !state_.failed) writeOffset(*own, *signature, lines, origin);
  for (const ir::Axis axis : ir::kAxes)
    if (!given.returns || (given.setting && given.setting->axes[ir::indexOf(axis)]))
      at_[ir::indexOf(axis)].value = nullptr;
}

} // namespace dotek::backends::fusion
