// Every limit of Dotek, in one place. Each is a flag: `--limit NAME=N`; `dotek list limits` prints them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace dotek {

// X(member, name, default, what it bounds)
#define DOTEK_LIMITS(X)                                                                                      \
  X(keptBytes, "kept-bytes", 1u << 30, "memory that the text of one input and its tree may take, in bytes")  \
  X(lineBytes, "line-bytes", 16384, "length of one line of a macro, a dialog or a Prog, in bytes")           \
  X(lineTokens, "line-tokens", 1000, "tokens on one line of a macro, a dialog or a Prog")                    \
  X(nesting, "nesting", 64, "depth of brackets and of IF and FOR blocks")                                    \
  X(includeDepth, "include-depth", 16, "depth of #INCLUDE")                                                  \
  X(callDepth, "call-depth", 32, "depth of macro and routine calls when a program is run")                   \
  X(steps, "steps", 1000000, "statements that one run may execute")                                          \
  X(simSteps, "sim-steps", 50000000,                                                                         \
    "jumps and loop passes of one run of an NC program; a block or a call counts 10")                        \
  X(paths, "paths", 1024, "paths that the checks of a cycle may take while a host input is unknown")         \
  X(outputBytes, "output-bytes", 64u << 20, "size of one result, in bytes")                                  \
  X(textLength, "text-length", 1000, "characters of a text variable of a GibbsCAM macro")                    \
  X(files, "files", 10000, "files that one command may read")                                                \
  X(scriptSeconds, "script-seconds", 3,                                                                      \
    "processor time of the runs of a script, in seconds, beside 20 ms a run")                                \
  X(scriptMemory, "script-memory", 64, "memory of a script, in MB")                                          \
  X(scriptOutput, "script-output", 1u << 20, "text that one run of a script may write, in bytes")

struct Limits {
#define DOTEK_LIMIT_MEMBER(member, name, value, what) std::uint32_t member = value;
  DOTEK_LIMITS(DOTEK_LIMIT_MEMBER)
#undef DOTEK_LIMIT_MEMBER
};

struct LimitInfo {
  std::string_view name;
  std::uint32_t Limits::*member;
  std::string_view what;
};

// All limits, in the order of the table above.
std::span<const LimitInfo> limitTable();

} // namespace dotek
