// The style sheet of the report's page, embedded from verify-report.css.
#pragma once

#include <string_view>

namespace dotek::targets {

std::string_view verifyStyle();

} // namespace dotek::targets
