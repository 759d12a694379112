// Private to script: what Runner and serve() say to each other. Each frame is texts (support/Worker.h).
#pragma once

#include <string_view>

namespace dotek::script {

// Before anything else: kHello and the version.
inline constexpr std::string_view kHello = "dotek runs scripts";
// kLoad, seconds, megabytes, bytes of output, then name and text of each source. kRun, the argument.
inline constexpr std::string_view kLoad = "load", kRun = "run";
// kValue and the texts; kThrown, text, source and line; or what ran out, kMemory, kTime or kOutput, alone.
inline constexpr std::string_view kValue = "value", kThrown = "thrown", kMemory = "memory", kTime = "time",
                                  kOutput = "output", kNoRoom = "no room";

// Exit statuses of a worker that cannot answer.
inline constexpr int kEngineGaveUp = 70, kNoMemory = 71;

} // namespace dotek::script
