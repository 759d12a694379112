// Members that every job has, as JSON for the kernel.
#pragma once

#include "posts/Json.h"
#include "posts/PostJob.h"

#include <string>

namespace dotek::posts {

// A number, true, false, or a text.
std::string jsonOfArgument(const std::string& text);
void addCommon(const JobOptions& options, JsonObject& job);

} // namespace dotek::posts
