#include "stdlib/MacroSetRules.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::stdlib {
namespace {

class Rules {
public:
  explicit Rules(const MacroSignature& signature) : signature_(signature) {
    for (const MacroArgument& argument : signature.arguments) {
      if (argument.role == ArgumentRole::Target) targets_ += ir::letterOf(argument.axis);
      if (argument.role == ArgumentRole::Nominal) nominals_ += ir::letterOf(argument.axis);
      if (argument.role == ArgumentRole::Width) widths_ += ir::letterOf(argument.axis);
    }
  }

  std::vector<std::string> check() {
    intent();
    nominals();
    return std::move(defects_);
  }

private:
  using Role = ArgumentRole;

  void fail(std::string defect) { defects_.push_back(std::move(defect)); }
  const MacroArgument* find(Role role) const { return signature_.find(role); }
  bool has(Role role) const {
    return std::any_of(signature_.arguments.begin(), signature_.arguments.end(),
                       [&](const MacroArgument& argument) { return argument.role == role; });
  }
  bool needs(Role role) const {
    const auto of = [&](const MacroArgument& argument) { return argument.role == role; };
    const auto& all = signature_.arguments;
    return std::any_of(all.begin(), all.end(), of) &&
           std::all_of(all.begin(), all.end(),
                       [&](const MacroArgument& argument) { return !of(argument) || argument.required; });
  }
  void need(std::string_view what, std::initializer_list<Role> roles) {
    for (const Role role : roles)
      if (!needs(role)) fail(fmt::format("{} has an argument `{}`, which is required", what, roleName(role)));
  }
  void noTarget(std::string_view what) {
    if (!targets_.empty())
      fail(fmt::format("{} is measured from where the probe is: it has no target", what));
  }
  void round(std::string_view what) {
    if (!needs(Role::Diameter)) fail(fmt::format("{} has a diameter, which is required", what));
    noTarget(what);
  }
  void flat(std::string_view what) {
    if (widths_.size() != 1 || !needs(Role::Width))
      fail(fmt::format("{} has one width, which is required; other axes are signatures of their own", what));
    noTarget(what);
  }

  void intent() {
    switch (signature_.intent) {
    case Intent::ProtectedMove: protectedMove(); break;
    case Intent::Surface:
      if (targets_.size() != 1 || !needs(Role::Target))
        fail("a surface has one target, which is required; other axes are signatures of their own");
      if (has(Role::Diameter)) fail("a surface has no diameter");
      break;
    case Intent::Bore: round("a bore"); break;
    case Intent::Boss:
      round("a boss");
      need("a boss", {Role::Depth});
      break;
    case Intent::Pocket: flat("a pocket"); break;
    case Intent::Web:
      flat("a web");
      need("a web", {Role::Depth});
      break;
    case Intent::InnerCorner:
    case Intent::OuterCorner:
      if (targets_ != "XY" || !needs(Role::Target))
        fail("a corner has targets in X and Y, which are required");
      break;
    case Intent::Angle:
      if (targets_.size() != 1 || !needs(Role::Target)) fail("an angle has one target, which is required");
      need("an angle", {Role::Spacing});
      break;
    case Intent::AngledSurface:
      need("an angled surface", {Role::Direction, Role::Distance});
      noTarget("an angled surface");
      break;
    case Intent::AngledPocket:
    case Intent::AngledWeb:
      need("what lies at an angle", {Role::Direction, Role::Width});
      noTarget("what lies at an angle");
      if (signature_.intent == Intent::AngledWeb) need("a web", {Role::Depth});
      break;
    case Intent::ThreePointBore:
    case Intent::ThreePointBoss:
      round("what three points measure");
      need("what three points measure", {Role::FirstAngle, Role::SecondAngle, Role::ThirdAngle});
      if (signature_.intent == Intent::ThreePointBoss) need("a boss", {Role::Depth});
      break;
    case Intent::BoltCircle:
    case Intent::StockAllowance:
    case Intent::FeatureToFeature:
    case Intent::ToolUpdate:
    case Intent::Calibration: break;
    case Intent::ProbeOn:
    case Intent::ProbeOff:
      if (std::any_of(signature_.arguments.begin(), signature_.arguments.end(),
                      [](const MacroArgument& argument) { return argument.role != Role::Print; }))
        fail("a call that switches the probe has no arguments");
      break;
    }
  }

  void protectedMove() {
    if (targets_.empty()) fail("a protected move has no target");
    if (has(Role::Diameter) || has(Role::System)) fail("a protected move measures nothing and sets nothing");
    const bool anyRequired =
        std::any_of(signature_.arguments.begin(), signature_.arguments.end(),
                    [](const MacroArgument& a) { return a.role == Role::Target && a.required; });
    if (signature_.anyOf.empty() && !anyRequired)
      fail("a call without any target would fit; name the letters in `any_of`");
  }

  // Axes along which the call finds a position.
  std::string axes() const {
    if (!targets_.empty()) return targets_;
    if (!widths_.empty() && !has(Role::Direction)) return widths_;
    return "XY";
  }

  void nominals() {
    const MacroArgument* system = find(Role::System);
    if (!nominals_.empty() && (system == nullptr || system->systemRule == SystemRule::Error))
      fail("a nominal coordinate counts in the system that the call sets: `rule = \"nominal\"` is expected");
    if (system == nullptr || system->systemRule == SystemRule::Error) return;
    if (nominals_ != axes())
      fail(fmt::format("the system gets a nominal coordinate of {}, and {} given", axes(),
                       nominals_.empty() ? "none is" : nominals_ + " is"));
    for (const MacroArgument& argument : signature_.arguments) {
      if (argument.role == Role::Nominal && system->required && !argument.required)
        fail(
            fmt::format("`{}` is not required and `{}` is, which needs it", argument.letter, system->letter));
    }
  }

  const MacroSignature& signature_;
  std::string targets_, nominals_, widths_; // letters of axes
  std::vector<std::string> defects_;
};

} // namespace

std::vector<std::string> intentDefects(const MacroSignature& signature) {
  return Rules(signature).check();
}

} // namespace dotek::stdlib
