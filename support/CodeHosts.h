// Findings in the forms of code hosts.
#pragma once

#include "support/Diagnostics.h"

#include <string>

namespace dotek {

// Workflow commands of GitHub Actions, a line for each finding: `::error file=..,line=..::message`.
std::string renderGithub(const Diagnostics& diagnostics, const SourceMap& sources);

// Code quality report of GitLab: a JSON array.
std::string renderGitlab(const Diagnostics& diagnostics, const SourceMap& sources);

} // namespace dotek
