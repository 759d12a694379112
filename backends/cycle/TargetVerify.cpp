// Cases of verify --to cycle: the cycle runs by its meaning, no control is asked.
#include "backends/cycle/TargetVerify.h"

#include "backends/cycle/TargetMeasures.h"
#include "backends/cycle/TargetText.h"
#include "support/messages/Verify.h"
#include "targets/KeptResults.h"
#include "targets/OffParts.h"
#include "targets/ReadBack.h"
#include "targets/Stage.h"
#include "verify/CycleStand.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::targets {

namespace {

constexpr double kOvertravel = 10;    // of a search where nothing states it: that of vendors' macros, mm
constexpr double kGridSteps = 2.5e-6; // mm: two steps, and what a subtraction leaves
constexpr double kSamePlace = 1e-3;   // mm
constexpr std::string_view kUpward = "touch leads upward"; // alarm of the language
constexpr double kFirst = 54, kLast = 59;

class CycleVerification final : public Verification {
public:
  explicit CycleVerification(const VerificationSource& source)
      : from_(source), limits_(limitsOfRun(source.session.limits())), stand_(limits_), read_(source.session) {
  }

  bool prepare() override {
    Session& session = from_.session;
    std::set<std::string> used;
    std::optional<LoweredCycle> lowered = lowerCycle(from_.folder, from_.inputs, used, session);
    if (!lowered) return false;
    lowered->cycle.name = from_.folder.name;
    written_ = writtenCycle(from_.folder, *lowered,
                            from_.inputs.sourceControl ? &*from_.inputs.sourceControl : nullptr, session);
    if (!written_) return false;
    const Translation& translation = *from_.plan.translation;
    Diagnostics found;
    std::optional<frontend::cycle::Lowered> cycle;
    if (read_.read(translation.name, translation.text, found)) cycle = read_.lowered(found);
    file_ = static_cast<FileId>(session.sources().size() - 1);
    if (!cycle) {
      session.diagnostics().report<diag::TranslationNotRead>({}, translation.name, firstError(found));
      return false;
    }
    cycle_ = std::move(cycle->cycle);
    NamedTexts kept;
    for (const auto& [name, number] : written_->kept)
      kept.emplace_back(name, fmt::format("#{}", number));
    Diagnostics ignored; // an edited cycle may have other results
    keepResults(cycle_, kept, ignored);
    if (from_.options.translation) compareParameters();
    return true;
  }

  TargetRun run(const TargetCase& now) override {
    TargetRun out;
    bool good = true;
    const sim::CycleInputs inputs = inputsOf(now.drawn, good);
    if (!good) {
      // No caller of the cycle can give such a value.
      out.refused = true;
      out.why = "a work offset is none of G54 to G59, or a choice none of its names";
      return out;
    }
    const verify::Record record = stand_.run(cycle_, inputs, now.world, now.entry, now.stores);
    if (now.shown != nullptr)
      *now.shown = {stand_.run(cycle_, inputs, now.world, now.entry, now.stores, true), ""};
    if (record.overLimit) {
      out.stopped = record.text;
      return out;
    }
    if (now.rejected)
      compareRejection(record, now, out);
    else if (now.source != nullptr) {
      compareRecords(record, now, out);
      if (out.differences.empty()) compareOff(inputs, now, out);
    }
    if (now.questions != nullptr && !now.rejected)
      for (const auto& [text, line] : ofParameters_)
        out.differsAt(verify::Aspect::Variable, text, line);
    return out;
  }

private:
  // false: a value that the type of its parameter does not have.
  sim::CycleInputs inputsOf(const verify::Case& drawn, bool& good) const {
    sim::CycleInputs out;
    const auto host = [&](const char* name) {
      const auto found = drawn.hosts.find(name);
      return found == drawn.hosts.end() ? std::nullopt : std::optional(found->second);
    };
    out.overtravel = host("overtravel").value_or(kOvertravel);
    out.approachFeed = host("approach_feed").value_or(out.approachFeed);
    out.measuringFeed = host("measuring_feed").value_or(out.measuringFeed);
    out.retract = host("retract");
    std::map<std::string, double> values;
    for (const auto& [name, parameter] : written_->parameters) {
      const auto field = drawn.values.find(name);
      const auto given = field == drawn.values.end() ? drawn.hosts.find(name) : field;
      if (given == drawn.hosts.end() || given == drawn.values.end()) continue;
      const double value = values[parameter.name] = given->second + parameter.shift;
      if (parameter.names > 0)
        good =
            good && value >= 1 && value <= static_cast<double>(parameter.names) && value == std::floor(value);
    }
    out.values.resize(cycle_.variables.size());
    for (ir::VariableId id = 0; id < cycle_.variables.size(); ++id) {
      const ir::Variable& variable = cycle_.variable(id);
      if (variable.role == ir::Role::Host) {
        if (const auto value = host(variable.name.c_str())) out.values[id] = ir::Scalar::of(*value);
      } else if (variable.role == ir::Role::Parameter) {
        const auto value = values.find(variable.name);
        if (value != values.end()) {
          out.values[id] = ir::Scalar::of(value->second);
          if (variable.kind == ir::Kind::WorkOffset)
            good = good && value->second >= kFirst && value->second <= kLast &&
                   value->second == std::floor(value->second);
        } else {
          out.values[id] =
              variable.defaultValue ? ir::Scalar::of(*variable.defaultValue) : ir::Scalar::null();
        }
      }
    }
    return out;
  }

  // What a caller reads of an edited cycle and takes where he gives nothing: as the dialog of the source says
  // it. What is written now says how the language puts it.
  void compareParameters() {
    std::string text;
    for (const backends::EmittedLine& line : written_->lines)
      text += line.text + "\n";
    Diagnostics ignored;
    ReadCycle read(from_.session);
    if (!read.read("written", text, ignored)) return;
    const std::optional<frontend::cycle::Lowered> written = read.lowered(ignored);
    if (!written) return;
    const auto value = [](const ir::Variable& one) {
      return one.defaultValue ? fmt::format("{}", *one.defaultValue) : std::string("none");
    };
    for (const ir::Variable& wanted : written->cycle.variables) {
      if (wanted.role != ir::Role::Parameter) continue;
      const auto own =
          std::find_if(cycle_.variables.begin(), cycle_.variables.end(), [&](const ir::Variable& one) {
            return one.role == ir::Role::Parameter && one.name == wanted.name;
          });
      if (own == cycle_.variables.end()) continue; // where it matters the values tell
      const std::uint32_t line = lineOf(own->range);
      if (own->defaultValue != wanted.defaultValue)
        ofParameters_.emplace_back(fmt::format("default of `{}`: the source has {}, the translation {}",
                                               own->name, value(wanted), value(*own)),
                                   line);
      // In other words it may say the same.
      const auto& all = written->cycle.variables;
      const bool ofAnother = std::any_of(all.begin(), all.end(), [&](const ir::Variable& one) {
        return one.role == ir::Role::Parameter && one.name != wanted.name && one.meaning == own->meaning;
      });
      if (own->meaning != wanted.meaning && ofAnother)
        ofParameters_.emplace_back(fmt::format("title of `{}`: the source says `{}`, the translation `{}`",
                                               own->name, wanted.meaning, own->meaning),
                                   line);
    }
  }

  std::uint32_t lineOf(SourceRange range) const {
    return range.hasPlace() && range.file == file_ ? from_.session.sources().line(range) : 0;
  }

  void compareRejection(const verify::Record& record, const TargetCase& now, TargetRun& out) const {
    const std::uint32_t line = lineOf(record.endedAt);
    if (record.ending != verify::Ending::Alarm)
      out.differsAt(verify::Aspect::Ending, "the dialog rejects the values, and the cycle runs", line);
    else if (!record.pieces.empty())
      out.differsAt(verify::Aspect::Ending,
                    "the dialog rejects the values, and the cycle moves before its alarm", line);
    else if (now.rejection.find(record.text) == std::string_view::npos)
      out.differsAt(verify::Aspect::Ending,
                    fmt::format("the dialog rejects the values, `{}`, and the cycle stops with `{}`",
                                now.rejection, record.text),
                    line);
    else
      out.refused = true;
  }

  // How far another search goes is its own business.
  void compareOff(const sim::CycleInputs& inputs, const TargetCase& now, TargetRun& out) {
    const auto run = [&](const verify::Record& meant, sim::World& world) {
      TargetRun ran;
      TargetCase there{.drawn = now.drawn, .entry = now.entry, .stores = now.stores, .world = world};
      there.source = &meant;
      compareRecords(stand_.run(cycle_, inputs, world, now.entry, now.stores), there, ran);
      return ran;
    };
    addOffParts(now, {.search = 0}, run, out);
  }

  void compareRecords(const verify::Record& record, const TargetCase& now, TargetRun& out) const {
    verify::CompareRules rules;
    rules.tolerance = from_.options.tolerance;
    rules.results =
        std::max({rules.tolerance, resultTolerance(*from_.inputs.sourceControl, *from_.inputs.sourceControl),
                  kGridSteps});
    rules.tolerance = std::max(from_.plan.computesPlaces ? rules.results : rules.tolerance, kGridSteps);
    rules.relative = rules.results > from_.options.tolerance ? 2e-7 : 0;
    rules.mayRestoreModes = true;
    // Where its caller switches the probe, both leave it as it was.
    rules.switchesProbe =
        std::any_of(cycle_.body.begin(), cycle_.body.end(), [](const ir::CycleStatement& one) {
          return std::holds_alternative<ir::ProbePower>(one.node);
        });
    // How far another search goes is its own business.
    const bool searches = now.source->ending == verify::Ending::Alarm &&
                          now.source->alarmKind == stdlib::macroAlarmName(stdlib::MacroAlarm::ProbeFail);
    if (searches && verify::findsAll(record)) {
      out.undecided = true;
      return;
    }
    using stdlib::MacroAlarm;
    if (record.ending == verify::Ending::Alarm && record.pieces.empty() && record.text == kUpward) {
      out.refused = true;
      out.why = "a touch of the cycle leads upward, which the language refuses";
      return;
    }
    // What is in the way stops the cycle, and the source does not feel it.
    const bool blind =
        std::any_of(now.source->pieces.begin(), now.source->pieces.end(), [](const verify::Piece& one) {
          return one.kind == sim::PathKind::Protected && one.with.probe != verify::Switch::On;
        });
    if (blind && record.alarmKind == stdlib::macroAlarmName(MacroAlarm::PathObstructed) &&
        now.source->alarmKind != record.alarmKind) {
      out.undecided = true;
      out.why = "the source moves with the probe off where the cycle meets something and stops";
      return;
    }
    verify::Record own = joinedMeasures(*now.source, record, now.drawn.hosts.at("tool_radius"));
    leaveProbeOn(*now.source, own);
    // A limit that the macros look at by themselves is an `alarm` of the cycle.
    for (const MacroAlarm kind : {MacroAlarm::UpperLimit, MacroAlarm::OutOfTolerance,
                                  MacroAlarm::OutOfPosition, MacroAlarm::OutOfAngle})
      if (now.source->alarmKind == stdlib::macroAlarmName(kind) && own.ending == verify::Ending::Alarm &&
          own.alarmKind.empty())
        own.alarmKind = now.source->alarmKind;
    // What the source keeps for itself is a name of the cycle's own.
    verify::Record source = *now.source;
    std::erase_if(source.stores, [&](const auto& one) {
      return std::none_of(written_->kept.begin(), written_->kept.end(),
                          [&](const auto& kept) { return kept.second == one.first; });
    });
    for (verify::Difference& one : verify::compare(source, own, rules)) {
      const std::uint32_t line = lineOf(one.target);
      out.differences.push_back({std::move(one), line, ""});
    }
  }

  // It protects where the source does not (diag::CycleFormProbeOff): that is said, and no difference.
  static void leaveProbeOn(const verify::Record& source, verify::Record& own) {
    std::size_t next = 0; // of the source
    for (verify::Piece& here : own.pieces) {
      const auto there = std::find_if(source.pieces.begin() + static_cast<std::ptrdiff_t>(next),
                                      source.pieces.end(), [&](const verify::Piece& one) {
                                        return one.kind == here.kind &&
                                               (one.from - here.from).length() <= kSamePlace &&
                                               (one.to - here.to).length() <= kSamePlace;
                                      });
      if (there == source.pieces.end()) continue;
      next = static_cast<std::size_t>(there - source.pieces.begin()) + 1;
      if (here.kind != sim::PathKind::Measuring && here.with.probe == verify::Switch::On)
        here.with.probe = there->with.probe;
    }
  }

  const VerificationSource from_;
  const Limits limits_;
  verify::CycleStand stand_;
  ReadCycle read_;
  FileId file_ = 0;
  std::optional<backends::cycle::Emitted> written_;
  ir::Cycle cycle_;
  std::vector<std::pair<std::string, std::uint32_t>> ofParameters_; // differences, each with its line
};

} // namespace

std::unique_ptr<Verification> cycleVerification(const VerificationSource& source) {
  return std::make_unique<CycleVerification>(source);
}

} // namespace dotek::targets
