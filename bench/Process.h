// Runs a program as a process of its own: time, memory, status. What it prints goes to /dev/null.
#pragma once

#include <string>
#include <vector>

namespace bench {

using Command = std::vector<std::string>;

struct Run {
  double milliseconds = 0;
  double megabytes = 0;
  int status = 0; // -1: could not be started, or died
};

struct Figures {
  double median = 0;
  double megabytes = 0; // the largest
  int status = 0;       // of the last run
};

Run runOnce(const Command& command);
// Median of `runs` runs, after one that fills the file cache.
Figures measure(const Command& command, int runs);

} // namespace bench
