#include "backends/fanuc/ProgramCalls.h"

#include "backends/fanuc/ProgramResults.h"
#include "ir/Flow.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <set>
#include <utility>

namespace dotek::backends::fanuc {

namespace {

// P of a macro call with a literal number that some set knows.
std::optional<std::uint32_t> knownCall(const ir::ProgramStatement& statement,
                                       const std::vector<stdlib::MacroSet>& sets) {
  const auto* call = std::get_if<ir::Call>(&statement.node);
  if (call == nullptr || !call->program) return std::nullopt;
  const double* value = ir::constantValue(call->program);
  if (value == nullptr || *value < 1 || *value > 99999999) return std::nullopt;
  const auto number = static_cast<std::uint32_t>(std::lround(*value));
  const bool known =
      std::any_of(sets.begin(), sets.end(), [&](const stdlib::MacroSet& set) { return set.calls(number); });
  return known ? std::optional(number) : std::nullopt;
}

// `fits`: sets that know all calls so far.
struct Found {
  std::vector<const stdlib::MacroSet*> fits;
  const ir::ProgramStatement* first = nullptr;
  const ir::ProgramStatement* mixed = nullptr;
};

void look(const ir::Program& program, const std::vector<stdlib::MacroSet>& sets, Found& found) {
  for (const ir::ProgramStatement& statement : program.body) {
    const auto number = knownCall(statement, sets);
    if (!number || found.mixed != nullptr) continue;
    if (found.first == nullptr) {
      found.first = &statement;
      for (const stdlib::MacroSet& set : sets)
        found.fits.push_back(&set);
    }
    std::erase_if(found.fits, [&](const stdlib::MacroSet* set) { return !set->calls(*number); });
    if (found.fits.empty()) found.mixed = &statement;
  }
}

constexpr std::uint32_t kFirstAlarm = 150; // #3000 of the checks before calls, where it is free

// n of #3000 that no program of the file raises.
std::uint32_t freeAlarm(const ir::ProgramFile& file, const stdlib::Control& control) {
  std::set<std::uint32_t> taken;
  for (const ir::Program& program : file.programs)
    for (const ir::ProgramStatement& statement : program.body)
      if (const auto* raise = std::get_if<ir::Raise>(&statement.node))
        if (const double* value = ir::constantValue(raise->number); value != nullptr && *value >= 0)
          taken.insert(static_cast<std::uint32_t>(std::lround(*value)));
  for (std::uint32_t number = kFirstAlarm; number <= control.alarmLast; ++number)
    if (!taken.contains(number)) return number;
  for (std::uint32_t number = kFirstAlarm - 1; number > control.alarmFirst; --number)
    if (!taken.contains(number)) return number;
  return kFirstAlarm;
}

// "#520 to #523 have to be set before the first call": what the macros keep at power off.
std::string setup(const stdlib::MacroSet& set, const stdlib::Control& control) {
  std::string kept;
  for (const auto& scratch : set.scratch)
    if (std::any_of(control.common.begin(), control.common.end(), [&](const stdlib::VariableRange& range) {
          return range.kept && range.first <= scratch.first && scratch.second <= range.last;
        }))
      kept += fmt::format("{}#{} to #{}", kept.empty() ? "" : ", ", scratch.first, scratch.second);
  return kept.empty() ? "set them up before the first call"
                      : "what they keep in " + kept + " has to be set before the first call";
}

// The calls of one program, one after the other.
class Calls {
public:
  Calls(ir::Program& program, const ir::ProgramFile& file, const TranslateSettings& settings,
        Diagnostics& diagnostics)
      : program_(program), file_(file), settings_(settings), diagnostics_(diagnostics) {}

  void run() {
    std::vector<ir::ProgramStatement> body = std::move(program_.body);
    program_.body.clear();
    for (std::size_t begin = 0; begin < body.size();) {
      std::size_t end = begin + 1;
      const std::uint32_t old = body[begin].origin.block;
      while (end < body.size() && old != 0 && body[end].origin.block == old)
        ++end;
      if (old != 0) ++block_;
      bool behindWords = false;
      for (std::size_t i = begin; i < end; ++i) {
        const bool layout = ir::isLayout(body[i]);
        statement(std::move(body[i]), behindWords);
        behindWords = behindWords || !layout;
      }
      begin = end;
    }
  }

private:
  void add(ir::ProgramStatement statement) {
    if (statement.origin.block != 0) statement.origin.block = block_;
    program_.body.push_back(std::move(statement));
  }

  // `behindWords`: something is carried out before it in its block.
  void statement(ir::ProgramStatement one, bool behindWords) {
    if (const auto* block = std::get_if<ir::NcBlock>(&one.node)) probeSwitch(*block, one.origin.range());
    const auto* call = std::get_if<ir::Call>(&one.node);
    if (call == nullptr || call->kind == ir::CallKind::Off) return add(std::move(one));
    const auto number = calledProgram(*call, settings_.control);
    if (number && !settings_.source.calls(*number)) {
      const bool here = std::any_of(file_.programs.begin(), file_.programs.end(),
                                    [&](const ir::Program& program) { return program.number == *number; });
      if (!here && elsewhere_.insert(*number).second)
        diagnostics_.report<diag::CalledElsewhere>(one.origin.range(), *number, settings_.source.title);
      return add(std::move(one));
    }
    TranslatedCall there;
    if (number)
      there = translateCall(*call, settings_);
    else
      there.refusal = fmt::format("which program is called is computed; it may be a macro of `{}`",
                                  settings_.source.name);
    if (!there.refusal.empty()) {
      diagnostics_.report<diag::CallNotTranslated>(one.origin.range(), settings_.target.name, there.refusal);
      return add(std::move(one));
    }
    for (const std::string& note : there.notes)
      if (notes_.insert(note).second)
        diagnostics_.report<diag::CallTranslated>(one.origin.range(), *number, note);
    write(std::move(one), std::move(there), behindWords);
  }

  // Each block and each check of `before` on a line of its own; the label of the call's block stays first.
  void write(ir::ProgramStatement one, TranslatedCall there, bool behindWords) {
    bool fresh = !behindWords; // nothing is on the line
    bool open = false;         // a check reaches to its label
    const auto line = [&] {
      if (!std::exchange(fresh, false)) ++block_;
    };
    for (ir::ProgramStatement& before : there.before) {
      if (!open) line();
      open = std::holds_alternative<ir::Branch>(before.node) ||
             (open && !std::holds_alternative<ir::Label>(before.node));
      before.origin = one.origin;
      before.origin.reason = kReason;
      if (!std::holds_alternative<ir::Label>(before.node)) before.blockDelete = one.blockDelete;
      add(std::move(before));
    }
    if (!there.call) return;
    if (!there.before.empty()) line();
    one.node = std::move(*there.call);
    one.origin.reason = kReason;
    add(std::move(one));
  }

  void probeSwitch(const ir::NcBlock& block, SourceRange range) {
    for (const ir::Word& word : block.words) {
      const double* value = word.address == 'M' ? ir::constantValue(word.value) : nullptr;
      if (value == nullptr || *value < 0 || *value > 9999) continue;
      const auto* code = settings_.control.find('M', static_cast<std::uint32_t>(std::lround(*value * 10)));
      if (code == nullptr) continue;
      const bool on = code->function == stdlib::Function::ProbeOn;
      if (!on && code->function != stdlib::Function::ProbeOff) continue;
      const auto* macro = settings_.target.find(on ? stdlib::Intent::ProbeOn : stdlib::Intent::ProbeOff);
      if (macro != nullptr && !std::exchange(switchTold_, true))
        diagnostics_.report<diag::ProbeSwitchLeft>(range, fmt::format("M{:g}", *value),
                                                   settings_.target.title, macro->program);
    }
  }

  static constexpr const char* kReason = "call of another set of macros";

  ir::Program& program_;
  const ir::ProgramFile& file_;
  const TranslateSettings& settings_;
  Diagnostics& diagnostics_;
  std::uint32_t block_ = 0; // number of the block that is written
  std::set<std::string> notes_;
  std::set<std::uint32_t> elsewhere_;
  bool switchTold_ = false;
};

// A call whose program is computed, or nullptr.
const ir::ProgramStatement* computedCall(const ir::ProgramFile& file) {
  for (const ir::Program& program : file.programs)
    for (const ir::ProgramStatement& statement : program.body)
      if (const auto* call = std::get_if<ir::Call>(&statement.node))
        if (call->program && ir::constantValue(call->program) == nullptr) return &statement;
  return nullptr;
}

} // namespace

const stdlib::MacroSet* calledSet(const ir::ProgramFile& file, const std::vector<stdlib::MacroSet>& sets,
                                  const ir::ProgramStatement** mixed) {
  Found found;
  for (const ir::Program& program : file.programs)
    look(program, sets, found);
  if (mixed != nullptr) *mixed = found.mixed;
  return found.first == nullptr || found.fits.empty() ? nullptr : found.fits.front();
}

bool translateCalls(ir::ProgramFile& file, const CallOptions& options, Diagnostics& diagnostics) {
  Found found;
  for (const ir::Program& program : file.programs)
    look(program, options.sets, found);
  const stdlib::MacroSet& wanted = options.wanted;
  if (found.first == nullptr) {
    const ir::ProgramStatement* computed = computedCall(file);
    if (computed == nullptr) return true;
    diagnostics.report<diag::CallNotTranslated>(
        computed->origin.range(), wanted.name,
        "which program is called is computed; whether it is a macro of another set is not known");
    return false;
  }
  const bool same = std::any_of(found.fits.begin(), found.fits.end(),
                                [&](const stdlib::MacroSet* set) { return isSame(*set, wanted); });
  if (same && found.mixed == nullptr) return true;
  if (found.fits.size() != 1) {
    const ir::ProgramStatement& at = found.mixed != nullptr ? *found.mixed : *found.first;
    diagnostics.report<diag::CallsOfSeveralSets>(at.origin.range(), wanted.name,
                                                 *knownCall(at, options.sets));
    return false;
  }
  const stdlib::MacroSet& source = *found.fits.front();
  Diagnostics own;
  for (const ir::Program& program : file.programs) {
    const std::uint64_t number = options.number.value_or(static_cast<std::uint32_t>(program.number));
    for (const stdlib::MacroSet* set : {&source, &wanted})
      if (number != 0 && set->calls(static_cast<std::uint32_t>(number)))
        own.report<diag::ProgramNumberTaken>(program.range, number, set->title);
  }
  own.report<diag::CallsTranslated>(found.first->origin.range(), source.title, wanted.title,
                                    setup(wanted, options.control));
  const ir::ProgramFile before = file;
  const std::uint32_t alarm = freeAlarm(file, options.control);
  for (ir::Program& program : file.programs) {
    const TranslateSettings settings{
        source, wanted, options.control, [&program] { return program.addLabel({}); }, alarm, options.written};
    translateResults(program, before, settings, own);
    Calls(program, before, settings, own).run();
  }
  const bool done = !own.hasErrors();
  for (Diagnostic& one : own.all())
    diagnostics.add(std::move(one));
  return done;
}

} // namespace dotek::backends::fanuc
