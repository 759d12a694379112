// The stage on which both sides of a case run.
#pragma once

#include "ir/Program.h"
#include "stdlib/Control.h"
#include "targets/Subject.h"
#include "targets/Verification.h"

namespace dotek::targets {

// Both sides call macros of the same name, or none. One control may have them with other variables.
bool sameMacros(const stdlib::MacroSet* one, const stdlib::MacroSet* other);

// A calibrated probe with the ball of the case, as exact as its signal; off.
sim::Probe probeFor(const VerifyPlan& plan, const verify::Case& drawn);
// The same for the same values and host inputs: what is drawn of the caller by it comes again in a replay.
std::uint64_t callerStream(const verify::Case& drawn);
verify::Entry entryFor(const verify::Case& drawn, bool probeOn);
// The first block of the program with an M code of this function.
std::optional<SourceRange> blockWith(const ir::Program& program, const stdlib::Control& control,
                                     stdlib::Function function);
// Nothing that a probe could meet.
sim::Part emptyPart(const sim::Point3& middle);
// A run that was recorded with its moves, in the part that it met. `empty`: there is none to be seen.
sim::Picture pictureOf(const verify::Record& record, const sim::Part& part, const sim::Probe& probe,
                       bool empty);
// Both runs of a case, in one part.
CasePictures picturesOf(const verify::Record& source, const ShownRun& translation, const sim::Part& part,
                        const sim::Probe& probe, bool empty);
// "Fanuc 0i-MD, machining centre (fanuc-0i-md)", with where the profile is from unless it is Dotek's own.
std::string controlText(const stdlib::Control& control);
// Those of the run of a translated cycle: one that goes round for ever ends soon, unless `--limit sim-steps`
// says how long it may take.
Limits limitsOfRun(const Limits& limits);
// How far a search goes beyond a surface, mm.
inline constexpr double kReach = 12;
// What is compared of two programs of macro B, the target's on `control`: its waits, its alarms, results of
// macros of two sets (nullptr: none).
verify::CompareRules programRules(const VerificationSource& from, const stdlib::Control& control,
                                  const stdlib::MacroSet* sourceSet, const stdlib::MacroSet* set);
// Words of one side are rounded where those of the other are not (TargetCase::rounding).
void allowForRounding(verify::CompareRules& rules, const TargetCase& now);
// `rules` for a run of the source from `entry`: what follows a write of the active system is as exact as the
// control computes it. `byText`: the target's macros run by their text on `control`.
void allowForDatums(verify::CompareRules& rules, const verify::Record& source, const verify::Entry& entry,
                    const stdlib::Control& control, bool byText);
// What results may differ by where one of the controls computes with eight digits, mm.
double resultTolerance(const stdlib::Control& one, const stdlib::Control& other);

} // namespace dotek::targets
