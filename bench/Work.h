// Work of a process as a number that does not depend on what else the machine does.
#pragma once

#include "bench/Process.h"

#include <string>

namespace bench {

// What is counted, the best first:
//   Instructions  of the processor's counter (perf_event_open): exact, costs nothing; refused in most
//   containers
//                 and virtual machines
//   Valgrind      instructions as valgrind's cachegrind counts them: as exact, and everywhere; 20 times as
//   slow Time          user and system time, the least of three runs: everywhere, but 5 to 20 % of noise
enum class Counter { Instructions, Valgrind, Time };

// The best that this machine allows.
Counter bestCounter();
// "instructions", ...
std::string name(Counter counter);

struct Work {
  double amount = 0;    // instructions, or microseconds of processor time
  double megabytes = 0; // largest resident set
  double heap = 0;      // the most bytes of the heap that were in use at once; 0 where they were not counted
  int status = 0;       // as Run
};

// One run in `folder`; a run of more than `seconds` of processor time is killed: status -1.
Work workOf(const Command& command, const std::string& folder, Counter counter, int seconds);
// A run more that counts the heap (bench/Heap.cpp), in bytes; 0 where it cannot be counted.
double heapOf(const Command& command, const std::string& folder, int seconds);

} // namespace bench
