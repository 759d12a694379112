// Calls of the macro sets by the cycles of the library, beside the frozen meaning in C++ (tests/oracle): two
// readings of one call, which have to leave the same.
#include "stdlib/MacroCycle.h"
#include "tests/Draws.h"
#include "tests/oracle/VendorMacros.h"
#include "tests/unit/VendorHelper.h"
#include "verify/Random.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace dotek::tests {

namespace {

using stdlib::Intent;
using Role = stdlib::ArgumentRole;

constexpr double kBall = 3;
// The machine rounds to a nanometre, at its ties here so and there so: mm, and degrees over 5 mm.
constexpr double kGrid = 1e-5, kAngleGrid = 1e-4;
constexpr double kStartZ = 5, kTouchZ = -8;

// Keeps the places of contacts.
class Contacts final : public sim::SkipSignal {
public:
  explicit Contacts(ContactWorld& world) : world_(world) {}
  std::optional<double> contact(const sim::SkipMove& move) override {
    const std::optional<double> share = world_.contact(move);
    if (share)
      for (std::size_t i = 0; i < 3; ++i)
        places.push_back(move.machineFrom[i] + *share * (move.machineTo[i] - move.machineFrom[i]));
    return share;
  }
  std::vector<double> places;

private:
  ContactWorld& world_;
};

struct Drawn {
  std::string title;
  std::uint32_t program = 0;
  std::vector<double> locals = std::vector<double>(34, sim::kNull);
  bool inside = true, island = false, round = true;
  double size = 0, aside = 0, over = 0, turn = 0; // of the part: size, middle off the start, degrees
};

Drawn draw(const stdlib::MacroSignature& signature, verify::Random& random) {
  Drawn out;
  out.title = signature.title;
  out.program = signature.program;
  const auto chance = [&](double share) { return random.chance(share); };
  out.turn = signature.intent == Intent::Angle ? random.between(-4, 4) : 0;
  const double nominal = random.between(25, 80);
  // Now and then so far off that a search finds nothing, or meets something on its way.
  out.size = nominal + (chance(0.1) ? random.between(-16, 30) : random.between(-0.8, 0.8));
  out.aside = random.between(-0.5, 0.5);
  out.over = random.between(-0.5, 0.5);
  double first = random.between(0, 40);
  for (const stdlib::MacroArgument& one : signature.arguments) {
    if (!one.unknown.empty()) continue;
    double& local = out.locals[stdlib::localOf(one.letter)];
    switch (one.role) {
    case Role::Diameter: local = nominal; break;
    case Role::Width: local = nominal; break;
    case Role::Depth:
      local = kTouchZ;
      out.inside = false;
      break;
    case Role::Clearance:
      if (one.required || chance(0.7)) local = random.between(1, 6);
      if (!one.required && chance(0.3)) {
        local = -random.between(1, 6);
        out.inside = out.island = true;
      }
      break;
    case Role::Direction:
      local = chance(0.3) ? 90 * static_cast<double>(random.below(4)) : random.between(-180, 180);
      out.turn = local;
      break;
    case Role::FirstAngle:
    case Role::SecondAngle:
    case Role::ThirdAngle:
      local = first;
      first += random.between(60, 140);
      break;
    case Role::Target: local = nominal / 2; break;
    case Role::Spacing: local = random.between(5, 30) * (chance(0.5) ? 1 : -1); break;
    case Role::FaceAngle:
      if (chance(0.7))
        local = (one.axis == ir::Axis::X ? 90 : 0) + random.between(-3, 3) + (chance(0.2) ? 180 : 0);
      break;
    case Role::System:
      if (chance(0.6)) local = 1 + static_cast<double>(random.below(6));
      break;
    case Role::Overtravel:
      if (chance(0.5)) local = random.between(2, 12);
      break;
    case Role::SizeTolerance:
    case Role::PositionTolerance:
    case Role::AngleTolerance:
    case Role::UpperLimit:
      if (chance(0.25)) local = random.between(0, 2);
      break;
    default: break;
    }
  }
  switch (signature.intent) {
  case Intent::Pocket:
  case Intent::Web:
  case Intent::AngledPocket:
  case Intent::AngledWeb:
  case Intent::Angle: out.round = false; break;
  default: break;
  }
  return out;
}

void build(const Drawn& drawn, const stdlib::MacroSignature& signature, ContactWorld& world) {
  if (signature.intent == Intent::Angle) {
    const bool x =
        stdlib::localOf('X') < drawn.locals.size() && !sim::isNull(drawn.locals[stdlib::localOf('X')]);
    const double at = drawn.size / 2;
    x ? world.wall(at, 0, 180 + drawn.turn) : world.wall(0, at, 270 + drawn.turn);
    return;
  }
  if (drawn.island) world.boss(drawn.aside, drawn.over, std::max(1., drawn.size / 2 - 20), 0);
  const bool alongY =
      signature.find(Role::Width, ir::Axis::Y) != nullptr && signature.find(Role::Direction) == nullptr;
  const double turn = drawn.turn + (alongY ? 90 : 0);
  if (drawn.round && drawn.inside) return world.bore(drawn.aside, drawn.over, drawn.size);
  if (drawn.round) return world.boss(drawn.aside, drawn.over, drawn.size, 0);
  if (!drawn.inside) return world.box(drawn.aside, drawn.over, drawn.size, 60, 0, turn);
  const double a = turn * std::numbers::pi / 180;
  for (const double side : {1., -1.})
    world.wall(drawn.aside + side * drawn.size / 2 * std::cos(a),
               drawn.over + side * drawn.size / 2 * std::sin(a), side > 0 ? turn + 180 : turn);
}

// What the call leaves: how it ends, offsets, results, contacts, the place of the probe.
struct Left {
  std::string end;
  std::vector<double> numbers, contacts;
};

template <class Meaning>
Left run(const Drawn& drawn, const stdlib::MacroSignature& signature, Meaning& meaning) {
  Simulation simulation;
  ContactWorld world(kBall);
  build(drawn, signature, world);
  Contacts contacts(world);
  meaning.setStylusRadius(kBall);
  simulation.machine->setSkipSignal(&contacts);
  const bool within = drawn.inside && !drawn.island;
  REQUIRE(simulation.run(fmt::format("G90 G0 X0 Y0 Z{:g}", within ? kTouchZ : kStartZ)));
  Left out;
  const bool goesOn = meaning.run(*simulation.machine, drawn.program, drawn.locals);
  out.end = simulation.state() + " " + simulation.machine->end().text;
  out.contacts = contacts.places;
  if (!goesOn) return out;
  for (std::uint32_t variable = 135; variable < 150; ++variable)
    out.numbers.push_back(simulation.machine->common(variable));
  for (std::uint32_t system = 0; system < 6; ++system)
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      out.numbers.push_back(simulation.machine->read(5221 + 20 * system + axis).value_or(-1));
  for (const double at : simulation.machine->position())
    out.numbers.push_back(at);
  return out;
}

bool same(const std::vector<double>& a, const std::vector<double>& b, double grid) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [grid](double one, double other) {
    if (sim::isNull(one) || sim::isNull(other)) return sim::isNull(one) == sim::isNull(other);
    if (sim::isUnknown(one) || sim::isUnknown(other)) return sim::isUnknown(one) == sim::isUnknown(other);
    return std::abs(one - other) < grid;
  });
}

std::string text(const std::vector<double>& values) {
  std::string out;
  for (const double one : values)
    out += fmt::format(" {:.7g}", one);
  return out;
}

} // namespace

TEST_CASE("vendor macros: the cycles of the library leave what the frozen meaning of the calls leaves") {
  for (const char* name : {"inspection-plus", "dotek"}) {
    const stdlib::MacroSet set = *stdlib::MacroSet::load(stdlib::DataFiles(), name);
    const stdlib::Control control = *stdlib::Control::load(stdlib::DataFiles(), "fanuc-0i-md");
    for (const stdlib::MacroSignature& signature : set.signatures) {
      if (!measuringCycles().contains(stdlib::libraryCycle(signature))) continue;
      std::map<std::string, int> ends;
      const double grid = signature.intent == Intent::Angle ? kAngleGrid : kGrid;
      const int count = draws(2000, 40);
      for (int i = 0; i < count; ++i) {
        verify::Random random(
            verify::Random::sub(verify::Random::hash(signature.title), static_cast<std::uint64_t>(i)));
        const Drawn drawn = draw(signature, random);
        sim::VendorMacros meaning(set, control, measuringCycles());
        oracle::VendorMacros frozen(set, control);
        const Left now = run(drawn, signature, meaning), before = run(drawn, signature, frozen);
        CAPTURE(signature.title);
        CAPTURE(i);
        CAPTURE(drawn.island);
        CHECK(now.end == before.end);
        CHECK_MESSAGE(same(now.numbers, before.numbers, grid), text(now.numbers)
                                                                   << "\nfrozen" << text(before.numbers));
        CHECK_MESSAGE(same(now.contacts, before.contacts, kGrid), text(now.contacts)
                                                                      << "\nfrozen" << text(before.contacts));
        ++ends[now.end.substr(0, now.end.find(' '))];
      }
      CAPTURE(signature.title);
      CHECK(ends["running"] > count / 2); // most measure
      CHECK(ends["alarm"] > count / 50);  // and some find nothing, or too much
    }
  }
}

} // namespace dotek::tests
