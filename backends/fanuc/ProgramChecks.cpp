#include "backends/fanuc/ProgramChecks.h"

#include "backends/fanuc/MacroNames.h"
#include "backends/fanuc/ProgramText.h"
#include "backends/fanuc/ProgramVariables.h"
#include "backends/fanuc/WrittenFirst.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

namespace dotek::backends::fanuc {

namespace {

constexpr std::uint32_t kFirstSystem = 1000;
constexpr std::size_t kMostCalls = 64; // no control nests calls that deep

// The whole number that the control reads; nullopt: computed.
std::optional<std::uint32_t> wholeOf(const ir::ExpressionPtr& expression) {
  const double* value = expression ? ir::constantValue(expression) : nullptr;
  if (value == nullptr || std::abs(*value) > 99999999 || *value < 0) return std::nullopt;
  return static_cast<std::uint32_t>(std::lround(*value));
}

// What to write in place of a function that the target lacks; "": nothing known.
std::string_view workaround(std::string_view function) {
  if (function == "MOD") return "for whole numbers write `#1-FIX[#1/#2]*#2`";
  if (function == "POW") return "write the product, or `EXP[#2*LN[#1]]` where both exist";
  if (function == "ATAN[y]/[x]" || function == "ATAN[y,x]")
    return "divide in brackets, `ATAN[#1/#2]`, and add 180 degrees where x is negative";
  if (function == "ASIN") return "write `ATAN[#1/SQRT[1-#1*#1]]`";
  if (function == "ACOS") return "write `90-ATAN[#1/SQRT[1-#1*#1]]`";
  if (function == "ADP") return "write the point where the program is called";
  return "compute it before, or take another control";
}

class Variables {
public:
  Variables(ir::Program& program, AnyVariable& any, const ProgramContext& context)
      : program_(program), any_(any), context_(context) {}

  void run() {
    for (ir::ProgramStatement& statement : program_.body) {
      statement_ = &statement;
      if (auto* store = std::get_if<ir::Store>(&statement.node)) stored(*store);
      ir::rewrite(statement, [&](const ir::ExpressionPtr& expression) { return used(expression); });
      match(
          statement,
          [&](ir::OneOf<ir::Print> auto& node) {
            for (ir::PrintPiece& piece : node.pieces)
              if (piece.number) piece.number = there(*piece.number, statement.origin.range());
          },
          [&](const ir::OneOf<ir::NameVariables> auto& node) {
            for (std::uint32_t i = 0; i < node.names.size(); ++i)
              there(node.first + i, statement.origin.range());
          },
          // Their variables are in expressions.
          [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Comment, ir::NcBlock, ir::JumpTo,
                             ir::Loop, ir::LoopEnd, ir::Call, ir::Exit, ir::Raise, ir::Notice,
                             ir::Port> auto&) {});
    }
  }

private:
  // The program, or a call of a vendor's macro, has written it on every way: what the control keeps at power
  // off makes no difference.
  bool isFilled(std::uint32_t number) {
    auto [found, isNew] = unwritten_.try_emplace(number);
    if (!flow_) flow_ = ir::flowOf(program_.body);
    if (isNew)
      found->second = reachedUnwritten(program_.body, *flow_, [&](const ir::ProgramStatement& statement) {
        if (statement.blockDelete != 0) return false;
        if (const auto* store = std::get_if<ir::Store>(&statement.node))
          return wholeOf(store->number) == number;
        const auto* call = std::get_if<ir::Call>(&statement.node);
        return call != nullptr && leaves(*call, number);
      });
    return !found->second[static_cast<std::size_t>(statement_ - program_.body.data())];
  }

  bool leaves(const ir::Call& call, std::uint32_t number) const {
    const auto called = wholeOf(call.program);
    if (call.kind != ir::CallKind::Macro || !called || call.repeats != nullptr) return false;
    std::string letters;
    for (const ir::CallArgument& one : call.arguments)
      letters += one.letter;
    bool found = false;
    for (const stdlib::MacroSet* set : context_.options.macros)
      for (const stdlib::MacroSignature& signature : set->signatures) {
        if (signature.program != *called || !signature.fits(letters)) continue;
        const bool fills = std::any_of(
            signature.results.begin(), signature.results.end(),
            [&](const stdlib::MacroResult& one) { return one.documented && one.variable == number; });
        if (!fills) return false;
        found = true;
      }
    return found;
  }

  std::uint32_t there(std::uint32_t number, SourceRange range, bool reads = false) {
    const VariableThere found = variableThere(number, context_.from(), context_.to());
    if (!found.number) {
      // What the program itself reads of it is asked where it reads.
      if (found.onlyKeptOtherwise && (reads ? isFilled(number) : !found.lost)) return number;
      context_.diagnostics.report<diag::VariableElsewhere>(range, number, found.why);
    } else if (*found.number != number) {
      context_.diagnostics.report<diag::VariableMoved>(range, number, found.what, *found.number,
                                                       context_.to().title);
    }
    return found.number.value_or(number);
  }

  void stored(ir::Store& store) {
    const SourceRange range = statement_->origin.range();
    if (const auto number = wholeOf(store.number)) {
      const std::uint32_t moved = there(*number, range);
      if (moved != *number) store.number = ir::constant(moved, store.number->range, std::to_string(moved));
      if (!context_.same() && context_.to().isReadOnly(moved))
        context_.diagnostics.report<diag::VariableReadOnly>(range, moved, context_.to().title);
    } else {
      computed(store.number);
    }
  }

  ir::ExpressionPtr used(const ir::ExpressionPtr& expression) {
    const auto* machine = std::get_if<ir::MachineVariable>(&expression->node);
    if (machine == nullptr) return expression;
    const auto number = wholeOf(machine->number);
    if (!number) {
      computed(machine->number);
      return expression;
    }
    const std::uint32_t moved = there(*number, expression->range, true);
    if (moved == *number) return expression;
    return ir::machineVariable(ir::constant(moved, machine->number->range, std::to_string(moved)),
                               expression->range);
  }

  void computed(const ir::ExpressionPtr& number) {
    if (context_.same()) return;
    const SourceRange range = number->range.hasPlace() ? number->range : statement_->origin.range();
    const auto base = ir::firstNumber(number);
    const bool system = base && *base >= kFirstSystem;
    const bool same = any_.same();
    const bool known = system && (variableThere(*base, context_.from(), context_.to()).number ||
                                  variableThere(*base + 1, context_.from(), context_.to()).number);
    const bool holds =
        system ? same && known
               : same || any_.holds() || (base && sharesVariablesFrom(*base, context_.to(), context_.from()));
    if (!holds)
      context_.diagnostics.report<diag::VariableNumberComputed>(range, context_.to().title,
                                                                context_.from().title);
    else if (!system && !(same && base) && !std::exchange(told_, true))
      context_.diagnostics.report<diag::VariableNumberOpen>(range, context_.from().title,
                                                            context_.to().title);
  }

  ir::Program& program_;
  AnyVariable& any_;
  const ProgramContext& context_;
  ir::ProgramStatement* statement_ = nullptr;
  std::optional<ir::ProgramFlow> flow_; // of the body, once it is asked for
  std::map<std::uint32_t, std::vector<bool>> unwritten_;
  bool told_ = false;
};

class Checks {
public:
  Checks(const ir::Program& program, CallLevels& levels, const ProgramContext& context)
      : program_(program), levels_(levels), context_(context) {}

  void run() {
    for (const ir::ProgramStatement& statement : program_.body) {
      statement_ = &statement;
      ir::eachNode(statement, [&](const ir::Expression& node) { expression(node); });
      if (context_.same()) continue;
      match(
          statement, [&](const ir::Raise& node) { alarm(node); }, [&](const ir::Call& node) { called(node); },
          [&](const ir::OneOf<ir::Print, ir::Port, ir::NameVariables> auto&) { output(); },
          [&](const ir::Notice&) {
            if (!context_.to().variables.message)
              context_.diagnostics.report<diag::VariableElsewhere>(
                  statement.origin.range(), 3006,
                  "waits for the operator, which " + context_.to().title + " has no variable for");
          },
          [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Comment, ir::NcBlock, ir::JumpTo,
                             ir::Loop, ir::LoopEnd, ir::Exit> auto&) {});
    }
    if (!context_.same()) levels();
  }

private:
  SourceRange placeOf(const ir::Expression& node) const {
    return node.range.hasPlace() ? node.range : statement_->origin.range();
  }

  // ---- numbers and functions

  void expression(const ir::Expression& node) {
    digitsKept(node);
    if (const auto* constant = std::get_if<ir::Constant>(&node.node)) return digits(*constant, node);
    if (const auto* unary = std::get_if<ir::Unary>(&node.node)) {
      const std::string_view key = functionKey(unary->op);
      if (!key.empty() && known(key, node) && unary->op == ir::UnaryOp::ArcTangent) known("ATAN[y]", node);
      if (unary->op == ir::UnaryOp::RoundIncrement && context_.to().increment != context_.from().increment)
        context_.diagnostics.report<diag::ProgramFunction>(
            placeOf(node), context_.to().title, "ROUND of a word to " + numberText(context_.from().increment),
            "its least increment is another; round with FIX");
    } else if (const auto* binary = std::get_if<ir::Binary>(&node.node)) {
      const std::string_view key = functionKey(binary->op);
      if (binary->op == ir::BinaryOp::Bearing) {
        const auto& functions = context_.to().functions;
        if (!functions.contains("ATAN[y,x]")) known("ATAN[y]/[x]", node);
      } else if (!key.empty()) {
        known(key, node);
      } else if (!isArithmetic(binary->op)) {
        notOfPrograms("an operator");
      }
    } else if (std::holds_alternative<ir::VariableUse>(node.node) ||
               std::holds_alternative<ir::MeasuredResult>(node.node)) {
      notOfPrograms("a variable of a cycle");
    }
  }

  // Reported once: results that one control rounds and the other does not.
  void digitsKept(const ir::Expression& node) {
    if (context_.to().arithmetic == context_.from().arithmetic || arithmeticTold_) return;
    if (const auto* unary = std::get_if<ir::Unary>(&node.node)) {
      using Op = ir::UnaryOp;
      const bool exact = unary->op == Op::Negate || unary->op == Op::NullAsZero || unary->op == Op::Absolute;
      if (exact) return;
    } else if (const auto* binary = std::get_if<ir::Binary>(&node.node)) {
      // A counter is the same on both.
      const bool sum = binary->op == ir::BinaryOp::Add || binary->op == ir::BinaryOp::Subtract;
      const double* step = ir::constantValue(binary->right);
      if (sum && step != nullptr && *step == std::floor(*step)) return;
    } else {
      return;
    }
    arithmeticTold_ = true;
    const auto kept = [](const stdlib::Control& control) {
      return control.arithmetic == stdlib::Arithmetic::Decimal8 ? "eight digits" : "fifteen digits";
    };
    context_.diagnostics.report<diag::ArithmeticElsewhere>(placeOf(node), context_.from().title,
                                                           kept(context_.from()), context_.to().title,
                                                           kept(context_.to()));
  }

  static bool isArithmetic(ir::BinaryOp op) {
    return op == ir::BinaryOp::Add || op == ir::BinaryOp::Subtract || op == ir::BinaryOp::Multiply ||
           op == ir::BinaryOp::Divide;
  }
  void notOfPrograms(const char* what) {
    context_.diagnostics.report<diag::StatementNotOfProgram>(statement_->origin.range(), what);
  }

  bool known(std::string_view key, const ir::Expression& node) {
    if (context_.to().functions.contains(std::string(key))) return true;
    context_.diagnostics.report<diag::ProgramFunction>(placeOf(node), context_.to().title, key,
                                                       workaround(key));
    return false;
  }

  void digits(const ir::Constant& constant, const ir::Expression& node) {
    const std::string text = constant.digits.empty() ? numberText(constant.value) : constant.digits;
    const auto count = static_cast<std::uint32_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; }));
    if (count > context_.to().digits)
      context_.diagnostics.report<diag::ConstantDigits>(placeOf(node), text, count, context_.to().title,
                                                        context_.to().digits);
  }

  // ---- messages and output

  void alarm(const ir::Raise& raise) {
    const stdlib::Control& to = context_.to();
    const SourceRange range = statement_->origin.range();
    if (!to.variables.alarm)
      context_.diagnostics.report<diag::VariableElsewhere>(
          range, 3000, "raises an alarm, which " + to.title + " has no variable for");
    const auto number = wholeOf(raise.number);
    if (number && (*number < to.alarmFirst || *number > to.alarmLast))
      context_.diagnostics.report<diag::AlarmNumberThere>(range, *number, to.title, to.alarmFirst,
                                                          to.alarmLast);
  }

  void output() {
    if (!std::exchange(outputTold_, true))
      context_.diagnostics.report<diag::OutputNotKnown>(statement_->origin.range(), context_.to().title);
  }

  // ---- calls

  void called(const ir::Call& call) {
    const auto number = wholeOf(call.program);
    // Repeats and four digits of the number, on both.
    if (call.kind == ir::CallKind::Subprogram && context_.to().repeatInProgram &&
        context_.from().repeatInProgram)
      return;
    if (number && *number > context_.to().programLast)
      context_.diagnostics.report<diag::CalledProgramRange>(statement_->origin.range(), *number,
                                                            context_.to().programLast, context_.to().title);
  }

  void levels() {
    const std::uint32_t most = levels_.from(program_);
    if (most > context_.to().macroLevels)
      context_.diagnostics.report<diag::MacroLevelsThere>(program_.range, most, context_.to().title,
                                                          context_.to().macroLevels);
  }

  const ir::Program& program_;
  CallLevels& levels_;
  const ProgramContext& context_;
  const ir::ProgramStatement* statement_ = nullptr;
  bool outputTold_ = false;
  bool arithmeticTold_ = false;
};

} // namespace

bool AnyVariable::same() {
  if (!same_) same_ = sameVariables(context_.from(), context_.to());
  return *same_;
}

bool AnyVariable::holds() {
  if (!holds_) holds_ = holdsVariablesOf(context_.to(), context_.from());
  return *holds_;
}

CallLevels::CallLevels(const ir::ProgramFile& file) {
  for (const ir::Program& one : file.programs)
    byNumber_.emplace(one.number, &one);
}

std::uint32_t CallLevels::from(const ir::Program& program) {
  if (const auto known = depth_.find(&program); known != depth_.end()) return known->second;
  if (open_.size() > kMostCalls || !open_.insert(&program).second) return 0u;
  std::uint32_t most = 0;
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* call = std::get_if<ir::Call>(&statement.node);
    if (call == nullptr || call->kind == ir::CallKind::Off) continue;
    const auto number = wholeOf(call->program);
    const auto target = number ? byNumber_.find(*number) : byNumber_.end();
    const std::uint32_t below = target == byNumber_.end() ? 0 : from(*target->second);
    most = std::max(most, below + (call->kind == ir::CallKind::Subprogram ? 0 : 1));
  }
  open_.erase(&program);
  return depth_[&program] = most;
}

void translateVariables(ir::Program& program, AnyVariable& any, const ProgramContext& context) {
  Variables(program, any, context).run();
}

void checkProgram(const ir::Program& program, CallLevels& levels, const ProgramContext& context) {
  Checks(program, levels, context).run();
}

} // namespace dotek::backends::fanuc
