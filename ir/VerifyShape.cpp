#include "ir/VerifyShape.h"

#include <cmath>
#include <utility>

namespace dotek::ir {
namespace {

class Shape {
public:
  explicit Shape(const Cycle& cycle) : cycle_(cycle) {}

  std::vector<ShapeFault> run(const Statement& statement) {
    std::visit([&](const auto& node) { look(node); }, statement.node);
    for (const auto& [letter, variable] : statement.origin.arguments)
      if (variable >= cycle_.variables.size()) absent("a variable of the origin");
    return std::move(out_);
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
    if (const auto* constant = std::get_if<Constant>(&expression.node)) {
      if (!isFinite(constant->value)) fault("a constant is no finite number", expression.range);
    } else if (const auto* use = std::get_if<VariableUse>(&expression.node)) {
      if (use->variable >= cycle_.variables.size()) absent("a variable", expression.range);
    } else if (const auto* machine = std::get_if<MachineVariable>(&expression.node)) {
      need(machine->number, "the number of a machine variable");
    } else if (const auto* one = std::get_if<Unary>(&expression.node)) {
      need(one->operand, "an operand");
    } else if (const auto* two = std::get_if<Binary>(&expression.node)) {
      need(two->left, "an operand");
      need(two->right, "an operand");
    }
  }
  void need(const ConditionPtr& condition) {
    if (!condition) {
      out_.push_back({{}, "a condition is missing", true});
    } else if (const auto* comparison = std::get_if<Comparison>(&condition->node)) {
      need(comparison->left, "a side of a comparison");
      need(comparison->right, "a side of a comparison");
    } else if (const auto* null = std::get_if<IsNull>(&condition->node)) {
      need(null->value, "the value of a test for null");
    } else if (const auto* negated = std::get_if<Not>(&condition->node)) {
      need(negated->inner);
    } else if (const auto* junction = std::get_if<Junction>(&condition->node)) {
      need(junction->left);
      need(junction->right);
    }
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

  // ---- statements -----------------------------------------------------------------------------------------

  void look(const Assign& node) {
    if (node.variable >= cycle_.variables.size()) absent("a variable");
    need(node.value, "the value of an assignment");
  }
  void look(const Store& node) {
    need(node.number, "the number of a machine variable");
    need(node.value, "the value of a store");
  }
  void look(const Label& node) { label(node.label); }
  void look(const Jump& node) { label(node.target); }
  void look(const Branch& node) {
    need(node.condition);
    label(node.target);
  }
  void look(const Return&) {}
  void look(const Move& node) {
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
  void look(const Measure& node) {
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
  void look(const ProbePower&) {}
  void look(const Spindle& node) {
    if (node.speed && node.state == Spindle::State::Off) fault("a spindle that stops has a speed");
    allow(node.speed);
  }
  void look(const Coolant&) {}
  void look(const SetMode& node) {
    if (node.mode == Mode::WorkSystem)
      need(node.system, "the number of a work system");
    else if (node.system)
      fault("a mode that is no work system names one");
    if (node.mode != Mode::WorkSystem) allow(node.system);
  }
  void look(const Dwell& node) { need(node.seconds, "the time of a dwell"); }
  void look(const Stop&) {}
  void look(const Alarm&) {}
  void look(const Comment&) {}
  void look(const OpaqueBlock& node) {
    for (const Word& word : node.words) {
      if (word.address < 'A' || word.address > 'Z') fault("a word has no letter", word.range);
      allow(word.value);
    }
  }
  // The altitude of programs.
  template <class Other> void look(const Other&) { fault("a statement of programs stands in a cycle"); }
  void look(std::monostate) { fault("a statement does nothing"); }

  const Cycle& cycle_;
  std::vector<ShapeFault> out_;
};

struct Doing {
  std::string_view operator()(const Move&) const { return "a move"; }
  std::string_view operator()(const Measure&) const { return "a measurement"; }
  std::string_view operator()(const ProbePower&) const { return "a switch of the probe"; }
  std::string_view operator()(const Spindle&) const { return "a switch of the spindle"; }
  std::string_view operator()(const Coolant&) const { return "a switch of the coolant"; }
  std::string_view operator()(const SetMode&) const { return "a change of a mode"; }
  std::string_view operator()(const Dwell&) const { return "a dwell"; }
  std::string_view operator()(const OpaqueBlock&) const { return "a block whose meaning is not known"; }
  std::string_view operator()(const Return&) const { return "a return"; }
  template <class Other> std::string_view operator()(const Other&) const { return ""; }
};

} // namespace

std::vector<ShapeFault> shapeFaults(const Statement& statement, const Cycle& cycle) {
  return Shape(cycle).run(statement);
}

std::string_view notInChecks(const Statement& statement) {
  return std::visit(Doing{}, statement.node);
}

bool isFinite(double value) {
  return std::isfinite(value);
}

} // namespace dotek::ir
