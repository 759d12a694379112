// What `verify` says of a program with a fault, and what the program does then.
#pragma once

#include "driver/Driver.h"
#include "tests/unit/FaultOperators.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace dotek::tests {

inline constexpr const char* kFaultSets[] = {"easyprobe", "inspection-plus", "dotek"};

// Of one run of verify: what the translation did in each case.
struct Told {
  int status = 0;
  std::map<std::uint64_t, std::size_t> traces; // hashes
  std::set<std::uint64_t> agreeing;
  std::string messages;
};

// What a machine did: without actions that change nothing, which a trace may tell: a move to where it is,
// the same once more. A hash.
std::size_t deedsOf(const std::string& trace);

Told toldBy(driver::VerifyOptions options);

// What the operators look for in a program that calls macros of any set.
FaultWords faultWordsOf(const std::string& program);

} // namespace dotek::tests
