// The parts of the page that are in files of their own, embedded at build: picture.html with @MARKS@, its
// style and its scripts.
#pragma once

#include <string_view>

namespace dotek::sim {

std::string_view pageFrame();
std::string_view pageStyle();
std::string_view pageView();
std::string_view pageScript();

} // namespace dotek::sim
