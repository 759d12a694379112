// `new post`: a post of Fusion for a lathe with a control by Mikronex, from the control's profile and a short
// description (docs/fusion-lathe.md).
#pragma once

#include "project/Session.h"

#include <optional>
#include <string>

namespace dotek::posts {

// nullopt: reported.
std::optional<std::string> newLathePost(const std::string& description, project::Session& session);

} // namespace dotek::posts
