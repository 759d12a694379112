// Calls of a vendor's macros by their signatures.
#include "frontend/nc/Lifter.h"
#include "support/Decimal.h"
#include "support/messages/Nc.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dotek::frontend::nc {
namespace {

constexpr std::uint32_t kFirstSystem = 54; // SystemCode::Index 1

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
  for (const Word& word : block_.words) {
    if (word.address == 'G' || word.address == 'P') continue;
    if (letters.find(word.address) != std::string::npos)
      return refuse<diag::AddressTwice>(word.range, word.address);
    letters += word.address;
  }
  const stdlib::SignatureMatch match = stdlib::match(*context_.macros, program, letters);
  if (match.unknown != 0) {
    const Word* word = find(match.unknown);
    return refuse<diag::UnknownMacroLetter>(word == nullptr ? programWord.range : word->range, program,
                                            context_.macros->name, match.unknown);
  }
  if (match.refused != nullptr)
    return refuse<diag::MacroLettersRefused>(block_.range, program, context_.macros->name,
                                             fmt::format("{}", fmt::join(match.refused->letters, " and ")),
                                             match.refused->text.empty() ? "" : ": " + match.refused->text);
  if (!match.missing.empty())
    return refuse<diag::MissingMacroLetter>(block_.range, program, context_.macros->name, match.missing);
  if (match.signature == nullptr)
    return refuse<diag::AmbiguousMacro>(block_.range, program, context_.macros->name, letters);
  if (context_.state.absolute != true && match.signature->intent != stdlib::Intent::ProbeOn &&
      match.signature->intent != stdlib::Intent::ProbeOff)
    return refuse<diag::CallUnderIncremental>(block_.range, program);
  // The macro moves at a feed of its own and leaves its motion behind; G90 it restores.
  context_.state.motion = std::nullopt;
  context_.state.feed = nullptr;
  context_.stored.clear();
  switch (match.signature->intent) {
  case stdlib::Intent::ProtectedMove: return protectedMove(*match.signature);
  case stdlib::Intent::Surface:
  case stdlib::Intent::Bore: return measure(*match.signature);
  case stdlib::Intent::ProbeOn:
  case stdlib::Intent::ProbeOff:
    for (const Word& word : block_.words)
      if (const auto* found = match.signature->find(word.address))
        return refuse<diag::MacroLetterNotTranslated>(word.range, program, word.address,
                                                      stdlib::roleName(found->role));
    add(ir::ProbePower{match.signature->intent == stdlib::Intent::ProbeOn});
    return true;
  case stdlib::Intent::Boss:
  case stdlib::Intent::Pocket:
  case stdlib::Intent::Web:
  case stdlib::Intent::InnerCorner:
  case stdlib::Intent::OuterCorner:
  case stdlib::Intent::Angle:
  case stdlib::Intent::AngledSurface:
  case stdlib::Intent::AngledPocket:
  case stdlib::Intent::AngledWeb:
  case stdlib::Intent::ThreePointBore:
  case stdlib::Intent::ThreePointBoss:
  case stdlib::Intent::BoltCircle:
  case stdlib::Intent::StockAllowance:
  case stdlib::Intent::FeatureToFeature:
  case stdlib::Intent::ToolUpdate:
  case stdlib::Intent::Calibration: break;
  }
  return refuse<diag::MacroNotTranslated>(programWord.range, program, context_.macros->name,
                                          "`" + match.signature->title + "`");
}

// The argument stands in the call.
ir::ExpressionPtr Lifter::argument(const stdlib::MacroArgument& argument) {
  const Word& word = *find(argument.letter);
  Reading reading{argument.kind, false};
  const bool measures =
      !argument.selector && (argument.kind == ir::Kind::Length || argument.kind == ir::Kind::Angle);
  if (argument.selector) reading.kind = ir::Kind::Number;
  if (argument.role == stdlib::ArgumentRole::Feed && !inRange(word, "a feed", false)) return nullptr;
  if (argument.role == stdlib::ArgumentRole::Diameter && !inRange(word, "a diameter", false)) return nullptr;
  reading.increments = measures && context_.control.isLength(argument.letter);
  const ir::ExpressionPtr out = value(word, reading);
  if (!out) return nullptr;
  if (const auto* use = std::get_if<ir::VariableUse>(&out->node))
    origin_.arguments.emplace_back(argument.letter, use->variable);
  return out;
}

bool Lifter::protectedMove(const stdlib::MacroSignature& signature) {
  ir::Move move;
  move.motion = ir::Motion::Protected;
  for (const Word& word : block_.words) {
    const stdlib::MacroArgument* found = signature.find(word.address);
    if (found == nullptr || word.address == 'G' || word.address == 'P') continue;
    const ir::ExpressionPtr read = argument(*found);
    if (!read) return false;
    if (found->role == stdlib::ArgumentRole::Target)
      move.axes[ir::indexOf(found->axis)] = ir::Coordinate{read, found->frame, nullptr};
    else if (found->role == stdlib::ArgumentRole::Feed)
      move.feed = read;
    else
      return refuse<diag::MacroLetterNotTranslated>(word.range, signature.program, word.address,
                                                    stdlib::roleName(found->role));
  }
  add(std::move(move));
  return true;
}

bool Lifter::measure(const stdlib::MacroSignature& signature) {
  ir::Measure measure;
  measure.feature = signature.intent == stdlib::Intent::Bore ? ir::Feature::Bore : ir::Feature::Surface;
  ir::OffsetSetting setting;
  bool nominals = false;
  bool sets = false;
  const stdlib::MacroArgument* system = nullptr;
  for (const Word& word : block_.words) {
    const stdlib::MacroArgument* found = signature.find(word.address);
    if (found == nullptr || word.address == 'G' || word.address == 'P') continue;
    const ir::ExpressionPtr read = argument(*found);
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
      system = found;
      setting.system = workSystem(*found, word, read);
      if (!setting.system) return false;
      sets = true;
      break;
    default:
      return refuse<diag::MacroLetterNotTranslated>(word.range, signature.program, word.address,
                                                    stdlib::roleName(found->role));
    }
  }
  if (sets && system->systemRule == stdlib::SystemRule::Error) {
    // Where the probe stands is the nominal centre of a bore: the source does not write it.
    if (!measure.target)
      return refuse<diag::OffsetWithoutNominal>(find(system->letter)->range, signature.program,
                                                system->letter);
    setting.nominal[ir::indexOf(measure.axis)] = measure.target->value;
    nominals = true;
  }
  if (sets != nominals)
    return refuse<diag::MissingMacroLetter>(block_.range, signature.program, context_.macros->name,
                                            sets ? "the nominal coordinate" : "the work offset");
  if (sets) measure.setting = std::move(setting);
  context_.measured = &signature;
  add(std::move(measure));
  return true;
}

// The G number of the system that `read`, the argument, names.
ir::ExpressionPtr Lifter::workSystem(const stdlib::MacroArgument& argument, const Word& word,
                                     const ir::ExpressionPtr& read) {
  const bool index = argument.systemCode == stdlib::SystemCode::Index;
  const std::optional<double> known = knownNumber(*word.value);
  if (known) {
    const double number = index ? *known + (kFirstSystem - 1) : *known;
    const bool whole = number >= 0 && number < 10000 && number == std::trunc(number);
    const stdlib::CodeInfo* code =
        whole ? context_.control.find('G', static_cast<std::uint32_t>(number) * 10) : nullptr;
    if (code == nullptr || code->function != stdlib::Function::WorkSystem) {
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
