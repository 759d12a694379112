// The double of the post kernel, Kernel.js, embedded at build.
#pragma once

#include <string_view>

namespace dotek::backends::fusion {

std::string_view kernelText();

} // namespace dotek::backends::fusion
