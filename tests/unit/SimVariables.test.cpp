// Variables of the machine: reference 1.3 and 1.10.
#include "SimHarness.h"
#include "stdlib/VariableNumbers.h"

#include <cstring>

using namespace dotek;
using sim::isNull;
using tests::Simulation;

TEST_CASE("sim variables: null is neither zero nor another NaN") {
  CHECK(isNull(sim::kNull));
  CHECK_FALSE(isNull(0));
  const double zero = 0;
  CHECK_FALSE(isNull(zero / zero));
  Simulation s;
  for (const std::uint32_t number : {0u, 1u, 33u, 100u, 199u, 500u, 999u}) {
    CAPTURE(number);
    CHECK(isNull(*s.machine->read(number)));
  }
  CHECK(s.machine->write(500, 1.5));
  CHECK(s.machine->read(500) == 1.5);
  CHECK(s.machine->write(500, sim::kNull));
  CHECK(isNull(*s.machine->read(500)));
}

TEST_CASE("sim variables: alarms 115 and 116 (reference 1.11)") {
  const auto reading = [](std::uint32_t number) {
    Simulation s;
    s.machine->read(number);
    return s.state();
  };
  const auto writing = [](std::uint32_t number) {
    Simulation s;
    s.machine->write(number, 1);
    return s.state();
  };
  CHECK(reading(34) == "alarm 115");
  CHECK(reading(200) == "alarm 115");
  CHECK(writing(499) == "alarm 115");
  CHECK(writing(0) == "alarm 116");
  CHECK(writing(4001) == "alarm 116");
  CHECK(writing(4109) == "alarm 116");
  CHECK(writing(5001) == "alarm 116");
  CHECK(writing(5021) == "alarm 116");
  CHECK(writing(5061) == "alarm 116");
  CHECK(reading(3901) == "inconclusive");
  CHECK(writing(3000) == "inconclusive"); // takes a message: raise()
  CHECK(reading(100000) == "inconclusive");
  CHECK(writing(2001) == "running");
  CHECK(writing(5221) == "running");
}

TEST_CASE("sim variables: the checks know what stops with alarm 116") {
  for (const char* control : {"fanuc-0i-md", "fanuc-31i-b", "fanuc-6m", "haas-ngc"}) {
    CAPTURE(control);
    const Simulation judged(control);
    for (std::uint32_t number = 1000; number < 20000; ++number) {
      // What is not named the check system-variable-unknown reports.
      if (!stdlib::namesVariable(judged.profile, number)) continue;
      static constexpr std::uint32_t kOfOne = 100; // a machine is slow to build: one for many that it takes
      static std::unique_ptr<Simulation> s;
      if (s == nullptr || number % kOfOne == 0 || !s->machine->running() || s->profile.name != control)
        s = std::make_unique<Simulation>(control);
      s->machine->write(number, 1);
      CAPTURE(number);
      CHECK((s->state() != "alarm 116" || stdlib::isReadAlone(s->profile, number)));
    }
  }
}

TEST_CASE("sim variables: modal state (#4001 to #4022, #4102 to #4120)") {
  Simulation s;
  CHECK(s.machine->read(4001) == 0);
  CHECK(s.machine->read(4002) == 17);
  CHECK(s.machine->read(4003) == 90);
  CHECK(s.machine->read(4006) == 21);
  CHECK(s.machine->read(4014) == 54);
  s.run("O77\nN30 G1 G91 G56 G18 X1. F250 S1200 T5 M3");
  CHECK(s.machine->read(4001) == 1);
  CHECK(s.machine->read(4002) == 18);
  CHECK(s.machine->read(4003) == 91);
  CHECK(s.machine->read(4014) == 56);
  CHECK(s.machine->read(4109) == 250);
  CHECK(s.machine->read(4113) == 3);
  CHECK(s.machine->read(4114) == 30);
  CHECK(s.machine->read(4115) == 77);
  CHECK(s.machine->read(4119) == 1200);
  CHECK(s.machine->read(4120) == 5);
  s.run("N40 X2.");
  CHECK(s.machine->read(4114) == 40);
}

TEST_CASE(
    "sim variables: offsets of the 6M are in steps of systems and axes (#2503=#2501+204.5 is X of G56)") {
  Simulation s("fanuc-6m");
  s.machine->write(2501, 10);
  s.machine->write(2503, 214.5);
  s.machine->write(2703, -3);
  s.machine->write(2600, 1); // external Y
  s.run("G56 G0 X0. Y0. Z0.");
  CHECK(s.machineAt() == "214.5 1 -3");
  CHECK(s.machine->read(2503) == 214.5);
  CHECK(s.machine->read(2600) == 1);
  CHECK(s.machine->read(2506) == 0);
  s.machine->write(2007, 4);
  CHECK(s.machine->read(2007) == 4);
  CHECK(s.machine->read(2000) == 0); // T6M: #2000 reads 0
  s.machine->read(5061);
  CHECK(s.state() == "inconclusive"); // no skip position is listed
}

TEST_CASE("sim variables: positions") {
  Simulation s;
  s.machine->write(5222, 100);
  s.run("G0 X1. Y2. A5.");
  CHECK(s.machine->read(5001) == 1);
  CHECK(s.machine->read(5002) == 2);
  CHECK(s.machine->read(5022) == 102);
  CHECK(s.machine->read(5042) == 2);
  CHECK(s.machine->read(5004) == 5);
}

TEST_CASE("sim variables: a tool offset of unknown meaning has the value that it is given before the run") {
  Simulation s("fanuc-31i-b");
  CHECK_FALSE(s.machine->read(2403));
  CHECK(s.state() == "inconclusive");
  CHECK(s.machine->end().text.find("`--var 2403=VALUE`") != std::string::npos);
  Simulation written("fanuc-31i-b");
  CHECK_FALSE(written.machine->write(2403, 1));
  CHECK(written.state() == "inconclusive");
  Simulation given("fanuc-31i-b");
  CHECK(given.machine->preset(2403, 0));
  CHECK(given.machine->read(2403) == 0);
  CHECK(given.machine->write(2403, -0.01));
  CHECK(given.machine->read(2403) == -0.01);
  CHECK_FALSE(given.machine->read(2404));
  // D of the 31i is stated.
  CHECK(Simulation("fanuc-31i-b").machine->read(12003) == 0);
  CHECK_FALSE(Simulation("fanuc-31i-b").machine->preset(3999, 1));
}

TEST_CASE("sim variables: timers (#3001 ms, settable; #3002 hours)") {
  Simulation s;
  s.machine->advance(1.5);
  CHECK(s.machine->read(3001) == 1500);
  s.machine->write(3001, 100);
  CHECK(s.machine->read(3001) == 100);
  s.run("G4 X0.25");
  CHECK(s.machine->read(3001) == 350);
  CHECK(*s.machine->read(3002) == doctest::Approx(1.75 / 3600));
}

TEST_CASE("sim variables: levels of calls (reference 1.8)") {
  Simulation s; // five macro levels
  sim::Machine& m = *s.machine;
  m.setLocal(1, 10);
  m.write(2, 20);
  REQUIRE(m.enter({9001, 0, 0, false})); // M98 shares the locals
  CHECK(m.read(1) == 10);
  REQUIRE(m.enter({9002, 0, 0, true})); // G65 has its own, all null
  CHECK(isNull(*m.read(1)));
  m.setLocal(1, 11);
  m.frame().sequence = 55;
  m.leave();
  CHECK(m.read(1) == 10);
  m.leave();
  CHECK(m.read(2) == 20);
  for (std::uint32_t i = 1; i <= 5; ++i)
    REQUIRE(m.enter({9000 + i, 0, 0, true}));
  CHECK_FALSE(m.enter({9006, 0, 0, true}));
  CHECK(s.state() == "alarm 122");
  CHECK(m.end().stack.size() == 6);
  Simulation deep;
  while (deep.machine->enter({1, 0, 0, false})) {
  }
  CHECK(deep.state() == "alarm 77");
}

TEST_CASE("sim variables: #3000 raises 3000 + n with its message") {
  Simulation s;
  CHECK_FALSE(s.machine->raise(145, "NOT MEASURED"));
  CHECK(s.state() == "alarm 3145");
  CHECK(s.machine->end().text == "NOT MEASURED");
  Simulation haas("haas-ngc");
  CHECK_FALSE(haas.machine->raise(15, "NOT MEASURED"));
  CHECK(haas.state() == "alarm 1015");
}
