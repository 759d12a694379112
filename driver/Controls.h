// Private to driver: the control and the probe codes of a command that names none.
#pragma once

#include "project/Session.h"
#include "targets/Options.h"

namespace dotek::driver {

// What dotek.toml says of the inputs: programs are read by the rules of its control, and what is written is
// for it, unless the target has controls of its own. A flag comes before it.
void takeControls(targets::TranslationOptions& options, project::Session& session);

// Codes that switch the probe, for programs, cycle files and folders without a Prog: flags, the job, then the
// dotek.toml of the inputs. What is read with a Prog takes those of its folder by itself.
void takeProbeCodes(targets::TranslationOptions& options, project::Session& session);

} // namespace dotek::driver
