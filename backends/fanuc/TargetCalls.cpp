#include "backends/fanuc/TargetCalls.h"

#include "backends/fanuc/Uses.h"
#include "ir/CycleNames.h"
#include "ir/Fold.h"
#include "ir/Positions.h"
#include "ir/Rewrite.h"
#include "ir/ShareVariables.h"
#include "ir/Walk.h"
#include "support/Ascii.h"
#include "support/messages/Cycle.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::targets {

namespace fanuc = backends::fanuc;

namespace {

// The program itself, a macro of the set and one that this calls in turn.
constexpr std::uint32_t kOtherLevels = 3;

std::optional<std::size_t> programOf(const ir::CycleStatement& statement) {
  const auto* call = std::get_if<ir::CallCycle>(&statement.node);
  if (call == nullptr || call->cycle != ir::kProgram) return std::nullopt;
  for (const ir::CycleArgument& one : call->arguments)
    if (const double* index = ir::constantValue(one.value);
        one.parameter == ir::kCalledProgram && index != nullptr)
      return static_cast<std::size_t>(*index);
  return std::nullopt;
}

std::set<std::string> storedBy(const ir::Cycle& cycle) {
  std::set<std::string> out;
  for (const ir::CycleStatement& statement : cycle.body)
    if (const auto* call = std::get_if<ir::CallCycle>(&statement.node);
        call != nullptr && call->cycle == ir::kKeep)
      for (const ir::CycleArgument& one : call->arguments)
        out.insert(one.parameter);
  return out;
}

} // namespace

std::optional<std::vector<backends::EmittedLine>>
emitSharing(const ir::Cycle& cycle, const fanuc::EmitOptions& emit, bool mayShare, const SourceMap& sources,
            Diagnostics& diagnostics, std::vector<fanuc::Argument>& letters, std::uint32_t* alarms) {
  Diagnostics said;
  auto lines = fanuc::emit(cycle, emit, sources, said, &letters, alarms);
  for (const ir::Sharing sharing : {ir::Sharing::Locals, ir::Sharing::Arguments}) {
    const bool few = !lines && std::any_of(said.all().begin(), said.all().end(), [](const Diagnostic& one) {
      return one.code == diag::TooManyLocals::code || one.code == diag::ExpressionDepth::code;
    });
    if (!few || !mayShare) break;
    ir::Cycle shared = cycle;
    ir::shareVariables(shared, sharing);
    fanuc::EmitOptions options = emit;
    if (sharing == ir::Sharing::Arguments) options.unshared = &cycle;
    said = Diagnostics();
    lines = fanuc::emit(shared, options, sources, said, &letters, alarms);
  }
  for (Diagnostic& one : said.all())
    diagnostics.add(std::move(one));
  return lines;
}

std::uint32_t programLevels(const stdlib::Control& control) {
  return control.macroLevels > kOtherLevels ? control.macroLevels - kOtherLevels : 1;
}

CalledPrograms::CalledPrograms(LoweredCycle& lowered, ConversionContext& context,
                               const stdlib::MacroSet& macros)
    : lowered_(lowered), context_(context), macros_(macros), all_(lowered.programs.size()),
      programs_(lowered.programs.size()) {
  for (std::size_t i = 0; i < all_.size(); ++i)
    all_[i].lowered = &lowered.programs[i];
  reach(lowered.cycle);
  for (const CycleInPlace& one : lowered.inPlace)
    context.session.diagnostics().report<diag::CallStaysInline>(one.call, one.cycle, one.why);
}

void CalledPrograms::reach(ir::Cycle& cycle) {
  for (const ir::CycleStatement& statement : cycle.body) {
    const auto index = programOf(statement);
    if (!index || *index >= all_.size() || std::find(used_.begin(), used_.end(), *index) != used_.end())
      continue;
    used_.push_back(*index);
    LoweredProgram& program = *all_[*index].lowered;
    ir::fold(program.cycle, program.fixed);
    reach(program.cycle);
  }
}

std::set<std::string> CalledPrograms::stored() const {
  std::set<std::string> out;
  for (const std::size_t index : used_)
    out.merge(storedBy(all_[index].lowered->cycle));
  return out;
}

// The last ones of the first range that nobody else works in: programs that people write begin with the
// first ones.
bool CalledPrograms::takeVariables() {
  std::size_t wanted = 0;
  for (const std::size_t index : used_) {
    const LoweredProgram& program = *all_[index].lowered;
    for (std::size_t i = 0; i < program.results.size(); ++i)
      if (program.readResults.contains(program.results[i])) wanted = std::max(wanted, i + 1);
  }
  if (wanted == 0) return true;
  const stdlib::Control& control = *context_.inputs->control;
  std::set<std::uint32_t> taken;
  for (const auto& [name, text] : context_.options.results)
    taken.insert(resultNumber(text).value_or(0));
  std::vector<stdlib::MacroSet> sets = context_.session.macroSets(&control);
  sets.push_back(macros_);
  for (const stdlib::MacroSet& set : sets)
    for (const auto& [first, last] : set.scratch)
      for (std::uint32_t number = first; number <= last; ++number)
        taken.insert(number);
  std::vector<stdlib::VariableRange> ranges = control.common;
  std::stable_sort(ranges.begin(), ranges.end(),
                   [](const auto& a, const auto& b) { return !a.kept && b.kept; });
  for (const stdlib::VariableRange& range : ranges)
    for (std::uint32_t number = range.last; number >= range.first && variables_.size() < wanted; --number)
      if (!taken.contains(number)) variables_.push_back(number);
  if (variables_.size() == wanted) return true;
  context_.session.diagnostics().report<diag::NoVariableForResults>(lowered_.cycle.range, wanted,
                                                                    control.title);
  return false;
}

// Results by the variables that they are in.
void CalledPrograms::name(ir::Cycle& cycle) const {
  for (ir::CycleStatement& statement : cycle.body)
    ir::rewrite(statement, [&](const ir::ExpressionPtr& node) {
      const auto index = ir::handedBackOf(*node);
      return index ? ir::machineVariable(ir::constant(variables_.at(*index)), node->range) : node;
    });
}

// An argument moves the probe where the called cycle moves by it.
void CalledPrograms::markMoving(ir::Cycle& cycle) const {
  for (ir::CycleStatement& statement : cycle.body) {
    const auto index = programOf(statement);
    if (!index || *index >= all_.size()) continue;
    const ir::Cycle& called = all_[*index].lowered->cycle;
    const std::set<ir::VariableId> moving = fanuc::movingVariables(called, *context_.inputs->control);
    for (ir::CycleArgument& one : std::get<ir::CallCycle>(statement.node).arguments)
      one.moves = std::any_of(moving.begin(), moving.end(),
                              [&](ir::VariableId id) { return called.variable(id).name == one.parameter; });
  }
}

bool CalledPrograms::prepare(std::uint32_t first, KeptResults& results) {
  if (used_.empty()) return true;
  if (!takeVariables()) return false;
  Diagnostics& diagnostics = context_.session.diagnostics();
  for (std::size_t i = 0; i < used_.size(); ++i) {
    One& one = all_[used_[i]];
    LoweredProgram& program = *one.lowered;
    NamedTexts wanted;
    const std::set<std::string> stored = storedBy(program.cycle);
    for (const auto& [name, text] : context_.options.results)
      if (stored.contains(name)) wanted.emplace_back(name, text);
    KeptResults kept = keepResults(program.cycle, wanted, diagnostics, [&](const std::string& name) {
      const auto at = std::find(program.results.begin(), program.results.end(), name);
      return program.readResults.contains(name)
                 ? std::optional(variables_.at(static_cast<std::size_t>(at - program.results.begin())))
                 : std::nullopt;
    });
    results.stored.merge(kept.stored);
    one.remarks = std::move(kept.headings);
    name(program.cycle);
    programs_[used_[i]].number = first + static_cast<std::uint32_t>(i);
    programs_[used_[i]].cycle = &program.cycle;
  }
  for (const std::uint32_t number : variables_)
    handedBack_.insert(number);
  name(lowered_.cycle);
  std::string numbers;
  for (const std::uint32_t number : variables_)
    numbers += fmt::format("{}#{}", numbers.empty() ? "" : " ", number);
  std::string programs;
  for (const std::size_t index : used_)
    programs += fmt::format("{}O{:04} {}", programs.empty() ? "" : ", ", programs_[index].number,
                            upperCase(all_[index].lowered->cycle.name));
  results.headings.push_back("CALLS " + programs);
  if (!numbers.empty()) results.headings.push_back("THEIR RESULTS ARE HANDED BACK IN " + numbers);
  return !diagnostics.hasErrors();
}

fanuc::EmitOptions CalledPrograms::optionsOf(std::size_t index, const fanuc::EmitOptions& emit) const {
  const LoweredProgram& program = *all_[index].lowered;
  fanuc::EmitOptions out = emit;
  out.programNumber = programs_[index].number;
  out.probePower = fanuc::ProbePowerMode::Source;
  out.letters.clear();
  std::set<char> taken;
  for (const auto& [id, letter] : program.letters)
    if (ir::uses(program.cycle, id) && std::string_view("GLNOP").find(letter) == std::string_view::npos &&
        taken.insert(letter).second)
      out.letters.emplace(program.cycle.variable(id).name, letter);
  out.fixed.clear();
  for (const auto& [id, value] : program.fixed)
    if (ir::uses(program.cycle, id)) out.fixed.emplace(program.cycle.variable(id).name, value);
  out.choices.clear();
  out.computed.clear();
  out.remarks = all_[index].remarks;
  out.programs = programs_;
  out.calledFrom = emit.programNumber;
  out.ends = index == used_.back();
  return out;
}

bool CalledPrograms::learn(std::size_t index, const fanuc::EmitOptions& emit) {
  One& one = all_[index];
  if (std::exchange(one.done, true)) return true;
  ir::Cycle& cycle = one.lowered->cycle;
  fanuc::CalledProgram& program = programs_[index];
  for (const ir::CycleStatement& statement : cycle.body) {
    const auto inner = programOf(statement);
    if (!inner) {
      const auto switched = ir::switchesProbe(statement);
      program.switchesOn = program.switchesOn || switched == true;
      program.switchesOff = program.switchesOff || switched == false;
      continue;
    }
    if (!learn(*inner, emit)) return false;
    program.switchesOn = program.switchesOn || programs_[*inner].switchesOn;
    program.switchesOff = program.switchesOff || programs_[*inner].switchesOff;
  }
  markMoving(cycle);
  Diagnostics said;
  std::vector<fanuc::Argument> letters;
  const auto lines =
      emitSharing(cycle, optionsOf(index, emit), true, context_.session.sources(), said, letters);
  programs_[index].arguments = std::move(letters);
  if (!lines)
    for (Diagnostic& diagnostic : said.all())
      context_.session.diagnostics().add(std::move(diagnostic));
  return lines.has_value();
}

bool CalledPrograms::addTo(fanuc::EmitOptions& emit) {
  if (used_.empty()) return true;
  if (programs_[used_.front()].number == 0) return false; // prepare() has reported why
  for (const std::size_t index : used_)
    if (!learn(index, emit)) return false;
  markMoving(lowered_.cycle);
  emit.programs = programs_;
  emit.ends = false;
  return true;
}

bool CalledPrograms::append(const fanuc::EmitOptions& emit, std::uint32_t alarms,
                            std::vector<backends::EmittedLine>& lines) {
  for (const std::size_t index : used_) {
    fanuc::EmitOptions options = optionsOf(index, emit);
    options.alarmsBefore = alarms;
    std::vector<fanuc::Argument> letters;
    std::uint32_t own = 0;
    auto added = emitSharing(all_[index].lowered->cycle, options, true, context_.session.sources(),
                             context_.session.diagnostics(), letters, &own);
    if (!added) return false;
    alarms += own;
    lines.insert(lines.end(), std::make_move_iterator(added->begin()), std::make_move_iterator(added->end()));
  }
  return true;
}

} // namespace dotek::targets
