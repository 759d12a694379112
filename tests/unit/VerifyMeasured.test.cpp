// What the macros measure is what is true of the placed part: by their meaning and by our own text, on random
// parts; and off by the known error of the method where a touch is not normal to its surface.
#include "tests/unit/MeasuredRunner.h"

#include <cmath>
#include <map>

using namespace dotek;
using namespace dotek::tests;

namespace {

constexpr double kMicrometre = 1e-3;
// What is left beside the truth without noise, mm: of doubles, where the machine's lengths lie on a grid of a
// nanometre, and of eight digits.
constexpr double kDoubles = 3e-6, kEightDigits = 3e-5;
constexpr int kPlacements = 25; // of each feature, for each control

struct Ways {
  MeasuredRunner easyprobe, inspectionPlus, meaning, text;
  explicit Ways(const std::string& control)
      : easyprobe(control, "easyprobe"), inspectionPlus(control, "inspection-plus"),
        meaning(control, "dotek"), text(control, "dotek", ownMacroText()) {}
  std::vector<std::pair<std::string, MeasuredRunner*>> all() {
    return {{"EasyProbe by meaning", &easyprobe},
            {"Inspection Plus by meaning", &inspectionPlus},
            {"our own by meaning", &meaning},
            {"our own by text", &text}};
  }
};

struct Errors {
  double largest = 0; // of positions, sizes and offsets, by the noise that they may hold; mm
  int runs = 0;
  void take(double error, double touches = 1) { largest = std::max(largest, std::abs(error) / touches); }
};

// All that a run leaves beside the truth. `noise`: of one touch at most, mm.
void judge(const MeasuredFeature& feature, const verify::Record& record, bool easyprobe, double tolerance,
           double noise, Errors& errors) {
  CAPTURE(feature.name);
  CAPTURE(record.text);
  REQUIRE(record.ending == verify::Ending::Finished);
  CHECK(record.events.empty());
  const auto zeros = verify::standZeros();
  const bool sets = feature.calls.begin()->second.find('S') != std::string::npos;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    const auto coordinate = [&](const sim::Point3& p) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; };
    const double left = record.zeros.at({55, static_cast<std::uint32_t>(axis)});
    double truth = coordinate(zeros[1]);
    const bool set = sets && feature.found.contains(axis);
    if (set)
      truth = coordinate(zeros[0]) + feature.found.at(axis) -
              (easyprobe ? feature.wanted : feature.expected).at(axis);
    CAPTURE(left);
    CAPTURE(truth);
    CHECK(std::abs(left - truth) <= tolerance + noise);
    if (set) errors.take(left - truth);
    CHECK(std::abs(coordinate(record.end) - coordinate(feature.start + zeros[0])) <= tolerance);
  }
  for (std::size_t i = 0; i < feature.results.size() && !easyprobe; ++i) {
    const MeasuredResult& result = feature.results[i];
    CAPTURE(result.variable);
    CAPTURE(result.value);
    const double value = record.stores.at(MeasuredRunner::kResults + static_cast<std::uint32_t>(i));
    CAPTURE(value);
    CHECK(std::abs(value - result.value) <= (tolerance + noise) * std::max(1.0, result.touches));
    errors.take(value - result.value, std::max(1.0, result.touches));
  }
  ++errors.runs;
}

// Every path that has the feature measures it; all leave the same offsets.
void measure(Ways& ways, const MeasuredFeature& feature, double tolerance, const MeasuredProbe& probe,
             Errors& errors) {
  CAPTURE(feature.name);
  std::optional<verify::Record> first;
  for (const auto& [name, runner] : ways.all()) {
    CAPTURE(name);
    // What the outer corner does is said by its text alone.
    if (runner == &ways.meaning && feature.name == "outer corner") continue;
    const auto record = runner->run(feature, probe);
    if (!record) continue;
    judge(feature, *record, runner == &ways.easyprobe, tolerance, 3 * probe.noise, errors);
    if (runner == &ways.easyprobe || probe.noise > 0) continue;
    if (!first) {
      first = record;
      continue;
    }
    for (const auto& [key, zero] : record->zeros)
      CHECK(std::abs(zero - first->zeros.at(key)) < kMicrometre);
  }
}

template <class Make> void forBoth(const std::string& what, Make make) {
  for (const std::string control : {"fanuc-31i-b", "fanuc-0i-md"}) {
    CAPTURE(control);
    Ways ways(control);
    const double tolerance = control == "fanuc-31i-b" ? kDoubles : kEightDigits;
    CHECK(tolerance <= kMicrometre);
    Errors errors;
    make(ways, tolerance, errors);
    MESSAGE(what << " on " << control << ": " << errors.runs << " runs, at most "
                 << fmt::format("{:.9f}", errors.largest) << " mm off");
  }
}

double turnOf(verify::Random& random, double least, double most) {
  return random.between(least, most) * (random.chance(0.5) ? 1 : -1);
}

} // namespace

TEST_CASE("measured: features that are touched along their normals are exact") {
  forBoth("features", [](Ways& ways, double tolerance, Errors& errors) {
    verify::Random random(11);
    for (int n = 0; n < kPlacements; ++n) {
      for (const std::string_view name : kMeasuredFeatures) {
        // Turned bores stay what they are; the angle of a face is what is measured.
        const bool turned = name.starts_with("b") || name.starts_with("angle");
        measure(ways, measuredFeature(name, random, {turned ? turnOf(random, 0, 5) : 0, 0, {}}), tolerance,
                {}, errors);
      }
      for (const std::string_view name : kAngledFeatures)
        measure(ways, measuredFeature(name, random), tolerance, {}, errors);
    }
  });
}

TEST_CASE("measured: oblique touches are off by the known error of the method") {
  forBoth("oblique touches", [](Ways& ways, double tolerance, Errors& errors) {
    verify::Random random(12);
    for (int n = 0; n < kPlacements; ++n)
      for (const std::string_view name : kMeasuredFeatures) {
        if (name.starts_with("b") || name.starts_with("angle")) continue;
        const double turn = turnOf(random, 0.2, 8);
        measure(ways, measuredFeature(name, random, {name == "surface z" ? 0 : turn, turn, {}}), tolerance,
                {}, errors);
      }
  });
}

TEST_CASE("measured: a noisy probe is off by its noise") {
  constexpr double kNoise = 3e-4; // a common radio probe repeats within a micrometre
  forBoth("noise", [&](Ways& ways, double tolerance, Errors& errors) {
    verify::Random random(13);
    for (int n = 0; n < kPlacements; ++n)
      for (const std::string_view name : kMeasuredFeatures) {
        MeasuredProbe probe;
        probe.noise = kNoise;
        probe.seed = random.next();
        measure(ways, measuredFeature(name, random), tolerance, probe, errors);
      }
    CHECK(errors.largest > kNoise); // it is there
  });
}

TEST_CASE("measured: the calibrated radius takes the path to the signal away") {
  forBoth("pre-travel", [](Ways& ways, double tolerance, Errors& errors) {
    verify::Random random(14);
    for (int n = 0; n < kPlacements; ++n)
      for (const std::string_view name : kMeasuredFeatures) {
        if (name == "surface z") continue; // that is the tool length's
        MeasuredProbe probe;
        probe.preTravel = random.between(0.001, 0.02);
        measure(ways, measuredFeature(name, random), tolerance, probe, errors);
      }
  });
}

// Surfaces just within the search, and just beyond it: there the macros say so.
TEST_CASE("measured: searches go as far as the call says") {
  for (const std::string control : {"fanuc-31i-b", "fanuc-0i-md"}) {
    CAPTURE(control);
    Ways ways(control);
    verify::Random random(15);
    int runs = 0;
    for (int n = 0; n < 2 * kPlacements; ++n)
      for (const std::string_view name : kMeasuredFeatures)
        for (const auto& [way, runner] : ways.all()) {
          CAPTURE(name);
          CAPTURE(way);
          const bool missed = n % 2 == 0;
          const MeasuredFeature feature = measuredFeature(name, random, {0, 0, missed ? 0.1 : -0.1});
          if (runner == &ways.easyprobe || (runner == &ways.meaning && name == "outer corner")) continue;
          const auto record = runner->run(feature);
          if (!record) continue;
          CAPTURE(record->text);
          CHECK(record->ending == (missed ? verify::Ending::Alarm : verify::Ending::Finished));
          CHECK(record->alarmKind == (missed ? "probe-fail" : ""));
          ++runs;
        }
    CHECK(runs > 30 * kPlacements);
  }
}
