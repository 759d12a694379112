// The job that a `.cnc` file holds.
#pragma once

#include "posts/CncCycle.h"
#include "posts/PostJob.h"

#include <string>
#include <string_view>
#include <variant>

namespace dotek::posts {

// What the kernel runs, as JSON.
std::variant<std::string, cnc::Fault> cncJob(const cnc::File& file, const JobOptions& options,
                                             const cnc::HoleCycles& holes);
// nullopt: reported.
std::optional<PostJob> readCncJob(const std::string& path, std::string_view bytes, const JobOptions& options,
                                  project::Session& session);

} // namespace dotek::posts
