// What a device (--device) does to the run: it sees what the program writes, and shifts the probe by the
// errors of the machine.
#include "sim/run/SimWorld.h"
#include "support/messages/Device.h"

#include <utility>

namespace dotek::sim {

void SimWorld::setDevice(Device* device) {
  device_ = device;
  if (device == nullptr) return;
  device->setTouching([this] { return machineNow_ != nullptr && world_ && isTouching(); });
  device->setReport([this](std::string what, std::string then, bool fault) {
    const RunPlace place = place_();
    if (fault)
      session_.diagnostics().report<diag::DeviceFault>(place.range, what, then);
    else
      session_.diagnostics().report<diag::DeviceBeyondTable>(place.range, what, then);
  });
}

bool SimWorld::isTouching() {
  SkipMove here;
  here.machineFrom = here.machineTo = machineNow_->machinePosition();
  return isThere(here);
}

void SimWorld::dwelled(double seconds) {
  if (device_ != nullptr) device_->dwelled(seconds);
}

void SimWorld::systemWritten(std::uint32_t variable, double value) {
  if (device_ != nullptr) device_->written(variable, value);
}

std::optional<double> SimWorld::systemRead(std::uint32_t variable) {
  return device_ == nullptr ? std::nullopt : device_->read(variable);
}

SkipMove SimWorld::shifted(const SkipMove& move) const {
  if (device_ == nullptr) return move;
  SkipMove out = move;
  const Position from = device_->shiftAt(move.machineFrom), to = device_->shiftAt(move.machineTo);
  for (std::size_t i = 0; i < kAxes; ++i) {
    out.machineFrom[i] += from[i];
    out.machineTo[i] += to[i];
  }
  return out;
}

MachineMotion SimWorld::shifted(const MachineMotion& motion) const {
  if (device_ == nullptr) return motion;
  MachineMotion out = motion;
  const Position from = device_->shiftAt(motion.from), to = device_->shiftAt(motion.to);
  for (std::size_t i = 0; i < kAxes; ++i) {
    out.from[i] += from[i];
    out.to[i] += to[i];
  }
  return out;
}

} // namespace dotek::sim
