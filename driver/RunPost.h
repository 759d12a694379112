// Posts of Fusion that run: `run-post` and `new job`. Part of the public library, as Driver.h.
#pragma once

#include "driver/Driver.h"

#include <optional>
#include <string>

namespace dotek::driver {

// `new job` takes the post alone.
struct RunPostOptions {
  std::string post;                        // a post of Fusion
  std::optional<std::string> job;          // what it is run on; nothing: `matrix` says it
  std::string matrix;                      // "probing", "drilling"; "": a job
  std::optional<std::string> diff, expect; // another post; a program
  std::optional<bool> inch;                // nothing: as the job says
  NamedTexts properties;
  bool map = false;
  // --check: the program is linted for `control`, and with a part or a machine it runs. `name`: of its file.
  bool check = false;
  std::string control, name;
  std::optional<std::string> part, machine;
  CommonOptions common;
};

// The program that a post writes. With --diff or --expect the status is 1 where it differs, and the output
// shows how; with `check` where that finds something: the output is the program all the same.
Outcome runPost(const RunPostOptions& options);
// The beginning of a job for a post.
Outcome newJob(const RunPostOptions& options);
// A post for a lathe from a description (docs/fusion-lathe.md).
Outcome newPost(const std::string& description, const CommonOptions& common);

} // namespace dotek::driver
