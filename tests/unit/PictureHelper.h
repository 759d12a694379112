// Pictures made by hand: a plate with a bore that a cycle measures.
#pragma once

#include "sim/picture/Picture.h"
#include "tests/unit/PartHelper.h"

#include <cmath>
#include <string>

namespace dotek::tests {

using sim::PathKind;
using sim::Picture;

// 120 x 80 x 20 with a bore of 30, a boss, a slot and a pocket: five shapes. Its upper face is Z-400.
inline Part platePart() {
  using Action = PartBuilder::Action;
  PartBuilder builder;
  builder.box({0, 0, -20}, {120, 80, 0});
  builder.cylinder({30, 40, -30}, {30, 40, 1}, 15, Action::Remove);
  builder.cylinder({70, 25, 0}, {70, 25, 12}, 8);
  builder.box({58, 54, -8}, {82, 66, 1}, Action::Remove, 5.9);
  builder.box({92, 20, -6}, {112, 60, 1}, Action::Remove, 3);
  return finish(builder)->placed({{-300, -200, -400}, {}}, {{0.12, -0.08, 0.03}, {0, 0, 0.25}});
}

class PictureMaker {
public:
  PictureMaker() { picture.probe = probe(); }

  static sim::Probe probe() {
    sim::Probe out;
    out.ballDiameter = 6;
    out.length = 180;
    out.stemDiameter = 4;
    out.stemLength = 50;
    out.bodyDiameter = 40;
    out.bodyLength = 60;
    return out;
  }

  void start(const Point3& at) { at_ = at; }
  void block(const std::string& text) {
    picture.blocks.push_back({text, "bore.nc:" + std::to_string(picture.blocks.size() + 1)});
  }
  void move(PathKind kind, const Point3& to, bool on = true) {
    picture.moves.push_back({kind, at_, to, on, picture.blocks.size() - 1});
    at_ = to;
  }
  void contact(const Point3& point) { picture.contacts.push_back({point, picture.moves.size() - 1}); }
  void error(const std::string& text) { picture.errors.push_back({at_, text, picture.moves.size() - 1}); }

  Picture picture;

private:
  Point3 at_;
};

// The bore from four sides, the upper face, a side of the plate, and a rapid that goes wrong.
inline Picture borePicture() {
  PictureMaker make;
  Picture& picture = make.picture;
  picture.title = "bore.nc on plate.toml";
  picture.part = platePart();
  const Point3 centre = picture.part->toMachine({30, 40, -8});
  make.start({-270, -160, -150});
  make.block("G90 G0 X-270. Y-160.");
  make.move(PathKind::Rapid, {centre.x, centre.y, -150}, false);
  make.block("G43 H1 Z-380.");
  make.move(PathKind::Rapid, {centre.x, centre.y, -377}, false);
  make.block("G65 P9810 Z-408. F1000. (protected)");
  make.move(PathKind::Protected, centre);
  for (const double angle : {0.0, 180.0, 90.0, 270.0}) {
    const double pi = std::acos(-1.0);
    const Point3 way{std::round(std::cos(angle * pi / 180)), std::round(std::sin(angle * pi / 180)), 0};
    make.block("G31 " + std::string(way.x != 0 ? "X" : "Y") + (way.x + way.y > 0 ? "" : "-") + "14. F100.");
    make.move(PathKind::Measuring, centre + way * 12);
    make.contact(centre + way * 15);
    make.block("G1 X0. Y0. F1000.");
    make.move(PathKind::Feed, centre);
  }
  make.block("G1 Z-385. F1000.");
  make.move(PathKind::Feed, {centre.x, centre.y, -382});
  make.block("G0 X-245. Y-155.");
  const Point3 above{-245, -150, -382};
  make.move(PathKind::Rapid, above);
  make.block("G31 Z-405. F100.");
  make.move(PathKind::Measuring, {above.x, above.y, -396.97});
  make.contact({above.x, above.y, -399.97});
  make.block("G1 Z-385. F1000.");
  make.move(PathKind::Feed, above);
  make.block("G0 X-170.");
  make.move(PathKind::Rapid, {-165, -150, -382});
  make.block("G65 P9810 Z-410. F1000.");
  make.move(PathKind::Protected, {-165, -150, -407});
  make.block("G31 X-185. F100.");
  make.move(PathKind::Measuring, {-176.7, -150, -407});
  make.contact({-179.7, -150, -407});
  make.block("G1 X-170. F1000.");
  make.move(PathKind::Feed, {-165, -150, -407});
  make.block("G0 X-200.");
  make.move(PathKind::Rapid, {-176.7, -150, -407});
  make.error("the probe runs into the part in rapid <G0>; the stylus breaks");
  return picture;
}

} // namespace dotek::tests
