#include "stdlib/MacroSet.h"

#include <algorithm>
#include <cmath>

namespace dotek::stdlib {
namespace {

constexpr std::string_view kIntentNames[] = {
#define DOTEK_INTENT(id, name) name,
    DOTEK_INTENTS(DOTEK_INTENT)
#undef DOTEK_INTENT
};
constexpr std::string_view kRoleNames[] = {
#define DOTEK_ROLE(id, name, kind, axis, selector) name,
    DOTEK_ROLES(DOTEK_ROLE)
#undef DOTEK_ROLE
};
constexpr AxisUse kRoleAxes[] = {
#define DOTEK_ROLE(id, name, kind, axis, selector) AxisUse::axis,
    DOTEK_ROLES(DOTEK_ROLE)
#undef DOTEK_ROLE
};
constexpr std::string_view kOutputNames[] = {
#define DOTEK_OUTPUT(id, name) name,
    DOTEK_OUTPUTS(DOTEK_OUTPUT)
#undef DOTEK_OUTPUT
};
constexpr std::string_view kAlarmNames[] = {
#define DOTEK_MACRO_ALARM(id, name) name,
    DOTEK_MACRO_ALARMS(DOTEK_MACRO_ALARM)
#undef DOTEK_MACRO_ALARM
};
// By letter from A: #n; 0: never an argument.
constexpr std::uint32_t kLocals[] = {1, 2, 3, 7,  8,  9,  0,  11, 4,  5,  6,  0,  13,
                                     0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};

} // namespace

std::string_view intentName(Intent intent) {
  return kIntentNames[static_cast<std::size_t>(intent)];
}
std::string_view roleName(ArgumentRole role) {
  return kRoleNames[static_cast<std::size_t>(role)];
}
std::string_view outputName(Output output) {
  return kOutputNames[static_cast<std::size_t>(output)];
}
std::string_view macroAlarmName(MacroAlarm alarm) {
  return kAlarmNames[static_cast<std::size_t>(alarm)];
}

std::uint32_t localOf(char letter) {
  return letter >= 'A' && letter <= 'Z' ? kLocals[letter - 'A'] : 0;
}

char letterOfLocal(std::uint32_t local) {
  const auto* const at = std::find(std::begin(kLocals), std::end(kLocals), local);
  return local == 0 || at == std::end(kLocals) ? '\0' : static_cast<char>('A' + (at - std::begin(kLocals)));
}

const MacroArgument* MacroSignature::find(char letter) const {
  const auto at = std::find_if(arguments.begin(), arguments.end(),
                               [&](const MacroArgument& argument) { return argument.letter == letter; });
  return at == arguments.end() ? nullptr : &*at;
}

const MacroArgument* MacroSignature::find(ArgumentRole role, ir::Axis axis) const {
  const bool axial = kRoleAxes[static_cast<std::size_t>(role)] != AxisUse::None;
  const auto at = std::find_if(arguments.begin(), arguments.end(), [&](const MacroArgument& argument) {
    return argument.role == role && (!axial || argument.axis == axis);
  });
  return at == arguments.end() ? nullptr : &*at;
}

const MacroResult* MacroSignature::find(Output output) const {
  const auto at = std::find_if(results.begin(), results.end(),
                               [&](const MacroResult& result) { return result.output == output; });
  return at == results.end() ? nullptr : &*at;
}

bool MacroSignature::fits(std::string_view letters) const {
  for (const char letter : letters) {
    if (find(letter) == nullptr) return false;
  }
  for (const MacroArgument& argument : arguments) {
    if (argument.required && letters.find(argument.letter) == std::string_view::npos) return false;
  }
  return anyOf.empty() || letters.find_first_of(anyOf) != std::string_view::npos;
}

bool MacroSet::calls(std::uint32_t program) const {
  return std::any_of(signatures.begin(), signatures.end(),
                     [&](const MacroSignature& signature) { return signature.program == program; });
}

bool MacroSet::keepsCalibration(std::uint32_t variable) const {
  constexpr std::uint32_t kFirstKept = 500; // of every control that has these macros
  return std::any_of(scratch.begin(), scratch.end(), [&](const auto& range) {
    return range.first >= kFirstKept && range.first <= variable && variable <= range.second;
  });
}

bool MacroSet::hasUnstated() const {
  return std::any_of(signatures.begin(), signatures.end(), [](const MacroSignature& signature) {
    return !signature.unknown.empty() ||
           std::any_of(signature.arguments.begin(), signature.arguments.end(), [](const MacroArgument& one) {
             return !one.unknown.empty() || one.role == ArgumentRole::Unstated;
           });
  });
}

std::vector<const MacroSignature*> MacroSet::of(std::uint32_t program) const {
  std::vector<const MacroSignature*> out;
  for (const MacroSignature& signature : signatures) {
    if (signature.program == program) out.push_back(&signature);
  }
  return out;
}

const MacroSignature* MacroSet::find(Intent intent, ir::Axis axis) const {
  const auto along = [&](const MacroSignature& signature) {
    switch (intent) {
    case Intent::Surface:
    case Intent::Angle: return signature.find(ArgumentRole::Target, axis) != nullptr;
    case Intent::Pocket:
    case Intent::Web: return signature.find(ArgumentRole::Width, axis) != nullptr;
    default: return true;
    }
  };
  const auto at = std::find_if(signatures.begin(), signatures.end(), [&](const MacroSignature& signature) {
    return signature.intent == intent && along(signature);
  });
  return at == signatures.end() ? nullptr : &*at;
}

const MacroAlarmInfo* MacroSet::find(MacroAlarm alarm) const {
  const auto at = std::find_if(alarms.begin(), alarms.end(),
                               [&](const MacroAlarmInfo& info) { return info.alarm == alarm; });
  return at == alarms.end() ? nullptr : &*at;
}

std::uint32_t extendedSystem(const MacroArgument& argument, double number) {
  constexpr double kSame = 1e-6;
  if (argument.extendedFirst == 0) return 0;
  const double steps = std::round((number - argument.extendedFirst) / argument.extendedStep);
  if (steps < 0 || number > argument.extendedLast + kSame) return 0;
  const bool same = std::abs(argument.extendedFirst + steps * argument.extendedStep - number) <= kSame;
  return same ? static_cast<std::uint32_t>(steps) + 1 : 0;
}

double extendedNumber(const MacroArgument& argument, std::uint32_t n) {
  return argument.extendedFirst + (n - 1) * argument.extendedStep;
}

} // namespace dotek::stdlib
