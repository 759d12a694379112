// Runs plain programs on a machine, for tests.
#pragma once

#include "frontend/nc/Scan.h"
#include "sim/machine/Machine.h"
#include "stdlib/DataFiles.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <string_view>

namespace dotek::tests {

struct Simulation {
  explicit Simulation(std::string_view control = "fanuc-0i-md")
      : profile(*stdlib::Control::load(stdlib::DataFiles(), control)),
        machine(std::make_unique<sim::Machine>(profile)) {}

  // Runs blocks; true where the run has not ended.
  bool run(std::string_view text) {
    LineChunks chunks(text);
    frontend::nc::Scanner scanner(chunks);
    ir::NcWords words;
    frontend::nc::Scanner::Result result;
    while ((result = scanner.next(words)) == frontend::nc::Scanner::Result::Block) {
      if (!machine->execute(words)) return false;
    }
    CAPTURE(text);
    REQUIRE(result == frontend::nc::Scanner::Result::End);
    return machine->running();
  }
  // "X Y Z" of the active work system.
  std::string at() const {
    return fmt::format("{:g} {:g} {:g}", machine->position()[0] + 0.0, machine->position()[1] + 0.0,
                       machine->position()[2] + 0.0);
  }
  std::string machineAt() const {
    const sim::Position position = machine->machinePosition();
    return fmt::format("{:g} {:g} {:g}", position[0] + 0.0, position[1] + 0.0, position[2] + 0.0);
  }
  // "alarm 11", "inconclusive G", "running", "end".
  std::string state() const {
    const sim::RunEnd& end = machine->end();
    switch (end.ending) {
    case sim::Ending::Running: return "running";
    case sim::Ending::ProgramEnd: return "end";
    case sim::Ending::TextEnd: return "text end";
    case sim::Ending::Return: return "return";
    case sim::Ending::Call: return "call";
    case sim::Ending::Limit: return "limit";
    case sim::Ending::Alarm: return fmt::format("alarm {}", end.number);
    case sim::Ending::Inconclusive:
      return end.letter == 0 ? "inconclusive" : fmt::format("inconclusive {}", end.letter);
    }
    return "";
  }

  stdlib::Control profile;
  std::unique_ptr<sim::Machine> machine;
};

} // namespace dotek::tests
