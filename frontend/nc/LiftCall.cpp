// Calls of a vendor's macros by their signatures.
#include "frontend/nc/Lifter.h"
#include "stdlib/MacroCycle.h"
#include "stdlib/ReadCall.h"
#include "support/Decimal.h"
#include "support/messages/Nc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

namespace dotek::frontend::nc {
namespace {

constexpr std::uint32_t kFirstSystem = 54; // SystemCode::Index 1

// A statement of the IR of its own says the call.
bool isPlain(const stdlib::CallReading& reading) {
  using stdlib::ArgumentRole;
  const auto only = [&](std::initializer_list<ArgumentRole> roles) {
    return std::all_of(reading.arguments.begin(), reading.arguments.end(), [&](const auto& one) {
      return std::find(roles.begin(), roles.end(), one.meaning->role) != roles.end();
    });
  };
  switch (reading.signature->intent) {
  case stdlib::Intent::ProtectedMove: return only({ArgumentRole::Target, ArgumentRole::Feed});
  case stdlib::Intent::ProbeOn:
  case stdlib::Intent::ProbeOff: return reading.arguments.empty();
  case stdlib::Intent::Surface:
    return only({ArgumentRole::Target, ArgumentRole::Nominal, ArgumentRole::System});
  case stdlib::Intent::Bore: {
    // The nominal centre of one that corrects by the error is the place of the probe.
    const stdlib::ReadArgument* system = reading.find(ArgumentRole::System);
    return only({ArgumentRole::Diameter, ArgumentRole::Nominal, ArgumentRole::System}) &&
           (system == nullptr || system->meaning->systemRule == stdlib::SystemRule::Nominal);
  }
  default: return false;
  }
}

bool isCall(const stdlib::CodeInfo* info) {
  return info != nullptr && info->function == stdlib::Function::MacroCall;
}

} // namespace

bool Lifter::call(std::uint32_t program, const Word& programWord) {
  if (context_.macros == nullptr || !context_.macros->calls(program))
    return refuse<diag::UnknownMacro>(programWord.range, program,
                                      context_.macros == nullptr ? "none" : context_.macros->name);
  // Words before the call are no arguments on every control, and G is an argument on none.
  if (block_.words.front().address != 'G' || !isCall(codes_.front().info) ||
      std::count_if(codes_.begin(), codes_.end(), [](const Code& c) { return c.word->address == 'G'; }) > 1)
    return refuse<diag::CallForm>(programWord.range, program);
  std::string letters;
  std::vector<const Word*> words; // of the letters
  for (const Word& word : block_.words) {
    if (word.address == 'G' || word.address == 'P') continue;
    letters += word.address;
    words.push_back(&word);
  }
  const stdlib::CallReading reading = stdlib::readCall(*context_.macros, program, letters);
  using stdlib::CallRefusal;
  switch (reading.refusal) {
  case CallRefusal::None: break;
  case CallRefusal::UnknownProgram:
    return refuse<diag::UnknownMacro>(programWord.range, program, context_.macros->name);
  case CallRefusal::RepeatedLetter:
    return refuse<diag::AddressTwice>(words[reading.at]->range, reading.letter());
  case CallRefusal::UnknownLetter:
    return refuse<diag::UnknownMacroLetter>(words[reading.at]->range, refusalText(reading));
  case CallRefusal::Excluded:
    return refuse<diag::MacroLettersRefused>(block_.range, refusalText(reading),
                                             reading.excluded->text.empty() ? ""
                                                                            : ": " + reading.excluded->text);
  case CallRefusal::Missing: return refuse<diag::MissingMacroLetter>(block_.range, refusalText(reading));
  case CallRefusal::Ambiguous: return refuse<diag::AmbiguousMacro>(block_.range, refusalText(reading));
  }
  const stdlib::MacroSignature& signature = *reading.signature;
  if (context_.state.absolute != true && signature.intent != stdlib::Intent::ProbeOn &&
      signature.intent != stdlib::Intent::ProbeOff)
    return refuse<diag::CallUnderIncremental>(block_.range, program);
  // The macro moves at a feed of its own and leaves its motion after it; G90 it restores.
  context_.state.motion = std::nullopt;
  context_.state.feed = nullptr;
  context_.stored.clear();
  if (!isPlain(reading)) return cycle(reading, words);
  switch (signature.intent) {
  case stdlib::Intent::ProtectedMove: return protectedMove(reading, words);
  case stdlib::Intent::ProbeOn:
  case stdlib::Intent::ProbeOff:
    add(ir::ProbePower{signature.intent == stdlib::Intent::ProbeOn});
    return true;
  default: return measure(reading, words);
  }
}

ir::ExpressionPtr Lifter::argument(const stdlib::MacroArgument& argument, const Word& word) {
  Reading reading{argument.kind, false};
  if (argument.selector) reading.kind = ir::Kind::Number;
  if (argument.role == stdlib::ArgumentRole::Feed && !inRange(word, "a feed", false)) return nullptr;
  if (argument.role == stdlib::ArgumentRole::Diameter && !inRange(word, "a diameter", false)) return nullptr;
  // A number without a point counts least increments whatever it means to the macro.
  reading.increments =
      argument.role != stdlib::ArgumentRole::System && context_.control.isLength(argument.letter);
  const ir::ExpressionPtr out = value(word, reading);
  if (!out) return nullptr;
  if (const auto* use = std::get_if<ir::VariableUse>(&out->node))
    origin_.arguments.emplace_back(argument.letter, use->variable);
  return out;
}

bool Lifter::protectedMove(const stdlib::CallReading& reading, const std::vector<const Word*>& words) {
  ir::Move move;
  move.motion = ir::Motion::Protected;
  for (const stdlib::ReadArgument& one : reading.arguments) {
    const stdlib::MacroArgument& meaning = *one.meaning;
    const ir::ExpressionPtr read = argument(meaning, *words[one.at]);
    if (!read) return false;
    if (meaning.role == stdlib::ArgumentRole::Target)
      move.axes[ir::indexOf(meaning.axis)] = ir::Coordinate{read, meaning.frame, nullptr};
    else
      move.feed = read;
  }
  add(std::move(move));
  return true;
}

bool Lifter::measure(const stdlib::CallReading& reading, const std::vector<const Word*>& words) {
  const stdlib::MacroSignature& signature = *reading.signature;
  ir::Measure measure;
  measure.feature = signature.intent == stdlib::Intent::Bore ? ir::Feature::Bore : ir::Feature::Surface;
  ir::OffsetSetting setting;
  bool nominals = false;
  bool sets = false;
  const stdlib::ReadArgument* system = nullptr;
  for (const stdlib::ReadArgument& one : reading.arguments) {
    const stdlib::MacroArgument* found = one.meaning;
    const Word& word = *words[one.at];
    const ir::ExpressionPtr read = argument(*found, word);
    if (!read) return false;
    switch (found->role) {
    case stdlib::ArgumentRole::Target:
      measure.axis = found->axis;
      measure.target = ir::Coordinate{read, found->frame, nullptr};
      break;
    case stdlib::ArgumentRole::Diameter: measure.diameter = read; break;
    case stdlib::ArgumentRole::Nominal:
      setting.nominal[ir::indexOf(found->axis)] = read;
      nominals = true;
      break;
    case stdlib::ArgumentRole::System:
      system = &one;
      setting.system = workSystem(*found, word, read);
      if (!setting.system) return false;
      sets = true;
      break;
    default: break; // isPlain() says no
    }
  }
  if (sets && system->meaning->systemRule == stdlib::SystemRule::Error) {
    setting.nominal[ir::indexOf(measure.axis)] = measure.target->value;
    nominals = true;
  }
  if (sets != nominals)
    return refuse<diag::MissingMacroLetter>(
        block_.range, lacks(reading, sets ? "the nominal coordinate" : "the work offset"));
  if (sets) measure.setting = std::move(setting);
  context_.measured = &signature;
  add(std::move(measure));
  return true;
}

bool Lifter::cycle(const stdlib::CallReading& reading, const std::vector<const Word*>& words) {
  const stdlib::MacroSignature& signature = *reading.signature;
  const stdlib::CycleFacts facts = stdlib::cycleFacts(signature);
  ir::CallCycle call;
  call.cycle = stdlib::intentName(signature.intent);
  call.axis = stdlib::axisOf(signature);
  call.set = context_.macros->name;
  call.power = facts.power;
  call.moves = facts.moves;
  call.returns = facts.returns;
  for (const stdlib::MacroResult& result : signature.results)
    if (result.name) call.results.push_back(*result.name);
  std::array<ir::ExpressionPtr, 3> nominal;
  for (const stdlib::ReadArgument& one : reading.arguments) {
    const stdlib::MacroArgument& meaning = *one.meaning;
    const Word& word = *words[one.at];
    const ir::ExpressionPtr read = argument(meaning, word);
    if (!read) return false;
    call.setsTool = call.setsTool || meaning.kind == ir::Kind::ToolOffset;
    if (meaning.role == stdlib::ArgumentRole::Nominal) {
      nominal[ir::indexOf(meaning.axis)] = read;
    } else if (meaning.role == stdlib::ArgumentRole::System) {
      const ir::ExpressionPtr system = workSystem(meaning, word, read);
      if (!system) return false;
      call.setting = ir::CycleSetting{system, facts.sets, {}};
    } else {
      const bool coordinate = meaning.role == stdlib::ArgumentRole::Target;
      call.arguments.push_back({stdlib::parameterName(meaning), read,
                                coordinate ? std::optional(meaning.frame) : std::nullopt, meaning.kind,
                                stdlib::movesProbe(meaning.role)});
    }
  }
  if (call.setting) call.setting->nominal = std::move(nominal);
  if (!call.power) context_.measured = &signature;
  add(std::move(call));
  return true;
}

// 101 and following, or 154.01, are G54.1 P1 and following: the control has that one.
bool Lifter::isExtended(const stdlib::MacroArgument& argument, double number) const {
  const stdlib::SystemVariables& v = context_.control.variables;
  const std::uint32_t entry = stdlib::extendedSystem(argument, number);
  return entry != 0 && v.extendedX && static_cast<int>(entry) <= v.extendedCount;
}

// The G number of the system that `read`, the argument, names. What stands for an extended one is counted on
// from there: a call of the same macro gets the number back.
ir::ExpressionPtr Lifter::workSystem(const stdlib::MacroArgument& argument, const Word& word,
                                     const ir::ExpressionPtr& read) {
  const bool index = argument.systemCode == stdlib::SystemCode::Index;
  const std::optional<double> known = knownNumber(*word.value);
  if (known) {
    const double number = index ? *known + (kFirstSystem - 1) : *known;
    const bool whole = number >= 0 && number < 10000 && number == std::trunc(number);
    const stdlib::CodeInfo* code =
        whole ? context_.control.find('G', static_cast<std::uint32_t>(number) * 10) : nullptr;
    const bool standsForExtended = index && isExtended(argument, *known);
    if (!standsForExtended && (code == nullptr || code->function != stdlib::Function::WorkSystem)) {
      refuse<diag::NoWorkSystem>(word.range, argument.letter, numberText(*known), context_.control.name);
      return nullptr;
    }
  }
  if (!index) return read;
  if (const double* constant = ir::constantValue(read))
    return ir::constant(*constant + (kFirstSystem - 1), word.range);
  return ir::binary(ir::BinaryOp::Add, read, ir::constant(kFirstSystem - 1, word.range), word.range);
}

std::vector<std::uint32_t> programsCalled(const Block& block) {
  std::vector<std::uint32_t> out;
  const bool calls = std::any_of(block.words.begin(), block.words.end(), [](const Word& word) {
    return word.address == 'G' && codeTenths(word) == 650U;
  });
  if (!calls) return out;
  for (const Word& word : block.words) {
    if (word.address != 'P' || !word.value) continue;
    const std::optional<double> program = literalOf(*word.value);
    if (program && *program >= 0 && *program <= 99999999 && *program == std::trunc(*program))
      out.push_back(static_cast<std::uint32_t>(*program));
  }
  return out;
}

} // namespace dotek::frontend::nc
