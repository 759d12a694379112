#include "driver/Controls.h"

#include "project/CycleLowering.h"
#include "project/Settings.h"
#include "targets/Target.h"

#include <filesystem>

namespace dotek::driver {

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

} // namespace dotek::driver
