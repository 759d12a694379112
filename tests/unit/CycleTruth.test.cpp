// What cycles of the library measure on a part that is shifted and turned is what is true of it, and a noisy
// probe moves their results by as much as its touches allow.
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/unit/CycleBench.h"

#include "ir/CycleNames.h"
#include "project/CycleLowering.h"
#include "project/CycleValues.h"
#include "project/Session.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <ranges>
#include <string>
#include <vector>

using namespace dotek;
using namespace dotek::tests;
using sim::Point3;

namespace {

constexpr double kMicrometre = 1e-3;
constexpr double kAngle = 1e-3; // degrees: a micrometre at 57 mm
constexpr std::uint32_t kFirstStore = 900;

// A result on the part at its place, and what each mm of the shift along x, y and z makes of it. `sigma`: of
// the result, by that of one touch; 0: it is a function of a largest or a least, and not looked at.
struct Truth {
  std::string name;
  double value;
  std::array<double, 3> perShift;
  double sigma;
};
struct Given {
  std::string cycle;
  std::map<std::string, double> values;
  std::vector<Truth> results;
  bool turns; // the results stay what they are where the part is turned about the middle of its touches
};

const double kHalf = std::sqrt(0.5), kDouble = std::sqrt(2.0);
constexpr std::array<double, 3> kStays = {0, 0, 0}, kX = {1, 0, 0}, kY = {0, 1, 0}, kZ = {0, 0, 1};

// The ball's radius is 3, the start X0 Y0 Z0.
const std::vector<Given>& all() {
  static const std::vector<Given> out = {
      {"bore",
       {{"diameter", 30}},
       {{"size", 30, kStays, kDouble},
        {"centre_x", 0, kX, kHalf},
        {"centre_y", 0, kY, kHalf},
        {"deviation", 0, kStays, kDouble}},
       true},
      {"bore-angled",
       {{"diameter", 40}, {"first_angle", 30}},
       {{"size", 40, kStays, 0}, {"centre_x", 0, kX, kHalf}, {"centre_y", 0, kY, kHalf}},
       true},
      {"boss",
       {{"diameter", 24}, {"depth", 12}},
       {{"size", 24, kStays, kDouble}, {"centre_x", 0, kX, kHalf}, {"centre_y", 0, kY, kHalf}},
       true},
      {"surface-x", {{"distance", 12}}, {{"position", 12, kX, 1}, {"deviation", 0, kX, 1}}, false},
      {"surface-x", {{"distance", -9}}, {{"position", -9, kX, 1}}, false},
      {"surface-y", {{"distance", 11}}, {{"position", 11, kY, 1}}, false},
      {"surface-z", {{"distance", -7}}, {{"position", -7, kZ, 1}}, false},
      {"web-x",
       {{"width", 20}, {"depth", 12}},
       {{"size", 20, kStays, kDouble}, {"centre", 0, kX, kHalf}},
       false},
      {"web-y",
       {{"width", 16}, {"depth", 12}},
       {{"size", 16, kStays, kDouble}, {"centre", 0, kY, kHalf}},
       false},
      {"channel-x", {{"width", 32}}, {{"size", 32, kStays, kDouble}, {"centre", 0, kX, kHalf}}, false},
      {"channel-y", {{"width", 28}}, {{"size", 28, kStays, kDouble}, {"centre", 0, kY, kHalf}}, false},
      {"rectangle-inside",
       {{"size_x", 40}, {"size_y", 30}},
       {{"found_x", 40, kStays, kDouble},
        {"found_y", 30, kStays, kDouble},
        {"centre_x", 0, kX, kHalf},
        {"centre_y", 0, kY, kHalf}},
       false},
      {"rectangle-outside",
       {{"size_x", 40}, {"size_y", 30}, {"depth", 12}},
       {{"found_x", 40, kStays, kDouble},
        {"found_y", 30, kStays, kDouble},
        {"centre_x", 0, kX, kHalf},
        {"centre_y", 0, kY, kHalf}},
       false},
      {"corner-inner",
       {{"distance_x", 15}, {"distance_y", -12}},
       {{"corner_x", 15, kX, 1}, {"corner_y", -12, kY, 1}},
       false},
      {"corner-outer",
       {{"reach_x", 20}, {"reach_y", 20}, {"depth", 12}},
       {{"corner_x", 0, kX, 1}, {"corner_y", 0, kY, 1}},
       false},
      {"mean-touch-x",
       {{"distance", 14}, {"touches", 4}},
       {{"position", 14, kX, 0.5}, {"spread", 0, kStays, 0}},
       false},
      {"mean-touch-z", {{"distance", -8}, {"touches", 9}}, {{"position", -8, kZ, 1.0 / 3}}, false},
      {"step-height",
       {{"distance", 10}, {"step_up", 4}, {"distance_x", 40}},
       {{"height", 4, kStays, kDouble}, {"first_z", -10, kZ, 1}, {"second_z", -6, kZ, 1}},
       false},
      {"surface-angled",
       {{"distance", 20}, {"direction", 30}},
       {{"position_x",
         20 * std::cos(M_PI / 6),
         {0.75, std::sqrt(3.0) / 4, 0}, // the shift along the direction, in its own direction
         std::cos(M_PI / 6)},
        {"position_y", 10, {std::sqrt(3.0) / 4, 0.25, 0}, 0.5}},
       false},
      {"edge-angle-x",
       {{"distance", 15}, {"spacing", 50}},
       {{"turn", 0, kStays, kDouble / 50 * 180 / M_PI}, {"position", 15, kY, 1}},
       false},
  };
  return out;
}

struct Library {
  project::CommonOptions options;
  project::Session session{options};

  Bench bench(const Given& given) {
    Bench out;
    const auto lowered =
        project::lowerCycleFile((root() / "stdlib/cycles" / (given.cycle + ".cycle")).string(), session);
    REQUIRE_MESSAGE(lowered, renderText(session.diagnostics(), session.sources(), 0));
    out.cycle = lowered->cycle;
    out.entry.probeOn = false;
    out.inputs.values.resize(out.cycle.variables.size());
    for (ir::VariableId id = 0; id < out.cycle.variables.size(); ++id) {
      const ir::Variable& variable = out.cycle.variable(id);
      if (variable.role != ir::Role::Parameter) continue;
      const auto value = given.values.find(variable.name);
      out.inputs.values[id] = value != given.values.end() ? ir::Scalar::of(value->second)
                              : variable.defaultValue     ? ir::Scalar::of(*variable.defaultValue)
                                                          : ir::Scalar::null();
    }
    keepResults(given, out);
    makePart(out);
    return out;
  }
  std::vector<verify::Touch> touches;

private:
  // What the cycle leaves at its end goes to variables of the machine, in the order of the truths.
  static void keepResults(const Given& given, Bench& bench) {
    for (ir::CycleStatement& statement : std::views::reverse(bench.cycle.body)) {
      const auto* call = std::get_if<ir::CallCycle>(&statement.node);
      if (call == nullptr || call->cycle != ir::kResults) continue;
      const std::vector<ir::CycleArgument> left = call->arguments;
      statement.node = ir::Comment{"results"};
      for (std::size_t i = 0; i < given.results.size(); ++i)
        for (const ir::CycleArgument& one : left)
          if (one.parameter == given.results[i].name)
            bench.keep(kFirstStore + static_cast<std::uint32_t>(i), one.value);
      break;
    }
    REQUIRE(bench.stores.size() == given.results.size());
  }
  void makePart(Bench& bench) {
    const auto rehearsal = bench.stand.rehearse(bench.cycle, bench.inputs, bench.probe, bench.entry);
    REQUIRE_MESSAGE(rehearsal.ending == verify::Ending::Finished, rehearsal.text);
    touches = rehearsal.surfaces;
    bench.part = verify::partOf(touches, kBall, 12, {});
    REQUIRE(bench.part);
  }
};

// `./dev accept` asks for 2,000.
int noisyRuns() {
  const char* const asked = std::getenv("DOTEK_NOISY_RUNS");
  return asked != nullptr ? std::max(1, std::atoi(asked)) : draws(100, 40);
}

double toleranceOf(const Truth& truth) {
  return truth.name == "turn" ? kAngle : kMicrometre;
}

} // namespace

TEST_CASE("measured truth: cycles of the library find the features of a shifted part, and turned ones") {
  for (const Given& given : all()) {
    CAPTURE(given.cycle);
    Library library;
    Bench bench = library.bench(given);
    const sim::Part nominal = *bench.part;
    for (int n = 0; n < draws(20, 5); ++n) {
      PartRandom random(static_cast<std::uint64_t>(n) + 1);
      verify::PartError error;
      error.shift = {random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(-0.5, 0.5)};
      if (given.turns) error.turn = random.between(-1, 1);
      bench.part = verify::withError(nominal, library.touches, error);
      const verify::Record record = bench.run();
      REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
      CHECK(record.events.empty());
      const std::array<double, 3> shift = {error.shift.x, error.shift.y, error.shift.z};
      for (std::size_t i = 0; i < given.results.size(); ++i) {
        const Truth& truth = given.results[i];
        CAPTURE(truth.name);
        double wanted = truth.value;
        for (std::size_t axis = 0; axis < 3; ++axis)
          wanted += truth.perShift[axis] * shift[axis];
        const double found = record.stores.at(kFirstStore + static_cast<std::uint32_t>(i));
        CAPTURE(found);
        CAPTURE(wanted);
        CHECK(std::abs(found - wanted) < toleranceOf(truth));
      }
    }
  }
}

TEST_CASE("measured truth: noise of the touches moves results no further than it has to") {
  constexpr double kNoise = 0.001;
  const int runs = noisyRuns();
  for (const Given& given : all()) {
    CAPTURE(given.cycle);
    Library library;
    Bench bench = library.bench(given);
    bench.probe.noise = kNoise;
    bench.probe.overtravel = 1;
    std::vector<double> sums(given.results.size());
    std::vector<int> beyond(given.results.size());
    for (int n = 1; n <= runs; ++n) {
      const verify::Record record = bench.run(static_cast<std::uint64_t>(n));
      REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
      for (std::size_t i = 0; i < given.results.size(); ++i) {
        const Truth& truth = given.results[i];
        const double off = record.stores.at(kFirstStore + static_cast<std::uint32_t>(i)) - truth.value;
        sums[i] += off;
        if (std::abs(off) > 3 * truth.sigma * kNoise + kExact) ++beyond[i];
      }
    }
    for (std::size_t i = 0; i < given.results.size(); ++i) {
      const Truth& truth = given.results[i];
      if (truth.sigma == 0) continue;
      CAPTURE(truth.name);
      CHECK(beyond[i] <= std::max(1, runs / 100));
      CHECK(std::abs(sums[i] / runs) <= 3 * truth.sigma * kNoise / std::sqrt(runs) + kExact);
      CHECK(sums[i] != 0);
    }
  }
}
