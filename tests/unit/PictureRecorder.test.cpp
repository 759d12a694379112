// Pictures of a run: kinds of moves, contacts and errors at their moves, blocks, and what is bounded.
#include "sim/picture/PictureRecorder.h"

#include "tests/unit/PartHelper.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::sim;
using namespace dotek::tests;

namespace {

Part cube() {
  PartBuilder builder;
  builder.box({0, 0, 0}, {10, 10, 10});
  return *finish(builder);
}

Probe probe() {
  Probe out;
  out.ballDiameter = 4;
  out.effectiveRadius = 2;
  out.length = 100;
  out.overtravel = 3;
  return out;
}

struct Recording {
  World world{cube(), probe()};
  std::string block = "G0";
  PictureRecorder recorder;

  explicit Recording(bool withWorld = true)
      : recorder(
            empty(), withWorld ? &world : nullptr,
            [](std::uint32_t program, std::span<const double>) -> std::optional<PathKind> {
              if (program == 9810) return PathKind::Protected;
              if (program == 9811) return PathKind::Measuring;
              return std::nullopt;
            },
            [this] {
              return PictureBlock{block, "a.nc:1"};
            }) {}
  static Picture empty() {
    Picture out;
    out.part = cube();
    out.probe = probe();
    return out;
  }
  static Position at(double x, double y, double z) { // of the tip
    Position out{};
    out[0] = x, out[1] = y, out[2] = z + 100;
    return out;
  }
  void go(MotionKind kind, const Position& to) {
    SkipMove skip;
    skip.machineFrom = place;
    skip.machineTo = to;
    Position end = to;
    if (kind == MotionKind::Skip) {
      if (const auto share = recorder.contact(skip))
        for (std::size_t i = 0; i < 3; ++i)
          end[i] = place[i] + *share * (to[i] - place[i]);
    }
    recorder.moved({kind, place, end, 1, true});
    place = end;
  }
  Position place = at(-20, 5, 5);
};

} // namespace

TEST_CASE("picture recorder: kinds of moves follow the calls around them") {
  Recording r;
  const std::vector<double> locals(34, 0);
  r.go(MotionKind::Rapid, r.at(-18, 5, 5));
  r.go(MotionKind::Skip, r.at(-17, 5, 5)); // outside of a call
  r.recorder.callBegins(9810, locals);
  r.go(MotionKind::Skip, r.at(-16, 5, 5));
  r.recorder.callBegins(7, locals); // has no say
  r.go(MotionKind::Skip, r.at(-15, 5, 5));
  r.go(MotionKind::Feed, r.at(-14, 5, 5));
  r.recorder.callEnded(7);
  r.recorder.callEnded(9810);
  r.recorder.callBegins(9811, locals);
  r.go(MotionKind::Skip, r.at(-13, 5, 5));
  r.recorder.callBegins(9810, locals); // the innermost that has a say
  r.go(MotionKind::Skip, r.at(-12, 5, 5));
  r.recorder.callEnded(9810);
  r.recorder.callEnded(9811);
  std::string kinds;
  for (const PictureMove& move : r.recorder.picture().moves)
    kinds += std::string(pathKindName(move.kind)) + " ";
  CHECK(kinds == "rapid measuring protected protected feed measuring protected ");
}

TEST_CASE("picture recorder: contacts and errors are at their moves, by the ball's centre") {
  Recording r;
  r.block = "G31 X5.";
  r.go(MotionKind::Skip, r.at(5, 5, 5));
  r.block = "G0 X-20.";
  r.go(MotionKind::Rapid, r.at(-20, 5, 5));
  r.recorder.probeSwitched(false);
  r.block = "G31 X5.";
  r.go(MotionKind::Skip, r.at(-3, 5, 5));
  r.block = "G0 X5.";
  r.go(MotionKind::Rapid, r.at(5, 5, 5));
  const Picture& picture = r.recorder.picture();
  REQUIRE(picture.moves.size() == 4);
  CHECK(picture.moves[0].to.x == doctest::Approx(-2));
  CHECK(picture.moves[0].to.z == doctest::Approx(7)); // tip at 5
  CHECK((picture.moves[1].probeOn && !picture.moves[2].probeOn));
  CHECK(!r.world.on());
  REQUIRE(picture.contacts.size() == 1);
  CHECK(picture.contacts[0].move == 0);
  CHECK(picture.contacts[0].point.x == doctest::Approx(0));
  REQUIRE(picture.errors.size() == 2);
  CHECK(picture.errors[0].move == 2);
  CHECK(picture.errors[0].kind == PictureError::Kind::Miss);
  CHECK(picture.errors[1].move == 3);
  CHECK_FALSE(isMiss(picture.errors[1]));
  CHECK(errorNames(picture) == std::vector<std::string>{"M1", "E1"});
  CHECK(picture.errors[1].text.find("rapid move runs the ball into the part") != std::string::npos);
  REQUIRE(picture.blocks.size() == 3); // equal ones once
  CHECK(picture.moves[0].block == 0);
  CHECK(picture.moves[2].block == 0);
  CHECK(picture.blocks[picture.moves[3].block].text == "G0 X5.");
}

TEST_CASE("picture recorder: without a world the moves are those of the gauge line") {
  Recording r(false);
  r.go(MotionKind::Rapid, r.at(1, 2, 3));
  r.go(MotionKind::Skip, r.at(2, 2, 3));
  REQUIRE(r.recorder.picture().moves.size() == 2);
  CHECK(r.recorder.picture().moves[0].to == Point3{1, 2, 103});
  CHECK(!r.recorder.isThere({}));
}

TEST_CASE("picture recorder: the number of moves is bounded, the world goes on") {
  Recording r;
  for (std::size_t i = 0; i < PictureRecorder::kMostMoves; ++i)
    r.go(MotionKind::Feed, r.at(-20 - static_cast<double>(i % 2), 5, 5));
  CHECK(!r.recorder.isFull());
  r.go(MotionKind::Skip, r.at(5, 5, 5));
  CHECK(r.recorder.isFull());
  CHECK(r.recorder.picture().moves.size() == PictureRecorder::kMostMoves);
  CHECK(r.recorder.picture().contacts.empty());
  CHECK(r.world.events().size() == 1);
}

TEST_CASE("recorder: a run that an alarm ends before its first move stands where it began") {
  const auto end = [](Recording& run) {
    RunFacts facts;
    facts.end.ending = Ending::Alarm;
    facts.end.number = 3007;
    facts.end.text = "PROBE NOT CALIBRATED";
    facts.block = {"#3000=7", "a.nc:2"};
    run.recorder.finish(facts);
    return run.recorder.picture();
  };
  Recording known;
  known.recorder.setPlace([] { return Point3{30, 40, 92}; });
  known.recorder.setFrame([] { return PictureFrame{"G54", {0, 0, 100}}; });
  const Picture picture = end(known);
  CHECK(picture.still);
  REQUIRE(picture.moves.size() == 1);
  CHECK(picture.moves[0].to == Point3{30, 40, 92});
  REQUIRE(picture.errors.size() == 1);
  CHECK(picture.errors[0].at == Point3{30, 40, 92});
  CHECK(picture.result->position.starts_with("G54 X30.000 Y40.000 Z90.000; machine X30.000"));
  CHECK(picture.result->counts.back() == "0 moves");
  CHECK(pictureHtml(picture).find("\"count\":0,\"still\":true,") != std::string::npos);
  CHECK(pictureSvg(picture).find("without a place") == std::string::npos);

  Recording unknown; // where the machine stands is not stated
  CHECK_FALSE(end(unknown).still);
}
