// Cases of verify --to fusion.
#include "backends/fusion/TargetVerify.h"
#include "backends/fusion/Emit.h"
#include "backends/fusion/Run.h"
#include "backends/fusion/TargetOperation.h"
#include "backends/fusion/TargetWritten.h"
#include "ir/Program.h"
#include "project/MacroCycles.h"
#include "sim/machine/Compile.h"
#include "sim/machine/SafeMoves.h"
#include "sim/vendor/VendorMacros.h"
#include "stdlib/MovedSet.h"
#include "support/Decimal.h"
#include "support/messages/Verify.h"
#include "targets/DialogChoices.h"
#include "targets/MissedTouches.h"
#include "targets/OffParts.h"
#include "targets/ReadBack.h"
#include "targets/Stage.h"
#include "verify/Callers.h"
#include "verify/Exactness.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <fmt/format.h>

namespace dotek::targets {

namespace fusion = backends::fusion;

namespace {

class FusionVerification final : public Verification {
public:
  explicit FusionVerification(const VerificationSource& source)
      : from_(source), control_(*source.inputs.sourceControl),
        sourceSet_(source.session.macroSet(source.plan.sourceMacros, &*source.inputs.sourceControl)),
        set_(source.session.macroSet(source.plan.targetMacros, &*source.inputs.sourceControl)),
        stand_(control_,
               set_ == nullptr ? std::vector<const stdlib::MacroSet*>{}
                               : std::vector<const stdlib::MacroSet*>{set_},
               limits_),
        runner_({source.session.options().scriptProgram, source.session.limits()}) {
    stand_.passOverAbsent();
  }

  bool takesTies() const override { return true; }
  bool meetsLimitsAlike() const override {
    return control_.arithmetic == stdlib::Arithmetic::Decimal8 && sourceSet_ == set_;
  }
  // Macros that correct an offset by measured less expected take no other nominal, and the fragment says so.
  bool needsNominal() const override {
    return set_ != sourceSet_ &&
           from_.plan.translation->text.find(fusion::kMissedNominal) != std::string::npos;
  }

  bool prepare() override {
    const Translation& translation = *from_.plan.translation;
    prefix_ = fusion::prefixOf(from_.folder.name);
    demands_.setPrefix(prefix_);
    if (const auto fault = fragment_.load(translation.text, prefix_, true, fusion::sharedHelpers(control_))) {
      report(*fault);
      return false;
    }
    if (set_ != nullptr) {
      if (const auto text = stdlib::macroText(from_.session.data(), set_->name)) {
        Diagnostics found;
        auto file = readBack(set_->name, *text, control_, from_.session.limits(), sources_, found);
        if (!file) {
          from_.session.diagnostics().report<diag::TranslationNotRead>({}, set_->name, firstError(found));
          return false;
        }
        macros_.emplace(std::move(*file));
      }
    }
    return true;
  }

  TargetRun run(const TargetCase& now) override {
    TargetRun out;
    const fusion::RunResult result = fragment_.run(operationOf(now.drawn, prefix_));
    if (result.fault) {
      if (result.fault->kind == script::Fault::Kind::Script)
        out.differsAt(verify::Aspect::Ending, "the fragment fails: " + result.fault->text,
                      lineOf(*result.fault));
      else
        out.stopped = result.fault->text;
      return out;
    }
    if (!result.errors.empty()) {
      if (result.wroteAfterError || !result.text.empty())
        out.differs(verify::Aspect::Ending,
                    "the fragment writes blocks beside its error: " + result.errors.front());
      if (now.source != nullptr && !demands_.isOfFragment(result.errors.front()))
        out.differs(verify::Aspect::Ending,
                    fmt::format("the dialog takes the values, and the fragment stops with its message `{}`",
                                result.errors.front()));
      else if (now.rejected && !says(result.errors.front(), now.rejection))
        out.differs(verify::Aspect::Ending,
                    fmt::format("{}; the fragment stops with `{}`", now.rejection, result.errors.front()));
      out.refused = out.differences.empty();
      out.why = "the post stops with an error: " + result.errors.front();
      return out;
    }
    if (now.source == nullptr) return out; // it runs
    if (sourceSet_ != set_ && losesDigits(result)) {
      out.undecided = out.ofValues = true;
      out.why = "calls of another set get fewer digits than these values have, and the fragment warns of it";
      return out;
    }
    runText(now, result.text, out);
    if (!out.stopped.empty() || !out.differences.empty()) return out;
    if (sourceSet_ == set_ && !now.drawn.edge && !now.losesDigits && losesDigits(result)) {
      out.differs(verify::Aspect::Printed,
                  "the fragment warns of more digits than are printed, where the post prints all");
      return out;
    }
    compareFrame(now, result, out);
    if (now.questions != nullptr && out.differences.empty()) runOtherwise(now, result, out);
    return out;
  }

private:
  // 0 where it is not in the fragment.
  static std::uint32_t lineOf(const script::Fault& fault) {
    return fault.source == fusion::kFragment ? fault.line : 0;
  }

  // Its own errors aside. What a message has beside ASCII is written in several ways.
  bool says(const std::string& error, std::string_view message) const {
    const bool ascii = std::all_of(message.begin(), message.end(),
                                   [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    return !ascii || demands_.isOfFragment(error) || message.find(error) != std::string::npos;
  }

  // What keeps the translation from being read, at its line where that is known.
  void report(const script::Fault& fault) {
    reportFault(fault, lineOf(fault), *from_.plan.translation, from_.session);
  }

  // ---- what it owes the post (docs/fusion.md)

  // Whether the post writes this comment with a block number before it.
  static bool isNumbered(const TargetCase& now, const std::string& comment) {
    return std::any_of(now.lines.begin(), now.lines.end(), [&](const auto& line) {
      return hasNumber(line.text) && line.text.size() > comment.size() && line.text.ends_with(comment);
    });
  }

  void compareFrame(const TargetCase& now, const fusion::RunResult& result, TargetRun& out) const {
    if (!result.taken)
      out.differs(verify::Aspect::Ending,
                  fmt::format("`{}_dispatch` prints the cycle and does not return true", prefix_));
    std::string kept;
    for (const std::string& name : result.kept)
      kept += (kept.empty() ? "`" : ", `") + name + "`";
    if (!kept.empty())
      out.differs(verify::Aspect::Modal,
                  kept + " not reset: the post leaves out words that the macros have made necessary");
    const Written written = writtenOf(result.text);
    // Each line of the Prog has its line where the macros are the same, and each block its number otherwise.
    const bool each = sourceSet_ == set_ && now.lines.size() == written.lines.size();
    const bool all = std::all_of(now.lines.begin(), now.lines.end(), [](const auto& line) {
      return hasNumber(line.text) || isComment(line.text);
    });
    for (std::size_t i = 0; i < written.lines.size(); ++i) {
      // A block that a jump leads to brings its own. A comment is numbered where the post numbers that one.
      const bool numbered = each ? hasNumber(now.lines[i].text)
                                 : all && (!isComment(written.lines[i]) || isNumbered(now, written.lines[i]));
      const bool wanted = !hasNumber(written.lines[i]) && numbered;
      if (written.numbered[i] == wanted || (!each && !all)) continue;
      out.differs(verify::Aspect::Printed,
                  wanted ? "a block that the post numbers is written without its number (writeBlock)"
                         : "a line that the post does not number is written as a block (writeln)",
                  written.lines[i]);
      return;
    }
  }

  void runOtherwise(const TargetCase& now, const fusion::RunResult& result, TargetRun& out) {
    runWithActive(now, out);
    demands_.check(now, result, out);
  }

  // The system in force is set: what comes after is moved by that.
  void runWithActive(const TargetCase& now, TargetRun& out) {
    for (const verify::DrawField& field : from_.plan.fields) {
      if (field.kind != ir::Kind::WorkOffset || field.fixed || !out.differences.empty()) continue;
      fusion::RunInput input = operationOf(now.drawn, prefix_);
      const auto property = input.properties.find(fusion::propertyOf(prefix_, field.name));
      if (property == input.properties.end()) continue;
      property->second = field.firstSystem + (now.entry.system - 54.0);
      const SourceQuestions::Ran meant = now.questions->with(field.name, property->second);
      const fusion::RunResult result = fragment_.run(input);
      if (meant.answer != SourceQuestions::Answer::Runs || !result.ok()) continue;
      const std::optional<Compiled> made = compiled(result.text, out);
      if (!made) return;
      std::vector<verify::Difference> found =
          verify::compare(meant.record, runCode(*made, now, now.entry), rulesFor(now, meant.record));
      for (verify::Difference& one : found)
        one.text = fmt::format("with {} as `{}`, the system in force: {}", numberText(property->second),
                               field.name, one.text);
      add(std::move(found), made->id, out);
    }
  }

  // What a fragment has posted, ready to run. nullopt: it cannot be read, and `out` says so.
  struct Compiled {
    FileId id = 0;
    std::unique_ptr<ir::ProgramFile> file;
    sim::Bytecode code;
    sim::BlockSet watching = {}; // bare skip moves that go to a position
  };
  std::optional<Compiled> compiled(const std::string& numbered, TargetRun& out) {
    const std::string text = writtenOf(numbered).text;
    Diagnostics found;
    auto file = readBack("posted by the fragment", "O1\n" + text + "M30\n", control_, from_.session.limits(),
                         sources_, found);
    if (!file) {
      out.differs(verify::Aspect::Ending, "the text of the fragment cannot be read: " + firstError(found));
      return std::nullopt;
    }
    Compiled made{
        static_cast<FileId>(sources_.size() - 1), std::make_unique<ir::ProgramFile>(std::move(*file)), {}};
    std::vector<const ir::Program*> programs;
    for (const ir::Program& program : made.file->programs)
      programs.push_back(&program);
    if (macros_)
      for (const ir::Program& program : macros_->programs)
        programs.push_back(&program);
    made.code = sim::compile(programs, control_, sources_);
    made.watching = sim::safeMoves(programs, control_);
    return made;
  }

  void runText(const TargetCase& now, const std::string& numbered, TargetRun& out) {
    const std::optional<Compiled> made = compiled(numbered, out);
    if (!made) return;
    const verify::Record record = runCode(*made, now, now.entry);
    if (record.overLimit) {
      out.stopped = record.text;
      return;
    }
    const auto show = [&](const verify::Entry& entry, std::string who) {
      if (now.shown != nullptr)
        *now.shown = {runCode(*made, now, entry, verify::Stand::Way::KeepMoves), std::move(who)};
    };
    show(now.entry, "");
    add(verify::compare(*now.source, record, rulesFor(now, *now.source)), made->id, out);
    if (now.questions == nullptr || now.posted == nullptr || !out.differences.empty()) return;
    // With another work system, tool length or mode in force than the source selects.
    std::vector<verify::OtherCaller> others =
        verify::otherCallers(*now.posted, control_, now.entry, now.stream);
    for (verify::OtherCaller& other : verify::otherModes(control_, now.entry))
      others.push_back(std::move(other));
    std::optional<verify::Record> keeps;
    for (const verify::OtherCaller& other : others) {
      const SourceQuestions::Ran meant = now.questions->from(other.entry);
      const verify::CompareRules rules = rulesFor(now, meant.record);
      if (meant.answer != SourceQuestions::Answer::Runs ||
          !verify::runsAlike(usualRun(now, other.entry, keeps), meant.record, rules))
        continue;
      const verify::Record ran = runCode(*made, now, other.entry);
      if (other.ofModes && refusesModes(ran, numbered)) continue;
      std::vector<verify::Difference> differences = verify::compare(meant.record, ran, rules);
      if (differences.empty()) continue;
      for (verify::Difference& one : differences)
        one.text = fmt::format("printed {}: {}", other.who, one.text);
      show(other.entry, "printed " + other.who);
      add(std::move(differences), made->id, out);
      return;
    }
    add(compareMissed(
            now, record,
            [&](const verify::Interference& none) {
              return runCode(*made, now, now.entry, verify::Stand::Way::Run, none);
            },
            [&](const verify::Record& source) {
              // Alarms that the source itself raises are printed as they are.
              verify::CompareRules own = rulesFor(now, source);
              own.sameAlarmNumbers = own.sameAlarmNumbers || source.alarmKind.empty();
              return own;
            },
            control_.arithmetic == stdlib::Arithmetic::Decimal8),
        made->id, out);
    const bool exact = meetsLimitsAlike();
    add(compareOffParts(now, {rulesFor(now, *now.source).overtravel, exact, takesTies()},
                        [&](const verify::Record& meant, sim::World& world) {
                          return verify::compare(meant, runIn(world, *made, now), rulesFor(now, meant));
                        }),
        made->id, out);
    runShifted(*made, now, record, out);
  }

  verify::Record runIn(sim::World& world, const Compiled& made, const TargetCase& now) {
    const TargetCase there{.drawn = now.drawn, .entry = now.entry, .stores = now.stores, .world = world};
    return runCode(made, there, now.entry);
  }

  // A macro may ask for the modes that it needs: its own alarm comes before anything is measured.
  static bool refusesModes(const verify::Record& ran, const std::string& text) {
    return ran.ending == verify::Ending::Alarm && ran.alarmKind.empty() &&
           text.find(ran.text) == std::string::npos &&
           std::all_of(ran.measures.begin(), ran.measures.end(),
                       [](const verify::Measure& one) { return one.contacts.empty(); });
  }

  // A local shift along an axis where the fragment writes an offset of it and the source does not: what it
  // computes would hold the shift.
  void runShifted(const Compiled& made, const TargetCase& now, const verify::Record& ran, TargetRun& out) {
    if (!out.differences.empty()) return;
    constexpr std::string_view kAxes = "XYZ";
    for (const verify::BrokenCaller& caller : verify::brokenCallers(control_, true)) {
      const std::size_t axis = kAxes.find(caller.shifts);
      if (axis == std::string_view::npos || !ran.ownOffsets[axis] || now.source->ownOffsets[axis]) continue;
      // The check comes after the measure, which a large shift sideways leads past its surface.
      constexpr double kAside = 1; // mm
      if (axis != 2 && caller.away.length() > kAside) continue;
      verify::Entry broken = now.entry;
      broken.blocks = caller.blocks;
      const verify::Record record = runCode(made, now, broken);
      const bool stops = record.ending == verify::Ending::Alarm &&
                         verify::showsAlarm(record.text, caller.alarm, control_.alarmLength) &&
                         record.measures.size() < *ran.ownOffsets[axis];
      if (!stops)
        out.differs(verify::Aspect::Ending, fmt::format("printed {}: `{}` has to stop it before it measures",
                                                        caller.who, caller.alarm));
    }
  }

  verify::Record runCode(const Compiled& made, const TargetCase& now, const verify::Entry& entry,
                         verify::Stand::Way way = verify::Stand::Way::Run,
                         const verify::Interference& interference = {}) {
    std::optional<sim::VendorMacros> meaning;
    if (set_ != nullptr) {
      meaning.emplace(*set_, control_, measuring_);
      meaning->setStylusRadius(now.drawn.hosts.at("tool_radius"));
      if (sourceSet_ == set_) meaning->passUnstated();
    }
    stand_.watchOnly(made.watching);
    verify::Record record =
        stand_.run(made.code, now.world, entry, now.stores, meaning ? &*meaning : nullptr, way, interference);
    // What macros do inside is their own business.
    std::erase_if(record.early, [&](const verify::EarlyUse& use) { return use.range.file != made.id; });
    return record;
  }

  verify::CompareRules rulesFor(const TargetCase& now, const verify::Record& source) const {
    verify::CompareRules rules = programRules(from_, control_, sourceSet_, set_);
    allowForDatums(rules, source, now.entry, control_, macros_.has_value());
    allowForRounding(rules, now);
    const bool given = from_.plan.fixedHosts.contains("overtravel");
    if (const auto host = now.drawn.hosts.find("overtravel");
        given && sourceSet_ != set_ && host != now.drawn.hosts.end())
      rules.overtravel = host->second;
    return rules;
  }

  // `id`: of the fragment's text.
  void add(std::vector<verify::Difference> found, FileId id, TargetRun& out) const {
    for (verify::Difference& difference : found) {
      std::string line;
      if (difference.target.hasPlace() && difference.target.file == id)
        line = sources_.file(id).line(sources_.line(difference.target));
      out.differences.push_back({std::move(difference), 0, std::move(line)});
    }
  }

  const VerificationSource from_;
  const stdlib::Control& control_;
  const stdlib::MacroSet *sourceSet_, *set_;
  const sim::MeasuringCycles measuring_ = project::measuringCycles({set_}, from_.session);
  const Limits limits_ = limitsOfRun(from_.session.limits());
  verify::Stand stand_;
  std::string prefix_;
  script::Runner runner_;
  fusion::Fragment fragment_{runner_};
  std::optional<ir::ProgramFile> macros_; // of the target's set, where it has a text
  SourceMap sources_;
  OperationDemands demands_{from_, fragment_, sourceSet_ == set_};
};

} // namespace

std::unique_ptr<Verification> fusionVerification(const VerificationSource& source) {
  return std::make_unique<FusionVerification>(source);
}

} // namespace dotek::targets
