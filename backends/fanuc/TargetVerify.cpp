// Cases of verify --to fanuc.
#include "backends/fanuc/TargetVerify.h"

#include "backends/fanuc/TargetAlarms.h"
#include "backends/fanuc/TargetEntry.h"
#include "backends/fanuc/TargetText.h"
#include "frontend/gibbs/Ast.h"
#include "sim/machine/Value.h"
#include "sim/machine/VendorMacros.h"
#include "support/Decimal.h"
#include "targets/MissedTouches.h"
#include "targets/Stage.h"
#include "verify/Bounds.h"
#include "verify/Callers.h"
#include "verify/Exactness.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <set>

namespace dotek::targets {

namespace gibbs = frontend::gibbs;

namespace {

constexpr std::uint32_t kOwnAlarms = 3000; // of programs

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

// The zero of the system in which the case begins is another one at the end.
bool writesActive(const verify::Record& record, const verify::Entry& entry) {
  const sim::Point3& zero = entry.zeros[entry.system - 54];
  const double before[] = {zero.x, zero.y, zero.z};
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const auto after = record.zeros.find({entry.system, axis});
    if (after != record.zeros.end() && after->second != before[axis]) return true;
  }
  return false;
}

std::uint32_t programNumber(const std::string& text) {
  const std::size_t at = text.find("\nO");
  return at == std::string::npos ? 0 : static_cast<std::uint32_t>(std::atoi(text.c_str() + at + 2));
}

class FanucVerification final : public Verification {
public:
  explicit FanucVerification(const VerificationSource& source)
      : from_(source), translation_(*source.plan.translation), control_(*source.inputs.control),
        sourceSet_(source.session.macroSet(source.plan.sourceMacros)),
        set_(source.session.macroSet(source.plan.targetMacros)),
        stand_(control_,
               set_ == nullptr ? std::vector<const stdlib::MacroSet*>{}
                               : std::vector<const stdlib::MacroSet*>{set_},
               limits_) {}

  bool prepare() override {
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
    return true;
  }

  TargetRun run(const TargetCase& now) override {
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

private:
  verify::Entry entryOf(const TargetCase& now) const {
    verify::Entry entry = now.entry;
    entry.blocks = verify::callerModes(control_, now.stream);
    addArguments(now.drawn, entry);
    presetWear(from_, now.drawn, entry);
    return entry;
  }

  void addArguments(const verify::Case& drawn, verify::Entry& entry) const {
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

  // `trace`: nullptr: nobody reads it.
  verify::Record runText(const TargetCase& now, const verify::Entry& entry, std::string* trace,
                         verify::Stand::Way way = verify::Stand::Way::Run,
                         const verify::Interference& interference = {}) {
    if (now.shown != nullptr) ran_ = entry;
    std::optional<sim::VendorMacros> meaning;
    if (set_ != nullptr) {
      meaning.emplace(*set_, control_);
      meaning->setStylusRadius(now.drawn.hosts.at("tool_radius"));
      if (sourceSet_ == set_) meaning->passUnstated();
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

  void add(std::vector<verify::Difference> found, TargetRun& out) const {
    for (verify::Difference& difference : found) {
      const std::uint32_t line = text_.line(difference.target);
      out.differences.push_back({std::move(difference), line, ""});
    }
  }

  std::string rejects() const {
    return from_.plan.cycleFile ? "the checks of the cycle reject the values"
                                : "the dialog rejects the values";
  }

  // The dialog has rejected the values: the translation raises an alarm, and nothing has moved.
  void compareRejection(const verify::Record& record, const TargetCase& now, TargetRun& out) const {
    const std::uint32_t line = text_.line(record.endedAt);
    if (record.ending == verify::Ending::Alarm && record.pieces.empty() && setsSomething(record, now.entry))
      out.differsAt(verify::Aspect::Ending, rejects() + ", and the program sets an offset before its alarm",
                    line);
    else if (record.ending != verify::Ending::Alarm)
      out.differsAt(verify::Aspect::Ending, rejects() + ", and the program runs", line);
    else if (!record.pieces.empty())
      out.differsAt(verify::Aspect::Ending, rejects() + ", and the program moves before its alarm", line);
    else if (!saysSo(translation_.text, record.text, now.rejection))
      out.differsAt(verify::Aspect::Ending,
                    from_.plan.cycleFile
                        ? fmt::format("{}, `{}`, and the program stops with `{}`", rejects(), now.rejection,
                                      record.text)
                        : fmt::format("{}; the program stops with `{}`", now.rejection, record.text),
                    line);
    else
      out.refused = true;
  }

  // Without a Prog: the path and the touches alone.
  void comparePath(const TargetCase& now, const verify::Record& record, TargetRun& out) const {
    if (record.ending != verify::Ending::Finished)
      out.differsAt(verify::Aspect::Ending, "the path ends against an alarm: " + record.text,
                    text_.line(record.endedAt));
    else if (now.path != nullptr)
      add(verify::compare(*now.path, {}, record, from_.options.tolerance), out);
    if (now.path != nullptr) compareReturn(record, nullptr, out);
  }

  // It goes back to its caller and leaves him what he had in force.
  void compareReturn(const verify::Record& record, const verify::Record* source, TargetRun& out) const {
    if (record.ending != verify::Ending::Finished) return;
    if (const std::uint32_t line = text_.line(record.lastBlock); line != 0) {
      out.differsAt(verify::Aspect::Ending, "it ends in place of going back to its caller (M99)", line);
      return;
    }
    const std::string why = verify::whyNotPutBack(control_, record, source);
    if (!why.empty()) out.differs(verify::Aspect::Modal, why);
  }

  verify::CompareRules rulesFor(const TargetCase& now, const verify::Record& source) const {
    verify::CompareRules rules;
    rules.results = std::max(from_.options.tolerance, resultTolerance(control_, *from_.inputs.sourceControl));
    if (sourceSet_ != set_) rules.results = std::max(rules.results, verify::kGridSteps);
    // After a write of the system that is active, what follows is as exactly as the control computes.
    const bool computed = from_.plan.computesPlaces || writesActive(source, now.entry);
    rules.tolerance = computed ? rules.results : from_.options.tolerance;
    // Positions that the cycle computes go to the control rounded to its least increment, and contacts on
    // round surfaces follow.
    if (from_.plan.cycleFile) {
      const double rounded = kRoundedWord * std::pow(10, -control_.decimals);
      rules.tolerance = std::max(rules.tolerance, rounded);
      rules.results = std::max(rules.results, rounded);
    }
    // Of eight digits the last one is a ten millionth at most; two of them.
    rules.relative = rules.results > from_.options.tolerance ? 2e-7 : 0;
    rules.mayRestoreModes = true;
    rules.switchesProbe = from_.options.switchProbe;
    rules.sameAlarmNumbers = sourceSet_ == set_;
    const stdlib::CodeInfo* const wait = control_.find(stdlib::Function::MachineCoordinates);
    rules.waits = wait != nullptr && wait->grade != "assumed";
    rules.samePlace = [this, &now](SourceRange one, SourceRange other) {
      return translation_.stemsFrom(now.sourceOf(one), text_.line(other), from_.session.sources());
    };
    return rules;
  }

  void compareRecords(const TargetCase& now, const verify::Record& record, TargetRun& out) const {
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
        !saysSo(translation_.text, record.text, source.text))
      out.differsAt(verify::Aspect::Ending,
                    fmt::format("an alarm (`{}`) against `{}`", source.text, record.text), line);
    // How far another vendor's macro searches is its own business: it may find what the source's does not.
    const bool searches = source.ending == verify::Ending::Alarm &&
                          source.alarmKind == stdlib::macroAlarmName(stdlib::MacroAlarm::ProbeFail);
    // So is whether it begins where the ball is already in contact: at an edge the travel is that short.
    const bool begins = record.alarmKind == stdlib::macroAlarmName(stdlib::MacroAlarm::ProbeOpen);
    if (sourceSet_ != set_ && now.drawn.edge && begins && source.alarmKind != record.alarmKind) {
      out.undecided = true;
      out.why = "the ball touches where a measure begins: " + record.text;
    } else if (sourceSet_ != set_ && searches &&
               (verify::findsAll(record) || !rules.samePlace(source.endedAt, record.endedAt)))
      out.undecided = true;
    else
      add(verify::compare(source, record, rules), out);
    if (!out.undecided && out.differences.empty()) compareReturn(record, &source, out);
  }

  // ---- callers who break what it demands

  static bool setsSomething(const verify::Record& record, const verify::Entry& entry) {
    for (std::uint32_t system = 0; system < entry.zeros.size(); ++system) {
      const double before[] = {entry.zeros[system].x, entry.zeros[system].y, entry.zeros[system].z};
      for (std::uint32_t axis = 0; axis < 3; ++axis)
        if (const auto zero = record.zeros.find({54 + system, axis});
            zero != record.zeros.end() && zero->second != before[axis])
          return true;
    }
    return !record.tools.empty();
  }

  // An alarm before anything moves or is set; `text`: which one, as far as the control shows it; "": any.
  static bool stopsAtOnce(const verify::Record& record, const verify::Entry& entry, std::string_view text) {
    if (record.ending != verify::Ending::Alarm || record.alarm < kOwnAlarms || !record.pieces.empty() ||
        setsSomething(record, entry))
      return false;
    return text.empty() || (!record.text.empty() && text.starts_with(record.text));
  }

  static std::string didInstead(const verify::Record& record) {
    switch (record.ending) {
    case verify::Ending::Finished: return "it runs to its end";
    case verify::Ending::Inconclusive: return "what it does is not known: " + record.text;
    case verify::Ending::Alarm: break;
    }
    return fmt::format("it {}stops with `{}`", record.pieces.empty() ? "" : "moves, then ", record.text);
  }

  void differs(const std::string& who, const std::string& wanted, const verify::Record& record,
               TargetRun& out) {
    out.differsAt(verify::Aspect::Ending, fmt::format("called {}: {}; {}", who, wanted, didInstead(record)),
                  text_.line(record.endedAt));
    noteCaller(who);
  }

  // The first caller who sees a difference, of the last run.
  void noteCaller(const std::string& who) {
    if (!differing_ && ran_) differing_ = {who, *ran_};
  }

  void callOtherwise(const TargetCase& now, const verify::Entry& entry, const verify::Record& ran,
                     TargetRun& out) {
    if (const std::string why = whyListsOther(translation_.text); !why.empty())
      out.differs(verify::Aspect::Ending, why);
    const bool writesZ = ran.ownOffsetOfZ && (now.source == nullptr || !now.source->ownOffsetOfZ);
    for (const verify::BrokenCaller& caller : verify::brokenCallers(control_, writesZ)) {
      if (caller.ofToolLength && loadsTool(now)) continue;
      verify::Entry broken = entry;
      broken.blocks = caller.blocks;
      broken.modal = caller.modal;
      const verify::Record record = runText(now, broken, nullptr);
      // A shift moves the start as well, where that is fixed.
      if (!caller.blocks.empty() && stopsAtOnce(record, broken, "") &&
          record.text.starts_with("START NOT AT"))
        continue;
      if (!stopsAtOnce(record, broken, caller.alarm))
        differs(caller.who, fmt::format("`{}` has to stop it before anything moves", caller.alarm), record,
                out);
    }
    callFromOthers(now, entry, out);
    add(compareMissed(
            now, ran,
            [&](const verify::Interference& none) {
              return runText(now, entry, nullptr, verify::Stand::Way::Run, none);
            },
            [&](const verify::Record& source) { return rulesFor(now, source); }, comparesExactly()),
        out);
    for (const OutputArgument& argument : translation_.arguments)
      if (!now.questions->maySkip(argument.name)) callWithout(argument, now, entry, out);
    for (const verify::DrawField& field : from_.plan.fields)
      if (field.kind == ir::Kind::WorkOffset && !field.fixed) callWithSystems(field, now, entry, out);
  }

  // From the same place, with another work system or tool length in force than the source selects.
  void callFromOthers(const TargetCase& now, const verify::Entry& entry, TargetRun& out) {
    if (now.posted == nullptr || now.source == nullptr) return;
    const stdlib::Control& posts = *from_.inputs.sourceControl;
    for (verify::OtherCaller& other : verify::otherCallers(*now.posted, posts, now.entry, now.stream)) {
      const SourceQuestions::Ran meant = now.questions->from(other.entry);
      if (meant.answer != SourceQuestions::Answer::Runs) continue;
      verify::CompareRules rules = rulesFor(now, meant.record);
      rules.samePlace = nullptr;
      if (!verify::runsAlike(*now.source, meant.record, rules)) continue;
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

  bool comparesExactly() const {
    return control_.arithmetic == stdlib::Arithmetic::Decimal8 &&
           from_.inputs.sourceControl->arithmetic == stdlib::Arithmetic::Decimal8;
  }

  bool loadsTool(const TargetCase& now) const {
    return now.posted != nullptr &&
           verify::hasCode(*now.posted, *from_.inputs.sourceControl, stdlib::Function::ToolLengthPlus);
  }

  const verify::DrawField* fieldOf(const std::string& name) const {
    const std::string folded = gibbs::foldCase(name);
    const auto found =
        std::find_if(from_.plan.fields.begin(), from_.plan.fields.end(),
                     [&](const verify::DrawField& one) { return gibbs::foldCase(one.name) == folded; });
    return found == from_.plan.fields.end() ? nullptr : &*found;
  }

  std::optional<double> defaultOf(const verify::DrawField& field) const {
    for (const auto& [name, text] : from_.options.defaults)
      if (gibbs::foldCase(name) == gibbs::foldCase(field.name)) return parseNumber(text);
    return field.initial;
  }

  // Where the argument is left out: an alarm if it moves something, else the default.
  void callWithout(const OutputArgument& argument, const TargetCase& now, const verify::Entry& entry,
                   TargetRun& out) {
    const std::uint32_t local = stdlib::localOf(argument.letter);
    verify::Entry without = entry;
    std::erase_if(without.variables, [&](const auto& one) { return one.first == local; });
    const verify::Record record = runText(now, without, nullptr);
    const std::string who = fmt::format("without {} ({})", argument.letter, argument.name);
    const std::string alarm = fmt::format("ARGUMENT {} MISSING", argument.letter);
    if (stopsAtOnce(record, without, alarm)) {
      const std::string_view listed = listedDefault(translation_.text, argument.letter);
      if (!listed.empty() && listed != "GIVE")
        differs(who, fmt::format("its default of {} has to be taken", listed), record, out);
      else if (!listed.empty() || !from_.options.useDefaults)
        return;
      const verify::DrawField* const field = fieldOf(argument.name);
      if (field == nullptr || !defaultOf(*field)) return;
      const SourceQuestions::Ran meant = now.questions->with(field->name, *defaultOf(*field));
      if (meant.answer == SourceQuestions::Answer::Runs)
        differs(who, "its default has to be taken", record, out);
      return;
    }
    const std::string wanted = fmt::format("`{}` has to stop it before anything moves", alarm);
    const verify::DrawField* const field = fieldOf(argument.name);
    const std::optional<double> value = field == nullptr ? std::nullopt : defaultOf(*field);
    if (field != nullptr && !from_.options.useDefaults && now.questions->moves(field->name)) {
      differs(who, wanted, record, out);
      return;
    }
    // A parameter without a default that only feeds a check changes nothing where it is left out and the
    // checks can be decided without it.
    if (!value && now.questions->rejectsSome(field == nullptr ? argument.name : field->name)) {
      differs(who, wanted, record, out);
      return;
    }
    SourceQuestions::Ran meant;
    if (value)
      meant = now.questions->with(field->name, *value);
    else if (now.source != nullptr)
      meant = {SourceQuestions::Answer::Runs, *now.source};
    if (meant.answer == SourceQuestions::Answer::None) return;
    if (meant.answer == SourceQuestions::Answer::Rejected) {
      if (!stopsAtOnce(record, without, ""))
        differs(who, "an alarm has to stop it before anything moves", record, out);
      return;
    }
    // Its places are those of another posted text.
    verify::CompareRules rules = rulesFor(now, meant.record);
    rules.samePlace = nullptr;
    std::vector<verify::Difference> found = verify::compare(meant.record, record, rules);
    for (verify::Difference& one : found)
      one.text =
          value ? fmt::format("called {}, for which {} is the default: {}", who, numberText(*value), one.text)
                : fmt::format("called {}: {}", who, one.text);
    const bool alike = found.empty();
    if (!alike) noteCaller(who);
    add(std::move(found), out);
    if (!value) return;
    if (alike) compareDefault(argument, *value, without, record, now, out);
    callAtBounds(argument, *field, *value, now, entry, out);
  }

  // A tolerance may let both pass: what the program counts with is the same as with the default given. One
  // that is left out and stays null has no default to be another one.
  void compareDefault(const OutputArgument& argument, double value, const verify::Entry& without,
                      const verify::Record& ran, const TargetCase& now, TargetRun& out) {
    const std::uint32_t local = stdlib::localOf(argument.letter);
    if (local >= ran.locals.size() || sim::isNull(ran.locals[local]) || sim::isUnknown(ran.locals[local]))
      return;
    verify::Entry with = without;
    with.variables.emplace_back(local, value);
    const verify::Record meant = runText(now, with, nullptr);
    if (local >= meant.locals.size() || sim::isNull(meant.locals[local]) ||
        sim::isUnknown(meant.locals[local]) ||
        std::abs(meant.locals[local] - ran.locals[local]) <= from_.options.tolerance)
      return;
    const std::string who = fmt::format("without {} ({})", argument.letter, argument.name);
    out.differs(verify::Aspect::Variable,
                fmt::format("called {}, for which {} is the default: it counts with {}", who,
                            numberText(value), numberText(ran.locals[local])));
    noteCaller(who);
  }

  // Where a check that reads the argument turns, and a step beside it: it does the same with the default
  // given.
  void callAtBounds(const OutputArgument& argument, const verify::DrawField& field, double value,
                    const TargetCase& now, const verify::Entry& entry, TargetRun& out) {
    if (from_.plan.bounds == nullptr || atBounds_.contains(argument.letter)) return;
    const verify::Bounds& bounds = *from_.plan.bounds;
    verify::Case given = now.drawn;
    given.values[field.name] = value;
    std::vector<verify::DrawField> alone = from_.plan.fields, others = from_.plan.fields;
    for (std::size_t i = 0; i < others.size(); ++i)
      (others[i].name == field.name ? others : alone)[i].fixed = value;
    std::set<std::size_t> ofField;
    for (const verify::Bound& bound : bounds.find(alone, {given}, true, UINT64_MAX))
      ofField.insert(bound.comparison);
    for (const verify::Bound& bound : bounds.find(others, {given}, true, UINT64_MAX)) {
      const auto met = ofField.contains(bound.comparison) ? bounds.meet(bound, others, given, true)
                                                          : std::optional<verify::Case>();
      for (const int steps : {-1, 0, 1}) {
        if (!met) break;
        atBounds_.insert(argument.letter);
        verify::Case beside = *met;
        const verify::DrawField& moved = others[bound.field];
        beside.values[moved.name] += steps * std::pow(10.0, -moved.decimals);
        verify::Entry with = now.entry;
        with.blocks = entry.blocks;
        addArguments(beside, with);
        verify::Entry without = with;
        std::erase_if(without.variables,
                      [&](const auto& one) { return one.first == stdlib::localOf(argument.letter); });
        const verify::Record meant = runText(now, with, nullptr), ran = runText(now, without, nullptr);
        if (meant.ending == ran.ending && meant.alarm == ran.alarm && meant.text == ran.text) continue;
        out.differsAt(verify::Aspect::Ending,
                      fmt::format("called with {} {}: with {} {}, its default, it {}; without {} it {}",
                                  moved.name, numberText(beside.values[moved.name]), argument.letter,
                                  numberText(value), endingOf(meant), argument.letter, endingOf(ran)),
                      text_.line(ran.endedAt));
        return;
      }
    }
  }

  static std::string endingOf(const verify::Record& record) {
    return record.ending == verify::Ending::Finished ? "runs to its end"
                                                     : fmt::format("stops with `{}`", record.text);
  }

  // Beside the six work systems, and between two of them.
  void callWithSystems(const verify::DrawField& field, const TargetCase& now, const verify::Entry& entry,
                       TargetRun& out) {
    const auto argument =
        std::find_if(translation_.arguments.begin(), translation_.arguments.end(), [&](const auto& one) {
          return gibbs::foldCase(one.name) == gibbs::foldCase(field.name);
        });
    const auto drawn = now.drawn.values.find(field.name);
    if (argument == translation_.arguments.end() || drawn == now.drawn.values.end()) return;
    const double first = field.firstSystem;
    if (field.systemOf(drawn->second) == 0) return;
    callWithActive(field, argument->letter, now, entry, out);
    for (const double value : {first - 1, first + 6, first + 0.5}) {
      const SourceQuestions::Ran meant = now.questions->with(field.name, value);
      // What the source takes is no fault of the translation.
      if (meant.answer == SourceQuestions::Answer::Runs && meant.record.ending == verify::Ending::Finished)
        continue;
      verify::Entry other = entry;
      const std::uint32_t local = stdlib::localOf(argument->letter);
      std::erase_if(other.variables, [&](const auto& one) { return one.first == local; });
      other.variables.emplace_back(local, value);
      const verify::Record record = runText(now, other, nullptr);
      if (!stopsAtOnce(record, other, ""))
        differs(fmt::format("with {} {}", argument->letter, numberText(value)),
                "an alarm has to stop it before anything moves, it is no work offset", record, out);
    }
  }

  // The system that is in force: what comes after is moved by what was set.
  void callWithActive(const verify::DrawField& field, char letter, const TargetCase& now,
                      const verify::Entry& entry, TargetRun& out) {
    const double value = field.firstSystem + (now.entry.system - 54.0);
    const SourceQuestions::Ran meant = now.questions->with(field.name, value);
    if (meant.answer != SourceQuestions::Answer::Runs) return;
    verify::Entry other = entry;
    const std::uint32_t local = stdlib::localOf(letter);
    std::erase_if(other.variables, [&](const auto& one) { return one.first == local; });
    other.variables.emplace_back(local, value);
    const verify::Record record = runText(now, other, nullptr);
    if (record.ending == verify::Ending::Alarm && translation_.madeUp(text_.line(record.endedAt))) return;
    verify::CompareRules rules = rulesFor(now, meant.record);
    rules.samePlace = nullptr;
    std::vector<verify::Difference> found = verify::compare(meant.record, record, rules);
    const std::string who = fmt::format("with {} {}, the system in force", letter, numberText(value));
    for (verify::Difference& one : found)
      one.text = fmt::format("called {}: {}", who, one.text);
    if (!found.empty()) noteCaller(who);
    add(std::move(found), out);
  }

  const VerificationSource from_;
  const Translation& translation_;
  const stdlib::Control& control_;
  const stdlib::MacroSet *sourceSet_, *set_;
  const Limits limits_ = limitsOfRun(from_.session.limits());
  verify::Stand stand_;
  FanucText text_;
  // For a picture: what ran last, and the caller of the first difference.
  std::optional<verify::Entry> ran_;
  std::optional<std::pair<std::string, verify::Entry>> differing_;
  std::set<char> atBounds_; // letters of arguments whose defaults were looked at where checks turn
};

} // namespace

std::unique_ptr<Verification> fanucVerification(const VerificationSource& source) {
  return std::make_unique<FanucVerification>(source);
}

} // namespace dotek::targets
