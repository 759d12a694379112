#include "driver/VerifyPrograms.h"

#include "driver/VerifyTranslation.h"
#include "support/messages/Commands.h"
#include "targets/Target.h"
#include "targets/VerifyReport.h"
#include "targets/VerifyRuns.h"

namespace dotek::driver {

namespace {

class ProgramsCommand {
public:
  ProgramsCommand(const VerifyOptions& options, Session& session) : options_(options), session_(session) {}

  Outcome run() {
    if (options_.to.empty()) {
      session_.diagnostics().report<diag::MissingOption>({}, "verify", "--to TARGET",
                                                         "what the programs are compared with");
      return outcomeOf(session_, "");
    }
    ConvertOptions convert;
    convert.inputs = options_.inputs;
    convert.common = options_.common;
    convert.common.host.clear();
    convert.common.assume.erase("probe-on");
    convert.source = options_.source;
    convert.to = options_.to;
    convert.control = options_.control;
    convert.fromControl = options_.fromControl;
    convert.probeMacros = options_.probeMacros;
    convert.datum = options_.datum;
    Outcome refused;
    const auto converted = convertedFor(options_, convert, refused);
    if (!converted) return refused;
    const auto make = findTarget(options_.to)->programs;
    const std::unique_ptr<ProgramSubject> subject = make(options_, plan_);
    ProgramSubject& main = *subject;
    plan_.programs = true;
    Translation translation = translationOf(*converted);
    if (options_.translation && !takeEdited(*options_.translation, translation, session_))
      return outcomeOf(session_, "");
    plan_.translation = std::move(translation);
    if (!loadWorld(options_, plan_, session_)) return outcomeOf(session_, "");
    Session& own = main.session();
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
    const auto another = [&]() -> std::unique_ptr<CaseSubject> {
      std::unique_ptr<ProgramSubject> runner = make(options_, plan_);
      if (!runner->load() || !runner->fields()) return nullptr;
      runner->session().diagnostics() = Diagnostics();
      return runner->prepare() ? std::move(runner) : nullptr;
    };
    if (!runCases(options_, !options_.replay, main, another, report)) return outcomeOf(own, "");
    own.diagnostics() = Diagnostics();
    return outcomeOf(own, report.finish(), true);
  }

private:
  const VerifyOptions& options_;
  Session& session_;
  VerifyPlan plan_;
};

} // namespace

Outcome verifyPrograms(const VerifyOptions& options, Session& session) {
  return ProgramsCommand(options, session).run();
}

} // namespace dotek::driver
