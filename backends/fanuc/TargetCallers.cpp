// Callers who break what a program demands, or have something else in force.
#include "backends/fanuc/TargetVerification.h"

#include "backends/fanuc/TargetAlarms.h"
#include "backends/fanuc/TargetHeader.h"
#include "frontend/gibbs/Ast.h"
#include "sim/machine/Value.h"
#include "support/Decimal.h"
#include "targets/MissedTouches.h"
#include "targets/OffParts.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace dotek::targets {

namespace gibbs = frontend::gibbs;

bool FanucVerification::setsSomething(const verify::Record& record, const verify::Entry& entry) {
  for (std::uint32_t system = 0; system < entry.zeros.size(); ++system) {
    const double before[] = {entry.zeros[system].x, entry.zeros[system].y, entry.zeros[system].z};
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      if (const auto zero = record.zeros.find({54 + system, axis});
          zero != record.zeros.end() && zero->second != before[axis])
        return true;
  }
  return !record.tools.empty();
}

bool FanucVerification::stopsAtOnce(const verify::Record& record, const verify::Entry& entry,
                                    std::string_view text) const {
  if (record.ending != verify::Ending::Alarm || record.alarm < kOwnAlarms || !record.pieces.empty() ||
      setsSomething(record, entry))
    return false;
  return text.empty() || verify::showsAlarm(record.text, text, control_.alarmLength);
}

std::string FanucVerification::didInstead(const verify::Record& record) {
  switch (record.ending) {
  case verify::Ending::Finished: return "it runs to its end";
  case verify::Ending::Inconclusive: return "what it does is not known: " + record.text;
  case verify::Ending::Alarm: break;
  }
  return fmt::format("it {}stops with `{}`", record.pieces.empty() ? "" : "moves, then ", record.text);
}

void FanucVerification::differs(const std::string& who, const std::string& wanted,
                                const verify::Record& record, TargetRun& out) {
  out.differsAt(verify::Aspect::Ending, fmt::format("called {}: {}; {}", who, wanted, didInstead(record)),
                text_.line(record.endedAt));
  noteCaller(who);
}

void FanucVerification::noteCaller(const std::string& who) {
  if (!differing_ && ran_) differing_ = {who, *ran_};
}

void FanucVerification::callOtherwise(const TargetCase& now, const verify::Entry& entry,
                                      const verify::Record& ran, TargetRun& out) {
  if (const std::string why = whyListsOther(translation_.text); !why.empty())
    out.differs(verify::Aspect::Ending, why);
  if (const std::string why = whyHeaderDiffers(translation_.converted, translation_.text); !why.empty())
    out.differs(verify::Aspect::Variable, why);
  const bool writesZ = ran.ownOffsets[2] && (now.source == nullptr || !now.source->ownOffsets[2]);
  for (const verify::BrokenCaller& caller : verify::brokenCallers(control_, writesZ, fixedStarts())) {
    if (caller.ofToolLength && loadsTool(now)) continue;
    verify::Entry broken = entry;
    broken.start = entry.start + caller.away;
    broken.blocks = caller.blocks;
    broken.modal = caller.modal;
    const verify::Record record = runText(now, broken, nullptr);
    if (!stopsAtOnce(record, broken, caller.alarm))
      differs(caller.who, fmt::format("`{}` has to stop it before anything moves", caller.alarm), record,
              out);
  }
  callFromOthers(now, entry, out);
  callWithExternal(now, entry, out);
  add(compareMissed(
          now, ran,
          [&](const verify::Interference& none) {
            return runText(now, entry, nullptr, verify::Stand::Way::Run, none);
          },
          [&](const verify::Record& source) { return rulesFor(now, source); }, comparesExactly()),
      out);
  if (out.differences.empty() && now.source != nullptr)
    add(compareOffParts(now,
                        {rulesFor(now, *now.source).overtravel,
                         comparesExactly() && sameMacros(sourceSet_, set_), takesTies()},
                        [&](const verify::Record& meant, sim::World& world) {
                          return verify::compare(meant, runIn(world, now, entry), rulesFor(now, meant));
                        }),
        out);
  for (const OutputArgument& argument : translation_.arguments)
    if (!now.questions->maySkip(argument.name)) callWithout(argument, now, entry, out);
  for (const OutputArgument& argument : translation_.arguments)
    callWithNoOffset(argument, now, entry, out);
  for (const verify::DrawField& field : from_.plan.fields)
    if (field.kind == ir::Kind::WorkOffset && !field.fixed) callWithSystems(field, now, entry, out);
  for (const verify::DrawField& field : from_.plan.fields)
    if (!field.fixed) callBesideList(field, now, entry, out);
  for (const verify::DrawField& field : from_.plan.fields)
    if (from_.plan.cycleFile && field.kind == ir::Kind::ToolOffset && !field.fixed)
      callWithTools(field, now, entry, out);
}

void FanucVerification::callFromOthers(const TargetCase& now, const verify::Entry& entry, TargetRun& out) {
  if (now.posted == nullptr || now.source == nullptr) return;
  const stdlib::Control& posts = *from_.inputs.sourceControl;
  std::optional<verify::Record> keeps;
  const auto usual = [&](const verify::Entry& other) -> const verify::Record& {
    return usualRun(now, other, keeps);
  };
  for (verify::OtherCaller& other : verify::otherCallers(*now.posted, posts, now.entry, now.stream)) {
    const SourceQuestions::Ran meant = now.questions->from(other.entry);
    if (meant.answer != SourceQuestions::Answer::Runs) continue;
    const verify::CompareRules rules = rulesFor(now, meant.record);
    verify::CompareRules ofSource = rules;
    ofSource.samePlace = nullptr;
    if (!verify::runsAlike(usual(other.entry), meant.record, ofSource)) continue;
    other.entry.blocks = entry.blocks;
    other.entry.variables = entry.variables;
    const verify::Record record = runText(now, other.entry, nullptr);
    std::vector<verify::Difference> found = verify::compare(meant.record, record, rules);
    for (verify::Difference& one : found)
      one.text = fmt::format("called {}: {}", other.who, one.text);
    const bool alike = found.empty();
    if (!alike) noteCaller(other.who);
    add(std::move(found), out);
    if (!alike) return;
    if (record.ending != verify::Ending::Finished) continue;
    const std::string why = verify::whyNotPutBack(control_, record, &meant.record);
    if (why.empty()) continue;
    noteCaller(other.who);
    out.differs(verify::Aspect::Modal, why);
  }
}

std::map<char, double> FanucVerification::fixedStarts() const {
  std::map<char, double> out;
  if (from_.plan.cycleFile) return out; // it has no such input
  for (const char axis : {'x', 'y', 'z'})
    if (const auto at = from_.inputs.hosts.find(std::string("start_") + axis); at != from_.inputs.hosts.end())
      out.emplace(static_cast<char>(std::toupper(axis)), at->second);
  return out;
}

void FanucVerification::callWithExternal(const TargetCase& now, const verify::Entry& entry, TargetRun& out) {
  if (now.source == nullptr) return;
  const std::optional<verify::Entry> one = verify::withExternalOffset(*from_.inputs.sourceControl, now.entry);
  const std::optional<verify::Entry> other = verify::withExternalOffset(control_, entry);
  if (!one || !other) return;
  const SourceQuestions::Ran meant = now.questions->from(*one);
  SourceRange at;
  if (meant.answer != SourceQuestions::Answer::Runs || !verify::whyNoEvidence(meant.record, at).empty())
    return;
  const std::string who = "with an external offset in force";
  std::vector<verify::Difference> found =
      verify::compare(meant.record, runText(now, *other, nullptr), rulesFor(now, meant.record));
  if (found.empty()) return;
  for (verify::Difference& difference : found)
    difference.text = fmt::format("called {}: {}", who, difference.text);
  noteCaller(who);
  add(std::move(found), out);
}

bool FanucVerification::comparesExactly() const {
  return control_.arithmetic == stdlib::Arithmetic::Decimal8 &&
         from_.inputs.sourceControl->arithmetic == stdlib::Arithmetic::Decimal8;
}

bool FanucVerification::loadsTool(const TargetCase& now) const {
  return now.posted != nullptr &&
         verify::hasCode(*now.posted, *from_.inputs.sourceControl, stdlib::Function::ToolLengthPlus);
}

} // namespace dotek::targets
