// Cases of verify --to fusion.
#include "backends/fusion/TargetVerify.h"
#include "backends/fusion/Emit.h"
#include "backends/fusion/Run.h"
#include "backends/fusion/TargetWritten.h"
#include "ir/Program.h"
#include "sim/machine/Compile.h"
#include "sim/machine/VendorMacros.h"
#include "support/Decimal.h"
#include "support/messages/Verify.h"
#include "targets/MissedTouches.h"
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

constexpr double kTooLong = 1e15;
// Fit pictures of usual size themselves; what is computed from them need not.
constexpr double kLarge[] = {kTooLong, 99999, 9999, 999};
constexpr double kEightDigits = 5e-5; // left of a result beside another way to compute it

class FusionVerification final : public Verification {
public:
  explicit FusionVerification(const VerificationSource& source)
      : from_(source), control_(*source.inputs.sourceControl),
        sourceSet_(source.session.macroSet(source.plan.sourceMacros)),
        set_(source.session.macroSet(source.plan.targetMacros)),
        stand_(control_,
               set_ == nullptr ? std::vector<const stdlib::MacroSet*>{}
                               : std::vector<const stdlib::MacroSet*>{set_},
               limits_),
        runner_({source.session.options().scriptProgram, source.session.limits()}) {}

  // Macros that correct an offset by measured less expected take no other nominal, and the fragment says so.
  bool needsNominal() const override {
    return set_ != sourceSet_ &&
           from_.plan.translation->text.find(fusion::kMissedNominal) != std::string::npos;
  }

  bool prepare() override {
    const Translation& translation = *from_.plan.translation;
    prefix_ = fusion::prefixOf(from_.folder.name);
    if (const auto fault = fragment_.load(translation.text, prefix_, true, fusion::sharedHelpers(control_))) {
      report(*fault);
      return false;
    }
    if (set_ != nullptr) {
      if (const stdlib::DataFile* text = from_.session.data().find("macrob", set_->name)) {
        Diagnostics found;
        auto file =
            readBack(set_->name, std::string(text->text), control_, from_.session.limits(), sources_, found);
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
    const fusion::RunResult result = fragment_.run(inputOf(now.drawn));
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
      if (now.source != nullptr && !isOfFragment(result.errors.front()))
        out.differs(verify::Aspect::Ending,
                    fmt::format("the dialog takes the values, and the fragment stops with its message `{}`",
                                result.errors.front()));
      else if (now.rejected && !says(result.errors.front(), now.rejection))
        out.differs(verify::Aspect::Ending,
                    fmt::format("the dialog rejects the values, `{}`, and the fragment stops with `{}`",
                                now.rejection, result.errors.front()));
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
    compareFrame(now, result, out);
    if (now.questions != nullptr && out.differences.empty()) runOtherwise(now, out);
    return out;
  }

private:
  // As a job file keeps numbers: in 32 bits.
  static double inJob(double value) { return static_cast<float>(value); }

  // 0 where it is not in the fragment.
  static std::uint32_t lineOf(const script::Fault& fault) {
    return fault.source == fusion::kFragment ? fault.line : 0;
  }

  // Its own errors aside. What a message has beside ASCII is written in several ways.
  bool says(const std::string& error, std::string_view message) const {
    const bool ascii = std::all_of(message.begin(), message.end(),
                                   [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    return !ascii || isOfFragment(error) || message.find(error) != std::string::npos;
  }

  // Not a check of the source: what the fragment looks at besides begins with the name of the cycle.
  bool isOfFragment(const std::string& error) const { return error.starts_with(from_.folder.name + ": "); }

  // What keeps the translation from being read, at its line where that is known.
  void report(const script::Fault& fault) {
    reportFault(fault, lineOf(fault), *from_.plan.translation, from_.session);
  }

  fusion::RunInput inputOf(const verify::Case& drawn) const {
    const auto host = [&](const char* name, double otherwise) {
      const auto found = drawn.hosts.find(name);
      return found == drawn.hosts.end() ? otherwise : found->second;
    };
    fusion::RunInput out;
    for (const auto& [name, value] : drawn.values)
      out.properties[fusion::propertyOf(prefix_, name)] = inJob(value);
    out.points = {{inJob(host("start_x", 0)), inJob(host("start_y", 0)), inJob(host("start_z", 0))}};
    out.toolDiameter = inJob(2 * host("tool_radius", 3));
    out.toolNumber = host("tool_number", 1);
    out.toolLengthOffset = host("tool_offset", 1);
    const std::pair<const char*, const char*> kCycle[] = {
        {"clearance", "clearance"}, {"retract", "retract"}, {"overtravel", "probeOvertravel"}};
    for (const auto& [name, member] : kCycle)
      if (const auto found = drawn.hosts.find(name); found != drawn.hosts.end())
        out.cycle[member] = inJob(found->second);
    return out;
  }

  // ---- what it owes the post (docs/fusion.md)

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
      // A block that a jump leads to brings its own.
      const bool wanted = !hasNumber(written.lines[i]) &&
                          (each ? hasNumber(now.lines[i].text) : all && !isComment(written.lines[i]));
      if (written.numbered[i] == wanted || (!each && !all)) continue;
      out.differs(verify::Aspect::Printed,
                  wanted ? "a block that the post numbers is written without its number (writeBlock)"
                         : "a line that the post does not number is written as a block (writeln)",
                  written.lines[i]);
      return;
    }
  }

  // The operation of another cycle, a document in inches, a field that the operation does not give.
  void runOtherwise(const TargetCase& now, TargetRun& out) {
    fusion::RunInput input = inputOf(now.drawn);
    input.chosen = false;
    fusion::RunResult result = fragment_.run(input);
    if (!result.ok() || !result.text.empty() || result.taken)
      out.differs(verify::Aspect::Ending,
                  "an operation that names no cycle: it has to write nothing; " +
                      (result.taken ? "its dispatch returns true" : didInstead(result)));
    input = inputOf(now.drawn);
    input.inch = true;
    result = fragment_.run(input);
    if (result.fault || result.errors.empty() || !result.text.empty())
      out.differs(verify::Aspect::Ending, "a document in inches has to be an error; " + didInstead(result));
    input = inputOf(now.drawn);
    input.probing = true;
    result = fragment_.run(input);
    if (result.fault || result.errors.empty() || !result.text.empty() || !result.taken)
      out.differs(verify::Aspect::Ending,
                  "a probing operation has to be an error, and the post has to print nothing else for it; " +
                      (result.errors.empty() || result.taken ? didInstead(result)
                                                             : "its dispatch does not return true"));
    runWithoutSense(now, out);
    runRejected(now, out);
    runWithActive(now, out);
    for (const verify::DrawField& field : from_.plan.fields) {
      input = inputOf(now.drawn);
      if (field.fixed || input.properties.erase(fusion::propertyOf(prefix_, field.name)) == 0) continue;
      runWithout(field, now, fragment_.run(input), out);
    }
    for (const verify::DrawField& field : from_.plan.fields)
      compareDefinition(field, result, out);
  }

  // What the dialog of the operation begins with.
  void compareDefinition(const verify::DrawField& field, const fusion::RunResult& result,
                         TargetRun& out) const {
    const auto defined = result.defined.find(fusion::propertyOf(prefix_, field.name));
    const auto& given = from_.options.defaults;
    const bool own =
        std::any_of(given.begin(), given.end(), [&](const auto& one) { return one.first == field.name; });
    if (!out.differences.empty() || own || !field.initial || defined == result.defined.end()) return;
    const std::optional<double> value = parseNumber(defined->second);
    if (value && std::abs(*value - *field.initial) <= from_.options.tolerance) return;
    out.differs(verify::Aspect::Variable,
                fmt::format("the property of `{}` is defined as {} against {}, the first value of the field",
                            field.name, defined->second, numberText(*field.initial)));
  }

  // ---- values that no operation should give

  // The fragment has to stop with an error, where it uses what the name stands for: with one that ends so.
  void demandError(const TargetCase& now, const std::string& name, const fusion::RunInput& input,
                   const std::string& why, TargetRun& out, std::string_view says = "") {
    if (!out.differences.empty()) return;
    const fusion::RunResult result = fragment_.run(input);
    const bool stops = !result.fault && !result.errors.empty() && result.text.empty();
    if (stops && result.errors.front().ends_with(says)) return;
    if (!result.fault && result.text == right_ && result.errors.empty() && !uses(now, name)) return;
    out.differs(verify::Aspect::Ending,
                why + (stops ? fmt::format(" has to be an error, `..{}`; ", says) : " has to be an error; ") +
                    didInstead(result));
  }

  // A number that fits no picture and no word of a control is printed by nobody.
  // true: that is so, or it is refused for another reason.
  bool demandText(const fusion::RunInput& input, double value, const std::string& what, TargetRun& out) {
    if (!out.differences.empty()) return false;
    const fusion::RunResult result = fragment_.run(input);
    const bool other = !result.errors.empty() && !isOfFragment(result.errors.front());
    if (result.fault)
      out.differs(verify::Aspect::Ending,
                  fmt::format("{} as {}: it fails: {}", numberText(value), what, result.fault->text));
    if (result.text.find("null") == std::string::npos || right_.find("null") != std::string::npos)
      return other;
    out.differs(verify::Aspect::Ending,
                fmt::format("{} as `{}` does not fit and has to be an error; it writes `null`",
                            numberText(value), what));
    return false;
  }

  // A check of the dialog may bound one field by another: then that one is larger still.
  void demandTexts(fusion::RunInput input, const std::string& property, double value, const std::string& what,
                   TargetRun& out) {
    constexpr double kLarger = 16;
    input.properties[property] = value;
    if (!demandText(input, value, what, out)) return;
    for (auto& [name, other] : input.properties) {
      if (name == property) continue;
      const double drawn = other;
      for (const double larger : {value * kLarger, -value * kLarger}) {
        other = larger;
        demandText(input, value, what, out);
      }
      other = drawn;
    }
  }

  // Values that the dialog rejects beside those of the case, which leave all else as it is.
  void runRejected(const TargetCase& now, TargetRun& out) {
    constexpr double kFar = 500;
    for (const verify::DrawField& field : from_.plan.fields) {
      fusion::RunInput input = inputOf(now.drawn);
      const auto property = input.properties.find(fusion::propertyOf(prefix_, field.name));
      if (field.fixed || property == input.properties.end()) continue;
      for (const double value : {0.0, kFar, -kFar}) {
        if (!out.differences.empty()) return;
        if (now.questions->with(field.name, value).answer != SourceQuestions::Answer::Rejected) continue;
        property->second = value;
        const fusion::RunResult result = fragment_.run(input);
        if (!result.fault && !result.errors.empty() && result.text.empty()) continue;
        out.differs(verify::Aspect::Ending, fmt::format("the dialog rejects {} as `{}`; {}",
                                                        numberText(value), field.name, didInstead(result)));
      }
    }
  }

  // The system in force is set: what comes after is moved by that.
  void runWithActive(const TargetCase& now, TargetRun& out) {
    for (const verify::DrawField& field : from_.plan.fields) {
      if (field.kind != ir::Kind::WorkOffset || field.fixed || !out.differences.empty()) continue;
      fusion::RunInput input = inputOf(now.drawn);
      const auto property = input.properties.find(fusion::propertyOf(prefix_, field.name));
      if (property == input.properties.end()) continue;
      property->second = field.firstSystem + (now.entry.system - 54.0);
      const SourceQuestions::Ran meant = now.questions->with(field.name, property->second);
      const fusion::RunResult result = fragment_.run(input);
      if (meant.answer != SourceQuestions::Answer::Runs || !result.ok()) continue;
      const std::optional<Compiled> made = compiled(result.text, out);
      if (!made) return;
      verify::CompareRules rules = rulesFor(now);
      rules.tolerance = rules.results; // what follows is as exactly as the control computes the offset
      std::vector<verify::Difference> found =
          verify::compare(meant.record, runCode(*made, now, now.entry), rules);
      for (verify::Difference& one : found)
        one.text = fmt::format("with {} as `{}`, the system in force: {}", numberText(property->second),
                               field.name, one.text);
      add(std::move(found), made->id, out);
    }
  }

  bool uses(const TargetCase& now, const std::string& name) {
    const auto known = uses_.find(name);
    if (known != uses_.end() && known->second) return true;
    return uses_[name] = now.questions->moves(name) || now.questions->rejectsSome(name);
  }

  // Texts for numbers, halves of what chooses something, a ball without a radius, a negative overtravel.
  void runWithoutSense(const TargetCase& now, TargetRun& out) {
    const auto& hosts = now.drawn.hosts;
    right_ = fragment_.run(inputOf(now.drawn)).text;
    const auto isWhole = [](ir::Kind kind) {
      return kind == ir::Kind::WorkOffset || kind == ir::Kind::ToolOffset || kind == ir::Kind::Count;
    };
    for (const verify::DrawField& field : from_.plan.fields) {
      fusion::RunInput input = inputOf(now.drawn);
      const auto property = input.properties.find(fusion::propertyOf(prefix_, field.name));
      if (field.fixed || property == input.properties.end()) continue;
      input.noNumber = property->first;
      demandError(now, field.name, input, fmt::format("a text as `{}`", field.name), out, " is no number");
      input.noNumber.clear();
      if (isWhole(field.kind)) {
        property->second += 0.5;
        demandError(now, field.name, input, fmt::format("a half as `{}`", field.name), out,
                    " is no whole number");
      }
      if (field.kind == ir::Kind::WorkOffset && sourceSet_ != set_)
        for (const double system : {field.firstSystem - 1, field.firstSystem + 6}) {
          property->second = system;
          demandError(now, field.name, input, fmt::format("{} as `{}`", numberText(system), field.name), out);
        }
      for (const double size : kLarge)
        for (const double value : {size, -size}) {
          demandTexts(input, property->first, value, field.name, out);
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      fusion::RunInput input = inputOf(now.drawn);
      input.points.front()[axis] = kTooLong;
      demandText(input, kTooLong, std::string(1, "xyz"[axis]) + " of the point", out);
    }
    struct Input {
      const char *host, *name;
    };
    static constexpr Input kInputs[] = {{"start_x", "x"},
                                        {"start_y", "y"},
                                        {"start_z", "z"},
                                        {"tool_radius", "diameter"},
                                        {"tool_number", "number"},
                                        {"tool_offset", "lengthOffset"},
                                        {"clearance", "clearance"},
                                        {"retract", "retract"},
                                        {"overtravel", "probeOvertravel"}};
    for (const Input& one : kInputs) {
      if (from_.plan.fixedHosts.contains(one.host) || !hosts.contains(one.host)) continue;
      fusion::RunInput input = inputOf(now.drawn);
      input.noNumber = one.name;
      demandError(now, one.host, input, fmt::format("a text as {}", one.host), out, " is no number");
    }
    for (const auto& [host, member] : {std::pair("tool_number", &fusion::RunInput::toolNumber),
                                       std::pair("tool_offset", &fusion::RunInput::toolLengthOffset)}) {
      if (from_.plan.fixedHosts.contains(host) || !hosts.contains(host)) continue;
      fusion::RunInput input = inputOf(now.drawn);
      input.*member += 0.5;
      demandError(now, host, input, fmt::format("a half as {}", host), out);
    }
    runWithoutBall(now, out);
  }

  void runWithoutBall(const TargetCase& now, TargetRun& out) {
    const auto& hosts = now.drawn.hosts;
    if (hosts.contains("tool_radius") && !from_.plan.fixedHosts.contains("tool_radius")) {
      fusion::RunInput input = inputOf(now.drawn);
      input.toolDiameter = 0;
      demandError(now, "tool_radius", input, "a ball without a radius", out, " is not above 0");
    }
    if (!hosts.contains("overtravel") || from_.plan.fixedHosts.contains("overtravel")) return;
    fusion::RunInput input = inputOf(now.drawn);
    input.cycle["probeOvertravel"] = -1;
    demandError(now, "overtravel", input, "an overtravel of -1", out, " is negative");
    input.cycle["probeOvertravel"] = 0;
    const fusion::RunResult none = fragment_.run(input);
    if (!none.ok() && now.questions->with("overtravel", 0).answer == SourceQuestions::Answer::Runs)
      out.differs(verify::Aspect::Ending, "with an overtravel of 0 the source runs; " + didInstead(none));
  }

  // As with the first value of DefineData; without one an error where the field moves something.
  void runWithout(const verify::DrawField& field, const TargetCase& now, const fusion::RunResult& result,
                  TargetRun& out) {
    const std::string who = fmt::format("`{}` as its property is defined", field.name);
    if (!field.initial) {
      const bool stops = !result.fault && !result.errors.empty() && result.text.empty();
      if (!stops && now.questions->moves(field.name))
        out.differs(verify::Aspect::Ending,
                    who + ": without a default it has to be an error; " + didInstead(result));
      return;
    }
    fusion::RunInput given = inputOf(now.drawn);
    given.properties[fusion::propertyOf(prefix_, field.name)] = inJob(*field.initial);
    const fusion::RunResult meant = fragment_.run(given);
    if (meant.text == result.text && meant.errors == result.errors &&
        meant.fault.has_value() == result.fault.has_value())
      return;
    const Written one = writtenOf(meant.text), other = writtenOf(result.text);
    const auto at = std::mismatch(one.lines.begin(), one.lines.end(), other.lines.begin(), other.lines.end());
    out.differs(verify::Aspect::Variable,
                fmt::format("{} against {}, the first value of the field", who, numberText(*field.initial)),
                at.second == other.lines.end() ? "" : *at.second);
  }

  // What a fragment has posted, ready to run. nullopt: it cannot be read, and `out` says so.
  struct Compiled {
    FileId id = 0;
    std::unique_ptr<ir::ProgramFile> file;
    sim::Bytecode code;
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
    const verify::CompareRules rules = rulesFor(now);
    add(verify::compare(*now.source, record, rules), made->id, out);
    if (now.questions == nullptr || now.posted == nullptr || !out.differences.empty()) return;
    // With another work system or tool length in force than the source selects.
    for (const verify::OtherCaller& other :
         verify::otherCallers(*now.posted, control_, now.entry, now.stream)) {
      const SourceQuestions::Ran meant = now.questions->from(other.entry);
      if (meant.answer != SourceQuestions::Answer::Runs ||
          !verify::runsAlike(*now.source, meant.record, rules))
        continue;
      std::vector<verify::Difference> differences =
          verify::compare(meant.record, runCode(*made, now, other.entry), rules);
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
              verify::CompareRules own =
                  rules; // alarms that the source itself raises are printed as they are
              own.sameAlarmNumbers = own.sameAlarmNumbers || source.alarmKind.empty();
              return own;
            }),
        made->id, out);
    runShifted(*made, now, record, out);
  }

  // A local shift of Z where the fragment writes an offset along it and the source does not: what it computes
  // would hold the shift.
  void runShifted(const Compiled& made, const TargetCase& now, const verify::Record& ran, TargetRun& out) {
    if (!out.differences.empty() || !ran.ownOffsetOfZ || now.source->ownOffsetOfZ) return;
    for (const verify::BrokenCaller& caller : verify::brokenCallers(control_, true)) {
      if (caller.blocks.find('Z') == std::string::npos) continue;
      verify::Entry broken = now.entry;
      broken.blocks = caller.blocks;
      const verify::Record record = runCode(made, now, broken);
      const bool stops = record.ending == verify::Ending::Alarm && caller.alarm.starts_with(record.text) &&
                         !record.text.empty() && record.measures.empty();
      if (!stops)
        out.differs(verify::Aspect::Ending, fmt::format("printed {}: `{}` has to stop it before it measures",
                                                        caller.who, caller.alarm));
    }
  }

  verify::Record runCode(const Compiled& made, const TargetCase& now, const verify::Entry& entry,
                         verify::Stand::Way way = verify::Stand::Way::Run,
                         const verify::Interference& interference = {}) const {
    std::optional<sim::VendorMacros> meaning;
    if (set_ != nullptr) {
      meaning.emplace(*set_, control_);
      meaning->setStylusRadius(now.drawn.hosts.at("tool_radius"));
      if (sourceSet_ == set_) meaning->passUnstated();
    }
    verify::Record record =
        stand_.run(made.code, now.world, entry, now.stores, meaning ? &*meaning : nullptr, way, interference);
    // What macros do inside is their own business.
    std::erase_if(record.early, [&](const verify::EarlyUse& use) { return use.range.file != made.id; });
    return record;
  }

  verify::CompareRules rulesFor(const TargetCase& now) const {
    verify::CompareRules rules;
    rules.tolerance = rules.results = from_.options.tolerance;
    if (control_.arithmetic == stdlib::Arithmetic::Decimal8)
      rules.results = std::max(rules.tolerance, kEightDigits);
    if (sourceSet_ != set_) rules.results = std::max(rules.results, verify::kGridSteps);
    rules.sameAlarmNumbers = sourceSet_ == set_;
    const stdlib::CodeInfo* const wait = control_.find(stdlib::Function::MachineCoordinates);
    rules.waits = wait != nullptr && wait->grade != "assumed";
    if (const auto host = now.drawn.hosts.find("overtravel");
        sourceSet_ != set_ && host != now.drawn.hosts.end())
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
  const Limits limits_ = limitsOfRun(from_.session.limits());
  verify::Stand stand_;
  std::string prefix_;
  script::Runner runner_;
  fusion::Fragment fragment_{runner_};
  std::optional<ir::ProgramFile> macros_; // of the target's set, where it has a text
  SourceMap sources_;
  std::string right_;                // what it writes for the case at hand
  std::map<std::string, bool> uses_; // whether fields and host inputs are used; false may become true
};

} // namespace

std::unique_ptr<Verification> fusionVerification(const VerificationSource& source) {
  return std::make_unique<FusionVerification>(source);
}

} // namespace dotek::targets
