// A device that runs beside the machine: it sees what the program writes, dwells and moves, and shifts what
// the probe touches.
#pragma once

#include "sim/device/DeviceFile.h"
#include "sim/machine/Machine.h"
#include "sim/machine/MacroMeaning.h"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::sim {

// A touch, as the report needs it.
struct DeviceTouch {
  double position = 0;        // along the axis of the error
  std::vector<double> values; // of the device
  double at = 0;              // of the machine, along the axis of the error
  double error = 0;           // that the device added
};

class Device final : public MacroMeaning {
public:
  // What the machine's control is extended by, with `file`, outlives the device. `next`: the macros that
  // other calls mean; nullptr: none.
  Device(const DeviceFile& file, const stdlib::Control& control);
  void setNext(MacroMeaning* next) { next_ = next; }
  // Takes what happened, and what the device does then. `fault`: of the program; else the file does not say
  // enough.
  using Report = std::function<void(std::string what, std::string then, bool fault)>;
  void setReport(Report report) { report_ = std::move(report); }
  // Whether the probe touches something now.
  void setTouching(std::function<bool()> touching) { touching_ = std::move(touching); }

  // ---- calls by code
  bool knows(std::uint32_t program) const override;
  bool run(Machine& machine, std::uint32_t program, std::span<const double> locals) override;

  // ---- what the machine does
  void written(std::uint32_t variable, double value);
  // What the device puts there; nothing: what the program has written.
  std::optional<double> read(std::uint32_t variable);
  void dwelled(double seconds);
  void moved(const Position& from, const Position& to); // of the machine
  // What the position of the probe differs by from where the machine is.
  Position shiftAt(const Position& machine);
  void touchBegins(); // a skip move: draws its noise, looks whether all values have settled
  void touched(const Position& machine);

  const DeviceFile& file() const { return file_; }
  const std::vector<double>& values() const { return values_; }
  const std::vector<DeviceTouch>& touches() const { return touches_; }
  // Rows of a table that were taken over: by index, then column.
  const std::map<std::uint32_t, std::vector<double>>& rows(std::size_t table) const { return rows_[table]; }
  // What a rule gives at a position; nothing: its table is empty.
  std::optional<double> ruled(const DeviceRule& rule, double position) const;
  double limited(std::size_t value, double wanted) const;

private:
  bool apply(const DeviceCall& call, std::span<const double> locals, Machine& machine);
  std::uint32_t bytesAt(const DeviceCell& cell) const;
  double cell(const DeviceCell& cell) const;
  bool isOf(const DeviceCell& cell, std::uint32_t variable, std::uint32_t address, std::uint32_t bytes) const;
  void strobe(std::size_t table);
  void say(std::string what, std::string then, bool fault = true);
  double noise(double deviation);
  bool moves(DeviceMoving moving, std::size_t axis) const;

  const DeviceFile& file_;
  std::optional<stdlib::PmcWindow> window_;
  MacroMeaning* next_ = nullptr;
  Report report_;
  std::function<bool()> touching_;
  std::map<std::uint32_t, std::uint8_t> memory_; // beyond the window
  std::map<std::uint32_t, double> variables_;
  double address_ = -1;
  std::vector<double> values_;
  std::vector<double> settles_; // seconds that each value still needs
  std::vector<std::string> setBy_;
  std::vector<std::map<std::uint32_t, std::vector<double>>> rows_;
  std::vector<bool> strobed_;
  std::vector<double> sinceData_; // seconds of dwell since the data of a table changed
  std::array<double, kAxes> direction_{};
  std::uint64_t draws_ = 0;
  double noise_ = 0;
  std::vector<DeviceTouch> touches_;
  std::map<std::string, std::uint32_t> said_;
};

} // namespace dotek::sim
