#include "driver/VerifyCycleFile.h"

#include "driver/VerifyCases.h"
#include "support/messages/CamFolder.h"
#include "support/messages/Commands.h"
#include "support/messages/Cycle.h"
#include "support/messages/Verify.h"
#include "targets/CycleFileCases.h"
#include "targets/Target.h"
#include "targets/Translation.h"

#include <filesystem>
#include <memory>

namespace dotek::driver {

namespace {

class CycleFileCommand {
public:
  CycleFileCommand(const VerifyOptions& options, Session& session)
      : options_(options), session_(session), main_(options, plan_) {}

  Outcome run() {
    if (!checkOptions()) return outcomeOf(session_, "");
    plan_.cycleFile = true;
    Session& own = main_.session();
    if (!main_.load()) return outcomeOf(own, "");
    plan_.fields = main_.fields();
    plan_.fixedHosts = main_.inputs().hosts;
    plan_.bounds = std::make_shared<verify::Bounds>(main_.cycle());
    if (!loadWorld(options_, plan_, own)) return outcomeOf(own, "");
    own.diagnostics() = Diagnostics();
    const Target* const target = findTarget(options_.to);
    // A program without arguments is written for each case.
    std::optional<Translated> written;
    if (target->fixesValues)
      written.emplace().translation.name = main_.cycle().name;
    else
      written = translated(options_, main_.compilation(), &main_.inputs());
    if (!written) return refusalOf(own);
    const std::string text = written->translation.text;
    if (options_.translation && !takeEdited(*options_.translation, written->translation, own))
      return outcomeOf(own, "");
    const bool edited = written->translation.text != text;
    if (edited) written->said.clear(); // is of the text that convert would write
    plan_.targetMacros = std::move(written->macros);
    plan_.translation = std::move(written->translation);
    own.diagnostics() = Diagnostics();
    if (!main_.prepare()) return outcomeOf(own, "");
    VerifyReport report(options_, plan_, main_);
    report.addSaid(std::move(written->said), edited);
    const auto another = [&]() -> std::unique_ptr<CaseSubject> {
      auto runner = std::make_unique<CycleFileRunner>(options_, plan_);
      if (!runner->load()) return nullptr;
      runner->session().diagnostics() = Diagnostics();
      return runner->prepare() ? std::move(runner) : nullptr;
    };
    return outcomeOfCases(options_, !options_.replay, main_, another, report);
  }

private:
  bool checkOptions() {
    Diagnostics& diagnostics = session_.diagnostics();
    const Target* const target = checkedTarget(convertOptionsOf(options_), false, true, "verify",
                                               "what the cycle is compared with", diagnostics);
    if (target != nullptr && !target->takesCycleFiles)
      diagnostics.report<diag::CycleTarget>({}, options_.inputs.front());
    if (!options_.variables.empty()) diagnostics.report<diag::OptionOfPrograms>({}, "--var");
    return !diagnostics.hasErrors();
  }

  const VerifyOptions& options_;
  Session& session_;
  VerifyPlan plan_;
  CycleFileRunner main_;
};

} // namespace

Outcome verifyCycleFile(const VerifyOptions& options, Session& session) {
  return CycleFileCommand(options, session).run();
}

} // namespace dotek::driver
