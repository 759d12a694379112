// A device beside the control, as data: what codes and variables do there, what its logic takes over and
// sets, and which error the machine has. docs/device.md explains each key.
#pragma once

#include "sim/device/ErrorTable.h"
#include "stdlib/Control.h"
#include "support/Diagnostics.h"
#include "support/Files.h"
#include "support/Limits.h"
#include "support/Source.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dotek::sim {

// A place of the device's memory that a program reaches: bytes beyond the control's window, or a system
// variable.
struct DeviceCell {
  std::uint32_t variable = 0; // 0: beyond the window
  std::uint32_t address = 0;
  std::uint32_t bytes = 1;
  std::optional<std::uint32_t> bit; // of the byte
};

// A value that the device applies: a voltage, a pressure.
struct DeviceValue {
  std::string name, title, unit;
  double initial = 0;
  double perUnit = 0;                             // counts of its output; 0: any value
  std::optional<std::pair<double, double>> range; // of counts, or of the value itself; beyond it: its end
};

// What a code of the program does.
struct DeviceCall {
  stdlib::CallCode code;
  std::vector<std::pair<std::uint32_t, std::size_t>> sets; // local variable of the call, and value
  std::vector<std::pair<std::uint32_t, double>> when;      // locals that have to hold this
  double settle = 0;                                       // seconds of dwell until the value holds
  std::string name;                                        // "G5101"
};

// Rows that the device takes over from its memory when a strobe comes.
struct DeviceTable {
  struct Column {
    std::string name;
    DeviceCell cell;
    double scale = 1; // value of a count
  };
  std::string name;
  DeviceCell strobe, index;
  double strobeValue = 1;
  std::uint32_t first = 1, last = 1; // index of its rows
  double hold = 0;                   // seconds that the data have to be there before the strobe
  std::vector<Column> columns;
};

// Where the machine is along an axis, counted from `zero` (a coordinate of the machine).
struct DeviceAxis {
  std::size_t axis = 2;
  double zero = 0;
};
enum class DeviceMoving : std::uint8_t { Any, Plus, Minus }; // direction of the last move along the axis

// What the device sets by itself: a value that it finds by a table, linear from row to row.
struct DeviceRule {
  std::size_t value = 0;
  std::size_t table = 0;
  std::size_t start = 0, slope = 0; // columns: the value at the row's position, and by how much it grows
  DeviceAxis along;
  double from = 0, step = 1; // position of the first row, and to the next
  DeviceMoving moving = DeviceMoving::Any;
};

// What a touch reads too much along `axis`.
struct DeviceError {
  std::size_t axis = 1;
  DeviceAxis along;
  DeviceMoving moving = DeviceMoving::Any;
  std::optional<std::size_t> value; // the second variable of the table
  ErrorTable table;
  double noise = 0; // standard deviation, mm
};

struct DeviceSignal {
  DeviceCell cell;
  bool touching = true; // of the probe
};

// What the report shows of the run.
struct DeviceReportPlan {
  struct Column {
    std::string title;
    std::uint32_t first = 0, step = 1; // variable of the first row, and to the next
    std::vector<double> expected;      // by row; empty: nothing to compare with
    std::string source;                // of what is expected
  };
  struct Table {
    std::string title, note;
    std::uint32_t rows = 0;
    double from = 0, each = 1; // position of the first row, and to the next
    std::vector<Column> columns;
  };
  std::vector<Table> tables;
  std::vector<std::string> notes;
  double from = 0, to = 0, step = 0; // where the errors are compared; step 0: nowhere
  double limit = 0, tolerance = 0;   // mm
};

struct DeviceFile {
  std::string title;
  std::optional<stdlib::PmcWindow> window; // instead of the control's own
  std::vector<DeviceValue> values;
  std::vector<DeviceCall> calls;
  std::vector<DeviceTable> tables;
  std::vector<DeviceRule> rules;
  std::vector<DeviceError> errors;
  std::vector<DeviceSignal> signals;
  DeviceReportPlan report;
  std::uint64_t seed = 1; // of the noise
  // The control with what the file adds: codes, a window.
  void extend(stdlib::Control& control);
  bool usesWindow() const; // one of its cells is beyond it
};

// nullopt: reported. Tables are looked for from the folder of the file on, and read where `bounds` allow it.
std::optional<DeviceFile> loadDevice(const std::string& path, const Limits& limits, const ReadBounds& bounds,
                                     SourceMap& sources, Diagnostics& diagnostics);

} // namespace dotek::sim
