#include "ir/Flow.h"
#include "lint/Lathe.h"
#include "lint/NcProgram.h"
#include "lint/Turning.h"

#include <algorithm>
#include <set>

namespace dotek::lint::rule {
namespace {

using stdlib::Function;

constexpr double kMost = 20, kMostInches = 1; // a revolution, of a cut

// The word whose code has this function; nullptr: there is none.
const ir::Word* codeOf(const ir::NcBlock& block, const Project& project, Function function, double usual) {
  return project.control != nullptr ? wordOf(block, *project.control, function) : codeWord(block, 'G', usual);
}

void check(const NcProgram& nc, Report& report) {
  const bool lathe = isForLathe(nc.project);
  if (!lathe && lathesOf(nc.project).contains(&nc.file)) return; // its codes mean something else
  const stdlib::Control* const control = nc.project.control;
  std::set<ir::LabelId> targets;
  bool computed = false;
  for (const ir::ProgramStatement& statement : nc.program.body) {
    if (const auto target = ir::targetOf(statement)) targets.insert(*target);
    computed = computed || ir::isComputedJump(statement);
  }
  const ir::Word* mode = nullptr; // nullptr: not certain, or a feed a minute
  bool inch = false, threads = false;
  for (const ir::ProgramStatement& statement : nc.program.body) {
    const auto* label = std::get_if<ir::Label>(&statement.node);
    if (callOf(statement) != nullptr || (label != nullptr && (computed || targets.contains(label->label))))
      mode = nullptr;
    if (ir::endsProgram(statement) || std::holds_alternative<ir::Exit>(statement.node)) mode = nullptr;
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    if (hasCode(*block, 'G', 20)) inch = true;
    if (hasCode(*block, 'G', 21)) inch = false;
    if (codeOf(*block, nc.project, Function::FeedPerMinute, 94) != nullptr) mode = nullptr;
    if (const ir::Word* word = codeOf(*block, nc.project, Function::FeedPerRevolution, 95)) mode = word;
    for (const double code : {0, 1, 2, 3})
      if (hasCode(*block, 'G', code)) threads = false;
    for (const Function one : {Function::Thread, Function::ThreadingCycle, Function::ThreadPasses,
                               Function::CannedCycle, Function::MacroCall})
      threads = threads || (control != nullptr && wordOf(*block, *control, one) != nullptr);
    if (control == nullptr) threads = threads || cycleOf(*block) != 0;
    const ir::Word* const feed = firstWord(*block, "F");
    if (mode == nullptr || threads || feed == nullptr) continue;
    const double* value = ir::constantValue(feed->value);
    // Without a point a control may count a feed in hundredths or less.
    const bool whole = ir::numberWithoutPoint(feed->value) != nullptr;
    if (value == nullptr || *value < (inch ? kMostInches : kMost)) continue;
    if (whole && (control == nullptr || control->decimal == stdlib::DecimalMode::Increment)) continue;
    report
        .at(feed->range,
            "a feed of {} {} a revolution; the tool breaks, or the control stops with an alarm; write the "
            "feed "
            "a revolution, or `{}` before it for one a minute",
            *value, inch ? "inches" : "millimetres", lathe ? "G98" : "G94")
        .note(mode->range, "feeds count revolutions since this block");
    return;
  }
}

} // namespace

DOTEK_LINT_RULE(feed_of_minute){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
