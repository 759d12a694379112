#include "tests/unit/MeasuredFeatures.h"

#include "verify/Stand.h"

#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace dotek::tests {

namespace {

using Action = sim::PartBuilder::Action;
using sim::Point3;

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kDepth = -12; // of the touches below the top of a feature, lowest point of the ball
constexpr double kAbove = 8;   // where a way over a feature begins

double& part(Point3& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

class Maker {
public:
  Maker(std::string_view name, verify::Random& random, const MeasuredPlace& place)
      : random_(random), turn_(place.turn), tilt_(place.tilt) {
    out_.name = name;
    out_.ball = thousandths(0.5, 4);
    // The middle of the feature, and how far off it lies.
    middle_ = {thousandths(-60, 60), thousandths(-60, 60), thousandths(-40, 40)};
    off_ = {random_.between(-0.4, 0.4), random_.between(-0.4, 0.4), random_.between(-0.4, 0.4)};
    if (!place.beyond) {
      if (random_.chance(0.3)) search_ = thousandths(3, 9);
      return;
    }
    off_ = {};
    if (random_.chance(0.5)) search_ = thousandths(3, 5);
    far_ = search_.value_or(10) + *place.beyond;
  }

  MeasuredFeature make() {
    const std::string& name = out_.name;
    if (name.starts_with("surface")) surface(name.back() - 'x');
    if (name == "bore" || name == "boss") round(name == "boss");
    if (name.starts_with("pocket") || name.starts_with("web")) flat(name.back() - 'x', name[0] == 'w');
    if (name == "inner corner") corner(false);
    if (name == "outer corner") corner(true);
    if (name.starts_with("angle ")) angle(name.back() - 'x');
    if (name == "angled surface") angledSurface();
    if (name == "angled pocket" || name == "angled web") angledFlat(name.back() == 'b');
    if (name.starts_with("three-point")) threePoints(name.ends_with("boss"));
    return std::move(out_);
  }

private:
  double thousandths(double least, double most) {
    return std::round(random_.between(least, most) * 1000) / 1000;
  }
  double side() { return random_.chance(0.5) ? 1 : -1; }
  // How far beyond the expected surface, where the call says it.
  std::string beyond() const { return search_ ? "Q" + text(*search_) : std::string(); }
  static std::string text(double value) { return fmt::format("{:.3f}", value); }

  // Shapes were built around the feature's middle.
  void place(sim::PartBuilder& builder, const Point3& turn) {
    std::string fault;
    const std::unique_ptr<sim::Part> part = builder.finish(fault);
    out_.part = part->placed({verify::standZeros()[0] + middle_, {}}, {off_, turn});
  }
  void place(sim::PartBuilder& builder) { place(builder, {0, 0, turn_}); }

  void find(std::size_t axis, double found, double expected) {
    out_.found[axis] = found;
    out_.expected[axis] = expected;
    out_.wanted[axis] = thousandths(-90, 90);
  }
  std::string wanted(std::size_t axis) { return std::string(1, "IJK"[axis]) + text(out_.wanted[axis]); }

  // What a touch along one axis finds of a face through the middle, whose normal leans by the turn: the ball
  // meets it with its side, and counts as if it had met it with its front.
  double errorOfTouch(double lean, double sign) const {
    return -sign * out_.ball * (1 / std::cos(lean * kDegree) - 1);
  }

  void surface(std::size_t axis) {
    const double sign = axis == 2 ? -1 : side(), way = thousandths(8, 30);
    sim::PartBuilder builder;
    part(off_, axis) += sign * far_;
    Point3 least{-40, -40, -40}, most{40, 40, 40};
    (sign > 0 ? part(least, axis) : part(most, axis)) = 0;
    builder.box(least, most);
    const double lean = axis == 2 ? tilt_ : turn_;
    place(builder, axis == 2 ? Point3{tilt_, 0, 0} : Point3{0, 0, turn_});
    out_.start = middle_;
    part(out_.start, axis) -= sign * way;
    if (axis != 2) out_.start.z -= out_.ball;
    // The face along the line of the touch, beside the middle by the part's shift.
    const std::size_t other = axis == 2 ? 1 : 1 - axis;
    Point3 off = off_;
    const double slope = std::tan(lean * kDegree) * (axis == 0 ? -1 : 1);
    const double face = part(off, axis) - slope * part(off, other);
    find(axis, part(middle_, axis) + face + errorOfTouch(lean, sign), part(middle_, axis));
    const char letter = "XYZ"[axis];
    const std::string at = letter + text(part(middle_, axis));
    out_.calls["easyprobe"] = fmt::format("G65P9023S55.{}{}{}", letter, text(sign * (way + 9)), wanted(axis));
    const std::string more = "S2" + beyond();
    out_.calls["inspection-plus"] = "G65P9811" + at + more;
    out_.calls["dotek"] = "G65P8811" + at + more;
    out_.results = {{135 + static_cast<std::uint32_t>(axis), out_.found[axis], 1}};
  }

  double sizeOf(double expected, bool outside) {
    if (far_ != 0) return expected + (outside ? -2 : 2) * far_;
    return expected + random_.between(-0.4, 0.4);
  }
  void aboveOrWithin(bool outside) { out_.start = middle_ + Point3{0, 0, outside ? kAbove : kDepth}; }
  // Mostly less than the ball is wide: what forgets it meets the feature on the path down.
  double clearance() { return thousandths(0.6, random_.chance(0.5) ? 1 : 8); }
  std::string downBeside(double clearance) const {
    return "Z" + text(middle_.z + kDepth) + "R" + text(clearance);
  }

  void round(bool boss) {
    const double diameter = thousandths(far_ != 0 ? 30 : 14, 60), size = sizeOf(diameter, boss);
    sim::PartBuilder builder;
    if (!boss) builder.box({-70, -70, -40}, {70, 70, 0});
    const Action action = boss ? Action::Add : Action::Remove;
    if (far_ != 0) { // along one axis alone
      Point3 half{diameter / 2, diameter / 2, 0};
      part(half, random_.below(2)) = size / 2;
      builder.box({-half.x, -half.y, -40}, {half.x, half.y, 0}, action);
    } else {
      builder.cylinder({0, 0, -40}, {0, 0, 0}, size / 2, action);
    }
    place(builder);
    aboveOrWithin(boss);
    find(0, middle_.x + off_.x, middle_.x);
    find(1, middle_.y + off_.y, middle_.y);
    const std::string d = "D" + text(diameter) + (boss ? downBeside(clearance()) : std::string());
    if (!boss) out_.calls["easyprobe"] = "G65P9023D" + text(diameter) + "S55." + wanted(0) + wanted(1);
    const std::string more = "S2" + beyond();
    out_.calls["inspection-plus"] = "G65P9814" + d + more;
    out_.calls["dotek"] = "G65P8814" + d + more;
    out_.results = {{135, out_.found[0], 1}, {136, out_.found[1], 1}, {138, size, 2}};
  }

  void flat(std::size_t axis, bool web) {
    const double width = thousandths(far_ != 0 ? 30 : 14, 60), size = sizeOf(width, web);
    sim::PartBuilder builder;
    Point3 half{45, 45, 0};
    part(half, axis) = size / 2;
    if (!web) builder.box({-60, -60, -40}, {60, 60, 0});
    builder.box({-half.x, -half.y, -40}, {half.x, half.y, 0}, web ? Action::Add : Action::Remove);
    place(builder);
    aboveOrWithin(web);
    // The middle of the two faces along the line of the touches.
    Point3 off = off_;
    const double slope = std::tan(turn_ * kDegree) * (axis == 0 ? -1 : 1);
    find(axis, part(middle_, axis) + part(off, axis) - slope * part(off, 1 - axis), part(middle_, axis));
    const double stretch = 1 / std::cos(turn_ * kDegree) - 1;
    const double measured = size + (size + (web ? 2 : -2) * out_.ball) * stretch;
    const std::string call = std::string(1, "XY"[axis]) + text(width) +
                             (web ? downBeside(clearance()) : std::string()) + "S2" + beyond();
    out_.calls["inspection-plus"] = "G65P9812" + call;
    out_.calls["dotek"] = "G65P8812" + call;
    out_.results = {{135 + static_cast<std::uint32_t>(axis), out_.found[axis], 1}, {138, measured, 2}};
  }

  // Faces across X and Y that meet in the middle.
  void corner(bool outer) {
    const double x = side(), y = side(), wayX = thousandths(10, 25), wayY = thousandths(10, 25);
    sim::PartBuilder builder;
    const auto facing = [&](std::size_t axis, double sign) {
      Point3 least{-60, -60, -40}, most{60, 60, 0};
      (sign > 0 ? part(least, axis) : part(most, axis)) = 0;
      builder.box(least, most, outer && axis == 1 ? Action::Keep : Action::Add);
    };
    facing(0, x);
    facing(1, y);
    out_.start = middle_ + Point3{-x * wayX, -y * wayY, kDepth};
    const double i = thousandths(far_ != 0 ? 20 : 8, 25), j = thousandths(far_ != 0 ? 20 : 8, 25);
    if (random_.chance(0.5))
      off_.x += x * far_;
    else
      off_.y += y * far_;
    place(builder);
    // Where the two touches meet their faces: Y of the one across X, X of the one across Y.
    const double atY = outer ? y * j : -y * wayY, atX = outer ? x * i : -x * wayX;
    const double slope = std::tan(turn_ * kDegree);
    find(0, middle_.x + off_.x - slope * (atY - off_.y) + errorOfTouch(turn_, x), middle_.x);
    find(1, middle_.y + off_.y + slope * (atX - off_.x) + errorOfTouch(turn_, y), middle_.y);
    const std::string at = "X" + text(middle_.x) + "Y" + text(middle_.y);
    if (!outer) out_.calls["inspection-plus"] = "G65P9815" + at + "S2" + beyond();
    out_.calls["dotek"] =
        (outer ? fmt::format("G65P8816{}I{}J{}S2", at, text(i), text(j)) : "G65P8815" + at + "S2") + beyond();
    out_.results = {{135, out_.found[0], 1}, {136, out_.found[1], 1}};
  }

  void angle(std::size_t axis) {
    const double sign = side(), way = thousandths(12, 30), spacing = thousandths(8, 30);
    sim::PartBuilder builder;
    Point3 least{-60, -60, -40}, most{60, 60, 0};
    (sign > 0 ? part(least, axis) : part(most, axis)) = 0;
    builder.box(least, most);
    part(off_, axis) += sign * far_;
    place(builder);
    out_.start = middle_ + Point3{0, 0, kDepth};
    part(out_.start, axis) -= sign * way;
    const std::string at =
        std::string(1, "XY"[axis]) + text(part(middle_, axis)) + "D" + text(spacing) + beyond();
    out_.calls["inspection-plus"] = "G65P9843" + at;
    out_.calls["dotek"] = "G65P8843" + at;
    const double angle = (axis == 0 ? 90 : 0) + turn_;
    const double touches = 2 / spacing / kDegree;
    out_.results = {{139, angle, touches}, {144, turn_, touches}};
  }

  void angledSurface() {
    const double direction = thousandths(-180, 180), way = thousandths(8, 30);
    sim::PartBuilder builder;
    builder.box({0, -60, -40}, {40, 60, 0});
    place(builder, {0, 0, direction});
    const Point3 along{std::cos(direction * kDegree), std::sin(direction * kDegree), 0};
    out_.start = middle_ - along * way + Point3{0, 0, kDepth};
    for (double* coordinate : {&out_.start.x, &out_.start.y}) // the machine is on its increments
      *coordinate = std::round(*coordinate * 1000) / 1000;
    const double distance = (middle_ + off_ - out_.start).dot(along);
    find(0, out_.start.x + along.x * distance, out_.start.x + along.x * way);
    find(1, out_.start.y + along.y * distance, out_.start.y + along.y * way);
    const std::string call = fmt::format("A{}D{}S2", text(direction), text(way)) + beyond();
    out_.calls["inspection-plus"] = "G65P9821" + call;
    out_.calls["dotek"] = "G65P8821" + call;
    out_.results = {{135, out_.found[0], 1}, {136, out_.found[1], 1}};
  }

  void angledFlat(bool web) {
    const double direction = thousandths(-90, 90);
    const double width = thousandths(14, 60), size = width + random_.between(-0.4, 0.4);
    sim::PartBuilder builder;
    if (!web) builder.box({-60, -60, -40}, {60, 60, 0});
    builder.box({-size / 2, -45, -40}, {size / 2, 45, 0}, web ? Action::Add : Action::Remove);
    place(builder, {0, 0, direction});
    aboveOrWithin(web);
    const Point3 along{std::cos(direction * kDegree), std::sin(direction * kDegree), 0};
    const double off = off_.x * along.x + off_.y * along.y;
    find(0, middle_.x + along.x * off, middle_.x);
    find(1, middle_.y + along.y * off, middle_.y);
    const std::string call =
        fmt::format("A{}D{}{}", text(direction), text(width), web ? downBeside(clearance()) : std::string()) +
        beyond();
    out_.calls["inspection-plus"] = "G65P9822" + call;
    out_.calls["dotek"] = "G65P8822" + call;
    out_.results = {{135, out_.found[0], 1}, {136, out_.found[1], 1}, {138, size, 2}};
  }

  void threePoints(bool boss) {
    round(boss);
    const double first = thousandths(-30, 30), second = thousandths(100, 140),
                 third = thousandths(-140, -100);
    const std::string call = out_.calls["inspection-plus"];
    out_.calls.clear();
    const std::string letters =
        fmt::format("A{}B{}C{}{}", text(first), text(second), text(third), call.substr(call.find('D')));
    out_.calls["inspection-plus"] = "G65P9823" + letters;
    out_.calls["dotek"] = "G65P8823" + letters;
    // Three touches spread over the circle tell the middle and the size less well than opposite ones.
    out_.results[0].touches = out_.results[1].touches = 2;
    out_.results[2].touches = 4;
  }

  verify::Random& random_;
  const double turn_, tilt_;
  std::optional<double> search_; // 10 mm without
  double far_ = 0;               // how much farther a surface lies
  Point3 middle_, off_;
  MeasuredFeature out_;
};

} // namespace

MeasuredFeature measuredFeature(std::string_view name, verify::Random& random, const MeasuredPlace& place) {
  return Maker(name, random, place).make();
}

} // namespace dotek::tests
