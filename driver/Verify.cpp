#include "support/messages/Verify.h"
#include "driver/Controls.h"
#include "driver/Driver.h"
#include "driver/VerifyCases.h"
#include "driver/VerifyCycleFile.h"
#include "driver/VerifyPrograms.h"
#include "project/CycleFolder.h"
#include "project/CycleLowering.h"
#include "project/FormChoice.h"
#include "project/Prog.h"
#include "project/Programs.h"
#include "support/Files.h"
#include "support/messages/Commands.h"
#include "targets/CycleCases.h"
#include "targets/CycleFields.h"
#include "targets/Target.h"
#include "targets/Translation.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <utility>

namespace dotek::driver {
namespace {

// What is said of the form holds for all cases; everything else that was found on the path to them is not the
// result of verify.
void keepOfForm(const Diagnostics& found, Diagnostics& kept) {
  std::set<std::string> told;
  for (const Diagnostic& one : kept.all())
    told.insert(one.message);
  for (const Diagnostic& one : found.all())
    if (isAboutForm(one.code) && told.insert(one.message).second) kept.add(one);
}

class VerifyCommand {
public:
  VerifyCommand(const VerifyOptions& options, Session& session)
      : options_(options), session_(session), target_(findTarget(options.to)), main_(options, plan_) {}

  Outcome run() {
    if (!checkOptions()) return outcomeOf(session_, "");
    if (!main_.load()) return outcomeOf(main_.session(), "");
    leaveFindingsToLint(main_.session());
    Diagnostics ofForm;
    keepOfForm(main_.session().diagnostics(), ofForm);
    if (!makePlan()) return notWritten_ ? refusalOf(main_.session()) : outcomeOf(main_.session(), "");
    keepOfForm(main_.session().diagnostics(), ofForm);
    main_.session().diagnostics() = Diagnostics();
    if (!main_.prepare()) return outcomeOf(main_.session(), "");
    VerifyReport report(options_, plan_, main_);
    addFindings(ofForm, main_.session().sources(), said_);
    report.addSaid(said_, edited_);
    const auto another = [&]() -> std::unique_ptr<CaseSubject> {
      auto runner = std::make_unique<CaseRunner>(options_, plan_);
      if (!runner->load()) return nullptr;
      runner->session().diagnostics() = Diagnostics();
      return runner->prepare() ? std::move(runner) : nullptr;
    };
    const bool edges = !options_.to.empty() && !options_.replay;
    return outcomeOfCases(options_, edges, main_, another, report, ofForm);
  }

private:
  bool checkOptions() {
    Diagnostics& diagnostics = session_.diagnostics();
    if (options_.inputs.empty())
      diagnostics.report<diag::MissingOption>({}, "verify", "INPUT",
                                              "one folder of a cycle, or one file of programs");
    else if (options_.inputs.size() > 1)
      diagnostics.report<diag::OneInput>({}, "verify", options_.inputs.size(),
                                         "`convert --verify` takes several");
    if (target_ != nullptr)
      checkTargetOptions(*target_, options_, diagnostics);
    else if (!options_.to.empty())
      diagnostics.report<diag::UnknownTarget>({}, options_.to);
    const auto none = [&]<class Message>(bool given, std::string_view flag, Message) {
      if (given) diagnostics.report<Message>({}, flag);
    };
    none(!options_.fromControl.empty(), "--from-control", diag::OptionOfPrograms{});
    if (options_.to.empty()) {
      none(options_.programNumber.has_value(), "--program-number", diag::FlagWithoutTarget{});
      if (options_.probeMacros && session_.macroSet(*options_.probeMacros) == nullptr)
        reportUnknownMacroSet(*options_.probeMacros, session_);
      none(options_.translation.has_value(), "--translation", diag::FlagWithoutTarget{});
      none(options_.useDefaults, "--defaults use", diag::FlagWithoutTarget{});
      none(options_.switchProbe, "--probe-power macro", diag::FlagWithoutTarget{});
      none(!options_.letters.empty(), "--arg", diag::FlagWithoutTarget{});
      none(!options_.datum.empty(), "--datum", diag::FlagWithoutTarget{});
    }
    if (options_.to.empty() && !options_.source.prog && !diagnostics.hasErrors())
      diagnostics.report<diag::MissingOption>({}, "verify", "--prog PROG.txt or --to TARGET",
                                              "what the cycle is compared with");
    return !diagnostics.hasErrors();
  }

  // What the job says of the first operation of this cycle: where it is. Its fields are drawn.
  void takeOperation() {
    if (!main_.inputs().job) return;
    for (const JobOperation& one : main_.inputs().job->operations) {
      if (one.cycle != main_.folder().name) continue;
      plan_.fixedHosts.insert(one.hosts.begin(), one.hosts.end());
      if (one.at.empty()) return;
      plan_.fixedHosts.emplace("start_x", one.at.front().first);
      plan_.fixedHosts.emplace("start_y", one.at.front().second);
      return;
    }
  }

  bool makePlan() {
    Session& session = main_.session();
    plan_.fixedHosts = main_.inputs().hosts;
    takeOperation();
    if (!loadWorld(options_, plan_, session)) return false;
    std::optional<LoweredCycle> lowered = main_.compilation().lower(main_.folder());
    if (!lowered && (!options_.to.empty() || !main_.inputs().program)) return false;
    if (!lowered) {
      // Not to be translated, but it prints: what can be read of it is enough to draw.
      session.diagnostics() = Diagnostics();
      std::set<std::string> used;
      lowered = lowerCycle(main_.folder(), main_.inputs(), used, session, Strictness::Lenient);
      session.diagnostics() = Diagnostics();
      plan_.findsMacros = true;
    }
    if (lowered) {
      if (lowered->macros != nullptr) plan_.sourceMacros = lowered->macros->name;
      takeFields(*lowered, main_.folder(), main_.inputs(), plan_);
    } else {
      takeDeclaredFields(main_.folder(), main_.inputs(), plan_);
    }
    if (options_.to.empty()) {
      if (options_.probeMacros) plan_.sourceMacros = *options_.probeMacros;
      return true;
    }
    return translate();
  }

  bool translate() {
    if (target_->fixesValues) return plannedForEachCase();
    // What is said on the path to the cases is not the result; what convert says of the form is.
    Session& session = main_.session();
    Diagnostics ofForm;
    keepOfForm(session.diagnostics(), ofForm);
    std::vector<VerifyDocument::Finding> said; // of the lowering, which convert does no second time
    addFindings(session.diagnostics(), session.sources(), said);
    session.diagnostics() = std::move(ofForm);
    std::optional<Translated> written = translated(options_, main_.compilation(), &main_.inputs());
    notWritten_ = !written;
    if (!written) return false;
    const std::string text = written->translation.text;
    if (options_.translation && !takeEdited(*options_.translation, written->translation, session))
      return false;
    edited_ = written->translation.text != text;
    // What convert says of its own text does not hold of one that was edited.
    if (!edited_) {
      said_ = options_.converted == nullptr ? std::move(said) : std::vector<VerifyDocument::Finding>();
      for (VerifyDocument::Finding& one : written->said)
        if (std::find(said_.begin(), said_.end(), one) == said_.end()) said_.push_back(std::move(one));
    }
    plan_.targetMacros = std::move(written->macros);
    const bool callsMacros = std::find(target_->flags.begin(), target_->flags.end(),
                                       TargetFlag::ProbeMacros) != target_->flags.end();
    const LoweringInputs& inputs = main_.inputs();
    const bool same = plan_.targetMacros == plan_.sourceMacros &&
                      session.macroSet(plan_.sourceMacros, &*inputs.sourceControl) ==
                          session.macroSet(plan_.targetMacros, inputs.control ? &*inputs.control : nullptr);
    if (!callsMacros || !same) keepToSixSystems();
    plan_.translation = std::move(written->translation);
    return true;
  }

  // Numbers of G54.1 Pn have a meaning in the source's own set alone.
  void keepToSixSystems() {
    for (verify::DrawField& field : plan_.fields)
      if (!field.extendedAlone) field.extended.clear();
  }

  // A program without arguments is written for each case, or edited for one.
  bool plannedForEachCase() {
    keepToSixSystems();
    Translation translation;
    translation.name = main_.folder().name;
    if (options_.translation) {
      Session& session = main_.session();
      const auto bytes = readBytes(*options_.translation, session.limits(), session.diagnostics());
      if (!bytes) return false;
      translation.name = *options_.translation;
      translation.text = *bytes;
      for (const verify::DrawField& field : plan_.fields)
        if (!field.fixed) session.diagnostics().report<diag::EditedNeedsValues>({}, "--set " + field.name);
      for (const std::string_view host : target_->hosts)
        if (!plan_.fixedHosts.contains(std::string(host)))
          session.diagnostics().report<diag::EditedNeedsValues>({}, fmt::format("--host {}", host));
      if (session.diagnostics().hasErrors()) return false;
      const std::string written = writtenNow();
      edited_ = written != *bytes;
      if (edited_) translation.converted = written;
    }
    plan_.translation = std::move(translation);
    return true;
  }

  // What convert writes for the values that are given; "" where it refuses them.
  std::string writtenNow() {
    Diagnostics& diagnostics = main_.session().diagnostics();
    const Diagnostics before = std::exchange(diagnostics, Diagnostics());
    const std::optional<Translated> written = translated(options_, main_.compilation(), &main_.inputs());
    diagnostics = before;
    return written ? written->translation.text : std::string();
  }

  const VerifyOptions& options_;
  Session& session_;
  const Target* const target_; // nullptr: none is named
  VerifyPlan plan_;
  CaseRunner main_;
  bool notWritten_ = false; // the conversion is refused
  bool edited_ = false;     // by --translation
  std::vector<VerifyDocument::Finding> said_;
};

} // namespace

Outcome verify(const VerifyOptions& given) {
  return guarded(given.common, given.inputs, [&](Session& session) {
    VerifyOptions options = given;
    takeControls(options, session);
    takeProbeCodes(options, session);
    if (session.diagnostics().hasErrors()) return outcomeOf(session, "");
    if (options.inputs.size() == 1 && isCycleFile(options.inputs.front(), session))
      return verifyCycleFile(options, session);
    const bool programs = options.inputs.size() == 1 && isProgramFile(options.inputs.front(), session);
    if (session.diagnostics().hasErrors()) return outcomeOf(session, "");
    return programs ? verifyPrograms(options, session) : VerifyCommand(options, session).run();
  });
}

} // namespace dotek::driver
