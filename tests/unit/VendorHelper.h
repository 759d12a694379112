// Calls of a vendor's macros on a machine with a part, for tests.
#pragma once

#include "ContactWorld.h"
#include "SimHarness.h"
#include "sim/vendor/VendorMacros.h"
#include "tests/MeasuringCycles.h"

#include <cstdlib>

namespace dotek::tests {

struct VendorCase : Simulation {
  explicit VendorCase(std::string_view macros = "inspection-plus", double ball = 3,
                      std::optional<double> calibrated = 3, std::string_view control = "fanuc-0i-md")
      : Simulation(control), set(*stdlib::MacroSet::load(stdlib::DataFiles(), macros)),
        meaning(set, profile, measuringCycles()), world(ball),
        trace([this](std::string_view text) { lines += text; }) {
    if (calibrated) meaning.setStylusRadius(*calibrated);
    machine->setSkipSignal(&world);
    machine->setTrace(&trace);
  }

  // "9811 X10. S2": true where the run goes on.
  bool call(const std::string& text) {
    char* at = nullptr;
    const auto program = static_cast<std::uint32_t>(std::strtoul(text.c_str(), &at, 10));
    std::vector<double> locals(34, sim::kNull);
    while (*at != '\0') {
      if (*at == ' ') {
        ++at;
        continue;
      }
      const std::uint32_t local = stdlib::localOf(*at);
      REQUIRE(local != 0);
      locals[local] = std::strtod(at + 1, &at);
    }
    CHECK(meaning.knows(program));
    return meaning.run(*machine, program, locals);
  }
  void stand(double x, double y, double z) {
    REQUIRE(run(fmt::format("G90 G0 X{:.4f} Y{:.4f} Z{:.4f}", x, y, z)));
  }
  double variable(std::uint32_t number) {
    const auto out = machine->read(number);
    REQUIRE(out);
    REQUIRE_FALSE(sim::isNull(*out));
    return *out;
  }
  std::string text() {
    trace.flush();
    return lines;
  }

  stdlib::MacroSet set;
  sim::VendorMacros meaning;
  ContactWorld world;
  std::string lines;
  sim::Trace trace;
};

// Within a micrometre.
inline bool near(double a, double b) {
  return std::abs(a - b) < 1e-3;
}

} // namespace dotek::tests
