#include "driver/VerifyPrograms.h"

#include "driver/VerifyCases.h"
#include "support/messages/Commands.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Mikroprog.h"
#include "targets/Conversion.h"
#include "targets/Target.h"
#include "targets/Translation.h"

namespace dotek::driver {

namespace {

class ProgramsCommand {
public:
  ProgramsCommand(const VerifyOptions& options, Session& session) : options_(options), session_(session) {}

  Outcome run() {
    const Target* const target = checkOptions();
    if (session_.diagnostics().hasErrors()) return outcomeOf(session_, "");
    const auto make = target->programs;
    const std::unique_ptr<ProgramSubject> subject = make(options_, plan_);
    ProgramSubject& main = *subject;
    plan_.programs = true;
    Session& own = main.session();
    Compilation compilation(own);
    std::optional<Translated> written = translated(options_, compilation, nullptr);
    if (!written) return refusalOf(own);
    const std::string text = written->translation.text;
    if (options_.translation && !takeEdited(*options_.translation, written->translation, session_))
      return outcomeOf(session_, "");
    const bool edited = written->translation.text != text;
    if (edited) written->said.clear(); // is of the text that convert would write
    plan_.translation = std::move(written->translation);
    if (!loadWorld(options_, plan_, session_)) return outcomeOf(session_, "");
    own.diagnostics() = Diagnostics();
    if (!main.load()) return outcomeOf(own, "");
    auto fields = main.fields();
    if (!fields) return outcomeOf(own, "");
    plan_.fields = std::move(*fields);
    plan_.fixedHosts = main.hosts();
    plan_.sourceMacros = main.sourceMacros();
    plan_.targetMacros = main.targetMacros();
    own.diagnostics() = Diagnostics();
    if (!main.prepare()) return outcomeOf(own, "");
    VerifyReport report(options_, plan_, main);
    report.addSaid(std::move(written->said), edited);
    const auto another = [&]() -> std::unique_ptr<CaseSubject> {
      std::unique_ptr<ProgramSubject> runner = make(options_, plan_);
      if (!runner->load() || !runner->fields()) return nullptr;
      runner->session().diagnostics() = Diagnostics();
      return runner->prepare() ? std::move(runner) : nullptr;
    };
    return outcomeOfCases(options_, !options_.replay, main, another, report);
  }

private:
  const Target* checkOptions() {
    ConvertOptions convert = convertOptionsOf(options_);
    convert.common.host.clear(); // the cases take them
    convert.common.assume.erase("probe-on");
    const Target* const target = checkedTarget(convert, true, false, "verify",
                                               "what the programs are compared with", session_.diagnostics());
    if (target == nullptr || target->programs != nullptr || !target->writesPrograms) return target;
    if (target->fixesValues)
      session_.diagnostics().report<diag::MikroprogCannot>(
          {},
          "a program for Mikroprog has one run, whose values are fixed, so there is nothing to vary and "
          "compare",
          "run source and result by `dotek sim --trace FILE` and compare the traces (docs/mikroprog.md)");
    else
      session_.diagnostics().report<diag::ProgramTarget>({}, options_.to);
    return target;
  }

  const VerifyOptions& options_;
  Session& session_;
  VerifyPlan plan_;
};

} // namespace

Outcome verifyPrograms(const VerifyOptions& options, Session& session) {
  return ProgramsCommand(options, session).run();
}

} // namespace dotek::driver
