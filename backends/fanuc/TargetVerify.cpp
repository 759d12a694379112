// Cases of verify --to fanuc.
#include "backends/fanuc/TargetVerification.h"
#include "project/MacroCycles.h"

#include "backends/fanuc/TargetAlarms.h"
#include "backends/fanuc/TargetEntry.h"
#include "frontend/gibbs/Ast.h"
#include "project/CycleChecks.h"
#include "sim/machine/Value.h"
#include "sim/vendor/VendorMacros.h"
#include "stdlib/MovedSet.h"
#include "support/Decimal.h"
#include "verify/Exactness.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::targets {

namespace gibbs = frontend::gibbs;

namespace {

// What the program leaves: zeros of the systems in coordinates of the machine, variables.
void traceResults(const verify::Record& record, sim::Trace& trace) {
  for (const auto& [key, value] : record.zeros) {
    trace.begin("zero").text(std::to_string(key.first));
    trace.word(std::string_view("XYZ").substr(key.second, 1), value).end();
  }
  for (const auto& [number, value] : record.stores) {
    trace.begin("variable").text(std::to_string(number));
    if (sim::isNull(value))
      trace.text("null").end();
    else
      trace.word("", value).end();
  }
}

std::uint32_t programNumber(const std::string& text) {
  const std::size_t at = text.find("\nO");
  return at == std::string::npos ? 0 : static_cast<std::uint32_t>(std::atoi(text.c_str() + at + 2));
}

// How a control pads what it prints is a parameter of it, and no difference of the programs.
stdlib::Control paddingAs(const stdlib::Control& source, stdlib::Control control) {
  if (!control.printPadding) control.printPadding = source.printPadding;
  return control;
}

} // namespace

FanucVerification::FanucVerification(const VerificationSource& source)
    : from_(source), translation_(*source.plan.translation),
      control_(paddingAs(*source.inputs.sourceControl, *source.inputs.control)),
      sourceSet_(source.session.macroSet(source.plan.sourceMacros, &*source.inputs.sourceControl)),
      set_(source.session.macroSet(source.plan.targetMacros, &*source.inputs.control)),
      measuring_(project::measuringCycles({set_}, source.session)),
      macrosHaveText_(set_ != nullptr && stdlib::macroText(source.session.data(), set_->name).has_value()),
      stand_(control_,
             set_ == nullptr ? std::vector<const stdlib::MacroSet*>{}
                             : std::vector<const stdlib::MacroSet*>{set_},
             limits_) {
  stand_.passOverAbsent();
}

bool FanucVerification::prepare() {
  Session& session = from_.session;
  // The arguments are in the locals of the caller; one that is null is left out of the call.
  std::string call = fmt::format("O1\nG65P{}", programNumber(translation_.text));
  // In the order of the alphabet: of I, J and K out of it the control reads the second set.
  std::vector<OutputArgument> arguments = translation_.arguments;
  std::sort(arguments.begin(), arguments.end(),
            [](const OutputArgument& a, const OutputArgument& b) { return a.letter < b.letter; });
  for (const OutputArgument& argument : arguments)
    call += fmt::format("{}#{}", argument.letter, stdlib::localOf(argument.letter));
  if (!text_.read("call", call + "\nM30\n", control_, session) ||
      !text_.readTranslation(translation_, control_, session) ||
      (set_ != nullptr && !text_.readMacros(*set_, control_, session)))
    return false;
  text_.compile(control_);
  stand_.watchOnly(text_.safeMoves());
  stored_ = text_.storesOfTranslation();
  std::set<std::uint32_t> numbers;
  for (const auto& [number, line] : stored_)
    numbers.insert(number);
  stand_.watchStores(std::move(numbers));
  return true;
}

TargetRun FanucVerification::run(const TargetCase& now) {
  TargetRun out;
  differing_.reset();
  const verify::Entry entry = entryOf(now);
  const verify::Record record = runText(now, entry, &out.trace);
  if (record.overLimit)
    out.stopped = record.text;
  else if (now.rejected)
    compareRejection(record, now, out);
  else if (now.source == nullptr)
    comparePath(now, record, out);
  else
    compareRecords(now, record, out);
  if (now.questions != nullptr && !now.rejected && out.differences.empty() && out.stopped.empty() &&
      record.ending == verify::Ending::Finished)
    callOtherwise(now, entry, record, out);
  if (now.shown != nullptr)
    *now.shown = {
        runText(now, differing_ ? differing_->second : entry, nullptr, verify::Stand::Way::KeepMoves),
        differing_ ? "called " + differing_->first : ""};
  return out;
}

verify::Entry FanucVerification::entryOf(const TargetCase& now) const {
  verify::Entry entry = now.entry;
  entry.blocks += verify::callerModes(control_, now.stream);
  addArguments(now.drawn, entry);
  presetTools(from_, now.drawn, entry);
  return entry;
}

void FanucVerification::addArguments(const verify::Case& drawn, verify::Entry& entry) const {
  for (const OutputArgument& argument : translation_.arguments) {
    const std::uint32_t local = stdlib::localOf(argument.letter);
    const std::string folded = gibbs::foldCase(argument.name);
    const auto field = std::find_if(drawn.values.begin(), drawn.values.end(),
                                    [&](const auto& one) { return gibbs::foldCase(one.first) == folded; });
    if (field != drawn.values.end())
      entry.variables.emplace_back(local, field->second);
    else if (const auto host = drawn.hosts.find(argument.name); host != drawn.hosts.end())
      entry.variables.emplace_back(local, host->second);
  }
}

verify::Record FanucVerification::runText(const TargetCase& now, const verify::Entry& entry,
                                          std::string* trace, verify::Stand::Way way,
                                          const verify::Interference& interference) {
  if (now.shown != nullptr) ran_ = entry;
  std::optional<sim::VendorMacros> meaning;
  if (set_ != nullptr) {
    meaning.emplace(*set_, control_, measuring_);
    meaning->setStylusRadius(now.drawn.hosts.at("tool_radius"));
    if (sameMacros(sourceSet_, set_)) meaning->passUnstated();
  }
  std::optional<sim::Trace> writer;
  if (from_.options.traces && trace != nullptr) {
    writer.emplace([trace](std::string_view lines) { *trace += lines; });
    const sim::Point3& at = entry.start;
    writer->begin("start").word("X", at.x).word("Y", at.y).word("Z", at.z).end();
  }
  stand_.setTrace(writer ? &*writer : nullptr);
  verify::Record record = stand_.run(text_.code(), now.world, entry, now.stores,
                                     meaning ? &*meaning : nullptr, way, interference);
  if (writer) traceResults(record, *writer);
  // What macros do inside is their own business.
  std::erase_if(record.early, [&](const verify::EarlyUse& use) { return text_.line(use.range) == 0; });
  return record;
}

verify::Record FanucVerification::runIn(sim::World& world, const TargetCase& now,
                                        const verify::Entry& entry) {
  TargetCase there{.drawn = now.drawn, .entry = now.entry, .stores = now.stores, .world = world};
  return runText(there, entry, nullptr);
}

void FanucVerification::add(std::vector<verify::Difference> found, TargetRun& out) const {
  for (verify::Difference& difference : found) {
    const std::uint32_t line = text_.line(difference.target);
    out.differences.push_back({std::move(difference), line, ""});
  }
}

std::string FanucVerification::rejects() const {
  return from_.plan.cycleFile ? "the checks of the cycle reject the values" : "the dialog rejects the values";
}

namespace {

// The value of some parameter is no offset, which the program asks before all that the cycle's own checks and
// those of called cycles ask: which of two alarms comes first is open in the source.
bool asksForOffset(const VerifyPlan& plan, const verify::Case& drawn, std::string_view alarm, double tools) {
  if (!plan.cycleFile) return false;
  return std::any_of(plan.fields.begin(), plan.fields.end(), [&](const verify::DrawField& field) {
    const auto given = drawn.values.find(field.name);
    if (given == drawn.values.end()) return false;
    const double value = given->second;
    if (field.kind == ir::Kind::ToolOffset)
      return alarm.starts_with("TOOL OFFSET NOT") &&
             !(value >= 1 && value <= tools && value == std::floor(value));
    return field.kind == ir::Kind::WorkOffset && field.systemOf(value) == 0 &&
           (alarm.starts_with("WORK OFFSET NOT") || alarm.starts_with("NO SUCH WORK OFFSET"));
  });
}

} // namespace

void FanucVerification::compareRejection(const verify::Record& record, const TargetCase& now,
                                         TargetRun& out) const {
  const std::uint32_t line = text_.line(record.endedAt);
  if (record.ending == verify::Ending::Alarm && record.pieces.empty() && setsSomething(record, now.entry))
    out.differsAt(verify::Aspect::Ending, rejects() + ", and the program sets an offset before its alarm",
                  line);
  else if (record.ending != verify::Ending::Alarm)
    out.differsAt(verify::Aspect::Ending, rejects() + ", and the program runs", line);
  else if (!record.pieces.empty())
    out.differsAt(verify::Aspect::Ending, rejects() + ", and the program moves before its alarm", line);
  else if (!from_.plan.cycleFile && project::isWithoutMessage(now.rejection) &&
           raises(translation_.text, record.text))
    out.refused = true; // the text is the translation's own
  else if (!saysSo(translation_.text, record.text, now.rejection, control_.alarmLength) &&
           !asksForOffset(from_.plan, now.drawn, record.text, control_.variables.toolCount))
    out.differsAt(
        verify::Aspect::Ending,
        from_.plan.cycleFile
            ? fmt::format("{}, `{}`, and the program stops with `{}`", rejects(), now.rejection, record.text)
            : fmt::format("{}; the program stops with `{}`", now.rejection, record.text),
        line);
  else
    out.refused = true;
}

void FanucVerification::comparePath(const TargetCase& now, const verify::Record& record,
                                    TargetRun& out) const {
  if (record.ending != verify::Ending::Finished)
    out.differsAt(verify::Aspect::Ending, "the path ends against an alarm: " + record.text,
                  text_.line(record.endedAt));
  else if (now.path != nullptr)
    add(verify::compare(*now.path, {}, record, from_.options.tolerance), out);
  if (now.path != nullptr) compareReturn(record, nullptr, out);
}

void FanucVerification::compareReturn(const verify::Record& record, const verify::Record* source,
                                      TargetRun& out) const {
  if (record.ending != verify::Ending::Finished) return;
  if (const std::uint32_t line = text_.line(record.lastBlock); line != 0) {
    out.differsAt(verify::Aspect::Ending, "it ends in place of going back to its caller (M99)", line);
    return;
  }
  const std::string why = verify::whyNotPutBack(control_, record, source);
  if (!why.empty()) out.differs(verify::Aspect::Modal, why);
}

verify::CompareRules FanucVerification::rulesFor(const TargetCase& now, const verify::Record& source) const {
  verify::CompareRules rules = programRules(from_, control_, sourceSet_, set_);
  rules.tolerance = from_.plan.computesPlaces ? rules.results : from_.options.tolerance;
  allowForDatums(rules, source, now.entry, control_, macrosHaveText_);
  // Where one control counts in eight digits and the other in fifteen, a computed word may be rounded the
  // other way; where both count in eight, other macros may compute it in another order.
  constexpr double kLastDigits = 5e-5; // mm, of places within 10 m
  const bool others = control_.arithmetic == stdlib::Arithmetic::Decimal8 && !rules.sameAlarmNumbers;
  const double rounding = control_.arithmetic != from_.inputs.sourceControl->arithmetic ? kOtherArithmetic
                          : others                                                      ? kLastDigits
                                                                                        : 0;
  if (from_.plan.computesPlaces && rounding > 0)
    rules.tolerance = rules.results = std::max(rules.results, rounding);
  // Positions that the cycle computes go to the control rounded to its least increment, and contacts on
  // round surfaces follow.
  if (from_.plan.cycleFile) {
    const double rounded = kRoundedWord * std::pow(10, -control_.decimals);
    rules.tolerance = std::max(rules.tolerance, rounded);
    rules.results = std::max(rules.results, rounded);
  }
  allowForRounding(rules, now);
  // Of eight digits the last one is a ten millionth at most; two of them.
  rules.relative = rules.results > from_.options.tolerance ? 2e-7 : 0;
  rules.mayRestoreModes = true;
  const auto hasParts = [](const stdlib::Control& control) {
    return control.variables.toolGeometry && control.variables.toolWear;
  };
  // Which part a call with T changes is the business of its macro.
  const bool sameCalls = sourceSet_ == nullptr || sameMacros(sourceSet_, set_);
  rules.toolParts =
      hasParts(control_) && (from_.plan.cycleFile || (sameCalls && hasParts(*from_.inputs.sourceControl)));
  rules.switchesProbe = from_.options.switchProbe;
  rules.samePlace = [this, &now](SourceRange one, SourceRange other) {
    return translation_.stemsFrom(now.sourceOf(one), text_.line(other), from_.session.sources());
  };
  return rules;
}

verify::CompareRules FanucVerification::rulesElsewhere(const TargetCase& now,
                                                       const verify::Record& source) const {
  verify::CompareRules rules = rulesFor(now, source);
  rules.samePlace = nullptr;
  rules.sourceControl = &*from_.inputs.sourceControl;
  rules.targetControl = control_.name == rules.sourceControl->name ? rules.sourceControl : &control_;
  return rules;
}

// How far another vendor's macro searches is its own business: it may find what the source's does not.
bool FanucVerification::searchesOn(const verify::Record& source, const verify::Record& record,
                                   const verify::CompareRules& rules) const {
  return !sameMacros(sourceSet_, set_) && source.ending == verify::Ending::Alarm &&
         source.alarmKind == stdlib::macroAlarmName(stdlib::MacroAlarm::ProbeFail) &&
         (verify::findsAll(record) || (rules.samePlace && !rules.samePlace(source.endedAt, record.endedAt)));
}

void FanucVerification::compareRecords(const TargetCase& now, const verify::Record& record,
                                       TargetRun& out) const {
  const verify::Record& source = *now.source;
  const verify::CompareRules rules = rulesFor(now, source);
  if (record.ending == verify::Ending::Alarm && record.pieces.empty() &&
      translation_.madeUp(text_.line(record.endedAt))) {
    out.refused = true;
    out.why = record.text;
    return;
  }
  // The text of an alarm of the cycle's own.
  const std::uint32_t line = text_.line(record.endedAt);
  if (from_.plan.cycleFile && source.ending == verify::Ending::Alarm && source.alarmKind.empty() &&
      record.ending == verify::Ending::Alarm && record.alarm >= kOwnAlarms && !translation_.madeUp(line) &&
      !saysSo(translation_.text, record.text, source.text, control_.alarmLength))
    out.differsAt(verify::Aspect::Ending,
                  fmt::format("an alarm (`{}`) against `{}`", source.text, record.text), line);
  // Another vendor's macro may begin where the ball is already in contact: at an edge the travel is that
  // short.
  const bool begins = record.alarmKind == stdlib::macroAlarmName(stdlib::MacroAlarm::ProbeOpen);
  if (!sameMacros(sourceSet_, set_) && now.drawn.edge && begins && source.alarmKind != record.alarmKind) {
    out.undecided = true;
    out.why = "the ball touches where a measure begins: " + record.text;
  } else if (searchesOn(source, record, rules))
    out.undecided = true;
  else
    add(verify::compare(source, record, rules), out);
  const bool ended = source.ending == verify::Ending::Finished && record.ending == verify::Ending::Finished;
  if (!out.undecided && (ended || out.differences.empty())) compareStrays(now, record, out);
  if (!out.undecided && out.differences.empty()) compareReturn(record, &source, out);
}

void FanucVerification::compareStrays(const TargetCase& now, const verify::Record& record,
                                      TargetRun& out) const {
  std::size_t told = 0;
  for (const auto& [number, value] : record.strays) {
    if (now.stores.contains(number) || translation_.handedBack.contains(number)) continue;
    out.differsAt(verify::Aspect::Variable,
                  fmt::format("#{}: the source does not write it, the translation leaves {}", number,
                              sim::isNull(value)      ? "it null"
                              : sim::isUnknown(value) ? "a value that is not known"
                                                      : "it at " + numberText(value)),
                  stored_.at(number));
    out.differences.back().difference.subject = fmt::format("#{}", number);
    if (++told == verify::kMostOfAspect) return;
  }
}

std::unique_ptr<Verification> fanucVerification(const VerificationSource& source) {
  return std::make_unique<FanucVerification>(source);
}

} // namespace dotek::targets
