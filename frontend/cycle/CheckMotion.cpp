// Where the stylus is while a cycle runs, as far as its lines show it: moves that nothing watches, an end
// below the start, a spindle that nobody has stopped. Warnings.
#include "frontend/cycle/Checker.h"
#include "frontend/cycle/Walk.h"
#include "support/messages/Cycle.h"

#include <algorithm>
#include <optional>

namespace dotek::frontend::cycle {

namespace {

struct Stylus {
  // Among the part: after a protected move or a touch, until a move along z alone takes it up.
  bool down = false;
  int raised = 0;                     // moves upward that none downward has taken back
  std::optional<SourceRange> lowered; // by this move, and not taken up since
  bool ended = false;                 // by an alarm
};

Stylus joined(const Stylus& a, const Stylus& b) {
  if (a.ended) return b;
  if (b.ended) return a;
  return {a.down && b.down, std::min(a.raised, b.raised), a.lowered ? a.lowered : b.lowered, false};
}

bool isNegative(const Expression& expression) {
  if (const auto* bracketed = std::get_if<Bracketed>(&expression.node)) return isNegative(*bracketed->inner);
  if (const auto* unary = std::get_if<Unary>(&expression.node)) return unary->op == UnaryOp::Negate;
  const auto* binary = std::get_if<Binary>(&expression.node);
  return binary != nullptr &&
         (binary->op == BinaryOp::Multiply || binary->op == BinaryOp::Divide ||
          binary->op == BinaryOp::Subtract || binary->op == BinaryOp::Add) &&
         isNegative(*binary->left);
}

class Motion {
public:
  explicit Motion(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void run(const File& file) {
    const Stylus last = block(file.body, {});
    if (!last.ended && last.lowered) diagnostics_.report<diag::EndsLower>(*last.lowered);
  }

private:
  Stylus block(const Block& all, Stylus stylus) {
    for (const Statement& one : all.statements)
      stylus = statement(one, stylus);
    return stylus;
  }

  Stylus statement(const Statement& one, Stylus stylus) {
    if (const auto* to = std::get_if<Move>(&one.node)) {
      move(*to, one, stylus);
    } else if (const auto* probe = std::get_if<ProbeSwitch>(&one.node)) {
      if (!probe->on) stylus.down = false;
    } else if (std::holds_alternative<Alarm>(one.node)) {
      stylus.ended = true;
    } else if (std::holds_alternative<Call>(one.node)) {
      stylus.down = false; // it ends where it says
    } else if (const auto* touch = std::get_if<Touch>(&one.node)) {
      stylus.down = true;
      if (touch->otherwise != nullptr) stylus = joined(stylus, block(*touch->otherwise, stylus));
    } else if (const auto* choice = std::get_if<If>(&one.node)) {
      Stylus after = choice->otherwise == nullptr ? stylus : block(*choice->otherwise, stylus);
      for (const If::Part& part : choice->parts)
        after = joined(after, block(part.body, stylus));
      stylus = after;
    } else if (const Block* body = loopIn(one)) {
      stylus = joined(stylus, block(*body, stylus));
    }
    return stylus;
  }

  static const Block* loopIn(const Statement& one) {
    if (const auto* repeat = std::get_if<Repeat>(&one.node)) return &repeat->body;
    if (const auto* counted = std::get_if<For>(&one.node)) return &counted->body;
    const auto* loop = std::get_if<While>(&one.node);
    return loop == nullptr ? nullptr : &loop->body;
  }

  void move(const Move& move, const Statement& one, Stylus& stylus) {
    const Coordinate* z = nullptr;
    bool across = move.toStart;
    for (const Coordinate& part : move.axes) {
      if (part.axis == Axis::Z) z = &part;
      if (part.axis < Axis::Z && part.frame != Coordinate::Frame::Machine) across = true;
    }
    const bool watched = move.kind == Move::Kind::Protected;
    if (stylus.down && !watched && across)
      diagnostics_.report<diag::MoveUnwatched>(one.range,
                                               move.kind == Move::Kind::Feed ? "feed move" : "rapid move");
    if (move.toStart) {
      stylus = {};
      return;
    }
    const bool downward = z != nullptr && move.reach == Reach::By && isNegative(*z->value);
    if (z != nullptr) {
      if (!downward) stylus.lowered.reset();
      if (downward && stylus.raised == 0) stylus.lowered = one.range;
      stylus.raised = downward ? std::max(0, stylus.raised - 1) : stylus.raised + 1;
    }
    if (z != nullptr && !across) {
      stylus.down = watched && downward;
    } else if (watched) {
      stylus.down = stylus.down || downward;
    }
  }

  Diagnostics& diagnostics_;
};

} // namespace

void checkMotion(const File& file, Diagnostics& diagnostics) {
  Motion(diagnostics).run(file);
  bool needs = false, stopped = false, measures = false;
  std::optional<SourceRange> first; // that switches the probe on
  eachStatement(file.body, [&](const Statement& one) {
    needs = needs || std::holds_alternative<Needs>(one.node);
    if (std::holds_alternative<SpindleOff>(one.node) && !first) stopped = true;
    measures = measures || std::holds_alternative<Touch>(one.node);
    const auto* probe = std::get_if<ProbeSwitch>(&one.node);
    if (probe != nullptr && probe->on && !first) first = one.range;
  });
  if (first && measures && !needs && !stopped) diagnostics.report<diag::SpindleUnstopped>(*first);
}

} // namespace dotek::frontend::cycle
