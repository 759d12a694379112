// A run of `sim` that another command listens to: `dotek flatten`.
#pragma once

#include "driver/Driver.h"
#include "ir/Program.h"
#include "project/Session.h"
#include "sim/machine/Run.h"
#include "sim/machine/RunListener.h"
#include "stdlib/Control.h"

#include <string_view>
#include <vector>

namespace dotek::driver {

class WatchedRun {
public:
  virtual ~WatchedRun() = default;
  virtual std::string_view command() const = 0; // that messages name
  // Before the run: the programs, the one that runs first, and the file of the command line. All outlive the
  // run.
  virtual void read(const stdlib::Control& control, const std::vector<const ir::Program*>& programs,
                    FileId file) = 0;
  // Gives who listens; it outlives the run.
  virtual sim::RunListener& begins(const sim::Run& run, const sim::Machine& machine) = 0;
};

// Runs the program as sim(options) does, kept as a whole; errors and findings are those of `sim`.
Outcome runWatched(const SimOptions& options, WatchedRun& watched, project::Session& session);

} // namespace dotek::driver
