#include "backends/fanuc/TranslateCall.h"

#include "backends/common/MacroCall.h"
#include "ir/Linear.h"
#include "stdlib/ReadCall.h"
#include "stdlib/SearchTravel.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dotek::backends::fanuc {

using stdlib::ArgumentRole;
using stdlib::Intent;
using stdlib::MacroArgument;
using stdlib::MacroSignature;
using stdlib::SystemCode;
using stdlib::SystemRule;

namespace {

constexpr double kFirstSystem = 54, kSystems = 6;

// A computed length: with a point, so that it counts millimetres in every setting.
ir::ExpressionPtr millimetres(double value) {
  const std::string text = numberText(value);
  return ir::constant(value, {}, text.find('.') == std::string::npos ? text + "." : text);
}

ir::ExpressionPtr numbered(std::uint32_t number) {
  return ir::machineVariable(ir::constant(number));
}

// The part of an argument whose being empty leaves the argument empty: #1 of `X#1` and of `X-#1`; nullptr: it
// is a number whatever happens.
ir::ExpressionPtr emptyPart(const ir::ExpressionPtr& value) {
  if (const auto* unary = std::get_if<ir::Unary>(&value->node))
    return unary->op == ir::UnaryOp::Negate ? emptyPart(unary->operand) : nullptr;
  if (const auto* either = std::get_if<ir::Binary>(&value->node))
    return either->op == ir::BinaryOp::ValueOr && emptyPart(either->right) != nullptr ? value : nullptr;
  const bool empty = std::holds_alternative<ir::MachineVariable>(value->node) ||
                     std::holds_alternative<ir::NullValue>(value->node);
  return empty ? value : nullptr;
}

bool mayBeNull(const ir::ExpressionPtr& value) {
  return emptyPart(value) != nullptr;
}

// An operand of arithmetic.
ir::ExpressionPtr number(const ir::ExpressionPtr& value) {
  if (!mayBeNull(value)) return value;
  if (const auto* unary = std::get_if<ir::Unary>(&value->node))
    return ir::unary(unary->op, number(unary->operand));
  return ir::unary(ir::UnaryOp::NullAsZero, value);
}
ir::ExpressionPtr plus(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  const double* left = ir::constantValue(a);
  const double* right = ir::constantValue(b);
  if (left != nullptr && right != nullptr)
    if (const auto sum = ir::exactSum(*left, *right)) return millimetres(*sum);
  return ir::binary(ir::BinaryOp::Add, number(a), number(b));
}
ir::ExpressionPtr minus(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::binary(ir::BinaryOp::Subtract, number(a), number(b));
}

bool same(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::provenEqual(number(a), number(b), ir::Cycle());
}

bool countsIncrements(char letter, const ir::ExpressionPtr& value, const stdlib::Control& control) {
  return ir::numberWithoutPoint(value) != nullptr && control.countsIncrements(letter);
}

// What a call says, by the signature of its set: why nothing is known, or the reading that fits.
std::string read(const ir::Call& call, const stdlib::MacroSet& set, stdlib::CallReading& out) {
  if (call.kind != ir::CallKind::Macro) return "only G65 calls are translated";
  if (call.repeats != nullptr) return "what repeated measurements leave is not known";
  const double* program = call.program == nullptr ? nullptr : ir::constantValue(call.program);
  if (program == nullptr) return "which macro it calls is computed";
  if (!(*program >= 1 && *program < 1e8) || *program != std::floor(*program)) return "P names no program";
  std::string letters;
  for (const ir::CallArgument& argument : call.arguments) {
    if (argument.local != stdlib::localOf(argument.letter) ||
        letters.find(argument.letter) != std::string::npos)
      return fmt::format("`{}` is repeated: it sets #{}", argument.letter, argument.local);
    letters += argument.letter;
  }
  out = stdlib::readCall(set, static_cast<std::uint32_t>(*program), letters);
  return stdlib::refusalText(out);
}

ir::Axis measuredAxis(const MacroSignature& signature) {
  for (const MacroArgument& argument : signature.arguments)
    if (argument.role == ArgumentRole::Target || argument.role == ArgumentRole::Width) return argument.axis;
  return ir::Axis::X;
}

class Translation {
public:
  Translation(const ir::Call& call, const TranslateSettings& settings) : call_(call), settings_(settings) {}

  TranslatedCall run() {
    out_.refusal = read(call_, settings_.source, reading_);
    if (refused()) return std::move(out_);
    from_ = reading_.signature;
    if (isSame(settings_.source, settings_.target)) {
      out_.call = call_;
      return std::move(out_);
    }
    to_ = settings_.target.find(from_->intent, measuredAxis(*from_));
    if (to_ == nullptr)
      probePower();
    else
      write();
    if (!out_.refusal.empty()) {
      out_.before.clear();
      out_.call.reset();
    }
    return std::move(out_);
  }

private:
  void refuse(std::string why) {
    if (out_.refusal.empty()) out_.refusal = std::move(why);
  }
  bool refused() const { return !out_.refusal.empty(); }
  void note(std::string text) {
    if (std::find(out_.notes.begin(), out_.notes.end(), text) == out_.notes.end())
      out_.notes.push_back(std::move(text));
  }
  std::string title() const { return fmt::format("P{} ({})", from_->program, from_->title); }
  const std::string& target() const { return settings_.target.name; }

  const ir::ExpressionPtr* given(char letter) const {
    const auto at = std::find_if(call_.arguments.begin(), call_.arguments.end(),
                                 [&](const ir::CallArgument& argument) { return argument.letter == letter; });
    return at == call_.arguments.end() ? nullptr : &at->value;
  }
  const ir::ExpressionPtr* given(ArgumentRole role, ir::Axis axis = ir::Axis::X) const {
    const stdlib::ReadArgument* argument = reading_.find(role, axis);
    return argument == nullptr ? nullptr : &call_.arguments[argument->at].value;
  }

  // The length that a word hands over: within an expression a number without a point counts millimetres.
  ir::ExpressionPtr length(char letter, const ir::ExpressionPtr& value) {
    if (!countsIncrements(letter, value, settings_.control)) return value;
    if (const auto out = ir::exactProduct(*ir::constantValue(value), settings_.control.increment))
      return millimetres(*out);
    refuse(fmt::format("the number after `{}` is no length", letter));
    return value;
  }

  // A set without macros for the probe's switch leaves it to a code of the machine.
  void probePower() {
    const bool on = from_->intent == Intent::ProbeOn;
    if (!on && from_->intent != Intent::ProbeOff) {
      refuse(fmt::format("`{}` has no macro for {}", target(), stdlib::intentName(from_->intent)));
      return;
    }
    if (!call_.arguments.empty()) {
      refuse(fmt::format("`{}` of {} has no place in a code of the machine", call_.arguments[0].letter,
                         title()));
      return;
    }
    const auto* code = settings_.control.find(on ? stdlib::Function::ProbeOn : stdlib::Function::ProbeOff);
    if (code == nullptr) {
      refuse(fmt::format("neither `{}` nor `{}` says how the probe is switched {}; `--probe-{} CODE` does",
                         target(), settings_.written.empty() ? settings_.control.name : settings_.written,
                         on ? "on" : "off", on ? "on" : "off"));
      return;
    }
    block(*code);
  }

  void write() {
    for (const MacroSignature* signature : {from_, to_})
      if (!signature->unknown.empty())
        return refuse(fmt::format("{}: {} is in no source", title(), signature->unknown));
    for (const stdlib::ReadArgument& argument : reading_.arguments)
      carry(*argument.meaning, call_.arguments[argument.at]);
    nominals();
    if (refused()) return;
    finish();
  }

  void carry(const MacroArgument& argument, const ir::CallArgument& word) {
    if (!argument.unknown.empty() || argument.role == ArgumentRole::Unstated)
      return refuse(fmt::format("what `{}` of {} says is in no source", argument.letter, title()));
    if (argument.role == ArgumentRole::Nominal) return;                    // with the system
    if (argument.role == ArgumentRole::Overtravel && travelsFar()) return; // with the target
    const MacroArgument* place = to_->find(argument.role, argument.axis);
    if (place == nullptr || !place->unknown.empty())
      return refuse(
          argument.role == ArgumentRole::FlagOnly
              ? fmt::format("`{}1` of {} raises no alarm, and `{}` is not known to have such a call",
                            argument.letter, title(), target())
              : fmt::format("`{}` of {} is its {}, and `{}` is not known to take one", argument.letter,
                            title(), stdlib::roleName(argument.role), target()));
    switch (argument.role) {
    case ArgumentRole::Target: put(*place, coordinate(argument, *place, word.value)); break;
    case ArgumentRole::System: system(argument, *place, word.value); break;
    default: put(*place, place->selector ? word.value : length(word.letter, word.value)); break;
    }
  }

  void put(const MacroArgument& place, ir::ExpressionPtr value) {
    if (!refused()) arguments_.push_back({place.letter, stdlib::localOf(place.letter), std::move(value), {}});
  }

  ir::ExpressionPtr coordinate(const MacroArgument& from, const MacroArgument& to,
                               const ir::ExpressionPtr& word) {
    const ir::ExpressionPtr value = length(from.letter, word);
    if (from.frame == to.frame) return value;
    const ir::ExpressionPtr here = position(from.axis);
    if (refused()) return value;
    present(value, from.letter);
    if (from.frame == ir::Frame::Work) {
      const ir::ExpressionPtr beyond = travelsFar() ? searchedBeyond(from.axis) : nullptr;
      if (beyond != nullptr && isNoTravel(minus(value, here))) {
        refuse(fmt::format("the surface of {} is expected where the probe is, so its travel has no direction",
                           title()));
        return value;
      }
      if (beyond != nullptr) {
        note(fmt::format("`{}` of `{}` is the greatest travel: it ends as far beyond the expected surface as "
                         "`{}` searches",
                         to.letter, target(), settings_.source.name));
        return longerTravel(minus(value, here), beyond);
      }
      note(fmt::format("`{}` of `{}` is the greatest travel: nothing is searched beyond the expected surface",
                       to.letter, target()));
      return minus(value, here);
    }
    note(fmt::format("`{}` of `{}` is where the surface is expected: it is searched beyond, too", to.letter,
                     target()));
    return plus(here, value);
  }

  // The target's travel is its whole search, and the source's call states a place.
  bool travelsFar() const {
    const MacroArgument* const place = from_->find(ArgumentRole::Target, measuredAxis(*from_));
    return from_->intent == Intent::Surface && place != nullptr && place->frame == ir::Frame::Work &&
           stdlib::travelIsSearch(*to_, measuredAxis(*to_));
  }
  // How far the call searches beyond where it expects the surface; nullptr: not known.
  ir::ExpressionPtr searchedBeyond(ir::Axis axis) {
    const stdlib::ReadArgument* given = reading_.find(ArgumentRole::Overtravel, ir::Axis::X);
    if (given == nullptr) return overtravelOf(&settings_.source, axis);
    const ir::CallArgument& word = call_.arguments[given->at];
    present(word.value, word.letter);
    return number(length(word.letter, word.value));
  }

  // Of the active system, the tool's length taken off, as the axes stand.
  ir::ExpressionPtr position(ir::Axis axis) {
    const auto& v = settings_.control.variables;
    const std::optional<stdlib::LengthInPositions>& with = settings_.control.withToolLength;
    const bool z = axis == ir::Axis::Z;
    const bool held = z && (!with || with->position);
    if (!v.position || (held && (!with || !v.toolLength))) {
      refuse(fmt::format("`{}` has no variable of the position in {}", settings_.control.name,
                         ir::letterOf(axis)));
      return ir::constant(0);
    }
    wait();
    const auto step = static_cast<std::uint32_t>(ir::indexOf(axis));
    const ir::ExpressionPtr now = numbered(static_cast<std::uint32_t>(*v.position) + step);
    return held ? minus(now, numbered(static_cast<std::uint32_t>(*v.toolLength) + step)) : now;
  }

  // Macro statements are carried out before the axes are: a bare G53 waits.
  void wait() {
    if (std::exchange(waited_, true)) return;
    const auto* code = settings_.control.find(stdlib::Function::MachineCoordinates);
    if (code == nullptr || code->grade == "assumed") {
      refuse(fmt::format("no block of `{}` is known to wait until the axes are", settings_.control.name));
      return;
    }
    block(*code);
  }

  void block(const stdlib::CodeInfo& code) {
    ir::NcBlock block;
    const double value = code.tenths / 10.0;
    block.words.push_back({code.letter, ir::constant(value, {}, fmt::format("{:g}", value)), {}});
    add(std::move(block));
  }

  template <class Node> void add(Node node) {
    ir::ProgramStatement statement;
    statement.node = std::move(node);
    out_.before.push_back(std::move(statement));
  }

  // An alarm before the call unless the condition holds.
  void demand(ir::ConditionPtr condition, std::string text) {
    const ir::LabelId label = settings_.newLabel();
    add(ir::Branch{std::move(condition), label});
    add(ir::Raise{ir::constant(settings_.alarm), std::move(text)});
    add(ir::Label{label});
  }
  // The target computes with the value: empty, it would count as 0.
  void present(const ir::ExpressionPtr& value, char letter) {
    if (!mayBeNull(value) || checked_.find(letter) != std::string::npos) return;
    checked_ += letter;
    demand(ir::compare(ir::Relation::Different, emptyPart(value), numbered(0)),
           fmt::format("{} IS MISSING", letter));
  }

  void system(const MacroArgument& from, const MacroArgument& to, const ir::ExpressionPtr& value) {
    const bool index = from.systemCode == SystemCode::Index;
    const double first = index ? 1 : kFirstSystem;
    if (const double* known = ir::constantValue(value)) {
      if (const std::uint32_t n = stdlib::extendedSystem(from, *known)) {
        const double there = stdlib::extendedNumber(to, n);
        if (stdlib::extendedSystem(to, there) != n)
          return refuse(fmt::format("`{}{:g}` of {} names a work system beyond G59, which `{}` does not set; "
                                    "take macros that set it (`--probe-macros dotek`)",
                                    from.letter, *known, title(), target()));
        sets_ = true;
        return put(to, ir::constant(there, {}, fmt::format("{:g}{}", there, to.point ? "." : "")));
      }
      if (*known < first || *known >= first + kSystems || *known != std::floor(*known))
        return refuse(fmt::format("`{}{:g}` of {} names no system G54 to G59", from.letter, *known, title()));
    } else {
      present(value, from.letter);
      const std::string text = fmt::format("{} IS NOT G54 TO G59", from.letter);
      demand(ir::compare(ir::Relation::GreaterEqual, number(value), ir::constant(first)), text);
      demand(ir::compare(ir::Relation::LessEqual, number(value), ir::constant(first + kSystems - 1)), text);
      demand(ir::compare(ir::Relation::Same, number(value), ir::unary(ir::UnaryOp::Round, number(value))),
             text);
    }
    if (to.systemRule == SystemRule::Error && from.systemRule == SystemRule::Nominal && !expectsNominal())
      return;
    sets_ = true;
    if (to.systemRule != from.systemRule)
      note("both sets set the same offset while no local shift, rotation or scaling is in force");
    if (from.systemCode == to.systemCode) return put(to, value);
    const double shift = index ? kFirstSystem - 1 : 1 - kFirstSystem;
    if (const double* known = ir::constantValue(value))
      put(to, ir::constant(*known + shift, {}, fmt::format("{:.0f}{}", *known + shift, to.point ? "." : "")));
    else
      put(to, plus(value, ir::constant(shift)));
  }

  // Where the source expects the feature, work coordinates.
  ir::ExpressionPtr expected(ir::Axis axis) {
    const MacroArgument* argument = from_->find(ArgumentRole::Target, axis);
    if (argument == nullptr) return position(axis); // it lies where the probe is
    const ir::ExpressionPtr value = length(argument->letter, *given(argument->letter));
    return argument->frame == ir::Frame::Work ? value : plus(position(axis), value);
  }

  // A set that corrects by measured minus expected gives the feature its nominal only where that is the
  // expected coordinate.
  bool expectsNominal() {
    for (const MacroArgument& argument : from_->arguments) {
      if (argument.role != ArgumentRole::Nominal) continue;
      const ir::ExpressionPtr* nominal = given(argument.letter);
      if (nominal == nullptr || !same(length(argument.letter, *nominal), expected(argument.axis))) {
        refuse(fmt::format(
            "{} gives the feature the coordinate `{}` in {}; `{}` corrects the offset by what was "
            "measured minus what is expected, which is the same only where the feature is expected "
            "at `{}`, and that is not known",
            title(), argument.letter, ir::letterOf(argument.axis), target(), argument.letter));
        return false;
      }
    }
    return true;
  }

  // The coordinates that the feature gets, where the target wants them.
  void nominals() {
    for (const MacroArgument& place : to_->arguments) {
      if (place.role != ArgumentRole::Nominal || !sets_ || refused()) continue;
      const ir::ExpressionPtr* nominal = given(ArgumentRole::Nominal, place.axis);
      if (nominal != nullptr) {
        put(place, length(from_->find(ArgumentRole::Nominal, place.axis)->letter, *nominal));
        continue;
      }
      const ir::ExpressionPtr value = expected(place.axis);
      if (const MacroArgument* target = from_->find(ArgumentRole::Target, place.axis); target != nullptr)
        present(value, target->letter);
      put(place, value);
    }
  }

  void finish() {
    ir::Call call;
    call.program = ir::constant(to_->program, {}, std::to_string(to_->program));
    std::string letters;
    for (const MacroArgument& place : to_->arguments) {
      const auto at = std::find_if(arguments_.begin(), arguments_.end(),
                                   [&](const ir::CallArgument& one) { return one.letter == place.letter; });
      if (at == arguments_.end()) {
        if (!place.required) continue;
        return refuse(fmt::format("P{} of `{}` wants `{}`, its {}, and the call states none", to_->program,
                                  target(), place.letter, stdlib::roleName(place.role)));
      }
      call.arguments.push_back(*at);
      letters += place.letter;
    }
    if (const stdlib::CallReading there = stdlib::readCall(settings_.target, to_->program, letters);
        there.signature != to_)
      return refuse(there.signature == nullptr ? stdlib::refusalText(there)
                                               : fmt::format("P{} of `{}` with {} is another measurement",
                                                             to_->program, target(), letters));
    if (from_->intent == Intent::ProtectedMove && given(ArgumentRole::Feed) == nullptr)
      note(fmt::format("P{} takes its own feed or the last one: the call states none", to_->program));
    out_.call = std::move(call);
  }

  const ir::Call& call_;
  const TranslateSettings& settings_;
  stdlib::CallReading reading_;
  const MacroSignature* from_ = nullptr; // of the reading
  const MacroSignature* to_ = nullptr;
  TranslatedCall out_;
  std::vector<ir::CallArgument> arguments_;
  std::string checked_; // letters whose presence is demanded
  bool waited_ = false, sets_ = false;
};

bool within(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& ranges, std::uint32_t variable) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [&](const auto& range) { return range.first <= variable && variable <= range.second; });
}

const stdlib::MacroResult* resultIn(const MacroSignature& signature, std::uint32_t variable) {
  const auto at =
      std::find_if(signature.results.begin(), signature.results.end(),
                   [&](const stdlib::MacroResult& result) { return result.variable == variable; });
  return at == signature.results.end() ? nullptr : &*at;
}

} // namespace

bool isSame(const stdlib::MacroSet& one, const stdlib::MacroSet& other) {
  return one.name == other.name && one.scratch == other.scratch;
}

std::optional<std::uint32_t> packagedVariable(const stdlib::MacroSet& source, const stdlib::MacroSet& target,
                                              std::uint32_t variable) {
  if (source.name != target.name) return std::nullopt;
  for (std::size_t i = 0; i < source.overwritten.size(); ++i)
    if (const auto [first, last] = source.overwritten[i]; variable >= first && variable <= last)
      return target.overwritten.at(i).first + (variable - first);
  return std::nullopt;
}

TranslatedCall translateCall(const ir::Call& call, const TranslateSettings& settings) {
  return Translation(call, settings).run();
}

TranslatedVariable translateResult(const ir::Call& call, std::uint32_t variable,
                                   const TranslateSettings& settings) {
  const stdlib::MacroSet& source = settings.source;
  const stdlib::MacroSet& target = settings.target;
  if (isSame(source, target)) return {"", variable};
  // The same macros with other variables.
  if (source.name == target.name) {
    if (const auto there = packagedVariable(source, target, variable)) return {"", *there};
    if (within(target.scratch, variable))
      return {fmt::format("the macros of `{}` overwrite #{}", target.title, variable), 0};
    return {"", variable};
  }
  stdlib::CallReading reading;
  if (std::string refusal = read(call, source, reading); !refusal.empty()) return {std::move(refusal), 0};
  const stdlib::MacroResult* result = resultIn(*reading.signature, variable);
  if (result == nullptr) {
    if (within(source.scratch, variable))
      return {fmt::format("what #{} holds after P{} is not known", variable, reading.program), 0};
    if (within(target.scratch, variable))
      return {fmt::format("the macros of `{}` overwrite #{}", target.name, variable), 0};
    return {"", variable};
  }
  if (!result->documented)
    return {fmt::format("#{} after P{} is {}, and no source says what it holds", variable, reading.program,
                        result->output == stdlib::Output::Main ? "the result of the macro"
                                                               : stdlib::outputName(result->output)),
            0};
  const MacroSignature* to = target.find(reading.signature->intent, measuredAxis(*reading.signature));
  const stdlib::MacroResult* there = to == nullptr ? nullptr : to->find(result->output);
  if (there == nullptr || !there->documented)
    return {fmt::format("`{}` is not known to leave the {} in a variable", target.name,
                        stdlib::outputName(result->output)),
            0};
  return {"", there->variable};
}

} // namespace dotek::backends::fanuc
