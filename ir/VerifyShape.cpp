#include "ir/VerifyShape.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

namespace dotek::ir {
namespace {

class Shape {
public:
  explicit Shape(const Cycle& cycle) : cycle_(cycle) {}

  std::vector<ShapeFault> run(const CycleStatement& statement) {
    match(statement, *this);
    for (const auto& [letter, variable] : statement.origin.arguments)
      if (variable >= cycle_.variables.size()) absent("a variable of the origin");
    return std::move(out_);
  }

  void operator()(const Assign& node) {
    if (node.variable >= cycle_.variables.size()) absent("a variable");
    need(node.value, "the value of an assignment");
  }
  void operator()(const Store& node) {
    need(node.number, "the number of a machine variable");
    need(node.value, "the value of a store");
  }
  void operator()(const Label& node) { label(node.label); }
  void operator()(const Jump& node) { label(node.target); }
  void operator()(const Branch& node) {
    need(node.condition);
    label(node.target);
  }
  void operator()(const Return&) {}
  void operator()(const Move& node) {
    bool any = false;
    for (const Axis axis : kAxes) {
      const auto& target = node.axes[indexOf(axis)];
      if (!target) continue;
      any = true;
      coordinate(*target, axis);
    }
    if (!any) fault("a move names no axis");
    allow(node.feed);
  }
  void operator()(const Measure& node) {
    const bool surface = node.feature == Feature::Surface;
    if (surface && !node.target) fault("the measurement of a surface has no target");
    if (surface && node.diameter) fault("the measurement of a surface has a diameter");
    if (!surface && node.target) fault("the measurement of a bore has a target");
    if (!surface)
      need(node.diameter, "the diameter of a bore");
    else
      allow(node.diameter);
    if (node.target) coordinate(*node.target, node.axis);
    if (!node.setting) return;
    need(node.setting->system, "the work system of a measurement");
    bool any = false;
    for (const Axis axis : kAxes) {
      const ExpressionPtr& nominal = node.setting->nominal[indexOf(axis)];
      if (!nominal) continue;
      any = true;
      allow(nominal);
      if (surface ? axis != node.axis : axis == Axis::Z)
        fault("a measurement sets an axis that it does not measure");
    }
    if (!any) fault("a measurement sets a work system along no axis");
  }
  void operator()(const CallCycle& node) {
    if (node.cycle.empty()) fault("a call names no cycle");
    std::set<std::string_view> names;
    for (const CycleArgument& argument : node.arguments) {
      need(argument.value, "an argument of a cycle");
      if (!names.insert(argument.parameter).second) fault("a call fills a parameter twice");
      if (argument.frame && *argument.frame != Frame::Work && *argument.frame != Frame::Here)
        fault("a coordinate of a cycle counts from the active system or from the probe");
    }
    if (!node.moves && !node.returns) fault("a cycle without a move leaves the probe elsewhere");
    if (!node.setting) return;
    need(node.setting->system, "the work system of a cycle");
    for (const Axis axis : kAxes)
      if (const ExpressionPtr& nominal = node.setting->nominal[indexOf(axis)]) {
        allow(nominal);
        if (!node.setting->axes[indexOf(axis)])
          fault("a cycle has a nominal of an axis that it does not set");
      }
    if (std::none_of(node.setting->axes.begin(), node.setting->axes.end(), [](bool set) { return set; }))
      fault("a cycle sets a work system along no axis");
  }
  void operator()(const ProbePower&) {}
  void operator()(const Spindle& node) {
    if (node.speed && node.state == Spindle::State::Off) fault("a spindle that stops has a speed");
    allow(node.speed);
  }
  void operator()(const Coolant&) {}
  void operator()(const SetMode& node) {
    if (node.mode == Mode::WorkSystem)
      need(node.system, "the number of a work system");
    else if (node.system)
      fault("a mode that is no work system names one");
    if (node.mode != Mode::WorkSystem) allow(node.system);
  }
  void operator()(const Dwell& node) { need(node.seconds, "the time of a dwell"); }
  void operator()(const Stop&) {}
  void operator()(const Alarm&) {}
  void operator()(const OneOf<Comment, Port, Print> auto&) {}
  void operator()(const OpaqueBlock& node) {
    for (const Word& word : node.words) {
      if (word.address < 'A' || word.address > 'Z') fault("a word has no letter", word.range);
      allow(word.value);
    }
  }

private:
  void fault(std::string message, SourceRange range = {}) {
    out_.push_back({range, std::move(message), false});
  }
  void absent(const std::string& what, SourceRange range = {}) {
    out_.push_back({range, what + " does not exist", true});
  }

  // ---- expressions ----------------------------------------------------------------------------------------

  void need(const ExpressionPtr& expression, const char* what) {
    if (expression)
      tree(*expression);
    else
      out_.push_back({{}, std::string(what) + " is missing", true});
  }
  void allow(const ExpressionPtr& expression) {
    if (expression) tree(*expression);
  }
  void tree(const Expression& expression) {
    match(
        expression,
        [&](const Constant& node) {
          if (!isFinite(node.value)) fault("a constant is no finite number", expression.range);
        },
        [&](const VariableUse& node) {
          if (node.variable >= cycle_.variables.size()) absent("a variable", expression.range);
        },
        [&](const MachineVariable& node) { need(node.number, "the number of a machine variable"); },
        [&](const Unary& node) { need(node.operand, "an operand"); },
        [&](const Binary& node) {
          need(node.left, "an operand");
          need(node.right, "an operand");
        },
        [](const OneOf<NullValue, MeasuredResult> auto&) {});
  }
  void need(const ConditionPtr& condition) {
    if (!condition) {
      out_.push_back({{}, "a condition is missing", true});
      return;
    }
    match(
        *condition,
        [&](const Comparison& node) {
          need(node.left, "a side of a comparison");
          need(node.right, "a side of a comparison");
        },
        [&](const IsNull& node) { need(node.value, "the value of a test for null"); },
        [&](const Not& node) { need(node.inner); },
        [&](const Junction& node) {
          need(node.left);
          need(node.right);
        },
        [](const Truth&) {});
  }

  void label(LabelId id) {
    if (id >= cycle_.labels.size()) absent("a label");
  }

  void coordinate(const Coordinate& place, Axis axis) {
    need(place.value, "a coordinate");
    allow(place.system);
    if (place.system && place.frame != Frame::Work)
      fault("a coordinate names a work system and counts from another frame");
    if (place.frame == Frame::Retract && axis != Axis::Z)
      fault("a coordinate along X or Y counts from the retract plane");
  }

  const Cycle& cycle_;
  std::vector<ShapeFault> out_;
};

struct Doing {
  std::string_view operator()(const Move&) const { return "a move"; }
  std::string_view operator()(const Measure&) const { return "a measurement"; }
  std::string_view operator()(const CallCycle&) const { return "a cycle"; }
  std::string_view operator()(const ProbePower&) const { return "a switch of the probe"; }
  std::string_view operator()(const Spindle&) const { return "a switch of the spindle"; }
  std::string_view operator()(const Coolant&) const { return "a switch of the coolant"; }
  std::string_view operator()(const SetMode&) const { return "a change of a mode"; }
  std::string_view operator()(const Dwell&) const { return "a dwell"; }
  std::string_view operator()(const OpaqueBlock&) const { return "a block whose meaning is not known"; }
  std::string_view operator()(const Return&) const { return "a return"; }
  std::string_view
  operator()(const OneOf<Assign, Store, Label, Jump, Branch, Stop, Alarm, Comment, Port, Print> auto&) const {
    return "";
  }
};

} // namespace

std::vector<ShapeFault> shapeFaults(const CycleStatement& statement, const Cycle& cycle) {
  return Shape(cycle).run(statement);
}

std::string_view notInChecks(const CycleStatement& statement) {
  return match(statement, Doing{});
}

bool isFinite(double value) {
  return std::isfinite(value);
}

} // namespace dotek::ir
