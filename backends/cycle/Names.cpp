// What variables are called, and of which kind they are.
#include "backends/cycle/State.h"
#include "ir/InferKinds.h"
#include "ir/Match.h"
#include "ir/Walk.h"

#include <algorithm>

namespace dotek::backends::cycle {

namespace {

// Host inputs that the language has a name for.
constexpr std::pair<std::string_view, std::string_view> kHosts[] = {{"tool_radius", "ball_radius"},
                                                                    {"overtravel", "overtravel"},
                                                                    {"approach_feed", "approach_feed"},
                                                                    {"measuring_feed", "measuring_feed"},
                                                                    {"retract", "retract"},
                                                                    {"start_x", "start.x"},
                                                                    {"start_y", "start.y"},
                                                                    {"start_z", "start.z"},
                                                                    {"here_x", "here.x"},
                                                                    {"here_y", "here.y"},
                                                                    {"here_z", "here.z"}};

// Degrees, as labels of dialogs abbreviate them or spell them out.
constexpr std::string_view kDegrees[] = {"deg",   "degree", "degrees",      "\xC2\xB0",     "grad",
                                         "gradi", "grado",  "grados",       "degr\xC3\xA9", "degr\xC3\xA9s",
                                         "graus", "stopni", "stupn\xC4\x9B"};

// What parameters that stand alone in a place are for: names for those whose own are no names.
class Roles {
public:
  explicit Roles(const State& state) {
    for (const ir::CycleStatement& statement : state.cycle.body)
      of(statement);
  }
  // "": none is seen.
  std::string of(ir::VariableId id) const {
    const auto found = roles_.find(id);
    return found == roles_.end() ? "" : found->second;
  }

private:
  void take(const ir::ExpressionPtr& value, std::string role) {
    if (value == nullptr) return;
    if (const auto* use = std::get_if<ir::VariableUse>(&value->node))
      roles_.emplace(use->variable, std::move(role));
  }
  static std::string along(std::string_view what, ir::Axis axis) {
    return std::string(what) + "_" + "xyz"[ir::indexOf(axis)];
  }
  void of(const ir::CycleStatement& statement) {
    ir::match(
        statement,
        [&](const ir::Move& node) {
          for (const ir::Axis axis : ir::kAxes)
            if (const auto& to = node.axes[ir::indexOf(axis)])
              take(to->value, along(to->frame == ir::Frame::Here ? "way" : "place", axis));
        },
        [&](const ir::Measure& node) {
          take(node.diameter, "diameter");
          if (node.target)
            take(node.target->value,
                 along(node.target->frame == ir::Frame::Here ? "travel" : "surface", node.axis));
          if (!node.setting) return;
          take(node.setting->system, "system");
          for (const ir::Axis axis : ir::kAxes)
            take(node.setting->nominal[ir::indexOf(axis)], along("nominal", axis));
        },
        [&](const ir::CallCycle& node) {
          for (const ir::CycleArgument& one : node.arguments) {
            std::string role = one.parameter;
            std::replace(role.begin(), role.end(), ' ', '_');
            std::replace(role.begin(), role.end(), '-', '_');
            take(one.value, role);
          }
          if (node.setting) take(node.setting->system, "system");
        },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::ProbePower, ir::Comment,
                           ir::Assign, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop,
                           ir::Alarm, ir::OpaqueBlock, ir::Port, ir::Print> auto&) {});
  }

  std::map<ir::VariableId, std::string> roles_;
};

bool isDegrees(std::string_view unit) {
  std::string small;
  for (const char c : unit)
    if (c != '.') small += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return std::find(std::begin(kDegrees), std::end(kDegrees), small) != std::end(kDegrees);
}

ir::Kind kindBy(const ir::Variable& variable) {
  if (variable.kind != ir::Kind::Number) return variable.kind;
  if (variable.unit == "mm" || variable.unit == "in") return ir::Kind::Length;
  if (isDegrees(variable.unit)) return ir::Kind::Angle;
  return variable.role == ir::Role::Local ? ir::Kind::Number : ir::Kind::Ratio;
}

// 53 where the source sets the system `variable + 53`.
void findShifts(State& state) {
  const auto look = [&](const ir::ExpressionPtr& system) {
    if (system == nullptr) return;
    const auto* sum = std::get_if<ir::Binary>(&system->node);
    if (sum == nullptr || sum->op != ir::BinaryOp::Add) return;
    for (const auto& [one, other] : {std::pair(sum->left, sum->right), std::pair(sum->right, sum->left)}) {
      const auto* use = std::get_if<ir::VariableUse>(&one->node);
      const double* by = ir::constantValue(other);
      if (use != nullptr && by != nullptr) state.shifts.emplace(use->variable, *by);
    }
  };
  for (const ir::CycleStatement& statement : state.cycle.body) {
    if (const auto* measure = std::get_if<ir::Measure>(&statement.node); measure && measure->setting)
      look(measure->setting->system);
    if (const auto* call = std::get_if<ir::CallCycle>(&statement.node); call && call->setting)
      look(call->setting->system);
  }
}

} // namespace

std::string quoted(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += c == '"' ? '\'' : static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  return out.empty() ? "" : " \"" + out + "\"";
}

std::string typeOf(ir::Kind kind) {
  switch (kind) {
  case ir::Kind::Length: return "length";
  case ir::Kind::Angle: return "angle";
  case ir::Kind::Feed: return "feed";
  case ir::Kind::Count: return "count";
  case ir::Kind::WorkOffset: return "work_offset";
  case ir::Kind::ToolOffset: return "tool_offset";
  case ir::Kind::Flag: return "flag";
  case ir::Kind::Text: return "text";
  case ir::Kind::Number:
  case ir::Kind::Ratio: break;
  }
  return "ratio";
}

std::string State::fresh(const std::string& base) {
  std::string out = base;
  int& next = nextOf.emplace(base, 2).first->second;
  while (!taken.insert(out).second)
    out = base + "_" + std::to_string(next++);
  return out;
}

void nameVariables(State& state) {
  for (const auto& [host, name] : kHosts)
    state.taken.emplace(name);
  findShifts(state);
  for (ir::Variable& variable : state.cycle.variables)
    variable.kind = kindBy(variable);
  ir::inferKinds(state.cycle);
  const Roles roles(state);
  // Parameters first: a local gives way.
  for (const ir::Role role : {ir::Role::Parameter, ir::Role::Host, ir::Role::Local}) {
    for (ir::VariableId id = 0; id < state.cycle.variables.size(); ++id) {
      const ir::Variable& variable = state.cycle.variable(id);
      if (variable.role != role) continue;
      if (role == ir::Role::Host) {
        const auto known = std::find_if(std::begin(kHosts), std::end(kHosts),
                                        [&](const auto& one) { return one.first == variable.name; });
        state.names[id] = known == std::end(kHosts) ? state.fresh(variable.name) : std::string(known->second);
        continue;
      }
      std::string name = state.options.proposeName(variable.name);
      std::string small;
      for (const char c : variable.name)
        small += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
      if (state.options.isReserved(small)) {
        const std::string role_ = roles.of(id);
        if (!role_.empty() && !state.options.isReserved(role_)) name = role_;
      } else if (name != small && state.options.proposeName(small) == small) {
        name = small; // of `ZM` no `z_m`
      }
      state.names[id] = state.fresh(name);
    }
  }
}

} // namespace dotek::backends::cycle
