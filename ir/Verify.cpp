#include "ir/Verify.h"

#include "ir/CycleNames.h"
#include "ir/Flow.h"
#include "ir/Kinds.h"
#include "ir/Names.h"
#include "ir/Nulls.h"
#include "ir/VerifyShape.h"
#include "ir/Walk.h"

#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace dotek::ir {
namespace {

class Verifier {
public:
  explicit Verifier(const Cycle& cycle) : cycle_(cycle), names_(cycle) {}

  std::vector<Violation> run() {
    declarations();
    shapes(cycle_.checks);
    shapes(cycle_.body);
    for (const CycleStatement& statement : cycle_.checks)
      if (const std::string_view what = notInChecks(statement); !what.empty())
        report(statement.origin.range(), "the checks hold " + std::string(what));
    if (broken_) return std::move(out_);
    labels(cycle_.checks);
    labels(cycle_.body);
    const Nulls nulls = findNulls(cycle_);
    meanings(cycle_.checks, nulls.checks);
    meanings(cycle_.body, nulls.body);
    return std::move(out_);
  }

private:
  void report(SourceRange range, std::string message, bool mixedKinds = false) {
    out_.push_back({range, std::move(message), mixedKinds});
  }
  // The narrowest place that is known.
  static SourceRange place(SourceRange inner, const CycleStatement& statement) {
    return inner.hasPlace() ? inner : statement.origin.range();
  }
  std::string text(const Expression& expression) const {
    std::string out = "`";
    write(expression, names_, out);
    return out + "`";
  }

  void declarations() {
    std::unordered_set<std::string_view> seen;
    for (const LabelName& label : cycle_.labels)
      if (!seen.insert(label.name).second)
        report(label.range, "two labels have the name `" + label.name + "`");
    for (const Variable& variable : cycle_.variables)
      if (variable.defaultValue && !isFinite(*variable.defaultValue))
        report(variable.range, "the default of `" + variable.name + "` is no finite number");
  }

  void shapes(const std::vector<CycleStatement>& list) {
    for (const CycleStatement& statement : list) {
      for (ShapeFault& fault : shapeFaults(statement, cycle_)) {
        report(place(fault.range, statement), std::move(fault.message));
        broken_ |= fault.breaks;
      }
    }
  }

  void labels(const std::vector<CycleStatement>& list) {
    std::unordered_set<LabelId> placed;
    for (const CycleStatement& statement : list) {
      const auto* label = std::get_if<Label>(&statement.node);
      if (label && !placed.insert(label->label).second)
        report(statement.origin.range(), "label `" + names_.label(label->label) + "` is placed twice");
    }
    for (const CycleStatement& statement : list) {
      const std::optional<LabelId> target = targetOf(statement);
      if (target && !placed.contains(*target))
        report(statement.origin.range(),
               "a jump goes to label `" + names_.label(*target) + "`, which its list does not hold");
    }
  }

  void meanings(const std::vector<CycleStatement>& list, const std::vector<NumberSet>& nulls) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      kinds(list[i]);
      nullsOf(list[i], nulls[i]);
    }
  }

  // ---- kinds ----------------------------------------------------------------------------------------------

  Kind kindOf(const ExpressionPtr& expression, const CycleStatement& statement) {
    return ir::kindOf(expression, cycle_, [&](const Expression& whole, Kind left, Kind right) {
      mixed(whole.range, text(whole), left, right, statement);
    });
  }

  void mixed(SourceRange range, const std::string& what, Kind left, Kind right,
             const CycleStatement& statement) {
    report(place(range, statement),
           what + " mixes the kinds " + std::string(kindName(left)) + " and " + std::string(kindName(right)),
           true);
  }

  static bool differ(Kind a, Kind b) { return a != b && a != Kind::Number && b != Kind::Number; }

  void kinds(const CycleStatement& statement) {
    match(
        statement, [&](const Branch& node) { kinds(node.condition, statement); },
        [&](const Assign& node) {
          const Kind value = kindOf(node.value, statement);
          const Kind variable = cycle_.variables[node.variable].kind;
          if (differ(value, variable))
            mixed(node.value->range, "`" + names_.variable(node.variable) + "` = " + text(*node.value),
                  variable, value, statement);
        },
        [&](const OneOf<Store, Label, Jump, Return, Move, Measure, CallCycle, ProbePower, Spindle, Coolant,
                        SetMode, Dwell, Stop, Alarm, Comment, OpaqueBlock, Port, Print> auto&) {
          slotKinds(statement);
        });
  }

  void slotKinds(const CycleStatement& statement) {
    std::set<const Expression*> required;
    eachRequirement(statement, [&](const ExpressionPtr& expression, Kind wanted) {
      required.insert(expression.get());
      const Kind kind = kindOf(expression, statement);
      if (!differ(kind, wanted)) return;
      report(place(expression->range, statement),
             text(*expression) + " is of the kind " + std::string(kindName(kind)) + "; the kind " +
                 std::string(kindName(wanted)) + " is needed here",
             true);
    });
    eachSlot(statement, [&](const ExpressionPtr& slot) {
      if (!required.contains(slot.get())) kindOf(slot, statement);
    });
  }

  void kinds(const ConditionPtr& condition, const CycleStatement& statement) {
    match(
        *condition,
        [&](const Comparison& node) {
          const Kind left = kindOf(node.left, statement);
          const Kind right = kindOf(node.right, statement);
          if (!differ(left, right)) return;
          std::string what = "`";
          write(*condition, names_, what);
          mixed(condition->range, what + "`", left, right, statement);
        },
        [&](const IsNull& node) { kindOf(node.value, statement); },
        [&](const Not& node) { kinds(node.inner, statement); },
        [&](const Junction& node) {
          kinds(node.left, statement);
          kinds(node.right, statement);
        },
        [](const Truth&) {});
  }

  // ---- null -----------------------------------------------------------------------------------------------

  void nullsOf(const CycleStatement& statement, const NumberSet& nulls) {
    match(
        statement, [&](const Branch& node) { nullsOf(node.condition, statement, nulls); },
        [&](const OneOf<Assign, OpaqueBlock, Port, Print> auto&) { slotNulls(true, statement, nulls); },
        // What its caller leaves out a program may be given as it is.
        [&](const CallCycle& node) { slotNulls(node.cycle == kProgram, statement, nulls); },
        [&](const OneOf<Store, Label, Jump, Return, Move, Measure, ProbePower, Spindle, Coolant, SetMode,
                        Dwell, Stop, Alarm, Comment> auto&) { slotNulls(false, statement, nulls); });
  }

  void slotNulls(bool free, const CycleStatement& statement, const NumberSet& nulls) {
    eachSlot(statement, [&](const ExpressionPtr& slot) { nullsOf(slot, free, statement, nulls); });
  }

  // `free`: the value itself may be null.
  void nullsOf(const ExpressionPtr& expression, bool free, const CycleStatement& statement,
               const NumberSet& nulls) {
    if (!free && mayBeNull(expression, nulls))
      report(place(expression->range, statement),
             text(*expression) + " may be null where a number is needed");
    match(
        *expression, [&](const MachineVariable& node) { nullsOf(node.number, false, statement, nulls); },
        [&](const Unary& node) { nullsOf(node.operand, node.op == UnaryOp::NullAsZero, statement, nulls); },
        [&](const Binary& node) {
          // Whether ValueOr as a whole may be null was looked at above.
          const bool valueOr = node.op == BinaryOp::ValueOr;
          nullsOf(node.left, valueOr, statement, nulls);
          nullsOf(node.right, valueOr, statement, nulls);
        },
        [](const OneOf<Constant, NullValue, VariableUse, MeasuredResult> auto&) {});
  }

  void nullsOf(const ConditionPtr& condition, const CycleStatement& statement, const NumberSet& nulls) {
    match(
        *condition,
        [&](const Comparison& node) {
          nullsOf(node.left, false, statement, nulls);
          nullsOf(node.right, false, statement, nulls);
        },
        [&](const IsNull& node) { nullsOf(node.value, true, statement, nulls); },
        [&](const Not& node) { nullsOf(node.inner, statement, nulls); },
        [&](const Junction& node) {
          nullsOf(node.left, statement, nulls);
          // `x is not null and x < 5`: the right side is looked at where x is a number.
          bool isNot = false; // of the test: `is not null`
          const auto* use = nullTest(node.left, isNot);
          NumberSet rest = nulls;
          if (use && isNot == (node.op == Connective::And)) rest.erase(use->variable);
          nullsOf(node.right, statement, rest);
        },
        [](const Truth&) {});
  }

  const Cycle& cycle_;
  Names names_;
  std::vector<Violation> out_;
  bool broken_ = false; // expressions cannot be walked
};

} // namespace

std::vector<Violation> verify(const Cycle& cycle) {
  return Verifier(cycle).run();
}

} // namespace dotek::ir
