// What a cycle may say and hardly means: loops that never run or never end, names that are given twice before
// anybody reads them, comparisons with one answer. Warnings.
#include "frontend/cycle/Checker.h"
#include "frontend/cycle/Walk.h"
#include "ir/Match.h"
#include "support/Ascii.h"
#include "support/messages/Cycle.h"

#include <fmt/format.h>
#include <optional>
#include <string_view>

namespace dotek::frontend::cycle {

namespace {

bool isPartOfName(char c) {
  return isLetter(c) || isDigit(c) || c == '_';
}

bool holdsWord(std::string_view text, std::string_view word) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string_view::npos; at += word.size()) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !isPartOfName(text[at - 1])) && (end == text.size() || !isPartOfName(text[end])))
      return true;
  }
  return false;
}

const Expression& within(const Expression& expression) {
  const auto* bracketed = std::get_if<Bracketed>(&expression.node);
  return bracketed == nullptr ? expression : within(*bracketed->inner);
}

// Never below 0, whatever it reads.
bool isNeverNegative(const Expression& expression) {
  const auto* function = std::get_if<Function>(&within(expression).node);
  return function != nullptr &&
         (function->name.text == "abs" || function->name.text == "sqrt" || function->name.text == "square");
}

// Each part of the expression, the whole one first.
template <class Visit> void eachPart(const Expression& expression, const Visit& visit) {
  visit(expression);
  std::visit(ir::Overloaded{[&](const Unary& one) { eachPart(*one.operand, visit); },
                            [&](const Binary& one) {
                              eachPart(*one.left, visit);
                              eachPart(*one.right, visit);
                            },
                            [&](const Function& one) {
                              for (const ExpressionPtr& argument : one.arguments)
                                eachPart(*argument, visit);
                            },
                            [&](const Bracketed& one) { eachPart(*one.inner, visit); }, [](const auto&) {}},
             expression.node);
}

// What the statement asks or computes, without the blocks in it.
template <class Visit> void eachExpression(const Statement& statement, const Visit& visit) {
  if (const auto* choice = std::get_if<If>(&statement.node))
    for (const If::Part& part : choice->parts)
      visit(*part.condition);
  if (const auto* loop = std::get_if<While>(&statement.node)) visit(*loop->condition);
  if (const auto* require = std::get_if<Require>(&statement.node)) visit(*require->condition);
  if (const auto* assign = std::get_if<Assign>(&statement.node)) visit(*assign->value);
  if (const auto* report = std::get_if<Report>(&statement.node)) visit(*report->measured);
}

// What a touch, a call or an assignment gives; nullptr: the statement gives nothing.
const Name* givenBy(const Statement& statement) {
  if (const auto* assign = std::get_if<Assign>(&statement.node)) return &assign->name;
  if (const auto* touch = std::get_if<Touch>(&statement.node)) return touch->name ? &*touch->name : nullptr;
  if (const auto* call = std::get_if<Call>(&statement.node)) return call->result ? &*call->result : nullptr;
  return nullptr;
}

} // namespace

void Checker::slips(const Block& block) {
  const auto& all = block.statements;
  means(block);
  for (std::size_t i = 0; i < all.size(); ++i) {
    neverRead(all, i);
    if (const auto* loop = std::get_if<For>(&all[i].node)) neverRuns(*loop, all[i]);
    if (const auto* loop = std::get_if<While>(&all[i].node)) neverEnds(*loop);
    eachExpression(all[i], [&](const Expression& expression) {
      eachPart(expression, [&](const Expression& part) {
        oneAnswer(part);
        meanOf(part);
        bothLimits(part);
      });
    });
  }
}

// `touch x by gap -> side`, then `touch y by gap -> side`, and nobody has read the first.
void Checker::neverRead(const std::vector<Statement>& all, std::size_t at) {
  const Name* const name = givenBy(all[at]);
  if (name == nullptr || std::holds_alternative<Assign>(all[at].node)) return;
  for (std::size_t i = at + 1; i < all.size(); ++i) {
    const Name* const again = givenBy(all[i]);
    const bool same = again != nullptr && again->text == name->text;
    // What comes before the name in its own line may read the first.
    const SourceRange read =
        same ? SourceRange{all[i].range.file, all[i].range.begin, again->range.begin} : all[i].range;
    if (holdsWord(sources_.text(read), name->text)) return;
    if (!same) continue;
    diagnostics_.report<diag::FoundTwice>(name->range, name->text, sources_.line(again->range))
        .note(again->range, "it is given again here");
    return;
  }
}

void Checker::neverRuns(const For& loop, const Statement& statement) {
  const std::optional<double> from = constant(loop.first), to = constant(loop.last);
  const std::optional<double> step = loop.step == nullptr ? 1 : constant(loop.step);
  if (!from || !to || !step || (*step > 0 ? *from <= *to : *from >= *to)) return;
  const SourceRange head{statement.range.file, statement.range.begin,
                         (loop.step == nullptr ? loop.last : loop.step)->range.end};
  diagnostics_.report<diag::LoopNeverRuns>(head, *step > 0 ? "up" : "down", text(loop.first->range),
                                           text(loop.last->range),
                                           *step > 0 ? "; write `step -1` to count down" : "");
}

void Checker::neverEnds(const While& loop) {
  const std::string_view condition = sources_.text(loop.condition->range);
  bool changes = false;
  eachStatement(loop.body, [&](const Statement& one) {
    const Name* const name = givenBy(one);
    changes = changes || std::holds_alternative<SetTool>(one.node) ||
              std::holds_alternative<SetStored>(one.node) ||
              std::holds_alternative<ErrorStatement>(one.node) ||
              (name != nullptr && holdsWord(condition, name->text));
  });
  if (!changes)
    diagnostics_.report<diag::LoopUnchanged>(loop.condition->range, text(loop.condition->range),
                                             text(loop.most->range));
}

// `abs(error) > -0.1 mm`, `side.at - side.at`.
void Checker::oneAnswer(const Expression& expression) {
  const auto* binary = std::get_if<Binary>(&expression.node);
  if (binary == nullptr) return;
  const std::string left = text(binary->left->range), right = text(binary->right->range);
  const bool value = std::holds_alternative<NameUse>(within(*binary->left).node) ||
                     std::holds_alternative<Member>(within(*binary->left).node);
  if (value && left == right) {
    const bool difference = binary->op == BinaryOp::Subtract;
    const bool holds = binary->op == BinaryOp::LessEqual || binary->op == BinaryOp::GreaterEqual ||
                       binary->op == BinaryOp::Is;
    const bool compares = holds || binary->op == BinaryOp::Less || binary->op == BinaryOp::Greater ||
                          binary->op == BinaryOp::IsNot;
    if (difference || compares)
      diagnostics_.report<diag::ComparedAlways>(expression.range, text(expression.range),
                                                difference ? "0"
                                                : holds    ? "true"
                                                           : "false",
                                                fmt::format("`{}` is on both sides", left));
    return;
  }
  const bool turned = isNeverNegative(*binary->right);
  if (!turned && !isNeverNegative(*binary->left)) return;
  const std::optional<double> limit = constant(turned ? binary->left : binary->right);
  if (!limit) return;
  const bool above = binary->op == (turned ? BinaryOp::Less : BinaryOp::Greater) ||
                     binary->op == (turned ? BinaryOp::LessEqual : BinaryOp::GreaterEqual);
  const bool below = binary->op == (turned ? BinaryOp::Greater : BinaryOp::Less) ||
                     binary->op == (turned ? BinaryOp::GreaterEqual : BinaryOp::LessEqual);
  const bool orEqual = binary->op == BinaryOp::LessEqual || binary->op == BinaryOp::GreaterEqual;
  // At 0 `>= 0` always holds and `< 0` never does.
  const bool always = above && (*limit < 0 || (*limit == 0 && orEqual));
  const bool never = below && (*limit < 0 || (*limit == 0 && !orEqual));
  if (always || never)
    diagnostics_.report<diag::ComparedAlways>(expression.range, text(expression.range),
                                              always ? "true" : "false",
                                              fmt::format("`{}` is never below 0", turned ? right : left));
}

} // namespace dotek::frontend::cycle
