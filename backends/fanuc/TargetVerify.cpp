// Cases of verify --to fanuc.
#include "backends/fanuc/TargetVerify.h"

#include "backends/fanuc/TargetText.h"
#include "frontend/gibbs/Ast.h"
#include "sim/machine/Value.h"
#include "sim/machine/VendorMacros.h"
#include "targets/Stage.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>

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
    for (const OutputArgument& argument : translation_.arguments)
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
    const verify::Record record = runText(now, out.trace);
    if (record.overLimit)
      out.stopped = record.text;
    else if (now.rejected)
      compareRejection(record, out);
    else if (now.source == nullptr)
      comparePath(now, record, out);
    else
      compareRecords(now, record, out);
    return out;
  }

private:
  verify::Record runText(const TargetCase& now, std::string& trace) {
    verify::Entry entry = now.entry;
    for (const OutputArgument& argument : translation_.arguments) {
      const std::uint32_t local = stdlib::localOf(argument.letter);
      const std::string folded = gibbs::foldCase(argument.name);
      const auto field = std::find_if(now.drawn.values.begin(), now.drawn.values.end(),
                                      [&](const auto& one) { return gibbs::foldCase(one.first) == folded; });
      if (field != now.drawn.values.end())
        entry.variables.emplace_back(local, field->second);
      else if (const auto host = now.drawn.hosts.find(argument.name); host != now.drawn.hosts.end())
        entry.variables.emplace_back(local, host->second);
    }
    std::optional<sim::VendorMacros> meaning;
    if (set_ != nullptr) {
      meaning.emplace(*set_, control_);
      meaning->setStylusRadius(now.drawn.hosts.at("tool_radius"));
    }
    std::optional<sim::Trace> writer;
    if (from_.options.traces) {
      writer.emplace([&](std::string_view lines) { trace += lines; });
      const sim::Point3& at = entry.start;
      writer->begin("start").word("X", at.x).word("Y", at.y).word("Z", at.z).end();
    }
    stand_.setTrace(writer ? &*writer : nullptr);
    verify::Record record =
        stand_.run(text_.code(), now.world, entry, now.stores, meaning ? &*meaning : nullptr);
    if (writer) traceResults(record, *writer);
    return record;
  }

  void add(std::vector<verify::Difference> found, TargetRun& out) const {
    for (verify::Difference& difference : found) {
      const std::uint32_t line = text_.line(difference.target);
      out.differences.push_back({std::move(difference), line, ""});
    }
  }

  // The dialog has rejected the values: the translation raises an alarm, and nothing has moved.
  void compareRejection(const verify::Record& record, TargetRun& out) const {
    const std::uint32_t line = text_.line(record.endedAt);
    if (record.ending != verify::Ending::Alarm)
      out.differsAt(verify::Aspect::Ending, "the dialog rejects the values, and the program runs", line);
    else if (!record.pieces.empty())
      out.differsAt(verify::Aspect::Ending,
                    "the dialog rejects the values, and the program moves before its alarm", line);
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
  }

  void compareRecords(const TargetCase& now, const verify::Record& record, TargetRun& out) const {
    const verify::Record& source = *now.source;
    verify::CompareRules rules;
    rules.results = std::max(from_.options.tolerance, resultTolerance(control_, *from_.inputs.sourceControl));
    // After a write of the system that is active, what follows is as exactly as the control computes.
    rules.tolerance = writesActive(source, now.entry) ? rules.results : from_.options.tolerance;
    // Of eight digits the last one is a ten millionth at most; two of them.
    rules.relative = rules.results > from_.options.tolerance ? 2e-7 : 0;
    rules.mayRestoreModes = true;
    rules.sameAlarmNumbers = sourceSet_ == set_;
    rules.samePlace = [&](SourceRange one, SourceRange other) {
      return translation_.stemsFrom(now.sourceOf(one), text_.line(other), from_.session.sources());
    };
    if (record.ending == verify::Ending::Alarm && record.pieces.empty() &&
        translation_.madeUp(text_.line(record.endedAt))) {
      out.refused = true;
      out.why = record.text;
      return;
    }
    // How far another vendor's macro searches is its own business: it may find what the source's does not.
    const bool searches = source.ending == verify::Ending::Alarm &&
                          source.alarmKind == stdlib::macroAlarmName(stdlib::MacroAlarm::ProbeFail);
    if (sourceSet_ != set_ && searches && !rules.samePlace(source.endedAt, record.endedAt))
      out.undecided = true;
    else
      add(verify::compare(source, record, rules), out);
  }

  const VerificationSource from_;
  const Translation& translation_;
  const stdlib::Control& control_;
  const stdlib::MacroSet *sourceSet_, *set_;
  const Limits limits_ = limitsOfRun(from_.session.limits());
  verify::Stand stand_;
  FanucText text_;
};

} // namespace

std::unique_ptr<Verification> fanucVerification(const VerificationSource& source) {
  return std::make_unique<FanucVerification>(source);
}

} // namespace dotek::targets
