// Test cases over several processes: the working directory, caches and a crash are a process's own.
#pragma once

#include <functional>
#include <string>

namespace dotek::tests {

// What the last lines of a run count.
struct Totals {
  unsigned ran = 0;
  unsigned failed = 0;
  int goldens = 0;
  int rewritten = 0;
  int corpusRun = 0;
  int corpusSkipped = 0;
  int skipped = 0;

  Totals& operator+=(const Totals& other);
};

// Runs `one` for each of 0 to count-1, in `jobs` child processes that take the next one when they are done
// with one. What a child prints comes out in one piece, case by case. A child that dies (a signal, a
// sanitizer) counts as the failure of its case, which `name` tells; another child goes on.
Totals runInProcesses(unsigned jobs, unsigned count, const std::function<Totals(unsigned)>& one,
                      const std::function<std::string(unsigned)>& name);

} // namespace dotek::tests
