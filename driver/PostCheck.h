// `run-post --check`: lint and a run of what a post has written. Private to driver.
#pragma once

#include "driver/RunPost.h"
#include "posts/PostRun.h"
#include "project/Session.h"

#include <string>

namespace dotek::driver {

struct CheckedPost {
  bool fails = false;
  std::string summary; // what the run measured; "": it did not run, or measured nothing
};

// Findings go to the session: their places are in the program, with the line of the post that wrote each.
CheckedPost checkPosted(const RunPostOptions& options, const posts::PostResult& result,
                        const posts::PostRunner& runner, project::Session& session);

} // namespace dotek::driver
