// Something outside of the control beyond its signals and its window into the memory of the PMC. A watcher of
// the machine (MotionWatcher.h) that is one, too, is asked.
#pragma once

#include <cstdint>
#include <optional>

namespace dotek::sim {

class SystemWatcher {
public:
  virtual ~SystemWatcher() = default;
  // The program has set a signal, or written beyond the window.
  virtual void systemWritten(std::uint32_t variable, double value) = 0;
  // What is put there from outside; nothing: what the program has written counts.
  virtual std::optional<double> systemRead(std::uint32_t variable) = 0;
};

} // namespace dotek::sim
