#include "driver/Controls.h"

#include "project/CycleLowering.h"
#include "project/Job.h"
#include "project/Settings.h"
#include "support/messages/Fanuc.h"
#include "targets/Target.h"

#include <filesystem>
#include <fmt/format.h>

namespace dotek::driver {

namespace {

// "`M60` and `M61`"
std::string shown(const stdlib::ProbeCodes& codes) {
  if (codes.on.empty() && codes.off.empty()) return "no code that it names";
  if (codes.on.empty() || codes.off.empty()) return fmt::format("`{}{}` alone", codes.on, codes.off);
  return fmt::format("`{}` and `{}`", codes.on, codes.off);
}

} // namespace

void takeControls(targets::TranslationOptions& options, project::Session& session) {
  if (options.inputs.empty() || !(options.control.empty() || options.fromControl.empty())) return;
  std::error_code error;
  const std::string& first = options.inputs.front();
  const bool cycle = project::isCycleFile(first, session);
  // What is not there is neither; reading it says so.
  const bool programs = !std::filesystem::is_directory(first, error) && !cycle &&
                        (first == "-" || std::filesystem::exists(first, error));
  const targets::Target* const target = targets::findTarget(options.to);
  const bool takes = options.control.empty() &&
                     (target == nullptr || !(target->ownControls || (target->controlOfForm && !cycle)));
  const bool reads = programs && options.fromControl.empty();
  if (!takes && !reads) return;
  std::vector<std::string> inputs = options.inputs;
  if (!programs && options.source.prog) inputs = {*options.source.prog};
  const std::string control = project::controlOf(inputs, session);
  if (control.empty() || session.data().find("controls", control) == nullptr) return;
  if (reads) options.fromControl = control;
  if (takes) options.control = control;
}

void takeProbeCodes(targets::TranslationOptions& options, project::Session& session) {
  if (options.inputs.empty() || options.source.prog) return;
  project::CommonOptions& common = options.common;
  if (common.job) {
    project::Session ofJob(common); // what is wrong with the job is said where it is taken
    static_cast<void>(project::loadJob(*common.job, ofJob));
    common.probeCodes = ofJob.probeCodes();
  }
  if (!common.probeCodes.on.empty() && !common.probeCodes.off.empty())
    return session.takeProbeCodes(common.probeCodes);
  const std::string& first = options.inputs.front();
  const stdlib::ProbeCodes codes = project::settingsOf(first, session).probe;
  for (const std::string& input : options.inputs)
    if (const stdlib::ProbeCodes other = project::settingsOf(input, session).probe; other != codes) {
      session.diagnostics().report<diag::ProbeCodesDiffer>({}, first, shown(codes), input, shown(other));
      return;
    }
  common.probeCodes = stdlib::merged(common.probeCodes, codes);
  session.takeProbeCodes(common.probeCodes);
}

} // namespace dotek::driver
