// Results of measurements in blocks for another macro set: copied, or computed from what its macros leave.
#include "backends/common/MacroCall.h"
#include "backends/fusion/State.h"
#include "ir/Dataflow.h"
#include "ir/Flow.h"
#include "ir/Fold.h"
#include "ir/Walk.h"
#include "stdlib/KeptResults.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Fusion.h"

#include <algorithm>
#include <charconv>

namespace dotek::backends::fusion {

namespace {

// Measure or CallCycle whose results the macros hold; nullptr: on some way none.
using Lasts = std::set<const ir::CycleStatement*>;

// Where the macros of a set leave it; `measured` may be a null pointer.
FoundResult resultIn(const stdlib::MacroSet& macros, const ir::CycleStatement* measured,
                     ir::ResultName name) {
  const stdlib::MacroSignature* signature = measured == nullptr ? nullptr : signatureOf(macros, *measured);
  return signature == nullptr ? FoundResult() : resultAfter(*signature, *measured, name);
}

} // namespace

bool MacroBlocks::overwritesResults(const ir::CycleStatement& statement) const {
  return ir::match(
      statement,
      [&](const ir::Move& node) {
        return node.motion == ir::Motion::Protected && !stdlib::moveKeepsResults(state_.options.macros);
      },
      [&](const ir::OpaqueBlock& node) {
        return !movesNothing(node) &&
               std::any_of(node.words.begin(), node.words.end(),
                           [](const ir::Word& word) { return word.address != 'N' && word.address != 'T'; });
      },
      [&](const ir::ProbePower& node) {
        return statement.origin.addresses.find('P') != std::string::npos ||
               state_.options.macros.find(node.on ? stdlib::Intent::ProbeOn : stdlib::Intent::ProbeOff) !=
                   nullptr;
      },
      [](const ir::OneOf<ir::Measure, ir::CallCycle, ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Comment,
                         ir::Assign, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop,
                         ir::Alarm, ir::Port, ir::Print> auto&) { return false; });
}

const std::vector<Lasts>& MacroBlocks::lasts() {
  const auto& body = state_.cycle.body;
  if (!lasts_.empty()) return lasts_;
  const auto facts = ir::factsBefore(
      body, Lasts{nullptr},
      [&](std::size_t at, std::size_t, const Lasts& before) -> Lasts {
        return ir::match(
            body[at], [&](const ir::OneOf<ir::Measure, ir::CallCycle> auto&) -> Lasts { return {&body[at]}; },
            [&](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Move, ir::ProbePower,
                                ir::Comment, ir::Assign, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode,
                                ir::Dwell, ir::Stop, ir::Alarm, ir::OpaqueBlock, ir::Port, ir::Print> auto&)
                -> Lasts { return overwritesResults(body[at]) ? Lasts{nullptr} : before; });
      },
      [](Lasts& into, const Lasts& other) {
        const std::size_t before = into.size();
        into.insert(other.begin(), other.end());
        return into.size() != before;
      });
  for (const auto& fact : facts)
    lasts_.push_back(fact.value_or(Lasts()));
  return lasts_;
}

FoundResult MacroBlocks::after(const ir::CycleStatement* measured, ir::ResultName name) const {
  return resultIn(state_.options.macros, measured, name);
}

bool MacroBlocks::leadsStraight(const std::vector<std::vector<std::size_t>>& next, std::size_t from,
                                std::size_t to) const {
  const auto& body = state_.cycle.body;
  std::size_t at = from;
  for (std::size_t steps = 0; steps <= body.size(); ++steps) {
    if (next[at].size() != 1) return false;
    at = next[at].front();
    if (at == to) return true;
    if (at >= body.size()) return false;
    const ir::CycleStatement& one = body[at];
    const bool passes = ir::match(
        one,
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Comment, ir::Port, ir::Print> auto&) { return true; },
        [&](const ir::Store&) { return moved_.contains(&one); },
        [](const ir::OneOf<ir::Measure, ir::CallCycle, ir::Branch, ir::Move, ir::ProbePower, ir::Assign,
                           ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm,
                           ir::OpaqueBlock> auto&) { return false; });
    if (!passes) return false;
  }
  return false;
}

void MacroBlocks::reportInstead(const FoundResult& known, SourceRange range) {
  if (known.instead)
    state_.diagnostics.report<diag::ResultDiffers>(range, known.result->variable, state_.options.macros.title,
                                                   ir::resultTitle(*known.instead));
}

void MacroBlocks::planCopies() {
  const auto& body = state_.cycle.body;
  const auto next = ir::successors(body);
  for (std::size_t at = 0; at < body.size(); ++at) {
    const auto* store = std::get_if<ir::Store>(&body[at].node);
    const auto* result = store == nullptr ? nullptr : std::get_if<ir::MeasuredResult>(&store->value->node);
    const double* number = result == nullptr ? nullptr : ir::constantValue(store->number);
    if (number == nullptr || lasts()[at].size() < 2) continue;
    std::map<const ir::CycleStatement*, FoundResult> each;
    std::set<std::uint32_t> variables;
    bool differs = false;
    for (const ir::CycleStatement* measured : lasts()[at]) {
      const FoundResult one = after(measured, result->name);
      if (one.result == nullptr || !leadsStraight(next, static_cast<std::size_t>(measured - body.data()), at))
        break;
      each[measured] = one;
      variables.insert(one.result->variable);
      differs = differs || one.instead;
    }
    if (each.size() != lasts()[at].size() || (variables.size() < 2 && !differs)) continue;
    moved_.insert(&body[at]);
    for (const auto& [measured, one] : each) {
      reportInstead(one, store->value->range);
      copies_[measured].push_back("#" + numberText(*number) + "=#" + std::to_string(one.result->variable));
    }
  }
}

void MacroBlocks::copyResults(const ir::CycleStatement& measured, std::vector<Text>& lines) {
  const auto found = copies_.find(&measured);
  if (found == copies_.end() || state_.failed) return;
  for (const std::string& copy : found->second)
    lines.emplace_back().add(copy);
}

void MacroBlocks::join(std::size_t label) {
  joined_ = label < lasts().size() ? lasts()[label] : Lasts{nullptr};
  if (joined_.size() == 1 && *joined_.begin() == last_)
    joined_.clear();
  else
    last_ = nullptr;
}

FoundResult MacroBlocks::found(ir::ResultName name) const {
  if (last_ != nullptr) return after(last_, name);
  FoundResult out;
  for (const ir::CycleStatement* measured : joined_) {
    const FoundResult one = after(measured, name);
    if (one.result == nullptr) return {};
    const bool same =
        out.result == nullptr || (out.result->variable == one.result->variable && out.instead == one.instead);
    if (!same) return {};
    out = one;
  }
  return out;
}

bool MacroBlocks::comparesAlike(const ir::CycleStatement& statement) {
  // What is stored only where a comparison holds is in the text of that one.
  const bool stores = std::holds_alternative<ir::Store>(statement.node) && !moved_.contains(&statement);
  if (!(stores || std::holds_alternative<ir::Branch>(statement.node)) || state_.options.source == nullptr)
    return false;
  const Lasts& before = lasts()[static_cast<std::size_t>(&statement - state_.cycle.body.data())];
  bool alike = !before.empty();
  ir::eachNode(statement, [&](const ir::Expression& node) {
    const auto* result = std::get_if<ir::MeasuredResult>(&node.node);
    if (result == nullptr) return;
    for (const ir::CycleStatement* measured : before) {
      const FoundResult there = resultIn(*state_.options.source, measured, result->name);
      const FoundResult here = after(measured, result->name);
      alike = alike && there.result != nullptr && here.result != nullptr && !there.instead && !here.instead &&
              there.result->variable == here.result->variable;
    }
  });
  return alike;
}

bool MacroBlocks::comparesOthers(const ir::CycleStatement& statement) {
  if (!std::holds_alternative<ir::Branch>(statement.node) || state_.options.source == nullptr) return false;
  const Lasts& before = lasts()[static_cast<std::size_t>(&statement - state_.cycle.body.data())];
  bool known = !before.empty();
  ir::eachNode(statement, [&](const ir::Expression& node) {
    const auto* result = std::get_if<ir::MeasuredResult>(&node.node);
    if (result == nullptr) return;
    for (const ir::CycleStatement* measured : before) {
      const FoundResult there = resultIn(*state_.options.source, measured, result->name);
      known = known && there.result != nullptr && !there.instead &&
              compared_.emplace(there.result->variable, result->name).first->second == result->name;
    }
  });
  return known;
}

void MacroBlocks::piece(Text& text, std::string_view printed, bool beforePicture, const ir::Origin& origin) {
  constexpr std::string_view kDigits = "0123456789";
  std::size_t done = 0;
  for (std::size_t at = printed.find('#'); !compared_.empty() && at != std::string_view::npos;
       at = printed.find('#', at + 1)) {
    const std::size_t end = std::min(printed.find_first_not_of(kDigits, at + 1), printed.size());
    std::uint32_t number = 0;
    std::from_chars(printed.data() + at + 1, printed.data() + end, number);
    const auto found = compared_.find(number);
    if (found == compared_.end() || (end == printed.size() && beforePicture)) continue;
    text.add(std::string(printed.substr(done, at - done)));
    macroOperand(text, ir::result(found->second), origin);
    replaced_.insert(number);
    done = end;
  }
  text.add(std::string(printed.substr(done)));
}

void MacroBlocks::endBlock(const ir::Origin& origin) {
  if (replaced_.size() < compared_.size()) state_.refuse<diag::FusionResultCompared>(origin.range());
}

void MacroBlocks::refuseResult(ir::ResultName name, SourceRange range) {
  const bool measures = std::any_of(joined_.begin(), joined_.end(), [](const auto* one) { return one; });
  if (last_ == nullptr && measures)
    state_.refuse<diag::ResultOfSeveral>(range, ir::resultTitle(name), state_.options.macros.title);
  else
    state_.refuse<diag::ResultUnknown>(range, state_.options.macros.title, ir::resultTitle(name));
}

void MacroBlocks::setLast(const ir::CycleStatement* measured) {
  last_ = measured;
  joined_.clear();
}

bool MacroBlocks::errorText(ir::ResultName name, const stdlib::MacroSignature& signature,
                            const ir::Origin& origin, Text& text) {
  ir::ResultName measured = ir::ResultName::Size;
  ir::ExpressionPtr expected;
  switch (name) {
  case ir::ResultName::ErrorX: measured = ir::ResultName::PositionX; break;
  case ir::ResultName::ErrorY: measured = ir::ResultName::PositionY; break;
  case ir::ResultName::ErrorZ: measured = ir::ResultName::PositionZ; break;
  case ir::ResultName::SizeError: break;
  default: return false;
  }
  if (name == ir::ResultName::SizeError) {
    const auto* cycle = std::get_if<ir::CallCycle>(&last_->node);
    const auto* measure = std::get_if<ir::Measure>(&last_->node);
    if (measure != nullptr) expected = measure->diameter;
    for (std::size_t i = 0; cycle != nullptr && i < cycle->arguments.size(); ++i)
      if (const ir::CycleArgument& one = cycle->arguments[i];
          one.parameter == stdlib::roleName(stdlib::ArgumentRole::Diameter) ||
          one.parameter.starts_with(stdlib::roleName(stdlib::ArgumentRole::Width)))
        expected = one.value;
  } else {
    expected =
        expected_[static_cast<std::size_t>(measured) - static_cast<std::size_t>(ir::ResultName::PositionX)]
            .value;
  }
  const stdlib::MacroResult* found = findResult(signature, measured);
  if (found == nullptr || !found->documented || expected == nullptr) return false;
  bool ofResult = false; // it may have been overwritten by this measurement
  ir::eachNode(expected, [&](const ir::Expression& node) {
    ofResult = ofResult || std::holds_alternative<ir::MeasuredResult>(node.node);
  });
  if (ofResult) return false;
  text.add("#" + std::to_string(found->variable) + "-[");
  if (needsControl(expected))
    macro(text, ir::simplify(expected), origin);
  else
    texts_.number(text, expected, origin, true);
  text.add("]");
  return true;
}

void MacroBlocks::store(const ir::Store& store, const ir::Origin& origin, std::vector<Text>& lines) {
  const auto* result = std::get_if<ir::MeasuredResult>(&store.value->node);
  const double* number = ir::constantValue(store.number);
  if (result == nullptr || number == nullptr) {
    Text text;
    macro(text, ir::machineVariable(store.number), origin);
    text.add("=");
    wholeRound_ = true;
    macro(text, ir::simplify(store.value), origin);
    wholeRound_ = false;
    lines.push_back(std::move(text));
    return;
  }
  const stdlib::MacroSignature* signature =
      last_ == nullptr ? nullptr : signatureOf(state_.options.macros, *last_);
  const FoundResult known = found(result->name);
  reportInstead(known, store.value->range);
  if (known.result == nullptr) {
    if (state_.failed) return; // the measurement was refused
    Text computed;
    computed.add("#" + numberText(*number) + "=");
    if (signature != nullptr && errorText(result->name, *signature, origin, computed)) {
      lines.push_back(std::move(computed));
      return;
    }
    return refuseResult(result->name, origin.range());
  }
  Text text;
  text.add("#" + numberText(*number) + "=#" + std::to_string(known.result->variable));
  lines.push_back(std::move(text));
}

} // namespace dotek::backends::fusion
