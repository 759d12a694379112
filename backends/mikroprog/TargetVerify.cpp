// Cases of verify --to mikroprog.
#include "backends/mikroprog/TargetCompare.h"
#include "backends/mikroprog/TargetFrame.h"
#include "backends/mikroprog/TargetProgram.h"
#include "frontend/gibbs/Ast.h"
#include "sim/mikroprog/Dialect.h"
#include "stdlib/MacroSet.h"
#include "support/messages/Verify.h"
#include "targets/ReadBack.h"
#include "verify/CycleStand.h"
#include "verify/Interference.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace dotek::targets {

namespace dialect = sim::mikroprog;

namespace {

struct Ran {
  verify::Record record;
  std::optional<MikroprogTail> tail;
};
using Runs = std::function<Ran(const verify::Interference&)>;

constexpr sim::Point3 kBeside{7.25, -5.5, 0}; // mm; on a lathe along X alone

class MikroprogVerification final : public Verification {
public:
  explicit MikroprogVerification(const VerificationSource& source) : from_(source) {}

  bool datumsMovePath() const override { return true; }

  bool prepare() override {
    if (from_.inputs.job && from_.inputs.job->lengthToCentre) {
      from_.session.diagnostics().report<diag::LengthOfProbe>({});
      return false;
    }
    if (from_.plan.cycleFile) {
      lowered_ = own_.lowerFile(from_.options.inputs.front(), from_.options.source);
    } else {
      std::set<std::string> used;
      lowered_ = lowerCycle(from_.folder, from_.inputs, used, from_.session);
    }
    if (!lowered_) return false;
    lowered_->cycle.name = from_.folder.name;
    const auto name = mikroprogControlFor(from_.options.control, from_.folder, *lowered_, from_.session);
    if (!name) return false;
    control_ = loadMikroprogControl(*name, from_.session);
    return control_.has_value();
  }

  TargetRun run(const TargetCase& now) override {
    TargetRun out;
    std::optional<std::string> text = from_.plan.translation->text;
    if (text->empty()) text = write(now.drawn);
    if (!text) {
      out.refused = true;
      out.why = "the conversion is refused: " + firstError(from_.session.diagnostics());
      return out;
    }
    if (now.source == nullptr) return out;
    // Of a cycle: with each `set` as part of its touch, which is shown to do the same.
    std::optional<verify::Record> joined;
    if (from_.plan.cycleFile && from_.plan.translation->text.empty()) {
      joined = runFolded(now, false);
      for (verify::Difference& one :
           verify::compare(withoutFeeds(*now.source), withoutFeeds(*joined), joinedRules()))
        out.differences.push_back({std::move(one), 0, ""});
      if (!out.differences.empty()) return out;
    }
    const verify::Record& meant = joined ? *joined : *now.source;
    const bool setsItsOwn =
        std::any_of(meant.measures.begin(), meant.measures.end(), [&](const verify::Measure& measure) {
          return std::any_of(measure.datums.begin(), measure.datums.end(),
                             [&](const auto& datum) { return datum.first.first == now.entry.system; });
        });
    if (setsItsOwn) {
      out.undecided = true;
      out.why = "the source sets the system in which it goes on, this control has no other to set";
      return out;
    }
    SourceMap sources;
    Diagnostics found;
    const FileId id = sources.add(SourceFile("program", std::move(*text), Encoding::Cp852));
    std::optional<ir::Program> program = readSuf(id, *control_, sources, found);
    if (!program) {
      for (const Diagnostic& one : found.all())
        if (one.severity == Severity::Error && out.differences.empty())
          out.differs(verify::Aspect::Ending, "the program is faulty: " + one.message,
                      one.range.hasPlace() ? std::string(sources.file(id).line(sources.line(one.range)))
                                           : "");
      if (out.differences.empty()) out.differs(verify::Aspect::Ending, "the program cannot be read");
      return out;
    }
    const auto lineOf = [&](SourceRange range) {
      return range.hasPlace() ? std::string(sources.file(id).line(sources.line(range))) : std::string();
    };
    if (std::optional<verify::Difference> fault = textFault(*program, *control_)) {
      std::string line = lineOf(fault->target);
      out.differences.push_back({std::move(*fault), 0, std::move(line)});
      return out;
    }
    const dialect::Profile profile(*control_);
    const sim::Bytecode code = dialect::compile(*program, profile, sources);
    verify::Stand stand(profile.machine, {}, from_.session.limits(), profile.dialect);
    verify::Entry entry = now.entry;
    entry.probeOn = true; // no function switches it
    const Runs runs = [&](const verify::Interference& interference) {
      verify::Record ran =
          stand.run(code, now.world, entry, {}, nullptr, verify::Stand::Way::Run, interference);
      std::optional<MikroprogTail> tail = takeEnding(ran, *control_);
      return Ran{std::move(ran), std::move(tail)};
    };
    const verify::Record ran = runs({}).record;
    if (now.shown != nullptr) {
      now.shown->record = stand.run(code, now.world, entry, {}, nullptr, verify::Stand::Way::KeepMoves, {});
      takeEnding(*now.shown->record, *control_);
    }
    const bool byOperator = from_.options.datum == "operator";
    const std::optional<MikroprogRetract> retract = retractOf(now, meant);
    const MikroprogFacts facts{*control_,
                               now.entry.zeros[now.entry.system - 54],
                               now.drawn.hosts.at("overtravel"),
                               now.world.probe().ballRadius(),
                               now.drawn.hosts.at("return_feed"),
                               byOperator,
                               retract.has_value(),
                               tolerance()};
    const bool sets = std::any_of(meant.measures.begin(), meant.measures.end(),
                                  [](const verify::Measure& measure) { return !measure.datums.empty(); });
    const verify::Record source = !sets || byOperator ? meant
                                  : joined            ? runFolded(now, true)
                                                      : now.inItsDatums();
    std::vector<verify::Difference> differences = compareWithSource(source, ran, facts);
    if (SourceRange at; !differences.empty() && source.pathMoved && !whyNoEvidence(source, at).empty()) {
      out.undecided = true;
      out.why = whyBeside(source);
      return out;
    }
    for (verify::Difference& difference : differences) {
      std::string line = lineOf(difference.target);
      out.differences.push_back({std::move(difference), 0, std::move(line)});
    }
    if (!out.differences.empty() || meant.ending != verify::Ending::Finished) return out;
    interfere(runs, ran, lineOf, retract, out);
    if (!out.differences.empty()) return out;
    const auto rehearsed = [&](const sim::Point3& by) {
      verify::Entry begun = entry;
      begun.start = entry.start + by;
      return stand.run(code, now.world, begun, {}, nullptr, verify::Stand::Way::Rehearse);
    };
    const sim::Point3 by = control_->hasAxis('Y') ? kBeside : sim::Point3{kBeside.x, 0, 0};
    if (std::optional<verify::Difference> fault = startFault(rehearsed({}), rehearsed(by), by)) {
      std::string line = lineOf(fault->target);
      out.differences.push_back({std::move(*fault), 0, std::move(line)});
    }
    return out;
  }

private:
  // The cycle that the program of this case was written from, by its own meaning.
  verify::Record runFolded(const TargetCase& now, bool movePath) const {
    sim::CycleInputs inputs;
    inputs.overtravel = now.drawn.hosts.at("overtravel");
    inputs.values.resize(folded_.variables.size());
    for (ir::VariableId id = 0; id < folded_.variables.size(); ++id)
      if (const auto host = now.drawn.hosts.find(folded_.variable(id).name);
          folded_.variable(id).role == ir::Role::Host && host != now.drawn.hosts.end())
        inputs.values[id] = ir::Scalar::of(host->second);
    if (const auto feed = now.drawn.hosts.find("approach_feed"); feed != now.drawn.hosts.end())
      inputs.approachFeed = feed->second;
    if (const auto retract = now.drawn.hosts.find("retract"); retract != now.drawn.hosts.end())
      inputs.retract = retract->second;
    return verify::CycleStand(from_.session.limits())
        .run(folded_, inputs, now.world, now.entry, now.stores, false, movePath);
  }

  // What a cycle computes goes into words of so many decimals.
  double tolerance() const {
    const double rounded = from_.plan.cycleFile ? kRoundedWord * std::pow(10, -control_->decimals) : 0;
    return std::max(from_.options.tolerance, rounded);
  }

  static verify::Record withoutFeeds(verify::Record record) {
    for (verify::Piece& piece : record.pieces)
      if (piece.kind == sim::PathKind::Protected) piece.feed.reset();
    return record;
  }

  // Offsets, contacts, path and end; the feed of a protected move is that of the machine in both.
  verify::CompareRules joinedRules() const {
    verify::CompareRules rules;
    rules.tolerance = rules.results = std::max(from_.options.tolerance, 1e-6);
    rules.mayRestoreModes = true;
    return rules;
  }

  // How the tails go up: the program knows at which Z it begins. nullopt: it does not, as one that is edited
  // and was written without it. `meant`: what it was written from.
  std::optional<MikroprogRetract> retractOf(const TargetCase& now, const verify::Record& meant) const {
    const bool edited = !from_.plan.translation->text.empty();
    if (edited && !from_.plan.fixedHosts.contains("start_z")) return std::nullopt;
    const sim::Point3& zero = now.entry.zeros[now.entry.system - 54];
    MikroprogRetract out;
    out.z = std::max(now.drawn.hosts.at("start_z"), now.drawn.hosts.at("clearance"));
    out.least = zero.z + out.z;
    for (const verify::Piece& piece : meant.pieces)
      if (piece.kind != sim::PathKind::Measuring) out.z = std::max(out.z, piece.to.z - zero.z);
    if (from_.options.datum != "operator") out.z += mostRaised(meant, zero, now.world.probe().ballRadius());
    out.tolerance = kRoundedWord * std::pow(10, -control_->decimals);
    out.feed = now.drawn.hosts.at("return_feed");
    return out;
  }

  // Why the path that a datum has moved is no evidence; `source` is the run on it.
  static std::string_view whyBeside(const verify::Record& source) {
    const auto stem = [](const auto& event) { return event.first.outcome == sim::Outcome::StemCollision; };
    if (source.events.empty())
      return "the source comes to nothing after a datum, where this control goes on beside its path";
    if (std::any_of(source.events.begin(), source.events.end(), stem))
      return "the stem of the probe touches the part, and this control goes on beside its path";
    return "the path that a datum has corrected meets the part";
  }

  // The program of these values. nullopt: the session says why there is none.
  std::optional<std::string> write(const verify::Case& drawn) {
    from_.session.diagnostics() = Diagnostics();
    LoweredCycle lowered = *lowered_;
    for (ir::VariableId id = 0; id < lowered.cycle.variables.size(); ++id) {
      const ir::Variable& variable = lowered.cycle.variable(id);
      if (lowered.fixed.contains(id)) continue;
      if (variable.role == ir::Role::Host) {
        if (const auto host = drawn.hosts.find(variable.name); host != drawn.hosts.end())
          lowered.fixed.emplace(id, host->second);
      } else if (variable.role == ir::Role::Parameter) {
        for (const auto& [name, value] : drawn.values)
          if (frontend::gibbs::foldCase(name) == frontend::gibbs::foldCase(variable.name))
            lowered.fixed.emplace(id, value);
        if (from_.plan.cycleFile && variable.defaultValue) lowered.fixed.emplace(id, *variable.defaultValue);
      }
    }
    const MikroprogWriting writing{*control_,
                                   from_.options.datum,
                                   from_.options.common.assume,
                                   false,
                                   drawn.hosts,
                                   [](const std::string&) { return std::string("--set"); },
                                   from_.plan.cycleFile,
                                   &folded_};
    auto program = writeMikroprog(from_.folder, std::move(lowered), writing, from_.session);
    if (!program) return std::nullopt;
    std::string out;
    for (const backends::EmittedLine& line : program->lines)
      out.append(line.text).append("\r\n");
    return out;
  }

  // Each search once without its surface, each protected move with an obstacle half way, each guard with
  // contact already there.
  static void interfere(const Runs& runs, const verify::Record& ran,
                        const std::function<std::string(SourceRange)>& lineOf,
                        const std::optional<MikroprogRetract>& retract, TargetRun& out) {
    using stdlib::MacroAlarm;
    const auto attempt = [&](const verify::Interference& interference, MacroAlarm alarm,
                             std::string_view what, std::size_t number) {
      SourceRange at;
      const Ran disturbed = runs(interference);
      std::string why = whyNotCaught(disturbed.record, macroAlarmName(alarm), at);
      if (why.empty() && retract && disturbed.tail) why = tailFault(*disturbed.tail, *retract);
      if (!why.empty() && out.differences.empty())
        out.differs(verify::Aspect::Ending, fmt::format("{} {}: {}", what, number + 1, why), lineOf(at));
    };
    const auto eachOf = [&](std::size_t count, std::optional<std::size_t> verify::Interference::*which,
                            MacroAlarm alarm, std::string_view what) {
      for (std::size_t i = 0; i < count; ++i) {
        verify::Interference one;
        one.*which = i;
        attempt(one, alarm, what, i);
      }
    };
    eachOf(ran.searches, &verify::Interference::missing, MacroAlarm::ProbeFail, "no surface at search");
    eachOf(ran.protectedMoves, &verify::Interference::obstacle, MacroAlarm::PathObstructed,
           "an obstacle in protected move");
    eachOf(ran.questions.size(), &verify::Interference::touching, MacroAlarm::PathObstructed,
           "contact before chain");
  }

  const VerificationSource from_;
  project::Compilation own_{from_.session};
  ir::Cycle folded_; // of the case at hand
  std::optional<LoweredCycle> lowered_;
  std::optional<stdlib::MikroprogControl> control_;
};

} // namespace

std::unique_ptr<Verification> mikroprogVerification(const VerificationSource& source) {
  return std::make_unique<MikroprogVerification>(source);
}

} // namespace dotek::targets
