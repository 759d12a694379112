// Flow of control within a branch: N numbers that a GOTO of the branch names, IF, WHILE.
#include "frontend/nc/Lifter.h"
#include "support/messages/Nc.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::frontend::nc {
namespace {

// Each round forgets what a jump back may have changed: at most four facts at each label.
constexpr int kMostRounds = 1000;

ModalState merged(const ModalState& a, const ModalState& b) {
  ModalState out = a;
  if (out.motion != b.motion) out.motion = std::nullopt;
  if (out.absolute != b.absolute) out.absolute = std::nullopt;
  if (out.feedPerMinute != b.feedPerMinute) out.feedPerMinute = std::nullopt;
  if (!ir::equal(out.feed, b.feed)) out.feed = nullptr;
  return out;
}

bool steers(const Block& block) {
  return block.statement.has_value();
}

// Labels for the numbers that a GOTO names; false where one has no block, or two.
bool declareTargets(const std::vector<Block>& blocks, LiftContext& context) {
  bool ok = true;
  for (const Block& block : blocks) {
    if (!block.statement) continue;
    const Statement& statement = *block.statement;
    if (statement.kind != Statement::Kind::GoTo && statement.kind != Statement::Kind::If) continue;
    if (context.flow.targets.contains(statement.number)) continue;
    const auto count = std::count_if(blocks.begin(), blocks.end(), [&](const Block& one) {
      return one.sequenceNumber == statement.number;
    });
    if (count == 1 && statement.number != 0) {
      const ir::LabelId label =
          context.cycle.addLabel({fmt::format("N{}", statement.number), statement.range});
      context.flow.targets.emplace(statement.number, label);
      continue;
    }
    context.diagnostics.report<diag::JumpOutOfBranch>(statement.range, statement.number,
                                                      count == 0 ? "no block" : "several blocks");
    ok = false;
  }
  return ok;
}

bool liftEach(const std::vector<Block>& blocks, LiftContext& context, std::vector<ir::CycleStatement>& out) {
  bool ok = true;
  for (const Block& block : blocks)
    ok = lift(block, context, out) && ok;
  for (const LiftFlow::Loop& loop : context.flow.loops) {
    context.diagnostics.report<diag::LoopUnbalanced>(loop.range,
                                                     fmt::format("`DO{0}` has no `END{0}`", loop.number));
    ok = false;
  }
  return ok;
}

} // namespace

bool liftAll(const std::vector<Block>& blocks, LiftContext& context, std::vector<ir::CycleStatement>& out) {
  if (std::none_of(blocks.begin(), blocks.end(), steers)) return liftEach(blocks, context, out);
  if (!declareTargets(blocks, context)) return false;
  for (int round = 0;; ++round) {
    Diagnostics found;
    LiftContext trial{context.control, context.macros, context.cycle, found};
    trial.fixed = context.fixed;
    trial.encoding = context.encoding;
    trial.flow.targets = context.flow.targets;
    trial.flow.arriving = context.flow.arriving;
    trial.flow.loopStates = context.flow.loopStates;
    std::vector<ir::CycleStatement> body;
    const bool ok = liftEach(blocks, trial, body);
    if (trial.flow.again && round < kMostRounds) {
      context.flow.arriving = std::move(trial.flow.arriving);
      context.flow.loopStates = std::move(trial.flow.loopStates);
      continue;
    }
    for (const Diagnostic& one : found.all())
      context.diagnostics.add(one);
    context.coarse = std::move(trial.coarse);
    context.blankZero = std::move(trial.blankZero);
    std::move(body.begin(), body.end(), std::back_inserter(out));
    return ok;
  }
}

// A jump to the label with what is in force here.
void Lifter::arrive(ir::LabelId label) {
  LiftFlow& flow = context_.flow;
  const auto [at, fresh] = flow.arriving.try_emplace(label, context_.state);
  if (!fresh) at->second = merged(at->second, context_.state);
  const auto entered = flow.entered.find(label);
  if (entered != flow.entered.end() && !(merged(entered->second, context_.state) == entered->second))
    flow.again = true;
}

void Lifter::enter(ir::LabelId label) {
  LiftFlow& flow = context_.flow;
  const auto at = flow.arriving.find(label);
  if (flow.reachable && at != flow.arriving.end())
    context_.state = merged(context_.state, at->second);
  else if (!flow.reachable)
    context_.state = at != flow.arriving.end()
                         ? at->second
                         : ModalState{std::nullopt, std::nullopt, std::nullopt, nullptr};
  flow.reachable = true;
  flow.entered.insert_or_assign(label, context_.state);
  add(ir::Label{label});
}

bool Lifter::statement() {
  const Statement& statement = *block_.statement;
  LiftFlow& flow = context_.flow;
  const auto target = flow.targets.find(statement.number);
  const bool jumps = statement.kind == Statement::Kind::GoTo || statement.kind == Statement::Kind::If;
  if (jumps && target == flow.targets.end())
    return refuse<diag::JumpOutOfBranch>(statement.range, statement.number, "no block");
  const auto number = [&] { return target->second; };
  ir::ConditionPtr condition;
  if (statement.condition) {
    condition = this->condition(*statement.condition);
    if (!condition) return false;
  }
  switch (statement.kind) {
  case Statement::Kind::GoTo:
    add(ir::Jump{number()});
    arrive(number());
    flow.reachable = false;
    return true;
  case Statement::Kind::If:
    add(ir::Branch{condition, number()});
    arrive(number());
    return true;
  case Statement::Kind::IfThen: {
    const ir::LabelId after = context_.cycle.addLabel({"after", statement.range});
    add(ir::Branch{ir::negate(condition), after});
    if (!assignments()) return false;
    flow.reachable = true;
    add(ir::Label{after});
    return true;
  }
  case Statement::Kind::While: {
    const LiftFlow::Loop loop = {statement.number, context_.cycle.addLabel({"loop", statement.range}),
                                 context_.cycle.addLabel({"end", statement.range}), statement.range};
    // The same loop of the next round has the same place.
    flow.loops.push_back(loop);
    const std::size_t place = flow.placed++;
    const auto known = flow.loopStates.find(place);
    if (known != flow.loopStates.end()) flow.arriving.insert_or_assign(loop.begin, known->second);
    enter(loop.begin);
    flow.loops.back().place = place;
    if (condition) {
      add(ir::Branch{ir::negate(condition), loop.end});
      arrive(loop.end);
    }
    return true;
  }
  case Statement::Kind::End: break;
  }
  if (flow.loops.empty() || flow.loops.back().number != statement.number)
    return refuse<diag::LoopUnbalanced>(
        statement.range,
        flow.loops.empty() ? fmt::format("`END{}` has no `DO`", statement.number)
                           : fmt::format("`END{}` ends `DO{}`", statement.number, flow.loops.back().number));
  const LiftFlow::Loop loop = flow.loops.back();
  flow.loops.pop_back();
  add(ir::Jump{loop.begin});
  if (flow.reachable) arrive(loop.begin);
  // Nothing comes back where an alarm or a jump ends each pass.
  const auto arrived = flow.arriving.find(loop.begin);
  if (arrived != flow.arriving.end()) flow.loopStates.insert_or_assign(loop.place, arrived->second);
  flow.reachable = false;
  enter(loop.end);
  return true;
}

ir::ConditionPtr Lifter::condition(const Condition& condition) {
  if (const auto* joined = std::get_if<Joined>(&condition.node)) {
    const ir::ConditionPtr left = this->condition(*joined->left);
    const ir::ConditionPtr right = left ? this->condition(*joined->right) : nullptr;
    if (!right) return nullptr;
    const SourceRange range = condition.range;
    if (joined->joint == Joint::Xor)
      return ir::join(ir::Connective::Or, ir::join(ir::Connective::And, left, ir::negate(right), range),
                      ir::join(ir::Connective::And, ir::negate(left), right, range), range);
    return ir::join(joined->joint == Joint::And ? ir::Connective::And : ir::Connective::Or, left, right,
                    range);
  }
  const auto& comparison = std::get<Comparison>(condition.node);
  const auto isEmpty = [](const Expression& side) {
    const auto* variable = std::get_if<VariableRef>(&side.node);
    return variable != nullptr && literalOf(*variable->number) == 0.0;
  };
  const bool equals = comparison.relation == "EQ", differs = comparison.relation == "NE";
  for (const bool first : {true, false}) {
    const Expression& empty = first ? *comparison.left : *comparison.right;
    if (!(equals || differs) || !isEmpty(empty)) continue;
    const ir::ExpressionPtr other = formula(first ? *comparison.right : *comparison.left, false);
    if (!other) return nullptr;
    const ir::ConditionPtr test = ir::isNull(other, condition.range);
    return equals ? test : ir::negate(test);
  }
  // An empty variable equals nothing, and counts as 0 where the greater one is asked for.
  const bool plain = equals || differs;
  const auto side = [&](const Expression& one) { return plain ? formula(one, false) : operand(one, false); };
  const ir::ExpressionPtr left = side(*comparison.left);
  const ir::ExpressionPtr right = left ? side(*comparison.right) : nullptr;
  if (!right) return nullptr;
  const ir::Relation relation = equals                        ? ir::Relation::Same
                                : differs                     ? ir::Relation::Different
                                : comparison.relation == "GT" ? ir::Relation::Greater
                                : comparison.relation == "LT" ? ir::Relation::Less
                                : comparison.relation == "GE" ? ir::Relation::GreaterEqual
                                                              : ir::Relation::LessEqual;
  return ir::compare(relation, left, right, condition.range);
}

} // namespace dotek::frontend::nc
