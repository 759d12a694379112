// Members that every job has, as JSON for the kernel.
#pragma once

#include "posts/Json.h"
#include "posts/PostJob.h"
#include "stdlib/Toml.h"

#include <string>

namespace dotek::posts {

// A number, true, false, or a text.
std::string jsonOfArgument(const std::string& text);
void addCommon(const JobOptions& options, JsonObject& job);
// An operation of a job in TOML.
std::string sectionOf(const stdlib::TomlDocument& document, const stdlib::TomlTable& table);

} // namespace dotek::posts
