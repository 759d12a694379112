#include "lint/Probing.h"

#include "lint/Skips.h"

#include "ir/Walk.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace dotek::lint {
namespace {

// A longer program is a CAM's, where one move follows another; facts of all its paths would take minutes.
constexpr std::size_t kMostStatements = 20000;
// Optional arguments of measuring macros, which the data leave out.
constexpr std::string_view kOptional = "BEFHMQRTUVW";
constexpr std::uint32_t kPack = 100; // macros of a pack share their hundred: 9800 to 9899

// The number of a variable that is written out; a half is rounded up.
std::optional<std::uint32_t> writtenNumber(const ir::ExpressionPtr& number) {
  const double* value = ir::constantValue(number);
  if (value == nullptr || !(*value >= 0 && *value <= 1e6)) return std::nullopt;
  const auto whole = static_cast<std::uint32_t>(*value);
  return *value - whole >= 0.5 ? whole + 1 : whole;
}

bool inPack(const Project& project, std::uint32_t program) {
  for (const stdlib::MacroSet& set : project.macroSets)
    for (const stdlib::MacroSignature& signature : set.signatures)
      if (signature.program / kPack == program / kPack) return true;
  return false;
}

std::optional<ProbeStep::Kind> meaning(const Project& project, std::uint32_t program,
                                       std::string_view letters) {
  for (const stdlib::MacroSet& set : project.macroSets) {
    if (!mayBeOf(set, program, letters)) continue;
    for (const stdlib::MacroSignature* signature : set.of(program)) {
      switch (signature->intent) {
      case stdlib::Intent::ProtectedMove: return ProbeStep::Kind::Protected;
      case stdlib::Intent::ProbeOn: return ProbeStep::Kind::On;
      case stdlib::Intent::ProbeOff: return ProbeStep::Kind::Off;
      // These compute or remember; they do not touch.
      case stdlib::Intent::FeatureToFeature:
      case stdlib::Intent::ToolUpdate: return ProbeStep::Kind::PackCall;
      default: return ProbeStep::Kind::Measure;
      }
    }
  }
  // Off is off with a letter more; that it is on then is not known.
  for (const stdlib::MacroSet& set : project.macroSets)
    for (const stdlib::MacroSignature* signature : set.of(program))
      if (signature->intent == stdlib::Intent::ProbeOff) return ProbeStep::Kind::Off;
  return std::nullopt;
}

} // namespace

bool mayBeOf(const stdlib::MacroSet& set, std::uint32_t program, std::string_view letters) {
  return std::all_of(letters.begin(), letters.end(), [&](char letter) {
    return kOptional.find(letter) != std::string_view::npos || stdlib::takesLetter(set, program, letter);
  });
}

stdlib::CallReading readKnown(const stdlib::MacroSet& set, std::uint32_t program, std::string_view letters) {
  std::string known;
  for (const char letter : letters)
    if (stdlib::takesLetter(set, program, letter) && known.find(letter) == std::string::npos) known += letter;
  return stdlib::readCall(set, program, known);
}

Probing::Probing(const Project& project) : project_(project) {
  readOwn();
  if (project.control) return;
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    for (const ir::ProgramStatement& statement : program.body) {
      if (guessCodes_) return;
      const auto* block = std::get_if<ir::NcBlock>(&statement.node);
      const ProbeStep::Kind kind = step(statement).kind;
      guessCodes_ = (block != nullptr && hasCode(*block, 'G', 31)) || kind == ProbeStep::Kind::Protected ||
                    kind == ProbeStep::Kind::Measure;
    }
  });
  // The blocks of a post are those of the control of its form, or of a probing cycle anyway.
  guessCodes_ = guessCodes_ || !project.joined.empty();
}

void Probing::readOwn() {
  for (const NcFile& file : project_.programs)
    for (const macrob::Program& one : file.file->programs)
      if (one.name) own_.insert(one.name->number);
  struct Own {
    std::set<std::uint32_t> calls;
    std::uint32_t number = 0;
    bool open = false; // switches the probe, or calls what is not known
    bool skips = false;
    bool lifts = false; // along Z, after the last measurement
  };
  std::map<std::uint32_t, Own> all;
  eachProgram(project_, [&](const ir::Program& program, const macrob::File&) {
    Own& own = all[static_cast<std::uint32_t>(program.number)];
    own.number = static_cast<std::uint32_t>(program.number);
    for (const ir::ProgramStatement& statement : program.body) {
      const auto* block = std::get_if<ir::NcBlock>(&statement.node);
      const bool skip = block != nullptr && hasCode(*block, 'G', 31);
      own.skips = own.skips || skip;
      if (skip) own.lifts = false;
      if (!skip && block != nullptr && isPlainMove(*block) && hasWord(*block, 'Z') && !hasWord(*block, 'X') &&
          !hasWord(*block, 'Y'))
        own.lifts = true;
      if (block != nullptr)
        for (const ir::Word& word : block->words) {
          const double* code = word.address == 'M' ? ir::constantValue(word.value) : nullptr;
          // M0 to M9, M30 and M99 switch no probe; of others only a profile knows.
          own.open = own.open || (word.address == 'M' && (code == nullptr || (*code > 9 && *code != 30)));
        }
      const ProbeStep one = step(statement);
      if (one.kind == ProbeStep::Kind::Measure || one.kind == ProbeStep::Kind::Call) own.lifts = false;
      if (one.kind == ProbeStep::Kind::Call && one.program != 0)
        own.calls.insert(one.program);
      else if (one.kind != ProbeStep::Kind::None)
        own.open = true;
    }
  });
  // What a program calls decides as well: from what is called to who calls it.
  std::map<std::uint32_t, std::vector<Own*>> callers;
  std::vector<std::uint32_t> decided;
  for (auto& [number, own] : all) {
    for (const std::uint32_t called : own.calls) {
      callers[called].push_back(&own);
      own.open = own.open || !all.contains(called);
    }
    if (own.open || own.skips) decided.push_back(number);
  }
  while (!decided.empty()) {
    const Own& own = all.at(decided.back());
    const auto above = callers.find(decided.back());
    decided.pop_back();
    if (above == callers.end()) continue;
    for (Own* caller : above->second) {
      if ((caller->open || !own.open) && (caller->skips || !own.skips)) continue;
      caller->open = caller->open || own.open;
      caller->skips = caller->skips || own.skips;
      decided.push_back(caller->number);
    }
  }
  for (const auto& [number, own] : all) {
    if (!own.open && number != 0) quiet_.insert(number);
    if (own.skips && number != 0) skipping_.insert(number);
    if (own.lifts && number != 0) lifting_.insert(number);
  }
}

ProbeStep::Kind Probing::codeStep(double code) const {
  const auto number = static_cast<std::uint32_t>(std::lround(code * 10));
  const auto of = [&](const stdlib::Control& control) {
    const stdlib::CodeInfo* info = control.find('M', number);
    if (info == nullptr) return ProbeStep::Kind::None;
    return info->function == stdlib::Function::ProbeOn    ? ProbeStep::Kind::On
           : info->function == stdlib::Function::ProbeOff ? ProbeStep::Kind::Off
                                                          : ProbeStep::Kind::None;
  };
  if (project_.control) return of(*project_.control);
  if (!guessCodes_) return ProbeStep::Kind::None;
  for (const stdlib::Control& control : project_.controls)
    if (const ProbeStep::Kind kind = of(control); kind != ProbeStep::Kind::None) return kind;
  return ProbeStep::Kind::None;
}

ProbeStep Probing::callStep(const ir::Call& call) const {
  using Kind = ProbeStep::Kind;
  if (call.kind == ir::CallKind::Off) return {};
  const double* number = call.program ? ir::constantValue(call.program) : nullptr;
  if (number == nullptr || *number < 0) return {Kind::Call, 0};
  const auto program = static_cast<std::uint32_t>(std::lround(*number));
  std::string letters;
  for (const ir::CallArgument& argument : call.arguments)
    letters += argument.letter;
  if (const auto kind = meaning(project_, program, letters)) return {*kind, program};
  if (quiet_.contains(program)) return {Kind::OwnCall, program};
  return {inPack(project_, program) ? Kind::PackCall : Kind::Call, program};
}

ProbeStep Probing::blockStep(const ir::NcBlock& block) const {
  using Kind = ProbeStep::Kind;
  for (const ir::Word& word : block.words) {
    const double* code = word.address == 'M' ? ir::constantValue(word.value) : nullptr;
    const Kind kind = code == nullptr || *code < 0 ? Kind::None : codeStep(*code);
    if (kind != Kind::None) return {kind, 0};
  }
  return {};
}

template <ir::AnyStatement Statement> ProbeStep Probing::stepOf(const Statement& statement) const {
  using Kind = ProbeStep::Kind;
  return match(
      statement,
      [](const ir::ProbePower& node) -> ProbeStep {
        return {node.on ? Kind::On : Kind::Off, 0};
      },
      [](const ir::Measure&) -> ProbeStep {
        return {Kind::Measure, 0};
      },
      [](const ir::CallCycle& node) -> ProbeStep {
        if (node.power) return {*node.power ? Kind::On : Kind::Off, 0};
        return {node.moves ? Kind::Measure : Kind::PackCall, 0};
      },
      [](const ir::Move& node) -> ProbeStep {
        return {node.motion == ir::Motion::Protected ? Kind::Protected : Kind::None, 0};
      },
      [&](const ir::Call& node) { return callStep(node); },
      [&](const ir::NcBlock& node) { return blockStep(node); },
      // A block of a cycle whose meaning is not known may do anything, but none is taken to switch the probe.
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Comment, ir::Assign, ir::Return,
                         ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm,
                         ir::OpaqueBlock, ir::JumpTo, ir::Loop, ir::LoopEnd, ir::Exit, ir::Raise, ir::Notice,
                         ir::Port, ir::Print, ir::NameVariables> auto&) -> ProbeStep { return {}; });
}

ProbeStep Probing::step(const ir::CycleStatement& statement) const {
  return stepOf(statement);
}

ProbeStep Probing::step(const ir::ProgramStatement& statement) const {
  return stepOf(statement);
}

template <ir::AnyStatement Statement>
std::vector<std::optional<ProbeState>> Probing::statesOf(const std::vector<Statement>& body,
                                                         const ir::ProgramFlow& flow) const {
  return ir::factsBefore<ProbeState>(
      body, flow, ProbeState::AsBefore,
      [&](std::size_t at, std::size_t, ProbeState before) {
        switch (step(body[at]).kind) {
        case ProbeStep::Kind::On: return ProbeState::On;
        case ProbeStep::Kind::Off: return ProbeState::Off;
        case ProbeStep::Kind::Call: return ProbeState::Mixed;
        case ProbeStep::Kind::None:
        case ProbeStep::Kind::Protected:
        case ProbeStep::Kind::Measure:
        case ProbeStep::Kind::PackCall:
        case ProbeStep::Kind::OwnCall: break;
        }
        return before;
      },
      [](ProbeState& into, ProbeState other) {
        if (into == other || into == ProbeState::Mixed) return false;
        into = ProbeState::Mixed;
        return true;
      });
}

std::vector<std::optional<ProbeState>> Probing::states(const std::vector<ir::CycleStatement>& body) const {
  return statesOf(body, ir::flowOf(body));
}

std::vector<std::optional<ProbeState>> Probing::states(const std::vector<ir::ProgramStatement>& body,
                                                       const ir::ProgramFlow& flow) const {
  return statesOf(body, flow);
}

bool Probing::probes(const ir::Program& program) const {
  return std::any_of(program.body.begin(), program.body.end(), [&](const ir::ProgramStatement& statement) {
    const ProbeStep::Kind kind = step(statement).kind;
    return kind != ProbeStep::Kind::None && kind != ProbeStep::Kind::Call && kind != ProbeStep::Kind::OwnCall;
  });
}

bool endsProgram(const ir::Program& program) {
  return std::any_of(program.body.begin(), program.body.end(),
                     [](const ir::ProgramStatement& statement) { return ir::endsProgram(statement); });
}

void eachProgram(const Project& project,
                 const std::function<void(const ir::Program&, const macrob::File&)>& visit) {
  for (const NcFile& nc : project.programs) {
    if (!nc.lowered) continue;
    for (const ir::Program& program : nc.lowered->programs)
      if (program.body.size() <= kMostStatements) visit(program, *nc.file);
  }
}

std::optional<double> wordValue(const ir::NcBlock& block, char address) {
  for (const ir::Word& word : block.words) {
    if (word.address != address) continue;
    const double* value = ir::constantValue(word.value);
    return value == nullptr ? std::nullopt : std::optional(*value);
  }
  return std::nullopt;
}

bool hasWord(const ir::NcBlock& block, char address) {
  return std::any_of(block.words.begin(), block.words.end(),
                     [&](const ir::Word& word) { return word.address == address; });
}

bool hasCode(const ir::NcBlock& block, char address, double code) {
  return std::any_of(block.words.begin(), block.words.end(), [&](const ir::Word& word) {
    const double* value = word.address == address ? ir::constantValue(word.value) : nullptr;
    return value != nullptr && *value == code;
  });
}

bool endsAbove(const ir::ProgramStatement& statement) {
  const auto* call = std::get_if<ir::Call>(&statement.node);
  return call != nullptr && std::any_of(call->arguments.begin(), call->arguments.end(),
                                        [](const ir::CallArgument& one) { return one.letter == 'Z'; });
}

bool endsAbove(const ir::CycleStatement&) {
  return false;
}

std::optional<std::uint32_t> variableNumber(const ir::Expression& expression) {
  const auto* variable = std::get_if<ir::MachineVariable>(&expression.node);
  return variable == nullptr ? std::nullopt : writtenNumber(variable->number);
}

std::optional<std::uint32_t> storedNumber(const ir::ProgramStatement& statement) {
  const auto* store = std::get_if<ir::Store>(&statement.node);
  return store == nullptr ? std::nullopt : writtenNumber(store->number);
}

void eachRead(const ir::ProgramStatement& statement,
              const std::function<void(std::uint32_t number, SourceRange range)>& visit) {
  eachRead(statement, visit, [](const ir::MachineVariable&) {});
}

void eachRead(const ir::ProgramStatement& statement,
              const std::function<void(std::uint32_t number, SourceRange range)>& visit,
              const std::function<void(const ir::MachineVariable&)>& computed) {
  ir::eachNode(statement, [&](const ir::Expression& node) {
    const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
    if (variable == nullptr) return;
    if (const auto number = writtenNumber(variable->number))
      visit(*number, node.range);
    else
      computed(*variable);
  });
  if (const auto* print = std::get_if<ir::Print>(&statement.node))
    for (const ir::PrintPiece& piece : print->pieces)
      if (piece.number) visit(*piece.number, statement.origin.range());
}

} // namespace dotek::lint
